/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A student's own points: measured values over the slider's value, beside the theories' lines; written and read as
 * CSV. */
import { CLASS, DSMC, MD } from "./colours.js";
import { CLOSED } from "./chart.js";
import { CONTROLS, gridOf, rowOf, shownValue, symbolOf } from "./controls.js";
import { lessonOf } from "./lessons.js";
import { t } from "./i18n.js";
import { store } from "./state.js";
import { chosenTheories, error, lineOf, mean, ranked, settled } from "./theories.js";
import { workers } from "./worker_rpc.js";
import { quantityName, theoryName } from "./words.js";

export const QUANTITIES = ["temperature", "temperature_ratio", "N1", "N2", "cooling_rate", "compressibility_factor", "shear_viscosity", "collision_rate"];
const ENGINES = ["md", "dsmc"];

/* The properties that all points of a diagram share: everything but the slider and the seed. */
function familyOf({ about }, row) {
  const values = JSON.parse(JSON.stringify(about.values));
  delete values.run;
  const parts = row.key.split("."),
    last = parts.pop(),
    at = parts.reduce((inner, part) => inner[part], values);
  delete at[last];
  return JSON.stringify(values);
}

/* Is there something to keep? A mean with its error of each engine that runs: a point is a comparison. An engine that
 * has ended without one is not waited for. */
export function canKeep({ gas, means, player, quantity }) {
  if (!gas || player || !means || !means.progress) return false;
  const has = (engine) => Number.isFinite(error(settled(means, engine), quantity)),
    running = ENGINES.filter((engine) => means.progress[engine]);
  return running.some(has) && running.every((engine) => has(engine) || means.progress[engine].over);
}
export function keepPoint() {
  const { gas, means, slider } = store.state,
    row = rowOf(slider),
    point = { slider: row.name, x: shownValue(row, gas.about.values), seed: gas.about.values.run.seed, from: "" };
  for (const engine of ENGINES) {
    const part = settled(means, engine);
    point[engine] = Object.fromEntries(QUANTITIES.filter((q) => Number.isFinite(error(part, q))).map((q) => [q, [mean(part, q), error(part, q)]]));
  }
  point.family = familyOf(gas, row);
  store.dispatch("point", { points: [point] });
}

/* ---- Lines of theories over the slider: evaluated one by one, while no other call is pending ---- */

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
    let answers = {};
    try {
      answers = (await workers.evaluate.request("theory", { scene: gas.scene, sets: { ...gas.sets, [row.key]: text } })).theory;
    } catch (e) {
      /* the flow rejects this value: no theory there */
    }
    line.theory.push(Object.fromEntries(Object.entries(answers || {}).map(([name, part]) => [name, Object.fromEntries(QUANTITIES.map((q) => [q, mean(part, q)]))])));
    store.dispatch("line", { key, line: { ...line } });
  }
  working = false;
  if (wantsLines() && keyOf(store.state) !== key) drawLines();
}
function wantsLines() {
  const { gas, means, player } = store.state;
  if (!gas || player || !means || !means.evaluated || !hasPoints(store.state)) return false;
  const line = store.state.lines[keyOf(store.state)];
  return !line || line.theory.length < line.x.length;
}
/* A lesson without a quantity has no points. Between walls theories give no answer, but points are kept. */
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
    shown = points.filter((one) => one.slider === row.name && (!one.family || one.family === family)),
    mine = shown.filter((one) => !one.from);
  series.push(...ofTheClass(shown, quantity, studentsOf(points)));
  for (const [engine, colour, shape] of [
    ["md", MD, "circle"],
    ["dsmc", DSMC, "square"],
  ]) {
    const kept = measuredOf(mine, engine, quantity);
    if (kept.x.length) series.push({ name: `${engine} kept`, label: t(engine), colour, shape, ...kept });
    const part = settled(means, engine),
      m = mean(part, quantity);
    if (Number.isFinite(m))
      series.push({ name: `${engine} now`, label: t("measuredNow", { engine: t(engine) }), quiet: kept.x.length > 0, colour, points: true, shape, hollow: true, x: [shownValue(row, gas.about.values)], y: [m], error: [error(part, quantity) || 0] });
  }
  const known = series.flatMap((one) => one.x).filter(Number.isFinite);
  chart.update({
    title: t("pointsOf", { quantity: quantityName(quantity), slider: symbolOf(row) }),
    series,
    summary: t("pointsSummary", { n: shown.length, quantity: quantityName(quantity), slider: symbolOf(row) }),
    x: { label: symbolOf(row), symbol: symbolOf(row), range: [Math.min(a, ...known) - 0.02 * (b - a), Math.max(b, ...known) + 0.02 * (b - a)] },
    y: { label: t(`symbol_${quantity}`) },
  });
}

