# SPDX-License-Identifier: GPL-3.0-or-later
"""Sweeps: a scene at every point of a grid, in a folder that can be resumed."""
from __future__ import annotations

import itertools
import json
import math
import os
import tempfile
import warnings

import numpy as np

from . import _c, calls, tables, yaml
from .errors import BadInput, NotFound, PartialResult, check, encode, exception, lib, new_error, owned_text, text
from .handles import Handle
from .result import Result
from .run import read, reporting, thread_count
from .scene import Scene, as_scene
from .structs import Record, new, values
from .theory import Grid, grid_keys, merged

ffi = _c.ffi

STATES = {lib.GG_POINT_MISSING: "missing", lib.GG_POINT_DONE: "done", lib.GG_POINT_SHORT: "short",
          lib.GG_POINT_OTHER_BUILD: "other build", lib.GG_POINT_DAMAGED: "damaged"}


class Point:
    """One point of a sweep.

    values   its varied keys
    name     of its file, a hash
    state    "missing", "done", "short": done, but ended before its stopping criteria; "other build" or "damaged": runs again
    file     its result file; None while it is missing
    seconds  expected processor time
    """

    def __init__(self, keys, name, state, file, seed, seconds, scene):
        self.values, self.name, self.state, self.file, self.seed = keys, name, state, file, seed
        self.seconds, self._scene = seconds, scene

    @property
    def scene(self):
        """The scene as it is run at this point."""
        return self._scene()

    def read(self):
        """Its Result or Comparison. Raises NotFound while it is missing."""
        if self.state == "missing":
            raise NotFound(f"the point {self.values} has no result yet: repeat the sweep")
        return read(self.file)

    def __repr__(self):
        return f"<point {', '.join(f'{key} {value}' for key, value in self.values.items())}: {self.state}>"


