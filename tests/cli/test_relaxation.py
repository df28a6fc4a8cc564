# SPDX-License-Identifier: GPL-3.0-or-later
"""run.duration and protocol: curves in time are means over replicas and agree with solutions in closed form. An
interrupted run continues across a step of the protocol bit for bit."""
import glob
import json
import os
import re
import signal
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

from tap import GRAINGAS, PATIENCE, check, main, run

# Without losses dT/dt = 2 drag (T_b - T).
ELASTIC = """flow: hss
engine: %s
phi: 0.05
particles: 500
thermostat: bath
bath: {drag: 0.2, temperature: 2}
temperature: 0.5
collision: {e: 1}
dsmc: {particles: 5000}
protocol: [{at: 4.03, bath.temperature: 0.2}, {at: 7, bath.drag: 0.5, bath.temperature: 1}]
run: {duration: 10, replicas: 16}
"""


KICKED = """flow: hss
engine: %s
phi: 0.05
particles: 1000
dsmc: {particles: 40000}
species: [{torque: 0.2}]
collision: {e: 0.9, beta: 0}
start: {temperature: 1, spin: 1}
run: {duration: 10, replicas: 4, seed: 5}
protocol: [{at: 3.03, collision.normal_kick: 0.1, collision.tangential_kick: -0.2}, {at: 7, collision.e: 0.7}]
"""


def exact(t):
    T = 2 - 1.5 * np.exp(-0.4 * np.minimum(t, 4.03))
    T = np.where(t > 4.03, 0.2 + (T - 0.2) * np.exp(-0.4 * (np.clip(t, 4.03, 7) - 4.03)), T)
    return np.where(t > 7, 1 + (T - 1) * np.exp(-(t - 7)), T)


def curve(path, name, engine=""):
    """x, value, error."""
    with h5py.File(path) as file:
        group = file[f"graingas/{engine}/curves/{name}"]
        return [np.array(group[k]) for k in ("x", "value", "stderr")]


def test_exact_course():
    """Both engines, times of changes included; the errors are those of the mean. The start is exact."""
    for engine in "md", "dsmc":
        done = run("run", "scene.yaml", "--quiet", "--output", "r.h5", scene=ELASTIC % engine)
        check(done.code == 0, done.err)
        t, T, error = curve("r.h5", "temperature_in_time")
        check(len(t) == 102 and t[0] == 0 and t[-1] == 10 and 4.03 in t, t)
        z = (T[1:] - exact(t[1:])) / error[1:]
        check(abs(T[0] - 0.5) < 1e-9 and np.abs(z).max() < 6 and (z ** 2).mean() < 3, engine, T[0], np.abs(z).max(), (z ** 2).mean())
        check(error[1:].max() < 0.02 * T.max(), error.max())


def free_shear(t):
    """Curves of grains that do not collide: drag 0.5 and a bath of 1 from M = 1, shear rate 2 until 3, then 0.5."""
    xy, xx, found = 0.0, 1.0, []
    for a, gone in ((2, np.minimum(t, 3)), (0.5, np.maximum(t - 3, 0))):
        fade, lag = np.exp(-gone), xy + a
        xy, xx = lag * fade - a, 1 + 2 * a * a * (1 - fade) - 2 * a * lag * gone * fade + (xx - 1) * fade
    return {"temperature": (xx + 2) / 3, "P_xx": xx, "P_yy": 1 + 0 * t, "P_xy": xy, "pressure": (xx + 2) / 3,
            "N1": 3 * (xx - 1) / (xx + 2), "N2": 0 * t, "shear_viscosity": -xy / np.where(t > 3, 0.5, 2)}


