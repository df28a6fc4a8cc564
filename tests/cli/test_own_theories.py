# SPDX-License-Identifier: GPL-3.0-or-later
"""Theories of a scene's own, `theories`: formulas and tables answer like the others, in theory, compare and sweeps, where
a changed formula needs no new run; what is wrong is named with its line."""
import csv
import itertools
import json
import math
import os
import random
import re

from tap import check, main, run

SCENE = """flow: usf
phi: 0.1
particles: 100
collision: {e: 0.9}
run: {collisions: 100, warmup: 20}
theories:
  mine: {temperature: "5*pi/(1152*phi^2*chi^2*(1-e^2))", N1: "5/2*(1-e)"}
  table: points.csv
"""
POINTS = "temperature,phi,collision.e,N2\n2.5,0.1,0.9,\n1.5,0.2,0.9,0.01\n"


def theories(text, points=POINTS):
    with open("points.csv", "w") as f:
        f.write(points)
    return run("theory", "scene.yaml", "--json", "--theory", "mine,table", scene=text)


def test_formulas_are_evaluated():
    done = theories(SCENE)
    said = json.loads(done.out)["theory"]
    chi = (1 - 0.1 / 2) / (1 - 0.1) ** 3
    exact = 5 * math.pi / (1152 * 0.01 * chi ** 2 * 0.19)
    check(abs(said["mine"]["temperature"]["mean"] / exact - 1) < 1e-12, said["mine"], exact)
    check(abs(said["mine"]["N1"]["mean"] - 0.25) < 1e-15 and set(said["mine"]) == {"temperature", "N1"})
    check(said["table"] == {"temperature": {"mean": 2.5, "unit": "d^2 gamma^2"}}, said["table"])
    other = json.loads(theories(SCENE.replace("phi: 0.1", "phi: 0.2")).out)["theory"]
    check(other["table"]["N2"]["mean"] == 0.01 and other["table"]["temperature"]["mean"] == 1.5, other["table"])
    done = run("theory", "scene.yaml", "--set", "phi=0.15", "--json", "--theory", "table")
    check("table does not apply: table has no row for this scene" in done.out, done.out[-900:])
    mixture = "species:\n - {fraction: 0.5}\n - {fraction: 0.5, mass: 2}\n"
    done = theories(SCENE + mixture)
    check("mine is a formula for one species" in done.out, done.out[-900:])
    done = theories(SCENE.replace('"5/2*(1-e)"', "m_2*x_1") + mixture)
    check(abs(json.loads(done.out)["theory"]["mine"]["N1"]["mean"] - 1) < 1e-12)


MIXTURE = """flow: usf
phi: 0.12
collision: {e: {11: 0.9, 12: 0.8, 22: 0.7}, beta: {11: 0.1, 12: -0.2, 22: -0.3}, mu: {11: 0.4, 12: 0.5, 22: 0.6}}
species: [{fraction: 0.3, diameter: 1, mass: 1, inertia: 0.35}, {fraction: 0.7, diameter: 1.5, mass: 2.5, inertia: 0.45}]
"""
PARAMETERS = {"phi": 0.12, "gamma": 1.0, "e": 0.9, "beta": 0.1, "mu": 0.4, "K": 0.35, "K_2": 0.45, "e_12": 0.8, "e_22": 0.7,
              "beta_12": -0.2, "beta_22": -0.3, "mu_12": 0.5, "mu_22": 0.6, "x_1": 0.3, "x_2": 0.7, "m_1": 1.0, "m_2": 2.5,
              "sigma_1": 1.0, "sigma_2": 1.5, "sigma_12": 1.25}
FUNCTIONS = {"ln": math.log, "log10": math.log10, "exp": math.exp, "sqrt": math.sqrt, "abs": math.fabs, "sin": math.sin,
             "cos": math.cos}
