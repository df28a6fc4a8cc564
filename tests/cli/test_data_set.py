# SPDX-License-Identifier: GPL-3.0-or-later
"""The data set of validation/data_set: its columns are those of its dictionary, its commands those of its plan, rows
computed anew are the same within their errors, and the closure table interpolates to the error that its page states."""
import csv
import importlib.machinery
import json
import math
import os
import re
import subprocess
import sys

from tap import GRAINGAS, PATIENCE, check, main

SOURCE = os.environ["SOURCE"]
FOLDER = os.path.join(SOURCE, "validation", "data_set")
sys.dont_write_bytecode = True


def module(name):
    return importlib.machinery.SourceFileLoader(name, os.path.join(FOLDER, name)).load_module()


data_set, closure = module("data_set"), module("closure.py")
data_set.GRAINGAS = GRAINGAS
TABLES = data_set.TABLES


def answer(*words):
    done = subprocess.run([GRAINGAS, *words, "--json"], cwd=SOURCE, capture_output=True, text=True, timeout=100 * PATIENCE)
    check(done.returncode == 0, words, done.stderr)
    return json.loads(done.stdout)


def test_every_column_is_in_the_dictionary_and_every_row_of_the_dictionary_is_a_column():
    words, used = data_set.dictionary(), set()
    for table in TABLES:
        for column in data_set.read(table)[0]:
            row = data_set.meaning(words, table, column)
            used.add((row["table"], row["column"]))
            check(len(row["meaning"]) > 8, table, column)
    check(used == set(words), set(words) ^ used)
    tables = json.loads(subprocess.run([GRAINGAS, "--tables"], capture_output=True, text=True, check=True).stdout)
    for table, listed in ("usf", "quantities"), ("cooling", "quantities_without_shear"):
        units = {q["name"]: q["unit"] for q in tables[listed]}
        for q in data_set.QUANTITIES[table]:
            check(words[table, q]["unit"] == units.get(q, words[table, q]["unit"]), q)


def test_every_run_is_a_point_of_the_plan_with_its_command_and_its_rows():
    plan = {data_set.name(p): p for p in data_set.plan()}
    check(len(plan) == len(data_set.plan()), "two points have one name")
    states = {(p.flow, p.phi, p.e, p.beta, p.mu) for p in plan.values()}
    check(300 <= len(states) <= 420, len(states))
    runs = data_set.read("runs")
    for row in runs:
        point = plan["_".join(row[k] for k in ("flow", "method", "phi", "e", "beta", "mu"))]
        check(row["command"] == " ".join(["graingas", *data_set.command(point)]), row["command"])
        check(re.fullmatch(r"[0-9a-f]{16}", row["build"]) and row["version"], row)
    for table in "usf", "cooling":
        engines = [tuple(r[k] for k in ("phi", "e", "beta", "mu", "method")) for r in data_set.read(table)
                   if r["method"] in data_set.ENGINES]
        listed = [tuple(r[k] for k in ("phi", "e", "beta", "mu", "method")) for r in runs
                  if r["flow"] == table and r["method"] in data_set.ENGINES]
        check(sorted(engines) == sorted(listed) and len(set(engines)) == len(engines), table)


