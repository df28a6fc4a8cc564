# SPDX-License-Identifier: GPL-3.0-or-later
"""graingas export: tables with the numbers of the result's document, to the last bit, in CSV as others read it; grains
as extended XYZ in the cell of their frame; and no file at all where one of them cannot be."""
import csv
import json
import math
import os
import re
import resource
import shutil
import subprocess
import sys

from tap import GRAINGAS, Skip, check, main, run

try:
    import h5py
except ImportError:
    h5py = None

SHEARED = ("flow: usf\nphi: 0.2\nparticles: 100\ncollision: {e: 0.9, beta: 0}\ndsmc: {particles: 500}\n"
           "measure: [rheology, velocity_distributions]\nrun: {collisions: 60, warmup: 10}\n"
           "output: {trajectory_every: 10}\n")
MIXTURE = ("flow: usf\nphi: 0.2\nparticles: 100\ncollision: {e: 0.9}\n"
           "species: [{fraction: 0.5}, {fraction: 0.5, diameter: 1.5, mass: 2}]\n"
           "run: {collisions: 20, warmup: 5}\n")
WALLED = ("flow: couette\nphi: 0.1\nparticles: 200\nwalls: {e: 0.9, beta: 1, speed: 1}\ncollision: {e: 0.9, beta: 0}\n"
          "run: {collisions: 20, warmup: 5}\noutput: {trajectory_every: 5}\n")


def simulated(scene, *args, command="run", output="r.h5"):
    picture = ("--picture", "none") if command == "compare" else ()
    done = run(command, "scene.yaml", "--quiet", "--json", "--output", output, *picture, *args, scene=scene)
    check(done.code == 0, done.code, done.err)
    return json.loads(done.out)


def exported(*args, code=0):
    done = run("export", *args)
    check(done.code == code, args, done.code, done.err)
    return done


def rows(path):
    """Cells of a table by its head; lines as RFC 4180 ends them, no number that is none."""
    with open(path, "rb") as f:
        text = f.read()
    check(text.endswith(b"\r\n") and text.count(b"\n") == text.count(b"\r\n"), path)
    check(not re.search(rb"(?i)(^|,)-?(nan|inf|null)(,|\r)", text), path)
    with open(path, newline="", encoding="utf-8") as f:
        lines = list(csv.reader(f, strict=True))
    check(len({len(line) for line in lines}) == 1, path)
    return lines[0], [dict(zip(lines[0], line)) for line in lines[1:]]


def same(cell, number, *what):
    """The same bits, or nothing."""
    check((cell == "") if number is None else (cell != "" and float(cell) == number), *what, cell, number)


def frames(path):
    """Count, cell, columns and grains of each frame, as a reader takes them that knows the format alone."""
    found = []
    with open(path, encoding="ascii") as f:
        while line := f.readline():
            n, head = int(line), f.readline()
            keys = {k: q or w for k, q, w in re.findall(r'(\w+)=(?:"([^"]*)"|(\S+))', head)}
            columns = re.findall(r"(\w+):([SRI]):(\d+)", keys["Properties"])
            grains = []
            for _ in range(n):
                words, grain = f.readline().split(), {}
                for name, kind, width in columns:
                    taken, words = words[:int(width)], words[int(width):]
                    taken = [{"S": str, "R": float, "I": int}[kind](w) for w in taken]
                    grain[name] = taken if width != "1" else taken[0]
                check(not words, "more columns than are named")
                grains.append(grain)
            lattice = [float(x) for x in keys["Lattice"].split()]
            found.append((keys, [lattice[0:3], lattice[3:6], lattice[6:9]], grains))
    return found


def fractions(cell, r):
    """Coordinates along the edges of a cell whose second edge alone leans, along x."""
    y = r[1] / cell[1][1]
    return (r[0] - y * cell[1][0]) / cell[0][0], y, r[2] / cell[2][2]


