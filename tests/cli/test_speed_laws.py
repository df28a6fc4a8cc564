# SPDX-License-Identifier: GPL-3.0-or-later
"""e, beta and mu as formulas and tables of the normal speed: tables are read beside the scene, kept in results and
checkpoints, and drawn; runs resume without the file, bit for bit; theories; messages on what is invalid."""
import json
import os
import sys

from tap import check, main, run

GAS = "flow: usf\nphi: 0.05\nparticles: 500\ndsmc: {particles: 2000}\n"
STEP = "0.9 if v < 2 else 0.6"


def results_of(scene, *options):
    done = run("run", "scene.yaml", "--json", "--quiet", *options, scene=scene)
    check(done.code == 0, done.err)
    return json.loads(done.out)


def words(done):
    return " ".join((done.err + done.out).split())


def test_a_table_is_read_beside_the_scene_and_kept():
    """A table in a file, rows in the scene and the formula of the same step have the same results."""
    os.mkdir("gas")
    with open("gas/e.csv", "w", encoding="utf-8") as file:
        file.write("v, e\n# a step\n0, 0.9\n2 0.9\n2,0.6\n\n")
    tail = "run: {collisions: 20, warmup: 20}\n"
    done = run("run", "gas/scene.yaml", "--json", "--quiet", "--engine", "dsmc", name="gas/scene.yaml",
               scene=GAS + tail + "collision: {e: {table: e.csv}}\n")
    check(done.code == 0, done.err)
    table = json.loads(done.out)
    check(table["scene"]["collision"]["e"] == {"table": [[0, 0.9], [2, 0.9], [2, 0.6]]}, table["scene"]["collision"])
    rows = results_of(GAS + tail + "collision: {e: {table: [[0, 0.9], [2, 0.9], [2, 0.6]]}}\n", "--engine", "dsmc")
    formula = results_of(GAS + tail + f"collision: {{e: {STEP}}}\n", "--engine", "dsmc")
    check(formula["scene"]["collision"]["e"] == STEP, formula["scene"]["collision"])
    for one in rows, formula:
        check(one["results"] == table["results"], one["results"], table["results"])


def test_resumed_without_the_table():
    """A run that is interrupted by its time limit resumes from the checkpoint alone: same bits as without a stop."""
    with open("mu.txt", "w", encoding="utf-8") as file:
        file.write("0 0.4\n1 0.2\n3 0.1\n")
    scene = GAS + f"collision: {{e: {STEP}, beta: 0.1, mu: {{table: mu.txt}}}}\n"
    for engine, collisions in ("md", 2000), ("dsmc", 1500):
        often = f"run: {{collisions: {collisions}, warmup: 20, seed: 3}}\noutput: {{checkpoint_every: 0.01}}\n"
        with open("mu.txt", "w", encoding="utf-8") as file:
            file.write("0 0.4\n1 0.2\n3 0.1\n")
        whole = results_of(scene + often, "--engine", engine, "--output", "whole.h5")
        part = run("run", "scene.yaml", "--quiet", "--engine", engine, "--output", "part.h5", "--set",
                   "run.time_limit=0.1", scene=scene + often)
        check(part.code == 1, part.code, part.err, "the time limit has to end the run")
        os.remove("mu.txt")
        stored = run("info", "part.checkpoint.h5")
        check("table" in stored.out, stored.out)
        done = run("run", "scene.yaml", "--json", "--quiet", "--resume", "part.checkpoint.h5", "--engine", engine, "--output",
                   "part.h5", "--set", "run.time_limit=none")
        check(done.code == 0 and "mu.txt: cannot be read" in done.err, engine, done.err)
        check(json.loads(done.out)["results"] == whole["results"], engine)


def test_a_change_to_a_formula_is_kept_in_the_result():
    """The protocol of a stored scene can be read again: the result is resumed, and shown, with the same formula."""
    scene = f"{GAS}collision: {{e: 0.9}}\nrun: {{duration: 3}}\nprotocol: [{{at: 1, collision.e: '{STEP}'}}, {{at: 2, shear_rate: 2}}]\n"
    done = run("run", "scene.yaml", "--json", "--quiet", "--engine", "dsmc", "--output", "kept.h5", scene=scene)
    check(done.code == 0, done.err)
    kept = [{"at": 1.0, "collision.e": STEP}, {"at": 2.0, "shear_rate": 2}]
    check(json.loads(done.out)["scene"]["protocol"] == kept, json.loads(done.out)["scene"]["protocol"])
    done = run("info", "kept.h5", "--json")
    check(done.code == 0 and STEP in done.out, done.out, done.err)
    again = run("export", "kept.h5", "--output", "kept.csv")
    check(again.code == 0, again.err)


def test_info_draws_the_law():
    done = run("info", "scene.yaml", scene=GAS + "collision: {e: 1 - 0.2*v^0.2}\n")
    check(done.code == 0 and "e(v) of species 1 and 1" in done.out and "####" in done.out, done.out, done.err)
    done = run("info", "scene.yaml", scene=GAS + "collision: {e: '0.9'}\n")
    check("e(v)" not in done.out, done.out)


