# SPDX-License-Identifier: GPL-3.0-or-later
"""Result files opened by the readers that users bring: h5py and MDAnalysis."""
import json
import sys

from tap import Skip, check, main, run

SCENE = ("flow: usf\nphi: 0.2\nparticles: 200\ncollision: {e: 0.9, beta: 0}\ndsmc: {particles: 1000}\n"
         "run: {collisions: 120, warmup: 20}\noutput: {trajectory_every: 20}\n")


def modules(*names):
    import importlib
    import warnings

    warnings.simplefilter("ignore")
    try:
        return [importlib.import_module(name) for name in names]
    except ImportError as missing:
        raise Skip(missing)


def test_h5py_opens_a_run():
    (h5py,) = modules("h5py")
    d = json.loads(run("run", "scene.yaml", "--json", scene=SCENE).out)
    with h5py.File("scene.h5") as f:
        check(list(f["h5md"].attrs["version"]) == [1, 1] and f["h5md/creator"].attrs["name"] == b"graingas")
        check(f["h5md/author"].attrs["name"])
        for name, result in d["results"].items():
            group = f["graingas/results"][name]
            if result["mean"] is not None:
                check(group["mean"][()] == result["mean"], name)
            check(group["unit"].asstr()[()] == result["unit"] and group["samples"][()] == result["samples"])
        check(json.loads(f["graingas/document"].asstr()[()]) == d)
        check("phi: 0.2" in f["graingas/scene"].asstr()[()] and f["graingas/seed"][()] == 1)
        check(f["graingas/command"].asstr()[()] == "graingas run scene.yaml --json")
        T = f["observables/temperature"]
        check(len(T["value"]) == len(T["time"]) == len(T["step"]) and T["value"].attrs["unit"] == b"d^2 gamma^2")
        grains = f["particles/grains"]
        position = grains["position"]
        check(position["value"].shape[1:] == (200, 3) and position["value"].shape[0] == len(position["time"]) >= 5)
        check(grains["box/edges/step"] == position["step"] == grains["velocity/step"], "hard links")
        check(list(grains["id"][:]) == list(range(200)))
        edges = grains["box/edges/value"][0].diagonal()
        check(abs(200 * 3.141592653589793 / 6 / edges.prod() - 0.2) < 1e-12)


def test_edges_lean_with_the_shear():
    """Under the stored edges no two grains overlap, images across the sliding boundary included; upright edges would
    make them."""
    h5py, numpy = modules("h5py", "numpy")
    run("run", "scene.yaml", "--set", "phi=0.4", scene=SCENE)

    def closest(x, edges):
        fractions = numpy.linalg.solve(edges.T, (x[:, None, :] - x[None, :, :]).reshape(-1, 3).T).T
        r = (fractions - numpy.round(fractions)) @ edges
        # Lattice reduction aside, the nearest image of a leaning box may be one cell further along x.
        least = numpy.min([((r + k * edges[0]) ** 2).sum(axis=1) for k in (-1, 0, 1)], axis=0)
        return numpy.sort(least)[len(x)] ** 0.5

    with h5py.File("scene.h5") as f:
        upright = 1.0
        for x, edges in zip(f["particles/grains/position/value"], f["particles/grains/box/edges/value"]):
            check(closest(x, edges) > 1 - 1e-9, closest(x, edges))
            upright = min(upright, closest(x, numpy.diag(numpy.diagonal(edges))))
        check(upright < 0.99, "the test would not notice")


