/* SPDX-License-Identifier: GPL-3.0-or-later */
/* What can be taken along: the picture, the curves, the scene. Names of files say which gas it is. */
import { t } from "./i18n.js";
import { byId } from "./words.js";

export function save(name, blob) {
  const link = document.createElement("a");
  link.href = URL.createObjectURL(blob);
  link.download = name;
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
  byId("taken").textContent = t("saved", { name });
}
/* graingas-cooling-e0.8-seed1.csv */
export function fileName({ values }, ending) {
  const { flow, phi, collision, run } = values;
  return `graingas-${flow}-phi${phi}-e${collision.e}${collision.beta > -1 ? `-beta${collision.beta}` : ""}-seed${run.seed}.${ending}`;
}

const COURSES = [
  ["T", "md_temperature"],
  ["theta", "md_rotational_temperature"],
  ["T2", "dsmc_temperature"],
  ["theta2", "dsmc_rotational_temperature"],
];
const tidy = (x) => (Number.isFinite(x) ? x : "");

/* A table of how the gas went, a row a time; below it one of each curve that was measured. */
export function curvesCsv(history, means, title) {
  const parts = [`# ${title}`];
  if (history.rows) {
    const used = COURSES.filter(([column]) => history.rows.some((row) => Number.isFinite(row[column])));
    parts.push(["time", "collisions_per_grain", ...used.map(([, name]) => name)].join(","));
    for (const row of history.rows) parts.push([row.time, row.clock, ...used.map(([column]) => tidy(row[column]))].join(","));
  } else
    for (const [column, name] of COURSES) {
      const { x, y } = history.course(column);
      if (x.length) parts.push(`time,${name}`, ...x.map((at, i) => `${at},${tidy(y[i])}`));
    }
  for (const engine of ["md", "dsmc"])
    for (const [name, c] of Object.entries((means && means[engine] && means[engine].curves) || {}))
      parts.push("", `${c.x_name},${engine}_${name},error`, ...c.x.flatMap((x, i) => (c.value[i] === null ? [] : [`${x},${c.value[i]},${c.stderr[i] ?? ""}`])));
  return `${parts.join("\n")}\n`;
}
