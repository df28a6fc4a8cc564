/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The controls of the scene, a row each: a key, as the library names it, and how it is chosen. A row has
 *   min, max, step    a slider and a number; without min and max a number alone (plain)
 *   words             a list to choose from; their names are the strings NAME_WORD
 *   box, on, off      a box that switches the key on, to the text `on`, and off, to `off`
 *   get, put          where the value differs from the key's: get is a number (null: none) of the scene's values,
 *                     put the text for the key, of a number and those values
 *   flows             the flows in which it has an effect; all flows without it */
import { WALLED } from "./flows.js";
import { store } from "./state.js";
import { t } from "./i18n.js";

export const FLOWS = ["usf", "hcs", "hss", "equilibrium", "couette", "poiseuille", "chute", "fourier"];
const GRAVITY = { chute: "[0.1, -0.1, 0]", poiseuille: "[1, 0, 0]" };

/* The diameter or mass of the second species over that of the first. */
const ratioOf = (part) => ({
  key: "species",
  get: ({ species }) => (species.length === 2 ? species[1][part] / species[0][part] : null),
  put: (ratio, { species: [one, two] }) => JSON.stringify([one, { ...two, [part]: ratio * one[part] }]),
});
const alone = ({ species: [one] }) => JSON.stringify([{ ...one, fraction: 1 }]);
const inTwo = ({ species: [one] }) =>
  JSON.stringify([
    { ...one, fraction: 0.5 },
    { ...one, fraction: 0.5, diameter: 2 * one.diameter, mass: 8 * one.mass },
  ]);

/* The angle of a chute in degrees; the magnitude of gravity stays the same. */
const tilt = {
  key: "gravity",
  get: ({ gravity: [along, down] }) => +((Math.atan2(along, -down) * 180) / Math.PI).toFixed(2),
  put: (degrees, { gravity: [along, down] }) => {
    const pull = Math.hypot(along, down),
      angle = (degrees * Math.PI) / 180;
    return `[${(pull * Math.sin(angle)).toPrecision(6)}, ${(-pull * Math.cos(angle)).toPrecision(6)}, 0]`;
  },
};

export const CONTROLS = [
  { key: "flow", name: "flow", words: FLOWS },
  { key: "thermostat", name: "thermostat", words: ["gaussian", "white_noise"], flows: ["hss"] },
  { name: "tilt", ...tilt, min: 0, max: 60, step: 1, flows: ["chute"] },
  { key: "phi", name: "phi", min: 0.005, max: 0.5, step: 0.005, symbol: "φ" },
  { key: "collision.e", name: "e", min: 0, max: 1, step: 0.01, symbol: "e", wide: [0.5, 1] },
  { key: "collision.law", name: "law", words: ["constant", "viscoelastic"] },
  { key: "collision.beta", name: "beta", min: -1, max: 1, step: 0.05, symbol: "β" },
  { key: "collision.mu", name: "mu", min: 0, max: 1, step: 0.01, symbol: "μ", box: "friction", on: () => "0.3", off: () => "inf" },
  { key: "walls.e", name: "wallE", min: 0, max: 1, step: 0.01, flows: WALLED },
  { key: "walls.beta", name: "wallBeta", min: -1, max: 1, step: 0.05, flows: WALLED },
  { name: "diameter", ...ratioOf("diameter"), min: 0.25, max: 4, step: 0.05, box: "mixture", on: inTwo, off: alone },
  { name: "mass", ...ratioOf("mass"), min: 0.1, max: 20, step: 0.1 },
  { key: "particles", name: "particles", min: 100, max: 4000, step: 100, symbol: "N" },
  { key: "run.seed", name: "seed", min: 0, step: 1, plain: true },
];
export const valueOf = (values, key) => key.split(".").reduce((at, part) => (at == null ? at : at[part]), values);
export const asText = (value) => (typeof value === "object" ? JSON.stringify(value) : String(value));
export const shownValue = (row, values) => (row.get ? row.get(values) : valueOf(values, row.key));

export class Controls {
  /* `change(key, value)`: called after the user has changed a control. `wanted()`: the values into which the new one
   * is put. */
  constructor(rows, change, wanted) {
    Object.assign(this, { rows, change, wanted });
    for (const row of CONTROLS) this.rows.append((row.all = row.words ? this.choice(row) : this.number(row)));
  }

  element(kind, attributes, ...children) {
    const made = document.createElement(kind);
    Object.entries(attributes).forEach(([name, value]) => {
      if (value !== undefined) made.setAttribute(name, value);
    });
    made.append(...children);
    return made;
  }
  label(target, key) {
    return this.element("label", { for: target, "data-t": key });
  }

  choice(row) {
    const select = this.element("select", { id: row.name });
    for (const one of row.words) select.append(this.element("option", { value: one, "data-t": `${row.name}_${one}` }));
    select.addEventListener("change", () => this.change(row.key, select.value));
    row.inputs = [select];
    return this.element("div", { class: "control" }, this.label(row.name, row.name), select);
  }

