# SPDX-License-Identifier: GPL-3.0-or-later
"""A trajectory goes on where a run does: cut by kill -9, SIGTERM or the time limit, resumed once or often, here or
there, the result holds every frame of the run that was left alone, bit for bit."""
import functools
import glob
import json
import os
import random
import re
import shutil
import signal
import subprocess
import sys
import time

from tap import GRAINGAS, PATIENCE, Skip, check, main, run

try:
    import h5py
except ImportError:
    h5py = None

SCENE = """flow: usf
engine: %s
phi: 0.2
particles: 300
species: [{fraction: 0.5}, {fraction: 0.5, mass: 2}]
collision: {e: 0.9, beta: 0}
dsmc: {particles: 300}
run: {collisions: %g, warmup: 30, replicas: %d}
output: {checkpoint_every: %g, trajectory_every: 10}
"""


def particles(path):
    """Every array under /particles but second names of one, as shape and bytes."""
    if not h5py:
        raise Skip("no h5py")
    found = {}
    with h5py.File(path) as f:
        f["particles"].visititems(lambda name, item: found.update({name: (item.shape, item[()].tobytes())})
                                  if isinstance(item, h5py.Dataset) else None)
    return found


def same(path, whole, *what):
    found = particles(path)
    check(sorted(found) == sorted(whole), *what, sorted(found))
    for name in whole:
        check(found[name] == whole[name], name, found[name][0], whole[name][0], *what)


@functools.lru_cache(None)
def particles_of(scene):
    """The frames of the run that nobody cuts, made once for all tests."""
    done = run("run", "scene.yaml", "--quiet", "--output", "whole.h5", "--set", "output.checkpoint_every=0", scene=scene)
    check(done.code == 0, done.err)
    whole = particles("whole.h5")
    os.remove("whole.h5")
    check(len(whole) > 5 and whole["grains/position/value" if "md" in scene else "grains/velocity/value"][0][0] > 40)
    return whole


def whole_run(scene):
    with open("scene.yaml", "w") as f:
        f.write(scene)
    return particles_of(scene)


def cut(args, after, how):
    """True if the run was over before."""
    child = subprocess.Popen([GRAINGAS, "run", "scene.yaml", "--quiet", *args], stdout=subprocess.DEVNULL,
                             stderr=subprocess.PIPE, text=True)
    try:
        _, err = child.communicate(timeout=after)
    except subprocess.TimeoutExpired:
        child.send_signal(how)
        _, err = child.communicate(timeout=60 * PATIENCE)
    check(child.returncode in (0, 130, -how), child.returncode, err)
    return child.returncode == 0


def at_random_moments(engine, replicas, seed):
    scene = SCENE % (engine, 6000, replicas, 0.02)
    whole = whole_run(scene)
    draw = random.Random(seed)
    names, at, begun, cuts = ["one.h5", "two.h5"], 0, time.monotonic(), 0
    over = False
    while not over:
        args = ["--output", names[at]]
        kept = "%s.checkpoint.h5" % names[at][:3]
        older = kept + ".1"
        if os.path.exists(kept) or os.path.exists(older):
            use = older if os.path.exists(older) and draw.random() < 0.3 else kept
            args += ["--resume", use]
            if draw.random() < 0.3:  # under another name, where nothing is in the way
                at = 1 - at
                args[1] = names[at]
                for left in glob.glob("%s.checkpoint*" % names[at][:3]):
                    os.remove(left)
        patience = 60 if time.monotonic() > begun + 4 else draw.uniform(0.03, 0.4)
        over = cut([*args, "--threads", str(draw.choice([1, 2]))], patience, draw.choice([signal.SIGKILL, signal.SIGTERM]))
        cuts += not over
    check(cuts > 2, "too fast a machine", cuts)
    same(names[at], whole, engine, cuts)


def test_md_cut_at_random_moments():
    at_random_moments("md", 1, 1)


