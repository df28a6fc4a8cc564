/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A diagram as SVG, with its legend as a list: lines, points with error bars, bands, bars. It is built once; an
 * update moves its lines. A pointer or the arrow keys read values. */
import { number, powerOfTen } from "./words.js";

const SVG = "http://www.w3.org/2000/svg";

export function make(name, attributes, ...children) {
  const made = document.createElementNS(SVG, name);
  set(made, attributes);
  made.append(...children);
  return made;
}
function set(element, attributes) {
  for (const [key, value] of Object.entries(attributes))
    if (element.getAttribute(key) !== String(value)) element.setAttribute(key, value);
}

/* The range of logarithmic axes: beyond it doubles overflow, and so do quotients of such numbers. */
export const inLog = (x) => x >= 1e-300 && x <= 1e300;

/* About five round numbers between two, or the decades and what lies between them. */
export function ticks(from, to, log) {
  const found = [];
  if (!(Number.isFinite(from) && Number.isFinite(to) && from < to && (!log || from > 0))) return found;
  if (log) {
    const many = Math.log10(to) - Math.log10(from),
      every = Math.max(1, Math.ceil(many / 6));
    for (let p = Math.ceil(Math.log10(from) - 1e-9); p <= Math.log10(to) + 1e-9; p++)
      if (p % every === 0) found.push(10 ** p);
    if (found.length > 1) return found;
    if (many < 0.7) return ticks(from, to, false);
    return [1, 2, 5]
      .flatMap((m) => [-1, 0, 1].map((k) => m * 10 ** (Math.floor(Math.log10(from)) + k + 1)))
      .filter((x) => x >= from && x <= to)
      .sort((a, b) => a - b);
  }
  const raw = (to - from) / 5,
    ten = 10 ** Math.floor(Math.log10(raw)),
    step = [1, 2, 5, 10].find((m) => m * ten >= raw) * ten,
    first = Math.ceil(from / step - 1e-9);
  for (let i = 0; i < 12 && (first + i) * step <= to + 1e-9 * step; i++) found.push((first + i) * step);
  return found;
}
export const nice = (x, digits = 3) => {
  if (x === 0) return "0";
  if (Math.abs(x) < 1e4 && Math.abs(x) >= 1e-2) return String(+x.toPrecision(digits)).replace("-", "−");
  return powerOfTen(x, digits - 2);
};
/* Labels of an axis: with as many digits as distinguish the numbers. */
export function labels(values) {
  const all = [3, 4, 5, 6, 7].map((digits) => values.map((v) => nice(v, digits)));
  return all.find((some) => new Set(some).size === values.length) || all[4];
}

export function range(values, log) {
  const good = values.filter((x) => Number.isFinite(x) && (!log || inLog(x)));
  if (!good.length) return log ? [0.1, 1] : [0, 1];
  let a = Math.min(...good),
    b = Math.max(...good);
  if (log) return a === b ? [a / 2, b * 2] : [a / 1.1, b * 1.1];
  if (a === b) {
    a -= Math.abs(a) / 2 || 1;
    b += Math.abs(b) / 2 || 1;
  }
  return [a - 0.06 * (b - a), b + 0.08 * (b - a)];
}

const LEFT = 58,
  RIGHT = 10,
  TOP = 8,
  BOTTOM = 38;
export const CLOSED = ["circle", "diamond", "up", "square", "down", "star", "hexagon"];
const SHAPES = {
  diamond: "M0,-5.5L5,0L0,5.5L-5,0z",
  up: "M0,-5L5,4H-5z",
  down: "M0,5L5,-4H-5z",
  star: "M0,-6L1.8,-1.9L5.9,-1.6L2.8,1.2L3.7,5.4L0,3.1L-3.7,5.4L-2.8,1.2L-5.9,-1.6L-1.8,-1.9z",
  hexagon: "M-5,0L-2.5,-4.4H2.5L5,0L2.5,4.4H-2.5z",
  circle: "M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0",
  square: "M-4,-4h8v8h-8z",
  cross: "M-4,-4L4,4M-4,4L4,-4",
  dash: "M-9,0h18",
  plus: "M-5,0h10M0,-5v10",
};
const isOpen = (shape) => shape === "cross" || shape === "dash" || shape === "plus";

