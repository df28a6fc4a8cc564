# SPDX-License-Identifier: GPL-3.0-or-later
"""Own observables, theories and laws: their numbers, their exceptions, and the same runs from tables and functions."""
import copy
import pickle

import numpy as np
import pytest

import graingas as gg


@gg.define_observable("second")
def second(sample):
    """Mean square velocity over 3."""
    return (sample.velocity**2).sum() / 3 / sample.n


def test_observable_measures_what_the_library_does(short):
    result = gg.run(short.add(second))
    assert result["second"].mean == pytest.approx(result["temperature"].mean, rel=1e-9)
    assert result["second"].error == pytest.approx(result["temperature"].error, rel=1e-6)
    assert (result["second"].unit, result["second"].symbol) == ("1", None)


@gg.define_theory("ours", "temperature")
def ours(facts):
    return facts.phi * facts.pairs[0][0].e


def falling(g):
    return 0.9 if g < 1 else 0.8


LAW = gg.define_law(falling)
UNNAMED = gg.define_law(lambda g: 0.9)


def test_importable_functions_pickle(short):
    """Pickles have the name, or that of the function, and tables their numbers. The runs are the same."""
    for extensions in [second], [second, ours], [LAW], [UNNAMED], [gg.define_law(falling, "again")], \
            [gg.define_observable("third", {"x": "d"})(falling_sample)], [gg.define_law(([0, 1, 5], [0.95, 0.9, 0.8]))]:
        s = short.copy().add(*extensions)
        t = pickle.loads(pickle.dumps(s))
        assert t == s and t != short and [e.name for e in t._extensions] == [e.name for e in extensions]
        one, other = gg.run(s), gg.run(t)
        assert one.identity == other.identity and list(one) == list(other)
    assert pickle.loads(pickle.dumps(second)) is second and pickle.loads(pickle.dumps(UNNAMED)) is UNNAMED
    sim = gg.Simulation(short.copy().add(LAW))
    assert pickle.loads(pickle.dumps(sim)).collide(200).hash == sim.collide(200).hash


def falling_sample(sample):
    return sample.velocity[0, 0]


def test_functions_without_a_name_do_not_pickle(short):
    def inner(sample):
        return 0
    for extension in gg.define_observable("a")(inner), gg.define_theory("a", "N1")(lambda f: 0), gg.define_law(lambda g: 0.9), \
            gg.define_observable("a", collision=lambda view: None)(falling_sample):
        with pytest.raises(TypeError, match="top level"):
            pickle.dumps(short.copy().add(extension))


def test_copies_keep_functions(short):
    """Copies keep functions without a name, too."""
    s = short.add(gg.define_law(lambda g: 0.8), second)
    for t in copy.copy(s), copy.deepcopy(s), s.copy():
        assert t == s and gg.run(t).identity == gg.run(s).identity
    with pytest.raises(gg.BadInput, match=r"own, second.*formulas"):
        gg.sweep(s, e=[0.9])


@pytest.mark.parametrize("name", ["md", "dsmc", "z", "Z", "unit", "quantity", "md_error", "dsmc_x", "mine_error", "beyond_expected"])
def test_names_of_columns_are_no_names_of_theories(short, name):
    """to_dataframe()["md"] is that of md: a theory of this name is rejected, from Python and in the text of a scene."""
    with pytest.raises(gg.BadInput, match="reserved"):
        gg.theory(short, gg.define_theory(name, "N1")(lambda facts: 0))
    with pytest.raises(gg.BadInput, match="reserved"):
        gg.Scene(f"flow: usf\nphi: 0.1\ntheories: {{{name}: {{N1: phi}}}}")


def test_names_of_errors_are_no_names_of_quantities(short):
    """Grids call the error of temperature temperature_error."""
    with pytest.raises(gg.BadInput, match="reserved"):
        short.add(gg.define_observable("mine", ["temperature_error"])(falling_sample))


@pytest.mark.parametrize("engine", ["md", "dsmc"])
def test_state_and_collisions(short, engine):
    """A state for each replica: collisions counted in an interval, as the sample counts them."""
    def count(view, state):
        assert np.allclose((view.normal**2).sum(), 1)
        state[0] += 1

    @gg.define_observable("counting", {"seen": "1", "counted": "1"}, state=2, collision=count)
    def counting(sample, state):
        seen, state[0] = state[0], 0
        return {"seen": seen, "counted": sample.collisions}
    short.engine = engine
    if engine == "dsmc":
        short = gg.Scene(flow="usf", phi=0.1, engine="dsmc", dsmc={"particles": 500}, run={"collisions": 100, "warmup": 50})
    result = gg.run(short.copy(**{"run.replicas": 2}).add(counting), threads=2)
    assert result["seen"].mean == pytest.approx(result["counted"].mean, rel=0.02) and result["seen"].mean > 100


def test_sample_has_everything(short):
    seen = []

    @gg.define_observable("looking")
    def looking(sample):
        if not seen:
            seen.append((sample.position, sample.velocity, sample.spin, sample.species, sample.mass, sample.box, sample.stress))
        return 0
    gg.run(short.add(looking))
    position, velocity, spin, species, mass, box, stress = seen[0]
    assert position.shape == velocity.shape == spin.shape == (200, 3) and species.shape == (200,) and mass.shape == (1,)
    assert np.all(position >= 0) and np.all(position <= box) and stress.shape == (3, 3)


