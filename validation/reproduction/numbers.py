# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers of the text, computed from the points of a figure."""
import math
from dataclasses import dataclass

import numpy as np

from . import entry as entries
from .points import NOTHING, Query, Value, key_number, meets


@dataclass
class Row:
    """A number of the paper or of the verdict by one method; x: value of the key that it is over (NaN: none)."""
    number: entries.Number
    method: str
    x: float
    value: Value

    @property
    def z(self):
        if self.number.paper is None or self.method not in entries.ENGINES:
            return math.nan
        return (self.value.mean - self.number.paper) / math.hypot(self.value.error, self.number.paper_error)


def zero(x, y, e):
    """First zero of the polygon through the points."""
    for i in range(len(x) - 1):
        if not (y[i] * y[i + 1] <= 0) or y[i] == y[i + 1]:
            continue
        t, width = y[i] / (y[i] - y[i + 1]), x[i + 1] - x[i]
        return Value(x[i] + t * width, math.hypot((1 - t) * e[i], t * e[i + 1]) / abs((y[i + 1] - y[i]) / width))
    return NOTHING


def _top(x, y):
    """Abscissa of the extremum of the parabola through three points."""
    a, b = (y[1] - y[0]) / (x[1] - x[0]), (y[2] - y[1]) / (x[2] - x[1])
    return 0.5 * (x[0] + x[1]) - a / (2 * (b - a) / (x[2] - x[0]))


def extreme(x, y, e, least):
    """Abscissa of the least or largest y, by a parabola through it and its neighbours, in ln(x) if x is positive."""
    at = int(np.argmin(y) if least else np.argmax(y)) if len(y) else 0
    if len(x) < 3 or at in (0, len(x) - 1):
        return NOTHING
    x, y, e = x[at - 1:at + 2], y[at - 1:at + 2], e[at - 1:at + 2]
    log = x[0] > 0
    x = np.log(x) if log else x
    here = _top(x, y)
    moved = [_top(x, y + e * (np.arange(3) == k)) - here for k in range(3)]
    error = math.sqrt(sum(d * d for d in moved))
    return Value(math.exp(here), error * math.exp(here)) if log else Value(here, error)


def power(x, y, e, exponent):
    """A or B of y = A x^B, by least squares of ln(y) with the errors of the points."""
    with np.errstate(divide="ignore", invalid="ignore"):
        known = (x > 0) & (y > 0) & np.isfinite(e / y) & (e > 0)
    if known.sum() < 2:
        return NOTHING
    u, v, w = np.log(x[known]), np.log(y[known]), (y[known] / e[known]) ** 2
    s, sx, sy, sxx, sxy = w.sum(), (w * u).sum(), (w * v).sum(), (w * u * u).sum(), (w * u * v).sum()
    d = s * sxx - sx * sx
    if not d > 0:
        return NOTHING
    b = (s * sxy - sx * sy) / d
    a = math.exp((sy - b * sx) / s)
    return Value(b, math.sqrt(s / d)) if exponent else Value(a, a * math.sqrt(sxx / d))


FIND = {"zero": zero, "minimum": lambda *of: extreme(*of, True), "maximum": lambda *of: extreme(*of, False),
        "prefactor": lambda *of: power(*of, False), "exponent": lambda *of: power(*of, True)}


def _along(number, points, method):
    """(x, value) of every point that the number uses, by increasing x."""
    source, found = number.source, []
    query = Query(points, source, source.names[0], *((method, None) if method in entries.ENGINES else (None, method)))
    for point in points:
        if (number.sweep is not None and point.sweep != number.sweep) or not meets(point.scene, number.at):
            continue
        if query.engine and query.engine not in point.engines:
            continue
        x = key_number(point.scene, number.over) if number.over else 0.0
        x = number.x(x=x) if number.x else x
        value = query.at(point, x)
        if math.isfinite(x) and math.isfinite(value.mean):
            found.append((x, value))
    return sorted(found, key=lambda one: one[0])


def rows(entry, points):
    """One Row for each number and method; for a number over a key without `find`, one for each value of the key."""
    for number in entry.numbers:
        theories = number.theories if number.source.kind == "quantity" else []
        for method in [*entries.ENGINES, *theories]:
            found = _along(number, points, method)
            if number.find != "value":
                x, y, e = (np.array(column, float) for column in zip(*((x, *v[:2]) for x, v in found))) if found else [np.zeros(0)] * 3
                found = [(math.nan, FIND[number.find](x, y, e))]
            for x, value in found if number.over else found[:1]:
                if math.isfinite(value.mean):
                    yield Row(number, method, x if number.over else math.nan, value)
