# SPDX-License-Identifier: GPL-3.0-or-later
"""The command line itself: which command takes which option, the ways to ask for help, where a scene comes from, how
numbers may be written, and lines no wider than the terminal."""
import json
import os
import re
import sys

from tap import GRAINGAS, check, main, page, run

SCENE = ("flow: usf\nphi: 0.1\nparticles: 200\ncollision: {e: 0.9, beta: 0}\ndsmc: {particles: 500}\n"
         "measure: [rheology, velocity_distributions, orientation]\nrun: {collisions: 60, warmup: 10}\n")
COMMANDS = "compare", "run", "theory", "plot", "info", "bench"
TAKEN = {"set": "compare run theory info", "output": "compare run plot", "json": "compare run theory info bench",
         "seed": "compare run bench", "threads": "compare run bench", "quiet": " ".join(COMMANDS),
         "resume": "compare run", "extend": "compare run", "accept-version": "compare run sweep", "all": "compare run theory info", "engine": "run", "format": "plot", "picture": "compare bench",
         "width": "compare plot bench",
         "quick": "bench", "limit": "bench", "schema": "info", "theory": "theory", "help": " ".join(COMMANDS)}


def test_options_of_commands():
    """The table of the interface, as --help has it; an option of others is said to be theirs."""
    for command in COMMANDS:
        text = run(command, "--help").out
        has = set(re.findall(r"^  --([\w-]+)", text, re.M))
        check(has == {name for name, takers in TAKEN.items() if command in takers.split()}, command, has)
        for name in set(TAKEN) - has:
            done = run(command, "x", f"--{name}")
            check(done.code == 2 and f"{command} has no option '--{name}', which is for" in done.err, done.err)


def test_theories_by_name():
    """--theory, repeated or with commas, evaluates these and no others."""
    both = json.loads(run("theory", "scene.yaml", "--json", "--theory", "grad,lun1991", scene=SCENE).out)
    check(set(both["theory"]) | set(both["theories"]) == {"grad", "lun1991"}, both)
    check(json.loads(run("theory", "scene.yaml", "--json", "--theory", "grad", "--theory", "lun1991").out) == both)
    done = run("theory", "scene.yaml", "--theory", "lun1992")
    check(done.code == 2 and "did you mean 'lun1991'?" in done.err, done.err)


def test_options_stand_anywhere():
    """Options may stand anywhere, whatever POSIX asks for; after -- there are none."""
    os.environ["POSIXLY_CORRECT"] = "1"
    for args in ("scene.yaml", "--json"), ("--json", "scene.yaml"), ("--json", "--", "scene.yaml"):
        done = run("info", *args, scene=SCENE)
        check(done.code == 0 and json.loads(done.out), args, done.err)
    check(run("info", "scene.yaml", "more.yaml", "--help").out == run("info", "--help").out)
    for args in ("scene.yaml", "--", "--json"), ("scene.yaml", "more.yaml"):
        done = run("info", *args)
        check(done.code == 2 and "one too many" in done.err, args, done.err)
    del os.environ["POSIXLY_CORRECT"]


def test_quiet_commands_print_results_only():
    """Every command takes it, and says nothing beside its result."""
    run("run", "scene.yaml", "--quiet", scene=SCENE)
    for args in ("theory", "scene.yaml"), ("info", "scene.yaml"), ("info", "scene.h5"), ("plot", "scene.h5"):
        done = run(*args, "--quiet")
        check(done.code == 0 and not done.err, args, done.err)
    check(run("plot", "scene.h5", "--quiet").out == "" and run("plot", "scene.h5").out.split()[0] == "scene.svg")


def test_ways_to_ask():
    check(run().code == 2 and "Usage: graingas COMMAND" in run().out)
    top = run("--help").out
    check(top == run("-h").out == run("help").out)
    for command in COMMANDS:
        text = run(command, "--help")
        for args in (command, "-h"), (command, "help"), ("help", command):
            done = run(*args)
            check(done.code == 0 and done.out == text.out, args)
    for args, words in ((("help", "rum"), "unknown command 'rum'; did you mean 'run'?"),
                        (("scene.yaml",), f"for this scene, e.g. {GRAINGAS} compare scene.yaml"),
                        (("r.h5",), f"for this result, e.g. {GRAINGAS} info r.h5"),
                        (("--json", "run"), f"options come after the command: {GRAINGAS} COMMAND --json"),
                        (("--verison",), "did you mean '--version'?"), (("simulate",), f"see {GRAINGAS} --help"), (("reproduce", "3.5"), "in Python: validation/reproduce"),
                        (("run", "--out-put", "x"), "did you mean '--output'?"),
                        (("run", "--verbose"), f"see {GRAINGAS} run --help"),
                        (("run", "--quick", "x"), "run has no option '--quick', which is for validate, bench"),
                        (("run", "scene.yaml", "-json"), "unknown option '-json'; did you mean '--json'?"),
                        (("run", "-seed", "7", "scene.yaml"), "unknown option '-seed'; did you mean '--seed'?"),
                        (("run", "--output=x.h5", "-v", "scene.yaml"), "unknown option '-v'"),
                        (("--help=1",), "option '--help' takes no value"),
                        (("--version=1",), "option '--version' takes no value"),
                        (("run", "--json=1"), "option '--json' takes no value"),
                        (("run", "--helq=1"), "unknown option '--helq'; did you mean '--help'?"),
                        (("run", "--set"), "option '--set' needs a value"),
                        (("info", "--json"), "needs a FILE")):
        done = run(*args)
        check(done.code == 2 and words in done.err and not done.out, args, done.err)
    for command in COMMANDS:
        check("option '--help' takes no value" in run(command, "--help=1").err, command)
        done = run(command, "")
        check(done.code == 2 and f"{command}: the file name is empty" in done.err, command, done.err)
    every = run("info")
    check(every.code == 0 and "dsmc.precision" in every.out and "default" not in every.out.split("\n")[0], every.err)


