# SPDX-License-Identifier: GPL-3.0-or-later
"""Collisions that accumulate without end: with md.contact_time auto the run begins anew with a tenfold one, up to 1e-3, and
says so. The scene collapses at 1e-5 with seed 1; at phi 0.6 at 1e-4, too, with seed 2. Grains in lasting contact collide up to 300
times as often as Enskog's equation says, without end or collapse."""
import csv
import json
import os
import sys

from tap import check, main, run

SCENE = """flow: usf
phi: 0.58
particles: 1000
collision: {e: 0.5, beta: 0}
run: {warmup: 200, collisions: 60}
"""


def result(*sets, more=()):
    done = run("run", "scene.yaml", "--json", "--quiet", *[x for s in sets for x in ("--set", s)], *more, scene=SCENE)
    check(done.code == 0, done.code, done.err)
    return json.loads(done.out)


def warned(d):
    return [w for w in d["warnings"] if w.startswith("md.contact_time")]


def numbers(d):
    return d["results"], d["collisions"], d["engine_state"]["events"]


def test_auto_is_raised_until_it_is_enough():
    for seed, phi, value, before in (1, 0.58, "0.0001", "1e-05"), (2, 0.6, "0.001", "0.0001"):
        sets = f"run.seed={seed}", f"phi={phi}"
        found = result(*sets)
        check(found["engine_state"]["contact_time"] == float(value), seed, found["engine_state"])
        check(len(warned(found)) == 1 and f"auto is {value} here" in warned(found)[0] and f"at {before}" in warned(found)[0],
              found["warnings"])
        given = result(*sets, f"md.contact_time={value}")
        check(numbers(found) == numbers(given), "not the run with that contact time")
        check("contact_time" not in given["engine_state"] and not warned(given), given["warnings"])


def test_lasting_contacts_are_no_collapse():
    """A rate that stays at more than 80 times Enskog's is that of the state: the contact time is the default one."""
    found = result("phi=0.52", "run.collisions=400")
    enskog = json.loads(run("theory", "scene.yaml", "--json", "--set", "phi=0.52", scene=SCENE).out)["theory"]
    rate = found["results"]["collision_rate"]["mean"] / enskog["enskog_hermite"]["collision_rate"]["mean"]
    check(rate > 80 and "contact_time" not in found["engine_state"] and not warned(found), rate, found["warnings"])


def test_a_given_one_is_kept():
    done = run("run", "scene.yaml", "--set", "md.contact_time=1e-5", scene=SCENE)
    check(done.code == 1 and "it is 1e-05" in done.err, done.code, done.err)
    done = run("run", "scene.yaml", "--set", "output.trajectory_every=20", "--output", "t.h5", scene=SCENE)
    check(done.code == 1 and "it is 1e-05" in done.err, "frames of a run that begins anew", done.err)


def test_all_replicas_take_it_whatever_the_threads():
    one, two = (result("run.replicas=3", more=("--threads", n)) for n in ("1", "2"))
    check(numbers(one) == numbers(two), "threads")
    check(one["engine_state"]["contact_time"] == two["engine_state"]["contact_time"], "threads")


def test_it_is_resumed_with():
    whole, sets = result(), ("output.checkpoint_every=60",)
    cuts, more = 0, ()
    for limit in "0.05", "0.1", "0.2", "0.4", "0.8", "1e6":
        done = run("run", "scene.yaml", "--json", "--quiet", "--set", f"run.time_limit={limit}", "--set", sets[0], "--output",
                   "cut.h5", *more, scene=SCENE)
        if done.code == 0:
            break
        if os.path.exists("cut.checkpoint.h5"):
            cuts, more = cuts + 1, ("--resume", "cut.checkpoint.h5")
    check(cuts > 0, "was not cut")
    check(numbers(json.loads(done.out)) == numbers(whole), "resumed: other numbers")
    check(warned(json.loads(done.out)) == warned(whole), "resumed: says something else")


def test_a_comparison_tells_it():
    done = run("compare", "scene.yaml", "--quiet", scene=SCENE)
    check(done.code == 0 and "auto is 0.0001 here" in done.out + done.err, done.out, done.err)


def test_the_table_of_a_sweep_has_it():
    with open("sweep.yaml", "w") as f:
        f.write(SCENE.replace("run: {", "run: {seed: 5, "))
        f.write("vary: {md.contact_time: [auto, 1e-3]}\nsweep: {does: run, seeds: common}\n")
    check(run("sweep", "sweep.yaml", "--quiet", "--output", "s").code == 0)
    done = run("sweep", "s", "--collect", "--picture", "none")
    check(done.code == 0, done.err)
    with open(done.out.split()[0]) as f:
        table = list(csv.DictReader(f))
    state = json.loads(run("info", "s/" + table[0]["file"] + ".h5", "--json").out)["engine_state"]
    found = {(row["point"], row["contact_time"] and float(row["contact_time"])) for row in table}
    check(found == {("1", state["contact_time"]), ("2", "")}, found)


if __name__ == "__main__":
    main(sys.modules[__name__])
