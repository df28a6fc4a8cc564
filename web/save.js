/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Files that the page saves: the picture, the curves, the scene. Names of files tell which gas it is. */
import { make } from "./chart.js";
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

/* The boxes side by side, under them the title of the gas and the meaning of the colours: from `low` over the scale
 * to `high`. */
export function boxPicture(boxes, title, scale, [low, high]) {
  const line = Math.max(16, Math.round(boxes[0].width / 36)),
    sheet = Object.assign(document.createElement("canvas"), { width: boxes.reduce((sum, one) => sum + one.width, 0), height: boxes[0].height + 4 * line }),
    to = sheet.getContext("2d");
  to.fillStyle = "#ffffff";
  to.fillRect(0, 0, sheet.width, sheet.height);
  boxes.reduce((x, one) => (to.drawImage(one, x, 0), x + one.width), 0);
  Object.assign(to, { font: `${line * 0.8}px sans-serif`, fillStyle: "#1b1f23", textBaseline: "middle" });
  to.fillText(title, line / 2, boxes[0].height + line, sheet.width - line);
  let x = line / 2;
  const y = boxes[0].height + 2.6 * line,
    put = (text) => (to.fillText(text, x, y), (x += to.measureText(text).width + line / 2));
  put(low);
  to.drawImage(scale, x, y - line / 3, 8 * line, (2 * line) / 3);
  x += 8.5 * line;
  put(high);
  return sheet;
}

/* A diagram with its title and its legend, as a separate drawing. */
const STYLE = "text{font:12px sans-serif;fill:#1b1f23}.rule{display:none}";
export function curveSvg(figure, title) {
  const plot = figure.querySelector(".plot svg").cloneNode(true),
    { width, height } = plot.viewBox.baseVal,
    keys = [...figure.querySelectorAll(".legend li")],
    line = 18;
  plot.setAttribute("y", 2 * line);
  const legend = keys.map((key, i) => {
    const mark = key.firstChild.cloneNode(true);
    for (const [name, value] of Object.entries({ width: 26, height: 10, y: -9 })) mark.setAttribute(name, value);
    return make("g", { transform: `translate(10 ${height + (3 + i) * line})` }, mark, make("text", { x: 34 }, key.lastChild.textContent));
  });
  const svg = make(
    "svg",
    { xmlns: "http://www.w3.org/2000/svg", width, height: height + (3 + keys.length) * line, viewBox: `0 0 ${width} ${height + (3 + keys.length) * line}` },
    make("style", {}, STYLE),
    make("rect", { width: "100%", height: "100%", fill: "#fff" }),
    make("text", { x: 10, y: line, "font-weight": "bold" }, figure.querySelector("figcaption").textContent),
    make("text", { x: 10, y: 1.9 * line }, title),
    plot,
    ...legend,
  );
  return new XMLSerializer().serializeToString(svg);
}

const COURSES = [
  ["T", "md_temperature"],
  ["theta", "md_rotational_temperature"],
  ["T2", "dsmc_temperature"],
  ["theta2", "dsmc_rotational_temperature"],
];
const tidy = (x) => (Number.isFinite(x) ? x : "");

/* The history as a table, a row a time; below it a table for each measured curve. */
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
