/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The page in headless Chromium: it loads without messages on the console, and without the network; lessons run;
 * controls act; the same seed gives the same trajectory; hostile input is rejected with the messages of the command. */
"use strict";
const assert = require("assert"),
  fs = require("fs"),
  path = require("path");
const { find, Browser } = require("./chromium.js"),
  { terminal, refusal, resultOf, refusalOf, list } = require("./tap.js"),
  { strings } = require("./modules.js"),
  scenes = require("./scenes.js");

const file = process.env.PAGE,
  quick = 120;
/* Lessons whose means take half a minute: with QUICK their means are not tested. */
const LONG = ["normal_stress", "clustering"];
const LESSONS = Object.keys(strings("en")).filter((key) => /^lesson_.*_question$/.test(key)).map((key) => key.slice(7, -9));
const wait = (ms) => new Promise((r) => setTimeout(r, ms));
let browser;

/* Helper functions in the page. */
const HELPERS = `
  const S = () => graingas.store.state, byId = (id) => document.getElementById(id), now = graingas.now;
  const move = (id, value) => { const c = byId(id); c.value = value;
    c.dispatchEvent(new Event(c.type === "range" ? "input" : "change", { bubbles: true })); };
  const V = () => S().gas.about.values;`;
const READY = "globalThis.graingas && graingas.store.state.gas !== null && graingas.now.frames > 0";

async function open(hash = "", more = {}) {
  const tab = await browser.open(file, { hash, ...more });
  await tab.until(READY, quick);
  await tab.value(`globalThis.T = (() => { ${HELPERS} return { S, byId, move, V }; })(); var { S, byId, move, V } = T, now = graingas.now; 0`);
  return tab;
}
async function silent(tab) {
  assert.deepStrictEqual(tab.said, []);
  assert.deepStrictEqual(
    tab.fetched.filter((url) => !/^(file|blob|data):/.test(url)),
    [],
  );
  await tab.close();
}
const link = (scene) => `#scene=${encodeURIComponent(scene)}`;
const SMALL = link("{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.9}}");
const PLAYED =
  "{flow: usf, phi: 0.2, particles: 300, collision: {e: 0.9, beta: 0}, output: {trajectory_every: 1}, run: {collisions: 40, warmup: 5}}";

/* Delay frames by so many milliseconds, as on a slow machine. */
const slower = (ms) => `{ const { live } = graingas.workers, request = live.request.bind(live); graingas.slower = ${ms};
  live.request = async (job, ...rest) => { const answer = await request(job, ...rest);
    if (job === "frame") await new Promise((r) => setTimeout(r, graingas.slower)); return answer; }; } 0`;

/* Drop a file on the page, as from a folder. */
const drop = (tab, name, bytes) =>
  tab.value(`(() => { const data = new DataTransfer(), bytes = Uint8Array.from(atob("${Buffer.from(bytes).toString("base64")}"), (c) => c.charCodeAt(0));
  data.items.add(new File([bytes], "${name}")); for (const kind of ["dragover", "drop"]) byId("box").dispatchEvent(new DragEvent(kind, { dataTransfer: data, bubbles: true, cancelable: true })); })()`);
const banner = (tab) => tab.value("byId('banner').innerText");

/* How many pixels of a box differ from the dark background, and how many colours they have. */
const drawn = (id) => `(() => { const c = byId("${id}"), copy = document.createElement("canvas"), to = copy.getContext("2d", { willReadFrequently: true });
  copy.width = c.width; copy.height = c.height; to.drawImage(c, 0, 0);
  const p = to.getImageData(0, 0, c.width, c.height).data, seen = new Set(); let n = 0, sum = 0;
  for (let i = 0; i < p.length; i += 4) if (Math.abs(p[i] - 16) + Math.abs(p[i + 1] - 21) + Math.abs(p[i + 2] - 26) > 30) { n++; sum += p[i] - p[i + 2]; seen.add((p[i] >> 4) * 256 + (p[i + 1] >> 4) * 16 + (p[i + 2] >> 4)); }
  return { share: n / (c.width * c.height), colours: seen.size, warm: sum / n }; })()`;

