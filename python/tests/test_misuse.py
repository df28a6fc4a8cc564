# SPDX-License-Identifier: GPL-3.0-or-later
"""No misuse in Python crashes: wrong types and shapes, after close, from own callbacks, from two threads, in
a fork. Each row of a table is a misuse and the exception that it raises; a crash would end the test's process."""
import gc
import os
import pickle
import signal
import sys
import threading
import time

import numpy as np
import pytest

import graingas as gg

SHORT = {"flow": "usf", "phi": 0.1, "particles": 100, "run": {"collisions": 100, "warmup": 20}}


def scene(**keys):
    return gg.Scene(SHORT, **keys)


def simulation(engine="md"):
    return gg.Simulation(scene(engine=engine))


def closed():
    sim = simulation()
    sim.close()
    sim.close()
    return sim


def closed_trajectory():
    gg.run(scene(trajectory_every=20), output="t.h5")
    trajectory = gg.trajectory("t.h5")
    trajectory.close()
    return trajectory


TYPES = [
    (lambda: gg.Scene(3), TypeError), (lambda: gg.Scene(b"flow: usf\0"), gg.BadInput),
    (lambda: gg.Scene(object()), TypeError),
    (lambda: gg.Scene("flow: [usf"), gg.BadInput), (lambda: gg.Scene("a: {b: " * 10000), gg.BadInput),
    (lambda: gg.Scene(""), gg.BadFile), (lambda: gg.Scene("\ud800: 1"), gg.BadInput),
    (lambda: scene()[3], TypeError), (lambda: scene()[None], TypeError), (lambda: scene().__setitem__(3, 1), TypeError),
    (lambda: scene().__setitem__("phi", object()), TypeError),
    (lambda: scene().__setitem__("phi", np.zeros((2, 2))), gg.BadInput),
    (lambda: scene().__setitem__("phi", "1\n2"), gg.BadInput),
    (lambda: scene().__setitem__("x" * 100000, 1), gg.BadInput),
    (lambda: scene().__setitem__("phi", float("nan")), gg.BadInput), (lambda: scene().add(3), TypeError),
    (lambda: gg.run(None), gg.BadInput), (lambda: gg.run(3), TypeError),
    (lambda: gg.run(scene(), threads=0), gg.BadInput),
    (lambda: gg.run(scene(), threads=2**40), gg.BadInput),
    (lambda: gg.run(scene(), threads="two"), (ValueError, TypeError)),
    (lambda: gg.run(scene(), output=3), TypeError), (lambda: gg.run(scene(), resume="nowhere.h5"), gg.BadFile),
    (lambda: gg.run(scene(), output="/dev/full"), gg.BadFile), (lambda: gg.read(3), TypeError),
    (lambda: gg.run(scene())[3], TypeError), (lambda: gg.run(scene()).find(None), TypeError),
    (lambda: gg.local_fluxes(3), TypeError), (lambda: gg.local_fluxes(gg.run(scene())), gg.BadInput),
    (lambda: gg.Simulation(None), gg.BadInput), (lambda: gg.Simulation(scene(), stream=-1), gg.BadInput),
    (lambda: gg.Simulation(scene(), stream=1.5), gg.BadInput),
    (lambda: gg.Simulation(scene(), stream=2**70), gg.BadInput),
    (lambda: simulation().advance(-1), gg.BadInput), (lambda: simulation().advance(float("nan")), gg.BadInput),
    (lambda: simulation().advance(float("inf")), gg.BadInput), (lambda: simulation().advance("x"), ValueError),
    (lambda: simulation().advance(None), TypeError), (lambda: simulation().collide(-1), gg.BadInput),
    (lambda: simulation().collide(1.5), gg.BadInput), (lambda: simulation().collide(2**64), gg.BadInput),
    (lambda: simulation().on_collision(3), TypeError), (lambda: simulation().events(-1), gg.BadInput),
    (lambda: simulation().save("no/such/folder.h5"), gg.BadFile),
    (lambda: gg.Simulation.load("nowhere.h5"), gg.BadFile),
    (lambda: gg.Simulation.load(__file__), gg.BadFile), (lambda: gg.trajectory(__file__), gg.BadFile),
    (lambda: gg.Simulation(scene(), positions=np.zeros((3, 3))), gg.BadInput),
    (lambda: gg.Simulation(scene(), positions=np.zeros(300)), gg.BadInput),
    (lambda: gg.Simulation(scene(), velocities="abc"), gg.BadInput),
    (lambda: gg.Simulation(scene(), velocities=np.zeros((0, 3))), gg.BadInput),
    (lambda: gg.Simulation(scene(), positions=np.full((100, 3), np.nan), velocities=np.zeros((100, 3))), gg.BadInput),
    (lambda: simulation().set_grains(velocities=np.zeros((99, 3))), gg.BadInput),
    (lambda: simulation().set_grains(velocities=np.zeros((100, 3), complex)), gg.BadInput),
    (lambda: simulation().set_grains(positions=np.zeros((100, 3))), gg.BadInput),
    (lambda: simulation().set_grains(velocities=np.full((100, 3), np.inf)), gg.BadInput),
    (lambda: simulation().set_grains(species=np.full(100, 7)), gg.BadInput),
    (lambda: simulation().set_grains(species=[0.5] * 100), gg.BadInput),
    (lambda: simulation("dsmc").set_grains(positions=np.zeros((5000, 3))), gg.BadInput),
    (lambda: simulation().__setitem__(3, 1), TypeError), (lambda: simulation().__setitem__("e", object()), TypeError),
    (lambda: simulation().__setitem__("e", float("nan")), gg.BadInput),
    (lambda: simulation().__setitem__("x" * 100000, 1), gg.BadInput), (lambda: simulation()[3], TypeError),
    (lambda: gg.Simulation.from_bytes("text"), TypeError), (lambda: gg.Simulation.from_bytes(b""), gg.BadFile),
    (lambda: gg.Result.from_bytes(b"x" * 99), gg.BadFile), (lambda: gg.Comparison.from_bytes(None), TypeError),
    (lambda: gg.Result.from_bytes(simulation().to_bytes()), gg.GraingasError),
    (lambda: gg.export(3, "x"), TypeError), (lambda: gg.export(__file__, "x"), gg.BadFile),
    (lambda: gg.theories(scene(), 3), TypeError),
    (lambda: gg.cite(3), TypeError), (lambda: gg.cite("nobody"), gg.NotFound), (lambda: gg.cite("\0"), gg.BadInput),
    (lambda: gg.theory(scene(), 3), TypeError), (lambda: gg.theory(scene(), "\0"), gg.BadInput),
    (lambda: gg.define_observable(lambda s: 0), TypeError),
    (lambda: gg.define_observable("a")(3), TypeError), (lambda: gg.define_theory("a", "N1")(None), TypeError),
    (lambda: gg.define_law(3), TypeError), (lambda: gg.define_law("abc"), TypeError),
    (lambda: gg.define_law(np.zeros((2, 3, 4))), gg.BadInput), (lambda: gg.define_law(([], [])), gg.BadInput),
    (lambda: scene().add(gg.define_law(([float("nan")], [0.5]))), gg.BadInput),
    (lambda: scene().add(gg.define_law(lambda g: "x")), ValueError),
    (lambda: scene().add(gg.define_law(lambda g: None)), TypeError),
    (lambda: gg.run(scene().add(gg.define_observable("a")(lambda s: "x"))), ValueError),
    (lambda: gg.run(scene().add(gg.define_observable("a")(lambda: 0))), TypeError),
    (lambda: gg.run(scene().add(gg.define_observable("a", state=-1)(lambda s: 0))), gg.BadInput),
    (lambda: gg.run(scene().add(gg.define_observable("a" * 1000)(lambda s: 0))), gg.BadInput),
    (lambda: gg.theory(scene(), gg.define_theory("a", "N1")(lambda f: "x" * 10**6)).reason.nothing, AttributeError),
    (lambda: gg.sweep(scene(), e=[0.9], folder="\0"), gg.BadInput),
    (lambda: gg.sweep(scene(), e=[object()]), TypeError), (lambda: gg.sweep(scene(), e=[0.9], does="run}\nphi: 0.2"), gg.BadInput),
    (lambda: gg.sweep(scene(), e=[0.9], seeds="common, does: theory"), gg.BadInput),
    (lambda: pickle.dumps(scene().add(gg.define_law(lambda g: 0.9))), TypeError),
]

