# SPDX-License-Identifier: GPL-3.0-or-later
"""The live view of a simulation in a notebook: what it draws, that it pauses, and that it changes no trajectory."""
import os
import re
import sys
import time
import types

import numpy as np
import pytest

import graingas as gg
from conftest import SOURCE
from graingas import live

GAS = gg.Scene(flow="usf", phi=0.1, particles=200, e=0.9, engine="md")


def until(condition, seconds=20):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


def test_colours_are_the_pages():
    with open(os.path.join(SOURCE, "web", "colours.js"), encoding="utf-8") as file:
        page = re.search(r"rising: \[(.*?)\n  \]", file.read(), re.DOTALL)[1]
    assert np.array_equal(live.RISING, [[int(x) for x in row.split(",")] for row in re.findall(r"\[([\d, ]+)\]", page)])
    assert live.colours(np.array([-1, 0, 0.5, 1, 2])) == ["#4c54e8", "#4c54e8", "#dc548c", "#ffee5a", "#ffee5a"]


def test_a_picture_has_each_grain_once_inside_its_frame():
    sim = gg.Simulation(GAS)
    text = live.picture(sim, 300)
    circles = np.array([[float(x) for x in found] for found in re.findall(r'cx="([^"]+)" cy="([^"]+)" r="([^"]+)"', text)])
    assert len(circles) == 200 and (circles[:, :2] >= 0).all() and (circles[:, :2] <= 300).all()
    assert text.count("<path") == 12 and f"T = {sim.temperature:.4g}" in text
    assert np.ptp(circles[:, 2]) == 0 and 2 < circles[0, 2] < 30


def test_a_box_is_turned_and_tilted_without_being_stretched():
    box = np.array([4.0, 2.0, 3.0])
    flat = live.project(live.corners(box), box)
    for a in range(8):
        for b in range(a):
            assert np.isclose(np.linalg.norm(flat[a] - flat[b]), np.linalg.norm((live.corners(box)[a] - live.corners(box)[b])))
    assert flat[2, 1] > flat[0, 1]  # y points up


def test_views_need_positions_and_positive_numbers():
    with pytest.raises(gg.BadInput, match="engine: md"):
        gg.Simulation(gg.Scene(flow="usf", phi=0.1, engine="dsmc")).view()
    for wrong in {"every": 0}, {"rate": -1}, {"size": 0}:
        with pytest.raises(gg.BadInput, match="above 0"):
            gg.Simulation(GAS).view(**wrong)


def test_a_view_moves_pauses_and_stops():
    sim = gg.Simulation(GAS)
    view = sim.view(every=0.01, rate=1000)
    assert "paused" in repr(view) and sim.time == 0
    view.resume()
    until(lambda: "0.0 collisions" not in view.picture)
    view.pause()
    at = sim.time
    time.sleep(0.05)
    assert sim.time == at > 0
    same = gg.Simulation(GAS)  # the same steps without a view
    for _ in range(round(at / 0.01)):
        same.advance(0.01)
    assert same.hash == sim.hash
    view.resume()
    with view.paused() as free:
        assert free is sim and sim.time >= at
        now = sim.time
    until(lambda: view.error or view.pause()._sim.time > now or view.resume() is None)
    view.stop()
    assert "stopped" in repr(view) and view.error is None and not view._thread.is_alive()
    with pytest.raises(gg.BadInput, match="make another"):
        view.resume()


def test_what_ends_a_view_is_kept():
    sim = gg.Simulation(GAS)
    view = sim.view(rate=1000)
    sim.close()
    view.resume()
    until(lambda: view.error is not None)
    assert isinstance(view.error, gg.BadInput) and "stopped" in repr(view)


def test_a_notebook_gets_one_picture_that_changes(monkeypatch):
    shown = []

    class Handle:
        update = shown.append

    fake = types.ModuleType("IPython.display")
    fake.HTML = lambda text: text
    fake.display = lambda text, display_id: shown.append(text) or Handle
    monkeypatch.setitem(sys.modules, "IPython", types.ModuleType("IPython"))
    monkeypatch.setitem(sys.modules, "IPython.display", fake)
    view = gg.Simulation(GAS).view(rate=1000)
    view._ipython_display_()
    until(lambda: len(shown) > 3)
    view.stop()
    assert len(set(shown)) == len(shown) and shown[0].startswith("<svg") and shown[-1] == view._repr_html_()