def test_engine_rows_computed_anew_with_another_seed_are_the_same_within_their_errors():
    """Eight states of dsmc and four of md, T to 2 % and 4 % or better: chi^2 between its quantiles of 1e-4 and 1 - 1e-4."""
    for method, error, count, low, high in ("dsmc", 0.02, 8, 0.46, 31.9), ("md", 0.04, 4, 0.028, 23.6):
        rows = [r for r in data_set.read("usf") if r["method"] == method and float(r["e"]) <= 0.9 and not r["note"]]
        chi2, chosen = 0, rows[::max(len(rows) // count, 1)][:count]
        check(len(chosen) == count, method, len(rows))
        for seed, row in enumerate(chosen):
            point = data_set.Point("usf", method, *(float(row[k]) for k in data_set.STATE))
            found = answer(*data_set.command(point)[:-2], "--set", f"run.relative_error={error}", "--set", "output.checkpoint_every=0", "--seed",
                           str(seed + 1), "--output", os.path.abspath("r.h5"))["results"]["temperature"]
            chi2 += (found["mean"] - float(row["temperature"])) ** 2 / (found["stderr"] ** 2 + float(row["temperature_error"]) ** 2)
            check(0 < found["stderr"] / found["mean"] < 1.2 * error, row, found)
        check(low < chi2 < high, method, chi2)


def test_theory_rows_computed_anew_have_the_same_digits():
    rows = data_set.read("usf")
    for method, note in ("enskog_hermite", ""), ("gaussian_closure", ""), ("lun1991", "out of range"):
        row = next(r for r in rows if r["method"] == method and r["note"] == note)
        point = data_set.Point("usf", "theories", *(float(row[k]) for k in data_set.STATE))
        found = answer(*data_set.command(point))["theory"][method]
        for q in data_set.QUANTITIES["usf"]:
            check((row[q] == "") == (q not in found), method, q)
            if row[q]:
                check(abs(float(row[q]) - found[q]["mean"]) <= 2e-6 * abs(found[q]["mean"]) + 1e-12, row, q, found[q])


def test_make_continues_where_it_stopped_and_collect_gives_the_committed_rows():
    """Three calls of no time at all each make one point of the plan, in its order; theories have the rows of the data set."""
    plan, command = data_set.plan(), [sys.executable, os.path.join(FOLDER, "data_set")]
    for k in range(3):
        done = subprocess.run([*command, "make", "--minutes", "1e-6", "--folder", "points", "--known", "none"], capture_output=True, text=True,
                              env=dict(os.environ, GRAINGAS=GRAINGAS), timeout=100 * PATIENCE)
        check(done.returncode == 0 and f"{len(plan) - k} of {len(plan)} points are missing" in done.stdout, done.stdout, done.stderr)
        check(sorted(os.listdir("points")) == sorted(os.path.basename(data_set.path_of(p, "")) for p in plan[:k + 1]), plan[:3])
    keys = ("flow", *data_set.STATE, "method")
    for table, rows in data_set.tables("points").items():
        committed = {tuple(r.get(k) for k in keys): r for r in data_set.read(table)}
        for row in (r for r in rows if r["method"] not in data_set.ENGINES):
            known = committed[tuple(row.get(k) for k in keys)]
            same = {k: str(v) for k, v in row.items() if k not in ("seconds", "version", "build")}
            check(all(known[k] == v for k, v in same.items()), table, same, known)


def test_make_and_collect_start_from_the_committed_tables():
    """Without the theories of one state `make` computes them alone, and `collect` gives all rows again."""
    point = data_set.Point("usf", "theories", 0.1, 0.7, -1, math.inf)
    os.mkdir("known")
    for table in TABLES:
        rows = data_set.read(table)
        with open(os.path.join("known", table + ".csv"), "w", newline="") as f:
            writer = csv.DictWriter(f, rows[0])
            writer.writeheader()
            writer.writerows(row for row in rows if table not in ("usf", "runs") or row.get("flow", "usf") != "usf" or
                             row["method"] in data_set.ENGINES or any(float(row[k]) != getattr(point, k) for k in data_set.STATE))
    missing, words = len(data_set.plan()) - len(data_set.read("runs")) + 1, ["--minutes", "1e-6", "--folder", "made", "--known", "known"]
    done = subprocess.run([sys.executable, os.path.join(FOLDER, "data_set"), "make", *words], capture_output=True, text=True,
                          env=dict(os.environ, GRAINGAS=GRAINGAS), timeout=100 * PATIENCE)
    check(done.returncode == 0 and done.stdout.startswith(f"{missing} of {len(data_set.plan())} points"), done.stdout, done.stderr)
    check(os.listdir("made") == [os.path.basename(data_set.path_of(point, ""))], os.listdir("made"))
    for table, rows in data_set.tables("made", "known").items():
        committed = data_set.read(table)
        check(len(rows) == len(committed), table, len(rows), len(committed))
        for row, known in zip(rows, committed):
            check(all(known[k] == str(v) for k, v in row.items() if k not in ("version", "build")), table, row, known)


def test_the_hdf5_file_has_the_rows_of_the_tables():
    import h5py
    with h5py.File(os.path.join(FOLDER, "data_set.h5")) as f:
        for table in TABLES:
            rows, records = data_set.read(table), f[table][:]
            check(len(rows) == len(records) and list(rows[0]) == list(records.dtype.names), table, len(rows), len(records))
            for column in rows[0]:
                for row, cell in zip(rows, records[column]):
                    same = row[column] == cell.decode() if isinstance(cell, bytes) else (
                        math.isnan(cell) if row[column] == "" else float(row[column]) == cell)
                    check(same, table, column, row[column], cell)


def test_dsmc_agrees_with_the_noise_free_solution_of_the_same_state():
    """Over all states: mean z^2 of a quantity near 1 or below, as numerical errors are upper estimates."""
    for table, q in ("usf", "temperature"), ("usf", "N1"), ("cooling", "cooling_rate"), ("cooling", "thermal_conductivity_reduced"):
        by = {}
        for r in data_set.read(table):
            by.setdefault(tuple(r[k] for k in data_set.STATE), {})[r["method"]] = r
        z = [(float(m["dsmc"][q]) - float(m["enskog_hermite"][q])) /
             math.hypot(float(m["dsmc"][q + "_error"]), float(m["enskog_hermite"][q + "_error"]))
             for m in by.values() if all(k in m and m[k][q] and m[k][q + "_error"] for k in ("dsmc", "enskog_hermite"))]
        mean = sum(x * x for x in z) / len(z)
        check(len(z) > 10 and 0.05 < mean < 1 + 4 * math.sqrt(2 / len(z)) and max(map(abs, z)) < 4, table, q, len(z), mean, max(map(abs, z)))


def test_the_closure_table_interpolates_to_the_stated_error():
    """Noise-free solutions at states between those of the table; and nodes that are left out."""
    table = closure.Closure()
    check(len(table.phi) >= 8 and len(table.e) >= 7, table.phi, table.e)
    for phi, e, error in (0.125, 0.55, 0.001), (0.25, 0.55, 0.001), (0.25, 0.97, 0.0003), (0.45, 0.75, 0.0003):
        words = data_set.command(data_set.Point("usf", "theories", phi, e, -1.0, math.inf))
        found = answer(*words)["theory"]["enskog_hermite"]
        T, p, eta, zeta = table(phi, e)
        for value, q in zip((T, p, eta), closure.NAMES):
            check(abs(value / found[q]["mean"] - 1) < error, phi, e, q, value, found[q])
        check(abs(zeta / (2 * eta / (3 * phi * T)) - 1) < 1e-12, zeta)
    over_phi, over_e = table.left_out()
    check(0.005 < over_phi < 0.0125 and 0.001 < over_e < 0.0018, over_phi, over_e)
    done = subprocess.run([sys.executable, os.path.join(FOLDER, "closure.py"), "0.125", "0.85"], capture_output=True, text=True)
    check(done.returncode == 0 and re.fullmatch(r"T = \S+\np = \S+\neta = \S+\nzeta = \S+\n", done.stdout), done.stdout)
    done = subprocess.run([sys.executable, os.path.join(FOLDER, "closure.py"), "0.7", "0.85"], capture_output=True, text=True)
    check(done.returncode == 1 and "phi from 0.01 to 0.55" in done.stderr and "Traceback" not in done.stderr, done.stderr)


if __name__ == "__main__":
    main(sys.modules[__name__])
