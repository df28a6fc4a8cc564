/* What is drawn of grains, whether they live or are played: places, colours from 0 to 1, marks that turn. */
const COLOURS_END = { speed: 2, spin: 2, since: 3 }; /* root mean squares; mean free times */

/* Lengths of vectors over so many times their root mean square. */
function lengths(vectors, end) {
  const found = new Float32Array(vectors.length / 3);
  let sum = 0;
  for (let i = 0; i < found.length; i++) {
    found[i] = Math.hypot(vectors[3 * i], vectors[3 * i + 1], vectors[3 * i + 2]);
    sum += found[i] * found[i];
  }
  const most = end * Math.sqrt(sum / found.length) || 1;
  return found.map((one) => one / most);
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

class Picture {
  /* Adds to `about` what of the grains stays as it is. */
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

  /* `by`: speed, spin, or since, the time since the last collision in mean free times, of so many collisions a time. */
  of(state, { position, velocity, spin, hit }, by, rate) {
    const turning = state.rotationalTemperature > 0;
    if (turning) turnMarks(this.marks, spin, state.time - this.time);
    this.time = state.time;
    return {
      position: Float32Array.from(position),
      value:
        by === "since" && hit
          ? Float32Array.from(hit, (time) => ((state.time - time) * rate) / COLOURS_END.since)
          : by === "spin"
            ? lengths(spin, COLOURS_END.spin)
            : lengths(velocity, COLOURS_END.speed),
      marks: turning ? Float32Array.from(this.marks) : null,
    };
  }
}
