/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The box in three dimensions, on a canvas: x to the right along the flow, y up along its gradient. Order of
 * painting: edges behind the grains, grains from far to near, edges before the grains. */
import { DARK, rgb } from "./colours.js";
import { isWalled, sheared } from "./flows.js";
import { Spheres } from "./spheres.js";

export const CAMERA = [0.45, 0.22, 1];
const PART = 0.3, /* the visible part of the images above and below */
  SIDE = 0.25; /* the same beyond the box along x */
const EDGES = [];
for (let i = 0; i < 8; i++) for (const bit of [1, 2, 4]) if (!(i & bit)) EDGES.push([i, i | bit]);

export class BoxView {
  /* `turned(camera)`: called after the user has rotated the box; `picked(grain)`: after a click on a grain (null:
   * beside all grains). */
  constructor(canvas, turned, picked) {
    Object.assign(this, { canvas, turned, picked, found: [], spheres: new Spheres(), sheet: document.createElement("canvas") });
    [this.yaw, this.pitch, this.zoom] = CAMERA;
    this.listen();
  }
  get camera() {
    return [this.yaw, this.pitch, this.zoom];
  }
  look([yaw, pitch, zoom]) {
    if (yaw === this.yaw && pitch === this.pitch && zoom === this.zoom) return;
    Object.assign(this, { yaw, pitch, zoom });
    this.again();
  }
  move(yaw, pitch, zoom) {
    this.turned([
      this.yaw + yaw,
      Math.min(1.55, Math.max(-1.55, this.pitch + pitch)),
      Math.min(8, Math.max(0.4, this.zoom * zoom)),
    ]);
  }

  /* One finger or the mouse rotates the box, two fingers zoom; a click without movement picks a grain. */
  listen() {
    let way = Infinity;
    const c = this.canvas,
      held = new Map(),
      apart = () => {
        const [a, b] = [...held.values()];
        return Math.hypot(a[0] - b[0], a[1] - b[1]);
      };
    c.addEventListener("pointerdown", (e) => {
      if (e.button !== 0) return;
      held.set(e.pointerId, [e.clientX, e.clientY]);
      way = held.size === 1 ? 0 : Infinity;
      try {
        c.setPointerCapture(e.pointerId);
      } catch (none) {
        /* the pointer has gone already */
      }
    });
    c.addEventListener("pointerup", (e) => {
      if (held.has(e.pointerId) && way < 5) this.pick(e.offsetX, e.offsetY);
    });
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"])
      c.addEventListener(end, (e) => held.delete(e.pointerId));
    c.addEventListener("pointermove", (e) => {
      if (!(e.buttons & 1)) held.delete(e.pointerId); /* the button was released outside the page */
      const from = held.get(e.pointerId);
      if (!from) return;
      way += Math.hypot(e.clientX - from[0], e.clientY - from[1]);
      const before = held.size === 2 ? apart() : 0;
      held.set(e.pointerId, [e.clientX, e.clientY]);
      if (held.size === 2) this.move(0, 0, apart() / before || 1);
      else if (held.size === 1) this.move((e.clientX - from[0]) * 0.008, (e.clientY - from[1]) * 0.008, 1);
    });
    const keys = {
      ArrowLeft: [-0.1, 0, 1],
      ArrowRight: [0.1, 0, 1],
      ArrowUp: [0, -0.1, 1],
      ArrowDown: [0, 0.1, 1],
      "+": [0, 0, 1.15],
      "-": [0, 0, 1 / 1.15],
    };
    c.addEventListener("keydown", (e) => {
      if (!keys[e.key]) return;
      this.move(...keys[e.key]);
      e.preventDefault();
    });
    c.addEventListener(
      "wheel",
      (e) => {
        if (!e.ctrlKey) return;
        this.move(0, 0, e.deltaY < 0 ? 1.1 : 1 / 1.1);
        e.preventDefault();
      },
      { passive: false },
    );
  }
  /* The grain nearest to the eye among those drawn at this place, with some slack for fingers. */
  pick(x, y) {
    const ratio = this.w / this.canvas.clientWidth,
      nearest = [...this.found].reverse(),
      on = (slack) => nearest.find(([sx, sy, r]) => Math.hypot(sx - x * ratio, sy - y * ratio) <= r + slack * ratio),
      one = on(0) || on(8);
    this.picked(one ? one[4] : null);
  }
  again() {
    if (this.last) this.draw(...this.last);
  }

