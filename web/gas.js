/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which gas runs: calls of the workers, and how their answers enter the state. */
import { rowOf, setsOf, shownValue, symbolOf } from "./controls.js";
import { isWalled } from "./flows.js";
import { LESSONS, lessonOf, nearestLesson } from "./lessons.js";
import { gather } from "./points.js";
import { TemperatureHistory } from "./history.js";
import { settled } from "./theories.js";
import { t } from "./i18n.js";
import { store } from "./state.js";
import { WorkerClient, workers } from "./worker_rpc.js";
import { byId, number } from "./words.js";

export const START = LESSONS[0];
const MOST_GRAINS = 20000,
  MOST_BYTES = 6e8,
  FEWER = 2000;

export const page = { given: null }; /* the scene that the page was built with: shown if the address names none */
/* Data of frames, which change too often for the state. */
export const now = { frame: null, frames: 0, fresh: false, want: true, step: false, due: 0, lost: 0, behind: 0, busy: false, trail: [] };
const renew = () => Object.assign(now, { frame: null, trail: [], fresh: false, want: true, due: 0, lost: 0, behind: 0 });

/* Unpack a part of the page: gzip as base64. Each part is read once. */
async function unpack(id) {
  const packed = Uint8Array.from(atob(byId(id).textContent.trim()), (c) => c.charCodeAt(0));
  byId(id).textContent = "";
  return new Response(new Blob([packed]).stream().pipeThrough(new DecompressionStream("gzip"))).arrayBuffer();
}

/* Open all workers; the version of the first. Callers of the others wait for them themselves. */
let wasm = null,
  source = "";
export async function openWorkers() {
  wasm = await unpack("wasm");
  source = URL.createObjectURL(new Blob([await unpack("worker")], { type: "text/javascript" }));
  workers.measure = openAnother();
  workers.measure.onmeans = takeMeans;
  const version = await openLive();
  workers.evaluate = openAnother();
  workers.evaluate.ontheories = takeTheories;
  return version;
}
function openAnother() {
  const worker = new WorkerClient(source);
  worker.request("open", { wasm }).catch((e) => store.dispatch("banner", { banner: { text: e.message, offers: [] } }));
  return worker;
}
async function openLive() {
  workers.live = new WorkerClient(source);
  return (await workers.live.request("open", { wasm })).version;
}

/* If the start of a gas takes long, a banner tells how many grains are placed. Its button ends the worker and
 * returns to the previous gas. */
const LONG = 1500; /* ms */
function announceStart(n, id) {
  return setTimeout(() => {
    if (id !== store.state.requested.id) return;
    const offers = store.state.player ? [] : [{ label: t("stop"), act: stopMaking }];
    store.dispatch("banner", { banner: { text: t("making", { n: n.toLocaleString(store.state.language) }), offers, quiet: true } });
  }, LONG);
}
async function stopMaking() {
  const { gas } = store.state;
  nextRequest();
  workers.live.end(t("stopped"));
  await openLive();
  if (gas) await start(gas.scene, gas.sets, { lesson: gas.lesson, look: { playing: true } });
  else await openLesson(START.name);
}

const LONGEST_TRAIL = 400; /* frames */
/* The positions of the followed grain; empty without one, and after another was chosen. */
export function recordTrail({ picture }, grain) {
  if (now.trailOf !== grain || !picture || !picture.one) Object.assign(now, { trail: [], trailOf: grain });
  if (picture && picture.one) now.trail.push(picture.one.position);
  if (now.trail.length > LONGEST_TRAIL) now.trail.shift();
}

/* ---- A new gas ---- */

let requests = 0,
  edits = 0;
export const nextRequest = () => ++requests;

/* A control was moved. Changes add up until the sliders rest. */
export function change(key, value) {
  const { requested } = store.state;
  store.dispatch("request", { requested: { id: nextRequest(), sets: { ...requested.sets, ...setsOf(key, value) } } });
  clearTimeout(edits);
  edits = setTimeout(() => again(), 120);
}
/* Start the wanted gas again, with more keys set. */
export function again(more = {}, options = {}) {
  const { scene, sets } = store.state.requested;
  return start(scene, { ...sets, ...more }, options);
}

