/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A student's own points: what was measured, over the slider's value, beside the theories' lines; as CSV, and from it. */
import { DSMC, MD } from "./colours.js";
import { gridOf, rowOf, shownValue, symbolOf } from "./controls.js";
import { workers } from "./gas.js";
import { lessonOf } from "./lessons.js";
import { t } from "./i18n.js";
import { store } from "./state.js";
import { chosenTheories, error, lineOf, mean, ranked } from "./theories.js";
import { quantityName, theoryName } from "./words.js";

export const QUANTITIES = ["temperature", "temperature_ratio", "N1", "N2", "cooling_rate", "compressibility_factor", "shear_viscosity", "collision_rate"];
const ENGINES = ["md", "dsmc"];

/* What of a gas is the same for all its points: everything but the slider and the seed. */
function familyOf({ about }, row) {
  const values = JSON.parse(JSON.stringify(about.values));
  delete values.run;
  const parts = row.key.split("."),
    last = parts.pop(),
    at = parts.reduce((inner, part) => inner[part], values);
  delete at[last];
  return JSON.stringify(values);
}

/* Whether there is something to keep: means with errors. */
export function canKeep({ gas, means, player, quantity }) {
  return !!gas && !player && !!means && ENGINES.some((engine) => Number.isFinite(error(means[engine] && means[engine].results, quantity)));
}
export function keepPoint() {
  const { gas, means, slider } = store.state,
    row = rowOf(slider),
    point = { slider: row.name, x: shownValue(row, gas.about.values), seed: gas.about.values.run.seed, from: "" };
  for (const engine of ENGINES) {
    const part = means[engine] && means[engine].results;
    point[engine] = Object.fromEntries(QUANTITIES.filter((q) => Number.isFinite(error(part, q))).map((q) => [q, [mean(part, q), error(part, q)]]));
  }
  point.family = familyOf(gas, row);
  store.dispatch("point", { points: [point] });
}

/* ---- The lines of theories over the slider: evaluated one by one, where nothing else waits ---- */

const keyOf = ({ gas, slider }) => `${slider} ${familyOf(gas, rowOf(slider))}`;
let working = false;
export async function drawLines() {
  if (working || !wantsLines()) return;
  working = true;
  const key = keyOf(store.state),
    { gas, slider } = store.state,
    row = rowOf(slider),
    x = gridOf(row),
    line = store.state.lines[key] || { x, theory: [] };
  while (line.theory.length < x.length && wantsLines() && keyOf(store.state) === key) {
    const value = x[line.theory.length],
      text = row.put ? row.put(value, gas.about.values) : String(+value.toPrecision(6));
    let said = {};
    try {
      said = (await workers.measure.ask("theory", { scene: gas.scene, sets: { ...gas.sets, [row.key]: text } })).theory;
    } catch (e) {
      /* a value that the flow refuses: no theory there */
    }
    line.theory.push(Object.fromEntries(Object.entries(said || {}).map(([name, part]) => [name, Object.fromEntries(QUANTITIES.map((q) => [q, mean(part, q)]))])));
    store.dispatch("line", { key, line: { ...line } });
  }
  working = false;
  if (wantsLines() && keyOf(store.state) !== key) drawLines();
}
function wantsLines() {
  const { gas, means, player } = store.state;
  if (!gas || player || !means || !hasPoints(store.state)) return false;
  const line = store.state.lines[keyOf(store.state)];
  return !line || line.theory.length < line.x.length;
}
/* A lesson without a quantity has no points; between walls the theories say nothing, but points are kept. */
export const hasPoints = ({ chart, player, lesson }) =>
  !player && !["speeds", "distance"].includes(chart) && (!lesson || !!lessonOf(lesson).quantity);

