/* SPDX-License-Identifier: GPL-3.0-or-later */
import { isWalled } from "./flows.js";
import { sceneOf } from "./live.js";

/* Times for the lines of theories of free cooling: decades, few enough, as far as diagrams go. The page draws lines
 * between them, which at late times are straight. */
export const COOLING_TIMES = [
  ...Array.from({ length: 120 }, (_, i) => 10 ** (i / 12 - 4)),
  ...Array.from({ length: 589 }, (_, i) => 10 ** (6 + i / 2)),
];
export function courseOfTheories(comparison) {
  const T = {};
  for (const name of Object.keys(comparison.document().theory || {})) {
    const values = comparison.cooling(name, COOLING_TIMES);
    if (Number.isFinite(values[0])) T[name] = values;
  }
  return { cooling: { time: COOLING_TIMES, T } };
}

/* These take seconds: evaluated last. */
const SLOW = ["enskog_hermite", "navier_stokes", "navier_stokes_hermite", "moments"];
/* A theory that takes microseconds: a comparison of engines alone has it, too. */
const QUICK = "haff1983";

/* The theories of a scene, one by one, in a worker of their own: means do not wait for them. */
export class Evaluating {
  constructor(g, text, sets) {
    this.g = g;
    this.scene = sceneOf(g, text, sets);
    this.names = g.catalogue("theories").map(({ name }) => name).sort((a, b) => SLOW.indexOf(a) - SLOW.indexOf(b));
    this.found = { theory: {}, theories: {}, cooling: { time: COOLING_TIMES, T: {} } };
  }
  /* Evaluate the next theory; is it the last? */
  goOn() {
    const comparison = new this.g.Comparison(this.scene, this.names.shift());
    try {
      const { theory, theories } = comparison.document();
      Object.assign(this.found.theory, theory);
      Object.assign(this.found.theories, theories);
      Object.assign(this.found.cooling.T, courseOfTheories(comparison).cooling.T);
    } finally {
      comparison.free();
    }
    return !this.names.length;
  }
  free() {
    this.scene.free();
  }
}

/* The means, in their own worker: a run of each engine in pieces, until the scene's own end. */
export class Measuring {
  constructor(g, text, sets) {
    this.sessions = {};
    this.refused = {};
    const scene = sceneOf(g, text, sets);
    let values;
    try {
      values = scene.values();
    } finally {
      scene.free();
    }
    const drawn = isWalled(values) ? ["profiles"] : ["velocity_distributions"],
      one = { measure: `[${[...new Set([...values.measure, ...drawn])]}]`, "run.replicas": 1 };
    try {
      this.compare(sceneOf(g, text, sets, one), g);
      for (const engine of ["md", "dsmc"]) this.begin(g, text, sets, engine, one);
    } catch (e) {
      this.free();
      throw e;
    }
  }
  compare(scene, g) {
    try {
      this.comparison = new g.Comparison(scene, QUICK);
    } finally {
      scene.free();
    }
  }

  begin(g, text, sets, engine, one) {
    let scene = null;
    try {
      scene = sceneOf(g, text, sets, { ...one, engine });
      this.sessions[engine] = { session: new g.Session(scene), over: false, why: null };
    } catch (e) {
      this.refused[engine] = e.message;
    } finally {
      if (scene) scene.free();
    }
  }

  /* Run each engine for so many milliseconds; is nothing left to do? */
  goOn(milliseconds) {
    for (const one of Object.values(this.sessions)) {
      if (one.over) continue;
      try {
        one.over = one.session.goOn(milliseconds);
      } catch (e) {
        one.over = true;
        one.why = e.message;
      }
    }
    return Object.values(this.sessions).every((one) => one.over);
  }

  /* All means so far. An engine without means yet is left out. */
  means() {
    const progress = {};
    for (const [engine, one] of Object.entries(this.sessions)) {
      progress[engine] = { ...one.session.progress(), over: one.over, why: one.why };
      try {
        this.comparison.take(one.session);
      } catch (e) {
        progress[engine].lack = e.message;
      }
    }
    return { ...this.comparison.document(), progress, refused: this.refused };
  }

  free() {
    for (const one of Object.values(this.sessions)) one.session.free();
    if (this.comparison) this.comparison.free();
  }
}

/* The answers of the theories for a scene. */
export function theoriesOf(g, text, sets) {
  const scene = sceneOf(g, text, sets);
  let comparison = null;
  try {
    comparison = new g.Comparison(scene);
    const { theory, theories } = comparison.document();
    return { theory, theories };
  } finally {
    scene.free();
    if (comparison) comparison.free();
  }
}
