# SPDX-License-Identifier: GPL-3.0-or-later
"""Results of one engine's run."""
from __future__ import annotations

import hashlib
import json
import math
from collections import namedtuple
from collections.abc import Mapping
from functools import cached_property
from typing import Optional

from . import _c, calls, tables
from .curves import Curve, result_curves
from .errors import check, encode, lib, look_up, new_error, owned_text, text
from .estimate import Estimate
from .grains import Grains, copy_grains
from .names import Quantity
from .scene import Scene
from .structs import Record, array, new, values

ffi = _c.ffi

History = namedtuple("History", "time value")


class Result(Mapping[str, Estimate]):
    """Means with standard errors of a run: result["temperature"] is an Estimate.

    A mapping over the quantities that have a mean. `partial` says why the run ended before its stopping criteria; None
    if it did not.
    """

    def __init__(self, pointer, owner=None, scene=None):
        self._pointer = pointer if owner is not None else ffi.gc(pointer, lib.gg_result_free)
        self._owner, self._scene, self.partial = owner, scene, None

    def find(self, quantity: str) -> Estimate:
        """Everything known about a quantity, also if it has no mean. Raises NotFound for an unknown name."""
        found = new("gg_measurement")
        look_up(lib.gg_result_find, self._pointer, encode(quantity, "quantity"), found)
        return Estimate._of(found, self)

    def __getitem__(self, quantity: Quantity | str) -> Estimate:
        return self.find(quantity)

    def _all(self):
        i, found, error = 0, new("gg_measurement"), new_error()
        while lib.gg_result_at(self._pointer, i, found, error) == lib.GG_OK:
            yield Estimate._of(found, self)
            i += 1

    @cached_property
    def identity(self) -> str:
        """Hash of the numbers of the run. Results with one identity are one run: read twice, copied, or run again with
        the same seed."""
        digest = hashlib.blake2b(self.engine.encode(), digest_size=16)
        for e in self._all():
            if not math.isnan(e.mean):
                digest.update(f"{e.name} {e.mean.hex()} {e.error.hex()} {e.samples}\n".encode())
        return digest.hexdigest()

    def __iter__(self):
        return (estimate.name for estimate in self._all() if not math.isnan(estimate.mean))

    def __len__(self):
        return sum(1 for _ in self)

    def __contains__(self, quantity):
        return quantity in list(self)

    def _ipython_key_completions_(self):
        return list(self)

    def _covariance(self, a, b):
        """Covariance of two means; NaN: unknown."""
        found = ffi.new("double *")
        lib.gg_result_covariance(self._pointer, a.encode(), b.encode(), found, ffi.NULL)
        return found[0]

    def covariance(self, quantity: str, other: str) -> float:
        """Covariance of two means. Raises NotFound or BadInput with the reason if there is none."""
        found = ffi.new("double *")
        look_up(lib.gg_result_covariance, self._pointer, encode(quantity, "quantity"), encode(other, "quantity"), found)
        return found[0]

    def _row(self, quantity):
        """Covariances of a mean with all means where they are known."""
        found = {name: self._covariance(quantity, name) for name in self}
        return {name: number for name, number in found.items() if math.isfinite(number)}

    @property
    def info(self) -> Record:
        """Engine, verdict on the steady state, window, collisions, processor time, origin of the file."""
        info = new("gg_result_info")
        check(lib.gg_result_get_info, self._pointer, info)
        return Record(**values(info))

    @property
    def engine(self) -> str:
        return self.info.engine

    @property
    def is_steady(self) -> bool:
        """Whether the steady state was reached."""
        return bool(lib.gg_result_is_steady(self._pointer))

    @property
    def scene(self) -> Scene:
        """The scene as it was run."""
        return self._scene or Scene._copy_of(lib.gg_result_scene(self._pointer))

    @property
    def warnings(self) -> list[str]:
        return list(iter_texts(lambda i: lib.gg_result_warning(self._pointer, i)))

    def history(self, quantity: str) -> History:
        """Time series from the start of the run, first replica: (time, value), each (n,). It exists for temperature,
        rotational_temperature, temperature_ratio, pressure, P_xy, spin_z, collision_rate, a2, cos2_psi."""
        n, time, series = ffi.new("size_t *"), ffi.new("const double **"), ffi.new("const double **")
        check(lib.gg_result_history, self._pointer, encode(quantity, "quantity"), n, time, series)
        return History(array(time[0], n[0]), array(series[0], n[0]))

    @property
    def curves(self) -> dict[str, Curve]:
        """Curves by name."""
        return result_curves(self)

    @property
    def grains(self) -> Grains:
        """The last state of the grains, first replica."""
        info = self.info
        return copy_grains(lib.gg_result_grains, self._pointer, info.grains, info.engine == "md")

    def to_json(self) -> str:
        """The document of `graingas run --json`, as text."""
        made = ffi.new("char **")
        check(lib.gg_result_to_json, self._pointer, made)
        return owned_text(made)

    def to_dict(self) -> dict:
        """The document of `graingas run --json`."""
        return json.loads(self.to_json())

    def to_bytes(self) -> bytes:
        """The file in memory; Result.from_bytes(content) reads it."""
        return calls.left_behind(lambda: bytes_of(lib.gg_result_to_bytes, self._pointer))

    @classmethod
    def from_bytes(cls, content: bytes, partial: Optional[str] = None) -> Result:
        """A result from the bytes of a file or of to_bytes(). Raises BadFile if they are damaged."""
        found = cls(from_bytes(lib.gg_result_from_bytes, "gg_result **", content))
        found.partial = partial
        return found

    def write(self, path) -> None:
        """Writes the HDF5 (H5MD) file; it appears whole or not at all, also after Ctrl-C."""
        write(lib.gg_result_write, self._pointer, path)

    def to_dataframe(self):
        """A row for each quantity: mean, error, unit, tau, samples."""
        import pandas
        rows = [[e.mean, e.error, e.unit, e.tau, e.samples] for e in self.values()]
        return pandas.DataFrame(rows, index=pandas.Index(list(self), name="quantity"),
                                columns=["mean", "error", "unit", "tau", "samples"])

    def plot(self, quantity="temperature", ax=None, **style):
        """Draws the history of a quantity with matplotlib; returns the axes."""
        from .plot import plot_history
        return plot_history(self, quantity, ax, **style)

    def _table(self):
        return ["quantity", "unit", self.engine], [[e.name, e.unit, str(e)] for e in self.values()]

    def __repr__(self):
        return self.scene.title + "\n\n" + tables.as_text(*self._table())

    def _repr_html_(self):
        return tables.as_html(self.scene.title, *self._table(), [self.partial] if self.partial else [])

    def __reduce__(self):
        return Result.from_bytes, (self.to_bytes(), self.partial)

    __hash__ = object.__hash__

    def __eq__(self, other):
        return self is other


