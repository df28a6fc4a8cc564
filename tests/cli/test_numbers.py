# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers in print: what is read off curves, with errors in the last digits and z, and the rates that bench prints."""
import json
import re
import sys

from tap import check, main, run

CURVES = ("flow: usf\nphi: 0.2\nparticles: 200\ncollision: {e: 0.9, beta: 0}\ndsmc: {particles: 1000}\n"
          "run: {collisions: 300, warmup: 30}\n"
          "measure: [rheology, orientation, velocity_distributions, pair_correlation, cells]\n")
MINOR = re.compile("fit_|_likelihood|kurtosis|skewness|cells|_slabs|_box|_corrected|rate_unit|long_time_tail|_2_4.5|_3.3_5.5")


def estimate(text):
    """1.234(41) or 12.3(1.2), perhaps with an exponent: value, error, and half a unit of the last digit."""
    found = re.fullmatch(r"(-?\d+\.?(\d*))\(([\d.]+)\)(e[-+]\d+)?", text)
    check(found, "no estimate:", text)
    scale = float("1" + (found[4] or "e0"))
    digit = 10.0 ** -len(found[2])
    error = float(found[3]) * (1 if "." in found[3] else digit)
    return float(found[1]) * scale, error * scale, 0.51 * digit * scale


def rows(text):
    """(curve, number) -> cells of the table of what is read off, whose columns may go on in further blocks (rows that
    have nothing there are left out)."""
    table = {}
    for block in text[text.index("read off"):].split("read off")[1:]:
        lines = block.splitlines()
        head = " " * 8 + lines[0]
        edges = [(word.group(), word.end()) for word in re.finditer(r"\S+", head)]
        curve = None
        for line in lines[2:]:
            if not line.strip():
                break
            curve = line.split()[0] if not line.startswith(" ") else curve
            name = line.split()[0 if line.startswith(" ") else 1]
            cells = table.setdefault((curve, name), {"md": "", "dsmc": "", "z": ""})
            for word, end in edges:
                cell = re.search(r"(?:  |^)(\S*)$", line.ljust(end)[:end])
                cells[word] = cell.group(1) if cell else ""
    return table


def same(cell, number):
    value, error, half = estimate(cell)
    check(abs(value - number["mean"]) <= half, cell, number)
    check(abs(error - number["stderr"]) <= max(half, 0.051 * number["stderr"]), cell, number)


def test_numbers_off_curves():
    """Printed is what the JSON holds, to the digits shown; z is the difference over both errors; what is minor waits for
    --all; and a number that one engine lacks leaves its cell empty."""
    d = json.loads(run("compare", "scene.yaml", "--json", "--picture", "none", scene=CURVES).out)
    curves = {engine: d[engine]["curves"] for engine in ("md", "dsmc")}
    for everything in False, True:
        more = ["--all"] if everything else []
        done = run("compare", "scene.yaml", "--quiet", "--picture", "none", *more, columns=100)
        table = rows(done.out)
        check(everything or done.out.count("read off") == 1, "does not fit on a page")
        expected = {(c, n) for e in curves.values() for c, curve in e.items() for n in curve["numbers"]
                    if curve["numbers"][n]["mean"] is not None and (everything or not MINOR.search(n))}
        check(set(table) == expected, set(table) ^ expected)
        for (curve, name), cells in table.items():
            by = {e: curves[e].get(curve, {"numbers": {}})["numbers"].get(name) for e in curves}
            for engine, number in by.items():
                check(bool(cells[engine]) == bool(number), curve, name, engine, cells)
                if number and "(?)" in cells[engine]:
                    check(number["stderr"] is None, curve, name, engine, cells)
                elif number and "(" in cells[engine]:
                    same(cells[engine], number)
                elif number:  # without an error, where that is none
                    check(abs(float(cells[engine]) / number["mean"] - 1) < 1e-2 and number["stderr"] < 1e-9, cells, number)
            if all(by.values()) and cells["z"]:
                z = ((by["md"]["mean"] - by["dsmc"]["mean"])
                     / (by["md"]["stderr"] ** 2 + by["dsmc"]["stderr"] ** 2) ** 0.5)
                check(abs(float(cells["z"]) - z) < 0.051, cells["z"], z)
    check(("pair_correlation", "contact_value") in table and not table["pair_correlation", "contact_value"]["dsmc"])
    check(table["orientation_cos", "Lambda"]["z"])


def ratios_are_whole(rows, by):
    """Every scene at every density once, its ratio within its range, the one it is set beside among the rows."""
    seen = {(r["scene"], r["phi"]) for r in rows}
    check(len(seen) == len(rows) == len({s for s, _ in seen}) * len({phi for _, phi in seen}), sorted(seen))
    for r in rows:
        check((r["against"], r["phi"]) in seen and 0 < r["ratio_lowest"] <= r["ratio"] <= r["ratio_highest"], r)
        check(r["scene"] != r["against"] or r["ratio"] == 1, r)
        check(r["unit"] == by, r)
    return {s for s, _ in seen}


def test_bench_md():
    """The table by size and density, and a ratio for every feature. Times themselves are not asserted; the other tables
    are those of tests/bench."""
    done = run("bench", "md", "--quick", "--json", "--quiet", timeout=300)
    check(done.code == 0, done.err)
    rows = [json.loads(line) for line in done.out.splitlines()]
    rates = [r for r in rows if r["name"].startswith("collisions:")]
    cells = {(r["phi"], r["particles"]) for r in rates}
    check(cells == {(phi, n) for phi in (0.01, 0.3, 0.5) for n in (1000, 10000)} and len(rates) == 6, cells)
    for r in rows:
        check(0 < r["lowest"] <= r["value"] <= r["highest"], r)
    ratios = [r for r in rows if "ratio" in r]
    scenes = ratios_are_whole([r for r in ratios if r["unit"] == "collisions per CPU-second"], "collisions per CPU-second")
    check({"smooth", "rough", "two species", "walls", "walls, gravity", "sheared frictional", "white noise, e = 0.9"} < scenes, scenes)


if __name__ == "__main__":
    main(sys.modules[__name__])
