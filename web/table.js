/* The table of both engines and the theories, as `graingas compare` prints it. */
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

const number = (x, digits = 4) =>
  !Number.isFinite(x)
    ? "–"
    : x !== 0 && (Math.abs(x) < 1e-3 || Math.abs(x) >= 1e6)
      ? x.toExponential(digits - 1)
      : String(+x.toPrecision(digits));

/* 138.82(40): the error in units of the last digits; (?): it is not known. What is conserved has none but rounding. */
function withError(x, e) {
  if (!Number.isFinite(x)) return "–";
  if (!Number.isFinite(e)) return `${number(x, 3)}(?)`;
  if (e < 1e-9 * Math.abs(x) || !(e > 0)) return number(x, 6);
  const first = Math.floor(Math.log10(e)),
    places = Math.max(0, 1 - first),
    far = Math.floor(Math.log10(Math.abs(x) || e));
  if (far > 6 || far < -4) {
    const scale = 10 ** far;
    return `${withError(x / scale, e / scale)}e${far}`;
  }
  const digits = Math.round(e * 10 ** places);
  return places ? `${x.toFixed(places)}(${digits})` : `${Math.round(x)}(${Math.round(e)})`;
}

function cell(kind, text, more = {}) {
  const made = document.createElement(kind);
  made.textContent = text;
  Object.assign(made, more);
  return made;
}

function fillTable(table, means, everything) {
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
  const theories = everything ? theoriesWith(means, shown) : chosenTheories(means, theoriesWith(means, shown)),
    compared = Object.fromEntries((means.comparison || []).map((one) => [one.quantity, one]));
  const head = document.createElement("tr");
  for (const text of [
    t("quantity"),
    t("unit"),
    t("md"),
    t("dsmc"),
    t("z"),
    ...theories.map((name) => name + beyondMark(means, name)),
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
  line.append(cell("th", name, { scope: "row" }), cell("td", known ? known[name].unit : ""));
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

/* Why theories are out of their range. */
function fillRanges(list, means) {
  const beyond = Object.entries(means.theories).filter(([name, about]) => about.beyond && means.theory[name]);
  list.replaceChildren(...beyond.map(([name, about]) => cell("li", `† ${name} (${about.title}): ${about.beyond}`)));
}
