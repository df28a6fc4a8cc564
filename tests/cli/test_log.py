# SPDX-License-Identifier: GPL-3.0-or-later
"""output.log: a row for each sample while the run lasts, with means that end as those of the result; resumed runs go on
in the same file, as if they had never been interrupted; what is no log is left alone."""
import csv
import json
import os
import signal
import subprocess
import sys
import time

from tap import GRAINGAS, PATIENCE, check, main, run

SCENE = "flow: usf\nengine: %s\nphi: 0.1\nparticles: 200\ncollision: {e: 0.9, beta: 0}\ndsmc: {particles: 200}\n" \
        "run: {collisions: %g, warmup: 40, replicas: %d}\noutput: {log: run.csv}\n"


def rows(name="run.csv"):
    with open(name, encoding="utf-8") as file:
        return list(csv.DictReader(file))


def test_rows_grow_and_means_are_theirs():
    """Samples count from 1, time and collisions grow; the means begin with averaging, and are those of the values."""
    for engine in "md", "dsmc":
        done = run("run", "scene.yaml", "--json", "--quiet", scene=SCENE % (engine, 400, 1))
        check(done.code == 0, done.err)
        found, results = rows(), json.loads(done.out)["results"]
        check([int(r["sample"]) for r in found] == list(range(1, len(found) + 1)) and len(found) > 150, len(found))
        for name in "time", "collisions_per_grain":
            values = [float(r[name]) for r in found]
            check(all(a < b for a, b in zip(values, values[1:])), name)
        window = [r for r in found if r["averaging"] == "1"]
        check(0 < len(window) < len(found) and all(r["averaging"] == "0" for r in found[:len(found) - len(window)]))
        check(all(r["temperature_mean"] == "" for r in found if r["averaging"] == "0"))
        for n in 1, 7, len(window):
            mean = sum(float(r["temperature"]) for r in window[:n]) / n
            check(abs(float(window[n - 1]["temperature_mean"]) / mean - 1) < 1e-7, engine, n)
        for name in "temperature", "temperature_ratio", "pressure", "shear_viscosity":
            mean = results[name]["mean"]
            check(abs(float(found[-1][name + "_mean"]) / mean - 1) < 1e-7, engine, name, found[-1], mean)


def test_json_lines():
    """JSON lines have the same numbers, an object a line; NaN is null. The log is that of the first
    replica for any number of threads."""
    check(run("run", "scene.yaml", "--quiet", scene=SCENE % ("dsmc", 200, 3)).code == 0)
    check(run("run", "scene.yaml", "--quiet", "--threads", "3", "--set", "output.log=run.jsonl").code == 0)
    with open("run.jsonl", encoding="utf-8") as file:
        lines = [json.loads(line) for line in file]
    table = rows()
    check(len(lines) == len(table) and lines[0]["temperature_mean"] is None)
    for line, row in zip(lines, table):
        check({k: "" if v is None else f"{v:.9g}" for k, v in line.items()} == row, line, row)


def test_a_falling_temperature_has_a_column():
    """A falling temperature has a column, which ends with Haff's law."""
    done = run("run", "scene.yaml", "--quiet", scene="flow: hcs\nphi: 0.1\nparticles: 500\ncollision: {e: 0.9}\n"
               "run: {collisions: 400}\noutput: {log: run.csv}\n")
    check(done.code == 0, done.err)
    found = rows()
    T = [float(r["temperature"]) for r in found]
    check(T[0] > 0.2 and T[-1] < 1e-6 and all(b < 1.1 * a for a, b in zip(T, T[1:])), T[0], T[-1])
    check(abs(float(found[-1]["cooling_rate"])) < 1 and len(found) > 100)


