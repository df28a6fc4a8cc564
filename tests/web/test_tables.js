/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers, units, tables, CSV, controls, links and pictures of the page, in node: printed and drawn texts for values
 * that all differ. Expected texts and numbers are computed here; units are the command's. */
"use strict";
const assert = require("assert");
const { list, terminal } = require("./tap.js"),
  { modules } = require("./modules.js"),
  { Element, openDocument } = require("./dom.js");

openDocument(400, 300);
globalThis.navigator ||= { language: "en" };
let m;

const near = (found, wanted, what = "", within = 1e-9) => {
  assert.strictEqual(found.length, wanted.length, `${what}: ${found} for ${wanted}`);
  Array.from(found).forEach((x, i) => assert.ok(Math.abs(x - wanted[i]) <= within * Math.max(1, Math.abs(wanted[i])), `${what} ${i}: ${found} for ${wanted}`));
};
const byId = (id) => document.getElementById(id);
const VALUES = { flow: "usf", phi: 0.1, collision: { e: 0.8, beta: 0.5, mu: 0.3, law: "constant" }, run: { seed: 7 }, particles: 100, walls: { e: 0.7 }, species: [{ fraction: 1, diameter: 1, mass: 1 }] };
const row = (time, clock, T, theta) => ({ time, collisionsPerGrain: clock, temperature: T, rotationalTemperature: theta });

