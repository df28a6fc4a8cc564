/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The diagram beside the box: the history of the live gas, the means so far, the lines of theories. */
import { inLog } from "./chart.js";
import { DSMC, GHOSTS, MD } from "./colours.js";
import { isWalled, sheared } from "./flows.js";
import { now } from "./gas.js";
import { t } from "./i18n.js";
import { store } from "./state.js";
import { chosenTheories, error, lineOf, mean, settled, theoriesWith, titleOf } from "./theories.js";
import { withError, number, quantityName, theoryName } from "./words.js";

export const CHARTS = ["temperature", "speeds", "velocities", "stress", "distance", "profiles", "errors"];
const hasRate = (values) => sheared(values) || values.flow === "couette";
export const timeUnit = (values) => (hasRate(values) ? "1/γ" : values.phi === 0 ? "1/(n d² v₀)" : "d/v₀");
/* Without excluded volume the mean free path takes the place of d. */
export const speedUnit = (values) => (!hasRate(values) ? "v₀" : values.phi === 0 ? "γ/(n d²)" : "d γ");
export const temperatureUnit = (values) => (!hasRate(values) ? "v₀²" : values.phi === 0 ? "(γ/(n d²))²" : "d² γ²");

export const spinUnit = (values) => (hasRate(values) ? "γ" : "v₀/d");

const MARKS = ["cross", "plus", "dash"];

export function showChart(chart, state) {
  const kinds = { temperature, speeds, velocities, stress, distance, profiles, errors };
  chart.update(kinds[state.chart](state));
}

/* Curves of earlier runs, the newest first. */
const ghosts = (state, log) =>
  state.ghosts
    .filter((one) => one.chart === state.chart)
    .map((one, i) => ({ name: `ghost ${one.label}`, label: one.label, x: one.x, y: one.y, colour: GHOSTS[i], width: 1.5, log }));

function temperature(state) {
  const { gas, means, shelf } = state,
    { values } = gas.about,
    { history } = gas,
    cooling = values.flow === "hcs",
    rough = values.collision.beta > -1 || values.collision.mu !== "inf" || history.course("theta").y.some((y) => y > 0);
  const line = (name, label, colour, dash) => ({ ...history.course(name), name, label, colour, dash });
  const drawn = [line("T", `${t("md")}: T`, MD), line("T2", `${t("dsmc")}: T`, DSMC), line("T3", `${t("twin")}: T`, "#444444")];
  if (rough) drawn.push(line("theta", `${t("md")}: θ`, MD, "4 3"), line("theta2", `${t("dsmc")}: θ`, DSMC, "4 3"));
  const series = [...ghosts(state, cooling), ...drawn.filter((one) => one.y.some(Number.isFinite))],
    x = series.flatMap((one) => one.x).sort((a, b) => a - b);
  if (means && means.theory && x.length) series.push(...(cooling ? coolingLines(means, x) : steadyLines(means, x, rough, values)));
  if (cooling && x.length) series.push(...slopeLine(series.find((one) => one.name === "T") || series[0]));
  if (history.now > 0) series.push(nowLine(history.now, series));
  const time = history.key === "time",
    unit = temperatureUnit(values);
  return {
    title: t(rough ? "temperature" : "temperatureOnly"),
    series,
    summary: shelf ? t("temperature") : summaryOf(state, "temperature"),
    x: { label: time ? t("time", { unit: timeUnit(values) }) : t("collisionsAGrain"), symbol: time ? "t" : t("collisionsAGrain"), log: cooling },
    y: { label: `T (${unit})`, log: cooling, range: cooling ? null : [0, 1.12 * highest(series)] },
  };
}
/* A line of slope -2 on logarithmic axes: above the end of a curve that has fallen to a fifth of its start, and up
 * to that height. */
const ABOVE = 2;
function slopeLine({ x, y }) {
  const end = x.length - 1,
    from = x[end] * Math.sqrt((ABOVE * y[end]) / y[0]);
  if (!(y[end] < 0.2 * y[0]) || !inLog(from)) return [];
  return [{ name: "slope", label: t("slope"), colour: "#777777", width: 1.2, reads: false, x: [from, x[end]], y: [y[0], ABOVE * y[end]] }];
}
/* A vertical line at the frame that is played. */
function nowLine(at, series) {
  const good = series.flatMap((s) => Array.from(s.y)).filter(inLog),
    y = good.length ? [Math.min(...good), Math.max(...good)] : [0, 1];
  return { x: [at, at], y, colour: "#222222", dash: "2 3", width: 1.5, label: t("playedNow"), name: "now", reads: false };
}
function highest(series) {
  const all = series.flatMap((s) => Array.from(s.y)).filter(Number.isFinite);
  return all.length ? Math.max(...all) || 1 : 1;
}

