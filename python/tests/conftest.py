# SPDX-License-Identifier: GPL-3.0-or-later
"""Fixtures of all tests: scenes that take a fraction of a second, and a folder for each test."""
import os
import signal
import threading

import pytest

import graingas as gg

SOURCE = os.environ.get("SOURCE", os.path.join(os.path.dirname(__file__), "..", ".."))


@pytest.fixture(autouse=True)
def own_folder(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)


@pytest.fixture
def examples():
    return os.path.join(SOURCE, "examples")


@pytest.fixture
def short():
    """Rough grains under shear: md takes 0.1 s."""
    return gg.Scene(flow="usf", phi=0.1, particles=200, collision={"e": 0.9, "beta": 0},
                    run={"collisions": 300, "warmup": 50})


@pytest.fixture
def words_of_ctrl_c():
    """A function that repeats another until Ctrl-C, and returns the text of its KeyboardInterrupt. A Ctrl-C between two
    calls, which has no text, is tried again."""
    def words(function):
        for _ in range(20):
            threading.Timer(0.3, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
            with pytest.raises(KeyboardInterrupt) as raised:
                while True:
                    function()
            if str(raised.value):
                return str(raised.value)
    return words


@pytest.fixture
def endless():
    """A scene whose run takes hours."""
    return gg.Scene(flow="usf", phi=0.1, particles=1000, run={"relative_error": 1e-6})


@pytest.fixture(scope="session")
def comparison():
    return gg.compare(gg.Scene(flow="usf", phi=0.1, particles=200, collision={"e": 0.9, "beta": 0},
                               measure=["rheology", "velocity_distributions"],
                               run={"collisions": 400, "warmup": 50}, dsmc={"particles": 500}), threads=2)
