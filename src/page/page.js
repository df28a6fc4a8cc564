/* The page itself: who asks the workers for what, and where their answers are shown. */
const byId = (id) => document.getElementById(id);
const START = "{flow: usf, phi: 0.1, particles: 1000, collision: {e: 0.9, beta: 0}}";
const SPEEDS = [0.001, 0.01, 0.1, 1, 10, 100, 1000];

const page = {
  scene: START,
  sets: {},
  asked: { scene: START, sets: {} },
  lesson: null,
  playing: true,
  speed: 1,
  frames: 0,
  owed: 0,
  lost: 0,
  behind: 0,
  starts: 0,
  files: 0,
  player: null,
  drawnTheories: null,
  about: null,
  frame: null,
  means: null,
  history: null,
  live: null,
  measure: null,
  view: null,
  controls: null,
};

/* ---- Beginning ---- */

async function wasmBytes() {
  const packed = Uint8Array.from(atob(byId("wasm").textContent.trim()), (c) => c.charCodeAt(0));
  byId("wasm").textContent = "";
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

async function openWorkers() {
  const bytes = await wasmBytes(),
    source = URL.createObjectURL(new Blob([byId("worker").textContent], { type: "text/javascript" }));
  page.live = new Helper(source);
  page.measure = new Helper(source);
  page.measure.onmeans = takeMeans;
  const answers = await Promise.all([
    page.live.ask("open", { wasm: bytes }),
    page.measure.ask("open", { wasm: bytes }),
  ]);
  byId("version").textContent = answers[0].version;
}

function givenScene() {
  const given = JSON.parse(byId("given").textContent);
  return /^@given@$/.test(given) ? null : given;
}

async function begin() {
  const link = readLink();
  language = LANGUAGES.includes(link.language) ? LANGUAGES.indexOf(link.language) : ownLanguage();
  page.view = new BoxView(byId("box"));
  page.controls = new Controls(byId("control-rows"), changeKey, wantedValues);
  page.playing = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  lessonButtons();
  listen();
  showLanguage();
  byId("title").textContent = t("loading");
  try {
    await openWorkers();
  } catch (e) {
    byId("title").textContent = t("broken", { why: e.message });
    return;
  }
  await follow(link);
  byId("main").inert = false; /* until now there was no gas that controls could act on */
  requestAnimationFrame(tick);
}

/* What a link, the command or nobody asks for. A lesson's name alone is its scene. */
async function follow(link) {
  const lesson = LESSONS.find((one) => one.name === link.lesson);
  const scene = link.scene !== null ? link.scene : lesson ? lesson.scene : givenScene() || START;
  if (!(await start(scene, link.sets, { lesson: lesson || null })) && !page.about)
    await start(START, {}, { keepMessage: true });
}
/* Its words stand beside its own gas alone: null takes them away. */
function showLessonOf(lesson) {
  page.lesson = lesson && lesson.name;
  if (lesson) takeLook(lesson);
  showLesson();
}

/* ---- A new gas ---- */

/* Whether the scene is one; if not, the gas that there was goes on, and the message says why. */
async function start(scene, sets, { keepMessage = false, lesson } = {}) {
  const mine = ++page.starts;
  clearTimeout(page.changeTimer); /* whatever a control was about to change is in it, or was of the gas before */
  page.pending = {};
  page.asked = { scene, sets, mine };
  let answer;
  try {
    answer = await page.live.ask("start", { scene, sets });
  } catch (e) {
    if (mine === page.starts) {
      page.asked = { scene: page.scene, sets: page.sets };
      refuse(e.message, sets);
    }
    return false;
  }
  if (!(page.asked.mine > mine)) page.asked = { scene, sets, mine };
  if (!keepMessage) byId("refused").textContent = "";
  if (page.player) {
    leavePlaying();
    page.playing = page.shelf.playing;
  }
  if (page.about && page.about.values.flow !== answer.about.values.flow) page.drawnTheories = null;
  Object.assign(page, {
    scene,
    sets,
    about: answer.about,
    refusal: answer.refusal,
    dsmcRefusal: answer.dsmcRefusal,
    means: null,
    frame: null,
    newFrame: false,
    owed: 0,
    lost: 0,
    behind: 0,
  });
  page.history = new Past(answer.about.values.flow === "hcs");
  if (lesson !== undefined) showLessonOf(lesson);
  showGas();
  writeLink(page);
  page.wantFrame = true;
  byId("progress").textContent = t("waiting");
  askMeans();
  return true;
}

/* What is known of the gas that is seen, before it moves. */
function showGas() {
  const { about } = page,
    title = page.player ? `${page.player.name}: ${about.title}` : about.title;
  page.controls.show(about.values);
  byId("images-row").hidden = !sheared();
  if (document.activeElement !== byId("yaml")) byId("yaml").value = about.yaml; /* nobody's typing is written over */
  byId("title").textContent = title;
  byId("event").textContent = "";
  document.title = `${title} – graingas`;
  page.noticed = null;
  page.said = -Infinity; /* with its first frame */
  showPlaying();
  showCharts();
  clearMeans();
}

/* Theories take a second: only the newest scene is measured, after the sliders rest. */
function askMeans() {
  clearTimeout(page.meansTimer);
  page.meansTimer = setTimeout(async () => {
    if (page.asking) {
      askMeans();
      return;
    }
    page.asking = true;
    const mine = (page.measured = page.about);
    page.measuringId = page.measure.count + 1;
    try {
      const answer = await page.measure.ask("measure", { scene: page.scene, sets: page.sets });
      if (mine === page.about) showMeans(answer);
    } catch (e) {
      if (mine === page.about) byId("progress").textContent = e.message;
    }
    page.asking = false;
  }, 300);
}
function takeMeans(data) {
  if (data.id !== page.measuringId || page.asking) return;
  if (data.refused !== undefined) {
    if (page.measured === page.about) byId("progress").textContent = data.refused;
    return;
  }
  if (page.measured === page.about) showMeans(data.answer);
  else if (page.player && page.measured === page.shelf.about) page.shelf.means = data.answer; /* the gas that waits */
}

function refuse(message, sets) {
  byId("refused").textContent = message.slice(0, 600);
  for (const key of Object.keys(sets)) if (message.includes(key)) page.controls.refuse(key);
}

/* What is asked of the gas by now: the keys set over its scene, those a control is about to change among them; a key as
 * text; and the values that controls build on. What is in force lags behind until the answer. */
const wantedSets = () => ({ ...page.asked.sets, ...page.pending });
function wantedText(key) {
  const wanted = wantedSets()[key];
  return wanted === undefined || wanted === page.sets[key] ? asText(valueOf(page.about.values, key)) : wanted;
}
function wantedValues() {
  const values = { ...page.about.values };
  for (const key of ["species", "gravity"])
    try {
      values[key] = JSON.parse(wantedText(key));
    } catch (e) {
      /* a link's own way to write it: what is in force */
    }
  return values;
}

/* Keys that would cost energy, and what they are in an elastic gas. */
const ELASTIC = { "collision.e": "1", "collision.beta": "-1", "collision.mu": "inf", "collision.law": "constant" };

/* What a flow needs, and others refuse. An elastic gas needs e = 1; the flow that comes after it has again what was
 * there before, or 0.9 where nothing was. */
function changeKey(key, value) {
  const before = wantedText("flow"),
    sets = { [key]: value };
  if (key === "flow")
    Object.assign(sets, {
      thermostat: value === "hss" ? "gaussian" : "none",
      gravity: value === "chute" ? "[0.1, -0.1, 0]" : "[0, 0, 0]",
    });
  if (key === "flow" && value === "equilibrium") {
    if (before !== "equilibrium")
      page.inelastic = Object.fromEntries(Object.keys(ELASTIC).map((one) => [one, wantedText(one)]));
    Object.assign(sets, ELASTIC);
  } else if (key === "flow" && before === "equilibrium") {
    Object.assign(sets, page.inelastic || { "collision.e": "0.9" });
    page.inelastic = null;
  }
  page.pending = { ...page.pending, ...sets };
  clearTimeout(page.changeTimer);
  page.changeTimer = setTimeout(() => start(page.asked.scene, wantedSets()), 120);
}

/* ---- Frames: the gas is asked to go on as far as the clock on the wall says ---- */

function tick(now) {
  requestAnimationFrame(tick); /* first: whatever goes wrong in one frame, the next is drawn */
  const seconds = Math.min((now - (page.last || now)) / 1000, 0.25);
  page.last = now;
  if (page.newFrame) {
    page.newFrame = false;
    drawFrame();
  }
  owe(page.about ? seconds : 0);
  if (page.player) tickPlaying(seconds);
  else if (page.about && !page.inFlight && (page.playing || page.wantFrame || page.wantStep)) ask();
  if (now - (page.slow || 0) > 300 && page.changed) {
    page.slow = now;
    page.changed = false;
    showCharts();
  }
  if (now - (page.said || 0) > 8000 && page.frame) {
    page.said = now;
    say();
  }
}

/* Seconds that the gas has yet to go on for are kept while it is not asked; above so many they are lost. `behind` are
 * those lost in frames one after another; from some on that is said. */
const MOST_OWED = 1,
  MOST_BEHIND = 0.7;
function owe(seconds) {
  if (!page.playing || page.player) page.owed = 0;
  else page.owed += seconds;
  page.lost += Math.max(0, page.owed - MOST_OWED);
  page.owed = Math.min(page.owed, MOST_OWED);
}

async function ask() {
  const mine = page.starts,
    step = page.wantStep,
    seconds = step ? 0 : page.owed;
  page.inFlight = true;
  page.owed = 0;
  page.wantFrame = page.wantStep = false;
  try {
    const answer = await page.live.ask("frame", {
      collisions: page.speed * seconds,
      colour: byId("colour").value,
      step,
    });
    if (mine === page.starts) takeFrame(answer, step, seconds);
    else page.wantFrame = true; /* a start came between; if it is refused, the gas before is to be seen */
  } catch (e) {
    if (mine === page.starts) {
      byId("refused").textContent = e.message;
      page.playing = false;
      showPlaying();
    }
  }
  page.inFlight = false;
}

function takeFrame(frame, step, seconds) {
  page.frame = frame;
  page.newFrame = page.changed = true;
  page.frames++;
  const lost = page.lost + (frame.behind ? seconds : 0);
  page.behind = lost > 0 ? page.behind + lost : 0;
  page.lost = 0;
  page.history.add(frame.md, frame.dsmc);
  if (step) showEvent(frame.event);
}

function drawFrame() {
  const { picture, md, event } = page.frame;
  if (md) page.view.draw(picture, md, page.about, { images: byId("images").checked, event });
  else page.view.draw(null, page.frame.dsmc, page.about, {});
  showClock(md || page.frame.dsmc);
}

/* ---- What people do ---- */

function listen() {
  const on = (id, what, kind = "click") => byId(id).addEventListener(kind, what);
  const play = (yes) => {
    page.playing = yes;
    if (yes) showEvent(null);
    if (yes && page.player && page.player.at >= page.player.frames - 1) page.player.at = 0;
    showPlaying();
  };
  on("play", () => play(!page.playing));
  on("step", () => {
    if (page.player) {
      goTo(Math.floor(page.player.at) + 1);
      return;
    }
    play(false);
    page.wantStep = true;
  });
  on("slower", () => faster(-1));
  on("faster", () => faster(1));
  on("restart", () => (page.player ? goTo(0) : start(page.asked.scene, wantedSets())));
  on("reseed", () => start(page.asked.scene, { ...wantedSets(), "run.seed": String(1 + Math.floor(Math.random() * 999999)) }));
  on(
    "colour",
    () => {
      showScale();
      page.wantFrame = true;
    },
    "change",
  );
  on(
    "images",
    () => {
      page.newFrame = !!page.frame;
    },
    "change",
  );
  on(
    "language",
    () => speak(byId("language").value),
    "change",
  );
  on(
    "everything",
    () => {
      if (page.means) showMeans(page.means);
    },
    "change",
  );
  on("use-yaml", () => start(byId("yaml").value, {}));
  on("controls", (e) => e.preventDefault(), "submit");
  on("save-png", () => {
    page.view.again();
    byId("box").toBlob((blob) => save("graingas.png", blob));
  });
  on("save-csv", () =>
    save("graingas.csv", new Blob([curvesCsv(page.history, page.means, page.about.title)], { type: "text/csv" })),
  );
  on("save-yaml", () => save("scene.yaml", new Blob([page.about.yaml], { type: "text/yaml" })));
  on("copy-link", copyLink);
  listenForFiles();
  window.addEventListener("hashchange", () => {
    const link = readLink();
    if (LANGUAGES.includes(link.language)) speak(link.language);
    follow(link);
  });
  window.addEventListener("resize", () => {
    page.newFrame = !!page.frame;
  });
}

function speak(name) {
  language = LANGUAGES.indexOf(name);
  showLanguage();
}

async function copyLink() {
  const link = location.href.split("#")[0] + linkOf(page);
  try {
    await navigator.clipboard.writeText(link);
    byId("taken").textContent = t("copied");
  } catch (e) {
    byId("taken").textContent = t("linkIs", { link });
  }
}

begin();
