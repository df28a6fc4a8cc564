# SPDX-License-Identifier: GPL-3.0-or-later
"""Help at the keyboard: init, JSON Schema, completion for shells; each is compared with what the program accepts."""
import glob
import json
import os
import re
import shutil
import subprocess

from tap import GRAINGAS, Skip, check, main, run

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def flows():
    done = run("info", "--schema")
    check(done.code == 0, done.err)
    return [w["const"] for w in json.loads(done.out)["properties"]["flow"]["oneOf"]]


def test_init_writes_accepted_scenes():
    """init writes an accepted scene of every flow, also with all its comments as keys; it replaces no file."""
    for flow in flows():
        name = flow + ".yaml"
        check(run("init", flow).new == [name])
        check(run("info", name).code == 0, flow)
        with open(name) as f:
            text = f.read()
        whole = re.sub(r"^( *)# (?=[a-z_]+:( |$))", r"\1", text.split("\n", 3)[3], flags=re.M)
        check(whole.count("\n#") == 0 and len(whole.splitlines()) > 20, whole)
        done = run("info", "all.yaml", scene=whole, name="all.yaml")
        check(done.code == 0, flow, done.err)
        check("no effect" not in done.err and ("walls:" in whole) == (flow in ("couette", "poiseuille", "chute", "fourier")), done.err)
    again = run("init", "usf")
    check(again.code == 3 and "is there already" in again.err, again.err)
    with open("usf.yaml") as f:
        check(f.read().startswith("# usf: uniform shear"))
    check(run("init", "--output", "mine.yaml").new == ["mine.yaml"])
    done = run("init", "coutte")
    check(done.code == 2 and "one of" in done.err and not done.new, done.err)
    check("flow: usf" in run("init", "--output", "/dev/stdout", "--quiet").out)


# Text of a scene, and whether it is one.
SCENES = ((True, "{flow: usf, phi: 0.1, collision: {e: {11: 0.9, other: 0.8}, beta: 0, mu: 0.3}}"),
          (True, "{flow: couette, phi: 0, walls: {speed: 2}, gravity: [0, 0, -1], run: {until: {N1: 0.1}, relative_error: auto}}"),
          (True, "{flow: usf, phi: 0.1, species: [{fraction: 0.5}, {fraction: 0.5, diameter: 2}], measure: [rheology]}"),
          (False, "{flow: usf, phi: 0.7}"), (False, "{flow: usf, phi: 0.1, colision: {e: 0.9}}"), (False, "{phi: 0.1}"),
          (False, "{flow: usf, phi: 0.1, collision: {e: 1.1}}"), (False, "{flow: shear, phi: 0.1}"), (False, "{flow: usf}"),
          (True, "{flow: fourier, phi: 0.1, walls: {temperature: [2, 1]}}"), (True, "{flow: couette, phi: 0.1, walls: {temperature: 2}}"),
          (False, "{flow: fourier, phi: 0.1, walls: {temperature: [2]}}"), (False, "{flow: fourier, phi: 0.1, walls: {temperature: [2, 0]}}"),
          (False, "{flow: usf, phi: 0.1, measure: [colour]}"), (False, "{flow: usf, phi: 0.1, gravity: [0, 1]}"),
          (False, "{flow: usf, phi: 0.1, species: [{fracton: 1}]}"), (False, "{flow: usf, phi: 0.1, run: {replicas: 1.5}}"),
          (False, "{flow: usf, phi: 0.1, run: {until: {colour: 0.1}}}"), (False, "{flow: usf, phi: 0.1, shear_rate: [1]}"),
          (True, "{flow: usf, phi: 0.1, shear_rate: sin(t), run: {duration: 5}}"))


def test_the_schema_accepts_what_the_program_does():
    """An editor marks what the program rejects, and nothing else: examples, sweeps of the papers' figures, and mistakes."""
    try:
        import jsonschema
        import yaml
    except ImportError:
        raise Skip("jsonschema or yaml is not installed")
    schema = json.loads(run("info", "--schema").out)
    jsonschema.Draft7Validator.check_schema(schema)
    validator = jsonschema.Draft7Validator(schema)
    files = glob.glob(ROOT + "/examples/*.yaml") + [ROOT + "/validation/grid/grid.yaml", ROOT + "/validation/noise_free/closures.yaml"]
    for path in filter(os.path.exists, files):
        with open(path) as f:
            wrong = list(validator.iter_errors(plain(yaml.safe_load(f))))
        check(not wrong, path, wrong[:1])
    for good, text in SCENES:
        wrong = [e.message for e in validator.iter_errors(plain(yaml.safe_load(text)))]
        taken = run("info", "s.yaml", scene=text, name="s.yaml").code == 0
        check(taken == good and (not wrong) == good, text, wrong)
    names = set(line.split()[0] for line in run("info").out.splitlines() if line[:1].isalpha())
    held = set()
    for key, value in schema["properties"].items():
        held |= {key + "." + k for k in value["properties"]} if "properties" in value else {key}
    check(names <= held and {"vary", "theories"} <= held, names ^ held)


def plain(value):
    """As JSON has it: keys are texts."""
    if isinstance(value, dict):
        return {str(k): plain(v) for k, v in value.items()}
    return [plain(v) for v in value] if isinstance(value, list) else value


def completed(*words):
    ask = 'source ./c; COMP_WORDS=("$@"); COMP_CWORD=$(($# - 1)); _graingas; printf "%s\\n" "${COMPREPLY[@]}"'
    done = subprocess.run(["bash", "-c", ask, "bash", *words], capture_output=True, text=True, check=True)
    return done.stdout.split()


def test_shells_complete_what_the_program_takes():
    for shell in "bash", "zsh", "fish":
        with open("c", "w") as f:
            f.write(run("--completion", shell).out)
        if shutil.which(shell):
            done = subprocess.run([shell, "-n", "c"], capture_output=True, text=True)
            check(done.returncode == 0 and not done.stderr, shell, done.stderr)
        with open("c") as f:
            text = f.read()
        check(all(command in text for command in ("compare", "sweep", "init", "relative-to")), shell)
    check(run("--completion", "csh").code == 2)
    if not shutil.which("bash"):
        raise Skip("no bash")
    with open("c", "w") as f:
        f.write(run("--completion", "bash").out)
    open("a.yaml", "w").close(), open("a.h5", "w").close()
    check(completed("graingas", "comp") == ["compare"])
    check(completed("graingas", "compare", "--the") == [] and completed("graingas", "theory", "--the") == ["--theory"])
    check(completed("graingas", "run", "--engine", "") == ["md", "dsmc"])
    check(completed("graingas", "run", "--set", "collision.m") == ["collision.mu"])
    check(completed("graingas", "compare", "a") == ["a.yaml"] and completed("graingas", "plot", "a") == ["a.h5"])
    check("temperature_ratio" in completed("graingas", "info", "temperature"))
    options = run("sweep", "--help").out
    for word in completed("graingas", "sweep", "--"):
        check(word in options, word)


if __name__ == "__main__":
    import sys
    check(os.path.exists(GRAINGAS))
    main(sys.modules[__name__])