/* Are there too many grains for a page? Then a banner offers fewer grains before the gas is started. */
function isTooLarge({ particles, bytes }, scene, sets, options, id) {
  if (options.whatever) return false;
  if (particles <= MOST_GRAINS && bytes <= MOST_BYTES) return false;
  if (id !== store.state.requested.id) return true;
  const fewer = { ...sets, particles: String(FEWER), "dsmc.particles": "auto" };
  store.dispatch("refused", {
    text: t("tooLarge", { n: particles.toLocaleString(store.state.language), bytes: number(bytes / 1e6, 2) }),
    offers: [
      { label: t("fewer", { n: FEWER }), act: () => start(scene, fewer, options) },
      { label: t("runAll"), act: () => start(scene, sets, { ...options, whatever: true }) },
    ],
  });
  return true;
}

/* Start a scene. If the library rejects it, the present gas continues and the banner gives the reason. `look`:
 * members of the state that change with the gas. */
export async function start(scene, sets, options = {}) {
  const { lesson = store.state.lesson, look = {}, keepBanner = false } = options,
    id = nextRequest(),
    { remember = false } = lessonOf(lesson) || {};
  clearTimeout(edits); /* pending changes of controls are in `sets`, or belong to the previous gas */
  store.dispatch("request", { requested: { id, scene, sets } });
  let answer,
    making = 0;
  try {
    const cost = await workers.live.request("cost", { scene, sets });
    if (isTooLarge(cost, scene, sets, options, id)) return false;
    making = announceStart(cost.particles, id);
    answer = await workers.live.request("start", { scene, sets, pair: ("pair" in look ? look.pair : store.state.pair) || null, remember });
  } catch (e) {
    if (id === requests) refuse(e.message, sets, scene);
    return false;
  } finally {
    clearTimeout(making);
  }
  const { about, refusal, dsmcRefusal } = answer,
    gas = { id, scene, sets, lesson, about, refusal, dsmcRefusal, history: new TemperatureHistory(about.values.flow === "hcs") };
  leaveGhost(gas);
  const quantity = about.values.flow === "hcs" && store.state.quantity === "temperature" ? { quantity: "cooling_rate" } : {}, /* T has no mean there */
    chart = store.state.chart === "profiles" && !isWalled(about.values) ? { chart: "temperature" } : {};
  if (store.state.player) workers.live.request("close").catch(() => {});
  renew();
  store.dispatch("started", { gas, change: { lesson, ...quantity, ...chart, ...look, ...(keepBanner ? {} : { banner: null }) } });
  requestMeans();
  return true;
}

function refuse(message, sets, scene) {
  const keys = Object.keys(sets).filter((key) => message.includes(key)),
    text = store.state.gas || !scene ? message : t("refusedLink", { why: message });
  store.dispatch("refused", { text: text.slice(0, 700), keys });
}

/* Keep the curve of the previous gas in the diagram, if the next one is of its kind. */
function leaveGhost(next) {
  const { gas, slider, chart, player } = store.state;
  if (!gas || player || gas.lesson !== next.lesson || gas.about.values.flow !== next.about.values.flow) return;
  const row = rowOf(slider),
    [before, after] = [gas, next].map(({ about }) => shownValue(row, about.values));
  if (before === after) return;
  const course = chart === "distance" ? gas.history.far : gas.history.course("T");
  if (course.x.length < 8) return;
  store.dispatch("ghost", { ghost: { label: `${symbolOf(row)} = ${number(before)}`, chart, x: [...course.x], y: [...course.y] } });
}

/* ---- Lessons ---- */

/* Members of the state that a lesson sets. */
export const lookOf = ({ speed, colour, camera, pair, chart, quantity, slider, follow }) => ({
  question: "",
  speed,
  colour,
  camera,
  pair,
  chart,
  slider,
  follow,
  ghosts: [],
  theories: null,
  ...(quantity ? { quantity } : {}),
});
export function openLesson(name, { sets = {}, look = {} } = {}) {
  const lesson = lessonOf(name);
  return start(lesson.scene, sets, { lesson: name, look: { ...lookOf(lesson), ...look } });
}
/* A user's own scene: no lesson text beside it. */
export function ownScene(scene, sets = {}, look = {}) {
  return start(scene, sets, { lesson: null, look: { ghosts: [], pair: "", chart: "temperature", question: "", ...look } });
}

