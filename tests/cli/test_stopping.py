# SPDX-License-Identifier: GPL-3.0-or-later
"""Signals and the time limit are honoured at once, whatever the run is at: the start, an interval that would take
minutes, a million grains. The bound is far above what it takes, and far below what it took."""
import fcntl
import json
import os
import shlex
import signal
import subprocess
import sys
import time

from tap import GRAINGAS, PATIENCE, check, main, run

BOUND = 10 * PATIENCE  # s

SCENES = {
    "dilute": "{flow: hcs, phi: 1e-9, particles: 1000}",
    "small steps": "{flow: usf, phi: 0.1, engine: dsmc, dsmc: {time_step: 1e-9}}",
    "masses": "{flow: usf, phi: 0.001, engine: dsmc, species: [{fraction: 0.5}, {fraction: 0.5, mass: 1.0e12}]}",
    "a million (md)": "{flow: usf, phi: 0.5, particles: 1000000}",
    "a million (dsmc)": "{flow: usf, phi: 0.1, engine: dsmc, particles: 1000000, run: {relative_error: 1.0e-7}}",
}


def wait_until_it_listens(child, sig):
    """Wait until the process catches the signal, so that a slow start is not measured."""
    until = time.time() + BOUND
    while os.path.exists("/proc/self/status") and time.time() < until and child.poll() is None:
        with open(f"/proc/{child.pid}/status") as f:
            caught = next(int(line.split()[1], 16) for line in f if line.startswith("SigCgt:"))
        if caught >> (sig - 1) & 1:
            return
        time.sleep(0.01)


def stop(args, after, sig, ignore=False):
    before = lambda: signal.signal(sig, signal.SIG_IGN if ignore else signal.SIG_DFL)  # whatever we were started with
    child = subprocess.Popen([GRAINGAS, *args, "--quiet"], stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True,
                             preexec_fn=before)
    wait_until_it_listens(child, signal.SIGTERM)
    time.sleep(after)
    child.send_signal(sig)
    try:
        err = child.communicate(timeout=BOUND)[1]
    except subprocess.TimeoutExpired:
        child.kill()
        child.communicate()
        return None, "not within %g s" % BOUND
    return child.returncode, err


def test_signals_end_a_run_with_its_results():
    for name, scene in SCENES.items():
        with open("scene.yaml", "w") as f:
            f.write(scene)
        for after, sig in (0.2, signal.SIGHUP), (0.6, signal.SIGTERM):
            code, err = stop(("run", "scene.yaml"), after, sig)
            check(code == 130 and "interrupted" in err, name, after, code, err)
            check(os.listdir(".") == ["scene.yaml"], os.listdir("."))


def test_a_signal_ends_a_comparison():
    with open("scene.yaml", "w") as f:
        f.write("{flow: hcs, phi: 1e-9, particles: 1000, dsmc: {time_step: 1e-9}}")
    for threads in "1", "2":
        code, err = stop(("compare", "scene.yaml", "--threads", threads), 0.5, signal.SIGTERM)
        check(code == 130 and "interrupted" in err, code, err)


def test_ignored_signals_stay_ignored():
    """Signals that the parent ignores (nohup, background jobs of scripts) stay ignored."""
    with open("scene.yaml", "w") as f:
        f.write("{flow: usf, phi: 0.1, engine: dsmc, run: {collisions: 1e9, time_limit: %g}}" % (0.6 * PATIENCE))
    for sig in signal.SIGHUP, signal.SIGINT:
        code, err = stop(("run", "scene.yaml"), 0.3, sig, ignore=True)
        check(code == 1 and "time limit" in err, sig, code, err)


def test_time_limit():
    for name, scene in SCENES.items():
        with open("scene.yaml", "w") as f:
            f.write(scene)
        done = run("run", "scene.yaml", "--json", "--set", "run.time_limit=0.5", timeout=BOUND / PATIENCE)
        check(done.code == 1 and "time limit reached" in done.err, name, done.code, done.err)


