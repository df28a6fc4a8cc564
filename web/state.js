/* SPDX-License-Identifier: GPL-3.0-or-later */
/* The state of the page: one object, with one writer. A change is a dispatched action; parts that show the state
 * subscribe. Data of every frame (grains, clock) are not in it. */

export const initial = {
  language: "en",
  view: "all" /* "box", "curve": for pages that embed it; "present": for a projector */,
  lesson: null /* its name; null: a user's own scene */,
  requested: { id: 0, scene: "", sets: {} } /* the wanted gas: in force or pending */,
  gas: null /* the gas that runs: {id, scene, sets, lesson, about, refusal, dsmcRefusal, history} */,
  means: null,
  shelf: null /* the live gas while a result is played */,
  player: null /* the result that is played: {name, frames, rate} */,
  playing: true,
  speed: 1,
  colour: "speed",
  follow: false,
  images: true,
  sound: false,
  camera: [0.45, 0.22, 1],
  arrows: false,
  grain: null /* the number of the followed grain */,
  question: "" /* a teacher's own question, of a link or of this page */,
  pair: "",
  chart: "temperature",
  quantity: "temperature",
  slider: "e",
  theories: null /* the drawn theories; null: the first few */,
  everything: false,
  banner: null /* {text, offers: [{label, act}]} */,
  refusedKeys: [],
  ghosts: [] /* curves of earlier runs: {label, chart, x, y} */,
  points: [],
  lines: {} /* lines of theories over the slider: {key: {x, theory: [per x]}} */,
};

/* Members that belong to the displayed gas, and are restored after a result was played. */
const SHELVED = ["gas", "means", "lesson", "playing", "theories", "chart", "quantity", "pair"];
const pick = (from, names) => Object.fromEntries(names.map((name) => [name, from[name]]));

const ACTIONS = {
  /* Change how the gas is shown. */
  look: (state, { change }) => ({ ...state, ...change }),

  /* A gas is requested; an edit is the same, a little earlier. */
  request: (state, { requested }) => ({ ...state, requested: { ...state.requested, ...requested } }),
  /* A gas has started. Answers may come late: a request made meanwhile stays pending. A new flow has other theories. */
  started: (state, { gas, change }) => ({
    ...state,
    ...change,
    ...(state.shelf ? { shelf: null, player: null, playing: state.shelf.playing } : {}),
    gas,
    requested: state.requested.id > gas.id ? state.requested : { id: gas.id, scene: gas.scene, sets: gas.sets },
    means: null,
    refusedKeys: [],
    theories: state.gas && state.gas.about.values.flow !== gas.about.values.flow ? null : state.theories,
  }),
  /* A request was rejected: the present gas continues. */
  refused: (state, { text, keys = [], offers = [] }) => ({
    ...state,
    requested: state.gas ? { id: state.requested.id, scene: state.gas.scene, sets: state.gas.sets } : state.requested,
    refusedKeys: keys,
    banner: { text, offers },
  }),
  banner: (state, { banner }) => ({ ...state, banner }),

  /* Means of the displayed gas, or of the live gas while a result is played. */
  means: (state, { id, means }) =>
    state.gas && state.gas.id === id
      ? { ...state, means }
      : state.shelf && state.shelf.gas.id === id
        ? { ...state, shelf: { ...state.shelf, means } }
        : state,

  /* A result is played; the live gas is paused. */
  play: (state, { player, gas, change }) => ({
    ...state,
    ...change,
    shelf: state.shelf || pick(state, SHELVED),
    player,
    gas,
    requested: { id: gas.id, scene: gas.scene, sets: {} },
    means: null,
    lesson: null,
    theories: null,
    banner: null,
  }),
  back: (state, { id }) => {
    const { gas } = state.shelf;
    return { ...state, ...state.shelf, shelf: null, player: null, requested: { id, scene: gas.scene, sets: gas.sets } };
  },

  ghost: (state, { ghost }) => ({ ...state, ghosts: [ghost, ...state.ghosts.filter((one) => one.label !== ghost.label)].slice(0, 3) }),
  point: (state, { points }) => ({ ...state, points: [...state.points, ...points] }),
  /* Add points of others; they replace earlier points of the same student. */
  gather: (state, { points }) => {
    const whose = (one) => `${one.from} ${one.slider} ${one.quantity || ""}`,
      given = new Set(points.map(whose));
    return { ...state, points: [...state.points.filter((one) => !one.from || !given.has(whose(one))), ...points] };
  },
  forgetStudent: (state, { from }) => ({ ...state, points: state.points.filter((one) => one.from !== from) }),
  forget: (state) => ({ ...state, points: [], ghosts: [] }),
  line: (state, { key, line }) => ({ ...state, lines: { ...state.lines, [key]: line } }),
};

export function reduce(state, action) {
  return ACTIONS[action.type](state, action);
}

export class Store {
  constructor(state = initial) {
    this.state = state;
    this.listeners = [];
    this.shown = state;
  }
  /* Listeners are called synchronously and never re-entrantly. */
  dispatch(type, more = {}) {
    this.state = reduce(this.state, { type, ...more });
    if (this.telling) return;
    this.telling = true;
    try {
      for (let round = 0; this.shown !== this.state && round < 20; round++) {
        const before = this.shown;
        this.shown = this.state;
        for (const listener of this.listeners) listener(this.shown, before);
      }
    } finally {
      this.telling = false;
    }
  }
  look(change) {
    this.dispatch("look", { change });
  }
  subscribe(listener) {
    this.listeners.push(listener);
  }
}

export const store = new Store();