export function showPoints(chart, state) {
  const { gas, means, quantity, points } = state,
    row = rowOf(state.slider),
    [a, b] = row.wide || [row.min, row.max],
    series = [];
  const line = state.lines[keyOf(state)];
  if (line) {
    const with_ = ranked([...new Set(line.theory.flatMap((one) => Object.keys(one).filter((name) => Number.isFinite(one[name][quantity]))))]);
    for (const name of chosenTheories(with_))
      series.push({ name, label: theoryName(name), ...lineOf(name), width: 1.6, x: line.x.slice(0, line.theory.length), y: line.theory.map((one) => (one[name] ? one[name][quantity] : NaN)) });
  }
  const family = familyOf(gas, row),
    mine = points.filter((one) => one.slider === row.name && (!one.family || one.family === family));
  for (const [engine, colour, shape] of [
    ["md", MD, "circle"],
    ["dsmc", DSMC, "square"],
  ]) {
    const kept = mine.filter((one) => one[engine] && one[engine][quantity]),
      add = (name, some, more) => some.length && series.push({ name, label: t(engine), colour, points: true, shape, ...more, x: some.map((one) => one.x), y: some.map((one) => one[engine][quantity][0]), error: some.map((one) => one[engine][quantity][1]) });
    add(`${engine} class`, kept.filter((one) => one.from), { shape: "plus", label: t("classPoints", { engine: t(engine) }) });
    add(`${engine} kept`, kept.filter((one) => !one.from), {});
    const part = means && means[engine] && means[engine].results,
      m = mean(part, quantity);
    if (Number.isFinite(m))
      series.push({ name: `${engine} now`, label: t("measuredNow", { engine: t(engine) }), quiet: true, colour, points: true, shape, hollow: true, x: [shownValue(row, gas.about.values)], y: [m], error: [error(part, quantity) || 0] });
  }
  const known = series.flatMap((one) => one.x).filter(Number.isFinite);
  chart.update({
    title: t("pointsOf", { quantity: quantityName(quantity), slider: symbolOf(row) }),
    series,
    summary: t("pointsSummary", { n: mine.length, quantity: quantityName(quantity), slider: symbolOf(row) }),
    x: { label: symbolOf(row), symbol: symbolOf(row), range: [Math.min(a, ...known) - 0.02 * (b - a), Math.max(b, ...known) + 0.02 * (b - a)] },
    y: { label: t(`symbol_${quantity}`) },
  });
}

/* ---- CSV: a row a point, a column a quantity ---- */

export function pointsCsv(points) {
  const columns = ENGINES.flatMap((engine) => QUANTITIES.filter((q) => points.some((one) => one[engine] && one[engine][q])).flatMap((q) => [`${engine}_${q}`, `${engine}_${q}_error`])),
    numberAt = (one, column) => {
      const [, engine, q, isError] = /^(md|dsmc)_(.*?)(_error)?$/.exec(column),
        found = one[engine] && one[engine][q];
      return found ? found[isError ? 1 : 0] : "";
    };
  return `${[["slider", "value", "seed", ...columns], ...points.map((one) => [one.slider, one.x, one.seed, ...columns.map((column) => numberAt(one, column))])].map((row) => row.join(",")).join("\n")}\n`;
}
/* Those of a file; none if it is no such table. */
export function pointsOf(text, from) {
  const [head, ...rows] = text.trim().split(/\r?\n/).slice(0, 5001).map((row) => row.split(","));
  if (head[0] !== "slider" || head[1] !== "value") return [];
  return rows
    .map((row) => {
      const point = { slider: row[0], x: Number(row[1]), seed: row[2], from, md: {}, dsmc: {} };
      head.forEach((column, i) => {
        const found = /^(md|dsmc)_(.*?)(_error)?$/.exec(column);
        if (!found || !QUANTITIES.includes(found[2]) || row[i] === "" || row[i] === undefined) return;
        const at = (point[found[1]][found[2]] = point[found[1]][found[2]] || [NaN, 0]);
        at[found[3] ? 1 : 0] = Number(row[i]);
      });
      return point;
    })
    .filter((one) => Number.isFinite(one.x));
}
