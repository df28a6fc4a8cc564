# SPDX-License-Identifier: GPL-3.0-or-later
"""Results and comparisons: the numbers of the library's own document and file, tables, arithmetic, pickles, pictures."""
import copy
import itertools
import json
import math
import os
import pickle

import numpy as np
import pytest

import graingas as gg
from graingas import units


def test_numbers_are_those_of_the_document(comparison):
    document = json.loads(comparison.md.to_json())["results"]
    for name, estimate in comparison.md.items():
        assert estimate.mean == pytest.approx(document[name]["mean"], rel=1e-14), name
    assert comparison["temperature"].md.mean == comparison.md["temperature"].mean
    assert comparison["temperature"].unit == "d^2 gamma^2"


def test_z_is_the_difference_over_the_error(comparison):
    row = comparison["temperature"]
    assert row.z == pytest.approx((row.md.mean - row.dsmc.mean) / math.hypot(row.md.error, row.dsmc.error))
    difference = row.md - row.dsmc
    assert difference.mean / difference.error == pytest.approx(row.z)


def test_theories_have_numbers_deviations_and_reasons(comparison):
    lun = comparison.theories["lun1991"]
    assert comparison["temperature"].theory["lun1991"] == lun["temperature"]
    assert lun.deviation("temperature") == pytest.approx(lun["temperature"] / comparison.md["temperature"].mean - 1)
    assert comparison.theories["haff1983"].reason and len(comparison.theories["haff1983"]) == 0
    assert "cooling" not in comparison and "temperature" in lun


def test_unknown_names(comparison):
    for wrong in (lambda: comparison["heat"], lambda: comparison.md["heat"], lambda: comparison.theories["lun1991"]["heat"]):
        with pytest.raises(gg.NotFound, match="heat"):
            wrong()
    assert comparison.get("heat") is None and isinstance(gg.NotFound("x"), KeyError)


def test_file_and_pickle_keep_everything(comparison):
    comparison.write("c.h5")
    for other in (gg.read("c.h5"), pickle.loads(pickle.dumps(comparison))):
        assert list(other) == list(comparison) and isinstance(other, gg.Comparison)
        assert other["temperature"].md.mean == comparison["temperature"].md.mean
        assert other.scene == comparison.scene
    comparison.md.write("r.h5")
    for other in (gg.read("r.h5"), pickle.loads(pickle.dumps(comparison.md))):
        assert isinstance(other, gg.Result) and other["N1"].mean == comparison.md["N1"].mean


def test_file_is_the_librarys(comparison):
    h5py = pytest.importorskip("h5py")
    comparison.write("c.h5")
    with h5py.File("c.h5") as file:
        assert file["graingas/md/results/temperature/mean"][()] == comparison.md["temperature"].mean
        curve = file["graingas/md/curves/velocity_distribution_Cx/value"][:]
    assert np.array_equal(curve, comparison.md.curves["velocity_distribution_Cx"].value, equal_nan=True)


def test_curves_and_history(comparison):
    curves = comparison.curves["velocity_distribution_Cx"]
    assert {"md", "dsmc"} <= set(curves)
    curve = curves["md"]
    assert curve.x.shape == curve.value.shape == curve.error.shape == (len(curve),)
    time, T = comparison.md.history("temperature")
    assert time.shape == T.shape and np.all(np.diff(time) > 0) and T[-1] > 0
    with pytest.raises(gg.BadInput):
        comparison.md.history("N1")


def test_grains_are_copies(comparison):
    g = comparison.md.grains
    assert g.position.shape == g.velocity.shape == g.spin.shape == (200, 3) and g.species.shape == (200,)
    assert comparison.dsmc.grains.position is None
    g.position[:] = 0  # a copy: the grains of the result stay
    assert comparison.md.grains.position.max() > 1


