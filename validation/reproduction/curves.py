# SPDX-License-Identifier: GPL-3.0-or-later
"""Numbers taken from curves."""
import math

import numpy as np

DECAYS = "power", "exponential", "misfit of power", "misfit of exponential"
WORDS = "first", "middle", "last", "largest", "smallest", "edge_over_middle", "deviation", "skewness"


def _moment(x, weight, k):
    mean = (x * weight).sum() / weight.sum()
    return ((x - mean) ** k * weight).sum() / weight.sum()


def decay(curve, law, low, high):
    """Slope of ln y over ln x ("power") or over x ("exponential") from low to high, by least squares with the errors of
    the points; "misfit of power", "misfit of exponential": root mean square of ln y about that line. Errors of slopes
    include the misfit."""
    with np.errstate(invalid="ignore", divide="ignore"):
        used = (curve.x >= low) & (curve.x <= high) & (curve.value > 0) & (curve.error > 0) & (curve.error < 0.5 * curve.value)
    x, v, w = curve.x[used], np.log(curve.value[used]), (curve.value[used] / curve.error[used]) ** 2
    if len(x) < 4:
        return math.nan, math.nan
    x = np.log(x) if "power" in law else x
    mean = (w * x).sum() / w.sum()
    slope = (w * (x - mean) * v).sum() / (w * (x - mean) ** 2).sum()
    left = v - (w * v).sum() / w.sum() - slope * (x - mean)
    if law.startswith("misfit"):
        return math.sqrt((left**2).mean()), math.nan
    scale = max(1, (w * left**2).sum() / (len(x) - 2))
    return slope, math.sqrt(scale / (w * (x - mean) ** 2).sum())


def take(curve, what):
    """Value and error (NaN: unknown). what: a word, an abscissa, a range: the share of a distribution in it, in percent,
    or a law of decay and its range."""
    if isinstance(what, list) and isinstance(what[0], str):
        return decay(curve, *what)
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
