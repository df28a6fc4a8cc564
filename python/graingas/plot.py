# SPDX-License-Identifier: GPL-3.0-or-later
"""Pictures with matplotlib, in one style. Every function returns the axes; axes.figure.savefig("x.pdf") writes them."""
from __future__ import annotations

import functools
import itertools
import re

import numpy as np

from . import catalogue
from .errors import not_found
from .scene import SHORT

# Okabe and Ito's colours, told apart by the colour-blind: md, dsmc, then the theories.
COLOURS = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000"]
MARKERS = "os^vD<>"
DASHES = ["-", "--", "-.", ":"]
STYLE = {"axes.spines.top": False, "axes.spines.right": False, "axes.labelsize": 9, "xtick.labelsize": 8,
         "ytick.labelsize": 8, "legend.fontsize": 8, "legend.frameon": False, "font.size": 9, "lines.linewidth": 1,
         "lines.markersize": 4, "errorbar.capsize": 2, "pdf.fonttype": 42, "svg.fonttype": "none",
         "savefig.bbox": "tight"}


def styled(function):
    """Context in which matplotlib has the style."""
    @functools.wraps(function)
    def draw(*arguments, **options):
        import matplotlib
        with matplotlib.rc_context(STYLE):
            return function(*arguments, **options)
    return draw


@styled
def new_axes(ax=None):
    """The axes given, or new ones of the width of a column."""
    if ax is not None:
        return ax
    from matplotlib import pyplot
    figure, ax = pyplot.subplots(figsize=(3.4, 2.6), dpi=120, layout="constrained")
    ax.set_prop_cycle(color=COLOURS)
    return ax


def legend(ax):
    """Adds a legend inside the axes; beside them where it is long."""
    entries = len(ax.get_legend_handles_labels()[1])
    if entries <= 4:
        ax.legend()
        return
    ax.legend(loc="upper left", bbox_to_anchor=(1.02, 1), borderaxespad=0)
    ax.figure.set_size_inches(5.4, max(2.6, 0.4 + 0.2 * entries))


def unit_text(unit):
    """d^2 gamma^2 as mathematics."""
    greek = re.sub(r"\b(gamma|rho)(?=\b|_)", r"\\\1", unit)
    return f"${greek}$" if re.fullmatch(r"[\w^\\ /()]+", greek) else unit


def symbol_text(name, symbol=None):
    """A symbol as mathematics; without one the name."""
    return f"${symbol}$" if symbol else name


def label(name, unit=None, symbol=None):
    text = symbol_text(name, symbol)
    return text if unit in (None, "", "1") else f"{text} [{unit_text(unit)}]"


def time_label(quantities):
    """Label of a time axis: the unit of time is that of a rate, inverted. quantities: those of the scene's results."""
    rate = quantities["collision_rate"].unit
    return label("time", "d/v_0" if rate == "v_0/d" else f"1/{rate}" if " " not in rate else f"1/({rate})")


def errors(values):
    """Error bars; none where the error is unknown."""
    return np.nan_to_num(np.asarray(values, float), posinf=0)


@styled
def plot_history(result, quantity, ax=None, **style):
    ax = new_axes(ax)
    time, values = result.history(quantity)
    ax.plot(time, values, **{"label": result.engine, "linewidth": 0.8, **style})
    found = result.find(quantity)
    ax.set(xlabel=time_label(catalogue.quantities(result.scene)), ylabel=label(quantity, found.unit, found.symbol))
    known = values[np.isfinite(values)]
    if len(known) and 0 < 100 * known.min() < known.max():  # free cooling: a power of time
        ax.set(xscale="log", yscale="log")
    return ax


def _scales(curve, ax):
    positive = np.nanmin(curve.value) > 0 if len(curve) else False
    ax.set(xlabel=label(curve.x_name, curve.x_unit), ylabel=label(curve.y_name, curve.unit),
           xscale="log" if curve.log_x and np.nanmin(curve.x) > 0 else "linear",
           yscale="log" if curve.log_y and positive else "linear")


@styled
def plot_curve(curve, ax=None, **style):
    ax = new_axes(ax)
    ax.errorbar(curve.x, curve.value, errors(curve.error), **{"fmt": ".", "label": curve.label or curve.name, **style})
    if curve.law is not None:
        ax.plot(curve.x, curve.law, color="grey", linewidth=0.8, label=curve.law_label)
    _scales(curve, ax)
    legend(ax)
    return ax


@styled
def plot_curve_set(curves, ax=None):
    ax = new_axes(ax)
    for i, (source, curve) in enumerate(curves.items()):
        if source in ("md", "dsmc"):
            ax.errorbar(curve.x, curve.value, errors(curve.error), fmt=MARKERS[i], mfc="none", label=source, color=COLOURS[i])
        else:
            ax.plot(curve.x, curve.value, DASHES[i % 4], label=source, color=COLOURS[i % 7])
    _scales(curve, ax)
    legend(ax)
    return ax


@styled
def plot_local_fluxes(found, fluxes, axes=None):
    """Measured fluxes as points, those of closures at the measured profiles as lines; a panel each."""
    if axes is None:
        from matplotlib import pyplot
        axes = pyplot.subplots(1, len(fluxes), figsize=(3.2 * len(fluxes), 2.6), dpi=120, layout="constrained")[1]
    axes = np.atleast_1d(axes)
    for ax, flux in zip(axes, fluxes):
        ax.errorbar(found.y, found.measured[flux], errors(found.error[flux]), fmt="o", mfc="none", color=COLOURS[0],
                    label="measured")
        for i, (name, answers) in enumerate(found.theory.items(), 1):
            ax.plot(found.y, answers[flux], DASHES[i % 4], color=COLOURS[i % 7], label=name)
        ax.set(xlabel=label("y", found.units["y"]), ylabel=label(flux, found.units[flux], re.sub("_(.+)", r"_{\1}", flux)))
        legend(ax)
    return axes