def test_tables_have_the_numbers(comparison):
    pandas = pytest.importorskip("pandas")
    table = comparison.to_dataframe()
    assert isinstance(table, pandas.DataFrame)
    assert table.loc["temperature", "md"] == comparison.md["temperature"].mean
    assert table.loc["temperature", "lun1991"] == comparison.theories["lun1991"]["temperature"]
    assert comparison.md.to_dataframe().loc["N1", "error"] == comparison.md["N1"].error
    html = comparison._repr_html_()
    rows = [name for name in comparison if not table.loc[name].drop(["unit", "z"]).isna().all()]
    assert str(comparison["temperature"].md) in html and html.count("<tr>") == len(rows) + 1 < len(comparison)
    shown = [line.split()[0] for line in repr(comparison).splitlines()[4:]]
    assert str(comparison["temperature"].md) in repr(comparison) and shown == rows


def test_pictures_are_drawn_and_written(comparison):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    before = dict(matplotlib.rcParams)
    for i, ax in enumerate([comparison.plot(), comparison.md.plot("temperature"),
                            comparison.curves["velocity_distribution_Cx"].plot(),
                            comparison.md.curves["velocity_distribution_Cx"].plot()]):
        assert isinstance(ax, matplotlib.axes.Axes) and ax.get_ylabel()
        ax.figure.savefig(f"{i}.pdf")
    assert dict(matplotlib.rcParams) == before
    ax = comparison.md.plot("temperature")
    assert (ax.get_xlabel(), ax.get_ylabel()) == (r"time [$1/\gamma$]", r"$T$ [$d^2 \gamma^2$]")
    ax = matplotlib.pyplot.figure().add_subplot()
    assert comparison.plot(["temperature", "N1"], ax=ax) is ax
    assert [tick.get_text() for tick in ax.get_xticklabels()] == ["$T$", "$N_1$"]


def test_picture_keeps_ratios_apart(comparison):
    """A theory without N1 (ratio 0) is marked at the edge: it does not squash the others."""
    pytest.importorskip("matplotlib").use("Agg")
    assert comparison["N1"].theory["lun1991"] == 0
    ax = comparison.plot(["temperature_ratio", "N1", "pressure"])
    low, high = ax.get_ylim()
    assert 0.02 <= high - 1 <= 0.6 and low + high == pytest.approx(2)
    edge = [line for line in ax.lines if line.get_marker() == "v" and line.get_xdata()[0] == 1]
    assert edge and all(low < line.get_ydata()[0] < low + 0.1 for line in edge)


def test_citations(comparison):
    """The engines and the theories that answered; names; and an error for others."""
    text = gg.cite(comparison)
    for key in "graingas", "AlderWainwright1959", "MontaneroSantos1996", "Lun1991", "CarnahanStarling1969":
        assert f"{{{key},\n" in text
    assert "Haff1983" not in text and text.count("@software") == 1
    assert "MontaneroSantos1996" not in gg.cite(comparison.md) and "Lun1991" not in gg.cite(comparison.md)
    assert gg.cite() == gg.cite("md").split("\n\n")[0] + "\n"
    assert gg.cite(comparison.theories["lun1991"]) == gg.cite("lun1991")
    with pytest.raises(gg.NotFound, match="did you mean 'lun1991'"):
        gg.cite("lun199")
    with pytest.raises(TypeError, match="Comparison"):
        gg.cite(3)


def test_documents_as_dicts(comparison):
    assert comparison.to_dict() == json.loads(comparison.to_json()) and comparison.md.to_dict()["engine"] == "md"


def test_symbols_are_latex(comparison):
    """Symbols of all quantities, also of species of mixtures, are LaTeX that matplotlib reads."""
    mathtext = pytest.importorskip("matplotlib.mathtext")
    mixture = gg.Scene(flow="hcs", phi=0.1, species=[{"fraction": 0.25, "mass": k + 1} for k in range(4)])
    found = gg.catalogue.quantities(mixture)
    assert found["temperature_4"].symbol == "T_{4}" and found["rotational_conductivity"].symbol == r"\kappa_{rh}"
    for entry in found.values():
        mathtext.MathTextParser("path").parse(f"${entry.symbol}$")
    assert all(comparison[name].symbol == row.md.symbol == found[name].symbol for name, row in comparison.items())


