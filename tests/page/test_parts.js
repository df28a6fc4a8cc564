/* Parts of the page that need no browser, in node: scales of diagrams, what is kept of the past, texts of numbers, links.
 */
"use strict";
const assert = require("assert"),
  fs = require("fs"),
  path = require("path"),
  { list } = require("./tap.js");

/* Those names of these files of the page, with what the browser would give them. */
function parts(files, names, given = {}) {
  const folder = path.resolve(__dirname, "../../src/page"),
    source = files.map((name) => fs.readFileSync(path.join(folder, name), "utf8")).join("\n");
  return new Function(...Object.keys(given), `"use strict";${source}\nreturn { ${names} };`)(...Object.values(given));
}
const drawing = (names) => parts(["plot.js", "curves.js", "table.js"], names, { page: {}, t: (key) => key });

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
  "the past of a gas that cools for ever": () => {
    const { Past } = drawing(["Past"]),
      past = new Past(true),
      at = (time, temperature) => ({ time, temperature, rotationalTemperature: 0, collisionsPerGrain: 1 });
    for (const [time, T] of [
      [0, 1],
      [1, 1],
      [1e100, 1e-200],
      [1e200, 1e-310],
      [1.7e308, 1e-299],
      [Infinity, 0],
    ])
      past.add(at(time, T), null);
    assert.deepStrictEqual(past.column("time"), [1, 1e100]);
  },
};

list(tests, null);
