/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Numbers, units and names for readers. */
import { has, t } from "./i18n.js";

export const number = (x, digits = 4) =>
  !Number.isFinite(x)
    ? "–"
    : x !== 0 && (Math.abs(x) < 1e-3 || Math.abs(x) >= 1e6)
      ? powerOfTen(x, digits)
      : String(+x.toPrecision(digits));

const SUPERSCRIPTS = "⁰¹²³⁴⁵⁶⁷⁸⁹";
export const superscript = (n) => String(n).replace(/-/, "⁻").replace(/\d/g, (d) => SUPERSCRIPTS[d]);
/* 5.05·10⁻⁵ */
export function powerOfTen(x, digits) {
  const [first, power] = x.toExponential(digits - 1).split("e");
  return `${first === "1" ? "" : `${first}·`}10${superscript(+power)}`;
}

/* 138.82(40): the error in units of the last digits; (?): unknown error. A conserved quantity has no error but
 * rounding. */
export function withError(x, e) {
  if (!Number.isFinite(x)) return "–";
  if (!Number.isFinite(e)) return `${number(x, 3)}(?)`;
  if (e < 1e-9 * Math.abs(x) || !(e > 0)) return number(x, 6);
  const first = Math.floor(Math.log10(e)),
    places = Math.max(0, 1 - first),
    far = Math.floor(Math.log10(Math.abs(x) || e));
  if (far > 6 || far < -4) {
    const scale = 10 ** far;
    return `${withError(x / scale, e / scale)}·10${superscript(far)}`;
  }
  const digits = Math.round(e * 10 ** places);
  return places ? `${x.toFixed(places)}(${digits})` : `${Math.round(x)}(${Math.round(e)})`;
}

/* rho_p d^2 gamma^2 -> ρₚ d² γ² */
export const typeset = (unit) =>
  unit
    .replace(/\^(-?\d)/g, (_, n) => superscript(n))
    .replace(/rho_p/g, "ρₚ")
    .replace(/gamma/g, "γ")
    .replace(/v_0/g, "v₀")
    .replace(/ /g, "\u202f");

const AUTHORS = { garzo: "Garzó", montanero: "Montanero" };
/* garzo_dufty1999 -> Garzó & Dufty 1999 */
export function theoryName(name) {
  if (has(`theory_${name}`)) return t(`theory_${name}`);
  const found = /^([a-z_]+?)(\d{4})(?:_(.*))?$/.exec(name);
  if (!found) return name.replace(/_/g, " ").replace(/^./, (one) => one.toUpperCase());
  const [, who, year, rest] = found,
    all = who.split("_").map((one) => AUTHORS[one] || one.replace(/^./, (c) => c.toUpperCase())),
    last = all.pop();
  return `${all.length ? `${all.join(", ")} & ` : ""}${last} ${year}${rest ? ` (${rest.replace(/_/g, ", ")})` : ""}`;
}
/* The displayed name of a quantity of the results, where it has one. */
export const quantityName = (name) => (has(`q_${name}`) ? t(`q_${name}`) : name.replace(/_/g, " "));

export function cell(kind, text, more = {}) {
  const made = document.createElement(kind);
  made.textContent = text;
  return Object.assign(made, more);
}
export const byId = (id) => document.getElementById(id);
