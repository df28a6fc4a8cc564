/* The box in three dimensions, on a canvas: x to the right along the flow, y up along its gradient. Grains are pictures
 * of spheres, painted once a colour and then copied, the far ones first. */
const LEVELS = 32;

/* Dark blue to light yellow through grey, equally well told apart without red or green (after cividis). */
const COLOUR_MAP = [[0, 45, 110], [70, 90, 125], [124, 123, 120], [186, 165, 100], [255, 234, 70]];
function colourAt(x) {
  const at = Math.min(Math.max(x, 0), 1) * (COLOUR_MAP.length - 1), i = Math.min(Math.floor(at), COLOUR_MAP.length - 2), f = at - i;
  return COLOUR_MAP[i].map((c, k) => Math.round(c + f * (COLOUR_MAP[i + 1][k] - c)));
}
const rgb = (c, lighter = 0) => `rgb(${c.map((x) => Math.round(x + (255 - x) * lighter)).join(",")})`;

/* A sphere of that colour, lit from above left. */
function sphere(colour, size) {
  const canvas = document.createElement("canvas"), r = size / 2;
  canvas.width = canvas.height = size;
  const to = canvas.getContext("2d"), light = to.createRadialGradient(r * 0.65, r * 0.6, r * 0.1, r, r, r);
  light.addColorStop(0, rgb(colour, 0.65));
  light.addColorStop(0.45, rgb(colour, 0.15));
  light.addColorStop(1, rgb(colour.map((c) => c * 0.55)));
  to.fillStyle = light;
  to.beginPath();
  to.arc(r, r, r - 0.5, 0, 2 * Math.PI);
  to.fill();
  return canvas;
}

class BoxView {
  constructor(canvas) {
    this.canvas = canvas;
    this.yaw = 0.45;
    this.pitch = 0.22;
    this.zoom = 1;
    this.spheres = Array.from({ length: LEVELS }, (_, i) => sphere(colourAt(i / (LEVELS - 1)), 48));
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
    c.addEventListener("pointerdown", (e) => { from = [e.clientX, e.clientY]; c.setPointerCapture(e.pointerId); });
    c.addEventListener("pointerup", () => { from = null; });
    c.addEventListener("pointermove", (e) => {
      if (!from) return;
      turn((e.clientX - from[0]) * 0.008, (e.clientY - from[1]) * 0.008);
      from = [e.clientX, e.clientY];
    });
    const keys = { ArrowLeft: () => turn(-0.1, 0), ArrowRight: () => turn(0.1, 0), ArrowUp: () => turn(0, -0.1),
      ArrowDown: () => turn(0, 0.1), "+": () => this.zoomBy(1.15), "-": () => this.zoomBy(1 / 1.15) };
    c.addEventListener("keydown", (e) => { if (keys[e.key]) { keys[e.key](); e.preventDefault(); } });
    c.addEventListener("wheel", (e) => { if (e.ctrlKey) { this.zoomBy(e.deltaY < 0 ? 1.1 : 1 / 1.1); e.preventDefault(); } }, { passive: false });
  }
  zoomBy(factor) {
    this.zoom = Math.min(6, Math.max(0.4, this.zoom * factor));
    this.again();
  }
  again() { if (this.last) this.draw(...this.last); }

  /* The canvas as large as it is shown. */
  fit() {
    const ratio = Math.min(window.devicePixelRatio || 1, 2), w = Math.round(this.canvas.clientWidth * ratio), h = Math.round(this.canvas.clientHeight * ratio);
    if (this.canvas.width !== w || this.canvas.height !== h) { this.canvas.width = w; this.canvas.height = h; }
    this.w = w;
    this.h = h;
  }

