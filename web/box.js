/* The box in three dimensions, on a canvas: x to the right along the flow, y up along its gradient; the far grains are
 * painted first. */
class BoxView {
  constructor(canvas) {
    this.canvas = canvas;
    this.yaw = 0.45;
    this.pitch = 0.22;
    this.zoom = 1;
    this.spheres = new Spheres();
    this.listen();
  }

  listen() {
    const c = this.canvas;
    let from = null;
    const turn = (dx, dy) => {
      this.yaw += dx;
      this.pitch = Math.min(1.5, Math.max(-1.5, this.pitch + dy));
      this.again();
    };
    c.addEventListener("pointerdown", (e) => {
      if (e.button !== 0) return;
      from = [e.clientX, e.clientY];
      c.setPointerCapture(e.pointerId);
    });
    for (const end of ["pointerup", "pointercancel", "lostpointercapture"])
      c.addEventListener(end, () => {
        from = null;
      });
    c.addEventListener("pointermove", (e) => {
      if (!(e.buttons & 1)) from = null; /* it was let go where nobody saw it */
      if (!from) return;
      turn((e.clientX - from[0]) * 0.008, (e.clientY - from[1]) * 0.008);
      from = [e.clientX, e.clientY];
    });
    const keys = {
      ArrowLeft: () => turn(-0.1, 0),
      ArrowRight: () => turn(0.1, 0),
      ArrowUp: () => turn(0, -0.1),
      ArrowDown: () => turn(0, 0.1),
      "+": () => this.zoomBy(1.15),
      "-": () => this.zoomBy(1 / 1.15),
    };
    c.addEventListener("keydown", (e) => {
      if (keys[e.key]) {
        keys[e.key]();
        e.preventDefault();
      }
    });
    c.addEventListener(
      "wheel",
      (e) => {
        if (e.ctrlKey) {
          this.zoomBy(e.deltaY < 0 ? 1.1 : 1 / 1.1);
          e.preventDefault();
        }
      },
      { passive: false },
    );
  }
  zoomBy(factor) {
    this.zoom = Math.min(6, Math.max(0.4, this.zoom * factor));
    this.again();
  }
  again() {
    if (this.last) this.draw(...this.last);
  }