def test_picture_of_cooling(short):
    pytest.importorskip("matplotlib")
    ax = gg.run(short.copy(flow="hcs", e=0.5)).plot()
    assert (ax.get_xscale(), ax.get_yscale()) == ("log", "log") and ax.get_xlabel() == "time [$d/v_0$]"


def test_estimates_by_hand():
    a, b = gg.Estimate(2.0, 0.3), gg.Estimate(5.0, 0.4)
    assert ((a + b).mean, (a + b).error) == (7, pytest.approx(0.5))
    assert (a * b).error == pytest.approx(math.hypot(5 * 0.3, 2 * 0.4))
    assert (a / b).error == pytest.approx(0.4 * math.hypot(0.3 / 2, 0.4 / 5))
    assert (a - a).error == 0 and (a / a).error == 0 and (2 * a).error == pytest.approx(0.6)
    assert (a**2).error == pytest.approx(2 * 2 * 0.3) and (1 / a).error == pytest.approx(0.3 / 4)
    assert (-a).mean == -2 and abs(-a).mean == 2 and (3 - a).mean == 1
    assert str(gg.Estimate(1.234, 0.0041)) == "1.2340(41)" and f"{a:.2f}" == "2.00"


def test_estimates_and_numpy():
    a, x = gg.Estimate(2.0, 0.3), np.array([1.0, 2.0])
    for left, right in ((a * x, x * a), (a + x, x + a), (a - x, -(x - a)), (a / x, 1 / (x / a))):
        assert [e.mean for e in left] == [e.mean for e in right]
        assert [e.error for e in left] == pytest.approx([e.error for e in right])
    assert (a * x)[1].error == pytest.approx(0.6)
    assert type(math.sqrt(a)) is float and "without its error" in gg.Estimate.__doc__
    assert np.sqrt(a).mean == math.sqrt(2) and np.sqrt(a).error == pytest.approx(0.3 / (2 * math.sqrt(2)))
    with pytest.raises(TypeError):
        a + "1"


def test_estimates_of_one_run_are_correlated(comparison):
    """Covariances enter: p/(nT) from p and T has the error of its own series, as independent numbers five times that."""
    md = comparison.md
    p, T, ratio = md["pressure"], md["temperature"], md["compressibility_factor"]
    ours = (p / T).error / (p / T).mean
    assert ours == pytest.approx(ratio.error / ratio.mean, rel=0.4)
    assert math.hypot(p.error / p.mean, T.error / T.mean) > 3 * ours
    assert md.covariance("pressure", "pressure") == pytest.approx(p.error**2)
    assert md.covariance("pressure", "temperature") == md.covariance("temperature", "pressure") > 0
    assert (p - md["pressure"]).error == 0 and (p / T * T).error == pytest.approx(p.error)
    P_xx = md["P_xx"]
    expected = p.error**2 + P_xx.error**2 + 2 * md.covariance("pressure", "P_xx")
    assert (p + P_xx).error == pytest.approx(math.sqrt(expected))
    of_both = p.error**2 + comparison.dsmc["pressure"].error**2
    assert (p - comparison.dsmc["pressure"]).error == pytest.approx(math.sqrt(of_both))
    with pytest.raises(gg.NotFound):
        md.covariance("pressur", "temperature")


def test_uncertainties_agree_with_estimates(comparison):
    uncertainties = pytest.importorskip("uncertainties")
    u = comparison["temperature"].md.u
    assert (u.n, u.s) == pytest.approx((comparison.md["temperature"].mean, comparison.md["temperature"].error))
    p, T = comparison.md["pressure"], comparison.md["temperature"]
    independent = (p / T).mean * math.hypot(p.error / p.mean, T.error / T.mean)
    assert (p.u / T.u).s == pytest.approx((p / T).error) and (p / T).error < 0.3 * independent
    assert (p / T).u.s == pytest.approx((p.u / T.u).s)
    assert (p.u - comparison.md["pressure"].u).s == 0
    assert (p.u - comparison.dsmc["pressure"].u).s == pytest.approx((p - comparison.dsmc["pressure"]).error)
    assert isinstance(u, uncertainties.core.AffineScalarFunc)