def test_shear_rate():
    """It changes on the way, and the unit of time stays: exact without collisions, in both engines."""
    scene = """{flow: usf, engine: %s, phi: 1e-5, particles: 500, shear_rate: 2, temperature: 1, collision: {e: 1},
        thermostat: bath, bath: {drag: 0.5}, dsmc: {particles: 2000}, protocol: [{at: 3, shear_rate: 0.5}],
        run: {duration: 8, replicas: 16}}"""
    for engine in "md", "dsmc":
        done = run("run", "scene.yaml", "--quiet", "--output", "f.h5", scene=scene % engine)
        check(done.code == 0, done.err)
        units = {"temperature": 4, "N1": 1, "N2": 1, "shear_viscosity": 2 / 1e-5}
        for name in free_shear(np.zeros(1)):
            t, value, error = (a[1:] for a in curve("f.h5", name + "_in_time"))
            check(abs(t[-1] - 16) < 1e-12 and 6 in t, t)
            unit = units.get(name, 4 / 1e-5)
            z = (value * unit - free_shear(t / 2)[name]) / (error * unit)
            check(np.abs(z).max() < 6 and 0.2 < (z ** 2).mean() < 3, engine, name, np.abs(z).max(), (z ** 2).mean())


def test_shear_rate_scales():
    """A steady gas sheared twice as fast has four times the temperature: theories of the last rate, both engines, and
    the images of a stored box follow the strain."""
    scene = """{flow: usf, engine: %s, phi: 0.05, particles: 200, shear_rate: 0.5, collision: {e: 0.7, beta: 0},
        dsmc: {particles: 5000}, run: {duration: 80, replicas: 8}, protocol: [{at: 40, shear_rate: 1}],
        output: {trajectory_every: 5}}"""
    at_once, changed = (json.loads(run("theory", "scene.yaml", "--json", "--quiet", *arguments, scene=scene % "md").out)
                        for arguments in (["--set", "protocol=[]"], []))
    for name, values in at_once["theory"].items():
        for quantity, power in ("temperature", 4), ("shear_viscosity", 2), ("P_xy", 4), ("N1", 1), ("temperature_ratio", 1):
            one, two = (of["theory"][name].get(quantity) for of in (at_once, changed))
            if isinstance(one, dict):
                check(abs(two["mean"] - power * one["mean"]) <= 1e-6 * abs(two["mean"]), name, quantity, one, two)
    expected = changed["theory"]["enskog_hermite"]["temperature"]["mean"]
    for engine in "md", "dsmc":
        done = run("run", "scene.yaml", "--quiet", "--output", "v.h5", scene=scene % engine)
        check(done.code == 0, done.err)
        t, T, error = curve("v.h5", "temperature_in_time")
        last = T[-20:].mean()
        check(abs(last / expected - 1) < (0.1 if engine == "md" else 0.03), engine, last, expected)
        if engine == "md":
            with h5py.File("v.h5") as file:
                box = file["particles/grains/box/edges"]
                t, edges = np.array(box["time"]), np.array(box["value"])
            check(t[-1] > 30 and t[0] < 15, t)
            slid = (np.where(t < 20, t, 20 + 2 * (t - 20)) * edges[:, 1, 1] - edges[:, 1, 0]) / edges[:, 0, 0]
            check(np.abs(slid - np.round(slid)).max() < 1e-9, slid)


def number(path, name, what):
    """Mean, error."""
    with h5py.File(path) as file:
        group = file[f"graingas/curves/{name}/numbers/{what}"]
        return np.array([group["mean"][()], group["stderr"][()]])


def test_diffusion_after_change():
    """Three times the shear rate: D three times as large, the same free paths in the laboratory. Displacements and
    velocities of the laboratory are those of the present flow."""
    scene = """{flow: usf, engine: md, phi: 0.1, particles: 200, collision: {e: 0.7}, run: {duration: %g, replicas: 8},
        measure: [rheology, diffusion, collisions], protocol: %s}"""
    for path, text in ("d3.h5", scene % (20, "[{at: 2, shear_rate: 3}]")), ("d1.h5", scene % (35, "[]")):
        done = run("run", "scene.yaml", "--quiet", "--output", path, scene=text)
        check(done.code == 0, done.err)
    for name, what, power, sight in (("velocity_autocorrelation_Cx", "diffusion_green_kubo", 3, 2.5),
                                     ("displacement_squared_x", "diffusion_einstein", 3, 5),
                                     ("free_path_laboratory", "mean_free_path_laboratory", 1, 0.05)):
        (changed, error), reference = number("d3.h5", name, what), power * number("d1.h5", name, what)
        error = np.hypot(error, reference[1])
        check(abs(changed - reference[0]) < 4 * error < sight, name, changed, reference, error)


