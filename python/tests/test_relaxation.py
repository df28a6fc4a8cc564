# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves in time: starts, protocols, bands against exact results, crossings, Ctrl-C."""
import os
import signal
import threading
import warnings

import numpy as np
import pytest

import graingas as gg

BATH = dict(flow="hss", thermostat="bath", phi=0.1, e=1, temperature=1)


def bath(**keys):
    scene = gg.Scene(particles=200, **{**BATH, **keys})
    scene["dsmc.particles"], scene["bath.drag"], scene["bath.temperature"] = 200, 0.3, 0.5
    return scene


def test_elastic_gas_follows_its_bath():
    """T - T_b falls as exp(-2 drag t), also after the bath was made hotter; scatter as of a canonical gas."""
    found = gg.relax(bath(), 8, points=17, replicas=96, protocol=[(4, {"bath.temperature": 2})], threads=None)
    decay = np.exp(-0.6 * found.time)
    cold = 0.5 + 0.5 * decay
    right = np.where(found.time <= 4, cold, 2 + (cold[8] - 2) * decay / decay[8])
    for engine, series in found["temperature"].items():
        z = (series.mean - right)[1:] / series.stderr[1:]
        assert np.abs(z).max() < 4, (engine, z)
        scatter = series.values[:, -1].std(ddof=1) / (right[-1] * (2 / 600) ** 0.5)
        assert 0.75 < scatter < 1.25, (engine, scatter)
    z = found.z("temperature")[1:]
    assert np.abs(z).max() < 4 and (z ** 2).mean() > 0.1


def test_starts_are_as_asked():
    scene = gg.Scene(flow="hcs", phi=0.05, e=0.9, particles=500)
    scene["dsmc.particles"] = 20000
    found = gg.relax(scene, 0.02, points=2, replicas=4, engines=["dsmc"], start={"temperature": 3, "a2": 0.1})
    assert found["temperature"]["dsmc"].mean[0] == pytest.approx(0.5)  # the unit v_0 follows from it
    assert found.quantities == ["temperature", "a2"]
    heated = gg.relax(bath(), 0.02, points=2, replicas=4, engines=["dsmc"], start={"temperature": 3})
    assert heated["temperature"]["dsmc"].mean[0] == pytest.approx(3)
    for a2 in -0.35, -0.1, 0.1, 0.5:
        many = gg.relax(scene, 0.001, points=2, replicas=16, engines=["dsmc"], start={"a2": a2})["a2"]["dsmc"]
        assert many.mean[0] == pytest.approx(a2, abs=4 * many.stderr[0]) and many.stderr[0] < 0.004, (a2, many.mean)
    scene.species = [{"fraction": 0.5}, {"fraction": 0.5, "mass": 5}]
    mixed = gg.relax(scene, 0.02, points=2, replicas=2, start={"temperature": [1, 4]})
    for engine in "md", "dsmc":
        assert mixed["temperature_1"][engine].mean[0] == pytest.approx(1 / 5)
        assert mixed["temperature_2"][engine].mean[0] == pytest.approx(4 / 5)


def test_spins_start_as_asked():
    """Cooling of rough grains from spins at rest, or rotating about z."""
    scene = gg.Scene(flow="hcs", phi=0.05, e=0.9, beta=0, particles=500)
    scene["dsmc.particles"] = 500
    for keys in {"rotational_temperature": 0}, {"temperature": 2, "rotational_temperature": 3}:
        found = gg.relax(scene, 0.02, points=2, replicas=2, start=keys)
        for engine in "md", "dsmc":
            ratio = keys["rotational_temperature"] / keys.get("temperature", 0.5)
            assert found["temperature_ratio"][engine].mean[0] == pytest.approx(ratio, rel=0.01)
    for engine in "md", "dsmc":
        sim = gg.Simulation(scene.copy(engine=engine, **{"start.spin": 4}))
        assert sim.grains.spin[:, 2].mean() == pytest.approx(4, abs=0.2)
        assert sim.grains.spin[:, 0].mean() == pytest.approx(0, abs=0.2)


def test_cooling_is_that_of_haff():
    """T^(-1/2) grows linearly, at half of Enskog's cooling rate (4/3) sqrt(pi) n chi (1 - e^2)."""
    phi, e = 0.05, 0.95
    scene = gg.Scene(flow="hcs", phi=phi, e=e, particles=500)
    scene["dsmc.particles"] = 5000
    found = gg.relax(scene, 20, points=21, replicas=24, threads=None)
    rate = 4 / 3 * np.pi ** 0.5 * (6 * phi / np.pi) * (1 - phi / 2) / (1 - phi) ** 3 * (1 - e ** 2)
    for engine, series in found["temperature"].items():
        slope = (series.mean[1:] ** -0.5 - series.mean[0] ** -0.5) / found.time[1:]
        assert np.abs(slope[2:] / (rate / 2) - 1).max() < 0.02, (engine, slope, rate / 2)
    assert np.abs(found.z("temperature")[1:]).max() < 4.5


