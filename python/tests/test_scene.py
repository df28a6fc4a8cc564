# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes: keys in every notation, their help, errors with the library's messages, copies and pickles."""
import copy
import json
import math
import os
import pickle
import re
from decimal import Decimal
from fractions import Fraction

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
    """A name is no YAML: it stays the same, however it is given and written."""
    for s in (gg.Scene(flow="usf", phi=0.1, log=name), gg.Scene({"flow": "usf", "phi": 0.1, "output": {"log": name}}),
              gg.Scene(flow="usf", phi=0.1).copy(**{"output.log": name})):
        assert s["output.log"] == s.log == name
        assert gg.Scene(s.to_yaml()).log == gg.Scene(s.to_yaml(all=True)).log == gg.Scene(s.to_json()).log == name
        assert pickle.loads(pickle.dumps(s)).log == name


def test_other_readers_read_the_same():
    """PyYAML reads version 1.1, in which 1e-07 is a text."""
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
    ("phi", np.float64(0.1)), ("aspect", np.array([1.0, 2.0, 3.0])), ("particles", np.int64(500)), ("phi", 1e-7)])
def test_values_return(key, value):
    s = gg.Scene(flow="usf", phi=0.1)
    s[key] = value
    assert s[key] == (value.tolist() if isinstance(value, np.ndarray) else value)


@pytest.mark.parametrize("key, value, expected", [
    ("phi", Decimal("0.1"), 0.1), ("phi", Fraction(1, 8), 0.125), ("phi", np.float32(0.125), 0.125), ("phi", np.array(0.2), 0.2),
    ("aspect", range(1, 4), [1, 2, 3]), ("aspect", (1, Fraction(1, 2), Decimal(2)), [1, 0.5, 2]), ("measure", {"rheology"}, ["rheology"]),
    ("phi", gg.Estimate(0.1, 0.01), 0.1), ("collision", {"e": Decimal("0.8")}, None), ("phi", "0.2", 0.2),
    ("measure", "[rheology, orientation]", ["rheology", "orientation"])])
def test_numbers_and_lists_of_other_kinds(key, value, expected):
    s = gg.Scene(flow="usf", phi=0.3)
    s[key] = value
    assert gg.Scene(**{"flow": "usf", "phi": 0.3, key: value}) == s == gg.Scene({"flow": "usf", "phi": 0.3, key: value})
    assert s.e == 0.8 if expected is None else s[key] == expected


def test_values_of_pandas():
    pandas = pytest.importorskip("pandas")
    s = gg.Scene(flow="usf", phi=0.1, aspect=pandas.Series([1.0, 2.0, 0.5]), measure=pandas.Series(["rheology", "orientation"]))
    assert s.aspect == [1, 2, 0.5] and s.measure == ["rheology", "orientation"]
    found = gg.scan(s, e=pandas.Series([0.5, 0.75]), phi=[Fraction(1, 8), Decimal("0.25")], theories=["lun1991"])
    assert found["phi"].values.tolist() == [0.125, 0.25] and found["collision.e"].values.tolist() == [0.5, 0.75]


TEXTS = ["hcs\noutput: {log: x.csv}", "5, seed: 9", "0.1\nparticles: 9", "usf, phi: 0.4", "usf}", "usf # x", "usf: x", "[usf], particles: [9", "\"usf\", phi: 0.4",
         "&a usf", "!x usf", "usf\tparticles: 9", "{a: b}, particles: 9", "usf\r\nparticles: 9", "[it's ], particles: [9's]"]


@pytest.mark.parametrize("words", TEXTS)
def test_a_text_brings_in_no_other_key(words):
    """Whatever a value contains, it is the value of its key: as a keyword, in a dict, of a group, set later."""
    for make in (lambda: gg.Scene(flow=words, phi=0.1), lambda: gg.Scene({"flow": words, "phi": 0.1}),
                 lambda: gg.Scene(flow="usf", phi=0.1, run={"warmup": words}), lambda: gg.Scene(flow="usf", phi=words),
                 lambda: gg.Scene({"flow": "usf", words: 0.1}), lambda: gg.Scene(flow="usf", phi=0.1).copy(thermostat=words)):
        with pytest.raises(gg.BadInput):
            make()


NAMES = ["run #1.csv", "! a.csv", "[a].csv", "a: b.csv", "{a}.csv", "- a.csv", "'a'.csv", '"a".csv', "a b.csv", "*a.csv", "&a.csv",
         "%a.csv", "@a.csv", "`a.csv", "a,b.csv", "é.csv", "[a, b.csv", "a\\b.csv", "~.csv", "1e3.csv", "? a.csv"]


def test_names_of_files_are_texts():
    """A run writes its log to the file of this name, however the name is given."""
    scene = gg.Scene(flow="usf", phi=0.1, particles=20, run={"collisions": 5, "warmup": 1})
    for name in NAMES:
        makers = (lambda: gg.Scene(scene, output={"log": name}), lambda: scene.copy(**{"output.log": name}),
                  lambda: gg.Scene(**{**dict(scene.given()), "output.log": name}))
        gg.run(makers[len(name) % 3]())
        assert os.listdir() == [name]
        os.remove(name)


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


@pytest.mark.parametrize("name", ["2026-11-28T17:30/usf.yaml", "a: b.yaml", "C:usf", "https://example.org/usf.yaml", "a:b"])
def test_file_name_with_a_colon_that_is_not_there(name):
    """The error is about a missing file, not about a text."""
    with pytest.raises(gg.BadFile, match="cannot|no such|No such"):
        gg.Scene(name)


def test_texts_of_one_line():
    assert gg.Scene("{flow: usf, phi: 0.1}") == gg.Scene("flow: usf\nphi: 0.1") == gg.Scene('{"flow": "usf", "phi": 0.1}')
    assert gg.Scene("flow: usf").flow == "usf"


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


