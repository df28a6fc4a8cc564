# SPDX-License-Identifier: GPL-3.0-or-later
"""References of the program and of its methods."""
from __future__ import annotations

from . import _c, catalogue
from .comparison import Comparison, Theory
from .errors import check, encode, lib, not_found, owned_text
from .result import Result

ffi = _c.ffi


def _methods(of):
    """Names of the engines, theories, contact value and law that gave the numbers."""
    if isinstance(of, Theory):
        return [of.name]
    if not isinstance(of, (Result, Comparison)):
        raise TypeError(f"cite: expected a Result, a Comparison, a Theory or a name, not {type(of).__name__}")
    names = [of.scene.contact_value, of.scene.collision.law]
    if isinstance(of, Result):
        return [of.engine, *names]
    engines = [name for name in ("md", "dsmc") if getattr(of, name) is not None]
    return [*engines, *(name for name, theory in of.theories.items() if theory.reason is None), *names]


def _entries(names):
    made, n = ffi.new("char **"), ffi.new("size_t *")
    check(lib.gg_cite, encode(" ".join(names), "name"), n, made)
    return owned_text(made), n[0]


def cite(*of) -> str:
    """BibTeX of the program, and of the methods that a result used: cite(c) has both engines and every theory that
    answered. Names work, too: cite("md", "lun1991"). Raises NotFound for a name without a reference."""
    names = []
    for thing in of:
        if isinstance(thing, str):
            if _entries([thing])[1] == 0:
                raise not_found("reference", thing, ["md", "dsmc", *catalogue.theories()])
            names.append(thing)
        else:
            names += _methods(thing)
    return _entries(names)[0]
