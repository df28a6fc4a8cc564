# SPDX-License-Identifier: GPL-3.0-or-later
"""Relaxation of gases: curves in time, means of many replicas in one or both engines, with changes of keys on the
way.
"""
from __future__ import annotations

from concurrent.futures import ThreadPoolExecutor
from typing import Optional, Sequence

import numpy as np

from . import calls, catalogue
from .arguments import real, refused, whole
from .errors import BadInput, not_found
from .plot import COLOURS, DASHES, label, legend, new_axes, styled, time_label
from .run import thread_count
from .scene import as_scene
from .simulation import Simulation, followed

ENGINES = ("md", "dsmc")


class TimeSeries:
    """A quantity in time: mean and stderr (points) over replicas; values (replicas, points) of each."""

    def __init__(self, values):
        self.values = values
        self.mean = values.mean(axis=0)
        self.stderr = values.std(axis=0, ddof=1) / len(values) ** 0.5

    def __repr__(self):
        return f"<graingas.TimeSeries: {self.values.shape[1]} times, {self.values.shape[0]} replicas>"


def _first_crossing(time, difference):
    """Time of the first change of sign of a difference, by straight lines; NaN: never."""
    after = np.flatnonzero(difference[:-1] * difference[1:] < 0)
    if not len(after):
        return np.nan
    k = after[0]
    return time[k] + (time[k + 1] - time[k]) * difference[k] / (difference[k] - difference[k + 1])


class Relaxation:
    """Curves of a gas in time. relaxation["temperature"]["md"].mean; units are those of results.

    time (points); engines; quantities: temperature, a2; rotational_temperature and temperature_ratio of rough grains;
    temperature_1, temperature_2, ... of mixtures
    """

    def __init__(self, scene, time, series, protocol):
        self.scene, self.time, self.protocol, self._series = scene, time, protocol, series

    @property
    def engines(self):
        return list(self._series)

    @property
    def quantities(self):
        return list(next(iter(self._series.values())))

    def __getitem__(self, quantity):
        """Engine -> TimeSeries."""
        if quantity not in self.quantities:
            raise not_found("curve", quantity, self.quantities)
        return {engine: of[quantity] for engine, of in self._series.items()}

    def z(self, quantity):
        """(points) md minus dsmc over their combined standard error. Points of one replica are correlated."""
        if set(self.engines) != set(ENGINES):
            raise BadInput(f"z: it takes both engines; here is {self.engines[0]} alone")
        md, dsmc = (self[quantity][engine] for engine in ENGINES)
        with np.errstate(invalid="ignore", divide="ignore"):
            return (md.mean - dsmc.mean) / np.hypot(md.stderr, dsmc.stderr)

    def crossing(self, other, quantity="temperature", engine=None):
        """(time, standard error) at which the mean of this gas and of another cross for the first time; NaN: they do
        not. The error is a jackknife over the replicas of both. engine: of both; None: the first."""
        engine = engine or self.engines[0]
        one, two = self[quantity][engine], other[quantity][engine]
        if len(self.time) != len(other.time) or not np.allclose(self.time, other.time):
            raise BadInput("crossing: both relaxations need the same times")

        def without(series):
            n = len(series.values)
            return (n * series.mean - series.values) / (n - 1)
        when = _first_crossing(self.time, one.mean - two.mean)
        variance = 0
        for first, second in ((without(one), [two.mean]), ([one.mean], without(two))):
            times = np.array([_first_crossing(self.time, a - b) for a in first for b in second])
            variance += (len(times) - 1) * times.var()
        return when, variance ** 0.5

    @styled
    def plot(self, quantity="temperature", ax=None, bands=2.0, **style):
        """Means with a band of so many standard errors, a colour an engine. Returns the axes."""
        ax = new_axes(ax)
        for k, (engine, series) in enumerate(self[quantity].items()):
            look = {"color": COLOURS[k], "linestyle": DASHES[k], "label": engine, **style}
            line, = ax.plot(self.time, series.mean, **look)
            ax.fill_between(self.time, series.mean - bands * series.stderr, series.mean + bands * series.stderr,
                            color=line.get_color(), alpha=0.25, linewidth=0)
        for at, changes in self.protocol:
            ax.axvline(at, color="0.7", linewidth=0.6, zorder=0)
        known = catalogue.quantities(self.scene)
        ax.set(xlabel=time_label(known), ylabel=label(quantity, known[quantity].unit, known[quantity].symbol))
        legend(ax)
        return ax

    def to_dataframe(self):
        """pandas: a row a time; columns (engine, quantity, "mean" or "stderr")."""
        import pandas
        table = {(engine, q, what): getattr(series, what) for engine, of in self._series.items()
                 for q, series in of.items() for what in ("mean", "stderr")}
        return pandas.DataFrame(table, index=pandas.Index(self.time, name="time"))

    def __repr__(self):
        n = len(next(iter(self[self.quantities[0]].values())).values)
        return (f"<graingas.Relaxation: {self.scene.title}; {', '.join(self.engines)}; {n} replicas, "
                f"times 0 to {self.time[-1]:g}>")


