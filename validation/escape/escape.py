#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Grains that escape friction in free cooling (docs/explanation/free_cooling_with_friction.md), with the Python module:

    validation/escape/escape.py planted           # fast grains planted in both engines: what friction takes from them
    validation/escape/escape.py counts            # escapes counted in dsmc, beside the rate of the program
    validation/escape/escape.py picture FILE.png  # spins over time, and the tail of their distribution

Spins are surface velocities s = (d/2) omega, "thermal" is sqrt(theta/K). Ten minutes of one core for all three."""
import sys

import numpy as np

import graingas

K = 0.4
NU0 = 3.2 * np.sqrt(np.pi)  # nu_0 over n chi d^2 sqrt(T)


def scene(engine, grains, phi, e, beta, mu, seed=1):
    size = {"particles": grains} if engine == "md" else {"dsmc": {"particles": grains}}
    return graingas.Scene({"engine": engine, "flow": "hcs", "phi": phi, "run": {"seed": seed},
                           "collision": {"e": e, "beta": beta, "mu": mu}} | size)


def kick(e, mu):
    """mu eta_1/K: what a sliding contact takes from a fast spin, over g_n sin(s, k)."""
    return mu * (1 + e) / 2 / K


def density(phi):
    """n chi d^3, in Monte Carlo at phi = 0 n d^2 = 1."""
    return 6 * phi / np.pi * (1 - phi / 2) / (1 - phi)**3 if phi else 1


class Gas:
    """A cooling gas; spins are over sqrt(T)."""

    def __init__(self, engine, grains, phi, e, beta, mu, seed=1):
        self.simulation = graingas.Simulation(scene(engine, grains, phi, e, beta, mu, seed))
        self.n, self.half, self.mu_kick = grains, 0.5 if phi else 1, kick(e, mu)
        self.density = density(phi)

    def advance(self, collisions):
        """Advances by collisions a grain; returns what T^-1/2 grew by, over n chi times the time: x = zeta/2."""
        before, was = self.simulation.time, self.temperature
        self.simulation.collide(int(collisions * self.n / 2))
        return (self.temperature**-0.5 - was**-0.5) / (self.simulation.time - before) / self.density

    @property
    def temperature(self):
        return self.simulation.temperature

    def spins(self):
        return self.half * self.simulation.grains.spin

    def plant(self, spin, count, seed):
        """Gives the first grains this spin, over sqrt(T), in random directions."""
        direction = np.random.default_rng(seed).normal(size=(count, 3))
        direction *= spin * np.sqrt(self.temperature) / np.linalg.norm(direction, axis=1)[:, None]
        spins = self.spins()
        spins[:count] = direction
        self.simulation.set_grains(spins=spins / self.half)


def follow(gas, spin, count, seed, collisions=40):
    """Plants grains; rows of collisions a grain, T, mean spin and own temperature of the planted grains (the fastest),
    and the integrals of T and of (T + T_own)/2 over n chi dt."""
    gas.plant(spin, count, seed)
    rows, times = [], []
    for k in range(2 * collisions + 1):
        if k:
            gas.advance(0.5)
        grains, T = gas.simulation.grains, gas.temperature
        s = gas.half * np.linalg.norm(grains.spin, axis=1)
        fastest = np.argsort(s)[-count:]
        own = (grains.velocity[fastest]**2).sum() / (3 * count)
        rows.append((k / 2, T, s[fastest].mean(), own))
        times.append(gas.simulation.time)
    rows, times = np.array(rows), np.array(times)
    steps = gas.density * np.diff(times)
    T, mean = rows[:, 1], (rows[:, 1] + rows[:, 3]) / 2

    def integral(f):
        return np.concatenate([[0], np.cumsum(steps * np.sqrt(f[1:] * f[:-1]))])

    return np.column_stack([rows, integral(T), integral(mean)])


def planted():
    print("engine  phi   e    mu   seeds  loss/formula        loss/formula at T    T_own/T             growth/(zeta/2)")
    for engine, grains, count, phi, e, mu in (("dsmc", 100000, 200, 0, 0.9, 0.5), ("dsmc", 100000, 200, 0, 0.9, 0.2),
                                              ("dsmc", 100000, 200, 0.1, 0.7, 0.5), ("dsmc", 100000, 1000, 0.05, 0.9, 0.5),
                                              ("md", 4000, 40, 0.05, 0.9, 0.5), ("md", 4000, 40, 0.01, 0.9, 0.5),
                                              ("md", 4000, 40, 0.02, 0.8, 0.3)):
        found = []
        for seed in range(1, 25 if (phi, e) in ((0.05, 0.9), (0.01, 0.9)) else 9):
            gas = Gas(engine, grains, phi, e, 0, mu, seed)
            gas.advance(20)
            c = np.pi**2 * gas.mu_kick
            path = follow(gas, 5 * c / gas.advance(5), count, seed)
            late = path[-20:]
            lost = path[0, 2] - path[-1, 2]
            growth = np.log(late[-1, 2] / late[0, 2]) / np.log(late[0, 1] / late[-1, 1]) * 2 + 1
            found.append((lost / (c * path[-1, 5]), lost / (c * path[-1, 4]), late[:, 3].mean() / late[:, 1].mean(), growth))
        mean, error = np.mean(found, axis=0), np.std(found, axis=0, ddof=1) / np.sqrt(len(found))
        print(f"{engine:6} {phi:5} {e:4} {mu:5} {len(found):5}  " + "  ".join(f"{m:8.4f} +- {d:.4f}" for m, d in zip(mean, error)),
              flush=True)


CASES = ((0.7, 0, 0.5, 2e5), (0.75, 0, 0.5, 4e5), (0.8, 0, 0.5, 1e6), (0.8, 0.5, 0.5, 2e6), (0.85, 0.3, 0.4, 2e6),
         (0.9, 0, 0.5, 6e6), (0.9, 0, 0.3, 2e6), (0.9, 0, 0.2, 5e5), (0.95, 0, 0.1, 1e6), (0.7, 0, 1, 6e6), (0.6, 0, 0.8, 1e6))


def count(e, beta, mu, grains, collisions=160):
    """Rows of collisions a grain, grains beyond 2, 4 and 8 s* at T_own = T, theta/T of those below s*, zeta*."""
    gas = Gas("dsmc", int(grains), 0, e, beta, mu)
    rows = []
    for done in range(10, collisions + 1, 10):
        x = gas.advance(10)
        star, T = np.pi**2 * gas.mu_kick / x, gas.temperature
        s2 = (gas.spins()**2).sum(axis=1) / T
        rows.append([done] + [(s2 > (f * star)**2).sum() for f in (2, 4, 8)] + [K * s2[s2 < star**2].mean() / 3, 2 * x / NU0])
    return np.array(rows), star


def counts():
    print("e     beta  mu    zeta*   theta/T  s*/thermal  escapes  per collision         program   tail/(rate/x)")
    for e, beta, mu, grains in CASES:
        rows, star = count(e, beta, mu, grains)
        half = rows[len(rows) // 2:]
        escapes, span, zeta = half[-1, 2] - half[0, 2], half[-1, 0] - half[0, 0], half[:, 5].mean()
        rate = escapes / span / grains
        tail = (half[-1, 2] - half[-1, 3]) / grains / np.log(2)  # grains per ln s between 4 and 8 s*
        short = scene("dsmc", 100, 0, e, beta, mu)
        short["run.collisions"] = 20
        program = graingas.run(short).info.escape_rate
        print(f"{e:4}  {beta:4}  {mu:4}  {zeta:.4f}  {half[:, 4].mean():.4f}  {star / np.sqrt(half[:, 4].mean() / K):8.1f}  "
              f"{escapes:9.0f}    {rate:.3g} +- {np.sqrt(max(escapes, 1)) / span / grains:.1g}  {program:9.3g}    "
              f"{tail / (rate / (0.4 * zeta)):.2f}", flush=True)


def draw_planted(axes):
    """Single grains in md: spins over the thermal spin from 10 to 60, below and above the threshold."""
    e, mu, theta, spins = 0.9, 0.5, 0.5256, np.array([10, 15, 20, 25, 30, 40, 60])
    gas = Gas("md", 4000, 0.05, e, 0, mu, 3)
    gas.advance(20)
    c, x, thermal = np.pi**2 * gas.mu_kick, gas.advance(5), np.sqrt(theta / K)
    planted = np.random.default_rng(5).normal(size=(len(spins), 3))
    planted *= (spins * thermal * np.sqrt(gas.temperature) / np.linalg.norm(planted, axis=1))[:, None]
    s = gas.spins()
    s[:len(spins)] = planted
    gas.simulation.set_grains(spins=s / gas.half)
    path = [spins]
    for _ in range(80):
        gas.advance(0.5)
        path.append(np.linalg.norm(gas.spins()[:len(spins)], axis=1) / np.sqrt(gas.temperature) / thermal)
    t = np.arange(81) / 2
    axes.semilogy(t, np.array(path), color="C0", lw=1)
    hot = c / x * 1.5 / thermal
    axes.axhline(hot, color="0.5", ls="--", lw=1)
    axes.semilogy(t, hot + (60 - hot) * np.exp(x / (4 * np.sqrt(np.pi)) * t), color="C3", ls=":", lw=1.5)
    axes.set(xlabel="collisions a grain", ylabel="spin / thermal spin", ylim=(0.3, 2000), title="planted grains, md, e = 0.9", xlim=(0, 40))
    axes.text(37, hot * 0.62, "$s^*$", fontsize=8)


def draw_tail(axes):
    """Grains per ln s in dsmc at e = 0.7 after 20, 40 and 80 collisions a grain, and the plateau rate/x."""
    gas = Gas("dsmc", 2000000, 0, 0.7, 0, 0.5)
    edges = np.geomspace(0.1, 3000, 90)
    middle = np.sqrt(edges[1:] * edges[:-1])
    for k, more in enumerate((20, 20, 40)):
        x = gas.advance(more)
        s = np.linalg.norm(gas.spins(), axis=1) / np.sqrt(gas.temperature)
        thermal = np.sqrt((s[s < 5 * np.median(s)]**2).mean() / 3)
        n = np.histogram(s / thermal, edges)[0] / len(s) / np.diff(np.log(edges))
        axes.loglog(middle[n > 0], n[n > 0], color=f"C{k}", lw=1.2, label=f"{(20, 40, 80)[k]} collisions")
    axes.loglog(middle, np.sqrt(2 / np.pi) * middle**3 * np.exp(-middle**2 / 2), color="0.6", lw=1, label="Maxwellian")
    axes.axhline(2.24e-4 / (x / (4 * np.sqrt(np.pi))), color="C3", ls=":", lw=1.5)
    axes.set(xlabel="spin / thermal spin", ylabel="grains per ln s", ylim=(1e-6, 2), title="all grains, dsmc, e = 0.7")
    axes.legend(frameon=False, fontsize=7)


def picture(path):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot
    pyplot.rcParams.update({"font.size": 8, "axes.titlesize": 8})
    figure, axes = pyplot.subplots(1, 2, figsize=(6.4, 2.8), dpi=150, layout="constrained")
    draw_planted(axes[0])
    draw_tail(axes[1])
    figure.savefig(path)


if __name__ == "__main__":
    {"planted": planted, "counts": counts, "picture": picture}[sys.argv[1]](*sys.argv[2:])
