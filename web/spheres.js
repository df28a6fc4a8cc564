/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Spheres as pixels, painted by the page itself: some thousand a picture take a few milliseconds on the processor,
 * with or without a graphics processor. Pixels without a sphere are transparent. */
import { DARK, colourAt } from "./colours.js";

const LEVELS = 64,
  SHADES = 32,
  FOGS = 8;

const word = ([r, g, b]) => ((255 << 24) | (Math.min(255, b) << 16) | (Math.min(255, g) << 8) | Math.min(255, r)) >>> 0;
const between = (a, b, f) => a.map((x, k) => Math.round(x + f * (b[k] - x)));

/* Pixels of a map by fog, level and shade: from the dark rim to the highlight; far spheres approach the colour of
 * the ground. */
function paints(map) {
  const all = new Uint32Array(FOGS * LEVELS * SHADES);
  let at = 0;
  for (let fog = 0; fog < FOGS; fog++)
    for (let level = 0; level < LEVELS; level++)
      for (let shade = 0; shade < SHADES; shade++) {
        const f = shade / (SHADES - 1),
          c = colourAt(level / (LEVELS - 1), map);
        const lit = f < 0.8 ? between(DARK, c, f / 0.8) : between(c, [255, 255, 255], ((f - 0.8) / 0.2) * 0.75);
        all[at++] = word(between(lit, DARK, (0.72 * fog) / (FOGS - 1)));
      }
  return all;
}

const made = {}; /* made once, when first drawn */
const paintsOf = (map) => (made[map] ||= paints(map));

/* A sphere whose centre is off by a part of a pixel: rows of first pixel, shades, and the direction of the surface
 * in parts of 127. Lit from above left. */
function shapeOf(r, offX, offY) {
  const size = Math.ceil(r + 1),
    rows = [];
  for (let y = -size; y <= size; y++) {
    const shades = [],
      normal = [];
    let first = 0;
    for (let x = -size; x <= size; x++) {
      const u = (x + 0.5 - offX) / r,
        v = (y + 0.5 - offY) / r,
        away = Math.hypot(u, v),
        cover = Math.min(1, (1 - away) * r + 0.5);
      if (cover <= 0) continue;
      const depth = Math.sqrt(Math.max(0, 1 - away * away)),
        light = Math.max(0, -0.45 * u - 0.55 * v + 0.7 * depth);
      if (!shades.length) first = x;
      shades.push(
        Math.round((SHADES - 1) * cover * Math.min(1, 0.22 + 0.6 * light + (0.22 * Math.max(0, light - 0.85)) / 0.15)),
      );
      normal.push(127 * u, 127 * v, 127 * depth);
    }
    if (shades.length) rows.push({ y, x: first, shades: Uint8Array.from(shades), normal: Int8Array.from(normal) });
  }
  return rows;
}

export class Spheres {
  constructor() {
    this.shapes = new Map();
  }

  /* An empty picture. */
  begin(w, h) {
    if (!this.image || this.image.width !== w || this.image.height !== h) {
      this.image = new ImageData(w, h);
      this.pixels = new Uint32Array(this.image.data.buffer);
    }
    this.pixels.fill(0);
  }

  /* Radii and places are rounded to a quarter of a pixel: nothing jitters. */
  shape(r, fx, fy) {
    const q = Math.max(2, Math.round(4 * r)),
      key = (q * 4 + fx) * 4 + fy;
    if (!this.shapes.has(key)) {
      this.kept = (this.kept || 0) + q * q; /* pixels, approximately; all shapes together take a few megabytes */
      if (this.kept > 2e7) {
        this.shapes.clear();
        this.kept = q * q;
      }
      this.shapes.set(key, shapeOf(q / 4, (fx + 0.5) / 4, (fy + 0.5) / 4));
    }
    return this.shapes.get(key);
  }

  /* fog from 0, near, to 1. spin: a direction on the screen [right, down, to the eye]; the half of the sphere that
   * it points to is darker. */
  paint(x, y, r, value, map, fog, spin) {
    const { width: w, height: h } = this.image,
      x0 = Math.floor(x),
      y0 = Math.floor(y),
      rows = this.shape(Math.min(r, 400), Math.floor(4 * (x - x0)), Math.floor(4 * (y - y0))),
      level = Math.min(LEVELS - 1, Math.max(0, Math.round(value * (LEVELS - 1)) || 0)),
      base = (Math.round(fog * (FOGS - 1)) * LEVELS + level) * SHADES,
      from = paintsOf(map);
    for (const row of rows) {
      const at = y0 + row.y;
      if (at < 0 || at >= h) continue;
      const first = x0 + row.x,
        begin = Math.max(0, -first),
        end = Math.min(row.shades.length, w - first),
        to = at * w + first;
      if (!spin) for (let k = begin; k < end; k++) this.pixels[to + k] = from[base + row.shades[k]];
      else
        for (let k = begin, j = 3 * begin; k < end; k++, j += 3) {
          const side = row.normal[j] * spin[0] + row.normal[j + 1] * spin[1] + row.normal[j + 2] * spin[2];
          this.pixels[to + k] = from[base + (side < 0 ? row.shades[k] >> 1 : row.shades[k])];
        }
    }
  }
}