def test_rows_come_while_it_runs():
    """And are on the disk at once: kill -9 leaves whole rows."""
    with open("scene.yaml", "w", encoding="utf-8") as file:
        file.write(SCENE % ("md", 1e8, 1))
    child = subprocess.Popen([GRAINGAS, "run", "scene.yaml", "--quiet"], stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
    until = time.time() + 60 * PATIENCE
    while time.time() < until and not (os.path.exists("run.csv") and len(rows()) > 50):
        time.sleep(0.05)
    check(child.poll() is None, "it ended")
    second = run("run", "scene.yaml", "--quiet", "--set", "run.collisions=100", "--output", "other.h5")
    child.kill()
    child.wait()
    check(second.code == 3 and "run.csv" in second.err, "two runs write one log", second.err)
    with open("run.csv", "rb") as file:
        check(file.read().endswith(b"\n"))
    found = rows()
    check(len(found) > 50 and [int(r["sample"]) for r in found] == list(range(1, len(found) + 1)))


def test_resumed_runs_go_on():
    """Cut by signals twice, with rows beyond the checkpoint, the file is that of the run that was left alone."""
    for engine, ending, length in ("md", "csv", 1500), ("dsmc", "jsonl", 3000):
        log = "run." + ending
        check(run("run", "scene.yaml", "--quiet", "--set", f"output.log=whole.{ending}", scene=SCENE % (engine, length, 2)).code == 0)
        args = ["run", "scene.yaml", "--quiet", "--set", f"output.log={log}", "--set", "output.checkpoint_every=0.02", "--output", "a.h5"]
        cuts = 0
        for _ in range(6):
            more = ["--resume", "a.checkpoint.h5"] if os.path.exists("a.checkpoint.h5") else []
            child = subprocess.Popen([GRAINGAS, *args, *more], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
            until = time.time() + (0.25 + 0.1 * cuts) * PATIENCE
            while child.poll() is None and (time.time() < until or not os.path.exists("a.checkpoint.h5")):
                time.sleep(0.01)
            if child.poll() is not None:
                break
            child.send_signal(signal.SIGKILL if cuts % 2 else signal.SIGTERM)
            child.communicate()
            cuts += 1
        if os.path.exists("a.checkpoint.h5"):
            done = run(*args, "--resume", "a.checkpoint.h5")
            check(done.code == 0, done.err)
        with open(log, "rb") as one, open(f"whole.{ending}", "rb") as other:
            check(one.read() == other.read(), engine, cuts, "cuts: the log differs")
        check(cuts > 0, "it was never cut")


def test_what_is_no_log_stays():
    """Files of others, devices, other endings; the result and its log are two files. A log of a run is replaced."""
    with open("notes.csv", "w", encoding="utf-8") as file:
        file.write("my notes\n")
    scene = SCENE % ("dsmc", 100, 1)
    done = run("run", "scene.yaml", "--quiet", "--set", "output.log=notes.csv", scene=scene)
    check(done.code == 3 and "no log of a run" in done.err, done.err)
    with open("notes.csv", encoding="utf-8") as file:
        check(file.read() == "my notes\n")
    for name in "run.txt", "run", ".csv", "/dev/null", "[run.csv]", '"a\\nb.csv"', "x" * 300 + ".csv":
        done = run("run", "scene.yaml", "--quiet", "--set", f"output.log={name}")
        check(done.code == 2 and "output.log" in done.err and ".csv or .jsonl" in done.err, name, done.err)
    os.mkfifo("pipe.csv")
    for name in "pipe.csv", "nowhere/run.csv":
        done = run("run", "scene.yaml", "--quiet", "--set", f"output.log={name}")
        check(done.code == 3 and name in done.err, name, done.err)
    done = run("run", "scene.yaml", "--quiet", "--set", "output.log=same.csv", "--output", "same.csv")
    check(done.code == 2 and "would be both" in done.err, done.err)
    for _ in range(2):
        check(run("run", "scene.yaml", "--quiet").code == 0)
    check(int(rows()[-1]["sample"]) == len(rows()))


def test_beside_the_result():
    """A log goes where its result goes, unless its path is absolute; so do the rows of a run that is resumed."""
    os.makedirs("there/deeper")
    scene = SCENE % ("dsmc", 100, 1)
    for output, log in (("there/a.h5", "there/run.csv"), ("./a.h5", "run.csv"), ("/dev/null", "run.csv"),
                        ("there/deeper/../b.h5", "there/run.csv"), (os.path.abspath("there/c.h5"), "there/run.csv")):
        done = run("run", "scene.yaml", "--quiet", "--output", output, scene=scene)
        check(done.code == 0 and os.path.exists(log), output, done.err)
        os.remove(log)
        check(not os.path.exists("run.csv") and not os.path.exists("there/run.csv"), output)
    for name in os.path.abspath("there/own.csv"), "deeper/own.csv":
        done = run("run", "scene.yaml", "--quiet", "--set", f"output.log={name}", "--output", "there/a.h5")
        check(done.code == 0 and os.path.exists(os.path.join("there", name)) and not os.path.exists("run.csv"), done.err)
    done = run("run", "scene.yaml", "--quiet", "--set", "output.log=a.csv", "--output", "there/a.csv")
    check(done.code == 2 and "there/a.csv: would be both" in done.err, done.err)
    long = ["run", "scene.yaml", "--quiet", "--output", "there/d.h5", "--set", "run.collisions=4000", "--set", "output.checkpoint_every=0.02"]
    stopped = run(*long, "--set", "run.time_limit=0.05")
    check(stopped.code == 1 and os.path.exists("there/d.checkpoint.h5"), stopped.err)
    before = len(rows("there/run.csv"))
    done = run(*long, "--set", "run.time_limit=none", "--resume", "there/d.checkpoint.h5")
    check(done.code == 0 and "earlier run" not in done.err and not os.path.exists("run.csv"), done.err)
    found = rows("there/run.csv")
    check(len(found) > before > 0 and [int(r["sample"]) for r in found] == list(range(1, len(found) + 1)))


def test_replaced_with_a_word():
    """The log of an earlier run is replaced, and the user hears of it before the run."""
    for name in "run.csv", "run.jsonl":
        args = ["run", "scene.yaml", "--quiet", "--set", f"output.log={name}"]
        first = run(*args, scene=SCENE % ("dsmc", 100, 1))
        check(first.code == 0 and "earlier run" not in first.err, first.err)
        with open(name, encoding="utf-8") as file:
            n = len(file.readlines()) - name.endswith("csv")
        second = run(*args)
        check(second.code == 0 and f"warning: {name} holds {n} rows of an earlier run, and is replaced" in second.err, second.err)


def test_off_and_elsewhere():
    """Without the key no file; a comparison and a sweep, whose points keep none, warn."""
    done = run("compare", "scene.yaml", "--quiet", "--picture", "none", "--output", "c.h5", scene=SCENE % ("md", 100, 1))
    check(done.code in (0, 1) and "output.log has no effect in a comparison" in done.err and "run.csv" not in done.new, done.err)
    done = run("sweep", "scene.yaml", "--vary", "collision.e=0.8,0.9", "--quiet")
    check(done.code in (0, 1) and not os.path.exists("run.csv"), done.err)
    check(done.err.count("output.log has no effect in a sweep") == 1, done.err)
    check(run("run", "scene.yaml", "--quiet", "--set", "output.log=none").code == 0 and not os.path.exists("run.csv"))
    check("none" in run("info", "scene.yaml", "--set", "output.log=none").out)


def test_full_disk():
    """The run ends with the reason."""
    done = run("run", "scene.yaml", "--quiet", "--output", "/dev/null", scene=SCENE % ("md", 4000, 1), limit=20000)
    check(done.code == 3 and "run.csv: cannot be written" in done.err, done.code, done.err)


if __name__ == "__main__":
    main(sys.modules[__name__])