def test_crossing_has_the_error_of_parts():
    """The hotter of two rough gases is the colder one soon; the jackknife's error is that of the scatter of parts."""
    hot = bath(e=0.9, beta=0, temperature=1.2)
    hot["rotational_temperature"], hot["bath.temperature"], hot["dsmc.particles"] = 0.02, 0.05, 2000
    cold = hot.copy(temperature=1)
    cold["rotational_temperature"] = 3
    one, two = (gg.relax(s, 2, points=21, replicas=32, engines=["dsmc"], threads=None) for s in (hot, cold))
    when, error = one.crossing(two)
    parts = []
    for k in range(8):
        first, second = (r["temperature"]["dsmc"].values[4 * k:4 * k + 4].mean(axis=0) for r in (one, two))
        after = np.flatnonzero(first < second)[0]
        gap = (first - second)[after - 1:after + 1]
        parts.append(one.time[after - 1] + 0.1 * gap[0] / (gap[0] - gap[1]))
    assert when == pytest.approx(np.mean(parts), abs=3 * error + 0.005)
    assert 0.5 < error / (np.std(parts, ddof=1) / 8 ** 0.5) < 2
    assert np.isnan(one.crossing(one)[0])


def test_pictures_and_tables():
    pytest.importorskip("matplotlib")
    pandas = pytest.importorskip("pandas")
    found = gg.relax(bath(beta=0.5), 1, points=5, replicas=2, protocol=[(0.5, {"bath.temperature": 1})])
    ax = found.plot("temperature_ratio")
    assert len(ax.lines) == 3 and [t.get_text() for t in ax.get_legend().texts] == ["md", "dsmc"]
    assert (ax.get_xlabel(), ax.get_ylabel()) == ("time [$d/v_0$]", r"$\theta/T$")
    assert found.plot().get_ylabel() == "$T$ [$v_0^2$]"
    with pytest.raises(gg.NotFound, match="did you mean 'temperature'"):
        found.plot("temprature")
    table = found.to_dataframe()
    assert isinstance(table, pandas.DataFrame)
    assert table["md", "temperature", "mean"].iloc[0] == pytest.approx(1, abs=0.2)
    assert "2 replicas" in repr(found)
    with pytest.raises(gg.BadInput, match="both engines"):
        gg.relax(bath(), 1, points=2, replicas=2, engines="dsmc").z("temperature")


@pytest.mark.parametrize("wrong, word", [
    (dict(replicas=1), "replicas"), (dict(points=1), "points"), (dict(until=0), "until"),
    (dict(engines=["lattice"]), "lattice"),
    (dict(until="a"), "until"), (dict(engine="md"), "give engines='md'"),
    (dict(until=float("inf")), "until"), (dict(engines="lattice"), "lattice"), (dict(start={"a2": float("nan")}), "a2"),
    (dict(start={"a2": -0.4}), "a2"), (dict(start={"temperature": -1}), "temperature"),
    (dict(start={"temperature": [1, 2]}), "species"), (dict(protocol=[(2, {"bath.drag": 1})]), "time 2"),
    (dict(protocol=[(0, {"bath.drag": 1})]), "time 0"), (dict(protocol=[(1, {"bath.drag": 1})]), "time 1"),
    (dict(protocol=[(0.5, {})]), "names no key"), (dict(protocol=[(0.5, {"bath.drag": 1}), (0.2, {"bath.drag": 2})]), "order of times"),
    (dict(flow="couette"), "walls"), (dict(start={"spins": 1}), "spin"), (dict(protocol=[3]), "protocol"), (dict(protocol=[(0.5, {"phi": 0.2})]), "phi")])
def test_wrong_arguments_are_named(wrong, word):
    with pytest.raises(gg.BadInput, match=word):
        gg.relax(gg.Scene(phi=0.1, flow="couette") if "flow" in wrong else bath(),
                 **{"until": 1, "points": 2, "replicas": 2, **{k: v for k, v in wrong.items() if k != "flow"}})


def test_followed_scenes():
    """A scene's own duration and protocol belong to run(): no other call ignores them silently."""
    scene = bath()
    scene["run.duration"], scene["protocol"] = 4, [{"at": 1, "bath.temperature": 2}]
    with pytest.raises(gg.BadInput, match="run.duration and protocol, which run"):
        gg.relax(scene, 4, points=2, replicas=2)
    with pytest.warns(UserWarning, match="run.duration and protocol of the scene: no effect on a Simulation"):
        gg.Simulation(scene)
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        gg.Simulation(bath())


def test_ctrl_c_ends_relax():
    scene = bath()
    scene["dsmc.particles"] = 200000
    timer = threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT))
    timer.start()
    with pytest.raises(KeyboardInterrupt):
        gg.relax(scene, 1e6, points=3, replicas=4, engines=["dsmc"], threads=2)
