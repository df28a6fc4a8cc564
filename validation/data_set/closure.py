#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Closure of sheared smooth grains from the data set, for other programs: T, p, shear viscosity and loss at phi and e.

    validation/data_set/closure.py PHI E        (units: d, shear rate, density of the grains)

The table is divided by a formula that has its large factors, 1/(1 - e^2) and the divergence of the contact value: smooth
grains of kinetic theory (J of docs/reference/theories.md#jenkins_zhang2002-vescovi2014-chialvo_sundaresan2013). Ratios
are interpolated through the four nearest values of each axis (Lagrange), over e and over G/(G + 0.3), G = phi chi, in
which they are smooth. Needs Python alone."""
import csv
import math
import os
import sys

TABLE = os.path.join(os.path.dirname(os.path.realpath(__file__)), "usf.csv")
NAMES = ["temperature", "pressure", "shear_viscosity"]


def contact(phi):
    return phi * (1 - phi / 2) / (1 - phi) ** 3


def formula(phi, e):
    """T, p and eta of steady shear in units of rho_p, d and the shear rate; 1 to 3 times those of the table."""
    G = contact(phi)
    J = (1 + e) / 2 + math.pi / 32 * (5 + 2 * (1 + e) * (3 * e - 1) * G) * (5 + 4 * (1 + e) * G) / (
        (24 - 6 * (1 - e) ** 2 - 5 * (1 - e * e)) * G * G)
    T = 2 * J / (15 * (1 - e * e))
    return [T, phi * T * (1 + 2 * (1 + e) * G), 8 * J * phi * G / (5 * math.sqrt(math.pi)) * math.sqrt(T)]


class Closure:
    """The states of one method, on the largest grid of phi and e that it fills: rows of e are kept first."""

    def __init__(self, path=TABLE, method="enskog_hermite", beta="-1", mu="inf"):
        with open(path) as f:
            rows = [r for r in csv.DictReader(f) if (r["method"], r["beta"], r["mu"]) == (method, beta, mu)]
        found = {(float(r["phi"]), float(r["e"])): r for r in rows if all(r[q] for q in NAMES)}
        densities = sorted({phi for phi, _ in found})
        self.e = sorted({e for _, e in found if sum((phi, e) in found for phi in densities) >= 0.75 * len(densities)})
        self.phi = [phi for phi in densities if all((phi, e) in found for e in self.e)]
        self.ratio = {(phi, e): [float(found[phi, e][q]) / f for q, f in zip(NAMES, formula(phi, e))]
                      for phi in self.phi for e in self.e}

    @staticmethod
    def weights(axis, x, variable=float):
        """Weights of the four nearest nodes around x in Lagrange's polynomial of a variable."""
        first = min(max(sum(node <= x for node in axis) - 2, 0), max(len(axis) - 4, 0))
        nodes, v = axis[first:first + 4], variable
        return {a: math.prod((v(x) - v(b)) / (v(a) - v(b)) for b in nodes if b != a) for a in nodes}

    def __call__(self, phi, e, without_phi=None, without_e=None):
        """T, p, eta and zeta = 2 eta / (3 n T), the fraction of the translational energy lost per time."""
        if not (self.phi[0] <= phi <= self.phi[-1] and self.e[0] <= e <= self.e[-1]):
            raise ValueError(f"phi from {self.phi[0]} to {self.phi[-1]} and e from {self.e[0]} to {self.e[-1]} are in the table")
        over_phi = self.weights([x for x in self.phi if x != without_phi], phi, lambda x: contact(x) / (contact(x) + 0.3))
        over_e = self.weights([x for x in self.e if x != without_e], e)
        T, p, eta = (f * sum(a * b * self.ratio[x, y][k] for x, a in over_phi.items() for y, b in over_e.items())
                     for k, f in enumerate(formula(phi, e)))
        return T, p, eta, 2 * eta / (3 * phi * T)

    def left_out(self):
        """Largest relative error of T, p and eta at inner values of phi, and of e, interpolated without that value."""
        def off(phi, e, **without):
            found, true = self(phi, e, **without), [r * f for r, f in zip(self.ratio[phi, e], formula(phi, e))]
            return max(abs(a / b - 1) for a, b in zip(found, true))
        return (max(off(phi, e, without_phi=phi) for phi in self.phi[1:-1] for e in self.e),
                max(off(phi, e, without_e=e) for phi in self.phi for e in self.e[1:-1]))


if __name__ == "__main__":
    if len(sys.argv) != 3:
        sys.exit(__doc__)
    try:
        for symbol, value in zip(("T", "p", "eta", "zeta"), Closure()(*map(float, sys.argv[1:]))):
            print(f"{symbol} = {value:.6g}")
    except ValueError as error:
        sys.exit(f"closure.py: {error}")
