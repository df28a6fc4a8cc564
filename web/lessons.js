/* SPDX-License-Identifier: GPL-3.0-or-later */
/* Lessons: a scene, the slider of its question, the curve of its answer. Their words are the strings lesson_NAME,
 * lesson_NAME_short, lesson_NAME_text and lesson_NAME_question of every language.
 *   slider     the row of CONTROLS;  chart      which diagram;  quantity   of the points that are kept; null: none
 *   speed      collisions a grain in a second at the start;  colour, camera, pair, remember (distances from the
 *   start)
 *   follow     clock and colours are scaled by the present state: for lessons about a slow and cold gas */
const lesson = (name, scene, more) => ({
  name,
  scene,
  colour: "speed",
  speed: 1,
  camera: [0.45, 0.22, 1],
  pair: "",
  quantity: null,
  remember: false,
  follow: false,
  ...more,
});

export const LESSONS = [
  lesson("temperature", "{flow: hcs, phi: 0.05, particles: 1000, collision: {e: 1}}", { slider: "e", chart: "speeds" }),
  lesson("haff", "{flow: hcs, phi: 0.1, particles: 1000, collision: {e: 0.9}}", {
    slider: "e",
    chart: "temperature",
    quantity: "cooling_rate",
    speed: 3,
  }),
  lesson("equipartition", "{flow: usf, phi: 0.1, particles: 1000, collision: {e: 0.9, beta: 0}}", {
    slider: "beta",
    chart: "temperature",
    quantity: "temperature_ratio",
    colour: "spin",
  }),
  lesson("normal_stress", "{flow: usf, phi: 0.02, particles: 1000, collision: {e: 0.7}}", {
    slider: "phi",
    chart: "stress",
    quantity: "N1",
    colour: "along",
  }),
  lesson("friction", "{flow: usf, phi: 0.2, particles: 1000, collision: {e: 0.9, beta: 1, mu: 0.2}}", {
    slider: "mu",
    chart: "temperature",
    quantity: "temperature",
    colour: "spin",
  }),
  lesson("enskog", "{flow: usf, phi: 0.3, particles: 1000, collision: {e: 0.7}}", {
    slider: "phi",
    chart: "stress",
    quantity: "N1",
    colour: "since",
    speed: 3,
  }),
  lesson("sure", "{flow: usf, phi: 0.01, particles: 1000, collision: {e: 0.9}}", {
    slider: "particles",
    chart: "errors",
    quantity: "temperature",
    colour: "along",
    speed: 3,
  }),
  lesson("clustering", "{flow: hcs, phi: 0.2, particles: 2000, collision: {e: 0.6}, aspect: [3, 3, 1]}", {
    slider: "e",
    chart: "temperature",
    colour: "along",
    camera: [0, 0, 1.15],
    speed: 10,
    follow: true,
  }),
  lesson("walls", "{flow: couette, phi: 0.1, particles: 1000, collision: {e: 0.9}}", {
    slider: "e",
    chart: "profiles",
    quantity: "temperature",
    colour: "along",
    camera: [0.2, 0.1, 1],
    speed: 10,
  }),
  lesson("chaos", "{flow: hcs, phi: 0.1, particles: 200, collision: {e: 1}}", {
    slider: "phi",
    chart: "distance",
    pair: "bit",
    colour: "origin",
    speed: 3,
  }),
  lesson("reverse", "{flow: hcs, phi: 0.1, particles: 200, collision: {e: 1}}", {
    slider: "e",
    chart: "distance",
    remember: true,
    colour: "origin",
  }),
];
export const lessonOf = (name) => LESSONS.find((one) => one.name === name) || null;

/* The lesson whose name is nearest to a wrong one; null: none is near. */
export function nearestLesson(wrong) {
  const steps = (a, b) => {
    let row = Array.from({ length: b.length + 1 }, (_, j) => j);
    for (let i = 1; i <= a.length; i++)
      row = row.reduce(
        (next, _, j) => [...next, j ? Math.min(row[j] + 1, next[j - 1] + 1, row[j - 1] + (a[i - 1] !== b[j - 1])) : i],
        [],
      );
    return row[b.length];
  };
  const [best] = LESSONS.map(({ name }) => [steps(wrong.toLowerCase().slice(0, 40), name), name]).sort((a, b) => a[0] - b[0]);
  return best[0] <= 3 ? best[1] : null;
}
