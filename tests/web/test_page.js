/* The page in headless Chromium: it loads without a word on the console, and without the network; lessons run; controls
 * act; the same seed gives the same trajectory; what is hostile is refused in the terminal's words. */
"use strict";
const assert = require("assert"),
  fs = require("fs"),
  path = require("path");
const { find, Browser } = require("./chromium.js"),
  { terminal, refusal, resultOf, refusalOf, list } = require("./tap.js"),
  scenes = require("./scenes.js");

const file = process.env.PAGE,
  quick = 120;
const wait = (ms) => new Promise((r) => setTimeout(r, ms));
let browser;

async function open(hash = "", more = {}) {
  const tab = await browser.open(file, { hash, ...more });
  await tab.until("typeof page === 'object' && page.about !== null && page.frames > 0", quick);
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
const PLAYED =
  "{flow: usf, phi: 0.2, particles: 300, collision: {e: 0.9, beta: 0}, output: {trajectory_every: 1}, run: {collisions: 40, warmup: 5}}";
const link = (scene) => `#scene=${encodeURIComponent(scene)}`;

/* Frames come so many milliseconds later, as on a slow machine. */
const slower = (ms) => `{ const ask = page.live.ask.bind(page.live); page.slower = ${ms};
  page.live.ask = async (job, ...rest) => { const answer = await ask(job, ...rest);
    if (job === "frame") await new Promise((r) => setTimeout(r, page.slower)); return answer; }; }`;

/* As somebody drops it from a folder. */
const drop = (tab, name, bytes) =>
  tab.value(`(() => { byId("file-refused").textContent = ""; const data = new DataTransfer(), bytes = Uint8Array.from(atob("${bytes.toString("base64")}"), (c) => c.charCodeAt(0));
  data.items.add(new File([bytes], "${name}")); for (const kind of ["dragover", "drop"]) byId("box").dispatchEvent(new DragEvent(kind, { dataTransfer: data, bubbles: true, cancelable: true })); })()`);

/* Of the box: how many of its pixels differ from the darkness around, and how many colours they have. */
const DRAWN = `(() => { const c = byId("box"), copy = document.createElement("canvas"), to = copy.getContext("2d", { willReadFrequently: true });
  copy.width = c.width; copy.height = c.height; to.drawImage(c, 0, 0);
  const p = to.getImageData(0, 0, c.width, c.height).data, seen = new Set(); let n = 0;
  for (let i = 0; i < p.length; i += 4) if (Math.abs(p[i] - 16) + Math.abs(p[i + 1] - 21) + Math.abs(p[i + 2] - 26) > 30) { n++; seen.add((p[i] >> 4) * 256 + (p[i + 1] >> 4) * 16 + (p[i + 2] >> 4)); }
  return { share: n / (c.width * c.height), colours: seen.size }; })()`;

const tests = {
  "loads in silence, draws, measures": async () => {
    const tab = await open();
    await tab.until("page.means && page.means.md && page.means.md.results.temperature.mean > 0", quick);
    const { share, colours } = await tab.value(DRAWN);
    assert.ok(share > 0.1 && share < 0.9 && colours > 20, `${share} of the box, ${colours} colours`);
    assert.strictEqual(await tab.value("document.querySelectorAll('figure > svg').length"), 3);
    assert.ok(await tab.value("byId('table').tBodies[0].rows.length > 8"));
    assert.strictEqual(await tab.value("document.documentElement.scrollWidth > innerWidth"), false);
    await silent(tab);
  },

  "a page with a scene in it begins with that": async () => {
    const out = path.join(browser.home, "own.html"),
      before = file;
    terminal("{flow: chute, phi: 0.2, particles: 300, collision: {e: 0.8}}", "page", "--quiet", "--output", out);
    const tab = await browser.open(out);
    await tab.until("typeof page === 'object' && page.about !== null", quick);
    assert.deepStrictEqual(
      await tab.value("[page.about.values.flow, page.about.values.particles, page.about.values.collision.e]"),
      ["chute", 300, 0.8],
    );
    assert.ok(fs.statSync(before).size < 1.5e6);
    await silent(tab);
  },

  "six lessons run, each with both engines": async () => {
    const tab = await open("#lesson=haff");
    for (const name of await tab.value("LESSONS.map((one) => one.name)")) {
      await tab.value(`byId("lesson-${name}").click()`);
      await tab.until(
        `page.lesson === "${name}" && page.frame && page.frame.md.collisions > 100 && page.means && page.means.progress.md && page.means.progress.dsmc`,
        quick,
      );
      assert.strictEqual(await tab.value("byId('refused').textContent"), "");
      assert.ok((await tab.value("byId('lesson-text').innerText")).length > 150);
      assert.ok((await tab.value(DRAWN)).share > 0.02, name);
    }
    await silent(tab);
  },

  "every control acts": async () => {
    const tab = await open();
    const set = async (id, value, test) => {
      await tab.value(
        `{ const c = byId("${id}"); c.value = "${value}"; c.dispatchEvent(new Event(c.type === "range" ? "input" : "change", { bubbles: true })); }`,
      );
      await tab.until(test, quick);
    };
    await set("phi", 0.2, "page.about.values.phi === 0.2");
    await set("e", 0.8, "page.about.values.collision.e === 0.8");
    await set("beta", 0.5, "page.about.values.collision.beta === 0.5");
    await tab.value("byId('friction').click()");
    await tab.until("page.about.values.collision.mu === 0.3", quick);
    await set("mu", 0.1, "page.about.values.collision.mu === 0.1");
    await set("law", "viscoelastic", "page.about.values.collision.law === 'viscoelastic'");
    await set("law", "constant", "page.about.values.collision.law === 'constant'");
    await tab.value("byId('mixture').click()");
    await tab.until("page.about.values.species.length === 2 && page.about.values.species[1].mass === 8", quick);
    await set("diameter", 1.5, "page.about.values.species[1].diameter === 1.5");
    await set("mass-number", 3, "page.about.values.species[1].mass === 3 && page.about.values.species[1].diameter === 1.5");
    await tab.until("page.frame && page.about.diameters.length === 2", quick);
    await tab.value("byId('mixture').click()");
    await tab.until("page.about.values.species.length === 1", quick);
    await set("particles", 300, "page.about.values.particles === 300");
    await set("seed-number", 7, "page.about.values.run.seed === 7");
    await set("phi-number", 0.15, "page.about.values.phi === 0.15");
    for (const flow of await tab.value("FLOWS"))
      await set("flow", flow, `page.about.values.flow === "${flow}" && page.frame`);
    /* what an elastic gas took away comes back */
    await set("flow", "usf", "page.about.values.flow === 'usf'");
    await set("e", 0.7, "page.about.values.collision.e === 0.7");
    await set("flow", "equilibrium", "page.about.values.collision.e === 1 && page.about.values.collision.beta === -1");
    await set("flow", "hcs", "page.about.values.flow === 'hcs'");
    assert.deepStrictEqual(await tab.value("[page.about.values.collision.e, page.about.values.collision.beta, page.about.values.collision.mu]"), [0.7, 0.5, 0.1]);
    /* rows that some flows have */
    const shown = (id) => tab.value(`byId("${id}").offsetWidth > 0`);
    assert.deepStrictEqual([await shown("wallE"), await shown("thermostat"), await shown("tilt")], [false, false, false]);
    await set("flow", "hss", "page.about.values.flow === 'hss'");
    await set("thermostat", "white_noise", "page.about.values.thermostat === 'white_noise'");
    await set("flow", "chute", "page.about.values.flow === 'chute'");
    await set("tilt", 30, "Math.abs(page.about.values.gravity[0] / page.about.values.gravity[1] + Math.tan(Math.PI / 6)) < 1e-4");
    await set("wallE", 0.5, "page.about.values.walls.e === 0.5");
    await set("wallBeta", 0, "page.about.values.walls.beta === 0");
    /* and from a scene with every key, as a page has that was written with one */
    for (const from of ["hss", "chute"]) {
      await set("flow", from, `page.about.values.flow === "${from}" && page.frame`);
      await tab.value("void start(page.about.yaml, {})");
      await tab.until("Object.keys(page.sets).length === 0 && page.frame", quick);
      for (const flow of await tab.value("FLOWS"))
        await set("flow", flow, `page.about.values.flow === "${flow}" && page.frame`);
    }
    assert.strictEqual(await tab.value("byId('refused').textContent"), "");
    await tab.value("void start('{flow: usf, phi: 0.1, particles: 200, run: {seed: 5}}', {})");
    await tab.until("page.about.values.run.seed === 5", quick);
    assert.match(await tab.value("location.hash"), /seed=5\b/);
    await set("language", "de", "document.documentElement.lang === 'de' && byId('step').textContent === 'Ein Stoß'");
    await set("colour", "since", "byId('scale-text').textContent.includes('freie')");
    await silent(tab);
  },

  "changes while a gas is awaited add up": async () => {
    const tab = await open(link("{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.8}}"));
    const move = `const move = (id, value) => { const c = byId(id); c.value = value;
      c.dispatchEvent(new Event(c.type === "range" ? "input" : "change", { bubbles: true })); };
      const asked = () => new Promise((r) => { const from = page.starts, look = () => page.starts > from ? r() : setTimeout(look, 1); look(); });`;
    /* one is asked for, and not answered, when the next is moved */
    await tab.value(`(async () => { ${move} move("phi", 0.2); await asked(); move("e", 0.7); })()`);
    await tab.until("page.about.values.collision.e === 0.7", quick);
    assert.strictEqual(await tab.value("page.about.values.phi"), 0.2);
    await tab.value(`(async () => { ${move} move("phi", 0.15); await asked(); byId("restart").click(); })()`);
    await tab.until("page.about.values.phi === 0.15 && page.frame", quick);
    await wait(500);
    assert.strictEqual(await tab.value("page.about.values.phi"), 0.15);
    await tab.value(`(async () => { ${move} move("phi", 0.25); byId("reseed").click(); })()`);
    await tab.until("page.about.values.phi === 0.25 && page.sets['run.seed']", quick);
    /* both rows of one key */
    await tab.value("byId('mixture').click()");
    await tab.until("page.about.values.species.length === 2", quick);
    await tab.value(`(async () => { ${move} move("diameter", 1.5); move("mass", 3); })()`);
    await tab.until("page.about.values.species[1].mass === 3", quick);
    assert.strictEqual(await tab.value("page.about.values.species[1].diameter"), 1.5);
    await tab.value("byId('mixture').click()");
    await tab.until("page.about.values.species.length === 1", quick);
    /* over "equilibrium" in the list */
    await tab.value(`(async () => { ${move} move("flow", "equilibrium"); move("flow", "couette"); })()`);
    await tab.until("page.about.values.flow === 'couette'", quick);
    assert.strictEqual(await tab.value("page.about.values.collision.e"), 0.7);
    /* what is refused is not built on */
    await tab.value(`(async () => { ${move} move("e-number", 7); await asked(); })()`);
    await tab.until("byId('refused').textContent.includes('collision.e')", quick);
    await tab.value(`(async () => { ${move} move("phi", 0.2); })()`);
    await tab.until("page.about.values.phi === 0.2 && byId('refused').textContent === ''", quick);
    await silent(tab);
  },

  "the scene as text is the one that runs": async () => {
    const tab = await open("#scene=" + encodeURIComponent("{flow: usf, phi: 0.1, particles: 200}") + "&set=collision.e=0.8");
    assert.match(await tab.value("byId('yaml').value"), /\n  e: 0\.8\n/);
    await tab.value("byId('yaml').closest('details').open = true; byId('yaml').focus(); byId('yaml').value = '{flow: hcs, '; 0");
    await tab.value("void start(page.scene, { phi: '0.2' })");
    await tab.until("page.about.values.phi === 0.2", quick);
    assert.strictEqual(await tab.value("byId('yaml').value"), "{flow: hcs, ");
    await tab.value("byId('use-yaml').focus(); void start(page.scene, { phi: '0.3' })");
    await tab.until("page.about.values.phi === 0.3 && byId('yaml').value.includes('phi: 0.3')", quick);
    await silent(tab);
  },

  "a frame that fails is not the last; a box that is not shown is not drawn": async () => {
    const tab = await open(link("{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.9}}"));
    await tab.value("byId('box').style.display = 'none'; 0");
    const more = "(async () => { const from = page.frames; await new Promise((r) => setTimeout(r, 1000)); return page.frames - from; })()";
    assert.ok((await tab.value(more)) > 5);
    await tab.value("byId('box').style.display = ''; page.drawn = BoxView.prototype.draw; BoxView.prototype.draw = () => { throw new Error('a test'); }; 0");
    await wait(300);
    await tab.value("BoxView.prototype.draw = page.drawn; 0");
    assert.ok((await tab.value(more)) > 5);
    assert.ok(tab.said.every((one) => one.includes("a test")), tab.said.join());
    await tab.close();
  },

  "the speed that is shown is kept": async () => {
    const tab = await open(link("{flow: usf, phi: 0.1, particles: 100, collision: {e: 0.9}}"));
    /* answers that take a fifth of a second, as on a slow machine: nothing of the time between is lost */
    await tab.value(slower(200));
    await wait(1500);
    const clock = "[performance.now() / 1000, page.frame.md.collisionsPerGrain]";
    const [t0, c0] = await tab.value(clock);
    await wait(6000);
    const [t1, c1] = await tab.value(clock);
    const speed = (c1 - c0) / (t1 - t0);
    assert.ok(speed > 0.7 && speed < 1.35, `1 shown, ${speed} kept`);
    assert.strictEqual(await tab.value("page.behind"), 0);
    /* what cannot be kept is said */
    await tab.value("page.slower = 2200; 0");
    await tab.until("byId('warnings').textContent.includes('cannot go faster')", 20);
    await silent(tab);
  },

  "paused: a start that is refused leaves the picture of the gas before": async () => {
    const tab = await open(link("{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.9}}"));
    await tab.value("byId('play').click()");
    await tab.value(slower(500));
    await tab.value('start("{flow: hcs, phi: 0.1, particles: 200, collision: {e: 0.9}}", {})');
    await tab.until("page.inFlight && !page.wantFrame", 10);
    await tab.value('start("{flow: usf, phi: 7}", {})');
    await tab.until("page.frame && page.about.values.flow === 'hcs'", 10);
    await silent(tab);
  },

  "links: lessons beside their own gas, languages, the gas that waits": async () => {
    const bad = encodeURIComponent("{flow: usf, phi: 7}"),
      good = encodeURIComponent("{flow: hcs, phi: 0.1, particles: 200, collision: {e: 0.9}}");
    const tab = await open(`#scene=${bad}&lesson=haff`);
    assert.deepStrictEqual(await tab.value("[page.lesson, byId('lesson-text').hidden, page.speed]"), [null, true, 1]);
    await tab.value("byId('lesson-friction').click()");
    await tab.until("page.lesson === 'friction' && page.about.values.collision.mu === 0.2", quick);
    await tab.value(`location.hash = "#scene=${bad}&lesson=haff"; 0`);
    await tab.until("byId('refused').textContent", quick);
    assert.strictEqual(await tab.value("page.lesson"), "friction");
    await tab.value(`location.hash = "#scene=${encodeURIComponent("{flow: usf, phi: 0.1}\0x")}"; 0`);
    await tab.until("byId('refused').textContent.includes('control characters')", quick);
    await tab.value(`location.hash = "#scene=${good}&seed=5&language=de"; 0`);
    await tab.until("page.about.values.flow === 'hcs' && document.documentElement.lang === 'de'", quick);
    /* while a result is played the address is of the gas that waits, in the language that is chosen */
    await drop(tab, "class.h5", resultOf(PLAYED).bytes);
    await tab.until("page.player && page.player.shown >= 0", quick);
    await tab.value("byId('language').value = 'en'; byId('language').dispatchEvent(new Event('change')); 0");
    assert.match(await tab.value("location.hash"), /hcs.*seed=5.*language=de/);
    await tab.value("byId('back').click()");
    assert.match(await tab.value("location.hash"), /hcs.*seed=5$/);
    await silent(tab);
  },

  "mixtures: velocities of each species": async () => {
    const tab = await open(link("{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.9}, species: [{fraction: 0.5}, {fraction: 0.5, diameter: 2, mass: 8}], run: {collisions: 100, warmup: 10}}"));
    for (const which of ["Cx_1", "Cy_1", "Cx_2", "Cy_2"])
      await tab.until(`byId("chart-velocities").querySelector("[data-name='velocities md ${which}']")`, quick);
    assert.match(await tab.value("byId('chart-velocities').querySelector('.legend').textContent"), /md: Cx,2/);
    await silent(tab);
  },

  "between walls: T beside its mean, an open top without a lid": async () => {
    const tab = await open(link("{flow: couette, phi: 0.2, particles: 500, collision: {e: 0.9, beta: 0}, run: {collisions: 300, warmup: 100}}"));
    await tab.value("page.speed = 100; 0");
    await tab.until("page.means && page.means.progress.md.over && page.frame.md.collisionsPerGrain > 300", quick);
    const [mean, live] = await tab.value("[page.means.md.results.temperature.mean, page.history.column('T').slice(-20).reduce((a, b) => a + b) / 20]");
    assert.ok(Math.abs(live / mean - 1) < 0.15, `live ${live}, mean ${mean}`);
    const lids = (top) => tab.value(`(async () => { await start("{flow: chute, phi: 0.2, particles: 300, collision: {e: 0.8}, walls: {top: ${top}}}", {});
      while (!page.frame) await new Promise((r) => setTimeout(r, 20));
      let n = 0; const wall = page.view.wall; page.view.wall = () => n++; drawFrame(); page.view.wall = wall; return n; })()`);
    assert.deepStrictEqual([await lids("open"), await lids("closed")], [1, 2]);
    await silent(tab);
  },

  "the box turns with a button that is held, no longer": async () => {
    const tab = await open(link("{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.9}}"));
    await tab.value("byId('box').scrollIntoView(); 0");
    const [x, y] = await tab.value("(({ x, y, width, height }) => [x + width / 2, y + height / 2])(byId('box').getBoundingClientRect())");
    const mouse = (type, more) => tab.send("Input.dispatchMouseEvent", { type, x, y, ...more });
    const yaw = () => tab.value("page.view.yaw"),
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
    await tab.value("byId('box').dispatchEvent(new PointerEvent('pointercancel'))");
    await mouse("mouseMoved", { x: x + 90, button: "left", buttons: 1 });
    assert.strictEqual(await yaw(), turned);
    await silent(tab);
  },

  "pause, one collision, faster and slower, restart": async () => {
    const tab = await open(link("{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.9}}"));
    await tab.value("byId('play').click()");
    await wait(400);
    const before = await tab.value("page.frame.md.collisions");
    await wait(700);
    assert.strictEqual(await tab.value("page.frame.md.collisions"), before);
    for (let k = 1; k <= 3; k++) {
      await tab.value("byId('step').click()");
      await tab.until(`page.frame.md.collisions === ${before + k} && page.frame.event`, quick);
    }
    assert.match(await tab.value("byId('event').textContent"), /Grains \d+ and \d+ met/);
    for (let k = 0; k < 9; k++) await tab.value("byId('faster').click()");
    assert.strictEqual(await tab.value("page.speed"), 1000);
    for (let k = 0; k < 9; k++) await tab.value("byId('slower').click()");
    assert.strictEqual(await tab.value("page.speed"), 0.001);
    await tab.value("byId('restart').click()");
    await tab.until("page.frame && page.frame.md.collisions === 0", quick);
    await silent(tab);
  },

  "a result is dropped, played, scrubbed, and left": async () => {
    const { printed, bytes } = resultOf(PLAYED),
      tab = await open(link("{flow: hcs, phi: 0.1, particles: 200, collision: {e: 0.9}}"));
    const file = path.join(browser.home, "class.h5");
    fs.writeFileSync(file, bytes);
    await tab.until("page.means", quick);
    await drop(tab, "class.h5", bytes);
    await tab.until("page.player && page.player.shown >= 0", quick);
    const last = (await tab.value("page.player.frames")) - 1;
    assert.ok(last > 10);
    assert.match(await tab.value("document.title"), /class\.h5: .*shear/);
    assert.deepStrictEqual(await tab.value("[page.about.values.flow, byId('flow').value]"), ["usf", "usf"]);
    /* forwards by itself, to the end; colours, spins */
    await tab.value("for (let k = 0; k < 9; k++) byId('faster').click()");
    assert.match(await tab.value("byId('speed').textContent"), /60 frames/);
    await tab.until(`page.player.shown === ${last} && !page.playing`, quick);
    assert.ok((await tab.value(DRAWN)).share > 0.1);
    assert.ok(await tab.value("page.frame.picture.marks !== null && byId('colour').querySelector('[value=since]').disabled"));
    /* by hand, with the keyboard */
    await tab.value("byId('scrub').focus()");
    await tab.press("Home");
    await tab.until("page.player.shown === 0", quick);
    const first = await tab.value("page.frame.md.time");
    await tab.value("byId('step').click()");
    await tab.until(`page.player.shown === 1 && page.frame.md.time > ${first}`, quick);
    assert.match(await tab.value("byId('frame-number').textContent"), new RegExp(`^2 of ${last + 1}$`));
    /* its means in the table and in the text */
    await tab.until("page.means && page.means.stored", quick);
    assert.strictEqual(await tab.value("page.means.md.results.temperature.mean"), printed.results.temperature.mean);
    assert.match(await tab.value("byId('table').innerText"), /temperature/);
    await tab.value("say()");
    assert.match(await tab.value("byId('summary').textContent"), /class\.h5, frame 2 of .*Mean so far: md 0\.\d/);
    await tab.until("byId('chart-temperature').querySelector('[data-name=now]')", quick);
    /* files that are refused leave it as it is */
    const damaged = Buffer.from(bytes);
    damaged[5000] ^= 1;
    const without = resultOf("{flow: usf, engine: dsmc, phi: 0.1, dsmc: {particles: 200}, run: {collisions: 9, warmup: 1}}");
    for (const [given, words] of [
      [Buffer.from("no result"), refusalOf(Buffer.from("no result"))],
      [damaged, refusalOf(damaged)],
      [without.bytes, "given.h5: nothing to play: it holds no positions of grains"],
    ]) {
      await drop(tab, "given.h5", given);
      await tab.until("byId('file-refused').textContent", quick);
      const said = await tab.value("byId('file-refused').textContent");
      assert.ok(said.startsWith("given.h5: ") && words.endsWith(said), `${said}\n${words}`);
      assert.strictEqual(await tab.value("page.player.name"), "class.h5");
    }
    /* back to the gas that waited */
    await tab.value("byId('back').click()");
    await tab.until("!page.player && page.about.values.flow === 'hcs' && page.frame && !byId('player').offsetWidth", quick);
    /* chosen by its button; and from there a live gas of that scene */
    await tab.choose("#file", file);
    await tab.until("page.player && page.player.shown >= 0", quick);
    await tab.value("byId('run-live').click()");
    await tab.until("!page.player && page.about.values.flow === 'usf' && page.frame && page.frame.dsmc", quick);
    assert.strictEqual(await tab.value("byId('refused').textContent + byId('file-refused').textContent"), "");
    await silent(tab);
  },

  "the trajectories of the terminal": async () => {
    const tab = await open();
    for (const name of ["smooth, sheared", "rough, sheared", "frictional, sheared", "cooling", "monte carlo, rough"]) {
      const there = JSON.parse(terminal(scenes[name], "fingerprint", "--json")).fingerprint;
      assert.strictEqual(
        (await tab.value(`page.live.ask("hash", { scene: ${JSON.stringify(scenes[name])}, collisions: 100000 })`)).hash,
        there,
        name,
      );
    }
    await silent(tab);
  },

  "what is seen does not depend on how often it is drawn": async () => {
    const scene = JSON.stringify("{flow: usf, phi: 0.2, particles: 300, collision: {e: 0.9}}"),
      tab = await open();
    await tab.value("page.playing = false");
    const walk = async (pieces) =>
      tab.value(`(async () => { await page.live.ask("start", { scene: ${scene}, sets: {} }); let f;
      for (let k = 0; k < ${pieces}; k++) f = await page.live.ask("frame", { collisions: 1e-9, colour: "speed" });
      for (;;) { f = await page.live.ask("frame", { colour: "speed", step: true }); if (f.md.collisions >= 300) break; }
      return [f.md.collisions, f.md.temperature, ...f.event.k]; })()`);
    assert.deepStrictEqual(await walk(1), await walk(50));
    await silent(tab);
  },

  "curves pass through the terminal's means": async () => {
    const scene =
      "{flow: usf, phi: 0.1, particles: 500, collision: {e: 0.9, beta: 0}, run: {collisions: 2000, warmup: 200}}";
    const there = JSON.parse(
      terminal(scene, "compare", "--json", "--quiet", "--output", "/dev/null", "--picture", "none"),
    );
    const tab = await open(link(scene));
    await tab.until(
      "page.means && page.means.progress.md && page.means.progress.md.over && page.means.progress.dsmc.over",
      120,
    );
    for (const engine of ["md", "dsmc"]) {
      const { mean, stderr } = there[engine].results.temperature;
      const drawn =
        await tab.value(`(() => { const f = byId("chart-temperature"), { yr } = JSON.parse(f.dataset.scales), line = f.querySelector("[data-name='mean ${engine} temperature']");
        const y = +line.getAttribute("points").split(" ")[0].split(",")[1]; return yr[0] + (HIGH - BOTTOM - y) / (HIGH - BOTTOM - TOP) * (yr[1] - yr[0]); })()`);
      assert.ok(Math.abs(drawn - mean) < 4 * stderr + 0.01, `${engine}: drawn ${drawn}, terminal ${mean} +- ${stderr}`);
      assert.strictEqual(await tab.value(`page.means.${engine}.results.temperature.mean`), mean);
    }
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
        said = await tab.value("byId('refused').textContent");
      const there = refusal(scene, "fingerprint").trim(),
        end = there.slice(there.lastIndexOf(": ") + 2).slice(0, 60);
      assert.ok(said.length > 10 && said.includes(end.slice(0, 40)), `${said}\n${there}`);
      assert.strictEqual(await tab.value("document.querySelectorAll('img, main script').length"), 0);
      assert.strictEqual(await tab.value("page.about.values.flow"), "usf");
      await silent(tab);
    }
    const tab = await open("#set=collision.e=9&set=nonsense=1&set=%00&lesson=__proto__&language=xx&seed=-1");
    assert.match(await tab.value("byId('refused').textContent"), /collision\.e/);
    await silent(tab);
  },

  "controls wait for the gas, and nothing of one stands beside the next": async () => {
    const tab = await browser.open(file, { hash: link("{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.9}}") });
    await tab.until("typeof page === 'object' && page.controls", quick);
    assert.ok(await tab.value("page.about !== null || byId('main').inert"));
    await tab.until("page.means && page.frame && byId('theory-boxes').querySelector('input')", quick);
    assert.strictEqual(await tab.value("byId('main').inert"), false);
    const shown = `["chart-stress", "chart-velocities", "table", "ranges"].map((id) =>
      byId(id).querySelectorAll("g path, polyline, tbody tr, li:not(.legend li)").length)`;
    await tab.until(`${shown}[0] > 0 && ${shown}[2] > 0 && ${shown}[3] > 0`, quick);
    await tab.until("/^Uniform shear/.test(byId('summary').textContent)", 4);
    const emptied = await tab.value(`(async () => {
      await start("{flow: hcs, phi: 0.1, particles: 200, collision: {e: 0.9}}", {});
      const left = ${shown}; byId("theory-boxes").querySelector("input").click(); return left; })()`);
    assert.deepStrictEqual(emptied, [0, 0, 0, 0]);
    await tab.until("/^Homogeneous cooling/.test(byId('summary').textContent)", 4);
    await silent(tab);
  },

  "the gas that waits is measured to its end": async () => {
    const tab = await open(
      link("{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.9}, run: {collisions: 300, warmup: 20}}"),
    );
    const { bytes } = resultOf(PLAYED),
      brief = resultOf(PLAYED.replace("trajectory_every: 1", "trajectory_every: 8")).bytes;
    await tab.until("page.means", quick);
    const over = "Object.values(page.means.progress).every((p) => p.over)";
    const waits = !(await tab.value(over));
    await drop(tab, "long.h5", bytes);
    await tab.until("page.player && page.player.shown > 10", quick);
    /* another while it plays: what is under way of the first is not the second's */
    await tab.value("byId('faster').click(), byId('faster').click()");
    await drop(tab, "brief.h5", brief);
    await tab.until("page.player.name === 'brief.h5' && page.player.shown === page.player.frames - 1", quick);
    assert.strictEqual(await tab.value("byId('file-refused').textContent"), "");
    if (waits) await tab.until("Object.values(page.shelf.means.progress).every((p) => p.over)", quick);
    await tab.value("byId('back').focus(), byId('back').click()");
    assert.strictEqual(await tab.value("document.activeElement.id"), "play");
    const done = "/md done, dsmc done/.test(byId('progress').textContent)";
    await tab.until(`!page.player && page.means && ${over} && ${done}`, 10);
    await silent(tab);
  },

  "the mark ! is the library's": async () => {
    const tab = await open();
    await tab.until("page.means && page.means.comparison", quick);
    assert.deepStrictEqual(
      await tab.value(`(() => { const body = document.createElement("table");
      body.append(document.createElement("thead"), document.createElement("tbody"));
      const results = { temperature: { mean: 1, stderr: 0.1, unit: "" }, pressure: { mean: 1, stderr: 0.1, unit: "" } };
      fillTable(body, { md: { results }, dsmc: { results }, theory: {}, theories: {}, comparison: [
        { quantity: "temperature", md_dsmc_z: 3.5, beyond_expected: false },
        { quantity: "pressure", md_dsmc_z: -2, beyond_expected: true }] }, false);
      return [...body.tBodies[0].rows].map((row) => row.cells[4].textContent); })()`),
      ["+3.5", "-2.0 !"],
    );
    assert.ok(await tab.value("page.means.comparison.every((row) => typeof row.beyond_expected === 'boolean')"));
    await silent(tab);
  },

  "what is taken along: picture, curves, scene, link": async () => {
    const tab = await open(
      link("{flow: usf, phi: 0.1, particles: 200, collision: {e: 0.9}, run: {collisions: 200, warmup: 20}}"),
    );
    await tab.until("page.history.rows.length > 3 && page.means && page.means.md && page.means.md.curves", quick);
    await tab.value("page.taken = {}; save = (name, blob) => { page.taken[name] = blob; }; 0");
    for (const id of ["save-png", "save-csv", "save-yaml"]) await tab.value(`byId("${id}").click()`);
    await tab.until("Object.keys(page.taken).length === 3", quick);
    const head = await tab.value("page.taken['graingas.png'].arrayBuffer().then((b) => [...new Uint8Array(b, 0, 8)])");
    assert.deepStrictEqual(head, [137, 80, 78, 71, 13, 10, 26, 10]);
    const [title, columns, ...rows] = (await tab.value("page.taken['graingas.csv'].text()")).trim().split("\n");
    assert.match(title, /^# Uniform shear flow/);
    assert.strictEqual(columns, "curve,x_name,x,value,error");
    assert.ok(rows.every((row) => /^[^,]+,[^,]+,-?[\d.e+-]+,-?[\d.e+-]+,[\d.e+-]*$/.test(row)), rows.join("\n"));
    for (const curve of ["md_temperature", "dsmc_temperature", "md_velocity_distribution_Cx"])
      assert.ok(rows.some((row) => row.startsWith(`${curve},`)), curve);
    const yaml = await tab.value("page.taken['scene.yaml'].text()");
    const hash = (scene) => JSON.parse(terminal(scene, "fingerprint", "--json", "--set", "engine=md")).fingerprint;
    assert.strictEqual(hash(yaml), hash(await tab.value("page.scene")));
    /* seeds that are no double go with the link */
    await tab.value("void start(page.scene, { 'run.seed': '9007199254740993' })");
    await tab.until("page.sets['run.seed'] && /seed=9007199254740993&?/.test(location.hash)", quick);
    await silent(tab);
  },

  "theories are drawn as chosen": async () => {
    const tab = await open(link("{flow: hcs, phi: 0.1, particles: 300, collision: {e: 0.9}}"));
    await tab.until("page.means && byId('theory-boxes').querySelectorAll('input').length > 4", quick);
    const lines = () =>
      tab.value(
        "[...byId('chart-temperature').querySelectorAll('polyline')].map((l) => l.dataset.name).filter((n) => / temperature$/.test(n)).map((n) => n.split(' ')[0])",
      );
    await tab.until("byId('chart-temperature').querySelector(\"[data-name='haff1983 temperature']\")", quick);
    assert.strictEqual((await lines()).length, 4);
    const all = await tab.value(
      "for (const box of byId('theory-boxes').querySelectorAll('input')) { if (!box.checked) box.click(); } [...page.drawnTheories]",
    );
    assert.ok(all.length > 4);
    await tab.until(`[...byId('chart-temperature').querySelectorAll('polyline')].filter((l) => / temperature$/.test(l.dataset.name)).length === ${all.length}`, quick);
    /* of a sheared gas: a theory has its colour in both diagrams, and no two share one */
    const sheared = await open("#lesson=normal_stress");
    for (const at of ["#chart-temperature", "#chart-stress"])
      await sheared.until(`document.querySelectorAll("${at} .legend li").length > 5`, quick);
    const keys = await sheared.value(`[...document.querySelectorAll("#chart-temperature li, #chart-stress li")]
      .map((li) => [li.textContent, li.querySelector("line, path").getAttribute("stroke")])
      .filter(([name]) => name.replace(" †", "") in page.means.theory)`);
    assert.ok(keys.length > 5);
    assert.strictEqual(new Set(keys.map(String)).size, new Set(keys.map(([name]) => name)).size);
    assert.strictEqual(new Set(keys.map(String)).size, new Set(keys.map(([, colour]) => colour)).size);
    await silent(sheared);
    /* Haff's line, by the library, through the gas it is of: the first point of both */
    const [T, haff] = await tab.value(
      "[page.history.rows[0].T, page.means.cooling.T.haff1983[0]]",
    );
    assert.ok(Math.abs(T / haff - 1) < 0.1, `${T} and ${haff}`);
    await tab.value("byId('theory-boxes').querySelector('[value=haff1983]').click()");
    await tab.until("!byId('chart-temperature').querySelector(\"[data-name='haff1983 temperature']\")", quick);
    await silent(tab);
  },

  "keyboard, and nothing moves for those who asked for that": async () => {
    const tab = await open("", { media: [{ name: "prefers-reduced-motion", value: "reduce" }] });
    assert.strictEqual(await tab.value("page.playing"), false);
    assert.ok(
      await tab.value(
        "[...document.querySelectorAll('button, input, select, textarea, canvas, summary')].every((e) => e.disabled || e.tabIndex >= 0 || e.ariaHidden === 'true' || e.getAttribute('aria-hidden') === 'true')",
      ),
    );
    await tab.value("byId('box').focus()");
    const yaw = await tab.value("page.view.yaw");
    for (const type of ["keyDown", "keyUp"])
      await tab.send("Input.dispatchKeyEvent", {
        type,
        key: "ArrowRight",
        code: "ArrowRight",
        windowsVirtualKeyCode: 39,
      });
    assert.ok((await tab.value("page.view.yaw")) > yaw);
    await silent(tab);
  },

  "each text in both languages": async () => {
    const tab = await open("#language=de");
    assert.ok(
      await tab.value(
        "Object.values(STRINGS).every((two) => two.length === LANGUAGES.length && two.every((one) => one.length)) && LESSONS.every((l) => [l.title, l.text, l.question].every((two) => two.length === 2))",
      ),
    );
    assert.deepStrictEqual(
      await tab.value(
        "[...document.querySelectorAll('[data-t]')].filter((e) => !STRINGS[e.dataset.t]).map((e) => e.dataset.t)",
      ),
      [],
    );
    await silent(tab);
  },

  "axe-core finds nothing": async () => {
    const at = [process.env.AXE, path.join(__dirname, "node_modules/axe-core/axe.min.js")].find(
      (one) => one && fs.existsSync(one),
    );
    if (!at) return "SKIP axe-core is not there (npm install in tests/page; ./check-page does it)";
    const axe = fs.readFileSync(at, "utf8"),
      { bytes } = resultOf(PLAYED);
    for (const [width, height] of [
      [390, 844],
      [1366, 768],
    ])
      for (const hash of ["#lesson=equipartition", "#lesson=clustering&language=de"]) {
        const tab = await open(hash, { width, height });
        await tab.until("page.means && page.means.md && page.means.md.results.N1", quick);
        await tab.value(`${axe}; byId("theories").open = true; 0`);
        const found = async () =>
          tab.value(
            "axe.run(document).then((r) => r.violations.map((v) => `${v.id}: ${v.help}: ${v.nodes.map((n) => n.target).join(' ')}`))",
          );
        assert.deepStrictEqual(await found(), []);
        await drop(tab, "class.h5", bytes);
        await tab.until("page.means && page.means.stored && page.player.shown >= 0", quick);
        assert.deepStrictEqual(await found(), []);
        await drop(tab, "none.h5", Buffer.from("no result"));
        await tab.until("byId('file-refused').textContent", quick);
        assert.deepStrictEqual(await found(), []);
        await tab.close();
      }
    return "";
  },

  "sixty frames a second with 1000 grains": async () => {
    const tab = await open(link("{flow: usf, phi: 0.1, particles: 1000, collision: {e: 0.9, beta: 0}}"));
    const { cost, shown } =
      await tab.value(`(async () => { const wait = (ms) => new Promise((r) => setTimeout(r, ms)); await wait(1500);
      const from = page.frames, begin = performance.now(); await wait(3000); const shown = (page.frames - from) / (performance.now() - begin) * 1000;
      const f = page.frame, o = { images: true, event: null }, all = []; page.playing = false;
      for (let k = 0; k < 60; k++) { const a = performance.now(); page.view.draw(f.picture, f.md, page.about, o); all.push(performance.now() - a); await wait(5); }
      return { cost: all.sort((a, b) => a - b)[20], shown }; })()`);
    console.log(
      `# 1000 grains, without a graphics processor: ${shown.toFixed(0)} frames a second; ${cost.toFixed(1)} ms of the page's own for each`,
    );
    assert.ok(shown >= +(process.env.FRAMES || 1) && cost < 100);
    await silent(tab);
  },

  "memory does not grow": async () => {
    const tab = await open(
        link("{flow: usf, phi: 0.1, particles: 500, collision: {e: 0.9, beta: 0}, run: {relative_error: 0.0001}}"),
      ),
      seconds = +(process.env.PAGE_SECONDS || 12);
    await tab.value("page.speed = 100");
    const used = async () => {
      await tab.send("HeapProfiler.collectGarbage");
      const heap = (await tab.send("Runtime.getHeapUsage")).usedSize;
      return [
        heap,
        ...(await Promise.all(
          ["live", "measure"].map((who) => tab.value(`page.${who}.ask("memory").then((a) => a.bytes)`)),
        )),
      ];
    };
    await wait((1000 * seconds) / 3);
    const before = await used();
    await wait((1000 * 2 * seconds) / 3);
    const after = await used();
    console.log(
      `# bytes of the page's heap, of both modules: ${before} and, after ${((2 * seconds) / 3).toFixed(0)} s more, ${after}`,
    );
    assert.ok(
      after[0] - before[0] < 4e6 && after[1] === before[1] && after[2] - before[2] < 20e6 /* while series fill up */,
    );
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
  try {
    await list(process.argv[2] ? { [process.argv[2]]: tests[process.argv[2]] } : tests, null);
  } finally {
    await browser.close();
  }
})();
