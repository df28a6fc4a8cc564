# SPDX-License-Identifier: GPL-3.0-or-later
"""The notebooks and the page docs/howto/python.md run, and their statements hold. Without NIGHTLY some have fewer points
between the ends, where nothing is asserted."""
import glob
import json
import math
import os
import re
import sys

import numpy as np
import pytest

import graingas as gg
from conftest import SOURCE

SHORTER = {"friction": {"mus = [0.01, 0.03, 0.1, 0.3, 1, 3, 10]": "mus = [0.01, 0.1, 10]"},
           "suspension": {"np.linspace(0.13, 0.21, 17)": "np.linspace(0.145, 0.195, 11)"},
           "three_questions": {"beta=[-0.9, -0.3, 0.3, 0.9]": "beta=[-0.9, 0.9]", "phi=[0.1, 0.3, 0.5]": "phi=[0.1, 0.5]",
                               "particles=500": "particles=250"}}
NOTEBOOKS = {os.path.basename(path)[:-6]: path for path in glob.glob(os.path.join(SOURCE, "python", "notebooks", "*.ipynb"))}


def cells(name):
    with open(NOTEBOOKS[name], encoding="utf-8") as file:
        book = json.load(file)
    code = [cell for cell in book["cells"] if cell["cell_type"] == "code"]
    assert all(not cell["outputs"] for cell in code), "clear the outputs before a commit"
    parts = ["".join(cell["source"]) for cell in code]
    for long, short in SHORTER.get(name, {}).items() if "NIGHTLY" not in os.environ else ():
        assert sum(long in part for part in parts) == 1, long
        parts = [part.replace(long, short) for part in parts]
    return parts


def execute(parts):
    """Names defined by all parts; the last expression of a part is printed, as in a notebook."""
    matplotlib = pytest.importorskip("matplotlib")
    pytest.importorskip("xarray")
    pytest.importorskip("pandas")
    matplotlib.use("Agg")
    names = {}
    for i, part in enumerate(parts):
        exec(compile(part, f"cell {i}", "exec"), names)
        last = part.strip().splitlines()[-1]
        if re.fullmatch(r"[\w.]+", last):
            value = names[last] if last in names else eval(last, names)
            assert getattr(value, "_repr_html_", value.__repr__)()
    return names


def test_every_notebook_is_tried():
    assert sorted(NOTEBOOKS) == ["friction", "haffs_law", "hydrodynamics", "oscillation", "own_theory", "suspension", "sweep_to_xarray",
                                 "three_questions", "trajectory", "two_temperatures"]


def test_friction():
    """dsmc and the noise-free solution agree within 1 %, an effective restitution does not. A fast spin escapes, a slow
    one does not."""
    names = execute(cells("friction"))
    shares, measured, theory = names["shares"], names["measured"]["temperature_ratio"].values, names["theory"]["temperature_ratio"]
    assert shares == sorted(shares, reverse=True) and shares[0] > 0.98 and shares[-1] < 0.002
    assert np.abs(theory.sel(theory="enskog_hermite") / measured - 1).max() < 0.02
    assert theory.sel(theory="jenkins_zhang2002").values[-1] / measured[-1] < 0.7
    slow, fast = (names["paths"][times] for times in (10, 60))
    assert slow[1][-1] < 10 * slow[2][-1] and fast[1][-1] > 5000 * fast[2][-1]


def test_suspension():
    """Two states between drags 0.155 and 0.185; at 0.18 dsmc is within a quarter (hot) and a tenth (cold) of the closure; the way up and the way down differ."""
    names = execute(cells("suspension"))
    assert 0.15 < names["two"].min() < 0.16 and 0.18 < names["two"].max() < 0.19
    at = np.argmin(abs(names["drags"] - 0.18))
    assert abs(names["branches"]["hot"][at] / names["measured"]["hot"].mean - 1) < 0.25
    assert abs(names["branches"]["cold"][at] / names["measured"]["cold"].mean - 1) < 0.1
    path = dict(enumerate(zip(names["steps"], names["path"])))
    assert path[2][0] == path[4][0] == 0.175 and path[2][1] > 80 and path[4][1] < 0.2


def test_haffs_law():
    names = execute(cells("haffs_law"))
    assert names["temperatures"][-1] < 0.03 * names["temperatures"][0]
    assert np.allclose(names["temperatures"], names["predicted"], rtol=0.15)
    assert abs(names["slope"] / names["expected"] - 1) < 0.05


