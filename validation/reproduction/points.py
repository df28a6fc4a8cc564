# SPDX-License-Identifier: GPL-3.0-or-later
"""The points of a figure: runs of its sweeps, their results, values of engines and theories at each point."""
import functools
import math
import os
import warnings
from dataclasses import dataclass
from typing import NamedTuple

import graingas as gg

from . import curves
from . import entry as entries
from .formula import Formula

RATIO = Formula("y/r")


class Value(NamedTuple):
    mean: float
    error: float  # NaN: unknown; 0: exact
    unit: str = None


NOTHING = Value(math.nan, math.nan)


def sweeps(entry, quick, folder):
    """The sweeps of an entry by name, not run. A sweep of another figure has that figure's quick values."""
    found = {}
    for name, sweep in entry.sweeps.items():
        owner = entry
        if isinstance(sweep, str):
            owner = entries.read(entries.find(sweep, os.path.dirname(entry.path)))
            sweep = owner.sweeps.get("")
        if not isinstance(sweep, entries.Sweep):
            raise entries.BadEntry(f"{entry.base}.yaml: key 'sweep': {owner.figure} has not one sweep of its own")
        text = sweep.quick(owner.quick) if quick else sweep.text
        found[name] = gg.Sweep.parse(text, folder, f"{owner.base}.yaml" + (" with its quick values" if quick else ""))
    return found


class Point:
    """A finished point of a sweep."""

    def __init__(self, sweep, point):
        self.sweep, self.varied, self.scene, self.file = sweep, list(point.values), point.scene, point.file
        self.result = point.read()
        both = isinstance(self.result, gg.Comparison)
        found = [self.result.md, self.result.dsmc] if both else [self.result]
        self.engines = {result.engine: result for result in found if result is not None}
        self.short = point.state == "short"
        self.evaluated = {}  # theories by name and changes of keys

    @functools.cached_property
    def _theories(self):
        return self.result.theories if isinstance(self.result, gg.Comparison) else {}

    @functools.lru_cache(maxsize=None)
    def curves(self, engine):
        return self.engines[engine].curves

    def converged(self, engine):
        """Whether the run met its criteria in a steady state. A gas that is followed in time has none to meet."""
        followed = isinstance(self.scene["run.duration"], (int, float))
        return followed or (not self.short and self.engines[engine].is_steady)

    def quantity(self, engine, name):
        found = self.engines[engine].find(name)
        return Value(found.mean, found.error, found.unit)

    def curve_number(self, engine, curve, name):
        found = self.curves(engine)[curve].numbers.get(name) if curve in self.curves(engine) else None
        return Value(found.mean, found.error, found.unit) if found else NOTHING

    @functools.lru_cache(maxsize=None)
    def theory_curves(self, name):
        """Curves of a theory, as stored, or evaluated now; none where it does not apply."""
        theory = self._theories.get(name)
        if theory is None or not theory.curves:
            theory = _evaluated(self.scene, name, {})
        return theory.curves if theory is not None else {}

    def theory(self, name, quantity, changes):
        """Value of a theory at this point, with `changes` of scene keys."""
        theory = self._theories.get(name) if not changes else None
        if theory is None or quantity not in theory:
            key = name, *changes.items()
            if key not in self.evaluated:
                self.evaluated[key] = _evaluated(self.scene, name, changes)
            theory = self.evaluated[key]
        if theory is None or quantity not in theory:
            return NOTHING
        error = theory.error(quantity)
        return Value(theory[quantity], 0 if math.isnan(error) else error)


def _evaluated(scene, name, changes):
    try:
        changed = scene.copy()
        for key, value in changes.items():
            changed[key] = value
        return gg.theory(changed, name)
    except gg.BadInput:
        return None


def key_number(scene, key):
    """The value of a scene key as a number; NaN if it is not one."""
    value = scene[key]
    return float(value) if isinstance(value, (int, float)) else math.nan


def _is(scene, key, text):
    """Whether the key has this value. Numbers are compared as numbers, other values as the scene writes them."""
    try:
        here, wanted = key_number(scene, key), float(text)
    except ValueError:
        here, wanted = math.nan, math.nan
    if not math.isnan(here):
        return here == wanted or abs(here - wanted) <= 1e-9 * abs(wanted)
    other = scene.copy()
    try:
        other[key] = text
    except gg.BadInput:
        return False
    return other.text_of(key) == scene.text_of(key)


def meets(scene, conditions):
    return all(any(_is(scene, key, text) for text in values) for key, values in conditions.items())


def run(entry, quick, folder, threads, say):
    """Run missing points and read every finished one. Returns the points and the reasons why some are incomplete."""
    points, reasons = [], []
    for name, sweep in sweeps(entry, quick, folder).items():
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", gg.PartialResult)
            sweep.run(threads, say)
        if sweep.partial:
            reasons.append(sweep.partial)
            if "interrupted" in sweep.partial:
                raise KeyboardInterrupt(sweep.partial)
        points += [Point(name, point) for point in sweep if point.state != "missing"]
    if not points:
        raise gg.RunFailed(f"{entry.figure}: no point came to an end. {' '.join(reasons)}")
    return points, reasons


@dataclass
class Query:
    """Value that a panel or a number takes from every point, of one engine or of one theory."""
    points: list
    source: entries.Source
    name: str
    engine: str = None
    theory: str = None
    changes: dict = None  # scene keys with other values for the theory

    def _raw(self, point, changes):
        if self.theory:
            return point.theory(self.theory, self.name, changes)
        if self.source.kind == "curve":
            curve = point.curves(self.engine).get(self.name)
            return Value(*curves.take(curve, self.source.take)) if curve is not None else NOTHING
        if self.source.kind == "number":
            return point.curve_number(self.engine, self.name, self.source.number)
        return point.quantity(self.engine, self.name)

    def _other(self, point):
        """The point with the values of relative_to that agrees with this one in all other keys."""
        free = self.source.relative_to
        for other in self.points:
            keys = {key for key in {*other.varied, *point.varied} - set(free) if not key.startswith("run.")}
            if meets(other.scene, free) and all(other.scene.text_of(k) == point.scene.text_of(k) for k in keys):
                return other
        return None

    def _reference(self, point):
        changes = self.changes or {}
        if self.source.relative_theory:
            return point.theory(self.source.relative_theory, self.name, changes)
        other = self._other(point)
        if other is None or (self.engine and self.engine not in other.engines):
            return NOTHING
        return self._raw(other, {key: value for key, value in changes.items() if key not in self.source.relative_to})

    def at(self, point, x):
        """The value at a point, after the formula `as` and relative to the source's reference."""
        value, reference = self._raw(point, self.changes or {}), Value(0, 0)
        relative = bool(self.source.relative_theory or self.source.relative_to)
        formula = self.source.formula or (RATIO if relative else None)
        if formula is None:
            return value
        if relative:
            reference = self._reference(point)
        at = {"x": x, "y": value.mean, "r": reference.mean}
        error = abs(formula.slope("y", **at)) * value.error
        if relative:
            error = math.hypot(error, formula.slope("r", **at) * reference.error)
        if relative and value[:2] == reference[:2]:
            error = 0.0  # the reference itself
        return Value(formula(**at), error)
