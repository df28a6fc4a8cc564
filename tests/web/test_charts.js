/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Charts by numbers, in node: positions of values in pixels, axes and their marks, error bars and bands; the
 * contents of each diagram for a state, with units. Expected numbers are computed here, not by the page's code. */
"use strict";
const assert = require("assert");
const { list } = require("./tap.js"),
  { modules } = require("./modules.js"),
  { Element, openDocument } = require("./dom.js");

/* The plot of a figure of 468 by 346 pixels is 400 wide and 300 high: x from 58 to 458, y from 308 up to 8. */
openDocument(468, 346);
globalThis.navigator ||= { language: "en" };
let m;

const near = (found, wanted, what = "") => {
  assert.strictEqual(found.length, wanted.length, `${what}: ${found} for ${wanted}`);
  found.forEach((x, i) => assert.ok(Object.is(x, wanted[i]) || Math.abs(x - wanted[i]) <= 1e-9 * Math.max(1, Math.abs(wanted[i])), `${what} ${i}: ${found} for ${wanted}`));
};
const chartOf = (spec) => {
  const figure = Object.assign(new Element("figure"), { id: "figure" }),
    chart = new m.chart.Chart(figure, (key, { x, all } = {}) => (x === undefined ? key : `${x} | ${all}`));
  chart.update({ title: "T", ...spec });
  return { chart, figure, of: (name) => chart.drawn.get(name) };
};
const numbersOf = (element, ...names) => names.map((name) => element.number(name));
const polygon = (element) => element.getAttribute("points").split(" ").map((one) => one.split(",").map(Number));
const placeOf = (path) => /translate\((.*),(.*)\)/.exec(path.getAttribute("transform")).slice(1).map(Number);
const axisTexts = (chart) => chart.axes.all("text").map((one) => [one.textContent, one.number("x"), one.number("y")]);

/* The input of a diagram of the page for a state. */
const shown = (state) => {
  let spec = null;
  m.charts.showChart({ update: (one) => (spec = one) }, { ...m.state.initial, ...state });
  return { ...spec, of: (name) => spec.series.find((one) => one.name === name) };
};
const aboutOf = (flow, more = {}) => ({ values: { flow, phi: 0.1, collision: { e: 0.9, beta: -1, mu: "inf" }, run: { seed: 1 }, ...more } });
const rowOf = (time, clock, T, theta) => ({ time, collisionsPerGrain: clock, temperature: T, rotationalTemperature: theta });
const mean = (value, stderr = 0.01 * value) => ({ mean: value, stderr });
const about = (title) => ({ title, beyond: null });