  /* Make the canvas as large as it is shown. */
  fit() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2),
      w = Math.round(this.canvas.clientWidth * ratio),
      h = Math.round(this.canvas.clientHeight * ratio);
    for (const one of [this.canvas, this.sheet])
      if (one.width !== w || one.height !== h) {
        one.width = w;
        one.height = h;
      }
    this.w = w;
    this.h = h;
    this.thick = Math.max(1, ratio);
  }

  /* Map the box to the screen: [x, y, pixels per length, depth]. A chute is tilted so that gravity points down. */
  aim(box, strips, [along, down] = [0, 0]) {
    const extent = Math.hypot(box[0] * (strips ? 1.25 : 1), box[1] * (strips ? 1.5 : 1), box[2]),
      away = 1.9 * extent,
      roll = Math.atan2(along, -down || 1);
    const [cy, sy, cp, sp, cr, sr] = [this.yaw, this.pitch, along ? roll : 0].flatMap((angle) => [Math.cos(angle), Math.sin(angle)]);
    this.rotate = (a, b, c) => {
      const v = a * sy + c * cy,
        u = a * cy - c * sy,
        up = b * cp - v * sp;
      return [u * cr + up * sr, up * cr - u * sr, b * sp + v * cp];
    };
    let scale = 1,
      right = 0,
      lower = 0;
    this.to = (x, y, z) => {
      const [u, up, depth] = this.rotate(x - box[0] / 2, y - box[1] / 2, z - box[2] / 2),
        f = scale / (away - depth);
      return [right + u * f, lower - up * f, f, depth];
    };
    /* centre the corners, as large as the canvas allows */
    const corners = Array.from({ length: 8 }, (_, i) => this.to(i & 1 ? box[0] : 0, i & 2 ? box[1] : 0, i & 4 ? box[2] : 0)),
      ends = (k) => [Math.min(...corners.map((c) => c[k])), Math.max(...corners.map((c) => c[k]))],
      [x0, x1] = ends(0),
      [y0, y1] = ends(1),
      part = strips ? [1.3, 1.45] : [1.05, 1.07];
    scale = Math.min(this.w / Math.hypot(box[0], box[2]) / part[0] * away * 1.12, this.w / (x1 - x0) / part[0], this.h / (y1 - y0) / part[1]) * this.zoom;
    right = this.w / 2 - (scale * (x0 + x1)) / 2;
    lower = this.h / 2 - (scale * (y0 + y1)) / 2;
    this.far = extent / 2;
    this.corner = [this.rotate(1, 0, 0), this.rotate(0, 1, 0), this.rotate(0, 0, 1)];
    this.away = away;
  }
  /* Is the face of an axis, at its low or its high side, visible from outside? */
  faces(axis, high, box) {
    return this.corner[axis][2] * (high ? 1 : -1) * this.away > box[axis] / 2;
  }

  /* Edges of a box from y0 to y1 that is shifted along x, cut at its sides; only edges for which `which` holds. */
  edges(to, box, [y0, y1], [x0, x1], style, dashes, which = () => true) {
    const point = (i) => this.to(i & 1 ? x1 : x0, i & 2 ? y1 : y0, i & 4 ? box[2] : 0);
    to.strokeStyle = style;
    to.setLineDash(dashes);
    to.lineWidth = this.thick;
    to.beginPath();
    for (const [i, j] of EDGES) {
      if (!which(i, j)) continue;
      to.moveTo(...point(i).slice(0, 2));
      to.lineTo(...point(j).slice(0, 2));
    }
    to.stroke();
    to.setLineDash([]);
  }
  /* An edge is behind if both its faces point away from the eye. */
  isBehind(box) {
    return (i, j) => [0, 1, 2].every((axis) => ((i ^ j) >> axis) & 1 || !this.faces(axis, !!(i & (1 << axis)), box));
  }

  wall(to, box, y) {
    to.fillStyle = "rgba(150, 175, 200, 0.25)";
    to.beginPath();
    for (const [x, z] of [
      [0, 0],
      [box[0], 0],
      [box[0], box[2]],
      [0, box[2]],
    ])
      to.lineTo(...this.to(x, y, z).slice(0, 2));
    to.fill();
  }

  /* All grains to be painted, with those of the images above and below the box, which slide along x:
   * [x, y, r, depth, i, image]. */
  collect(picture, about, box, offset, strips) {
    const found = [],
      { position } = picture,
      part = PART * box[1],
      [from, until] = [-SIDE * box[0], (1 + SIDE) * box[0]];
    const add = (i, x, y, z, image) => {
      const [sx, sy, f, depth] = this.to(x, y, z);
      found.push([sx, sy, (f * about.diameters[about.species[i]]) / 2, depth, i, image]);
    };
    const slide = (i, x, y, z) => {
      for (const one of [x - box[0], x, x + box[0]]) if (one >= from && one <= until) add(i, one, y, z, true);
    };
    for (let i = 0; i < about.species.length; i++) {
      const x = position[3 * i],
        y = position[3 * i + 1],
        z = position[3 * i + 2];
      add(i, x, y, z, false);
      if (strips && y < part) slide(i, (x + offset) % box[0], y + box[1], z);
      if (strips && y > box[1] - part) slide(i, (((x - offset) % box[0]) + box[0]) % box[0], y - box[1], z);
    }
    return found.sort((a, b) => a[3] - b[3]);
  }

  grains(found, picture, map) {
    for (const [x, y, r, depth, i, image] of found) {
      if (r <= 0 || x < -r || y < -r || x > this.w + r || y > this.h + r) continue;
      const fog = Math.min(1, Math.max(0, 0.5 - depth / (2 * this.far)) * 0.75 + (image ? 0.45 : 0));
      let spin = null;
      if (picture.marks && r > 2) {
        const [u, up, near] = this.rotate(picture.marks[3 * i], picture.marks[3 * i + 1], picture.marks[3 * i + 2]);
        spin = [u, -up, near];
      }
      this.spheres.paint(x, y, r, picture.value[i], map, fog, spin);
    }
  }

  /* The two grains of the last collision, and the line k between their centres. */
  pair(to, event, found) {
    const both = event.grain.map((i) => found.find((one) => one[4] === i && !one[5]));
    if (both.some((one) => !one)) return;
    for (const one of both) this.ring(to, one);
    const [a, b] = both,
      away = Math.hypot(a[0] - b[0], a[1] - b[1]);
    if (away > 4 * (a[2] + b[2])) return; /* the grains collided across a side of the box */
    const dx = b[0] - a[0],
      dy = b[1] - a[1];
    to.beginPath();
    to.moveTo(a[0] - dx, a[1] - dy);
    to.lineTo(b[0] + dx, b[1] + dy);
    to.stroke();
  }

  /* An arrow from a place of the box along a direction of it; its length is in pixels. */
  arrow(to, [x, y, z], [a, b, c], length) {
    const [x0, y0] = this.to(x, y, z),
      [u, up] = this.rotate(a, b, c),
      size = Math.hypot(u, up) || 1,
      [ux, uy] = [u / size, -up / size],
      head = length / 3;
    const [x1, y1] = [x0 + ux * length, y0 + uy * length];
    to.strokeStyle = to.fillStyle = "#f0f4f8";
    to.lineWidth = 2.5 * this.thick;
    to.beginPath();
    to.moveTo(x0 - ux * length, y0 - uy * length);
    to.lineTo(x1 - ux * head, y1 - uy * head);
    to.stroke();
    to.beginPath();
    to.moveTo(x1, y1);
    to.lineTo(x1 - ux * head - uy * head * 0.6, y1 - uy * head + ux * head * 0.6);
    to.lineTo(x1 - ux * head + uy * head * 0.6, y1 - uy * head - ux * head * 0.6);
    to.fill();
  }
  /* Arrows for the motion of images and walls, and for gravity. */
  arrows(to, box, values, strips) {
    const length = 22 * this.thick,
      moves = strips ? PART : values.flow === "couette" ? 0.06 : 0,
      along = Math.sign(values.flow === "couette" ? values.walls.speed : 1) || 1;
    if (moves)
      for (const [y, sign] of [
        [1 + moves * 0.8, along],
        [-moves * 0.8, -along],
      ])
        this.arrow(to, [box[0] / 2, box[1] * y, box[2] / 2], [sign, 0, 0], length);
    if (values.gravity && values.gravity.some((one) => one !== 0)) {
      this.arrow(to, [box[0] / 2, box[1] * 0.9, box[2]], values.gravity, length);
      const [x, y] = this.to(box[0] / 2, box[1] * 0.9, box[2]);
      to.font = `italic ${16 * this.thick}px serif`;
      to.fillText("g", x + 8 * this.thick, y - 4 * this.thick);
    }
  }

  /* Every grain's velocity, or that of the followed grain, as a line from its centre. The velocity of the grain that
   * was fastest at the start is a sixth of the box long. */
  velocities(to, picture, about, box) {
    const per = Math.min(...box) / 6 / (about.fastest || 1),
      { velocity, position, one } = picture,
      line = (at, v) => {
        const [x0, y0] = this.to(...at),
          [x1, y1] = this.to(...at.map((x, k) => x + v[k] * per)),
          size = Math.hypot(x1 - x0, y1 - y0),
          head = Math.min(size / 2, 5 * this.thick) / (size || 1),
          [ux, uy] = [(x1 - x0) * head, (y1 - y0) * head];
        to.moveTo(x0, y0);
        to.lineTo(x1, y1);
        to.moveTo(x1 - ux - uy * 0.6, y1 - uy + ux * 0.6);
        to.lineTo(x1, y1);
        to.lineTo(x1 - ux + uy * 0.6, y1 - uy - ux * 0.6);
      };
    to.lineWidth = this.thick;
    to.strokeStyle = "rgba(240, 244, 248, 0.55)";
    to.beginPath();
    if (velocity) for (let i = 0; i < velocity.length; i += 3) line(position.subarray(i, i + 3), velocity.subarray(i, i + 3));
    to.stroke();
    if (!one) return;
    to.lineWidth = 2.5 * this.thick;
    to.strokeStyle = "#ffffff";
    to.beginPath();
    line(one.position, one.velocity);
    to.stroke();
  }
  /* The followed grain: its trail, paler where it is older, and a ring. The grain leaves the box on one side and
   * enters on another: no line crosses the box there. */
  trail(to, trail, box, followed) {
    to.lineWidth = 2 * this.thick;
    for (let k = 1; k < trail.length; k++) {
      if (trail[k].some((x, a) => Math.abs(x - trail[k - 1][a]) > box[a] / 2)) continue;
      to.strokeStyle = `rgba(255, 255, 255, ${(0.15 + (0.7 * k) / trail.length).toFixed(2)})`;
      to.beginPath();
      to.moveTo(...this.to(...trail[k - 1]).slice(0, 2));
      to.lineTo(...this.to(...trail[k]).slice(0, 2));
      to.stroke();
    }
    if (followed) this.ring(to, followed);
  }
  ring(to, [x, y, r]) {
    to.lineWidth = 2 * this.thick;
    to.strokeStyle = "#ffffff";
    to.beginPath();
    to.arc(x, y, r + to.lineWidth, 0, 2 * Math.PI);
    to.stroke();
  }

  draw(picture, state, about, options) {
    this.last = [picture, state, about, options];
    this.fit();
    if (!this.w || !this.h) return; /* the box is not shown */
    const to = this.canvas.getContext("2d"),
      { box } = state,
      { values } = about,
      walls = isWalled(values) ? (values.walls.top === "open" ? [0] : [0, 1]) : [],
      strips = options.images && sheared(values);
    to.fillStyle = rgb(DARK);
    to.fillRect(0, 0, this.w, this.h);
    if (!picture) return;
    this.aim(box, strips, values.flow === "chute" ? values.gravity : undefined);
    const behind = this.isBehind(box),
      whole = [
        [0, box[1]],
        [0, box[0]],
      ];
    if (strips) this.outlines(to, box, state.imageOffset);
    for (const side of walls) if (!this.faces(1, !!side, box)) this.wall(to, box, side * box[1]);
    this.edges(to, box, ...whole, "rgba(160, 185, 205, 0.55)", [], behind);
    this.spheres.begin(this.w, this.h);
    const found = (this.found = this.collect(picture, about, box, state.imageOffset, strips));
    this.grains(found, picture, options.map);
    this.sheet.getContext("2d").putImageData(this.spheres.image, 0, 0);
    to.drawImage(this.sheet, 0, 0);
    for (const side of walls) if (this.faces(1, !!side, box)) this.wall(to, box, side * box[1]);
    this.edges(to, box, ...whole, "rgba(190, 210, 225, 0.9)", [], (i, j) => !behind(i, j));
    this.arrows(to, box, values, strips);
    if (picture.velocity || picture.one) this.velocities(to, picture, about, box);
    if (picture.one) this.trail(to, options.trail || [], box, found.find((one) => one[4] === options.grain && !one[5]));
    if (options.event) this.pair(to, options.event, found);
  }

  /* Outlines of the images: their visible part, with the sides of their boxes, which slide. */
  outlines(to, box, offset) {
    const cut = (x) => Math.min((1 + SIDE) * box[0], Math.max(-SIDE * box[0], x)),
      dashes = [4 * this.thick, 4 * this.thick];
    for (const [ys, shift] of [
      [[box[1], (1 + PART) * box[1]], offset],
      [[-PART * box[1], 0], -offset],
    ]) {
      const from = ((shift % box[0]) + box[0]) % box[0];
      for (const x of [from - box[0], from])
        if (cut(x + box[0]) > cut(x))
          this.edges(to, box, ys, [cut(x), cut(x + box[0])], "rgba(160, 185, 205, 0.45)", dashes);
    }
  }
}
