/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of the page in its address, as short as possible: #lesson=haff&set=collision.e=0.8, or #scene={flow:
 * ...}. Also read after a question mark. */
import { LANGUAGES, ownLanguage } from "./i18n.js";
import { CHARTS } from "./charts.js";
import { CONTROLS } from "./controls.js";
import { lessonOf } from "./lessons.js";
import { lookOf, page, START } from "./gas.js";
import { QUANTITIES } from "./points.js";
import { initial, store } from "./state.js";

const VIEWS = ["all", "box", "curve", "present"],
  COLOURS = ["speed", "spin", "since", "along", "origin"],
  PAIRS = ["", "elastic", "bit"];
const one = (list) => ({ read: (text) => (list.includes(text) ? text : undefined), write: String });
/* A teacher's question as plain text: no control characters, line breaks or changes of direction. */
export const tidyQuestion = (text) => text.replace(/[\p{C}\p{Zl}\p{Zp}]+/gu, " ").trim().slice(0, 240);
const yes = { read: (text) => text === "1", write: (value) => (value ? "1" : "0") };
/* How the gas is shown: parameters by their place in the state. `withQuestion`: with a question alone; lessons have their
 * own. */
const LOOK = {
  question: { read: (text) => tidyQuestion(text) || undefined, write: String },
  slider: { ...one(CONTROLS.filter((row) => row.max !== undefined).map((row) => row.name)), withQuestion: true },
  quantity: { ...one(QUANTITIES), withQuestion: true },
  view: one(VIEWS),
  colour: one(COLOURS),
  chart: one(CHARTS),
  pair: one(PAIRS),
  follow: yes,
  images: yes,
  arrows: yes,
  grain: { read: (text) => (/^\d{1,5}$/.test(text) ? +text : undefined), write: (i) => String(i ?? "") },
  playing: yes,
  speed: { read: (text) => (+text >= 0.001 && +text <= 1000 ? +text : undefined), write: String },
  camera: {
    read: (text) => {
      const at = text.split(",").map(Number);
      return at.length === 3 && at.every(Number.isFinite) && at[2] >= 0.4 && at[2] <= 8 ? at : undefined;
    },
    write: (at) => at.map((x) => +x.toFixed(2)).join(","),
  },
};

export function readLink(place = location) {
  const given = new URLSearchParams(place.hash.length > 1 ? place.hash.slice(1) : place.search.slice(1)),
    look = {};
  const pairs = given.getAll("set").map((text) => {
    const at = text.indexOf("=");
    return at < 0 ? [text, ""] : [text.slice(0, at), text.slice(at + 1)];
  });
  if (given.has("seed")) pairs.push(["run.seed", given.get("seed")]);
  for (const [name, { read }] of Object.entries(LOOK)) {
    const value = given.has(name) ? read(given.get(name)) : undefined;
    if (value !== undefined) look[name] = value;
  }
  const language = given.get("language");
  if (lessonOf(given.get("lesson")) || !look.question) for (const name of ["question", "slider", "quantity"]) delete look[name];
  return {
    scene: given.get("scene"),
    sets: Object.fromEntries(pairs) /* a null prototype: any name of a key is safe */,
    lesson: given.get("lesson"),
    language: Object.keys(LANGUAGES).includes(language) ? language : null,
    look,
    points: given.getAll("points").slice(0, 200),
  };
}
/* The points of all links, or parts of links, in a text. */
export const pointsIn = (text) =>
  text.split(/\s+/).flatMap((one) => (one.includes("points=") ? readLink({ hash: `#${one.replace(/^[^#]*#/, "").replace(/^[^?=]*\?/, "")}`, search: "" }).points : []));

/* A link with points: lesson or scene, slider, quantity, and the points. */
export function linkOfPoints(state, texts) {
  const { lesson, gas } = state,
    to = new URLSearchParams(lesson ? { lesson } : { scene: gas.about.brief });
  for (const text of texts) to.append("points", text);
  return `#${readable(to)}`;
}
/* Leave readable characters unescaped in an address. */
const readable = (to) => to.toString().replace(/%(3A|3B|2C|7B|7D|5B|5D|3D|3F|7E)/g, (code) => decodeURIComponent(code));

/* A link to the live gas, also while a result is played. */
export function linkOf(state, own = ownLanguage()) {
  const of = state.shelf ? { ...state, ...state.shelf } : state,
    lesson = lessonOf(of.lesson),
    usual = { ...initial, ...(lesson ? lookOf(lesson) : {}) },
    to = new URLSearchParams();
  const { gas } = of;
  if (lesson) {
    if (lesson !== START || page.given !== null) to.set("lesson", lesson.name);
    for (const [key, value] of Object.entries(gas.sets)) if (key !== "run.seed") to.append("set", `${key}=${value}`);
    if (gas.sets["run.seed"] !== undefined) to.set("seed", gas.sets["run.seed"]);
  } else if (gas.scene !== page.given || Object.keys(gas.sets).length) to.set("scene", gas.about.brief);
  for (const [name, { write, withQuestion }] of Object.entries(LOOK))
    if (name !== "playing" && (withQuestion ? of.question : write(of[name]) !== write(usual[name]))) to.set(name, write(of[name]));
  if (!of.playing) to.set("playing", "0");
  if (state.language !== own) to.set("language", state.language);
  const text = readable(to);
  return text ? `#${text}` : "";
}

/* Write the address: a new entry of the history for another lesson or scene, none for a slider. */
export function writeLink(state, step) {
  const link = linkOf(state),
    at = location.href.split("#")[0] + link;
  if (location.href === at) return;
  try {
    history[step ? "pushState" : "replaceState"](null, "", at);
  } catch (e) {
    /* the address is too long for this browser */
  }
}
