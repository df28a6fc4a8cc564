/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The live gas, in a worker: md, and beside it dsmc or a twin of md that differs in one thing. Results do not depend
 * on how often the page requests frames. */
import { GraingasError } from "./engines.js";
import { isWalled, sheared } from "./flows.js";
import { Picture } from "./picture.js";

/* The scene's text with keys set over it. */
export function sceneOf(g, text, sets, more = {}) {
  const scene = new g.Scene(text);
  try {
    for (const [key, value] of Object.entries({ ...sets, ...more })) scene.set(key, value);
    return scene.check();
  } catch (e) {
    scene.free();
    throw e;
  }
}

/* Members that differ from the defaults, of objects of values. */
function differing(values, defaults) {
  const found = {};
  for (const [key, value] of Object.entries(values)) {
    if (JSON.stringify(value) === JSON.stringify(defaults[key])) continue;
    const inner = value && typeof value === "object" && !Array.isArray(value);
    found[key] = inner ? differing(value, defaults[key]) : value;
  }
  return found;
}
/* A value as YAML on one line. */
const flowStyle = (value) =>
  Array.isArray(value)
    ? `[${value.map(flowStyle).join(", ")}]`
    : value && typeof value === "object"
      ? `{${Object.entries(value)
          .map(([key, one]) => `${key}: ${flowStyle(one)}`)
          .join(", ")}}`
      : String(value);

/* The shortest scene with the same values; the whole scene where that fails. */
function briefScene(g, values, yaml) {
  const read = (text, use) => {
    const scene = new g.Scene(text);
    try {
      return use(scene);
    } finally {
      scene.free();
    }
  };
  const { flow, phi } = values;
  for (const given of [{ flow, phi }, { flow, phi, thermostat: values.thermostat }])
    try {
      const defaults = read(flowStyle(given), (scene) => scene.values()),
        brief = flowStyle({ ...given, ...differing(values, defaults) });
      if (read(brief, (scene) => scene.yaml()) === yaml) return brief;
    } catch (e) {
      /* a flow that needs more than these keys */
    }
  return yaml;
}

/* Description of a scene for the page. */
export function aboutOf(g, scene) {
  const values = scene.values(),
    yaml = scene.yaml();
  return { values, yaml, title: scene.title(), brief: briefScene(g, values, yaml) };
}

/* Number of grains, and memory of a run with them: checked before a gas is made. */
export function costOf(g, text, sets) {
  const scene = sceneOf(g, text, sets);
  try {
    const { particles } = scene.values();
    let bytes = 0;
    for (const engine of ["md", "dsmc"])
      try {
        bytes = Math.max(bytes, scene.needs(engine).bytes);
      } catch (e) {
        /* an engine that cannot run the scene needs nothing */
      }
    return { particles, bytes };
  } finally {
    scene.free();
  }
}

/* The displayed state. Between walls T is that of results: the temperature of the engine's state is of whole
 * velocities. */
export function shownState(gas, state, values) {
  const temperature = isWalled(values) ? gas.localTemperature(state.grains, state.box[1]) : NaN; /* NaN in dsmc without positions */
  return Number.isFinite(temperature) ? { ...state, temperature } : state;
}
/* The shear rate of the flow about which velocities are given. */
export const flowOf = (values) => (sheared(values) ? 1 : 0);

const BINS = 30;
export const SHORTEST = 12; /* ms of work a frame: at sixty frames a second the page has time left */

export class LiveGas {
  /* pair: null; "elastic", the same start with e = 1; "bit", the same with one last bit more. remember: distances
   * from the start are wanted. */
  constructor(g, text, sets, { pair = null, remember = false } = {}) {
    Object.assign(this, { pair, remember, refusal: null, dsmcRefusal: null, event: null, ended: null, dsmcEnded: null });
    const scene = sceneOf(g, text, sets);
    try {
      this.about = aboutOf(g, scene);
    } finally {
      scene.free();
    }
    try {
      this.begin(g, text, sets, this.about.values);
    } catch (e) {
      this.free();
      throw e;
    }
  }

  begin(g, text, sets, values) {
    this.md = this.make(g, text, sets, { engine: "md" }, "refusal");
    if (this.pair && this.md) this.beginTwin(g, text, sets);
    const grains = values.dsmc.particles === "auto" ? { "dsmc.particles": Math.max(4000, values.particles) } : {};
    if (!this.twin) this.dsmc = this.make(g, text, sets, { engine: "dsmc", ...grains }, "dsmcRefusal");
    if (!this.md && !this.dsmc) throw new GraingasError(this.refusal, 2);
    this.rate = this.startRate = this.firstRate(g, text, sets);
    if (!this.md) return;
    if (this.remember) this.md.remember();
    this.md.follow();
    this.view = this.viewOf(this.md, this.about);
    this.about.fast = this.view.scale.speed;
    this.about.fastest = this.view.fastest;
    if (this.twin) this.twinView = this.viewOf(this.twin, {});
  }
  viewOf(gas, about) {
    const view = new Picture(gas.grains(), gas.species(), about);
    view.fix(gas.state(), gas.grains(), gas.species(), flowOf(this.about.values));
    return view;
  }
  /* Put the grains back into both simulations: then both have the same rounding. */
  beginTwin(g, text, sets) {
    const elastic = this.pair === "elastic" ? { "collision.e": "1" } : {};
    this.twin = this.make(g, text, sets, { engine: "md", ...elastic }, "twinRefusal");
    if (!this.twin || this.pair !== "bit") return;
    this.md.nudge(false);
    this.twin.nudge(true);
  }