NUMBERS = [float("nan"), float("inf"), None, "x", "2", 1 + 2j, [1], 10**400, object()]
WHOLE = [*NUMBERS, 1.5, -1, True]
TAKES = {
    "time": (NUMBERS, lambda x: simulation().advance(x)), "every": (NUMBERS, lambda x: next(simulation().frames(x))),
    "collisions": (WHOLE, lambda x: simulation().collide(x)), "of events": (WHOLE, lambda x: simulation().events(x)),
    "stream": (WHOLE, lambda x: gg.Simulation(scene(), stream=x)), "state": (WHOLE, lambda x: gg.define_observable("a", state=x)),
    "n": ([x for x in WHOLE if x is not None], lambda x: next(simulation().frames(1, x))),
    "threads": ([0, *(x for x in WHOLE if x is not None)], lambda x: gg.run(scene(), threads=x)),
    "of a sweep": ([0, *(x for x in WHOLE if x is not None)], lambda x: gg.sweep(scene(), e=[0.9], threads=x)),
    "points": ([1, *WHOLE], lambda x: gg.relax(scene(), 1, points=x)), "replicas": ([1, *WHOLE], lambda x: gg.relax(scene(), 1, replicas=x)),
    "until": ([0, -1, *NUMBERS], lambda x: gg.relax(scene(), x)),
    "protocol": (NUMBERS, lambda x: gg.relax(scene(), 2, protocol=[(x, {"collision.e": 0.5})]))}