def test_chosen_quantities_end_the_run():
    """Quantities with errors of their own: those and no others end the run; headline ones keep theirs where it is given."""
    with open("scene.yaml", "w") as f:
        f.write("{flow: usf, phi: 0.1, particles: 300}")

    def errors(*sets, code=0):
        done = run("run", "scene.yaml", "--json", "--quiet", *(w for s in sets for w in ("--set", s)))
        check(done.code == code, done.err)
        found = json.loads(done.out)["results"]
        return {q: found[q]["stderr"] / abs(found[q]["mean"]) for q in ("temperature", "N1", "shear_viscosity")}, done.err

    alone, _ = errors("run.until={N1: 0.02}")
    check(0.006 < alone["N1"] <= 0.02, alone)
    both, _ = errors("run.until={N1: 0.05, temperature: 0.005}", "run.relative_error=0.03")
    check(both["temperature"] <= 0.005 < both["shear_viscosity"] <= 0.03, both)
    one, member = (run("info", "scene.yaml", "--json", "--set", of).out for of in ("run.until={N1: 0.02}", "run.until.N1=0.02"))
    check(one == member and json.loads(one)["run"]["until"] == {"N1": 0.02}, one, member)
    _, said = errors("run.until={N1: 0.001}", "run.collisions=3000", code=1)
    check("relative error 0.001 was not reached: N1 has 0.0" in said, said)
    for value, text in ("{n1: 0.1}", "did you mean 'N1'"), ("{N1: 2}", "a number above 0, at most 1"), ("0.1", "a map of quantities"), \
                       ("{a2: 0.1}", "a2 has no mean in this scene"), ("{N1: 0.1, N1: 0.2}", "twice"):
        done = run("run", "scene.yaml", "--set", "run.until=" + value)
        check(done.code == 2 and text in done.err, value, done.code, done.err)


def test_few_grains():
    """A Monte Carlo ensemble whose 1/N is no longer small beside the error asked for says so; one that is chosen is large
    enough."""
    with open("scene.yaml", "w") as f:
        f.write("{flow: hss, phi: 0.1, engine: dsmc, collision: {e: 0.8}, run: {relative_error: 0.01}}")
    for more, told in (("dsmc.particles=300",), True), (("dsmc.particles=900",), False), ((), False):
        done = run("run", "scene.yaml", "--json", "--quiet", *(w for m in more for w in ("--set", m)))
        found = json.loads(done.out)
        bias = found["engine_state"]["particles_bias"]
        check(abs(bias * found["particles"] - 2) < 1e-9, found["engine_state"])
        check(any("1/N" in w for w in found["warnings"]) == told, more, found["warnings"])


def test_limit_is_named():
    """Before the start and on the way: what ends the run, and what was asked needs."""
    with open("scene.yaml", "w") as f:
        f.write("{flow: usf, phi: 0.1, engine: dsmc, dsmc: {particles: 2000}, run: {relative_error: 2.0e-5, time_limit: %g}}"
                % PATIENCE)
    told = run("info", "scene.yaml").out
    check("less than one processor is expected to need" in told, told)
    done = run("run", "scene.yaml")
    last = [line for line in done.err.splitlines() if "averaging" in line][0]
    check("limit in " in last and " left" not in last, done.err)
    check("time limit" not in run("info", "scene.yaml", "--set", "run.time_limit=none").out)


def test_walls_that_slip():
    """A flow that dies because friction at its walls is at its limit says so."""
    scene = ("{flow: couette, phi: 0.3, particles: 200, collision: {e: 0.8, beta: 0.3, mu: 0.2}, walls: {mu: %s}, "
             "run: {collisions: 300, warmup: 200}}")
    for mu in "0.3", "inf":
        done = run("run", "-", "--json", "--quiet", "--output", "slip.h5", typed=scene % mu)
        found = json.loads(done.out)
        check(abs(found["results"]["wall_friction"]["mean"] - 0.3) < 0.005 or mu == "inf", found["results"]["wall_friction"])
        said = [w for w in found["warnings"] if "both walls slip" in w]
        check(len(said) == (mu == "0.3"), mu, found["warnings"])
        check(not said or "walls.mu a larger value" in said[0], said)


def test_time_limit_in_the_warmup():
    """A run that ended in its warm-up averaged over nothing: no collisions averaged over, no table without rows."""
    with open("scene.yaml", "w") as f:
        f.write("{flow: usf, phi: 0.3, particles: 2000, run: {warmup: 1.0e7, time_limit: %g}}" % PATIENCE)
    done = run("run", "scene.yaml", "--output", "cut.h5")
    check(done.code == 1 and "ended in its warm-up" in done.out, done.code, done.out, done.err)
    check("averaged over" not in done.out and "samples" not in done.out, done.out)
    done = run("info", "cut.h5", "--json")
    check('"collisions": 0' in done.out, done.out)


