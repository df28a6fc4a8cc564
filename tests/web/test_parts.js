/* Parts of the page that need no browser, in node: scales of diagrams, what is kept of the history, texts of numbers, links.
 */
"use strict";
const assert = require("assert"),
  fs = require("fs"),
  path = require("path"),
  { list } = require("./tap.js");

/* Those names of these files of the page, with what the browser would give them. */
function parts(files, names, given = {}) {
  const folder = path.resolve(__dirname, "../../web"),
    source = files.map((name) => fs.readFileSync(path.join(folder, name), "utf8")).join("\n");
  return new Function(...Object.keys(given), `"use strict";${source}\nreturn { ${names} };`)(...Object.values(given));
}
const drawing = (names) => parts(["plot.js", "history.js", "curves.js", "table.js"], names, { page: {}, t: (key) => key });

const tests = {
  "axes of gases that cool for ever": () => {
    const { ticks, range } = drawing(["ticks", "range"]);
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
  },
  "the history of a gas that cools for ever": () => {
    const { TemperatureHistory } = drawing(["TemperatureHistory"]),
      history = new TemperatureHistory(true),
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
  "lines of theories go as far as the gas": () => {
    const { coolingLines } = drawing(["coolingLines"]),
      { COOLING_TIMES: time } = parts(["measuring.js"], ["COOLING_TIMES"]),
      means = { cooling: { time, T: { haff1983: time.map((t) => (1 + t) ** -2) } }, theories: { haff1983: {} }, theory: {} };
    for (const last of [1e-3, 40, 1e7, 3e80, 9e299]) {
      const [{ x, y }] = coolingLines(means, [0, 1e-4, last]);
      assert.ok(x[x.length - 1] >= last && x[x.length - 1] <= 1.31 * last, `${last}: to ${x[x.length - 1]}`);
      if (last < 1e100) assert.ok(Math.abs(y[y.length - 1] * (1 + x[x.length - 1]) ** 2 - 1) < 1e-3);
    }
  },
  "Monte Carlo that is late is not drawn at the time of md": () => {
    const { TemperatureHistory } = drawing(["TemperatureHistory"]),
      history = new TemperatureHistory(false),
      at = (time, temperature) => ({ time, temperature, rotationalTemperature: 0, collisionsPerGrain: time });
    history.add(at(1, 2), at(1.01, 3));
    history.add(at(2, 2), at(1.5, 3));
    history.add(null, at(3, 4));
    assert.deepStrictEqual(history.column("T2"), [3, NaN, 4]);
    assert.deepStrictEqual(history.column("T"), [2, 2, NaN]);
  },
  "a gas whose Monte Carlo lags is behind": () => {
    const { LiveGas } = parts(["live.js"], ["LiveGas"]),
      engine = (time, done) => ({
        advance: () => done,
        state: () => ({ time, collisionsPerGrain: 0, grains: 9 }),
        grains: () => null,
      });
    const behind = (md, dsmc) => {
      const gas = Object.create(LiveGas.prototype),
        since = { time: 0, collisionsPerGrain: 0 };
      Object.assign(gas, { md, dsmc, since, about: { values: { flow: "usf" } }, view: { of: () => null } });
      return gas.frame({ collisions: 1 }).behind;
    };
    assert.strictEqual(behind(engine(2, true), engine(1, true)), false);
    assert.strictEqual(behind(engine(2, true), engine(1, false)), true);
    assert.strictEqual(behind(engine(2, false), engine(2, true)), true);
  },
  "a worker that fails tells whoever waits": async () => {
    class Worker {
      postMessage() {}
    }
    const { WorkerClient } = parts(["worker_rpc.js"], ["WorkerClient"], { Worker }),
      client = new WorkerClient("source"),
      waiting = client.ask("frame");
    client.worker.onerror({ message: "out of memory" });
    await assert.rejects(waiting, /out of memory/);
    await assert.rejects(client.ask("frame"), /out of memory/);
  },
  "what fails while it is measured is told": () => {
    const said = [],
      later = [];
    class Measuring {
      means() {
        return {};
      }
      goOn() {
        throw new Error("broken");
      }
    }
    const { JOBS } = parts(["worker.js"], ["JOBS"], {
      Measuring,
      onmessage: null,
      postMessage: (message) => said.push(message),
      setTimeout: (call) => later.push(call),
      clearTimeout: () => {},
    });
    JOBS.measure({ scene: "", sets: {}, id: 7 });
    later.pop()();
    assert.deepStrictEqual(said, [{ job: "means", id: 7, refused: "broken" }]);
  },
  "errors that are not known, and those of what is conserved": () => {
    const { withError, error } = drawing(["withError", "error"]),
      of = (mean, stderr) => withError(mean, error({ q: { mean, stderr } }, "q"));
    assert.strictEqual(of(1.23456, null), "1.23(?)");
    assert.strictEqual(of(1.2345678, 1e-12), "1.23457");
    assert.strictEqual(of(2, 0), "2");
    assert.strictEqual(of(0.1388, 0.0004), "0.13880(40)");
  },
  "a collapse is told by contacts and collisions of the same time": () => {
    const told = (caught, collisions, since) => {
      const results = {},
        md = { collisions, total: { collisions: since }, engine_state: { contact_time_collisions: caught }, results },
        page = { about: { values: { flow: "usf" } }, means: { md, progress: {} } };
      const { allWarnings } = parts(["curves.js", "warnings.js"], ["allWarnings"], { page, t: (key) => key, MOST_BEHIND: 1 });
      return allWarnings().includes("collapse");
    };
    assert.strictEqual(told(500, 1e3, 1e6), false);
    assert.strictEqual(told(2000, 1e6, 1e6), true);
  },
  "units of time": () => {
    const unit = (flow, phi) =>
      parts(["show.js"], ["timeUnit"], { page: { about: { values: { flow, phi } } } }).timeUnit();
    assert.deepStrictEqual(
      [unit("usf", 0), unit("couette", 0.1), unit("hcs", 0.1), unit("hcs", 0)],
      ["1/γ", "1/γ", "d/v₀", "1/(n d² v₀)"],
    );
  },
  "a link keeps the language": () => {
    const link = (own, language) => {
      const { urlState } = parts(["url_state.js"], ["urlState"], {
        navigator: { language: own },
        LANGUAGES: ["en", "de"],
        language,
      });
      return new URLSearchParams(urlState({ scene: "", sets: { "run.seed": "1" } }).slice(1)).get("language");
    };
    assert.deepStrictEqual([link("en-GB", 0), link("en-GB", 1), link("de-AT", 0), link("de-AT", 1)], [null, "de", "en", "de"]);
  },
};

list(tests, null);
