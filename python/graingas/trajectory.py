# SPDX-License-Identifier: GPL-3.0-or-later
"""Trajectories: the stored frames of a run."""
from __future__ import annotations

import numpy as np

from . import _c, calls
from .errors import check, encode, lib
from .grains import Grains
from .handles import Handle
from .scene import Scene
from .simulation import species_of
from .structs import Record, new, values

ffi = _c.ffi

ELEMENTS = "H He Li Be B C N O F Ne Na Mg Al Si P S".split()  # of the species, as in exported files


class Frame:
    """One frame: `state` (as of Simulation.state), `grains`, `species`."""

    def __init__(self, state, grains, species):
        self.state, self.grains, self.species = state, grains, species

    @property
    def time(self) -> float:
        return self.state.time

    @property
    def periodic(self) -> tuple:
        """Whether the cell repeats along x, y, z; it does not across walls."""
        return tuple(map(bool, self.state.periodic))

    @property
    def cell(self) -> np.ndarray:
        """Edges of the periodic cell as rows, (3, 3); under shear it is tilted."""
        cell = np.diag(self.state.box)
        cell[1, 0] = self.state.image_offset
        return cell

    def to_ase(self):
        """An ase.Atoms: positions, cell, masses and momenta in units of results, peculiar velocities; species are called
        H, He, Li, ...; array "radii"."""
        import ase
        mass, radius = (np.array([getattr(s, name) for s in self.species])[self.grains.species]
                        for name in ("mass", "diameter"))
        atoms = ase.Atoms([ELEMENTS[i] for i in self.grains.species], positions=self.grains.position, cell=self.cell,
                          pbc=self.periodic, masses=mass, momenta=mass[:, None] * self.grains.velocity,
                          info={"time": self.time})
        atoms.set_array("radii", radius / 2)
        return atoms

    def __repr__(self):
        return f"<frame at time {self.time:g}: {len(self.grains)} grains>"


class Trajectory:
    """Frames of a result file, a sequence; one at a time is in memory. The frames of a comparison are those of md."""

    def __init__(self, path):
        path = encode(path, "file name")

        def open_it():
            made = ffi.new("gg_trajectory **")
            check(lib.gg_trajectory_open, path, made)
            return Handle(made[0], lib.gg_trajectory_free, "trajectory")
        self._handle = calls.left_behind(open_it)
        with self._handle.held() as pointer:
            self._scene = Scene._copy_of(lib.gg_trajectory_scene(pointer))

    @property
    def scene(self) -> Scene:
        """A copy of the scene, as it was run."""
        return self._scene.copy()

    def __len__(self):
        with self._handle.held(1) as pointer:
            return lib.gg_trajectory_frames(pointer)

    def __getitem__(self, k):
        if isinstance(k, slice):
            return [self[i] for i in range(*k.indices(len(self)))]
        n = len(self)
        if not -n <= k < n:
            raise IndexError(f"frame {k}: the trajectory has {n} frames")
        return self._handle.read(lambda pointer: self._frame(pointer, k % n), 1)

    def _frame(self, pointer, k):
        state = new("gg_simulation_state")
        check(lib.gg_trajectory_frame, pointer, k, state, ffi.NULL)
        grains = Grains(state.grains)
        check(lib.gg_trajectory_frame, pointer, k, state, grains._struct())
        species = species_of(lib.gg_trajectory_get_species, pointer, int(grains.species.max(initial=0)) + 1)
        return Frame(Record(**values(state)), grains, species)

    def to_ase(self) -> list:
        """All frames as ase.Atoms."""
        return [frame.to_ase() for frame in self]

    def close(self) -> None:
        """Closes the file; later uses raise BadInput."""
        self._handle.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def __repr__(self):
        return "<trajectory: closed>" if self._handle.closed else f"<trajectory of {len(self)} frames: {self._scene.title}>"


def trajectory(path) -> Trajectory:
    """The trajectory of a result file: its frames are a sequence. Raises BadFile; RunFailed if it has no positions."""
    return Trajectory(path)