@pytest.fixture
def fresh():
    """A state in which no number of uncertainties was used before."""
    gg.estimate.Correlated._of_runs.clear()


@pytest.mark.parametrize("a, b", [("temperature", "pressure"), ("P_xx", "P_yy"), ("collision_rate", "temperature"),
                                  ("N1", "N2"), ("P_xy", "shear_viscosity"), ("rotational_temperature", "temperature")])
def test_uncertainties_of_two_means_are_exact(comparison, fresh, a, b):
    """Sum, product and ratio of the first two means used have the errors that their covariance gives."""
    pytest.importorskip("uncertainties")
    a, b = comparison.md[a], comparison.md[b]
    b.unit = a.unit
    for ours, theirs in (a + b, a.u + b.u), (a * b, a.u * b.u), (a / b, a.u / b.u):
        assert theirs.s == pytest.approx(ours.error, rel=1e-6), ours


def test_uncertainties_of_many_means(comparison, fresh):
    """Each mean keeps its error. A mean has exactly the covariance with the earlier one that correlates most with
    it.
    """
    uncertainties = pytest.importorskip("uncertainties")
    md, used = comparison.md, []
    for e in md.values():
        if not e.error > 0:
            continue
        assert e.u.s == pytest.approx(e.error)
        rho = {b: np.clip(md.covariance(e.name, b.name) / e.error / b.error, -1, 1) for b in used
               if math.isfinite(md._covariance(e.name, b.name))}
        if rho:
            largest = max(map(abs, rho.values()))
            found = {b: uncertainties.covariance_matrix([e.u, b.u])[0][1] / e.error / b.error
                     for b in rho if abs(rho[b]) > largest - 1e-9}
            assert any(found[b] == pytest.approx(rho[b], abs=1e-9) for b in found)
        used.append(e)
    assert len(used) > 20


def again(what):
    return pickle.loads(pickle.dumps(what))


WAYS = {"read": lambda r: (gg.read("r.h5"), gg.read("r.h5")), "kept": lambda r: (r, gg.read("r.h5")),
        "pickled": lambda r: (again(r), again(r)), "copied": lambda r: (copy.deepcopy(r), copy.copy(r)),
        "pickled means": lambda r: ({name: again(e) for name, e in r.items()}, {name: again(e) for name, e in r.items()}),
        "copied means": lambda r: (copy.deepcopy(dict(r)), r),
        "pickled together": lambda r: again((dict(r), dict(r)))}


@pytest.mark.parametrize("way", WAYS)
def test_one_run_twice_is_one_run(comparison, way):
    """A mean less itself is 0 without error, and a ratio has the error that the covariance gives."""
    comparison.md.write("r.h5")
    here = comparison.md
    a, b = WAYS[way](here)
    for name in "pressure", "temperature", "N1":
        assert ((a[name] - b[name]).mean, (a[name] - b[name]).error) == (0, 0)
    for one, other in ("P_xy", "pressure"), ("rotational_temperature", "temperature"):
        found, expected = a[one] / b[other], here[one] / here[other]
        assert found.error == pytest.approx(expected.error, rel=1e-12)
    independent = math.hypot(here["pressure"].error / here["pressure"].mean, here["temperature"].error / here["temperature"].mean)
    assert (a["pressure"] / b["temperature"]).error < 0.4 * independent * (a["pressure"] / b["temperature"]).mean