def test_replicas_of_dsmc_cut_at_random_moments():
    at_random_moments("dsmc", 2, 2)


def test_time_limit():
    whole = whole_run(SCENE % ("md", 3000, 1, 60))
    done = run("run", "scene.yaml", "--quiet", "--set", "run.time_limit=0.1")
    check(done.code == 1 and "time limit" in done.err, done.code, done.err)
    part = particles("scene.h5")["grains/velocity/value"]
    check(0 < part[0][0] < whole["grains/velocity/value"][0][0], part[0])
    check(whole["grains/velocity/value"][1].startswith(part[1][:-24 * 300]))  # but the last state, which is stored, too
    done = run("run", "scene.yaml", "--quiet", "--resume", "scene.checkpoint.h5")
    check(done.code == 0 and "begins where" not in done.err + done.out, done.err)
    same("scene.h5", whole)


def stopped():
    with open("scene.yaml", "w") as f:
        f.write(SCENE % ("md", 1e9, 1, 60))
    check(not cut([], 0.5, signal.SIGTERM))
    return ["--resume", "scene.checkpoint.h5"]


def test_without_checkpoints_or_under_another_name():
    whole = whole_run(SCENE % ("md", 3000, 1, 60))
    run("run", "scene.yaml", "--quiet", "--set", "run.time_limit=0.1")
    done = run("run", "scene.yaml", "--quiet", "--resume", "scene.checkpoint.h5", "--output", "b.h5", "--set",
               "output.checkpoint_every=0")
    check(done.code == 0 and done.new == ["b.h5"], done.err, done.new)
    same("b.h5", whole)
    shutil.copy("scene.checkpoint.h5", "kept.h5")  # a copy of the checkpoint finds the frames beside it
    done = run("run", "scene.yaml", "--quiet", "--resume", "kept.h5", "--output", "c.h5")
    check(done.code == 0, done.err)
    same("c.h5", whole)


def test_log_missing_or_damaged():
    """Refused with the way out, and nothing is touched."""
    resume = stopped()
    log = "scene.checkpoint.frames"
    with open(log, "rb") as f:
        good = f.read()
    draw = random.Random(3)
    for k in range(5):
        bad = bytearray(good)
        if k == 0:
            del bad[-1]
        else:
            bad[draw.randrange(len(bad))] ^= 1 << draw.randrange(8)
        with open(log, "wb") as f:
            f.write(bad)
        done = run("run", "scene.yaml", "--quiet", *resume)
        check(done.code == 3 and log + ": frame " in done.err and "output.trajectory_every: 0" in done.err, done.err)
        check(("missing" if k == 0 else "damaged") in done.err, done.err)
    os.remove(log)
    done = run("run", "scene.yaml", "--quiet", *resume)
    check(done.code == 3 and log + ": cannot be read" in done.err and not done.new, done.err, done.new)
    done = run("run", "scene.yaml", "--quiet", *resume, "--set", "output.trajectory_every=0", "--set", "run.collisions=100",
               "--output", "other.h5")  # a run that is done removes its own checkpoint
    check(done.code == 0 and not os.path.exists(log), done.err)
    with open(log, "wb") as f:
        f.write(good)
    check(not cut(resume, 0.3, signal.SIGKILL))


def test_asked_for_later():
    """Frames that were not asked for before a resumption are missing, which is said; those after it are as asked."""
    with open("scene.yaml", "w") as f:
        f.write(SCENE % ("md", 1e9, 1, 60))
    run("run", "scene.yaml", "--quiet", "--set", "run.time_limit=0.05", "--set", "output.trajectory_every=0")
    done = run("run", "scene.yaml", "--quiet", "--json", "--resume", "scene.checkpoint.h5", "--set",
               "run.collisions=1500", "--set", "output.trajectory_every=100")
    check(done.code == 0 and any("begins where the run was resumed" in w for w in json.loads(done.out)["warnings"]),
          done.err, done.out)
    if h5py:
        with h5py.File("scene.h5") as f:
            frames = f["particles/grains/velocity/step"][()]
        check(5 < len(frames) <= 18 and all(b - a > 0.9 * 100 * 300 / 2 for a, b in zip(frames[:-2], frames[1:])), frames)


