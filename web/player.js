/* A result of the terminal, played: its frames in place of the live gas, which waits, and its means in place of those
 * that the page measures. */
const FRAMES_A_SECOND = [0.5, 1, 2, 5, 10, 20, 30, 60];
const LARGEST_FILE = 2 ** 31; /* bytes: where reading in place ends (emscripten) */
/* What belongs to the gas that is seen, and comes back with it. */
const SHELVED =
  "scene sets about refusal dsmcRefusal means frame history behind playing lesson drawnTheories".split(" ");

async function playFile(file) {
  const mine = ++page.files,
    say = (text) => {
      byId("file-refused").textContent = text;
    };
  say("");
  if (file.size > LARGEST_FILE) {
    say(t("tooLarge", { name: file.name }));
    return;
  }
  byId("taken").textContent = t("reading", { name: file.name });
  try {
    const { about } = await page.live.ask("play", { file });
    if (mine === page.files) beginPlaying(file, about);
  } catch (e) {
    if (mine === page.files) say(e.message.slice(0, 600));
    byId("taken").textContent = "";
    return;
  }
  try {
    const means = await page.measure.ask("read", { file });
    if (mine === page.files && page.player) takeStored(means);
  } catch (e) {
    if (mine === page.files) say(e.message.slice(0, 600));
  }
  byId("taken").textContent = "";
}

function beginPlaying(file, about) {
  page.starts++; /* answers that are under way are of another gas, and so is what a control was about to change */
  clearTimeout(page.changeTimer);
  clearTimeout(page.meansTimer);
  page.pending = {};
  page.asked = { scene: about.yaml, sets: {} };
  if (!page.player) page.shelf = Object.fromEntries(SHELVED.map((name) => [name, page[name]]));
  page.player = { name: file.name, frames: about.frames, at: 0, shown: -1, rate: 10 };
  Object.assign(page, {
    scene: about.yaml,
    sets: {},
    about,
    refusal: null,
    dsmcRefusal: null,
    means: null,
    frame: null,
    newFrame: false,
    behind: 0,
    lesson: null,
    drawnTheories: null,
    playing: about.frames > 1 && !matchMedia("(prefers-reduced-motion: reduce)").matches,
  });
  page.history = new StoredHistory(about.values.flow === "hcs");
  if (byId("colour").value === "since") byId("colour").value = "speed";
  byId("scrub").max = about.frames - 1;
  showLesson();
  showScale();
  showGas();
  byId("progress").textContent = t("waiting");
}

/* The result's means and courses. */
function takeStored(means) {
  page.history = new StoredHistory(page.about.values.flow === "hcs", means.courses);
  if (page.frame) page.history.now = page.frame.md.time;
  showMeans(means);
}

/* The live gas again, as it was left. */
function endPlaying() {
  if (!page.player) return;
  leavePlaying();
  page.starts++;
  Object.assign(page, page.shelf, { newFrame: !!page.shelf.frame, wantFrame: true });
  page.asked = { scene: page.scene, sets: page.sets };
  showLesson();
  showGas();
  writeUrlState(page);
  if (page.means) showMeans(page.means);
  else askMeans();
}
/* Whatever comes next. */
function leavePlaying() {
  if (!page.player) return;
  page.player = null;
  page.files++;
  page.live.ask("close").catch(() => {}); /* a worker that is gone has closed it */
  byId("file-refused").textContent = "";
}

/* So much further by the clock on the wall; it ends at the last frame. */
function tickPlaying(seconds) {
  const p = page.player,
    last = p.frames - 1;
  if (page.playing) {
    p.at = Math.min(last, p.at + seconds * p.rate);
    if (p.at >= last) {
      page.playing = false;
      showPlaying();
    }
  }
  if (!page.inFlight && (Math.floor(p.at) !== p.shown || page.wantFrame)) askPlayed(Math.floor(p.at));
}

async function askPlayed(k) {
  const mine = page.starts;
  page.inFlight = true;
  page.wantFrame = false;
  try {
    const frame = await page.live.ask("played", { k, colour: byId("colour").value });
    if (mine === page.starts && page.player) takePlayed(frame, k);
  } catch (e) {
    if (mine === page.starts && page.player) {
      byId("file-refused").textContent = e.message.slice(0, 600);
      page.playing = false;
      page.player.shown = k;
      showPlaying();
    }
  }
  page.inFlight = false;
}

function takePlayed(frame, k) {
  page.player.shown = k;
  page.frame = frame;
  page.newFrame = page.changed = true;
  page.frames++;
  page.history.now = frame.md.time;
  byId("scrub").value = k;
  byId("frame-number").textContent = t("frameOf", whichFrame());
}

/* Where somebody put it. */
function goTo(k) {
  const p = page.player;
  if (!p) return;
  p.at = Math.min(p.frames - 1, Math.max(0, k));
  page.playing = false;
  showPlaying();
}

function faster(by) {
  if (page.player) {
    const at = FRAMES_A_SECOND.indexOf(page.player.rate) + by;
    page.player.rate = FRAMES_A_SECOND[Math.min(FRAMES_A_SECOND.length - 1, Math.max(0, at))];
  } else page.speed = SPEEDS[Math.min(SPEEDS.length - 1, Math.max(0, SPEEDS.indexOf(page.speed) + by))];
  showPlaying();
}

function listenForFiles() {
  byId("open-file").addEventListener("click", () => byId("file").click());
  byId("file").addEventListener("change", () => {
    const [file] = byId("file").files;
    byId("file").value = "";
    if (file) playFile(file);
  });
  byId("scrub").addEventListener("input", () => goTo(Number(byId("scrub").value)));
  byId("back").addEventListener("click", endPlaying);
  byId("run-live").addEventListener("click", () => start(page.about.yaml, {}));
  const over = (e, yes) => {
    if (![...e.dataTransfer.types].includes("Files")) return;
    e.preventDefault();
    document.body.classList.toggle("dropping", yes);
  };
  document.addEventListener("dragover", (e) => over(e, true));
  document.addEventListener("dragleave", (e) => over(e, false));
  document.addEventListener("drop", (e) => {
    over(e, false);
    const [file] = e.dataTransfer.files;
    if (file) playFile(file);
  });
}
