# SPDX-License-Identifier: GPL-3.0-or-later
"""Interruption, checkpoints and resumption from the command line."""
import json
import os
import signal
import subprocess
import sys
import tempfile
import time

from tap import GRAINGAS, PATIENCE, check, main, run

SCENE = "flow: usf\nphi: 0.2\nparticles: 500\ncollision: {e: 0.9, beta: 0}\nrun: {collisions: %g, warmup: 30}\n"


class Running:
    """A running command: for how long, and its output so far. Its output goes to files, so that no pipe fills up."""

    def __init__(self, args):
        self.begun = time.monotonic()
        self.out, self.err = tempfile.TemporaryFile(), tempfile.TemporaryFile()
        self.process = subprocess.Popen([GRAINGAS, *args], stdout=self.out, stderr=self.err)

    def age(self):
        return time.monotonic() - self.begun

    @staticmethod
    def text(file):
        return os.pread(file.fileno(), 1 << 24, 0).decode()


def interrupted(*args, after, sig=signal.SIGINT):
    """The signal comes once `after` holds, of the command that runs."""
    run = Running(args)
    while not after(run) and run.process.poll() is None and run.age() < 60 * PATIENCE:
        time.sleep(0.01)
    run.process.send_signal(sig)
    code = run.process.wait(timeout=60 * PATIENCE)
    return code, run.text(run.out), run.text(run.err)


def a_second(run):
    return run.age() > 1


def there(name):
    return lambda run: os.path.exists(name)


def averaging(*engines):
    """All of them do, and have for a while."""
    since = []

    def yet(run):
        said = run.text(run.err)
        if not since and all(engine + " averaging" in said for engine in engines):
            since.append(run.age())
        return since and run.age() > since[0] + 0.3 * PATIENCE

    return yet


def test_interrupted_without_checkpoint():
    with open("scene.yaml", "w") as f:
        f.write(SCENE % 1e9)
    for command, engines in ("run", ["md"]), ("compare", ["md", "dsmc"]):
        code, out, err = interrupted(command, "scene.yaml", after=averaging(*engines))
        check(code == 130, code, err)
        check("interrupted" in err and os.listdir(".") == ["scene.yaml"], err, os.listdir("."))
        check("interrupted: the results so far" in out and "temperature " in out, out)
    code, out, err = interrupted("run", "scene.yaml", "--json", after=averaging("md"))
    d = json.loads(out)
    check(code == 130 and d["results"]["temperature"]["mean"] > 0, code, out)
    check(any("interrupted" in w for w in d["warnings"]), d["warnings"])
    code, out, err = interrupted("run", "scene.yaml", "--quiet", "--set", "run.warmup=1e9", after=a_second)
    check(code == 130 and not out and "interrupted" in err, code, out, err)  # nothing was averaged


def test_resumed_run_is_the_same_run():
    """A run interrupted and resumed gives bit for bit the numbers of one that was left alone."""
    for engine in "md", "dsmc":
        with open("scene.yaml", "w") as f:
            f.write(SCENE % 1500 + "dsmc: {particles: 500}\noutput: {checkpoint_every: 0.02}\n")
        args = ("run", "scene.yaml", "--engine", engine, "--json")
        whole = json.loads(run(*args, "--quiet").out)
        os.remove("scene.h5")
        for name in "scene.checkpoint.h5", "scene.checkpoint.h5.1":
            if os.path.exists(name):
                os.remove(name)
        code, out, err = interrupted(*args, after=there("scene.checkpoint.h5"), sig=signal.SIGTERM)
        check(code == 130 and "--resume scene.checkpoint.h5" in err, code, err)
        check(not os.path.exists("scene.h5") and "interrupted" in (out or "interrupted"), out)
        done = run(*args, "--resume", "scene.checkpoint.h5")
        check(done.code == 0, done.err)
        check(json.loads(done.out)["results"] == whole["results"], engine)


def test_resumed_comparison_is_the_same():
    """A comparison goes on from both engines' checkpoints."""
    with open("scene.yaml", "w") as f:
        f.write(SCENE % 1500 + "dsmc: {particles: 500}\noutput: {checkpoint_every: 0.02}\n")
    args = ("compare", "scene.yaml", "--json", "--picture", "none")
    whole = json.loads(run(*args, "--quiet", "--output", "whole.h5").out)
    code, out, err = interrupted(*args, after=there("scene.compare.checkpoint.h5"), sig=signal.SIGTERM)
    check(code == 130 and "--resume scene.compare.checkpoint.h5" in err, code, err)
    told = run("info", "scene.compare.checkpoint.h5").out
    check("a checkpoint of a comparison" in told and "  md: " in told, told)
    done = run(*args, "--resume", "scene.compare.checkpoint.h5")
    check(done.code == 0, done.err)
    for engine in "md", "dsmc":
        check(json.loads(done.out)[engine]["results"] == whole[engine]["results"], engine)


def test_checkpoint_of_another_scene():
    with open("scene.yaml", "w") as f:
        f.write(SCENE % 1e9 + "output: {checkpoint_every: 0.2}\n")
    interrupted("run", "scene.yaml", "--quiet", after=there("scene.checkpoint.h5"))
    done = run("info", "scene.checkpoint.h5")
    check(done.code == 0 and "a checkpoint of a run" in done.out and "  md: " in done.out, done.out, done.err)
    check("collisions a grain" in done.out and "phi: 0.2" in done.out, done.out)
    check("graingas" not in done.out, "the program's version, which need not be the checkpoint's", done.out)
    done = run("run", "scene.yaml", "--resume", "scene.checkpoint.h5", "--set", "collision.e=0.8")
    check(done.code == 2 and "collision.e" in done.err, done.code, done.err)


def test_killed_at_any_moment():
    """Whatever the moment of a kill -9, a whole checkpoint is there to go on from."""
    with open("scene.yaml", "w") as f:
        f.write(SCENE % 1e9 + "output: {checkpoint_every: 0.001}\n")
    for k in range(6):
        begun = []

        def after(run):
            if not begun and os.path.exists("scene.checkpoint.h5"):
                begun.append(time.monotonic())
            return begun and time.monotonic() > begun[0] + 0.037 * k

        args = ("run", "scene.yaml", "--quiet") + (("--resume", "scene.checkpoint.h5") if k else ())
        code, _, err = interrupted(*args, after=after, sig=signal.SIGKILL)
        check(code == -signal.SIGKILL, code, err)
    code, _, err = interrupted(*args, after=a_second)
    check(code == 130 and "--resume" in err, code, err)


def test_a_trajectory_is_stored_whole():
    done = run("run", "scene.yaml", "--quiet", "--set", "output.trajectory_every=20", scene=SCENE % 100)
    check(done.code in (0, 1) and done.new == ["scene.h5"], done.err)


if __name__ == "__main__":
    main(sys.modules[__name__])