class Sweep:
    """Results of a sweep: a sequence of Points, in the order of the grid; the last key changes fastest.

    axes      varied keys with their values
    folder    a result file for each point
    partial   why it ended early; None if it did not
    """

    def __init__(self, pointer, axes, folder):
        self._handle, self.axes = Handle(pointer, lib.gg_sweep_free, "sweep"), axes
        self._temporary = tempfile.TemporaryDirectory(prefix="graingas-sweep-") if folder is None else None
        self.folder = self._temporary.name if folder is None else str(folder)
        self.partial, self._interrupted = None, False

    @classmethod
    def parse(cls, source, folder=None, name="sweep") -> Sweep:
        """Makes a sweep of a file's text: a scene with the maps `vary` and `sweep`. Nothing runs before run(). `name`
        of the file appears in messages.
        """
        made = ffi.new("gg_sweep **")
        check(lib.gg_sweep_parse, encode(source), encode(name), made)
        return cls._checked(made[0], folder)

    @classmethod
    def load(cls, path, folder=None, does=None) -> Sweep:
        """The sweep of a file, or of a sweep's folder with its results. Nothing runs before run(). does: replaces
        that of the file."""
        made = ffi.new("gg_sweep **")
        check(lib.gg_sweep_load, encode(path, "file name"), made)
        return cls._checked(made[0], path if folder is None and os.path.isdir(path) else folder, does)

    @classmethod
    def _checked(cls, pointer, folder, does=None):
        found = cls(pointer, {}, folder)
        if does is not None:
            check(lib.gg_sweep_set, pointer, b"sweep.does", encode(does, "does"))
        check(lib.gg_sweep_check, pointer)
        found.axes = _axes(pointer)
        return found

    def validate(self, page=None, picture=None) -> Verdict:
        """Compares the finished points, which have to be comparisons, with Enskog's equation.

        page      Markdown file to write, with maps, counts and tables
        picture   SVG, PNG, PDF or a script for gnuplot: the maps alone, drawn by gnuplot
        Ctrl-C raises KeyboardInterrupt at once; a map that is being drawn is finished in the background.
        Raises BadInput if the sweep does not compare; RunFailed if no point is finished.
        """
        kept = {name: ffi.new("char[]", encode(path, name)) for name, path in (("page", page), ("picture", picture)) if path}
        folder, call = encode(self.folder, "folder"), calls.Call()

        def work(pointer):
            words = _verdict(pointer, folder, call, {})
            return Verdict(json.loads(_verdict(pointer, folder, call, {"json": 1, **kept})), words)
        return self._handle.read(work, call=call)

    def run(self, threads=1, progress=None, accept_version=False) -> Sweep:
        """Runs the points that are not finished. accept_version: points of another build of graingas are finished, too,
        though its numbers may differ. Ctrl-C and points that end early: as for sweep()."""
        call, error, options = calls.Call(), new_error(), new("gg_sweep_options")
        options.threads, options.context, options.accept_version = thread_count(threads), call.c, bool(accept_version)
        call.keep.append(ffi.new("char[]", b"graingas (Python)"))
        options.command, options.stop = call.keep[-1], ffi.addressof(lib, "ggpy_stop")
        options.progress, options.ended, options.warn = lib.ggpy_sweep_progress, lib.ggpy_sweep_ended, lib.ggpy_warn
        folder = encode(self.folder, "folder")
        with self._handle.held() as pointer, reporting(progress, 1, _describe) as report:
            check(lib.gg_sweep_check, pointer)
            status = calls.interruptible(lambda: lib.gg_sweep_run(pointer, folder, options, error), call, report)
        for line in call.warnings:
            warnings.warn(line, stacklevel=4)
        if status not in (lib.GG_OK, lib.GG_FAILED, lib.GG_INTERRUPTED):
            raise exception(status, error)
        self._interrupted = call.interrupted
        if status != lib.GG_OK:
            self.partial = "\n".join([text(error.message), *call.events])
            warnings.warn(self.partial, PartialResult, stacklevel=3)
        return self

    @property
    def does(self) -> str:
        """"run", "compare" or "theory"."""
        with self._handle.held() as pointer:
            return text(lib.gg_sweep_does(pointer))

    def __len__(self):
        with self._handle.held() as pointer:
            return lib.gg_sweep_points(pointer)

    def __getitem__(self, i):
        if isinstance(i, slice):
            return [self[k] for k in range(*i.indices(len(self)))]
        n = len(self)
        if not -n <= i < n:
            raise IndexError(f"point {i}: the sweep has {n} points")
        with self._handle.held() as pointer:
            return _point(self, pointer, i % n)

    def _scene(self, i):
        made = ffi.new("gg_scene **")
        with self._handle.held() as pointer:
            check(lib.gg_sweep_scene, pointer, i, made)
        return Scene._from_pointer(made[0])

    def to_dataframe(self):
        """A row for each point, solver ("md", "dsmc", a theory) and quantity: the keys, mean, error, unit."""
        import pandas
        rows = [{**point.values, **row} for point in self if point.state != "missing" for row in _rows(point.read())]
        return pandas.DataFrame(rows)

    def grid(self) -> Grid:
        """Means and errors over the grid: dims are the keys and "solver"; NaN where a point is missing."""
        found = [(i, list(_rows(point.read()))) for i, point in enumerate(self) if point.state != "missing"]
        solvers = list(dict.fromkeys(row["solver"] for _, rows in found for row in rows))
        shape = tuple(map(len, self.axes.values()))
        units = merged({row["quantity"]: row["unit"]} for _, rows in found for row in rows)
        units.update({name + "_error": unit for name, unit in units.items()})
        arrays = {}
        for i, rows in found:
            for row in rows:
                at = (*np.unravel_index(i, shape), solvers.index(row["solver"]))
                for name, number in (row["quantity"], row["mean"]), (row["quantity"] + "_error", row["error"]):
                    arrays.setdefault(name, np.full((*shape, len(solvers)), math.nan))[at] = number
        return Grid([*self.axes, "solver"], {**self.axes, "solver": solvers}, arrays, units)

    def to_xarray(self):
        """The grid as an xarray.Dataset: variables QUANTITY and QUANTITY_error."""
        return self.grid().to_xarray()

    def plot(self, quantity="temperature", over=None, relative_to=None, ax=None):
        """Draws a quantity over a key, a line for each solver and combination of the other keys; returns the axes.
        relative_to: the solver by which all others are divided."""
        from .plot import plot_sweep
        return plot_sweep(self.grid(), quantity, over, relative_to, ax)

    def __repr__(self):
        states = [point.state for point in self]
        return f"<sweep of {len(states)} points over {', '.join(self.axes)}: {states.count('missing')} missing>"

    def _repr_html_(self):
        return tables.as_html(repr(self)[1:-1], [*self.axes, "state"],
                              [[*point.values.values(), point.state] for point in self])


class Verdict(dict):
    """Comparison of a grid with Enskog's equation: the document of `graingas validate --json` as a dict; str() is the
    Markdown that the command prints."""

    def __init__(self, document, words):
        super().__init__(document)
        self._words = words

    @property
    def agrees(self) -> bool | None:
        """Whether dsmc and the noise-free solution agree within chance; None: there is nothing to compare."""
        return self["dsmc"]["agrees"]

    def __str__(self):
        return self._words

    __repr__ = _repr_markdown_ = __str__


def _verdict(pointer, folder, call, settings):
    options, made, error = new("gg_validate_options"), ffi.new("char **"), new_error()
    options.stop, context = call.stopping
    for name, value in settings.items():
        setattr(options, name, value)
    status = lib.gg_sweep_validate(pointer, folder, options, lib.ggpy_line, context, made, error)
    found = owned_text(made)
    if status not in (lib.GG_OK, lib.GG_FAILED) or found is None:
        raise exception(status, error)
    return found


def _names(pointer):
    return [text(name) for name in itertools.takewhile(lambda name: name != ffi.NULL,
                                                       (lib.gg_sweep_key(pointer, k) for k in itertools.count()))]