  /* From the box to the screen: [x, y, pixels per length, depth]. */
  aim(box, strips) {
    const extent = Math.hypot(box[0], box[1] * (strips ? 1.35 : 1), box[2]), away = 1.9 * extent;
    const cy = Math.cos(this.yaw), sy = Math.sin(this.yaw), cp = Math.cos(this.pitch), sp = Math.sin(this.pitch);
    const scale = this.zoom * Math.min(this.w / Math.hypot(box[0], box[2]) , this.h / (extent * 0.92)) * away * 0.94;
    this.to = (x, y, z) => {
      const a = x - box[0] / 2, b = y - box[1] / 2, c = z - box[2] / 2;
      const u = a * cy - c * sy, v = a * sy + c * cy, up = b * cp - v * sp, depth = b * sp + v * cp;
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
    for (const [i, j] of [[0, 1], [2, 3], [4, 5], [6, 7], [0, 2], [1, 3], [4, 6], [5, 7], [0, 4], [1, 5], [2, 6], [3, 7]]) {
      to.moveTo(...corner(i).slice(0, 2));
      to.lineTo(...corner(j).slice(0, 2));
    }
    to.stroke();
    to.setLineDash([]);
  }

  wall(to, box, y) {
    to.fillStyle = "rgba(150, 175, 200, 0.28)";
    to.beginPath();
    for (const [x, z] of [[0, 0], [box[0], 0], [box[0], box[2]], [0, box[2]]]) to.lineTo(...this.to(x, y, z).slice(0, 2));
    to.fill();
  }

  /* All grains to be painted, with those of the images in strips above and below the box: [x, y, r, depth, i, faint]. */
  collect(picture, about, box, offset, strips) {
    const found = [], { position } = picture, part = 0.3 * box[1];
    const add = (i, x, y, z, faint) => {
      const [sx, sy, f, depth] = this.to(x, y, z);
      found.push([sx, sy, f * about.diameters[about.species[i]] / 2, depth, i, faint]);
    };
    for (let i = 0; i < about.species.length; i++) {
      const x = position[3 * i], y = position[3 * i + 1], z = position[3 * i + 2];
      add(i, x, y, z, false);
      if (!strips) continue;
      if (y < part) add(i, (x + offset) % box[0], y + box[1], z, true);
      if (y > box[1] - part) add(i, (x - offset + box[0]) % box[0], y - box[1], z, true);
    }
    return found.sort((a, b) => a[3] - b[3]);
  }

  grains(to, found, picture) {
    for (const [x, y, r, , i, faint] of found) {
      if (r <= 0 || x < -r || y < -r || x > this.w + r || y > this.h + r) continue;
      to.globalAlpha = faint ? 0.28 : 1;
      to.drawImage(this.spheres[Math.min(LEVELS - 1, Math.max(0, Math.round(picture.value[i] * (LEVELS - 1))))], x - r, y - r, 2 * r, 2 * r);
      if (picture.marks && !faint && r > 3) this.mark(to, x, y, r, picture.marks, 3 * i);
    }
    to.globalAlpha = 1;
  }

  /* Two dots on opposite sides of a grain, which turn with it: the one that is seen. */
  mark(to, x, y, r, marks, at) {
    const cy = Math.cos(this.yaw), sy = Math.sin(this.yaw), cp = Math.cos(this.pitch), sp = Math.sin(this.pitch);
    const a = marks[at], b = marks[at + 1], c = marks[at + 2];
    const u = a * cy - c * sy, v = a * sy + c * cy, up = b * cp - v * sp, depth = b * sp + v * cp, side = depth < 0 ? -1 : 1;
    const flat = Math.abs(depth), angle = Math.atan2(-up * side, u * side);
    to.fillStyle = depth < 0 ? "#ffffff" : "#101418";
    to.beginPath();
    to.ellipse(x + side * u * r * 0.8, y - side * up * r * 0.8, Math.max(0.4, r * 0.26 * flat), r * 0.26, angle, 0, 2 * Math.PI);
    to.fill();
  }

  /* The two of the last collision, and the line k between their centres. */
  pair(to, event, found) {
    const both = event.grain.map((i) => found.find((one) => one[4] === i && !one[5]));
    if (both.some((one) => !one)) return;
    to.lineWidth = Math.max(2, this.w / 350);
    to.strokeStyle = "#ffffff";
    for (const [x, y, r] of both) { to.beginPath(); to.arc(x, y, r + to.lineWidth, 0, 2 * Math.PI); to.stroke(); }
    const [a, b] = both, away = Math.hypot(a[0] - b[0], a[1] - b[1]);
    if (away > 4 * (a[2] + b[2])) return; /* they met across a side of the box */
    const dx = (b[0] - a[0]), dy = (b[1] - a[1]);
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
    for (const [y, text] of [[box[1] * 1.22, "⟶"], [-box[1] * 0.22, "⟵"]]) {
      const [x, at] = this.to(box[0] / 2, y, box[2] / 2);
      to.fillText(text, x, at);
    }
  }

  draw(picture, state, about, options) {
    this.last = [picture, state, about, options];
    this.fit();
    const to = this.canvas.getContext("2d"), box = state.box, flow = about.values.flow;
    const sheared = /shear|usf/.test(flow), walled = /couette|poiseuille|chute/.test(flow), strips = sheared && options.images;
    to.fillStyle = "#10151a";
    to.fillRect(0, 0, this.w, this.h);
    if (!picture) return;
    this.aim(box, strips);
    if (walled) for (const y of [0, box[1]]) this.wall(to, box, y);
    this.edges(to, box, 0, box[1], 0, "#8fa3b5", []);
    const found = this.collect(picture, about, box, state.imageOffset, strips);
    this.grains(to, found, picture);
    if (strips) this.arrows(to, box);
    if (options.event) this.pair(to, options.event, found);
  }
}