def test_identity_of_runs(comparison, short):
    """The identity is the same for one run, however read, and for the same scene and seed; it differs for another seed
    or engine.
    """
    md = comparison.md
    md.write("r.h5")
    same = {md.identity, gg.read("r.h5").identity, again(md).identity, again(comparison).md.identity}
    assert same == {md.identity} and comparison.dsmc.identity != md.identity
    one, two, other = gg.run(short), gg.run(short, threads=2), gg.run(short.copy(seed=7))
    assert one.identity == two.identity != other.identity
    assert (one["N1"] - two["N1"]).error == 0
    assert (one["N1"] - other["N1"]).error == pytest.approx(math.hypot(one["N1"].error, other["N1"].error))


def test_pickled_means_are_small(comparison):
    """A pickle of a mean has covariances, not the result; combinations and copies keep their parts."""
    md = comparison.md
    whole, one = len(pickle.dumps(md)), len(pickle.dumps(md["temperature"]))
    assert one < 5000 < 20 * one < whole
    ratio = md["pressure"] / md["temperature"]
    assert (again(ratio) - ratio).error == pytest.approx(0, abs=1e-9 * ratio.error)
    assert (again(ratio) * md["temperature"]).error == pytest.approx(md["pressure"].error)
    own = gg.Estimate(2.0, 0.3)
    assert (again(own) - own).error == (copy.copy(own) - own).error == 0 and (gg.Estimate(2.0, 0.3) - own).error > 0.4
    for name in "tau", "tau_unit", "samples", "unit", "symbol", "reason", "name":
        assert getattr(again(md["N1"]), name) == getattr(md["N1"], name)


def test_uncertainties_of_one_run_twice(comparison):
    pytest.importorskip("uncertainties")
    md = comparison.md
    md.write("r.h5")
    x, y = gg.read("r.h5")["P_xy"].u, again(md["P_xy"]).u
    assert (x - y).s == 0 and x.s == pytest.approx(md["P_xy"].error)
    own = gg.Estimate(2.0, 0.3)
    assert (own.u - own.u).s == 0 and own.u.s == pytest.approx(0.3)


def test_numbers_of_curves_are_of_the_run(short):
    """The same number twice is one number; its covariance with others is unknown."""
    result = gg.run(short.copy(measure=["rheology", "diffusion"], **{"run.collisions": 600}))

    def number():
        return next(n for curve in result.curves.values() for n in curve.numbers.values() if n.error > 0)
    assert (number() - number()).error == 0 and (again(number()) - number()).error == 0
    assert math.isnan((number() * result["temperature"]).error)


def test_comparisons_take_the_mean():
    """< > == max sorted round compare the numbers, as float() does; means of unlike units are not compared."""
    a, b, c = gg.Estimate(2.0, 0.3), gg.Estimate(5.0, 0.4), gg.Estimate(2.0, 0.1)
    assert a < b and b > a and a <= c and a >= c and a == c and a != b and a > 1 and 3 > a and not a > 2 and a == 2
    assert max(a, b) is b and sorted([b, a]) == [a, b] and min([b, a, 3]) is a and hash(a) == hash(2.0)
    assert round(gg.Estimate(5.5421, 0.1), 2) == 5.54 and isinstance(round(a), int)
    assert (np.array([1.0, 3.0]) > a).tolist() == [False, True] and (a == "2") is False and a != gg.Estimate(2.0, 0.3, "d")
    with pytest.raises(TypeError):
        a < "3"
    for wrong in (lambda: a < gg.Estimate(1, 1, "d"), lambda: max(a, gg.Estimate(3, 1, "d"))):
        with pytest.raises(gg.BadInput, match="units differ"):
            wrong()


@pytest.mark.parametrize("form, text", [("", "5.542(12)"), (".3", "5.54"), (".3f", "5.542"), (".2e", "5.54e+00"),
                                        ("12", "5.542(12)   "), (">12", "   5.542(12)"), ("s", "5.542(12)"),
                                        (".4s", "5.54"), ("g", "5.542"), ("+.1f", "+5.5"), (".0%", "554%")])
def test_formats_show_the_error(form, text):
    assert format(gg.Estimate(5.542, 0.012), form) == text


