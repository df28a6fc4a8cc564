/* SPDX-License-Identifier: GPL-3.0-or-later */
/* TAP, as the tests of the command print it; and the two programs that are compared: the command and the engines in
 * node. */
"use strict";
const fs = require("fs"),
  os = require("os"),
  path = require("path"),
  { execFileSync } = require("child_process");

const module_file = process.env.ENGINES,
  command = process.env.GRAINGAS;

async function engines() {
  if (!fs.existsSync(module_file)) {
    console.log("1..0 # SKIP the page was not built (ninja page)");
    process.exit(0);
  }
  const { openEngines } = await import(path.resolve(__dirname, "../../web/engines.js"));
  return openEngines(require(module_file), { wasmBinary: fs.readFileSync(module_file.replace(/js$/, "wasm")) });
}

const terminal = (scene, ...args) =>
  execFileSync(command, args.concat("-"), { input: scene, encoding: "utf8", maxBuffer: 1 << 26 });
/* The command's message on standard error when it rejects a scene. */
const refusal = (scene, ...args) => {
  try {
    execFileSync(command, args.concat("-"), { input: scene, encoding: "utf8", stdio: ["pipe", "pipe", "pipe"] });
  } catch (e) {
    return e.stderr;
  }
  return "";
};

/* A result file of the command: its bytes, and what the command printed. */
function resultOf(scene, use = "run", more = []) {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), "graingas-result-")),
    file = path.join(folder, "result.h5");
  const printed = JSON.parse(terminal(scene, use, "--json", "--quiet", "--output", file, ...more));
  const bytes = fs.readFileSync(file);
  fs.rmSync(folder, { recursive: true });
  return { printed, bytes };
}
/* The command's message about a file with these bytes. */
function refusalOf(bytes, name = "given.h5") {
  const folder = fs.mkdtempSync(path.join(os.tmpdir(), "graingas-result-"));
  fs.writeFileSync(path.join(folder, name), bytes);
  try {
    execFileSync(path.resolve(command), ["info", name], { cwd: folder, encoding: "utf8", stdio: ["pipe", "pipe", "pipe"] });
  } catch (e) {
    return e.stderr.trim();
  } finally {
    fs.rmSync(folder, { recursive: true });
  }
  return "";
}

/* One line a test; a test that returns "SKIP why" is skipped. */
async function list(tests, g) {
  const names = Object.keys(tests);
  console.log(`1..${names.length}`);
  for (const [i, name] of names.entries()) {
    try {
      const note = await tests[name](g);
      console.log(`ok ${i + 1} - ${name}${note ? ` # ${note}` : ""}`);
    } catch (e) {
      console.log(`not ok ${i + 1} - ${name}`);
      console.error(`# ${e.stack}`);
      process.exitCode = 1;
    }
  }
}
const run = async (tests) => list(tests, await engines());

module.exports = { run, list, terminal, refusal, resultOf, refusalOf };
