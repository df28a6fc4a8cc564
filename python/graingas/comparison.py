# SPDX-License-Identifier: GPL-3.0-or-later
"""Comparisons: both engines and the theories on one scene."""
from __future__ import annotations

import functools
import json
import math
from collections.abc import Mapping
from typing import Optional

from . import _c, calls, tables
from .arguments import real
from .curves import curves_by_name, curves_of
from .errors import ByName, NotFound, check, encode, lib, look_up, new_error, owned_text, text
from .estimate import Estimate
from .names import Quantity
from .result import Result, bytes_of, from_bytes, iter_texts, write
from .scene import Scene
from .structs import Record, new, values

ffi = _c.ffi

ENGINES = "md", "dsmc"


class Theory(Mapping[str, float]):
    """Answers of a theory: theory["shear_viscosity"] is a number in units of results.

    name, title, citation, assumptions
    reason   why it does not apply to the scene; None if it does
    beyond   why the scene is outside the theory's range, although it answers; None within
    """

    def __init__(self, comparison, info):
        self._comparison = comparison
        self.__dict__.update(values(info))

    def _value(self, quantity, function, *more):
        found = ffi.new("double *")
        look_up(function, self._comparison._pointer, encode(self.name), encode(quantity, "quantity"), found, *more)
        return found[0]

    def __getitem__(self, quantity: Quantity | str) -> float:
        found = self._value(quantity, lib.gg_comparison_theory_value, ffi.NULL)
        if math.isnan(found):
            raise NotFound(f"{self.name} gives no {quantity}: {self.reason or 'it does not answer it in this scene'}")
        return found

    def deviation(self, quantity: str) -> float:
        """theory/simulation - 1, against md, or dsmc without md; NaN without a simulation."""
        ratio = ffi.new("double *")
        self._value(quantity, lib.gg_comparison_theory_value, ratio)
        return ratio[0]

    def error(self, quantity: str) -> float:
        """Numerical error of an answer; NaN: it is exact."""
        return self._value(quantity, lib.gg_comparison_theory_error)

    def temperature(self, time):
        """T(t) of freely cooling smooth grains by Haff's law with the theory's cooling rate; times as a number or array."""
        import numpy as np
        found, name = ffi.new("double *"), encode(self.name)

        def at(t):
            check(lib.gg_comparison_theory_cooling, self._comparison._pointer, name, t, found)
            return found[0]
        return np.vectorize(at, otypes=[float])(time) if np.ndim(time) else at(real(time, "time"))

    @property
    def curves(self):
        """Curves of the theory, with the names, abscissae and numbers of the measured ones."""
        of = self._comparison._pointer, encode(self.name)
        return curves_of(functools.partial(lib.gg_comparison_theory_curve, *of),
                         functools.partial(lib.gg_comparison_theory_curve_number, *of))

    def __iter__(self):
        return (name for name in self._comparison._quantities() if name in self)

    def __contains__(self, quantity):
        try:
            return not math.isnan(self[quantity])
        except NotFound:
            return False

    def __len__(self):
        return sum(1 for _ in self)

    def __repr__(self):
        if self.reason:
            return f"<theory {self.name}: does not apply: {self.reason}>"
        return f"<theory {self.name}: {', '.join(f'{name} {self[name]:.5g}' for name in self)}>"

    __hash__ = object.__hash__

    def __eq__(self, other):
        return self is other


class Row:
    """One quantity of a comparison.

    symbol      LaTeX; None of a quantity of your own
    md, dsmc    Estimates; without a mean where the engine has none
    z           (md - dsmc) over the combined standard error
    beyond      whether md differs from Enskog's equation by more than expected
    theory      answers by name of the theory; `deviation` likewise
    departure   of each engine, its difference from Enskog's equation solved without random numbers
    """

    def __init__(self, comparison, row):
        self._comparison = comparison
        self.name, self.symbol, self.unit = text(row.name), text(row.symbol), text(row.unit)
        self.z, self.beyond = row.z, bool(row.beyond)
        self.departure = {engine: Record(**values(ffi.addressof(row, "departure", i))) for i, engine in enumerate(ENGINES)}
        self.md, self.dsmc = (self._estimate(engine, row, i) for i, engine in enumerate(ENGINES))

    def _estimate(self, engine, row, i):
        result = getattr(self._comparison, engine)
        if result is not None:
            return result.find(self.name)
        return Estimate(row.mean[i], row.error[i], self.unit, self.name, symbol=self.symbol,
                        reason=self._comparison.refusals.get(engine))

    @property
    def theory(self) -> dict[str, float]:
        return ByName.of(f"theory of {self.name}", {name: theory[self.name] for name, theory
                                                    in self._comparison.theories.items() if self.name in theory})

    @property
    def deviation(self) -> dict[str, float]:
        return {name: theory.deviation(self.name) for name, theory in self._comparison.theories.items()
                if self.name in theory}

    def __repr__(self):
        theories = "".join(f"  {name} {value:.4g}" for name, value in self.theory.items())
        return f"{self.name} [{self.unit}]  md {self.md}  dsmc {self.dsmc}  z {self.z:+.1f}{theories}"


