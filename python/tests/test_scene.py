# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes: keys by every way to write them, their help, errors with the library's words, copies and pickles."""
import math
import os
import pickle
import re

import numpy as np
import pytest

import graingas as gg
from conftest import SOURCE
from graingas import yaml
from graingas.scene import KEYS, SHORT


def test_sources_are_equal(examples):
    path = os.path.join(examples, "usf.yaml")
    with open(path, encoding="utf-8") as file:
        text = file.read()
    keys = gg.Scene(flow="usf", phi=0.01, particles=1000, e=0.9, beta=0, relative_error=0.005)
    assert gg.Scene(path) == gg.Scene(text) == keys == gg.Scene({"flow": "usf", "phi": 0.01, "particles": 1000,
                                                                "collision": {"e": 0.9, "beta": 0},
                                                                "run.relative_error": 0.005})


def test_ways_to_a_key():
    s = gg.Scene(flow="usf", phi=0.1)
    s.e = 0.8
    assert s["collision.e"] == s.collision.e == s.e == 0.8
    s.collision.beta = -0.5
    assert s["collision.beta"] == s.beta == -0.5
    s["phi"] = 0.3
    assert s.phi == 0.3
    s["run"] = {"seed": 7}
    assert s.run.seed == s.seed == 7


HOSTILE = ["run #1.csv", "! a.csv", "a: b.csv", "[a, b].csv", "{a}.csv", "*a.csv", "'a'.csv", '"a" \\n.csv', " a.csv", "5.csv",
           "~.csv", "- a.csv", "grün #2.csv"]


@pytest.mark.parametrize("name", HOSTILE)
def test_names_are_texts(name):
    """Not YAML: given by any way and written by any way, a name is the same."""
    for s in (gg.Scene(flow="usf", phi=0.1, log=name), gg.Scene({"flow": "usf", "phi": 0.1, "output": {"log": name}}),
              gg.Scene(flow="usf", phi=0.1).copy(**{"output.log": name})):
        assert s["output.log"] == s.log == name
        assert gg.Scene(s.to_yaml()).log == gg.Scene(s.to_yaml(all=True)).log == gg.Scene(s.to_json()).log == name
        assert pickle.loads(pickle.dumps(s)).log == name


def test_other_readers_read_the_same():
    """PyYAML is one of version 1.1, where 1e-07 is a text."""
    other = pytest.importorskip("yaml")
    s = gg.Scene(flow="usf", phi=1e-07, e=0.5, log="run #1.csv", relative_error=1e-5)
    for text in s.to_yaml(), s.to_yaml(all=True):
        read = other.safe_load(text)
        assert (read["phi"], read["output"]["log"], read["run"]["relative_error"]) == (1e-07, "run #1.csv", 1e-5)
    for value in 1e-07, -1e-09, 1.5e-10, 1e22, 0.1:
        assert other.safe_load(yaml.write(value)) == yaml.read(yaml.write(value)) == value


@pytest.mark.parametrize("key, value", [
    ("phi", 1 / 3), ("particles", 12345), ("flow", "hcs"), ("measure", ["rheology", "orientation"]),
    ("aspect", [1, 2, 0.5]), ("collision.mu", math.inf), ("run.time_limit", None), ("thermostat", "none"),
    ("phi", np.float64(0.1)), ("aspect", np.array([1.0, 2.0, 3.0])), ("particles", np.int64(500))])
def test_values_return(key, value):
    s = gg.Scene(flow="usf", phi=0.1)
    s[key] = value
    assert s[key] == (value.tolist() if isinstance(value, np.ndarray) else value)


def test_pairs_of_species():
    s = gg.Scene(flow="usf", phi=0.1, species=[{"fraction": 0.5}, {"fraction": 0.5, "diameter": 2}],
                 collision={"e": {12: 0.8, "other": 0.5}})
    assert s["collision.e.12"] == 0.8 and s["collision.e.22"] == 0.5
    assert s.e[12] == 0.8 and s.species[1]["diameter"] == 2
    assert pickle.loads(pickle.dumps(s)) == s


def test_completion_and_help(capsys):
    s = gg.Scene(flow="usf", phi=0.1)
    assert {"phi", "collision", "e", "seed"} <= set(dir(s)) and "beta" in dir(s.collision)
    assert set(s._ipython_key_completions_()) == set(KEYS)
    for key in KEYS:
        assert KEYS[key].doc in (gg.scene._documentation(key)) and KEYS[key].allowed
    assert "restitution" in gg.Scene.e.__doc__ and "a number from 0 to 1" in gg.Scene.e.__doc__
    s.help("e")
    assert "Value: 0.9" in capsys.readouterr().out
    assert all(SHORT[word].endswith("." + word) for word in SHORT)


def test_scene_is_a_mapping():
    s = gg.Scene(flow="usf", phi=0.1)
    assert list(s) == list(KEYS) == list(dict(s)) and len(s) == len(KEYS)
    assert "phi" in s and "phy" not in s and s.get("phi") == 0.1 and s.get("phy", 3) == 3
    assert dict(s.collision)["e"] == s.collision["e"] == s.e and "e" in s.collision and "d" not in s.collision
    s.collision["beta"] = 0.5
    assert s["collision.beta"] == 0.5
    with pytest.raises(KeyError):
        s["phy"]