  number(row) {
    const { min, max, step, name } = row,
      box = this.element("div", { class: "control" }, this.label(row.plain ? `${name}-number` : name, name));
    row.number = this.element("input", { type: "number", id: `${name}-number`, min, max, step: "any" });
    row.inputs = [row.number];
    row.number.addEventListener("change", () => this.moved(row, row.number.value));
    if (!row.plain) {
      const range = this.element("input", { type: "range", id: name, min, max, step });
      row.inputs.unshift(range);
      range.addEventListener("input", () => {
        row.number.value = range.value;
        this.moved(row, range.value);
      });
    }
    box.append(...row.inputs);
    if (row.box) box.prepend(this.switch(row));
    return box;
  }
  switch(row) {
    row.on_off = this.element("input", { type: "checkbox", id: row.box });
    row.on_off.addEventListener("change", () =>
      this.change(row.key, (row.on_off.checked ? row.on : row.off)(this.wanted())),
    );
    return this.element(
      "label",
      { for: row.box, class: "wide" },
      row.on_off,
      " ",
      this.element("span", { "data-t": row.box }),
    );
  }
  moved(row, value) {
    this.change(row.key, row.put && value !== "" ? row.put(Number(value), this.wanted()) : String(value));
  }

  /* Show the values of the scene in force. */
  show(values) {
    this.values = values;
    for (const row of CONTROLS) {
      row.all.hidden = !!row.flows && !row.flows.includes(values.flow);
      for (const input of row.inputs) input.removeAttribute("aria-invalid");
      if (row.words) this.showChoice(row, values);
      else this.showNumber(row, shownValue(row, values));
    }
  }
  showNumber(row, value) {
    const plain = typeof value === "number";
    for (const input of row.inputs) {
      input.disabled = !plain;
      if (plain && document.activeElement !== input) input.value = value;
    }
    if (row.get && !row.box && !plain) row.all.hidden = true;
    if (!row.on_off) return;
    row.on_off.checked = plain || (value !== null && String(value) !== row.off(this.values));
    row.all.classList.toggle("off", !row.on_off.checked);
  }
  /* Add a word of the scene that the list does not have. */
  showChoice(row, values) {
    const [select] = row.inputs,
      value = valueOf(values, row.key);
    let other = select.querySelector("option[data-other]");
    if (!row.words.includes(value)) {
      if (!other) select.append((other = this.element("option", { "data-other": "" })));
      other.value = value;
      other.textContent = t("word_other", { name: value });
    } else if (other) other.remove();
    select.value = value;
  }

  /* Mark the controls whose keys are named in the library's error message. */
  refuse(keys) {
    for (const row of CONTROLS)
      if (keys.includes(row.key)) for (const input of row.inputs) input.setAttribute("aria-invalid", "true");
  }

  /* Move the control of a lesson to the front; the others keep their order. */
  pull(name, place) {
    for (const row of CONTROLS) (row.name === name ? place : this.rows).append(row.all);
    place.hidden = !name;
  }

  /* Names for screen readers. */
  name() {
    for (const row of CONTROLS)
      if (row.number && !row.plain) row.number.setAttribute("aria-label", t("number", { name: t(row.name) }));
  }
}

/* The row of a name, and the label before its value. */
export const rowOf = (name) => CONTROLS.find((row) => row.name === name) || CONTROLS.find((row) => row.name === "e");
export const symbolOf = (row) => row.symbol || t(row.name);
/* The range over which theories are drawn: that of the slider, or the part `wide` of it. */
export const gridOf = (row, n = 9) => {
  const [a, b] = row.wide || [row.min, row.max];
  return Array.from({ length: n }, (_, i) => a + ((b - a) * i) / (n - 1));
};

/* Keys that dissipate energy, and their values in an elastic gas. */
const ELASTIC = { "collision.e": "1", "collision.beta": "-1", "collision.mu": "inf", "collision.law": "constant" };
let inelastic = null; /* the values of these keys before the gas became elastic */

/* The wanted value of the next gas: of a key as text, and the values that controls build on. */
function wantedText(key) {
  const { requested, gas } = store.state,
    wanted = requested.sets[key];
  return wanted === undefined || wanted === gas.sets[key] ? asText(valueOf(gas.about.values, key)) : wanted;
}
export function wantedValues() {
  const values = { ...store.state.gas.about.values };
  for (const key of ["species", "gravity"])
    try {
      values[key] = JSON.parse(wantedText(key));
    } catch (e) {
      /* a link has a form of its own: take the value in force */
    }
  return values;
}

/* The keys to set together with this one: keys that a flow requires, and that other flows reject. Equilibrium
 * requires e = 1; the flow after it gets back the previous value, or 0.9 without one. */
export function setsOf(key, value) {
  const sets = { [key]: value };
  if (key !== "flow") return sets;
  const before = wantedText("flow");
  Object.assign(sets, {
    thermostat: value === "hss" ? "gaussian" : "none",
    gravity: GRAVITY[value] || "[0, 0, 0]",
    "walls.temperature": value === "fourier" ? "[1, 0.5]" : "none",
  });
  if (value === "equilibrium") {
    if (before !== "equilibrium") inelastic = Object.fromEntries(Object.keys(ELASTIC).map((one) => [one, wantedText(one)]));
    Object.assign(sets, ELASTIC);
  } else if (before === "equilibrium") {
    Object.assign(sets, inelastic || { "collision.e": "0.9" });
    inelastic = null;
  }
  return sets;
}
