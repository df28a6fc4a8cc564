/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Speed of the page, and growth of its memory, in headless Chromium: numbers, no test. Each start of a lesson has a
 * fresh tab. PAGE: the page; PAGE_SECONDS: how long its memory is recorded (600). Arguments: some of starts, frames,
 * memory. */
"use strict";
const { Browser } = require("./chromium.js");
const file = process.env.PAGE,
  seconds = +(process.env.PAGE_SECONDS || 600),
  wait = (s) => new Promise((r) => setTimeout(r, 1000 * s)),
  link = (scene) => `#scene=${encodeURIComponent(scene)}`,
  GAS = "{flow: usf, phi: 0.1, particles: 1000, collision: {e: 0.9}}";

const median = (list) => [...list].sort((a, b) => a - b)[Math.floor(list.length / 2)];
const say = (name, value, unit) => console.log(`${name.padEnd(52)} ${String(value).padStart(9)} ${unit}`);

/* Milliseconds since the tab opened its address. */
async function starts(browser) {
  const found = [];
  for (let k = 0; k < 5; k++) {
    const tab = await browser.open(file, { hash: "#lesson=haff" });
    found.push(
      await tab.value(`new Promise((done) => { const at = {}, tick = () => { const g = globalThis.graingas;
        if (g && g.workers.live && !at.made) at.made = performance.now();
        if (g && document.getElementById("version").textContent && !at.open) at.open = performance.now();
        if (g && g.parts.view && g.parts.view.last && g.now.frames > 0) done([at.made, at.open - at.made, performance.now()]); else setTimeout(tick, 1); };
        tick(); })`),
    );
    await tab.close();
  }
  const of = (k) => median(found.map((one) => one[k])).toFixed(0);
  say("script, page unpacked", of(0), "ms");
  say("worker start (engines compiled)", of(1), "ms");
  say("first frame, from the address", of(2), "ms");
}

/* Number of drawn frames, and time to draw one. */
async function frames(browser, name, hash) {
  const tab = await browser.open(file, { hash });
  await tab.until("globalThis.graingas && graingas.now.frames > 10", 60);
  const [rate, cost] = await tab.value(`(async () => { const { view } = graingas.parts, draw = view.draw.bind(view), costs = [];
    view.draw = (...a) => { const from = performance.now(); draw(...a); costs.push(performance.now() - from); };
    const from = performance.now(); await new Promise((r) => setTimeout(r, 8000));
    return [costs.length / (performance.now() - from) * 1000, costs.sort((a, b) => a - b)[costs.length >> 1]]; })()`);
  say(`frames a second: ${name}`, rate.toFixed(1), "");
  say(`drawing one: ${name}`, cost.toFixed(2), "ms");
  await tab.close();
}

async function memory(browser) {
  const tab = await browser.open(file, { hash: `${link(GAS.replace("}}", "}, run: {relative_error: 0.0001}}"))}&speed=30` });
  const used = async () => {
    await tab.send("HeapProfiler.collectGarbage");
    const { usedSize } = await tab.send("Runtime.getHeapUsage");
    return [usedSize, ...(await Promise.all(["live", "measure"].map((who) => tab.value(`graingas.workers.${who}.request("memory").then((a) => a.bytes)`))))].map((b) => (b / 1e6).toFixed(1)).join(", ");
  };
  await tab.until("globalThis.graingas && graingas.store.state.means && graingas.store.state.means.md", 120);
  for (let k = 0; k <= 4; k++) {
    if (k) await wait(seconds / 4);
    say(`memory after ${((k * seconds) / 4).toFixed(0)} s: page, live, measuring`, await used(), "MB");
  }
  await tab.close();
}

const PARTS = {
  starts,
  frames: async (browser) => {
    await frames(browser, "1000 grains, sheared", link(GAS));
    await frames(browser, "1000 grains, sheared, measuring done", link(GAS.replace("}}", "}, run: {collisions: 20, warmup: 5}}")));
    await frames(browser, "1000 grains, arrows, a trail", `${link(GAS)}&arrows=1&grain=1`);
    await frames(browser, "4000 grains", link(GAS.replace("1000", "4000")));
  },
  memory,
};
(async () => {
  const browser = new Browser(),
    wanted = process.argv.slice(2);
  try {
    for (const [name, part] of Object.entries(PARTS)) if (!wanted.length || wanted.includes(name)) await part(browser);
  } finally {
    await browser.close();
  }
})();
