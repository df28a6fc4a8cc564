# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of the library: keys of scenes, flows, engines, observables, quantities, theories."""
from __future__ import annotations

import json

from . import _c
from .errors import check, encode, lib, new_error, owned_text
from .structs import Record, new, values

ffi = _c.ffi


def _entries(get):
    i, entry, error = 0, new("gg_entry"), new_error()
    while get(i, entry, error) == lib.GG_OK:
        yield Record(**values(entry))
        i += 1


def table(which, scene=ffi.NULL):
    """All entries of a table, by name."""
    return {entry.name: entry for entry in _entries(lambda i, e, err: lib.gg_catalogue_entry(which, i, scene, e, err))}


def words(key):
    """The words that a key of type choice or set takes, by name."""
    text = encode(key, "key")
    return {entry.name: entry for entry in _entries(lambda i, e, err: lib.gg_catalogue_word(text, i, e, err))}


def keys():
    """Keys of scenes: name, type, unit, doc, allowed, value (the default), when they have an effect."""
    return table(lib.GG_CATALOGUE_KEYS)


def flows():
    """Flows: name, doc, traits (words separated by blanks: sheared, walls, moving_walls, cools, falls, may_fall)."""
    return table(lib.GG_CATALOGUE_FLOWS)


def traits(flow):
    """Words of the table of flows about a flow: {"walls", "may_fall"}."""
    return set(flows()[flow].traits.split())


def observables():
    """Words of the key `measure`: name, doc."""
    return table(lib.GG_CATALOGUE_OBSERVABLES)


def quantities(scene=None):
    """Quantities of results: name, unit (of results of the scene; None: under shear), doc, symbol and formula (LaTeX),
    when they have a mean."""
    if scene is None:
        return table(lib.GG_CATALOGUE_QUANTITIES)
    with scene.held() as pointer:
        return table(lib.GG_CATALOGUE_QUANTITIES, pointer)


def theories():
    """Theories: name, doc, citation, assumptions, answers (names of quantities), when they apply."""
    return table(lib.GG_CATALOGUE_THEORIES)


def schema():
    """JSON Schema (draft 7) of the files of scenes and sweeps, as a dict."""
    made = ffi.new("char **")
    check(lib.gg_schema_to_json, made)
    return json.loads(owned_text(made))


def template(flow="usf"):
    """A scene of the flow as a template, as YAML text: every other key is a comment with its default."""
    made = ffi.new("char **")
    check(lib.gg_scene_begin, encode(flow, "flow"), made)
    return owned_text(made)
