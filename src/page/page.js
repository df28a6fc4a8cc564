/* The page itself: who asks the workers for what, and where their answers are shown. */
const byId = (id) => document.getElementById(id);
const START = "{flow: usf, phi: 0.1, particles: 1000, collision: {e: 0.9, beta: 0}}";
const SPEEDS = [0.001, 0.01, 0.1, 1, 10, 100, 1000];

/* A worker whose jobs are answered one by one. */
class Helper {
  constructor(source) {
    this.worker = new Worker(source);
    this.waiting = new Map();
    this.count = 0;
    this.worker.onmessage = ({ data }) => {
      const one = this.waiting.get(data.id);
      this.waiting.delete(data.id);
      if (one && data.job === one.job) one.settle(data);
      else if (this.onmeans && data.job === "means") this.onmeans(data);
    };
  }
  ask(job, more = {}, transfer = []) {
    const id = ++this.count;
    return new Promise((resolve, reject) => {
      this.waiting.set(id, { job, settle: (data) => (data.refused === undefined ? resolve({ ...data.answer, id }) : reject(new Error(data.refused))) });
      this.worker.postMessage({ job, id, ...more }, transfer);
    });
  }
}

const page = {
  scene: START, sets: {}, lesson: null, playing: true, speed: 1, frames: 0, starts: 0,
  about: null, frame: null, means: null, history: null, live: null, measure: null, view: null, controls: null,
};

/* ---- Beginning ---- */