const measuredOf = (some, engine, quantity) => {
  const found = some.filter((one) => one[engine] && one[engine][quantity]);
  return { points: true, x: found.map((one) => one.x), y: found.map((one) => one[engine][quantity][0]), error: found.map((one) => one[engine][quantity][1]) };
};
/* Each student has an own mark, filled for md, hollow for dsmc; marks at one x are drawn side by side. */
function ofTheClass(points, quantity, all) {
  const names = studentsOf(points);
  return names.flatMap((from, i) =>
    ENGINES.map((engine) => ({
      name: `${engine} of ${from}`,
      label: shownName(from, all) + (engine === "md" ? "" : ` (${t(engine)})`),
      colour: CLASS[i % CLASS.length],
      shape: CLOSED[i % CLOSED.length],
      hollow: engine === "dsmc",
      quiet: engine === "dsmc",
      shift: (i - (names.length - 1) / 2) * Math.min(7, 36 / names.length),
      ...measuredOf(points.filter((one) => one.from === from), engine, quantity),
    })).filter(({ x }) => x.length),
  );
}

/* ---- Points as part of a link: a student's name, slider, quantity; then for each point its x, mean and error of
 * md, mean and error of dsmc: Ann~k3f9x2;e;cooling_rate;0.9,0.122,0.003,0.125,0.001;... The reader checks
 * everything. ---- */

const MOST = { names: 200, points: 60, name: 24 };
/* A name in any script, with marks on letters, without characters that have a meaning in tables or pages. */
export const tidyName = (text) =>
  [...text.normalize("NFC").replace(/[^\p{L}\p{M}\p{N} ._-]/gu, " ").replace(/\s+/g, " ").replace(/^[ .\p{M}-]+/u, "")].slice(0, MOST.name).join("").trimEnd();

/* The owner of points: a name and, in links, the device that made them, Ann~k3f9x2: two students may have one name. */
const tidyFrom = (text) => {
  const [, name, device] = /^(.*?)(~[0-9a-z]{1,8})?$/s.exec(text);
  return tidyName(name) && tidyName(name) + (device || "");
};
/* The displayed name: the second of a name is "Ann 2". `all`: everybody who has points. */
export function shownName(from, all) {
  const nameOf = (one) => one.split("~")[0],
    same = all.filter((one) => nameOf(one) === nameOf(from)),
    i = same.indexOf(from);
  return i > 0 ? `${nameOf(from)} ${i + 1}` : nameOf(from);
}
export const studentsOf = (points) => [...new Set(points.map((one) => one.from).filter(Boolean))];
/* The mark of this device is stored, so that a student who shares again replaces the previous points. */
const DEVICE = "graingas-device";
let device = "";
function ownDevice() {
  try {
    device ||= /^[0-9a-z]{1,8}$/.exec(localStorage.getItem(DEVICE) || "")?.[0] || "";
  } catch (e) {
    /* a browser without storage: the mark lasts for this visit */
  }
  if (device) return device;
  device = Math.floor(Math.random() * 36 ** 6).toString(36);
  try {
    localStorage.setItem(DEVICE, device);
  } catch (e) {
    /* no storage: as above */
  }
  return device;
}

export function pointsText({ points, slider, quantity }, name, from = "") {
  const short = (x, digits) => String(+x.toPrecision(digits)),
    mine = points.filter((one) => one.from === from && one.slider === slider && ENGINES.some((engine) => one[engine][quantity])).slice(0, MOST.points),
    part = (pair) => (pair ? `${short(pair[0], 5)},${short(pair[1], 2)}` : ",");
  if (!mine.length) return "";
  return [from || `${tidyName(name) || t("nobody")}~${ownDevice()}`, slider, quantity, ...mine.map((one) => [short(one.x, 5), part(one.md[quantity]), part(one.dsmc[quantity])].join(",").replace(/,+$/, ""))].join(";");
}
/* The student's own points; without any, those of all others, as on the phone that gathers them. */
export function pointsTexts(state, name) {
  const own = pointsText(state, name);
  return own ? [own] : studentsOf(state.points).map((from) => pointsText(state, from, from)).filter(Boolean);
}
/* A valid point of a link or a table: within its slider's range, and with numbers that a measurement can have. A
 * point far outside would squeeze the diagram. */
const LARGEST = 1e6;
function tidyPoint(point) {
  const row = CONTROLS.find(({ name, max }) => name === point.slider && max !== undefined),
    sane = ([m, dm]) => Math.abs(m) <= LARGEST && dm >= 0 && dm <= LARGEST,
    of = (part) => Object.fromEntries(Object.entries(part).filter(([, pair]) => sane(pair)));
  return { ...point, x: row && point.x >= row.min && point.x <= row.max ? point.x : NaN, md: of(point.md), dsmc: of(point.dsmc) };
}
const isPoint = (one) => Number.isFinite(one.x) && ENGINES.some((engine) => Object.keys(one[engine]).length);