const parts = {
  "points, error bars and marks lie at their values": () => {
    const { of, chart } = chartOf({
      x: { range: [0, 10], label: "x" },
      y: { range: [0, 3], label: "y" },
      series: [{ name: "s", label: "s", colour: "red", points: true, x: [2.5, 5, 7.5], y: [1, NaN, 2], error: [0.5, 1, 0], shift: 7 }],
    });
    const [first] = of("s").all("line");
    assert.strictEqual(of("s").all("line").length, 1); /* an error of 0 has no bar, NaN has no point */
    near(numbersOf(first, "x1", "x2", "y1", "y2"), [165, 165, 258, 158]);
    assert.deepStrictEqual(of("s").all("path").map(placeOf), [
      [165, 208],
      [365, 108],
    ]);
    near([chart.valueAt(158), chart.valueAt(58), chart.valueAt(458)], [2.5, 0, 10]);
  },
  "logarithmic axes": () => {
    const { of, chart } = chartOf({
      x: { range: [1, 100], log: true },
      y: { range: [1e-3, 1], log: true },
      series: [{ name: "s", label: "s", colour: "red", x: [0, 1, 10, 100], y: [1, 1, 0.01, -1], band: [0, 0, 0.005, 0] }],
    });
    const d = 100 * Math.log10(1.5),
      e = 100 * Math.log10(2);
    assert.deepStrictEqual(polygon(of("s").line), [
      [58, 8],
      [258, 208],
    ]);
    const band = [[58, 8], [258, 208 - d], [258, 208 + e], [58, 8]];
    polygon(of("s").band).forEach(([x, y], i) => assert.ok(x === band[i][0] && Math.abs(y - band[i][1]) <= 0.051, `${i}: ${x}, ${y}`));
    near([chart.valueAt(258), chart.valueAt(358)], [10, 10 ** 1.5]);
  },
  "a bar stands over its bin": () => {
    const { of } = chartOf({ x: { range: [0, 10] }, y: { range: [0, 3] }, series: [{ name: "s", label: "s", colour: "red", bars: 1, x: [2.5], y: [2] }] });
    near(numbersOf(of("s").all("rect")[0], "x", "y", "width", "height"), [138, 108, 39, 200]);
  },
  "ranges hold all values, their errors and bands, with some room": () => {
    const { range } = m.chart;
    near(range([0, 10, NaN], false), [-0.6, 10.8]);
    near(range([-1, 1], false), [-1.12, 1.16]);
    near(range([4], false), [1.76, 6.32]);
    near(range([0], false), [-1.12, 1.16]);
    near(range([1, -5, 0, 100], true), [1 / 1.1, 110]);
    near(range([4], true), [2, 8]);
    assert.deepStrictEqual([range([], false), range([0], true)], [[0, 1], [0.1, 1]]);
    for (const error of ["error", "band"]) {
      const { chart } = chartOf({ x: {}, y: {}, series: [{ name: "s", label: "s", points: error === "error", x: [0, 10], y: [1, 2], [error]: [0.5, 1] }] });
      near([...chart.xr, ...chart.yr], [-0.6, 10.8, 0.5 - 0.06 * 2.5, 3 + 0.08 * 2.5], error);
    }
  },
  "marks are round, and stand at their values": () => {
    const { ticks } = m.chart;
    for (const [from, to, log, wanted] of [
      [0, 7, false, [0, 2, 4, 6]],
      [-1.3, 2.2, false, [-1, 0, 1, 2]],
      [3.1, 3.35, false, [3.1, 3.15, 3.2, 3.25, 3.3, 3.35]],
      [0, 2500, false, [0, 500, 1000, 1500, 2000, 2500]],
      [0.9, 1100, true, [1, 10, 100, 1000]],
      [1e-12, 1, true, [1e-12, 1e-10, 1e-8, 1e-6, 1e-4, 1e-2, 1]],
      [1.5, 45, true, [2, 5, 10, 20]],
      [0.15, 0.9, true, [0.2, 0.5]],
      [2, 8, true, [2, 4, 6, 8]],
    ])
      near(ticks(from, to, log), wanted, `${from} to ${to}`);
    const { chart } = chartOf({ x: { range: [0, 10], label: "time" }, y: { range: [1e-2, 1], log: true, label: "T" }, series: [{ name: "s", label: "s", x: [1], y: [0.1] }] }),
      found = axisTexts(chart);
    assert.deepStrictEqual(found, [
      ["0.01", 53, 312],
      ["0.1", 53, 162],
      ["1", 53, 12],
      ["0", 58, 324],
      ["2", 138, 324],
      ["4", 218, 324],
      ["6", 298, 324],
      ["8", 378, 324],
      ["10", 458, 324],
      ["time", 258, 341],
      ["T", 11, 158],
    ]);
    const named = chartOf({ x: { range: [-0.5, 2.5], names: ["a", "b", "c"] }, y: { range: [0, 1] }, series: [{ name: "s", label: "s", x: [1], y: [0.1] }] });
    assert.deepStrictEqual(axisTexts(named.chart).slice(-3).map(([text, x]) => [text, Math.round(x)]), [["a", 125], ["b", 258], ["c", 391]]);
  },
  "a pointer reads the nearest value of each line, none beyond its ends": () => {
    const { chart } = chartOf({
      x: { range: [0, 10], symbol: "t", label: "time" },
      y: { range: [0, 5] },
      series: [
        { name: "a", label: "a", x: [0, 2, 4], y: [1, 2, 3] },
        { name: "b", label: "b", points: true, x: [9], y: [0.123456] },
        { name: "c", label: "c", x: [3], y: [7], reads: false },
      ],
    });
    chart.read(2.9, false);
    assert.strictEqual(chart.readout.textContent, "t = 2.9 | a: 2; b: 0.1235");
    near(numbersOf(chart.rule, "x1", "x2", "y1", "y2"), [174, 174, 8, 308]);
    chart.read(3.1, false);
    assert.strictEqual(chart.readout.textContent, "t = 3.1 | a: 3; b: 0.1235");
    chart.read(4.3, false);
    assert.strictEqual(chart.readout.textContent, "t = 4.3 | b: 0.1235");
    assert.deepStrictEqual(chart.places(), [0, 2, 4, 9]);
  },
  "how an inelastic gas goes: columns, means with errors, theories": () => {
    const history = new m.history.TemperatureHistory(false);
    history.add(rowOf(1, 10, 2, 3), rowOf(1, 11, 4, 5), rowOf(1, 12, 6, 7));
    history.add(rowOf(2, 20, 2.1, 3.1), rowOf(2, 21, 4.1, 5.1), rowOf(2, 22, 6.1, 7.1));
    const results = (T, theta) => ({ results: { temperature: mean(T, 0.1 * T), rotational_temperature: mean(theta, 0.2 * theta) } }),
      means = { md: results(8, 9), dsmc: results(10, 11), theory: { lun1991: { temperature: { mean: 12 }, rotational_temperature: { mean: 13 } } }, theories: { lun1991: about("Lun") } };
    const spec = shown({ gas: { about: aboutOf("usf", { collision: { e: 0.9, beta: 0, mu: "inf" } }), history }, means });
    for (const [name, y] of Object.entries({ T: [2, 2.1], T2: [4, 4.1], T3: [6, 6.1], theta: [3, 3.1], theta2: [5, 5.1] })) assert.deepStrictEqual([spec.of(name).x, spec.of(name).y], [[10, 20], y], name);
    for (const [name, y, e] of [
      ["mean md temperature", 8, 0.8],
      ["mean md rotational_temperature", 9, 1.8],
      ["mean dsmc temperature", 10, 1],
      ["mean dsmc rotational_temperature", 11, 2.2],
    ]) {
      assert.deepStrictEqual([spec.of(name).x, spec.of(name).y], [[10, 20], [y, y]], name);
      near(spec.of(name).band, [e, e], name);
    }
    assert.deepStrictEqual([spec.of("lun1991 temperature").y, spec.of("lun1991 rotational_temperature").y], [[12, 12], [13, 13]]);
    assert.deepStrictEqual([spec.y.label, spec.y.log, spec.x.label, spec.x.log], ["T (d² γ²)", false, "collisions a grain", false]);
    near(spec.y.range, [0, 1.12 * 13]);
    const colours = Object.fromEntries(spec.series.map((one) => [one.name, one.colour]));
    assert.ok(colours.T === colours.theta && colours.T === colours["mean md temperature"] && colours.T2 === colours.theta2 && colours.T2 === colours["mean dsmc temperature"] && colours.T !== colours.T2);
    assert.deepStrictEqual(["T", "T2", "T3", "theta"].map((name) => spec.of(name).label), ["grains: T", "Enskog, by dice: T", "the box beside: T", "grains: θ"]);
    /* between walls the mean of the steady flow is not drawn across */
    assert.strictEqual(shown({ gas: { about: aboutOf("couette"), history }, means }).of("mean md temperature"), undefined);
  },
  "how a cooling gas goes: time, both axes logarithmic, the slope of Haff's law": () => {
    const history = new m.history.TemperatureHistory(true),
      T = (time) => 3 * (1 + time / 5) ** -2;
    for (let k = -2; k <= 3; k++) history.add(rowOf(10 ** k, k + 3, T(10 ** k), 0), null);
    const time = [1e-3, 1e-1, 10, 1e3, 1e5],
      means = { theory: {}, theories: { haff1983: about("Haff") }, cooling: { time, T: { haff1983: time.map((t) => 7 / t) } } };
    const spec = shown({ gas: { about: aboutOf("hcs"), history }, means });
    near(spec.of("T").x, [0.01, 0.1, 1, 10, 100, 1000]);
    near(spec.of("T").y, spec.of("T").x.map(T));
    assert.deepStrictEqual([spec.x.label, spec.x.log, spec.y.label, spec.y.log, spec.y.range], ["time (d/v₀)", true, "T (v₀²)", true, null]);
    const { x, y } = spec.of("slope");
    near([y[0], y[1], x[1]], [T(0.01), 2 * T(1000), 1000]);
    near([Math.log(y[1] / y[0]) / Math.log(x[1] / x[0])], [-2]);
    const line = spec.of("haff1983 temperature");
    near(line.x, [0.1, 10, 1000, 1300]);
    near(line.y, [70, 0.7, 7e-3, 7 / 1300]);
    /* no line before the gas has cooled to a fifth */
    const short = new m.history.TemperatureHistory(true);
    for (const [t, T1] of [[1, 1], [2, 0.5], [4, 0.21]]) short.add(rowOf(t, t, T1, 0), null);
    assert.strictEqual(shown({ gas: { about: aboutOf("hcs"), history: short }, means: null }).of("slope"), undefined);
  },
  "a stored result is over time, md and dsmc apart, with the frame that is shown": () => {
    const history = new m.history.StoredHistory(false, {
      md: { T: { time: [1, 2], value: [3, 4] }, theta: { time: [1, 2], value: [5, 6] } },
      dsmc: { T: { time: [7, 8], value: [9, 10] }, theta: { time: [7, 8], value: [11, 12] } },
    });
    history.now = 1.5;
    const spec = shown({ gas: { about: aboutOf("usf"), history }, means: null });
    for (const [name, x, y] of [
      ["T", [1, 2], [3, 4]],
      ["T2", [7, 8], [9, 10]],
      ["theta", [1, 2], [5, 6]],
      ["theta2", [7, 8], [11, 12]],
      ["now", [1.5, 1.5], [3, 12]],
    ])
      assert.deepStrictEqual([spec.of(name).x, spec.of(name).y], [x, y], name);
    assert.strictEqual(spec.x.label, "time (1/γ)");
  },
  "the history: clock or time, older points thinned, the first kept": () => {
    const steady = new m.history.TemperatureHistory(false);
    for (let k = 0; k <= 480; k++) steady.add(rowOf(2 * k, k / 10, k, 3 * k), null);
    assert.deepStrictEqual([steady.rows.length, steady.key, steady.gap], [241, "clock", 0.04]);
    near(steady.course("theta").x.slice(0, 3), [0, 0.2, 0.4]);
    near(steady.course("theta").y.slice(0, 3), [0, 6, 12]);
    steady.addDistance(1, 5);
    steady.addDistance(1.005, 6);
    steady.addDistance(1.02, 7);
    assert.deepStrictEqual([steady.far.x, steady.far.y], [[1, 1.02], [5, 7]]);
    const cooling = new m.history.TemperatureHistory(true);
    for (const t of [1, 1.02, 1.04]) cooling.add(rowOf(t, 5 * t, 1, 0), null);
    assert.deepStrictEqual([cooling.key, cooling.column("time"), cooling.column("clock")], ["time", [1, 1.04], [5, 5.2]]);
  },
  "speeds: bars at the middles of bins, Maxwell's curve of this T": () => {
    const density = Array.from({ length: 30 }, (_, i) => i / 100);
    m.gas.now.frame = { speeds: { end: 6, density }, md: { temperature: 0.49 } };
    const spec = shown({ chart: "speeds", gas: { about: { ...aboutOf("hcs"), fast: 1.2 } } });
    near(spec.of("speeds").x.slice(0, 3), [0.1, 0.3, 0.5]);
    near([spec.of("speeds").bars], [0.2]);
    assert.strictEqual(spec.of("speeds").y, density);
    const { x, y } = spec.of("maxwell"),
      sum = (f) => x.reduce((all, v, i) => all + f(v) * y[i], 0) * (x[1] - x[0]);
    near([x[0], x[80], x.length], [0, 6, 81]);
    for (const [found, wanted] of [
      [sum(() => 1), 1],
      [sum((v) => v), Math.sqrt((8 * 0.49) / Math.PI)],
      [sum((v) => v * v), 3 * 0.49],
    ])
      assert.ok(Math.abs(found / wanted - 1) < 1e-4, `${found} for ${wanted}`);
    assert.strictEqual(spec.x.label, "speed v (v₀)");
    near([...spec.x.range, ...spec.y.range], [0, 3, 0, 1.3 * Math.max(...y)]);
    m.gas.now.frame = null;
    near(shown({ chart: "speeds", gas: { about: { ...aboutOf("usf"), fast: 0.4 } } }).y.range, [0, 1.3 * 2]);
  },
  "velocities: each curve with its errors, engine by engine, beside the Gaussian": () => {
    const curve = (k) => ({ label: `C_{x${k}}`, x: [k, k + 1], value: [0.1 * k, null], stderr: [0.01 * k, null], reference: { value: [k / 7, k / 9] } }),
      of = (k) => ({ curves: { velocity_distribution_Cx: curve(k), velocity_distribution_Cy_2: curve(k + 1), cells_Cx: curve(99) } }),
      spec = shown({ chart: "velocities", gas: { about: aboutOf("hcs") }, means: { md: of(1), dsmc: of(5) } });
    assert.deepStrictEqual(spec.series.map((one) => one.name), ["velocities md Cx", "velocities md Cy_2", "velocities dsmc Cx", "velocities dsmc Cy_2", "gaussian"]);
    for (const [name, k] of [["velocities md Cx", 1], ["velocities md Cy_2", 2], ["velocities dsmc Cx", 5], ["velocities dsmc Cy_2", 6]]) {
      near(spec.of(name).x, [k, k + 1], name);
      near(spec.of(name).y, [0.1 * k, NaN], name);
      near(spec.of(name).band, [0.01 * k, 0], name);
    }
    assert.deepStrictEqual([spec.of("velocities md Cx").dash, spec.of("velocities md Cy_2").dash, spec.of("velocities md Cy_2").width, spec.of("velocities md Cx").label], ["", "4 3", 1, "grains: Cx1"]);
    near(spec.of("gaussian").y, [1 / 7, 1 / 9]);
    assert.deepStrictEqual([spec.x.range, spec.y.range, spec.y.log, spec.y.label], [[-5, 5], [1e-4, 2], true, "P / P(0)"]);
  },
  "pressures along x, y and z, over the mean": () => {
    m.gas.now.frame = { md: { kineticStress: [[4, 9, 9], [9, 2, 9], [9, 9, 3]] } };
    const results = (x, y, z) => ({ pressure: mean((x + y + z) / 3), P_xx: mean(x, 0.2), P_yy: mean(y, 0.3), P_zz: mean(z, 0.4), N1: mean((3 * (x - y)) / (x + y + z), 0.01), N2: mean(0.25, 0.01) });
    const means = { md: { results: results(5, 3, 4) }, dsmc: { results: results(12, 6, 9) }, theory: { lun1991: results(2, 0.4, 0.6) }, theories: { lun1991: about("Lun") } },
      spec = shown({ chart: "stress", gas: { about: aboutOf("usf") }, means });
    m.gas.now.frame = null;
    near(spec.of("now").y, [4 / 3, 2 / 3, 1]);
    near(spec.of("now").x, [0, 1, 2]);
    near(spec.of("md").y, [5 / 4, 3 / 4, 1]);
    near(spec.of("md").error, [0.05, 0.075, 0.1]);
    near(spec.of("dsmc").y, [12 / 9, 6 / 9, 1]);
    near(spec.of("dsmc").error, [0.2 / 9, 0.3 / 9, 0.4 / 9]);
    near(spec.of("lun1991").y, [2, 0.4, 0.6]);
    near([spec.of("md").x, spec.of("lun1991").x, spec.of("dsmc").x].flat(), [-0.26, 0.74, 1.74, 0, 1, 2, 0.26, 1.26, 2.26]);
    near(spec.y.range, [0, 2.2]);
    assert.deepStrictEqual(spec.x.names, ["along x (flow)", "along y", "along z"]);
    assert.strictEqual(spec.summary, "N1: grains 0.500(10); Enskog, by dice 0.667(10); Lun 1991 1.6. N2: grains 0.250(10); Enskog, by dice 0.250(10); Lun 1991 0.25");
  },
  "distances, and curves of runs before": () => {
    const history = { far: { x: [1, 30], y: [1e-12, 1e-3] } },
      ghost = (label, chart) => ({ label, chart, x: [1, 2], y: [3, 4] }),
      spec = shown({ chart: "distance", pair: "bit", gas: { about: aboutOf("hcs"), history }, ghosts: [ghost("e = 0.8", "distance"), ghost("e = 0.7", "temperature")] });
    assert.deepStrictEqual(spec.series.map((one) => [one.name, one.x, one.y]), [["ghost e = 0.8", [1, 2], [3, 4]], ["distance", [1, 30], [1e-12, 1e-3]]]);
    assert.deepStrictEqual([spec.title, spec.x.range, spec.y.range, spec.y.log, spec.y.label], ["Distance to the twin", [0, 30], [1e-17, 10], true, "distance (d)"]);
  },
  "errors of means over their collisions, a line of slope -1/2, z": () => {
    const history = new m.history.TemperatureHistory(false),
      results = (stderr) => ({ temperature: { mean: 6, stderr } });
    for (const [c, e] of [[100, 0.2], [105, 9], [400, 0.1]]) history.addError("md", c, results(e)); /* 105: less than a tenth more */
    history.addError("dsmc", 100, results(null));
    const means = { md: { results: results(0.1) }, dsmc: { results: results(0.02) }, theory: {}, comparison: [{ quantity: "temperature", md_dsmc_z: -1.26 }] },
      spec = shown({ chart: "errors", gas: { about: aboutOf("usf"), history }, quantity: "temperature", means });
    assert.deepStrictEqual(spec.series.map((one) => one.name), ["error md", "half"]);
    near(spec.of("error md").x, [100, 400]);
    near(spec.of("error md").y, [0.2, 0.1]);
    near(spec.of("half").y, [0.2, 0.1]); /* exactly 2/sqrt(c) */
    assert.deepStrictEqual([spec.x.log, spec.y.log, spec.title], [true, true, "Error of temperature T; z = −1.3"]);
    const warm = { ...means, progress: { md: { averaging: 0, over: false }, dsmc: { averaging: 1, over: false } } };
    assert.strictEqual(shown({ chart: "errors", gas: { about: aboutOf("usf"), history }, quantity: "temperature", means: warm }).title, "Error of temperature T");
  },
  "between walls: T and the solid fraction over their means, where grains can be": () => {
    const curves = {
        profile_solid_fraction: { x: [0, 1, 2, 3], value: [0.01, 0.2, 0.4, null], stderr: [0, 0.02, null, 0] },
        profile_temperature: { x: [0, 1, 2, 3], value: [9, 2, 6, 9], stderr: [0, 0.4, 0.8, 0] },
      },
      spec = shown({ chart: "profiles", gas: { about: aboutOf("couette") }, means: { md: { curves }, dsmc: { curves } } });
    near(spec.of("md profile_temperature").x, [1, 2]);
    near(spec.of("md profile_temperature").y, [0.5, 1.5]);
    near(spec.of("md profile_temperature").band, [0.1, 0.2]);
    near(spec.of("md profile_solid_fraction").y, [0.2 / 0.3, 0.4 / 0.3]);
    near(spec.of("dsmc profile_solid_fraction").error, [0.02 / 0.3, 0]);
    for (const engine of ["md", "dsmc"]) assert.strictEqual(spec.of(`${engine} profile_temperature`).colour, spec.of(`${engine} profile_solid_fraction`).colour);
    assert.strictEqual(spec.of("md profile_temperature").colour, m.colours.MD); /* a colour means an engine */
    assert.deepStrictEqual([spec.of("dsmc profile_temperature").points, spec.of("md profile_temperature").label, spec.of("md profile_solid_fraction").label, spec.x.label], [true, "grains: T", "grains: φ", "height y (d)"]);
  },
  "profiles beside the box lie on its own height": () => {
    const place = new Element("div"),
      curve = (value) => ({ x: [1, 3, 5], value, stderr: [0, 0.5, null] });
    m.profiles.showProfiles(place, { md: { curves: { profile_velocity: curve([-2, 0, 2]), profile_temperature: curve([1, 2, 4]) } }, dsmc: { curves: { profile_temperature: curve([1, 3, null]) } } }, [300, 60], 400);
    const [svg] = place.children,
      [u, T] = svg.children;
    /* bins of 2 from 0 to 6 over 240 pixels; u from -2 - .06 x 4 to 2 + .08 x 4 over 60 pixels from 4, T from 0 to 4 from 70 */
    const uAt = (v) => 4 + (60 * (v + 2.24)) / 4.56,
      tAt = (v) => 70 + (60 * (v + 0.24)) / 4.56;
    const alike = (found, wanted) => found.flat().forEach((x, i) => assert.ok(Math.abs(x - wanted.flat()[i]) <= 0.051, `${found} for ${wanted}`));
    alike(polygon(u.all("polyline")[0]), [[uAt(-2), 260], [uAt(0), 180], [uAt(2), 100]]);
    alike(polygon(T.all("polyline")[0]), [[tAt(1), 260], [tAt(2), 180], [tAt(4), 100]]);
    alike(numbersOf(T.all("line")[0], "x1", "x2", "y1", "y2"), [tAt(1.5), tAt(2.5), 180, 180]);
    alike(T.all("circle").map((one) => numbersOf(one, "cx", "cy")), [[tAt(1), 260], [tAt(3), 180]]);
    assert.deepStrictEqual(u.all("text").map((one) => one.textContent), ["u", "−2", "2"]);
    near(numbersOf(svg, "width", "height"), [198, 400]);
  },
  "theories: the best known first, the chosen ones, each with a look of its own": () => {
    const { ranked, chosenTheories, theoriesWith, titleOf, lineOf } = m.theories,
      names = ["zzz", "grad", "lun1991", "haff1983", "enskog_hermite"],
      means = { theory: { grad: { N1: { mean: 1 } }, lun1991: { temperature: { mean: 2 } }, haff1983: { cooling_rate: { mean: null } }, zzz: { temperature: { mean: 3 }, N1: { mean: 2 } } }, theories: { grad: { beyond: "phi" } } };
    assert.deepStrictEqual(ranked(names), ["enskog_hermite", "haff1983", "lun1991", "grad", "zzz"]);
    assert.deepStrictEqual([chosenTheories(names), theoriesWith(means, ["N1"]), theoriesWith(means, ["temperature", "cooling_rate"])], [["enskog_hermite", "haff1983"], ["grad", "zzz"], ["lun1991", "zzz"]]);
    assert.deepStrictEqual([titleOf(means, "grad"), titleOf(means, "lun1991")], ["Grad's moments †", "Lun 1991"]);
    m.state.store.look({ theories: ["zzz", "grad"], means });
    assert.deepStrictEqual(chosenTheories(names), ["grad", "zzz"]);
    const looks = () => ["lun1991", "grad", "haff1983"].map((name) => m.colours.LINES.indexOf(lineOf(name)));
    assert.deepStrictEqual(looks(), [3, 6, 1]);
    assert.strictEqual(m.colours.LINES.indexOf(lineOf("zzz")), 0); /* the first line that no theory of this gas has */
    m.state.store.look({ theories: null, means: null });
    assert.deepStrictEqual(looks(), [3, 6, 1]); /* also before theories have come */
    const all = [...m.colours.CLASS, ...m.colours.LINES.map((one) => one.colour), m.colours.MD, m.colours.DSMC];
    assert.strictEqual(new Set(all).size, all.length); /* a student, a theory and an engine share no colour */
  },
  "my points over the slider, beside the theories' lines and the points of a class": () => {
    const gas = { about: aboutOf("hcs", { collision: { e: 0.93, beta: -1, mu: "inf" } }) },
      point = (x, md, dsmc, from = "") => ({ slider: "e", x, from, md: { N1: md }, dsmc: dsmc ? { N1: dsmc } : {} }),
      key = `e ${JSON.stringify({ flow: "hcs", phi: 0.1, collision: { beta: -1, mu: "inf" } })}`;
    let spec = null;
    m.points.showPoints(
      { update: (one) => (spec = one) },
      {
        ...m.state.initial,
        gas,
        slider: "e",
        quantity: "N1",
        means: { md: { results: { N1: mean(0.7, 0.03) } } },
        points: [point(0.9, [1, 0.1], [2, 0.2]), { ...point(0.8, [3, 0.3]), family: "other" }, { ...point(0.7, [4, 0.4]), slider: "phi" }, point(0.6, [5, 0.5], [6, 0.6], "Ann"), point(0.55, [7, 0.7], null, "Bob")],
        lines: { [key]: { x: [0.5, 0.75, 1], theory: [{ grad: { N1: 10 } }, { grad: { N1: 11 } }] } },
      },
    );
    const of = (name) => spec.series.find((one) => one.name === name);
    for (const [name, x, y, error, shift] of [
      ["md kept", [0.9], [1], [0.1]],
      ["dsmc kept", [0.9], [2], [0.2]],
      ["md now", [0.93], [0.7], [0.03]],
      ["md of Ann", [0.6], [5], [0.5], -3.5],
      ["dsmc of Ann", [0.6], [6], [0.6], -3.5],
      ["md of Bob", [0.55], [7], [0.7], 3.5],
    ])
      assert.deepStrictEqual([of(name).x, of(name).y, of(name).error, of(name).shift], [x, y, error, shift], name);
    assert.deepStrictEqual([of("grad").x, of("grad").y], [[0.5, 0.75], [10, 11]]);
    near(spec.x.range, [0.49, 1.01]);
    assert.deepStrictEqual([spec.x.label, spec.y.label, spec.title], ["e", "N₁", "My points: first normal stress difference N₁ over e"]);
    assert.ok(!of("dsmc now") && !of("dsmc of Bob"));
  },
};

modules(["chart", "charts", "colours", "gas", "history", "points", "profiles", "state", "theories"]).then((all) => {
  m = all;
  return list(parts, null);
});
