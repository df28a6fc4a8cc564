/* The controls of the scene: each a key of it, as the library names it. */
const FLOWS = ["usf", "hcs", "hss", "equilibrium", "couette", "chute"];
const CONTROLS = [
  { key: "phi", name: "phi", min: 0.005, max: 0.5, step: 0.005 },
  { key: "collision.e", name: "e", min: 0, max: 1, step: 0.01 },
  { key: "collision.beta", name: "beta", min: -1, max: 1, step: 0.05 },
  { key: "collision.mu", name: "mu", min: 0, max: 1, step: 0.01, box: "friction", off: "inf" },
  { key: "particles", name: "particles", min: 100, max: 4000, step: 100 },
  { key: "run.seed", name: "seed", min: 0, step: 1, plain: true },
];
const valueOf = (values, key) => key.split(".").reduce((at, part) => (at == null ? at : at[part]), values);

class Controls {
  /* `change(key, value)`: somebody moved one. */
  constructor(rows, change) {
    this.rows = rows;
    this.change = change;
    this.build();
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

  build() {
    const flow = this.element("select", { id: "flow" });
    for (const one of FLOWS) flow.append(this.element("option", { value: one, "data-t": `flow_${one}` }));
    flow.addEventListener("change", () => this.change("flow", flow.value));
    this.rows.append(this.element("div", { class: "control" }, this.label("flow", "flow"), flow));
    for (const c of CONTROLS) this.rows.append(this.one(c));
  }

  one(c) {
    const { min, max, step } = c,
      box = this.element("div", { class: "control" }, this.label(c.plain ? `${c.name}-number` : c.name, c.name));
    const number = this.element("input", { type: "number", id: `${c.name}-number`, min, max, step: "any" });
    c.number = number;
    number.addEventListener("change", () => this.moved(c, number.value));
    if (!c.plain) {
      const range = this.element("input", { type: "range", id: c.name, min, max, step });
      c.range = range;
      range.addEventListener("input", () => {
        number.value = range.value;
        this.moved(c, range.value);
      });
      box.append(range);
    }
    box.append(number);
    if (c.box) {
      const on = this.element("input", { type: "checkbox", id: c.box });
      c.on = on;
      on.addEventListener("change", () => this.moved(c, on.checked ? 0.3 : c.off));
      box.append(
        this.element("label", { for: c.box, class: "wide" }, on, " ", this.element("span", { "data-t": c.box })),
      );
    }
    return box;
  }
  moved(c, value) {
    this.change(c.key, String(value));
  }

  /* As the scene in force has it. */
  show(values) {
    const flow = document.getElementById("flow");
    let other = flow.querySelector("option[data-other]");
    if (!FLOWS.includes(values.flow)) {
      if (!other) flow.append((other = this.element("option", { "data-other": "" })));
      other.value = values.flow;
      other.textContent = t("flow_other", { name: values.flow });
    } else if (other) other.remove();
    flow.value = values.flow;
    for (const c of CONTROLS) {
      const value = valueOf(values, c.key),
        off = c.off !== undefined && String(value) === c.off,
        plain = typeof value === "number";
      for (const input of [c.range, c.number]) {
        if (!input) continue;
        input.disabled = !plain;
        if (plain && document.activeElement !== input) input.value = value;
        input.removeAttribute("aria-invalid");
      }
      if (c.on) c.on.checked = !off;
    }
    flow.removeAttribute("aria-invalid");
  }

  /* Which one the library refused, by the key that its message names. */
  refuse(key) {
    for (const c of CONTROLS)
      for (const input of [c.range, c.number]) if (input && c.key === key) input.setAttribute("aria-invalid", "true");
    if (key === "flow") document.getElementById("flow").setAttribute("aria-invalid", "true");
  }

  /* Names for those who do not see where a number stands. */
  name() {
    for (const c of CONTROLS) if (!c.plain) c.number.setAttribute("aria-label", t("number", { name: t(c.name) }));
  }
}