def test_conductivity_after_change():
    """Heat conductivity of the gas after the change, from e = 0.98 to 0.4: that of theory."""
    scene = """{flow: hcs, engine: dsmc, phi: 0.3, collision: {e: 0.98}, dsmc: {particles: 4000},
        run: {duration: 12, replicas: 8}, protocol: [{at: 3, collision.e: 0.4}], measure: [rheology, conductivity]}"""
    done, theory = (run(command, "scene.yaml", "--json", "--quiet", scene=scene) for command in ("run", "theory"))
    check(done.code == 0 and theory.code == 0, done.err, theory.err)
    name = "thermal_conductivity_reduced"
    found = json.loads(done.out)["results"][name]
    theory = json.loads(theory.out)["theory"]["enskog_hermite"][name]["mean"]
    check(abs(found["mean"] - theory) < 4 * found["stderr"] < 0.3 * theory, found, theory)


def test_gas_that_has_it():
    """Observables measure after the last change what that state allows; `info` and the run name what they cannot measure."""
    scene = """{flow: usf, engine: md, phi: 0.1, particles: 100, collision: {e: %s}, run: {duration: 10},
        measure: [rheology, diffusion], protocol: [{at: 5, collision.e: %s}]}"""
    for one, two in (1, 0.8), (0.8, 1):
        told = "diffusion is not measured: a gas that heats up has no stationary velocity correlation"
        for command in "info", "run":
            arguments = [] if command == "info" else ["--output", "g.h5"]
            done = run(command, "scene.yaml", *arguments, scene=scene % (one, two))
            check(done.code == 0 and (told in " ".join((done.out + done.err).split())) == (two == 1), command, one, two, done.out)
        with h5py.File("g.h5") as file:
            check(("displacement_squared_x" in file["graingas/curves"]) == (two < 1), list(file["graingas/curves"]))


def test_log_columns():
    """A log keeps its columns, whatever quantities the present thermostat has."""
    scene = """{flow: hss, engine: dsmc, phi: 0.1, collision: {e: 0.8}, dsmc: {particles: 300}, thermostat: gaussian,
        run: {duration: 10, replicas: 2}, output: {log: l.csv},
        protocol: [{at: 5, thermostat: bath, bath.drag: 0.2, bath.temperature: 1}]}"""
    done = run("run", "scene.yaml", "--quiet", "--output", "l.h5", scene=scene)
    check(done.code == 0, done.err)
    with open("l.csv") as file:
        widths = [line.count(",") for line in file]
    check(len(widths) == 101 and len(set(widths)) == 1, widths)


def test_given_step():
    """A step of Monte Carlo that is longer than the time from one sample to the next ends with it."""
    done = run("run", "scene.yaml", "--quiet", "--output", "s.h5", "--set", "dsmc.time_step=1", scene=ELASTIC % "dsmc")
    check(done.code == 0, done.err)
    t, T, error = curve("s.h5", "temperature_in_time")
    z = (T[1:] - exact(t[1:])) / error[1:]
    check(np.abs(z).max() < 6 and (z ** 2).mean() < 3, np.abs(z).max(), (z ** 2).mean())


def test_values_are_those_at_the_end():
    """Values are those at the end, and theories those of the last bath."""
    scene = (ELASTIC % "md").replace("{e: 1}", "{e: 0.8}")
    done = run("compare", "scene.yaml", "--json", "--quiet", "--output", "c.h5", scene=scene)
    check(done.code == 0, done.err)
    both = json.loads(done.out)
    for engine in "md", "dsmc":
        found = both[engine]["results"]["temperature"]
        t, T, error = curve("c.h5", "temperature_in_time", engine)
        check(abs(found["mean"] / T[-1] - 1) < 1e-12 and abs(found["stderr"] / error[-1] - 1) < 1e-9, found)
        check(found["samples"] == 16, found)
        with h5py.File("c.h5") as file:
            check(file[f"graingas/{engine}/verdict"][()] in (b"followed", "followed"))
        theory = both["theory"]["enskog_hermite"]["temperature"]["mean"]
        check(abs(found["mean"] - theory) < 5 * found["stderr"] + 0.06 * theory, found, theory)
        check("not a steady mean" not in done.out)
    told = [row for row in both["comparison"] if any(key.startswith("enskog") for key in row)]
    check(not told and "differs from Enskog" not in done.out and "no known cause" not in done.out, told)


