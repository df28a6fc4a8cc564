# SPDX-License-Identifier: GPL-3.0-or-later
"""Shear that starts from rest, stops, is reversed or oscillates: exact without collisions, near the Gaussian closure with
them; the balance of energy; oscillations in their limits; interrupted runs; and errors of wrong scenes."""
import glob
import json
import os
import signal
import subprocess
import sys
import time

import h5py
import numpy as np

from tap import GRAINGAS, PATIENCE, check, main, run


def curve(path, name):
    """x, value, error, reference."""
    with h5py.File(path) as file:
        group = file[f"graingas/curves/{name}"]
        return [np.array(group[k]) if k in group else None for k in ("x", "value", "stderr", "reference")]


def number(path, name, what):
    """Mean, error."""
    with h5py.File(path) as file:
        group = file[f"graingas/curves/{name}/numbers/{what}"]
        return group["mean"][()], group["stderr"][()] if "stderr" in group else 0


def free(t, strain):
    """Grains that do not collide: C_x = C_x0 - strain C_y, from <CC> = 1."""
    g = strain(t)
    return {"temperature": (3 + g ** 2) / 3, "P_xy": -g, "P_xx": 1 + g ** 2, "P_yy": 1 + 0 * t}


def test_free_flight():
    """A protocol from rest through reversal to rest, in units of the largest rate; and a formula."""
    protocol = "shear_rate: 0, protocol: [{at: 1, shear_rate: 2}, {at: 2, shear_rate: -1}, {at: 5, shear_rate: 0}]"
    for text, unit, strain in (
            (protocol, 2, lambda t: 2 * np.clip(t - 1, 0, 1) - np.clip(t - 2, 0, 3)),
            ('shear_rate: "1.5*cos(t)"', 1.5, lambda t: 1.5 * np.sin(t)),
            ('shear_rate: "2 if t < 3 else -1", shear_steps: 24', 2, lambda t: 2 * np.minimum(t, 3) - np.maximum(t - 3, 0))):
        for engine in "md", "dsmc":
            scene = """{flow: usf, engine: %s, phi: 1e-5, particles: 500, start: {temperature: 1}, collision: {e: 1},
                dsmc: {particles: 2000}, run: {duration: 8, replicas: 16}, %s}""" % (engine, text)
            done = run("run", "scene.yaml", "--output", "f.h5", scene=scene)
            check(done.code == 0, done.err)
            check(("largest absolute shear rate, %g" % unit) in " ".join((done.out + done.err).split()), done.out, done.err)
            for name, exact in free(np.zeros(1), strain).items():
                t, value, error, _ = curve("f.h5", name + "_in_time")
                t, value, error = t[1:] / unit, value[1:], error[1:]
                check(abs(t[-1] - 8) < 1e-9, t)
                expected = free(t, strain)[name]
                scale = unit ** 2 * (1 if name == "temperature" else 1e5)  # stresses: phi T for <CC> = 1
                far = np.abs(expected) > 1e-3
                z = (value * scale - expected)[far] / np.maximum(error * scale, 1e-9)[far]
                check(np.abs(z).max() < 6 and (z ** 2).mean() < 4 and error.max() < 0.3 * np.abs(value).max(), engine, text, name, np.abs(z).max(), (z ** 2).mean())


def test_cessation_and_reversal():
    """After shear stops the stress decays, after reversal it changes its sign, and Monte Carlo is near the closure on the
    way. Work and losses are in balance. There is no viscosity, and no theory of the last state."""
    common = "{flow: usf, phi: 0.05, collision: {e: 0.9}, engine: %s, particles: 500, dsmc: {particles: 20000}, "
    for engine, replicas, most in ("dsmc", 4, 0.06), ("md", 16, 0.1):
        for rate in 0, -1:
            scene = common % engine + "run: {duration: 12, replicas: %d}, protocol: [{at: 6, shear_rate: %d}]}" % (replicas, rate)
            done = run("run", "scene.yaml", "--json", "--quiet", "--output", "c.h5", scene=scene)
            check(done.code == 0, done.err)
            results = json.loads(done.out)["results"]
            check(results["shear_viscosity"]["mean"] is None, results["shear_viscosity"])
            for name in "P_xy", "temperature", "P_xx", "pressure":
                t, value, error, theory = (a[1:] for a in curve("c.h5", name + "_in_time"))
                scale = np.abs(theory).max()
                off = np.abs(value - theory) - 5 * error
                check(off.max() < most * scale, engine, rate, name, off.max() / scale)
                if name == "P_xy":
                    before, after = value[(t > 5) & (t < 6)].mean(), value[t > 11].mean()
                    check(before < 0 and (after > -0.3 * before if rate else abs(after) < 0.1 * abs(before)), before, after)
            balance = results["energy_balance"]
            check(rate == 0 or abs(balance["mean"] - 1) < 5 * balance["stderr"] < 0.5, balance)
            theory = json.loads(run("theory", "scene.yaml", "--json", "--quiet", scene=scene).out)
            check("gaussian_closure" not in theory["theory"] or rate > 0, theory["theory"].keys())