  /* The canvas as large as it is shown. */
  fit() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2),
      w = Math.round(this.canvas.clientWidth * ratio),
      h = Math.round(this.canvas.clientHeight * ratio);
    if (this.canvas.width !== w || this.canvas.height !== h) {
      this.canvas.width = w;
      this.canvas.height = h;
    }
    this.w = w;
    this.h = h;
  }

  /* From the box to the screen: [x, y, pixels per length, depth]. */
  aim(box, strips) {
    const extent = Math.hypot(box[0], box[1] * (strips ? 1.35 : 1), box[2]),
      away = 1.9 * extent;
    const cy = Math.cos(this.yaw),
      sy = Math.sin(this.yaw),
      cp = Math.cos(this.pitch),
      sp = Math.sin(this.pitch);
    const scale = this.zoom * Math.min(this.w / Math.hypot(box[0], box[2]), this.h / (extent * 0.92)) * away * 0.94;
    this.to = (x, y, z) => {
      const a = x - box[0] / 2,
        b = y - box[1] / 2,
        c = z - box[2] / 2;
      const u = a * cy - c * sy,
        v = a * sy + c * cy,
        up = b * cp - v * sp,
        depth = b * sp + v * cp;
      const f = scale / (away - depth);
      return [this.w / 2 + u * f, this.h / 2 - up * f, f, depth];
    };
  }

  edges(to, box, y0, y1, shift, style, dashes) {
    const corner = (i) => this.to(shift + (i & 1 ? box[0] : 0), i & 2 ? y1 : y0, i & 4 ? box[2] : 0);
    to.strokeStyle = style;
    to.setLineDash(dashes);
    to.lineWidth = Math.max(1, this.w / 700);
    to.beginPath();
    for (const [i, j] of [
      [0, 1],
      [2, 3],
      [4, 5],
      [6, 7],
      [0, 2],
      [1, 3],
      [4, 6],
      [5, 7],
      [0, 4],
      [1, 5],
      [2, 6],
      [3, 7],
    ]) {
      to.moveTo(...corner(i).slice(0, 2));
      to.lineTo(...corner(j).slice(0, 2));
    }
    to.stroke();
    to.setLineDash([]);
  }

  wall(to, box, y) {
    to.fillStyle = "rgba(150, 175, 200, 0.28)";
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

  /* All grains to be painted, with those of the images in strips above and below the box: [x, y, r, depth, i, faint]. */
  collect(picture, about, box, offset, strips) {
    const found = [],
      { position } = picture,
      part = 0.3 * box[1];
    const add = (i, x, y, z, faint) => {
      const [sx, sy, f, depth] = this.to(x, y, z);
      found.push([sx, sy, (f * about.diameters[about.species[i]]) / 2, depth, i, faint]);
    };
    for (let i = 0; i < about.species.length; i++) {
      const x = position[3 * i],
        y = position[3 * i + 1],
        z = position[3 * i + 2];
      add(i, x, y, z, false);
      if (!strips) continue;
      if (y < part) add(i, (x + offset) % box[0], y + box[1], z, true);
      if (y > box[1] - part) add(i, (x - offset + box[0]) % box[0], y - box[1], z, true);
    }
    return found.sort((a, b) => a[3] - b[3]);
  }

  grains(found, picture) {
    for (const [x, y, r, , i, faint] of found) {
      if (r <= 0 || x < -r || y < -r || x > this.w + r || y > this.h + r) continue;
      this.spheres.paint(x, y, r, picture.value[i], faint);
      if (picture.marks && !faint && r > 3) this.mark(x, y, r, picture.marks, 3 * i);
    }
  }

  /* Two dots on opposite sides of a grain, which turn with it: the one that is seen. */
  mark(x, y, r, marks, at) {
    const cy = Math.cos(this.yaw),
      sy = Math.sin(this.yaw),
      cp = Math.cos(this.pitch),
      sp = Math.sin(this.pitch);
    const a = marks[at],
      b = marks[at + 1],
      c = marks[at + 2];
    const u = a * cy - c * sy,
      v = a * sy + c * cy,
      up = b * cp - v * sp,
      depth = b * sp + v * cp,
      side = depth < 0 ? -1 : 1;
    const flat = Math.hypot(u, up) || 1;
    this.spheres.dot(
      x + side * u * r * 0.8,
      y - side * up * r * 0.8,
      r * 0.28,
      Math.max(0.5, r * 0.28 * Math.abs(depth)),
      u / flat,
      -up / flat,
      depth < 0 ? [255, 255, 255] : [10, 12, 14],
    );
  }

  /* The two of the last collision, and the line k between their centres. */
  pair(to, event, found) {
    const both = event.grain.map((i) => found.find((one) => one[4] === i && !one[5]));
    if (both.some((one) => !one)) return;
    to.lineWidth = Math.max(2, this.w / 350);
    to.strokeStyle = "#ffffff";
    for (const [x, y, r] of both) {
      to.beginPath();
      to.arc(x, y, r + to.lineWidth, 0, 2 * Math.PI);
      to.stroke();
    }
    const [a, b] = both,
      away = Math.hypot(a[0] - b[0], a[1] - b[1]);
    if (away > 4 * (a[2] + b[2])) return; /* they met across a side of the box */
    const dx = b[0] - a[0],
      dy = b[1] - a[1];
    to.strokeStyle = "#ffffff";
    to.beginPath();
    to.moveTo(a[0] - dx, a[1] - dy);
    to.lineTo(b[0] + dx, b[1] + dy);
    to.stroke();
  }

  arrows(to, box) {
    to.fillStyle = "#dfe6ee";
    to.font = `${Math.max(14, this.h / 26)}px sans-serif`;
    to.textAlign = "center";
    for (const [y, text] of [
      [box[1] * 1.22, "⟶"],
      [-box[1] * 0.22, "⟵"],
    ]) {
      const [x, at] = this.to(box[0] / 2, y, box[2] / 2);
      to.fillText(text, x, at);
    }
  }

  draw(picture, state, about, options) {
    this.last = [picture, state, about, options];
    this.fit();
    if (!this.w || !this.h) return; /* it is not shown */
    const to = this.canvas.getContext("2d"),
      box = state.box,
      flow = about.values.flow;
    const sheared = /shear|usf/.test(flow),
      walled = /couette|poiseuille|chute/.test(flow),
      strips = sheared && options.images;
    this.spheres.begin(this.w, this.h);
    if (!picture) {
      to.putImageData(this.spheres.image, 0, 0);
      return;
    }
    this.aim(box, strips);
    const found = this.collect(picture, about, box, state.imageOffset, strips);
    this.grains(found, picture);
    to.putImageData(this.spheres.image, 0, 0);
    if (walled) this.wall(to, box, 0);
    if (walled && about.values.walls.top !== "open") this.wall(to, box, box[1]);
    this.edges(to, box, 0, box[1], 0, "rgba(160, 185, 205, 0.75)", []);
    if (strips) this.arrows(to, box);
    if (options.event) this.pair(to, options.event, found);
  }
}