  make(g, text, sets, more, why) {
    let scene = null;
    try {
      scene = sceneOf(g, text, sets, more);
      return new g.Simulation(scene);
    } catch (e) {
      this[why] = e.message;
      return null;
    } finally {
      if (scene) scene.free();
    }
  }

  /* Collisions a grain in the unit of time, of a gas like this one that is discarded. */
  firstRate(g, text, sets) {
    this.since = { time: 0, collisionsPerGrain: 0 };
    const trial = this.make(g, text, sets, { engine: this.md ? "md" : "dsmc" }, "trial");
    if (!trial) throw new GraingasError(this.trial, 1);
    try {
      trial.collide(Math.max(2, Math.floor(trial.state().grains / 10)), 500);
      const state = trial.state();
      return state.collisionsPerGrain / state.time || 1;
    } finally {
      trial.free();
    }
  }

  /* The present collision rate: over the last tenth of a collision a grain. */
  followRate(state) {
    const done = state.collisionsPerGrain - this.since.collisionsPerGrain;
    if (done < 0.1 && done * state.grains < 200) return;
    this.rate = done / (state.time - this.since.time);
    this.since = state;
  }

  /* Advance by this time, for so many ms of work at most; is it done? */
  goOn(time, work) {
    const leader = this.md || this.dsmc;
    let done = true;
    try {
      if (!this.ended && time > 0) done = leader.advance(time, work);
    } catch (e) {
      this.ended = e.message;
    }
    const state = leader.state();
    this.followRate(state);
    return this.takeAlong(state.time, work) && done;
  }

  /* Advance dsmc, or the twin, to the time of md; has it arrived? */
  takeAlong(time, work) {
    const other = this.twin || this.dsmc;
    if (!this.md || !other || this.dsmcEnded || this.ended) return true;
    const lack = time - other.state().time;
    try {
      return !(lack > 0) || other.advance(lack, this.twin ? work : work / 2);
    } catch (e) {
      this.dsmcEnded = e.message;
      return true;
    }
  }

  step() {
    this.event = null;
    if (!this.md || this.ended) return;
    try {
      this.event = this.md.step();
    } catch (e) {
      this.ended = e.message;
    }
    this.goOn(0, SHORTEST);
  }
  reverse() {
    for (const gas of [this.md, this.twin]) if (gas) gas.reverse();
  }

  distance() {
    if (!this.md || !(this.twin ? this.pair === "bit" : this.remember)) return NaN;
    if (this.twin && this.twin.state().time < this.md.state().time * (1 - 1e-12)) return NaN;
    return this.md.distance(this.twin || null);
  }

  /* `collisions` a grain at the start's rate, or, with `follow`, at the present one. */
  frame({ collisions, work = SHORTEST, colour, step, follow = false, speeds = false, arrows = false, grain = null }) {
    const rate = follow ? this.rate : this.startRate,
      done = step ? (this.step(), true) : this.goOn(collisions / rate, work);
    if (!step && collisions > 0) this.event = null;
    const { values } = this.about,
      short = (s) => s && shownState(s, s.state(), values),
      look = { by: colour, rate: this.rate, follow, flow: flowOf(values), arrows, grain };
    const answer = {
      md: short(this.md),
      dsmc: short(this.dsmc),
      twin: short(this.twin),
      picture: this.md ? this.view.of(this.md.state(), this.md.grains(), look) : null,
      twinPicture: this.twin ? this.twinView.of(this.twin.state(), this.twin.grains(), { ...look, by: colour === "since" ? "speed" : colour }) : null,
      distance: this.distance(),
      rate: this.rate,
      timeScale: 1 / rate,
      event: this.event,
      behind: !done,
      ended: this.ended,
      dsmcEnded: this.dsmcEnded,
    };
    if (speeds && this.md) {
      const end = 2.5 * this.view.scale.speed;
      this.md.grains();
      answer.speeds = { end, density: this.md.speeds(BINS, end) };
    }
    return answer;
  }

  free() {
    for (const s of [this.md, this.dsmc, this.twin]) if (s) s.free();
  }
}