def test_a_run_is_exported_to_the_last_bit():
    for engine in "md", "dsmc":
        document = simulated(SHEARED, "--engine", engine, output=engine + ".h5")
        done = exported(engine + ".h5")
        head, table = rows(engine + ".csv")
        check(head == ["quantity", "mean", "stderr", "unit", "samples", "correlation_time", "correlation_time_unit",
                       "steady", "reason"], head)
        check([line["quantity"] for line in table] == list(document["results"]) and len(table) > 10, table)
        empty = 0
        for line in table:
            one = document["results"][line["quantity"]]
            for key in "mean", "stderr", "correlation_time", "samples":
                same(line[key], one[key], line["quantity"], key)
            check(line["unit"] == one["unit"] and line["correlation_time_unit"] == one["correlation_time_unit"])
            check(line["reason"] == one.get("reason", "") and line["steady"] == str(document["steady"]).lower(), line)
            empty += line["mean"] == ""
        check(empty > 0, "a quantity that cannot be had is there, and empty")
        curves(document, engine + "_", done)
        check((engine + ".xyz" in done.new) == (engine == "md"), done.new)
        check(sorted(done.out.split()) == done.new, done.out)


def curves(document, prefix, done):
    check(len(document["curves"]) >= 3)
    for name, curve in document["curves"].items():
        path = f"{prefix}{curve['group']}_{name}.csv"
        check(path in done.new, path, done.new)
        head, table = rows(path)
        unit = {"x": curve["x_unit"], "y": curve["unit"]}
        law = curve.get("reference")
        names = [(curve["x_name"], "x"), (curve["y_name"], "y"), ("stderr", "y")] + ([(law["label"], "y")] if law else [])
        check(head == [n if unit[u] in ("", "1") else f"{n} [{unit[u]}]" for n, u in names], head)
        check(len(table) == len(curve["x"]) > 3, path)
        columns = [curve["x"], curve["value"], curve["stderr"]] + ([law["value"]] if law else [])
        for i, line in enumerate(table):
            for k, column in enumerate(columns):
                same(list(line.values())[k], column[i], path, i, k)
    told = {(line["curve"], line["number"]): line for line in rows(prefix + "numbers.csv")[1]
            if line["engine"] == document["engine"]}
    wanted = {(c, n): one for c, curve in document["curves"].items() for n, one in curve["numbers"].items()}
    check(told.keys() == wanted.keys() and wanted, told.keys())
    for key, one in wanted.items():
        same(told[key]["mean"], one["mean"], key)
        same(told[key]["stderr"], one["stderr"], key)
        check(told[key]["unit"] == one["unit"], key)


def test_a_comparison_is_exported_whole():
    document = simulated(SHEARED, command="compare")
    done = exported("r.h5")
    _, table = rows("r.csv")
    check([line["quantity"] for line in table] == [row["quantity"] for row in document["comparison"]])
    said = 0
    for line, row in zip(table, document["comparison"]):
        quantity = line["quantity"]
        same(line["md_dsmc_z"], row["md_dsmc_z"], quantity)
        check(line["unit"] == row["unit"] and line["beyond_expected"] == str(row["beyond_expected"]).lower(), line)
        for engine in "md", "dsmc":
            one = document[engine]["results"].get(quantity, {})
            for key in "mean", "stderr", "samples", "correlation_time":
                same(line[f"{engine}_{key}"], one.get(key), quantity, engine, key)
            check(line[engine + "_steady"] == (str(document[engine]["steady"]).lower() if one else ""), line)
        for name, theory in document["theory"].items():
            same(line[name], theory.get(quantity, {}).get("mean"), quantity, name)
            same(line.get(name + "_error", ""), theory.get(quantity, {}).get("error"), quantity, name)
            said += line[name] != ""
    check(said > 10, said)
    for engine in "md", "dsmc":
        path = f"r_{engine}_velocity_distributions_{next(iter(document[engine]['curves']))}.csv"
        check(path in done.new, path, done.new)
    check(len(frames("r.xyz")) == 1)
    # One engine alone steady: as another program may have written it.
    if not h5py:
        return
    document["md"]["steady"], document["dsmc"]["steady"] = False, True
    with h5py.File("r.h5", "r+") as f:
        del f["graingas/document"]
        text = json.dumps(document).encode()
        f["graingas"].create_dataset("document", data=text, dtype=f"S{len(text) + 1}")
    exported("r.h5", "--output", "other")
    for line in rows("other.csv")[1]:
        check((line["md_steady"], line["dsmc_steady"]) in (("false", "true"), ("false", ""), ("", "true"), ("", "")), line)
    check(any(line["md_steady"] and line["dsmc_steady"] for line in rows("other.csv")[1]))


