# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulations: conservation, the same bits from copies, collisions by callback and in bulk, Ctrl-C, trajectories."""
import os
import pathlib
import pickle
import signal
import threading
import time

import numpy as np
import pytest

import graingas as gg


@pytest.fixture(params=["md", "dsmc"])
def either(request, short):
    return gg.Simulation(short.copy(engine=request.param))


@pytest.fixture
def sim(short):
    return gg.Simulation(short)


def test_state_is_that_of_the_grains(either):
    either.advance(2)
    g, state = either.grains, either.state
    assert state.temperature == pytest.approx((g.velocity**2).sum() / 3 / len(g))
    assert state.collisions > 0 and either.species[0].grains == len(g) == state.grains
    assert (g.position is None) == (state.box[0] == 0)


def test_notebooks_show_the_state(either):
    either.collide(100)
    text = either._repr_html_()
    assert f"<td>{either.state.collisions}</td>" in text and f"<td>{either.temperature:.4g}</td>" in text and "usf" not in text
    assert f"<th>{either['engine']}</th>" in text and either.scene.title in text
    either.close()
    assert "closed" in either._repr_html_()


def test_elastic_grains_keep_their_energy():
    sim = gg.Simulation(gg.Scene(flow="equilibrium", phi=0.2, particles=300, e=1))
    before = sim.temperature
    sim.collide(20000)
    assert sim.temperature == pytest.approx(before, rel=1e-12)
    assert np.allclose(sim.grains.velocity.sum(axis=0), 0, atol=1e-9)


def test_grains_do_not_overlap(sim):
    sim.collide(2000)
    g, (Lx, Ly, Lz), offset = sim.grains, sim.state.box, sim.state.image_offset
    d = g.position[:, None] - g.position[None]
    rows = np.round(d[..., 1] / Ly)
    d[..., 1] -= rows * Ly
    d[..., 0] -= rows * offset
    d[..., 0] -= np.round(d[..., 0] / Lx) * Lx
    d[..., 2] -= np.round(d[..., 2] / Lz) * Lz
    distance = np.sqrt((d**2).sum(-1))[np.triu_indices(len(g), 1)]
    assert distance.min() > 1 - 1e-9


def test_copies_continue_with_the_same_bits(either):
    either.collide(1000)
    either.save("s.h5")
    others = [either.copy(), pickle.loads(pickle.dumps(either)), gg.Simulation.load("s.h5"),
              gg.Simulation.load("s.h5", either.scene)]
    for other in others:
        assert other.hash == either.hash and other.scene == either.scene
    for one in [either, *others]:
        one.collide(2000)
    assert {other.hash for other in others} == {either.hash}


def test_grains_from_outside(either):
    """Grains that are set are read back with the same energy; for overlaps the error names the pair."""
    g = either.grains
    arrays = {"velocities": g.velocity, "spins": g.spin, "species": g.species}
    if g.position is not None:
        arrays["positions"] = g.position
    made = gg.Simulation(either.scene, **arrays)
    assert np.allclose(made.grains.velocity, g.velocity, atol=1e-12) and made.time == 0
    assert made.temperature == pytest.approx(either.temperature, rel=1e-12)
    either.collide(500)
    g = either.grains
    either.set_grains(velocities=2 * g.velocity)
    assert np.allclose(either.grains.velocity, 2 * g.velocity, atol=1e-12) and either.time > 0
    either.collide(100)


def test_overlaps_are_named(sim):
    g = sim.grains
    g.position[7] = g.position[3]
    with pytest.raises(gg.BadInput, match="3 and 7|7 and 3|4 and 8|8 and 4"):
        gg.Simulation(sim.scene, positions=g.position, velocities=g.velocity)


def test_two_temperatures_relax():
    """Elastic grains, half of them hot: both halves end at the mean."""
    start = gg.Simulation(gg.Scene(flow="equilibrium", phi=0.1, particles=400, e=1))
    g = start.grains
    g.velocity[:200] *= 3
    sim = gg.Simulation(start.scene, positions=g.position, velocities=g.velocity)
    hot = (sim.grains.velocity[:200] ** 2).sum(1).mean() / (sim.grains.velocity[200:] ** 2).sum(1).mean()
    sim.collide(20000)
    mixed = (sim.grains.velocity[:200] ** 2).sum(1).mean() / (sim.grains.velocity[200:] ** 2).sum(1).mean()
    assert hot > 8 and abs(mixed - 1) < 0.35


