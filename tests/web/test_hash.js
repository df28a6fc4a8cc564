/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Same scene and seed, same trajectory: after 100 000 collisions the state in WebAssembly equals that of the command
 * to the last bit. */
"use strict";
const assert = require("assert"),
  { run, terminal } = require("./tap.js"),
  scenes = require("./scenes.js");

const tests = {};
for (const [name, yaml] of Object.entries(scenes))
  tests[name] = (g) => {
    const scene = new g.Scene(yaml),
      simulation = new g.Simulation(scene);
    const there = JSON.parse(terminal(yaml, "fingerprint", "--json"));
    simulation.collide(100000);
    const here = simulation.state();
    assert.strictEqual(here.collisions, there.collisions);
    assert.strictEqual(simulation.hash(), there.fingerprint);
    assert.strictEqual(here.temperature, there.temperature);
    simulation.free();
    scene.free();
  };
run(tests);