OSCILLATION = """flow: usf
engine: dsmc
phi: 0.2
collision: {e: 0.8}
shear_rate: "sin(2*pi*t/%g)"
shear_period: %g
dsmc: {particles: 5000}
"""


def test_slow_oscillation():
    """The limit of steady shear: -P_xy = p_0 |rate| rate, whose harmonics are 8/(3 pi) p_0 and a fifth of that. The closure
    converges with the number of steps like the square of their length."""
    scene = OSCILLATION % (400, 400) + "run: {duration: 800, replicas: 4}\n"
    check(run("run", "scene.yaml", "--quiet", "--output", "s.h5", scene=scene).code == 0)
    steady = run("theory", "scene.yaml", "--json", "--quiet", "--theory", "gaussian_closure",
                 scene="{flow: usf, phi: 0.2, collision: {e: 0.8}}")
    p0 = -json.loads(steady.out)["theory"]["gaussian_closure"]["P_xy"]["mean"]
    for suffix, most in ("_of_closure", 0.01), ("", 0.04):
        amplitude, error = number("s.h5", "stress_over_strain", "stress_amplitude" + suffix)
        third, wide = number("s.h5", "stress_over_strain", "third_harmonic" + suffix)
        check(abs(amplitude / (8 / (3 * np.pi) * p0) - 1) < most and error < 0.01 * amplitude, suffix, amplitude, p0)
        check(abs(third - 0.2) < (0.01 if suffix else 4 * wide + 0.01), suffix, third, wide)
    loss = []
    for steps in 10, 20, 40, 80:
        scene = OSCILLATION % (10, 10) + "shear_steps: %d\nrun: {duration: 40, replicas: 2}\n" % steps
        check(run("run", "scene.yaml", "--quiet", "--output", "n.h5", "--set", "dsmc.particles=100", scene=scene).code == 0)
        loss.append(number("n.h5", "stress_over_strain", "loss_modulus_of_closure")[0])
    first, second, third = np.abs(np.diff(loss))
    check(3 < first / second < 5 and 3 < second / third < 5 and third < 0.003 * loss[-1], loss)


def test_frequency_and_amplitude_in_a_bath():
    """A gas that a bath keeps warm has both apart. Slow and small: G''/omega is the viscosity of steady shear at the same
    small rate, and there is no third harmonic. Fast: G' tends to a constant, while G'' grows by collisions alone. Larger
    rates heat the gas: both moduli grow. Monte Carlo has the moduli of the closure."""
    scene = """{flow: usf, engine: dsmc, phi: 0.2, collision: {e: 0.8}, thermostat: bath, bath: {drag: 0.2, temperature: 1},
        start: {temperature: %g}, shear_rate: "%g*sin(%g*t)", shear_period: %.17g, shear_steps: 40,
        dsmc: {particles: %d}, run: {duration: %.17g, replicas: 4}}"""

    def moduli(rate, omega, periods, grains, T=1):
        period = 2 * np.pi / omega
        done = run("run", "scene.yaml", "--quiet", "--output", "f.h5",
                   scene=scene % (T, rate, omega, period, grains, periods * period))
        check(done.code == 0, done.err)
        measured = [np.array(number("f.h5", "stress_over_strain", name)) * rate ** 2 for name in ("storage_modulus", "loss_modulus")]
        closure = [number("f.h5", "stress_over_strain", name + "_of_closure")[0] * rate ** 2 for name in (
            "storage_modulus", "loss_modulus")]
        return measured, closure, number("f.h5", "stress_over_strain", "third_harmonic_of_closure")[0]
    steady = run("theory", "scene.yaml", "--json", "--quiet", "--theory", "gaussian_closure", scene="""{flow: usf, phi: 0.2,
        collision: {e: 0.8}, thermostat: bath, bath: {drag: 0.2, temperature: 1}, shear_rate: 0.1}""")
    viscosity = 0.1 * json.loads(steady.out)["theory"]["gaussian_closure"]["shear_viscosity"]["mean"]
    _, (storage, loss), third = moduli(0.1, 0.02, 2, 100, 0.5)
    check(abs(loss / 0.02 / viscosity - 1) < 0.01 and 0 < storage < 0.06 * loss and third < 0.005, storage, loss, viscosity, third)
    for rate, omega in (1, 4), (6, 4):
        measured, closure, _ = moduli(rate, omega, 6, 4000)
        for (value, error), theory in zip(measured, closure):
            check(abs(value - theory) < 4 * error + 0.03 * theory and error < 0.04 * theory, rate, omega, value, error, theory)
    fast = [moduli(1, omega, 4, 100, 0.55)[1] for omega in (32, 64)]
    check(abs(fast[1][0] / fast[0][0] - 1) < 0.1 and 1.7 < fast[1][1] / fast[0][1] < 2, fast)


