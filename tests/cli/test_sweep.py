# SPDX-License-Identifier: GPL-3.0-or-later
"""graingas sweep on the command line: lists of points, errors, results, kill and resume, several processes in one
folder, tables, scripts for a cluster."""
import contextlib
import csv
import glob
import json
import os
import random
import re
import shutil
import signal
import struct
import subprocess
import sys
import time
import zlib

from tap import GRAINGAS, PATIENCE, check, main, run

SWEEP = """flow: usf
phi: 0.1
particles: 100
run: {collisions: 150, warmup: 20, replicas: 2}
vary:
  collision.e: [0.7, 0.8, 0.9]
  phi: [0.05, 0.1]
"""


def points_in(folder):
    """Files beside the text of the sweep."""
    return [f for f in os.listdir(folder) if f != "sweep.yaml"]


def write(text=SWEEP, name="s.yaml"):
    with open(name, "w") as f:
        f.write(text)


def rows(name):
    with open(name, newline="") as f:
        return [{k: v for k, v in row.items() if k != "seconds"} for row in csv.DictReader(f)]


def collected(folder):
    done = run("sweep", "s.yaml", "--collect", "--output", folder, "--picture", "none")
    check(done.code == 0, done.err)
    return rows(folder + ".csv")


def test_a_sweep_lists_its_points():
    write()
    done = run("sweep", "s.yaml", "--list", "--threads", "2")
    check(done.code == 0 and not done.new and "run at 6 points, of which 0 are done" in done.out, done.out, done.err)
    check([line.split()[:3] for line in done.out.splitlines()[1:3]] == [["1", "0.7", "0.05"], ["2", "0.7", "0.1"]])
    points = json.loads(run("sweep", "s.yaml", "--list", "--json").out)["points"]
    check(len({p["name"] for p in points}) == 6 and points[5]["keys"] == {"collision.e": 0.9, "phi": 0.1}, points)


def test_refused_before_anything_runs():
    write(SWEEP.replace("[0.05, 0.1]", "[0.05, 0.1, 0.7, 0.2, 0.3]"))
    done = run("sweep", "s.yaml")
    check(done.code == 2 and "point 3 of 15 (collision.e 0.7, phi 0.7): key 'phi'" in done.err, done.err)
    check(not os.path.exists("s.sweep"))
    write()
    for args, words in ((("--vary", "phi=0.1,0.2"), "varied twice"), (("--set", "phi=0.1"), "is varied"),
                        (("--point", "7"), "from 1 to 6"), (("--does", "dance"), "allowed: one of run"),
                        (("--vary", "run.seed=1:1000000:1"), "1000000 values"),
                        (("--show", "temperature"), "goes with --collect"), (("--list", "--collect"), "do not go together"),
                        (("--slurm", "--point", "1"), "do not go together"), (("--slurm", "--json"), "do not go together")):
        done = run("sweep", "s.yaml", *args)
        check(done.code == 2 and words in done.err and not done.new, args, done.err)
    done = run("run", "s.yaml")
    check(done.code == 2 and "graingas sweep FILE" in done.err, done.err)
    done = run("sweep", "scene.yaml", scene="flow: usf\nphi: 0.1\n")
    check(done.code == 2 and "no key is varied" in done.err, done.err)


def test_values_without_an_end():
    """An alias within what it stands for."""
    for vary in ("&a {phi: *a}", "{phi: &a [1, *a]}", "{phi: &a [[1, *a], *a, *a]}", "{run: &a {run: *a}}"):
        done = run("sweep", "scene.yaml", "--list", scene="flow: usf\nphi: 0.1\nvary: " + vary + "\n")
        check(done.code == 2 and done.err.startswith("graingas: scene.yaml:"), vary, done.code, done.err)


