# SPDX-License-Identifier: GPL-3.0-or-later
"""start.positions: grains start where a file or a lattice says, in the scene's unit of length; files that are not of the
scene are rejected with the reason."""
import os

import numpy as np
import pytest

import graingas as gg

SCENE = {"flow": "usf", "phi": 0.2, "particles": 100, "engine": "md", "run.collisions": 60, "run.warmup": 10}


def xyz(name, r, edges, species=None, columns=("species:S:1:pos:R:3", "{s} {x}")):
    lattice = " ".join(repr(float(x)) for x in np.asarray(edges).ravel())
    with open(name, "w") as f:
        f.write(f'{len(r)}\nLattice="{lattice}" Properties={columns[0]} Time=3\n')
        for i, at in enumerate(r):
            f.write(columns[1].format(s=species[i] if species is not None else "X", x=" ".join(repr(float(x)) for x in at)) + "\n")


def start(**keys):
    return gg.Simulation(gg.Scene(**{**SCENE, **keys}))


def grains(**keys):
    sim = start(**keys)
    return np.array(sim.grains.position), np.diag(sim.state.box)


def test_grains_start_at_the_positions_of_a_file():
    r, box = grains()
    xyz("a.xyz", r, box)
    for columns in ("id:I:1:pos:R:3:mass:R:1:species:S:1", "7 {x} 2.5 {s}"), ("pos:R:3", "{x}"):
        xyz("b.xyz", r, box, columns=columns)
        assert np.allclose(start(**{"start.positions": "b.xyz"}).grains.position, r, atol=1e-12)
    one, two = (start(**{"start.positions": "a.xyz", "run.seed": seed}) for seed in (1, 2))
    assert np.allclose(one.grains.position, r, atol=1e-12)
    assert one.temperature == pytest.approx(two.temperature, rel=1e-12)
    assert not np.allclose(one.grains.velocity, two.grains.velocity)
    one.collide(1000)
    xyz("away.xyz", r + np.diag(box) * [3, -2, 0], box)  # images of them
    assert np.allclose(start(**{"start.positions": "away.xyz"}).grains.position, r, atol=1e-9)


def test_lengths_of_a_file_are_in_the_unit_of_the_scene():
    r, box = grains()
    xyz("cm.xyz", 2.5 * r, 2.5 * box)
    sim = start(**{"start.positions": "cm.xyz", "species": [{"diameter": 2.5}]})
    assert np.allclose(sim.grains.position, r, atol=1e-9)


def test_species_are_those_of_the_file():
    mixture = {"species": [{"fraction": 0.5, "diameter": 1}, {"fraction": 0.5, "diameter": 1.4}], "phi": 0.1}
    sim = start(**mixture)
    r, species = np.array(sim.grains.position), np.array(sim.grains.species)
    for names in ("H", "He"), ("1", "2"):
        xyz("a.xyz", r, np.diag(sim.state.box), [names[s - species.min()] for s in species])
        again = start(**mixture, **{"start.positions": "a.xyz"})
        assert np.allclose(again.grains.position, r, atol=1e-9) and list(again.grains.species) == list(species)
    xyz("a.xyz", r, np.diag(sim.state.box), ["H"] * len(r))
    with pytest.raises(gg.BadInput, match="has 100 grains of species 1, the scene 50"):
        start(**mixture, **{"start.positions": "a.xyz"})


def test_a_run_starts_from_the_last_frame_of_a_result():
    first = gg.run(gg.Scene(**{**SCENE, "flow": "equilibrium", "e": 1}), output="a.h5")
    sim = start(**{"start.positions": "a.h5"})
    h5py = pytest.importorskip("h5py")
    with h5py.File("a.h5") as f:
        assert np.allclose(sim.grains.position, f["particles/grains/position/value"][-1], atol=1e-12)
    gg.export("a.h5", "a")
    assert np.allclose(start(**{"start.positions": "a.xyz"}).grains.position, sim.grains.position, atol=1e-9)
    assert first["temperature"].mean > 0
    result = gg.run(gg.Scene(**{**SCENE, "start.positions": "a.h5", "run.collisions": 300, "run.replicas": 2}))
    same = gg.run(gg.Scene(**{**SCENE, "run.collisions": 300, "run.replicas": 2}))
    T = [r["temperature"] for r in (result, same)]
    assert abs(T[0].mean - T[1].mean) < 5 * np.hypot(T[0].error, T[1].error)
    assert result["temperature"].mean != same["temperature"].mean
    both = gg.compare(gg.Scene(**{**SCENE, "start.positions": "a.h5", "dsmc.particles": 1000}))
    assert both["temperature"].md.mean > 0 and both["temperature"].dsmc.mean > 0


