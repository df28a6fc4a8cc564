/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The engines as a page sees them: objects with methods, around the exports of exports_*.c. Runs in a worker, a
 * window and node. `make` is the function that the module engines.js was built as (graingas). */

const STATE = [
  "time",
  "collisions",
  "collisionsPerGrain",
  "grains",
  "temperature",
  "rotationalTemperature",
  "strain",
  "imageOffset",
];
const SPECIES = ["grains", "diameter", "mass", "inertia", "temperature", "rotationalTemperature"];
const PROGRESS = ["fraction", "averaging", "collisions", "relativeError", "secondsLeft"];
const ENTRY = ["name", "doc", "unit", "type", "allowed", "value"];
const CATALOGUES = ["keys", "speciesKeys", "flows", "engines", "observables", "quantities", "theories"];

/* An error of the library with its message; status as in graingas.h. */
export class GraingasError extends Error {
  constructor(message, status) {
    super(message);
    this.name = "GraingasError";
    this.status = status;
  }
}

/* Reject NUL: in C it would end the text, and the rest would be dropped silently. The message is that of the
 * library's reader of YAML. */
function refuseNul(text) {
  const at = text.indexOf("\0");
  if (at < 0) return;
  const bytes = new TextEncoder().encode(text.slice(0, at)).length;
  throw new GraingasError(`no YAML text (control characters are not allowed at byte ${bytes})`, 2);
}

