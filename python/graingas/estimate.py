# SPDX-License-Identifier: GPL-3.0-or-later
"""Means with their standard errors."""
from __future__ import annotations

import functools
import math
import operator
import re
import uuid

from . import _c, units
from .correlated import Correlated
from .errors import BadInput, text
from .structs import value

ffi, lib = _c.ffi, _c.lib

FIELDS = "name", "mean", "error", "unit", "tau", "tau_unit", "samples", "reason", "symbol"
AS_TEXT = re.compile(r"(.?[<>^])?\d*|.*s")  # of format(): a width, not a precision


def format_estimate(mean, error):
    """1.234, 0.0041 -> "1.2340(41)"; an unknown error is (?)."""
    buffer = ffi.new("char[]", 64)
    lib.gg_format_estimate(mean, error, buffer, len(buffer))
    return text(buffer)


def _with_number(method):
    """Arrays and objects that are no numbers are left to the other operand."""
    @functools.wraps(method)
    def operator(self, other):
        if isinstance(other, str) or getattr(other, "ndim", 0) or not hasattr(other, "__float__"):
            return NotImplemented
        return method(self, other)
    return operator


def _compared(by):
    @_with_number
    def compare(self, other):
        _need_like_units(self, other, "be compared")
        return by(float(self), float(other))
    return compare


class Origin:
    """The part of a run that a mean carries without the results: identity of the run, and covariances by two names."""

    def __init__(self, identity, rows):
        self.identity, self._rows = identity, rows

    def _covariance(self, a, b):
        return self._rows.get(a, {}).get(b, math.nan)

    def _row(self, name):
        return self._rows.get(name, {})


class Estimate:
    """A mean with its standard error.

    mean, error   numbers in `unit`; NaN error: the run is too short for one
    tau           correlation time, in `tau_unit`; NaN: unknown
    samples       number of samples
    reason        why there is no mean; None if there is one
    symbol        of the quantity, LaTeX: f"${e.symbol}$"; None: a number of a curve or a quantity of your own
    u             the same as a number of uncertainties, correlated with the means of the run whose `u` was used before.
                  Combinations of two means have the error of the operators below; those of more means nearly

    + - * / **, np.sqrt, np.log, np.log10 and np.exp give estimates. Errors add up linearly: means of different runs are
    independent, those of one run have a covariance, also if they were read twice, copied or pickled. The error is NaN
    where the covariance is not known, and where a sum of several means nearly cancels. + and - of unlike units raise
    BadInput; a plain number has the unit of the estimate.
    < <= > >= ==, and so max() and sorted(), compare means alone: whether two differ is (a - b).mean / (a - b).error.
    float(), round() and functions of `math` take the mean alone, without its error: use the functions above, and for
    others `u` with uncertainties.umath. f"{e}" has the error, f"{e:.3f}" is the mean.
    """

    __slots__ = (*FIELDS, "_source", "_curve", "_terms", "_token")

    def __init__(self, mean, error, unit="1", name="", tau=math.nan, tau_unit="", samples=0, reason=None, symbol=None,
                 source=None, curve=None):
        self.name, self.mean, self.error, self.unit = name, mean, error, unit
        self.tau, self.tau_unit, self.samples, self.reason, self.symbol = tau, tau_unit, samples, reason, symbol
        self._source, self._curve = source, curve  # the run, and of a number of a curve the curve
        self._terms = self._token = None

    @classmethod
    def _of(cls, found, source=None, curve=None):
        """From a gg_measurement."""
        return cls(found.mean, found.error, value(found.unit) or "1", value(found.name), found.correlation_time,
                   value(found.correlation_time_unit) or "", found.samples, value(found.reason),
                   value(found.symbol), source, curve)

    @property
    def u(self):
        from uncertainties import ufloat
        if self._terms is not None:
            return self.mean + sum(d * (e.u - e.mean) for d, e in self._terms.values() if d)
        made = Correlated.of(_key(self)[0]).number(self)
        return made if made is not None else ufloat(self.mean, self.error, tag=self.name or None)

    def _covariance_with(self, curve, name):
        """Covariance with another mean of the run; NaN: unknown, as for numbers of curves."""
        known = self._source is not None and self._curve is None and curve is None
        return self._source._covariance(self.name, name) if known else math.nan

    def __float__(self):
        return float(self.mean)

    def __round__(self, digits=None):
        return round(float(self), digits)

    def __str__(self):
        if math.isnan(self.mean):
            return f"- ({self.reason})" if self.reason else "-"
        return format_estimate(self.mean, self.error)

    def __repr__(self):
        unit = "" if self.unit in ("1", "") or math.isnan(self.mean) else " " + self.unit
        return str(self) + unit

    def __format__(self, form):
        return format(str(self) if AS_TEXT.fullmatch(form) else float(self), form)

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
        _need_like_units(self, other, "be added")
        return self._combined(other, self.mean + float(other), 1, 1, self.unit)

    @_with_number
    def __sub__(self, other):
        _need_like_units(self, other, "be subtracted")
        return self._combined(other, self.mean - float(other), 1, -1, self.unit)

    @_with_number
    def __rsub__(self, other):
        return self._combined(None, float(other) - self.mean, -1, 0, self.unit)

    @_with_number
    def __mul__(self, other):
        b = float(other)
        return self._combined(other, self.mean * b, b, self.mean, units.product(self.unit, _unit(other)))

    @_with_number
    def __truediv__(self, other):
        b = float(other)
        return self._combined(other, self.mean / b, 1 / b, -self.mean / b**2, units.ratio(self.unit, _unit(other)))

    @_with_number
    def __rtruediv__(self, other):
        a = float(other)
        return self._combined(None, a / self.mean, -a / self.mean**2, 0, units.ratio("1", self.unit))

    @_with_number
    def __pow__(self, power):
        _need_no_unit(power, "an exponent")
        x, p = float(self), float(power)
        y = _real_power(x, p)
        by_power = y * math.log(x) if isinstance(power, Estimate) and x > 0 else math.nan
        return self._combined(power, y, _slope(x, p), by_power, units.power(self.unit, p))

    @_with_number
    def __rpow__(self, base):
        _need_no_unit(self, "an exponent")
        a = float(base)
        y = _real_power(a, float(self))
        return self._combined(None, y, y * math.log(a) if a > 0 else math.nan, 0, "1")

    def sqrt(self):
        """For np.sqrt."""
        return self**0.5

    def log(self):
        """For np.log: the logarithm of the number in `unit`."""
        return self._combined(None, _logarithm(self.mean), _slope(self.mean, 0, 1), 0, "1")

    def log10(self):
        """For np.log10."""
        return self.log() / math.log(10)

    def exp(self):
        """For np.exp."""
        _need_no_unit(self, "the argument of exp")
        y = math.exp(self.mean)
        return self._combined(None, y, y, 0, "1")

    def __neg__(self):
        return self._combined(None, -self.mean, -1, 0, self.unit)

    def __pos__(self):
        return self

    def __abs__(self):
        return -self if self.mean < 0 else self

    __radd__, __rmul__ = __add__, __mul__
    __lt__, __le__, __gt__, __ge__ = map(_compared, (operator.lt, operator.le, operator.gt, operator.ge))

    @_with_number
    def __eq__(self, other):
        return float(self) == float(other) and (not isinstance(other, Estimate) or units.alike(self.unit, other.unit))

    def __hash__(self):
        return hash(float(self))

    def __copy__(self):
        _key(self)
        made = Estimate.__new__(Estimate)
        for name in Estimate.__slots__:
            setattr(made, name, getattr(self, name))
        return made

    def __deepcopy__(self, memo):
        return self.__copy__()

    def __reduce__(self):
        """Pickles the covariances with other means of the run, not the run itself."""
        fields = tuple(getattr(self, name) for name in FIELDS)
        if self._terms is not None:
            return _restored, (fields, None, list(self._terms.values()))
        identity = _key(self)[0]
        row = self._source._row(self.name) if self._source is not None and self._curve is None else None
        return _restored, (fields, (identity, self._curve, row), None)