def test_grains_say_what_they_are():
    """Units, mass and diameter; and with the shear put back, the laboratory's velocities have its slope."""
    h5py, numpy = modules("h5py", "numpy")
    mixture = SCENE + "species: [{fraction: 0.5, diameter: 1, mass: 1}, {fraction: 0.5, diameter: 2, mass: 4}]\n"
    for scene, units in (SCENE, "1/gamma d gamma d gamma"), (mixture, "1/gamma d gamma d gamma"):
        run("run", "scene.yaml", scene=scene)
        with h5py.File("scene.h5") as f:
            grains = f["particles/grains"]
            named = [grains.attrs["time_unit"]] + [grains[k].attrs["unit"] for k in ("velocity", "position", "spin")]
            check(b" ".join(named).decode() == units, named)
            check(grains["spin/value"].attrs["unit"] == b"gamma" and grains["box/edges"].attrs["unit"] == b"d")
            check(grains["mass"].attrs["unit"] == b"m" and grains["diameter"].attrs["unit"] == b"d")
            for species, mass, diameter in zip(grains["species"], grains["mass"], grains["diameter"]):
                check((mass, diameter) == ((4, 2) if species else (1, 1)), species, mass, diameter)
            check(set(grains["species"]) == ({0, 1} if scene == mixture else {0}))
            check(grains["velocity"].attrs["frame"].startswith(b"peculiar"))
            y = grains["position/value"][..., 1] - grains["box/edges/value"][:][:, 1, 1, None] / 2
            peculiar = grains["velocity/value"][..., 0]
            laboratory = peculiar + grains["velocity"].attrs["shear_rate"] * y
            for velocity, slope in (peculiar, 0), (laboratory, 1):
                found = (velocity * y).mean() / (y * y).mean()
                error = (peculiar.var() / (y * y).mean() / y.size) ** 0.5
                check(abs(found - slope) < 5 * error < 0.5, found, slope, error)
    run("run", "scene.yaml", scene=SCENE.replace("usf", "hcs"))
    with h5py.File("scene.h5") as f:
        velocity = f["particles/grains/velocity"]
        check(velocity.attrs["unit"] == b"v_0" and velocity.attrs["shear_rate"] == 0)
        check(velocity.attrs["frame"].startswith(b"laboratory"))


def test_h5py_opens_a_comparison():
    (h5py,) = modules("h5py")
    d = json.loads(run("compare", "scene.yaml", "--json", "--picture", "none", scene=SCENE).out)
    with h5py.File("scene.compare.h5") as f:
        for engine in "md", "dsmc":
            check(f["graingas"][engine]["results/pressure/mean"][()] == d[engine]["results"]["pressure"]["mean"])
            check(len(f[f"observables/{engine}_pressure/value"]) > 10)
        lun = f["graingas/theory/lun1991"]
        check(lun["pressure/mean"][()] == d["theory"]["lun1991"]["pressure"]["mean"] and lun.attrs["citation"])


def test_h5py_opens_curves():
    """Curves and the laws beside them are what the JSON holds; a curve without a law has none in the file, either."""
    (h5py,) = modules("h5py")
    d = json.loads(run("run", "scene.yaml", "--json", "--set", "measure=[rheology,collisions,diffusion]", scene=SCENE).out)
    with h5py.File("scene.h5") as f:
        laws = 0
        for name, curve in d["curves"].items():
            group, law = f["graingas/curves"][name], curve.get("reference")
            x = [None if v != v else v for v in group["x"][:]]  # a lag that was never reached
            check(x == curve["x"] and group["x"].attrs["unit"].decode() == curve["x_unit"], name)
            check(("reference" in group) == bool(law), name)
            if law:
                laws += 1
                check([None if v != v else v for v in group["reference"][:]] == law["value"] and group["reference"].attrs["label"].decode() == law["label"], name)
        check(0 < laws < len(d["curves"]), laws)


def test_mdanalysis_reads_trajectories():
    (mda, h5py) = modules("MDAnalysis", "h5py")
    for command in "run", "compare":
        run(command, "scene.yaml", "--output", "scene.h5", scene=SCENE)
        u = mda.Universe.empty(200, trajectory=False)
        u.load_new("scene.h5", format="H5MD", convert_units=False)
        check(u.trajectory.n_frames >= 5 if command == "run" else u.trajectory.n_frames == 1)
        with h5py.File("scene.h5") as f:
            edge = f["particles/grains/box/edges/value"][0][0][0]
            for k, frame in enumerate(u.trajectory):
                stored = f["particles/grains/position/value"][k]
                check(abs(u.atoms.positions - stored).max() < 1e-5 and abs(frame.dimensions[0] - edge) < 1e-4)
                check(abs(frame.velocities).max() > 0)


def test_mdanalysis_opens_dsmc():
    """An ensemble without positions or box."""
    (mda,) = modules("MDAnalysis")
    run("run", "scene.yaml", "--engine", "dsmc", scene=SCENE)
    u = mda.Universe.empty(1000, trajectory=False)
    u.load_new("scene.h5", format="H5MD", convert_units=False)
    check(abs(u.trajectory[0].velocities).max() > 0)


if __name__ == "__main__":
    main(sys.modules[__name__])
