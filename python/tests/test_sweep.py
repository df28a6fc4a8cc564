# SPDX-License-Identifier: GPL-3.0-or-later
"""Sweeps: every point is the run of its keys, tables and cubes, resumed folders."""
import os
import signal
import warnings

import pytest

import graingas as gg


@pytest.fixture
def swept(short):
    return gg.sweep(short, {"collision.e": [0.7, 0.9]}, phi=[0.05, 0.1], folder="u", threads=2)


def test_points_are_runs(swept, short):
    assert len(swept) == 4 and [p.values["phi"] for p in swept] == [0.05, 0.1, 0.05, 0.1]
    for point in swept:
        alone = gg.run(short.copy(e=point.values["collision.e"], phi=point.values["phi"], seed=point.seed))
        assert point.read()["temperature"].mean == alone["temperature"].mean


def test_tables_and_cubes_agree(swept):
    pytest.importorskip("xarray")
    table, cube = swept.to_dataframe(), swept.to_xarray()
    assert cube["temperature"].dims == ("collision.e", "phi", "solver")
    for _, row in table[table.quantity == "temperature"].iterrows():
        at = {"collision.e": row["collision.e"], "phi": row["phi"], "solver": row["solver"]}
        assert float(cube["temperature"].sel(at)) == row["mean"]
        assert float(cube["temperature_error"].sel(at)) == row["error"]
    assert swept[2].values == {"collision.e": 0.9, "phi": 0.05}
    assert float(cube["temperature"].sel({"collision.e": 0.9, "phi": 0.05, "solver": "md"})) == \
        swept[2].read()["temperature"].mean


def test_folder_is_resumed(swept, short):
    removed = swept[1].file
    kept = os.stat(swept[0].file).st_mtime_ns
    os.remove(removed)
    again = gg.sweep(short, {"collision.e": [0.7, 0.9]}, phi=[0.05, 0.1], folder="u")
    assert os.path.exists(removed) and os.stat(swept[0].file).st_mtime_ns == kept
    assert all(point.state == "done" for point in again)


def test_comparisons_theories_and_pictures(short):
    matplotlib = pytest.importorskip("matplotlib")
    matplotlib.use("Agg")
    compared = gg.sweep(short, e=[0.8, 0.9], does="compare")
    assert {"md", "dsmc", "lun1991"} <= set(compared.grid().coords["solver"])
    ax = compared.plot("temperature", relative_to="enskog_hermite")
    assert ax.get_ylabel() == "$T$ / enskog_hermite" and ax.get_xlabel() == "collision.e"
    assert compared.plot(over="e").get_xlabel() == "collision.e"
    for wrong in {"relative_to": "nobody"}, {"over": "beta"}, {"quantity": "temprature"}:
        with pytest.raises(gg.NotFound):
            compared.plot(**wrong)
    flows = gg.sweep(short, flow=["usf", "hcs"], does="theory").grid().units
    assert flows["temperature"] == flows["temperature_error"] == "d^2 gamma^2 or v_0^2" and flows["N1"] == "1"
    theories = gg.sweep(short, e=[0.8, 0.9], does="theory")
    assert "md" not in theories.grid().coords["solver"]
    assert theories[0].read().theories["lun1991"]["temperature"] == compared[0].read().theories["lun1991"]["temperature"]


GRID = """
flow: usf
phi: 0.1
particles: 200
collision: {beta: 0}
run: {collisions: 150, warmup: 30}
dsmc: {particles: 500}
vary: {collision.e: [0.8, 0.9]}
"""


def test_validate_gives_the_same_verdict_again():
    """The verdict of a grid: the document and the page; the folder has the sweep, and gives the same verdict again."""
    with open("grid.yaml", "w", encoding="utf-8") as file:
        file.write(GRID)
    verdict = gg.validate("grid.yaml", folder="g", page="page.md")
    assert verdict["points"] == verdict["done"] == 2 and verdict.agrees is None  # none is steady
    assert str(verdict).startswith("2 points") and os.path.exists("page.md")
    assert gg.Verdict({"dsmc": {"agrees": False, "values": 9}}, "").agrees is False
    again = gg.Sweep.load("g")
    assert [point.state for point in again] == ["done"] * 2 and again.does == "compare" and again.validate() == verdict
    for sweep, file in (again, "g/sweep.yaml"), (gg.Sweep.load("grid.yaml", does="compare", folder="g"), "./grid.yaml"):
        with pytest.raises(gg.BadInput, match="overwritten by its own page"):
            sweep.validate(page=file)
    assert again.axes == {"collision.e": [0.8, 0.9]}
    assert gg.Sweep.load("grid.yaml").does == "run" and gg.Sweep.load("grid.yaml", does="theory").does == "theory"


