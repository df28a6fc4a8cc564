/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The worker's side of the page: messages in, answers out. One worker shows the gas, another measures it. */
import { openEngines } from "./engines.js";
import { LiveGas, costOf } from "./live.js";
import { Evaluating, Measuring, theoriesOf } from "./measuring.js";
import { Replay, readResult } from "./replay.js";

let g = null,
  live = null,
  replay = null,
  measuring = null,
  evaluating = null,
  timer = 0,
  told = 0;

export const JOBS = {
  open: async ({ wasm }) => {
    g = await openEngines(globalThis.graingas, { wasmBinary: wasm });
    return { version: g.version };
  },
  cost: ({ scene, sets }) => costOf(g, scene, sets),
  theory: ({ scene, sets }) => theoriesOf(g, scene, sets),
  start: ({ scene, sets, pair, remember }) => {
    const next = new LiveGas(g, scene, sets, { pair, remember });
    if (live) live.free();
    live = next;
    return { about: live.about, refusal: live.refusal, dsmcRefusal: live.dsmcRefusal };
  },
  reverse: () => (live.reverse(), {}),
  frame: (job) => (live ? live.frame(job) : {}),
  play: ({ file }) => {
    const next = new Replay(g, file);
    if (replay) replay.free();
    replay = next;
    return { about: replay.about };
  },
  played: (job) => replay.frame(job),
  close: () => {
    if (replay) replay.free();
    replay = null;
    return {};
  },
  read: ({ file }) => readResult(g, file),
  measure: ({ scene, sets, id }) => {
    clearTimeout(timer);
    if (measuring) measuring.free();
    measuring = null;
    measuring = new Measuring(g, scene, sets);
    measuring.id = id;
    told = 0;
    later();
    return measuring.means();
  },
  evaluate: ({ scene, sets, id }) => {
    clearTimeout(timer);
    if (evaluating) evaluating.free();
    evaluating = null;
    evaluating = new Evaluating(g, scene, sets);
    evaluating.id = id;
    timer = setTimeout(evaluateNext, 0);
    return {};
  },
  hash: ({ scene, collisions }) => {
    const made = new g.Scene(scene),
      simulation = new g.Simulation(made);
    simulation.collide(collisions);
    const hash = simulation.hash();
    simulation.free();
    made.free();
    return { hash };
  },
  memory: () => ({ bytes: g.memory() }),
};

function later() {
  clearTimeout(timer);
  timer = setTimeout(goOn, 0);
}

/* Measure for a few milliseconds, then serve messages of the page. */
function goOn() {
  const { id } = measuring;
  try {
    measureOn(id);
  } catch (e) {
    postMessage({ job: "means", id, refused: e.message });
  }
}
function measureOn(id) {
  const over = measuring.goOn(25),
    now = Date.now();
  if (over || now - told > 900) {
    told = now;
    postMessage({ job: "means", id, answer: measuring.means() });
  }
  if (!over) later();
}

/* Evaluate one theory, then serve messages of the page. */
function evaluateNext() {
  const { id } = evaluating;
  try {
    const done = evaluating.goOn();
    postMessage({ job: "theories", id, answer: { ...evaluating.found, done } });
    if (!done) timer = setTimeout(evaluateNext, 0);
  } catch (e) {
    postMessage({ job: "theories", id, refused: e.message });
  }
}

const transfers = (answer) =>
  [answer.picture, answer.twinPicture]
    .filter(Boolean)
    .flatMap(({ position, value, marks, velocity }) => [position, value, marks, velocity].filter(Boolean).map((array) => array.buffer));

onmessage = async ({ data }) => {
  try {
    const answer = await JOBS[data.job](data);
    postMessage({ job: data.job, id: data.id, answer }, transfers(answer));
  } catch (e) {
    postMessage({ job: data.job, id: data.id, refused: e.message, status: e.status || 1 });
  }
};
