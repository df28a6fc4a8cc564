/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Texts, one JSON file a language. A test finds strings that a language lacks. {x} is replaced by a value. */
import de from "./strings/de.json";
import en from "./strings/en.json";
import es from "./strings/es.json";
import { store } from "./state.js";

export const LANGUAGES = { en, de, es };

export function t(key, values = {}) {
  const text = LANGUAGES[store.state.language][key];
  if (text === undefined) throw new Error(`no text "${key}"`);
  return text.replace(/\{(\w+)\}/g, (_, name) => values[name]);
}
export const has = (key) => key in LANGUAGES[store.state.language];

/* The language of a page whose address names none. */
export function ownLanguage() {
  const own = (navigator.language || "en").slice(0, 2);
  return Object.keys(LANGUAGES).includes(own) ? own : "en";
}