def interrupt(*_):
    os.kill(os.getpid(), signal.SIGINT)


def test_interrupted_validation(endless):
    """Without a point KeyboardInterrupt, else the verdict on the finished points."""
    grid = endless.to_yaml() + "vary: {collision.e: [0.8, 0.9]}\nsweep: {does: compare}\n"
    with open("endless.yaml", "w") as file:
        file.write(grid)
    with pytest.warns(gg.PartialResult), pytest.raises(KeyboardInterrupt, match="interrupted"):
        gg.validate("endless.yaml", folder="g", progress=interrupt)
    with open("grid.yaml", "w") as file:
        file.write(GRID + "sweep: {does: compare}\n")
    found = gg.Sweep.load("grid.yaml", "h", "compare").run()
    os.remove(found[1].file)
    with pytest.MonkeyPatch.context() as patch, warnings.catch_warnings(record=True) as told:
        patch.setattr(gg.Sweep, "run", lambda sweep, *_: interrupted_run(sweep))
        verdict = gg.validate("grid.yaml", folder="h")
    assert verdict and not told and [point.state for point in found] == ["done", "missing"]


def interrupted_run(sweep):
    sweep._interrupted, sweep.partial = True, "interrupted"
    return sweep


def test_interrupted_verdict(monkeypatch):
    """Ctrl-C while points are read leaves no page, and the sweep can be used."""
    with open("grid.yaml", "w") as file:
        file.write(GRID + "sweep: {does: compare}\n")
    found = gg.Sweep.load("grid.yaml", "g", "compare").run()
    wait = gg.calls.threading.Event.wait
    sent = []

    def interrupted(event, *seconds):
        if not sent:
            sent.append(interrupt())
        return wait(event, *seconds)
    with monkeypatch.context() as patch, pytest.raises(KeyboardInterrupt):
        patch.setattr(gg.calls.threading.Event, "wait", interrupted)
        found.validate(page="page.md")
    assert found.validate()
    assert not os.path.exists("page.md")


@pytest.mark.parametrize("wrong, kind", [
    (lambda s: gg.validate("nowhere.yaml"), gg.BadFile), (lambda s: gg.validate(3), TypeError),
    (lambda s: gg.sweep(s, e=[0.9]).validate(), gg.BadInput),
    (lambda s: gg.Sweep.parse(GRID + "sweep: {does: compare}\n").validate(), gg.RunFailed),
    (lambda s: gg.sweep(s, e=[0.9], does="compare").validate(page="no/such/folder.md"), gg.BadFile)])
def test_no_verdict(short, wrong, kind):
    with pytest.raises(kind):
        wrong(short)


def test_temporary_folder_goes_with_the_sweep(short):
    found = gg.sweep(short, e=[0.9])
    folder = found.folder
    assert os.path.isdir(folder)
    del found
    __import__("gc").collect()
    assert not os.path.exists(folder)


def test_short_points_are_named():
    s = gg.Scene(flow="usf", phi=0.1, particles=200, run={"relative_error": 1e-5, "time_limit": 0.2})
    with pytest.warns(gg.PartialResult, match="point 0"):
        found = gg.sweep(s, e=[0.9])
    assert found.partial and found[0].state == "short" and "time limit" in found.partial
    assert found[0].read().info.engine == "md"


@pytest.mark.parametrize("wrong", [
    lambda s: gg.sweep(s), lambda s: gg.sweep(s, e=0.9), lambda s: gg.sweep(s, e=[0.9, 9]), lambda s: gg.sweep(s, nothing=[1]),
    lambda s: gg.sweep(s, e=[0.9], does="dance"), lambda s: gg.sweep(s, e=[0.9], threads=-1),
    lambda s: gg.sweep(s.add(gg.define_law(lambda g: 0.9)), e=[0.9])])
def test_wrong_sweeps(short, wrong):
    with pytest.raises(gg.BadInput):
        wrong(short)