def test_functions_of_numpy():
    """Errors of functions follow from derivatives; log and log10 of a number with a unit are of the number in this
    unit.
    """
    a = gg.Estimate(2.0, 0.3, "d")
    assert (np.log(a).mean, np.log(a).error, np.log(a).unit) == (math.log(2), pytest.approx(0.15), "1")
    assert (np.log10(a).mean, np.log10(a).error) == pytest.approx((math.log10(2), 0.15 / math.log(10)))
    ratio = a / gg.Estimate(4.0, 0.0, "d")
    assert (np.exp(ratio).mean, np.exp(ratio).error) == pytest.approx((math.exp(0.5), 0.075 * math.exp(0.5)))
    assert (np.log(a) - np.log(a)).error == 0 and math.isnan(np.log(gg.Estimate(-1.0, 0.1)).mean)
    assert np.sqrt(a).unit == "d^0.5" and math.isnan(np.sqrt(gg.Estimate(-1.0, 0.1)).mean)
    with pytest.raises(gg.BadInput, match="exp"):
        np.exp(a)


def test_powers_of_estimates():
    """The error of the exponent enters, compared with finite differences; a plain exponent has none."""
    x, y = gg.Estimate(2.0, 0.03), gg.Estimate(3.0, 0.05)
    expected = math.hypot(12 * 0.03, 8 * math.log(2) * 0.05)
    assert ((x**y).mean, (x**y).error) == (8, pytest.approx(expected))
    assert (2**y).error == pytest.approx(8 * math.log(2) * 0.05) and (x**3).error == pytest.approx(12 * 0.03)
    assert (x**x).error == pytest.approx(4 * (1 + math.log(2)) * 0.03)
    with pytest.raises(gg.BadInput, match="unit"):
        x ** gg.Estimate(3.0, 0.05, "d")


def test_units_of_products_cancel(comparison):
    """Products and ratios cancel; sums of unlike units raise an error, plain numbers have the unit of the mean."""
    p, T, N1 = (comparison.md[name] for name in ("pressure", "temperature", "N1"))
    assert (p.unit, T.unit) == ("rho_p d^2 gamma^2", "d^2 gamma^2")
    assert ((p / T).unit, (p / T * T).unit, np.sqrt(T).unit, (T**2).unit) == ("rho_p", p.unit, "d gamma", "d^4 gamma^4")
    assert ((1 / T).unit, (T / T).unit, (N1 * T).unit) == ("1/(d^2 gamma^2)", "1", T.unit)
    assert (p / T * T - p).error == pytest.approx(0, abs=1e-12) and (T - 1).unit == (2 + T).unit == T.unit
    for wrong in (lambda: p + T, lambda: T - N1, lambda: N1 + T):
        with pytest.raises(gg.BadInput, match="units differ"):
            wrong()


@pytest.mark.parametrize("a, b", [("gamma/(n d^2)", "1/(n d^2/gamma)"), ("n m (gamma/(n d^2))^2", "m gamma^2/(n d^4)"),
                                  ("n m v_0^3 (n d^2)", "n^2 d^2 m v_0^3"), ("1", ""), ("v_0/d", "v_0 d^-1")])
def test_units_are_products(a, b):
    assert units.alike(a, b) and units.alike(units.product(a, "K"), units.product("K", b))
    assert units.ratio(a, b) == "1" and units.alike(units.power(units.power(a, 1 / 3), 3), a)


@pytest.mark.parametrize("odd", ["a)(", "(a", "a^", "^2", "/", "a^b", "10 m", "furlong"])
def test_units_that_are_no_products(odd):
    assert units.ratio(odd, odd) == "1" and not units.alike(odd, "d") and units.product(odd, "1") == odd


def test_every_unit_of_the_library_is_a_product():
    """A unit that is written and read again is the same."""
    for flow, phi in itertools.product(("usf", "hcs", "couette"), (0, 0.1)):
        scene = gg.Scene(flow=flow, phi=phi, engine="dsmc" if not phi else "md")
        for entry in gg.catalogue.quantities(scene).values() if phi or flow != "couette" else ():
            assert units.parse(units.write(units.parse(entry.unit))) == units.parse(entry.unit), entry.unit