def _restored(fields, origin, terms):
    made = Estimate.__new__(Estimate)
    for name, member in zip(FIELDS, fields):
        setattr(made, name, member)
    made._source = made._curve = made._terms = made._token = None
    if terms is not None:
        made._terms = {_key(e): (d, e) for d, e in terms}
        return made
    identity, made._curve, row = origin
    if row is None and made._curve is None:
        made._token = identity
    else:
        made._source = Origin(identity, {made.name: row or {}})
    return made


def _key(estimate):
    """Key that is equal for two estimates of the same mean: their run (without a run: a token); curve; name."""
    if estimate._source is not None:
        return estimate._source.identity, estimate._curve, estimate.name
    if estimate._token is None:
        estimate._token = uuid.uuid4().hex
    return estimate._token, None, estimate.name


def _unit(other):
    return getattr(other, "unit", "1")


def _need_like_units(a, b, what):
    if isinstance(b, Estimate) and not units.alike(a.unit, b.unit):
        names = " and ".join(f"{e.name or e!s} [{e.unit}]" for e in (a, b))
        raise BadInput(f"{names} cannot {what}: their units differ (float() gives the number alone)")


def _need_no_unit(a, what):
    if isinstance(a, Estimate) and not units.alike(a.unit, "1"):
        raise BadInput(f"{a.name or str(a)} [{a.unit}] cannot be {what}: it has a unit (float() gives the number alone)")


def _real_power(x, p):
    y = x**p
    return math.nan if isinstance(y, complex) else y


def _slope(x, p, factor=None):
    """Derivative of x^p, or factor times x^(p - 1); NaN where there is none."""
    factor = p if factor is None else factor
    try:
        return factor * _real_power(x, p - 1) if factor else 0.0
    except ZeroDivisionError:
        return math.nan


def _logarithm(x):
    return math.log(x) if x > 0 else -math.inf if x == 0 else math.nan


def _of_one_run(a, b):
    return a._source is not None and b._source is not None and a._source.identity == b._source.identity


def _covariance(a, b):
    """Covariance of two different means of one run; NaN: unknown."""
    found = a._covariance_with(b._curve, b.name)
    return found if math.isfinite(found) else b._covariance_with(a._curve, a.name)


def _error(terms):
    """Standard error of a sum of terms derivative times estimate."""
    variance = independent = sum(d**2 * e.error**2 for d, e in terms if d)
    for i, (d, a) in enumerate(terms):
        for f, b in terms[:i]:
            if d and f and _of_one_run(a, b):
                variance += 2 * d * f * _covariance(a, b)
    if -1e-12 * independent <= variance < 0:  # rounding
        return 0.0
    return math.sqrt(variance) if variance >= 0 else math.nan