def stored(path):
    """Arrays of the grains as the file has them."""
    if not h5py:
        raise Skip("no h5py")
    with h5py.File(path) as f:
        g = f["particles/grains"]
        return {"edges": g["box/edges/value"][()], "time": g["velocity/time"][()], "step": g["velocity/step"][()],
                "diameter": g["diameter"][()], "mass": g["mass"][()], "species": g["species"][()],
                **{name: g[name + "/value"][()] for name in ("position", "velocity", "spin") if name in g}}


def as_stored(path, result):
    """Every frame, whole; positions but for the image that is in the cell."""
    whole, found = stored(result), frames(path)
    check(len(found) == len(whole["time"]) and len(found) > 0, len(found))
    for k, (keys, cell, grains) in enumerate(found):
        check(float(keys["Time"]) == whole["time"][k] and int(keys["collisions"]) == whole["step"][k], keys)
        check(cell == whole["edges"][k].tolist(), cell)
        check(("omega" in grains[0]) == ("spin" in whole))
        for i, grain in enumerate(grains):
            check(grain["id"] == i and grain["velo"] == whole["velocity"][k][i].tolist(), k, i)
            check("spin" not in whole or grain["omega"] == whole["spin"][k][i].tolist(), k, i)
            check(grain["radius"] == whole["diameter"][i] / 2 and grain["mass"] == whole["mass"][i], k, i)
            check(grain["species"] == ["H", "He"][whole["species"][i]], k, i)
            r = whole["position"][k][i]
            images = (grain["pos"][0] - r[0]) / cell[0][0]
            check(abs(images - round(images)) < 1e-12 and abs(images) < 1.5 and grain["pos"][1:] == r[1:].tolist(), k, i)
    return found


def inside(found):
    for keys, cell, grains in found:
        for grain in grains:
            for f, periodic in zip(fractions(cell, grain["pos"]), keys["pbc"].split()):
                check(-1e-12 < f < 1 + 1e-12 or periodic == "F", keys, grain)


SMOOTH = ("flow: usf\nphi: 0.2\nparticles: 200\ncollision: {e: 0.8}\ndsmc: {particles: 2000}\n"
          "measure: [rheology, velocity_distributions]\nrun: {collisions: 60, warmup: 10}\n")


def test_curves_of_theory():
    """The noise-free distribution has the names and abscissae of the measured one, in JSON, CSV, HDF5 and pictures."""
    theory = json.loads(run("theory", "scene.yaml", "--json", scene=SMOOTH).out)["theory_curves"]["enskog_hermite"]
    document = simulated(SMOOTH, command="compare")
    said, measured = document["theory_curves"]["enskog_hermite"], document["dsmc"]["curves"]
    check(list(said) == list(measured) == list(theory) and len(said) == 6, list(said))
    for name, curve in said.items():
        check(max(abs(a - b) for a, b in zip(curve["x"], measured[name]["x"])) < 1e-9, name)
        check(curve["value"] == theory[name]["value"], name)
    exported("r.h5")
    _, table = rows("r_enskog_hermite_velocity_distributions_velocity_distribution_Cy.csv")
    check([line["P/P(0)"] == "" for line in table] ==
          [value is None for value in said["velocity_distribution_Cy"]["value"]])
    same(table[80]["P/P(0)"], said["velocity_distribution_Cy"]["value"][80])
    done = run("plot", "r.h5")
    check(done.code == 0, done.err)
    with open("r_velocity_distributions.svg", encoding="utf-8") as f:
        check("Enskog (Hermite)" in re.sub(r"<[^>]*>", "", f.read()))
    simulated(SMOOTH, "--engine", "dsmc", output="one.h5")  # has asked no theory: its picture does
    check(run("plot", "one.h5").code == 0)
    with open("one_velocity_distributions.svg", encoding="utf-8") as f:
        check("Enskog (Hermite)" in re.sub(r"<[^>]*>", "", f.read()))
    if not h5py:
        return
    with h5py.File("r.h5") as f:
        for name, curve in said.items():
            stored = f["graingas/theory/enskog_hermite/curves"][name]
            for key in "x", "value", "stderr":
                check([None if math.isnan(x) else x for x in stored[key][()].tolist()] == curve[key], name, key)


