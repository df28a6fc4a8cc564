/* The gas that is seen, in a worker: md, and dsmc beside it, taken along by the clock of their own collisions. Nothing
 * here depends on how often the page asks. */

/* The scene's text with keys set over it. */
function sceneOf(g, text, sets, more = {}) {
  const scene = new g.Scene(text);
  try {
    for (const [key, value] of Object.entries({ ...sets, ...more })) scene.set(key, value);
    return scene.check();
  } catch (e) {
    scene.free();
    throw e;
  }
}

/* What is shown of a state. Between walls T is the one that results have: the state's is of whole velocities. */
const isWalled = ({ flow }) => /couette|poiseuille|chute/.test(flow);
function shownState(gas, state, values) {
  return isWalled(values) ? { ...state, temperature: gas.localTemperature(state.grains, state.box[1]) } : state;
}

class LiveGas {
  constructor(g, text, sets) {
    this.refusal = this.dsmcRefusal = this.event = this.ended = this.dsmcEnded = null;
    const scene = sceneOf(g, text, sets);
    try {
      this.about = { values: scene.values(), title: scene.title(), yaml: scene.yaml() };
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
    const grains = values.dsmc.particles === "auto" ? { "dsmc.particles": Math.max(4000, values.particles) } : {};
    this.dsmc = this.make(g, text, sets, { engine: "dsmc", ...grains }, "dsmcRefusal");
    if (!this.md && !this.dsmc) throw new GraingasError(this.refusal, 2);
    this.rate = this.firstRate(g, text, sets);
    if (!this.md) return;
    this.md.follow();
    this.view = new Picture(this.md.grains(), this.md.species(), this.about);
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

  /* Collisions a grain in the unit of time, of a gas like this one that is thrown away. */
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

  /* How often they collide now: over the last tenth of a collision a grain. */
  followRate(state) {
    const done = state.collisionsPerGrain - this.since.collisionsPerGrain;
    if (done < 0.1 && done * state.grains < 200) return;
    this.rate = done / (state.time - this.since.time);
    this.since = state;
  }

  /* Go on by so many collisions a grain, for 12 ms of work at most; is it done? */
  goOn(collisions) {
    const leader = this.md || this.dsmc;
    let done = true;
    try {
      if (!this.ended && collisions > 0) done = leader.advance(collisions / this.rate, 12);
    } catch (e) {
      this.ended = e.message;
    }
    const state = leader.state();
    this.followRate(state);
    return this.takeAlong(state.time) && done;
  }

  /* dsmc to the time of md, for 6 ms of work at most; is it there? */
  takeAlong(time) {
    if (!this.md || !this.dsmc || this.dsmcEnded || this.ended) return true;
    const lack = time - this.dsmc.state().time;
    try {
      return !(lack > 0) || this.dsmc.advance(lack, 6);
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
    this.goOn(0);
  }

  frame({ collisions, colour, step }) {
    const done = step ? (this.step(), true) : this.goOn(collisions);
    if (!step && collisions > 0) this.event = null;
    const short = (s) => s && shownState(s, s.state(), this.about.values);
    return {
      md: short(this.md),
      dsmc: short(this.dsmc),
      picture: this.md ? this.view.of(this.md.state(), this.md.grains(), colour, this.rate) : null,
      event: this.event,
      behind: !done,
      ended: this.ended,
      dsmcEnded: this.dsmcEnded,
    };
  }

  free() {
    for (const s of [this.md, this.dsmc]) if (s) s.free();
  }
}
