#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""N1, N2 and the kurtosis of C_x of a sheared run by the definitions of a peculiar velocity that papers leave open:

  graingas run SCENE.yaml --engine md --set output.trajectory_every=6 --output usf.h5
  validation/figures/definitions.py usf.h5 [PARTS ALONG AN EDGE ...]

flow: velocities minus the imposed flow. bins, cells: these minus their mean in the grain's slab across y, or in its
cell; lab: laboratory velocities minus their mean there, so that the shear within a part stays in C_x. Three kinds of
N1 and N2 are printed: of the whole stress (collisional part from the run), of the kinetic stress over the kinetic
pressure, and per cell (the mean over parts of each part's kinetic ratio).

The row `flow` has values; the other rows have differences from it on the same frames. Brackets: standard error of the
last digits, by jackknife over twenty blocks of frames. Needs numpy and h5py."""
import sys

import h5py
import numpy as np

BLOCKS = 20


def part_of(position, edge, n, cells):
    place = np.minimum((position / edge % 1 * n).astype(int), n - 1)
    return (place[:, 0] * n + place[:, 1]) * n + place[:, 2] if cells else place[:, 1]


def sums_of(values, part, parts):
    return np.stack([np.bincount(part, values[:, a], parts) for a in range(3)], 1)


def differences(stress):
    pressure = stress.sum(-1) / 3
    return np.stack([stress[..., 0] - stress[..., 1], stress[..., 1] - stress[..., 2]], -1) / pressure[..., None]


def frame_by_definitions(position, velocity, edge, numbers):
    laboratory = velocity.copy()
    laboratory[:, 0] += position[:, 1] - edge / 2
    yield "flow", velocity, None
    for n in numbers:
        for cells, name in ((False, f"{n} bins"), (True, f"{n}^3 cells")):
            part = part_of(position, edge, n, cells)
            count = np.bincount(part, minlength=n ** 3 if cells else n)
            for v, where in ((velocity, ""), (laboratory, ", lab")):
                peculiar = v - (sums_of(v, part, len(count)) / np.maximum(count, 1)[:, None])[part]
                squares = sums_of(peculiar ** 2, part, len(count))[count > 1]
                yield name + where, peculiar, differences(squares).mean(0)


def jackknife(rows, function):
    blocks = np.array([b.mean(0) for b in np.array_split(rows, BLOCKS)])
    left = np.array([function((blocks.sum(0) - b) / (BLOCKS - 1)) for b in blocks])
    return function(blocks.mean(0)), np.sqrt((BLOCKS - 1) / BLOCKS * ((left - left.mean(0)) ** 2).sum(0))


def main(path, numbers):
    file = h5py.File(path)
    grains, results = file["particles/grains"], file["graingas/results"]
    edge = grains["box/edges/value"][0][0, 0]
    stress = np.pi / 6 * len(grains["id"]) / edge ** 3  # of <C C>: rho_p d^2 rate^2
    collisional = np.array([results[f"P_{a}{a}_collisional/mean"][()] for a in "xyz"]) / stress
    position, velocity = grains["position/value"], grains["velocity/value"]
    rows = {}
    for t in range(len(velocity) // 10, len(velocity)):
        for name, c, own in frame_by_definitions(position[t], velocity[t], edge, numbers):
            own = differences((c ** 2).mean(0)) if own is None else own
            rows.setdefault(name, []).append(np.concatenate([(c ** 2).mean(0), own, (c[:, :1] ** 4).mean(0)]))
    columns = {"total": lambda m: differences(m[:3] + collisional), "kinetic": lambda m: differences(m[:3]),
               "per cell": lambda m: m[3:5]}
    print(f"{velocity.shape[1]} grains, {len(rows['flow'])} frames\n{'':16}"
          + "".join(f"{'N1, ' + k:>16}{'N2, ' + k:>16}" for k in columns) + f"{'kurtosis C_x':>16}")
    flow = np.array(rows["flow"])
    for name, own in rows.items():
        own, text = np.array(own), f"{name:16}"
        for key, of in columns.items():
            beside = columns["kinetic" if key == "per cell" else key]
            value, error = (jackknife(own, of) if name == "flow" else
                            jackknife(np.hstack([own, flow]), lambda m: of(m[:6]) - beside(m[6:])))
            text += "".join(f"{value[k]:+12.4f}({1e4 * error[k]:2.0f})" for k in range(2))
        value, error = jackknife(own, lambda m: m[5] / m[0] ** 2)
        print(text + f"{value:12.3f}({1e3 * error:.0f})")


if __name__ == "__main__":
    main(sys.argv[1], [int(n) for n in sys.argv[2:]] or [4, 5, 10])