def test_sheared_trajectory():
    """The cell leans by shear rate times height, counted from the nearest image, and every grain is in it."""
    simulated(SHEARED)
    exported("r.h5", "--only", "trajectory")
    found = as_stored("r.xyz", "r.h5")
    inside(found)
    leans = []
    for keys, cell, grains in found:
        check(keys["pbc"] == "T T T" and keys["shear_rate"] == "1" and keys["velocity_unit"] == "d gamma", keys)
        slid = float(keys["Time"]) * cell[1][1] / cell[0][0]
        check(abs(math.remainder(cell[1][0] / cell[0][0] - slid, 1)) < 1e-9, keys, slid)
        leans.append(cell[1][0])
    check(len(found) >= 6 and len(set(leans)) == len(leans) and max(abs(x) for x in leans) > 0.1, leans)


def test_species_of_a_mixture_are_exported():
    simulated(MIXTURE)
    done = exported("r.h5")
    found = as_stored("r.xyz", "r.h5")
    inside(found)
    check(len(found) == 1 and done.new == ["r.csv", "r.xyz"], done.new)
    radii = {(grain["species"], grain["radius"], grain["mass"]) for grain in found[0][2]}
    check(radii == {("H", 0.5, 1), ("He", 0.75, 2)} and "omega" not in found[0][2][0], radii)


def test_walls_bound_the_exported_box():
    simulated(WALLED)
    exported("r.h5")
    found = as_stored("r.xyz", "r.h5")
    inside(found)
    check(len(found) >= 3)
    for keys, cell, grains in found:
        check(keys["pbc"] == "T F T" and cell[1][0] == 0 and keys["shear_rate"] == "0", keys)
        check(all(grain["radius"] <= grain["pos"][1] <= cell[1][1] - grain["radius"] for grain in grains))


