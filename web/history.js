/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The history of the temperatures of the live simulation. */

import { inLog } from "./chart.js";

/* Is dsmc behind md, or did it stop earlier? Then its values are of another time. */
export const isLate = (dsmc, md) => !!dsmc && !!md && dsmc.time < md.time * (1 - 1e-9);

/* Points of the history, fewer and fewer of the older ones: bounded memory. Cooling gases have logarithmic axes. */
export class TemperatureHistory {
  constructor(logarithmic) {
    this.rows = [];
    this.gap = 0.02;
    this.logarithmic = logarithmic;
    this.far = { x: [], y: [], gap: 0.01 };
    this.errors = { md: [], dsmc: [] };
  }
  /* The standard errors of an engine's means over c collisions a grain; a row for each tenth more. */
  addError(engine, c, results) {
    const rows = this.errors[engine],
      last = rows[rows.length - 1];
    if (last && c < 1.1 * last.c) return;
    rows.push({ c, e: Object.fromEntries(Object.entries(results).map(([name, one]) => [name, one && one.stderr])) });
  }
  /* The distance of the grains from their start, or from their twins, over collisions a grain. */
  addDistance(clock, distance) {
    const { far } = this;
    if (!Number.isFinite(distance) || clock < (far.x[far.x.length - 1] ?? -1) + far.gap) return;
    far.x.push(clock);
    far.y.push(distance);
    if (far.x.length > 600) {
      far.x = far.x.filter((_, i) => i % 2 === 0);
      far.y = far.y.filter((_, i) => i % 2 === 0);
      far.gap *= 2;
    }
  }
  add(md, dsmc, twin = null) {
    const of = md || dsmc,
      last = this.rows[this.rows.length - 1];
    if (this.logarithmic && !(inLog(of.time) && inLog(of.temperature))) return;
    if (last && (this.logarithmic ? of.time < 1.03 * last.time : of.collisionsPerGrain < last.clock + this.gap)) return;
    const pick = (s) => (s ? [s.temperature, s.rotationalTemperature] : [NaN, NaN]),
      [T, theta] = pick(md),
      [T2, theta2] = pick(isLate(dsmc, md) ? null : dsmc),
      [T3] = pick(isLate(twin, md) ? null : twin);
    this.rows.push({ clock: of.collisionsPerGrain, time: of.time, T, theta, T2, theta2, T3 });
    if (this.rows.length > 480) {
      this.rows = this.rows.filter((_, i) => i % 2 === 0);
      this.gap *= 2;
    }
  }
  column(name) {
    return this.rows.map((row) => row[name]);
  }
  get key() {
    return this.logarithmic ? "time" : "clock";
  }
  course(name) {
    return { x: this.column(this.key), y: this.column(name) };
  }
}

/* The history of a stored result, over time; a line marks the frame that is played. */
export class StoredHistory {
  constructor(logarithmic, courses = {}) {
    this.logarithmic = logarithmic;
    this.courses = courses;
    this.key = "time";
    this.now = 0;
  }
  course(name) {
    const of = this.courses[name.endsWith("2") ? "dsmc" : "md"],
      one = of && of[name.replace("2", "")];
    return one ? { x: one.time, y: one.value } : { x: [], y: [] };
  }
}