def test_time_limit_before_a_checkpoint():
    """The limit counts from the first start, and says so; how far the run is are the collisions that there were."""
    with open("scene.yaml", "w") as f:
        f.write("{flow: usf, phi: 0.3, particles: 4000, run: {relative_error: 1e-5, time_limit: %g}, "
                "output: {checkpoint_every: 1000}}" % (1.5 * PATIENCE))
    done = run("run", "scene.yaml", "--json", "--quiet")
    check(done.code == 1 and "time limit reached" in done.err, done.code, done.err)
    there = 2 * json.loads(done.out)["total"]["collisions"] / 4000
    told = float(run("info", "scene.checkpoint.h5").out.split("after ")[1].split()[0])
    check(abs(told - there) < 3 + 0.04 * there, told, there)
    again = shlex.split(done.err.split("\ncontinue with: ")[1])
    check(again == [GRAINGAS, "run", "scene.yaml", "--json", "--quiet", "--resume", "scene.checkpoint.h5", "--set",
                    "run.time_limit=%g" % (3 * PATIENCE)], again)
    done = run("run", "scene.yaml", "--json", "--quiet", "--resume", "scene.checkpoint.h5")
    check(done.code == 1 and "counts from the run's first start" in done.err, done.code, done.err)


def test_stopped_within_an_interval():
    """A checkpoint from the middle of an interval resumes to the uninterrupted run."""
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


def test_gnuplot_that_hangs():
    """A signal reaches it (without one it has a minute: plot/gnuplot)."""
    os.mkdir("bin")
    with open("bin/gnuplot", "w") as f:
        f.write(f"#!/bin/sh\necho $$ > {os.getcwd()}/drawing\nexec sleep 1000\n")
    os.chmod("bin/gnuplot", 0o755)
    with open("scene.yaml", "w") as f:
        f.write("{flow: usf, phi: 0.1, particles: 100, run: {collisions: 20}, output: {checkpoint_every: 0}}")
    child = subprocess.Popen([GRAINGAS, "compare", "scene.yaml", "--quiet"], stdout=subprocess.DEVNULL,
                             stderr=subprocess.PIPE, text=True,
                             env=dict(os.environ, PATH=os.path.abspath("bin") + ":" + os.environ["PATH"]))
    until = time.time() + BOUND
    while time.time() < until and not (os.path.exists("drawing") and open("drawing").read().strip()):
        time.sleep(0.01)
    gnuplot = open("drawing").read().strip()
    check(stopped(child, 0.1) == 130, child.returncode)
    check("interrupted while gnuplot drew" in child.stderr.read() and not os.path.exists("/proc/" + gnuplot))


PIPE_SIZE = 1031  # F_SETPIPE_SZ, of Linux


def full_pipe():
    """Somebody holds its reading end, and reads nothing."""
    reader, writer = os.pipe()
    fcntl.fcntl(writer, PIPE_SIZE, 4096)
    os.set_blocking(writer, False)
    os.write(writer, b"x" * 4096)
    os.set_blocking(writer, True)
    return reader, writer


def stopped(child, after, file=None):
    """Exit code of a process that gets SIGTERM `after` seconds after it catches signals and has made `file`."""
    wait_until_it_listens(child, signal.SIGTERM)
    until = time.time() + BOUND
    while file and not os.path.exists(file) and time.time() < until:
        time.sleep(0.01)
    time.sleep(after)
    check(child.poll() is None, "it did not wait", child.returncode)
    child.terminate()
    try:
        return child.wait(timeout=BOUND)
    except subprocess.TimeoutExpired:
        child.kill()
        raise AssertionError("not within %g s" % BOUND)


def test_reader_that_stalls():
    """SIGTERM ends a run although its output goes to a stalled reader (a suspended pager, a halted terminal)."""
    with open("long.yaml", "w") as f:
        f.write("{flow: usf, phi: 0.1, run: {collisions: 1e7}, output: {checkpoint_every: 1000}}")
    with open("short.yaml", "w") as f:
        f.write("{flow: usf, phi: 0.1, particles: 100, run: {collisions: 20}, output: {checkpoint_every: 0}}")
    reader, writer = full_pipe()
    for name, file, streams in (("long", None, {"stderr": writer, "stdout": subprocess.DEVNULL}),
                                ("short", "short.h5", {"stdout": writer, "stderr": subprocess.DEVNULL})):
        child = subprocess.Popen([GRAINGAS, "run", name + ".yaml"], **streams)
        check(stopped(child, 0.5 * PATIENCE, file) == 130, name, child.returncode)
    check(os.path.exists("long.checkpoint.h5") and os.path.exists("short.h5"), os.listdir("."))
    os.mkfifo("pipe")
    end = os.open("pipe", os.O_RDONLY | os.O_NONBLOCK)
    fcntl.fcntl(end, PIPE_SIZE, 4096)
    child = subprocess.Popen([GRAINGAS, "run", "short.yaml", "--quiet", "--output", "pipe"], stdout=subprocess.DEVNULL,
                             stderr=subprocess.PIPE, text=True)
    code = stopped(child, PATIENCE)
    err = child.communicate()[1]
    check(code == 3 and "its reader stalled" in err, code, err)
    for fd in reader, writer, end:
        os.close(fd)


if __name__ == "__main__":
    main(sys.modules[__name__])
