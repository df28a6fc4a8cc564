/* Spheres as pixels, painted by the page itself: some thousand a picture take a few milliseconds on the processor, with
 * or without a graphics processor. */
const LEVELS = 32,
  SHADES = 32,
  DARK = [16, 21, 26];

/* Dark blue to light yellow through grey, equally well told apart without red or green (after cividis). */
const COLOUR_MAP = [
  [20, 60, 130],
  [70, 90, 125],
  [124, 123, 120],
  [186, 165, 100],
  [255, 234, 70],
];
function colourAt(x) {
  const at = Math.min(Math.max(x, 0), 1) * (COLOUR_MAP.length - 1),
    i = Math.min(Math.floor(at), COLOUR_MAP.length - 2),
    f = at - i;
  return COLOUR_MAP[i].map((c, k) => Math.round(c + f * (COLOUR_MAP[i + 1][k] - c)));
}
const rgb = (c) => `rgb(${c.join(",")})`;
const word = ([r, g, b]) => ((255 << 24) | (Math.min(255, b) << 16) | (Math.min(255, g) << 8) | Math.min(255, r)) >>> 0;
const between = (a, b, f) => a.map((x, k) => Math.round(x + f * (b[k] - x)));

/* Pixels of a colour by shade, from the dark rim to the gleam; the faint ones are for the images of the box. */
function paints(faint) {
  const all = new Uint32Array(LEVELS * SHADES);
  for (let level = 0; level < LEVELS; level++)
    for (let shade = 0; shade < SHADES; shade++) {
      const f = shade / (SHADES - 1),
        c = colourAt(level / (LEVELS - 1));
      const lit = f < 0.8 ? between(DARK, c, f / 0.8) : between(c, [255, 255, 255], ((f - 0.8) / 0.2) * 0.75);
      all[level * SHADES + shade] = word(faint ? between(DARK, lit, 0.3) : lit);
    }
  return all;
}

/* Shades of a sphere whose centre stands a part of a pixel off: rows of first pixel and shades. Lit from above left. */
function shadesOf(r, offX, offY) {
  const size = Math.ceil(r + 1),
    rows = [];
  for (let y = -size; y <= size; y++) {
    const row = { y, x: 0, shades: [] };
    for (let x = -size; x <= size; x++) {
      const u = (x + 0.5 - offX) / r,
        v = (y + 0.5 - offY) / r,
        away = Math.hypot(u, v),
        cover = Math.min(1, (1 - away) * r + 0.5);
      if (cover <= 0) continue;
      const depth = Math.sqrt(Math.max(0, 1 - away * away)),
        light = Math.max(0, -0.45 * u - 0.55 * v + 0.7 * depth);
      if (!row.shades.length) row.x = x;
      row.shades.push(
        Math.round((SHADES - 1) * cover * Math.min(1, 0.22 + 0.6 * light + (0.22 * Math.max(0, light - 0.85)) / 0.15)),
      );
    }
    if (row.shades.length) rows.push({ ...row, shades: Uint8Array.from(row.shades) });
  }
  return rows;
}

class Spheres {
  constructor() {
    this.paints = [paints(false), paints(true)];
    this.shapes = new Map();
    this.dark = word(DARK);
  }

  /* An empty picture. */
  begin(w, h) {
    if (!this.image || this.image.width !== w || this.image.height !== h) {
      this.image = new ImageData(w, h);
      this.pixels = new Uint32Array(this.image.data.buffer);
    }
    this.pixels.fill(this.dark);
  }

  /* Radii to a quarter of a pixel, places too: nothing jitters. */
  shape(r, fx, fy) {
    const q = Math.max(2, Math.round(4 * r)),
      key = (q * 4 + fx) * 4 + fy;
    if (!this.shapes.has(key)) {
      this.kept = (this.kept || 0) + q * q; /* pixels, some; all together a few megabytes */
      if (this.kept > 4e7) {
        this.shapes.clear();
        this.kept = q * q;
      }
      this.shapes.set(key, shadesOf(q / 4, (fx + 0.5) / 4, (fy + 0.5) / 4));
    }
    return this.shapes.get(key);
  }

  paint(x, y, r, value, faint) {
    const { width: w, height: h } = this.image,
      x0 = Math.floor(x),
      y0 = Math.floor(y);
    const rows = this.shape(Math.min(r, 400), Math.floor(4 * (x - x0)), Math.floor(4 * (y - y0)));
    const level = Math.min(LEVELS - 1, Math.max(0, Math.round(value * (LEVELS - 1)) || 0)) * SHADES,
      from = this.paints[faint ? 1 : 0];
    for (const row of rows) {
      const at = y0 + row.y;
      if (at < 0 || at >= h) continue;
      const first = x0 + row.x,
        begin = Math.max(0, -first),
        end = Math.min(row.shades.length, w - first),
        base = at * w + first;
      for (let k = begin; k < end; k++) this.pixels[base + k] = from[level + row.shades[k]];
    }
  }

  /* A dot on a sphere, an ellipse that is narrow along (ux, uy). */
  dot(x, y, wide, narrow, ux, uy, colour) {
    const { width: w, height: h } = this.image,
      paint = word(colour);
    for (let b = Math.max(0, Math.floor(y - wide)); b <= Math.min(h - 1, Math.ceil(y + wide)); b++)
      for (let a = Math.max(0, Math.floor(x - wide)); a <= Math.min(w - 1, Math.ceil(x + wide)); a++) {
        const dx = a + 0.5 - x,
          dy = b + 0.5 - y,
          along = (dx * ux + dy * uy) / narrow,
          across = (dy * ux - dx * uy) / wide;
        if (along * along + across * across <= 1) this.pixels[b * w + a] = paint;
      }
  }
}