/* A steady flow: means with their errors as bands, theories as lines across. Between walls no mean is drawn: it is
 * that of the steady flow, which this gas has not reached yet. */
function steadyLines(means, x, rough, values) {
  const across = [x[0], Math.max(x[x.length - 1], x[0] + 0.1)],
    out = [],
    both = rough ? ["temperature", "rotational_temperature"] : ["temperature"];
  if (isWalled(values)) return out;
  for (const [engine, colour] of [
    ["md", MD],
    ["dsmc", DSMC],
  ])
    for (const name of both) {
      const part = settled(means, engine),
        m = mean(part, name),
        e = error(part, name) || 0;
      if (Number.isFinite(m)) out.push({ x: across, y: [m, m], band: [e, e], colour, width: 1, name: `mean ${engine} ${name}`, label: t("meanOf", { name: t(engine) }), quiet: true });
    }
  for (const name of chosenTheories(theoriesWith(means, ["temperature"])))
    for (const q of both) {
      const m = mean(means.theory[name], q);
      if (Number.isFinite(m)) out.push({ x: across, y: [m, m], ...lineOf(name), width: 1.6, label: titleOf(means, name), title: means.theories[name].title, quiet: q !== "temperature", name: `${name} ${q}` });
    }
  return out;
}

/* The part of a line between two x, on logarithmic axes, with an interpolated end. */
function pieceOf(x, y, from, to) {
  const end = x.findIndex((one) => one > to),
    inside = x.map((_, i) => i).filter((i) => x[i] >= from && x[i] <= to),
    piece = { x: inside.map((i) => x[i]), y: inside.map((i) => y[i]) };
  if (end < 1 || !(y[end] > 0)) return piece;
  const part = Math.log(to / x[end - 1]) / Math.log(x[end] / x[end - 1]);
  piece.x.push(to);
  piece.y.push(y[end - 1] * (y[end] / y[end - 1]) ** part);
  return piece;
}

/* Theories of free cooling, each with its own rate, up to the present time of the gas; equal lines are drawn once. */
export function coolingLines(means, x) {
  const { time, T } = means.cooling,
    shown = x.filter(inLog),
    drawn = store.state.theories ? chosenTheories(Object.keys(T)) : ["haff1983"].filter((name) => T[name]);
  return (drawn.length ? drawn : chosenTheories(Object.keys(T)).slice(0, 1)).map((name) => ({
    ...pieceOf(time, T[name], shown[0] / 1.3, shown[shown.length - 1] * 1.3),
    ...lineOf(name),
    width: 1.6,
    label: titleOf(means, name),
    title: means.theories[name].title,
    name: `${name} temperature`,
  }));
}

/* Speeds of the grains at this moment, beside Maxwell's distribution of the same T. */
function speeds({ gas }) {
  const { frame } = now,
    found = frame && frame.speeds,
    series = [];
  if (found) {
    const { end, density } = found,
      wide = end / density.length,
      T = frame.md.temperature,
      x = Array.from({ length: 81 }, (_, i) => (i * end) / 80),
      norm = Math.sqrt(2 / Math.PI) / T ** 1.5;
    series.push({ name: "speeds", label: t("grainsNow"), colour: MD, bars: wide, x: density.map((_, i) => (i + 0.5) * wide), y: density });
    if (T > 0) series.push({ name: "maxwell", label: t("maxwell"), colour: "#222222", dash: "6 4", x, y: x.map((v) => norm * v * v * Math.exp((-v * v) / (2 * T))) });
  }
  const fast = gas.about.fast || 1;
  return {
    title: t("speeds"),
    series,
    summary: t("speeds"),
    x: { label: t("speedAxis", { unit: speedUnit(gas.about.values) }), symbol: "v", range: [0, 2.5 * fast] },
    y: { label: t("shareAxis"), range: [0, 1.3 * Math.max(highest(series.slice(-1)), 0.8 / fast)] },
  };
}

