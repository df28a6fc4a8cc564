/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Shows the state: updates each part that has changed. */
import { Chart } from "./chart.js";
import { CHARTS, showChart, speedUnit, spinUnit, temperatureUnit, timeUnit } from "./charts.js";
import { SPEEDS } from "./clock.js";
import { colourAt, mapOf, rgb } from "./colours.js";
import { CONTROLS, rowOf, symbolOf } from "./controls.js";
import { FRAMES_A_SECOND, whichFrame } from "./files.js";
import { isWalled, sheared } from "./flows.js";
import { now, openLesson, ownScene } from "./gas.js";
import { LANGUAGES, t } from "./i18n.js";
import { LESSONS } from "./lessons.js";
import { writeLink } from "./link.js";
import { canKeep, drawLines, hasPoints, QUANTITIES, showPoints } from "./points.js";
import { showProfiles } from "./profiles.js";
import { store } from "./state.js";
import { fillRanges, fillTable } from "./table.js";
import { error, mean, showTheories } from "./theories.js";
import { allWarnings } from "./warnings.js";
import { byId, cell, number, quantityName, withError } from "./words.js";

const COLOURS = ["speed", "along", "spin", "since", "origin"];
const TRUTHS = ["same", "collisions", "dice", "size", "theory", "scale", "clusters"];
export const parts = {}; /* made by begin() */

/* Fill the parts that never change. */
export function begin({ controls, view, twin }) {
  const text = (key, values) => t(key, values);
  Object.assign(parts, { controls, view, twin, chart: new Chart(byId("chart"), text), points: new Chart(byId("points"), text) });
  for (const { name } of LESSONS) {
    const button = cell("button", "", { type: "button", id: `lesson-${name}` });
    button.addEventListener("click", () => openLesson(name));
    byId("lessons").append(button);
  }
  const own = cell("button", "", { type: "button", id: "lesson-own" });
  own.addEventListener("click", () => ownScene(store.state.gas.about.brief));
  byId("lessons").append(own);
  const options = (id, names) => byId(id).append(...names.map((value) => cell("option", "", { value })));
  options("colour", COLOURS);
  options("chart-kind", CHARTS);
  options("quantity", QUANTITIES);
  options("question-slider", CONTROLS.filter((row) => row.max !== undefined).map((row) => row.name));
  byId("question-slider").value = store.state.slider;
  options("language", Object.keys(LANGUAGES));
  for (const [code, strings] of Object.entries(LANGUAGES)) {
    const one = byId("language").querySelector(`[value=${code}]`);
    one.textContent = strings.languageName;
    one.lang = code;
  }
  byId("thermometer").append(cell("div", "", { className: "tube" }), cell("output", ""));
  byId("thermometer").firstChild.append(cell("div", "", { className: "mercury" }), cell("div", "", { className: "second" }));
}

/* Show all parts of the state that differ from the page. */
export function show(state, before) {
  const is = (...names) => names.some((name) => state[name] !== before[name]);
  if (is("language")) showLanguage();
  if (is("banner", "language")) showBanner(state);
  if (is("view")) showView(state);
  if (!state.gas) return;
  if (is("gas", "language")) showGas(state);
  if (is("gas", "lesson", "language", "slider", "question")) showLesson(state, before);
  if (is("refusedKeys", "gas")) parts.controls.refuse(state.refusedKeys);
  if (is("gas", "playing", "speed", "player", "follow", "language")) showPlaying(state);
  if (is("gas", "colour", "language", "player")) showScale(state);
  if (is("colour", "follow", "pair", "arrows", "grain")) now.want = true;
  if (is("arrows", "grain")) showFollowed(state, before);
  if (is("camera")) for (const one of [parts.view, parts.twin]) one.look(state.camera);
  if (is("images") && now.frame) now.fresh = true;
  if (is("gas", "pair", "language")) showPair(state);
  if (is("means", "theories", "everything", "language", "gas")) showMeans(state);
  if (is("chart", "quantity", "language", "gas")) showChoices(state);
  if (is("chart", "gas", "means", "language", "theories", "ghosts", "pair")) showChart(parts.chart, state);
  if (is("chart", "gas", "means", "language", "theories", "points", "lines", "quantity", "slider", "player")) showMyPoints(state);
  if (is("gas", "lesson", "language", "colour", "speed", "camera", "playing", "pair", "chart", "view", "follow", "images", "arrows", "grain", "question", "quantity", "slider")) link(state, before);
  announceChanges(state, before);
}

