# SPDX-License-Identifier: GPL-3.0-or-later
"""Panels as tables: lines of points with errors, by engine, theory or law."""
import math
from dataclasses import dataclass, field

import graingas as gg
import numpy as np

from . import entry as entries
from .points import Query, Value, key_number, meets

FINE = 41  # points of a smooth line
NODES, MISS = 9, 0.005  # of an interpolated line; what it may miss, over its rise
WORDS = {("collision.mu", "inf"): "∞", ("thermostat", "none"): "HCS", ("thermostat", "gaussian"): "HSS"}  # of lines
SERIES_POINTS = 100  # of a time series
SLABS, BLOCKS = 20, 10  # of a profile from frames
BIN_TOO_COARSE = 0.67  # points on a logarithmic axis with a larger relative error are not shown


@dataclass
class Line:
    method: str  # an engine, a theory, a law, a guide
    group: str  # "e = 0.9"; "" if the panel has one only
    style: str  # "points", "band" or "line"
    rows: list = field(default_factory=list)  # x, its error, y, its error, is the point converged?

    def put(self, x, y, error=math.nan, x_error=math.nan, converged=True):
        self.rows.append((x, x_error, y, error, converged))

    def sort(self):
        self.rows.sort(key=lambda row: row[0])

    @property
    def columns(self):
        return np.array([row[:4] for row in self.rows], float).reshape(-1, 4).T


