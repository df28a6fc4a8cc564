# SPDX-License-Identifier: GPL-3.0-or-later
"""validation/reproduce: figures of papers. A small entry against separate runs and formulas; entries, names,
resumption, texts.
"""
import csv
import glob
import io
import math
import os
import shutil
import subprocess
import sys
import types
from xml.etree import ElementTree

import numpy as np
import pytest
from PIL import Image
from conftest import SOURCE

import graingas as gg

pytest.importorskip("matplotlib")
pytest.importorskip("yaml")
sys.path.insert(0, os.path.join(SOURCE, "validation"))
from reproduction import command, curves, numbers, parameters, pictures, points, small_svg, texts  # noqa: E402
from reproduction import entry as entries  # noqa: E402
from reproduction.formula import Formula  # noqa: E402

ENTRY = """figure: thesis 9.9
shows: A small figure
sweep:
  flow: usf
  engine: md
  phi: 0.1
  particles: 100
  measure: [rheology, velocity_distributions]
  run: {collisions: 200, warmup: 20}
  vary: {collision.beta: [-1, 0], collision.e: [0.8, 0.9, 1]}
  sweep: {does: run}
quick: {run.collisions: 100, vary: {collision.e: [0.7, 0.9]}}
panels:
  - {title: one, x: {key: collision.e, label: e}, y: {quantity: pressure, as: y/r-1, relative_to: {collision.beta: -1}},
     lines: {by: collision.beta, label: β}}
  - {title: two, x: {key: collision.e, as: 1-x^2}, y: {quantity: temperature}, where: {collision.beta: -1},
     theories: [lun1991], guides: [{label: half, as: x/2}]}
  - {x: {label: c, from: -2, to: 2}, y: {curve: velocity_distribution_Cx}, where: {collision.e: 0.9}, lines: {by: collision.beta}}
numbers:
  - {what: T at e = 0.9, where: p. 1, paper: 0.50, of: temperature, at: {collision.e: 0.9, collision.beta: -1}}
  - {name: p, of: pressure, over: collision.e, at: {collision.beta: 0}, theories: [lun1991]}
verdict: agrees
because: >
  The pressure is {p: ?} (Lun {p lun1991 at 0.9: ?}), at most {p max bare: ?}.
"""


@pytest.fixture
def folder(tmp_path):
    (tmp_path / "entries").mkdir()
    (tmp_path / "entries" / "thesis-9.09.yaml").write_text(ENTRY, encoding="utf-8")
    return str(tmp_path / "entries")