def test_keys_change_on_the_way(either):
    """From the change to e = 1 the energy stays; copies, pickles and files have the new key, earlier copies the old
    one.
    """
    before = either.copy()
    sim = gg.Simulation(gg.Scene(flow="hcs", phi=0.1, particles=200, e=0.8, engine=either.scene.engine))
    sim.collide(500)
    sim["collision.e"] = 1
    T = sim.temperature
    assert sim.collide(2000).temperature == pytest.approx(T, rel=1e-12)
    either["e"] = 0.6
    assert either["collision.e"] == either.scene.e == 0.6 and before["e"] == before.scene.e == 0.9
    either.save("s.h5")
    others = [either.copy(), pickle.loads(pickle.dumps(either)), gg.Simulation.load("s.h5"),
              gg.Simulation.from_bytes(either.to_bytes(), either.scene)]
    assert {other.collide(500).hash for other in others} == {either.collide(500).hash} != {before.collide(500).hash}
    assert all(other.scene == either.scene for other in others)


@pytest.mark.parametrize("key, value, words", [("phi", 0.2, "on the way"), ("collision.e", 1.5, "1.5"),
                                               ("collision.beta", -1, "other grains"), ("nothing", 1, "on the way")])
def test_other_keys_stay(sim, key, value, words):
    before = sim.hash, sim.scene
    with pytest.raises(gg.BadInput, match=words):
        sim[key] = value
    assert (sim.hash, sim.scene) == before


def test_keys_are_no_attributes(sim):
    with pytest.raises(AttributeError, match=r"sim\['collision.e'\]"):
        sim.e = 0.8
    with pytest.raises(AttributeError):
        sim.time = 0
    sim.label = "mine"
    assert sim["collision.e"] == 0.9


def test_own_law_stays_when_keys_change(short):
    asked = []
    sim = gg.Simulation(short.copy().add(gg.define_law(lambda g: asked.append(g) or 0.9)))
    sim["beta"] = 0.5
    del asked[:]
    sim.copy().collide(100)
    assert len(asked) >= 100


def test_streams_are_independent(short):
    assert gg.Simulation(short).hash == gg.Simulation(short).hash != gg.Simulation(short, stream=1).hash


def test_events_are_exact_collisions(sim):
    other = sim.copy()
    events = sim.events(5000)
    other.collide(5000)
    assert len(events) == 5000 and sim.hash == other.hash
    assert np.all(np.diff(events.time) >= 0) and np.all(events.normal_speed > 0)
    assert np.allclose((events.k**2).sum(1), 1)
    assert np.allclose((events.k * events.velocity).sum(1), -events.normal_speed) or \
        np.allclose((events.k * events.velocity).sum(1), events.normal_speed)
    normal = (events.impulse * events.k).sum(1)  # m/2 (1 + e) g along k
    assert np.allclose(normal, 0.5 * 1.9 * events.normal_speed)


def test_callback_sees_what_events_record(sim):
    other, seen = sim.copy(), []
    sim.on_collision(seen.append)
    sim.collide(300)
    events = other.events(300)
    assert len(seen) == 300
    for name in "grain", "k", "normal_speed", "time", "impulse":
        assert np.array_equal([getattr(event, name) for event in seen], events[name]), name


def test_callback_stops_itself(either):
    seen = []

    def watch(event):
        seen.append(event.time)
        if len(seen) == 10:
            either.on_collision(None)
    either.on_collision(watch)
    either.collide(2000)
    assert len(seen) == 10
    either.collide(100)
    assert len(seen) == 10


def test_callback_replaces_itself(either):
    first, second = [], []
    either.on_collision(lambda event: (first.append(event), either.on_collision(second.append)))
    either.collide(1000)
    assert len(first) == 1 and len(second) >= 900


def test_exception_of_the_callback_comes_out(either):
    def fail(event):
        raise ArithmeticError("from inside")
    either.on_collision(fail)
    with pytest.raises(ArithmeticError, match="from inside"):
        either.collide(10**9)
    either.collide(100)  # it receives no collisions any more, and continues
    assert either.state.collisions >= 100