def _now(sim, rough):
    """Quantities at this time."""
    state, grains = sim.state, sim.grains
    found = {"temperature": state.temperature}
    species = sim.species
    if len(species) == 1:
        square = (grains.velocity ** 2).sum(axis=1)
        found["a2"] = 0.6 * (square ** 2).mean() / square.mean() ** 2 - 1
    else:
        found.update({f"temperature_{k + 1}": s.temperature for k, s in enumerate(species)})
    if rough:
        found["rotational_temperature"] = state.rotational_temperature
        found["temperature_ratio"] = state.rotational_temperature / state.temperature
    return state.time, found


def _set_temperatures(sim, wanted):
    """Scale the velocities of each species, about a mean of zero, to its temperature (unit of results)."""
    grains, species = sim.grains, sim.species
    velocity = np.array(grains.velocity)
    kind = np.asarray(grains.species)
    mass = np.array([s.mass for s in species])[kind][:, None]
    for _ in range(5):  # subtracting the mean changes temperatures, by 1/N each time
        velocity -= (mass * velocity).sum(axis=0) / mass.sum()
        for k, T in enumerate(wanted):
            own = kind == k
            velocity[own] *= (3 * T * own.sum() / (mass[own] * velocity[own] ** 2).sum()) ** 0.5
    sim.set_grains(velocities=velocity)