@pytest.mark.parametrize("argument", TAKES)
def test_numbers_as_arguments(argument):
    """Errors about values that are no numbers, or not allowed, name the argument: no raw error of a conversion."""
    values, use = TAKES[argument]
    for value in values:
        with pytest.raises((gg.BadInput, TypeError)) as raised:
            use(value)
        words = str(raised.value)
        named = words.startswith(argument.removeprefix("of ").replace("events", "collisions").replace("a sweep", "threads"))
        assert named and ("allowed: " in words or "expected a" in words), (value, words)


CLOSED = [
    (lambda: closed().advance(1), gg.BadInput), (lambda: closed().collide(1), gg.BadInput),
    (lambda: closed().state, gg.BadInput),
    (lambda: closed().grains, gg.BadInput), (lambda: closed().events(3), gg.BadInput),
    (lambda: closed().save("s.h5"), gg.BadInput),
    (lambda: closed().copy(), gg.BadInput), (lambda: closed().set_grains(), gg.BadInput),
    (lambda: closed().species, gg.BadInput), (lambda: closed().walls, gg.BadInput),
    (lambda: closed().hash, gg.BadInput), (lambda: closed().take_sums(), gg.BadInput),
    (lambda: pickle.dumps(closed()), gg.BadInput),
    (lambda: closed().__setitem__("e", 0.8), gg.BadInput), (lambda: closed().to_bytes(), gg.BadInput),
    (lambda: closed_trajectory()[0], gg.BadInput), (lambda: len(closed_trajectory()), gg.BadInput),
]


@pytest.mark.parametrize("row", range(len(TYPES)))
def test_wrong_types_and_values(row):
    misuse, expected = TYPES[row]
    with pytest.raises(expected):
        misuse()


@pytest.mark.parametrize("row", range(len(CLOSED)))
def test_after_close(row):
    misuse, expected = CLOSED[row]
    with pytest.raises(expected):
        misuse()


INSIDE = {
    "advance": lambda sim: sim.advance(1), "collide": lambda sim: sim.collide(1), "events": lambda sim: sim.events(1),
    "state": lambda sim: sim.state, "grains": lambda sim: sim.grains, "species": lambda sim: sim.species,
    "hash": lambda sim: sim.hash, "sums": lambda sim: sim.take_sums(), "save": lambda sim: sim.save("s.h5"),
    "copy": lambda sim: sim.copy(),
    "set_grains": lambda sim: sim.set_grains(velocities=np.zeros((100, 3))),
    "set": lambda sim: sim.__setitem__("collision.e", 0.8), "bytes": lambda sim: sim.to_bytes(),
    "close": lambda sim: sim.close(), "pickle": lambda sim: pickle.dumps(sim)}


@pytest.mark.parametrize("engine", ["md", "dsmc"])
@pytest.mark.parametrize("use", INSIDE)
def test_from_own_callback(engine, use):
    sim = simulation(engine)
    sim.on_collision(lambda event: INSIDE[use](sim))
    with pytest.raises(gg.Busy):
        sim.collide(500)
    sim.collide(50)


def test_other_things_from_a_callback():
    """A callback may use all objects that are not in use: other simulations, runs, theories, files."""
    sim, other, done = simulation(), simulation(), []

    def work(event):
        sim.on_collision(None)
        done.append((other.advance(0.1), gg.run(scene()), gg.theory(scene(), "lun1991"), repr(sim), dir(event), repr(event)))
    sim.on_collision(work)
    sim.collide(100)
    assert len(done) == 1 and "in use" in done[0][3]


def test_from_own_observable():
    """An observable may change the scene of its run, and start another run."""
    s = scene()

    @gg.define_observable("inner")
    def inner(sample):
        s.phi = 0.2
        inner.kept = sample
        return gg.theory(scene(), "lun1991")["temperature"] if sample.time < 1 else 0
    gg.run(s.add(inner))
    assert s.phi == 0.2
    with pytest.raises(gg.BadInput, match="during the call"):
        inner.kept.velocity


