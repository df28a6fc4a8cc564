/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Drawing data of grains, live or played: places, colours from 0 to 1, marks that rotate. */
export const COLOURS_END = { speed: 2, spin: 2, since: 3 }; /* root mean squares; mean free times */

const rootMeanSquare = (vectors) => Math.sqrt((3 * vectors.reduce((sum, v) => sum + v * v, 0)) / vectors.length);

/* Velocities along x, of a sheared gas with that of the flow; both ends of the scale are at twice the speed of most
 * grains. */
const alongX = ({ position, velocity }, flow, box) => Float32Array.from({ length: velocity.length / 3 }, (_, i) => velocity[3 * i] + flow * (position[3 * i + 1] - box[1] / 2));
const endAlong = (all) => 2.2 * Math.sqrt(all.reduce((sum, v) => sum + v * v, 0) / all.length) || 1;

/* Lengths of vectors over the end of the scale. */
function lengths(vectors, end) {
  const found = new Float32Array(vectors.length / 3);
  for (let i = 0; i < found.length; i++)
    found[i] = Math.hypot(vectors[3 * i], vectors[3 * i + 1], vectors[3 * i + 2]) / end;
  return found;
}

/* Rotate the marks, a unit vector a grain, about their spins for this time. */
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

export class Picture {
  /* Adds to `about` the data of the grains that stay the same. */
  constructor({ n, species }, kinds, about) {
    about.species = Uint8Array.from(species);
    about.diameters = kinds.map((k) => k.diameter);
    this.marks = new Float32Array(3 * n);
    this.time = 0;
    for (let i = 0; i < n; i++) {
      /* evenly over the sphere */
      const z = 1 - 2 * ((i * 0.754877666) % 1),
        r = Math.sqrt(1 - z * z),
        a = 2 * Math.PI * ((i * 0.569840291) % 1);
      this.marks.set([r * Math.cos(a), r * Math.sin(a), z], 3 * i);
    }
  }

  /* Fix the scale of colours by this state. Spins that are still zero are scaled by equipartition. */
  fix(state, grains, kinds, flow) {
    const { velocity, spin, position } = grains,
      inertia = (kinds[0].inertia * kinds[0].mass * kinds[0].diameter ** 2) / 4,
      fast = rootMeanSquare(velocity) || 1;
    this.scale = { along: endAlong(alongX(grains, flow, state.box)), speed: fast, spin: rootMeanSquare(spin) || Math.sqrt((3 * state.temperature) / inertia) || 1 };
    this.fastest = 2 * Math.max(fast, this.scale.along / 2.2);
    this.origin = Float32Array.from({ length: position.length / 3 }, (_, i) => position[3 * i] / state.box[0]);
  }

  /* `by` selects the colour: speed, spin; since, the time since the last collision in mean free times (`rate`
   * collisions a time); along, the velocity along x from left to right, of a sheared gas with that of the flow;
   * origin, the initial position.
   * `follow`: speeds and spins are scaled by the present ones, not by those of the start. `arrows`: with all
   * velocities, of a sheared gas with that of the flow; `grain`: with the velocity and the spin of that one. */
  of(state, grains, { by, rate = 0, follow = false, flow = 0, arrows = false, grain = null }) {
    const { position, velocity, spin, hit } = grains,
      turning = state.rotationalTemperature > 0,
      end = (vectors, name) => COLOURS_END[name] * (follow || !this.scale ? rootMeanSquare(vectors) || 1 : this.scale[name]);
    if (turning) turnMarks(this.marks, spin, state.time - this.time);
    this.time = state.time;
    const along = by === "along" || arrows || grain !== null ? alongX(grains, flow, state.box) : null,
      moving = (i) => (i % 3 ? velocity[i] : along[i / 3]),
      three = (i, of) => [3 * i, 3 * i + 1, 3 * i + 2].map(of);
    const values = {
      since: () => hit && Float32Array.from(hit, (time) => ((state.time - time) * rate) / COLOURS_END.since),
      spin: () => lengths(spin, end(spin, "spin")),
      origin: () => this.origin,
      along: () => {
        const most = follow || !this.scale ? endAlong(along) : this.scale.along;
        return along.map((v) => 0.5 + v / (2 * most));
      },
    };
    return {
      position: Float32Array.from(position),
      value: Float32Array.from((values[by] && values[by]()) || lengths(velocity, end(velocity, "speed"))),
      marks: turning ? Float32Array.from(this.marks) : null,
      velocity: arrows ? Float32Array.from(velocity, (_, i) => moving(i)) : null,
      one:
        grain === null || !(3 * grain < position.length)
          ? null
          : { position: three(grain, (i) => position[i]), velocity: three(grain, moving), spin: turning ? three(grain, (i) => spin[i]) : null },
    };
  }
}
