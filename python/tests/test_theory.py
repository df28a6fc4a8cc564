# SPDX-License-Identifier: GPL-3.0-or-later
"""Theories alone: numbers in closed form, grids, and theories that do not apply."""
import math
import os
import signal
import threading
import time

import numpy as np
import pytest

import graingas as gg


@pytest.fixture
def shear():
    return gg.Scene(flow="usf", phi=0.1, e=0.9, beta=0)


def test_lun_in_closed_form(shear):
    """theta/T = K (1 + beta)/(1 + 2 K - beta), K = 4I/(m d^2) = 2/5."""
    for beta in -0.5, 0, 0.7:
        K = 0.4
        found = gg.theory(shear.copy(beta=beta), "lun1991")["temperature_ratio"]
        assert found == pytest.approx(K * (1 + beta) / (1 + 2 * K - beta), rel=1e-6)


def test_one_theory_has_the_numbers_of_all(shear):
    alone, together = gg.theory(shear, "lun1991"), gg.theories(shear).theories["lun1991"]
    assert dict(alone) == dict(together) and len(alone) > 3


def test_theories_that_do_not_apply(shear):
    haff = gg.theory(shear, "haff1983")
    assert "cooling" in haff.reason and list(haff) == []
    with pytest.raises(gg.NotFound, match="haff1983"):
        haff["temperature"]
    with pytest.raises(gg.NotFound, match="lun19"):
        gg.theory(shear, "lun19")


def test_haffs_law():
    """T(t) = T_0/(1 + zeta t/2)^2, T_0 = 1/2."""
    haff = gg.theory(gg.Scene(flow="hcs", phi=0.1, e=0.9), "haff1983")
    n = 6 * 0.1 / math.pi
    nu = 16 / 5 * math.sqrt(math.pi) * n * math.sqrt(0.5)
    t = np.array([0.0, 1.0, 10.0, 1000.0])
    expected = 0.5 / (1 + haff["cooling_rate"] * nu * t / 2) ** 2
    assert np.allclose(haff.temperature(t), expected, rtol=1e-9)
    assert haff.temperature(0) == pytest.approx(0.5)


def test_scan_has_a_number_for_each_point(shear):
    xarray = pytest.importorskip("xarray")
    es = np.linspace(0.5, 0.9, 3)
    found = gg.scan(shear, e=es, phi=[0.1, 0.2], theories=["lun1991", "lun1991_lun_savage"])
    assert isinstance(found, xarray.Dataset) and found["temperature"].shape == (3, 2, 2)
    at = found["temperature"].sel({"collision.e": es[1], "phi": 0.2, "theory": "lun1991_lun_savage"})
    assert float(at) == gg.theory(shear.copy(e=es[1], phi=0.2), "lun1991_lun_savage")["temperature"]
    assert found["temperature"].attrs["units"] == "d^2 gamma^2"
    flows = gg.scan(shear, flow=["usf", "hcs"], theories=["lun1991", "haff1983"], quantities=["temperature", "N1"])
    assert flows["temperature"].attrs["units"] == "d^2 gamma^2 or v_0^2" and flows["N1"].attrs["units"] == "1"


def test_scan_without_xarray(shear, monkeypatch):
    monkeypatch.setitem(__import__("sys").modules, "xarray", None)
    found = gg.scan(shear, {"collision.e": [0.5, 0.9]}, theories=["lun1991"], quantities=["temperature"])
    assert isinstance(found, gg.Grid) and found.dims == ("collision.e", "theory") and found["temperature"].shape == (2, 1)


def test_scan_of_one_name(shear):
    found = gg.scan(shear, e=[0.5, 0.9], theories="lun1991", quantities="temperature")
    assert found["temperature"].shape == (2, 1) and not np.isnan(found["temperature"]).any()
    with pytest.raises(gg.NotFound, match="did you mean 'temperature'"):
        gg.scan(shear, e=[0.5], theories="lun1991", quantities=["temprature"])
    with pytest.raises(gg.NotFound, match="did you mean 'lun1991'"):
        gg.scan(shear, e=[0.5], theories=["lun199"])
    nothing = gg.scan(shear, e=[0.5], theories="lun1991", quantities=["wall_heat_flux"])
    assert np.isnan(nothing["wall_heat_flux"]).all()


