# SPDX-License-Identifier: GPL-3.0-or-later
"""The default number of grains: where 1000 that cool or are heated by the Gaussian thermostat would not stay homogeneous, a
number that does, the same for every command; a given number is kept."""
import csv
import glob
import json
import os
import sys

from tap import check, main, run

SCENE = "flow: hcs\nphi: 0.2\ncollision: {e: 0.85}\nrun: {warmup: 20, collisions: 60}\n"
NONE_FITS = SCENE.replace("0.2", "0.3").replace("0.85", "0.8")
N = 660  # measured stable up to 775


def result(*args, scene=SCENE, code=0):
    done = run(*args, "scene.yaml", "--json", "--quiet", "--output", "r.h5", scene=scene)
    check(done.code == code, done.code, done.err)
    return json.loads(done.out)


def test_every_command_has_it():
    about = run("info", "scene.yaml", scene=SCENE, columns=300).out
    row = next(row for row in about.splitlines() if row.startswith("particles "))
    check(row.split()[1:3] == [str(N), "default"], row)
    check("number of grains: automatic: the box stays homogeneous, as it does up to about 77" in about, about)
    one, both, theory = result("run"), result("compare"), run("theory", "scene.yaml", "--json", "--theory", "haff1983")
    check(one["particles"] == both["md"]["particles"] == N, one["particles"], both["md"]["particles"])
    check(one["scene"]["particles"] == both["scene"]["particles"] == json.loads(theory.out)["scene"]["particles"] == N)
    for found in one, both["md"]:
        check(found["particles_chosen"].startswith("automatic: the box stays homogeneous"), found)
    given = run("run", "scene.yaml", "--json", "--quiet", "--set", f"particles={N}", "--output", "given.h5")
    check(json.loads(given.out)["results"] == one["results"], "not the run of that number")
    check("particles_chosen" not in json.loads(given.out), "given, not chosen")
    text = run("compare", "scene.yaml", "--quiet", "--output", "text.h5", columns=200)
    check(f"{N} grains, automatic: the box stays homogeneous" in text.out, text.out)


def test_no_homogeneous_box_is_large_enough():
    about = run("info", "scene.yaml", scene=NONE_FITS, columns=300).out
    check("number of grains: automatic, the smallest: vortices and clusters grow beyond about" in about, about)
    found = run("compare", "scene.yaml", "--quiet", "--output", "r.h5", columns=300)
    check("500 grains, automatic, the smallest: vortices and clusters grow beyond about" in found.out, found.out)


def test_a_given_number_is_kept():
    for n in 1000, 64:
        found = json.loads(run("run", "scene.yaml", "--json", "--quiet", "--set", f"particles={n}", scene=SCENE).out)
        check(found["particles"] == n and "particles_chosen" not in found, found["particles"])
        os.remove("scene.h5")


def test_a_resumed_run_keeps_its_size():
    whole = result("run", "--set", "run.collisions=1500")
    more, cuts = (), 0
    for limit in "0.1", "0.2", "0.4", "1e6":
        done = run("run", "scene.yaml", "--json", "--quiet", "--set", f"run.time_limit={limit}", "--set",
                   "output.checkpoint_every=60", "--set", "run.collisions=1500", "--output", "cut.h5", *more)
        if done.code == 0:
            break
        if os.path.exists("cut.checkpoint.h5"):
            cuts, more = cuts + 1, ("--resume", "cut.checkpoint.h5")
    check(cuts > 0, "was not cut")
    check(json.loads(done.out)["results"] == whole["results"] and json.loads(done.out)["particles"] == N, "resumed")


def test_points_of_a_sweep():
    with open("sweep.yaml", "w") as f:
        f.write(SCENE + "vary: {collision.e: [0.85, 0.95]}\nsweep: {does: run}\n")
    check(run("sweep", "sweep.yaml", "--quiet", "--output", "s").code == 0)
    found = {}
    for path in glob.glob("s/*.h5"):
        about = json.loads(run("info", path, "--json").out)
        found[about["scene"]["collision"]["e"]] = about["particles"]
    check(found == {0.85: N, 0.95: 1000}, found)


if __name__ == "__main__":
    main(sys.modules[__name__])