const parts = {
  "numbers with their errors": () => {
    const { number, withError, powerOfTen, superscript } = m.words;
    for (const [x, e, wanted] of [
      [138.8249, 0.4, "138.82(40)"],
      [0.138824, 0.0036, "0.1388(36)"],
      [-2.5, 0.25, "-2.50(25)"],
      [1234567, 3400, "1234567(3400)"],
      [12345.6, 87.6, "12346(88)"],
      [5.051e-5, 1.2e-6, "5.05(12)·10⁻⁵"],
      [1.5e8, 2e6, "1.500(20)·10⁸"],
      [0, 0.04, "0.000(40)"],
      [NaN, 1, "–"],
      [4.5678, NaN, "4.57(?)"],
      [4.5678912, 0, "4.56789"],
    ])
      assert.strictEqual(withError(x, e), wanted);
    assert.deepStrictEqual([1.23456, 1.2346e-4, 9.99e-4, 1e-3, 999999.4, 1234567, -0.5, 0, 1e6, Infinity].map((x) => number(x)), ["1.235", "1.235·10⁻⁴", "9.990·10⁻⁴", "0.001", "1000000", "1.235·10⁶", "-0.5", "0", "1.000·10⁶", "–"]);
    assert.deepStrictEqual([number(2.71828, 2), powerOfTen(1e-15, 1), powerOfTen(-3.2e7, 2), superscript(-1234567890)], ["2.7", "10⁻¹⁵", "-3.2·10⁷", "⁻¹²³⁴⁵⁶⁷⁸⁹⁰"]);
  },
  "units are the terminal's": () => {
    const { typeset } = m.words,
      { temperatureUnit, timeUnit, speedUnit, spinUnit } = m.charts;
    for (const phi of [0.1, 0]) {
      const told = JSON.parse(terminal(`{flow: usf, phi: ${phi}, collision: {e: 0.9}}`, "theory", "--theory", "lun1991", "--json"));
      assert.strictEqual(temperatureUnit(told.scene), typeset(told.theory.lun1991.temperature.unit).replace(/\u202f/g, " "));
    }
    for (const [flow, phi, ...wanted] of [
      ["usf", 0.1, "1/γ", "d γ", "γ", "d² γ²"],
      ["heated_shear", 0.1, "1/γ", "d γ", "γ", "d² γ²"],
      ["small_shear", 0.1, "1/γ", "d γ", "γ", "d² γ²"],
      ["couette", 0.1, "1/γ", "d γ", "γ", "d² γ²"],
      ["usf", 0, "1/γ", "γ/(n d²)", "γ", "(γ/(n d²))²"],
      ["hcs", 0.1, "d/v₀", "v₀", "v₀/d", "v₀²"],
      ["hss", 0, "1/(n d² v₀)", "v₀", "v₀/d", "v₀²"],
      ...["equilibrium", "poiseuille", "chute", "fourier"].map((one) => [one, 0.1, "d/v₀", "v₀", "v₀/d", "v₀²"]),
    ])
      assert.deepStrictEqual([timeUnit, speedUnit, spinUnit, temperatureUnit].map((unit) => unit({ flow, phi })), wanted, flow);
    assert.deepStrictEqual(["rho_p v_0^2", "d^-3", "rho_p d^2 gamma^2"].map(typeset), ["ρₚ\u202fv₀²", "d⁻³", "ρₚ\u202fd²\u202fγ²"]);
  },
  "the table of both engines and the theories": () => {
    const table = { tHead: new Element("thead"), tBodies: [new Element("tbody")] },
      mean = (value, stderr, unit, more) => ({ mean: value, stderr, unit, ...more }),
      means = {
        md: { results: { temperature: mean(1.5, 0.02, "d^2 gamma^2"), N1: mean(0.5, 0.01, "1"), a2: { mean: null, stderr: null, unit: "1", reason: "why not" } } },
        dsmc: { results: { temperature: mean(1.6, 0.03, "d^2 gamma^2"), own: mean(7, 1, "d") } },
        theory: { lun1991: { temperature: { mean: 1.7 }, pressure: { mean: 3.25, unit: "rho_p d^2 gamma^2" } }, grad: { temperature: { mean: 1.8 } }, zzz: { temperature: { mean: 1.9 } } },
        theories: { lun1991: { title: "Lun", beyond: "phi is large" }, grad: { title: "G", beyond: null }, zzz: { title: "Z", beyond: "never" } },
        comparison: [
          { quantity: "N1", md_dsmc_z: 2.345, beyond_expected: false },
          { quantity: "temperature", md_dsmc_z: -2.77, beyond_expected: true },
        ],
      };
    const rows = (everything) => {
      m.table.fillTable(table, means, everything);
      return [table.tHead, table.tBodies[0]].flatMap((part) => part.children.map((line) => line.children.map((one) => one.textContent)));
    };
    assert.deepStrictEqual(rows(false), [
      ["quantity", "unit", "grains", "Enskog, by dice", "z", "Lun 1991 †", "Grad's moments"],
      ["temperature T", "d²\u202fγ²", "1.500(20)", "1.600(30)", "-2.8 !", "1.7", "1.8"],
      ["pressure", "ρₚ\u202fd²\u202fγ²", "–", "–", "", "3.25", "–"],
      ["first normal stress difference N₁", "1", "0.500(10)", "–", "+2.3", "–", "–"],
    ]);
    assert.deepStrictEqual(rows(true).map((one) => one[0]), ["quantity", "temperature T", "first normal stress difference N₁", "fourth cumulant a₂", "own", "pressure"]);
    assert.deepStrictEqual(rows(true)[4], ["own", "d", "–", "7.0(10)", "", "–", "–", "–"]);
    assert.strictEqual(table.tBodies[0].children[2].children[2].title, "why not");
    const reasons = new Element("ul");
    m.table.fillRanges(reasons, means);
    assert.deepStrictEqual(reasons.children.map((one) => one.textContent), ["† Lun 1991 (Lun): phi is large", "† Zzz (Z): never"]);
  },
  "points kept: all quantities with errors, and their table": () => {
    const { store } = m.state,
      results = (k) => ({ results: Object.fromEntries(m.points.QUANTITIES.map((q, i) => [q, { mean: k + i, stderr: (k + i) / 100 }])) });
    store.state = { ...m.state.initial, gas: { about: { values: VALUES } }, slider: "mu", means: { md: results(10), dsmc: results(30) } };
    store.state.means.dsmc.results.N2.stderr = null;
    m.points.keepPoint();
    const [point] = store.state.points;
    assert.deepStrictEqual([point.slider, point.x, point.seed, point.from], ["mu", 0.3, 7, ""]);
    assert.deepStrictEqual([point.md.temperature, point.md.collision_rate, point.dsmc.N1, point.dsmc.N2], [[10, 0.1], [17, 0.17], [32, 0.32], undefined]);
    const { run, ...family } = { ...VALUES, collision: { e: 0.8, beta: 0.5, law: "constant" } }; /* all but the slider and the seed */
    assert.deepStrictEqual(JSON.parse(point.family), family);
    store.state = m.state.initial;
    const some = [
      { slider: "mu", x: 0.3, seed: 7, from: "", md: { N2: [1, 2], temperature: [3, 4] }, dsmc: { N1: [5, 6] } },
      { slider: "e", x: 0.9, seed: 8, from: "Ann~k3", md: { temperature: [9, 10] }, dsmc: { N1: [11, 12], shear_viscosity: [13, 14] } },
    ];
    const text = m.points.pointsCsv(some);
    assert.strictEqual(
      text,
      "slider,value,seed,md_temperature,md_temperature_error,md_N2,md_N2_error,dsmc_N1,dsmc_N1_error,dsmc_shear_viscosity,dsmc_shear_viscosity_error,name\n" +
        "mu,0.3,7,3,4,1,2,5,6,,,\n" +
        "e,0.9,8,9,10,,,11,12,13,14,Ann~k3\n",
    );
    assert.deepStrictEqual(
      m.points.pointsOf(text, "graingas-points-Bob.csv"),
      some.map((one, i) => ({ ...one, seed: String(one.seed), from: i ? "Ann~k3" : "Bob" })),
    );
    /* columns are found by their names */
    const [other] = m.points.pointsOf("slider,value,seed,dsmc_N1_error,name,md_N2,dsmc_N1\r\ne,0.9,4,2,Eve,3,5\r\n", "x.csv");
    assert.deepStrictEqual(other, { slider: "e", x: 0.9, seed: "4", from: "Eve", md: { N2: [3, 0] }, dsmc: { N1: [5, 2] } });
  },
  "a point waits for both engines, and not for one that has ended without a mean": () => {
    const part = (stderr) => ({ results: { N1: { mean: 1, stderr } } }),
      at = (md, dsmc) => ({ averaging: md, over: dsmc }),
      can = (progress, md, dsmc, more = {}) => m.points.canKeep({ gas: {}, player: null, quantity: "N1", means: { progress, md: md && part(md), dsmc: dsmc && part(dsmc) }, ...more });
    const both = { md: at(1, false), dsmc: at(1, false) },
      warming = { md: at(0, false), dsmc: at(1, false) };
    assert.strictEqual(can(both, 0.1, 0.2), true);
    assert.strictEqual(can(both, null, 0.2), false);
    assert.strictEqual(can(warming, 0.1, 0.2), false); /* md has numbers, but of its warm-up */
    assert.strictEqual(can({ md: at(1, false) }, 0.1, null), true); /* dsmc was refused */
    assert.strictEqual(can({ md: at(0, true), dsmc: at(1, false) }, null, 0.2), true); /* md ended without a mean */
    assert.strictEqual(can({ md: at(0, true), dsmc: at(0, true) }, null, null), false);
    assert.strictEqual(can(both, 0.1, 0.2, { player: {} }), false);
    assert.strictEqual(m.points.canKeep({ gas: {}, player: null, quantity: "N1", means: null }), false);
  },
  "theories over the slider: its keys and values, and what they answer": async () => {
    const { store } = m.state,
      requested = [];
    m.worker_rpc.workers.evaluate = {
      request: async (job, { sets }) => {
        requested.push([job, sets]);
        if (requested.length === 2) throw new Error("refused");
        return { theory: { grad: { N1: { mean: 100 + requested.length }, a2: { mean: 5 } } } };
      },
    };
    store.state = { ...m.state.initial, gas: { scene: "s", sets: { phi: "0.2" }, about: { values: VALUES } }, slider: "e", means: { theory: {}, evaluated: true } };
    await m.points.drawLines();
    assert.deepStrictEqual(requested.map(([job, sets]) => [job, sets["collision.e"], sets.phi]), [0.5, 0.5625, 0.625, 0.6875, 0.75, 0.8125, 0.875, 0.9375, 1].map((x) => ["theory", String(x), "0.2"]));
    const [[key, { x, theory }]] = Object.entries(store.state.lines);
    assert.match(key, /^e \{/);
    near(x, requested.map(([, sets]) => +sets["collision.e"]));
    assert.deepStrictEqual(theory.map((one) => one.grad && one.grad.N1), [101, undefined, 103, 104, 105, 106, 107, 108, 109]);
    store.state = m.state.initial;
  },
  "curves as a table: live, stored, measured": () => {
    const history = new m.history.TemperatureHistory(false),
      curve = (k, value) => ({ x_name: "y", x: [k, k + 1], value: [k + 2, value], stderr: [k + 4, null] });
    history.add(row(1, 2, 3, 4), row(1, 5, 6, 7));
    history.add(row(11, 12, 13, 14), row(0.5, 15, 16, 17)); /* Monte Carlo behind md in time */
    assert.strictEqual(
      m.save.curvesCsv(history, { md: { curves: { u: curve(10, null) } }, dsmc: { curves: { T: curve(20, 27) } } }, "A gas"),
      "# A gas\ntime,collisions_per_grain,md_temperature,md_rotational_temperature,dsmc_temperature,dsmc_rotational_temperature\n" +
        "1,2,3,4,6,7\n11,12,13,14,,\n\ny,md_u,error\n10,12,14\n\ny,dsmc_T,error\n20,22,24\n21,27,\n",
    );
    const stored = new m.history.StoredHistory(false, { md: { T: { time: [1, 2], value: [3, NaN] }, theta: null }, dsmc: { theta: { time: [5], value: [6] } } });
    assert.strictEqual(m.save.curvesCsv(stored, null, "B"), "# B\ntime,md_temperature\n1,3\n2,\ntime,dsmc_rotational_temperature\n5,6\n");
    assert.strictEqual(m.save.fileName({ values: VALUES }, "csv"), "graingas-usf-phi0.1-e0.8-beta0.5-seed7.csv");
    assert.strictEqual(m.save.fileName({ values: { ...VALUES, collision: { e: 0.8, beta: -1 } } }, "yaml"), "graingas-usf-phi0.1-e0.8-seed7.yaml");
  },
  "what controls show of a scene and write into it": () => {
    const { rowOf, shownValue, gridOf, setsOf } = m.controls,
      two = { species: [{ fraction: 0.3, diameter: 2, mass: 5 }, { fraction: 0.7, diameter: 3, mass: 10 }] };
    for (const [name, shown] of Object.entries({ phi: 0.1, e: 0.8, beta: 0.5, mu: 0.3, wallE: 0.7, particles: 100, seed: 7, diameter: null })) assert.strictEqual(shownValue(rowOf(name), VALUES), shown, name);
    near([shownValue(rowOf("diameter"), two), shownValue(rowOf("mass"), two)], [1.5, 2]);
    assert.deepStrictEqual(JSON.parse(rowOf("diameter").put(4, two)), [two.species[0], { fraction: 0.7, diameter: 8, mass: 10 }]);
    assert.deepStrictEqual(JSON.parse(rowOf("mass").put(4, two)), [two.species[0], { fraction: 0.7, diameter: 3, mass: 20 }]);
    assert.deepStrictEqual(JSON.parse(rowOf("diameter").on({ species: [{ fraction: 1, diameter: 2, mass: 5 }] })), [{ fraction: 0.5, diameter: 2, mass: 5 }, { fraction: 0.5, diameter: 4, mass: 40 }]);
    assert.deepStrictEqual(JSON.parse(rowOf("diameter").off(two)), [{ fraction: 1, diameter: 2, mass: 5 }]);
    const tilt = rowOf("tilt");
    near([tilt.get({ gravity: [1, -Math.sqrt(3), 0] }), tilt.get({ gravity: [0, -2, 0] })], [30, 0]);
    near(JSON.parse(tilt.put(60, { gravity: [0, -2, 0] })), [Math.sqrt(3), -1, 0], "tilt", 1e-5);
    near(gridOf(rowOf("e")), [0.5, 0.5625, 0.625, 0.6875, 0.75, 0.8125, 0.875, 0.9375, 1]);
    near(gridOf(rowOf("beta"), 3), [-1, 0, 1]);
    assert.strictEqual(shownValue(rowOf("no such row"), VALUES), 0.8);
    /* keys that a flow needs, and values that are restored after an elastic gas */
    const { store } = m.state,
      values = (flow, e) => ({ flow, collision: { e, beta: 0.5, mu: 0.3, law: "viscoelastic" } }),
      at = (given) => (store.state = { ...m.state.initial, requested: { id: 1, scene: "", sets: {} }, gas: { sets: {}, about: { values: given } } });
    at(values("usf", 0.8));
    assert.deepStrictEqual(setsOf("phi", "0.2"), { phi: "0.2" });
    assert.deepStrictEqual(setsOf("flow", "chute"), { flow: "chute", thermostat: "none", gravity: "[0.1, -0.1, 0]", "walls.temperature": "none" });
    assert.deepStrictEqual([setsOf("flow", "hss").thermostat, setsOf("flow", "fourier")["walls.temperature"], setsOf("flow", "poiseuille").gravity], ["gaussian", "[1, 0.5]", "[1, 0, 0]"]);
    const elastic = setsOf("flow", "equilibrium");
    assert.deepStrictEqual([elastic["collision.e"], elastic["collision.beta"], elastic["collision.mu"], elastic["collision.law"]], ["1", "-1", "inf", "constant"]);
    at(values("equilibrium", 1));
    const back = setsOf("flow", "hcs");
    assert.deepStrictEqual([back["collision.e"], back["collision.beta"], back["collision.mu"], back["collision.law"]], ["0.8", "0.5", "0.3", "viscoelastic"]);
    assert.strictEqual(setsOf("flow", "hcs")["collision.e"], "0.9");
    store.state = m.state.initial;
  },
  "a link carries every part of the look, and no other": () => {
    const { linkOf, readLink } = m.link,
      about = { brief: "{flow: usf, phi: 0.1, collision: {e: 0.5}}", values: VALUES };
    const look = { question: "Why T = θ & e?", slider: "mu", quantity: "N2", view: "curve", colour: "since", chart: "stress", pair: "bit", follow: true, images: false, arrows: true, grain: 12, playing: false, speed: 0.03, camera: [-0.25, 1.5, 2.75] };
    const usual = { ...m.state.initial, lesson: null, gas: { scene: about.brief, sets: {}, about } };
    const read = readLink({ hash: linkOf({ ...usual, ...look, language: "es" }, "en"), search: "" });
    assert.deepStrictEqual([read.look, read.scene, read.sets, read.lesson, read.language], [look, about.brief, {}, null, "es"]);
    for (const [name, value] of Object.entries(look)) {
      if (["question", "slider", "quantity"].includes(name)) continue; /* a lesson with another one */
      const alone = readLink({ hash: linkOf({ ...usual, [name]: value }, "en"), search: "" });
      assert.deepStrictEqual(alone.look, { [name]: value }, name);
    }
    const sets = { "collision.e": "0.75", "walls.temperature": "[1, 0.5]", "run.seed": "9" },
      lesson = readLink({ hash: linkOf({ ...usual, ...m.gas.lookOf(m.lessons.lessonOf("haff")), lesson: "haff", gas: { sets, about } }, "en"), search: "" });
    assert.deepStrictEqual([lesson.lesson, lesson.scene, lesson.sets, lesson.look], ["haff", null, sets, {}]);
    assert.deepStrictEqual(readLink({ hash: "", search: "?lesson=walls&speed=3" }).look, { speed: 3 });
    const texts = ["Ann~a;e;N1;0.9,1,0.1,2,0.2", "Bob;e;N1;0.8,3,0.3"];
    assert.deepStrictEqual(readLink({ hash: m.link.linkOfPoints({ lesson: null, gas: { about } }, texts), search: "" }).points, texts);
  },
  "colours: ends and middles of both scales": () => {
    const { colourAt, mapOf } = m.colours;
    assert.deepStrictEqual([-1, 0, 0.25, 0.5, 0.625, 1, 2].map((x) => colourAt(x)), [[76, 84, 232], [76, 84, 232], [146, 70, 205], [220, 84, 140], [235, 117, 107], [255, 238, 90], [255, 238, 90]]);
    assert.deepStrictEqual([0, 0.5, 1].map((x) => colourAt(x, "sided")), [[170, 80, 215], [225, 228, 230], [40, 165, 75]]);
    assert.deepStrictEqual(["speed", "spin", "since", "along", "origin"].map(mapOf), ["rising", "rising", "rising", "sided", "sided"]);
  },
  "what is drawn of grains: scales of speeds, spins, times and sides; marks that turn": () => {
    const grains = { n: 2, species: [0, 1], position: [1, 2, 3, 4, 9, 6], velocity: [3, 4, 0, 0, 0, 12], spin: [0, 0, 2, 0, 0, 4], hit: [1, 3] },
      kinds = [{ diameter: 1, mass: 1, inertia: 0.4 }, { diameter: 2, mass: 8, inertia: 0.4 }],
      about = {},
      state = { time: 5, box: [10, 8, 6], temperature: 2, rotationalTemperature: 0 },
      view = new m.picture.Picture(grains, kinds, about),
      of = (by, more) => view.of(state, grains, { by, ...more });
    assert.deepStrictEqual([Array.from(about.species), about.diameters], [[0, 1], [1, 2]]);
    view.fix(state, grains, kinds, 1);
    /* full scale: twice the root mean square; on each side 2.2 times that along x, with the flow y - 4 */
    const fast = Math.sqrt((25 + 144) / 2),
      turn = Math.sqrt((4 + 16) / 2),
      along = 2.2 * Math.sqrt((1 + 25) / 2);
    near(of("speed").value, [5 / (2 * fast), 12 / (2 * fast)], "speed", 1e-6);
    near(of("spin").value, [2 / (2 * turn), 4 / (2 * turn)], "spin", 1e-6);
    near(of("since", { rate: 0.6 }).value, [(4 * 0.6) / 3, (2 * 0.6) / 3], "since", 1e-6);
    near(of("along", { flow: 1 }).value, [0.5 + 1 / (2 * along), 0.5 + 5 / (2 * along)], "along", 1e-6);
    near(of("origin").value, [0.1, 0.4], "origin", 1e-6);
    near(of("speed", { arrows: true, flow: 1 }).velocity, [1, 4, 0, 5, 0, 12], "arrows", 1e-6);
    near([view.fastest], [2 * Math.max(fast, along / 2.2)]);
    /* over the present speeds, which have halved since the start */
    const slow = { ...grains, velocity: grains.velocity.map((v) => v / 2) };
    near(view.of(state, slow, { by: "speed" }).value, [5 / (4 * fast), 12 / (4 * fast)], "kept", 1e-6);
    near(view.of(state, slow, { by: "speed", follow: true }).value, [5 / (2 * fast), 12 / (2 * fast)], "followed", 1e-6);
    const { one } = of("speed", { grain: 1, flow: 1 });
    assert.deepStrictEqual([one.position, one.velocity, one.spin], [[4, 9, 6], [5, 0, 12], null]);
    /* a quarter rotation about z takes x to y */
    view.marks.set([1, 0, 0, 0, 1, 0]);
    const turned = view.of({ ...state, time: 5 + Math.PI / 4, rotationalTemperature: 1 }, grains, { by: "spin", grain: 0 });
    near(turned.marks, [0, 1, 0, 0, -1, 0], "marks", 1e-6);
    assert.deepStrictEqual(turned.one.spin, [0, 0, 2]);
    /* about x it takes y to z, about y z to x */
    view.marks.set([0, 1, 0, 0, 0, 1]);
    const others = view.of({ ...state, time: 5 + Math.PI / 2, rotationalTemperature: 1 }, { ...grains, spin: [2, 0, 0, 0, 2, 0] }, { by: "spin" });
    near(others.marks, [0, 0, 1, 1, 0, 0], "marks", 1e-6);
    /* smooth grains: spins of equipartition, 3 T/I, I = .4/4 */
    const still = new m.picture.Picture(grains, kinds, {});
    still.fix(state, { ...grains, spin: [0, 0, 0, 0, 0, 0] }, kinds, 0);
    near([still.scale.spin], [Math.sqrt(6 / 0.1)]);
  },
  "the box: x to the right, y up, z to the eye; images slide with the shear": () => {
    const view = new m.box.BoxView(new Element("canvas"), null, null),
      box = [10, 8, 6];
    Object.assign(view, { w: 400, h: 300, yaw: 0, pitch: 0, zoom: 1 });
    view.aim(box, false);
    const middle = view.to(5, 4, 3);
    near(middle.slice(0, 2), [200, 150]);
    const [right, up, close] = [view.to(6, 4, 3), view.to(5, 5, 3), view.to(5, 4, 4)];
    assert.ok(right[0] > 200 && right[1] === middle[1] && up[1] < 150 && up[0] === middle[0] && close[3] > middle[3] && close[2] > middle[2]);
    near([right[0] - 200, 150 - up[1]], [middle[2], middle[2]]);
    view.aim(box, false, [1, -1, 0]); /* a chute at 45 degrees: gravity points down on the screen */
    const [u, down] = view.rotate(1, -1, 0);
    near([u, down], [0, -Math.SQRT2]);
    view.aim(box, true);
    const about = { species: [0, 0], diameters: [1] },
      found = view.collect({ position: [9, 1, 3, 2, 7, 3] }, about, box, 3, true),
      places = [
        [0, 9, 1, false],
        [1, 2, 7, false],
        [0, 2, 9, true] /* above the box, ahead by 3 */,
        [0, 12, 9, true],
        [1, -1, -1, true] /* below it, behind by 3 */,
        [1, 9, -1, true],
      ].map(([i, x, y, image]) => [i, image, ...view.to(x, y, 3).slice(0, 2).map((p) => p.toFixed(3))].join());
    assert.deepStrictEqual(found.map(([x, y, , , i, image]) => [i, image, x.toFixed(3), y.toFixed(3)].join()).sort(), places.sort());
    near([found[0][2]], [found[0] && view.to(5, 4, 3)[2] / 2], "radius", 1e-9);
  },
  "beside the box: clock, thermometer, collision, followed grain, with units": () => {
    const { store } = m.state,
      about = { values: VALUES, title: "A gas", fast: 3, species: [0], diameters: [1] };
    Object.assign(m.show.parts, { view: { draw() {} } });
    byId("thermometer").append(new Element("div"), new Element("output"));
    byId("thermometer").firstChild.append(new Element("div"), new Element("div"));
    store.state = { ...m.state.initial, gas: { about, history: new m.history.TemperatureHistory(false) }, grain: 4, means: { md: { results: { temperature: { mean: 2.5, stderr: 0.1 } } } } };
    m.gas.now.frame = {
      md: { ...row(12.345, 6.78, 2.5, 1.25), box: [1, 1, 1] },
      picture: { one: { velocity: [1, -2, 2], spin: [0.5, 0, 0] } },
      event: { grain: [6, 8], normalSpeed: 0.4567 },
    };
    m.show.drawFrame(0);
    assert.strictEqual(byId("clock").textContent, "time 12.3 1/γ · 6.8 collisions a grain");
    assert.strictEqual(byId("event").textContent, "Grains 7 and 9 collided at 0.457 d γ. Of the energy of this approach 36 % is lost.");
    assert.strictEqual(byId("grain").textContent, "Grain 5: v 3 d γ (1.00, −2.00, 2.00) · ω 0.5 γ (0.50, 0.00, 0.00)");
    const [tube, text] = byId("thermometer").children;
    assert.deepStrictEqual([text.textContent, tube.firstChild.style.height, tube.lastChild.style.bottom], ["T\n2.5\nd² γ²\nθ\n1.25", "80%", "40%"]);
    assert.match(m.show.describe(), /^A gas\. After 6\.78 collisions a grain T is 2\.5 and θ is 1\.25\. grains: temperature T 2\.50\(10\)\./);
    m.gas.now.frame = null;
    store.state = m.state.initial;
  },
  "states come from the engines' numbers, courses of a result from its engines and quantities": async () => {
    const HEAPF64 = Float64Array.from({ length: 30 }, (_, i) => i - 2),
      g = await m.engines.openEngines(async () => ({ HEAPF64, UTF8ToString: String, _gg_version: () => 1, _page_simulation_new: () => 8, _page_state: () => 16 })),
      state = new g.Simulation({ at: 8 }).state();
    assert.deepStrictEqual(state, { time: 0, collisions: 1, collisionsPerGrain: 2, grains: 3, temperature: 4, rotationalTemperature: 5, strain: 6, imageOffset: 7, box: [8, 9, 10], kineticStress: [[11, 12, 13], [14, 15, 16], [17, 18, 19]] });
    const file = { history: (engine, quantity) => `${engine} ${quantity}`, document: () => ({}), free() {} },
      { courses } = m.replay.readResult({ withFile: () => ({ answer: file, gone() {} }) }, null);
    assert.deepStrictEqual(courses, { md: { T: "md temperature", theta: "md rotational_temperature" }, dsmc: { T: "dsmc temperature", theta: "dsmc rotational_temperature" } });
    const ghosts = ["a", "b", "c", "d", "c"].reduce((s, label, i) => m.state.reduce(s, { type: "ghost", ghost: { label, i } }), m.state.initial).ghosts;
    assert.deepStrictEqual(ghosts.map(({ label, i }) => [label, i]), [["c", 4], ["d", 3], ["b", 1]]);
  },
  "warnings begin where the model stops being true": () => {
    const told = (frame, means, flow = "hcs") => {
      m.gas.now.frame = { md: { box: [10, 20, 10], grains: 1200, temperature: 2, rotationalTemperature: 1, ...frame } };
      const all = m.warnings.allWarnings({ gas: { about: { values: { ...VALUES, flow, run: {} } } }, means: { progress: {}, ...means }, player: null });
      m.gas.now.frame = null;
      return all.join();
    };
    assert.strictEqual(told({}, { md: null, dsmc: null }, "usf"), ""); /* before the first means */
    const length = (l) => ({ theory: { goldhirsch_zanetti1993: { clustering_length: { mean: l } } } }),
      ratio = (r) => ({ md: { results: { temperature_ratio: { mean: r } } } }),
      caught = (n, all) => ({ md: { engine_state: { contact_time_collisions: n }, total: { collisions: all } } });
    assert.deepStrictEqual([told({}, length(19.5)), told({}, length(20.5)), told({}, length(19.5), "usf")].map((one) => /longer than/.test(one)), [true, false, false]);
    /* four standard errors of theta/T of 1200 grains: 4 x sqrt(4/3600) = .133 */
    assert.deepStrictEqual([0.5, 0.5 / 1.12, 0.5 / 1.15, 0.5 / 0.89, 0.5 / 0.85].map((r) => /not steady/.test(told({}, ratio(r), "usf"))), [false, false, true, false, true]);
    assert.deepStrictEqual([[101, "hcs"], [99, "hcs"], [1001, "usf"], [999, "usf"]].map(([n, flow]) => /inelastic/.test(told({}, caught(n, 1e6), flow))), [true, false, true, false]);
  },
  "the gas that is seen: time by collisions, Monte Carlo to the same time": () => {
    const { LiveGas, flowOf, shownState } = m.live,
      requested = [],
      engine = (name, time) => ({ advance: (dt) => requested.push([name, dt]) && true, state: () => ({ time, collisionsPerGrain: time, grains: 9, temperature: 5, box: [1, 7, 1] }), grains: () => null, localTemperature: (n, high) => n * 100 + high }),
      gas = Object.assign(Object.create(LiveGas.prototype), { md: engine("md", 8), dsmc: engine("dsmc", 5.5), since: { time: 6, collisionsPerGrain: 4 }, rate: 1, startRate: 4, about: { values: { flow: "usf" } }, view: { of: () => null } });
    const frame = gas.frame({ collisions: 2 });
    assert.deepStrictEqual(requested, [["md", 0.5], ["dsmc", 2.5]]);
    assert.deepStrictEqual([frame.timeScale, frame.rate, gas.since.time], [1 / 4, 2, 8]);
    assert.deepStrictEqual(["usf", "small_shear", "couette", "hcs"].map((flow) => flowOf({ flow })), [1, 1, 0, 0]);
    assert.deepStrictEqual(["couette", "usf"].map((flow) => shownState(gas.md, gas.md.state(), { flow }).temperature), [907, 5]);
    const { COOLING_TIMES: time } = m.measuring;
    near([time[0], time[12], time[119], time[120], time[122], time[time.length - 1]], [1e-4, 1e-3, 10 ** (119 / 12 - 4), 1e6, 1e7, 1e300]);
  },
};

modules(["box", "charts", "colours", "controls", "engines", "gas", "history", "lessons", "link", "live", "measuring", "picture", "points", "replay", "save", "show", "state", "table", "warnings", "words", "worker_rpc"]).then((all) => {
  m = all;
  return list(parts, null);
});