def test_scan_of_words_and_pairs(shear):
    pytest.importorskip("xarray")
    found = gg.scan(shear, contact_value=["carnahan_starling", "lun_savage"], theories=["lun1991"])
    assert list(found["contact_value"].values) == ["carnahan_starling", "lun_savage"]
    assert float(found["temperature"][0, 0]) != float(found["temperature"][1, 0])


@pytest.mark.parametrize("wrong", [dict(), dict(e=0.5), dict(e=[]), dict(e=[2]), dict(nothing=[1]), dict(e="abc")])
def test_wrong_grids(shear, wrong):
    with pytest.raises(gg.BadInput):
        gg.scan(shear, theories=["lun1991"], **wrong)


def test_results_beside_theories():
    """Results of single runs, beside the theories, are the columns of a comparison."""
    scene = gg.Scene(flow="usf", phi=0.1, e=0.9, beta=0, run={"collisions": 50, "warmup": 20})
    md, dsmc = (gg.run(scene.copy(engine=engine)) for engine in ("md", "dsmc"))
    alone, both = gg.theories(md.scene, md), gg.theories(dsmc.scene, dsmc, md)
    assert alone.md["N1"].mean == both.md["N1"].mean == md["N1"].mean and alone.dsmc is None
    assert both.dsmc["N1"].mean == dsmc["N1"].mean and math.isfinite(both["N1"].z)
    assert alone["temperature"].theory == gg.theories(md.scene)["temperature"].theory
    with pytest.raises(gg.BadInput, match="another scene"):
        gg.theories(md.scene.copy(phi=0.2), md)


def test_ctrl_c_ends_a_scan(shear):
    """One point takes a second, all take a quarter of an hour."""
    mixture = gg.Scene(flow="usf", phi=0.3, species=[{"fraction": f, "diameter": d} for f, d in ((0.5, 1), (0.3, 2), (0.2, 3))])
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        gg.scan(mixture, e=np.linspace(0.5, 1, 1000))
    assert gg.theory(shear, "lun1991")["temperature"] > 0


def test_what_is_left_behind_stops(monkeypatch):
    """Ctrl-C stops the library's part of a theory, which ends without an answer; in a comparison nothing runs."""
    rough = gg.Scene(flow="hcs", phi=0.3, e=0.7, beta=-0.5, particles=100)
    ended, check = [], gg.theory.__globals__["check"]

    def noted(function, *arguments):
        try:
            return check(function, *arguments)
        except BaseException as error:
            ended.append(error)
            raise
    monkeypatch.setitem(gg.theory.__globals__, "check", noted)
    threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        while True:  # each takes three seconds of processor time
            gg.theory(rough, "enskog_hermite")
    while any(thread.name == "graingas" for thread in threading.enumerate()):
        time.sleep(0.01)
    assert [str(error) for error in ended] == ["enskog_hermite: interrupted"]
    threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        gg.compare(rough, progress=False)


WALLED = dict(flow="couette", phi=0.1, e=0.9, particles=500, walls={"e": 0.9, "beta": 0, "speed": 1},
              measure=["rheology", "profiles", "fluxes"], run={"collisions": 300, "warmup": 50})