def test_a_followed_gas_is_compared_with_the_other_engine():
    """On its way a gas is compared with the other engine, not with the state that theories describe."""
    scene = (ELASTIC % "md").replace("duration: 10", "duration: 8").replace("{e: 1}", "{e: 0.8}")
    done = run("compare", "scene.yaml", "--quiet", scene=scene)
    check(done.code == 0, done.err)
    words = "Enskog's equation", "cause", "why:", "%", "not a steady", "enskog_hermite"
    check("followed in time" in done.out and not any(word in done.out for word in words), done.out)


def test_dsmc_follows_enskogs_equation_in_time():
    """Monte Carlo follows Enskog's equation: the first Sonine approximation and two Maxwellians are beside it in time,
    within what they leave out. In free cooling T = T_0/(1 + t/t_0)^2, with Haff's t_0."""
    smooth = (ELASTIC % "dsmc").replace("{e: 1}", "{e: 0.6}").replace("5000", "20000")
    for scene in smooth, smooth.replace("{e: 0.6}", "{e: 0.9, beta: 0}"):
        check(run("run", "scene.yaml", "--quiet", "--output", "t.h5", scene=scene).code == 0)
        for name, most in ("temperature_in_time", 0.01), ("rotational_temperature_in_time", 0.03), ("a2_in_time", None):
            with h5py.File("t.h5") as file:
                group = file["graingas/curves"].get(name)
                if group is None or "reference" not in group:
                    check(name != "temperature_in_time", scene)
                    continue
                value, error, theory = (np.array(group[k]) for k in ("value", "stderr", "reference"))
            off = np.abs(value - theory) - 5 * error
            check((off - (most * theory if most else 0.003)).max() < 0, name, off.max())
    cooling = "{flow: hcs, engine: dsmc, phi: 0.1, collision: {e: 0.9}, run: {duration: 100, replicas: 16}}"
    check(run("run", "scene.yaml", "--quiet", "--output", "h.h5", scene=cooling).code == 0)
    t, T, error = curve("h.h5", "temperature_in_time")
    rate = 4 * 0.6 / np.pi * 0.95 / 0.9 ** 3 * np.sqrt(np.pi * T[0])  # 4 n d^2 chi sqrt(pi T), of Enskog
    haff = T[0] / (1 + t * rate * (1 - 0.9 ** 2) / 6) ** 2
    check(T[-1] < 0.1 * T[0] and np.abs(T / haff - 1).max() < 0.02, np.abs(T / haff - 1).max())


def test_theory_of_shear():
    """The Gaussian closure in time ends where its steady state is, after a change of the shear rate, too; Monte Carlo is
    near it on the way. So it is in mixtures, of which Maxwellians know the temperatures."""
    common = "{engine: dsmc, phi: 0.1, dsmc: {particles: 10000}, run: {duration: 60, replicas: 4}, "
    sheared = common + "flow: usf, temperature: 1, protocol: [{at: 30, shear_rate: 1.5}], "
    mixture = "species: [{fraction: 0.5}, {fraction: 0.5, mass: 8}], "
    for scene, most in ((sheared + "collision: {e: 0.8}}", 0.05),
                        (sheared + mixture + "collision: {e: 0.8}, thermostat: bath, bath: {drag: 0.3}}", 0.05),
                        (sheared + "collision: {e: 0.9, beta: 0.2}}", 0.07),
                        (common + "flow: hss, thermostat: gaussian, " + mixture + "collision: {e: 0.6}}", 0.02),
                        (common + "flow: hss, thermostat: white_noise, " + mixture + "collision: {e: 0.6}}", 0.02),
                        (common + "flow: hcs, " + mixture + "collision: {e: 0.6}}", 0.02)):
        check(run("run", "scene.yaml", "--quiet", "--output", "g.h5", scene=scene).code == 0, scene)
        flows = "usf" in scene
        closure = "theory", "scene.yaml", "--json", "--quiet", "--theory", "gaussian_closure"
        steady = json.loads(run(*closure, scene=scene).out)["theory"] if flows else {}
        beside = 0
        with h5py.File("g.h5") as file:
            for name, group in file["graingas/curves"].items():
                if "reference" not in group or not name.endswith("_in_time"):
                    continue
                beside += 1
                value, error, theory = (np.array(group[k])[1:] for k in ("value", "stderr", "reference"))
                off = np.abs(value / theory - 1) - 5 * np.nan_to_num(error / np.abs(theory), nan=0)
                check((off < most).mean() > 0.95, scene, name, np.sort(off)[-5:])
                end = steady.get("gaussian_closure", {}).get(name[:-len("_in_time")])
                check(end is None or abs(theory[-1] / end["mean"] - 1) < 1e-3, scene, name, theory[-1], end)
        check(beside >= 2 and ("gaussian_closure" in steady) == flows, scene, beside)