def test_wrong_folders_of_a_sweep_are_rejected():
    write()
    open("taken", "w").close()
    for output, code, words in (("taken", 3, "no folder"), ("/dev/null", 3, "no folder"), ("a/b", 3, "No such file"),
                                ("", 2, "empty"), ("s.yaml", 2, "overwritten")):
        done = run("sweep", "s.yaml", "--output", output)
        check(done.code == code and words in done.err and not done.new, output, done.err)
    done = run("sweep", "s.yaml", "--output", "a b.sweep", "--point", "2", "--json")
    states = [p["state"] for p in json.loads(done.out)["points"]]
    check(done.code == 0 and states == ["missing", "done"] + 4 * ["missing"], done.out, done.err)


def test_foreign_files_and_words():
    """A file that is none of ours is no point that is done; values without numbers make tables and no picture."""
    write("flow: usf\nengine: dsmc\nphi: 0.1\ncollision: {e: 0.9}\nrun: {collisions: 30, warmup: 5}\n"
          "vary: {flow: [usf, hcs]}\n")
    check(run("sweep", "s.yaml", "--quiet").code in (0, 1))
    name = sorted(f for f in os.listdir("s.sweep") if f.endswith(".h5"))[0]
    with open(os.path.join("s.sweep", name), "w") as f:
        f.write("garbage\n")
    check("1 is done" in run("sweep", "s.yaml", "--list").out)
    check(run("sweep", "s.yaml", "--quiet").code in (0, 1))
    check("2 are done" in run("sweep", "s.yaml", "--list").out)
    done = run("sweep", "s.yaml", "--collect")
    check(done.code == 0 and done.out.split() == ["s.sweep.csv", "s.sweep.h5"] and "numbers" in done.err, done.out, done.err)
    check(run("sweep", "s.yaml", "--collect", "--over", "flow").code != 0)


def test_points_are_collected_in_one_table():
    """Without a picture, whose line would take theories at 25 points more (test_deviations_in_a_picture)."""
    write(SWEEP.replace("replicas: 2}", "replicas: 2}\nsweep: {does: compare}\ncollision: {beta: 0.5}").replace(
        "  phi: [0.05, 0.1]\n", ""))
    done = run("sweep", "s.yaml", "--quiet")
    check(done.code == 0 and not done.out and not done.err and done.new == ["s.sweep"], done.out, done.err)
    done = run("sweep", "s.yaml", "--collect", "--picture", "none")
    check(done.out.split() == ["s.sweep.csv", "s.sweep.h5"], done.out, done.err)
    table = rows("s.sweep.csv")
    check({r["method"] for r in table} >= {"md", "dsmc", "huthmann_zippelius1997"})
    check({r["collision.e"] for r in table} == {"0.7", "0.8", "0.9"})
    one = [r for r in table if r["point"] == "1" and r["quantity"] == "temperature"]
    check(all(r["unit"] == "d^2 gamma^2" for r in one) and one[0]["steady"] in ("true", "false"), one)
    read = json.loads(run("info", "s.sweep/" + one[0]["file"] + ".h5", "--json").out)
    check(float(one[0]["mean"]) == read["md"]["results"]["temperature"]["mean"], one[0])
    check(float(one[0]["error"]) == read["md"]["results"]["temperature"]["stderr"], one[0])
    check(int(one[0]["seed"]) == read["scene"]["run"]["seed"] != 1, one[0])
    done = run("sweep", "s.yaml", "--collect", "--output", "s.sweep/", "--picture", "none")
    check(done.out.split() == ["s.sweep.csv", "s.sweep.h5"], done.out, done.err)
    done = run("info", "s.sweep.h5")
    check(done.code == 3 and "table of a sweep" in done.err, done.code, done.err)
    done = run("sweep", "s.yaml", "--collect", "--json", "--picture", "none")
    check(done.code == 0 and len(json.loads(done.out)["points"]) == 3, done.out, done.err)
    for args, words in (("--over", "engine"), "is not a key that this sweep varies"), (("--show", "colour"), "no point has"):
        done = run("sweep", "s.yaml", "--collect", *args)
        check(done.code == 2 and words in done.err, done.err)
    of = {r["point"]: "s.sweep/" + r["file"] + ".h5" for r in table}
    before = rows("s.sweep.csv")
    shutil.copy(of["1"], of["3"])
    done = run("sweep", "s.yaml", "--collect")
    check(done.code == 3 and of["3"] + ": holds another point: collision.e is 0.7 there, and 0.9 at" in done.err, done.err)
    check(not done.out and not done.new and rows("s.sweep.csv") == before, done.out)