/* Open the gas of a link, or of the command that wrote the page, or else the first lesson. */
export async function follow({ scene, sets, lesson, look, points = [] }) {
  const { given } = page,
    known = lessonOf(lesson);
  let ok;
  if (scene === null && known) ok = await openLesson(known.name, { sets, look });
  else if (scene !== null || given) ok = await ownScene(scene ?? given, sets, look);
  else ok = await openLesson(START.name, { sets, look });
  if (!ok && !store.state.gas) await openLesson(START.name).then(() => restoreBanner());
  if (lesson !== null && !known) unknownLesson(lesson);
  if (gather(points) < points.length) store.dispatch("banner", { banner: { text: t("noPointsLink"), offers: [] } });
}
let lastBanner = null;
store.subscribe((state, before) => {
  if (state.banner && !state.banner.quiet && state.banner !== before.banner) lastBanner = state.banner;
});
/* Show the banner again: the start of the first lesson cleared the reason why another gas was rejected. */
function restoreBanner() {
  if (lastBanner) store.dispatch("banner", { banner: lastBanner });
}
function unknownLesson(wrong) {
  const near = nearestLesson(wrong);
  store.dispatch("banner", {
    banner: {
      text: t("noLesson", { name: wrong.slice(0, 60) }),
      offers: near ? [{ label: t(`lesson_${near}`), act: () => openLesson(near) }] : [],
    },
  });
}

/* ---- Means ---- */

/* Theories that are not evaluated yet. */
const NONE = { theory: {}, theories: {}, cooling: { time: [], T: {} }, done: false };
let timer = 0,
  asking = false,
  measuring = { job: 0, gas: 0 },
  evaluating = { job: 0, gas: 0 },
  measured = null,
  known = NONE;

/* Only the newest gas is measured, after the sliders rest. */
export function requestMeans() {
  clearTimeout(timer);
  timer = setTimeout(async () => {
    if (asking) {
      requestMeans();
      return;
    }
    const { gas, player } = store.state;
    if (player) return;
    asking = true;
    measuring = { job: workers.measure.count + 1, gas: gas.id };
    evaluating = { job: workers.evaluate.count + 1, gas: gas.id };
    measured = null;
    known = NONE;
    workers.evaluate.request("evaluate", { scene: gas.scene, sets: gas.sets }).catch(() => {}); /* `measure` gives the reason */
    try {
      measured = await workers.measure.request("measure", { scene: gas.scene, sets: gas.sets });
    } catch (e) {
      measured = failed(e.message);
    }
    asking = false;
    showMeans();
  }, 300);
}
const failed = (why) => ({ failed: why, progress: {} });
/* Means and theories come from two workers. */
function showMeans() {
  const { theory, theories, cooling, done } = known;
  if (measured) store.dispatch("means", { id: measuring.gas, means: { ...measured, theory, theories, cooling, evaluated: done } });
}
function takeMeans(data) {
  if (data.id !== measuring.job || asking) return;
  measured = data.refused !== undefined ? failed(data.refused) : data.answer;
  recordErrors(store.state, measured);
  showMeans();
}
function takeTheories(data) {
  if (data.id !== evaluating.job || evaluating.gas !== measuring.gas) return;
  known = data.refused !== undefined ? { ...known, done: true } : data.answer;
  showMeans();
}
/* Keep the errors of the means over the collisions that they are of: the curve of the lesson on errors. */
function recordErrors({ gas, player }, means) {
  if (!gas || player || gas.id !== measuring.gas) return;
  for (const engine of ["md", "dsmc"]) {
    const results = settled(means, engine);
    if (results) gas.history.addError(engine, (2 * means[engine].collisions) / means[engine].particles, results);
  }
}

export async function reverse() {
  await workers.live.request("reverse");
  now.want = true;
}
