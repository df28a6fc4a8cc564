#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Accuracy of the time left that a run reports. To be run by hand, on an idle machine:

    taskset -c 0 validation/stability/time_left.py build/libgraingas.so [SEED [NAME ...]]

Runs of every kind, each some seconds. Reports between a quarter and 95 % of each run are judged: the fraction that
has a time left, the fraction of those within 30 % of the true one, the worst ratio. FELL: the reported fraction of
work decreased. In a comparison each engine counts as a run."""
import ctypes as c
import math
import os
import sys
import tempfile
import time

SCENES = {
    "usf": "flow: usf, phi: 0.2, particles: 1000, run: {relative_error: 0.003}",
    "usf rough": "flow: usf, phi: 0.1, particles: 1000, collision: {beta: 0}, run: {relative_error: 0.003}",
    "usf friction": "flow: usf, phi: 0.3, particles: 500, collision: {beta: 0.5, mu: 0.3}, run: {relative_error: 0.004}",
    "usf large": "flow: usf, phi: 0.3, particles: 4000, run: {relative_error: 0.005}",
    "usf small": "flow: usf, phi: 0.1, particles: 50, run: {relative_error: 0.01}",
    "usf nearly smooth": "flow: usf, phi: 0.1, particles: 300, collision: {beta: -0.9}, run: {relative_error: 0.02}",
    "equilibrium": "flow: equilibrium, phi: 0.3, particles: 1000, run: {collisions: 10000}",
    "hcs": "flow: hcs, phi: 0.1, particles: 1000, collision: {e: 0.95}, run: {relative_error: 0.003}",
    "hss": "flow: hss, phi: 0.1, particles: 1000, run: {relative_error: 0.002}",
    "couette": "flow: couette, phi: 0.2, particles: 1000, run: {collisions: 6000}",
    "poiseuille": "flow: poiseuille, phi: 0.2, particles: 500, gravity: [0.05, 0, 0], run: {collisions: 8000}",
    "chute": "flow: chute, phi: 0.2, particles: 500, gravity: [0.5, -1, 0], run: {collisions: 6000, warmup: 1000}",
    "species": "flow: usf, phi: 0.1, particles: 500, species: [{fraction: 0.5}, {fraction: 0.5, mass: 4}], "
               "run: {relative_error: 0.005}",
    "curves": "flow: usf, phi: 0.1, particles: 1000, collision: {beta: 0}, measure: [rheology, velocity_distributions, "
              "diffusion, pair_correlation], run: {collisions: 2500}",
    "long warm-up": "flow: usf, phi: 0.1, particles: 1000, run: {warmup: 4000, collisions: 4000}",
    "time limit": "flow: usf, phi: 0.1, particles: 1000, run: {relative_error: 0.0001, time_limit: 4}",
    "replicas": "flow: usf, phi: 0.1, particles: 300, run: {relative_error: 0.003, replicas: 8}",
    "dsmc usf": "engine: dsmc, flow: usf, phi: 0.1, dsmc: {particles: 5000}, run: {relative_error: 0.001}",
    "dsmc rough": "engine: dsmc, flow: usf, phi: 0, collision: {beta: 0}, dsmc: {particles: 5000}, "
                  "run: {relative_error: 0.001}",
    "dsmc hcs": "engine: dsmc, flow: hcs, phi: 0.1, dsmc: {particles: 5000}, run: {relative_error: 0.001}",
    "dsmc white noise": "engine: dsmc, flow: hss, thermostat: white_noise, phi: 0.1, dsmc: {particles: 5000}, "
                        "run: {relative_error: 0.001}",
    "dsmc large": "engine: dsmc, flow: usf, phi: 0.05, dsmc: {particles: 50000}, run: {relative_error: 0.001}",
    "dsmc replicas": "engine: dsmc, flow: usf, phi: 0.1, dsmc: {particles: 1000}, "
                     "run: {relative_error: 0.001, replicas: 4}",
    "compare": "flow: usf, phi: 0.05, particles: 1000, dsmc: {particles: 2000}, run: {relative_error: 0.003}",
    "compare at once": "flow: usf, phi: 0.05, particles: 1000, dsmc: {particles: 2000}, run: {relative_error: 0.004}",
    "resumed": "flow: usf, phi: 0.1, particles: 1000, run: {relative_error: 0.0025}",
}


class Progress(c.Structure):
    _fields_ = [("engine", c.c_char_p), ("phase", c.c_char_p), ("fraction", c.c_double), ("collisions", c.c_uint64),
                ("rate", c.c_double), ("relative_error", c.c_double), ("time_left", c.c_double),
                ("replicas", c.c_int64), ("next", c.c_char_p)]


PROGRESS = c.CFUNCTYPE(c.c_int, c.c_void_p, c.POINTER(Progress))


class Options(c.Structure):
    _fields_ = [("threads", c.c_int), ("output", c.c_char_p), ("checkpoint", c.c_char_p), ("resume", c.c_char_p),
                ("command", c.c_char_p), ("context", c.c_void_p), ("progress", PROGRESS), ("stop", c.c_void_p),
                ("stored", c.c_void_p), ("warn", c.c_void_p), ("spare", c.c_void_p * 8)]


def watch(library, text, seed, compare=False, threads=1, **files):
    """Run a scene; returns its start and, by engine, a list of (clock, fraction, time left). files['until']: fraction
    at which to interrupt it."""
    scene, what, message = c.c_void_p(), c.c_void_p(), c.create_string_buffer(2048)
    until = files.pop("until", 2)
    reports = {}

    def progress(_, now):
        n = now.contents
        reports.setdefault(n.engine.decode(), []).append((time.monotonic(), n.fraction, n.time_left))
        return n.fraction >= until

    if library.gg_scene_parse(("{%s}" % text).encode(), b"scene", c.byref(scene), message):
        sys.exit(message.raw[4:].split(b"\0")[0].decode())
    library.gg_scene_set(scene, b"run.seed", str(seed).encode(), None)
    options = Options(threads=threads, progress=PROGRESS(progress), **files)
    call = library.gg_compare if compare else library.gg_run
    begun = time.monotonic()
    status = call(scene, c.byref(options), c.byref(what), message)
    if status not in (0, 1, 130):
        sys.exit(message.raw[4:].split(b"\0")[0].decode())
    (library.gg_comparison_free if compare else library.gg_result_free)(what)
    library.gg_scene_free(scene)
    return begun, reports


def judge(name, begun, lines):
    end = lines[-1][0]
    whole = end - begun
    late = [(t, left) for t, _, left in lines if begun + 0.25 * whole <= t <= end - 0.05 * whole]
    known = [(left / (end - t), left - (end - t)) for t, left in late if math.isfinite(left)]
    falls = any(b[1] < a[1] for a, b in zip(lines, lines[1:]))
    good = sum(abs(r - 1) <= 0.3 for r, _ in known)
    worst = max((r for r, _ in known), key=lambda r: abs(math.log(max(r, 1e-9))), default=math.nan)
    far = max((abs(d) / whole for _, d in known), default=math.nan)
    quarter = next((f for t, f, _ in lines if t >= begun + 0.25 * whole), math.nan)
    print(f"{name:22} {whole:5.1f} s  known {100 * len(known) / max(1, len(late)):4.0f} %  within 30 %: "
          f"{100 * good / max(1, len(known)):4.0f} %  worst {worst:5.2f} of the truth, off by {100 * far:3.0f} % of the run"
          f"  fraction {100 * quarter:3.0f} % at a quarter{'  FELL' if falls else ''}", flush=True)
    return len(known) and good == len(known), falls


def main():
    library = c.CDLL(os.path.abspath(sys.argv[1]))
    seed = sys.argv[2] if len(sys.argv) > 2 else "1"
    wanted = sys.argv[3:] or SCENES
    passed = fell = n = 0
    with tempfile.TemporaryDirectory() as folder:
        kept = os.path.join(folder, "c.h5").encode()
        for name in wanted:
            compare, threads, files = name.startswith("compare"), 2 if name == "compare at once" else 1, {}
            if name == "resumed":
                watch(library, SCENES[name], seed, checkpoint=kept, until=0.4)
                files = {"resume": kept}
            begun, reports = watch(library, SCENES[name], seed, compare, threads, **files)
            for engine, lines in reports.items():
                if compare and threads == 1 and engine == "dsmc":
                    begun = reports["md"][-1][0]
                ok, falls = judge(f"{name}: {engine}" if compare else name, begun, lines)
                passed, fell, n = passed + bool(ok), fell + falls, n + 1
    print(f"{passed} of {n} within 30 % throughout; the fraction fell in {fell}")


if __name__ == "__main__":
    main()