def test_rows_have_the_numbers_of_the_comparison():
    """Rows of the table have the numbers of the point's comparison, and every column one type."""
    write(SWEEP.replace("replicas: 2}", "replicas: 2}\nsweep: {does: compare}").replace(
        "collision.e: [0.7, 0.8, 0.9]\n  phi: [0.05, 0.1]", "- {particles: [100, 200], collision.mu: [.inf, 0.1]}").replace(
        "particles: 100\n", "collision: {e: 0.5, beta: 0.3}\n"))
    check(run("sweep", "s.yaml", "--quiet").code == 0)
    check(run("sweep", "s.yaml", "--collect", "--picture", "none").code == 0)
    table = rows("s.sweep.csv")
    check(all(int(r["seed"]) > 1 and int(r["particles"]) in (100, 200) for r in table), table[0])
    check(all(r[key] in ("true", "false") for r in table for key in ("steady", "short", "beyond_expected")))
    check({r["collision.mu"] for r in table} == {"inf", "0.1"}, "infinity as tables have it")
    for r in table:
        if r["method"] == "md" and r["quantity"] in ("temperature", "N1"):
            of = json.loads(run("info", "s.sweep/" + r["file"] + ".h5", "--json").out)
            of = next(row for row in of["comparison"] if row["quantity"] == r["quantity"])
            check(r["beyond_expected"] == ("true" if of["beyond_expected"] else "false"), r)
            check(bool(r["cause"]) == of["beyond_expected"], r)
            check(r["reference"] == "enskog_hermite" and float(r["z"]) == of["md_enskog_z"], r)
            check((r["deviation"] == "") == (r["quantity"] == "N1"), r)
            if r["deviation"]:
                check(float(r["deviation"]) == of["md_enskog_deviation"], r)
                check(float(r["deviation_error"]) == of["md_enskog_deviation_error"], r)
        if r["method"] == "dsmc" and r["quantity"] == "temperature":
            check(r["z"], r)
        if r["method"] == "lun1991" and r["quantity"] == "temperature":
            off = float(r["mean"]) / float(r["reference_mean"]) - 1
            check(abs(float(r["deviation"]) - off) < 1e-12 and r["z"] == "" and r["beyond_expected"] == "true", r)
            check("e" in r["cause"], r)
    try:
        import h5py
    except ImportError:
        return
    with h5py.File("s.sweep.h5") as f:
        kinds = {name: f["graingas/table/" + name].dtype.kind for name in ("point", "particles", "seed", "steady", "mean",
                                                                          "collision.mu", "z", "method")}
    check(kinds == {"point": "i", "particles": "i", "seed": "i", "steady": "u", "mean": "f", "collision.mu": "f",
                    "z": "f", "method": "S"}, kinds)


SPECIES = """[{fraction: 0.3333, diameter: 1.0, mass: 1.0, inertia: 0.4},
   {fraction: 0.3333, diameter: 0.8, mass: 0.8, inertia: 0.4},
   {fraction: 0.3334, diameter: 0.5, mass: %g, inertia: 0.4}]"""


def drawn(vary, *args):
    """The picture of a sweep of theories that take no time."""
    write("flow: equilibrium\nsweep: {does: theory}\nvary: " + vary)
    shutil.rmtree("s.sweep", ignore_errors=True)
    done = run("sweep", "s.yaml", "--quiet")
    check(done.code == 0, done.err)
    done = run("sweep", "s.yaml", "--collect", "--show", "pressure", *args)
    check(done.code == 0 and done.out.split()[-1] == "s.sweep.svg", done.out, done.err)
    with open("s.sweep.svg") as f:
        return f.read()


