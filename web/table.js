/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The table of both engines and the theories, as `graingas compare` prints it. */
import { t } from "./i18n.js";
import { chosenTheories, error, mean, theoriesWith, titleOf } from "./theories.js";
import { cell, number, quantityName, theoryName, typeset, withError } from "./words.js";

const MAIN = [
  "temperature",
  "rotational_temperature",
  "temperature_ratio",
  "spin_z",
  "pressure",
  "compressibility_factor",
  "shear_viscosity",
  "N1",
  "N2",
  "P_xy",
  "collision_rate",
  "mean_free_path",
  "cooling_rate",
  "a2",
  "energy_balance",
];

export function fillTable(table, means, everything) {
  const parts = [means.md && means.md.results, means.dsmc && means.dsmc.results];
  const names = everything
    ? [
        ...new Set(
          parts.flatMap((part) => Object.keys(part || {})).concat(Object.values(means.theory).flatMap(Object.keys)),
        ),
      ]
    : MAIN;
  const shown = names.filter(
    (name) =>
      parts.some((part) => Number.isFinite(mean(part, name))) ||
      (!everything && Object.values(means.theory).some((one) => Number.isFinite(mean(one, name)))) ||
      everything,
  );
  const theories = everything ? theoriesWith(means, shown) : chosenTheories(theoriesWith(means, shown)),
    compared = Object.fromEntries((means.comparison || []).map((one) => [one.quantity, one]));
  const head = document.createElement("tr");
  for (const text of [
    t("quantity"),
    t("unit"),
    t("md"),
    t("dsmc"),
    t("z"),
    ...theories.map((name) => titleOf(means, name)),
  ])
    head.append(cell("th", text, { scope: "col" }));
  table.tHead.replaceChildren(head);
  table.tBodies[0].replaceChildren(...shown.map((name) => row(name, parts, theories, means, compared[name] || {})));
}

function row(name, parts, theories, means, { md_dsmc_z: z, beyond_expected: far }) {
  const line = document.createElement("tr"),
    known = [...parts, ...theories.map((one) => means.theory[one])].find(
      (part) => part && part[name] && part[name].unit,
    );
  line.append(cell("th", quantityName(name), { scope: "row", title: name }), cell("td", known ? typeset(known[name].unit) : ""));
  for (const part of parts)
    line.append(
      cell("td", withError(mean(part, name), error(part, name)), {
        title: (part && part[name] && part[name].reason) || "",
      }),
    );
  line.append(
    cell("td", Number.isFinite(z) ? `${z > 0 ? "+" : ""}${z.toFixed(1)}${far ? " !" : ""}` : "", {
      className: far ? "far" : "",
    }),
  );
  for (const one of theories) line.append(cell("td", number(mean(means.theory[one], name))));
  return line;
}

/* List the reasons why theories are out of their range. */
export function fillRanges(list, means) {
  const beyond = Object.entries(means.theories).filter(([name, about]) => about.beyond && means.theory[name]);
  list.replaceChildren(...beyond.map(([name, about]) => cell("li", `† ${theoryName(name)} (${about.title}): ${about.beyond}`)));
}
