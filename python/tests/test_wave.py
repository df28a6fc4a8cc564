# SPDX-License-Identifier: GPL-3.0-or-later
"""start.wave: the box is long enough, the table of a comparison has the viscosity of both engines and of theories, and
theories beside no value of one time; a resumed run has the same bits; flows that are sheared reject the key."""
import math

import numpy as np
import pytest

import graingas as gg

SCENE = {"flow": "hcs", "phi": 0.1, "collision.e": 1, "particles": 500, "dsmc.particles": 4000, "start.wave": 0.5,
         "run.duration": 60, "run.replicas": 4}


def test_theories_stand_beside_the_viscosity_alone():
    r = gg.compare(gg.Scene(**SCENE))
    row = r["viscosity_reduced"]
    assert math.isfinite(row.md.mean) and math.isfinite(row.dsmc.mean) and math.isfinite(row.z) and abs(row.z) < 4
    assert row.deviation["enskog_hermite"] == pytest.approx(row.theory["enskog_hermite"] / row.md.mean - 1)
    assert math.isnan(r["pressure"].deviation.get("enskog_hermite", math.nan))
    for engine in r.md, r.dsmc:
        wave = engine.curves["shear_wave"]
        assert wave.value[0] == pytest.approx(0.5, rel=1e-9) and wave.x[-1] == pytest.approx(0.99 * 60)
        assert wave.numbers["wavelength"].mean >= 45 * wave.numbers["wavenumber_times_path"].mean * wave.numbers[
            "wavelength"].mean / (2 * math.pi) * (1 - 1e-9)


def test_the_wave_starts_in_both_engines():
    for engine in "md", "dsmc":
        sim = gg.Simulation(gg.Scene(**SCENE, engine=engine))
        y, c = sim.grains.position[:, 1], sim.grains.velocity
        L = sim.state.box[1]
        assert 2 * np.mean(c[:, 0] * np.sin(2 * math.pi * y / L)) == pytest.approx(0.5, rel=1e-6)
        assert np.allclose(c.mean(axis=0), 0, atol=1e-12)


def test_a_box_of_the_user_stays():
    assert gg.Scene(**SCENE, aspect=[1, 2, 1])["aspect"] == [1, 2, 1]


def test_sheared_flows_reject_a_wave():
    with pytest.raises(gg.GraingasError, match="start.wave.*allowed in flow: equilibrium"):
        gg.run(gg.Scene(**{**SCENE, "flow": "usf"}))
