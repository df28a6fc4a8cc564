/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The modules of the page in node alone: no bundler, no browser, no built page. */
"use strict";
const fs = require("fs"),
  os = require("os"),
  path = require("path"),
  { pathToFileURL } = require("url");

const folder = path.resolve(__dirname, "../../web");

/* Copy the page's modules in a form that node can import; texts become modules, too. */
function copyTo(work) {
  fs.mkdirSync(path.join(work, "strings"));
  fs.writeFileSync(path.join(work, "package.json"), '{"type": "module"}');
  for (const name of fs.readdirSync(folder).filter((one) => /\.js$/.test(one)))
    fs.writeFileSync(path.join(work, name), fs.readFileSync(path.join(folder, name), "utf8").replace(/(from "\.\/strings\/\w+\.json)"/g, '$1.js"'));
  for (const name of fs.readdirSync(path.join(folder, "strings")))
    fs.writeFileSync(path.join(work, "strings", `${name}.js`), `export default ${fs.readFileSync(path.join(folder, "strings", name), "utf8")};`);
}
/* {chart: {ticks, ...}, ...}; each call returns modules with a fresh state. */
async function modules(names) {
  const work = fs.mkdtempSync(path.join(os.tmpdir(), "graingas-modules-")),
    all = {};
  try {
    copyTo(work);
    for (const name of names) all[name] = await import(pathToFileURL(path.join(work, `${name}.js`)).href);
  } finally {
    fs.rmSync(work, { recursive: true });
  }
  return all;
}
const strings = (language) => JSON.parse(fs.readFileSync(path.join(folder, "strings", `${language}.json`), "utf8"));
const texts = () =>
  fs
    .readdirSync(folder)
    .filter((name) => /\.(js|html)$/.test(name))
    .map((name) => fs.readFileSync(path.join(folder, name), "utf8"));

/* {gas: ["controls", "flows", ...], ...}: the modules that each one imports. */
const imports = () =>
  Object.fromEntries(
    fs
      .readdirSync(folder)
      .filter((name) => /\.js$/.test(name))
      .map((name) => [name.slice(0, -3), [...fs.readFileSync(path.join(folder, name), "utf8").matchAll(/from "\.\/(\w+)\.js"/g)].map((found) => found[1])]),
  );

module.exports = { modules, imports, strings, texts, languages: fs.readdirSync(path.join(folder, "strings")).map((name) => name.replace(".json", "")) };