def test_theory_beside_the_others(short):
    @gg.define_theory("mine", ["temperature", "N1"], title="A theory")
    def mine(facts):
        return {"temperature": facts.phi * facts.pairs[0][0].e, "N1": facts.species[0].mass}
    found = gg.theory(short, mine)
    assert found["temperature"] == pytest.approx(0.09) and found["N1"] == 1 and found.title == "A theory"
    comparison = gg.compare(short.copy().add(mine))
    assert comparison["temperature"].theory["mine"] == pytest.approx(0.09)
    comparison.write("c.h5")
    assert gg.read("c.h5")["temperature"].theory["mine"] == pytest.approx(0.09)


@pytest.mark.parametrize("answer, reason", [("is only for é", "mine is only for é"),
                                            (gg.DoesNotApply("describes\ncooling"), "mine describes cooling")])
def test_reason_of_a_theory(short, answer, reason):
    @gg.define_theory("mine", "temperature")
    def mine(facts):
        if isinstance(answer, Exception):
            raise answer
        return answer
    assert gg.theory(short, mine).reason == reason


def test_own_theory_over_a_grid(short):
    pytest.importorskip("xarray")
    mine = gg.define_theory("mine", "temperature")(lambda facts: facts.pairs[0][0].e * 2)
    found = gg.scan(short, e=[0.5, 0.75], theories=[mine, "lun1991"], quantities=["temperature"])
    assert list(found["temperature"].sel(theory="mine").values) == [1.0, 1.5]


def test_law_as_table_function_and_constant(short):
    """A constant law is collision.e, up to the path of the engine; a table is the function that it samples."""
    expected = gg.run(short)["temperature"]
    constant = gg.run(short.copy(e=0.5).add(gg.define_law(lambda g: 0.9)))["temperature"]
    assert constant.mean == pytest.approx(expected.mean, rel=1e-9)
    table = gg.run(short.copy().add(gg.define_law(([1.0], [0.7]))))["temperature"]
    function = gg.run(short.copy().add(gg.define_law(lambda g, i, j: 0.7)))["temperature"]
    assert table.mean == pytest.approx(function.mean, rel=1e-9) != expected.mean


def test_compiled_law(short):
    numba = pytest.importorskip("numba")

    @numba.cfunc("float64(voidptr, float64, int32, int32)")
    def law(context, speed, first, second):
        return 0.7
    compiled = gg.run(short.copy().add(gg.define_law(law)))["temperature"]
    assert compiled.mean == gg.run(short.copy().add(gg.define_law(lambda g: 0.7)))["temperature"].mean
    for wrong, function in ("float32(float32)", lambda g: 0.7), ("float64(float64, int32, int32)", lambda g, i, j: 0.7):
        with pytest.raises(TypeError, match="float64.voidptr"):
            gg.define_law(numba.cfunc(wrong)(function))


def test_law_in_a_simulation(short):
    sim = gg.Simulation(short.copy().add(gg.define_law(lambda g: 0.6)))
    events = sim.events(200)
    assert np.allclose((events.impulse * events.k).sum(1), 0.5 * 1.6 * events.normal_speed)


class Ours(Exception):
    pass


def raises(*_):
    raise Ours("from the function")


def turns_bad(calls):
    """A law that works when it is first tested, and raises later."""
    def law(g):
        calls.append(g)
        if len(calls) > 3000:
            raise Ours("from the law")
        return 0.9
    return law


@pytest.mark.parametrize("make", [
    lambda s: gg.run(s.add(gg.define_observable("a")(raises))),
    lambda s: gg.compare(s.add(gg.define_observable("a")(raises)), threads=2),
    lambda s: gg.run(s.add(gg.define_observable("a", collision=raises)(lambda sample: 0))),
    lambda s: gg.theory(s, gg.define_theory("a", "N1")(raises)),
    lambda s: gg.compare(s.add(gg.define_theory("a", "N1")(raises))),
    lambda s: gg.scan(s, e=[0.5], theories=[gg.define_theory("a", "N1")(raises)]),
    lambda s: s.add(gg.define_law(raises)),
    lambda s: gg.run(s.copy(collisions=1e9).add(gg.define_law(turns_bad([])))),
    lambda s: gg.Simulation(s.add(gg.define_law(turns_bad([])))).collide(10**9)])
def test_exceptions_come_out_of_the_call(short, make):
    with pytest.raises(Ours):
        make(short)


@pytest.mark.parametrize("function, words", [
    (lambda sample: [1, 2], "returned 2 numbers"), (lambda sample: {"b": 1}, "no quantity 'b'")])
def test_wrong_answers(short, function, words):
    with pytest.raises(gg.BadInput, match=words):
        gg.run(short.add(gg.define_observable("a")(function)))


@pytest.mark.parametrize("wrong", [
    lambda s: s.add(gg.define_observable("two words")(lambda sample: 0)),
    lambda s: s.add(gg.define_observable("temperature")(lambda s: 0)),
    lambda s: s.add(gg.define_theory("lun1991", "N1")(lambda f: 0)),
    lambda s: s.add(gg.define_theory("a", "nothing")(lambda f: 0)),
    lambda s: s.add(gg.define_law(lambda g: 2)), lambda s: s.add(gg.define_law(([1, 0], [0.5, 0.5]))),
    lambda s: gg.define_law(([1, 2], [0.5])), lambda s: s.add(second).add(second)])
def test_definitions_are_checked(short, wrong):
    with pytest.raises(gg.BadInput):
        wrong(short)
