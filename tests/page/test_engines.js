/* What a page is given is what the library says: states, grains, collisions, means so far, theories, refusals. */
"use strict";
const assert = require("assert"),
  { run, terminal, refusal } = require("./tap.js");

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
    nearest.forEach((x, a) => assert.ok(Math.abs(x - e.k[a]) < 1e-9)); /* they touch */
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