def rows_of(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def quick(folder, *more):
    return command.main(["9.9", "--quick", "--entries", folder, "--output", "out", "--quiet", "--formats", "svg", *more])


def the_runs():
    """The same scenes, run by the module alone, by beta and e."""
    scenes = gg.sweep(gg.Scene(flow="usf", engine="md", phi=0.1, particles=100, measure=["rheology", "velocity_distributions"],
                               run={"collisions": 100, "warmup": 20}),
                      {"collision.beta": [-1, 0], "collision.e": [0.7, 0.9]}, folder="own")
    return {tuple(point.values.values()): gg.run(point.scene) for point in scenes}


def test_a_figure_against_runs_of_its_own(folder):
    assert quick(folder) in (0, 1)
    rows, runs = rows_of("out/thesis-9.09.csv"), the_runs()
    one = {(row["line"], float(row["x"])): row for row in rows if row["panel"] == "1"}
    assert len(one) == 4
    for e in 0.7, 0.9:
        mine, smooth = runs[0, e]["pressure"], runs[-1, e]["pressure"]
        row, ratio = one["β = 0", e], mine.mean / smooth.mean
        assert float(row["y"]) == pytest.approx(ratio - 1, rel=1e-12)
        error = ratio * math.hypot(mine.error / mine.mean, smooth.error / smooth.mean)
        assert float(row["y_stderr"]) == pytest.approx(error, rel=1e-8)
        assert float(one["β = -1", e]["y"]) == 0 and float(one["β = -1", e]["y_stderr"]) == 0
    two = [row for row in rows if row["panel"] == "2"]
    md = {float(row["x"]): row for row in two if row["method"] == "md"}
    assert set(md) == {1 - 0.7**2, 1 - 0.9**2} and {row["y_unit"] for row in two} == {"d^2 gamma^2"}
    assert float(md[1 - 0.9**2]["y"]) == runs[-1, 0.9]["temperature"].mean
    lun = [row for row in two if row["method"] == "lun1991"]
    assert len(lun) == 41
    for row in lun[::8]:
        scene = gg.Scene(flow="usf", phi=0.1, e=math.sqrt(1 - float(row["x"])))
        assert float(row["y"]) == pytest.approx(gg.theory(scene, "lun1991")["temperature"], rel=1e-9)
    assert all(float(row["y"]) == float(row["x"]) / 2 for row in two if row["method"] == "half")
    curve = runs[-1, 0.9].curves["velocity_distribution_Cx"]
    inside = abs(curve.x) <= 2
    three = [row for row in rows if row["panel"] == "3" and row["line"] == "β = -1" and row["method"] == "md"]
    assert np.array_equal([float(row["y"]) for row in three], curve.value[inside])
    t = next(row for row in rows_of("out/thesis-9.09_numbers.csv") if row["paper"])
    mean, error = runs[-1, 0.9]["temperature"].mean, runs[-1, 0.9]["temperature"].error
    assert float(t["mean"]) == mean and float(t["z"]) == pytest.approx((mean - 0.5) / math.hypot(error, 0.005))


def test_profiles_of_theories(tmp_path):
    """A theory's profiles beside measured ones, where it answers: lines by the module alone."""
    (tmp_path / "entries").mkdir()
    (tmp_path / "entries" / "thesis-9.08.yaml").write_text("""figure: thesis 9.8
shows: Profiles
sweep:
  flow: couette
  engine: dsmc
  phi: 0.1
  particles: 200
  measure: [rheology, profiles]
  run: {collisions: 100, warmup: 20}
  vary: {collision.e: [0.9, 0.7]}
  sweep: {does: run}
panels:
  - {x: {label: y}, y: {curve: profile_temperature}, lines: {by: collision.e, label: e}, theories: [moments]}
verdict: open
because: Profiles.
""", encoding="utf-8")
    command.main(["9.8", "--entries", str(tmp_path / "entries"), "--output", "out", "--quiet", "--formats", "svg"])
    rows = [row for row in rows_of("out/thesis-9.08.csv") if row["method"] == "moments"]
    for e in 0.9, 0.7:
        scene = gg.Scene(flow="couette", phi=0.1, e=e, particles=200, measure=["profiles"])
        curve = gg.theory(scene, "moments").curves["profile_temperature"]
        known = np.isfinite(curve.value)
        mine = [(float(row["x"]), float(row["y"])) for row in rows if row["line"] == f"e = {e}"]
        assert mine and np.allclose(mine, np.column_stack([curve.x, curve.value])[known], rtol=1e-9)


def test_finished_runs_are_reused(folder):
    quick(folder)
    before = {path: os.stat(path).st_mtime_ns for path in glob.glob("out/figures.sweep/*.h5")}
    assert len(before) == 4
    os.remove(sorted(before)[0])
    quick(folder)
    after = {path: os.stat(path).st_mtime_ns for path in glob.glob("out/figures.sweep/*.h5")}
    assert set(before) == set(after) and [p for p in before if before[p] != after[p]] == sorted(before)[:1]


def test_runs_that_are_not_steady_are_open_and_named(folder, capsys):
    path = os.path.join(folder, "thesis-9.09.yaml")
    text = open(path, encoding="utf-8").read().replace("warmup: 20", "warmup: 0")
    open(path, "w", encoding="utf-8").write(text.replace("run.collisions: 100", "run.collisions: 20"))
    command.main(["9.9", "--quick", "--entries", folder, "--output", "out"])
    said, rows = capsys.readouterr(), rows_of("out/thesis-9.09.csv")
    steady = {tuple(p.values.values()): p.read().is_steady for p in gg.Sweep.parse(entries.read(path).sweeps[""].quick(
        entries.read(path).quick), "out/figures.sweep")}
    assert len(steady) == 4 and not all(steady.values())
    for (beta, e), is_steady in steady.items():
        shown = [row for row in rows if row["panel"] == "1" and row["line"] == f"β = {beta}" and float(row["x"]) == e]
        assert [row["settled"] for row in shown] == ["yes" if is_steady else "no"]
        assert is_steady or f"collision.beta = {beta}, collision.e = {e} (md)" in said.out
    assert os.path.getsize("out/thesis-9.09.png") > 5000
    with open("out/thesis-9.09.svg", encoding="utf-8") as picture:
        note = picture.read().partition("not settled: ")[2].partition("<")[0]
    assert all((f"β = {beta}, e = {e} (md)" in note) == (not is_steady) for (beta, e), is_steady in steady.items())


def test_keys_that_vary_together_and_their_quick_values(folder):
    path = os.path.join(folder, "thesis-9.09.yaml")
    vary = "vary: [{collision.beta: [-1, 0], run.warmup: [30, 20]}, {collision.e: [0.8, 0.9, 1]}]"
    text = ENTRY.replace("vary: {collision.beta: [-1, 0], collision.e: [0.8, 0.9, 1]}", vary)
    for quick_vary, varied in (("{collision.beta: [0], collision.e: [0.7, 0.9]}", [{"collision.beta": 0, "collision.e": e} for e in (0.7, 0.9)]),
                               ("[{collision.beta: [0, 1], run.warmup: [5, 6]}]",
                                [{"collision.beta": beta, "run.warmup": warmup} for beta, warmup in ((0, 5), (1, 6))])):
        with open(path, "w", encoding="utf-8") as file:
            file.write(text.replace("vary: {collision.e: [0.7, 0.9]}", "vary: " + quick_vary))
        entry = entries.read(path)
        assert [point.values for point in points.sweeps(entry, True, None)[""]] == varied
        full = points.sweeps(entry, False, None)[""]
        assert [point.scene["run.warmup"] for point in full] == [30] * 3 + [20] * 3
    with open(path, "w", encoding="utf-8") as file:
        file.write(text.replace("vary: {collision.e: [0.7, 0.9]}", "vary: [{collision.é: [0]}]"))
    with pytest.raises(entries.BadEntry, match="is no key of a scene"):
        entries.read(path)


def drawn(*heights):
    """Panels alike with a line of each of these heights along their whole width, and the legend they share."""
    figure = pictures.pyplot.figure(figsize=(6, 2), layout="constrained")
    panels = []
    for k, lines in enumerate(heights, 1):
        ax = figure.add_subplot(1, len(heights), k, ylim=(0, 1))
        handles = [ax.plot([0, 1], [y, y], label="one")[0] for y in lines]
        panels.append((ax, handles[:1]))
    pictures._explain(figure, panels)
    figure.draw_without_rendering()
    return [ax for ax, _ in panels if ax.get_legend()], [ax for ax, _ in panels]


def test_legends_cover_nothing():
    full = np.linspace(0, 1, 30)
    (ax,), panels = drawn([0.5], full)
    assert ax is panels[0] and not pictures._covers(ax)
    (ax,), panels = drawn(full, [0.5])
    assert ax is panels[1] and not pictures._covers(ax)
    (ax,), panels = drawn(full, full)
    box = ax.get_legend().get_window_extent()
    assert ax is panels[1] and box.x0 >= ax.get_window_extent().x1 and not pictures._covers(ax)


def test_texts_are_filled_from_the_table(folder):
    quick(folder)
    entry, runs = entries.read(os.path.join(folder, "thesis-9.09.yaml")), the_runs()
    assert texts.fill(entry, "out") and not texts.fill(entries.read(entry.path), "out")
    told = texts.plain(entries.read(entry.path).because)
    p = [runs[0, e]["pressure"] for e in (0.7, 0.9)]
    lun = gg.theory(gg.Scene(flow="usf", phi=0.1, e=0.9, beta=0), "lun1991")["pressure"]
    most = max(p, key=lambda value: value.mean)
    assert told == (f"The pressure is {texts.format_number(p[0].mean, p[0].error)}, {texts.format_number(p[1].mean, p[1].error)} "
                    f"(Lun {lun:.3g}), at most {texts.format_number(most.mean, most.error, True)}.")
    with pytest.raises(entries.BadEntry, match="has no number 'q'"):
        entry.because = "{q: 1}"
        texts.fill(entry, "out")


@pytest.mark.parametrize("mean, error, text", [(1.364, 0.021, "1.36(2)"), (0.54321, 0.114, "0.54(11)"), (-0.0042, 0.0096, "-0.004(10)"),
                                               (312.4, 23, "312(23)"), (0.25, math.nan, "0.25")])
def test_numbers_as_text(mean, error, text):
    assert texts.format_number(mean, error) == text


def test_the_page_is_that_of_the_entries():
    """validation/reproduce page > docs/appendix/reproduction.md"""
    with open(os.path.join(SOURCE, "docs", "appendix", "reproduction.md"), encoding="utf-8") as page:
        assert page.read() == texts.page()


def test_verdicts_agree_with_the_tables_beside_the_pictures():
    """validation/reproduce fill"""
    for path in entries.files():
        entry = entries.read(path)
        table = os.path.join(texts.PICTURES, entry.base + "_numbers.csv")
        if os.path.exists(table):
            assert texts.from_table(entry.because, rows_of(table)) == entry.because, path
        names = {number.name for number in entry.numbers}
        assert {found.split()[0] for found, _ in texts.FILLED.findall(entry.because)} <= names, path


def test_entries_are_complete():
    found = [entries.read(path) for path in entries.files()]
    assert len(found) >= 94 and len({entry.figure for entry in found}) == len(found)
    for entry in found:
        assert entries.find(entry.figure) == entry.path and entry.panels and entry.because
        for sweep in points.sweeps(entry, True, None).values():
            assert len(sweep) > 0
        for panel in entry.panels:
            assert "none" not in panel.guides


@pytest.mark.parametrize("replaced, by, said", [
    ("title: one", "titel: one", "yaml:14: key 'titel': did you mean 'title'"),
    ("quantity: pressure", "quantity: presure", "yaml:14: key 'quantity': there is no quantity 'presure'"),
    ("theories: [lun1991], guides", "theories: [lun], guides", "yaml:17: key 'theories': there is no theory 'lun'"),
    ("as: y/r-1", "as: y/q-1", "yaml:14: key 'as': 'q' is not known; there are x, y"),
    ("as: 1-x^2", "as: __import__('os')", "yaml:16: key 'as'"),
    ("key: collision.e, label", "key: colision.e, label", "yaml:14: key 'colision.e': is no key of a scene"),
    ("verdict: agrees", "verdict: perhaps", "yaml:22: key 'verdict': 'perhaps' is not allowed"),
    ("shows: A", "figure: x\nshows: A", "yaml:2: key 'figure': is given twice"),
    ("numbers:", "numbers: [", "yaml:"), ("  phi: 0.1", "  phy: 0.1", "yaml:6: key 'phy'")])
def test_bad_entries_are_named(folder, capsys, replaced, by, said):
    path = os.path.join(folder, "thesis-9.09.yaml")
    open(path, "w", encoding="utf-8").write(ENTRY.replace(replaced, by, 1))
    assert command.main(["9.9", "--entries", folder, "--output", "out"]) == 2
    assert "thesis-9.09." + said in capsys.readouterr().err


@pytest.mark.parametrize("typed, said", [("thsis 2.16", "did you mean 'thesis 2.16'?"), ("reviw 3", "did you mean 'review 3'?"),
                                         ("nothing", "there is no figure 'nothing'")])
def test_no_such_figure(capsys, typed, said):
    assert command.main([typed]) == 2
    assert said in capsys.readouterr().err


def test_the_list(folder, capsys):
    assert command.main(["list", "--entries", folder]) == 0
    lines = capsys.readouterr().out.splitlines()
    assert lines[1].split()[:4] == ["thesis", "9.9", "md", "6"] and "agrees" in lines[1]
    assert lines[-1].startswith("1 figures: agrees 1. ")


def test_formulas_are_evaluated():
    for text, value in ("-2^2", -4), ("2^-1", 0.5), ("2^3^2", 512), ("ln(x)*y/(1+y)", math.log(3) * 2 / 3), ("abs(-pi)", math.pi):
        assert Formula(text)(x=3, y=2) == pytest.approx(value, rel=1e-15)
    assert math.isnan(Formula("ln(-x)")(x=1)) and Formula("y^2").slope("y", y=3) == pytest.approx(6)
    for text in "x.real", "f(1)", "x if x else y", "ln(x, y)", "'a'", "1 +", "[x]", "x < 1":
        with pytest.raises(ValueError):
            Formula(text)


def test_finding_zeros_extremes_and_powers():
    x, e = np.array([1.0, 2, 3, 4]), np.full(4, 0.1)
    zero = numbers.zero(x, np.array([3, 1, -1, -3.0]), e)
    assert zero.mean == 2.5 and zero.error == pytest.approx(math.hypot(0.05, 0.05) / 2)
    least = numbers.extreme(np.exp(x), (x - 2.2) ** 2, e, True)
    assert least.mean == pytest.approx(math.exp(2.2)) and least.error > 0
    assert math.isnan(numbers.extreme(x, x, e, True).mean) and math.isnan(numbers.zero(x, x, e).mean)
    a, b = (numbers.power(x, 0.7 * x**1.5, 0.01 * x**1.5, which) for which in (False, True))
    assert a.mean == pytest.approx(0.7) and b.mean == pytest.approx(1.5)
    u = np.log(x) - np.log(x).mean()
    assert b.error == pytest.approx(0.01 / 0.7 / math.sqrt((u**2).sum()))


def test_numbers_taken_from_curves():
    class Curve:
        x, error = np.linspace(-4, 4, 81), np.full(81, 0.1)
        value = np.exp(-(x**2) / 2)
    assert curves.take(Curve, "largest") == curves.take(Curve, "middle") == pytest.approx((1, 0.1)) and curves.take(Curve, 2.0)[0] == pytest.approx(math.exp(-2))
    assert curves.take(Curve, "deviation")[0] == pytest.approx(1, abs=2e-3) and abs(curves.take(Curve, "skewness")[0]) < 1e-12
    assert curves.take(Curve, [-1.05, 1.05])[0] == pytest.approx(100 * math.erf(1.05 / math.sqrt(2)), abs=0.1)
    assert curves.take(Curve, "first")[0] == pytest.approx(math.exp(-8))


def test_laws_of_decay():
    """Slopes within their errors, which hold for scattered points; the misfit tells which law it is."""
    rng, x = np.random.default_rng(5), np.geomspace(1, 20, 60)
    for law, slope, other, y in ("power", -2.5, "exponential", x**-2.5), ("exponential", -0.4, "power", np.exp(-0.4 * x)):
        error = 0.02 * y
        curve = types.SimpleNamespace(x=x, value=y + error * rng.standard_normal(60), error=error)
        mean, sigma = curves.take(curve, [law, 2, 20])
        assert abs(mean - slope) < 4 * sigma < 0.2 * abs(slope)
        assert curves.take(curve, ["misfit of " + law, 2, 20])[0] < 0.03 < 0.3 < curves.take(curve, ["misfit of " + other, 2, 20])[0]
    assert math.isnan(curves.take(curve, ["power", 30, 300])[0])


def rsvg(svg):
    return subprocess.run(["rsvg-convert", "-z", "4", "-b", "white"], input=svg, capture_output=True, check=True).stdout


def cairo(svg):
    return pytest.importorskip("cairosvg").svg2png(svg, scale=4, background_color="white")


@pytest.mark.parametrize("render", [rsvg, cairo])
@pytest.mark.parametrize("font", ["DejaVu Sans", "DejaVu Serif", "DejaVu Sans Mono"])
def test_formulas_in_any_font(render, font):
    """Pieces of a formula stand side by side, whatever the font and the program."""
    if render is rsvg and not shutil.which("rsvg-convert"):
        pytest.skip("no rsvg-convert")
    with pictures.matplotlib.rc_context({**pictures.STYLE, "savefig.bbox": None}):
        figure, image = pictures.pyplot.figure(figsize=(7, 1)), io.BytesIO()
        figure.text(0.02, 0.4, pictures.mathematics("|G_{CC}^{xx}| of C_x about cells, T_{cell}/T"), fontsize=12)
        figure.savefig(image, format="svg")
        pictures.pyplot.close(figure)
    root = ElementTree.fromstring(small_svg.small_svg(image.getvalue().decode()).replace("'DejaVu Sans',Verdana,sans-serif", f"'{font}'"))
    (text,) = (text for text in root.iter(f"{{{small_svg.SVG}}}text"))
    assert "".join("".join(text.itertext()).split()) in ("|GCCxx|ofCxaboutcells,Tcell/T", "|GxxCC|ofCxaboutcells,Tcell/T")
    ends = []
    for piece in text:
        for other in text:
            other.set("fill-opacity", "1" if other is piece else "0")
        ink = np.asarray(Image.open(io.BytesIO(render(ElementTree.tostring(root)))).convert("L")).min(0) < 128
        ends.append((ink.argmax(), len(ink) - ink[::-1].argmax()))
    over = [end - start for (_, end), (start, _) in zip(ends, ends[1:])]
    assert max(over) <= 3, (over, ends)
    blank = [gap for gap, piece, other in zip(over, text, text[1:]) if "of" in piece.text or "about" in other.text]
    assert len(blank) == 2 and max(blank) < -6, over
    assert ends[-1][1] - ends[0][0] > 4 * 12 * 10  # long enough to have been drawn


def test_layouts_and_titles():
    assert [pictures.layout(n) for n in (1, 2, 3, 4, 5, 6, 8, 9)] == [(1, 1), (1, 2), (1, 3), (2, 2), (2, 3), (2, 3), (4, 2), (3, 3)]
    entry = entries.read(entries.find("thesis 3.15"))
    at = [types.SimpleNamespace(sweep=name, scene=point.scene) for name, sweep in points.sweeps(entry, False, None).items() for point in sweep]
    assert parameters.titles(entry, at) == ("thesis 3.15: φ = 0.01", ["constant β, N = 8000", "μ = 0.1, N = 2000", "μ = 1, N = 2000"])
    entry = entries.read(entries.find("review 6"))
    at = [types.SimpleNamespace(sweep=name, scene=point.scene) for name, sweep in points.sweeps(entry, False, None).items() for point in sweep]
    assert parameters.titles(entry, at) == ("review 6: φ = 0, N = 50000", [""])


def test_labels_become_mathematics():
    assert pictures.mathematics("T_{cell}/T") == r"$T_{\rm cell}$/T" and pictures.mathematics("e = 1") == "e = 1"
    assert pictures.mathematics("|G_{CC}^{xx}|") == r"|$G_{\rm CC}^{\rm xx}$|"
