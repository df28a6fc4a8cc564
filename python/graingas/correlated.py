# SPDX-License-Identifier: GPL-3.0-or-later
"""Means of one run as numbers of uncertainties."""
import math

import numpy as np


class Correlated:
    """Makes the number of each mean when it is first used, correlated with those made before.

    Covariances are estimated pair by pair, and no set of independent numbers has all of them (their table has large
    negative eigenvalues). So a mean gets exactly its covariance with the earlier mean that correlates most with it. The
    others are as near as possible, those whose difference nearly cancels first. If all covariances together are
    impossible, half of the remaining variance is independent, so that no difference vanishes by chance.
    """

    _of_runs = {}  # by identity of the run: a run that is read twice is one run

    def __init__(self):
        self._made, self._before, self._shares, self._independent = {}, {}, [], []

    @classmethod
    def of(cls, identity):
        """The numbers of the run with this identity."""
        return cls._of_runs.setdefault(identity, cls())

    def number(self, estimate):
        """The number of a mean. None: the error of this mean is unknown."""
        key = estimate._curve, estimate.name
        if key not in self._made:
            if math.isnan(estimate.error):
                return None
            self._made[key] = self._make(estimate, key)
        return self._made[key]

    def _make(self, estimate, key):
        from uncertainties import ufloat
        share = _share(self._shares, self._coefficients(estimate))
        self._independent.append(ufloat(0, 1))
        self._shares = [*(np.append(row, 0) for row in self._shares), share]
        self._before[key] = estimate.error
        return estimate.mean + estimate.error * sum(x * z for x, z in zip(share, self._independent))

    def _coefficients(self, estimate):
        """Correlation coefficients with the earlier means; unknown ones are 0."""
        errors = np.array([estimate.error * error for error in self._before.values()])
        table = np.array([estimate._covariance_with(curve, name) for curve, name in self._before])
        return np.clip(np.nan_to_num(table / np.where(errors > 0, errors, 1)), -1, 1)


def _share(shares, rho):
    """A unit vector whose products with the unit vectors `shares` are `rho`; it may have one more element."""
    if not shares:
        return np.ones(1)
    nearest = np.argmax(abs(rho))
    main, left = rho[nearest] * shares[nearest], 1 - rho[nearest] ** 2
    others = np.array([share - (share @ shares[nearest]) * shares[nearest] for share in shares])
    rest = _nearest(others, rho - np.array(shares) @ main, 1 / np.sqrt(1 - rho**2 + 1e-4), left)
    return np.append(main + rest, math.sqrt(max(left - rest @ rest, 0)))


def _nearest(matrix, wanted, weight, room):
    """Solves matrix @ x = wanted by least squares. If x @ x is above `room`, the solution with half of that."""
    left, scale, right = np.linalg.svd(weight[:, None] * matrix, full_matrices=False)
    scale = np.where(scale > 1e-6 * scale.max(), scale, 0)
    b = left.T @ (weight * wanted)

    def solution(damping):
        return right.T @ (scale / np.maximum(scale**2 + damping, 1e-300) * b)
    if (found := solution(0)) @ found <= room:
        return found
    low, high = 1e-15, 1e15
    while high > 1.001 * low:
        middle = math.sqrt(low * high)
        low, high = (middle, high) if solution(middle) @ solution(middle) > room / 2 else (low, middle)
    return solution(high)
