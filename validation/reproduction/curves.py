# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers taken from curves."""
import math

import numpy as np

WORDS = "first", "middle", "last", "largest", "smallest", "edge_over_middle", "deviation", "skewness"


def _moment(x, weight, k):
    mean = (x * weight).sum() / weight.sum()
    return ((x - mean) ** k * weight).sum() / weight.sum()


def take(curve, what):
    """Value and error (NaN: unknown). what: a word, an abscissa, or a range: the share of a distribution in it, in
    percent."""
    known = np.isfinite(curve.value)
    x, value, error = curve.x[known], curve.value[known], curve.error[known]
    if not len(x):
        return math.nan, math.nan
    if isinstance(what, list):
        inside = (x >= what[0]) & (x <= what[1])
        return 100 * value[inside].sum() / value.sum(), math.nan
    if what in ("deviation", "skewness"):
        deviation = math.sqrt(_moment(x, value, 2))
        return (deviation if what == "deviation" else _moment(x, value, 3) / deviation**3), math.nan
    middle = abs(x - (x[0] + x[-1]) / 2)
    at = {"first": 0, "last": -1, "middle": middle.argmin(), "largest": value.argmax(), "smallest": value.argmin()}
    if what == "edge_over_middle":
        return float(value[0] / value[middle.argmin()]), math.nan
    i = at[what] if what in at else abs(x - what).argmin()
    return float(value[i]), float(error[i])
