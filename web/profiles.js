/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between walls: velocity, temperature and solid fraction across the gap, beside the box and on its own height. */
import { make, nice, range, ticks } from "./chart.js";
import { DSMC, MD } from "./colours.js";
import { t } from "./i18n.js";

const SHOWN = [
  ["profile_velocity", "u"],
  ["profile_temperature", "T"],
  ["profile_solid_fraction", "φ"],
];
const WIDE = 60,
  GAP = 6,
  FOOT = 34;

/* `heights`: where the floor and the lid of the box are on the screen, on a canvas of this height. */
export function showProfiles(place, means, [low, top], high) {
  const [grains, dice] = ["md", "dsmc"].map((engine) => (means && means[engine] && means[engine].curves) || {});
  const svg = make("svg", { width: SHOWN.length * (WIDE + GAP), height: high, role: "img", "aria-label": t("profiles") });
  SHOWN.forEach(([name, symbol], i) => {
    const left = i * (WIDE + GAP) + 4,
      group = make("g", {});
    group.append(
      make("rect", { x: left, y: top, width: WIDE, height: Math.max(1, low - top), fill: "#f6f8fa", stroke: "#c8ccd0" }),
      make("text", { x: left + WIDE / 2, y: low + 30, "text-anchor": "middle", "font-style": "italic" }, symbol),
    );
    if (grains[name] || dice[name]) group.append(...profile([grains[name], dice[name]], left, low, top));
    else if (i === 1) group.append(make("text", { x: left + WIDE / 2, y: (low + top) / 2, "text-anchor": "middle" }, t("waiting")));
    svg.append(group);
  });
  svg.setAttribute("height", Math.max(high, low + FOOT));
  place.replaceChildren(svg);
}

/* A line with its errors for md, marks for dsmc, in the colours of the engines. */
function profile(both, left, low, top) {
  const [grains, dice] = both.map((curve) => (curve ? curve.x.map((y, i) => ({ y, v: curve.value[i], e: curve.stderr[i] || 0 })).filter(({ v }) => Number.isFinite(v)) : [])),
    all = [...grains, ...dice].flatMap(({ v, e }) => [v - e, v + e]),
    [a, b] = range(Math.min(...[...grains, ...dice].map(({ v }) => v)) >= 0 ? [0, ...all.filter((v) => v > 0)] : all, false),
    { x: y } = both.find(Boolean),
    step = y.length > 1 ? y[1] - y[0] : 1,
    [from, to] = [y[0] - step / 2, y[y.length - 1] + step / 2];
  const X = (v) => (left + ((v - a) / (b - a)) * WIDE).toFixed(1),
    Y = (v) => (low + ((v - from) / (to - from)) * (top - low)).toFixed(1);
  const out = [make("polyline", { points: grains.map(({ y: at, v }) => `${X(v)},${Y(at)}`).join(" "), fill: "none", stroke: MD, "stroke-width": 2 })];
  for (const { y: at, v, e } of grains) if (e > 0) out.push(make("line", { x1: X(v - e), x2: X(v + e), y1: Y(at), y2: Y(at), stroke: MD, opacity: 0.5 }));
  for (const { y: at, v } of dice) out.push(make("circle", { cx: X(v), cy: Y(at), r: 2, fill: "#fff", stroke: DSMC }));
  const [first, ...rest] = ticks(a, b, false),
    last = rest[rest.length - 1];
  for (const [v, anchor] of [
    [first, "start"],
    [last, "end"],
  ])
    if (v !== undefined) out.push(make("text", { x: anchor === "end" ? left + WIDE : left, y: low + 14, "text-anchor": anchor, class: "small" }, nice(v)));
  return out;
}