def iter_texts(get):
    """Texts until NULL."""
    i = 0
    while get(i) != ffi.NULL:
        yield text(get(i))
        i += 1


def bytes_of(function, pointer, *more):
    """The bytes that a gg_..._to_bytes returns."""
    made, size = ffi.new("void **"), ffi.new("size_t *")
    check(function, pointer, *more, made, size)
    try:
        return bytes(ffi.buffer(made[0], size[0]))
    finally:
        lib.free(made[0])


def write(function, pointer, path):
    """Writes a file by a gg_..._write."""
    path, call = encode(path, "file name"), calls.Call()
    calls.finished(lambda error: function(pointer, path, *call.stopping, error), call, "the file is whole or unchanged")


def from_bytes(function, kind, content, *more):
    """The handle that a gg_..._from_bytes makes."""
    made = ffi.new(kind)
    check(function, ffi.from_buffer(content), len(content), *more, made)
    return made[0]


def read_result(path):
    made = ffi.new("gg_result **")
    check(lib.gg_result_read, encode(path, "file name"), made)
    return Result(made[0])


def export(path, prefix, *, results=True, curves=True, trajectory=True) -> list[str]:
    """Writes tables (CSV) and the trajectory (extended XYZ) of a result file: PREFIX.csv, PREFIX_....csv, PREFIX.xyz.
    Returns the file names. Raises BadFile; RunFailed if the result has none of the parts. Ctrl-C: all files are there, or
    none."""
    parts = results * lib.GG_EXPORT_RESULTS + curves * lib.GG_EXPORT_CURVES + trajectory * lib.GG_EXPORT_TRAJECTORY
    path, prefix, call = encode(path, "file name"), encode(prefix, "prefix"), calls.Call()
    stop, context = call.stopping
    calls.finished(lambda error: lib.gg_export(path, prefix, parts, lib.ggpy_line, ffi.NULL, stop, context, error), call,
                   "all files are there, or none")
    return call.lines
