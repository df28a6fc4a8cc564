# SPDX-License-Identifier: GPL-3.0-or-later
"""A finished run continues: the bits of an extended run are those of a run that had its stopping criteria from the start.
Results without a state, and changes of other keys, are rejected."""
import json
import os
import shutil
import sys

from tap import check, main, run

SCENE = ("{flow: usf, phi: 0.2, particles: 150, engine: %s, dsmc: {particles: 1000, time_step: 0.05}, "
         "run: {%s}, output: {state: kept%s}}")


def numbers(file):
    """All means, errors and correlation times, and how long the run averaged."""
    done = run("info", file, "--json")
    check(done.code == 0, done.err)
    answer = json.loads(done.out)
    check(answer["results"])
    return {key: answer[key] for key in ("results", "collisions_per_particle", "warnings") if key in answer}


def at_once(name, scene, *args):
    done = run("run", name + ".yaml", "--quiet", *args, scene=scene, name=name + ".yaml")
    check(done.code == 0, done.err)
    return numbers(name + ".h5")


def extended(result, *args):
    done = run("run", "--extend", result, "--quiet", *args)
    check(done.code == 0, done.err)
    return done


def test_an_extended_run_has_the_bits_of_one_with_its_criteria_from_the_start():
    for engine, errors in ("md", (0.02, 0.012, 0.007)), ("dsmc", (0.01, 0.006, 0.003)):
        ends = [(f"relative_error: {errors[0]}", f"relative_error: {errors[1]}"),
                (f"replicas: 3, relative_error: {errors[0]}", f"replicas: 3, relative_error: {errors[2]}"),
                ("until: {N1: 0.06}", "until: {N1: 0.04}"), ("collisions: 321", "collisions: 1000")]
        for i, (first, then) in enumerate(ends):
            whole = at_once("whole", SCENE % (engine, then, ""))
            part = at_once("part", SCENE % (engine, first, ""))
            check(part != whole, engine, first)
            extended("part.h5", "--set", "run." + then.replace("replicas: 3, ", "").replace(": ", "=", 1), "--threads", str(1 + i % 3))
            check(numbers("part.h5") == whole, engine, then, numbers("part.h5"), whole)
            os.remove("part.checkpoint.h5"), os.remove("whole.checkpoint.h5")


def test_a_run_is_extended_step_by_step():
    whole = at_once("whole", SCENE % ("md", "relative_error: 0.016", ""))
    at_once("part", SCENE % ("md", "relative_error: 0.06", ""))
    for error in 0.04, 0.026, 0.02, 0.018, 0.016:
        extended("part.h5", "--set", f"run.relative_error={error}")
    check(numbers("part.h5") == whole)


def test_the_result_is_replaced_only_where_it_is_not_given_another_name():
    part = at_once("part", SCENE % ("md", "relative_error: 0.05", ""))
    before = open("part.h5", "rb").read()
    extended("part.h5", "--set", "run.relative_error=0.02", "--output", "more.h5")
    check(open("part.h5", "rb").read() == before and numbers("part.h5") == part)
    check(os.path.exists("part.checkpoint.h5") and os.path.exists("more.checkpoint.h5"), os.listdir("."))
    check("in place of an older one" in run("run", "--extend", "more.h5", "--set", "run.relative_error=0.018").err)


def test_a_kept_state_is_not_replaced_by_another_run():
    at_once("part", SCENE % ("md", "relative_error: 0.05", ""))
    done = run("run", "part.yaml", "--quiet")
    check(done.code == 3 and "part.checkpoint.h5: holds the state of a run" in done.err, done.code, done.err)


def test_a_state_of_another_run_is_rejected():
    """A checkpoint has the name of the result's, and is of another run."""
    at_once("other", SCENE % ("md", "seed: 7, relative_error: 0.05", ""))
    at_once("part", SCENE % ("md", "relative_error: 0.05", ""))
    before = open("part.h5", "rb").read()
    shutil.copy("other.checkpoint.h5", "part.checkpoint.h5")
    done = run("run", "--extend", "part.h5", "--quiet", "--set", "run.relative_error=0.02")
    check(done.code == 2 and "part.h5: is not the result of the run in part.checkpoint.h5" in done.err, done.code, done.err)
    check("run.seed differs (there 7, here 1)" in done.err and open("part.h5", "rb").read() == before, done.err)


def test_trajectory_and_log_go_on():
    more = ", trajectory_every: 100, log: %s.csv"
    at_once("whole", SCENE % ("md", "collisions: 1000", more % "whole"))
    at_once("part", SCENE % ("md", "collisions: 400", more % "part"))
    extended("part.h5", "--set", "run.collisions=1000")
    for name in "whole", "part":
        check(run("export", name + ".h5", "--quiet", "--only", "trajectory").code == 0)
    check(open("whole.xyz").read() == open("part.xyz").read())
    check(open("whole.csv").read() == open("part.csv").read())


def test_a_comparison_is_extended():
    scene = SCENE % ("md", "collisions: %d", "")
    for name, collisions in ("whole", 600), ("part", 300):
        check(run("compare", name + ".yaml", "--quiet", "--picture", "none", scene=scene % collisions, name=name + ".yaml").code == 0)
    done = run("compare", "--extend", "part.compare.h5", "--set", "run.collisions=600", "--quiet", "--picture", "none")
    check(done.code == 0, done.err)
    of = [json.loads(run("info", f"{name}.compare.h5", "--json").out) for name in ("whole", "part")]
    for engine in "md", "dsmc":
        check(of[0][engine]["results"] == of[1][engine]["results"], engine)


def test_runs_whose_numerics_follow_the_requested_error_say_so():
    scene = "{flow: usf, phi: 0.2, engine: dsmc, run: {relative_error: %s}, output: {state: kept}}"
    at_once("part", scene % 0.02)
    extended("part.h5", "--set", "run.relative_error=0.01")
    warnings = json.loads(run("info", "part.h5", "--json").out)["warnings"]
    check(any("the ensemble and the time step are those chosen for 2 %" in w for w in warnings), warnings)


def test_results_without_a_state_and_other_changes_are_rejected():
    scene = SCENE % ("md", "relative_error: 0.05", "")
    at_once("part", scene)
    for key in "collision.e=0.8", "run.seed=3", "engine=dsmc", "run.warmup=100", "start.positions=fcc":
        done = run("run", "--extend", "part.h5", "--quiet", "--set", key)
        check(done.code == 2 and key.split("=")[0] in done.err and "run.relative_error, run.until" in done.err, key, done.err)
    check(run("run", "part.yaml", "--extend", "part.h5").code == 2)
    shutil.move("part.checkpoint.h5", "elsewhere.h5")
    done = run("run", "--extend", "part.h5", "--set", "run.relative_error=0.02")
    check(done.code == 3 and "has no state to continue from: part.checkpoint.h5 is not there" in done.err, done.code, done.err)
    check("output.state: kept" in done.err, done.err)
    check(run("run", "plain.yaml", "--quiet", scene=scene.replace("kept", "removed"), name="plain.yaml").code == 0)
    check(not os.path.exists("plain.checkpoint.h5"), os.listdir("."))


if __name__ == "__main__":
    main(sys.modules["__main__"])
