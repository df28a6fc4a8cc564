/* SPDX-License-Identifier: GPL-3.0-or-later */
/* A result of the command, in a worker: its frames by their numbers. */
import { aboutOf, flowOf, shownState } from "./live.js";
import { courseOfTheories } from "./measuring.js";
import { Picture } from "./picture.js";

export class Replay {
  constructor(g, file) {
    const { answer, gone } = g.withFile(file, (path) => new g.Trajectory(path));
    this.trajectory = answer;
    this.gone = gone;
    this.g = g;
    try {
      this.begin();
    } catch (e) {
      this.free();
      throw e;
    }
  }
  begin() {
    const scene = this.trajectory.scene();
    try {
      this.about = aboutOf(this.g, scene);
    } finally {
      scene.free();
    }
    this.about.frames = this.trajectory.frames;
    const { state, grains } = this.trajectory.frame(0),
      kinds = this.trajectory.species();
    this.view = new Picture(grains, kinds, this.about);
    this.view.fix(state, grains, kinds, flowOf(this.about.values));
    this.about.fastest = this.view.fastest;
  }
  frame({ k, colour, arrows = false, grain = null }) {
    const { state, grains } = this.trajectory.frame(k);
    const md = shownState(this.trajectory, state, this.about.values);
    return { md, dsmc: null, picture: this.view.of(state, grains, { by: colour, flow: flowOf(this.about.values), arrows, grain }), event: null };
  }
  free() {
    this.trajectory.free();
    this.gone();
  }
}

/* Its means and curves beside the theories, as in a comparison, and the histories of its temperatures. */
export function readResult(g, file) {
  const { answer, gone } = g.withFile(file, (path) => new g.Comparison(path));
  try {
    const courses = {};
    for (const engine of ["md", "dsmc"])
      courses[engine] = {
        T: answer.history(engine, "temperature"),
        theta: answer.history(engine, "rotational_temperature"),
      };
    return { ...answer.document(), ...courseOfTheories(answer), courses, progress: {}, refused: {}, stored: true };
  } finally {
    answer.free();
    gone();
  }
}