def symbols(picture):
    return len(re.findall("<use [^>]* transform='translate", picture))


def test_lines_of_a_picture():
    """One for each combination of the other keys, however long their values are; none through unrelated scenes."""
    picture = drawn("\n species:\n  - %s\n  - %s\n phi: [0.1, 0.2]\n" % (SPECIES % 0.5, SPECIES % 0.25))
    check("species = …mass: 0.5…<" in picture and "species = …mass: 0.25…<" in picture,
          re.findall("species[^<]*", picture))
    check(symbols(picture) == 0, "lines have no symbols")
    for rows in "{random: {points: 4}, phi: 0.1..0.4, particles: 100..200}", "[{phi: [0.1, 0.2], particles: [9, 4]}]":
        check(symbols(drawn(rows, "--over", "phi")) >= 2, "theories are points:", rows)
    check(symbols(drawn("[{phi: [0.1, 0.2], particles: [100, 100]}]", "--over", "phi")) == 0)


def test_deviations_in_a_picture():
    """Relative to a theory: its own line is zero, others lie off it as the table says; chosen theories, logarithmic
    axes and the title; lines have twenty-five points more than the table, which a second picture reads."""
    write(SWEEP.replace("replicas: 2}", "replicas: 2}\nsweep: {does: theory}").replace("  phi: [0.05, 0.1]\n", "").replace(
        "[0.7, 0.8, 0.9]", "[0.9, 0.95]") + "collision: {beta: 0}\n")  # the solver takes half as long as of smooth grains
    check(run("sweep", "s.yaml", "--quiet").code == 0)
    args = ("sweep", "s.yaml", "--collect", "--over", "collision.e", "--theories", "lun1991", "--show")
    done = run(*args, "temperature", "--quiet", "--relative-to", "enskog_hermite", "--log", "xy")
    check(done.code == 0 and "lines" in os.listdir("s.sweep"), done.err)
    with open("s.sweep.svg") as f:
        picture = f.read()
    check("T / Enskog (Hermite)" in picture and ">Lun 1991<" in picture and "Gaussian closure" not in picture)
    title = re.search(">(Uniform shear[^<]*)<", picture)
    check(title and "phi 0.1" in title[1] and ", e " not in title[1], title)
    longest = max(len(re.findall(r"[ML]?[\d.]+,[\d.]+", path)) for path in re.findall("d='([^']*)'", picture))
    check(longest >= 25, longest)
    before = {f: os.stat("s.sweep/lines/" + f).st_mtime_ns for f in os.listdir("s.sweep/lines") if f.endswith(".h5")}
    check(len(before) == 25, len(before))
    done = run(*args, "N1,temperature", "--log", "x")
    check(done.out.split() == ["s.sweep.csv", "s.sweep.h5", "s.sweep.svg"], done.out, done.err)
    with open("s.sweep.svg") as f:
        words = re.sub("<[^>]*>", " ", f.read())
    check("T" in words.split() and "N" in words, words)
    check(before == {f: os.stat("s.sweep/lines/" + f).st_mtime_ns for f in before})
    for wrong, words in ((("--relative-to", "moon"), "no point has a method 'moon'"), (("--theories", "moon"), "no point has a theory"),
                         (("--log", "z"), "allowed: x, y, xy, none")):
        done = run("sweep", "s.yaml", "--collect", *wrong)
        check(done.code == 2 and words in done.err, done.err)


def test_an_axis_of_one_value():
    check("φ" in drawn("{phi: 0.05}"))