def test_values_beyond_are_counted():
    """e below 0 counts as 0, in both engines; the result counts such collisions and warns."""
    scene = GAS + "run: {collisions: 20, warmup: 10}\ncollision: {e: 0.9 - 0.2*v}\n"
    for engine in "md", "dsmc":
        found = results_of(scene, "--engine", engine)
        check(any("no allowed value" in w for w in found["warnings"]), found["warnings"])
        count = found["engine_state"]["law_clamped"]
        check(0 < count < found["total"]["collisions"] * 1.1, count, found["total"])
        found = results_of(scene.replace("0.9 - 0.2*v", "0.9"), "--engine", engine)
        check(not any("allowed value" in w for w in found["warnings"]), found["warnings"])


def test_the_closure_and_monte_carlo():
    """Sheared grains whose e falls in a step, or by a power: the Gaussian closure is within 3 % of Monte Carlo in T."""
    for law in STEP, "1 - 0.2*v^0.2", "0.8 + 0*v":
        for rough in "", ", beta: 0.3":
            scene = GAS + f"collision: {{e: {law}{rough}}}\nrun: {{relative_error: 0.01}}\ndsmc: {{particles: 5000}}\n".replace(
                "dsmc: {particles: 2000}\n", "")
            scene = scene.replace("dsmc: {particles: 2000}\n", "", 1)
            T = results_of(scene, "--engine", "dsmc")["results"]["temperature"]
            done = run("theory", "scene.yaml", "--json", "--quiet", "--theory", "gaussian_closure", scene=scene)
            check(done.code == 0, done.err)
            closure = json.loads(done.out)["theory"]["gaussian_closure"]["temperature"]["mean"]
            check(abs(closure / T["mean"] - 1) < 0.035 + 4 * T["stderr"] / T["mean"], law, rough, closure, T)
            if law.startswith("0.8"):
                done = run("theory", "scene.yaml", "--json", "--quiet", "--theory", "gaussian_closure",
                           scene=scene.replace(law, "0.8"))
                exact = json.loads(done.out)["theory"]["gaussian_closure"]["temperature"]["mean"]
                check(abs(closure / exact - 1) < 1e-7, closure, exact)


def test_theories_of_constants_say_why_not():
    scene = GAS + f"collision: {{e: {STEP}, beta: 0.1, mu: 0.3 + 0*v}}\n"
    done = run("theory", "scene.yaml", "--theory", "lun1991", scene=scene)
    check("in this scene e depends on the speed" in words(done), words(done))
    done = run("theory", "scene.yaml", "--theory", "enskog_hermite", scene=GAS + f"collision: {{e: {STEP}}}\n")
    check("e depends on the speed" in words(done), words(done))


def test_energy_from_contacts():
    """e above 1 gives energy: a gas without thermostat keeps a temperature, the same in both engines; and does not cool
    freely by name."""
    scene = "flow: hss\nphi: 0.01\nparticles: 1000\ncollision: {e: '1.2 if v < 1 else 0.7'}\nrun: {collisions: 300}\n"
    done = run("compare", "scene.yaml", "--json", "--quiet", scene=scene + "measure: [rheology]\n")
    check(done.code == 0, done.err)
    found = json.loads(done.out)
    T = [found[engine]["results"]["temperature"] for engine in ("md", "dsmc")]
    check(found["md"]["steady"] and found["dsmc"]["steady"], found["warnings"])
    z = (T[0]["mean"] - T[1]["mean"]) / (T[0]["stderr"] ** 2 + T[1]["stderr"] ** 2) ** 0.5
    check(abs(z) < 4.5, T)
    done = run("run", "scene.yaml", scene=scene.replace("hss", "hcs"))
    check(done.code == 2 and "collision.e" in done.err and "hss" in done.err, done.err)


def test_invalid_laws():
    with open("down.txt", "w", encoding="utf-8") as file:
        file.write("0 0.9\n2 0.8\n1 0.7\n")
    with open("words.txt", "w", encoding="utf-8") as file:
        file.write("0 0.9\n1 high\n")
    with open("empty.txt", "w", encoding="utf-8") as file:
        file.write("# nothing\n")
    for value, *says in (("{e: 1 - 0.2*w*v}", "scene.yaml:5: key 'collision.e'", "character 9", "there are v"),
                         ("{e: 'fast'}", "character 1", "not known"),
                         ("{e: fast}", "value 'fast' is not allowed", "a formula of the normal speed v"),
                         ("{e: {table: down.txt}}", "row 3: the speed 1; speeds ascend"),
                         ("{e: {table: none.txt}}", "none.txt: cannot be read"),
                         ("{e: {table: .}}", "it is no file"),
                         ("{e: {table: words.txt}}", "words.txt:2: two numbers"),
                         ("{e: {table: empty.txt}}", "the table has no row"),
                         ("{e: {table: [[0, 0.9], [1]]}}", "a row of a table is [speed, value]"),
                         ("{e: {table: [[0, -0.9]]}}", "row 1: e = -0.9"),
                         ("{e: '1.5'}", "allowed: a number from 0 to 1"),
                         ("{e: 0.9 if sin(50*v) > 0 else 0.8}", "more than 16 steps"),
                         ("{law: viscoelastic, e: 1 - 0.1*v}", "key 'collision.law'", "key 'collision.e'"),
                         ("{mu: 0.1 + v}", "key 'collision.mu'", "collision.beta"),
                         ("{beta: 0.1 + v, e: 0.9}\nwalls: {e: 1 - v}", "key 'walls.e'", "allowed: a number")):
        done = run("info", "scene.yaml", scene=GAS + f"collision: {value}\n")
        check(done.code in (2, 3), value, done.code)
        for text in says:
            check(text in words(done), value, text, done.err)


if __name__ == "__main__":
    main(sys.modules[__name__])