export class Chart {
  /* `text(name, values)`: the words for a value that is read. */
  constructor(figure, text) {
    Object.assign(this, { figure, text, drawn: new Map(), keys: new Map(), series: [], at: null });
    this.caption = document.createElement("figcaption");
    this.legend = document.createElement("ul");
    Object.assign(this.legend, { className: "legend", tabIndex: 0 });
    this.readout = document.createElement("output");
    this.readout.className = "readout";
    this.svg = make("svg", { role: "img", tabindex: 0 });
    this.axes = make("g", {});
    this.inside = make("g", { "clip-path": `url(#clip-${figure.id})` });
    this.rule = make("line", { class: "rule", visibility: "hidden" });
    this.clip = make("rect", { x: LEFT, y: TOP });
    this.svg.append(make("clipPath", { id: `clip-${figure.id}` }, this.clip), this.axes, this.inside, this.rule);
    const holder = document.createElement("div");
    holder.className = "plot";
    holder.append(this.svg);
    figure.append(this.caption, holder, this.legend, this.readout);
    this.holder = holder;
    new ResizeObserver(() => this.fit()).observe(holder);
    this.listen();
  }

  fit() {
    const wide = Math.max(180, this.holder.clientWidth),
      high = Math.max(110, this.holder.clientHeight);
    if (wide === this.wide && high === this.high) return;
    Object.assign(this, { wide, high });
    set(this.svg, { viewBox: `0 0 ${wide} ${high}`, width: wide, height: high });
    set(this.clip, { width: wide - LEFT - RIGHT, height: high - TOP - BOTTOM });
    this.axesKey = null;
    if (this.spec) this.update(this.spec);
  }

  /* series: {name, label, colour, dash, width, x, y, error and shift in pixels (of points), band (of a line),
   * points, bars, shape; quiet: not in the legend; reads: false where the pointer does not read it}; x, y: {label,
   * log, range, names}. */
  update(spec) {
    this.spec = spec;
    if (!this.wide) this.fit();
    const { title, x, y, series, summary } = spec,
      all = (key) => series.flatMap((s) => Array.from(s[key] || [])),
      around = series.flatMap((s) =>
        s.error || s.band ? Array.from(s.y).flatMap((v, i) => [v - (s.error || s.band)[i], v + (s.error || s.band)[i]]) : [],
      );
    this.xr = x.range || range(all("x"), x.log);
    this.yr = y.range || range(all("y").concat(around), y.log);
    const scale = (v, [a, b], log, from, to) =>
      from + (log ? (Math.log(v) - Math.log(a)) / (Math.log(b) - Math.log(a)) : (v - a) / (b - a)) * (to - from);
    this.X = (v) => scale(v, this.xr, x.log, LEFT, this.wide - RIGHT);
    this.Y = (v) =>
      Math.min(2 * this.high, Math.max(-this.high, scale(v, this.yr, y.log, this.high - BOTTOM, TOP)));
    this.series = series;
    if (this.caption.textContent !== title) this.caption.textContent = title;
    set(this.svg, { "aria-label": summary || title });
    this.figure.dataset.scales = JSON.stringify({ xr: this.xr, yr: this.yr, xlog: !!x.log, ylog: !!y.log });
    this.drawAxes(x, y, !all("y").some(Number.isFinite));
    this.keep(this.drawn, series, (s) => make("g", { "data-name": s.name }), this.inside);
    for (const s of series) this.drawSeries(this.drawn.get(s.name), s, x.log, y.log);
    this.drawLegend(series.filter((s) => !s.quiet));
    if (this.at !== null) this.read(this.at, false);
  }

  /* One element for each series, in their order; elements of removed series are deleted. */
  keep(elements, series, make_, parent) {
    const names = new Set(series.map((s) => s.name));
    for (const [name, element] of elements)
      if (!names.has(name)) {
        element.remove();
        elements.delete(name);
      }
    series.forEach((s, i) => {
      if (!elements.has(s.name)) elements.set(s.name, make_(s));
      if (parent.children[i] !== elements.get(s.name)) parent.insertBefore(elements.get(s.name), parent.children[i] || null);
    });
  }

