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
  page.live = new WorkerClient(source);
  page.measure = new WorkerClient(source);
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
  const link = readUrlState();
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
  page.history = new TemperatureHistory(answer.about.values.flow === "hcs");
  if (lesson !== undefined) showLessonOf(lesson);
  showGas();
  writeUrlState(page);
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
  page.shownWarnings = null;
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
    const link = readUrlState();
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
  const link = location.href.split("#")[0] + urlState(page);
  try {
    await navigator.clipboard.writeText(link);
    byId("taken").textContent = t("copied");
  } catch (e) {
    byId("taken").textContent = t("linkIs", { link });
  }
}

begin();
