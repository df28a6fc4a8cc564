/* The gas that is seen, in a worker: md, and dsmc beside it, taken along by the clock of their own collisions. Nothing
 * here depends on how often the page asks. */
const COLOURS_END = { speed: 2.5, spin: 2.5, since: 3 };

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

/* Turn the marks, a unit vector a grain, about their spins for so long. */
function turnMarks(marks, spin, time) {
  for (let i = 0; i < marks.length; i += 3) {
    const w = Math.hypot(spin[i], spin[i + 1], spin[i + 2]);
    if (!(w > 0)) continue;
    const x = spin[i] / w,
      y = spin[i + 1] / w,
      z = spin[i + 2] / w,
      c = Math.cos(w * time),
      s = Math.sin(w * time);
    const a = marks[i],
      b = marks[i + 1],
      d = marks[i + 2],
      along = (x * a + y * b + z * d) * (1 - c);
    marks[i] = a * c + (y * d - z * b) * s + x * along;
    marks[i + 1] = b * c + (z * a - x * d) * s + y * along;
    marks[i + 2] = d * c + (x * b - y * a) * s + z * along;
  }
}

class LiveGas {
  constructor(g, text, sets) {
    this.refusal = this.dsmcRefusal = this.event = null;
    const scene = sceneOf(g, text, sets),
      values = scene.values();
    this.about = { values, title: scene.title(), yaml: scene.yaml() };
    scene.free();
    this.md = this.make(g, text, sets, { engine: "md" }, "refusal");
    const grains = values.dsmc.particles === "auto" ? { "dsmc.particles": Math.max(4000, values.particles) } : {};
    this.dsmc = this.make(g, text, sets, { engine: "dsmc", ...grains }, "dsmcRefusal");
    if (!this.md && !this.dsmc) throw new GraingasError(this.refusal, 2);
    this.ended = this.dsmcEnded = null;
    this.rate = this.firstRate(g, text, sets);
    if (this.md) this.prepareView();
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
    const trial = this.make(g, text, sets, { engine: this.md ? "md" : "dsmc" }, "trial");
    this.since = { time: 0, collisionsPerGrain: 0 };
    try {
      trial.collide(Math.max(2, Math.floor(trial.state().grains / 10)), 500);
      const state = trial.state();
      return state.collisionsPerGrain / state.time || 1;
    } finally {
      trial.free();
    }
  }

  prepareView() {
    const { n, species, velocity } = this.md.grains(),
      kinds = this.md.species();
    this.about.species = Uint8Array.from(species);
    this.about.diameters = kinds.map((k) => k.diameter);
    this.marks = new Float32Array(3 * n);
    for (let i = 0; i < n; i++) {
      /* evenly over the sphere */
      const z = 1 - 2 * ((i * 0.754877666) % 1),
        r = Math.sqrt(1 - z * z),
        a = 2 * Math.PI * ((i * 0.569840291) % 1);
      this.marks.set([r * Math.cos(a), r * Math.sin(a), z], 3 * i);
    }
    this.lastWay = Float64Array.from({ length: n }, (_, i) => this.way(velocity, i));
    this.lastHit = new Float64Array(n).fill(-Infinity);
  }

  /* What collisions alone change: of the velocity, a part that shear leaves as it is; where a thermostat rescales all,
   * its direction. */
  way(velocity, i) {
    const z = velocity[3 * i + 2];
    return this.about.values.thermostat === "none" ? z : velocity[3 * i + 1] / z;
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
    if (this.md && this.dsmc && !this.dsmcEnded && !this.ended) {
      const lack = state.time - this.dsmc.state().time;
      try {
        if (lack > 0) this.dsmc.advance(lack, 6);
      } catch (e) {
        this.dsmcEnded = e.message;
      }
    }
    return done;
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

  /* What is drawn: places, colours from 0 to 1, marks that turn. */
  picture(by) {
    const state = this.md.state(),
      { n, position, velocity, spin } = this.md.grains(),
      value = new Float32Array(n);
    const T = state.temperature,
      theta = state.rotationalTemperature,
      [kind] = this.md.species();
    const speed0 = COLOURS_END.speed * Math.sqrt(2 * T),
      spin0 = COLOURS_END.spin * Math.sqrt((3 * theta) / (kind.inertia / 4)) || 1;
    const since0 = COLOURS_END.since / this.rate;
    for (let i = 0; i < n; i++) {
      const way = this.way(velocity, i);
      if (Math.abs(way - this.lastWay[i]) > 1e-9 * Math.abs(way)) this.lastHit[i] = state.time;
      this.lastWay[i] = way;
      value[i] =
        by === "since"
          ? (state.time - this.lastHit[i]) / since0
          : by === "spin"
            ? Math.hypot(spin[3 * i], spin[3 * i + 1], spin[3 * i + 2]) / spin0
            : Math.hypot(velocity[3 * i], velocity[3 * i + 1], velocity[3 * i + 2]) / speed0;
    }
    if (theta > 0) turnMarks(this.marks, spin, state.time - (this.markTime || 0));
    this.markTime = state.time;
    return { position: Float32Array.from(position), value, marks: theta > 0 ? Float32Array.from(this.marks) : null };
  }

  frame({ collisions, colour, step }) {
    const done = step ? (this.step(), true) : this.goOn(collisions);
    if (!step && collisions > 0) this.event = null;
    const short = (s) => s && s.state();
    return {
      md: short(this.md),
      dsmc: short(this.dsmc),
      picture: this.md ? this.picture(colour) : null,
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
