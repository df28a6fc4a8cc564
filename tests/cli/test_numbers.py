# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers in print: what is derived from curves, with errors in the last digits and z."""
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
    """(curve, number) -> cells of the table of numbers derived from curves, whose columns may go on in further blocks
    (rows that have nothing there are left out)."""
    table = {}
    for block in text[text.index("derived from"):].split("derived from")[1:]:
        lines = block.splitlines()
        head = " " * len("derived from") + lines[0]
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
        check(everything or done.out.count("derived from") == 1, "does not fit on a page")
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


if __name__ == "__main__":
    main(sys.modules[__name__])