def test_ctrl_c_ends_an_advance(sim):
    def interrupt():
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)
    sent = []
    threading.Timer(0.5, interrupt).start()
    with pytest.raises(KeyboardInterrupt):
        sim.advance(1e9)
    assert time.monotonic() - sent[0] < 0.5  # 0.01 s on an idle machine
    before = sim.time
    sim.advance(1)
    assert sim.time == pytest.approx(before + 1)


def interrupted_start(function):
    """Ctrl-C half a second into a start that takes minutes: the test has no time for it."""
    scene = gg.Scene(flow="hcs", phi=0.49, particles=300000, e=0.9, engine="md")
    threading.Timer(0.5, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt) as caught:
        function(scene)
    return str(caught.value)


def test_interrupted_start():
    assert interrupted_start(gg.Simulation) == "the simulation was not started"


def test_interrupted_copies_and_files(sim):
    """Ctrl-C does not wait for such calls; the simulation is unchanged."""
    sim.save("sim.h5")
    content, before = sim.to_bytes(), sim.hash
    for function in (sim.copy, sim.to_bytes, lambda: gg.Simulation.load("sim.h5"),
                     lambda: gg.Simulation.from_bytes(content)):
        threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
        with pytest.raises(KeyboardInterrupt):
            while True:
                function()
    assert sim.hash == before == gg.Simulation.load("sim.h5").hash
    sim.collide(10)


def test_what_is_left_behind_is_stopped(sim, monkeypatch):
    """The library's part of such calls, and a save, ends at its next check for a stop; the file is unchanged."""
    sim.save("sim.h5")
    content, hash = sim.to_bytes(), sim.hash
    sim.collide(100)
    begin = gg.calls.Call.__init__
    with monkeypatch.context() as patch:
        patch.setattr(gg.calls.Call, "__init__", lambda self: (begin(self), self.stop())[0])
        for function in (sim.copy, sim.to_bytes, lambda: sim.save("sim.h5"), lambda: gg.Simulation.load("sim.h5"),
                         lambda: gg.Simulation.from_bytes(content)):
            with pytest.raises(gg.GraingasError, match="interrupted|stopped"):
                function()
    assert gg.Simulation.load("sim.h5").hash == hash != sim.hash
    for kept in pathlib.Path(".").iterdir():
        assert "tmp" not in kept.name


def test_interrupted_save(words_of_ctrl_c):
    sim = gg.Simulation(gg.Scene(flow="usf", phi=0.3, particles=50000, e=0.9, engine="dsmc", **{"dsmc.particles": 50000}))
    sim.save("large.h5")
    before = sim.hash
    sim.collide(100)
    assert words_of_ctrl_c(lambda: sim.save("large.h5")) == "the file is whole or unchanged"
    assert gg.Simulation.load("large.h5").hash in (before, sim.hash)
    sim.collide(10)


def test_later_calls_wait_for_one_that_was_left_behind(sim):
    may_end = threading.Event()
    threading.Timer(0.2, lambda: os.kill(os.getpid(), signal.SIGINT)).start()
    with pytest.raises(KeyboardInterrupt):
        sim._handle.read(lambda pointer: may_end.wait(60))  # without Ctrl-C
    threading.Timer(0.2, may_end.set).start()
    sim.collide(10)
    assert may_end.is_set()


def test_calls_left_behind_before_they_begin(sim, monkeypatch):
    """Ctrl-C comes before the thread takes the simulation: another call still waits for it."""
    begins, threads = threading.Event(), []

    def interrupted(work, _):
        def late():
            begins.wait(60)
            work()
        threads.append(threading.Thread(target=late))
        threads[-1].start()
        raise KeyboardInterrupt

    with monkeypatch.context() as patch:
        patch.setattr(gg.calls, "left_behind", interrupted)
        for _ in range(2):
            with pytest.raises(KeyboardInterrupt):
                sim._handle.read(lambda pointer: time.sleep(0.2))
    begins.set()
    while not sim._handle._lock.locked():
        time.sleep(0.001)
    sim.collide(10)
    for thread in threads:
        thread.join()


def test_interrupted_start_of_several():
    interrupted_start(lambda scene: gg.relax(scene, 1, points=2, replicas=50, threads=2, engines="md"))
    assert not [thread for thread in threading.enumerate() if thread.name == "graingas"]