def test_names_of_the_module():
    """help(graingas) shows what __all__ has."""
    things = [name for name, thing in vars(gg).items() if callable(thing) and not name.startswith("_") and name != "text"]
    assert sorted(things + ["catalogue", "plot"]) == sorted(gg.__all__)


@pytest.mark.parametrize("wrong, words", [
    (lambda s: gg.Scene(colision={"e": 0.8}), "did you mean 'collision"), (lambda s: gg.Scene(collision={"ee": 1}), "collision.ee"),
    (lambda s: setattr(s, "phy", 1), "did you mean 'phi'"), (lambda s: setattr(s, "e", 3), "from 0 to 1"),
    (lambda s: s.__setitem__("collision.e", "x"), "collision.e"), (lambda s: s["nothing"], "nothing"),
    (lambda s: gg.Scene("flow: usf\nphi: 2"), "scene:2"), (lambda s: gg.Scene("flow: usf").check(), "phi is missing")])
def test_errors_are_the_librarys(wrong, words):
    with pytest.raises(gg.BadInput, match=words):
        wrong(gg.Scene(flow="usf", phi=0.1))


def test_file_name_with_a_colon():
    with open("a: b.yaml", "w", encoding="utf-8") as file:
        file.write("flow: usf\nphi: 0.2\n")
    assert gg.Scene("a: b.yaml").phi == 0.2


def test_missing_file_and_attribute():
    with pytest.raises(gg.BadFile, match="nowhere.yaml"):
        gg.Scene("nowhere.yaml")
    assert issubclass(gg.BadFile, OSError) and issubclass(gg.BadInput, ValueError)
    assert not hasattr(gg.Scene(flow="usf", phi=0.1), "shape")
    for wrong in 3, [gg.Scene("flow: usf")]:
        with pytest.raises(TypeError, match="expected a Scene, a file name"):
            gg.run(wrong)


def test_failed_change_leaves_the_scene():
    s = gg.Scene(flow="usf", phi=0.1)
    before = s.to_yaml(all=True)
    with pytest.raises(gg.BadInput):
        s.phi = 7
    assert s.to_yaml(all=True) == before


def test_copy_is_independent():
    s = gg.Scene(flow="usf", phi=0.1)
    t = s.copy(phi=0.2, e=0.7)
    assert (s.phi, t.phi, t.e) == (0.1, 0.2, 0.7)


def test_pickle_keeps_what_is_given(examples):
    for name in sorted(os.listdir(examples)):
        if name.endswith(".yaml"):
            s = gg.Scene(os.path.join(examples, name))
            t = pickle.loads(pickle.dumps(s))
            assert t == s and t.given() == s.given(), name


def test_words_about_a_scene():
    s = gg.Scene(flow="usf", phi=0.1, walls={"speed": 2})
    assert "Uniform shear" in s.title and "Uniform shear" in repr(s)
    assert any("walls.speed" in line for line in s.warnings("md"))
    assert s.describe("md") and s.needs("md").memory > 0
    assert "usf" in gg.catalogue.words("flow") and "temperature" in gg.catalogue.quantities()


def test_schema_and_template():
    assert gg.catalogue.schema()["properties"]["phi"]["maximum"] == 0.6
    gg.Scene(gg.catalogue.template("couette")).check()
    with pytest.raises(gg.BadInput, match="one of usf|there is no flow"):
        gg.catalogue.template("shear")


@pytest.mark.parametrize("value", [1, -2.5, 1e-300, [1, [2, 3]], {"a": 1, 12: [0.5, "x"]}, "word", [], {}])
def test_yaml_reads_what_it_writes(value):
    assert yaml.read(yaml.write(value)) == value


# Functions of include/graingas.h without a call in the module, and why.
NOT_CALLED = """
gg_callback_fail: exceptions come out of the call
gg_comparison_departure gg_result_get gg_result_unit: rows and estimates have it
gg_text_make_printable: for programs with words of their own
gg_page_write gg_plot: pictures are those of matplotlib; the page is a command
gg_session_advance gg_session_free gg_session_get_progress gg_session_new gg_session_result: threads take their place
gg_simulation_record: events() stores all collisions of a step, however many
gg_sweep_collect gg_sweep_run_point gg_sweep_to_json gg_sweep_vary: sweep(), Point and to_dataframe()
gg_worker_run gg_workers_free gg_workers_new gg_workers_threads: mpirun starts the command
gg_checkpoint_about: a loaded simulation has its scene
"""


def test_functions_of_the_c_interface_are_called_or_listed():
    with open(os.path.join(SOURCE, "include", "graingas.h"), encoding="utf-8") as file:
        declared = set(re.findall(r"^GG_API [^;(]*?(gg_\w+)\(", file.read(), re.MULTILINE))
    folder, called = os.path.join(SOURCE, "python", "graingas"), set()
    for name in os.listdir(folder):
        if name.endswith(".py"):
            with open(os.path.join(folder, name), encoding="utf-8") as file:
                called |= set(re.findall(r"lib\.(gg_\w+)", file.read()))
    listed = set(re.findall(r"gg_\w+", NOT_CALLED))
    assert {name for name in declared - called if not name.endswith("_sized")} == listed
