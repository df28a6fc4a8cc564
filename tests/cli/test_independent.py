# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers that leave the program, held against a second computation. Grains and collisions of every replica are stored
by tests/cli/stored_events.c; what JSON, HDF5, CSV, XYZ and the C interface say of them is computed here from the
definitions in docs/reference, with numpy and without any of the program's model. A new flow is a row of FLOWS."""
import csv
import json
import os
import subprocess
import sys

from tap import PATIENCE, Skip, check, main, run

try:
    import h5py
    import numpy as np
except ImportError as missing:
    h5py = np = missing
else:
    np.seterr(divide="ignore", invalid="ignore")  # the first sample has no one before; a grain may not have spun yet

N, WARMUP, COLLISIONS, REPLICAS, SINGLE = 80, 40, 240, 3, 1200
SPECIES = [{"fraction": 0.6, "diameter": 2, "mass": 3, "inertia": 0.4},
           {"fraction": 0.4, "diameter": 3, "mass": 5, "inertia": 0.6}]
COLLISION = {"smooth": {"e": [0.95, 0.7, 0.85]},
             "rough": {"e": [0.9, 0.75, 0.8], "beta": [0.2, -0.4, 0.7]},
             "frictional": {"e": [0.95, 0.8, 0.9], "beta": [0.3, 0.8, -0.2], "mu": [0.1, 0.6, 0.25]}}
SHEAR = {"temperature": "d^2 gamma^2", "pressure": "rho_p d^2 gamma^2", "collision_rate": "gamma", "spin_z": "gamma",
         "dissipation": "rho_p d^2 gamma^3", "velocity": "d gamma", "spin": "gamma", "time": "1/gamma"}
REST = {"temperature": "v_0^2", "pressure": "rho_p v_0^2", "collision_rate": "v_0/d", "spin_z": "v_0/d",
        "dissipation": "rho_p v_0^3/d", "wall_heat_flux": "rho_p v_0^3", "velocity": "v_0", "spin": "v_0/d", "time": "d/v_0"}
# Settings by flow: keys of the scene, units, observables with curves, and the mirror image with which profiles are
# averaged (factors of u_x and omega_z; None: not averaged). Accelerations are in the scene's units.
FLOWS = {
    "usf": {"keys": {"shear_rate": 2}, "units": SHEAR, "measure": ["velocity_distributions"]},
    "hcs": {"keys": {}, "units": REST, "measure": ["velocity_distributions"]},
    "couette": {"keys": {"walls": {"e": 0.9, "beta": 0.5, "mu": 0.7, "speed": 4}}, "units": SHEAR,
                "measure": ["profiles"], "image": (-1, 1)},
    "poiseuille": {"keys": {"walls": {"e": 0.9, "beta": 0.5}, "gravity": [0.1, 0, 0]}, "units": REST,
                   "measure": ["profiles"], "image": (1, -1)},
    "fourier": {"keys": {"walls": {"e": 0.9, "beta": 0.5, "temperature": [1, 0.5], "accommodation": 0.8}}, "units": REST,
                "measure": ["profiles", "fluxes"], "image": None},
}
if not isinstance(h5py, ImportError):
    d, m, K = np.array([1, 1.5]), np.array([1, 5 / 3]), np.array([0.4, 0.6])  # in units of species 1
PHI, STRESS = 0.2, 3.141592653589793 / 6  # rho_p = 6 m/(pi d^3)


def by_pair(values):
    return dict(zip(("11", "12", "22"), values))


# Frames other than the imposed flow: cells, two along each edge, or two slabs.
FRAMES = {("usf", "smooth"): ["cells", "slabs"], ("usf", "rough"): ["cells", "cells_laboratory", "slabs_laboratory"],
          ("hcs", "frictional"): ["cells"]}


def scene_of(flow, kind, frame="imposed"):
    collision = {k: by_pair(v) for k, v in COLLISION[kind].items()}
    measure = ["rheology", "collisions"] + FLOWS[flow]["measure"] + (["orientation"] if kind != "smooth" else [])
    cells = {} if frame == "imposed" else {"frame": frame, "frame_cells": 2}
    if cells and flow == "usf":  # sums over a cooling gas weigh samples by the engine's present scale
        measure += ["velocity_correlations", "local_distributions"]
    return dict(FLOWS[flow]["keys"], **cells, flow=flow, phi=PHI, particles=N, species=SPECIES, collision=collision, measure=measure,
                run={"warmup": WARMUP, "collisions": COLLISIONS}, output={"trajectory_every": 1e-9},
                md={"contact_time": 1e-9})  # hardly a collision without its e


class Store:
    """Grains at every sample and all collisions of every replica, as stored_events wrote them."""

    def __init__(self, spins):
        samples = np.fromfile("samples.bin").reshape(-1, 14 + (6 if spins else 3) * N)
        self.replica = samples[:, 0].astype(int)
        self.time, self.elapsed, self.collisions = samples[:, 1], samples[:, 2], samples[:, 3]
        order = np.argsort(self.replica, kind="stable")  # simulations follow one by one
        grains, sums = np.empty((len(samples), 4 + 10 * N)), np.empty((len(samples), 20))
        grains[order] = np.fromfile("grains.bin").reshape(-1, 4 + 10 * N)
        sums[order] = np.fromfile("sums.bin").reshape(-1, 20)
        species = grains[:, -N:].astype(int)
        self.state, self.sums = grains[:, :4], sums
        self.order = np.argsort(species, axis=1, kind="stable")  # species 1 first: which grain is of which is drawn
        self.species = np.take_along_axis(species, self.order, 1)[0]

        def vectors(rows, k):
            return np.take_along_axis(rows[:, 3 * k * N:3 * (k + 1) * N].reshape(-1, N, 3), self.order[..., None], 1)

        self.position, self.velocity, self.spin = (vectors(grains[:, 4:], k) for k in range(3))
        self.shown = {"dissipation": samples[:, 4], "stress": samples[:, 5:14].reshape(-1, 3, 3),
                      "velocity": vectors(samples[:, 14:], 0), "spin": vectors(samples[:, 14:], 1) if spins else None}
        self.index = np.zeros(len(samples), int)
        for r in set(self.replica):
            self.index[self.replica == r] = np.arange((self.replica == r).sum())
        e = np.fromfile("events.bin").reshape(-1, 14)
        place = {pair: row for row, pair in enumerate(zip(self.replica, self.index))}
        self.event_row = np.array([place[int(r), int(i)] for r, i in e[:, :2]])
        self.pair = np.take_along_axis(species[self.event_row], e[:, 3:5].astype(int), 1)
        self.k, self.c12, self.J = e[:, 5:8], e[:, 8:11], e[:, 11:14]
        self.event_time, self.grains = e[:, 2], e[:, 3:5].astype(int)
        self.end = len(samples)  # samples of a replica that count