/* The address is written at once for another lesson, a little later while a camera moves. */
let linking = 0;
function link(state, before) {
  clearTimeout(linking);
  const step = !!before.gas && !state.player && !before.player && (before.lesson !== state.lesson || (state.lesson === null && before.gas.about.brief !== state.gas.about.brief));
  if (step || before.gas !== state.gas || before.language !== state.language) writeLink(state, step && before.gas.id !== state.gas.id);
  else linking = setTimeout(() => writeLink(store.state, false), 300);
}

/* ---- Words ---- */

function showLanguage() {
  document.documentElement.lang = store.state.language;
  byId("language").value = store.state.language;
  for (const one of document.querySelectorAll("[data-t]")) one.textContent = t(one.dataset.t);
  for (const one of document.querySelectorAll("[data-label]")) {
    one.setAttribute("aria-label", t(one.dataset.label));
    if (one.tagName === "BUTTON") one.title = t(one.dataset.label);
  }
  for (const one of byId("colour").options) one.textContent = t(`${one.value}Of`);
  for (const one of byId("chart-kind").options) one.textContent = t(`chart_${one.value}`);
  for (const one of byId("question-slider").options) one.textContent = symbolOf(rowOf(one.value));
  for (const one of byId("quantity").options) one.textContent = quantityName(one.value);
  for (const { name } of LESSONS) byId(`lesson-${name}`).textContent = t(`lesson_${name}_short`);
  byId("lesson-own").textContent = t("lesson_own_short");
  byId("truths").replaceChildren(...TRUTHS.map((name) => cell("li", t(`truth_${name}`))));
  parts.controls.name();
}

function showBanner({ banner }) {
  const place = byId("banner");
  place.replaceChildren();
  if (!banner) return;
  place.append(cell("p", banner.text));
  place.classList.toggle("quiet", !!banner.quiet);
  for (const { label, act } of banner.offers) {
    const button = cell("button", label, { type: "button" });
    button.addEventListener("click", () => {
      store.dispatch("banner", { banner: null });
      act();
    });
    place.append(button);
  }
  const close = cell("button", "×", { type: "button", className: "close" });
  close.setAttribute("aria-label", t("close"));
  close.addEventListener("click", () => store.dispatch("banner", { banner: null }));
  place.append(close);
}

function showView({ view }) {
  document.body.dataset.view = document.documentElement.dataset.view = view;
  byId("present").setAttribute("aria-pressed", String(view === "present"));
  now.fresh = !!now.frame;
}

function showLesson({ lesson, gas, slider, player, question }, before) {
  for (const button of byId("lessons").children) button.setAttribute("aria-pressed", String(button.id === `lesson-${lesson || "own"}`));
  const list = byId("lessons"),
    { offsetLeft: left, offsetWidth: wide } = byId(`lesson-${lesson || "own"}`);
  if (before.lesson !== lesson || !before.gas) list.scrollLeft = left - list.offsetLeft - (list.clientWidth - wide) / 2;
  byId("lesson-name").textContent = lesson ? t(`lesson_${lesson}`) : player ? player.name : t(question ? "questionName" : "lesson_own");
  byId("lesson-text").textContent = lesson ? t(`lesson_${lesson}_text`) : gas.about.title;
  byId("question").textContent = lesson ? t(`lesson_${lesson}_question`) : player ? "" : question;
  parts.controls.pull(rowOf(slider).name, byId("main-control"));
  byId("reverse").hidden = lesson !== "reverse";
  byId("another").hidden = lesson !== "sure";
  if (before.lesson !== lesson || before.question !== question || !before.gas) byId("more-controls").open = !lesson && !question;
}

/* ---- The gas ---- */