def kill_and_go_on(folder, threads, rng, extra=()):
    """Until it is through: kill -9 after a random time of the processor, which does not depend on other load."""
    kills = 0
    while True:
        child = subprocess.Popen([GRAINGAS, "sweep", "s.yaml", "--quiet", "--output", folder, "--threads", threads,
                                  *extra], stderr=subprocess.PIPE, text=True)
        most = rng.uniform(0.05, 0.4) * (1 + kills / 10)
        with contextlib.suppress(OSError):  # the clock of a process that has just ended
            while child.poll() is None and time.clock_gettime((~child.pid << 3) | 2) < most:
                time.sleep(0.005)
        through = child.poll() is not None
        child.kill()
        said = child.communicate()[1]
        if through:
            check(child.returncode == 0, said)
            return kills
        kills += 1


def test_a_killed_sweep_resumes_to_the_same_numbers():
    """kill -9 at any moment; then the same numbers as of a sweep that was left alone, and nothing but results."""
    write()
    check(run("sweep", "s.yaml", "--output", "whole.sweep", "--threads", "2").code == 0)
    whole = collected("whole.sweep")
    rng = random.Random(18)
    kills = kill_and_go_on("a.sweep", "2", rng)
    check(kills > 1, kills)
    check(collected("a.sweep") == whole)
    check(all(name.endswith(".h5") and len(name) == 19 for name in points_in("a.sweep")), points_in("a.sweep"))
    kill_and_go_on("b.sweep", "1", rng, ("--set", "output.checkpoint_every=0.025"))
    check(collected("b.sweep") == whole)
    check(all(len(name) == 19 for name in points_in("b.sweep")), points_in("b.sweep"))
    before = {f: os.stat(f).st_mtime_ns for f in glob.glob("a.sweep/*")}  # sweep.yaml, too
    check(run("sweep", "s.yaml", "--output", "a.sweep").code == 0)
    check(before == {f: os.stat(f).st_mtime_ns for f in glob.glob("a.sweep/*")}, "a point that is done was done again")


def test_shared_folder():
    """Two processes in one folder: neither does what the other is at, one is killed, the other does it all."""
    write(SWEEP.replace("150", "600"))
    args = [GRAINGAS, "sweep", "s.yaml", "--threads", "1", "--json"]
    some = [subprocess.Popen(args, stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True) for _ in range(3)]
    time.sleep(0.5)
    some[2].kill()
    out = [p.communicate(timeout=100 * PATIENCE) for p in some]
    for p, (text, err) in list(zip(some, out))[:2]:
        check(p.returncode == 0, err)
        check([q["state"] for q in json.loads(text)["points"]] == 6 * ["done"], text)
    check(all(len(name) == 19 for name in points_in("s.sweep")), points_in("s.sweep"))
    table = collected("s.sweep")
    check(run("sweep", "s.yaml", "--output", "alone.sweep").code == 0)
    check(table == collected("alone.sweep"))


def test_an_interrupted_sweep_keeps_its_points():
    write(SWEEP.replace("150", "1e9"))
    child = subprocess.Popen([GRAINGAS, "sweep", "s.yaml"], stderr=subprocess.PIPE, text=True,
                             preexec_fn=lambda: signal.signal(signal.SIGTERM, signal.SIG_DFL))
    time.sleep(1)
    child.send_signal(signal.SIGTERM)
    err = child.communicate(timeout=20 * PATIENCE)[1]
    check(child.returncode == 130 and "interrupted; continue with the same command" in err, err)
    check(points_in("s.sweep") == [], points_in("s.sweep"))


def by_another_build(path):
    """A point as another build would have left it, with a temperature that is wrong; whole by its checksum."""
    with open(path, "rb") as f:
        body = f.read()
    body = body[:body.rindex(b"gg-crc32")]
    build = json.loads(run("info", path, "--json").out)["build"].encode()
    check(body.count(build) > 1, build)
    body = body.replace(build, b"0" * len(build))
    with open(path, "wb") as f:
        f.write(body + b"gg-crc32" + struct.pack("<QI", len(body), zlib.crc32(body)))


