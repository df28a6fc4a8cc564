/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Which theories are drawn, and how: a theory has the same style in each diagram. */
import { LINES } from "./colours.js";
import { store } from "./state.js";
import { byId, cell, theoryName } from "./words.js";

/* The best known first. */
const FIRST = [
  "enskog_hermite",
  "haff1983",
  "gaussian_closure",
  "lun1991",
  "huthmann_zippelius1997",
  "garzo_dufty1999",
  "enskog",
  "sela_goldhirsch1998",
  "grad",
];
const FEW = 2; /* drawn without a choice of the user */

export const mean = (part, name) => (part && part[name] && Number.isFinite(part[name].mean) ? part[name].mean : NaN);
export const error = (part, name) => (part && part[name] && Number.isFinite(part[name].stderr) ? part[name].stderr : NaN);

/* The results of an engine that averages or has ended; undefined while it warms up. A stored result has no progress. */
export function settled(means, engine) {
  const part = means && means[engine],
    p = means && means.progress && means.progress[engine];
  return part && (!p || p.averaging || p.over) ? part.results : undefined;
}

export function ranked(names) {
  const rank = (name) => (FIRST.indexOf(name) + FIRST.length + 1) % (FIRST.length + 1);
  return [...names].sort((a, b) => rank(a) - rank(b));
}
/* Theories with an answer to one of these quantities. */
export function theoriesWith(means, names) {
  return ranked(Object.keys(means.theory || {}).filter((name) => names.some((q) => Number.isFinite(mean(means.theory[name], q)))));
}
/* The theories that are drawn: the first few, or the student's choice. */
export function chosenTheories(names) {
  const all = ranked(names),
    { theories } = store.state;
  return theories ? all.filter((name) => theories.includes(name)) : all.slice(0, FEW);
}
/* The best known theories have the same line for every gas (grad and enskog are of different flows); the others share
 * the lines that are left. */
const FIXED = Object.fromEntries(FIRST.map((name, i) => [name, LINES[name === "grad" ? FIRST.indexOf("enskog") : i]]));
export function lineOf(name) {
  if (FIXED[name]) return FIXED[name];
  const known = store.state.means ? drawable(store.state.means) : [],
    taken = known.map((one) => FIXED[one]),
    left = LINES.filter((one) => !taken.includes(one)),
    at = Math.max(0, known.filter((one) => !FIXED[one]).indexOf(name));
  return (left.length ? left : LINES)[at % (left.length || LINES.length)];
}
export const drawable = (means) =>
  ranked([...new Set([...theoriesWith(means, ["temperature", "N1", "cooling_rate"]), ...Object.keys((means.cooling && means.cooling.T) || {})])]);
/* A dagger marks a theory out of its range. */
export const titleOf = (means, name) => `${theoryName(name)}${means.theories[name] && means.theories[name].beyond ? " †" : ""}`;

/* A check box for each theory. */
export function showTheories(means) {
  const names = drawable(means),
    shown = store.state.theories || names.filter((name, i) => i < FEW),
    list = byId("theory-boxes");
  if (list.dataset.names !== names.join()) {
    list.dataset.names = names.join();
    list.replaceChildren(...names.map((name) => theoryBox(name, means)));
  }
  for (const box of list.querySelectorAll("input")) box.checked = shown.includes(box.value);
}
function theoryBox(name, means) {
  const label = document.createElement("label"),
    box = Object.assign(document.createElement("input"), { type: "checkbox", value: name });
  box.addEventListener("change", () =>
    store.look({ theories: [...byId("theory-boxes").querySelectorAll("input:checked")].map((one) => one.value) }),
  );
  label.append(box, ` ${theoryName(name)} `, cell("small", means.theories[name] ? means.theories[name].title : ""));
  return label;
}