async function wasmBytes() {
  const packed = Uint8Array.from(atob(byId("wasm").textContent.trim()), (c) => c.charCodeAt(0));
  byId("wasm").textContent = "";
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

async function openWorkers() {
  const bytes = await wasmBytes(), source = URL.createObjectURL(new Blob([byId("worker").textContent], { type: "text/javascript" }));
  page.live = new Helper(source);
  page.measure = new Helper(source);
  page.measure.onmeans = takeMeans;
  const answers = await Promise.all([page.live.ask("open", { wasm: bytes }), page.measure.ask("open", { wasm: bytes })]);
  byId("version").textContent = answers[0].version;
}

function givenScene() {
  const text = byId("given").textContent;
  return text.includes("@given") ? null : JSON.parse(text);
}

async function begin() {
  const link = readLink(), wanted = LANGUAGES.indexOf(link.language || (navigator.language || "en").slice(0, 2));
  language = Math.max(0, wanted);
  page.view = new BoxView(byId("box"));
  page.controls = new Controls(byId("control-rows"), changeKey);
  page.playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  lessonButtons();
  listen();
  showLanguage();
  byId("summary").textContent = t("loading");
  try { await openWorkers(); } catch (e) {
    byId("summary").textContent = t("broken", { why: e.message });
    return;
  }
  await follow(link);
  requestAnimationFrame(tick);
}

/* What a link, the command or nobody asks for. A lesson's name alone is its scene. */
async function follow(link) {
  const lesson = LESSONS.find((one) => one.name === link.lesson);
  page.lesson = lesson ? lesson.name : null;
  const scene = link.scene !== null ? link.scene : lesson ? lesson.scene : givenScene() || START;
  if (lesson) takeLook(lesson);
  showLesson();
  if (!(await start(scene, link.sets)) && !page.about) await start(START, {}, true);
}

/* ---- A new gas ---- */

/* Whether the scene is one; if not, the gas that there was goes on, and the message says why. */
async function start(scene, sets, keepMessage = false) {
  const mine = ++page.starts;
  let answer;
  try { answer = await page.live.ask("start", { scene, sets }); } catch (e) {
    if (mine === page.starts) refuse(e.message, sets);
    return false;
  }
  if (mine !== page.starts) return true;
  if (!keepMessage) byId("refused").textContent = "";
  Object.assign(page, { scene, sets, about: answer.about, refusal: answer.refusal, dsmcRefusal: answer.dsmcRefusal, means: null, frame: null, behind: 0 });
  page.history = new Past(answer.about.values.flow === "hcs");
  page.controls.show(answer.about.values);
  byId("images-row").hidden = !sheared();
  byId("yaml").value = page.scene;
  byId("title").textContent = answer.about.title;
  byId("event").textContent = "";
  document.title = `${answer.about.title} – graingas`;
  writeLink(page);
  page.wantFrame = true;
  showCharts();
  byId("table").tBodies[0].replaceChildren();
  byId("progress").textContent = t("waiting");
  askMeans();
  return true;
}

/* Theories take a second: only the newest scene is measured, after the sliders rest. */
function askMeans() {
  clearTimeout(page.meansTimer);
  page.meansTimer = setTimeout(async () => {
    if (page.asking) { askMeans(); return; }
    page.asking = true;
    const mine = page.starts;
    page.measuringId = page.measure.count + 1;
    try {
      const answer = await page.measure.ask("measure", { scene: page.scene, sets: page.sets });
      if (mine === page.starts) showMeans(answer);
    } catch (e) {
      if (mine === page.starts) byId("progress").textContent = e.message;
    }
    page.asking = false;
  }, 300);
}
function takeMeans(data) {
  if (data.id === page.measuringId && !page.asking) showMeans(data.answer);
}

function refuse(message, sets) {
  byId("refused").textContent = message.slice(0, 600);
  for (const key of Object.keys(sets)) if (message.includes(key)) page.controls.refuse(key);
}

/* An elastic gas needs e = 1, and so do those keys that would cost energy; the others get theirs back. */
function changeKey(key, value) {
  const sets = { ...page.sets, ...page.pending, [key]: value };
  if (key === "flow" && value === "equilibrium") Object.assign(sets, { "collision.e": "1", "collision.beta": "-1", "collision.mu": "inf" });
  else if (key === "flow" && page.about && page.about.values.collision.e === 1) sets["collision.e"] = "0.9";
  page.pending = sets;
  clearTimeout(page.changeTimer);
  page.changeTimer = setTimeout(() => { page.pending = {}; start(page.scene, sets); }, 120);
}

/* ---- Frames: the gas is asked to go on as far as the clock on the wall says ---- */

function tick(now) {
  const seconds = Math.min((now - (page.last || now)) / 1000, 0.25);
  page.last = now;
  if (page.newFrame) { page.newFrame = false; drawFrame(); }
  if (page.about && !page.inFlight && (page.playing || page.wantFrame || page.wantStep)) ask(seconds);
  if (now - (page.slow || 0) > 300 && page.changed) { page.slow = now; page.changed = false; showCharts(); }
  if (now - (page.said || 0) > 8000 && page.frame) { page.said = now; say(); }
  requestAnimationFrame(tick);
}

async function ask(seconds) {
  const mine = page.starts, step = page.wantStep;
  page.inFlight = true;
  page.wantFrame = page.wantStep = false;
  try {
    const answer = await page.live.ask("frame", { collisions: page.playing && !step ? page.speed * seconds : 0, colour: byId("colour").value, step });
    if (mine === page.starts) takeFrame(answer, step);
  } catch (e) { byId("refused").textContent = e.message; page.playing = false; }
  page.inFlight = false;
}

function takeFrame(frame, step) {
  page.frame = frame;
  page.newFrame = page.changed = true;
  page.frames++;
  page.behind = frame.behind ? page.behind + 1 : 0;
  page.history.add(frame.md, frame.dsmc);
  if (step) showEvent(frame.event);
}

function drawFrame() {
  const { picture, md, event } = page.frame;
  if (md) page.view.draw(picture, md, page.about, { images: byId("images").checked, event });
  else page.view.draw(null, page.frame.dsmc, page.about, {});
  showClock(md || page.frame.dsmc);
}

/* ---- What is shown ---- */

const sheared = () => /usf|shear/.test(page.about.values.flow);
const timeUnit = () => (sheared() ? "1/γ" : "d/v₀");

function showClock(s) {
  byId("clock").textContent = t("clock", { c: s.collisionsPerGrain.toFixed(s.collisionsPerGrain < 100 ? 2 : 0), t: number(s.time), unit: timeUnit(), n: s.collisions })
    + (sheared() ? t("clockStrain", { s: s.strain.toFixed(2) }) : "");
}

function showEvent(event) {
  byId("event").textContent = event ? t("event", { a: event.grain[0] + 1, b: event.grain[1] + 1, g: number(event.normalSpeed, 3), unit: sheared() ? "d γ" : "v₀",
    k: event.k.map((x) => x.toFixed(2)).join(", ") }) : "";
}

function showCharts() {
  temperatureChart(byId("chart-temperature"), page.history, page.means, page.about.values);
  showNotices();
}

function showMeans(means) {
  page.means = means;
  velocityChart(byId("chart-velocities"), means);
  stressChart(byId("chart-stress"), means);
  fillTable(byId("table"), means, byId("everything").checked);
  fillRanges(byId("ranges"), means);
  const phase = (engine) => {
    const p = means.progress[engine];
    if (!p) return t("phaseNone");
    return p.over ? t("phaseDone") : t(p.averaging ? "phaseAverage" : "phaseWarm", { p: Math.floor(100 * p.fraction) });
  };
  byId("progress").textContent = t("progress", { md: phase("md"), dsmc: phase("dsmc") });
  page.changed = true;
}

/* Where the model stops being true, and what the library warns of. */
function notices() {
  const out = [], { means, about, frame } = page, add = (key, values) => out.push(t(key, values));
  if (page.refusal) add("noBox", { why: page.refusal });
  if (page.dsmcRefusal) out.push(`dsmc: ${page.dsmcRefusal}`);
  if (frame && frame.ended) add("ended", { engine: frame.md ? "md" : "dsmc", why: frame.ended });
  if (frame && frame.dsmcEnded) add("ended", { engine: "dsmc", why: frame.dsmcEnded });
  if (page.behind > 40) add("behind");
  if (!means) return out;
  const length = mean(means.theory && means.theory.goldhirsch_zanetti1993, "clustering_length");
  if (about.values.flow === "hcs" && frame && frame.md && Math.max(...frame.md.box) > length) add("clusters", { l: number(length, 3) });
  const caught = means.md && means.md.engine_state && means.md.engine_state.contact_time_collisions;
  if (caught > 1e-3 * means.md.collisions) add("collapse", { n: caught });
  const ratio = mean(means.md && means.md.results, "temperature_ratio");
  if (frame && frame.md && ratio > 0 && Math.abs(frame.md.rotationalTemperature / frame.md.temperature / ratio - 1) > 4 * Math.sqrt(4 / (3 * frame.md.grains))) add("spins");
  for (const [engine, p] of Object.entries(means.progress)) {
    if (p.why) add("ended", { engine, why: p.why });
    else if (p.over && means[engine] && means[engine].steady === false) add("steady_no", { engine, why: means[engine].verdict });
  }
  for (const engine of ["md", "dsmc"]) for (const w of (means[engine] && means[engine].warnings) || []) if (!/null|not a steady mean|has no error|too short for errors/.test(w)) out.push(`${engine}: ${w}`);
  return [...new Set(out)].slice(0, 7);
}
function showNotices() {
  const now = notices(), text = now.join("\n");
  if (text === page.noticed) return;
  page.noticed = text;
  byId("notices").replaceChildren(...now.map((one) => cell("li", one)));
}

/* For those who hear the page: every few seconds what it shows. */
function say() {
  const s = page.frame.md || page.frame.dsmc, means = page.means, of = (engine) => means[engine] && means[engine].results;
  const both = means && Number.isFinite(mean(of("md"), "temperature")) ? t("summaryMeans", { md: withError(mean(of("md"), "temperature"), error(of("md"), "temperature")),
    dsmc: withError(mean(of("dsmc"), "temperature"), error(of("dsmc"), "temperature")) }) : "";
  byId("summary").textContent = t("summary", { title: page.about.title, c: number(s.collisionsPerGrain, 3), T: number(s.temperature),
    theta: s.rotationalTemperature > 0 ? t("summaryTheta", { theta: number(s.rotationalTemperature) }) : "", means: both });
  byId("box").setAttribute("aria-label", t("boxLabel", { n: s.grains, by: t(`${byId("colour").value}Of`) }));
}

function showScale() {
  const to = byId("scale").getContext("2d");
  for (let i = 0; i < 120; i++) { to.fillStyle = rgb(colourAt(i / 119)); to.fillRect(i, 0, 1, 10); }
  byId("scale-text").textContent = t(`scale_${byId("colour").value}`);
}

function showPlaying() {
  byId("play").textContent = t(page.playing ? "pause" : "play");
  byId("speed").textContent = t("speed", { x: page.speed });
  byId("slower").disabled = page.speed <= SPEEDS[0];
  byId("faster").disabled = page.speed >= SPEEDS[SPEEDS.length - 1];
}

function showLanguage() {
  document.documentElement.lang = LANGUAGES[language];
  byId("language").value = LANGUAGES[language];
  for (const one of document.querySelectorAll("[data-t]")) one.textContent = t(one.dataset.t);
  for (const one of document.querySelectorAll("[data-label]")) one.setAttribute("aria-label", t(one.dataset.label));
  byId("transport").setAttribute("aria-label", t("transport"));
  byId("box").setAttribute("aria-label", t("view"));
  page.controls.name();
  showLesson();
  showScale();
  showPlaying();
  if (page.about) { page.controls.show(page.about.values); page.noticed = null; showCharts(); writeLink(page); }
  if (page.means) showMeans(page.means);
  if (page.frame) say();
}

/* ---- Lessons ---- */

function lessonButtons() {
  for (const lesson of LESSONS) {
    const button = cell("button", "", { type: "button", id: `lesson-${lesson.name}` });
    button.addEventListener("click", () => follow({ scene: null, sets: {}, lesson: lesson.name }));
    byId("lesson-buttons").append(button);
  }
}
function takeLook(lesson) {
  page.speed = SPEEDS.reduce((best, one) => (Math.abs(Math.log(one / lesson.speed)) < Math.abs(Math.log(best / lesson.speed)) ? one : best));
  byId("colour").value = lesson.colour;
  showScale();
  showPlaying();
}
function showLesson() {
  for (const [i, lesson] of LESSONS.entries()) {
    const button = byId(`lesson-${lesson.name}`), now = page.lesson === lesson.name;
    button.textContent = `${i + 1}. ${lesson.title[language]}`;
    button.setAttribute("aria-pressed", String(now));
    if (!now) continue;
    const [text, question] = byId("lesson-text").children;
    text.textContent = lesson.text[language];
    question.textContent = lesson.question[language];
  }
  byId("lesson-text").hidden = !page.lesson;
}

/* ---- What people do ---- */

function listen() {
  const on = (id, what, kind = "click") => byId(id).addEventListener(kind, what);
  const faster = (by) => { page.speed = SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, SPEEDS.indexOf(page.speed) + by))]; showPlaying(); };
  const play = (yes) => { page.playing = yes; if (yes) showEvent(null); showPlaying(); };
  on("play", () => play(!page.playing));
  on("step", () => { play(false); page.wantStep = true; });
  on("slower", () => faster(-1));
  on("faster", () => faster(1));
  on("restart", () => start(page.scene, page.sets));
  on("reseed", () => start(page.scene, { ...page.sets, "run.seed": String(1 + Math.floor(Math.random() * 999999)) }));
  on("colour", () => { showScale(); page.wantFrame = true; }, "change");
  on("images", () => { page.newFrame = !!page.frame; }, "change");
  on("language", () => { language = LANGUAGES.indexOf(byId("language").value); showLanguage(); }, "change");
  on("everything", () => { if (page.means) showMeans(page.means); }, "change");
  on("use-yaml", () => start(byId("yaml").value, {}));
  on("controls", (e) => e.preventDefault(), "submit");
  on("save-png", () => { page.view.again(); byId("box").toBlob((blob) => save("graingas.png", blob)); });
  on("save-csv", () => save("graingas.csv", new Blob([curvesCsv(page.history, page.means, page.about.title)], { type: "text/csv" })));
  on("save-yaml", () => save("scene.yaml", new Blob([page.about.yaml], { type: "text/yaml" })));
  on("copy-link", copyLink);
  window.addEventListener("hashchange", () => follow(readLink()));
  window.addEventListener("resize", () => { page.newFrame = !!page.frame; });
}

async function copyLink() {
  const link = location.href.split("#")[0] + linkOf(page);
  try {
    await navigator.clipboard.writeText(link);
    byId("taken").textContent = t("copied");
  } catch (e) { byId("taken").textContent = t("linkIs", { link }); }
}

begin();