def test_small_oscillation():
    """The limit of linear response: G'' over the frequency is Enskog's viscosity of elastic grains. Both engines."""
    scene = """{flow: usf, phi: 0.2, particles: 500, collision: {e: 1}, start: {temperature: 30}, shear_rate: "sin(t)",
        shear_period: 6.283185307179586, shear_steps: 40, run: {duration: 25.132741228718345, replicas: 8},
        dsmc: {particles: 5000}}"""
    chi, phi = (1 - 0.1) / 0.8 ** 3, 0.2
    eta = 5 * np.sqrt(np.pi) / 96 * ((1 + 1.6 * phi * chi) ** 2 / chi + 768 / (25 * np.pi) * phi ** 2 * chi) * 1.016
    for engine, most in ("dsmc", 0.05), ("md", 0.1):
        done = run("run", "scene.yaml", "--quiet", "--output", "e.h5", "--set", "engine=" + engine, scene=scene)
        check(done.code == 0, done.err)
        T = number("e.h5", "temperature_in_period", "mean_temperature")[0]
        loss, error = number("e.h5", "stress_over_strain", "loss_modulus")
        storage, wide = number("e.h5", "stress_over_strain", "storage_modulus")
        check(abs(loss / np.sqrt(T) / eta - 1) < 4 * error / loss + 0.01 and error < most * loss, engine, loss, T, eta, error)
        check(abs(storage) < 0.2 * loss + 4 * wide, engine, storage, loss)


def written(path):
    return os.stat(path).st_mtime_ns if os.path.exists(path) else 0


OSCILLATES = "temperature_in_time", "P_xy_in_time", "spin_z_in_time", "stress_over_strain"
AGES = "autocorrelation_from_0", "autocorrelation_collisions_5", "displacement_from_5", "displacement_collisions_0"


def test_an_interrupted_run_resumes_to_the_same_bits():
    """Oscillation, and a cooling gas with functions of two times: its intervals have many parts, in which it is stopped."""
    oscillates = (OSCILLATION % (5, 5)).replace("{e: 0.8}", "{e: 0.8, beta: 0.3}") + "shear_steps: 40\nrun: {duration: 20, replicas: 2}\n"
    cools = """{flow: hcs, engine: dsmc, phi: 0.1, collision: {e: 0.8}, measure: [rheology, diffusion],
        dsmc: {particles: 5000}, run: {duration: 500, replicas: 2}, """
    for gas, engine, names in [(oscillates, engine, OSCILLATES) for engine in ("md", "dsmc")] + [(cools, e, AGES) for e in ("md", "dsmc")]:
        scene = gas.replace("engine: dsmc", "engine: " + engine)
        scene += "particles: 4000, output: {checkpoint_every: 0.02}}\n" if gas is cools else "particles: 400\noutput: {checkpoint_every: 0.02}\n"
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
            while process.poll() is None and (cuts >= 5 or written("cut.checkpoint.h5") == before):
                time.sleep(0.005)
            process.send_signal(signal.SIGINT)
            err = process.communicate(timeout=100 * PATIENCE)[1]
            if process.returncode == 0:
                break
            check(process.returncode == 130, process.returncode, err)
            cuts += 1
        check(cuts > 0 and process.returncode == 0, cuts, err)
        for name in names:
            one, other = (curve(path, name) for path in ("whole.h5", "cut.h5"))
            check(all(np.array_equal(a, b, equal_nan=True) for a, b in zip(one[:3], other[:3])), engine, name)


def test_errors():
    usf = "{flow: usf, phi: 0.1, "
    for scene, words in (
            (usf + "shear_rate: -1}", "'shear_rate': -1 is not allowed here; allowed: above 0"),
            (usf + "shear_rate: 0, run: {duration: 5}}", "'shear_rate': 0 is not allowed here"),
            (usf + 'shear_rate: "sin(x)", run: {duration: 5}}', "neither a number nor a formula of t: 'sin(x)' at character 5"),
            (usf + 'shear_rate: "sin(t)"}', "a formula needs flow: usf and run.duration"),
            (usf + 'shear_rate: "0*t", run: {duration: 5}}', "is 0 all the time"),
            (usf + 'shear_rate: "1/t", run: {duration: 5}}', "infinite or not a number at some time"),
            (usf + 'shear_rate: "sin(t)", shear_period: 2, run: {duration: 5}}', "run.duration 5 has 2.5 of them"),
            (usf + 'shear_rate: "sin(t)", run: {duration: 5}, protocol: [{at: 1, shear_rate: 2}]}', "shear_rate is a formula"),
            (usf + "run: {duration: 5}, protocol: [{at: 1, shear_rate: 1e-5}]}", "not allowed on the way from 1; allowed"),
            ("{flow: heated_shear, phi: 0.1, run: {duration: 5}, protocol: [{at: 1, shear_rate: -1}]}", "shear_rate")):
        done = run("run", "scene.yaml", "--quiet", scene=scene)
        check(done.code == 2 and words in " ".join(done.err.split()), scene, done.code, done.err)


if __name__ == "__main__":
    main(sys.modules[__name__])
