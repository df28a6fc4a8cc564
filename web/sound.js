/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Haff's law as sound: a click for each collision, or for a fixed fraction of them; the faster the grains, the
 * higher its pitch. No library. */
let audio = null,
  share = null;
const MOST_CLICKS = 40; /* a second */

/* Open the sound: browsers allow it after a click of the user alone. */
export function openSound() {
  audio = audio || new AudioContext();
  audio.resume();
  share = null;
}

function click(at, pitch) {
  const tone = audio.createOscillator(),
    level = audio.createGain();
  tone.type = "triangle";
  tone.frequency.value = pitch;
  level.gain.setValueAtTime(0.08, at);
  level.gain.exponentialRampToValueAtTime(0.0005, at + 0.05);
  tone.connect(level).connect(audio.destination);
  tone.start(at);
  tone.stop(at + 0.06);
}

/* Clicks for a constant fraction of the collisions between two frames, so that a gas that cools falls silent. */
export function clicks(before, after, fast, seconds) {
  const many = after.collisions - before.collisions;
  if (!audio || !(many > 0) || !(seconds > 0)) return;
  if (share === null) share = Math.min(1, (MOST_CLICKS * seconds) / many);
  const pitch = 660 * (Math.sqrt(3 * after.temperature) / (fast || 1)) ** 0.7;
  let heard = many * share;
  heard = Math.floor(heard) + (Math.random() < heard % 1 ? 1 : 0);
  for (let k = 0; k < Math.min(heard, 8); k++) click(audio.currentTime + Math.random() * seconds, Math.min(4000, Math.max(50, pitch)));
}