class Table:
    """The data of a panel."""

    def __init__(self, panel, points):
        self.of, self.points, self.lines = panel, points, []
        self.x_label = self.y_label = self.x_unit = self.y_unit = ""
        self.unconverged = []  # (engine, point)
        fill = {"quantity": self._over_points, "number": self._over_points, "curve": self._curves, "series": self._series,
                "frames": self._frames, "snapshot": lambda: None}
        fill[panel.source.kind]()
        self._guides()
        self._label_axes()

    def _add(self, method, group, style):
        for line in self.lines:
            if (line.method, line.group) == (method, group) and style == "points":
                return line
        self.lines.append(Line(method, group, style))
        return self.lines[-1]

    def _x(self, raw):
        return self.of.x.formula(x=raw) if self.of.x.formula else raw

    def takes(self, point):
        return (not self.of.sweeps or point.sweep in self.of.sweeps) and meets(point.scene, self.of.where)

    def _each(self):
        """Engine by engine, the points of the panel."""
        for engine in entries.ENGINES:
            for point in self.points:
                if engine in point.engines and (not self.of.engines or engine in self.of.engines) and self.takes(point):
                    if not point.converged(engine):
                        self.unconverged.append((engine, point))
                    yield engine, point

    def group(self, point, name):
        """Name of the line of a point: `name` if the panel has several sources, and the values of its scene keys."""
        parts = [name] if len(self.of.source.names) > 1 and name else []
        for key, label in self.of.lines.items():
            value = point.scene.text_of(key)
            if self.of.line_formula:
                value = f"{self.of.line_formula(v=key_number(point.scene, key)):.6g}"
            value = WORDS.get((key, value), value)
            parts.append(f"{label} = {value}" if label else value)
        return ", ".join(parts)

    def _over_points(self):
        source = self.of.source
        for engine, point in self._each():
            for i, name in enumerate(source.names):
                raw, x_error = key_number(point.scene, self.of.key) if self.of.key else math.nan, math.nan
                if self.of.x_number:
                    raw, x_error, _ = point.curve_number(engine, name, self.of.x_number)
                    x_error *= abs(self.of.x.formula.slope("x", x=raw)) if self.of.x.formula else 1
                x = self._x(raw)
                y = Query(self.points, source, name, engine).at(point, x)
                shown = symbol(name) if source.kind == "quantity" else curve_text(source, i, point, engine)
                group = self.group(point, "" if self.of.x_number else shown)
                if y.unit and not self.y_unit and not (source.formula or source.relative_to or source.relative_theory):
                    self.y_unit = y.unit
                if math.isfinite(x) and math.isfinite(y.mean):
                    self._add(engine, group, "points").put(x, y.mean, y.error, x_error, point.converged(engine))
        for line in self.lines:
            line.sort()
        for theory in self.of.theories:
            for name in source.names:
                self._theory(theory, name)

    def _theory(self, theory, name):
        groups = {}
        for point in filter(self.takes, self.points):
            groups.setdefault(self.group(point, symbol(name)), []).append(point)
        for group, points in groups.items():
            if not any((line.method, line.group) == (theory, group) for line in self.lines):
                self._theory_line(theory, name, group, points)

    def _theory_line(self, theory, name, group, points):
        """Curve of a theory with abscissae of its own if the points differ in the key alone, else through its values at
        the points."""
        line, source, at = self._add(theory, group, "line"), self.of.source, {k: v[0] for k, v in self.of.theories_at.items()}

        def value(key, point=points[0], changes=at):
            return Query(self.points, source, name, theory=theory, changes=changes).at(point, self._x(key))

        def elsewhere(key):
            return value(key, changes={self.of.key: f"{key:.15g}", **at})

        keys = [key_number(point.scene, self.of.key) for point in points]
        here = [value(key, point) for key, point in zip(keys, points)]
        found = zip(keys, here)
        known = [key for key, y in zip(keys, here) if math.isfinite(key) and math.isfinite(y.mean)]
        if known and min(known) < max(known) and all(_differ_in(points[0], p, self.of.key) for p in points):
            solved = theory.startswith("enskog_hermite") or any(y.error > 0 for y in here)
            ends = min(known), max(known)
            found = solved and interpolated(elsewhere, *ends, self.of.x.log, zip(keys, here)) or [
                (key, elsewhere(key)) for key in fine(*ends, self.of.x.log)]
        for key, y in found:
            self._put_theory(line, self._x(key), y)
        line.sort()

    @staticmethod
    def _put_theory(line, x, y):
        if math.isfinite(x) and math.isfinite(y.mean):
            line.put(x, y.mean, y.error if y.error > 0 else math.nan)

    def _transformed(self, x, mean, error):
        formula = self.of.source.formula
        if not formula:
            return Value(mean, error)
        return Value(formula(x=x, y=mean, r=0), abs(formula.slope("y", x=x, y=mean, r=0)) * error)

    def _is_shown(self, x, y, counted):
        """False outside the axes, for bins without counts, on logarithmic axes for errors as large as the value."""
        if not (math.isfinite(x) and math.isfinite(y.mean) and counted):
            return False
        inside = not self.of.x.range or self.of.x.range[0] <= x <= self.of.x.range[1]
        return inside and (not self.of.y.log or (y.mean > 0 and not y.error > BIN_TOO_COARSE * y.mean))

    def _curves(self):
        for engine, point in self._each():
            for name in self.of.source.names:
                curve = point.curves(engine).get(name)
                if curve is None:
                    continue
                group = self.group(point, curve.label or name)
                self.x_label, self.y_label = curve.x_name or "", curve.y_name or ""
                self.x_unit = self.x_unit if self.of.x.formula else curve.x_unit or ""
                self.y_unit = self.y_unit if self.of.source.formula else curve.unit or ""
                line = self._add(engine, group, "band")
                for x, mean, error in zip(curve.x.tolist(), curve.value.tolist(), curve.error.tolist()):
                    x = self._x(x)
                    y = self._transformed(x, mean, error)
                    if self._is_shown(x, y, mean != 0 or math.isfinite(error)):
                        line.put(x, *y[:2], converged=point.converged(engine))
                self._law(curve)
        for theory in self.of.theories:
            for point in filter(self.takes, self.points):
                for name in self.of.source.names:
                    if name in point.theory_curves(theory):
                        self._theory_curve(theory, point, point.theory_curves(theory)[name])

    def _theory_curve(self, theory, point, curve):
        line = self._add(theory, self.group(point, curve.label or curve.name), "line")
        for x, mean, error in zip(map(self._x, curve.x.tolist()), curve.value.tolist(), curve.error.tolist()):
            y = self._transformed(x, mean, error)
            if self._is_shown(x, y, True):
                self._put_theory(line, x, y)

    def _law(self, curve):
        """Add the curve's law, once per panel."""
        if curve.law is None or not self.of.source.beside or any(line.method == curve.law_label for line in self.lines):
            return
        line, (low, high) = self._add(curve.law_label, "", "line"), self.of.y.range or (-math.inf, math.inf)
        for x, value in zip(map(self._x, curve.x.tolist()), curve.law.tolist()):
            y = self._transformed(x, value, 0)
            if low <= y.mean <= high and self._is_shown(x, y, True):
                line.put(x, y.mean)

    def _series(self):
        self.x_label = "time"
        low, high = self.of.x.range or (-math.inf, math.inf)
        for engine, point in self._each():
            for name in self.of.source.names:
                try:
                    time, value = point.engines[engine].history(name)
                except gg.BadInput:
                    continue
                unit = point.quantity(engine, name).unit
                self.y_unit = self.y_unit or ("" if self.of.source.formula else unit)
                inside = [k for k, t in enumerate(time.tolist()) if low <= self._x(t) <= high]
                line = self._add(engine, self.group(point, symbol(name)), "band")
                for k in inside[::len(inside) // SERIES_POINTS + 1]:
                    x = self._x(time[k].item())
                    y = self._transformed(x, value[k].item(), math.nan)
                    if math.isfinite(y.mean):
                        line.put(x, y.mean)

    def _frames(self):
        """Laboratory velocity over shear rate times box height, across a sheared box: means over slabs. Errors are from
        the scatter of blocks of frames, because waves of the flow outlast the time between two frames."""
        for engine, point in self._each():
            line = self._add(engine, self.group(point, ""), "points")
            for k, (mean, error) in enumerate(zip(*_profile(gg.trajectory(point.file)))):
                line.put((k + 0.5) / SLABS - 0.5, mean, error, converged=point.converged(engine))

    def _guides(self):
        ends = [x for line in self.lines for x in line.columns[0].tolist()]
        low, high = self.of.x.range or (min(ends, default=0), max(ends, default=0))
        for label, formula in self.of.guides.items():
            if low < high:
                line = self._add(label, "", "line")
                for x in fine(low, high, self.of.x.log):
                    self._put_theory(line, x, Value(formula(x=x), math.nan))

    def _label_axes(self):
        of = self.of
        if of.x.label:
            self.x_label = of.x.label
        elif of.key:
            self.x_label = entries.key_label(of.key)
        elif of.x_number:
            self.x_label = of.x_number
        if of.y.label:
            self.y_label = of.y.label
        elif of.source.kind == "number":
            self.y_label = of.source.number
        elif not self.y_label:
            self.y_label = symbol(of.source.names[0])


def symbol(name):
    return entries.QUANTITIES[name].symbol if name in entries.QUANTITIES else name


def curve_text(source, i, point, engine):
    """Label of the i-th curve: the label or x_name of its file if that is unique among the curves, else its name."""
    curves = [point.curves(engine).get(name) for name in source.names]
    for attribute in "label", "x_name":
        texts = [getattr(curve, attribute, None) or "" for curve in curves]
        if texts[i] and texts.count(texts[i]) == 1:
            return texts[i]
    return source.names[i]


def fine(low, high, log):
    for i in range(FINE):
        u = i / (FINE - 1)
        yield low * (high / low) ** u if log and low > 0 else low + u * (high - low)


def interpolated(value, low, high, log, known):
    """A solution that takes seconds a point, on a smooth curve: the polynomial through its values at NODES abscissae of
    Chebyshev. None where it misses the values that are known."""
    def unit(key):
        return (math.log(key / low) / math.log(high / low) if log and low > 0 else (key - low) / (high - low)) * 2 - 1

    nodes = -np.cos(np.pi * np.arange(NODES) / (NODES - 1))
    keys = [low * (high / low) ** u if log and low > 0 else low + u * (high - low) for u in (nodes + 1) / 2]
    y = np.array([value(key).mean for key in keys])
    if not np.isfinite(y).all():
        return None
    series = np.polynomial.Chebyshev.fit(nodes, y, NODES - 1, domain=[-1, 1])
    if any(abs(series(unit(key)) - v.mean) > MISS * (y.max() - y.min()) for key, v in known if math.isfinite(v.mean)):
        return None
    return [(key, Value(float(series(unit(key))), math.nan)) for key in fine(low, high, log)]


def _differ_in(a, b, key):
    """Whether two points differ in the key alone, apart from keys of `run`, on which theories do not depend."""
    other = a.scene.copy()
    try:
        other[key] = b.scene.text_of(key)
    except gg.BadInput:
        return False
    return all(other.text_of(k) == b.scene.text_of(k) for k in a.varied if not k.startswith("run."))


def _profile(trajectory):
    sums, counts = np.zeros((BLOCKS, SLABS)), np.zeros((BLOCKS, SLABS))
    for k, frame in enumerate(trajectory):
        edge = frame.state.box[1]
        height = frame.grains.position[:, 1] / edge % 1
        slab, block = (height * SLABS).astype(int) % SLABS, k * BLOCKS // len(trajectory)
        sums[block] += np.bincount(slab, frame.grains.velocity[:, 0] / edge + height - 0.5, SLABS)
        counts[block] += np.bincount(slab, minlength=SLABS)
    with np.errstate(invalid="ignore"):
        means = sums / counts
    n = np.sum(counts > 0, 0)
    return np.nanmean(means, 0), np.nanstd(means, 0) / np.sqrt(n - 1)