def test_resumed_trajectory():
    simulated(SHEARED, output="whole.h5")
    run("run", "scene.yaml", "--quiet", "--set", "run.collisions=1e9", "--set", "run.time_limit=0.02", "--set",
        "output.checkpoint_every=60")
    check(os.path.exists("scene.checkpoint.h5"))
    done = run("run", "scene.yaml", "--quiet", "--resume", "scene.checkpoint.h5", "--set", "run.collisions=4000")
    check(done.code == 0, done.err)
    exported("whole.h5", "--only", "trajectory")
    exported("scene.h5", "--only", "trajectory")
    with open("whole.xyz", encoding="ascii") as f, open("scene.xyz", encoding="ascii") as g:
        whole, resumed = f.readlines(), g.readlines()
    check(len(resumed) > len(whole))
    last = (100 + 2) * (len(whole) // 102 - 1)  # the last state of the shorter run is stored, too
    check(last > 300 and resumed[:last] == whole[:last], last)
    inside(frames("scene.xyz"))


def test_other_readers():
    """ASE reads cell, velocities and radii, where it is installed."""
    try:
        from ase.io import read
    except ImportError as why:
        raise Skip(why)
    simulated(SHEARED)
    exported("r.h5")
    whole = stored("r.h5")
    found = read("r.xyz", index=":", format="extxyz")
    check(len(found) == len(whole["time"]))
    for k, atoms in enumerate(found):
        check(atoms.cell.tolist() == whole["edges"][k].tolist() and atoms.pbc.all())
        check(atoms.arrays["velo"].tolist() == whole["velocity"][k].tolist())
        check(abs(atoms.get_velocities() - whole["velocity"][k]).max() < 1e-12)
        check(set(atoms.arrays["radius"]) == {0.5} and set(atoms.get_atomic_numbers()) == {1})
        check(atoms.info["Time"] == whole["time"][k])


def test_ase_takes_masses():
    """Velocities and masses of a mixture are those of the file, not of the elements that species are called by."""
    try:
        from ase.io import read
    except ImportError as why:
        raise Skip(why)
    simulated(MIXTURE)
    exported("r.h5", "--only", "trajectory")
    whole, atoms = stored("r.h5"), read("r.xyz", format="extxyz")
    check(atoms.get_masses().tolist() == whole["mass"].tolist() and set(whole["mass"]) == {1, 2}, atoms.get_masses())
    check(abs(atoms.get_velocities() - whole["velocity"][0]).max() < 1e-12)
    energy = (whole["mass"][:, None] * whole["velocity"][0] ** 2).sum() / 2
    check(abs(atoms.get_kinetic_energy() - energy) < 1e-9 * energy)


def forged(path, change):
    """The result with another document, and a checksum that is right."""
    import struct
    import zlib

    import numpy

    with h5py.File(path, "r+") as f:
        document = json.loads(f["graingas/document"][()])
        change(document, f)
        if "document" in f["graingas"]:
            del f["graingas/document"]
        f["graingas"].create_dataset("document", data=numpy.bytes_(json.dumps(document)))
    with open(path, "r+b") as f:
        data = f.read()
        f.write(struct.pack("<8sQI", b"gg-crc32", len(data), zlib.crc32(data)))


def test_names_of_a_forged_file():
    """Names that would lead elsewhere are refused, by all that read the file; nothing is written."""
    if not h5py:
        raise Skip("no h5py")

    def group(d, f):
        next(iter(d["curves"].values()))["group"] = "/../../outside"

    def curve(d, f):
        d["curves"]["../../outside"] = d["curves"].pop(next(iter(d["curves"])))

    def number(d, f):
        next(iter(d["curves"].values()))["numbers"]["../x"] = {"mean": 1, "stderr": 1, "unit": "1"}

    def quantity(d, f):
        d["results"]["a\x1b[31m"] = d["results"]["temperature"]

    simulated(SHEARED, "--engine", "dsmc", output="whole.h5")
    os.makedirs("a/b/p_")
    for change in group, curve, number, quantity:
        shutil.copy("whole.h5", "a/b/p.h5")
        forged("a/b/p.h5", change)
        for args in ("export", "p.h5", "--output", "p"), ("plot", "p.h5"), ("info", "p.h5"):
            os.chdir("a/b")
            done = run(*args)
            os.chdir("../..")
            check(done.code == 3 and "has a name that is not allowed" in done.err and not done.out, change, args, done.err)
        check(sorted(os.listdir(".")) == ["a", "scene.yaml", "whole.h5"] and sorted(os.listdir("a/b")) == ["p.h5", "p_"])
    os.rmdir("a/b/p_")


def test_texts_of_a_forged_file():
    """Control sequences and spreadsheet formulas are written as text."""
    if not h5py:
        raise Skip("no h5py")
    import numpy

    def change(d, f):
        d["results"]["temperature"].update(unit="=HYPERLINK(1)", reason="+1+1")
        d["results"]["pressure"].update(unit="@SUM(1)", reason="a\x1b]0;x\x07\u202eb\nc")
        for name in "version", "command", "machine", "date":
            del f["graingas"][name]
            f["graingas"].create_dataset(name, data=numpy.bytes_(b"q\x1b[31m\n\xfc"))

    simulated(SHEARED, "--engine", "dsmc")
    forged("r.h5", change)
    done = run("info", "r.h5")
    check(done.code == 0 and "q?[31m??" in done.out, done.err)
    check("\x1b" not in done.out + done.err and "\u202e" not in done.out, done.out)
    exported("r.h5", "--only", "results")
    table = {line["quantity"]: line for line in rows("r.csv")[1]}
    check(table["temperature"]["unit"] == "'=HYPERLINK(1)" and table["temperature"]["reason"] == "'+1+1", table)
    check(table["pressure"]["unit"] == "'@SUM(1)" and table["pressure"]["reason"] == "a?]0;x??b?c", table["pressure"])
    check(float(table["P_xy"]["mean"]) < 0, "numbers stay numbers")


def test_parts_and_prefix():
    simulated(SHEARED)
    os.mkdir("there")
    done = exported("r.h5", "--only", "results", "--output", "there/x")
    check(done.out == "there/x.csv\n" and os.listdir("there") == ["x.csv"], done.out)
    check(exported("r.h5", "--only", "results,trajectory", "--output", "y.csv").new == ["y.csv", "y.xyz"])
    done = exported("r.h5", "--only", "curves", "--output", "z", "--quiet")
    check(done.new and all(name.startswith("z_") for name in done.new) and not done.out, done.new)
    shutil.copy("r.h5", "plain")  # a result without an ending is not what its tables are called
    check("plain.csv" in exported("plain").new)
    before = open("y.csv", "rb").read()
    exported("r.h5", "--only", "results", "--output", "y")
    check(open("y.csv", "rb").read() == before)


def test_numbers_have_a_point_in_every_locale():
    """A decimal point, whatever the user's numbers look like."""
    simulated(MIXTURE)
    os.environ["LC_ALL"] = "de_DE.UTF-8"
    exported("r.h5", "--only", "results")
    del os.environ["LC_ALL"]
    check(all(line["mean"] == "" or math.isfinite(float(line["mean"])) for line in rows("r.csv")[1]))


def contents():
    kept = {}
    for name in sorted(os.listdir(".")):
        if os.path.isfile(name):
            with open(name, "rb") as f:
                kept[name] = f.read()
    return kept


def refused(words, code, *args, **how):
    """With nothing written, and nothing touched."""
    before, names = contents(), sorted(os.listdir("."))
    done = run("export", *args, timeout=20, **how)
    check(done.code == code and words in done.err and not done.out, args, done.code, done.err)
    check(contents() == before and sorted(os.listdir(".")) == names, args, os.listdir("."))


def test_invalid_exports_are_rejected():
    simulated(SHEARED)
    refused("export needs RESULT.h5", 2)
    refused("did you mean trajectory", 2, "r.h5", "--only", "trajectry")
    refused("allowed: results, curves, trajectory", 2, "r.h5", "--only", "")
    refused("'-' is not a file to write", 2, "r.h5", "--output", "-")
    refused("need a prefix", 2, "r.h5", "--output", "")
    refused("need a prefix", 2, "r.h5", "--output", "there/")
    os.mkdir("there")
    refused("there: is a folder; give there/NAME", 2, "r.h5", "--output", "there")
    refused("there/: is a folder; give there/NAME", 2, "r.h5", "--output", "there/")
    os.mkdir("r")  # no prefix was asked for
    check(exported("r.h5", "--only", "results").new == ["r.csv"])
    check(exported("r.h5", "--only", "results", "--output", "there.csv").new == ["there.csv"])
    for name in "there.csv", "r.csv":
        os.remove(name)
    for name in "r", "there":
        os.rmdir(name)
    os.mkfifo("pipe")  # nothing beside it; root could also leave files in /dev
    os.symlink("/dev/null", "null")
    for name in "pipe", "null":
        refused(f"{name}: is a device or a pipe", 2, "r.h5", "--output", name)
        os.remove(name)
    refused("export has no option '--json'", 2, "r.h5", "--json")
    refused("option '--output' needs a value", 2, "r.h5", "--output")
    refused("none.h5: cannot be read", 3, "none.h5")
    refused("scene.yaml: cannot be read", 3, "scene.yaml")
    refused("No such file or directory", 3, "r.h5", "--output", "none/x")
    for name in "x.xyz", "x.csv":  # also the last of them: none of the others is there then
        os.mkdir(name)
        refused(f"{name}: cannot be written: Is a directory", 3, "r.h5", "--output", "x")
        os.rmdir(name)
        open(name, "w").close()
        os.chmod(name, 0o444)
        refused(f"{name}: cannot be written: it is write-protected", 3, "r.h5", "--output", "x")
        os.chmod(name, 0o644)
        os.remove(name)
        os.symlink("r.h5", name)
        refused(f"{name}: would be both the result and what is exported from it", 2, "r.h5", "--output", "x")
        os.remove(name)
        os.mkfifo(name)
        refused("tables and trajectories are files", 3, "r.h5", "--output", "x")
        os.remove(name)
    os.symlink("x.csv", "x.xyz")  # to where nothing stands yet, and then to a file
    refused("x.xyz: cannot be written: another process is writing it", 3, "r.h5", "--output", "x")
    open("x.csv", "w").close()
    refused("x.xyz: would be the same file as x.csv", 2, "r.h5", "--output", "x")
    os.remove("x.xyz")
    os.remove("x.csv")
    os.rename("r.h5", "x.csv")
    refused("x.csv: would be both the result", 2, "x.csv")
    os.rename("x.csv", "r.h5")
    refused("r.xyz: cannot be written: File too large", 3, "r.h5", limit=60_000)


def test_nothing_to_export():
    simulated(MIXTURE, "--engine", "dsmc", output="d.h5")
    refused("nothing to export: it holds no positions of grains", 1, "d.h5", "--only", "trajectory")
    refused("nothing to export: it holds no curves", 1, "d.h5", "--only", "curves")
    check(exported("d.h5").new == ["d.csv"])


def test_gases_with_heights_alone_have_no_snapshot():
    """Monte Carlo between walls has heights alone: no snapshot shows them, and what is exported says so."""
    simulated(WALLED, "--engine", "dsmc", "--set", "dsmc.particles=500")
    done = exported("r.h5", "--only", "trajectory")
    check(done.new == ["r.xyz"] and done.err.count("\n") == 1 and "have heights alone" in done.err, done.new, done.err)
    if shutil.which("gnuplot"):
        done = run("plot", "r.h5")
        check(done.code == 0 and done.new == ["r.svg"], done.new, done.err)
    simulated(WALLED, output="md.h5")
    check(exported("md.h5").err == "")


def test_many_files():
    """More of them than the usual limit of open files allows; and a limit that cannot be raised leaves nothing."""
    simulated(SHEARED, command="compare")
    limit = (16, resource.getrlimit(resource.RLIMIT_NOFILE)[1])
    done = subprocess.run([GRAINGAS, "export", "r.h5", "--output", "m"], capture_output=True, text=True,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, limit))
    names = [name for name in os.listdir(".") if name.startswith("m")]
    check(done.returncode == 0 and 2 * len(names) > limit[0], done.stderr, names)
    done = subprocess.run([GRAINGAS, "export", "r.h5", "--output", "n"], capture_output=True, text=True,
                          preexec_fn=lambda: resource.setrlimit(resource.RLIMIT_NOFILE, (16, 16)))
    check(done.returncode == 3 and "Too many open files" in done.stderr, done.returncode, done.stderr)
    check(not [name for name in os.listdir(".") if name.startswith("n")], os.listdir("."))