MINE = {"mine": {"temperature": "phi*e", "N1": "-phi/2"}}


def with_theories():
    with open("points.csv", "w", encoding="utf-8") as file:
        file.write("phi,temperature\n0.1,3.5\n")
    with open("scene.yaml", "w", encoding="utf-8") as file:
        file.write("flow: usf\nphi: 0.1\ntheories:\n  mine: {temperature: phi*e, N1: -phi/2}\n  table: points.csv\n")
    return gg.Scene("scene.yaml")


COPIES = {"copy()": lambda s: s.copy(), "pickle": lambda s: pickle.loads(pickle.dumps(s)), "copy": copy.copy, "deepcopy": copy.deepcopy,
          "yaml": lambda s: gg.Scene(s.to_yaml()), "all": lambda s: gg.Scene(s.to_yaml(all=True)), "json": lambda s: gg.Scene(s.to_json()),
          "scene": gg.Scene, "simulation": lambda s: gg.Simulation(s).scene,
          "pickled simulation": lambda s: pickle.loads(pickle.dumps(gg.Simulation(s))).scene}


@pytest.mark.parametrize("way", COPIES)
def test_theories_of_the_text_stay(way):
    """Formulas and tables answer in every copy, also from another folder."""
    s = with_theories()
    s.particles = 100
    os.mkdir("elsewhere")
    os.chdir("elsewhere")
    t = COPIES[way](s)
    if "simulation" not in way:  # a simulation has its seed and sizes given
        assert t == s
    assert t.theories == {**MINE, "table": os.path.realpath("../points.csv")}
    assert gg.theory(t, "mine")["temperature"] == pytest.approx(0.09) and gg.theory(t, "table")["temperature"] == 3.5


def test_dicts_and_back():
    """Nested as in the file, plain values, theories too."""
    s = gg.Scene(flow="usf", phi=0.1, e={11: 0.9, 12: 0.8, 22: 0.7}, species=[{"fraction": 0.5}, {"fraction": 0.5, "mass": 2}],
                 run={"collisions": 100}, theories={"mine": {"N1": "phi"}})
    found = s.to_dict()
    assert found["collision"]["e"] and found["run"] == {"collisions": 100} and "md" not in found
    again = gg.Scene.from_dict(json.loads(json.dumps(found)))
    assert again.to_yaml(all=True) == s.to_yaml(all=True) and again.theories == s.theories
    with pytest.raises(TypeError, match="dict"):
        gg.Scene.from_dict("flow: usf")


def test_formulas_that_use_each_other():
    """Names in any order; intermediate values are no answers; the text stays."""
    formulas = {"temperature": "2*w", "w": "phi + v", "v": "e"}
    s = gg.Scene(flow="usf", phi=0.1, e=0.9, theories={"mine": formulas})
    assert dict(gg.theory(s, "mine")) == {"temperature": 2 * (0.1 + 0.9)}
    assert gg.Scene(s.to_yaml()).theories == {"mine": formulas}
    with pytest.raises(gg.BadInput, match="depends on itself: w uses v uses w"):
        gg.Scene(flow="usf", phi=0.1, theories={"mine": {**formulas, "v": "w"}})


def test_theories_as_keys():
    """Theories as keyword, in a dict, beside other texts; equality compares them."""
    keyword, table = gg.Scene(flow="usf", phi=0.1, theories=MINE), gg.Scene({"flow": "usf", "phi": 0.1, "theories": MINE})
    without, other = gg.Scene(flow="usf", phi=0.1), gg.Scene(flow="usf", phi=0.1, theories={"mine": {"temperature": "phi"}})
    assert keyword == table != without and keyword != other and without.theories == {}
    with pytest.raises(gg.BadInput, match="add"):
        without.theories = MINE


def test_theories_of_the_text_in_a_sweep():
    """The points have the theories, also points that are read from the folder."""
    gg.sweep(with_theories(), e=[0.5, 0.7], does="theory", folder="u")
    found = gg.Sweep.load("u")
    assert [point.read().theories["mine"]["temperature"] for point in found] == pytest.approx([0.05, 0.07])
    assert [point.read().theories["table"]["temperature"] for point in found] == [3.5, 3.5]


def test_flows_of_the_page_are_those_of_the_library():
    """web/flows.js and web/controls.js agree with the library's table of flows: walls, shear, gravity."""
    flows = gg.catalogue.flows()
    assert flows["couette"].traits == "walls moving_walls may_fall" and flows["usf"].traits == "sheared"
    with open(os.path.join(SOURCE, "web", "flows.js"), encoding="utf-8") as file:
        page = file.read()
    with open(os.path.join(SOURCE, "web", "controls.js"), encoding="utf-8") as file:
        controls = file.read()
    walled = re.search(r"WALLED = \[(.*?)\]", page)[1]
    assert set(re.findall(r"\w+", walled)) == {name for name in flows if "walls" in gg.catalogue.traits(name)}
    sheared = re.search(r"sheared = .*?/(\S+)/\.test", page)[1]
    assert {name for name in flows if re.search(sheared, name)} == {name for name in flows if "sheared" in gg.catalogue.traits(name)}
    assert set(re.findall(r"\w+", re.search(r"FLOWS = \[(.*?)\]", controls)[1])) <= set(flows)
    gravity = dict(re.findall(r'(\w+): "(\[.*?\])"', re.search(r"GRAVITY = \{(.*?)\};", controls)[1]))
    assert set(gravity) == {name for name in flows if "falls" in gg.catalogue.traits(name)}
    for name, value in gravity.items():
        assert gg.Scene(flow=name, phi=0.1).gravity == yaml.read(value)


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
    assert declared - called == listed