def test_a_lattice_has_its_distances():
    r, box = grains(**{"start.positions": "fcc", "particles": 256, "phi": 0.4})
    edge = box[0, 0]
    d = r[:, None] - r[None]
    d -= edge * np.round(d / edge)
    nearest = np.sort(np.sqrt((d**2).sum(-1)), axis=1)[:, 1:13]
    assert np.allclose(nearest, edge / 4 / np.sqrt(2))
    with_vacancies, _ = grains(**{"start.positions": "fcc", "particles": 200, "phi": 0.4})
    assert len(with_vacancies) == 200
    with pytest.raises(gg.GraingasError, match="start.positions: fcc: grains .* overlap"):
        start(**{"start.positions": "fcc", "particles": 200, "phi": 0.3,
                 "species": [{"fraction": 0.5, "diameter": 1}, {"fraction": 0.5, "diameter": 3}]})
    assert gg.run(gg.Scene(**{**SCENE, "flow": "hcs", "start.positions": "fcc"}))["kurtosis_Cx"].mean > 2


def rejected(message, **keys):
    with pytest.raises(gg.GraingasError, match=message):
        start(**{"start.positions": "bad.xyz", **keys})


def test_what_does_not_fit_the_scene_is_rejected():
    r, box = grains()
    close = r.copy()
    close[7] = close[3] + [0.9, 0, 0]
    xyz("bad.xyz", close, box)
    rejected("grains 3 and 7 overlap: their centres are 0.9")
    xyz("bad.xyz", r[:-1], box)
    rejected("bad.xyz: has 99 grains, the scene 100 .particles")
    xyz("bad.xyz", r, 1.1 * box)
    rejected("its box is .*, the scene's .*phi, particles, aspect")
    lean = box.copy()
    lean[1, 0] = 1
    xyz("bad.xyz", r, lean)
    rejected("and leans")
    with open("bad.xyz", "w") as f:
        f.write("100\nno lattice\nX 1 2 here\n")
    rejected("bad.xyz: line 3 is not one of extended XYZ")
    os.remove("bad.xyz")
    rejected("start.positions: .*bad.xyz: cannot be read")
    with pytest.raises(gg.BadInput, match=r"start.positions': .* allowed: the name of a file that ends in .xyz or .h5, or fcc or random"):
        gg.Scene(**SCENE, **{"start.positions": "a.csv"})
    xyz("bad.xyz", r, np.zeros((3, 3)))
    assert np.allclose(start(**{"start.positions": "bad.xyz"}).grains.position, r, atol=1e-9)
    with pytest.warns(UserWarning, match="start.positions"):
        gg.run(gg.Scene(**{**SCENE, "engine": "dsmc", "dsmc.particles": 500, "start.positions": "bad.xyz"}))


def test_paths_are_relative_to_the_scene_and_only_a_start_reads_the_file():
    r, box = grains()
    os.mkdir("folder")
    xyz("folder/a.xyz", r, box)
    with open("folder/scene.yaml", "w") as f:
        f.write("{flow: usf, phi: 0.2, particles: 100, start: {positions: a.xyz}, run: {collisions: 60}, "
                "output: {state: kept}}")
    assert np.allclose(gg.Simulation(gg.Scene("folder/scene.yaml")).grains.position, r, atol=1e-12)
    gg.run("folder/scene.yaml", output="part.h5")
    whole = gg.run("folder/scene.yaml", **{"run.collisions": 200, "output.state": "removed"})
    os.remove("folder/a.xyz")
    longer = gg.extend("part.h5", **{"run.collisions": 200})
    assert longer["temperature"].mean == whole["temperature"].mean
    with pytest.raises(gg.BadInput, match="folder/scene.yaml:1: key 'start.positions': .*folder/a.xyz: cannot be read"):
        gg.Scene("folder/scene.yaml")
