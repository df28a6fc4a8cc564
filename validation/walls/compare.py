# SPDX-License-Identifier: GPL-3.0-or-later
"""Profiles between rough walls: dsmc beside walls_reference.c, a second program from the equations. A row of SCENES is a
test; `compare.py NAME ...` prints the profiles of these rows."""
import json
import os
import subprocess
import sys

sys.path.insert(0, os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tests", "cli"))
from tap import check, main, run

GRAINS, TIME, WARMUP = 3000, 900, 200  # times in units of the inverse mean shear rate
BOUND = 4.5  # standard errors
STEPS = 0.003  # share of a value that the steps of both programs and the finite numbers of grains may change
# The scene's phi, beta, walls.beta; grains in a cube as wide as the gap; collisions of a grain in a unit of time, about.
SCENES = {
    "rough": (0.3, 0, 1, 1000, 4.4),
    "rough_by_friction_of_grains": (0.3, 0.5, 0, 1000, 6),
    "smooth": (0.3, -1, 1, 1000, 6),
    "moderate": (0.1, 0, 1, 1000, 2),
}
PROFILES = ["solid_fraction", "velocity", "temperature", "rotational_temperature", "spin_z"]


def reference(phi, beta, wall_beta, box, step=0.03):
    """{(name, slab): (value, standard error)}; slab None: of the whole gap."""
    keys = {"phi": phi, "beta": beta, "wall_beta": wall_beta, "box": box, "grains": GRAINS, "time": TIME, "warm": WARMUP,
            "step": step, "inertia": 1e12 if beta == -1 else 0.4}
    command = [os.environ["WALLS_REFERENCE"]] + [str(x) for item in keys.items() for x in item]
    rows, seen = {}, {}
    for line in subprocess.run(command, capture_output=True, text=True, check=True).stdout.splitlines():
        words = line.split(",")
        if line.startswith("#"):
            continue
        if len(words) == 3:
            rows[words[0], None] = float(words[1]), float(words[2])
        else:
            slab = seen[words[1]] = seen.get(words[1], -1) + 1
            rows[words[1], slab] = float(words[2]), float(words[3])
    return rows


def dsmc(phi, beta, wall_beta, box, rate):
    scene = {"flow": "couette", "engine": "dsmc", "phi": phi, "particles": box, "collision": {"e": 0.9, "beta": beta},
             "walls": {"e": 0.9, "beta": wall_beta, "speed": 1}, "measure": ["rheology", "profiles"],
             "dsmc": {"particles": GRAINS, "time_step": 0.1},
             "run": {"collisions": TIME * rate, "warmup": WARMUP * rate, "replicas": 1, "seed": 11}}
    done = run("run", "scene.yaml", "--threads", "1", "--quiet", "--json", scene=json.dumps(scene), timeout=600)
    check(done.code == 0, done.err)
    result = json.loads(done.out)
    rows = {(name, None): (result["results"][name]["mean"], result["results"][name]["stderr"])
            for name in ("temperature",)}
    for name in PROFILES:
        curve = result["curves"].get("profile_" + name)
        for slab, (value, error) in enumerate(zip(curve["value"], curve["stderr"]) if curve else ()):
            rows[name, slab] = value, error
    return rows


def compared(name):
    """Rows of both, with the distance in standard errors beyond STEPS. Slabs that grains hardly reach do not count."""
    phi, beta, wall_beta, box, rate = SCENES[name]
    ours, other, rows = dsmc(phi, beta, wall_beta, box, rate), reference(phi, beta, wall_beta, box), []
    for key in ours:
        if key not in other or key[1] == 0:
            continue
        (a, da), (b, db) = ours[key], other[key]
        scale = max(abs(x[0]) for k, x in other.items() if k[0] == key[0] and k[1] is not None) if key[1] else abs(b)
        z = max(abs(a - b) - STEPS * max(abs(b), 0.05 * scale), 0) / max((da**2 + db**2) ** 0.5, 1e-300)
        rows.append((key, a, da, b, db, z))
    return rows


def agree(name):
    rows = compared(name)
    worst = max(rows, key=lambda row: row[-1])
    check(len(rows) > 30, "too few slabs:", len(rows))
    check(worst[-1] < BOUND, "dsmc and the second program differ:", worst)


for row in SCENES:
    globals()["test_" + row] = lambda name=row: agree(name)

if __name__ == "__main__":
    if len(sys.argv) == 1:
        main(sys.modules[__name__])
    for argument in sys.argv[1:]:
        for (quantity, at), one, error, two, error_two, distance in compared(argument):
            print(f"{quantity:24}{'' if at is None else at:>4} {one:10.5f} {error:.5f} {two:10.5f} {error_two:.5f} {distance:6.1f}")
