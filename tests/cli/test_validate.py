# SPDX-License-Identifier: GPL-3.0-or-later
"""graingas validate: a grid in order passes, a planted deviation does not; page, maps, continuation, points, options."""
import csv
import json
import os
import shutil
import struct
import tempfile
import zlib

from tap import check, main, run

GRID = """flow: usf
phi: 0.1
particles: 250
run: {relative_error: 0.05}
vary:
  - {collision.beta: [-1, 0.3], collision.mu: [.inf, 0.1]}
  - {phi: [0.05, 0.1]}
  - {collision.e: [0.6, 0.9]}
sweep: {does: compare}
"""


RUN_ONCE = tempfile.TemporaryDirectory()  # the grid's points, for the tests after the first


def validated(*args):
    with open("g.yaml", "w") as f:
        f.write(GRID)
    kept = os.path.join(RUN_ONCE.name, "g.sweep")
    if os.path.exists(kept) and not os.path.exists("g.sweep"):
        shutil.copytree(kept, "g.sweep")
    done = run("validate", "g.yaml", *args)
    if not os.path.exists(kept) and os.path.exists("g.sweep"):
        shutil.copytree("g.sweep", kept)
    return done


def test_a_grid_in_order():
    """Verdict, tables, maps and page; a second call runs nothing; a point is repeated with other random numbers."""
    done = validated("--page", "g.md")
    maps = ["g_%s.svg" % q for q in ("N1", "N2", "pressure", "shear_viscosity", "temperature")]
    ratio = "g_temperature_ratio.svg"  # rough grains alone
    check(done.code == 0 and done.new == sorted(["g.md", "g.sweep", "g.sweep.csv", "g.sweep.h5", ratio] + maps),
          done.new, done.err)
    check("8 points; md at 8, dsmc at 8." in done.out and "agree within their errors" in done.out, done.out)
    check("no noise-free solution" not in done.out, done.out)
    check("| beta 0.3, mu 0.1 | no answer" in done.out and "| beta -1 " in done.out, done.out)
    with open("g.md") as f:
        page = f.read()
    check(all("](%s)" % name in page for name in maps) and "agree within their errors" in page, page)
    with open("g_temperature.svg") as f:
        picture = f.read()
    check(all(word in picture for word in ("Lun 1991/Enskog", "md/dsmc", "β = 0.3, μ = 0.1", ">no answer<")))
    document = json.loads(validated("--picture", "none", "--json").out)
    check(document["points"] == 8 and document["dsmc"]["agrees"] and document["dsmc"]["without_solution"] == 0, document)
    check(document["largest_z"][0]["repeat"] == next(line for line in done.out.splitlines() if "--seed 2" in line).split("`")[1])
    check(document["without_reference"] == [] and {d["method"] for d in document["deviations"]} >= {"md", "dsmc", "lun1991"})
    before = {f: os.stat("g.sweep/" + f).st_mtime_ns for f in os.listdir("g.sweep")}
    again = validated("--picture", "none")
    check(again.code == 0 and again.out.split("\n\n", 1)[1] == done.out.split("\n\n", 1)[1], "the same verdict")
    check(before == {f: os.stat("g.sweep/" + f).st_mtime_ns for f in os.listdir("g.sweep")})
    command = next(line for line in done.out.splitlines() if "--seed 2" in line).split("`")[1]
    check(command.startswith("graingas validate g.yaml --seed 2 --output again.sweep --point "), command)
    repeated = run(*command.split()[1:])
    check(repeated.code == 0 and repeated.new == ["again.sweep"] and sum(f.endswith(".h5") for f in os.listdir("again.sweep")) == 1,
          repeated.err)
    check("at 1 points" in repeated.out, repeated.out)


def number(text):
    return float(text) if text else None