def window_of(store, replicas):
    return (store.replica < replicas) & (store.index >= WARMUP // 2) & (store.index < store.end)


def per_row(store, values):
    """Sums over the events of each sample."""
    flat = values.reshape(len(values), -1)
    out = np.zeros((len(store.time), flat.shape[1]))
    np.add.at(out, store.event_row, flat)
    return out.reshape((-1,) + values.shape[1:])


def losses(store, kind):
    """Energy that each collision destroys; NaN where it slid, for its tangential velocity is in no impulse."""
    Jn, gn = (store.J * store.k).sum(1), (store.c12 * store.k).sum(1)
    Jt = store.J - Jn[:, None] * store.k
    number = store.pair.sum(1)
    lost = Jn * gn - Jn * Jn * (1 / m[store.pair]).sum(1) / 2
    if kind == "smooth":
        return lost
    beta = np.array(COLLISION[kind]["beta"])[number]
    mu = np.array(COLLISION[kind].get("mu", [np.inf] * 3))[number]
    tangential = ((1 + 1 / K[store.pair]) / m[store.pair]).sum(1)
    lost += (Jt * Jt).sum(1) * tangential * (1 - beta) / (1 + beta) / 2
    return np.where(np.linalg.norm(Jt, axis=1) < mu * Jn * (1 - 1e-9), lost, np.nan)


class Followed:
    """Grains of a periodic flow from sample to sample and collision to collision: peculiar velocities (in flight C_x
    falls by C_y), heights from the middle, spins, and times since the collision before, of both grains as they meet."""

    def __init__(self, store, flow):
        sheared, edge = flow == "usf", box_of(store, flow)[1]
        n = len(store.J)
        self.c, self.spin, self.height = np.full((n, 2, 3), np.nan), np.full((n, 2, 3), np.nan), np.full((n, 2), np.nan)
        self.since = np.full((n, 2), np.inf)
        pushed = store.J[:, None] * np.array([-1, 1])[:, None] / m[store.pair][..., None]
        turned = self.turned(store)
        rows = {of: row for row, of in enumerate(zip(store.replica, store.index))}
        row, last = -1, {}
        for i in range(n):
            if store.event_row[i] != row:
                row = store.event_row[i]
                replica = store.replica[row]
                before = rows.get((replica, store.index[row] - 1))
                if before is not None:
                    place = np.argsort(store.order[before])
                    c, y, w = (x[before][place] for x in (store.velocity, store.position[..., 1], store.spin))
                    at = [store.state[before, 0]] * N
            now = store.event_time[i]
            for k, g in enumerate(store.grains[i]):
                self.since[i, k] = now - last.get((replica, g), -np.inf)
                last[replica, g] = now
                if before is None:  # the first sample: nobody knows where they came from
                    continue
                t, at[g] = now - at[g], now
                if sheared:
                    c[g, 0] -= c[g, 1] * t
                y[g] = (y[g] + c[g, 1] * t) % edge
                self.c[i, k], self.height[i, k], self.spin[i, k] = c[g], y[g] - edge / 2, w[g]
                c[g] += pushed[i, k]
                w[g] -= turned[i, k]

    @staticmethod
    def turned(store):
        """Angular momentum that a collision takes from both spins."""
        return np.cross(store.k, store.J)[:, None] * ((d / 2) / (K * m * d * d / 4))[store.pair][..., None]

    def losses(self, store):
        """Energy that the relative motion and both spins lose."""
        over_m = (1 / m[store.pair]).sum(1)
        lost = (store.c12 * store.J).sum(1) - (store.J ** 2).sum(1) * over_m / 2
        turned, inertia = self.turned(store), (K * m * d * d / 4)[store.pair]
        return lost + (inertia * (self.spin * turned - turned ** 2 / 2).sum(2)).sum(1)


def energy_growth(store):
    """Growth of the energy from each sample to the next, with spins and flow."""
    inertia = (K * m * d * d / 4)[store.species]
    E = ((m[store.species] * (store.velocity ** 2).sum(2) + inertia * (store.spin ** 2).sum(2)) / 2).sum(1)
    grown = np.full(len(E), np.nan)
    for r in set(store.replica):
        rows = np.where(store.replica == r)[0]
        grown[rows[1:]] = np.diff(E[rows])
    return grown


def work_between_walls(store, flow):
    """Work of moving walls (gamma is their velocity over half the gap) and of gravity, by the trapezoidal rule."""
    if flow == "couette":
        force = store.sums[:, 12:18].reshape(-1, 2, 3)[:, :, 0]  # lower, upper
        return box_of(store, flow)[1] / 2 * (force[:, 0] - force[:, 1])
    if flow == "fourier":
        return np.zeros(len(store.sums))
    p = (m[store.species] * store.velocity[..., 0]).sum(1)
    work = np.full(len(p), np.nan)
    for r in set(store.replica):
        rows = np.where(store.replica == r)[0]
        work[rows[1:]] = 0.05 * store.elapsed[rows[1:]] * (p[rows[1:]] + p[rows[:-1]]) / 2
    return work


def images(flow):
    """Factors of the components of velocity and spin in the image that the flow is folded with; None: not folded."""
    image = FLOWS[flow]["image"]
    return image and (([-1, -1, 1], [-1, -1, 1]) if image == (-1, 1) else ([1, -1, 1], [-1, 1, -1]))


def about_flow(store, window, flow):
    """Velocities and spins about straight lines in slabs of a diameter, which all samples of a replica's window have, and
    their images where the flow is folded."""
    height = store.position[..., 1].max() + 0.5  # of species 1, the smallest, at the wall
    slabs = max(int(min(height, N / 10)), 1)
    C, W = np.zeros_like(store.velocity), np.zeros_like(store.spin)
    for r in set(store.replica[window]):
        rows = window & (store.replica == r)
        y = store.position[rows][..., 1]
        slab = np.minimum((y / height * slabs).astype(int), slabs - 1)
        for field, to, image in zip((store.velocity[rows], store.spin[rows]), (C, W), images(flow) or (None, None)):
            left = np.zeros_like(field)
            for s in range(slabs):
                here, there = slab == s, slab == slabs - 1 - s
                h, v = y[here], field[here]
                if image:
                    h, v = np.concatenate([h, height - y[there]]), np.concatenate([v, field[there] * image])
                at, slope = straight(v, h, np.ones_like(h))
                left[here] = (field[here] - at - np.outer(y[here], slope)) * (len(h) / (len(h) - 2)) ** 0.5
            to[rows] = left
    return C, W


def about_cells(store, flow, frame):
    """Velocities about the mean of their cell, or slab across y, weighted by mass; spins about that, weighted by moment of
    inertia, plus the same mean of the box. In `cells` and `slabs` what a mean takes out of variances is put back."""
    laboratory, steps = frame.endswith("_laboratory"), [0, 1, 0] if frame.startswith("slabs") else [1, 2, 4]
    inertia, mass = (K * m * d * d / 4)[store.species], m[store.species]
    box = np.array(box_of(store, flow))
    C, W = np.zeros_like(store.velocity), np.zeros_like(store.spin)
    for t in range(len(store.time)):
        v, w = store.velocity[t].copy(), store.spin[t]
        if laboratory and flow == "usf":
            v[:, 0] += store.position[t][:, 1] - box[1] / 2
        place = np.clip(np.floor(2 * store.position[t] / box), 0, 1).astype(int) @ steps
        alone = np.bincount(place, minlength=8)[place] == 1
        for k in range(8):
            here = place == k
            for field, weight, to in (v, mass, C), (w, inertia, W):
                g = weight[here]
                left = field[here] - (g @ field[here]) / g.sum() if here.any() else field[here]
                share = 1 - g / g.sum()
                if not laboratory:
                    left *= np.where(share > 0, (N - 1) / (N - alone.sum()) / np.where(share > 0, share, 1), 0)[:, None] ** 0.5
                to[t, here] = left
        W[t] += inertia @ w / inertia.sum()
    return C, W


def long_waves(store, flow):
    """Intensities of long waves at every sample: of the solid fraction, over those of elastic spheres (Carnahan &
    Starling), and of momentum across the wave. Each value is that of the last sample with a number divisible by ten."""
    matter, momentum = np.zeros(len(store.time)), np.zeros(len(store.time))
    volume = d[store.species] ** 3
    p = m[store.species][:, None] * store.velocity
    structure = (1 - PHI) ** 4 / ((1 + 2 * PHI) ** 2 + PHI ** 3 * (PHI - 4))
    for axis in range(3):
        for wave in 1, 2:
            place = 16 * store.position[..., axis] / box_of(store, flow)[axis]
            left, step = np.exp(2j * np.pi * wave * np.floor(place) / 16), np.exp(2j * np.pi * wave / 16)
            phase = left * (1 + place % 1 * (step - 1)) / np.sinc(wave / 16) ** 2  # on straight lines between 16 points
            matter += np.abs((volume * phase).sum(1)) ** 2 / (6 * structure * (volume ** 2).sum())
            for across in {0, 1, 2} - {axis}:
                momentum += np.abs((p[..., across] * phase).sum(1)) ** 2 / (12 * (p[..., across] ** 2).sum(1))
    held = np.zeros(len(matter), int)
    for r in set(store.replica):
        rows = np.where(store.replica == r)[0]
        held[rows] = rows[np.maximum(np.arange(len(rows)) - np.arange(1, len(rows) + 1) % 10, 0)]  # the first has no row
    return matter[held], momentum[held]


def expected(store, flow, kind, replicas, C, W, followed):
    """Means over window and replicas, from grains and collisions alone; ratios are ratios of means."""
    window = window_of(store, replicas)
    walled, cooling, rough = "image" in FLOWS[flow], flow == "hcs", kind != "smooth"
    who = [store.species == i for i in range(2)]
    x = np.array([w.mean() for w in who])
    V = sum(STRESS * d[i] ** 3 * who[i].sum() for i in range(2)) / PHI
    n = N / V
    omega = W.copy()
    for w in who:
        omega[:, w] -= W[:, w].mean(1, keepdims=True)
    T = (m[store.species][:, None] * C * C).sum((1, 2)) / (3 * N)
    before = np.zeros_like(T)
    for r in set(store.replica):
        rows = np.where(store.replica == r)[0]
        before[rows[1:]] = T[rows[:-1]]
    dt = store.elapsed
    a, b = before ** -0.5, T ** -0.5  # Haff: T^(-1/2) grows evenly over an interval
    growth = (b - a) / dt
    root, first = (np.log(b / a) / growth, (1 / a - 1 / b) / growth) if cooling else (dt, dt)
    unit = T if cooling else np.ones_like(T)

    def mean(values):
        return values[window].mean(0)

    def species_mean(values, power, weight=(1, 1)):
        scaled = values / unit.reshape((-1,) + (1,) * (values.ndim - 1)) ** (power / 2)
        return sum(x[i] * weight[i] * mean(scaled[:, who[i]].mean(1)) for i in range(2))

    rate = mean(2 * per_row(store, np.ones((len(store.J), 1)))[:, 0] / (N * root))
    sigma = d[store.pair].mean(1)
    collisional = per_row(store, sigma[:, None, None] * store.k[:, :, None] * store.J[:, None, :])
    collisional = mean(collisional / (V * first)[:, None, None]) * STRESS
    kinetic = species_mean(C[..., :, None] * C[..., None, :], 2, m) * n * STRESS
    P = kinetic + collisional
    p = np.trace(P) / 3
    partial = [m[i] * mean((C * C)[:, who[i]].sum(2).mean(1) / unit) / 3 for i in range(2)]
    out = {"temperature": x @ partial, "pressure": p, "N1": (P[0, 0] - P[1, 1]) / p, "N2": (P[1, 1] - P[2, 2]) / p,
           "collision_rate": rate, "partial_temperature_ratio": partial[0] / partial[1], "temperature_1": partial[0],
           "temperature_2": partial[1], "compressibility_factor": p / (n * STRESS * (x @ partial))}
    out["mean_free_path"] = species_mean(np.linalg.norm(C, axis=2), 1) / rate
    out["knudsen"] = out["mean_free_path"] / V ** (1 / 3)
    for a_, b_ in "xx", "yy", "zz", "xy", "yx":
        i, j = "xyz".index(a_), "xyz".index(b_)
        out[f"P_{a_}{b_}"], out[f"P_{a_}{b_}_collisional"], out[f"P_{a_}{b_}_kinetic"] = P[i, j], collisional[i, j], kinetic[i, j]
    if flow == "usf":
        out["shear_viscosity"] = abs(P[0, 1])
    for i in range(3):
        out["kurtosis_C" + "xyz"[i]] = species_mean(C[..., i] ** 4, 4) / species_mean(C[..., i] ** 2, 2) ** 2
    if flow != "usf":
        shares = (T / unit)[window]
        for i in range(2):
            c4 = mean(((C * C).sum(2) ** 2)[:, who[i]].mean(1) / unit ** 2) / (15 * (partial[i] / m[i]) ** 2)
            fluctuation = (shares ** 2).mean() / shares.mean() ** 2
            out[f"c_{i + 1}"] = 2 * (c4 / fluctuation * (3 * N - 1) / (3 * N - 3) - 1)
    if not walled:
        out["density_waves"], out["momentum_waves"] = map(mean, long_waves(store, flow))
    if rough:
        inertia = K * m * d * d / 4
        whole = [(1 - 1 / N) / (1 - 1 / w.sum()) for w in who]  # means of spins are those of a species
        theta = species_mean((omega * omega).sum(2), 2, inertia * whole) / 3
        out["rotational_temperature"], out["temperature_ratio"] = theta, theta / out["temperature"]
        for i in range(3):
            out["kurtosis_W" + "xyz"[i]] = species_mean(omega[..., i] ** 4, 4) / species_mean(omega[..., i] ** 2, 2) ** 2
        out["skewness_Wz"] = species_mean(omega[..., 2] ** 3, 3) / species_mean(omega[..., 2] ** 2, 2) ** 1.5
        cosine = (C * omega).sum(2) ** 2 / ((C * C).sum(2) * (omega * omega).sum(2))
        out["cos2_psi"] = mean(cosine.mean(1))
        CC, WW, CW = (C * C).sum(2), (omega * omega).sum(2), (C * omega).sum(2)
        for name, product, apart in ("a11", CC * WW, 1), ("b", CW * CW, 1 / 3):
            at_once = sum(w.sum() / N * product[:, w].mean(1) / (CC[:, w].mean(1) * WW[:, w].mean(1)) for w in who)
            out[name] = mean(at_once) - apart
        if not walled:
            out["spin_z"] = species_mean(W[..., 2], 1)
    growth_rate = mean(energy_growth(store) / (V * dt)) * STRESS
    lost = losses(store, kind)
    if not walled:
        lost = np.where(np.isnan(lost), followed.losses(store), lost)
    lost = per_row(store, lost[:, None])[:, 0]
    if kind != "frictional" or not walled:
        out["dissipation"] = mean(lost / (V * dt)) * STRESS
    if walled:
        force = store.sums[:, 12:18].reshape(-1, 2, 3)  # on the lower and the upper wall
        drag = force[:, 0, 0] + (-1 if flow == "couette" else 1) * force[:, 1, 0]
        heat = store.sums[:, 18:]  # that the lower and the upper wall took
        out["wall_dissipation"] = mean(heat.sum(1) / (V * dt)) * STRESS
        if flow == "fourier":
            drag = -drag
            out["wall_heat_flux"] = mean((heat[:, 1] - heat[:, 0]) / (2 * V ** (2 / 3) * dt)) * STRESS
        out["wall_friction"] = mean(drag / dt) / mean((force[:, 1, 1] - force[:, 0, 1]) / dt)
        out["energy"] = mean(work_between_walls(store, flow) / (V * dt)) * STRESS - growth_rate
    elif flow == "usf":
        work = collisional + species_mean(store.velocity[..., :, None] * store.velocity[..., None, :], 2, m) * n * STRESS
        out["energy_balance"] = (-work[1, 0] - growth_rate) / out["dissipation"]
    if cooling:  # nu_0 of two species: sqrt(pi) n sigma_12^2 v_0, v_0^2 = 2T(m_1 + m_2)/(m_1 m_2)
        out["cooling_rate"] = mean(2 * growth) / (STRESS * 6 / np.pi * np.pi ** 0.5 * n * d.mean() ** 2 * (2 / m).sum() ** 0.5)
    return out


# Tolerances: sums in another order; roots of speeds in single precision; angles about the sample before's mean spin.
NOT_COOLING = ("temperature", "pressure", "temperature_1", "temperature_2", "rotational_temperature", "dissipation", "spin_z",
               "collision_rate", "compressibility_factor")
LOOSE = {"mean_free_path": 1e-6, "knudsen": 1e-6, "cos2_psi": 2e-2}


def close(found, right, *what, within=1e-9, least=1e-9):
    found, right = np.asarray(found, float), np.asarray(right, float)
    check(found.shape == right.shape, *what, found.shape, right.shape)
    check((np.isnan(found) == np.isnan(right)).all(), *what, found, right)
    bad = np.abs(found - right) > within * np.abs(right) + least
    check(not bad.any(), *what, found[bad][:3], right[bad][:3])


def hold_numbers(results, right, flow, where):
    """Between walls velocities are about a flow that is known better and better over the window; here about that of the
    whole window: within 1 % and a third of an error, higher moments and angles within four errors."""
    walled = "image" in FLOWS[flow]
    if walled:  # what grains and walls lose is what goes in and does not stay: exact, but for the rule of gravity's work
        lost, taken = results["dissipation"]["mean"], right["wall_dissipation"]
        energy, balance = right.pop("energy"), results["energy_balance"]["mean"]
        close(balance, (energy - taken) / lost if flow == "fourier" else energy / (lost + taken), where, "energy_balance")
        close(balance, 1, where, "energy_balance", within=1e-9 if flow != "poiseuille" else 0.02)
        check(results["energy_balance"]["stderr"] < (1e-9 if flow != "poiseuille" else 0.02), where, results["energy_balance"])
        right["energy_balance"] = balance
    for name, value in right.items():
        r = results[name]
        if r["mean"] is None:
            check(flow == "hcs" and value != value or name in NOT_COOLING or name.startswith("P_"), where, name, r)
        elif not walled or name.startswith("wall_") or name in ("collision_rate", "dissipation", "energy_balance") or name.endswith("_collisional"):
            close(r["mean"], value, where, name, within=LOOSE.get(name, 1e-9))
        else:
            within = 4 * r["stderr"] if name.startswith(("kurt", "skew", "cos2", "c_", "a11", "b")) else 0.01 * abs(value) + 0.3 * r["stderr"]
            check(abs(r["mean"] - value) < within, where, name, r["mean"], r["stderr"], value)
    missing = [q for q, r in results.items() if r["mean"] is not None and q not in right and q != "recorded"]
    slid = ["dissipation"] if walled and "mu" in COLLISION[where.split()[1]] else []
    check(missing in ([], slid), where, "is held by nothing:", missing)


def hold_units(results, flow):
    units = FLOWS[flow]["units"]
    for name, r in results.items():
        kind = "pressure" if name.startswith("P_") else "temperature" if "temperature" in name and "ratio" not in name else name
        if kind in units:
            check(r["unit"] == units[kind], flow, name, r["unit"])


# ---- Curves


def histogram(values, bins, low, high):
    count = np.histogram(values, bins, (low, high))[0]
    return count * bins / (count.sum() * (high - low))


def hold_flights(store, flow, curves, replicas, followed):
    """Free flights of a species that end after twelve collisions per grain of the window."""
    inside = window_of(store, replicas)[store.event_row]
    nodes, weights = np.polynomial.legendre.leggauss(12)
    for s in range(2):
        ends = inside[:, None] & (store.pair == s)
        for r in range(replicas):
            of = ends & (store.replica[store.event_row] == r)[:, None]
            ends &= ~(of & (of.cumsum().reshape(of.shape) <= 12 * (store.species == s).sum()))
        t, c, y = followed.since[ends], followed.c[ends], followed.height[ends]
        check(np.isfinite(t).all() and len(t) > 1000, flow, s, len(t))
        back = c[:, None] + (nodes[:, None] * 0.5 + 0.5) * (t[:, None, None] * np.outer(c[:, 1], [flow == "usf", 0, 0])[:, None])
        numbers = {"free_path": ("mean_free_path", (weights / 2 * np.linalg.norm(back, axis=2)).sum(1) * t)}
        if flow == "usf":
            numbers["free_time"] = "mean_free_time", t
            numbers["free_path_laboratory"] = "mean_free_path_laboratory", t * np.linalg.norm(c + np.outer(y, [1, 0, 0]), axis=1)
        for curve, (name, x) in numbers.items():
            found = curves[f"{curve}_{s + 1}"]["numbers"]
            close(found[name]["mean"], x.mean(), flow, name, s, within=1e-5)
            close(found["second_moment_over_mean_squared"]["mean"], (x * x).mean() / x.mean() ** 2, flow, name, s, within=1e-5)


def hold_collisions(store, flow, curves, rows):
    rows = rows[store.event_row]
    k, c12 = store.k[rows], store.c12[rows]
    cosine = (k * c12).sum(1) / np.linalg.norm(c12, axis=1)
    close(curves["impact_cos"]["value"], histogram(np.clip(cosine, 0, 1), 50, 0, 1), flow, "impact_cos")
    angle = np.arctan2(k[:, 1], k[:, 0]) / np.pi % 1
    close(curves["collision_angle"]["value"], histogram(angle, 72, 0, 1), flow, "collision_angle")
    for name, (i, j) in {"xx": (0, 0), "yy": (1, 1), "zz": (2, 2), "xy": (0, 1)}.items():
        close(curves["collision_angle"]["numbers"]["fabric_" + name]["mean"], (k[:, i] * k[:, j]).mean(), flow, name)


def hold_distributions(store, flow, curves, rows, C, W):
    for i in range(2):
        who = store.species == i
        for letter, field in ("C", C), ("W", W):
            for a in range(3):
                curve = curves.get(f"velocity_distribution_{letter}{'xyz'[a]}_{i + 1}")
                if letter == "W" and not store.spin.any():
                    check(curve is None)
                    continue
                v = field[rows][:, who, a]
                x = (v - v.mean(1, keepdims=True)) / v.std(1, keepdims=True)
                count = np.histogram(x, 160 + 1, (-8.05, 8.05))[0]
                value = np.array([0 if y is None else y for y in curve["value"]])
                middle = count[int(round((curve["x"][0] + 8.05) * 10 - 0.5)):][:len(value)]
                close(value / value.sum(), middle / middle.sum(), flow, letter, a, i)


def hold_orientation(store, flow, kind, curves, rows):
    C, W = store.velocity[rows], store.spin[rows].copy()
    if "image" in FLOWS[flow] or flow == "usf":
        middle = store.position[rows][..., 1] - box_of(store, flow)[1] / 2
        C = C + (middle[..., None] * [1, 0, 0] if flow == "usf" else 0)
    cosine = (C * W).sum(2) / (np.linalg.norm(C, axis=2) * np.linalg.norm(W, axis=2))
    cosine = cosine[np.isfinite(cosine)]
    curve = curves["orientation_cos_instantaneous"]
    close(curve["value"], histogram(cosine, 50, -1, 1), flow, "orientation", least=2e-2)
    close(curve["numbers"]["Lambda"]["mean"], (cosine ** 2).mean(), flow, "Lambda", within=1e-9)


def box_of(store, flow):
    volume = sum(STRESS * d[i] ** 3 * (store.species == i).sum() for i in range(2)) / PHI
    return [volume ** (1 / 3)] * 3


def hold_profiles(store, flow, kind, curves, rows):
    """Folded: every grain and its image. Temperatures are about a straight line in each slab."""
    image = images(flow)
    height = box_of(store, flow)[1]
    slabs = len(curves["profile_velocity"]["value"])
    y = store.position[rows][..., 1].ravel() / height * slabs
    s = np.tile(store.species, rows.sum())
    c, w = store.velocity[rows].reshape(-1, 3), store.spin[rows].reshape(-1, 3)
    alike = 2 if image else 1
    if image:
        c, w = (np.concatenate([x, x * factors]) for x, factors in zip((c, w), image))
        y, s = np.concatenate([y, slabs - y]), np.concatenate([s, s])
    slab, mass, inertia = y.astype(int), m[s], (K * m * d * d / 4)[s]
    names = ["solid_fraction", "velocity", "temperature"] + ([] if kind == "smooth" else ["rotational_temperature", "spin_z"])
    right = {"profile_" + name: np.full(slabs, np.nan) for name in names}
    for k in range(slabs):
        here = slab == k
        right["profile_solid_fraction"][k] = (d[s[here]] ** 3).sum() * STRESS * slabs / (height ** 3 * alike * rows.sum())
        if not here.any():
            continue
        h = y[here] - k
        right["profile_velocity"][k] = (mass[here] @ c[here, 0]) / mass[here].sum()
        for name, weight, field in ("temperature", mass, c), ("rotational_temperature", inertia, w):
            if "profile_" + name not in right:
                continue
            g = weight[here]
            basis = np.stack([np.ones_like(h), h], 1) if len(h) > 2 else np.ones((len(h), 1))
            fit = basis @ np.linalg.lstsq(basis * g[:, None] ** 0.5, field[here] * g[:, None] ** 0.5, rcond=None)[0]
            right["profile_" + name][k] = (g[:, None] * (field[here] - fit) ** 2).sum() / (3 * len(h))
        if kind != "smooth":
            right["profile_spin_z"][k] = w[here, 2].mean()
    if kind != "smooth":
        right["profile_temperature_ratio"] = right["profile_rotational_temperature"] / right["profile_temperature"]
    for name, value in right.items():
        found = np.array([np.nan if v is None else v for v in curves[name]["value"]], float)
        close(np.where(np.isnan(found), 0, found), np.nan_to_num(value), flow, kind, name, within=1e-6, least=1e-7)
        close(curves[name]["x"], (np.arange(slabs) + 0.5) * height / slabs, name)
        unit = {"velocity": "velocity", "spin_z": "spin"}.get(name[8:], "temperature" if name.endswith("temperature") else None)
        check(curves[name]["unit"] == (FLOWS[flow]["units"][unit] if unit else "1"), name, curves[name]["unit"])


def hold_walls(store, flow, curves, replicas):
    """Momentum that the walls take up: of the intervals between the first and the last snapshot."""
    area, window = box_of(store, flow)[0] ** 2, window_of(store, replicas)
    last = max(store.index[window]) // 2 * 2
    rows = window & (store.index < last)
    force = store.sums[rows, 12:18].reshape(-1, 2, 3).sum(0) / (store.elapsed[rows].sum() * area) * STRESS
    lower, upper = -force[0], force[1]
    numbers = curves["profile_velocity"]["numbers"]
    if FLOWS[flow]["image"] == (-1, 1):
        lower = upper = (lower + upper) / 2
    elif FLOWS[flow]["image"]:
        lower, upper = ((lower + upper * [-1, 1, 1]) / 2, (upper + lower * [-1, 1, 1]) / 2)
    for wall, P in ("lower", lower), ("upper", upper):
        for i, a in enumerate("xy"):
            close(numbers[f"wall_P_y{a}_{wall}"]["mean"], P[i], flow, wall, a)


def straight(x, h, weight):
    """Weighted least-squares line at + slope h of each component: [at, slope]."""
    basis = np.stack([np.ones_like(h), h], 1) * weight[:, None] ** 0.5
    return np.linalg.lstsq(basis, x * weight[:, None] ** 0.5, rcond=None)[0]


def hold_fluxes(store, flow, kind, curves, replicas):
    """Kinetic fluxes: about a linear fit of the flow in the slab, or of the next slab if grains fill less than half of
    this one. Collisional stresses: means over the channel, from the second sample on, of components that walls do not
    transmit. Heat flux at the walls: all intervals but the last."""
    window, height = window_of(store, replicas), box_of(store, flow)[1]
    slabs = len(curves["profile_P_yy"]["value"])
    y = store.position[window][..., 1].ravel() / height * slabs
    s = np.tile(store.species, window.sum())
    c, w = store.velocity[window].reshape(-1, 3), store.spin[window].reshape(-1, 3)
    slab, mass, inertia = y.astype(int), m[s], (K * m * d * d / 4)[s]
    h = y - slab - 0.5
    line = {}
    for k in range(slabs):
        here = slab == k
        if here.any() and np.average(h[here] ** 2, weights=mass[here]) - np.average(h[here], weights=mass[here]) ** 2 > 1 / 48:
            line[k] = [straight(x[here], h[here], g[here]) for x, g in ((c, mass), (w, inertia))]
    right = {}
    for k in range(slabs):
        here = slab == k
        near = min(line, key=lambda i: (abs(i - k), i > k))
        C, W = (x[here] - (fit[0] + np.outer(h[here] + k - near, fit[1])) for x, fit in zip((c, w), line[near]))
        per = STRESS * slabs / (height ** 3 * window.sum())
        for a, b in "xx", "yy", "zz", "xy", "yx":
            right.setdefault(f"P_{a}{b}", []).append(per * (mass[here] * C[:, "xyz".index(a)] * C[:, "xyz".index(b)]).sum())
        right.setdefault("q_y", []).append(per * (mass[here] / 2 * (C * C).sum(1) * C[:, 1]).sum())
        if kind != "smooth":
            right.setdefault("q_y_rotational", []).append(per * (inertia[here] / 2 * (W * W).sum(1) * C[:, 1]).sum())
            right.setdefault("M_yz", []).append(per * (inertia[here] * W[:, 2] * C[:, 1]).sum())
    size = np.abs(right["q_y"]).max()
    for name, value in right.items():
        close(curves[f"profile_{name}_kinetic"]["value"], value, flow, kind, name, within=1e-6, least=1e-7 * size)
        total = np.add(curves[f"profile_{name}_kinetic"]["value"], curves[f"profile_{name}_collisional"]["value"])
        close(curves[f"profile_{name}"]["value"], total, flow, kind, name, within=1e-12, least=1e-12 * size)
    rows = window & (store.index > store.index[window].min())
    stress = (d[store.pair].mean(1)[:, None, None] * store.k[:, :, None] * store.J[:, None, :])[rows[store.event_row]].sum(0)
    stress *= STRESS / (height ** 3 * store.elapsed[rows].sum())
    for a, b in "xx", "zz", "xy":
        close(np.mean(curves[f"profile_P_{a}{b}_collisional"]["value"]), stress["xyz".index(a), "xyz".index(b)], flow, kind, a, b)
    rows = window & (store.index < store.index[window].max())
    heat = store.sums[rows, 18:].sum(0) / (store.elapsed[rows].sum() * height ** 2) * STRESS
    for wall, q in ("lower", -heat[0]), ("upper", heat[1]):
        close(curves["profile_q_y"]["numbers"]["wall_q_y_" + wall]["mean"], q, flow, kind, wall)
    terms = {t: np.array(curves["profile_" + t]["value"]) for t in ("heat_divergence", "stress_work", "loss", "energy_residual")}
    q = np.array(curves["profile_q_y"]["value"]) + (0 if kind == "smooth" else np.array(curves["profile_q_y_rotational"]["value"]))
    close(terms["heat_divergence"], np.diff(q) * slabs / height, flow, kind, "dq/dy", within=1e-9, least=1e-9 * size)
    close(terms["energy_residual"], terms["heat_divergence"] - terms["stress_work"] + terms["loss"], flow, kind, "residual")


def hold_peculiar_orientation(store, curves, rows, C, W):
    """About the mean spin of each species, at every instant."""
    omega = W[rows].copy()
    for i in range(2):
        omega[:, store.species == i] -= omega[:, store.species == i].mean(1, keepdims=True)
    cosine = (C[rows] * omega).sum(2) / (np.linalg.norm(C[rows], axis=2) * np.linalg.norm(omega, axis=2))
    cosine = cosine[np.isfinite(cosine)]
    close(curves["orientation_cos"]["value"], histogram(cosine, 50, -1, 1), "orientation_cos", least=2e-2)
    close(curves["orientation_cos"]["numbers"]["Lambda"]["mean"], (cosine ** 2).mean(), "Lambda")


def hold_correlations(store, flow, kind, curves, replicas, C, W):
    """All pairs of every 8th sample: in so small a box none is left out."""
    rows = window_of(store, replicas) & ((store.index - WARMUP // 2) % 8 == 0)
    L, width = box_of(store, flow)[0], 0.25
    r = store.position[rows]
    apart = r[:, :, None] - r[:, None]
    up = np.round(apart[..., 1] / L)
    apart[..., 1] -= L * up
    apart[..., 0] -= up * store.state[rows, 3][:, None, None]
    for a in 0, 2:
        apart[..., a] -= L * np.round(apart[..., a] / L)
    bins = np.floor(np.linalg.norm(apart, axis=3) / width).astype(int)
    bins[:, np.arange(N), np.arange(N)] = 0
    fields = {"C": C[rows]}
    if kind != "smooth":
        omega = W[rows].copy()
        for i in range(2):
            omega[:, store.species == i] -= omega[:, store.species == i].mean(1, keepdims=True)
        fields["W"] = omega
    for letter, field in fields.items():
        for a in range(3):
            curve = curves[f"velocity_correlation_{letter}{'xyz'[a]}"]
            products = field[:, :, None, a] * field[:, None, :, a]
            right = [products[bins == int(x / width)].mean() / (field[..., a] ** 2).mean() if (bins == int(x / width)).any() else np.nan
                     for x in curve["x"]]
            found = [np.nan if v is None else v for v in curve["value"]]
            close(found, right, flow, kind, "correlation", letter, a)


def hold_local(store, flow, kind, curves, replicas, C, W, frame):
    """C_x and Omega_z in the cells of the frame, all and by solid fraction, about the mean of their species over its sigma.
    If the frame has slabs: in cells of about eight grains, at least three along an edge."""
    rows = np.where(window_of(store, replicas) & (store.index % 4 == 0))[0]  # every 4th sample
    box = np.array(box_of(store, flow))
    n = np.maximum(3, np.round(box / (8 * box.prod() / N) ** (1 / 3))).astype(int) if frame.startswith("slabs") else np.full(3, 2)
    place = np.clip(np.floor(n * store.position[rows] / box), 0, n - 1).astype(int) @ [1, n[0], n[0] * n[1]]
    volume = np.array([np.bincount(p, d[store.species] ** 3, n.prod()) for p in place])
    density = np.take_along_axis(volume, place, 1) / (d[store.species] ** 3).sum() * n.prod()
    for letter, field in ({"C": C[..., 0]} if kind == "smooth" else {"C": C[..., 0], "W": W[..., 2]}).items():
        for k in 0, 1:
            of = store.species == k
            x = field[rows][:, of]
            x = (x - x.mean(1, keepdims=True)) / x.std(1, keepdims=True)
            for class_ in "0.75", "1", "1.25", "all":
                curve = curves[f"local_distribution_{letter}{'x' if letter == 'C' else 'z'}_{k + 1}_{class_}"]
                here = x[np.abs(density[:, of] / float(class_) - 1) < 0.1] if class_ != "all" else x.ravel()
                variance = (here ** 2).mean()
                right = {"kurtosis": (here ** 4).mean() / variance ** 2, "skewness": (here ** 3).mean() / variance ** 1.5,
                         "temperature_over_mean": variance}
                for name, value in right.items():
                    close(curve["numbers"][name]["mean"], value, flow, kind, "local", letter, k, class_, name)


def hold_curves(store, flow, kind, curves, replicas, C, W, followed, frame):
    rows = window_of(store, replicas) & (store.index % 2 == 0)  # every 2nd sample
    hold_collisions(store, flow, curves, window_of(store, replicas))
    if "profiles" in FLOWS[flow]["measure"]:
        hold_profiles(store, flow, kind, curves, rows)
        hold_walls(store, flow, curves, replicas)
        if "fluxes" in FLOWS[flow]["measure"]:
            hold_fluxes(store, flow, kind, curves, replicas)
    else:
        hold_distributions(store, flow, curves, rows, C, W)
        hold_flights(store, flow, curves, replicas, followed)
    if "velocity_correlation_Cx" in curves:
        hold_correlations(store, flow, kind, curves, replicas, C, W)
        hold_local(store, flow, kind, curves, replicas, C, W, frame)
    if kind != "smooth" and "profiles" not in FLOWS[flow]["measure"]:
        hold_peculiar_orientation(store, curves, rows, C, W)
    if kind != "smooth":
        hold_orientation(store, flow, kind, curves, rows)


# ---- The collision rule


def hold_rule(flow, kind):
    """Single collisions by e, beta and mu of their pair; those with a wall hit in between are left out."""
    row = np.fromfile("rule.bin").reshape(-1, 13 + 36)
    dt, s = row[:, 1] - row[:, 0], row[:, 2:4].astype(int)
    k, c12, J = row[:, 4:7], row[:, 7:10], row[:, 10:13]
    before, after = row[:, 13:31].reshape(-1, 2, 3, 3), row[:, 31:].reshape(-1, 2, 3, 3)
    r, m12, sigma = d[s] / 2, m[s], d[s].mean(1)
    c = before[:, :, 1].copy()
    if flow == "usf":
        c[:, :, 0] -= c[:, :, 1] * dt[:, None]
    if flow == "poiseuille":
        c[:, :, 0] += 0.05 * dt[:, None]  # two lengths of the scene are one of results; times are the scene's
    imposed = -sigma * k[:, 1] if flow == "usf" else 0  # gamma (y_1 - y_2) at contact
    met = np.abs(c[:, 0] - c[:, 1] + np.outer(np.ones(len(c)) * imposed, [1, 0, 0]) - c12).max(1) < 1e-7 * np.abs(c12).max(1)
    check(met.mean() > (0.9 if "image" not in FLOWS[flow] else 0.5), flow, kind, "collisions followed", met.mean())
    spin = before[:, :, 2]
    g = c12 - np.cross(k, (r[..., None] * spin).sum(1))
    gn = (g * k).sum(1)
    gt = g - gn[:, None] * k
    pair = s.sum(1)
    e = np.array(COLLISION[kind]["e"])[pair]
    Jn = (1 + e) * gn / (1 / m12).sum(1)
    Jt = np.zeros_like(J)
    if kind != "smooth":
        beta, mu = np.array(COLLISION[kind]["beta"])[pair], np.array(COLLISION[kind].get("mu", [np.inf] * 3))[pair]
        Jt = ((1 + beta) / ((1 + 1 / K[s]) / m12).sum(1))[:, None] * gt
        size = np.linalg.norm(Jt, axis=1)
        slides = size > mu * Jn
        Jt[slides] *= (mu * Jn / size)[slides, None]
        check(kind == "rough" or 0.1 < slides[met].mean() < 0.9, "slides", slides[met].mean())
    right = Jn[:, None] * k + Jt
    scale = np.linalg.norm(right, axis=1)
    wrong = np.abs(right - J).max(1) > 1e-7 * scale
    check((wrong & met).sum() <= 0.01 * len(J), flow, kind, "impulses", (wrong & met).sum(), s[wrong & met][:5])
    turned = np.cross(k, J)[:, None] * (r / (K * m * d * d / 4)[s])[..., None]
    moved = J[:, None] * np.array([-1, 1])[:, None] / m12[..., None]
    if kind != "smooth":
        check(np.abs(spin - turned - after[:, :, 2])[met].max() < 1e-7 * np.abs(spin).max(), flow, kind, "spins")
    check(np.abs(c + moved - after[:, :, 1])[met].max() < 1e-7 * np.abs(c).max(), flow, kind, "velocities")


# ---- Files


def arrays(path):
    found = {}
    with h5py.File(path) as f:
        f["particles"].visititems(lambda name, item: found.update({name: item[()].tobytes()}) if isinstance(item, h5py.Dataset) else None)
    return found


def hold_file(path, document, store, flow, kind):
    """Results, curves and frames; frames are those of the first replica, in the units of the start."""
    with h5py.File(path) as f:
        for name, r in document["results"].items():
            group = f["graingas/results"][name]
            check(("mean" in group) == (r["mean"] is not None), name)
            check("mean" not in group or group["mean"][()] == r["mean"] and group["stderr"][()] == r["stderr"], name)
            check(group["unit"].asstr()[()] == r["unit"], name)
        for name, curve in document["curves"].items():
            group = f["graingas/curves"][name]
            for key in "x", "value", "stderr":
                close(group[key][:], [np.nan if v is None else v for v in curve[key]], name, key, within=0, least=0)
            for key, number in curve.get("numbers", {}).items():
                check(number["mean"] is None or group["numbers"][key]["mean"][()] == number["mean"], name, key)
        grains, first = f["particles/grains"], store.replica == 0
        order = store.order[first][0]
        scale = np.abs(store.velocity[first]).max((1, 2), keepdims=True)
        for field, right in ("velocity", store.velocity), ("spin", store.spin):
            if field == "spin" and kind == "smooth":
                check("spin" not in grains)
                continue
            found = grains[field]["value"][:][:, order]
            unit = scale if field == "velocity" else np.abs(right[first]).max((1, 2), keepdims=True)
            check((np.abs(found - right[first]) <= 1e-9 * unit).all(), flow, kind, field)
        box = grains["box/edges/value"][:][:, [0, 1, 2], [0, 1, 2]][0]
        close(box, box_of(store, flow), flow, "box")
        apart = np.abs(grains["position/value"][:][:, order] - store.position[first]) / box
        check(np.minimum(apart, np.abs(apart - 1)).max() < 1e-9, flow, kind, "position")
        close(grains["position/time"][:], store.time[first], flow, "time")
        species = grains["species"][:][order]
        close(species, store.species)
        close(grains["mass"][:][order], m[store.species])
        close(grains["diameter"][:][order], d[store.species])
        units = FLOWS[flow]["units"]
        check(grains.attrs["time_unit"].decode() == units["time"] and grains["velocity"].attrs["unit"].decode() == units["velocity"])
        check(kind == "smooth" or grains["spin"].attrs["unit"].decode() == units["spin"])


def hold_export(name, document, store, flow, kind):
    done = run("export", name + ".h5", "--output", "out")
    check(done.code == 0, done.err)
    with open("out.csv", newline="") as f:
        for row in csv.DictReader(f):
            r = document["results"][row["quantity"]]
            for key in "mean", "stderr":
                check(row[key] == "" if r[key] is None else float(row[key]) == r[key], row)
            check(row["unit"] == r["unit"], row)
    tables = {}
    for path in os.listdir("."):
        if path.startswith("out_") and path != "out_numbers.csv":
            with open(path, newline="") as f:
                tables[path] = list(csv.reader(f))[1:]
    for curve, c in document["curves"].items():
        rows = [t for p, t in tables.items() if p.endswith(f"_{curve}.csv")]
        check(len(rows) >= 1, curve, sorted(tables))
        for column, key in enumerate(("x", "value", "stderr")):
            close([float(v[column] or "nan") for v in rows[0]], [np.nan if v is None else v for v in c[key]], curve, key, within=0, least=0)
    with open("out.xyz") as f:
        lines = f.read().splitlines()
    last = store.replica == 0
    frame = np.array([line.split() for line in lines[-N:]])
    names = lines[-N - 1].split("Properties=")[1].split()[0].split(":")
    at, column = {}, 0
    for label, _, width in zip(names[::3], names[1::3], names[2::3]):
        at[label] = slice(column, column + int(width))
        column += int(width)
    order = store.order[last][-1]
    check((frame[:, at["id"]].ravel().astype(int) == np.arange(N)).all(), "ids")

    def of(label):
        return frame[:, at[label]].astype(float)[order]

    velocity = of("velo") if "velo" in at else of("momenta") / m[store.species][:, None]
    close(velocity, store.velocity[last][-1], flow, "velo", within=1e-6, least=1e-6 * np.abs(velocity).max())
    close(of("radius").ravel(), d[store.species] / 2, "radius", within=1e-6)
    close(of([k for k in at if k.startswith("mass")][0]).ravel(), m[store.species], "mass", within=1e-6)
    if kind != "smooth":
        spin = store.spin[last][-1]
        close(of("omega"), spin, flow, "omega", within=1e-6, least=1e-6 * np.abs(spin).max())


def hold_interface(store, flow, kind, frame, C):
    """The C interface returns the same numbers: the result one by one, samples of an observable, sums and state of a
    simulation."""
    with open("result.json") as f:
        document = json.load(f)
    with open("interface.json") as f:
        said = json.loads(f.read().replace("nan", "null"))
    for name, (mean, error, unit) in said.items():
        r = document["results"][name]
        check([r["mean"], r["stderr"], r["unit"]] == [mean, error, unit], name, r, mean, error, unit)
    if "image" not in FLOWS[flow]:
        scale = np.abs(store.velocity).max((1, 2), keepdims=True)
        check((np.abs(store.shown["velocity"] - C) <= 1e-9 * scale).all(), flow, frame, "velocity shown")
    if kind != "smooth":
        scale = np.abs(store.spin).max((1, 2), keepdims=True)
        check((np.abs(store.shown["spin"] - store.spin) <= 1e-9 * scale).all(), flow, "spin shown")
    count = np.bincount(store.event_row, minlength=len(store.time))
    check((count == store.collisions).all() and (count == store.sums[:, 1]).all(), flow, "collisions of an interval")
    volume = box_of(store, flow)[0] ** 3
    stress = per_row(store, d[store.pair].mean(1)[:, None, None] * store.k[:, :, None] * store.J[:, None, :])
    stress *= STRESS / (volume * store.elapsed)[:, None, None]
    scale = np.abs(stress).max((1, 2), keepdims=True)
    for a, b in (0, 0), (1, 1), (2, 2), (0, 1), (1, 0):
        for found in store.shown["stress"], store.sums[:, 3:12].reshape(-1, 3, 3):
            check((np.abs(found[:, a, b] - stress[:, a, b]) <= 1e-8 * scale[:, 0, 0]).all(), flow, "collisional stress", a, b)
    lost = per_row(store, losses(store, kind)[:, None])[:, 0] * STRESS / (volume * store.elapsed)
    for found in store.shown["dissipation"], store.sums[:, 2]:
        known = ~np.isnan(lost)
        check((np.abs(found - lost)[known] <= 1e-8 * np.abs(lost[known]) + 1e-300).all(), flow, "dissipation")
    C = store.velocity
    T = (m[store.species][:, None] * C * C).sum((1, 2)) / (3 * N)
    check((np.abs(store.state[:, 1] - T) <= 1e-9 * T).all(), flow, "temperature of the state")
    if "image" in FLOWS[flow]:
        p = (m[store.species][:, None] * C).sum(1)
        for r in set(store.replica):
            rows = store.replica == r
            gained = np.diff(p[rows], axis=0)
            pull = 0.05 * m[store.species].sum() * store.elapsed[rows][1:] if flow == "poiseuille" else 0
            walls = store.sums[rows, 12:18].reshape(-1, 2, 3).sum(1)[1:]
            left = gained + walls
            left[:, 0] -= pull
            check(np.abs(left[:, :2]).max() < 1e-7 * np.abs(walls).max(), flow, "momentum of grains and walls", np.abs(left).max())


# ---- The table


def resumed(document, whole):
    """A run that is interrupted three times and resumed gives the same bits."""
    cuts = 0
    for limit in "1e-6", "0.01", "0.03", "1e9":
        again = ["--resume", "cut.checkpoint.h5"] if cuts else []
        done = run("run", "scene.yaml", "--quiet", "--json", "--set", f"run.replicas={REPLICAS}", "--set", f"run.time_limit={limit}",
                   "--set", "output.checkpoint_every=60", "--output", "cut.h5", *again)
        check(done.code in (0, 1), done.err)
        cuts += done.code
        if done.code == 0:
            break
    check(cuts > 0, "was not cut")
    found = json.loads(done.out)
    for part in "results", "curves", "warnings", "collisions":
        check(found[part] == document[part], "resumed:", part)
    check(arrays("cut.h5") == whole, "resumed: frames")


def stored(scene, collisions, *more):
    if isinstance(h5py, ImportError):
        raise Skip(h5py)
    with open("scene.yaml", "w") as f:
        json.dump(scene, f)
    done = subprocess.run([os.environ["STORED_EVENTS"], "scene.yaml", ".", str(REPLICAS), str(collisions), *map(str, more)],
                          capture_output=True, text=True, timeout=60 * PATIENCE)
    check(done.returncode == 0, done.stderr)


def row(flow, kind, frame):
    stored(scene_of(flow, kind, frame), SINGLE)
    store = Store(kind != "smooth")
    hold_rule(flow, kind)
    followed = None if "image" in FLOWS[flow] else Followed(store, flow)
    for replicas in 1, REPLICAS:
        done = run("run", "scene.yaml", "--quiet", "--json", "--set", f"run.replicas={replicas}", "--output", f"r{replicas}.h5")
        check(done.code == 0, done.err)
        document = json.loads(done.out)
        walled = "image" in FLOWS[flow]
        C, W = (about_flow(store, window_of(store, replicas), flow) if walled else (store.velocity, store.spin) if frame == "imposed"
                else about_cells(store, flow, frame))
        check(document["results"]["N1"]["samples"] == window_of(store, replicas).sum(), "samples")
        hold_numbers(document["results"], expected(store, flow, kind, replicas, C, W, followed), flow, f"{flow} {kind} {replicas}")
        hold_units(document["results"], flow)
        hold_curves(store, flow, kind, document["curves"], replicas, C, W, followed, frame)
        hold_file(f"r{replicas}.h5", document, store, flow, kind)
        hold_export(f"r{replicas}", document, store, flow, kind)
    with open("result.json") as f:
        library = json.load(f)
    check({k: v for k, v in library["results"].items() if k != "recorded"} == document["results"], "library and command")
    check(library["curves"] == document["curves"], "curves of library and command")
    hold_interface(store, flow, kind, frame, C)
    if kind == "frictional" or frame != "imposed":  # these have all that others gather
        resumed(document, arrays(f"r{REPLICAS}.h5"))


def test_uneven_replicas():
    """A run that is stopped in the midst of its replicas: means are over what all of them have, curves over all whole
    blocks, of which a sample weighs as much as any other."""
    scene = scene_of("usf", "rough")
    scene["run"]["collisions"] = 1e5
    stored(scene, SINGLE, 800)
    with open("result.json") as f:
        document = json.load(f)
    store, first = Store(True), WARMUP // 2
    n = np.bincount(store.replica) - first
    check(n.min() > 20 and n.max() > n.min() + 20, "even replicas", n)
    store.end = first + n.min()
    right = expected(store, "usf", "rough", REPLICAS, store.velocity, store.spin, Followed(store, "usf"))
    check(document["results"]["N1"]["samples"] == REPLICAS * n.min(), n)
    for name in "temperature", "P_xy", "collision_rate", "temperature_ratio":
        close(document["results"][name]["mean"], right[name], name, n)
    samples = document["curves"]["impact_cos"]["samples"]
    block = [b for b in (1, 2, 4, 8, 16, 32, 64) if (n // b * b).sum() == samples]
    check(block, n, samples)
    rows = (store.index >= first) & (store.index < first + (n // block[-1] * block[-1])[store.replica])
    hold_collisions(store, "usf", document["curves"], rows)


def cooling(**more):
    """The result of a short run of a few cooling grains, of which nothing is stored."""
    scene = {"flow": "hcs", "engine": "dsmc", "phi": 0.1, "dsmc": {"particles": 200}, "collision": {"e": 0.95, "beta": 0.97},
             "run": {"warmup": 200, **more}}
    with open("scene.yaml", "w") as f:
        json.dump(scene, f)
    done = run("run", "scene.yaml", "--quiet", "--json")
    check(done.code == 0, done.err)
    return json.loads(done.out)


def test_deciding_errors_have_a_margin():
    """Errors that decide when a run ends are larger by 6 tau over the length of all replicas' windows."""
    asked, fixed = cooling(relative_error=0.05, replicas=3), cooling(collisions=1000, replicas=3)
    for name, q in asked["results"].items():
        if q.get("stderr"):
            plain = fixed["results"][name]
            close(q["mean"], plain["mean"], name)
            close(q["stderr"], plain["stderr"] * (1 + 6 * q["correlation_time"] / (2 * q["samples"])), name)


def test_long_series():
    """Rows of one sample, and of two: the shortest correlation time is half of a row, of two collisions a grain a sample.
    Work is that of the window."""
    for collisions, shortest in (12000, 1), (36000, 2):
        document = cooling(collisions=collisions, warmup=8000)
        close(document["results"]["cooling_rate"]["correlation_time"], shortest, "cooling_rate")
        share = document["collisions"] / document["total"]["collisions"]
        close(share, collisions / (collisions + 8000), "collisions", within=0.01)
        cpu = document["cpu_seconds"] / document["total"]["cpu_seconds"]
        check(share - 0.15 < cpu < share + 0.15, "processor time", cpu, share)


def test_errors_are_those_of_blocks():
    """Standard errors against those of means over blocks of samples, which are known to 8 %; of the distribution of angles
    against counting."""
    scene = scene_of("usf", "rough")
    scene["run"]["collisions"], scene["output"] = 3000, {}
    stored(scene, 0)
    samples = np.fromfile("samples.bin").reshape(-1, 14 + 6 * N)
    with open("result.json") as f:
        document = json.load(f)
    of, blocks = samples[:, 0].astype(int), 25
    C = samples[:, 14:14 + 3 * N].reshape(-1, N, 3)
    series = {"collision_rate": samples[:, 3] / samples[:, 2], "dissipation": samples[:, 4], "P_xy_collisional": samples[:, 6],
              "P_yy_collisional": samples[:, 9], "kurtosis_Cy": (C[..., 1] ** 4).mean(1) / (C[..., 1] ** 2).mean(1) ** 2}
    for name, y in series.items():
        means = []
        for r in range(REPLICAS):
            own = y[of == r][WARMUP // 2:]
            means += list(own[len(own) % blocks:].reshape(blocks, -1).mean(1))
        right = np.std(means, ddof=1) / len(means) ** 0.5 / abs(np.mean(means))
        q = document["results"][name]
        check(0.75 < q["stderr"] / abs(q["mean"]) / right < 1.4, name, q, right)
    curve = document["curves"]["impact_cos"]
    p, n = np.array(curve["value"]) / 50, document["collisions"]
    ratio = (np.array(curve["stderr"]) / 50) ** 2 / (p * (1 - p) / n)
    check(0.75 < ratio[5:].mean() < 1.35, "impact_cos", ratio)


def conductivities(V, e, phi, pairs, rng):
    """kappa*, its kinetic part, mu* of grains V in the cooling state, over 15 nT/(4 m nu_0): f1/f0 is C times a
    quadratic function of C^2, the rest are averages over grains and random pairs (Garzo and Dufty 1999). Derivatives are
    differences."""
    V = V - V.mean(0)
    V /= ((V * V).sum(1).mean() / 3) ** 0.5
    chi = (1 - phi / 2) / (1 - phi) ** 3
    rate, y, h = 6 * phi / np.pi * chi, 2 * (1 + e) * phi * chi, 1e-4
    slope = phi * (-0.5 / (1 - phi / 2) + 3 / (1 - phi))

    def b(C):  # polynomials that a Maxwellian makes orthogonal
        x = (C * C).sum(-1, keepdims=True) / 2
        return np.stack([C, C * (2.5 - x), C * (35 / 8 - 3.5 * x + x * x / 2)])

    def mean(u, v):  # of all pairs of functions, a third for each direction
        return np.einsum("mia,nia->mn", u, v) / (3 * u.shape[1])

    here, stretched = b(V), (b(V * (1 + h)) - b(V * (1 - h))) / (2 * h)
    pressed = sum((b(V + h * a) - b(V - h * a))[..., i].mean(1) for i, a in enumerate(np.eye(3))) / (6 * h)
    S = [-((here + stretched) * V).sum(2).mean(1) / 6 + (1 + y) * pressed,
         -(here * V).sum(2).mean(1) / 3 + (1 + y * (2 + slope)) * pressed]
    one, two = (V[rng.integers(len(V), size=pairs)] for _ in range(2))
    k = rng.normal(size=(pairs, 3))
    k /= np.linalg.norm(k, axis=1)[:, None]

    def meet(one, two):
        g = np.maximum(((one - two) * k).sum(1), 0)[:, None]
        return g, one - (1 + e) / 2 * g * k, two + (1 + e) / 2 * g * k

    def far(two):  # what one grain's functions change by, along k, at the rate of collisions
        g, after, _ = meet(one, two)
        return (g * k * (b(after) - b(one))).sum(2).mean(1)

    def carried(one, two):
        g = meet(one, two)[0][:, 0]
        return (g * g * ((one + two) * k).sum(1) / 2).mean()

    g, a1, a2 = meet(one, two)
    zeta = -2 * np.pi * rate * (g[:, 0] * ((a1 * a1).sum(1) + (a2 * a2).sum(1) - (one * one).sum(1) - (two * two).sum(1))).mean() / 3
    L = 2 * np.pi * rate * mean(g * (b(a1) + b(a2) - b(one) - b(two)), b(one) + b(two)) + zeta / 2 * mean(stretched, here)
    S[0] = S[0] + 4 * np.pi / 3 * rate * (far(two * (1 + h)) - far(two * (1 - h))) / (4 * h)
    S[1] = S[1] + 4 * np.pi / 3 * rate * (1 + slope / 2) * far(two)
    overlap = mean(here, here)

    def respond(operator, source):  # instead of the first equation: no momentum
        operator, source = operator.copy(), source.copy()
        operator[0], source[0] = overlap[0], 0
        return np.linalg.solve(operator, -source)

    A = respond(L + zeta / 2 * overlap, S[0])
    B = respond(L, S[1] + zeta * (1 + slope) * overlap @ A)
    flux = mean((V * (V * V).sum(1)[:, None] / 2)[None], here)[0]
    unit, transfer = 4 / 15 * 16 / 5 * np.pi ** 0.5 * rate / chi, 1 + 0.6 * y
    far_heat = [carried(one, two * (1 + h)) - carried(one, two * (1 - h)), carried(one * (1 + h), two) - carried(one * (1 - h), two)]
    extra = 4 * np.pi / 3 * rate * (1 + e) / 8 * (far_heat[0] - far_heat[1]) / (4 * h)
    kappa = -flux @ A
    return unit * np.array([kappa * transfer - extra, kappa, -flux @ B * transfer])


def test_conductivity_is_the_response_of_frames():
    """Against the response computed here from frames of the ensemble, whose scatter is the error: a2 of 10 000 grains is
    known to 0.007, kappa* to 1.5 %."""
    if isinstance(h5py, ImportError):
        raise Skip(h5py)
    names = ["thermal_conductivity_reduced", "thermal_conductivity_reduced_kinetic", "diffusive_heat_conductivity_reduced"]
    scene = {"flow": "hcs", "engine": "dsmc", "phi": 0.2, "collision": {"e": 0.85}, "dsmc": {"particles": 10000},
             "measure": ["rheology", "conductivity"], "run": {"collisions": 600},
             "output": {"trajectory_every": 20, "after": "warmup"}}
    with open("scene.yaml", "w") as f:
        json.dump(scene, f)
    done = run("run", "scene.yaml", "--quiet", "--json", "--output", "r.h5")
    check(done.code == 0, done.err)
    results = json.loads(done.out)["results"]
    with h5py.File("r.h5") as f:
        frames = f["particles/grains/velocity/value"][:]
    rng = np.random.default_rng(5)
    right = np.array([conductivities(V, 0.85, 0.2, 75000, rng) for V in frames])
    error = right.std(0, ddof=1) / len(right) ** 0.5
    for name, value, own in zip(names, right.mean(0), error):
        r = results[name]
        check(r["unit"] == "1" and max(r["stderr"], own) < 0.006 * results[names[0]]["mean"], name, r, own)
        check(abs(r["mean"] - value) < 4 * (r["stderr"] ** 2 + own ** 2) ** 0.5, name, r, value, own)


def chi(i, j, x):
    """Contact values: Boublik and Mansoori for two species, Carnahan and Starling for one."""
    xi = [PHI * sum(x[k] * d[k] ** p for k in range(2)) / sum(x[k] * d[k] ** 3 for k in range(2)) for p in range(4)]
    y = d[i] * d[j] / (d[i] + d[j]) * xi[2] / (1 - PHI)
    return (1 + 3 * y + 2 * y * y) / (1 - PHI)


def moments(store):
    """Growth of Helfand's moments from sample to sample: heat (3) and stress (9, symmetric), kinetic and in all. A flux
    lasts from a collision to the sample after it, whatever comes between."""
    c, mass = Followed(store, "equilibrium").c, m[store.pair][..., None]
    after = c + store.J[:, None] * np.array([-1, 1])[:, None] / mass

    def flux(mass, c):
        heat, stress = mass * (c * c).sum(-1, keepdims=True) * c / 2, mass[..., None] * c[..., :, None] * c[..., None, :]
        return np.concatenate([heat, stress.reshape(c.shape[:-1] + (9,))], -1)

    left = store.state[store.event_row, 0] - store.event_time
    kinetic = per_row(store, left[:, None] * (flux(mass, after) - flux(mass, c)).sum(1))
    kinetic[1:] += (flux(m[store.species][:, None], store.velocity).sum(1)[:-1]) * store.elapsed[1:, None]
    way = d[store.pair].mean(1)[:, None] * store.k
    energy = (m[store.pair[:, 1]] / 2 * ((after[:, 1] ** 2).sum(1) - (c[:, 1] ** 2).sum(1)))[:, None]
    stress = way[:, :, None] * store.J[:, None, :]
    jumps = np.concatenate([way * energy, ((stress + stress.transpose(0, 2, 1)) / 2).reshape(-1, 9)], 1)
    return kinetic, kinetic + per_row(store, jumps)


def test_helfand_moments_are_those_of_samples():
    """Helfand integrals of one species and of two, to the sixth interval, as double sums over samples."""
    last, trace = 6, np.eye(3).reshape(9) / 3
    for species in None, SPECIES:
        scene = {"flow": "equilibrium", "engine": "md", "phi": PHI, "particles": N, "measure": ["rheology", "helfand"],
                 "run": {"warmup": WARMUP, "collisions": COLLISIONS}, "output": {"trajectory_every": 1e-9}}
        stored(dict(scene, species=species) if species else scene, SINGLE)
        store = Store(False)
        done = run("run", "scene.yaml", "--quiet", "--json", "--set", f"run.replicas={REPLICAS}", "--output", "r.h5")
        check(done.code == 0, done.err)
        results = json.loads(done.out)["results"]
        kinetic, whole = moments(store)
        V = np.prod(box_of(store, "equilibrium"))
        T = (m[store.species][:, None] * store.velocity[-1] ** 2).sum() / (3 * N)
        x = [(store.species == i).sum() / N for i in range(2)]
        Z = 1 + 2 * np.pi / 3 * N / V * sum(x[i] * x[j] * ((d[i] + d[j]) / 2) ** 3 * chi(i, j, x) for i in range(2) for j in range(2))
        sums, bulk, rows, time = np.zeros(4), np.zeros(2), 0, 0
        for r in range(REPLICAS):
            of = np.where((store.replica == r) & window_of(store, REPLICAS))[0][1:]  # the first one only begins
            a, k = whole[of], kinetic[of]
            p = a[:, 3:] @ trace - N * T * Z * store.elapsed[of]
            shear, shear_k = (u[:, 3:] - np.outer(3 * u[:, 3:] @ trace, trace) for u in (a, k))
            for i in range(last, len(of)):
                for j in range(i - last, i + 1):
                    half = 0.5 if i == j else 1
                    sums += half * np.array([a[i, :3] @ a[j, :3] / 3, (a[i, :3] @ k[j, :3] + k[i, :3] @ a[j, :3]) / 6,
                                             shear[i] @ shear[j] / 10, (shear[i] @ shear_k[j] + shear_k[i] @ shear[j]) / 20])
                    bulk[0] += half * p[i] * p[j]
                bulk[1] += p[i]
                rows, time = rows + 1, time + store.elapsed[of[i]]
        eta, eta_b = sums[2:], bulk[0] - (last + 0.5) * bulk[1] ** 2 / rows
        nu0 = 3.2 * (np.pi * T) ** 0.5 * N / V if not species else np.pi ** 0.5 * N / V * d.mean() ** 2 * (2 * T * (1 / m).sum()) ** 0.5
        scale = nu0 / (N * T) / (time * T)
        right = {"viscosity_reduced": eta[0], "viscosity_reduced_kinetic": eta[1], "bulk_viscosity_reduced": eta_b}
        if not species:
            right.update({"thermal_conductivity_reduced": 4 / 15 / T * sums[0], "thermal_conductivity_reduced_kinetic": 4 / 15 / T * sums[1]})
        for name, value in right.items():
            close(results[name]["mean"], scale * value, name, species, within=1e-8)


# Rows that ./check runs: each kind of grain and of frame occurs. NIGHTLY runs all rows.
DAILY = {"usf": ["rough_cells_laboratory", "smooth_slabs", "rough_slabs_laboratory", "frictional"], "hcs": ["frictional_cells"],
         "couette": ["frictional"], "poiseuille": ["smooth"], "fourier": ["rough"]}

for _flow in FLOWS:
    for _kind in COLLISION:
        for _frame in ["imposed"] + FRAMES.get((_flow, _kind), []):
            _name = f"test_{_flow}_{_kind}" + (f"_{_frame}" if _frame != "imposed" else "")
            if "NIGHTLY" in os.environ or _flow not in DAILY or _name[len(f"test_{_flow}_"):] in DAILY[_flow]:
                globals()[_name] = lambda flow=_flow, kind=_kind, frame=_frame: row(flow, kind, frame)

if __name__ == "__main__":
    main(sys.modules[__name__])