export function pointsFrom(text) {
  const [name, slider, quantity, ...rest] = String(text).slice(0, 5000).split(";"),
    from = tidyFrom(name || "");
  if (!from || !QUANTITIES.includes(quantity) || !CONTROLS.some((row) => row.name === slider && row.max !== undefined)) return [];
  return rest
    .slice(0, MOST.points)
    .map((one) => {
      const [x, ...numbers] = one.split(",").map((part) => (part.trim() ? Number(part) : NaN)),
        pair = (at) => ({ [quantity]: [numbers[at], numbers[at + 1] >= 0 ? numbers[at + 1] : 0] });
      return tidyPoint({ slider, x, quantity, seed: "", from, md: pair(0), dsmc: pair(2) });
    })
    .filter(isPoint);
}

/* This device stores the points of links, one after another, until the user clears the diagram. */
const KEPT = "graingas-class";
const kept = () => {
  try {
    return JSON.parse(localStorage.getItem(KEPT)).filter((one) => typeof one === "string");
  } catch (e) {
    return []; /* none yet, or a browser without storage */
  }
};
function keep(texts) {
  try {
    localStorage.setItem(KEPT, JSON.stringify(texts));
  } catch (e) {
    /* no storage: they are in the diagram alone */
  }
}
export const clearKept = () => keep([]);
/* Remove one student's points, from the diagram and from this device. */
export function forgetStudent(from) {
  keep(kept().filter((one) => !pointsFrom(one).some((point) => point.from === from)));
  store.dispatch("forgetStudent", { from });
}
/* Add the points of these texts to those of before; the number of valid texts. */
export function gather(texts) {
  const good = texts.filter((one) => pointsFrom(one).length),
    head = (one) => one.split(";").slice(0, 3).join(";"),
    all = Object.values(Object.fromEntries([...kept(), ...good].map((one) => [head(one), one]))).slice(-MOST.names),
    points = all.flatMap(pointsFrom);
  if (good.length) keep(all);
  if (points.length) store.dispatch("gather", { points });
  return good.length;
}

/* ---- CSV: a row a point, a column a quantity ---- */

/* Quoted as by the library (src/io/file_writer.c): a spreadsheet would compute a text that begins like a formula. */
function csvCell(value) {
  const text = String(value),
    safe = /^[=+\-@\t\r]/.test(text) && !Number.isFinite(Number(text)) ? `'${text}` : text;
  return /[",\r\n]/.test(safe) ? `"${safe.replace(/"/g, '""')}"` : safe;
}
export function pointsCsv(points) {
  const columns = ENGINES.flatMap((engine) => QUANTITIES.filter((q) => points.some((one) => one[engine] && one[engine][q])).flatMap((q) => [`${engine}_${q}`, `${engine}_${q}_error`])),
    numberAt = (one, column) => {
      const [, engine, q, isError] = /^(md|dsmc)_(.*?)(_error)?$/.exec(column),
        found = one[engine] && one[engine][q];
      return found ? found[isError ? 1 : 0] : "";
    };
  return `${[["slider", "value", "seed", ...columns, "name"], ...points.map((one) => [one.slider, one.x, one.seed, ...columns.map((column) => numberAt(one, column)), one.from])].map((row) => row.map(csvCell).join(",")).join("\n")}\n`;
}
/* The points of a file; none if it is no such table. */
export function pointsOf(text, file) {
  const whose = tidyName(file.replace(/^graingas-points-?|\.csv$/gi, "")) || tidyName(file);
  const [head, ...rows] = text.trim().split(/\r?\n/).slice(0, 5001).map((row) => row.split(","));
  if (head[0] !== "slider" || head[1] !== "value") return [];
  return rows
    .map((row) => {
      const from = tidyFrom(row[head.indexOf("name")] || "") || whose,
        point = { slider: row[0], x: Number(row[1]), seed: /^\d{1,19}$/.test(row[2]) ? row[2] : "", from, md: {}, dsmc: {} };
      head.forEach((column, i) => {
        const found = /^(md|dsmc)_(.*?)(_error)?$/.exec(column);
        if (!found || !QUANTITIES.includes(found[2]) || row[i] === "" || row[i] === undefined) return;
        const at = (point[found[1]][found[2]] = point[found[1]][found[2]] || [NaN, 0]);
        at[found[3] ? 1 : 0] = Number(row[i]);
      });
      return tidyPoint(point);
    })
    .filter(isPoint);
}