/* Properties of the gas that are known before it moves. */
function showGas({ gas, player }) {
  const { about } = gas,
    title = player ? `${player.name}: ${about.title}` : about.title;
  parts.controls.show(about.values);
  byId("images-row").hidden = !sheared(about.values);
  if (document.activeElement !== byId("yaml")) byId("yaml").value = about.yaml; /* do not overwrite a text that the user edits */
  byId("event").textContent = "";
  document.title = `${title} – graingas`;
  byId("profiles").hidden = !isWalled(about.values);
  byId("chart-kind").querySelector("[value=profiles]").disabled = byId("profiles").hidden;
  byId("thermometer").style.display = "";
  thermometer.top = 0;
  shownWarnings = null;
  showWarnings(store.state);
}
function showPair({ pair, gas }) {
  byId("pair").value = pair;
  byId("twin-figure").hidden = !pair;
  byId("boxes").classList.toggle("two", !!pair);
  byId("box-name").textContent = pair ? t(`this_${pair}`, { e: gas.about.values.collision.e }) : "";
  byId("twin-name").textContent = pair ? t(`other_${pair}`) : "";
  now.fresh = !!now.frame;
}

export function drawFrame(time) {
  const { frame } = now,
    { gas, images, colour, grain } = store.state,
    look = { images, map: mapOf(colour), grain, trail: now.trail };
  if (frame.md) parts.view.draw(frame.picture, frame.md, gas.about, { ...look, event: frame.event });
  else parts.view.draw(null, frame.dsmc, gas.about, {});
  if (frame.twinPicture) parts.twin.draw(frame.twinPicture, frame.twin, gas.about, { ...look, trail: [] });
  showClock(frame.md || frame.dsmc, gas.about.values);
  showThermometer(frame);
  showGrain(frame, grain);
  if (frame.event !== shownEvent) showEvent((shownEvent = frame.event));
  if (time - slow < 250) return;
  slow = time;
  showChart(parts.chart, store.state);
  showWarnings(store.state);
  if (!byId("profiles").hidden && frame.md) alignProfiles(frame.md.box);
  announceState(frame.md || frame.dsmc);
}
let slow = 0,
  shownEvent = null;

function alignProfiles(box) {
  const ratio = parts.view.w / parts.view.canvas.clientWidth || 1,
    at = (y) => parts.view.to(box[0] / 2, y, box[2] / 2)[1] / ratio,
    heights = [at(0), at(box[1])];
  if (!(heights[0] > heights[1])) return;
  const key = `${store.state.gas.id} ${heights.map(Math.round)} ${store.state.language}`;
  if (key === aligned && store.state.means === alignedMeans) return;
  aligned = key;
  alignedMeans = store.state.means;
  showProfiles(byId("profiles"), alignedMeans, heights, byId("box").clientHeight);
}
let aligned = "",
  alignedMeans = null;

function showClock(s, values) {
  const text = t("clock", {
    c: s.collisionsPerGrain.toFixed(s.collisionsPerGrain < 100 ? 1 : 0),
    t: number(s.time, 3),
    unit: timeUnit(values),
  });
  if (byId("clock").textContent !== text) byId("clock").textContent = text;
}

function showEvent(event) {
  const { values } = store.state.gas.about;
  if (!event) {
    byId("event").textContent = "";
    return;
  }
  const e = values.collision.e,
    lost = values.collision.law === "constant" ? t("eventLost", { share: Math.round(100 * (1 - e * e)) }) : "";
  byId("event").textContent = t("event", {
    a: event.grain[0] + 1,
    b: event.grain[1] + 1,
    g: number(event.normalSpeed, 3),
    unit: speedUnit(values),
    lost,
  });
}

