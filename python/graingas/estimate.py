# SPDX-License-Identifier: GPL-3.0-or-later
"""Means with their standard errors."""
from __future__ import annotations

import functools
import math

from . import _c
from .errors import text
from .structs import value

ffi, lib = _c.ffi, _c.lib


def format_estimate(mean, error):
    """1.234, 0.0041 -> "1.2340(41)"; an unknown error is (?)."""
    buffer = ffi.new("char[]", 64)
    lib.gg_format_estimate(mean, error, buffer, len(buffer))
    return text(buffer)


def _with_number(method):
    """Arrays, and what is no number, are left to the other operand."""
    @functools.wraps(method)
    def operator(self, other):
        if isinstance(other, str) or getattr(other, "ndim", 0) or not hasattr(other, "__float__"):
            return NotImplemented
        return method(self, other)
    return operator


class Estimate:
    """A mean with its standard error.

    mean, error   numbers in `unit`; NaN error: the run is too short to know it
    tau           correlation time, in `tau_unit`; NaN: unknown
    samples       number of samples
    reason        why there is no mean; None if there is one
    symbol        of the quantity, LaTeX: f"${e.symbol}$"; None: a number of a curve or a quantity of your own
    u             the same as a number of uncertainties, correlated with the means of the run whose `u` was used before.
                  Of two means every combination has the error of the operators below; of more, nearly

    + - * / ** and np.sqrt give estimates. Errors add up linearly: means of different runs are independent, those of one
    run have a covariance. The error is NaN where that is not known, and where a sum of several means nearly cancels.
    float(), and so functions of `math`, take the mean alone, without its error: use np.sqrt or ** 0.5, and for other
    functions `u` with uncertainties.umath.
    """

    __slots__ = ("name", "mean", "error", "unit", "tau", "tau_unit", "samples", "reason", "symbol", "_source", "_terms")

    def __init__(self, mean, error, unit="1", name="", tau=math.nan, tau_unit="", samples=0, reason=None, symbol=None,
                 source=None):
        self.name, self.mean, self.error, self.unit = name, mean, error, unit
        self.tau, self.tau_unit, self.samples, self.reason, self.symbol = tau, tau_unit, samples, reason, symbol
        self._source, self._terms = source, None

    @classmethod
    def _of(cls, found, source=None):
        """From a gg_measurement."""
        return cls(found.mean, found.error, value(found.unit) or "1", value(found.name), found.correlation_time,
                   value(found.correlation_time_unit) or "", found.samples, value(found.reason),
                   value(found.symbol), source)

    @property
    def u(self):
        from uncertainties import ufloat
        if self._terms is not None:
            return self.mean + sum(d * (e.u - e.mean) for d, e in self._terms.values() if d)
        made = self._source._correlated.number(self.name) if self._source is not None else None
        return made if made is not None else ufloat(self.mean, self.error, tag=self.name or None)

    def __float__(self):
        return float(self.mean)

    def __str__(self):
        if math.isnan(self.mean):
            return f"- ({self.reason})" if self.reason else "-"
        return format_estimate(self.mean, self.error)

    def __repr__(self):
        unit = "" if self.unit in ("1", "") or math.isnan(self.mean) else " " + self.unit
        return str(self) + unit

    def __format__(self, form):
        return format(str(self) if form == "" or form[-1] in "s<>^0123456789" else float(self), form)

    def _derivatives(self):
        return self._terms if self._terms is not None else {_key(self): (1.0, self)}

    def _combined(self, other, function, by_self, by_other, unit):
        terms = {key: (by_self * d, e) for key, (d, e) in self._derivatives().items()}
        if isinstance(other, Estimate):
            for key, (d, e) in other._derivatives().items():
                terms[key] = (terms.get(key, (0.0,))[0] + by_other * d, e)
        made = Estimate(function, _error(list(terms.values())), unit)
        made._terms = terms
        return made

    @_with_number
    def __add__(self, other):
        return self._combined(other, self.mean + float(other), 1, 1, self.unit)

    @_with_number
    def __sub__(self, other):
        return self._combined(other, self.mean - float(other), 1, -1, self.unit)

    @_with_number
    def __rsub__(self, other):
        return self._combined(None, float(other) - self.mean, -1, 0, self.unit)

    @_with_number
    def __mul__(self, other):
        b = float(other)
        return self._combined(other, self.mean * b, b, self.mean, _unit(self, other, " "))

    @_with_number
    def __truediv__(self, other):
        b = float(other)
        return self._combined(other, self.mean / b, 1 / b, -self.mean / b**2, _unit(self, other, " / "))

    @_with_number
    def __rtruediv__(self, other):
        a = float(other)
        return self._combined(None, a / self.mean, -a / self.mean**2, 0, f"1 / ({self.unit})" if self.unit != "1" else "1")

    @_with_number
    def __pow__(self, power):
        power = float(power)
        unit = f"({self.unit})^{power:g}" if self.unit != "1" else "1"
        return self._combined(None, self.mean**power, power * self.mean ** (power - 1), 0, unit)

    def sqrt(self):
        """For np.sqrt."""
        return self**0.5

    def __neg__(self):
        return self._combined(None, -self.mean, -1, 0, self.unit)

    def __abs__(self):
        return -self if self.mean < 0 else self

    __radd__, __rmul__ = __add__, __mul__


def _key(estimate):
    """What two estimates that are the same mean share."""
    return (id(estimate._source), estimate.name) if estimate._source is not None else id(estimate)


def _unit(a, b, between):
    other = getattr(b, "unit", "1")
    if other == "1":
        return a.unit
    if between == " / ":
        return "1" if a.unit == other else f"{a.unit} / ({other})"
    return other if a.unit == "1" else f"{a.unit} {other}"


def _error(terms):
    """Standard error of a sum of derivative times estimate."""
    variance = independent = sum(d**2 * e.error**2 for d, e in terms if d)
    for i, (d, a) in enumerate(terms):
        for f, b in terms[:i]:
            if d and f and a._source is not None and a._source is b._source:
                variance += 2 * d * f * a._source._covariance(a.name, b.name)
    if -1e-12 * independent <= variance < 0:  # rounding
        return 0.0
    return math.sqrt(variance) if variance >= 0 else math.nan