def _settle(sim):
    """Under shear md begins where grains were pushed apart: many are left close to another, and for half a collision a
    grain collisions are several times as frequent as later. They find places; then it begins."""
    grains = sim.grains
    if grains.position is not None and "sheared" in catalogue.traits(sim.scene["flow"]):
        sim.collide(5 * len(grains) // 2)
        sim.set_grains(velocities=grains.velocity, spins=grains.spin)


class _Replicas:
    """Replicas of one engine, several at a time."""

    def __init__(self, scene, time, protocol, ratios):
        self.scene, self.time, self.ratios, self.protocol = scene, time, ratios, protocol
        self.call = calls.Call()  # of all replicas

    def run(self, n, threads):
        """Quantity -> values (n, points)."""
        with ThreadPoolExecutor(threads) as pool:
            try:
                rows = list(pool.map(self._one, range(n)))
            except BaseException:  # Ctrl-C, too
                self.call.interrupt()
                raise
        return {q: np.array([row[q] for row in rows]) for q in rows[0]}

    def _one(self, stream):
        with Simulation._one_of(self.scene, stream, self.call) as sim:
            return self._follow(sim)

    def _follow(self, sim):
        _settle(sim)
        if self.ratios is not None:
            _set_temperatures(sim, self.ratios * sim.state.temperature)
        begin, at, rows, changes = sim.time, [], [], list(self.protocol)
        rough = not catalogue.quantities(self.scene)["temperature_ratio"].missing
        for t in self.time:
            while changes and changes[0][0] <= t:
                when, keys = changes.pop(0)
                _advance_to(sim, begin + when)
                for key, value in keys.items():
                    sim[key] = value
            _advance_to(sim, begin + t)
            now, row = _now(sim, rough)
            at.append(now - begin), rows.append(row)
        # Monte Carlo ends at most one step after the time.
        return {q: np.interp(self.time, at, [row[q] for row in rows]) for q in rows[0]}


def _advance_to(sim, time):
    if time > sim.time:
        sim.advance(time - sim.time)


def _checked_protocol(protocol, until):
    found = []
    for change in protocol or ():
        try:
            at, keys = change
            at, keys = real(at, "protocol"), dict(keys)
        except (TypeError, ValueError):
            raise BadInput(f"protocol: {change!r} is not allowed; allowed: (time, {{key: value, ...}})") from None
        if not 0 < at < until:
            raise BadInput(f"protocol: time {at:g} is not allowed; allowed: above 0 and below until, {until:g}")
        if not keys:
            raise BadInput(f"protocol: the change at {at:g} names no key; allowed: (time, {{key: value, ...}})")
        if found and at < found[-1][0]:
            raise BadInput(f"protocol: time {at:g} comes after {found[-1][0]:g}; give changes in the order of times")
        found.append((at, keys))
    return found


STARTS = ("temperature", "rotational_temperature", "a2", "spin")


def _starting(scene, start):
    """The scene with this start, and T_i/T of its species where they are given; else None."""
    start = dict(start or {})
    unknown = sorted(set(start) - set(STARTS))
    if unknown:
        raise BadInput(f"start: key {unknown[0]!r} is not allowed; allowed: {', '.join(STARTS)}")
    ratios = None
    if np.ndim(start.get("temperature", 1)):
        T, species = np.asarray(start["temperature"], float), scene.species
        if T.shape != (len(species),) or not (np.isfinite(T).all() and (T > 0).all()):
            raise BadInput(f"start: temperature {start['temperature']!r} is not allowed; allowed: a number above 0, or one "
                           f"for each of the {len(species)} species")
        mean = float(np.average(T, weights=[s["fraction"] for s in species]))
        start["temperature"], ratios = mean, T / mean
    return scene.copy(**{f"start.{key}": value for key, value in start.items()}), ratios


def relax(scene, until: float, *, points: int = 60, replicas: int = 16, engines: Sequence[str] = ENGINES,
          protocol: Optional[Sequence] = None, start: Optional[dict] = None, threads: Optional[int] = 1,
          **keys) -> Relaxation:
    """A gas in time, from its start to a time, as the mean of many replicas.

    scene, keys  as for run(); flows without walls
    until        the last time, in the unit of results
    points       times, evenly spaced from 0
    replicas     of each engine, at least 2: bands and errors come from them
    protocol     [(time, {"bath.temperature": 2, ...}), ...]: keys changed on the way, those of Simulation[...]; times
                 in their order, between 0 and until
    start        keys of start in scenes, in the scene's units: {"temperature": T, "rotational_temperature": theta,
                 "a2": a2, "spin": omega_z}; instead of T also those of the species, [T_1, T_2, ...]
    threads      replicas at a time; None: all processors

    Sheared gases have velocities about the flow. Free cooling is not rescaled, and ends after 100 decades.
    Ctrl-C ends the call within 0.1 s, also while gases are made (a million grains: 0.5 s), and raises
    KeyboardInterrupt.
    """
    if "engine" in keys:
        raise BadInput(f"relax: engine has no effect; give engines={keys['engine']!r}")
    scene = as_scene(scene).copy(**keys)
    until = real(until, "until", "a number above 0")
    if until <= 0:
        raise refused("until", until, "a number above 0")
    points, replicas = whole(points, "points", 2, 10**7), whole(replicas, "replicas", 2, 10**7)
    engines = [engines] if isinstance(engines, str) else list(engines)
    wrong = [e for e in engines if e not in ENGINES]
    if wrong or not engines:
        raise BadInput(f"engines: {wrong[0] if wrong else engines!r} is not allowed; allowed: md, dsmc")
    if "walls" in catalogue.traits(scene["flow"]):
        raise BadInput(f"relax: flow: {scene['flow']} has walls, and another temperature at each height")
    given = followed(scene)
    if given:
        raise BadInput(f"relax: the scene gives {given}, which run() follows; leave it out, and give until and protocol")
    scene, ratios = _starting(scene, start)
    time, protocol = np.linspace(0, until, points), _checked_protocol(protocol, until)
    series = {}
    for engine in engines:
        replica = _Replicas(scene.copy(engine=engine), time, protocol, ratios)
        found = replica.run(replicas, thread_count(threads))
        series[engine] = {q: TimeSeries(values) for q, values in found.items()}
    return Relaxation(scene, time, series, protocol)