def collisions_told(scene):
    """A grain's, of graingas info."""
    return float(re.search(r"for\s+([\d.e+]+)\s+collisions\s+a\s+grain", run("info", "scene.yaml", scene=scene).out).group(1))


def test_fast_gas():
    """Theory beside a gas that comes to collide 10^4 times as often arrives at the steady state; where it takes too long
    its curve ends, and results are there in seconds. info counts the collisions of either, and of mixtures."""
    common = "{engine: dsmc, phi: 0.05, dsmc: {particles: 100}, "
    fast = common + "flow: usf, collision: {e: 0.8}, protocol: [{at: 2, shear_rate: 500}], run: {replicas: 1, duration: 4}}"
    endless = common + "flow: usf, temperature: 1, collision: {e: 1}, run: {replicas: 1, duration: 200}}"
    mixture = common + "flow: hcs, collision: {e: 0.7}, species: [{fraction: 0.5}, {fraction: 0.5, mass: 10}], run: {replicas: 1, duration: 200}}"
    for scene, ends in (fast, False), (endless, True), (mixture, False):
        done = run("run", "scene.yaml", "--quiet", "--output", "q.h5", scene=scene, timeout=30)
        check(done.code == 0, done.err)
        with h5py.File("q.h5") as file:
            theory = np.array(file["graingas/curves/temperature_in_time/reference"])
        check(np.isfinite(theory[:5]).all() and np.isnan(theory[-1]) == ends, scene, theory)
        number, unit = re.search(r"([\d.]+) ([kMG]?) ?collisions averaged", done.out).groups()
        made = float(number) * {"": 1, "k": 1e3, "M": 1e6, "G": 1e9}[unit] / 50
        check(0.5 < collisions_told(scene) / made < 1.6 if ends else abs(collisions_told(scene) / made - 1) < 0.1, scene, made)
        if scene == fast:
            closure = "theory", "scene.yaml", "--json", "--quiet", "--theory", "gaussian_closure"
            steady = json.loads(run(*closure, scene=scene).out)["theory"]
            check(abs(theory[-1] / steady["gaussian_closure"]["temperature"]["mean"] - 1) < 1e-5, theory[-1], steady)


def test_after_changes():
    """The gas after the last change has a curve of its own, and the cost counts the followed time."""
    done = run("run", "scene.yaml", "--quiet", "--output", "k.h5", scene=ELASTIC % "dsmc")
    check(done.code == 0, done.err)
    (t, T, _), (since, tail, _) = curve("k.h5", "temperature_in_time"), curve("k.h5", "temperature_after_changes")
    check(since[0] == 7 and np.array_equal(t[t >= 7], since) and np.array_equal(T[t >= 7], tail), since, tail)
    collided = float(re.search(r"([\d.]+) ([kM]) collisions", done.out).group(1)) * (1e3 if " k collisions" in done.out else 1e6)
    expected = collisions_told(ELASTIC % "dsmc") * 16 * 5000 / 2
    check(abs(expected / collided - 1) < 0.05, expected, collided)


