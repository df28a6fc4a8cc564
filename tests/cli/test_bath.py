# SPDX-License-Identifier: GPL-3.0-or-later
"""Gases in a bath: what noise, shear and drag bring is what collisions take and the grains keep, in both engines.
Diffusion of a gas and of tracers in it: Monte Carlo beside md and theory."""
import json
import sys

from tap import check, main, run

BALANCE = {
    "bath": "flow: hss\nthermostat: bath\nbath: {drag: 0.3, temperature: 1}\ncollision: {e: 0.8}\n",
    "rough": "flow: hss\nthermostat: bath\nbath: {drag: 0.3, temperature: 1, rotation: 0.5}\ncollision: {e: 0.8, beta: 0.2}\n",
    "noise": "flow: hss\nthermostat: white_noise\ncollision: {e: 0.8}\n",
    "mixture": "flow: hss\nthermostat: bath\nbath: {drag: 0.3, temperature: 1}\ncollision: {e: 0.8}\n"
               "species: [{fraction: 0.5, drag: 2}, {fraction: 0.5, mass: 3}]\n",
    "sheared": "flow: usf\nthermostat: bath\nbath: {drag: 0.2, temperature: 5, rotation: 1}\ncollision: {e: 0.7, beta: 0.2}\n",
    "warmed": "flow: heated_shear\ncollision: {e: 0.8}\n",
}


def compared(scene):
    done = run("compare", "scene.yaml", "--json", "--quiet", "--output", "c.h5", scene=scene)
    check(done.code == 0, done.err)
    return json.loads(done.out)


def results_of(scene, engine):
    done = run("run", "scene.yaml", "--json", "--quiet", "--engine", engine, "--output", "r.h5", scene=scene)
    check(done.code == 0, done.err)
    return json.loads(done.out)["results"]


def test_energy_balance():
    """1 within errors, which are small."""
    for name, scene in BALANCE.items():
        for engine in "md", "dsmc":
            gas = scene + "phi: 0.2\nparticles: 1000\nrun: {collisions: 400}\n"
            found = results_of(gas, engine)["energy_balance"]
            check(abs(found["mean"] - 1) < 5 * found["stderr"] + 1e-3 and found["stderr"] < 0.03, name, engine, found)
    free = results_of("flow: hss\nphi: 0.2\nparticles: 1000\ncollision: {e: 0.8}\nrun: {collisions: 300}\n", "md")
    check("nothing does work" in str(free["energy_balance"]), free["energy_balance"])


GAS = "phi: %g\nparticles: 1000\nmeasure: [rheology, diffusion]\nrun: {collisions: 1000}\n"


def coefficient(one, kind, of):
    """Mean over the components: value, error and the first Sonine approximation."""
    curves = [one["curves"][f"velocity_autocorrelation_C{a}{of}"]["numbers"] for a in "xyz"]
    found = [c[kind] for c in curves]
    return (sum(n["mean"] for n in found) / 3, sum(n["stderr"] ** 2 for n in found) ** 0.5 / 3,
            curves[0]["diffusion_first_sonine"]["mean"])


def test_dsmc_has_enskogs_diffusion():
    """Monte Carlo has Enskog's coefficient: elastic grains 1.019 times the first Sonine approximation (Chapman &
    Cowling), at finite density and at none. In a bath a grain loses its velocity to that, too."""
    for scene, most in (("flow: equilibrium\n" + GAS % 0.1, 0), ("flow: equilibrium\n" + GAS % 0, 0),
                        (BALANCE["bath"] + GAS % 0.1, 0.03)):
        done = run("run", "scene.yaml", "--json", "--quiet", scene="engine: dsmc\n" + scene)
        check(done.code == 0, done.err)
        D, error, theory = coefficient(json.loads(done.out), "diffusion_green_kubo", "")
        expected = theory if most else 1.019 * theory
        check(error < 0.01 * D and abs(D - expected) < 5 * error + most * theory, scene, D, error, expected)


def test_engines_agree_on_tracers():
    """Twenty heavy grains among a thousand: both engines agree, and with theory of the temperatures measured. Heavy
    inelastic grains are hotter in a bath than the gas."""
    scene = BALANCE["bath"] + GAS % 0.05 + "species: [{fraction: 0.98}, {fraction: 0.02, mass: 5, diameter: 1.5}]\n" \
        "dsmc: {particles: 16000}\n"
    both = compared(scene)
    (md, dm, theory), (dsmc, dd, same) = (coefficient(both[e], "diffusion_green_kubo", "_2") for e in ("md", "dsmc"))
    check(abs(md - dsmc) < 5 * (dm ** 2 + dd ** 2) ** 0.5, md, dm, dsmc, dd)
    check(abs(dsmc - same) < 5 * dd + 0.05 * same and dd < 0.15 * dsmc, dsmc, dd, same)
    for engine in "md", "dsmc":
        T = [both[engine]["results"][f"temperature_{k}"] for k in (1, 2)]
        check(T[1]["mean"] - T[0]["mean"] > 3 * T[1]["stderr"], engine, T)
    z = next(row["md_dsmc_z"] for row in both["comparison"] if row["quantity"] == "temperature_2")
    check(abs(z) < 5, z)


if __name__ == "__main__":
    main(sys.modules[__name__])