class Comparison(Mapping[str, Row]):
    """Both engines and the theories on one scene: c["temperature"].md, .dsmc, .z, .theory["lun1991"].

    A mapping over quantities, in the order of tables. md and dsmc are the Results (None: `refusals` has the reason).
    `partial` says why a run ended before its stopping criteria; None if none did.
    """

    def __init__(self, pointer, scene=None):
        self._pointer = ffi.gc(pointer, lib.gg_comparison_free)
        self._scene, self.partial = scene, None
        self._rows = None

    def _result(self, engine):
        pointer = lib.gg_comparison_result(self._pointer, engine.encode())
        return None if pointer == ffi.NULL else Result(pointer, owner=self, scene=self._scene)

    @property
    def md(self) -> Optional[Result]:
        return self._results[0]

    @property
    def dsmc(self) -> Optional[Result]:
        return self._results[1]

    @property
    def _results(self):
        if "_both" not in self.__dict__:
            self._both = tuple(map(self._result, ENGINES))
        return self._both

    @property
    def refusals(self) -> dict[str, str]:
        """Why there is no result, by engine."""
        found = {engine: text(lib.gg_comparison_refusal(self._pointer, engine.encode())) for engine in ENGINES}
        return {engine: reason for engine, reason in found.items() if reason is not None}

    def _table_rows(self):
        if self._rows is None:
            self._rows = {}
            row, error = new("gg_comparison_row"), new_error()
            while lib.gg_comparison_at(self._pointer, len(self._rows), row, error) == lib.GG_OK:
                made = Row(self, row)
                self._rows[made.name] = made
        return self._rows

    def _quantities(self):
        return list(self._table_rows())

    def __getitem__(self, quantity: Quantity | str) -> Row:
        rows = self._table_rows()
        if quantity not in rows:
            look_up(lib.gg_comparison_agreement, self._pointer, encode(quantity, "quantity"), ffi.NULL, ffi.NULL)
            raise NotFound(f"{quantity}: neither engine nor theory gives it in this scene")
        return rows[quantity]

    def __iter__(self):
        return iter(self._table_rows())

    def __len__(self):
        return len(self._table_rows())

    def _ipython_key_completions_(self):
        return list(self)

    @property
    def theories(self) -> dict[str, Theory]:
        """All theories by name; those that do not apply have a `reason`."""
        found, info, error = ByName.of("theory", {}), new("gg_theory_info"), new_error()
        while lib.gg_comparison_theory(self._pointer, len(found), info, error) == lib.GG_OK:
            theory = Theory(self, info)
            found[theory.name] = theory
        return found

    @property
    def curves(self) -> dict[str, CurveSet]:
        """Curves by name; each a dict of Curve by "md", "dsmc" and name of theory."""
        sources = {"md": self.md, "dsmc": self.dsmc, **self.theories}
        found = curves_by_name({})
        for source, result in sources.items():
            for name, curve in (result.curves if result is not None else {}).items():
                found.setdefault(name, CurveSet(name))[source] = curve
        return found

    @property
    def remarks(self) -> list:
        """Causes of differences larger than expected: theory, quantity, deviation, cause."""
        found, remark, error = [], new("gg_remark"), new_error()
        while lib.gg_comparison_remark(self._pointer, len(found), remark, error) == lib.GG_OK:
            found.append(Record(**values(remark)))
        return found

    @property
    def warnings(self) -> list[str]:
        """Keys that have no effect on any part of the comparison."""
        return list(iter_texts(lambda i: lib.gg_comparison_warning(self._pointer, i)))

    @property
    def scene(self) -> Scene:
        return self._scene or Scene._copy_of(lib.gg_comparison_scene(self._pointer))

    def to_json(self) -> str:
        """The document of `graingas compare --json`, as text."""
        made = ffi.new("char **")
        check(lib.gg_comparison_to_json, self._pointer, made)
        return owned_text(made)

    def to_dict(self) -> dict:
        """The document of `graingas compare --json`."""
        return json.loads(self.to_json())

    def to_bytes(self) -> bytes:
        """The file in memory; Comparison.from_bytes(content) reads it."""
        return calls.left_behind(lambda: bytes_of(lib.gg_comparison_to_bytes, self._pointer))

    @classmethod
    def from_bytes(cls, content: bytes, partial: Optional[str] = None) -> Comparison:
        """A comparison from the bytes of a file or of to_bytes(). Raises BadFile if they are damaged."""
        found = cls(from_bytes(lib.gg_comparison_from_bytes, "gg_comparison **", content))
        found.partial = partial
        return found

    def _take(self, result):
        """A copy of a Result. The library frees the result of its engine, so no caller may hold it."""
        if not isinstance(result, Result):
            raise TypeError(f"theories: expected a Result, not {type(result).__name__}")
        copy = from_bytes(lib.gg_result_from_bytes, "gg_result **", result.to_bytes())
        try:
            check(lib.gg_comparison_take, self._pointer, copy)
        except Exception:
            lib.gg_result_free(copy)
            raise

    def write(self, path) -> None:
        """Writes the HDF5 file; it appears whole or not at all, also after Ctrl-C."""
        write(lib.gg_comparison_write, self._pointer, path)

    def _columns(self):
        theories = {name: theory for name, theory in self.theories.items() if theory.reason is None and len(theory)}
        engines = [engine for engine in ENGINES if getattr(self, engine) is not None]
        return engines, theories

    def to_dataframe(self):
        """A row for each quantity: unit, mean and error of each engine, z, and a column for each theory."""
        import pandas
        engines, theories = self._columns()
        rows = {}
        for name, row in self.items():
            cells = {"unit": row.unit}
            for engine in engines:
                estimate = getattr(row, engine)
                cells.update({engine: estimate.mean, engine + "_error": estimate.error})
            if len(engines) == 2:
                cells["z"] = row.z
            cells.update({key: theory[name] if name in theory else math.nan for key, theory in theories.items()})
            rows[name] = cells
        return pandas.DataFrame.from_dict(rows, orient="index").rename_axis("quantity")

    def _table(self):
        engines, theories = self._columns()
        head = ["quantity", "unit", *engines, *(["z"] if len(engines) == 2 else []), *theories]
        rows = []
        for name, row in self.items():
            cells = [str(getattr(row, engine)) if not math.isnan(getattr(row, engine).mean) else "" for engine in engines]
            z = [""] if math.isnan(row.z) else [f"{row.z:+.1f}{'!' if row.beyond else ''}"]
            answers = [tables.number(theory[name]) if name in theory else "" for theory in theories.values()]
            if any(cells) or any(answers):
                rows.append([name, row.unit, *cells, *(z if len(engines) == 2 else []), *answers])
        return head, rows

    def __repr__(self):
        return self.scene.title + "\n\n" + tables.as_text(*self._table())

    def _repr_html_(self):
        notes = [self.partial] if self.partial else []
        return tables.as_html(self.scene.title, *self._table(), notes + [remark.cause for remark in self.remarks])

    def plot(self, quantities=None, ax=None):
        """Draws the ratio to md (or dsmc) of each quantity with matplotlib; returns the axes."""
        from .plot import plot_comparison
        return plot_comparison(self, quantities, ax)

    def __reduce__(self):
        return Comparison.from_bytes, (self.to_bytes(), self.partial)

    __hash__ = object.__hash__

    def __eq__(self, other):
        return self is other


class CurveSet(dict):
    """The curves of one name, by "md", "dsmc" and name of theory."""

    def __init__(self, name):
        super().__init__()
        self.name = name

    def plot(self, ax=None):
        """Draws all of them in one picture; returns the axes."""
        from .plot import plot_curve_set
        return plot_curve_set(self, ax)


def read_comparison(path):
    made = ffi.new("gg_comparison **")
    check(lib.gg_comparison_read, encode(path, "file name"), made)
    return Comparison(made[0])