def test_default_replicas():
    """A gas that is followed has eight replicas unless the scene says how many, so values have errors; its picture has no
    averaging window, which that of a steady gas has."""
    scene = "{flow: hss, engine: dsmc, phi: 0.1, dsmc: {particles: 1000}, thermostat: bath, run: {%s}}"
    folder = tempfile.mkdtemp()
    with open(os.path.join(folder, "gnuplot"), "w") as file:
        file.write("#!/bin/sh\ncat >> drawn.txt\nexit 1\n")
    os.chmod(os.path.join(folder, "gnuplot"), 0o755)
    for length, shaded in ("duration: 5", False), ("collisions: 50", True):
        done = run("run", "scene.yaml", "--quiet", "--json", "--output", "r.h5", scene=scene % length)
        check(done.code == 0 and "(?)" not in done.out, done.err)
        results = json.loads(done.out)
        check(results["scene"]["run"]["replicas"] == (1 if shaded else 8), results["scene"]["run"])
        check(results["results"]["temperature"]["stderr"] > 0, results["results"]["temperature"])
        if os.path.exists("drawn.txt"):
            os.remove("drawn.txt")
        path, os.environ["PATH"] = os.environ["PATH"], folder + ":" + os.environ["PATH"]
        run("plot", "r.h5")
        os.environ["PATH"] = path
        with open("drawn.txt") as file:
            drawn = file.read()
        check(("averaging window" in drawn) == shaded and "temperature" in drawn, drawn[:2000])


def test_theory_ends():
    """Theories with a constant e have no curve once the protocol changes to a law of restitution."""
    scene = ("{flow: hcs, engine: dsmc, phi: 0.1, collision: {e: 0.9}, dsmc: {particles: 1000}, "
             "run: {duration: 20, replicas: 2}, protocol: [{at: 10, collision.law: viscoelastic}]}")
    done = run("run", "scene.yaml", "--quiet", "--output", "l.h5", scene=scene)
    check(done.code == 0, done.err)
    with h5py.File("l.h5") as file:
        group = file["graingas/curves/temperature_in_time"]
        t, theory = (np.array(group[k]) for k in ("x", "reference"))
    check(np.array_equal(np.isfinite(theory), t <= 10), t, theory)


def test_two_replicas():
    """Two stresses at one instant, close to each other by chance, are no inhomogeneous gas."""
    scene = "{flow: hcs, engine: md, phi: 0.05, particles: 100, collision: {e: 0.9}, run: {duration: 10, replicas: 2}}"
    for seed in range(1, 9):
        done = run("run", "scene.yaml", "--quiet", "--set", f"run.seed={seed}", scene=scene)
        check(done.code == 0 and "not homogeneous" not in done.err, seed, done.err)


def test_out_of_time():
    """A run shorter than run.duration reports so, and the time of its values."""
    scene = (ELASTIC % "md").replace("duration: 10", "duration: 1e9").replace("replicas: 16", "replicas: 1, time_limit: 1")
    done = run("run", "scene.yaml", "--quiet", "--output", "o.h5", "--set", "particles=100", scene=scene)
    check(done.code == 1 and "short of run.duration" in done.err and "run.collisions" not in done.err, done.code, done.err)
    check("at the end" not in done.out and "values are those at time" in done.out, done.out)


def test_long_start():
    """A start that takes long shows that grains are placed, and ends with the time limit."""
    done = run("run", "scene.yaml", "--output", "d.h5", scene="{flow: hcs, phi: 0.6, particles: 100000, collision: "
               "{e: 0.9}, run: {duration: 10, replicas: 1, time_limit: 1}}")
    check(done.code == 1 and "time limit reached before the start was done" in done.err, done.code, done.err)
    check("md places grains, limit in " in done.err, done.err)


