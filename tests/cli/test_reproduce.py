"""graingas reproduce: one small figure from beginning to end, twice; the list; names that are no figure's."""
import csv
import json
import os
import sys

from tap import check, main, run


def stamps(folder):
    return {f: os.stat(os.path.join(folder, f)).st_mtime_ns for f in os.listdir(folder) if f.endswith(".h5")}


def test_a_figure_from_beginning_to_end():
    """The distribution of collision angles: data, tables and pictures; a second time nothing is run again."""
    done = run("reproduce", "thesis 2.25", "--quick", "--output", "out", "--threads", "1")
    check(done.code == 0, "the folder is made", done.err)
    check(sorted(done.out.split()) == [f"out/thesis-2.25.{e}" for e in ("csv", "h5", "png", "svg")], done.out)
    rows = list(csv.DictReader(open("out/thesis-2.25.csv", newline="")))
    check({r["method"] for r in rows} >= {"md"} and {r["panel"] for r in rows} == {"1"}, rows[:3])
    angles = [float(r["x"]) for r in rows if r["method"] == "md"]
    density = [float(r["y"]) for r in rows if r["method"] == "md"]
    check(abs(sum(density) / len(density) - 1) < 0.02, "a density over [0, 1)", sum(density) / len(density))
    upstream = [d for a, d in zip(angles, density) if a > 0.5]
    check(sum(upstream) > 0.6 * sum(density), "grains collide upstream, in the second quadrant", sum(upstream))
    check(open("out/thesis-2.25.svg").read().rstrip().endswith("</svg>"))
    check(open("out/thesis-2.25.png", "rb").read(4) == b"\x89PNG")
    check(open("out/thesis-2.25.h5", "rb").read(4) == b"\x89HDF")
    asked = run("info", "out/thesis-2.25.h5")
    check(asked.code == 3 and "it is a reproduced figure" in asked.err and ".csv" in asked.err, asked.err)
    before = stamps("out/figures.sweep")
    again = run("reproduce", "2.25", "--quick", "--output", "out")
    check(again.code == 0 and len(before) == 1 and stamps("out/figures.sweep") == before, again.err)
    point = "out/figures.sweep/" + next(iter(before))
    with open("other.yaml", "w") as f:
        f.write("flow: usf\nphi: 0.1\nparticles: 20\nrun: {collisions: 10, warmup: 2}\n")
    check(run("run", "other.yaml", "--output", point, "--quiet").code in (0, 1))
    again = run("reproduce", "2.25", "--quick", "--output", "out")
    check(again.code == 3 and point + ": holds another point: " in again.err, "a result under a point's name", again.err)


def test_units_of_what_changes_in_time():
    check(run("reproduce", "thesis 2.14", "--quick", "--threads", "1").code == 0)
    rows = list(csv.DictReader(open("thesis-2.14.csv", newline="")))
    check({(r["panel"], r["y_unit"]) for r in rows} == {("1", "d^2 gamma^2"), ("2", "1"), ("3", "1")}, rows[:3])


def test_the_list():
    """Every figure with what it needs, how long it takes, and its verdict."""
    table, document = run("reproduce", "list"), run("reproduce", "list", "--json")
    check(table.code == 0 and document.code == 0, table.err + document.err)
    figures = json.loads(document.out)
    names = [f["figure"] for f in figures]
    check("thesis 2.16" in names and "review 12" in names and len(set(names)) == len(names), names)
    review = next(f for f in figures if f["figure"] == "review 1")  # an ensemble, no box
    check(review["quick"]["particles"] == review["full"]["particles"] == 50000, review)
    for f in figures:
        check(f["figure"] in table.out, f["figure"])
        check(f["cannot"] or (f["quick"]["points"] > 0 and 0 < f["quick"]["cpu_seconds"] <= f["full"]["cpu_seconds"]), f)
        check(f["cannot"] or f["verdict"] in ("agrees", "differs", "cannot be told", "open"), f)


def test_what_is_no_figure():
    """Named with the nearest, and nothing is written."""
    for typed, said in (("thesis 2.61", "did you mean 'thesis 2.16'?"), ("reviw 3", "did you mean 'review 3'?"),
                        ("nothing", "there is no figure 'nothing'")):
        done = run("reproduce", typed)
        check(done.code == 2 and said in done.err and not done.new, typed, done.err)
    check(run("reproduce").code == 2)
    open("file", "w").close()
    done = run("reproduce", "thesis 2.25", "--output", "file")
    check(done.code != 0 and "file: cannot be written: it is no folder" in done.err, done.code, done.err)
    check(run("reproduce", "review 3", "--output", "nowhere/out").code == 3)
    check(run("reproduce", "review 3", "--json").code == 2)


main(sys.modules[__name__])
