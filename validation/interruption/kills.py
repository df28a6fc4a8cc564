#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""kill -9 at random times and resume, until the run ends: the result must equal the uninterrupted run's bit for bit.

    GRAINGAS=build/src/cli/graingas FAILING_WRITES=build/tests/faults/failing_writes.so \\
        validation/interruption/kills.py [KILLS] [SEED] [LOG]

Each run is killed up to six times, each time after a random part of its processor time. At least every tenth kill is
inside a call that changes a file (before, during or after the change), mostly of a checkpoint. After each kill all
files must be readable. At the end only the result may remain. LOG keeps the counts: the same command continues them.
Files are in TMPDIR. Needs h5py."""
import json
import os
import random
import shutil
import subprocess
import sys
import tempfile

HERE = os.path.dirname(os.path.abspath(__file__))
sys.path.insert(0, os.path.join(HERE, "../../tests/cli"))
from faults import GRAINGAS, Page, bits, difference, environment, kill_at, start  # noqa: E402

EVERY = 0.005  # s between checkpoints
AIMED = float(os.environ.get("AIMED", "0.2"))  # share of kills that are inside a write
SCENE = """flow: usf
phi: 0.2
particles: 100
collision: {e: 0.9, beta: 0.3, mu: 0.4}
dsmc: {particles: 500}
measure: [rheology, velocity_distributions]
run: {collisions: 500, warmup: 60, seed: 3}
output: {checkpoint_every: %g%s}
""" % (EVERY, "%s")
PLAIN, FRAMES = SCENE % "", SCENE % ", trajectory_every: 20"
# name: scene, command, result
COMMANDS = {
    "run, md": (PLAIN, ["run", "scene.yaml", "--engine", "md"]),
    "run, dsmc": (PLAIN, ["run", "scene.yaml", "--engine", "dsmc"]),
    "run, md, 4 replicas, 2 threads": (PLAIN.replace("seed: 3", "seed: 3, replicas: 4").replace("500,", "125,"),
                                       ["run", "scene.yaml", "--engine", "md", "--threads", "2"]),
    "run, md, trajectory": (FRAMES, ["run", "scene.yaml", "--engine", "md"]),
    "run, dsmc, trajectory": (FRAMES, ["run", "scene.yaml", "--engine", "dsmc"]),
    "compare": (PLAIN.replace("500,", "250,"), ["compare", "scene.yaml", "--output", "scene.h5", "--picture", "none"]),
    "sweep": (PLAIN.replace("500,", "170,"), ["sweep", "scene.yaml", "--vary", "phi=0.1,0.2,0.3"]),
    "sweep, trajectories": (FRAMES.replace("500,", "170,"), ["sweep", "scene.yaml", "--vary", "phi=0.1,0.2,0.3"]),
}
RESULT, CHECKPOINT, FOLDER = "scene.h5", "scene.checkpoint.h5", "scene.sweep"


def all_files():
    return sorted(os.path.relpath(os.path.join(top, name)) for top, _, names in os.walk(".") for name in names)


def results():
    return [f for f in all_files() if f == RESULT or (f.startswith(FOLDER) and f.count(".") == 2 and f.endswith(".h5"))]


def readable(path):
    return subprocess.run([GRAINGAS, "info", path, "--quiet"], capture_output=True).returncode == 0


def unreadable():
    """Results and checkpoints that cannot be read after a kill. If the latest checkpoint is missing, `info` reads the
    one before it."""
    files = all_files()
    checked = [f for f in files if f in results() or f.endswith(".checkpoint.h5")]
    checked += [f[:-2] for f in files if f.endswith(".checkpoint.h5.1") and f[:-2] not in files]
    return [f for f in checked if not readable(f)]


class Chain:
    """One command, from its start over some kills to its end."""

    def __init__(self, name, page, draw, whole):
        self.scene, self.command = COMMANDS[name]
        self.page, self.draw, self.whole = page, draw, whole
        self.tally = {"kills": 0, "aimed": 0, "runs": 0, "equal": 0, "loss": 0.0, "wrong": []}

    def args(self):
        there = os.path.exists(CHECKPOINT) or os.path.exists(CHECKPOINT + ".1")
        goes_on = self.command[0] != "sweep" and there
        return [*self.command, "--quiet", *(["--resume", CHECKPOINT] if goes_on else [])]

    def once(self, aimed, seconds):
        """The exit code, after whatever became of it."""
        self.page.clear()
        env = environment(self.page)
        if aimed:
            env = environment(self.page, at=self.draw.randint(1, 30), on=self.draw.choice(["checkpoint"] * 3 + [".h5"]),
                              fails=self.draw.choice(["kill-before", "kill-in", "kill-after"]))
        used, code, err = kill_at(start(self.args(), env), None if aimed else seconds)
        if code not in (0, -9):
            self.tally["wrong"].append(f"exit code {code}: {err}")
        if code != -9:
            return code
        self.page.read()
        self.tally["kills"] += 1
        self.tally["aimed"] += aimed
        self.tally["loss"] = max(self.tally["loss"], used - self.page.used)
        self.tally["wrong"] += [f"{f} cannot be read" for f in unreadable()]
        return code

    def go(self):
        with open("scene.yaml", "w") as f:
            f.write(self.scene)
        kills = self.draw.randint(1, 6)
        code = -9
        while code == -9 and self.tally["kills"] < kills:
            code = self.once(self.draw.random() < AIMED, self.draw.uniform(0, 0.7 * self.whole["seconds"]))
        if code == -9:
            code = self.once(False, None)
        self.tally["runs"] = 1
        if code == 0:
            self.compare()
        return self.tally

    def compare(self):
        files = all_files()
        wrong = [f"{f} is left" for f in files if os.path.basename(f) not in ("scene.yaml", "sweep.yaml") and f not in self.whole["bits"]]
        for path, expected in self.whole["bits"].items():
            different = difference(bits(path), expected) if path in files else "is missing"
            if different:
                wrong.append(f"{path}: {different}")
        self.tally["equal"] = not wrong
        self.tally["wrong"] += wrong


def in_folder(work, *args):
    folder = tempfile.mkdtemp(prefix="kills-")
    before = os.getcwd()
    os.chdir(folder)
    try:
        return work(*args)
    finally:
        os.chdir(before)
        shutil.rmtree(folder)


def leave_alone(name, page):
    scene, command = COMMANDS[name]
    with open("scene.yaml", "w") as f:
        f.write(scene)
    used, code, err = kill_at(start([*command, "--quiet"], environment(page)), None)
    if code != 0:
        raise SystemExit(f"{name}: exit code {code}: {err}")
    return {"seconds": used, "bits": {path: bits(path) for path in results()}}


def add(total, tally):
    for key, value in tally.items():
        total[key] = max(total[key], value) if key == "loss" else total[key] + value


def show(totals):
    print("| command | kills | aimed into a write | runs | bit-equal | largest loss (s) |\n|---|---|---|---|---|---|")
    for name, t in totals.items():
        print(f"| {name} | {t['kills']} | {t['aimed']} | {t['runs']} | {t['equal']} | {t['loss']:.3f} |")
    print("| all | %d | %d | %d | %d | %.3f |" % tuple(
        [sum(t[k] for t in totals.values()) for k in ("kills", "aimed", "runs", "equal")] +
        [max(t["loss"] for t in totals.values())]))
    for name, t in totals.items():
        for wrong in t["wrong"]:
            print(f"{name}: {wrong}")


def main(kills=2000, seed=1, log=None):
    totals = {name: {"kills": 0, "aimed": 0, "runs": 0, "equal": 0, "loss": 0.0, "wrong": []}
              for name in COMMANDS}
    if log and os.path.exists(log):
        with open(log) as f:
            totals = json.load(f)
    with tempfile.NamedTemporaryFile() as own:
        page = Page(own.name)
        whole = {name: in_folder(leave_alone, name, page) for name in COMMANDS}
        while sum(t["kills"] for t in totals.values()) < kills:
            name = min(totals, key=lambda n: totals[n]["kills"])
            draw = random.Random(f"{seed} {name} {totals[name]['runs']}")
            add(totals[name], in_folder(lambda: Chain(name, page, draw, whole[name]).go()))
            if log:
                with open(log + ".new", "w") as f:
                    json.dump(totals, f)
                os.rename(log + ".new", log)
    show(totals)
    sys.exit(any(t["wrong"] or t["equal"] < t["runs"] for t in totals.values()))


if __name__ == "__main__":
    try:
        import h5py  # noqa: F401
    except ImportError:
        sys.exit(77)  # skipped, says meson
    main(*[int(a) for a in sys.argv[1:3]], *[os.path.abspath(a) for a in sys.argv[3:4]])