def test_profiles_of_theories():
    """Profiles and their numbers without engines; beside a result, from its file, they are the same."""
    scene = gg.Scene(WALLED, engine="dsmc")
    found = gg.theories(scene)
    for name in "navier_stokes", "moments":
        theory = found.theories[name]
        u, T, q = (theory.curves["profile_" + key] for key in ("velocity", "temperature", "q_y"))
        inside = np.isfinite(u.value)
        assert (np.diff(u.value[inside]) > 0).all() and T.value[inside].argmax() in (inside.sum() // 2 - 1, inside.sum() // 2)
        stress = theory.curves["profile_P_yx"].value[inside]
        assert np.allclose(stress, u.numbers["wall_P_yx_upper"].mean, rtol=1e-5)
        slope = np.gradient(u.value[inside], u.x[inside])[inside.sum() // 2]
        assert u.numbers["slope_middle"].mean == pytest.approx(slope, rel=0.01)
        assert u.numbers["slip_upper"].unit == u.unit and math.isnan(u.numbers["slip_upper"].tau)
        assert q.value[inside][-1] < q.numbers["wall_q_y_upper"].mean  # that has the work of the slip, too
        assert "a wall takes heat" in theory.beyond
    both = gg.compare(scene.copy(e=0.9), output="c.h5")
    stored = gg.read("c.h5").theories["moments"]
    assert stored.beyond == both.theories["moments"].beyond == found.theories["moments"].beyond
    for name, curve in stored.curves.items():
        assert np.array_equal(curve.value, found.theories["moments"].curves[name].value, equal_nan=True)
        assert {n: e.mean for n, e in curve.numbers.items()} == \
            {n: e.mean for n, e in found.theories["moments"].curves[name].numbers.items()}


def test_closures_at_measured_profiles():
    """navier_stokes at the state of a height, from the coefficients of the cooling gas there; moments has the stress of
    a Monte Carlo run; states are parabolas through measured profiles."""
    r = gg.run(gg.Scene(WALLED, engine="dsmc", run={"collisions": 1000}))
    local = gg.local_fluxes(r)
    c0 = 5 / (16 * math.sqrt(math.pi))
    for i in range(0, len(local.y), 5):
        phi, T, shear, phi_slope, T_slope = (float(values[i]) for values in local.state.values())
        hcs = gg.theory(gg.Scene(flow="hcs", phi=phi, e=0.9), "garzo_santos_montanero2007")
        n, chi = 6 * phi / math.pi, (1 - phi / 2) / (1 - phi) ** 3
        ns = {name: values[i] * 6 / math.pi for name, values in local.theory["navier_stokes"].items()}
        assert ns["P_yy"] == pytest.approx(n * T * (1 + 2 * 1.9 * phi * chi), rel=1e-6)
        assert ns["P_yx"] == pytest.approx(-c0 * math.sqrt(T) * hcs["viscosity_reduced"] * shear, rel=1e-6)
        kappa, mu = (3.75 * c0 * math.sqrt(T) * hcs[key] for key in ("thermal_conductivity_reduced",
                                                                    "diffusive_heat_conductivity_reduced"))
        assert ns["q_y"] == pytest.approx(-kappa * T_slope - mu * T / n * 6 / math.pi * phi_slope, rel=1e-6)
        assert ns["loss"] == pytest.approx(1.5 * n**2 * T**1.5 * hcs["cooling_rate"] / c0, rel=1e-6)
    u, T = r.curves["profile_velocity"], r.curves["profile_temperature"]
    first = np.flatnonzero(np.isclose(u.x, local.y[0]))[0]
    near = slice(first, first + 9)
    fit = np.polyfit(u.x[near], u.value[near], 2, w=1 / u.error[near])
    assert local.state["shear_rate"][0] == pytest.approx(np.polyval(np.polyder(fit), local.y[0]), rel=1e-6)
    assert abs(local.state["temperature"] / T.value[first:first + len(local.y)] - 1).max() < 0.03
    for flux in "P_yx", "P_xx", "P_yy", "P_zz":
        assert abs(local.ratio("moments", flux) - 1) < 0.03, flux
        assert np.array_equal(local.measured[flux], r.curves["profile_" + flux].value[first:first + len(local.y)])
    assert local.ratio("navier_stokes", "P_yx") > 1.1 and abs(local.ratio("moments", "q_y") - 1) < 0.15
    head, *rows, last = str(local).splitlines()[2:]
    assert len(rows) == len(local.y) + 1 and head.split()[:5] == ["y", "phi", "T", "shear", "rate"]
    assert float(rows[1].split()[0]) == pytest.approx(local.y[0], rel=1e-3)
    assert f"{local.ratio('moments', 'P_yx'):.3f}" in last
    with pytest.raises(gg.BadInput, match="none of the theories lun1991"):
        gg.local_fluxes(r, "lun1991")
    with pytest.raises(gg.NotFound):
        gg.local_fluxes(r, "momenta")
    for wrong in dict(measure=["rheology"]), dict(beta=0), dict(phi=0.3, particles=60):
        short = gg.run(gg.Scene({**WALLED, "run": {"collisions": 5, "warmup": 5}, **wrong}))
        with pytest.raises(gg.BadInput):
            gg.local_fluxes(short)
