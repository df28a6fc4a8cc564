/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Frames: in each, the gas advances as far as the wall clock requires. */
import { tickPlaying } from "./files.js";
import { recordTrail, now } from "./gas.js";
import { SHORTEST } from "./live.js";
import { clicks } from "./sound.js";
import { store } from "./state.js";
import { workers } from "./worker_rpc.js";

export const SPEEDS = [-3, -2, -1, 0, 1, 2].flatMap((k) => [+(10 ** k).toPrecision(1), +(3 * 10 ** k).toPrecision(1)]).concat(1000);
const LONGEST = 40; /* ms of work a frame, where frames come slowly */
const MOST_DUE = 1; /* seconds by which the gas may be behind; time above is dropped */
export const MOST_BEHIND = 0.7; /* dropped in successive frames; the page shows a warning above this */

let last = 0;
/* `draw()` the newest frame. */
export function runClock(draw) {
  const tick = (time) => {
    requestAnimationFrame(tick); /* first: if a frame fails, the next one is still drawn */
    const seconds = Math.min((time - (last || time)) / 1000, 0.25);
    last = time;
    const { gas, player } = store.state;
    if (now.fresh) {
      now.fresh = false;
      draw(time);
    }
    owe(gas ? seconds : 0);
    if (player) tickPlaying(seconds);
    else if (gas && !now.busy && (store.state.playing || now.want || now.step)) request();
  };
  requestAnimationFrame(tick);
}

function owe(seconds) {
  const { playing, player } = store.state;
  if (!playing || player) now.due = 0;
  else now.due += seconds;
  now.lost += Math.max(0, now.due - MOST_DUE);
  now.due = Math.min(now.due, MOST_DUE);
}

async function request() {
  const { gas, speed, colour, follow, chart, arrows, grain } = store.state,
    { step } = now,
    { live } = workers,
    seconds = step ? 0 : now.due;
  Object.assign(now, { busy: true, due: 0, want: false, step: false });
  try {
    const frame = await live.request("frame", { collisions: speed * seconds, work: Math.min(LONGEST, Math.max(SHORTEST, 500 * seconds)), colour, follow, step, arrows, grain, speeds: chart === "speeds" });
    if (gas === store.state.gas) take(frame, gas, seconds);
    else now.want = true; /* a start came between; if it is rejected, the previous gas is shown */
  } catch (e) {
    if (gas === store.state.gas && live === workers.live) {
      store.dispatch("banner", { banner: { text: e.message, offers: [] } });
      store.look({ playing: false });
    }
  }
  now.busy = false;
}

function take(frame, gas, seconds) {
  const before = now.frame,
    lost = now.lost + (frame.behind ? seconds : 0);
  now.behind = lost > 0 ? now.behind + lost : 0;
  Object.assign(now, { frame, fresh: true, frames: now.frames + 1, lost: 0 });
  recordTrail(frame, store.state.grain);
  gas.history.add(frame.md, frame.dsmc, frame.twin);
  if (frame.md) gas.history.addDistance(frame.md.collisionsPerGrain, frame.distance);
  if (store.state.sound && before && before.md && frame.md) clicks(before.md, frame.md, gas.about.fast, seconds);
}
