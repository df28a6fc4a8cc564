# SPDX-License-Identifier: GPL-3.0-or-later
"""Theories without simulation: for one scene, and over a grid of scenes."""
from __future__ import annotations

import itertools
import math
import numbers
from decimal import Decimal

import numpy as np

from . import _c, calls, catalogue, yaml
from .comparison import Comparison, Theory
from .errors import BadInput, NotFound, check, encode, lib, not_found
from .run import serving
from .scene import SHORT, as_scene

ffi = _c.ffi


def _evaluate(scene, name=None):
    """All theories, or those of these names. Raises NotFound for an unknown one."""
    call, made = calls.Call(), ffi.new("gg_comparison **")
    word = ffi.NULL if name is None else encode(name, "theory")

    def work():
        with serving(scene, call), scene.held() as pointer:
            check(lib.gg_theories_evaluate, pointer, word, *call.stopping, made)
        return Comparison(made[0], scene=scene)
    try:
        return calls.left_behind(work, call)
    except BadInput as error:
        if "there is no theory called" in str(error):
            raise NotFound(str(error)) from None
        raise


def theories(scene, *results, **keys) -> Comparison:
    """Answers of all theories, as a Comparison without simulations, or with results of the same scene:
    theories(r.scene, r). Keys change the scene: theories(s, e=0.8). Raises BadInput if a result has another scene."""
    found = _evaluate(as_scene(scene).copy(**keys))
    for result in results:
        found._take(result)
    return found


def theory(scene, name, **keys) -> Theory:
    """Answers of one theory: theory(s, "lun1991", e=0.8)["shear_viscosity"] is a number in units of results.

    name   of a theory, or one of define_theory(), which need not be added to the scene
    Raises NotFound for an unknown theory. A theory that does not apply has no answers and a `reason`.
    """
    scene = as_scene(scene).copy(**keys)
    if hasattr(name, "add_to"):
        if name not in scene._extensions:
            scene.add(name)
        name = name.name
    return _evaluate(scene, name).theories[name]


class Grid:
    """Numbers over a grid: dims (names), coords (values by dim), values (arrays by name, in the order of dims)."""

    def __init__(self, dims, coords, values, units=None):
        self.dims, self.coords, self.values, self.units = tuple(dims), coords, values, units or {}

    def __getitem__(self, name):
        return self.values[name]

    def to_xarray(self):
        import xarray
        variables = {name: (self.dims, array, {"units": self.units.get(name, "1")}) for name, array in self.values.items()}
        return xarray.Dataset(variables, coords={name: _coordinate(values) for name, values in self.coords.items()})

    def __repr__(self):
        sizes = ", ".join(f"{dim}: {len(self.coords[dim])}" for dim in self.dims)
        return f"<grid over {sizes}; {', '.join(self.values)}>"


def _coordinate(values):
    """Numbers as numbers, all else as text."""
    if all(isinstance(value, (int, float)) for value in values):
        return np.array(values)
    return [value if isinstance(value, str) else yaml.write(value) for value in values]


def as_xarray(grid):
    """An xarray.Dataset; the Grid itself where xarray is missing."""
    try:
        return grid.to_xarray()
    except ImportError:
        return grid


def grid_keys(vary, short):
    """Full names of the varied keys with their values as lists of Python."""
    keys = {**(vary or {}), **short}
    found = {}
    for key, values in keys.items():
        if isinstance(values, (str, bytes, dict)) or not np.iterable(values):
            raise BadInput(f"key '{key}': expected a list of values to vary over, not {values!r}")
        values = values.tolist() if isinstance(values, np.ndarray) else list(values)
        if not values:
            raise BadInput(f"key '{key}': the list of values is empty")
        found[SHORT.get(key, key)] = list(map(_plain, values))
    return found


def _plain(value):
    """Decimal, Fraction and their like as int or float."""
    is_number = isinstance(value, (numbers.Number, Decimal)) and not isinstance(value, (bool, complex))
    return yaml.read(yaml.write(value)) if is_number else value


def scan(scene, vary=None, *, theories=None, quantities=None, **keys):
    """Theories over a grid of scenes: scan(s, e=np.linspace(.5, 1, 51), theories=["lun1991", mine]).

    vary, keys   values of each key; {"collision.e.12": [...]} for keys with dots
    theories     names, or theories of define_theory(); None: all
    quantities   names; None: all that have an answer
    Returns an xarray.Dataset with a dimension for each key and one for the theories, a variable for each quantity; a
    Grid where xarray is missing. NaN: no answer.
    """
    scene, axes = as_scene(scene).copy(), grid_keys(vary, keys)
    if not axes:
        raise BadInput("scan: give at least one key to vary, e.g. e=[0.5, 0.7, 0.9]")
    theories, quantities = _listed(theories), _listed(quantities)
    for extra in theories or ():
        if hasattr(extra, "add_to") and extra not in scene._extensions:
            scene.add(extra)
    names = [getattr(entry, "name", entry) for entry in theories] if theories is not None else None
    points = [_answers(scene.copy(), dict(zip(axes, point)), names) for point in itertools.product(*axes.values())]
    names = names or list(dict.fromkeys(name for answers, _ in points for name in answers))
    return as_xarray(_grid(axes, names, points, quantities))


def merged(units):
    """Units by quantity of several scenes: "gamma or v_0/d" where they differ."""
    found = {}
    for name, unit in dict.fromkeys(pair for some in units for pair in some.items()):
        found[name] = f"{found[name]} or {unit}" if name in found else unit
    return found


def _listed(names):
    """One name, or one theory, as a list."""
    return [names] if isinstance(names, str) or hasattr(names, "add_to") else names


def _answers(scene, point, names):
    """Numbers by theory and quantity at one point, and the units."""
    for key, value in point.items():
        scene[key] = value
    comparison = _evaluate(scene, ",".join(names) if names else None)
    found = {name: dict(theory) for name, theory in comparison.theories.items()}
    units = {row.name: row.unit for row in comparison.values()}
    return {name: answers for name, answers in found.items() if answers or names}, units


def _grid(axes, names, points, quantities):
    shape = (*map(len, axes.values()), len(names))
    units = merged(some for _, some in points)
    for name in quantities or ():
        if name not in units and name not in catalogue.quantities():
            raise not_found("quantity", name, units)
    wanted = quantities or [name for name in units if any(name in a for answers, _ in points for a in answers.values())]
    arrays = {}
    for quantity in wanted:
        numbers = [answers.get(name, {}).get(quantity, math.nan) for answers, _ in points for name in names]
        arrays[quantity] = np.array(numbers, float).reshape(shape)
    return Grid([*axes, "theory"], {**axes, "theory": list(names)}, arrays, units)
