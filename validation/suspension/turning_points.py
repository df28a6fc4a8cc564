#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Turning points: the drag at which the hot and the cold state of a sheared suspension end (docs/howto/suspension.md),
from tables of sweeps over bath.drag:

    validation/suspension/turning_points.py TABLE.csv ... [--picture FILE.png]

Near a turning point drag = d - c (ln T - ln T_c)^2. Fits to the five points of a state that are nearest to its end give
d, c and T_c. Their errors are half the width of the middle two thirds of fits to 200 sets of points, drawn within the
errors of the points."""
import csv
import sys

import numpy as np

BORDER = 3.0  # temperature between the states
NEAREST = 5


def read(paths):
    """Method -> (drag, T, error), all points."""
    found = {}
    for path in paths:
        with open(path, encoding="utf-8") as file:
            for row in csv.DictReader(file):
                if row["quantity"] == "temperature" and row["mean"]:
                    point = tuple(float(row[k] or 0) for k in ("bath.drag", "mean", "error"))
                    found.setdefault(row["method"], set()).add(point)
    return {method: np.array(sorted(points)).T for method, points in found.items()}


def turning(points, hot):
    """(drag, error), (T, error) of the end of a state, or None; the hot one ends at its largest drag."""
    drag, T, error = points[:, ((points[1] > BORDER) == hot) & (points[2] < 0.2 * points[1])]
    chosen = np.argsort(-drag if hot else drag)[:NEAREST]
    drag, T, error = (a[chosen] for a in (drag, T, error))
    if len(drag) < NEAREST:
        return None
    random, ends = np.random.default_rng(1), []
    for k in range(201):
        a, b, c = np.polyfit(np.log(T) + (error / T * random.normal(size=len(T)) if k else 0), drag, 2)
        ends.append((c - b * b / (4 * a), np.exp(-b / (2 * a))))
    low, high = np.nanpercentile(ends[1:], (16, 84), axis=0)
    return list(zip(ends[0], (high - low) / 2))


def picture(all_points, path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    figure, ax = pyplot.subplots(figsize=(5, 3.6), dpi=150, layout="constrained")
    styles = {"md": ("o", "C0"), "dsmc": ("s", "C1"), "enskog_hermite": ("-", "C2"), "gaussian_closure": ("--", "C3")}
    for method, (style, colour) in styles.items():
        if method not in all_points:
            continue
        drag, T, error = all_points[method]
        for hot in False, True:
            own, label = ((T > BORDER) == hot) & (error < 0.2 * T), method if hot else None
            if style in "os":
                ax.errorbar(drag[own], T[own], error[own], fmt=style, color=colour, ms=4, mfc="none", label=label)
            else:
                ax.plot(drag[own], T[own], style, color=colour, label=label)
    ax.set(yscale="log", xlabel="drag over shear rate", ylabel=r"T / $d^2\dot\gamma^2$")
    ax.legend(frameon=False, loc="center right")
    figure.savefig(path)


def main(arguments):
    target = None
    if "--picture" in arguments:
        at = arguments.index("--picture")
        target = arguments[at + 1]
        del arguments[at:at + 2]
    if not arguments:
        sys.exit(__doc__)
    all_points = read(arguments)
    for method, points in sorted(all_points.items()):
        for hot in False, True:
            end = turning(points, hot)
            if end:
                (drag, drag_error), (T, T_error) = end
                print(f"{method:18} {'hot' if hot else 'cold':4} ends at drag {drag:.5f} +- {drag_error:.5f}, "
                      f"T {T:.4g} +- {T_error:.2g}")
    if target:
        picture(all_points, target)


if __name__ == "__main__":
    main(sys.argv[1:])