def test_hydrodynamics():
    """Closures at measured profiles: moments has the stress; a Newtonian theory has too much of it and of heat flux."""
    names = execute(cells("hydrodynamics"))
    ns, moments, quiet = names["ratios"]["navier_stokes"], names["ratios"]["moments"], names["quiet"]
    assert abs(moments["P_yx"] - 1) < 0.03 and abs(moments["P_xx"] - 1) < 0.03 and abs(moments["q_y"] - 1) < 0.15
    assert 1.08 < ns["P_yx"] < 1.3 and 0.85 < ns["P_xx"] < 0.97
    assert all(abs(quiet.ratio(name, flux) - 1) < 0.03 for name in quiet.theory for flux in ("P_xx", "P_yy", "q_y"))


def test_oscillation():
    """Slow oscillations are steady shear at the present rate; Monte Carlo has the moduli of the closure, which converge to
    second order."""
    names = execute(cells("oscillation"))
    moduli, change = names["moduli"], np.diff(names["loss"])
    assert abs(names["amplitude"] / (8 / (3 * np.pi) * names["p0"]) - 1) < 0.05 and abs(moduli["third_harmonic"][0.04] - 0.2) < 0.03
    assert np.allclose(moduli["loss_modulus"], moduli["loss_modulus_of_closure"], rtol=0.03)
    assert np.allclose(change[:-1] / change[1:], 4, atol=0.5) and 0 < moduli["third_harmonic"][2] < 0.05


def test_own_theory():
    names = execute(cells("own_theory"))
    excess = names["excess"].sel({"collision.e": 0.5})
    assert float(abs(excess).max()) < 0.05 and float(excess.std()) < 1e-6
    measured, mine = names["measured"], names["theories"]["maxwellian"]
    assert mine == pytest.approx(5 / 12 * (1 - 0.05) / (1 - 0.1) ** 3 * 0.75)
    assert abs(measured.mean / names["theories"]["garzo_dufty1999"] - 1) < 0.02


def test_three_questions():
    names = execute(cells("three_questions"))
    assert names["ratio"].sel(solver="md").values[0] < 0.1 < 0.5 < names["ratio"].sel(solver="md").values[-1]
    z = [point.read()["temperature_ratio"].z for point in names["dense"]]
    assert abs(z[0]) < 8 and z[-1] > 10
    assert names["a2"].values[0] > 0.03 and names["a2"].values[-1] < 0
    assert np.allclose(names["a2"], names["theory"], atol=0.03)


def test_sweep_to_xarray():
    names = execute(cells("sweep_to_xarray"))
    measured, deviation, error = (names[name] for name in ("measured", "deviation", "error"))
    assert measured["N1"].dims == ("collision.e", "phi")
    assert (measured["N1"].diff("phi") < 0).all() and (measured["N1"].diff("collision.e") < 0).all()
    assert abs(deviation.sel(phi=0.05, **{"collision.e": 0.6})) < 2 > 4 * error.min()
    assert (names["theory"]["N1"].sel(theory="lun1991") == 0).all()


def test_two_temperatures():
    """Both starts and the changed coefficient end at Enskog's ratio; the bounds are four standard errors."""
    names = execute(cells("two_temperatures"))
    first = {name: path[3][0] / path[2][0] for name, path in names["paths"].items()}
    assert first["cold spins"] < 0.2 and first["hot spins"] > 2.5
    for late in names["late"].values():
        assert abs(late - names["enskog"]) < 0.12
    assert abs(names["changed"] - names["expected"]) < 0.09 and names["expected"] < names["enskog"] - 0.25


def test_trajectory():
    """g(r) at contact is near the contact value; ASE, where it is installed, finds the same distances."""
    names = execute(cells("trajectory"))
    assert 1 <= names["nearest"] < 1.01 and abs(names["g"][-5:].mean() - 1) < 0.05
    assert names["g"][0] == pytest.approx((1 - 0.1) / (1 - 0.2) ** 3, rel=0.15)
    assert names["T"][-1] == pytest.approx(names["frame"].state.temperature)
    if names["ase"]:
        assert names["same"] == pytest.approx(names["distances"](names["frame"]).min(), rel=1e-12)
        assert os.path.getsize("last.xyz") > 10000


def test_trajectory_without_ase(monkeypatch):
    monkeypatch.setitem(sys.modules, "ase.io", None)
    names = execute(cells("trajectory"))
    assert names["ase"] is None and names["nearest"] >= 1


def page():
    with open(os.path.join(SOURCE, "docs", "howto", "python.md"), encoding="utf-8") as file:
        return file.read()


def test_blocks_of_the_page_print_their_outputs():
    """Its blocks in order, in one session; every output that it shows is printed."""
    os.symlink(os.path.join(SOURCE, "examples"), "examples")
    names = execute(re.findall(r"^```python\n(.*?)^```", page(), re.MULTILINE | re.DOTALL))
    assert isinstance(names["c"], gg.Comparison) and math.isfinite(names["c"]["temperature"].z)


def test_page_names_what_there_is():
    public = {name for name in dir(gg) if not name.startswith("_")}
    for name in re.findall(r"\bgg\.(\w+)", page()):
        assert name in public, name