def test_the_verdict_by_hand():
    """Deviations, their errors, z and counts from the means in the table; processor times with the warm-up."""
    counts = json.loads(validated("--picture", "none", "--json").out)["deviations"]
    with open("g.sweep.csv") as f:
        rows = list(csv.DictReader(f))
    means = {(r["point"], r["method"], r["quantity"]): (number(r["mean"]), number(r["error"])) for r in rows}
    off = {}
    for r in rows:
        if not r["reference"]:
            continue
        mean, error, (truth, doubt) = float(r["mean"]), number(r["error"]), means[r["point"], r["reference"], r["quantity"]]
        engine = r["method"] in ("md", "dsmc")
        doubt, error = doubt or 0, (error if engine else 0) or 0
        check(float(r["reference_mean"]) == truth and abs(float(r["difference"]) - (mean - truth)) <= 1e-12 * abs(truth), r)
        scatter = (error**2 + doubt**2)**.5
        check(not engine or abs(float(r["z"]) * scatter / (mean - truth) - 1) < 1e-9, r)
        check(engine or not r["z"], "a theory's answer has no error of its own", r)
        check(abs(float(r["difference_error"] or 0) - scatter) <= 1e-9 * scatter, r)
        if r["quantity"] in ("N1", "N2"):
            size, unsure = mean - truth, scatter
        else:
            size, unsure = mean / truth - 1, (error**2 + (mean / truth * doubt)**2)**.5 / abs(truth)
            check(not r["deviation"] or abs(float(r["deviation"]) - size) < 1e-12 and abs(float(r["deviation_error"] or 0) - unsure) < 1e-12, r)
        off.setdefault((r["method"], r["quantity"]), []).append((abs(size), unsure))
    for c in counts:
        seen = off[c["method"], c["quantity"]]
        check(c["points"] == len(seen) and abs(abs(c["largest"]) - max(seen)[0]) < 1e-12, c)
        for threshold, n in c["beyond"].items():
            check(n == sum(size > float(threshold) and size >= 2 * error for size, error in seen), c, threshold)
    unsure = sum(size > .01 and size < 2 * error for key in off for size, error in off[key] if key[0] != "lun1991")
    check(unsure > 3, "deviations within their errors are there to be left out", unsure)
    engine = next(r for r in rows if r["method"] == "dsmc")
    total = json.loads(run("info", "g.sweep/%s.h5" % engine["file"], "--json").out)["dsmc"]["total"]["cpu_seconds"]
    check(abs(float(engine["seconds"]) / total - 1) < 1e-12, engine["seconds"], total)


def forge(path, *changes):
    """Replaces texts of a point's file by others of the same length; the file is whole again."""
    with open(path, "rb") as f:
        body = f.read()
    body = body[:body.rindex(b"gg-crc32")]
    for old, new in changes:
        check(old in body and len(old) == len(new), old, new)
        body = body.replace(old, new)
    with open(path, "wb") as f:
        f.write(body + b"gg-crc32" + struct.pack("<QI", len(body), zlib.crc32(body)))


def number_for(path, old, new):
    """The text of a number in a point's file, and one of the same length for another number."""
    with open(path, "rb") as f:
        body = f.read()
    there = next(t for t in (("%%.%dg" % n % old).encode() for n in (17, 16, 15)) if t in body)
    planted = (b"%.17g" % new + b"0" * 20)[:len(there)]
    check(planted.count(b".") == 1 and b"e" not in there + planted and abs(float(planted) / new - 1) < 1e-9, there, planted)
    return there, planted


def stored(path):
    return json.loads(run("info", path, "--json").out)


def plant(path):
    """A dsmc whose temperature is a fifth too large, in a file that is whole."""
    mean = stored(path)["dsmc"]["results"]["temperature"]["mean"]
    forge(path, number_for(path, mean, 1.2 * mean))


def test_a_planted_deviation():
    check(validated("--picture", "none").code == 0)
    points = json.loads(run("sweep", "g.yaml", "--list", "--json").out)["points"]
    for p in points:
        plant("g.sweep/" + p["name"] + ".h5")
    done = validated("--picture", "none", "--page", "g.md")
    check(done.code == 1 and "disagree beyond chance" in done.err, done.code, done.err)
    check("**dsmc and `enskog_hermite` disagree beyond chance.**" in done.out, done.out)
    check("| temperature !" in done.out and "| N1 " in done.out and "N1 !" not in done.out, done.out)
    check("| temperature " in done.out.split("The largest z:")[1].splitlines()[4], done.out)
    with open("g.md") as f:
        check("disagree beyond chance" in f.read(), "a page also where it fails")


SCORES = {"temperature": (2.5, -1.5, 0.5, -3.25, 0.5, -0.5, 0.25, -0.25),
          "pressure": (-4.0, -5.0, -5.6, -6.0, -3.0, -4.5, -5.0, -4.0),
          "shear_viscosity": (1.0, 1.25, -1.0, 7.5, 0.5, -0.5, 1.0, -1.0)}
OFF = (-0.3, -0.03, 0.005, 0.1, 0.002, -0.002, 0.001, -0.001)  # of md's temperature


def forged_points():
    """The grid's folder, in which z-scores of dsmc at the points are SCORES, and md's temperature is off by OFF: that of
    md by point."""
    check(validated("--picture", "none").code == 0)
    listed = json.loads(run("sweep", "g.yaml", "--list", "--json").out)["points"]
    md = {}
    for number, point in enumerate(listed, 1):
        path = "g.sweep/" + point["name"] + ".h5"
        document = stored(path)
        solution, k, changes = document["theory"]["enskog_hermite"], len(md), []
        for quantity, scores in SCORES.items():
            result, truth = document["dsmc"]["results"][quantity], solution[quantity]
            scatter = (result["stderr"]**2 + (truth.get("error") or 0)**2)**.5
            changes.append(number_for(path, result["mean"], truth["mean"] + scores[k] * scatter))
        result, truth = document["md"]["results"]["temperature"], solution["temperature"]["mean"]
        md[number] = OFF[k]
        changes.append(number_for(path, result["mean"], truth * (1 + md[number])))
        forge(path, *changes)
    check(len(md) == 8, md)
    return md


