/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The modules of the page, bundled for node as they are for a browser. */
"use strict";
const fs = require("fs"),
  os = require("os"),
  path = require("path"),
  { execFileSync } = require("child_process");

const folder = path.resolve(__dirname, "../../web");

/* {chart: {ticks, ...}, ...}, each call with a state of its own. */
function modules(names) {
  const work = fs.mkdtempSync(path.join(os.tmpdir(), "graingas-modules-")),
    file = path.join(work, "all.cjs");
  const entry = names.map((name) => `export * as ${name} from ${JSON.stringify(path.join(folder, `${name}.js`))};`).join("\n");
  execFileSync("esbuild", ["--bundle", "--platform=node", "--log-level=error", `--outfile=${file}`], { input: entry });
  const all = require(file);
  fs.rmSync(work, { recursive: true });
  return all;
}
const strings = (language) => JSON.parse(fs.readFileSync(path.join(folder, "strings", `${language}.json`), "utf8"));
const texts = () =>
  fs
    .readdirSync(folder)
    .filter((name) => /\.(js|html)$/.test(name))
    .map((name) => fs.readFileSync(path.join(folder, name), "utf8"));

module.exports = { modules, strings, texts, languages: fs.readdirSync(path.join(folder, "strings")).map((name) => name.replace(".json", "")) };
