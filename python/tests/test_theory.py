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