export async function openEngines(make, options) {
  const c = await make(options);
  const fail = () => {
    throw new GraingasError(c.UTF8ToString(c._page_error()), c._page_status());
  };
  const need = (answer) => answer || fail();
  const doubles = (at, n) => c.HEAPF64.subarray(at >> 3, (at >> 3) + n);
  const numbers = (at, n) => Array.from(doubles(need(at), n));
  const named = (names, values) => Object.fromEntries(names.map((name, i) => [name, values[i]]));
  const take = (at) => {
    const text = c.UTF8ToString(need(at));
    c._free(at);
    return text;
  };
  const withText = (texts, call) => {
    texts.forEach(refuseNul);
    const at = texts.map((text) => {
      const size = c.lengthBytesUTF8(text) + 1,
        block = need(c._malloc(size));
      c.stringToUTF8(text, block, size);
      return block;
    });
    try {
      return call(...at);
    } finally {
      at.forEach((block) => c._free(block));
    }
  };
  const matrix = (v) => [v.slice(0, 3), v.slice(3, 6), v.slice(6, 9)];
  const outcome = (code) => need(code) === 1;
  const withPath = (path, call) => need(withText([path], call));
  /* Views of the module's memory, valid until the next call of anything here: copy data that must stay. */
  const viewsOf = (at, n) => {
    const array = (which, per) => {
      const from = c._page_array(at, which);
      return from ? doubles(from, per * n) : null;
    };
    const species = c._page_array(at, 3) >> 2;
    return {
      n,
      position: array(0, 3),
      velocity: array(1, 3),
      spin: array(2, 3),
      species: c.HEAP32.subarray(species, species + n),
      hit: array(4, 1),
    };
  };
  const localTemperature = (at, n, height) => {
    const [position, velocity, , species, , mass] = [0, 1, 2, 3, 4, 5].map((which) => c._page_array(at, which));
    return position ? c._page_local_temperature(n, position, velocity, species, mass, height) : NaN;
  };
  const stateAt = (at) => {
    const v = numbers(at, 20);
    return { ...named(STATE, v), box: v.slice(8, 11), kineticStress: matrix(v.slice(11)) };
  };
  const allSpecies = (request) => {
    const found = [];
    for (let i = 0, at; (at = request(i)); i++) found.push(named(SPECIES, numbers(at, 6)));
    return found;
  };

  class Scene {
    constructor(yaml) {
      this.at = need(withText([yaml], (text) => c._page_scene(text)));
    }
    set(key, value) {
      need(withText([key, String(value)], (k, v) => c._page_scene_set(this.at, k, v)));
      return this;
    }
    check() {
      need(c._page_scene_check(this.at));
      return this;
    }
    yaml() {
      return take(c._page_scene_yaml(this.at));
    }
    values() {
      return JSON.parse(take(c._page_scene_json(this.at)));
    }
    title() {
      return take(c._page_scene_title(this.at));
    }
    /* Bytes and seconds of a processor for a run by "md" or "dsmc". */
    needs(engine) {
      const [bytes, seconds] = numbers(withText([engine], (e) => c._page_scene_needs(this.at, e)), 2);
      return { bytes, seconds };
    }
    warnings(use) {
      return take(withText([use], (u) => c._page_scene_warnings(this.at, u)))
        .split("\n")
        .filter(Boolean);
    }
    free() {
      c._gg_scene_free(this.at);
      this.at = 0;
    }
  }

  /* A gas step by step. advance and collide work for at most so many milliseconds and return whether they are done. */
  class Simulation {
    constructor(scene, stream = 0) {
      this.at = need(c._page_simulation_new(scene.at, stream));
    }
    advance(time, milliseconds = Infinity) {
      return outcome(c._page_advance(this.at, time, milliseconds));
    }
    collide(collisions, milliseconds = Infinity) {
      return outcome(c._page_collide(this.at, collisions, milliseconds));
    }
    step() {
      const v = numbers(c._page_step(this.at), 15);
      return {
        grain: v.slice(0, 2),
        species: v.slice(2, 4),
        k: v.slice(4, 7),
        velocity: v.slice(7, 10),
        normalSpeed: v[10],
        impulse: v.slice(11, 14),
        time: v[14],
      };
    }
    state() {
      return stateAt(c._page_state(this.at));
    }
    /* From now on grains() has the time of each grain's last collision. For md only. */
    follow() {
      need(c._page_follow(this.at));
    }
    sums() {
      const v = numbers(c._page_sums(this.at), 13);
      return {
        time: v[0],
        collisions: v[1],
        wallCollisions: v[2],
        dissipation: v[3],
        collisionalStress: matrix(v.slice(4)),
      };
    }
    grains() {
      need(c._page_take_grains(this.at));
      return viewsOf(this.at, doubles(need(c._page_state(this.at)), 4)[3]);
    }
    /* Between walls, with n grains and this height: T about the mean velocity at each place, as results have it. */
    localTemperature(grains, height) {
      need(c._page_take_grains(this.at));
      return localTemperature(this.at, grains, height);
    }
    species() {
      return allSpecies((i) => c._page_species_state(this.at, i));
    }
    reverse() {
      need(c._page_reverse(this.at));
    }
    /* Put the grains back; `change`: displace one of them by the last bit of its position. */
    nudge(change) {
      need(c._page_nudge(this.at, change));
    }
    remember() {
      need(c._page_remember(this.at));
    }
    /* Distance of the grains from their remembered positions, or from those of another simulation. */
    distance(other = null) {
      return c._page_distance(this.at, other ? other.at : 0);
    }
    /* The density of speeds of the grains taken last, in bins up to `end`. */
    speeds(bins, end) {
      return numbers(c._page_speeds(this.at, bins, end), bins);
    }
    hash() {
      return c.UTF8ToString(need(c._page_hash(this.at)));
    }
    free() {
      c._page_simulation_free(this.at);
      this.at = 0;
    }
  }

  /* The frames of a result file. */
  class Trajectory {
    constructor(path) {
      this.at = withPath(path, (at) => c._page_trajectory_new(at));
      this.frames = c._page_trajectory_frames(this.at);
    }
    scene() {
      return new Scene(take(c._page_scene_yaml(c._page_trajectory_scene(this.at))));
    }
    /* The k-th frame, from 0: its state and grains. */
    frame(k) {
      const state = stateAt(c._page_trajectory_frame(this.at, k));
      return { state, grains: viewsOf(this.at, state.grains) };
    }
    /* The same for the frame that was requested last. */
    localTemperature(grains, height) {
      return localTemperature(this.at, grains, height);
    }
    species() {
      return allSpecies((i) => c._page_trajectory_species(this.at, i));
    }
    free() {
      c._page_trajectory_free(this.at);
      this.at = 0;
    }
  }

  /* A run in pieces: means with errors, so far. */
  class Session {
    constructor(scene) {
      this.at = need(c._page_session(scene.at));
    }
    goOn(milliseconds) {
      return outcome(c._page_session_go_on(this.at, milliseconds));
    }
    progress() {
      return named(PROGRESS, numbers(c._page_session_progress(this.at), 5));
    }
    result() {
      return JSON.parse(take(c._page_session_json(this.at)));
    }
    free() {
      c._page_session_free(this.at);
      this.at = 0;
    }
  }

  /* The theories, or the one of that name, beside the results of sessions of the same scene; or a result file, by its
   * path. */
  class Comparison {
    constructor(scene, theory = "") {
      this.at = typeof scene === "string" ? withPath(scene, (at) => c._page_comparison_read(at)) : withPath(theory, (at) => c._page_comparison(scene.at, at));
    }
    take(session) {
      need(c._page_comparison_take(this.at, session.at));
      return this;
    }
    document() {
      return JSON.parse(take(c._page_comparison_json(this.at)));
    }
    /* T after these times of a gas that cools freely; NaN where the theory gives no answer. */
    cooling(theory, times) {
      return withText([theory], (at) => times.map((time) => c._page_cooling(this.at, at, time)));
    }
    /* The history of a quantity of "md" or "dsmc"; null: not recorded. */
    history(engine, quantity) {
      const at = withText([engine, quantity], (e, q) => c._page_history(this.at, e, q));
      if (!at) return null;
      const [n] = doubles(at, 1),
        all = Array.from(doubles(at, 2 * n + 1));
      c._free(at);
      return { time: all.slice(1, n + 1), value: all.slice(n + 1) };
    }
    free() {
      c._page_comparison_free(this.at);
      this.at = 0;
    }
  }

  function catalogue(list, scene = null) {
    const found = [];
    for (let i = 0, at; (at = c._page_entry(CATALOGUES.indexOf(list), i, scene ? scene.at : 0)); i++)
      found.push(named(ENTRY, take(at).split("\n")));
    return found;
  }

  /* A file, or {name, bytes}, is read under its base name. A worker reads it without a copy. */
  let folders = 0;
  function withFile(file, call) {
    const folder = `/file${++folders}`,
      inPlace = typeof Blob !== "undefined" && file instanceof Blob,
      gone = () => {
        c.FS.chdir("/");
        if (inPlace) c.FS.unmount(folder);
        else c.FS.unlink(`${folder}/${file.name}`);
        c.FS.rmdir(folder);
      };
    c.FS.mkdir(folder);
    if (inPlace) c.FS.mount(c.WORKERFS, { files: [file] }, folder);
    else c.FS.writeFile(`${folder}/${file.name}`, file.bytes);
    c.FS.chdir(folder);
    try {
      return { answer: call(file.name), gone };
    } catch (e) {
      gone();
      throw e;
    }
  }

  return {
    Scene,
    Simulation,
    Trajectory,
    withFile,
    Session,
    Comparison,
    catalogue,
    memory: () => c.HEAPU8.length,
    version: c.UTF8ToString(c._gg_version()),
    run: (scene) => JSON.parse(take(c._page_run_json(scene.at))),
  };
}