QUANTITIES = ("temperature", "pressure", "shear_viscosity", "N1", "N2", "P_xx", "P_yy", "P_zz", "P_xy", "P_yx", "collision_rate",
              "mean_free_path", "knudsen", "kurtosis_Cx", "kurtosis_Cy", "kurtosis_Cz")


def formula(r, depth):
    """A random formula as a text, with brackets only where chance puts them."""
    kind = r.random() if depth else 0
    blank = lambda: " " * r.randrange(2)
    if kind < 0.25:
        return r.choice((r.choice(list(PARAMETERS)), r.choice(list(PARAMETERS)), r.choice(("pi", "2", "0.5", ".25", "3.", "1e-2", "1.5E+1"))))
    if kind < 0.35:
        return f"{r.choice(list(FUNCTIONS))}{blank()}({blank()}{formula(r, depth - 1)}{blank()})"
    if kind < 0.45:
        return f"{r.choice('+-')}{blank()}{formula(r, depth - 1)}"
    if kind < 0.6:
        return f"({blank()}{formula(r, depth - 1)})"
    return f"{formula(r, depth - 1)}{blank()}{r.choice('++--**//^')}{blank()}{formula(r, depth - 1)}"


def by_python(text):
    """The value by Python's grammar; None: not a number; "unknown": Python raised an error where graingas may continue
    with an infinity."""
    number = r"(?<![\w.])(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?"  # whole ones, too, are floating-point numbers
    text = re.sub(number, lambda m: repr(float(m[0])), text).replace("^", "**").strip()
    try:
        value = eval(text, {"__builtins__": {}}, {**PARAMETERS, **FUNCTIONS, "pi": math.pi})  # pylint: disable=eval-used
    except (ZeroDivisionError, OverflowError, ValueError, TypeError):
        return "unknown"
    return value if isinstance(value, float) and math.isfinite(value) else None


def values_of(formulas):
    """Values by graingas, in the order of the formulas; None: no value."""
    parts = [formulas[k:k + len(QUANTITIES)] for k in range(0, len(formulas), len(QUANTITIES))]
    scene = MIXTURE + "theories:\n"
    for k, part in enumerate(parts):
        names = [*part] + ["m_2"] * (len(QUANTITIES) - len(part))  # each theory names the second species
        scene += f"  t{k}: " + json.dumps(dict(zip(QUANTITIES, names))) + "\n"
    names = ",".join(f"t{k}" for k in range(len(parts)))
    done = run("theory", "-", "--json", "--theory", names, typed=scene)
    check(done.code == 0, done.err, scene)
    theory = json.loads(done.out)["theory"]
    found = [theory.get(f"t{k}", {}).get(q, {}).get("mean") for k in range(len(parts)) for q in QUANTITIES]
    return found[:len(formulas)]


def test_expressions_against_python():
    """Each parameter, then random formulas of all operators and functions: the same bits as by Python's eval()."""
    check(values_of(list(PARAMETERS)) == list(PARAMETERS.values()), values_of(list(PARAMETERS)))
    r = random.Random(59)
    texts = [t for t in (formula(r, 5) for _ in range(1500)) if 8 < len(t) < 120][:360]
    compared = 0
    for k in range(0, len(texts), 120):
        part = texts[k:k + 120]
        for text, found in zip(part, values_of(part)):
            expected = by_python(text)
            if expected != "unknown":
                check(found == expected, repr(text), found, expected)
                compared += expected is not None
    check(compared > 200, compared)
    check(values_of(["1/(e-e)", "ln(-1)", "(-1)^0.5", "exp(1000)", "0/0 + m_2"]) == [None] * 5)


def test_wrong_grammar():
    """Formulas that Python rejects, too."""
    for text in ("2 3", "2(3)", "sin 1", "(1", "1)", "1 +", "* 2", "2 ^", "1..2", "sin()", "pi pi", "", "2e", "e e", "1,2"):
        done = run("theory", "-", "--json", typed=MIXTURE + "theories: {t: {N1: " + json.dumps(text) + "}}\n")
        check(done.code == 2 and "theories.t" in done.err, repr(text), done.code, done.err)


