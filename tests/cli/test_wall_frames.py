# SPDX-License-Identifier: GPL-3.0-or-later
"""Temperature, stresses and N1 between walls, held against stored frames: fine slabs, in each of them the straight line of
all frames together taken off. Nothing but the file is used: the two share no code."""
import json
import sys

from tap import Skip, check, main, run

try:
    import h5py
    import numpy
except ImportError as missing:
    h5py = missing

WARMUP, COLLISIONS, EVERY = 600, 2400, 2
CASES = {
    "couette_thin": "flow: couette\nphi: 0.05\nparticles: 300\ncollision: {e: 0.9, beta: -1}\n"
                    "walls: {e: 0.9, beta: 1, speed: 1}\n",
    "couette": "flow: couette\nphi: 0.3\nparticles: 1000\ncollision: {e: 0.9, beta: 0}\n"
               "walls: {e: 0.9, beta: 1, speed: 1}\n",
    "poiseuille": "flow: poiseuille\nphi: 0.2\nparticles: 1000\ncollision: {e: 0.9, beta: 0}\n"
                  "walls: {e: 0.9, beta: 0.5}\ngravity: [1, 0, 0]\n",
    "chute": "flow: chute\nphi: 0.2\nparticles: 500\ncollision: {e: 0.9, beta: 0}\n"
             "walls: {e: 0.9, beta: 0, top: closed}\ngravity: [0.1, -0.1, 0]\n",
}
RUN = f"run: {{warmup: {WARMUP}, collisions: {COLLISIONS}}}\noutput: {{trajectory_every: {EVERY}}}\nmeasure: [rheology]\n"


def about_lines(y, v, height, slabs):
    """Residuals of v (grains x 3) about a straight line in each slab."""
    slab = numpy.clip((y / height * slabs).astype(int), 0, slabs - 1)

    def of_slab(x):
        return numpy.bincount(slab, x, slabs)

    n = numpy.maximum(of_slab(None), 1)
    h = y - (of_slab(y) / n)[slab]
    left = numpy.empty_like(v)
    for a in range(3):
        w = v[:, a] - (of_slab(v[:, a]) / n)[slab]
        left[:, a] = w - h * (of_slab(h * w) / numpy.maximum(of_slab(h * h), 1e-300))[slab]
    left[n[slab] < 3] = 0
    return left


def frames_of(path):
    with h5py.File(path) as f:
        group = f["particles/grains"]
        first = len(group["position/time"]) * WARMUP // (WARMUP + COLLISIONS)
        fields = [group[name + "/value"][first:].reshape(-1, 3) for name in ("position", "velocity")]
        spin = group["spin/value"][first:].reshape(-1, 3) if "spin" in group else None
        return fields[0][:, 1], fields[1], spin, group["box/edges/value"][0].ravel()


def against_frames(name, *words):
    if isinstance(h5py, ImportError):
        raise Skip(h5py)
    made = run("run", "scene.yaml", "--json", "--quiet", *words, scene=CASES[name] + RUN)
    check(made.code == 0, made.err)
    d = json.loads(made.out)
    results, phi, rough = d["results"], d["scene"]["phi"], d["scene"]["collision"]["beta"] != -1
    y, c, spin, _ = frames_of("scene.h5")
    height = y.max() + 0.5  # centres are half a diameter from either wall
    for slabs in (24, 96):
        C = about_lines(y, c, height, slabs)
        P = phi * (C.T @ C) / len(C)
        held = {"temperature": (C * C).sum() / len(C) / 3}
        for a, b in ("xx", "yy", "zz", "xy"):
            held[f"P_{a}{b}_kinetic"] = P["xyz".index(a), "xyz".index(b)]
        whole = [P[a, a] + results[f"P_{'xyz'[a] * 2}_collisional"]["mean"] for a in range(3)]
        held["N1"] = (whole[0] - whole[1]) / (sum(whole) / 3)
        if rough:
            W = about_lines(y, spin, height, slabs)
            held["rotational_temperature"] = 0.4 / 4 * (W * W).sum() / len(W) / 3
        for quantity, value in held.items():
            r = results[quantity]
            z = (r["mean"] - value) / r["stderr"]
            print(f"# {name}, {slabs} slabs: {quantity} {r['mean']:.5g}({r['stderr']:.2g}), frames {value:.5g}: {z:.2f}")
            check(abs(z) < 1, name, slabs, quantity, r["mean"], r["stderr"], value)


def test_thin_couette():
    against_frames("couette_thin")


def test_couette_has_the_profiles_of_its_frames():
    against_frames("couette")


def test_couette_by_monte_carlo():
    against_frames("couette", "--engine", "dsmc", "--set", "dsmc.particles=1000")


def test_poiseuille_has_the_profiles_of_its_frames():
    against_frames("poiseuille")


def test_chute_has_the_profiles_of_its_frames():
    against_frames("chute")


if __name__ == "__main__":
    main(sys.modules[__name__])
