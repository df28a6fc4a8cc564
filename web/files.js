/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files that the user opens or drops: a result of the command is played in place of the live gas, which is paused; a
 * scene is run; points of a class are added to the student's own points. */
import { requestMeans, nextRequest, recordTrail, now, ownScene } from "./gas.js";
import { StoredHistory } from "./history.js";
import { t } from "./i18n.js";
import { pointsOf } from "./points.js";
import { store } from "./state.js";
import { byId } from "./words.js";
import { workers } from "./worker_rpc.js";

export const FRAMES_A_SECOND = [0.5, 1, 2, 5, 10, 20, 30, 60];
const LARGEST_FILE = 2 ** 31; /* bytes: the limit of reading in place (emscripten) */
/* The frame that is shown. It changes with every frame, so it is not in the state. */
export const played = { at: 0, shown: -1 };
let files = 0;

const refuse = (text) => store.dispatch("banner", { banner: { text: text.slice(0, 700), offers: [] } });

export async function openFile(file) {
  if (/\.(ya?ml|csv)$/i.test(file.name) && file.size < 1e6) {
    const text = await file.text();
    if (/csv$/i.test(file.name)) takePoints(text, file.name);
    else ownScene(text);
    return;
  }
  await playFile(file);
}
/* Read all tables of a class at once; of other files the first. */
function openFiles(files) {
  const tables = files.filter((one) => /\.csv$/i.test(one.name));
  for (const one of tables.length ? tables.slice(0, 200) : files.slice(0, 1)) openFile(one);
}
function takePoints(text, name) {
  const points = pointsOf(text, name);
  if (points.length) store.dispatch("gather", { points });
  else refuse(t("noPoints", { name }));
}

async function playFile(file) {
  const mine = ++files;
  if (file.size > LARGEST_FILE) {
    refuse(t("fileTooLarge", { name: file.name }));
    return;
  }
  store.dispatch("banner", { banner: { text: t("reading", { name: file.name }), offers: [], quiet: true } });
  try {
    const { about } = await workers.live.request("play", { file });
    if (mine === files) beginPlaying(file, about);
    const means = await workers.measure.request("read", { file });
    if (mine === files && store.state.player) takeStored(means);
  } catch (e) {
    if (mine === files) refuse(e.message);
  }
}

function beginPlaying(file, about) {
  const id = nextRequest(),
    { values } = about,
    still = about.frames === 1 || matchMedia("(prefers-reduced-motion: reduce)").matches;
  Object.assign(played, { at: 0, shown: -1 });
  Object.assign(now, { frame: null, trail: [], fresh: false, want: true, behind: 0 });
  store.dispatch("play", {
    player: { name: file.name, frames: about.frames, rate: 10 },
    gas: { id, scene: about.yaml, sets: {}, lesson: null, about, refusal: null, dsmcRefusal: null, history: new StoredHistory(values.flow === "hcs") },
    change: {
      playing: !still,
      chart: "temperature",
      quantity: "temperature",
      ...(store.state.colour === "since" || store.state.colour === "origin" ? { colour: "speed" } : {}),
    },
  });
}

/* Show the result's means and histories. */
function takeStored(means) {
  const { gas } = store.state;
  gas.history = new StoredHistory(gas.about.values.flow === "hcs", means.courses);
  if (now.frame) gas.history.now = now.frame.md.time;
  store.dispatch("means", { id: gas.id, means });
}

/* Return to the live gas as it was left. */
export function endPlaying() {
  if (!store.state.player) return;
  files++;
  workers.live.request("close").catch(() => {}); /* a worker that has ended has closed the file */
  Object.assign(now, { frame: null, trail: [], fresh: false, want: true });
  store.dispatch("back", { id: nextRequest() });
  if (!store.state.means) requestMeans();
}

/* Advance by seconds of the wall clock; playing ends at the last frame. */
export function tickPlaying(seconds) {
  const { player, playing } = store.state,
    last = player.frames - 1;
  if (playing) {
    played.at = Math.min(last, played.at + seconds * player.rate);
    if (played.at >= last) store.look({ playing: false });
  }
  if (!now.busy && (Math.floor(played.at) !== played.shown || now.want)) askPlayed(Math.floor(played.at));
}

async function askPlayed(k) {
  const { gas, colour, arrows, grain } = store.state;
  Object.assign(now, { busy: true, want: false });
  try {
    const frame = await workers.live.request("played", { k, colour, arrows, grain });
    if (gas === store.state.gas) takePlayed(frame, k);
  } catch (e) {
    if (gas === store.state.gas) {
      refuse(e.message);
      played.shown = k;
      store.look({ playing: false });
    }
  }
  now.busy = false;
}
function takePlayed(frame, k) {
  played.shown = k;
  recordTrail(frame, store.state.grain);
  Object.assign(now, { frame, fresh: true, frames: now.frames + 1 });
  store.state.gas.history.now = frame.md.time;
  byId("scrub").value = k;
  byId("frame-number").textContent = t("frameOf", whichFrame());
}
export const whichFrame = () => ({ k: Math.max(0, played.shown) + 1, n: store.state.player.frames });

/* Go to the frame that the user chose. */
export function goTo(k) {
  const { player } = store.state;
  if (!player) return;
  played.at = Math.min(player.frames - 1, Math.max(0, k));
  store.look({ playing: false });
}

export function listenForFiles() {
  byId("open-file").addEventListener("click", () => byId("file").click());
  byId("file").addEventListener("change", () => {
    const files = [...byId("file").files];
    byId("file").value = "";
    openFiles(files);
  });
  byId("scrub").addEventListener("input", () => goTo(Number(byId("scrub").value)));
  byId("back").addEventListener("click", endPlaying);
  byId("run-live").addEventListener("click", () => ownScene(store.state.gas.about.brief));
  const over = (e, yes) => {
    if (![...e.dataTransfer.types].includes("Files")) return;
    e.preventDefault();
    document.body.classList.toggle("dropping", yes);
  };
  document.addEventListener("dragover", (e) => over(e, true));
  document.addEventListener("dragleave", (e) => over(e, false));
  document.addEventListener("drop", (e) => {
    over(e, false);
    openFiles([...e.dataTransfer.files]);
  });
}