def test_where_scenes_come_from():
    """Standard input; texts of other systems."""
    expected = run("info", "scene.yaml", "--json", scene=SCENE).out
    check(run("info", "-", "--json", typed=SCENE).out == expected)
    check(run("info", "/dev/stdin", "--json", typed=SCENE).out == expected)
    check(run("info", "scene.yaml", "--json", scene="\ufeff" + SCENE.replace("\n", "\r\n")).out == expected)
    done = run("theory", "-", typed="flow: usf\n")
    check(done.code == 2 and "standard input: phi is missing" in done.err, done.err)
    check("standard input:1: key 'flwo'" in run("theory", "-", typed="flwo: usf\n").err)
    done = run("run", "-", "--quiet", typed=SCENE)
    check(done.code == 0 and done.new == ["stdin.h5"], done.err, done.new)
    check("is an HDF5 file" in run("theory", "stdin.h5").err and run("info", "stdin.h5", "--set", "phi=1").code == 2)


def test_numbers_are_read_as_written():
    for text, value in ("1e3", 1000), (" 300 ", 300), ("300 # grains", 300), ("+300", 300):
        done = run("info", "scene.yaml", "--json", "--set", f"particles={text}", scene=SCENE)
        check(json.loads(done.out)["particles"] == value, text, done.err)
    for text in "1_000", "0x10", "1e400", "nan", "inf", "yes", "1,5", "1.5", "[300]", '"300"', "-5", "":
        done = run("info", "scene.yaml", "--set", f"particles={text}", scene=SCENE)
        check(done.code == 2 and "key 'particles'" in done.err, text, done.err)
    for text in "0", "-1", "1e9", "5000", "", "two":
        done = run("run", "scene.yaml", "--threads", text)
        check(done.code == 2 and f"value '{text}' is not allowed; allowed: a whole number from 1 to" in done.err, text)
    twice = run("info", "scene.yaml", "--json", "--set", "phi=0.2", "--set", "phi=0.3").out
    check(json.loads(twice)["phi"] == 0.3, "the last one counts")


def test_command_line_is_kept():
    """As a shell reads it; given twice, the last seed counts."""
    done = run("run", "scene.yaml", "--quiet", "--output", "it's \"a\" $x.h5", "--seed", "1", "--seed", "2", scene=SCENE)
    check(done.code == 0, done.err)
    text = run("info", done.new[0]).out
    check("command: graingas run scene.yaml --quiet --output 'it'\\''s \"a\" $x.h5' --seed 1 --seed 2\n" in text, text)
    check("seed: 2" in text)


def test_exit_codes():
    """Mistakes print nothing on standard output, also with --json. Each exit code of a command is in the
    manual (1 and 130 are met in test_commands.py and test_files.py)."""
    manual = page("manual").split(".SH EXIT STATUS")[1].split(".SH")[0]
    check(re.findall(r"^\.B (\d+)", manual, re.M) == ["0", "1", "2", "3", "130"], manual)
    for command in "compare", "run", "theory", "info":
        for args, code in ((("none.yaml",), 3), ((".",), 3), (("scene.yaml", "--set", "phi=2"), 2),
                           (("scene.yaml", "--set", "gravity=[0, -1, 0]"), 2), (("scene.yaml", "--nothing"), 2)):
            done = run(command, *args, "--json", scene=SCENE)
            check(done.code == code and done.out == "" and done.err.count("\n") == 1, command, args, done.code, done.err)
            check(done.err.startswith("graingas: ") and not done.new, done.err, done.new)


def test_lines_fit():
    """No line is wider than the terminal; a pipe is 80 columns wide. Exceptions: values that can be read back
    (measure, machine, command)."""
    run("compare", "scene.yaml", "--output", "scene.h5", "--quiet", "--picture", "none", scene=SCENE)
    for columns in None, 80, 100, 120:
        for args in [("theory", "scene.yaml", "--all"), ("info", "scene.yaml"), ("info",), ("info", "scene.h5"),
                     ("run", "scene.yaml", "--quiet"), ("compare", "scene.yaml", "--quiet", "--picture", "none"),
                     ()] + [(command, "--help") for command in COMMANDS]:
            for line in run(*args, columns=columns).out.splitlines():
                check(len(line) <= (columns or 80) or re.match("measure: |machine: |command: ", line), columns, args,
                      line)
                check(not line.endswith(" "), "blanks at the end:", args, line)


if __name__ == "__main__":
    main(sys.modules[__name__])