USED = ("N1: a*w - N2", "w: 2*a", "a: 1 + e", "N2: a/w^2 if a > w else w")


def test_formulas_use_each_other():
    """In each of the 24 orders the same bits; intermediate values are no answers. A second species may stand behind a name."""
    one = "phi: 0.1\nflow: usf\ncollision: {e: 0.9}\n"
    for lines in itertools.permutations(USED):
        done = run("theory", "-", "--json", "--theory", "t", typed=one + "theories:\n  t:\n" + "".join(f"    {line}\n" for line in lines))
        said = json.loads(done.out)["theory"]["t"]
        a = 1 + 0.9
        w = 2 * a
        check({name: entry["mean"] for name, entry in said.items()} == {"N1": a * w - w, "N2": w}, lines, said)
    done = run("theory", "-", "--json", "--theory", "t", typed=MIXTURE + "theories: {t: {N1: 2*ratio, ratio: m_2/m_1}}\n")
    check(json.loads(done.out)["theory"]["t"]["N1"]["mean"] == 5, done.out[-900:])
    long = ", ".join(f"a{k}: {'1' if k == 62 else f'a{k + 1} + 1'}" for k in range(63))
    done = run("theory", "-", "--json", "--theory", "t", typed=one + f"theories: {{t: {{N1: a0, {long}}}}}\n")
    check(json.loads(done.out)["theory"]["t"]["N1"]["mean"] == 63, done.err)
    done = run("theory", "-", typed=one + f"theories: {{t: {{N1: a0, N2: a0, {long}}}}}\n")
    check(done.code == 2 and "has more than 64 formulas" in done.err, done.err)


def test_formulas_that_cannot_use_each_other():
    """Line, name, character; of a cycle its members."""
    for lines, line, words in (
            (("N1: a", "a: w + 1", "w: 2*v", "v: a"), 6, "the formula of 'a' depends on itself: a uses w uses v uses a"),
            (("N1: N1 + 1",), 5, "the formula of 'N1' depends on itself: N1 uses N1"),
            (("N1: a", "a: 2", "w: a"), 5, "t: there is no quantity called 'w'"),
            (("N1: a", "a: 2*(e + v)"), 6, "'2*(e + v)' at character 8: not known; there are phi, n, gamma"),
            (("N1: a", "a: 2*e w"), 6, "'2*e w' at character 5: not expected here"),
            (("N1: e", "e: 2"), 6, "the name 'e' is taken: it is a parameter of formulas"),
            (("N1: e", "sqrt: 2"), 6, "the name 'sqrt' is taken: it is a word of formulas"),
            (("N1: e", "else: 2"), 6, "the name 'else' is taken: it is a word of formulas"),
            (("N1: e", "a-b: 2"), 6, "'a-b' is not a valid name"),
            (("N1: a", "a: 2", "a: 3"), 7, "the name 'a' is given twice"),
            (("a: 2*w", "w: a"), 5, "the formula of 'a' depends on itself: a uses w uses a")):
        done = run("theory", "scene.yaml", scene="flow: usf\nphi: 0.1\ntheories:\n  t:\n" + "".join(f"    {x}\n" for x in lines))
        check(done.code == 2 and f"scene.yaml:{line}: key 'theories.t': {words}" in done.err and not done.out, done.err, lines)