  /* A text instead of axes while there is no data: a scale would mean nothing. */
  drawAxes(x, y, empty) {
    const key = JSON.stringify([this.xr, this.yr, x, y, empty, this.text("waiting")]);
    if (key === this.axesKey) return;
    this.axesKey = key;
    const { wide, high, xr, yr, X, Y } = this,
      out = [],
      line = (x1, y1, x2, y2, stroke) => out.push(make("line", { x1, y1, x2, y2, stroke })),
      text = (content, attributes) => out.push(make("text", attributes, content));
    if (empty) text(this.text("waiting"), { x: (LEFT + wide - RIGHT) / 2, y: (TOP + high - BOTTOM) / 2, "text-anchor": "middle" });
    const marks = empty ? [] : ticks(...yr, y.log),
      below = x.names ? [] : ticks(...xr, x.log),
      [markLabels, belowLabels] = [marks, below].map(labels);
    for (const [i, v] of marks.entries()) {
      line(LEFT, Y(v), wide - RIGHT, Y(v), "#e4e7ea");
      text(markLabels[i], { x: LEFT - 5, y: Y(v) + 4, "text-anchor": "end" });
    }
    if (x.names) x.names.forEach((name, i) => text(name, { x: X(i), y: high - BOTTOM + 16, "text-anchor": "middle" }));
    else
      for (const [i, v] of below.entries()) {
        line(X(v), high - BOTTOM, X(v), high - BOTTOM + 4, "#50575e");
        text(belowLabels[i], { x: X(v), y: high - BOTTOM + 16, "text-anchor": "middle" });
      }
    line(LEFT, high - BOTTOM, wide - RIGHT, high - BOTTOM, "#50575e");
    line(LEFT, TOP, LEFT, high - BOTTOM, "#50575e");
    if (x.label) text(x.label, { x: (LEFT + wide - RIGHT) / 2, y: high - 5, "text-anchor": "middle" });
    const middle = (TOP + high - BOTTOM) / 2;
    if (y.label) text(y.label, { x: 11, y: middle, "text-anchor": "middle", transform: `rotate(-90 11 ${middle})` });
    this.axes.replaceChildren(...out);
  }

  drawSeries(group, s, xlog, ylog) {
    const { X, Y } = this,
      good = (i) =>
        Number.isFinite(s.x[i]) && Number.isFinite(s.y[i]) && (!xlog || inLog(s.x[i])) && (!ylog || inLog(s.y[i])),
      at = Array.from(s.x, (_, i) => i).filter(good);
    if (s.points || s.bars) {
      group.replaceChildren(...at.flatMap((i) => (s.bars ? this.bar(s, i) : this.point(s, i))));
      return;
    }
    if (!group.line) group.append((group.band = make("polygon", { opacity: 0.22 })), (group.line = make("polyline", { fill: "none" })));
    const place = (i, y) => `${X(s.x[i]).toFixed(1)},${Y(y).toFixed(1)}`;
    set(group.line, {
      points: at.map((i) => place(i, s.y[i])).join(" "),
      stroke: s.colour,
      "stroke-width": s.width || 2,
      "stroke-dasharray": s.dash || "none",
    });
    const low = (y) => (ylog ? Math.max(y, 1e-300) : y);
    set(group.band, {
      fill: s.colour,
      points: s.band
        ? at
            .map((i) => place(i, s.y[i] + s.band[i]))
            .concat(at.map((i) => place(i, low(s.y[i] - s.band[i]))).reverse())
            .join(" ")
        : "",
    });
  }
  bar(s, i) {
    const left = this.X(s.x[i] - s.bars / 2),
      top = this.Y(s.y[i]);
    return [make("rect", { x: left, y: top, width: Math.max(1, this.X(s.x[i] + s.bars / 2) - left - 1), height: Math.max(0, this.high - BOTTOM - top), fill: s.colour, opacity: 0.55 })];
  }
  point(s, i) {
    const x = this.X(s.x[i]) + (s.shift || 0),
      y = this.Y(s.y[i]),
      e = s.error && s.error[i] > 0 ? s.error[i] : 0,
      out = e ? [make("line", { x1: x, x2: x, y1: this.Y(s.y[i] - e), y2: this.Y(s.y[i] + e), stroke: s.colour, "stroke-width": 1.5 })] : [];
    out.push(mark(s, x, y));
    return out;
  }