def test_damaged_files_are_not_exported():
    simulated(SHEARED)
    with open("r.h5", "r+b") as f:
        f.seek(5000)
        byte = f.read(1)[0]
        f.seek(5000)
        f.write(bytes([byte ^ 4]))
    refused("r.h5: cannot be read: its checksum does not match", 3, "r.h5")
    with open("r.h5", "r+b") as f:
        f.truncate(4000)
    refused("r.h5: cannot be read", 3, "r.h5")


def test_cools_for_ever():
    """A gas that has cooled by a thousand decades: the time overflows to infinity, but positions of the grains are
    finite, and the history is drawn up to the last finite time."""
    simulated("{flow: hcs, phi: 0.1, particles: 64, collision: {e: 0.5}, run: {collisions: 9000}}")
    exported("r.h5", "--quiet")
    with open("r.xyz", encoding="utf-8") as f:
        head, *grains = f.read().splitlines()[1:]
    check("Time=inf" in head and "nan" not in head.lower() and len(grains) == 64, head)
    check(all(math.isfinite(float(x)) for line in grains for x in line.split()[1:4]), grains[0])
    if shutil.which("gnuplot"):
        done = run("plot", "r.h5", "--output", "r.svg")
        check(done.code == 0 and os.path.getsize("r.svg") > 1000, done.err)


