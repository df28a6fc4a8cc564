# SPDX-License-Identifier: GPL-3.0-or-later
"""Positions, velocities, spins and species of grains, as numpy arrays."""
from __future__ import annotations

import numpy as np

from . import _c
from .errors import BadInput, check
from .structs import address, new

ffi = _c.ffi


class Grains:
    """Copies of the grains, in units of results.

    position   (n, 3) from 0 to the edges of the box; None in an engine without positions (dsmc)
    velocity   (n, 3) relative to the imposed flow gamma (y - box[1]/2) along x
    spin       (n, 3) angular velocity; 0 for smooth grains
    species    (n,)   from 0
    """

    __slots__ = ("position", "velocity", "spin", "species")

    def __init__(self, n, positions=True):
        self.position = np.zeros((n, 3)) if positions else None
        self.velocity, self.spin, self.species = np.zeros((n, 3)), np.zeros((n, 3)), np.zeros(n, "i4")

    def __len__(self):
        return len(self.velocity)

    def __repr__(self):
        return f"<{len(self)} grains{'' if self.position is not None else ', without positions'}>"

    def _struct(self):
        into = new("gg_grains")
        for name in ("position", "velocity", "spin"):
            setattr(into, name, address(getattr(self, name), "double *"))
        into.species = address(self.species, "int *")
        return into


SHAPES = {"position": (3,), "velocity": (3,), "spin": (3,), "species": ()}


def grains_from(n, **arrays):
    """A gg_grains of the caller's arrays, checked and converted, and the arrays that have to outlive it. None gives
    NULL. n: number of grains; None: that of the arrays.
    """
    into, kept = new("gg_grains"), []
    for name, values in arrays.items():
        if values is None:
            continue
        kept.append(_checked(name, values, n))
        n = len(kept[-1])
        setattr(into, name, address(kept[-1], "int *" if name == "species" else "double *"))
    return into, kept, n or 0


def _checked(name, values, n):
    kind = "i4" if name == "species" else "f8"
    if np.iscomplexobj(values):
        raise BadInput(f"{name}: expected an array of real numbers")
    try:
        found = np.ascontiguousarray(values, kind)
    except (TypeError, ValueError, OverflowError):
        raise BadInput(f"{name}: expected an array of {'whole ' if kind == 'i4' else ''}numbers") from None
    if kind == "i4" and not np.array_equal(found, np.asarray(values)):
        raise BadInput(f"{name}: expected an array of whole numbers")
    if found.ndim != 1 + len(SHAPES[name]) or found.shape[1:] != SHAPES[name] or n not in (None, len(found)):
        shape = ", ".join(["n" if n is None else str(n), *map(str, SHAPES[name])])
        raise BadInput(f"{name}: has the shape {found.shape}; expected ({shape}{',' if not SHAPES[name] else ''})")
    return found


def copy_grains(function, handle, n, positions, *before):
    """Grains from gg_simulation_get_grains and its like."""
    grains = Grains(n, positions)
    check(function, handle, *before, grains._struct())
    return grains