const tests = {
  "loads in silence, draws, measures": async () => {
    const tab = await open();
    assert.deepStrictEqual(await tab.value("[S().lesson, V().flow, V().collision.e]"), ["temperature", "hcs", 1]);
    await tab.until("S().means && S().means.md && S().means.md.results.pressure", quick);
    const { share, colours } = await tab.value(drawn("box"));
    assert.ok(share > 0.1 && share < 0.9 && colours > 20, `${share} of the box, ${colours} colours`);
    assert.ok(await tab.value("byId('table').tBodies[0].rows.length > 3"));
    assert.match(await tab.value("byId('version').textContent"), /graingas \d+\.\d+\.\d+.*\([0-9a-f]{7,}/);
    assert.ok(fs.statSync(file).size < 2e6, `${fs.statSync(file).size} bytes`);
    await silent(tab);
  },

  "a page with a scene in it begins with that": async () => {
    const out = path.join(browser.home, "own.html");
    terminal("{flow: chute, phi: 0.2, particles: 300, collision: {e: 0.8}}", "page", "--page", file, "--quiet", "--output", out);
    const tab = await browser.open(out);
    await tab.until(READY, quick);
    assert.deepStrictEqual(
      await tab.value("(({ flow, particles, collision }) => [flow, particles, collision.e])(graingas.store.state.gas.about.values)"),
      ["chute", 300, 0.8],
    );
    assert.strictEqual(await tab.value("location.hash"), "");
    /* a lesson, and back to the teacher's scene */
    await tab.value("document.getElementById('lesson-temperature').click()");
    await tab.until("location.hash === '#lesson=temperature' && graingas.store.state.lesson === 'temperature'", quick);
    await tab.value("history.back()");
    await tab.until("graingas.store.state.lesson === null && graingas.store.state.gas.about.values.flow === 'chute'", quick);
    await silent(tab);
  },

  "one screen: nothing scrolls on a projector, box, slider and curve share a phone": async () => {
    for (const [width, height] of [
      [1366, 768],
      [1920, 1080],
    ]) {
      const tab = await open("#lesson=haff", { width, height });
      for (const name of LESSONS) {
        await tab.value(`byId("lesson-${name}").click()`);
        await tab.until(`S().lesson === "${name}" && now.frame`, quick);
        const [page, seen, left] = await tab.value("[document.documentElement.scrollHeight, innerHeight, byId('lesson').scrollHeight - byId('lesson').clientHeight]");
        assert.ok(page <= seen && left <= 1, `${name} at ${width}: ${page} of ${seen}, ${left} of the words`);
      }
      await silent(tab);
    }
    for (const language of ["en", "de", "es"]) {
      const tab = await open(`#lesson=haff&language=${language}`, { width: 390, height: 844 });
      for (const name of LESSONS) {
        await tab.value(`byId("lesson-${name}").click()`);
        await tab.until(`S().lesson === "${name}" && now.frame && document.querySelector("#chart [data-name]")`, quick);
        /* the drawn part of the diagram, its axes and their names */
        const places = await tab.value("[byId('box'), byId('main-control'), document.querySelector('#chart svg')].map((one) => { const r = one.getBoundingClientRect(); return [r.top, r.bottom]; })");
        for (const [top, bottom] of places) assert.ok(top >= 0 && bottom <= 844, `${language}, ${name}: ${places.join("; ")}`);
        assert.ok(places[0][1] - places[0][0] > 180 && places[2][1] - places[2][0] > 100, `${language}, ${name}: ${places.join("; ")}`);
        assert.strictEqual(await tab.value("document.documentElement.scrollWidth > innerWidth"), false, `${language}, ${name}`);
        const [left, right] = await tab.value(`(({ left, right }) => [left, right])(byId("lesson-${name}").getBoundingClientRect())`);
        assert.ok(left >= 0 && right <= 390, `${language}, ${name}: its button from ${left} to ${right}`);
      }
      assert.ok(await tab.value("+getComputedStyle(document.querySelector('#chart text')).fontSize.slice(0, -2) * document.querySelector('#chart svg').getScreenCTM().a >= 11"));
      await silent(tab);
    }
  },

  "every lesson runs": async () => {
    const tab = await open("#lesson=haff");
    for (const name of LESSONS.filter((name) => !LONG.includes(name) || !process.env.QUICK)) {
      await tab.value(`byId("lesson-${name}").click()`);
      await tab.until(`S().lesson === "${name}" && now.frame && now.frame.md.collisions > 100 && S().means && (S().means.progress.md || S().means.progress.dsmc)`, quick);
      assert.strictEqual(await banner(tab), "", name);
      assert.ok((await tab.value(drawn("box"))).share > 0.02, name);
      assert.ok(await tab.value("byId('main-control').querySelector('input[type=range]').offsetWidth > 50"), name);
      await tab.until("document.querySelectorAll('#chart [data-name]').length > 0", quick);
    }
    await silent(tab);
  },

  "cooling looks like cooling; the switch follows the gas": async () => {
    const tab = await open(link("{flow: hcs, phi: 0.2, particles: 300, collision: {e: 0.5}}") + "&speed=3&images=0");
    const first = await tab.value(drawn("box")),
      high = await tab.value("parseFloat(document.querySelector('.mercury').style.height)");
    await tab.until("now.frame.md.temperature < 0.05", quick);
    await wait(300);
    const later = await tab.value(drawn("box")),
      low = await tab.value("parseFloat(document.querySelector('.mercury').style.height)");
    assert.ok(later.warm < first.warm - 25, `${first.warm}, then ${later.warm}`);
    assert.ok(low < high / 3, `thermometer ${high}, then ${low}`);
    await tab.value("byId('follow').click()");
    await tab.until("S().follow", quick);
    await wait(1500);
    const followed = await tab.value(drawn("box"));
    assert.ok(followed.warm > later.warm + 25, `${later.warm}, followed ${followed.warm}`);
    await silent(tab);
  },

  "every control acts": async () => {
    const tab = await open(SMALL);
    const set = async (id, value, test) => {
      await tab.value(`move("${id}", "${value}")`);
      await tab.until(test, quick);
    };
    await set("phi", 0.2, "V().phi === 0.2");
    await set("e", 0.8, "V().collision.e === 0.8");
    await set("beta", 0.5, "V().collision.beta === 0.5");
    await tab.value("byId('friction').click()");
    await tab.until("V().collision.mu === 0.3", quick);
    await set("mu", 0.1, "V().collision.mu === 0.1");
    await set("law", "viscoelastic", "V().collision.law === 'viscoelastic'");
    await set("law", "constant", "V().collision.law === 'constant'");
    await tab.value("byId('mixture').click()");
    await tab.until("V().species.length === 2 && V().species[1].mass === 8", quick);
    await set("diameter", 1.5, "V().species[1].diameter === 1.5");
    await set("mass-number", 3, "V().species[1].mass === 3 && V().species[1].diameter === 1.5");
    await tab.until("now.frame && S().gas.about.diameters.length === 2", quick);
    await tab.value("byId('mixture').click()");
    await tab.until("V().species.length === 1", quick);
    await set("particles", 300, "V().particles === 300");
    await set("seed-number", 7, "V().run.seed === 7");
    await set("phi-number", 0.15, "V().phi === 0.15");
    const flows = await tab.value("[...byId('flow').options].map((one) => one.value)");
    for (const flow of flows) await set("flow", flow, `V().flow === "${flow}" && now.frame`);
    /* values that an elastic gas set to 1 are restored */
    await set("flow", "usf", "V().flow === 'usf'");
    await set("e", 0.7, "V().collision.e === 0.7");
    await set("flow", "equilibrium", "V().collision.e === 1 && V().collision.beta === -1");
    await set("flow", "hcs", "V().flow === 'hcs'");
    assert.deepStrictEqual(await tab.value("[V().collision.e, V().collision.beta, V().collision.mu]"), [0.7, 0.5, 0.1]);
    /* rows of particular flows */
    const shown = (id) => tab.value(`!byId("${id}").closest(".control").hidden`);
    assert.deepStrictEqual([await shown("wallE"), await shown("thermostat"), await shown("tilt")], [false, false, false]);
    await set("flow", "hss", "V().flow === 'hss'");
    await set("thermostat", "white_noise", "V().thermostat === 'white_noise'");
    await set("flow", "chute", "V().flow === 'chute'");
    await set("tilt", 30, "Math.abs(V().gravity[0] / V().gravity[1] + Math.tan(Math.PI / 6)) < 1e-4");
    await set("wallE", 0.5, "V().walls.e === 0.5");
    await set("wallBeta", 0, "V().walls.beta === 0");
    /* and from a scene with every key, as in a page that was written with one */
    for (const from of ["hss", "chute"]) {
      await set("flow", from, `V().flow === "${from}" && now.frame`);
      await tab.value("void graingas.start(S().gas.about.yaml, {})");
      await tab.until("Object.keys(S().gas.sets).length === 0 && now.frame", quick);
      for (const flow of flows) await set("flow", flow, `V().flow === "${flow}" && now.frame`);
    }
    assert.strictEqual(await banner(tab), "");
    await set("language", "de", "document.documentElement.lang === 'de' && byId('step').textContent === 'Ein Stoß'");
    await set("colour", "since", "byId('scale-high').textContent === 'lange her'");
    await set("pair", "elastic", "now.frame && now.frame.twin && byId('twin').offsetWidth > 50");
    await silent(tab);
  },

  "changes while a gas is awaited add up": async () => {
    const tab = await open(link("{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.8}}"));
    /* `requested`: resolves when the request is pending, before its answer */
    const sent = `const { live } = graingas.workers, request = live.request.bind(live), requested = () => new Promise((r) => { live.request = (job, ...rest) => { if (job === "start") setTimeout(r, 0); return request(job, ...rest); }; });`;
    await tab.value(`(async () => { ${sent} const first = requested(); move("phi", 0.2); await first; move("e", 0.7); })()`);
    await tab.until("V().collision.e === 0.7", quick);
    assert.strictEqual(await tab.value("V().phi"), 0.2);
    await tab.value(`(async () => { ${sent} const first = requested(); move("phi", 0.15); await first; byId("restart").click(); })()`);
    await tab.until("V().phi === 0.15 && now.frame", quick);
    await wait(500);
    assert.strictEqual(await tab.value("V().phi"), 0.15);
    await tab.value(`move("phi", 0.25); byId("reseed").click()`);
    await tab.until("V().phi === 0.25 && S().gas.sets['run.seed']", quick);
    /* both rows of one key */
    await tab.value("byId('mixture').click()");
    await tab.until("V().species.length === 2", quick);
    await tab.value(`move("diameter", 1.5); move("mass", 3)`);
    await tab.until("V().species[1].mass === 3", quick);
    assert.strictEqual(await tab.value("V().species[1].diameter"), 1.5);
    await tab.value("byId('mixture').click()");
    await tab.until("V().species.length === 1", quick);
    /* over "equilibrium" in the list */
    await tab.value(`move("flow", "equilibrium"); move("flow", "couette")`);
    await tab.until("V().flow === 'couette'", quick);
    assert.strictEqual(await tab.value("V().collision.e"), 0.7);
    /* later changes do not build on a rejected value; the banner at the top shows its message */
    await tab.value(`move("e-number", 7)`);
    await tab.until("byId('banner').textContent.includes('collision.e')", quick);
    assert.ok(await tab.value("byId('banner').getBoundingClientRect().top >= 0 && byId('banner').getBoundingClientRect().bottom < innerHeight / 3"));
    assert.strictEqual(await tab.value("byId('e-number').getAttribute('aria-invalid')"), "true");
    await tab.value(`move("phi", 0.2)`);
    await tab.until("V().phi === 0.2 && byId('banner').textContent === ''", quick);
    await silent(tab);
  },

  "the scene as text is the one that runs": async () => {
    const tab = await open("#scene=" + encodeURIComponent("{flow: usf, phi: 0.1, particles: 200}") + "&set=collision.e=0.8");
    assert.match(await tab.value("byId('yaml').value"), /\n  e: 0\.8\n/);
    await tab.value("byId('own').open = true; byId('yaml').focus(); byId('yaml').value = '{flow: hcs, '; 0");
    await tab.value("void graingas.start(S().gas.scene, { phi: '0.2' })");
    await tab.until("V().phi === 0.2", quick);
    assert.strictEqual(await tab.value("byId('yaml').value"), "{flow: hcs, ");
    await tab.value("byId('use-yaml').focus(); void graingas.start(S().gas.scene, { phi: '0.3' })");
    await tab.until("V().phi === 0.3 && byId('yaml').value.includes('phi: 0.3')", quick);
    await silent(tab);
  },

  "a frame that fails is not the last; a box that is not shown is not drawn": async () => {
    const tab = await open(SMALL);
    const more = "(async () => { const from = now.frames; await new Promise((r) => setTimeout(r, 3000)); return now.frames - from; })()";
    await tab.value("byId('box').style.display = 'none'; 0");
    assert.ok((await tab.value(more)) > 5);
    await tab.value("byId('box').style.display = ''; const view = graingas.parts.view; view.draw = () => { throw new Error('a test'); }; 0");
    await wait(500);
    await tab.value("delete graingas.parts.view.draw; 0");
    assert.ok((await tab.value(more)) > 5);
    assert.ok(tab.said.every((one) => one.includes("a test")), tab.said.join());
    await tab.close();
  },

  "the speed that is shown is kept": async () => {
    const tab = await open(link("{flow: usf, phi: 0.1, particles: 100, collision: {e: 0.9}}"));
    /* answers that take a fifth of a second, as on a slow machine: no time is dropped */
    await tab.value(slower(200));
    const kept = await tab.value(`new Promise((done) => { let from = null;
      const tick = (at) => { const s = now.frame && now.frame.md; if (s && !from && at > 1500) from = [at, s.time];
        if (from && at - from[0] > 6000) done((s.time - from[1]) / now.frame.timeScale / ((at - from[0]) / 1000)); else requestAnimationFrame(tick); };
      requestAnimationFrame(tick); })`);
    assert.ok(kept > 0.6 && kept < 1.35, `1 shown, ${kept} kept`);
    /* dropped time causes a warning */
    await tab.value("graingas.slower = 2200; 0");
    await tab.until("byId('warnings').textContent.includes('cannot go faster')", 30);
    await silent(tab);
  },

  "paused: a start that is refused leaves the picture of the gas before": async () => {
    const tab = await open(SMALL);
    await tab.value("byId('play').click()");
    await tab.value(slower(500));
    await tab.value('graingas.start("{flow: hcs, phi: 0.1, particles: 200, collision: {e: 0.9}}", {})');
    await tab.until("now.busy && !now.want", 10);
    await tab.value('graingas.start("{flow: usf, phi: 7}", {})');
    await tab.until("now.frame && V().flow === 'hcs'", 10);
    await silent(tab);
  },

  "links: lessons, Back, languages, the gas that waits": async () => {
    const bad = encodeURIComponent("{flow: usf, phi: 7}"),
      good = encodeURIComponent("{flow: hcs, phi: 0.1, particles: 200, collision: {e: 0.9}}");
    const tab = await open(`#scene=${bad}`);
    assert.match(await banner(tab), /asks for a gas that is not possible.*phi/s);
    assert.strictEqual(await tab.value("S().lesson"), "temperature");
    await tab.value("byId('lesson-friction').click()");
    await tab.until("S().lesson === 'friction' && V().collision.mu === 0.2 && location.hash === '#lesson=friction'", quick);
    await tab.value("move('mu', 0.4)");
    await tab.until("location.hash === '#lesson=friction&set=collision.mu=0.4'", quick);
    await tab.value("byId('lesson-haff').click()");
    await tab.until("S().lesson === 'haff' && location.hash === '#lesson=haff'", quick);
    await tab.value("move('colour', 'along'); 0");
    await tab.until("location.hash === '#lesson=haff&colour=along'", quick);
    await tab.value("history.back()");
    await tab.until("S().lesson === 'friction' && V().collision.mu === 0.4", quick);
    await tab.value("history.forward()");
    await tab.until("S().lesson === 'haff' && S().colour === 'along'", quick);
    await tab.value(`location.hash = "#scene=${bad}&lesson=haff"; 0`);
    await tab.until("byId('banner').textContent", quick);
    assert.strictEqual(await tab.value("S().lesson"), "haff");
    await tab.value(`location.hash = "#scene=${encodeURIComponent("{flow: usf, phi: 0.1}\0x")}"; 0`);
    await tab.until("byId('banner').textContent.includes('control characters')", quick);
    await tab.value(`location.hash = "#lesson=haf"; 0`);
    await tab.until("/haf/.test(byId('banner').textContent) && byId('banner').querySelector('button').textContent === 'Cooling'", quick);
    await tab.value(`location.hash = "#scene=${good}&seed=5&language=de"; 0`);
    await tab.until("V().flow === 'hcs' && V().run.seed === 5 && document.documentElement.lang === 'de' && S().lesson === null", quick);
    await tab.until("location.hash.includes('run:')", quick);
    assert.match(await tab.value("decodeURIComponent(location.hash.replace(/\\+/g, ' '))"), /^#scene=\{flow: hcs, phi: 0.1, particles: 200, run: \{seed: 5\}\}&language=de$/);
    /* while a result is played the address is that of the live gas, in the chosen language */
    await drop(tab, "class.h5", resultOf(PLAYED).bytes);
    await tab.until("S().player && graingas.played.shown >= 0", quick);
    await tab.value("move('language', 'en'); 0");
    assert.match(await tab.value("location.hash"), /hcs.*seed.*5/);
    await tab.value("byId('back').click()");
    await tab.until("!S().player && /hcs.*seed.*5/.test(location.hash)", quick);
    await silent(tab);
  },

  "a link to a file says so; served, it has a code": async () => {
    const tab = await open("#lesson=haff");
    await tab.value("byId('share').click()");
    assert.match(await tab.value("byId('link-words').textContent"), /is a file/);
    assert.strictEqual(await tab.value("byId('qr').children.length"), 0);
    await tab.value("byId('close-sharing').click()");
    await silent(tab);
    const page = fs.readFileSync(file),
      server = require("http").createServer((_, answer) => answer.end(page)).listen(0, "127.0.0.1");
    await require("events").once(server, "listening");
    const served = await browser.open("", { url: `http://127.0.0.1:${server.address().port}/#lesson=haff` });
    await served.until(READY, quick);
    await served.value("document.getElementById('share').click()");
    const size = await served.value("document.querySelector('#qr svg')?.getAttribute('viewBox')");
    assert.match(String(size), /^-4 -4 \d+ \d+$/);
    assert.match(await served.value("document.getElementById('link').value"), /^http:\/\/127.*#lesson=haff$/);
    await served.close();
    server.close();
  },

  "a link cannot hang a device: a banner offers fewer grains first": async () => {
    for (const n of [1000000, 5000000]) {
      const from = Date.now(),
        tab = await open(link(`{flow: hcs, phi: 0.1, particles: ${n}, collision: {e: 0.9}}`));
      await tab.until("byId('banner').querySelectorAll('button').length === 3", 20);
      assert.ok(Date.now() - from < 30000);
      assert.match(await banner(tab), /grains and needs about \d/);
      await tab.value("byId('banner').querySelector('button').click()");
      await tab.until("V().particles === 2000 && S().lesson === null && byId('banner').textContent === ''", quick);
      await silent(tab);
    }
  },

  "a gas that takes long to make can be stopped": async () => {
    const tab = await open("#lesson=haff");
    await tab.value("void graingas.start('{flow: hcs, phi: 0.4, particles: 1000000, collision: {e: 0.9}}', {}, { lesson: null, whatever: true })");
    await tab.until("/1,000,000 grains is being made/.test(byId('banner').textContent)", quick);
    await tab.value("byId('banner').querySelector('button').click()");
    await tab.until("V().particles === 1000 && S().lesson === 'haff' && byId('banner').textContent === '' && now.frame && now.frame.md.collisions > 0", quick);
    await silent(tab);
  },

  "views for embedding and for a projector": async () => {
    const box = await open(SMALL + "&view=box");
    assert.ok(await box.value("byId('box').clientHeight > 0.7 * innerHeight && byId('lesson').offsetWidth === 0 && document.querySelector('header').offsetWidth === 0"));
    await silent(box);
    const curve = await open("#lesson=haff&view=curve");
    await curve.until("document.querySelector('#chart polyline')", quick);
    assert.ok(await curve.value("byId('chart').clientHeight > 0.7 * innerHeight && byId('box').offsetWidth === 0"));
    await silent(curve);
    const tab = await open("#lesson=haff");
    assert.strictEqual(await tab.value("byId('leave').offsetWidth"), 0);
    await tab.press("f");
    await tab.until("S().view === 'present' && document.querySelector('header').offsetWidth === 0 && byId('chart').offsetWidth > 200", quick);
    await tab.value("byId('leave').click()"); /* a board without keys */
    await tab.until("S().view === 'all' && !document.fullscreenElement && document.querySelector('header').offsetWidth > 0 && byId('leave').offsetWidth === 0", quick);
    await tab.press("f");
    await tab.until("S().view === 'present'", quick);
    const sizes = "[document.documentElement.scrollHeight - innerHeight, byId('lesson').scrollHeight - byId('lesson').clientHeight, parseFloat(getComputedStyle(byId('question')).fontSize)]";
    for (const name of LESSONS) {
      await tab.value(`byId("lesson-${name}").click()`);
      await tab.until(`S().lesson === "${name}" && now.frame`, quick);
      const [page, words, font] = await tab.value(sizes);
      assert.ok(page <= 0 && words <= 1 && font > 20, `${name}: ${page}, ${words} of the words, ${font} pixels`);
    }
    await tab.press("f");
    await tab.until("S().view === 'all' && document.querySelector('header').offsetWidth > 0", quick);
    await silent(tab);
  },

  "a student's own points: kept, beside the theories' lines, as a table": async () => {
    const scene = "{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.9}, run: {collisions: 300, warmup: 30}}",
      tab = await open(link(scene));
    await tab.value("graingas.taken = {}; graingas.save = (name, blob) => { graingas.taken[name] = blob; }; 0");
    for (const e of [0.9, 0.8]) {
      await tab.value(`move("e", ${e})`);
      await tab.until(`V().collision.e === ${e} && S().means && S().means.md && S().means.progress.md.over && !byId("keep").disabled`, quick);
      await tab.value("byId('keep').click()");
    }
    assert.deepStrictEqual(await tab.value("S().points.map((one) => one.x)"), [0.9, 0.8]);
    const there = JSON.parse(terminal(scene, "run", "--json", "--quiet", "--output", "/dev/null", "--set", "collision.e=0.8")).results.temperature;
    assert.deepStrictEqual(await tab.value("S().points[1].md.temperature"), [there.mean, there.stderr]);
    assert.strictEqual(await tab.value("document.querySelectorAll(\"#points [data-name='md kept'] path\").length"), 2);
    await tab.until("document.querySelector(\"#points [data-name='enskog_hermite'] polyline\")?.getAttribute('points').split(' ').length > 6", quick);
    await tab.until("document.querySelector(\"#chart [data-name='ghost e = 0.9']\")", quick);
    /* the table, and a table of the class beside the student's own */
    await tab.value("byId('save-points').click()");
    const text = await tab.value("graingas.taken['graingas-points.csv'].text()");
    assert.match(text, /^slider,value,seed,md_temperature,md_temperature_error,/);
    await drop(tab, "class.csv", Buffer.from(text.replace(/^e,0.9/m, "e,0.7")));
    await tab.until("S().points.length === 4 && document.querySelector(\"#points [data-name='md of class'] path\")", quick);
    await drop(tab, "other.csv", Buffer.from("a,b\n1,2\n"));
    await tab.until("byId('banner').textContent.includes('other.csv')", quick);
    /* a pointer and keys read the curve */
    const [x, y] = await tab.value("(({ x, y, width, height }) => [x + width / 2, y + height / 2])(document.querySelector('#points svg').getBoundingClientRect())");
    await tab.send("Input.dispatchMouseEvent", { type: "mouseMoved", x, y });
    await tab.until("/e = 0\\.7\\d* — .*grains: /.test(document.querySelector('#points .readout').textContent)", quick);
    await tab.value("document.querySelector('#points svg').focus()");
    await tab.press("Home");
    await tab.until("document.querySelector('#points .readout').getAttribute('aria-live') === 'polite' && /e = /.test(document.querySelector('#points .readout').textContent)", quick);
    await silent(tab);
  },

  "points of a class: by links, by several files, each student's own mark, on this device until they are cleared": async () => {
    const tab = await open("#lesson=haff&points=Ann;e;cooling_rate;0.9,0.1,0.002,0.101,0.001;0.8,0.19,0.003");
    const names = () => tab.value("[...document.querySelectorAll('#points [data-name]')].map((one) => one.dataset.name).filter((one) => / of /.test(one))");
    await tab.until("document.querySelectorAll(\"#points [data-name='md of Ann'] path\").length === 2", quick);
    /* links pasted by the teacher, whole or their end alone; a later one of a student replaces the earlier */
    await tab.value(`byId("class").click(); byId("links").value = "file:///x/page.html#lesson=haff&points=Bob+%26+<b>;e;cooling_rate;0.7,0.3,0.01\\n#points=Ann;e;cooling_rate;0.6,0.33,0.01\\n http://nothing"; byId("take-links").click()`);
    assert.match(await tab.value("byId('gathering-said').textContent"), /: 2\./);
    await tab.value("byId('close-gathering').click()");
    assert.deepStrictEqual(await names(), ["md of Ann", "md of Bob b"]);
    assert.deepStrictEqual(await tab.value("S().points.map((one) => [one.from, one.x])"), [["Ann", 0.6], ["Bob b", 0.7]]);
    /* several tables at once */
    const table = (x) => Buffer.from(`slider,value,seed,md_cooling_rate,md_cooling_rate_error\ne,${x},1,0.2,0.01\n`).toString("base64");
    await tab.value(`(() => { const data = new DataTransfer(); for (const [name, text] of [["graingas-points-Cleo.csv", "${table(0.85)}"], ["Dan.csv", "${table(0.75)}"]]) data.items.add(new File([atob(text)], name));
      byId("box").dispatchEvent(new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true })); })()`);
    await tab.until("S().points.length === 4 && document.querySelector(\"#points [data-name='md of Dan'] path\")", quick);
    assert.deepStrictEqual(await names(), ["md of Ann", "md of Bob b", "md of Cleo", "md of Dan"]);
    const marks = await tab.value("[...document.querySelectorAll(\"#points [data-name^='md of '] path\")].map((one) => one.getAttribute('d') + one.getAttribute('fill'))");
    assert.strictEqual(new Set(marks).size, 4);
    await silent(tab);
    /* the next visit has the points of links; after Clear none */
    const later = await open("#lesson=haff");
    await later.until("S().points.length === 2", quick);
    assert.match(await later.value("byId('share').click(), byId('link').value"), /#lesson=haff&points=Ann;e;cooling_rate;0.6,0.33,0.01&points=Bob\+b;e;cooling_rate;0.7,0.3,0.01$/);
    assert.strictEqual(await later.value("byId('me-row').hidden"), true);
    await later.value("byId('close-sharing').click(); byId('forget').click()");
    await silent(later);
    const cleared = await open("#lesson=haff");
    assert.deepStrictEqual(await cleared.value("S().points"), []);
    /* the student's own points, in a link and its code */
    await cleared.value("graingas.store.dispatch('point', { points: [{ slider: 'e', x: 0.9, seed: 1, from: '', family: null, md: { cooling_rate: [0.1001, 0.002] }, dsmc: {} }] }); byId('share').click(); byId('me').value = 'Eve <i>'; byId('me').dispatchEvent(new Event('input')); 0");
    assert.match(await cleared.value("byId('link').value"), /#lesson=haff&points=Eve\+i~[0-9a-z]+;e;cooling_rate;0.9,0.1001,0.002$/);
    assert.match(await cleared.value("document.querySelector('#qr svg').getAttribute('viewBox')"), /^-4 -4 \d+ \d+$/);
    assert.match(await cleared.value("byId('link-words').textContent"), /is a file/);
    await cleared.value("byId('mine').click()");
    assert.match(await cleared.value("byId('link').value"), /#lesson=haff$/);
    await silent(cleared);
  },

  "hostile points and questions of links are text, or nothing": async () => {
    const evil = "<img src=x onerror=globalThis.evil=1><script>globalThis.evil=1</script>\u202e";
    const tab = await open(`${SMALL}&question=${encodeURIComponent(evil)}&slider=__proto__&quantity=constructor&chart=toString&grain=1e9&arrows=<b>&points=${encodeURIComponent(`${evil};e;temperature;0.5,1,0.1`)}&points=__proto__;__proto__;__proto__;1,2,3&points=${"9,".repeat(4000)}`);
    assert.strictEqual(await tab.value("byId('question').textContent"), evil.slice(0, -1));
    assert.deepStrictEqual(await tab.value("[S().slider, S().quantity, S().chart, S().grain, S().arrows]"), ["e", "temperature", "temperature", null, false]);
    await tab.until("document.querySelector('#points [data-name]')", quick);
    assert.match(await banner(tab), /holds points/);
    assert.deepStrictEqual(await tab.value("S().points.map((one) => one.from)"), ["img src x onerror global"]);
    await wait(500);
    assert.strictEqual(await tab.value("globalThis.evil === undefined && document.querySelector('#question *, #points img, main script') === null && Object.prototype.temperature === undefined"), true);
    await tab.value("byId('forget').click(); location.hash = '#scene={flow: usf, phi: 0.15, particles: 200}&question=' + 'x'.repeat(200000)");
    await tab.until("V().phi === 0.15 && byId('question').textContent.length === 240 && byId('banner').textContent === ''", quick);
    assert.ok(await tab.value("document.documentElement.scrollWidth <= innerWidth"));
    await silent(tab);
  },

  "a teacher's own question: written here, opened by its link, with one slider and one curve": async () => {
    const tab = await open("#scene={flow: usf, phi: 0.1, particles: 200}&chart=stress");
    await tab.value("byId('question-text').value = 'Where is N₁ largest?'; move('question-slider', 'phi'); move('quantity', 'N1'); byId('use-question').click()");
    await tab.until("byId('question').textContent === 'Where is N₁ largest?' && byId('main-control').querySelector('#phi') && !byId('more-controls').open", quick);
    await tab.until("location.hash.includes('question=')", quick);
    const hash = await tab.value("location.hash");
    assert.ok(hash.length < 150, hash);
    /* the slider moves, and the question remains */
    await tab.value("move('phi', 0.2)");
    await tab.until("V().phi === 0.2 && byId('question').textContent !== ''", quick);
    await silent(tab);
    const student = await open(hash);
    assert.deepStrictEqual(await student.value("[S().lesson, S().chart, S().slider, S().quantity, byId('question').textContent, byId('lesson-name').textContent, byId('more-controls').open]"),
      [null, "stress", "phi", "N1", "Where is N₁ largest?", "A question", false]);
    await student.value("byId('lesson-haff').click()");
    await student.until("S().lesson === 'haff' && S().question === '' && !location.hash.includes('question')", quick);
    await silent(student);
  },

  "slope -2 is marked where a gas cools": async () => {
    const tab = await open(link("{flow: hcs, phi: 0.2, particles: 300, collision: {e: 0.5}}") + "&speed=3");
    const slope = "document.querySelector(\"#chart [data-name='slope'] polyline\")";
    await tab.until(`${slope} && ${slope}.getAttribute("points")`, quick);
    const found = await tab.value(`(() => { const { xr, yr } = JSON.parse(byId("chart").dataset.scales), chart = graingas.parts.chart,
      [[x0, y0], [x1, y1]] = ${slope}.getAttribute("points").split(" ").map((one) => one.split(",").map(Number)),
      X = (chart.X(xr[1]) - chart.X(xr[0])) / Math.log(xr[1] / xr[0]), Y = (chart.Y(yr[1]) - chart.Y(yr[0])) / Math.log(yr[1] / yr[0]);
      return (y1 - y0) / Y / ((x1 - x0) / X); })()`);
    assert.ok(Math.abs(found + 2) < 0.05, `${found}`);
    assert.match(await tab.value("byId('chart').querySelector('.legend').textContent"), /slope −2/);
    await silent(tab);
  },

  "a click on a grain names its velocity and spin, and follows it; arrows": async () => {
    const tab = await open(link("{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.9, beta: 0}}") + "&images=0&speed=0.3");
    await tab.until("graingas.parts.view.found.length === 200", quick);
    await tab.value("byId('play').click()");
    await wait(500);
    const at = await tab.value("(() => { const [x, y, , , i] = graingas.parts.view.found[199], r = byId('box').getBoundingClientRect(), ratio = graingas.parts.view.w / byId('box').clientWidth; return [r.left + x / ratio, r.top + y / ratio, i]; })()");
    const click = async ([x, y]) => {
      for (const type of ["mousePressed", "mouseReleased"]) await tab.send("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: 1, clickCount: 1 });
    };
    await click(at);
    await tab.until(`S().grain === ${at[2]} && now.frame.picture.one`, quick);
    /* as in the library: the speed of the picture over the colour scale is about the flow, this one with the flow */
    const [words, one, box] = await tab.value("[byId('grain').textContent, now.frame.picture.one, now.frame.md.box]");
    const speed = (v) => String(+Math.hypot(...v).toPrecision(3));
    assert.match(words, new RegExp(`^Grain ${at[2] + 1}: v ${speed(one.velocity)} d γ \\(.*ω ${speed(one.spin)} γ`));
    const value = await tab.value(`now.frame.picture.value[${at[2]}] * 2 * S().gas.about.fast`),
      peculiar = [one.velocity[0] - (one.position[1] - box[1] / 2), one.velocity[1], one.velocity[2]];
    assert.ok(Math.abs(Math.hypot(...peculiar) / value - 1) < 1e-3, `${peculiar} and ${value}`);
    assert.match(await tab.value("byId('said').textContent"), /is followed/);
    await tab.until("/grain=\\d/.test(location.hash)", quick);
    /* it leaves a trail */
    await tab.value("byId('play').click()");
    await tab.until("now.trail.length > 20 && Math.hypot(...now.trail[0].map((x, k) => x - now.trail[20][k])) > 1e-6", quick);
    await tab.value("byId('arrows').click()");
    await tab.until("now.frame.picture.velocity && now.frame.picture.velocity.length === 600", quick);
    await tab.value("move('grain-number', 7)");
    await tab.until("S().grain === 6 && now.trailOf === 6 && /^Grain 7:/.test(byId('grain').textContent)", quick);
    /* a click beside all grains picks none */
    const [x, y] = await tab.value("(({ left, top }) => [left + 4, top + 4])(byId('box').getBoundingClientRect())");
    await click([x, y]);
    await tab.until("S().grain === null && byId('grain').textContent === '' && byId('grain-number').value === ''", quick);
    await silent(tab);
  },

  "curves are moved, not made anew": async () => {
    const tab = await open(SMALL);
    await tab.until("document.querySelector(\"#chart [data-name='T'] polyline\")", quick);
    const moved = await tab.value(`(async () => { const line = document.querySelector("#chart [data-name='T'] polyline"), before = line.getAttribute("points");
      while (line.getAttribute("points") === before) await new Promise((r) => setTimeout(r, 50)); return line.isConnected; })()`);
    assert.ok(moved);
    await silent(tab);
  },

  "two boxes, one seed: e = 1 beside, one last bit apart": async () => {
    const tab = await open("#lesson=haff&pair=elastic");
    await tab.until("now.frame.twin && now.frame.md.temperature < 0.8 * now.frame.twin.temperature", quick);
    assert.ok((await tab.value(drawn("twin"))).share > 0.1);
    await tab.value("byId('lesson-chaos').click()");
    await tab.until("S().lesson === 'chaos' && now.frame && S().gas.history.far.y.some((d) => d > 0)", quick);
    const first = await tab.value("S().gas.history.far.y.find((d) => d > 0)");
    assert.ok(first < 1e-9, `${first}`);
    await tab.value("graingas.store.look({ speed: 30 })");
    await tab.until("S().gas.history.far.y.some((d) => d > 0.5)", quick);
    await silent(tab);
  },

  "all velocities reversed: an elastic gas comes back, another does not": async () => {
    const back = async (e) => {
      const tab = await open(`#lesson=reverse&set=collision.e=${e}&playing=0`);
      await tab.until("now.frame", quick);
      const nearest = await tab.value(`(async () => { const { live } = graingas.workers, request = (job, more) => live.request(job, more);
        await request("frame", { collisions: 1, colour: "origin" });
        const there = await request("frame", { collisions: 0, colour: "origin" }); await request("reverse");
        let least = Infinity, f = there; const turn = there.md.time;
        while (f.md.time < 2.05 * turn) { f = await request("frame", { collisions: 0.001, colour: "origin" }); least = Math.min(least, f.distance); }
        return [there.distance, least]; })()`);
      await silent(tab);
      return nearest;
    };
    const [away, elastic] = await back(1),
      [, lossy] = await back(0.8);
    assert.ok(away > 0.1 && elastic < 0.01 * away, `from ${away} to ${elastic}`);
    assert.ok(lossy > 10 * elastic, `${lossy} and ${elastic}`);
  },

  "mixtures: velocities of each species": async () => {
    const tab = await open(link("{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.9}, species: [{fraction: 0.5}, {fraction: 0.5, diameter: 2, mass: 8}], run: {collisions: 100, warmup: 10}}") + "&chart=velocities");
    for (const which of ["Cx_1", "Cy_1", "Cx_2", "Cy_2"]) await tab.until(`byId("chart").querySelector("[data-name='velocities md ${which}']")`, quick);
    assert.match(await tab.value("byId('chart').querySelector('.legend').textContent"), /grains: Cx,2/);
    await silent(tab);
  },

  "between walls: T beside its mean, profiles, an open top without a lid": async () => {
    const tab = await open(link("{flow: couette, phi: 0.2, particles: 500, collision: {e: 0.9, beta: 0}, run: {collisions: 300, warmup: 100}}") + "&speed=100&follow=1");
    await tab.until("S().means && S().means.progress.md.over && now.frame.md.collisionsPerGrain > 300", quick);
    const [mean, live] = await tab.value("[S().means.md.results.temperature.mean, S().gas.history.column('T').slice(-20).reduce((a, b) => a + b) / 20]");
    assert.ok(Math.abs(live / mean - 1) < 0.15, `live ${live}, mean ${mean}`);
    await tab.until("byId('profiles').querySelectorAll('polyline').length === 3 && byId('profiles').querySelectorAll('circle').length > 50", quick);
    await tab.value("move('chart-kind', 'profiles')");
    await tab.until("document.querySelector(\"#chart [data-name='md profile_temperature'] polyline\") && document.querySelectorAll(\"#chart [data-name='dsmc profile_temperature'] path\").length > 10", quick);
    assert.ok(await tab.value("(() => { const { yr } = JSON.parse(byId('chart').dataset.scales); return yr[0] < 1 && yr[1] > 1 && yr[1] < 3; })()"));
    /* a flow without a gap */
    await tab.value("move('flow', 'usf')");
    await tab.until("V().flow === 'usf' && S().chart === 'temperature'", quick);
    const lids = (top) => tab.value(`(async () => { await graingas.start("{flow: chute, phi: 0.2, particles: 300, collision: {e: 0.8}, walls: {top: ${top}}}", {});
      while (!now.frame) await new Promise((r) => setTimeout(r, 20));
      let n = 0; const { view } = graingas.parts; view.wall = () => n++; graingas.drawFrame(0); delete view.wall; return n; })()`);
    assert.deepStrictEqual([await lids("open"), await lids("closed")], [1, 2]);
    await silent(tab);
  },

  "the walls lesson: scale and thermometer fit from the first moment": async () => {
    const tab = await open("#lesson=walls");
    const [height, T, fast] = await tab.value("graingas.drawFrame(0), [parseFloat(document.querySelector('.mercury').style.height), S().gas.history.rows[0].T, S().gas.about.fast]");
    assert.ok(height > 20 && height < 95, `${height} % at T = ${T}`);
    assert.ok(Math.abs(fast ** 2 / (3 * T) - 1) < 0.5, `${fast} at T = ${T}`);
    const found = await tab.value("(() => { const v = [...now.frame.picture.value]; return [v.filter((x) => x <= 0 || x >= 1).length / v.length, Math.max(...v) - Math.min(...v)]; })()");
    assert.ok(found[0] < 0.1 && found[1] > 0.6, `${found}`);
    await silent(tab);
  },

  "the box turns with a button that is held, no longer; two fingers zoom it": async () => {
    const tab = await open(SMALL);
    const [x, y] = await tab.value("(({ x, y, width, height }) => [x + width / 2, y + height / 2])(byId('box').getBoundingClientRect())");
    const mouse = (type, more) => tab.send("Input.dispatchMouseEvent", { type, x, y, ...more });
    const yaw = () => tab.value("S().camera[0]"),
      before = await yaw();
    await mouse("mousePressed", { button: "right", buttons: 2, clickCount: 1 });
    await mouse("mouseMoved", { x: x + 30, buttons: 0 });
    await mouse("mouseMoved", { x: x + 60, buttons: 0 });
    assert.strictEqual(await yaw(), before);
    await mouse("mouseReleased", { button: "right", clickCount: 1 });
    await mouse("mousePressed", { button: "left", buttons: 1, clickCount: 1 });
    await mouse("mouseMoved", { x: x + 60, button: "left", buttons: 1 });
    const turned = await yaw();
    assert.ok(turned > before);
    await tab.value("byId('box').dispatchEvent(new PointerEvent('pointercancel', { pointerId: 1 }))");
    await mouse("mouseMoved", { x: x + 90, button: "left", buttons: 1 });
    assert.strictEqual(await yaw(), turned);
    await mouse("mouseReleased", { button: "left", clickCount: 1 });
    const touch = (type, ...apart) => tab.send("Input.dispatchTouchEvent", { type, touchPoints: apart.map((d, id) => ({ x: x + d, y, id })) });
    const [a, , zoom] = await tab.value("S().camera");
    await touch("touchStart", -30, 30);
    await touch("touchMove", -60, 60);
    await touch("touchEnd");
    const [b, , wider] = await tab.value("S().camera");
    assert.ok(wider > 1.5 * zoom && a === b, `zoom ${zoom} to ${wider}, yaw ${a} to ${b}`);
    await tab.value("byId('camera-home').click()");
    assert.deepStrictEqual(await tab.value("S().camera"), [0.45, 0.22, 1]);
    await tab.value("document.querySelector('[data-label=zoomIn]').click()");
    assert.ok((await tab.value("S().camera[2]")) > 1.2);
    await silent(tab);
  },

  "edges behind the grains are the three at the farthest corner": async () => {
    const tab = await open(SMALL);
    const behind = await tab.value(`(() => { const { view } = graingas.parts, box = now.frame.md.box, is = view.isBehind(box), all = [];
      for (let i = 0; i < 8; i++) for (const bit of [1, 2, 4]) if (!(i & bit) && is(i, i | bit)) all.push([i, i | bit]);
      const depth = (i) => view.to(i & 1 ? box[0] : 0, i & 2 ? box[1] : 0, i & 4 ? box[2] : 0)[3];
      const far = [0, 1, 2, 3, 4, 5, 6, 7].sort((a, b) => depth(a) - depth(b))[0];
      return [all.length, all.every((edge) => edge.includes(far))]; })()`);
    assert.deepStrictEqual(behind, [3, true]);
    await silent(tab);
  },

  "pause by key and button, one collision, faster and slower, restart": async () => {
    const tab = await open(SMALL);
    await tab.press(" ");
    await tab.until("!S().playing", quick);
    await wait(400);
    const before = await tab.value("now.frame.md.collisions");
    await wait(700);
    assert.strictEqual(await tab.value("now.frame.md.collisions"), before);
    for (let k = 1; k <= 3; k++) {
      await tab.value("byId('step').click()");
      await tab.until(`now.frame.md.collisions === ${before + k} && now.frame.event`, quick);
    }
    await tab.until("/Grains \\d+ and \\d+ collided at .* 19 % is lost/.test(byId('event').textContent)", quick);
    assert.strictEqual(await tab.value("byId('event').getAttribute('aria-live')"), "polite");
    for (let k = 0; k < 14; k++) await tab.value("byId('faster').click()");
    assert.strictEqual(await tab.value("S().speed"), 1000);
    for (let k = 0; k < 14; k++) await tab.value("byId('slower').click()");
    assert.strictEqual(await tab.value("S().speed"), 0.001);
    await tab.value("byId('restart').click()");
    await tab.until("now.frame && now.frame.md.collisions === 0", quick);
    await silent(tab);
  },

  "a result is dropped, played, scrubbed, and left": async () => {
    const { printed, bytes } = resultOf(PLAYED),
      tab = await open(link("{flow: hcs, phi: 0.1, particles: 200, collision: {e: 0.9}}"));
    const h5 = path.join(browser.home, "class.h5"),
      at = "graingas.played";
    fs.writeFileSync(h5, bytes);
    await tab.until("S().means", quick);
    await drop(tab, "class.h5", bytes);
    await tab.until(`S().player && ${at}.shown >= 0`, quick);
    const last = (await tab.value("S().player.frames")) - 1;
    assert.ok(last > 10);
    assert.match(await tab.value("document.title"), /class\.h5: .*shear/);
    assert.deepStrictEqual(await tab.value("[V().flow, byId('flow').value]"), ["usf", "usf"]);
    /* plays forwards to the end; colours, spins */
    await tab.value("for (let k = 0; k < 9; k++) byId('faster').click()");
    assert.match(await tab.value("byId('speed').textContent"), /60 frames/);
    await tab.until(`${at}.shown === ${last} && !S().playing`, quick);
    assert.ok((await tab.value(drawn("box"))).share > 0.1);
    assert.ok(await tab.value("now.frame.picture.marks !== null && byId('colour').querySelector('[value=since]').disabled"));
    /* by hand, with the keyboard */
    await tab.value("byId('scrub').focus()");
    await tab.press("Home");
    await tab.until(`${at}.shown === 0`, quick);
    const first = await tab.value("now.frame.md.time");
    await tab.value("byId('step').click()");
    await tab.until(`${at}.shown === 1 && now.frame.md.time > ${first}`, quick);
    assert.match(await tab.value("byId('frame-number').textContent"), new RegExp(`^2 of ${last + 1}$`));
    /* its means in the table and in the text */
    await tab.until("S().means && S().means.stored", quick);
    assert.strictEqual(await tab.value("S().means.md.results.temperature.mean"), printed.results.temperature.mean);
    assert.match(await tab.value("byId('table').textContent"), /temperature T/);
    assert.match(await tab.value("graingas.describe()"), /class\.h5, frame 2 of .*grains: temperature T 0\.\d/);
    await tab.until("byId('chart').querySelector('[data-name=now]')", quick);
    /* rejected files change nothing */
    const damaged = Buffer.from(bytes);
    damaged[5000] ^= 1;
    const without = resultOf("{flow: usf, engine: dsmc, phi: 0.1, dsmc: {particles: 200}, run: {collisions: 9, warmup: 1}}");
    for (const [given, words] of [
      [Buffer.from("no result"), refusalOf(Buffer.from("no result"))],
      [damaged, refusalOf(damaged)],
      [without.bytes, "given.h5: nothing to play: it holds no positions of grains"],
    ]) {
      await drop(tab, "given.h5", given);
      await tab.until("S().banner && !S().banner.quiet", quick);
      const said = await tab.value("S().banner.text");
      assert.ok(said.startsWith("given.h5: ") && words.endsWith(said), `${said}\n${words}`);
      assert.strictEqual(await tab.value("S().player.name"), "class.h5");
      await tab.value("graingas.store.dispatch('banner', { banner: null })");
    }
    /* back to the live gas */
    await tab.value("byId('back').focus(), byId('back').click()");
    await tab.until("!S().player && V().flow === 'hcs' && now.frame && !byId('player').offsetWidth", quick);
    assert.strictEqual(await tab.value("document.activeElement.id"), "play");
    /* a file chosen by the button; from there to a live gas of that scene */
    await tab.choose("#file", h5);
    await tab.until(`S().player && ${at}.shown >= 0`, quick);
    await tab.value("byId('run-live').click()");
    await tab.until("!S().player && V().flow === 'usf' && now.frame && now.frame.dsmc", quick);
    assert.strictEqual(await banner(tab), "");
    /* the page's own scene.yaml */
    await drop(tab, "scene.yaml", Buffer.from("flow: hss\nphi: 0.2\nparticles: 200\nthermostat: gaussian\n"));
    await tab.until("V().flow === 'hss' && now.frame", quick);
    await silent(tab);
  },

  "the gas that waits is measured to its end": async () => {
    const tab = await open(link("{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.9}, run: {collisions: 300, warmup: 20}}"));
    const { bytes } = resultOf(PLAYED),
      brief = resultOf(PLAYED.replace("trajectory_every: 1", "trajectory_every: 8")).bytes,
      over = (of) => `Object.values(${of}.progress).every((p) => p.over)`;
    await tab.until("S().means", quick);
    await drop(tab, "long.h5", bytes);
    await tab.until("S().player && graingas.played.shown > 3", quick);
    /* another file while the first plays: pending answers of the first are not shown in the second */
    await drop(tab, "brief.h5", brief);
    await tab.until("S().player.name === 'brief.h5' && graingas.played.shown === S().player.frames - 1", quick);
    await tab.until(over("S().shelf.means"), quick);
    await tab.value("byId('back').click()");
    await tab.until(`!S().player && S().means && ${over("S().means")} && /grains done; Enskog by dice done/.test(byId('progress').textContent)`, 10);
    await silent(tab);
  },

  "the trajectories of the terminal": async () => {
    const tab = await open();
    for (const name of ["smooth, sheared", "rough, sheared", "frictional, sheared", "cooling", "monte carlo, rough"]) {
      const there = JSON.parse(terminal(scenes[name], "fingerprint", "--json")).fingerprint;
      assert.strictEqual(
        (await tab.value(`graingas.workers.live.request("hash", { scene: ${JSON.stringify(scenes[name])}, collisions: 100000 })`)).hash,
        there,
        name,
      );
    }
    await silent(tab);
  },

  "what is seen does not depend on how often it is drawn": async () => {
    const scene = JSON.stringify("{flow: usf, phi: 0.2, particles: 300, collision: {e: 0.9}}"),
      tab = await open();
    await tab.value("byId('play').click()");
    const walk = async (pieces) =>
      tab.value(`(async () => { const request = (job, more) => graingas.workers.live.request(job, more); await request("start", { scene: ${scene}, sets: {} }); let f;
      for (let k = 0; k < ${pieces}; k++) f = await request("frame", { collisions: 1e-9, colour: "speed" });
      for (;;) { f = await request("frame", { colour: "speed", step: true }); if (f.md.collisions >= 300) break; }
      return [f.md.collisions, f.md.temperature, ...f.event.k]; })()`);
    assert.deepStrictEqual(await walk(1), await walk(50));
    await silent(tab);
  },

  "curves pass through the terminal's means": async () => {
    const scene = "{flow: usf, phi: 0.1, particles: 500, collision: {e: 0.9, beta: 0}, run: {collisions: 2000, warmup: 200}}";
    const there = JSON.parse(terminal(scene, "compare", "--json", "--quiet", "--output", "/dev/null", "--picture", "none"));
    const tab = await open(link(scene));
    await tab.until("S().means && S().means.progress.md && S().means.progress.md.over && S().means.progress.dsmc.over", 240);
    await tab.until("byId('chart').querySelector(\"[data-name='mean md temperature'] polyline\")", quick);
    for (const engine of ["md", "dsmc"]) {
      const { mean, stderr } = there[engine].results.temperature;
      const shown = await tab.value(`(() => { const { chart } = graingas.parts, line = chart.figure.querySelector("[data-name='mean ${engine} temperature'] polyline");
        const y = +line.getAttribute("points").split(" ")[0].split(",")[1], [a, b] = chart.yr; return a + (y - chart.Y(a)) / (chart.Y(b) - chart.Y(a)) * (b - a); })()`);
      assert.ok(Math.abs(shown - mean) < 4 * stderr + 0.01, `${engine}: drawn ${shown}, terminal ${mean} +- ${stderr}`);
      assert.strictEqual(await tab.value(`S().means.${engine}.results.temperature.mean`), mean);
    }
    /* the mark ! comes from the library */
    const marks = await tab.value("[...byId('table').tBodies[0].rows].filter((row) => row.cells[4].textContent.includes('!')).map((row) => row.cells[0].title)");
    assert.deepStrictEqual(marks.filter((name) => !there.comparison.find((one) => one.quantity === name).beyond_expected), []);
    await silent(tab);
  },

  "hostile links are refused in the terminal's words": async () => {
    for (const scene of [
      "<script>alert(1)</script>",
      "{flow: usf, phi: 7}",
      "{flow: usf, phi: 0.1, collision: {e: -3}}",
      "{flow: <img src=x onerror=alert(1)>, phi: 0.1}",
      "{flow: usf, phi: 0.1, particles: 1e99}",
      "{flow: usf, phi: [",
      "x".repeat(1 << 20),
    ]) {
      const tab = await open(link(scene)),
        said = await banner(tab);
      const there = refusal(scene, "fingerprint").trim(),
        end = there.slice(there.lastIndexOf(": ") + 2).slice(0, 60);
      assert.ok(said.length > 10 && said.includes(end.slice(0, 40)), `${said}\n${there}`);
      assert.strictEqual(await tab.value("document.querySelectorAll('img, main script').length"), 0);
      assert.strictEqual(await tab.value("S().lesson"), "temperature");
      await silent(tab);
    }
    const tab = await open("#set=collision.e=9&set=nonsense=1&set=%00&language=xx&seed=-1&camera=a,b&speed=NaN");
    assert.match(await banner(tab), /collision\.e/);
    await silent(tab);
    const wrong = await open("#lesson=__proto__");
    assert.match(await banner(wrong), /__proto__/);
    await silent(wrong);
  },

  "controls wait for the gas, and nothing of one stands beside the next": async () => {
    const tab = await open(SMALL);
    assert.strictEqual(await tab.value("byId('main').inert"), false);
    await tab.until("S().means && now.frame && byId('theory-boxes').querySelector('input') && byId('ranges').children.length", quick);
    const emptied = await tab.value(`(async () => {
      await graingas.start("{flow: hcs, phi: 0.1, particles: 200, collision: {e: 0.9}}", {});
      return ["table tbody tr", "ranges li", "theory-boxes input", "points [data-name='md now']"].map((one) => document.querySelectorAll("#" + one).length); })()`);
    assert.deepStrictEqual(emptied, [0, 0, 0, 0]);
    await tab.until("/^Homogeneous cooling/.test(byId('said').textContent)", 10);
    await silent(tab);
  },

  "what is taken along: picture, curves, scene": async () => {
    const tab = await open(link("{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.9}, run: {collisions: 200, warmup: 20}}"));
    await tab.until("S().gas.history.rows.length > 3 && S().means && S().means.md && S().means.md.curves", quick);
    await tab.value("graingas.taken = {}; graingas.save = (name, blob) => { graingas.taken[name.split('.').pop()] = [name, blob]; }; 0");
    for (const id of ["save-png", "save-csv", "save-yaml", "save-svg"]) await tab.value(`byId("${id}").click()`);
    await tab.until("Object.keys(graingas.taken).length === 4", quick);
    /* pictures state the gas, and the meaning of their colours and lines */
    const svg = await tab.value("graingas.taken.svg[1].text()");
    assert.match(svg, /<svg[^>]*xmlns="http:\/\/www.w3.org\/2000\/svg".*Temperature T.*Uniform shear flow.*data-name="T".*grains: T/s);
    assert.strictEqual(await tab.value(`new DOMParser().parseFromString(${JSON.stringify(svg)}, "image/svg+xml").querySelector("parsererror")`), null);
    const higher = await tab.value("createImageBitmap(graingas.taken.png[1]).then((image) => [image.width - byId('box').width, image.height - byId('box').height])");
    assert.ok(higher[0] === 0 && higher[1] >= 64, `${higher}`);
    assert.strictEqual(await tab.value("graingas.taken.csv[0]"), "graingas-usf-phi0.1-e0.9-seed1.csv");
    const head = await tab.value("graingas.taken.png[1].arrayBuffer().then((b) => [...new Uint8Array(b, 0, 8)])");
    assert.deepStrictEqual(head, [137, 80, 78, 71, 13, 10, 26, 10]);
    const [title, columns, first] = (await tab.value("graingas.taken.csv[1].text()")).split("\n");
    assert.match(title, /^# Uniform shear flow/);
    assert.match(columns, /^time,collisions_per_grain,md_temperature,.*dsmc_temperature/);
    assert.ok(first.split(",").length === columns.split(",").length && first.split(",").every((one) => Number.isFinite(+one)), first);
    const yaml = await tab.value("graingas.taken.yaml[1].text()");
    const hash = (scene) => JSON.parse(terminal(scene, "fingerprint", "--json", "--set", "engine=md")).fingerprint;
    assert.strictEqual(hash(yaml), hash(await tab.value("S().gas.scene")));
    /* the short scene of a link is the same scene; seeds beyond doubles are kept, too */
    assert.strictEqual(hash(await tab.value("S().gas.about.brief")), hash(yaml));
    await tab.value("void graingas.start(S().gas.scene, { 'run.seed': '9007199254740993' })");
    await tab.until("S().gas.sets['run.seed'] && location.hash.includes('9007199254740993')", quick);
    await silent(tab);
  },

  "theories are drawn as chosen": async () => {
    const tab = await open(link("{flow: hcs, phi: 0.1, particles: 300, collision: {e: 0.9}}"));
    await tab.until("S().means && byId('theory-boxes').querySelectorAll('input').length > 4", quick);
    const lines = () => tab.value("[...byId('chart').querySelectorAll('[data-name]')].map((l) => l.dataset.name).filter((n) => / temperature$/.test(n)).map((n) => n.split(' ')[0])");
    await tab.until("byId('chart').querySelector(\"[data-name='haff1983 temperature']\")", quick);
    assert.deepStrictEqual(await lines(), ["haff1983"]);
    const all = await tab.value("for (const box of byId('theory-boxes').querySelectorAll('input')) if (!box.checked) box.click(); S().theories");
    assert.ok(all.length > 4);
    const cooling = await tab.value("Object.keys(S().means.cooling.T).length");
    await tab.until(`[...byId('chart').querySelectorAll('[data-name]')].filter((l) => / temperature$/.test(l.dataset.name)).length === ${cooling}`, quick);
    /* no two share a colour and dashes */
    const keys = await tab.value("[...byId('chart').querySelectorAll('[data-name$=\" temperature\"] polyline')].map((l) => l.getAttribute('stroke') + l.getAttribute('stroke-dasharray'))");
    assert.strictEqual(new Set(keys).size, keys.length);
    /* Haff's line of the library passes through the first point of its gas */
    const [T, haff] = await tab.value("[S().gas.history.rows[0].T, S().means.cooling.T.haff1983[0]]");
    assert.ok(Math.abs(T / haff - 1) < 0.15, `${T} and ${haff}`);
    await tab.value("byId('theory-boxes').querySelector('[value=haff1983]').click()");
    await tab.until("!byId('chart').querySelector(\"[data-name='haff1983 temperature']\")", quick);
    await silent(tab);
  },

  "keyboard, and nothing moves for users who prefer reduced motion": async () => {
    const tab = await open("", { media: [{ name: "prefers-reduced-motion", value: "reduce" }] });
    assert.strictEqual(await tab.value("S().playing"), false);
    assert.ok(
      await tab.value(
        "[...document.querySelectorAll('button, input, select, textarea, canvas, summary')].every((e) => e.disabled || e.tabIndex >= 0 || e.getAttribute('aria-hidden') === 'true')",
      ),
    );
    await tab.value("byId('box').focus()");
    const yaw = await tab.value("S().camera[0]");
    await tab.press("ArrowRight");
    assert.ok((await tab.value("S().camera[0]")) > yaw);
    await silent(tab);
  },

  "what changes is said once": async () => {
    const tab = await open("#lesson=haff&speed=30");
    await tab.value("globalThis.heard = []; new MutationObserver(() => heard.push(byId('said').textContent)).observe(byId('said'), { childList: true, characterData: true, subtree: true }); 0");
    await tab.until("heard.some((one) => /T has halved/.test(one))", quick);
    await tab.value("byId('lesson-friction').click()");
    await tab.until("heard.some((one) => /^Friction\\. .*At which/.test(one))", quick);
    await tab.until("now.frame", quick);
    await tab.press("d");
    await tab.until("heard.some((one) => /After .* collisions a grain T is/.test(one))", quick);
    assert.strictEqual(await tab.value("new Set(heard).size"), await tab.value("heard.length"));
    await silent(tab);
  },

  "Haff's law can be heard": async () => {
    const tab = await open("#lesson=haff");
    await tab.value(`globalThis.pitches = []; AudioContext.prototype.createOscillator = ((make) => function () { const one = make.call(this), start = one.start.bind(one);
      one.start = (at) => { pitches.push(one.frequency.value); start(at); }; return one; })(AudioContext.prototype.createOscillator); 0`);
    await wait(1000);
    assert.strictEqual(await tab.value("pitches.length"), 0);
    const [x, y] = await tab.value("byId('switches').open = true; byId('sound').scrollIntoView(); (({ x, y, width, height }) => [x + width / 2, y + height / 2])(byId('sound').getBoundingClientRect())");
    for (const type of ["mousePressed", "mouseReleased"]) await tab.send("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons: 1, clickCount: 1 });
    await tab.until("pitches.length > 20", quick);
    const first = await tab.value("pitches[0]");
    await tab.value("graingas.store.look({ speed: 30 })");
    await tab.until(`pitches[pitches.length - 1] < 0.8 * ${first}`, quick);
    await silent(tab);
  },

  "axe-core finds nothing": async () => {
    const at = [process.env.AXE, path.join(__dirname, "node_modules/axe-core/axe.min.js")].find((one) => one && fs.existsSync(one));
    if (!at) return "SKIP axe-core is not there (npm install in tests/web; ./check --page does it)";
    const axe = fs.readFileSync(at, "utf8"),
      { bytes } = resultOf(PLAYED);
    for (const [width, height, hash] of [
      [390, 844, "#lesson=equipartition"],
      [1366, 768, "#lesson=chaos&language=de"],
      [1920, 1080, "#lesson=walls&language=es"],
    ]) {
      const tab = await open(hash, { width, height });
      await tab.until("S().means && S().means.md && S().means.md.results.pressure", quick);
      await tab.value(`${axe}; for (const one of document.querySelectorAll("details")) one.open = true; 0`);
      const found = async (where) =>
        assert.deepStrictEqual(
          await tab.value("axe.run(document).then((r) => r.violations.map((v) => `${v.id}: ${v.help}: ${v.nodes.map((n) => n.target).join(' ')}`))"),
          [],
          `${hash} at ${width}: ${where}`,
        );
      await found("lesson");
      await tab.value("byId('share').click()");
      await found("sharing");
      await tab.value("byId('close-sharing').click(); byId('class').click()");
      await found("points of a class");
      await tab.value("byId('close-gathering').click(); byId('question-text').value = 'Why?'; byId('use-question').click(); byId('arrows').click(); move('grain-number', 3)");
      await tab.until("byId('question').textContent === 'Why?' && byId('grain').textContent", quick);
      await tab.value("graingas.store.look({ chart: 'temperature' }); graingas.store.dispatch('gather', { points: Array.from({ length: 30 }, (_, i) => ({ slider: S().slider, x: i / 30, from: `student ${i}`, md: { [S().quantity]: [1, 0.1] }, dsmc: {} })) })");
      await tab.until("document.querySelectorAll('#points .legend li').length > 29", quick);
      await found("a question, a grain, a class of thirty");
      await drop(tab, "class.h5", bytes);
      await tab.until("S().means && S().means.stored && graingas.played.shown >= 0", quick);
      await found("a result");
      await drop(tab, "none.h5", Buffer.from("no result"));
      await tab.until("S().banner && !S().banner.quiet", quick);
      await found("a refusal");
      await tab.close();
    }
    return "";
  },

  "memory does not grow": async () => {
    const tab = await open(link("{flow: usf, phi: 0.1, particles: 500, collision: {e: 0.9, beta: 0}, run: {relative_error: 0.0001}}") + "&speed=100"),
      seconds = +(process.env.PAGE_SECONDS || 12);
    const used = async () => {
      await tab.send("HeapProfiler.collectGarbage");
      const heap = (await tab.send("Runtime.getHeapUsage")).usedSize;
      return [heap, ...(await Promise.all(["live", "measure"].map((who) => tab.value(`graingas.workers.${who}.request("memory").then((a) => a.bytes)`))))];
    };
    await tab.until("S().means && S().means.md && Object.values(S().lines).some((one) => one.theory.length === one.x.length)", quick);
    await wait((1000 * seconds) / 3);
    const before = await used();
    await wait((1000 * 2 * seconds) / 3);
    const after = await used();
    console.log(`# bytes of the page's heap, of both modules: ${before} and, after ${((2 * seconds) / 3).toFixed(0)} s more, ${after}`);
    assert.ok(after[0] - before[0] < 4e6 && after[1] === before[1] && after[2] - before[2] < 20e6 /* while series fill up */);
    await silent(tab);
  },
};

(async () => {
  if (!find()) {
    console.log("1..0 # SKIP chromium is not installed");
    return;
  }
  if (!fs.existsSync(file)) {
    console.log("1..0 # SKIP the page was not built (ninja page)");
    return;
  }
  browser = new Browser();
  const wanted = process.argv.slice(2);
  try {
    await list(wanted.length ? Object.fromEntries(Object.entries(tests).filter(([name]) => wanted.some((one) => name.includes(one)))) : tests, null);
  } finally {
    await browser.close();
  }
})();
