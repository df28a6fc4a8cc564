/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Between walls: velocity, temperature and solid fraction across the gap, beside the box and on its own height. */
import { make, nice, range, ticks } from "./chart.js";
import { DSMC, MD } from "./colours.js";
import { t } from "./i18n.js";

const SHOWN = [
  ["profile_velocity", "u", MD],
  ["profile_temperature", "T", DSMC],
  ["profile_solid_fraction", "φ", "#00785a"],
];
const WIDE = 60,
  GAP = 6,
  FOOT = 34;

/* `heights`: where on the screen the floor and the lid of the box are, of so high a canvas. */
export function showProfiles(place, means, [low, top], high) {
  const curves = (means && means.md && means.md.curves) || {};
  const svg = make("svg", { width: SHOWN.length * (WIDE + GAP), height: high, role: "img", "aria-label": t("profiles") });
  SHOWN.forEach(([name, symbol, colour], i) => {
    const left = i * (WIDE + GAP) + 4,
      group = make("g", {});
    group.append(
      make("rect", { x: left, y: top, width: WIDE, height: Math.max(1, low - top), fill: "#f6f8fa", stroke: "#c8ccd0" }),
      make("text", { x: left + WIDE / 2, y: low + 30, "text-anchor": "middle", "font-style": "italic" }, symbol),
    );
    if (curves[name]) group.append(...profile(curves[name], left, low, top, colour));
    else if (i === 1) group.append(make("text", { x: left + WIDE / 2, y: (low + top) / 2, "text-anchor": "middle" }, t("waiting")));
    svg.append(group);
  });
  svg.setAttribute("height", Math.max(high, low + FOOT));
  place.replaceChildren(svg);
}

function profile({ x: y, value, stderr }, left, low, top, colour) {
  const good = y.map((_, i) => i).filter((i) => Number.isFinite(value[i])),
    errors = good.map((i) => stderr[i] || 0),
    all = good.flatMap((i, k) => [value[i] - errors[k], value[i] + errors[k]]),
    [a, b] = range(Math.min(...all) >= 0 ? [0, ...all] : all, false),
    step = y.length > 1 ? y[1] - y[0] : 1,
    [from, to] = [y[0] - step / 2, y[y.length - 1] + step / 2];
  const X = (v) => (left + ((v - a) / (b - a)) * WIDE).toFixed(1),
    Y = (v) => (low + ((v - from) / (to - from)) * (top - low)).toFixed(1);
  const out = [make("polyline", { points: good.map((i) => `${X(value[i])},${Y(y[i])}`).join(" "), fill: "none", stroke: colour, "stroke-width": 2 })];
  good.forEach((i, k) => {
    if (errors[k] > 0) out.push(make("line", { x1: X(value[i] - errors[k]), x2: X(value[i] + errors[k]), y1: Y(y[i]), y2: Y(y[i]), stroke: colour, opacity: 0.5 }));
  });
  const [first, ...rest] = ticks(a, b, false),
    last = rest[rest.length - 1];
  for (const v of [first, last])
    if (v !== undefined)
      out.push(make("text", { x: Math.min(left + WIDE - 8, Math.max(left + 8, X(v))), y: low + 14, "text-anchor": "middle", class: "small" }, nice(v)));
  return out;
}