def test_full_disk():
    with open("scene.yaml", "w") as f:
        f.write(SCENE % ("md", 1e9, 1, 60))
    done = run("run", "scene.yaml", "--quiet", limit=2_000_000)
    check(done.code == 3 and "scene.checkpoint.frames: cannot be written: File too large" in done.err, done.code, done.err)
    check(not [name for name in os.listdir(".") if name.startswith("scene.checkpoint.frames")], os.listdir("."))


LEFT = "scene.checkpoint.h5"
ANOTHER = ["--set", "run.seed=9"]


def left_by_another():
    """A checkpoint with its frames, and what its run comes to."""
    whole = whole_run(SCENE % ("md", 3000, 1, 60))
    done = run("run", "scene.yaml", "--quiet", "--set", "run.time_limit=0.1")
    check(done.code == 1 and os.path.exists(LEFT), done.code, done.err)
    return whole


def content(name):
    with open(name, "rb") as f:
        return f.read()


def goes_on(whole, *args, resume=LEFT, output="scene.h5"):
    done = run("run", "scene.yaml", "--quiet", "--resume", resume, "--output", output, *args)
    check(done.code == 0, done.err)
    same(output, whole)


def test_another_run_beside_what_is_left():
    """It is refused before it touches anything, goes it on from elsewhere or not; the earlier run goes on."""
    whole = left_by_another()
    before = {name: content(name) for name in os.listdir(".")}
    done = run("run", "scene.yaml", "--quiet", "--output", "other.h5", "--set", "run.time_limit=0.03")
    check(done.code == 1, done.err)
    for args in ANOTHER, [], ["--output", "scene.h5", "--resume", "other.checkpoint.h5"]:
        done = run("run", "scene.yaml", "--quiet", *args)
        check(done.code == 3 and "holds the state of a run: resume it (--resume scene.checkpoint.h5), remove it, "
              "or choose another output" in done.err, done.code, done.err)
        check(all(content(name) == was for name, was in before.items()) and done.new == [], done.new)
    os.rename(LEFT, LEFT + ".1")
    check("holds the state of a run" in run("run", "scene.yaml", "--quiet", *ANOTHER).err)
    goes_on(whole)
    check(not [name for name in os.listdir(".") if name.startswith("scene.checkpoint")], os.listdir("."))


def test_targets_of_links_are_kept():
    """Targets of links are neither replaced nor removed."""
    os.mkdir("far")
    for name in LEFT, LEFT + ".1", "scene.checkpoint.frames", "scene.checkpoint.frames.new":
        with open("far/precious", "w") as f:
            f.write("mine")
        os.symlink("far/precious", name)
        done = run("run", "scene.yaml", "--quiet", scene=SCENE % ("md", 60, 1, 0.001))
        check(done.code == 3 and name + ": cannot be written: it is a link" in done.err, done.code, done.err)
        check(content("far/precious") == b"mine" and os.path.islink(name))
        os.remove(name)


STORED = ("flow: usf\nphi: 0.2\nparticles: 500\ncollision: {e: 0.9, beta: 0}\nrun: {collisions: 200, warmup: 60}\n"
          "output: {trajectory_every: 10}\n")


def grains_of(path):
    if not h5py:
        raise Skip("no h5py")
    with h5py.File(path) as f:
        g, window = f["particles/grains"], f["graingas/window"][()]
        return {name: (g[name]["value"].dtype, g[name]["value"][()]) for name in ("position", "velocity", "spin")
                if name in g}, g["velocity/time"][()], window


