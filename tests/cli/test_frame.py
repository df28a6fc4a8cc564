# SPDX-License-Identifier: GPL-3.0-or-later
"""The key frame: what it changes, what it leaves as it is, where it has no effect. Its numbers are held by
test_independent.py."""
import json
import sys

from tap import check, main, run

SCENE = """flow: usf
phi: 0.3
particles: 500
collision: {e: 0.9, beta: 0}
run: {warmup: 40, collisions: 80}
measure: [rheology, velocity_distributions, orientation]
"""


def document(*sets, scene=SCENE):
    done = run("run", "scene.yaml", "--json", "--quiet", *[x for s in sets for x in ("--set", s)], scene=scene)
    check(done.code == 0, done.err)
    return json.loads(done.out)


def numbers(d):
    return d["results"], d["curves"]


def test_imposed_is_the_default():
    check(numbers(document()) == numbers(document("frame=imposed")), "other numbers")


def test_only_peculiar_velocities_change():
    imposed, cells, laboratory = document(), document("frame=cells", "frame_cells=3"), document("frame=cells_laboratory", "frame_cells=3")
    for d in cells, laboratory:
        for q in "collision_rate", "dissipation", "P_xx_collisional", "P_xy_collisional", "momentum_waves", "density_waves":
            check(d["results"][q] == imposed["results"][q], q, d["results"][q], imposed["results"][q])
        for q in "spin_z", "energy_balance":  # sums in another order
            check(abs(d["results"][q]["mean"] / imposed["results"][q]["mean"] - 1) < 1e-9, q)
        instantaneous = d["curves"]["orientation_cos_instantaneous"]
        check(instantaneous == imposed["curves"]["orientation_cos_instantaneous"], "instantaneous orientation")
    T = [d["results"]["temperature"]["mean"] for d in (imposed, cells, laboratory)]
    check(0.9 * T[0] < T[1] < T[0] and T[2] > 1.1 * T[0], "temperatures", T)
    kurtosis = [d["results"]["kurtosis_Cx"]["mean"] for d in (imposed, cells, laboratory)]
    check(kurtosis[2] < kurtosis[0] - 0.2 and abs(kurtosis[1] - kurtosis[0]) < 0.1, "kurtosis", kurtosis)


def test_share_of_the_mean_is_put_back():
    """In equilibrium velocities are independent but for their sum: temperatures are those of the imposed frame, be grains
    few in a cell or many."""
    scene = "flow: equilibrium\nphi: 0.2\nparticles: 108\ncollision: {e: 1, beta: 1}\nrun: {warmup: 20, collisions: 2000}\n"
    imposed = document(scene=scene)["results"]
    for cells in 2, 3:
        found = document("frame=cells", f"frame_cells={cells}", scene=scene)["results"]
        for q in "temperature", "rotational_temperature":
            error = max(found[q]["stderr"], 1e-4)
            check(abs(found[q]["mean"] - imposed[q]["mean"]) < 4 * error and error < 0.01, cells, q, found[q], imposed[q])
    share = document("frame=cells_laboratory", "frame_cells=2", scene=scene)["results"]["temperature"]["mean"]
    check(abs(share / imposed["temperature"]["mean"] - (1 - 8 / 108) / (1 - 1 / 108)) < 0.005, "share", share)


def test_slabs():
    """Means of large slabs take less of the fluctuations away than those of small cells. The flow within a slab stays
    in: (h gamma)^2/12 in the mean square of C_x."""
    T = {frame: document(f"frame={frame}", "frame_cells=3")["results"]["temperature"]["mean"] for frame in
         ("imposed", "cells", "slabs", "slabs_laboratory")}
    check(T["cells"] < 0.995 * T["slabs"] and abs(T["slabs"] / T["imposed"] - 1) < 0.005, T)
    height = (500 * 3.14159265 / 6 / 0.3) ** (1 / 3) / 3
    share = T["slabs_laboratory"] - T["slabs"] * (1 - 3 / 500) / (1 - 1 / 500)
    check(abs(share / (height ** 2 / 36) - 1) < 0.1, share, height ** 2 / 36)  # test_independent.py has it exactly


def test_where_it_has_no_effect():
    both = "frame=cells", "frame_cells=3"
    dsmc, plain = document("engine=dsmc", *both), document("engine=dsmc")
    check(numbers(dsmc) == numbers(plain), "dsmc: other numbers")
    walls = "flow: couette\nphi: 0.2\nparticles: 200\nrun: {warmup: 20, collisions: 40}\n"
    for arguments, scene, reason in ((("engine=dsmc",) + both, SCENE, "dsmc"), (both, walls, "between walls"),
                                     (("frame_cells=3",), SCENE, "frame is imposed")):
        done = run("run", "scene.yaml", *[x for s in arguments for x in ("--set", s)], scene=scene)
        check("no effect" in done.err and "frame_cells" in done.err and reason in done.err, done.err)


def test_cells_of_few_grains_are_rejected():
    done = run("run", "scene.yaml", "--set", "frame=cells", "--set", "frame_cells=6", scene=SCENE)
    check(done.code != 0 and "6 x 6 x 6 cells of 500 grains hold 2.3 each; at least 4" in done.err, done.code, done.err)
    check(run("run", "scene.yaml", "--quiet", "--set", "frame=slabs", "--set", "frame_cells=125", scene=SCENE).code != 2)
    done = run("run", "scene.yaml", "--set", "frame=slabs", "--set", "frame_cells=126", scene=SCENE)
    check(done.code == 2 and "1 x 126 x 1 slabs of 500 grains hold 4 each; at least 4" in done.err, done.code, done.err)


def test_local_densities():
    """Solid fractions in place of multiples of the mean: the same classes, the same curves under other names."""
    few = "measure=[rheology, local_distributions]"
    usual, given = document(few)["curves"], document(few, "local_densities=[0.3, 0.225]")["curves"]
    check({name for name in given if name.startswith("local")} == {f"local_distribution_{of}_{part}" for of in ("Cx", "Wz")
                                                                   for part in ("phi_0.3", "phi_0.225", "all")}, list(given))
    for of in "Cx", "Wz":
        for mine, theirs in ("phi_0.3", "1"), ("phi_0.225", "0.75"), ("all", "all"):
            one, other = given[f"local_distribution_{of}_{mine}"], usual[f"local_distribution_{of}_{theirs}"]
            check(all(one[key] == other[key] for key in ("x", "value", "stderr")), of, mine)
            check(abs(one["numbers"]["solid_fraction"]["mean"] - other["numbers"]["solid_fraction"]["mean"]) < 1e-12, of, mine)
    for value, said in ("[0.2, 0.2]", "has 0.2 twice"), ("[0.75]", "at most 0.74"), ("[0]", "above 0"), ("[]", "a list of up to 8"), ("0.3", "a list of up to 8"):
        done = run("run", "scene.yaml", "--set", few, "--set", f"local_densities={value}", scene=SCENE)
        check(done.code == 2 and "local_densities" in done.err and said in done.err, value, done.err)
    done = run("run", "scene.yaml", "--set", "local_densities=[0.3]", scene=SCENE)
    check("local_densities has no effect without measure: [local_distributions]" in done.err, done.err)


if __name__ == "__main__":
    main(sys.modules[__name__])
