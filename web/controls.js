/* The controls of the scene, a row each: a key of it, as the library names it, and how it is chosen. A row has
 *   min, max, step    a slider and a number; without min and max a number alone (plain)
 *   words             a list to choose from; their names are the strings NAME_WORD
 *   box, on, off      a box that switches it on, to the text `on`, and off, to `off`
 *   get, put          where it is not the key's own value: a number (null: none) of the scene's values; and the text for
 *                     the key of a number and those values
 *   flows             where it has an effect; everywhere without */
const FLOWS = ["usf", "hcs", "hss", "equilibrium", "couette", "chute"];
const WALLED = ["couette", "poiseuille", "chute"];

/* The second species beside the first: its diameter or mass over that one's. */
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

/* How steep a chute is, in degrees, its pull being as strong as before. */
const tilt = {
  key: "gravity",
  get: ({ gravity: [along, down] }) => +((Math.atan2(along, -down) * 180) / Math.PI).toFixed(2),
  put: (degrees, { gravity: [along, down] }) => {
    const pull = Math.hypot(along, down),
      angle = (degrees * Math.PI) / 180;
    return `[${(pull * Math.sin(angle)).toPrecision(6)}, ${(-pull * Math.cos(angle)).toPrecision(6)}, 0]`;
  },
};

const CONTROLS = [
  { key: "flow", name: "flow", words: FLOWS },
  { key: "thermostat", name: "thermostat", words: ["gaussian", "white_noise"], flows: ["hss"] },
  { name: "tilt", ...tilt, min: 0, max: 60, step: 1, flows: ["chute"] },
  { key: "phi", name: "phi", min: 0.005, max: 0.5, step: 0.005 },
  { key: "collision.e", name: "e", min: 0, max: 1, step: 0.01 },
  { key: "collision.law", name: "law", words: ["constant", "viscoelastic"] },
  { key: "collision.beta", name: "beta", min: -1, max: 1, step: 0.05 },
  { key: "collision.mu", name: "mu", min: 0, max: 1, step: 0.01, box: "friction", on: () => "0.3", off: () => "inf" },
  { key: "walls.e", name: "wallE", min: 0, max: 1, step: 0.01, flows: WALLED },
  { key: "walls.beta", name: "wallBeta", min: -1, max: 1, step: 0.05, flows: WALLED },
  { name: "diameter", ...ratioOf("diameter"), min: 0.25, max: 4, step: 0.05, box: "mixture", on: inTwo, off: alone },
  { name: "mass", ...ratioOf("mass"), min: 0.1, max: 20, step: 0.1 },
  { key: "particles", name: "particles", min: 100, max: 4000, step: 100 },
  { key: "run.seed", name: "seed", min: 0, step: 1, plain: true },
];
const valueOf = (values, key) => key.split(".").reduce((at, part) => (at == null ? at : at[part]), values);
const asText = (value) => (typeof value === "object" ? JSON.stringify(value) : String(value));
const shownValue = (row, values) => (row.get ? row.get(values) : valueOf(values, row.key));

class Controls {
  /* `change(key, value)`: somebody moved one. `wanted()`: the values that its new one is put into. */
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

  /* As the scene in force has it. */
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
  /* A word that the list has not comes with the scene. */
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

  /* Which one the library refused, by the key that its message names. */
  refuse(key) {
    for (const row of CONTROLS)
      if (row.key === key) for (const input of row.inputs) input.setAttribute("aria-invalid", "true");
  }

  /* Names for those who do not see where a number stands. */
  name() {
    for (const row of CONTROLS)
      if (row.number && !row.plain) row.number.setAttribute("aria-label", t("number", { name: t(row.name) }));
  }
}