def test_published_theory_of_the_documents():
    """The example of extend.md is the theory of graingas, to rounding, wherever it is evaluated."""
    with open(os.path.join(os.environ["SOURCE"], "docs", "howto", "extend.md"), encoding="utf-8") as file:
        scene = re.search(r"<!-- file: friction.yaml -->\n```yaml\n(.*?)^```", file.read(), re.MULTILINE | re.DOTALL)[1]
    for phi, e, beta, mu, inertia in (0.2, 0.95, 0, 0.1, 0.4), (0.01, 0.99, 0.5, 0.05, 0.4), (0.4, 0.8, -0.3, 0.2, 0.3):
        text = scene.replace("phi: 0.2", f"phi: {phi}").replace("{e: 0.95, beta: 0, mu: 0.1}", f"{{e: {e}, beta: {beta}, mu: {mu}}}")
        done = run("theory", "-", "--json", "--theory", "friction,jenkins_zhang2002", typed=text + f"species: [{{inertia: {inertia}}}]\n")
        mine, theirs = (json.loads(done.out)["theory"][name] for name in ("friction", "jenkins_zhang2002"))
        check(len(mine) == 4, mine)
        for name, value in mine.items():
            check(abs(value["mean"] / theirs[name]["mean"] - 1) < 1e-12 and value["unit"] == theirs[name]["unit"], name, value, theirs[name])


def test_theories_have_no_grains():
    """A fraction of half a grain in a thousand, also in a sweep: exact, and no number of grains changes an answer."""
    scene = "flow: usf\nphi: 0.1\nspecies: [{fraction: 0.0005}, {fraction: 0.9995, mass: 2}]\ntheories: {x: {N1: x_1, N2: x_2}}\n"
    asked = ("theory", "-", "--json", "--theory", "x,gaussian_closure")
    answers = [run(*asked, "--set", f"particles={n}", typed=scene) for n in (1000, 8000)]
    check(all(done.code == 0 for done in answers), answers[0].err)
    few, many = (json.loads(done.out)["theory"] for done in answers)
    check(few["x"]["N1"]["mean"] == 0.0005 and few["x"]["N2"]["mean"] == 0.9995, few["x"])
    check(few["gaussian_closure"]["temperature"] == many["gaussian_closure"]["temperature"], few, many)
    rough = scene + "collision: {beta: 0}\nsweep: {does: theory}\n"
    done = run("sweep", "s.yaml", "--vary", "phi=0.1,0.2", scene=rough, name="s.yaml")
    check(done.code == 0, done.err)


def test_another_folder():
    """The table lies beside the scene, wherever the command is typed."""
    os.mkdir("there")
    with open("there/points.csv", "w") as f:
        f.write(POINTS)
    with open("there/scene.yaml", "w") as f:
        f.write(SCENE)
    check(json.loads(run("theory", "there/scene.yaml", "--json", "--theory", "table").out)["theory"]["table"]["temperature"]["mean"] == 2.5)


def test_compared_and_swept():
    """The grains are rough: their Enskog equation takes an eighth of the time."""
    scene = SCENE.replace("{e: 0.9}", "{e: 0.9, beta: 0.2}")
    theories(scene)
    done = run("compare", "scene.yaml", "--json", "--picture", "none")
    check(json.loads(done.out)["theory"]["table"]["temperature"]["mean"] == 2.5, done.err)
    text = scene + "vary: {collision.e: [0.8, 0.9]}\nsweep: {does: compare}\n"
    first = collected(text)
    check(run("info", "s.sweep/" + first[0]["file"] + ".h5", "--json").out.count('"mine"') >= 2)
    second = collected(text.replace("5/2", "7/2"))
    values = [[float(r["mean"]) for r in rows if r["method"] == "mine" and r["quantity"] == "N1"] for rows in (first, second)]
    check(len(values[0]) == 2 and all(abs(b / a - 1.4) < 1e-12 for a, b in zip(*values)), values)
    mine = next(r for r in second if r["method"] == "mine")
    off = float(mine["mean"]) - float(mine["reference_mean"])
    check(mine["reference"] == "enskog_hermite" and abs(float(mine["difference"]) - off) < 1e-12, mine)
    check(all(r in second for r in first if r["method"] in ("md", "dsmc")), "no point is run again")