function velocities({ means }) {
  const series = [],
    /* Cx and Cy; in mixtures those of each species */
    curves = (engine) =>
      Object.entries((means && means[engine] && means[engine].curves) || {})
        .map(([name, c]) => [c, /^velocity_distribution_(C([xy])(?:_(\d+))?)$/.exec(name)])
        .filter(([, found]) => found);
  let gauss = null;
  for (const [engine, colour] of [
    ["md", MD],
    ["dsmc", DSMC],
  ])
    for (const [c, [, which, axis, species]] of curves(engine)) {
      const numbers = (list) => list.map((v) => (v === null ? NaN : v));
      series.push({
        x: c.x,
        y: numbers(c.value),
        band: numbers(c.stderr).map((v) => v || 0),
        colour,
        dash: axis === "x" ? "" : "4 3",
        width: species > 1 ? 1 : 2,
        label: `${t(engine)}: ${c.label.replace(/[_{}]/g, "")}`,
        name: `velocities ${engine} ${which}`,
      });
      if (!gauss && c.reference) gauss = { x: c.x, y: c.reference.value, colour: "#222222", dash: "1 3", width: 2, label: t("gaussian"), name: "gaussian" };
    }
  if (gauss) series.push(gauss);
  return {
    title: t("velocities"),
    series,
    summary: t("velocities"),
    x: { label: t("velocityAxis"), symbol: "C", range: [-5, 5] },
    y: { label: "P / P(0)", log: true, range: [1e-4, 2] },
  };
}

/* The three pressures along x, y and z over their mean: now and as means. */
function stress({ means }) {
  const series = [],
    names = ["P_xx", "P_yy", "P_zz"],
    add = (part, at, rest) => {
      const p = mean(part, "pressure");
      if (Number.isFinite(mean(part, "P_xx")) && p > 0)
        series.push({ x: names.map((_, i) => i + at), y: names.map((name) => mean(part, name) / p), error: names.map((name) => error(part, name) / p || 0), points: true, ...rest });
    };
  if (means && means.theory) {
    const chosen = chosenTheories(theoriesWith(means, ["P_xx"]));
    chosen.forEach((name, i) =>
      add(means.theory[name], (0.36 * (i + 0.5)) / chosen.length - 0.18, { name, colour: lineOf(name).colour, shape: MARKS[i % MARKS.length], label: titleOf(means, name) }),
    );
    add(settled(means, "md"), -0.26, { name: "md", colour: MD, shape: "circle", label: t("md") });
    add(settled(means, "dsmc"), 0.26, { name: "dsmc", colour: DSMC, shape: "square", label: t("dsmc") });
  }
  const { frame } = now,
    s = frame && frame.md && frame.md.kineticStress;
  if (s && s.length === 3) {
    const p = (s[0][0] + s[1][1] + s[2][2]) / 3;
    if (p > 0) series.unshift({ name: "now", label: t("stressNow"), colour: "#9fc3dd", bars: 0.8, x: [0, 1, 2], y: [0, 1, 2].map((a) => s[a][a] / p) });
  }
  const all = series.flatMap((one) => one.y).filter(Number.isFinite);
  return {
    title: t("stress"),
    series,
    summary: means ? `${summaryOf({ means }, "N1")}. ${summaryOf({ means }, "N2")}` : t("stress"),
    x: { names: [t("alongX"), t("alongY"), t("alongZ")], range: [-0.5, 2.5] },
    y: { label: t("pressureAxis"), range: [0, Math.max(1.5, 1.1 * Math.max(0, ...all))] },
  };
}

/* The distance of the grains from their start, or from their twins, over decades. */
function distance(state) {
  const { x, y } = state.gas.history.far || { x: [], y: [] },
    twin = state.pair === "bit";
  return {
    title: t(twin ? "distanceTwin" : "distanceStart"),
    series: [...ghosts(state, twin), { name: "distance", label: t(twin ? "distanceTwin" : "distanceStart"), colour: MD, x, y }],
    summary: t(twin ? "distanceTwin" : "distanceStart"),
    x: { label: t("collisionsAGrain"), symbol: t("collisionsAGrain"), range: [0, Math.max(10, ...x.slice(-1))] },
    y: { label: t("distanceAxis"), log: true, range: [1e-17, 10] },
  };
}