def test_interrupted_change():
    """The grains are placed again. Ctrl-C before that changes nothing; Ctrl-C after it is raised as well."""
    sim = gg.Simulation(gg.Scene(flow="usf", phi=0.3, particles=100000, e=0.9, engine="md"))
    e, done = 0.9, False

    def interrupt():
        while not done:
            os.kill(os.getpid(), signal.SIGINT)
            time.sleep(0.2)
    other = threading.Thread(target=interrupt)
    with pytest.raises(KeyboardInterrupt):
        other.start()
        while True:
            sim["collision.e"] = e = 1.7 - e
    while other.is_alive():
        try:
            done = True
            other.join()
        except KeyboardInterrupt:
            pass
    assert sim["collision.e"] in (e, 1.7 - e)
    assert sim["collision.e"] == sim.copy()["collision.e"]  # which reads the library's scene
    sim.collide(10)


def test_two_simulations_in_two_threads(short):
    expected = [gg.Simulation(short, stream).collide(30000).hash for stream in (0, 1)]
    sims = [gg.Simulation(short, stream) for stream in (0, 1)]
    threads = [threading.Thread(target=sim.collide, args=(30000,)) for sim in sims]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [sim.hash for sim in sims] == expected


def test_sums_and_frames(sim):
    sim.collide(500)
    assert sim.take_sums().collisions == 500 and sim.take_sums().collisions == 0
    times = [s.time for s in sim.frames(0.25, 4)]
    assert np.allclose(np.diff(times), 0.25)


def test_walls_have_names():
    sim = gg.Simulation(gg.Scene(flow="couette", phi=0.1, particles=200))
    assert sim.walls[:2] == ["lower", "upper"]


@pytest.fixture
def stored(short):
    short["output.trajectory_every"] = 30
    gg.run(short, output="t.h5")
    return gg.trajectory("t.h5")


def test_trajectory_has_the_frames_of_the_run(stored):
    result = gg.read("t.h5")
    assert len(stored) == result.info.frames > 3 and stored.scene == result.scene
    assert np.array_equal(stored[-1].grains.velocity, result.grains.velocity)
    assert [frame.time for frame in stored] == sorted(frame.time for frame in stored[:])
    with pytest.raises(IndexError):
        stored[len(stored)]


@pytest.mark.parametrize("flow", gg.catalogue.flows())
def test_cells_are_periodic_where_the_library_says(flow):
    """In frames, exported files and simulations: across walls no images. The list of flows is the library's."""
    keys = {"collision.e": 1} if flow == "equilibrium" else {}
    scene = gg.Scene(flow=flow, phi=0.1, particles=60, run={"collisions": 12, "warmup": 1}, trajectory_every=4, **keys)
    try:
        gg.run(scene, output="t.h5")
    except gg.RunFailed:  # too short for a mean; its trajectory stands
        pass
    expected = (True, "walls" not in gg.catalogue.traits(flow), True)
    frame = gg.trajectory("t.h5")[-1]
    assert frame.periodic == expected == tuple(map(bool, gg.Simulation(scene).state.periodic))
    gg.export("t.h5", "t", results=False, curves=False)
    with open("t.xyz", encoding="utf-8") as file:
        assert f'pbc="{" ".join("FT"[p] for p in expected)}"' in file.read()
    if flow == "fourier":
        pytest.importorskip("ase")
        assert frame.to_ase().pbc.tolist() == list(expected)
        y = frame.grains.position[:, 1]
        assert np.allclose(frame.to_ase().get_all_distances(mic=True, vector=True)[:, :, 1], y[None, :] - y[:, None])
    dsmc = gg.Simulation(scene.copy(engine="dsmc")).state
    assert tuple(map(bool, dsmc.periodic)) == (expected if dsmc.box[0] > 0 else (False,) * 3)


def test_ase_has_energies_and_distances(stored):
    pytest.importorskip("ase")
    for frame, atoms in zip(stored, stored.to_ase()):
        assert 2 * atoms.get_kinetic_energy() / 3 / len(atoms) == pytest.approx(frame.state.temperature)
        assert atoms.get_all_distances(mic=True)[np.triu_indices(len(atoms), 1)].min() > 1 - 1e-9
