/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Parts of the page that need no browser, in node: the state, scales of diagrams, the stored history, texts of
 * numbers, links, points, languages. */
"use strict";
const assert = require("assert");
const { list } = require("./tap.js"),
  { modules, imports, strings, texts, languages } = require("./modules.js");

const NAMES = ["chart", "charts", "controls", "files", "gas", "history", "lessons", "link", "live", "measuring", "points", "save", "state", "theories", "warnings", "words", "worker_rpc"];
globalThis.navigator ||= { language: "en" };
let m;

const ABOUT = { values: { flow: "hcs", phi: 0.1, collision: { e: 0.9, beta: -1, mu: "inf" }, run: { seed: 1 }, particles: 100 }, brief: "{flow: hcs, phi: 0.1}", title: "", yaml: "" };
const gasOf = (id, about = ABOUT, more = {}) => ({ id, scene: about.brief, sets: {}, lesson: null, about, history: new m.history.TemperatureHistory(true), ...more });
const reduce = (state, type, more) => m.state.reduce(state, { type, ...more });

const tests = {
  "modules import one another in no circle": () => {
    const of = imports(),
      visit = (name, above) => {
        assert.ok(!above.includes(name), `${[...above, name].join(" -> ")}`);
        if (!visited.has(name)) for (const next of of[name]) visit(next, [...above, name]);
        visited.add(name);
      },
      visited = new Set();
    assert.ok(of.gas.includes("points"));
    for (const name of Object.keys(of)) visit(name, []);
  },
  "one writer: late answers, refusals, edits": () => {
    let s = m.state.initial;
    s = reduce(s, "request", { requested: { id: 1, scene: "a", sets: {} } });
    s = reduce(s, "started", { gas: gasOf(1) });
    /* two requests; after the first answer the second is still pending */
    s = reduce(s, "request", { requested: { id: 2, scene: "b", sets: {} } });
    s = reduce(s, "request", { requested: { id: 3, scene: "b", sets: { phi: "0.2" } } });
    s = reduce(s, "started", { gas: gasOf(2) });
    assert.deepStrictEqual([s.gas.id, s.requested.id, s.requested.sets], [2, 3, { phi: "0.2" }]);
    /* rejected: the present gas is again the wanted one, and the banner gives the reason */
    s = reduce(s, "refused", { text: "no", keys: ["phi"] });
    assert.deepStrictEqual([s.gas.id, s.requested.scene, s.requested.sets, s.banner.text, s.refusedKeys], [2, ABOUT.brief, {}, "no", ["phi"]]);
    /* means of another gas are dropped */
    assert.strictEqual(reduce(s, "means", { id: 1, means: {} }), s);
    assert.deepStrictEqual(reduce(s, "means", { id: 2, means: { x: 1 } }).means, { x: 1 });
  },
  "a result that is played leaves the gas as it was": () => {
    let s = reduce(m.state.initial, "started", { gas: gasOf(1), change: { lesson: "haff", chart: "stress", playing: false } });
    s = reduce(s, "means", { id: 1, means: { of: 1 } });
    s = reduce(s, "play", { player: { name: "a.h5" }, gas: gasOf(2), change: { playing: true, chart: "temperature" } });
    s = reduce(s, "play", { player: { name: "b.h5" }, gas: gasOf(3), change: {} });
    s = reduce(s, "means", { id: 1, means: { of: 2 } });
    assert.deepStrictEqual([s.lesson, s.means, s.shelf.means], [null, null, { of: 2 }]);
    s = reduce(s, "back", { id: 4 });
    assert.deepStrictEqual([s.gas.id, s.lesson, s.chart, s.playing, s.means, s.player, s.requested.id], [1, "haff", "stress", false, { of: 2 }, null, 4]);
  },
  "who listens hears each change once, though listeners change more": () => {
    const store = new m.state.Store(),
      seen = [];
    store.subscribe((s, before) => {
      seen.push([before.speed, s.speed]);
      if (s.speed === 3) store.look({ speed: 10 });
    });
    store.look({ speed: 3 });
    assert.deepStrictEqual(seen, [
      [1, 3],
      [3, 10],
    ]);
  },
  "axes of gases that cool for ever": () => {
    const { ticks, range } = m.chart;
    for (const [from, to] of [
      [1, Infinity],
      [0, 1],
      [NaN, NaN],
    ])
      assert.deepStrictEqual(ticks(from, to, true), []);
    const [a, b] = range([5e-324, 1e-308, 1e-299, 1, 1e299, 1.79e308], true),
      marks = ticks(a, b, true);
    assert.ok(a > 5e-300 && b < 2e299 && marks.length > 3 && marks.length < 9, `${a} to ${b}: ${marks}`);
    assert.ok(ticks(1e17, 1e17 + 64, false).length < 13);
    assert.deepStrictEqual(ticks(0, 1, false), [0, 0.2, 0.4, 0.6000000000000001, 0.8, 1]);
    assert.deepStrictEqual([1e-15, 2e5, 0.25, -0.5, 0].map((x) => m.chart.nice(x)), ["10⁻¹⁵", "2·10⁵", "0.25", "−0.5", "0"]);
    assert.deepStrictEqual(m.chart.labels([1.824, 1.826, 1.828]), ["1.824", "1.826", "1.828"]);
    assert.deepStrictEqual(m.chart.labels([0, 0.2, 0.4, 0.6000000000000001]), ["0", "0.2", "0.4", "0.6"]);
  },
  "the history of a gas that cools for ever": () => {
    const history = new m.history.TemperatureHistory(true),
      at = (time, temperature) => ({ time, temperature, rotationalTemperature: 0, collisionsPerGrain: 1 });
    for (const [time, T] of [
      [0, 1],
      [1, 1],
      [1e100, 1e-200],
      [1e200, 1e-310],
      [1.7e308, 1e-299],
      [Infinity, 0],
    ])
      history.add(at(time, T), null);
    assert.deepStrictEqual(history.column("time"), [1, 1e100]);
  },
  "the history is bounded": () => {
    const history = new m.history.TemperatureHistory(false);
    for (let k = 0; k < 20000; k++) {
      history.add({ time: k, temperature: 1, rotationalTemperature: 0, collisionsPerGrain: k / 10 }, null);
      history.addDistance(k / 10, 1e-10);
    }
    assert.ok(history.rows.length <= 480 && history.far.x.length <= 600 && history.far.x.length === history.far.y.length);
    assert.ok(history.far.x[history.far.x.length - 1] > 1900);
  },
  "lines of theories go as far as the gas": () => {
    const { COOLING_TIMES: time } = m.measuring,
      means = { cooling: { time, T: { haff1983: time.map((t) => (1 + t) ** -2) } }, theories: { haff1983: {} }, theory: {} };
    for (const last of [1e-3, 40, 1e7, 3e80, 9e299]) {
      const [{ x, y }] = m.charts.coolingLines(means, [0, 1e-4, last]);
      assert.ok(x[x.length - 1] >= last && x[x.length - 1] <= 1.31 * last, `${last}: to ${x[x.length - 1]}`);
      if (last < 1e100) assert.ok(Math.abs(y[y.length - 1] * (1 + x[x.length - 1]) ** 2 - 1) < 1e-3);
    }
  },
  "Monte Carlo that is late is not drawn at the time of md": () => {
    const history = new m.history.TemperatureHistory(false),
      at = (time, temperature) => ({ time, temperature, rotationalTemperature: 0, collisionsPerGrain: time });
    history.add(at(1, 2), at(1.01, 3));
    history.add(at(2, 2), at(1.5, 3));
    history.add(null, at(3, 4));
    assert.deepStrictEqual(history.column("T2"), [3, NaN, 4]);
    assert.deepStrictEqual(history.column("T"), [2, 2, NaN]);
  },
  "a gas whose Monte Carlo lags is behind": () => {
    const { LiveGas } = m.live,
      engine = (time, done) => ({
        advance: () => done,
        state: () => ({ time, collisionsPerGrain: 0, grains: 9 }),
        grains: () => null,
      });
    const behind = (md, dsmc) => {
      const gas = Object.create(LiveGas.prototype),
        since = { time: 0, collisionsPerGrain: 0 };
      Object.assign(gas, { md, dsmc, since, startRate: 1, about: { values: { flow: "usf" } }, view: { of: () => null } });
      return gas.frame({ collisions: 1 }).behind;
    };
    assert.strictEqual(behind(engine(2, true), engine(1, true)), false);
    assert.strictEqual(behind(engine(2, true), engine(1, false)), true);
    assert.strictEqual(behind(engine(2, false), engine(2, true)), true);
  },
  "time is physical: a gas that collides less often comes as far": () => {
    const requested = [],
      gas = Object.create(m.live.LiveGas.prototype),
      md = { advance: (time) => requested.push(time) && true, state: () => ({ time: 0, collisionsPerGrain: 0, grains: 9 }), grains: () => null };
    Object.assign(gas, { md, since: { time: 0, collisionsPerGrain: 0 }, rate: 0.1, startRate: 2, about: { values: { flow: "hcs" } }, view: { of: () => null } });
    gas.frame({ collisions: 1 });
    gas.frame({ collisions: 1, follow: true });
    assert.deepStrictEqual(requested, [0.5, 10]);
  },
  "a worker that fails tells whoever waits": async () => {
    globalThis.Worker = class {
      postMessage() {}
    };
    const client = new m.worker_rpc.WorkerClient("source"),
      waiting = client.request("frame");
    client.worker.onerror({ message: "out of memory" });
    await assert.rejects(waiting, /out of memory/);
    await assert.rejects(client.request("frame"), /out of memory/);
  },
  "errors that are not known, and those of what is conserved": () => {
    const { withError } = m.words,
      of = (mean, stderr) => withError(mean, m.theories.error({ q: { mean, stderr } }, "q"));
    assert.strictEqual(of(1.23456, null), "1.23(?)");
    assert.strictEqual(of(1.2345678, 1e-12), "1.23457");
    assert.strictEqual(of(2, 0), "2");
    assert.strictEqual(of(0.1388, 0.0004), "0.13880(40)");
  },
  "names of theories and units as people write them": () => {
    const { theoryName, typeset } = m.words;
    assert.deepStrictEqual(["haff1983", "garzo_dufty1999", "garzo_santos_montanero2007", "lun1991_lun_savage", "enskog_hermite"].map(theoryName), [
      "Haff's law, 1983",
      "Garzó & Dufty 1999",
      "Garzó, Santos & Montanero 2007",
      "Lun 1991 (lun, savage)",
      "Enskog's equation, solved",
    ]);
    assert.strictEqual(typeset("rho_p d^2 gamma^2"), "ρₚ\u202fd²\u202fγ²");
  },
  "a collapse is told by contacts and collisions of the same time": () => {
    const told = (caught, collisions, since) => {
      const md = { collisions, total: { collisions: since }, engine_state: { contact_time_collisions: caught }, results: {} };
      return m.warnings.allWarnings({ gas: { about: { values: { flow: "usf" } } }, means: { md, progress: {} }, player: null }).some((one) => /inelastic collapse/.test(one));
    };
    assert.strictEqual(told(500, 1e3, 1e6), false);
    assert.strictEqual(told(2000, 1e6, 1e6), true);
  },
  "units of time": () => {
    const unit = (flow, phi) => m.charts.timeUnit({ flow, phi });
    assert.deepStrictEqual([unit("usf", 0), unit("couette", 0.1), unit("hcs", 0.1), unit("hcs", 0)], ["1/γ", "1/γ", "d/v₀", "1/(n d² v₀)"]);
  },
  "a link says what differs, and is read back": () => {
    const { linkOf, readLink } = m.link,
      look = (name) => m.gas.lookOf(m.lessons.lessonOf(name)),
      lesson = (name, more = {}, sets = {}) => ({ ...m.state.initial, ...look(name), lesson: name, gas: { sets, about: ABOUT }, ...more });
    assert.strictEqual(linkOf(lesson("temperature"), "en"), "");
    assert.strictEqual(linkOf(lesson("haff", {}, { "collision.e": "0.8", "run.seed": "7" }), "en"), "#lesson=haff&set=collision.e=0.8&seed=7");
    const own = { ...m.state.initial, lesson: null, gas: { sets: {}, about: ABOUT }, language: "de", colour: "along", camera: [0, 1, 2], playing: false, view: "box" };
    const link = linkOf(own, "en"),
      read = readLink({ hash: link, search: "" });
    assert.strictEqual(link, "#scene={flow:+hcs,+phi:+0.1}&view=box&colour=along&camera=0,1,2&playing=0&language=de");
    assert.deepStrictEqual([read.scene, read.language, read.look], [ABOUT.brief, "de", { view: "box", colour: "along", camera: [0, 1, 2], playing: false }]);
    /* nonsense is no part of the state */
    assert.deepStrictEqual(readLink({ hash: "#colour=__proto__&camera=1,2&speed=-1&view=xx&language=constructor", search: "" }).look, {});
    assert.strictEqual(readLink({ hash: "#language=constructor", search: "" }).language, null);
  },
  "wrong names of lessons": () => {
    const { nearestLesson } = m.lessons;
    assert.deepStrictEqual(["haf", "Clusterings", "chaos2", "nonsense"].map(nearestLesson), ["haff", "clustering", "chaos", null]);
  },
  "a scene that is to be followed in time has a warning: the page does not follow it": () => {
    const of = (duration, player = null) => m.warnings.allWarnings({ gas: gasOf(1, { ...ABOUT, values: { ...ABOUT.values, run: { seed: 1, duration } } }), means: null, player });
    assert.deepStrictEqual([of("none"), of(5, { frames: 2 })], [[], []]);
    assert.match(of(5).join(), /run\.duration/);
  },
  "points go to a table and come back": () => {
    const point = { slider: "e", x: 0.8, seed: 3, from: "", md: { N1: [0.5, 0.01] }, dsmc: { N1: [0.52, 0.02], temperature: [1.5, 0.1] } };
    const text = m.points.pointsCsv([point]),
      [head] = text.split("\n");
    assert.match(head, /^slider,value,seed,md_N1,md_N1_error,dsmc_temperature,/);
    const [read] = m.points.pointsOf(text, "class.csv");
    assert.deepStrictEqual([read.x, read.md, read.dsmc, read.from], [0.8, { N1: [0.5, 0.01] }, { N1: [0.52, 0.02], temperature: [1.5, 0.1] }, "class"]);
    assert.deepStrictEqual(m.points.pointsOf("a,b\n1,2\n", "x.csv"), []);
    /* a text that a spreadsheet would compute is not read as a seed, and is written as a text; numbers are numbers */
    for (const bad of ["=cmd|' /C calc'!A0", "+1+1", "-1+1", "@SUM(A1)", "1e3", "\t=1"]) {
      assert.strictEqual(m.points.pointsOf(text.replace(",3,", `,${bad},`), "class.csv")[0].seed, "", bad);
      const [, row] = m.points.pointsCsv([{ ...point, seed: bad }]).split("\n");
      assert.strictEqual(row.split(",")[2], (/^1/.test(bad) ? "" : "'") + bad);
    }
    assert.strictEqual(m.points.pointsOf(text, "class.csv")[0].seed, "3");
    assert.match(m.points.pointsCsv([{ ...point, from: '=1,"x"', md: { N1: [-0.5, 0.01] } }]), /^e,0\.8,3,-0\.5,0\.01,.*,"'=1,""x"""$/m);
  },
  "points go into a link and come back": () => {
    const { pointsText, pointsFrom, tidyName } = m.points,
      point = (x, md, dsmc) => ({ slider: "e", x, from: "", md: md ? { N1: md } : {}, dsmc: dsmc ? { N1: dsmc } : {} });
    const text = pointsText({ points: [point(0.9, [0.512345678, 0.0123], [0.5, 0.001]), point(0.8, [0.4, 0.01]), point(0.7, null, [0.3, 0.02]), { ...point(0.6), from: "other" }], slider: "e", quantity: "N1" }, "=Ann; <b>");
    const [who, device] = text.split(";")[0].split("~");
    assert.match(device, /^[0-9a-z]{1,8}$/);
    assert.strictEqual(text.replace(`~${device}`, ""), "Ann b;e;N1;0.9,0.51235,0.012,0.5,0.001;0.8,0.4,0.01;0.7,,,0.3,0.02");
    assert.deepStrictEqual(pointsFrom(text).map((one) => [one.from, one.x, one.md.N1, one.dsmc.N1]), [
      [`${who}~${device}`, 0.9, [0.51235, 0.012], [0.5, 0.001]],
      [`${who}~${device}`, 0.8, [0.4, 0.01], undefined],
      [`${who}~${device}`, 0.7, undefined, [0.3, 0.02]],
    ]);
    /* two students of one name stay two, one who shares again stays one, also in a table */
    const anns = ["Ann~a1", "Ann~b2", "Ann~a1", "Ann"].flatMap((from, i) => pointsFrom(`${from};e;N1;0.${i + 5},1,0.1`)),
      gathered = anns.reduce((s, one) => reduce(s, "gather", { points: [one] }), m.state.initial).points,
      students = m.points.studentsOf(gathered);
    assert.deepStrictEqual(gathered.map((one) => [one.from, one.x]), [["Ann~b2", 0.6], ["Ann~a1", 0.7], ["Ann", 0.8]]);
    assert.deepStrictEqual(students.map((one) => m.points.shownName(one, students)), ["Ann", "Ann 2", "Ann 3"]);
    assert.deepStrictEqual(m.points.studentsOf(m.points.pointsOf(m.points.pointsCsv(gathered), "all.csv")), students);
    assert.deepStrictEqual(m.points.pointsTexts({ points: gathered, slider: "e", quantity: "N1" }, "").map((one) => one.split(";")[0]), students);
    assert.deepStrictEqual(pointsFrom("Ann~<b>;e;N1;0.5,1,0.1").map((one) => one.from), ["Ann b"]);
    assert.deepStrictEqual(m.link.pointsIn(`x.html#lesson=haff&points=${encodeURIComponent(text)} nonsense`), [text]);
    for (const bad of ["", ";e;N1;1,2,3", "Ann;e;nothing;1,2,3", "Ann;constructor;N1;1,2,3", "Ann;seed;N1;1,2,3", "Ann;e;N1;x,2,3", "Ann;e;N1;1,,", "Ann;e;__proto__;1,2,3"]) assert.deepStrictEqual(pointsFrom(bad), [], bad);
    /* values that no measurement gives would squeeze the diagram */
    for (const bad of ["1e300,1e300,1", "0.9,1e300,1", "0.9,1e999,1", "-0.1,1,1", "1.1,1,1", "0.9,-1e9,1", "Infinity,1,1", "0.9,0.5,1e999", "0.9,0.5,1e300"])
      assert.deepStrictEqual([pointsFrom(`Eve;e;N1;${bad}`), m.points.pointsOf(`slider,value,seed,md_N1,md_N1_error\ne,${bad.replace(",", ",1,")}\n`, "Eve.csv")], [[], []], bad);
    assert.deepStrictEqual(pointsFrom("Eve;e;N1;0.9,1e999,1,0.5,0.1").map((one) => [one.md, one.dsmc]), [[{}, { N1: [0.5, 0.1] }]]);
    const of = (from) => pointsFrom(`${from};e;N1;0.9,1,0.1`),
      both = reduce(reduce(m.state.initial, "gather", { points: of("Ann") }), "gather", { points: of("Eve") });
    assert.deepStrictEqual(reduce(both, "forgetStudent", { from: "Eve" }).points.map((one) => one.from), ["Ann"]);
    assert.strictEqual(pointsFrom(`Ann;e;N1;${"1,2,3;".repeat(1000)}`).length, 60);
    for (const where of ["https://x/?", "https://x/page.html?lesson=haff&", "https://x/#", "https://x/?a=1#", "https://x/#question=why?&", "#", ""]) assert.deepStrictEqual(m.link.pointsIn(`${where}points=Ann;e;N1;1,2,3`), ["Ann;e;N1;1,2,3"], where);
    assert.deepStrictEqual(["a".repeat(99), "𐐀".repeat(99)].map((one) => [...tidyName(one)].length), [24, 24]);
    assert.deepStrictEqual(["Jose\u0301", "José", "किरण", "\u0301", " \u0301Ann. ", "a\u202eb"].map(tidyName), ["José", "José", "किरण", "", "Ann.", "a b"]);
  },
  "a question is one line of text": () => {
    assert.strictEqual(m.link.tidyQuestion(" a\nb\u202ec\u0000d "), "a b c d");
    assert.strictEqual(m.link.tidyQuestion("x".repeat(1e5)).length, 240);
  },
  "curves as a table: a row a time": () => {
    const history = new m.history.TemperatureHistory(false);
    for (const k of [1, 2]) history.add({ time: k, temperature: 3 * k, rotationalTemperature: 0, collisionsPerGrain: k }, null);
    const means = { md: { curves: { P: { x_name: "C", x: [0, 1], value: [1, null], stderr: [0.1, null] } } } };
    assert.strictEqual(
      m.save.curvesCsv(history, means, "A gas"),
      "# A gas\ntime,collisions_per_grain,md_temperature,md_rotational_temperature\n1,1,3,0\n2,2,6,0\n\nC,md_P,error\n0,1,0.1\n",
    );
  },
  "no language lacks a string, no string is of no use": () => {
    const english = strings("en"),
      all = texts().join("\n");
    assert.deepStrictEqual(languages, ["de", "en", "es"]);
    for (const language of languages) {
      const own = strings(language);
      assert.deepStrictEqual(Object.keys(own).sort(), Object.keys(english).sort(), language);
      for (const [key, text] of Object.entries(own)) {
        assert.ok(typeof text === "string" && text.length > 0, `${language}: ${key}`);
        const holes = (of) => [...of.matchAll(/\{\w+\}/g)].map(String).sort();
        assert.deepStrictEqual(holes(text), holes(english[key]), `${language}: ${key}`);
      }
    }
    for (const [, key] of all.matchAll(/\bt\("(\w+)"|data-(?:t|label)="(\w+)"/g)) if (key) assert.ok(key in english, key);
    for (const [, key] of all.matchAll(/data-(?:t|label)="(\w+)"/g)) assert.ok(key in english, key);
    const made = /^(lesson|flow|thermostat|law|pair|this|other|chart|truth|q|symbol|theory|low|high)_|Of$/;
    for (const key of Object.keys(english)) assert.ok(made.test(key) || new RegExp(`["'.]${key}\\b`).test(all), `${key} is shown nowhere`);
  },
  "a lesson has one question and at most 40 words": () => {
    for (const language of languages) {
      const own = strings(language);
      for (const { name } of m.lessons.LESSONS) {
        const words = `${own[`lesson_${name}_text`]} ${own[`lesson_${name}_question`]}`.split(/\s+/).filter((one) => /[\p{L}\d]/u.test(one));
        assert.ok(words.length <= 40, `${language}, ${name}: ${words.length} words`);
        assert.strictEqual(own[`lesson_${name}_question`].split("?").length, 2, `${language}, ${name}`);
      }
    }
  },
};

modules(NAMES).then((all) => {
  m = all;
  return list(tests, null);
});