  drawLegend(series) {
    this.keep(this.keys, series, (s) => {
      const item = document.createElement("li");
      item.append(make("svg", { viewBox: "0 0 26 10", "aria-hidden": "true" }), document.createTextNode(""));
      return item;
    }, this.legend);
    for (const s of series) {
      const item = this.keys.get(s.name),
        key = JSON.stringify([s.label, s.colour, s.dash, s.width, s.shape, s.points, s.bars, s.hollow]);
      if (item.dataset.key === key) continue;
      item.dataset.key = key;
      item.firstChild.replaceChildren(
        s.points
          ? mark(s, 13, 5)
          : make("line", { x1: 0, x2: 26, y1: 5, y2: 5, stroke: s.colour, "stroke-width": s.bars ? 8 : s.width || 2, "stroke-dasharray": s.dash || "none" }),
      );
      item.lastChild.textContent = s.label;
      if (s.title) item.title = s.title;
    }
  }

  /* ---- Reading values ---- */

  listen() {
    this.svg.addEventListener("pointermove", (e) => {
      const at = this.svg.getBoundingClientRect();
      this.read(this.valueAt(((e.clientX - at.left) * this.wide) / at.width), false);
    });
    for (const end of ["pointerleave", "blur"]) this.svg.addEventListener(end, () => this.read(null, false));
    this.svg.addEventListener("keydown", (e) => {
      const step = { ArrowLeft: -1, ArrowRight: 1, Home: -Infinity, End: Infinity }[e.key];
      if (step === undefined || !this.X) return;
      e.preventDefault();
      const all = this.places(),
        now = this.at === null ? (step > 0 ? -1 : all.length) : all.findIndex((x) => x >= this.at);
      this.read(all[Math.min(all.length - 1, Math.max(0, now + step * Math.max(1, Math.round(all.length / 40))))], true);
    });
  }
  valueAt(pixel) {
    if (!this.xr) return null;
    const [a, b] = this.xr,
      f = (pixel - LEFT) / (this.wide - LEFT - RIGHT);
    return this.spec.x.log ? a * (b / a) ** f : a + f * (b - a);
  }
  /* All x that have a value, in order. */
  places() {
    const inside = (x) => x >= this.xr[0] && x <= this.xr[1];
    return [...new Set(this.series.filter((s) => s.reads !== false).flatMap((s) => Array.from(s.x)))].filter(inside).sort((a, b) => a - b);
  }
  /* The values of all series at an x; spoken if keys were used. */
  read(x, aloud) {
    this.at = x === undefined ? null : x;
    const shown = this.at !== null && Number.isFinite(this.at) && this.X;
    set(this.rule, { visibility: shown ? "visible" : "hidden" });
    this.readout.setAttribute("aria-live", aloud ? "polite" : "off");
    if (!shown) {
      this.readout.textContent = "";
      return;
    }
    const at = this.X(this.at);
    set(this.rule, { x1: at, x2: at, y1: TOP, y2: this.high - BOTTOM });
    const readings = this.series.filter((s) => s.reads !== false).map((s) => [s, nearest(s, this.at)]).filter(([, y]) => Number.isFinite(y));
    this.readout.textContent = this.text("readout", {
      x: this.spec.x.names ? this.spec.x.names[Math.round(this.at)] || "" : `${this.spec.x.symbol || this.spec.x.label} = ${nice(+this.at.toPrecision(3))}`,
      all: readings.map(([s, y]) => `${s.label}: ${number(y)}`).join("; "),
    });
  }
}

/* The value at the point nearest to x; none beyond the ends of the series. */
function nearest(s, x) {
  let best = -1;
  for (let i = 0; i < s.x.length; i++)
    if (Number.isFinite(s.y[i]) && (best < 0 || Math.abs(s.x[i] - x) < Math.abs(s.x[best] - x))) best = i;
  if (best < 0) return NaN;
  const first = s.x[0],
    last = s.x[s.x.length - 1],
    slack = s.points ? Infinity : 0.05 * Math.abs(last - first);
  return x < first - slack || x > last + slack ? NaN : s.y[best];
}

function mark(s, x, y) {
  const open = isOpen(s.shape);
  return make("path", {
    d: SHAPES[s.shape || "circle"],
    transform: `translate(${x.toFixed(1)},${y.toFixed(1)})`,
    fill: s.hollow ? "#ffffff" : open ? "none" : s.colour,
    stroke: s.colour,
    "stroke-width": open || s.hollow ? 2 : 1,
  });
}