def _values(pointer, i):
    return {name: yaml.read(text(lib.gg_sweep_value(pointer, i, k))) for k, name in enumerate(_names(pointer))}


def _axes(pointer):
    """Values of each key, in the order of the grid."""
    axes = {}
    for i in range(lib.gg_sweep_points(pointer)):
        for key, value in _values(pointer, i).items():
            axes.setdefault(key, [])
            if value not in axes[key]:
                axes[key].append(value)
    return axes


def _point(sweep, pointer, i):
    point, state, file = new("gg_sweep_point"), ffi.new("gg_point_state *"), ffi.new("char **")
    check(lib.gg_sweep_at, pointer, i, point)
    check(lib.gg_sweep_find, pointer, encode(sweep.folder), i, state, file)
    path = text(file[0])
    if file[0] != ffi.NULL:
        lib.free(file[0])
    return Point(_values(pointer, i), text(point.name), STATES[state[0]], path, point.seed, point.cpu_seconds,
                 lambda: sweep._scene(i))


def _rows(result):
    """Solver, quantity, mean, error and unit of everything in a result."""
    if isinstance(result, Result):
        yield from (_row(result.engine, e) for e in result.values())
        return
    for engine in (result.md, result.dsmc):
        if engine is not None:
            yield from (_row(engine.engine, e) for e in engine.values())
    for theory in result.theories.values():
        for name in theory:
            yield {"solver": theory.name, "quantity": name, "mean": theory[name], "error": theory.error(name),
                   "unit": result[name].unit}


def _row(solver, estimate):
    return {"solver": solver, "quantity": estimate.name, "mean": estimate.mean, "error": estimate.error,
            "unit": estimate.unit}


def _describe(call, engines):
    report = call.progress.get("sweep")
    if report is None:
        return 0.0, "start"
    return report.done / max(report.points, 1), f"{report.done} of {report.points} points"


@ffi.def_extern(onerror=lambda *_: None)
def ggpy_sweep_progress(context, progress):
    calls.of(context).progress["sweep"] = Record(**values(progress))


@ffi.def_extern(onerror=lambda *_: None)
def ggpy_sweep_ended(context, i, status, file, message):
    if status != lib.GG_OK:
        calls.of(context).events.append(f"point {i}: {text(message)}")


def _yaml(scene, axes, does, seeds):
    """The sweep as a file: a scene with the maps `vary` and `sweep`."""
    lists, how = yaml.write(axes), yaml.write({"does": does, "seeds": seeds})
    kept = {key: words for key, words in scene._given_texts().items() if key not in axes}
    return f"{yaml.nested(kept)}vary: {lists}\nsweep: {how}\n"


def sweep(scene, vary=None, *, does="run", folder=None, threads=1, seeds="independent", progress=None, accept_version=False,
          **keys) -> Sweep:
    """Runs, compares, or evaluates theories at every point of a grid: sweep(s, e=[0.7, 0.9], does="compare").

    vary, keys   values of each key; {"collision.e.12": [...]} for keys with dots
    does         "run", "compare" or "theory"
    folder       a result file for each point. Repeated with the same folder, only unfinished points run. None: a
                 temporary folder, removed with the Sweep
    seeds        "independent", or "common": run.seed of the scene for all points
    threads      for points and replicas; None: all processors
    accept_version
                 keep points of another build of graingas, whose numbers may differ

    Ctrl-C returns the finished points, with a warning PartialResult and `partial` set; so do points that ended before
    their stopping criteria. Raises BadInput, which names the first point that cannot be simulated; BadFile.
    """
    scene, axes = as_scene(scene), grid_keys(vary, keys)
    if not axes:
        raise BadInput("sweep: give at least one key to vary, e.g. e=[0.5, 0.7, 0.9]")
    if scene._extensions:
        names = ", ".join(extension.name for extension in scene._extensions)
        raise BadInput(f"sweep: its points are files, which hold nothing that add() registered ({names}); give theories as "
                       "formulas under `theories`, or use scan(), or run() for each point")
    return Sweep.parse(_yaml(scene, axes, encode(does, "does").decode(), seeds), folder).run(threads, progress, accept_version)


def validate(source=None, *, quick=False, folder=None, threads=1, progress=None, page=None, picture=None) -> Verdict:
    """Both engines and the theories against Enskog's equation over a grid, as `graingas validate`.

    source   file of a sweep, or its folder; None: the standard grid, uniform shear over density and restitution
    quick    the small standard grid
    Ctrl-C during the runs: the verdict on the finished points, with a warning PartialResult; KeyboardInterrupt without
    any. Other arguments and errors: as for sweep() and Sweep.validate().
    """
    if source is None:
        found = Sweep.parse(text(lib.gg_standard_grid(quick)), folder, "the standard grid")
    else:
        found = Sweep.load(source, folder, "compare")
    found.run(threads, progress)
    if found._interrupted and all(point.state == "missing" for point in found):
        raise KeyboardInterrupt(found.partial)
    return found.validate(page, picture)
