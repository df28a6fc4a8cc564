/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The engines in node and the command agree: states, grains, collisions, means so far, theories, error messages. */
"use strict";
const assert = require("assert"),
  { run, terminal, refusal, resultOf, refusalOf } = require("./tap.js");

const ROUGH = "{flow: usf, phi: 0.2, particles: 500, collision: {e: 0.9, beta: 0}}";
const SHORT =
  "{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.9}, measure: [rheology], run: {collisions: 300, warmup: 50}}";
const near = (a, b, tolerance) => assert.ok(Math.abs(a / b - 1) <= tolerance, `${a} is not ${b}`);

function open(g, yaml) {
  const scene = new g.Scene(yaml),
    simulation = new g.Simulation(scene);
  scene.free();
  return simulation;
}

run({
  "grains are those of the state": (g) => {
    const s = open(g, ROUGH);
    s.collide(5000);
    const state = s.state(),
      grains = s.grains();
    let T = 0;
    for (const v of grains.velocity) T += (v * v) / (3 * grains.n);
    near(T, state.temperature, 1e-12);
    near(state.box[0] * state.box[1] * state.box[2], (500 * Math.PI) / 6 / 0.2, 1e-12);
    for (let i = 0; i < 3 * grains.n; i++) assert.ok(grains.position[i] >= 0 && grains.position[i] < state.box[i % 3]);
    near(state.strain, state.time, 1e-12);
    assert.deepStrictEqual(
      s.species().map((k) => [k.grains, k.diameter, k.mass, k.inertia]),
      [[500, 1, 1, 0.4]],
    );
    s.free();
  },
  "views are no copies, and survive a growing memory": (g) => {
    const s = open(g, ROUGH),
      first = s.grains().position.byteOffset;
    const more = Array.from({ length: 12 }, () => open(g, "{flow: equilibrium, phi: 0.3, particles: 5000}"));
    s.collide(1000);
    assert.strictEqual(s.grains().position.byteOffset, first);
    assert.ok(s.grains().position[0] > 0);
    more.forEach((one) => one.free());
    s.free();
  },
  "one collision with its pair and k": (g) => {
    const s = open(g, ROUGH),
      before = s.state().collisions,
      e = s.step(),
      state = s.state(),
      grains = s.grains();
    assert.strictEqual(state.collisions, before + 1);
    near(Math.hypot(...e.k), 1, 1e-12);
    near(e.k[0] * e.velocity[0] + e.k[1] * e.velocity[1] + e.k[2] * e.velocity[2], e.normalSpeed, 1e-12);
    const apart = [0, 1, 2].map((a) => grains.position[3 * e.grain[1] + a] - grains.position[3 * e.grain[0] + a]);
    const across = Math.round(apart[1] / state.box[1]);
    apart[0] -= across * state.imageOffset;
    const nearest = apart.map((x, a) => x - state.box[a] * Math.round(x / state.box[a]));
    nearest.forEach((x, a) => assert.ok(Math.abs(x - e.k[a]) < 1e-9)); /* the grains touch */
    s.free();
  },
  "slices of time add up to the same trajectory": (g) => {
    const whole = open(g, ROUGH),
      sliced = open(g, ROUGH);
    whole.collide(200000);
    let slices = 1;
    for (let left = 200000; !sliced.collide(left, 5); slices++) left = 200000 - sliced.state().collisions;
    assert.ok(slices > 3);
    assert.strictEqual(sliced.hash(), whole.hash());
    whole.free();
    sliced.free();
  },
  "a session ends where a run does": (g) => {
    const scene = new g.Scene(SHORT),
      session = new g.Session(scene),
      there = g.run(scene).results;
    let pieces = 1,
      seen = 0;
    for (; !session.goOn(3); pieces++) {
      const now = session.result();
      seen += now.results.temperature && now.results.temperature.mean > 0;
      assert.ok(session.progress().fraction <= 1);
    }
    assert.ok(pieces > 3 && seen > 1, `${pieces} pieces, ${seen} with means`);
    const here = session.result().results;
    for (const name of Object.keys(there)) assert.deepStrictEqual(here[name], there[name], name);
    session.free();
    scene.free();
  },
  "means are the terminal's within their errors, theories the same": (g) => {
    const scene = new g.Scene(SHORT),
      comparison = new g.Comparison(scene),
      session = new g.Session(scene);
    while (!session.goOn(1000));
    const here = comparison.take(session).document(),
      there = JSON.parse(terminal(SHORT, "compare", "--json", "--quiet", "--output", "/dev/null", "--picture", "none"));
    for (const name of ["temperature", "pressure", "N1"]) {
      const a = here.md.results[name],
        b = there.md.results[name];
      assert.ok(Math.abs(a.mean - b.mean) <= 4 * Math.hypot(a.stderr, b.stderr), `${name}: ${a.mean} and ${b.mean}`);
    }
    for (const [theory, values] of Object.entries(there.theory))
      for (const [name, value] of Object.entries(values))
        if (value && typeof value.mean === "number" && value.mean !== 0)
          near(here.theory[theory][name].mean, value.mean, 1e-6);
    comparison.free();
    session.free();
    scene.free();
  },
  "refused in the terminal's words": (g) => {
    for (const yaml of [
      "{flow: usf, phi: 0.9}",
      "{flow: usf, phi: 0.3, collision: {e: 2}}",
      "{flow: usf, fi: 0.3}",
      "{flow: <script>, phi: 0.3}",
      "{flow: usf, phi: [",
      "{flow: usf}",
      "{flow: usf, phi: 0.1}\0{flow: hcs}",
      "x".repeat(1 << 20),
    ]) {
      let said = null;
      try {
        new g.Simulation(new g.Scene(yaml));
      } catch (e) {
        said = e;
      }
      assert.ok(said && said.status === 2, yaml.slice(0, 40));
      const words = refusal(yaml, "fingerprint")
        .replace(/standard input|<stdin>|-/g, "")
        .slice(-60)
        .trim();
      assert.ok(said.message.replace(/-/g, "").includes(words.slice(-40)), `${said.message}\n${words}`);
    }
  },
  "the time of each grain's last collision": (g) => {
    for (const yaml of [ROUGH, "{flow: hss, phi: 0.1, particles: 300, thermostat: white_noise, collision: {e: 0.8}}"]) {
      const s = open(g, yaml),
        plain = open(g, yaml);
      s.follow();
      assert.ok(s.grains().hit.every((time) => time === -Infinity));
      assert.strictEqual(plain.grains().hit, null);
      let events = [];
      for (let i = 0; i < 40; i++) events.push(s.step());
      plain.collide(40);
      assert.strictEqual(s.hash(), plain.hash()); /* recording collisions changes nothing */
      const { hit } = s.grains(),
        last = new Map();
      for (const e of events) e.grain.forEach((i) => last.set(i, e.time));
      hit.forEach((time, i) => assert.strictEqual(time, last.has(i) ? last.get(i) : -Infinity));
      assert.strictEqual(events[39].time, s.state().time);
      s.free();
      plain.free();
    }
  },
  "Haff's law is the library's": (g) => {
    const scene = new g.Scene("{flow: hcs, phi: 0.1, particles: 500, collision: {e: 0.9}}"),
      c = new g.Comparison(scene);
    const [start, late, later] = c.cooling("haff1983", [0, 1e6, 2e6]);
    assert.strictEqual(start, c.document().theory.haff1983.temperature.mean);
    near(late / later, 4, 1e-3);
    assert.ok(c.cooling("goldhirsch_zanetti1993", [1]).every(Number.isNaN));
    c.free();
    scene.free();
  },
  "between walls T is about the local mean, as in results": (g) => {
    for (const yaml of [
      "{flow: couette, phi: 0.2, particles: 1000, collision: {e: 0.9}, run: {collisions: 400, warmup: 200}}",
      "{flow: couette, phi: 0.2, particles: 600, collision: {e: 0.9}, species: [{fraction: 0.5}, {fraction: 0.5, diameter: 1, mass: 3}], run: {collisions: 400, warmup: 200}}",
    ]) {
      const scene = new g.Scene(yaml),
        there = g.run(scene).results.temperature.mean,
        s = new g.Simulation(scene);
      s.collide(300 * s.state().grains / 2);
      let T = 0,
        whole = 0;
      for (let k = 0; k < 200; k++) {
        s.collide(s.state().grains);
        T += s.localTemperature(s.state().grains, s.state().box[1]) / 200;
        whole += s.state().temperature / 200;
      }
      near(T, there, 0.06);
      s.free();
      assert.ok(whole > 1.15 * T, `${whole} of whole velocities, ${T} about the mean`);
      scene.free();
    }
    /* frames of a result that is played */
    const { printed, bytes } = resultOf(
      "{flow: couette, phi: 0.2, particles: 500, collision: {e: 0.9}, output: {trajectory_every: 4, after: warmup}, run: {collisions: 300, warmup: 200}}",
    );
    const { answer: t, gone } = g.withFile({ name: "walls.h5", bytes }, (path) => new g.Trajectory(path));
    let T = 0;
    for (let k = 0; k < t.frames; k++) {
      const { state } = t.frame(k);
      T += t.localTemperature(state.grains, state.box[1]) / t.frames;
    }
    near(T, printed.results.temperature.mean, 0.1);
    t.free();
    gone();
  },
  "a result of the terminal": (g) => {
    const scene =
      "{flow: usf, phi: 0.2, particles: 300, collision: {e: 0.9, beta: 0}, output: {trajectory_every: 1}, run: {collisions: 40, warmup: 5}}";
    const { printed, bytes } = resultOf(scene),
      file = { name: "a result.h5", bytes };
    const { answer: t, gone } = g.withFile(file, (path) => new g.Trajectory(path));
    const made = t.scene();
    assert.strictEqual(made.values().particles, 300);
    assert.ok(t.frames > 15);
    let before = -1;
    for (let k = 0; k < t.frames; k++) {
      const { state, grains } = t.frame(k);
      let T = 0;
      for (const v of grains.velocity) T += (v * v) / 900;
      near(T, state.temperature, 1e-12);
      assert.ok(state.time > before && state.rotationalTemperature > 0);
      assert.ok(grains.position.every((x, i) => x >= 0 && x <= state.box[i % 3]));
      before = state.time;
    }
    assert.deepStrictEqual(
      t.species().map((k) => [k.grains, k.diameter]),
      [[300, 1]],
    );
    assert.throws(() => t.frame(t.frames), /there is no frame/);
    const { answer: c, gone: goneToo } = g.withFile(file, (path) => new g.Comparison(path));
    const document = c.document();
    assert.deepStrictEqual(document.md.results.temperature.mean, printed.results.temperature.mean);
    assert.ok(document.theory.lun1991.temperature.mean > 0);
    const { time, value } = c.history("md", "temperature");
    assert.ok(time.length === value.length && time.length > 10 && value.every((T) => T > 0));
    assert.strictEqual(c.history("dsmc", "temperature"), null);
    made.free();
    t.free();
    c.free();
    gone();
    goneToo();
  },
  "a comparison of the terminal": (g) => {
    const { printed, bytes } = resultOf(SHORT, "compare", ["--picture", "none"]);
    const { answer: c, gone } = g.withFile({ name: "both.h5", bytes }, (path) => new g.Comparison(path));
    for (const engine of ["md", "dsmc"])
      assert.strictEqual(c.document()[engine].results.pressure.mean, printed[engine].results.pressure.mean);
    assert.ok(c.history("dsmc", "temperature").value.length > 10);
    c.free();
    gone();
  },
  "files are refused in the terminal's words": (g) => {
    const { bytes } = resultOf(SHORT),
      damaged = Buffer.from(bytes);
    damaged[5000] ^= 1;
    for (const given of [Buffer.alloc(0), Buffer.from("these are no grains"), damaged, bytes.subarray(0, 9000)]) {
      const said = refusalOf(given);
      for (const read of [(path) => new g.Trajectory(path), (path) => new g.Comparison(path)]) {
        let mine = "";
        try {
          g.withFile({ name: "given.h5", bytes: given }, read);
        } catch (e) {
          mine = e.message;
        }
        assert.ok(mine.startsWith("given.h5: ") && said.endsWith(mine), `${mine}\n${said}`);
      }
    }
    const dsmc = resultOf(SHORT.replace("usf", "usf, engine: dsmc, dsmc: {particles: 200}")).bytes;
    assert.throws(() => g.withFile({ name: "d.h5", bytes: dsmc }, (path) => new g.Trajectory(path)), /^GraingasError: d\.h5: .*it holds no positions of grains/);
  },
  "no files": (g) => {
    const names = g.catalogue("flows").map((flow) => flow.name);
    assert.ok(names.includes("usf") && names.includes("chute"));
    assert.strictEqual(g.version, JSON.parse(terminal(ROUGH, "fingerprint", "--collisions", "1", "--json")).graingas);
  },
  "what is freed is given back": (g) => {
    const size = () => process.memoryUsage().arrayBuffers + process.memoryUsage().external;
    const once = () => {
      const s = open(g, ROUGH);
      s.collide(2000);
      s.free();
    };
    for (let i = 0; i < 20; i++) once();
    const before = size();
    for (let i = 0; i < 200; i++) once();
    assert.ok(size() - before < 8 << 20);
  },
});