def collected(text):
    with open("s.yaml", "w") as f:
        f.write(text)
    check(run("sweep", "s.yaml", "--quiet").code in (0, 1))
    check(run("sweep", "s.yaml", "--collect", "--picture", "none").code == 0)
    with open("s.sweep.csv", newline="") as f:
        return list(csv.DictReader(f))


def test_invalid_theories_are_rejected():
    for old, new, words in (("phi^2", "psi^2", "scene.yaml:7: key 'theories.mine': '5*pi/(1152*psi^2"),
                            ("N1:", "colour:", "scene.yaml:7: key 'theories.mine': mine: there is no quantity called 'colour'"),
                            ("mine:", "grad:", "scene.yaml:7: key 'theories.grad': theory: the name 'grad' is taken"),
                            ("points.csv", "none.csv", "scene.yaml:8: key 'theories.table': none.csv: cannot be read"),
                            ("points.csv", "[1]", "scene.yaml:8: key 'theories.table': formulas are expected"),
                            ("N1:", "temperature:", "scene.yaml:7: key 'theories.mine': the quantity 'temperature' is given twice"),
                            ("  table: points.csv", "  mine: points.csv", "'mine' is taken")):
        done = theories(SCENE.replace(old, new))
        check(done.code == 2 and words in done.err and not done.out, done.code, done.err, words)
    for points, words in (("phi,e\n0.1,0.9\n", "has to name parameters"), ("temperature\n1\n", "has to name parameters"),
                          ("phi,temperature\n0.1\n", "points.csv:2: 2 numbers are needed"),
                          ("phi,temperature\n0.1,2,3\n", "points.csv:2: 2 numbers are needed"),
                          ("phi,temperature\n0.1,x\n", "points.csv:2: column 2 is not a number"),
                          ("phi,temperature\n", "has no row"), ("phi,temperature", "has no row"),
                          ("phi,phi,N1\n", "'phi' has two columns"), ("e,collision.e,N1\n", "'collision.e' has two columns"),
                          ("phi,N1,N2,N1\n", "'N1' has two columns"), ("walls.e,N1\n0.9,2\n", "column 'walls.e'"),
                          ("phi,species.3.inertia,N1\n", "column 'species.3.inertia'"), ("e.12,N1\n", "column 'e.12'"), ("", "has to name parameters")):
        done = theories(SCENE, points)
        check(done.code == 2 and words in done.err, points, done.code, done.err)


def test_no_table():
    """A pipe or folder in place of the table blocks no command: each command that reads the scene names it."""
    os.mkfifo("pipe.csv")
    os.mkdir("folder.csv")
    os.symlink("pipe.csv", "link.csv")
    for name in "pipe.csv", "folder.csv", "link.csv", "/dev/zero":
        scene = SCENE.replace("points.csv", name)
        for command in "theory", "info", "run":
            done = run(command, "scene.yaml", scene=scene, timeout=10)
            check(done.code == 2 and f"{name}: cannot be read: it is no file" in done.err, command, name, done.err)
        done = run("sweep", "sweep.yaml", "--list", scene=scene + "vary: {phi: [0.1, 0.2]}\n", name="sweep.yaml", timeout=10)
        check(done.code == 2 and "it is no file" in done.err, done.err)


def test_keys_as_columns():
    """A column may have the key of a scene; of a mixture each pair its own."""
    table = "collision.e.12,K_2,species.1.inertia,N1\n0.8,0.3,0.4,7\n0.9,0.3,0.4,8\n"
    mixture = "species:\n - {fraction: 0.5}\n - {fraction: 0.5, mass: 2, inertia: 0.3}\n"
    scene = SCENE.replace("e: 0.9", "e: {11: 0.7, 12: 0.8, 22: 0.9}") + mixture
    done = theories(scene, table)
    check(json.loads(done.out)["theory"]["table"]["N1"]["mean"] == 7, done.out[-900:])


if __name__ == "__main__":
    import sys
    main(sys.modules[__name__])