def test_other_builds():
    """Points of another build and damaged ones run again, and are kept, as --list says before; --accept-version keeps the
    former in place."""
    def told(file):
        points = json.loads(run("sweep", "s.yaml", "--list", "--json").out)["points"]
        return next(p["state"] for p in points if p["name"] + ".h5" == file)

    write()
    check(run("sweep", "s.yaml").code == 0)
    table, files = collected("s.sweep"), sorted(points_in("s.sweep"))
    check(all(row["build"] and row["version"].startswith("0.1.0") for row in table), table[0])
    points = [f for f in files if len(f) == 19]
    for name in points[:2]:
        by_another_build("s.sweep/" + name)
    done = run("sweep", "s.yaml", "--collect", "--picture", "none")
    check(done.code == 0 and "warning: 2 of 6 points are by another build" in done.err, done.err)
    check(sum(row["build"][0:4] == "0000" for row in rows("s.sweep.csv")) == len(table) // 3)
    states = ["other build" if f in points[:2] else "done" for f in points]
    done = run("sweep", "s.yaml", "--list")
    check("of which 4 are done" in done.out and "2 points will run again: damaged, or of another build" in done.out, done.out)
    check(sum("another build  " in line for line in done.out.splitlines()) == 2, done.out)
    check([told(f) for f in points] == states, states)
    done = run("sweep", "s.yaml", "--list", "--accept-version")
    check("of which 6 are done" in done.out and "will run again" not in done.out, done.out)
    done = run("sweep", "s.yaml", "--accept-version")
    check(done.code == 0 and "warning" not in done.err and sorted(points_in("s.sweep")) == files, done.err)
    with open("s.sweep/" + points[2], "r+b") as f:
        f.seek(3000)
        f.write(b"damage")
    check(told(points[2]) == "damaged" and "3 points will run again" in run("sweep", "s.yaml", "--list").out)
    done = run("sweep", "s.yaml")
    check(done.code == 0 and "warning: 2 points are by another build of graingas, 1 are damaged" in done.err, done.err)
    check(collected("s.sweep") == table)
    aside = [p[:-3] + ".old.h5" for p in points[:3]]
    check(sorted(points_in("s.sweep")) == sorted(files + aside), points_in("s.sweep"))


def test_failing_point():
    write("flow: hcs\nphi: 0.3\nparticles: 100\nmd: {contact_time: 0}\n"
          "vary: [{collision.e: [0.9, 0.1, 0.95], run.collisions: [20, 1e6, 20]}]\n")
    done = run("sweep", "s.yaml")
    check(done.code == 1 and "point 2 (collision.e 0.1, run.collisions 1e6) failed: md: " in done.err, done.err)
    check("of 3 points 1 failed" in done.err and len(points_in("s.sweep")) == 2, done.err)
    check({r["collision.e"] for r in collected("s.sweep")} == {"0.9", "0.95"})


def test_an_array_of_one_does_all_tasks():
    """An array of one does all that its tasks would do."""
    write()
    script = run("sweep", "s.yaml", "--vary", "collision.beta=-1,0", "--slurm", "--output", "my runs")
    check(script.code == 0 and "--array=1-12\n" in script.out and not script.new, script.out, script.err)
    with open("array.sh", "w") as f:
        f.write(script.out)
    for task in range(2, 5):
        done = subprocess.run(["bash", "array.sh"], capture_output=True, text=True,
                              env=dict(os.environ, SLURM_ARRAY_TASK_ID=str(task), SLURM_CPUS_PER_TASK="2"))
        check(done.returncode == 0 and len(points_in("my runs")) == task - 1, done.stderr)
    done = subprocess.run(["bash", "array.sh"], capture_output=True, text=True)
    check(done.returncode == 0 and len(points_in("my runs")) == 4, done.stderr)


def test_slurm_typed_otherwise():
    """An abbreviated option, a line's end in the scene's name, options that end with --."""
    write()
    os.rename("s.yaml", "a\ntouch harm;#.yaml")
    for i, words in enumerate((("a\ntouch harm;#.yaml", "--slu", "--output", "out0", "--slurm"),
                               ("--output", "out1", "--slurm", "--", "a\ntouch harm;#.yaml"))):
        script = run("sweep", *words)
        check(script.code == 0, script.err)
        done = subprocess.run(["bash", "-c", script.out], capture_output=True, text=True,
                              env=dict(os.environ, SLURM_ARRAY_TASK_ID="2"))
        check(done.returncode == 0 and len(points_in("out%d" % i)) == 1 and not os.path.exists("harm"), done.stderr)


def test_whole_numbers():
    """Seeds of thirteen digits are as many runs; steps that vanish are refused."""
    write()
    done = run("sweep", "s.yaml", "--vary", "run.seed=1000000000001:1000000000004:1", "--list", "--json")
    check(len({p["keys"]["run.seed"] for p in json.loads(done.out)["points"]}) == 4, done.out)
    for vary in "collision.e=0.5:0.500000000001:1e-13", "run.seed=9007199254740990:9007199254740993:1":
        done = run("sweep", "s.yaml", "--vary", vary, "--list")
        check(done.code == 2 and "lost in the digits" in done.err, done.err)
    done = run("sweep", "s.yaml", "--vary", "run.seed=9007199254740993,1e3", "--list", "--json")
    check({p["keys"]["run.seed"] for p in json.loads(done.out)["points"]} == {9007199254740993, 1000}, done.out)
    done = run("sweep", "s.yaml", "--list", "--json", "--output", b"\xff")
    check(done.code == 0 and json.loads(done.out)["folder"] == "?", done.out, done.err)


def test_short_points():
    """A point that ended short keeps no checkpoint: removed, it is done again from its beginning."""
    write()
    args = ("sweep", "s.yaml", "--set", "run.collisions=1e9", "--set", "run.time_limit=%g" % PATIENCE, "--point", "1",
            "--set", "output.checkpoint_every=0.05")
    for _ in range(2):
        started = time.monotonic()
        check(run(*args).code == 1 and time.monotonic() - started > PATIENCE / 4)
        left = points_in("s.sweep")
        check([f.split(".", 1)[1] for f in left] == ["short.h5"], left)
        os.remove("s.sweep/" + left[0])


def test_folder_knows_its_sweep():
    """sweep FOLDER: the same points, with nothing else at hand; rows that change together, words, settings, keys given."""
    with open("s.yaml", "w") as f:
        f.write("""{flow: usf, phi: 0.1, particles: 200, run: {collisions: 40, warmup: 10, replicas: 2},
                  vary: [{collision.e: [0.7, 0.9], phi: [0.1, 0.2]}, {measure: [[rheology], [rheology, orientation]], collision.beta: [0, 0.5]}],
                  sweep: {seeds: common}}""")
    os.makedirs("deep")
    done = run("sweep", "s.yaml", "--quiet", "--set", "collision.mu=0.4", "--output", "deep/x.sweep")
    check(done.code == 0, done.err)
    again = ("--set", "collision.mu=0.4", "--output", "deep/x.sweep")
    one, two = run("sweep", "s.yaml", "--list", *again).out, run("sweep", "deep/x.sweep", "--list").out
    check(one == two and "4 are done" in two, one, two)
    os.remove("s.yaml")
    done = run("sweep", "deep/x.sweep/", "--collect", "--picture", "none")
    check(done.code == 0 and os.path.exists("deep/x.sweep.csv"), done.err)
    check(run("sweep", "deep/x.sweep", "--point", "2", "--quiet").code == 0)
    os.makedirs("empty")
    done = run("sweep", "empty", "--list")
    check(done.code == 3 and "is a folder" in done.err, done)


if __name__ == "__main__":
    main(sys.modules[__name__])
