/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Warnings: limits of the model, and warnings of the library. */
import { MOST_BEHIND } from "./clock.js";
import { now } from "./gas.js";
import { t } from "./i18n.js";
import { mean } from "./theories.js";
import { number } from "./words.js";

export function allWarnings({ gas, means, player }) {
  const out = [],
    { frame } = now,
    { about } = gas,
    add = (key, values) => out.push(t(key, values));
  if (gas.refusal) add("noBox", { why: gas.refusal });
  if (gas.dsmcRefusal) out.push(`${t("dsmc")}: ${gas.dsmcRefusal}`);
  if (frame && frame.ended) add("ended", { engine: t(frame.md ? "md" : "dsmc"), why: frame.ended });
  if (frame && frame.dsmcEnded) add("ended", { engine: t("dsmc"), why: frame.dsmcEnded });
  if (now.behind > MOST_BEHIND) add("behind");
  /* a pasted scene: the live gas has no end, and keys of its protocol are changed by hand */
  if (!player && about.values.run && Number.isFinite(about.values.run.duration)) add("notFollowed");
  if (player && player.frames === 1) add("oneFrame");
  if (!means) return out;
  if (means.failed) return [...out, means.failed];
  if (player) return [...new Set([...out, ...storedWarnings(means)])].slice(0, 7);
  const length = mean(means.theory && means.theory.goldhirsch_zanetti1993, "clustering_length");
  if (about.values.flow === "hcs" && frame && frame.md && Math.max(...frame.md.box) > length)
    add("clusters", { l: number(length, 3) });
  /* both since the start; md is null until it has means, and where it cannot run */
  const { engine_state: { contact_time_collisions: caught } = {}, total } = means.md || {};
  if (total && caught > (about.values.flow === "hcs" ? 1e-4 : 1e-3) * total.collisions) add("collapse", { n: caught });
  const ratio = mean(means.md && means.md.results, "temperature_ratio");
  if (
    frame &&
    frame.md &&
    ratio > 0 &&
    Math.abs(frame.md.rotationalTemperature / frame.md.temperature / ratio - 1) >
      4 * Math.sqrt(4 / (3 * frame.md.grains))
  )
    add("spins");
  for (const [engine, p] of Object.entries(means.progress)) {
    if (p.why) add("ended", { engine: t(engine), why: p.why });
    else if (p.over && means[engine] && means[engine].steady === false)
      add("steady_no", { engine: t(engine), why: means[engine].verdict });
  }
  out.push(...warningsOf(means));
  return [...new Set(out)].slice(0, 7);
}
/* Warnings of the library, without those of an unfinished run and those shown elsewhere: reasons of missing numbers,
 * and whether the mean is steady. */
function warningsOf(means) {
  const out = [];
  for (const engine of ["md", "dsmc"]) {
    const now = means.progress[engine],
      unfinished = now && !now.over,
      elsewhere = unfinished ? /null|not a steady mean|has no error|too short for errors|blocks/ : /null|not a steady mean/;
    for (const w of (means[engine] && means[engine].warnings) || [])
      if (!elsewhere.test(w)) out.push(`${t(engine)}: ${w}`);
  }
  return out;
}
/* Warnings of a stored result: also whether its run was steady. */
function storedWarnings(means) {
  const unsteady = ["md", "dsmc"].filter((engine) => means[engine] && means[engine].steady === false);
  return [...unsteady.map((engine) => t("steady_no", { engine: t(engine), why: means[engine].verdict })), ...warningsOf(means)];
}