def test_z_of_both_signs():
    """A folder made by hand: mean and mean square of z, the largest, what fails, the list of the worst and the counts
    keep their signs, in the document and in the table."""
    md = forged_points()
    done = validated("--picture", "none", "--json")
    check(done.code == 1 and "disagree beyond chance" in done.err, done.code, done.err)
    verdict = json.loads(done.out)
    rows = {row["quantity"]: row for row in verdict["dsmc"]["quantities"]}
    check(verdict["dsmc"]["agrees"] is False and verdict["dsmc"]["points"] == 8, verdict["dsmc"])
    for quantity, scores in SCORES.items():
        row = rows[quantity]
        for name, value in (("points", 8), ("mean_z", sum(scores) / 8), ("mean_z2", sum(z * z for z in scores) / 8),
                            ("largest_z", max(map(abs, scores)))):
            check(abs(row[name] - value) < 1e-6, quantity, name, row[name], value)
        check(row["fails"] == (abs(row["mean_z"]) > row["mean_z_allowed"] or row["mean_z2"] > row["mean_z2_allowed"]
                               or row["largest_z"] > verdict["dsmc"]["z_allowed"]), row)
    check(rows["pressure"]["fails"] and rows["pressure"]["mean_z"] < 0 and not rows["temperature"]["fails"], rows)
    worst = {(row["quantity"], row["point"]): row["z"] for row in verdict["largest_z"]}
    points = sorted(md)
    check(abs(worst["pressure", points[2]] + 5.6) < 1e-6 and abs(worst["shear_viscosity", points[3]] - 7.5) < 1e-6, worst)
    sizes = [abs(row["z"]) for row in verdict["largest_z"]]
    check(sizes == sorted(sizes, reverse=True) and len(sizes) == 8, sizes)
    counts = next(row for row in verdict["deviations"] if (row["method"], row["quantity"]) == ("md", "temperature"))
    check(abs(counts["largest"] + 0.3) < 1e-9 and counts["where"]["point"] == points[0] and counts["beyond"]["0.2"] == 1, counts)
    text = validated("--picture", "none").out
    lines = text.splitlines()
    cells = [cell.strip() for cell in next(line for line in lines if line.startswith("| pressure !")).split("|")]
    check(cells[3] == "-4.64" and cells[5] == "22.33" and cells[7] == "6.0", cells)
    first = [[cell.strip() for cell in line.split("|")] for line in lines[lines.index("The largest z:"):] if "`graingas" in line]
    check([(row[1], row[2]) for row in first[:2]] == [("+7.5", "shear_viscosity"), ("-5.6", "pressure")], first[:2])
    with open("g.sweep.csv") as f:
        z = {(int(r["point"]), r["quantity"]): float(r["z"]) for r in csv.DictReader(f) if r["method"] == "dsmc" and r["z"]}
    for quantity, scores in SCORES.items():
        check(all(abs(z[point, quantity] - scores[k]) < 1e-6 for k, point in enumerate(points)), quantity, z)


def test_nothing_judged():
    """Without a point that has a steady dsmc and a noise-free solution, `agrees` is null and the command fails."""
    check(validated("--picture", "none").code == 0)
    for point in json.loads(run("sweep", "g.yaml", "--list", "--json").out)["points"]:
        forge("g.sweep/" + point["name"] + ".h5", (b'"steady": true', b'"steady":false'))
    done = validated("--picture", "none", "--json")
    verdict = json.loads(done.out)["dsmc"]
    check(verdict["agrees"] is None and verdict["values"] == 0 and verdict["not_steady"] == 8, verdict)
    check(done.code == 1 and "nothing was judged: of 8 points with a result" in done.err, done.err)


def test_wrong_options_are_rejected():
    for args, words in ((("--quick",), "without a file"), (("--point", "1", "--page", "p.md"), "do not go together"),
                        (("--point", "9"), "from 1 to 8"), (("--show", "colour"), "no point has a quantity 'colour'"),
                        (("--page", "./g.yaml"), "overwritten by its own page"), (("--picture", "maps.bmp"), "not .bmp")):
        done = validated(*args)
        check(done.code == 2 and words in done.err, args, done.code, done.err)
    with open("g.yaml") as f:
        check(f.read() == GRID, "the sweep's file is as it was")
    done = run("validate", "--list")
    check(done.code == 0 and "compare at 180 points" in done.out, done.out[-200:], done.err)
    done = run("validate", "--quick", "--list")
    check(done.code == 0 and "compare at 36 points" in done.out, done.out[-200:], done.err)


if __name__ == "__main__":
    import sys
    main(sys.modules[__name__])