/* Between walls: T and the solid fraction over their means, from the lower wall to the upper; lines for md, marks
 * for dsmc, each in the engine's colour; φ is dashed, its marks are diamonds. Left out: the layers at the walls that centres of grains cannot reach. */
function profiles({ means }) {
  const series = [];
  for (const [engine, colour] of [
    ["md", MD],
    ["dsmc", DSMC],
  ]) {
    const curves = (means && means[engine] && means[engine].curves) || {},
      share = curves.profile_solid_fraction;
    if (!share) continue;
    const most = average(share.value),
      inside = share.x.map((_, i) => i).filter((i) => share.value[i] > most / 2);
    for (const [name, symbol, dash, shape] of [
      ["profile_temperature", "T", "", "square"],
      ["profile_solid_fraction", "φ", "6 3", "diamond"],
    ]) {
      const { x, value, stderr } = curves[name] || { x: [], value: [], stderr: [] },
        all = average(inside.map((i) => value[i])),
        of = (list) => inside.map((i) => (list[i] === null ? NaN : list[i] / all)),
        errors = of(stderr).map((e) => e || 0),
        look = engine === "md" ? { band: errors, dash } : { error: errors, points: true, shape, hollow: true };
      if (all > 0) series.push({ name: `${engine} ${name}`, label: `${t(engine)}: ${symbol}`, colour, x: inside.map((i) => x[i]), y: of(value), ...look });
    }
  }
  return {
    title: t("profilesTitle"),
    series,
    summary: series.length ? t("profilesTitle") : t("waiting"),
    x: { label: t("heightAxis"), symbol: "y" },
    y: { label: t("profilesAxis") },
  };
}
/* How the error of a mean shrinks: over the collisions that it is of, on logarithmic axes, with a line of slope -1/2. */
function errors(state) {
  const { gas, quantity, means } = state,
    series = [];
  for (const [engine, colour, shape] of [
    ["md", MD, "circle"],
    ["dsmc", DSMC, "square"],
  ]) {
    const rows = ((gas.history.errors || {})[engine] || []).filter(({ e }) => e[quantity] > 0);
    if (rows.length) series.push({ name: `error ${engine}`, label: t(engine), colour, shape, points: true, x: rows.map(({ c }) => c), y: rows.map(({ e }) => e[quantity]) });
  }
  const longest = [...series].sort((a, b) => b.x.length - a.x.length)[0];
  if (longest && longest.x.length > 1) {
    const { x, y } = longest,
      from = x[0],
      to = x[x.length - 1],
      middle = Math.exp(x.reduce((sum, c, i) => sum + Math.log(y[i] * Math.sqrt(c)), 0) / x.length);
    series.push({ name: "half", label: t("slopeHalf"), colour: "#777777", width: 1.2, reads: false, x: [from, to], y: [middle / Math.sqrt(from), middle / Math.sqrt(to)] });
  }
  const one = ((means && means.comparison) || []).find((row) => row.quantity === quantity),
    z = one && settled(means, "md") && settled(means, "dsmc") ? one.md_dsmc_z : NaN;
  return {
    title: Number.isFinite(z) ? t("errorsZ", { quantity: quantityName(quantity), z: `${z < 0 ? "−" : "+"}${Math.abs(z).toFixed(1)}` }) : t("errorsOf", { quantity: quantityName(quantity) }),
    series,
    summary: summaryOf(state, quantity),
    x: { label: t("collisionsAGrain"), symbol: t("collisionsAGrain"), log: true },
    y: { label: t("errorAxis"), log: true },
  };
}
const average = (list) => {
  const good = list.filter(Number.isFinite);
  return good.reduce((sum, one) => sum + one, 0) / good.length;
};

function summaryOf({ means }, name) {
  if (!means || !means.theory) return t("waiting");
  const parts = ["md", "dsmc"].map((engine) => [t(engine), withError(mean(means[engine] && means[engine].results, name), error(means[engine] && means[engine].results, name))]);
  const theories = chosenTheories(theoriesWith(means, [name])).map((one) => [theoryName(one), number(mean(means.theory[one], name))]);
  return `${name}: ${parts
    .concat(theories)
    .map(([who, what]) => `${who} ${what}`)
    .join("; ")}`;
}