function showFollowed({ arrows, grain }, before) {
  byId("arrows").checked = arrows;
  if (document.activeElement !== byId("grain-number")) byId("grain-number").value = grain === null ? "" : grain + 1;
  if (grain !== before.grain && before.gas) say(grain === null ? "" : t("followed", { i: grain + 1 }));
}
/* The followed grain: its velocity, and its spin where it has one. */
const signed = (x) => x.toFixed(2).replace("-", "−");
const vector = (v) => `(${v.map(signed).join(", ")})`;
const sizeOf = (v) => number(Math.hypot(...v), 3);
function grainWords({ picture }, grain) {
  const one = picture && picture.one,
    { values } = store.state.gas.about;
  if (!one) return "";
  const words = t("grain", { i: grain + 1, v: sizeOf(one.velocity), unit: speedUnit(values), all: vector(one.velocity) });
  return one.spin ? `${words} · ω ${sizeOf(one.spin)} ${spinUnit(values)} ${vector(one.spin)}` : words;
}
function showGrain(frame, grain) {
  const words = grainWords(frame, grain);
  if (byId("grain").textContent !== words) byId("grain").textContent = words;
}

/* A thermometer on the scale of the gas's start; a gas that heats up gets a longer scale. */
const thermometer = { top: 0 };
function showThermometer({ md, dsmc, twin }) {
  const s = md || dsmc,
    T = s.temperature,
    { values } = store.state.gas.about,
    [tube, text] = byId("thermometer").children;
  if (!thermometer.top) thermometer.top = 1.25 * T;
  if (T > thermometer.top) thermometer.top *= 1.5;
  const { follow } = store.state,
    fast = store.state.gas.about.fast,
    share = follow || !fast ? 0.5 : Math.sqrt(3 * T) / (2 * fast);
  tube.firstChild.style.height = `${Math.min(100, (100 * T) / thermometer.top)}%`;
  tube.firstChild.style.background = rgb(colourAt(share));
  const second = twin ? twin.temperature : s.rotationalTemperature > 0 ? s.rotationalTemperature : 0;
  tube.lastChild.style.bottom = `${Math.min(100, (100 * second) / thermometer.top)}%`;
  tube.lastChild.hidden = !second;
  const words = `T\n${number(T, 3)}\n${temperatureUnit(values)}${second ? `\n${twin ? "T₂" : "θ"}\n${number(second, 3)}` : ""}`;
  if (text.textContent !== words) text.textContent = words;
}

function showScale({ colour, player }) {
  const to = byId("scale").getContext("2d");
  for (let i = 0; i < 120; i++) {
    to.fillStyle = rgb(colourAt(i / 119, mapOf(colour)));
    to.fillRect(i, 0, 1, 10);
  }
  byId("colour").value = colour;
  for (const name of ["since", "origin"]) byId("colour").querySelector(`[value=${name}]`).disabled = !!player;
  byId("scale-low").textContent = t(`low_${colour}`);
  byId("scale-high").textContent = t(`high_${colour}`);
}

function showPlaying({ player, playing, speed, follow }) {
  const [rate, all] = player ? [player.rate, FRAMES_A_SECOND] : [speed, SPEEDS];
  byId("play").textContent = t(playing ? "pause" : "play");
  byId("speed").textContent = player ? t("frameRate", { x: rate }) : t(follow ? "speedFollow" : "speed", { x: rate });
  byId("slower").disabled = rate <= all[0];
  byId("faster").disabled = rate >= all[all.length - 1];
  byId("step").textContent = t(player ? "nextFrame" : "step");
  byId("restart").textContent = t(player ? "firstFrame" : "restart");
  byId("reseed").hidden = !!player;
  byId("follow").checked = follow;
  if (!player && byId("player").contains(document.activeElement)) byId("play").focus(); /* the user who pressed it continues */
  byId("player").hidden = !player;
  if (player) {
    byId("scrub").max = player.frames - 1;
    byId("frame-number").textContent = t("frameOf", whichFrame());
  }
}

/* ---- Means, points ---- */