def test_cooling_mixture():
    """Temperatures of species decay with that of all grains, which is their mean."""
    scene = ("{flow: hcs, engine: %s, phi: 0.1, particles: 200, collision: {e: 0.7}, dsmc: {particles: 1000}, "
             "species: [{fraction: 0.5}, {fraction: 0.5, mass: 10}], run: {duration: 100, replicas: 4}}")
    for engine in "md", "dsmc":
        done = run("run", "scene.yaml", "--quiet", "--output", "m.h5", scene=scene % engine)
        check(done.code == 0, done.err)
        T, light, heavy = (curve("m.h5", name + "_in_time")[1] for name in ("temperature", "temperature_1", "temperature_2"))
        check(T[-1] < T[0] / 16 and np.allclose((light + heavy) / 2, T, rtol=1e-6), engine, T[-1], light[-1], heavy[-1])
        check((heavy[20:] > light[20:]).all(), engine)


def written(path):
    """When; 0: it is not there."""
    return os.stat(path).st_mtime_ns if os.path.exists(path) else 0


def test_an_interrupted_protocol_resumes_to_the_same_bits():
    """Interrupted before, between and after changes: the same bits. Daily either engine has one of the two flows."""
    for engine in "md", "dsmc":
        if engine == "dsmc" or "NIGHTLY" in os.environ:
            resumed(engine, (ELASTIC % engine).replace("{e: 1}", "{e: 0.9, beta: 0}"))
        if engine == "dsmc" and "NIGHTLY" not in os.environ:
            continue
        sheared = "shear_rate: 2\n" + (ELASTIC % engine).replace("hss", "usf").replace("{at: 7,", "{at: 7, shear_rate: 1,")
        resumed(engine, sheared.replace("{e: 1}", "{e: 0.9, beta: 0}"))


def test_kicks_and_torques_resume_across_changes_to_the_same_bits():
    """A torque alone, then kicks that begin and change; a start with a mean spin. Daily dsmc alone."""
    for engine in ["md"] * ("NIGHTLY" in os.environ) + ["dsmc"]:
        resumed(engine, KICKED % engine)


def resumed(engine, scene):
    scene += "output: {checkpoint_every: 0.02}\n"
    for left in glob.glob("cut.*"):
        os.remove(left)
    check(run("run", "scene.yaml", "--quiet", "--output", "whole.h5", scene=scene).code == 0, engine)
    cuts = 0
    for _ in range(60):
        command = [GRAINGAS, "run", "scene.yaml", "--quiet", "--output", "cut.h5"]
        before = written("cut.checkpoint.h5")
        if before:
            command += ["--resume", "cut.checkpoint.h5"]
        process = subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
        while process.poll() is None and (cuts >= 8 or written("cut.checkpoint.h5") == before):
            time.sleep(0.005)
        process.send_signal(signal.SIGINT)
        err = process.communicate(timeout=100 * PATIENCE)[1]
        if process.returncode == 0:
            break
        check(process.returncode == 130, process.returncode, err)
        cuts += 1
    check(cuts > 0 and process.returncode == 0, cuts, err)
    for name in "temperature_in_time", "rotational_temperature_in_time", "P_xy_in_time" if "usf" in scene else "a2_in_time":
        one, other = (curve(path, name) for path in ("whole.h5", "cut.h5"))
        check(all(np.array_equal(a, b, equal_nan=True) for a, b in zip(one, other)), engine, name)


def test_table_of_a_followed_gas():
    """md is compared with dsmc of the same time, and no theory of the steady state stands beside. The picture has both
    engines in one panel."""
    scene = """{flow: hcs, phi: 0.4, collision: {e: 0.9, beta: 0}, particles: 500, dsmc: {particles: 20000},
        start: {temperature: 1, rotational_temperature: 0.5}, run: {duration: 15, replicas: 8}}"""
    done = run("compare", "scene.yaml", "--quiet", "--output", "t.h5", "--picture", "t.svg", scene=scene)
    check(done.code == 0, done.err)
    table = done.out.split("(..)")[0]
    check(re.search(r"^temperature_ratio .*\+\d+\.\d!$", table, re.M), table)
    check("enskog" not in table and "%" not in table and "  - the gas swirls" in done.out, done.out)
    with open("t_relaxation.svg") as file:
        words = re.sub("<[^>]*>", " ", file.read())
    check("md" in words.split() and "dsmc" in words.split() and "points" in words and "not steady" not in words, words)


if __name__ == "__main__":
    main(sys.modules[__name__])