def test_nobody_elses_file_is_replaced():
    """A table of the user's own under the name of an export stays, and so do all others; an earlier export is replaced."""
    with open("u.yaml", "w") as f:
        f.write("{flow: couette, phi: 0.2, particles: 100, measure: [rheology, profiles], run: {collisions: 40, warmup: 10}, "
                "output: {trajectory_every: 10}}")
    check(run("run", "u.yaml", "--quiet").code == 0)
    names = run("export", "u.h5").out.split()
    check(len(names) > 4 and run("export", "u.h5").code == 0, names)
    for name, text in ("u.csv", "day,rain\n1,2\n"), ("u_numbers.csv", "my notes\n"), ("u.xyz", "3\nwater\nO 0 0 0\n"):
        kept = {n: open(n, "rb").read() for n in names}
        with open(name, "w") as f:
            f.write(text)
        done = run("export", "u.h5")
        check(done.code == 3 and name in done.err and "--output" in done.err, done.code, done.err)
        check(open(name).read() == text and all(open(n, "rb").read() == kept[n] for n in names if n != name), name)
        check(sorted(os.listdir(".")) == sorted([*names, "u.yaml", "u.h5"]), os.listdir("."))
        os.remove(name)
        check(run("export", "u.h5").code == 0)
    open("u.csv", "w").close()  # empty, as mktemp makes them
    check(run("export", "u.h5").code == 0 and os.path.getsize("u.csv") > 100)


if __name__ == "__main__":
    main(sys.modules[__name__])