function showMeans(state) {
  const { means, player, everything } = state,
    empty = { theory: {}, theories: {}, progress: {} };
  fillTable(byId("table"), means && means.theory ? means : empty, everything);
  fillRanges(byId("ranges"), means && means.theory ? means : empty);
  if (means && means.theory) showTheories(means);
  else {
    byId("theory-boxes").replaceChildren();
    delete byId("theory-boxes").dataset.names;
  }
  const phase = (engine) => {
    const p = means && means.progress[engine];
    if (!p) return t(means ? "phaseNone" : "waiting");
    return p.over ? t("phaseDone") : t(p.averaging ? "phaseAverage" : "phaseWarm", { p: Math.floor(100 * p.fraction) });
  };
  byId("progress").textContent = player ? t("progressStored", { name: player.name }) : means && means.failed ? means.failed : t("progress", { md: phase("md"), dsmc: phase("dsmc") });
  byId("box").setAttribute("aria-label", t("boxLabel", { by: t(`${state.colour}Of`), title: state.gas.about.title }));
  byId("twin").setAttribute("aria-label", t("twinLabel"));
}
function showChoices({ chart, quantity }) {
  byId("chart-kind").value = chart;
  byId("quantity").value = quantity;
}
function showMyPoints(state) {
  const has_ = hasPoints(state);
  byId("points").hidden = byId("points-row").hidden = byId("save-points-svg").hidden = !has_;
  byId("keep").hidden = !has_;
  byId("keep").disabled = !canKeep(state);
  byId("keep").title = byId("keep").disabled ? t("keepWaits") : "";
  byId("save-points").disabled = byId("forget").disabled = !state.points.length;
  if (!has_) return;
  showPoints(parts.points, state);
  drawLines();
}

let shownWarnings = null;
function showWarnings(state) {
  const all = allWarnings(state),
    text = `${state.language} ${all.join("\n")}`;
  if (text === shownWarnings) return;
  shownWarnings = text;
  byId("notes").hidden = !all.length;
  byId("notes").firstElementChild.textContent = t("notes", { n: all.length });
  byId("warnings").replaceChildren(...all.map((one) => cell("li", one)));
}

/* ---- Changes, spoken once for screen readers ---- */

export function say(text) {
  byId("said").textContent = text;
}
const heard = { T: 0, steady: false, time: 0 };
function announceChanges(state, before) {
  if (state.gas !== before.gas) Object.assign(heard, { T: 0, steady: false });
  if (state.lesson !== before.lesson && state.lesson) say(`${t(`lesson_${state.lesson}`)}. ${t(`lesson_${state.lesson}_text`)} ${t(`lesson_${state.lesson}_question`)}`);
  else if (state.question && state.question !== before.question && before.gas) say(state.question);
  else if (state.gas !== before.gas && before.gas) say(state.player ? t("summaryPlayed", { name: state.player.name, ...whichFrame(), title: state.gas.about.title }) : state.gas.about.title);
  const p = state.means && state.means.progress && state.means.progress.md;
  if (p && p.over && !heard.steady && state.means.md) {
    heard.steady = true;
    say(`${t("measured")} ${describeMeans(state)}`);
  }
}
/* T has halved or doubled since it was last spoken. */
function announceState(s) {
  const T = s.temperature;
  if (!heard.T) heard.T = T;
  if (performance.now() - heard.time < 4000 || !(T < heard.T / 2 || T > 2 * heard.T)) return;
  say(t(T < heard.T ? "halved" : "doubled", { T: number(T, 3) }));
  Object.assign(heard, { T, time: performance.now() });
}
function describeMeans({ means, quantity }) {
  return ["md", "dsmc"]
    .map((engine) => {
      const part = means && means[engine] && means[engine].results,
        q = [quantity, "temperature"].find((one) => Number.isFinite(mean(part, one)));
      return q ? `${t(engine)}: ${quantityName(q)} ${withError(mean(part, q), error(part, q))}.` : "";
    })
    .filter(Boolean)
    .join(" ");
}
/* A description on request. */
export function describe() {
  const { gas, player } = store.state,
    s = now.frame && (now.frame.md || now.frame.dsmc);
  if (!s) return "";
  const words = t("summary", {
    title: player ? t("summaryPlayed", { name: player.name, title: gas.about.title, ...whichFrame() }) : gas.about.title,
    c: number(s.collisionsPerGrain, 3),
    T: number(s.temperature),
    theta: s.rotationalTemperature > 0 ? t("summaryTheta", { theta: number(s.rotationalTemperature) }) : "",
  });
  return `${words} ${describeMeans(store.state)} ${grainWords(now.frame, store.state.grain)}`.trim();
}