def test_bytes_are_the_file(comparison):
    comparison.write("c.h5")
    with open("c.h5", "rb") as file:
        made = gg.Comparison.from_bytes(file.read())
    assert list(made) == list(comparison)
    again = gg.Result.from_bytes(comparison.md.to_bytes())
    assert again["N1"].mean == comparison.md["N1"].mean


@pytest.mark.parametrize("what", ["write", "compared", "export"])
def test_interrupted_files(comparison, what, words_of_ctrl_c):
    comparison.md.write("r.h5")
    function = {"write": lambda: comparison.md.write("w.h5"), "compared": lambda: comparison.write("w.h5"),
                "export": lambda: gg.export("r.h5", "w")}[what]
    function()
    before = {name: os.path.getsize(name) for name in os.listdir()}
    assert words_of_ctrl_c(function) in ("the file is whole or unchanged", "all files are there, or none")
    assert {name: os.path.getsize(name) for name in os.listdir()} == before
    function()


def test_export_writes_the_requested_parts(comparison):
    comparison.md.write("r.h5")
    names = gg.export("r.h5", "out", trajectory=False)
    assert "out.csv" in names and not any(name.endswith(".xyz") for name in names)
    with open("out.csv", encoding="utf-8") as file:
        row = next(line for line in file if line.startswith("temperature,")).split(",")
    assert repr(comparison.md["temperature"].mean) in row or float(row[2]) == comparison.md["temperature"].mean
    assert gg.export("r.h5", "only", results=False, curves=False) == ["only.xyz"]
    with pytest.raises(gg.GraingasError):
        gg.export("r.h5", "none", results=False, curves=False, trajectory=False)


def test_changed_files_are_read_with_a_warning(comparison):
    h5py = pytest.importorskip("h5py")
    comparison.md.write("r.h5")
    gg.read("r.h5")
    with h5py.File("r.h5", "a") as file:
        file["note"] = 1
    with pytest.warns(UserWarning, match="changed"):
        assert gg.read("r.h5")["N1"].mean == comparison.md["N1"].mean


def test_curves_by_local_density_are_read_back():
    """Their names end in a number: local_distribution_Cx_0.5."""
    scene = gg.Scene(flow="usf", phi=0.3, particles=200, measure=["rheology", "local_distributions"], run={"collisions": 60, "warmup": 10})
    made = gg.run(scene, output="local.h5")
    found = gg.read("local.h5").curves
    assert "local_distribution_Cx_0.5" in found and set(found) == set(made.curves)


@pytest.mark.parametrize("use, words", [
    (lambda c: c["temperatur"], "no quantity called 'temperatur'; did you mean 'temperature'?"),
    (lambda c: c.md["presure"], "no quantity called 'presure'; did you mean 'pressure'?"),
    (lambda c: c.theories["lun"], "no theory called 'lun'; did you mean 'lun1991'?"),
    (lambda c: c["temperature"].theory["lun"], "no theory of temperature called 'lun'; did you mean 'lun1991'?"),
    (lambda c: c.curves["velocity_distribution_x"], "no curve called 'velocity_distribution_x'; did you mean"),
    (lambda c: c.md.curves["g"], "no curve called 'g'; there are: "),
    (lambda c: gg.theories(c.scene).theories["lun1991"].curves["g"], "there are: none; add the observable to the scene's key measure"),
    (lambda c: c.scene.help("colision.e"), "no key called 'colision.e'; did you mean 'collision.e'?"),
])
def test_wrong_names(comparison, use, words):
    """A wrong name raises a KeyError that lists the right ones."""
    with pytest.raises(KeyError) as caught:
        use(comparison)
    assert words in str(caught.value)
    assert comparison.curves.get("g") is None and "g" not in comparison.curves
