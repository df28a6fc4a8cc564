/* A diagram as SVG, with its legend as a list: lines, points with error bars, bands. */
const SVG = "http://www.w3.org/2000/svg";

function make(name, attributes, ...children) {
  const made = document.createElementNS(SVG, name);
  for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
  made.append(...children);
  return made;
}

/* What logarithmic axes show: beyond it doubles end, and quotients of such numbers too. */
const inLog = (x) => x >= 1e-300 && x <= 1e300;

/* About five round numbers between two, or the decades and what lies between them. */
function ticks(from, to, log) {
  const found = [];
  if (!(Number.isFinite(from) && Number.isFinite(to) && from < to && (!log || from > 0))) return found;
  if (log) {
    const many = Math.log10(to) - Math.log10(from),
      every = Math.max(1, Math.ceil(many / 6));
    for (let p = Math.ceil(Math.log10(from) - 1e-9); p <= Math.log10(to) + 1e-9; p++)
      if (p % every === 0) found.push(10 ** p);
    if (found.length > 1) return found;
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
const nice = (x) =>
  x === 0
    ? "0"
    : Math.abs(x) >= 1e4 || Math.abs(x) < 1e-2
      ? x.toExponential(0).replace("e+", "e")
      : String(+x.toPrecision(3));

function range(values, log) {
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

const WIDE = 560,
  HIGH = 250,
  LEFT = 58,
  RIGHT = 12,
  TOP = 10,
  BOTTOM = 40;

/* series: {label, colour, dash, x, y, error (points), band (of a line), points (true), shape, from legend hidden (quiet)} */
function plot(figure, { title, x, y, series, summary }) {
  const all = (key) => series.flatMap((s) => Array.from(s[key] || []));
  const around = series.flatMap((s) =>
    s.error || s.band ? s.y.flatMap((v, i) => [v - (s.error || s.band)[i], v + (s.error || s.band)[i]]) : [],
  );
  const xr = x.range || range(all("x"), x.log),
    yr = y.range || range(all("y").concat(around), y.log);
  const scale = (v, [a, b], log, from, to) =>
    from + (log ? (Math.log(v) - Math.log(a)) / (Math.log(b) - Math.log(a)) : (v - a) / (b - a)) * (to - from);
  const X = (v) => scale(v, xr, x.log, LEFT, WIDE - RIGHT),
    Y = (v) => Math.min(2 * HIGH, Math.max(-HIGH, scale(v, yr, y.log, HIGH - BOTTOM, TOP)));
  const svg = make("svg", { viewBox: `0 0 ${WIDE} ${HIGH}`, role: "img", "aria-label": summary || title });
  const clip = `clip-${figure.id}`;
  svg.append(
    make(
      "clipPath",
      { id: clip },
      make("rect", { x: LEFT, y: TOP, width: WIDE - LEFT - RIGHT, height: HIGH - TOP - BOTTOM }),
    ),
  );
  axes(svg, X, Y, xr, yr, x, y);
  const inside = make("g", { "clip-path": `url(#${clip})` });
  for (const s of series) inside.append(...drawn(s, X, Y, x.log, y.log));
  svg.append(inside);
  const caption = document.createElement("figcaption");
  caption.textContent = title;
  figure.replaceChildren(caption, svg, legend(series));
  figure.dataset.scales = JSON.stringify({ xr, yr, xlog: !!x.log, ylog: !!y.log });
}

function axes(svg, X, Y, xr, yr, x, y) {
  const line = (x1, y1, x2, y2, stroke) => svg.append(make("line", { x1, y1, x2, y2, stroke }));
  const text = (content, attributes) => svg.append(make("text", attributes, content));
  for (const v of ticks(...yr, y.log)) {
    line(LEFT, Y(v), WIDE - RIGHT, Y(v), "#e4e7ea");
    text(nice(v), { x: LEFT - 6, y: Y(v) + 4, "text-anchor": "end" });
  }
  if (x.names) x.names.forEach((name, i) => text(name, { x: X(i), y: HIGH - BOTTOM + 16, "text-anchor": "middle" }));
  else
    for (const v of ticks(...xr, x.log)) {
      line(X(v), HIGH - BOTTOM, X(v), HIGH - BOTTOM + 4, "#50575e");
      text(nice(v), { x: X(v), y: HIGH - BOTTOM + 16, "text-anchor": "middle" });
    }
  line(LEFT, HIGH - BOTTOM, WIDE - RIGHT, HIGH - BOTTOM, "#50575e");
  line(LEFT, TOP, LEFT, HIGH - BOTTOM, "#50575e");
  if (x.label) text(x.label, { x: (LEFT + WIDE - RIGHT) / 2, y: HIGH - 6, "text-anchor": "middle" });
  if (y.label)
    text(y.label, {
      x: 12,
      y: (TOP + HIGH - BOTTOM) / 2,
      "text-anchor": "middle",
      transform: `rotate(-90 12 ${(TOP + HIGH - BOTTOM) / 2})`,
    });
}

function drawn(s, X, Y, xlog, ylog) {
  const good = (i) =>
    Number.isFinite(s.x[i]) && Number.isFinite(s.y[i]) && (!xlog || inLog(s.x[i])) && (!ylog || inLog(s.y[i]));
  const at = Array.from(s.x, (_, i) => i).filter(good),
    out = [];
  if (s.band && at.length) {
    const up = at.map((i) => `${X(s.x[i]).toFixed(1)},${Y(s.y[i] + s.band[i]).toFixed(1)}`);
    const down = at
      .map(
        (i) =>
          `${X(s.x[i]).toFixed(1)},${Y(ylog ? Math.max(s.y[i] - s.band[i], 1e-300) : s.y[i] - s.band[i]).toFixed(1)}`,
      )
      .reverse();
    out.push(make("polygon", { points: up.concat(down).join(" "), fill: s.colour, opacity: 0.25 }));
  }
  if (s.points)
    for (const i of at)
      out.push(
        ...point(
          s,
          X(s.x[i]),
          Y(s.y[i]),
          s.error && s.error[i] > 0 ? [Y(s.y[i] - s.error[i]), Y(s.y[i] + s.error[i])] : null,
        ),
      );
  else
    out.push(
      make("polyline", {
        points: at.map((i) => `${X(s.x[i]).toFixed(1)},${Y(s.y[i]).toFixed(1)}`).join(" "),
        fill: "none",
        stroke: s.colour,
        "stroke-width": s.width || 2,
        "stroke-dasharray": s.dash || "none",
        "data-name": s.name || s.label,
      }),
    );
  return out;
}

const SHAPES = {
  circle: "M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0",
  square: "M-4,-4h8v8h-8z",
  cross: "M-4,-4L4,4M-4,4L4,-4",
  dash: "M-9,0h18",
  plus: "M-5,0h10M0,-5v10",
};
function point(s, x, y, bar) {
  const out = [],
    open = s.shape === "cross" || s.shape === "dash" || s.shape === "plus";
  if (bar) out.push(make("line", { x1: x, x2: x, y1: bar[0], y2: bar[1], stroke: s.colour, "stroke-width": 1.5 }));
  out.push(
    make("path", {
      d: SHAPES[s.shape || "circle"],
      transform: `translate(${x.toFixed(1)},${y.toFixed(1)})`,
      fill: open ? "none" : s.colour,
      stroke: s.colour,
      "stroke-width": open ? 2 : 1,
      "data-name": s.name || s.label,
    }),
  );
  return out;
}

function legend(series) {
  const list = document.createElement("ul");
  list.className = "legend";
  for (const s of series) {
    if (s.quiet) continue;
    const item = document.createElement("li"),
      key = make("svg", { viewBox: "0 0 26 10", "aria-hidden": "true" });
    if (s.points) key.append(...point(s, 13, 5, null));
    else
      key.append(
        make("line", {
          x1: 0,
          x2: 26,
          y1: 5,
          y2: 5,
          stroke: s.colour,
          "stroke-width": s.width || 2,
          "stroke-dasharray": s.dash || "none",
        }),
      );
    item.append(key, s.label);
    if (s.title) item.title = s.title;
    list.append(item);
  }
  return list;
}