def test_state_that_is_kept():
    """The state of an observable is so large that its memory returns to the system after the run."""
    kept = []

    @gg.define_observable("counter", state=100000)
    def counter(sample, state):
        state[0] += 1
        kept.append(state)
        return state[0]
    gg.run(scene().add(counter))
    gc.collect()
    for i, state in enumerate(kept):
        assert state[0] == i + 1
        state[:] = 1.5


def test_own_law_uses_the_simulation():
    uses = []

    def law(g):
        if uses:
            uses[0].state
        return 0.9
    sim = gg.Simulation(scene().add(gg.define_law(law)))
    uses.append(sim)
    with pytest.raises(gg.Busy):
        sim.collide(10**9)


@pytest.mark.parametrize("engine", ["md", "dsmc"])
def test_one_simulation_in_two_threads(engine):
    """One thread uses it at a time; the other gets an error."""
    sim, refused, worked, stop = simulation(engine), [], [], time.monotonic() + 1

    def work(use):
        while time.monotonic() < stop:
            try:
                use()
                worked.append(1)
            except gg.Busy:
                refused.append(1)
    uses = [lambda: sim.collide(100), lambda: sim.advance(0.1), lambda: sim.grains, lambda: sim.take_sums(),
            lambda: sim.events(10)]
    threads = [threading.Thread(target=work, args=(use,)) for use in uses]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert refused and worked
    sim.collide(10)


def test_closed_while_in_use():
    sim = simulation()
    thread = threading.Thread(target=lambda: sim.collide(200000))
    thread.start()
    refused = 0
    while thread.is_alive():
        try:
            sim.close()
        except gg.Busy:
            refused += 1
    thread.join()
    sim.close()
    assert sim._handle.closed


def test_scene_changed_in_threads():
    s = scene()

    def change(value):
        for _ in range(100):
            s.phi = value
            s.copy().to_yaml()
    threads = [threading.Thread(target=change, args=(phi,)) for phi in (0.1, 0.2, 0.3)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert s.phi in (0.1, 0.2, 0.3)


def test_forgotten_objects():
    """Objects that callbacks and results need live as long as they do."""
    def forgotten():
        s = scene().add(gg.define_observable("mine")(lambda sample: sample.velocity.sum()), gg.define_law(lambda g: 0.8))
        return gg.Simulation(s), gg.run(s), gg.compare(s).md, gg.theories(s).theories["grad"]
    sim, result, md, theory = forgotten()
    gc.collect()
    sim.collide(1000)
    assert np.isfinite(result["mine"].mean) and np.isfinite(md["mine"].mean) and theory.name == "grad"
    events = sim.events(10)
    del sim
    gc.collect()
    assert events.time[-1] > 0


def in_child(work):
    """Exit code of a forked process; a signal is negative."""
    child = os.fork()
    if child == 0:
        try:
            signal.alarm(20)
            work()
            os._exit(0)
        except BaseException as error:
            print(repr(error), file=sys.stderr)
            os._exit(9)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


def test_after_fork():
    sim, result, s = simulation(), gg.run(scene()), scene()
    sim.collide(100)
    expected = sim.copy().collide(100).hash

    def work():
        assert sim.collide(100).hash == expected
        assert result["temperature"].mean == gg.run(s)["temperature"].mean
        s.phi = 0.2
        sim.close()
    assert in_child(work) == 0
    assert sim.collide(100).hash == expected


def test_fork_during_a_call():
    """The child's copy of a simulation that advances in the parent raises an error."""
    sim = simulation()
    thread = threading.Thread(target=lambda: sim.collide(300000))
    thread.start()

    def work():
        with pytest.raises(gg.Busy):
            sim.state
        assert gg.run(scene())["temperature"].mean > 0
    code = in_child(work)
    thread.join()
    assert code == 0


def test_damaged_pickles():
    content = pickle.dumps(simulation())
    for cut in range(200, len(content) - 1, len(content) // 7):
        damaged = content[:cut] + bytes([content[cut] ^ 255]) + content[cut + 1:]
        try:
            pickle.loads(damaged).collide(10)
        except Exception:
            pass


def test_end_of_the_program_during_a_run():
    """A daemon thread may still be in the library."""
    import subprocess
    code = ("import graingas as gg, threading, time\n"
            "s = gg.Scene(flow='usf', phi=0.1, run={'relative_error': 1e-6}).add(gg.define_law(lambda g: 0.9))\n"
            "threading.Thread(target=lambda: gg.run(s), daemon=True).start()\ntime.sleep(1)\n")
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, timeout=60)
    assert done.returncode == 0, done.stderr