def test_what_is_stored():
    """Options choose columns, precision and the part of the run; stored values are those of the whole file. The file's
    size is within a tenth of the estimate by `info`."""
    run("run", "scene.yaml", "--quiet", "--output", "whole.h5", scene=STORED)
    whole, times, window = grains_of("whole.h5")
    check(len(whole) == 3 and all(dtype == "f8" for dtype, _ in whole.values()) and times[0] < window[0] / 2, times)
    for args, fields, dtype, after in (
            ("--set=output.fields=[velocity, position]",), ("position", "velocity"), "f8", False), (
            ("--set=output.precision=single",), ("position", "velocity", "spin"), "f4", False), (
            ("--set=output.after=warmup", "--set=output.fields=[velocity]"), ("velocity",), "f8", True), (
            ("--set=output={after: warmup, precision: single, fields: [spin, velocity], trajectory_every: 10}",),
            ("velocity", "spin"), "f4", True):
        done = run("run", "scene.yaml", "--quiet", "--output", "r.h5", *args)
        check(done.code == 0 and "no effect" not in done.err, done.err)
        found, t, _ = grains_of("r.h5")
        check(sorted(found) == sorted(fields), args, sorted(found))
        kept = [k for k in range(len(times)) if times[k] in t]
        check(len(kept) == len(t) and (len(t) < len(times)) == after and (not after or t[0] >= window[0]), args, t, window)
        for name, (kind, values) in found.items():
            check(kind == dtype and (values == whole[name][1][kept].astype(dtype)).all(), args, name)
        said = re.search(r"result file: about ([\d.]+) (kB|MB), with ([\d.]+) frames", run("info", "scene.yaml", *args).out)
        size = float(said[1]) * {"kB": 1e3, "MB": 1e6}[said[2]]
        check(abs(size - os.path.getsize("r.h5")) < 0.3 * size, args, said[0], os.path.getsize("r.h5"))
        check(abs(float(said[3]) - len(t)) <= 2, args, said[0], len(t))
        check(run("info", "r.h5").code == 0)
        done = run("export", "r.h5", "--quiet")
        check(done.code == 0 and ("r.xyz" in os.listdir(".")) == ("position" in fields), args, done.err)
        if "position" in fields:
            os.remove("r.xyz")
    done = run("run", "scene.yaml", "--set", "output.fields=[position]")
    check(done.code == 2 and "key 'output.fields': velocity is missing" in done.err, done.err)
    done = run("run", "scene.yaml", "--quiet", "--set", "output={after: warmup, trajectory_every: 0}", "--output", "r.h5")
    check("output.after has no effect while output.trajectory_every is 0" in done.err, done.err)


def test_resumed_after_warmup():
    """Frames of the window alone, whole and in single precision, also where the run was cut in its warm-up or after."""
    scene = STORED + "  # cut\n"
    more = ("--set", "output={after: warmup, precision: single, trajectory_every: 10, checkpoint_every: 100}")
    run("run", "scene.yaml", "--quiet", "--output", "whole.h5", *more, scene=scene)
    whole = particles("whole.h5")
    for limit in 0.005, 0.03, 0.06:
        run("run", "scene.yaml", "--quiet", *more, "--set", f"run.time_limit={limit}")
        if not os.path.exists("scene.checkpoint.h5"):
            continue  # it was over before
        done = run("run", "scene.yaml", "--quiet", *more, "--resume", "scene.checkpoint.h5")
        check(done.code == 0, done.err)
        same("scene.h5", whole, limit)


def test_chunks_fit():
    """A frame of many grains fills its chunks: the file is as large as its data."""
    run("run", "scene.yaml", "--quiet", scene=STORED.replace("500", "50000").replace("200", "4").replace("60", "1"))
    found, _, _ = grains_of("scene.h5")
    with h5py.File("scene.h5") as f:
        stored = [f[f"particles/grains/{name}/value"].id.get_storage_size() for name in found]
    for size, (_, values) in zip(stored, found.values()):
        check(values.nbytes <= size < 1.001 * values.nbytes, size, values.nbytes)


if __name__ == "__main__":
    main(sys.modules[__name__])
