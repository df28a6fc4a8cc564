"""Signals and the time limit are honoured at once, whatever the run is at: the start, an interval that would take
minutes, a million grains. The bound is far above what it takes, and far below what it took."""
import json
import os
import signal
import subprocess
import sys
import time

from tap import GRAINGAS, check, main, run

BOUND = 10  # s

SCENES = {
    "dilute": "{flow: hcs, phi: 1e-9, particles: 1000}",
    "small steps": "{flow: usf, phi: 0.1, engine: dsmc, dsmc: {time_step: 1e-9}}",
    "masses": "{flow: usf, phi: 0.001, engine: dsmc, species: [{fraction: 0.5}, {fraction: 0.5, mass: 1.0e12}]}",
    "a million (md)": "{flow: usf, phi: 0.5, particles: 1000000}",
    "a million (dsmc)": "{flow: usf, phi: 0.1, engine: dsmc, particles: 1000000, run: {relative_error: 1.0e-7}}",
}


def stop(args, after, sig, ignore=False):
    before = lambda: signal.signal(sig, signal.SIG_IGN if ignore else signal.SIG_DFL)  # whatever we were started with
    child = subprocess.Popen([GRAINGAS, *args, "--quiet"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                             preexec_fn=before)
    time.sleep(after)
    child.send_signal(sig)
    try:
        err = child.communicate(timeout=BOUND)[1]
    except subprocess.TimeoutExpired:
        child.kill()
        child.communicate()
        return None, "not within %g s" % BOUND
    return child.returncode, err


def test_signals():
    for name, scene in SCENES.items():
        with open("scene.yaml", "w") as f:
            f.write(scene)
        for after, sig in (0.2, signal.SIGHUP), (1.0, signal.SIGTERM):
            code, err = stop(("run", "scene.yaml"), after, sig)
            check(code == 130 and "interrupted" in err, name, after, code, err)
            check(os.listdir(".") == ["scene.yaml"], os.listdir("."))


def test_comparison():
    with open("scene.yaml", "w") as f:
        f.write("{flow: hcs, phi: 1e-9, particles: 1000, dsmc: {time_step: 1e-9}}")
    for threads in "1", "2":
        code, err = stop(("compare", "scene.yaml", "--threads", threads), 0.5, signal.SIGTERM)
        check(code == 130 and "interrupted" in err, code, err)


def test_nohup():
    """Who ignores SIGHUP goes on."""
    with open("scene.yaml", "w") as f:
        f.write("{flow: usf, phi: 0.1, engine: dsmc, run: {collisions: 1e9, time_limit: 1}}")
    code, err = stop(("run", "scene.yaml"), 0.3, signal.SIGHUP, ignore=True)
    check(code == 1 and "time limit" in err, code, err)


def test_time_limit():
    for name, scene in SCENES.items():
        with open("scene.yaml", "w") as f:
            f.write(scene)
        done = run("run", "scene.yaml", "--json", "--set", "run.time_limit=0.5", timeout=BOUND)
        check(done.code == 1 and "the time limit struck" in done.err, name, done.code, done.err)


def test_stopped_within_an_interval():
    """What a checkpoint from the midst of an interval goes on to is the run that was left alone."""
    with open("scene.yaml", "w") as f:
        f.write("{flow: hcs, phi: 1e-4, particles: 1000, run: {collisions: 10, warmup: 6}, "
                "output: {checkpoint_every: 1000}}")
    args = ("run", "scene.yaml", "--json", "--quiet")
    whole = json.loads(run(*args, "--output", "whole.h5").out)
    code, err = stop(args, 0.3, signal.SIGTERM)
    if code == 0:
        return  # too fast a machine
    check(code == 130, code, err)
    done = run(*args, "--resume", "scene.checkpoint.h5")
    check(json.loads(done.out)["results"] == whole["results"], done.err)


if __name__ == "__main__":
    main(sys.modules[__name__])