def _main_quantities(comparison):
    return [name for name, row in comparison.items() if any(d.headline for d in row.departure.values())] or \
        [name for name in comparison if not np.isnan(_reference(comparison[name]).mean)][:10]


def _reference(row):
    return row.dsmc if np.isnan(row.md.mean) else row.md


FAR = 0.5  # ratios further from 1 than this do not set the scale


def _scale(ax, ratios):
    """Sets the limits by the ratios near 1, and marks the others at the edge: a theory without N1 does not squash the
    rest."""
    near = [abs(r - 1) for solver in ratios for r in solver[0] if abs(r - 1) <= FAR]
    span = 1.2 * max([0.02, *near])
    ax.set_ylim(1 - span, 1 + span)
    for solver, colour in ratios:
        for x, ratio in enumerate(solver):
            if abs(ratio - 1) > span:
                ax.plot(x, 1 + np.sign(ratio - 1) * 0.97 * span, "^" if ratio > 1 else "v", color=colour)


@styled
def plot_comparison(comparison, quantities=None, ax=None):
    """Each solver over md (or dsmc), quantity by quantity."""
    ax = new_axes(ax)
    names = [quantities] if isinstance(quantities, str) else quantities or _main_quantities(comparison)
    reference = [_reference(comparison[name]).mean for name in names]
    x, ratios = np.arange(len(names)), []
    for i, engine in enumerate(("md", "dsmc")):
        if getattr(comparison, engine) is not None:
            rows = [getattr(comparison[name], engine) for name in names]
            mean, error = np.array([[r.mean, r.error] for r in rows]).T / np.array(reference)
            ax.errorbar(x, mean, errors(abs(error)), fmt=MARKERS[i], mfc="none", color=COLOURS[i], label=engine)
            ratios.append((mean, COLOURS[i]))
    theories = [theory for theory in comparison.theories.values() if any(name in theory for name in names)]
    for i, theory in enumerate(theories, 2):
        answers = [theory[name] / m if name in theory else np.nan for name, m in zip(names, reference)]
        ax.plot(x, answers, "_", markersize=9, color=COLOURS[i % 7], label=theory.name)
        ratios.append((answers, COLOURS[i % 7]))
    _scale(ax, ratios)
    ax.axhline(1, color="grey", linewidth=0.5)
    texts = [symbol_text(name, comparison[name].symbol) for name in names]
    letters = max(len(re.sub(r"\\[a-zA-Z]+", "x", text).translate(dict.fromkeys(b"${}^"))) for text in texts)
    crowded = letters * len(texts) > 60  # in the width of a column the texts would overlap
    ax.set_xticks(x, texts, **(dict(rotation=60, ha="right") if crowded else {}))
    ax.set(ylabel="ratio to md" if comparison.md is not None else "ratio to dsmc")
    legend(ax)
    return ax


def _lines(grid, over):
    """Every combination of solver and of the keys that are not along x: its label, and its index in the arrays."""
    others = [dim for dim in grid.dims if dim != over]
    for places in itertools.product(*(range(len(grid.coords[dim])) for dim in others)):
        at = dict(zip(others, places))
        solver = grid.coords["solver"][at["solver"]]
        keys = ", ".join(f"{dim} {grid.coords[dim][i]}" for dim, i in at.items() if dim != "solver")
        yield solver, keys, tuple(slice(None) if dim == over else at[dim] for dim in grid.dims)


def _axis(grid, over):
    """The varied key along x; None: the one with the most values."""
    keys = [dim for dim in grid.dims if dim != "solver"]
    if over is None:
        return max(keys, key=lambda dim: len(grid.coords[dim]))
    if SHORT.get(over, over) not in keys:
        raise not_found("varied key", over, keys)
    return SHORT.get(over, over)


def _relative(grid, quantity, solver):
    """Means and errors, divided by those of a solver if one is named."""
    mean, error = grid[quantity], grid[quantity + "_error"]
    if solver is None:
        return mean, error
    solvers = grid.coords["solver"]
    if solver not in solvers:
        raise not_found("solver", solver, solvers)
    base = np.take(mean, [solvers.index(solver)], -1)
    return mean / base, error / abs(base)


@styled
def plot_sweep(grid, quantity, over=None, relative_to=None, ax=None):
    over = _axis(grid, over)
    if quantity not in grid.units:
        raise not_found("quantity", quantity, [name for name in grid.values if not name.endswith("_error")])
    ax = new_axes(ax)
    mean, error = _relative(grid, quantity, relative_to)
    solvers = grid.coords["solver"]
    combinations = []
    for solver, keys, at in _lines(grid, over):
        if np.all(np.isnan(mean[at])):
            continue
        combinations += [keys] if keys not in combinations else []
        colour, form = solvers.index(solver), combinations.index(keys)
        style = dict(fmt=MARKERS[form % 7], mfc="none") if solver in ("md", "dsmc") else dict(fmt=DASHES[form % 4])
        ax.errorbar(grid.coords[over], mean[at], errors(error[at]), color=COLOURS[colour % 7],
                    label=f"{solver}, {keys}" if keys else solver, **style)
    symbol = getattr(catalogue.quantities().get(quantity), "symbol", None)
    ax.set(xlabel=over, ylabel=f"{symbol_text(quantity, symbol)} / {relative_to}" if relative_to
           else label(quantity, grid.units[quantity], symbol))
    legend(ax)
    return ax
