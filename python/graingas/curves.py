# SPDX-License-Identifier: GPL-3.0-or-later
"""Curves of results: distributions, profiles, correlation functions, spectra."""
from __future__ import annotations

import functools

from . import _c
from .errors import ByName, lib, new_error
from .estimate import Estimate
from .structs import array, new, value

ffi = _c.ffi


class Curve:
    """A curve with its errors.

    x, value, error   (n,) numbers, NaN: no value, unknown error
    law, law_label    (n,) a curve to compare with, or None
    numbers           numbers derived from the curve: Estimate by name
    """

    def __init__(self, data, numbers=()):
        for name in "name", "observable", "panel", "label", "x_name", "x_unit", "y_name", "unit", "law_label":
            setattr(self, name, value(getattr(data, name)))
        self.log_x, self.log_y, self.samples = bool(data.log_x), bool(data.log_y), data.samples
        for name in "x", "value", "error", "law":
            setattr(self, name, array(getattr(data, name), data.n))
        self.numbers = {number.name: number for number in numbers}

    def __len__(self):
        return len(self.x)

    def __repr__(self):
        return f"<curve {self.name}: {self.y_name} over {self.x_name}, {len(self)} points>"

    def to_dataframe(self):
        """x, value, error (and law) as a pandas.DataFrame."""
        import pandas
        columns = {"x": self.x, "value": self.value, "error": self.error}
        if self.law is not None:
            columns["law"] = self.law
        return pandas.DataFrame(columns)

    def plot(self, ax=None, **style):
        """Draws the curve with matplotlib; returns the axes."""
        from .plot import plot_curve
        return plot_curve(self, ax, **style)


def _numbers(get, result, curve):
    k, found, error = 0, new("gg_measurement"), new_error()
    while get(k, found, error) == lib.GG_OK:
        yield Estimate._of(found, result, curve)
        k += 1


def curves_by_name(curves):
    return ByName.of("curve", curves, "; add the observable to the scene's key measure")


def curves_of(get, number, result=None):
    """All curves by name, from gg_result_curve and gg_result_curve_number, and their like."""
    found, i, error, data = curves_by_name({}), 0, new_error(), new("gg_curve_data")
    while get(i, data, error) == lib.GG_OK:
        curve = Curve(data, _numbers(functools.partial(number, i), result, value(data.name)))
        found[curve.name] = curve
        i += 1
    return found


def result_curves(result):
    return curves_of(functools.partial(lib.gg_result_curve, result._pointer),
                     functools.partial(lib.gg_result_curve_number, result._pointer), result)
