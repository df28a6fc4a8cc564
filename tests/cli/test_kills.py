# SPDX-License-Identifier: GPL-3.0-or-later
"""kill -9 in the calls that change a file (of a write, in its midst), the first twenty and every sixteenth, without NIGHTLY
every third of those: what is left can be gone on from, to the bits of the run that was left alone, and the command clears up
behind the dead one."""
import os
import subprocess
import sys

from tap import check
from faults import GRAINGAS, Page, bits, difference, environment, main_with_h5py

SCENE = """flow: usf
phi: 0.2
particles: 60
collision: {e: 0.9, beta: 0.3}
run: {collisions: 200, warmup: 10}
output: {trajectory_every: 5, checkpoint_every: 1.0e-6}
"""
RUN = ["run", "scene.yaml", "--quiet"]
SWEEP = ["sweep", "scene.yaml", "--vary", "phi=0.2", "--quiet"]
CHECKPOINT = "scene.checkpoint.h5"
SHARE = 1 if "NIGHTLY" in os.environ else 3


def files():
    return sorted(os.path.relpath(os.path.join(top, name)) for top, _, names in os.walk(".") for name in names)


def results():
    return {f: bits(f) for f in files() if f.endswith(".h5")}


def clear():
    for f in files():
        os.remove(f)
    with open("scene.yaml", "w") as f:
        f.write(SCENE)


def go_on(command):
    there = any(os.path.exists(CHECKPOINT + end) for end in ("", ".1"))
    done = subprocess.run([GRAINGAS, *command, *(["--resume", CHECKPOINT] if there and command is RUN else [])],
                          capture_output=True, text=True)
    check(done.returncode == 0, done.stderr)
    return done.stderr


def killed(command, page, at, how):
    page.clear()
    done = subprocess.run([GRAINGAS, *command], env=environment(page, at, how), capture_output=True)
    page.read()
    check(done.returncode == (-9 if page.faults else 0), page.what, done.returncode)
    return page.faults > 0


def every_call(command):
    page = Page("../page")
    clear()
    go_on(command)
    whole, there = results(), files()
    for how in ("kill-before", "kill-in", "kill-after") if "EVERY_KIND" in os.environ else ("kill-in",):
        at = 1
        clear()
        while killed(command, page, at, how):
            for f in files():
                head = f.removesuffix(".work.h5")
                if f != head:  # a point is done, and not yet published: nothing of it may be lost
                    check(os.path.exists(head + ".checkpoint.h5"), page.what, files())
            said = go_on(command)
            check("begins anew" not in said, page.what, said)
            check(files() == there, page.what, how, files())
            for path, now in results().items():
                different = difference(now, whole[path])
                check(different is None, page.what, how, path, different)
            at += 1 if "EVERY_KIND" in os.environ else SHARE * (1 if at < 20 else 16)
            clear()
        check(at > 25, at)


def in_folder(command):
    os.mkdir("here")
    os.chdir("here")
    every_call(command)


def test_a_killed_run_resumes():
    in_folder(RUN)


def test_a_killed_sweep_resumes():
    in_folder(SWEEP)


def test_checkpoint_before_alone():
    """Between two checkpoints there is a moment with the one before alone: a sweep sees that one, too."""
    os.mkdir("here")
    os.chdir("here")
    clear()
    page, at = Page("../page"), 1
    while killed(SWEEP, page, at, "kill-after") and not any(f.endswith(".checkpoint.h5.1") for f in files()):
        at += 1
        clear()
    one = [f for f in files() if f.endswith(".checkpoint.h5.1")]
    check(one and not os.path.exists(one[0][:-2]), files())
    with open(one[0], "r+b") as f:
        f.truncate(100)
    check("begins anew" in go_on(SWEEP))


if __name__ == "__main__":
    main_with_h5py(sys.modules[__name__])
