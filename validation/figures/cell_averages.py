#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Share of cells with a local solid fraction in a range, if each cell is averaged over so many frames in a row.

    graingas run cells.yaml --output cells.h5
    validation/figures/cell_averages.py cells.h5 10 0.25 0.4

The arguments are a result with a trajectory (positions) of grains of diameter 1, the number of cells along an edge, and
the range. Figure 4.3 of the thesis: cells.yaml has flow usf, phi 0.3, 8000 grains, e 0.5, beta 0, run {collisions: 14000,
warmup: 4000}, output {trajectory_every: 14, after: warmup, fields: [position, velocity], precision: single}. Needs numpy
and h5py."""
import sys

import h5py
import numpy as np


def counts(position, edges, n):
    """Grains in each cell."""
    place = np.clip((position / edges % 1 * n).astype(int), 0, n - 1)
    return np.bincount(place @ [1, n, n * n], minlength=n**3)


def shares(numbers, frames, low, high):
    """Share of cells in the range, and its standard error over the windows of so many frames."""
    windows = len(numbers) // frames
    means = numbers[:windows * frames].reshape(windows, frames, -1).mean(1)
    inside = ((means >= low) & (means < high)).mean(1)
    return inside.mean(), inside.std(ddof=1) / windows**0.5 if windows > 1 else float("nan")


def main(path, n, low, high):
    grains, n = h5py.File(path)["particles/grains"], int(n)
    edges, position = np.diag(grains["box/edges/value"][0]), grains["position/value"]
    numbers = np.array([counts(frame, edges, n) for frame in position], float)
    fractions = numbers * np.pi / 6 * position.shape[1] / edges.prod() / numbers.mean()
    for frames in (1, 10, 30, 100, 300, 1000, 3000):
        if frames <= len(fractions):
            share, error = shares(fractions, frames, float(low), float(high))
            print(f"{frames:6} frames: {100 * share:.1f} % +- {100 * error:.1f}")


if __name__ == "__main__":
    main(*sys.argv[1:])
