"""Positions, velocities, spins and species of grains, as numpy arrays."""
import numpy as np

from . import _c
from .errors import check
from .structs import address

ffi = _c.ffi


class Grains:
    """Copies of the grains, in units of results.

    position   (n, 3) from 0 to the edges of the box; None where the engine has none (dsmc)
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
        into = ffi.new("gg_grains *")
        for name in ("position", "velocity", "spin"):
            setattr(into, name, address(getattr(self, name), "double *"))
        into.species = address(self.species, "int *")
        return into


def copy_grains(function, handle, n, positions, *before):
    """Grains from gg_simulation_get_grains and its like."""
    grains = Grains(n, positions)
    check(function, handle, *before, grains._struct())
    return grains
