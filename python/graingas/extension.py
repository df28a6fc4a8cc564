# SPDX-License-Identifier: GPL-3.0-or-later
"""Observables, theories and laws of restitution from Python functions.

An exception in such a function ends every call that uses it at the time, and is raised by that call."""
from __future__ import annotations

import importlib
import inspect
import math
import re
import sys
from collections import deque

import numpy as np

from . import _c
from .arguments import whole
from .errors import BadInput, check, encode, lib
from .structs import Record, array, copy_of, dtype, new, value, values

ffi = _c.ffi

VIEW = dtype("gg_collision_view")


class DoesNotApply(Exception):
    """Raised by a theory: the reason why it does not apply to a scene, which continues its name: "describes free cooling"."""


class Extension:
    """Base of the objects that define_observable(), define_theory() and define_law() return. scene.add() registers it;
    calling it calls the function. Pickles have module and name of it or of its function, so it has to be at the top
    level of a module."""

    def __init__(self, name, function):
        self.name, self.function = name, function
        self.calls = []  # calls in progress that use it
        self._handle = ffi.new_handle(self)
        self._keep = []
        self.__doc__ = getattr(function, "__doc__", None)

    def __call__(self, *arguments):
        return self.function(*arguments)

    def text(self, words):
        """A C string that lives as long as this object; NULL for None."""
        if words is None:
            return ffi.NULL
        self._keep.append(ffi.new("char[]", encode(words)))
        return self._keep[-1]

    def fail(self, error):
        for call in list(self.calls):
            call.fail(error)

    def _recipe(self):
        """A function and its arguments that make the object again."""
        raise NotImplementedError

    def __eq__(self, other):
        return self is other or type(self) is type(other) and self._recipe() == other._recipe()

    def __hash__(self):
        return hash((type(self), self.name))

    def __reduce__(self):
        """Pickles its name in the module of its function, as pickles name functions; else the names of its
        functions.
        """
        module = getattr(self.function, "__module__", None)
        name = next((name for name, thing in vars(sys.modules.get(module, self)).items() if thing is self), None)
        if name is not None:
            return _at, (module, name)
        make, arguments = self._recipe()
        return _made_again, (make, [_Name.of(self, part) if callable(part) else part for part in arguments])

    def __repr__(self):
        return f"<graingas {type(self).__name__.lower()} {self.name}>"


def _at(module, path):
    """The object of this name in a module."""
    found = importlib.import_module(module)
    for name in path.split("."):
        found = getattr(found, name)
    return found


class _Name(tuple):
    """Module and name of a function in a pickle."""

    @classmethod
    def of(cls, extension, function):
        module, path = getattr(function, "__module__", None), getattr(function, "__qualname__", None)
        try:
            found = _at(module, path)
        except (ImportError, AttributeError, TypeError):
            found = None
        if getattr(found, "function", found) is not function:
            raise TypeError(f"{extension!r} cannot be pickled: its function {path or function!r} has no name in a module; "
                            "define it at the top level of one, without lambda")
        return cls((module, path))


def _made_again(make, arguments):
    return make(*(_at(*part) if isinstance(part, _Name) else part for part in arguments))


def _one_line(words):
    return " ".join(words.split()) if words else None


def _first_line(function):
    return _one_line((function.__doc__ or "").strip().partition("\n\n")[0])


class Sample:
    """The argument of an observable at the end of a sampling interval, valid during the call only.

    time, elapsed, n, n_species, volume, collisions, dissipation, box (3), stress (3, 3; collisional: xx, yy, zz, xy, yx)
    position (n, 3; None in dsmc), velocity (n, 3; peculiar), spin (n, 3; None for smooth grains), species (n,),
    mass, diameter, inertia (of each species)
    """

    _POINTERS = {"position": lib.ggpy_sample_position, "velocity": lib.ggpy_sample_velocity, "spin": lib.ggpy_sample_spin}

    def __init__(self, pointer):
        self._pointer = pointer
        for name in "time", "elapsed", "n", "n_species", "volume", "collisions", "dissipation":
            setattr(self, name, getattr(pointer, name))
        self.box = np.array(value(pointer.box))

    def __getattr__(self, name):
        pointer = self.__dict__.get("_pointer")
        if name not in (*self._POINTERS, "species", "mass", "diameter", "inertia", "stress"):
            raise AttributeError(name)
        if pointer is None:
            raise BadInput(f"{name}: a sample is valid during the call only; copy what is needed later")
        found = self._read(pointer, name)
        setattr(self, name, found)
        return found

    def _read(self, pointer, name):
        if name in self._POINTERS:
            return array(self._POINTERS[name](pointer), self.n, 3)
        if name == "species":
            return array(pointer.species, self.n, kind="u1")
        if name == "stress":
            return np.array(value(pointer.stress))
        return array(getattr(pointer, name), self.n_species)

    def close(self):
        self._pointer = None


class Observable(Extension):
    """An observable from a Python function."""

    def __init__(self, name, function, quantities, doc, state, collision):
        super().__init__(name, function)
        self.quantities, self.state, self.collision, self._doc = quantities, state, collision, doc

    def _recipe(self):
        return Observable, [self.name, self.function, self.quantities, self._doc, self.state, self.collision]

    def add_to(self, scene):
        table = ffi.new("gg_quantity_definition[]", len(self.quantities))
        for entry, (name, unit) in zip(table, self.quantities.items()):
            entry.name, entry.unit = self.text(name), self.text(unit)
        definition = new("gg_observable_definition")
        definition.name, definition.doc = self.text(self.name), self.text(self._doc)
        definition.n_quantities, definition.quantities = len(table), table
        definition.state_size, definition.context = 8 * self.state, self._handle
        definition.sample = lib.ggpy_sample
        if self.collision is not None:
            definition.collision = lib.ggpy_view
        check(lib.gg_scene_add_observable, scene, definition)

    def call(self, function, view, pointer):
        """function(view), or function(view, state) on a copy of a replica's state, which a function may keep."""
        if not self.state:
            return function(view)
        memory = np.frombuffer(ffi.buffer(pointer, 8 * self.state))
        state = memory.copy()
        found = function(view, state)
        memory[:] = state
        return found

    def store(self, found, into):
        """Stores the returned value of the function, as one number a quantity."""
        if isinstance(found, dict):
            unknown = set(found) - set(self.quantities)
            if unknown:
                raise BadInput(f"{self.name}: no quantity {sorted(unknown)[0]!r}; it defines {', '.join(self.quantities)}")
            found = [found.get(name, math.nan) for name in self.quantities]
        numbers = np.asarray(found, float).ravel()
        if len(numbers) != len(self.quantities):
            raise BadInput(f"{self.name}: returned {len(numbers)} numbers, not {len(self.quantities)}")
        for i, number in enumerate(numbers):
            into[i] = number


@ffi.def_extern(onerror=lambda *_: None)
def ggpy_sample(context, state, pointer, into):
    observable = ffi.from_handle(context)
    try:
        sample = Sample(pointer)
        try:
            observable.store(observable.call(observable.function, sample, state), into)
        finally:
            sample.close()
    except BaseException as error:
        observable.fail(error)


@ffi.def_extern(onerror=lambda *_: None)
def ggpy_view(context, state, pointer):
    observable = ffi.from_handle(context)
    try:
        observable.call(observable.collision, copy_of(pointer, VIEW), state)
    except BaseException as error:
        observable.fail(error)


def define_observable(name, quantities=None, *, doc=None, state=0, collision=None):
    """Makes an observable of a function: @define_observable("skew") above def skew(sample).

    quantities   names and units: {"skew": "1"}, or names; None: one quantity of the observable's name
    state        so many numbers that the run keeps for each replica, also in checkpoints, zero at the start; the
                 functions then get it as second argument, an array of shape (state,), and change it in place
    collision    function(view) or function(view, state), called with each collision while averaging

    The function takes a Sample and returns a number, a list, or a dict of numbers by quantity, in units of results.
    Replicas call it from several threads. scene.add() registers the observable.
    """
    if not isinstance(name, str):
        raise TypeError('define_observable: give a name first: @define_observable("skew")')
    if quantities is None:
        quantities = [name]
    quantities = dict(quantities) if isinstance(quantities, dict) else {quantity: "1" for quantity in quantities}

    state = whole(state, "state", 0, 2**20 - 1, "a whole number from 0 to 1048575")

    def make(function):
        _need_function(function, "define_observable")
        return Observable(name, function, quantities, doc or _first_line(function), state, collision)
    return make


def _need_function(function, what):
    if not callable(function):
        raise TypeError(f"{what}: expected a function, not {type(function).__name__}")


class Definition(Extension):
    """A theory from a Python function."""

    def __init__(self, name, function, quantities, title, citation, assumptions):
        super().__init__(name, function)
        self.quantities = list(quantities)
        self._texts = {"title": title, "citation": citation, "assumptions": assumptions}
        self._reasons = deque(maxlen=256)  # texts that the library reads after the function

    def _recipe(self):
        return Definition, [self.name, self.function, self.quantities, *self._texts.values()]

    def add_to(self, scene):
        definition = new("gg_theory_definition")
        names = ffi.new("char *[]", [self.text(name) for name in self.quantities])
        definition.name, definition.quantities = self.text(self.name), ffi.cast("const char *const *", names)
        definition.n_quantities, definition.context = len(self.quantities), self._handle
        for key, words in self._texts.items():
            setattr(definition, key, self.text(words))
        definition.evaluate = lib.ggpy_evaluate
        check(lib.gg_scene_add_theory, scene, definition)

    def reason(self, words):
        self._reasons.append(ffi.new("char[]", encode(_one_line(words) or "no reason given")))
        return self._reasons[-1]

    store = Observable.store


def _facts(pointer):
    facts = Record(**values(pointer, "species", "pairs"))
    n = facts.n_species
    facts.species = [Record(**values(pointer.species + i)) for i in range(n)]
    facts.pairs = [[Record(**values(pointer.pairs + n * i + j)) for j in range(n)] for i in range(n)]
    return facts


@ffi.def_extern(onerror=lambda *_: None)
def ggpy_evaluate(context, pointer, into):
    theory = ffi.from_handle(context)
    try:
        found = theory.function(_facts(pointer))
        if isinstance(found, str):
            return theory.reason(found)
        theory.store(math.nan if found is None else found, into)
        return ffi.NULL
    except DoesNotApply as reason:
        return theory.reason(str(reason))
    except BaseException as error:
        theory.fail(error)
        return theory.reason(f"{type(error).__name__}: {error}")


def define_theory(name, quantities, *, title=None, citation=None, assumptions=None):
    """Makes a theory of a function: @define_theory("mine", ["temperature"]) above def mine(facts).

    quantities   names of quantities that it answers
    facts        flow, thermostat, restitution_law, phi, density, shear_rate, gravity, box, temperature, stress_unit,
                 n_species, species[i] (fraction, diameter, mass, inertia), pairs[i][j] (e, beta, mu, diameter,
                 contact_value), in units of results

    The function returns a number, a list, or a dict of numbers by quantity; or a text, or raises DoesNotApply: the
    reason why it does not apply, a text that continues the name ("describes free cooling"). scene.add() registers the
    theory; theory() and scan() take it as it is.
    """
    quantities = [quantities] if isinstance(quantities, str) else quantities

    def make(function):
        _need_function(function, "define_theory")
        return Definition(name, function, quantities, title or _first_line(function), citation, assumptions)
    return make


class Law(Extension):
    """A law of restitution from a table, a Python function or a compiled function."""

    def add_to(self, scene):
        name = encode(self.name, "name")
        if self.table is not None:
            speed, e = self.table
            pointers = (ffi.cast("double *", ffi.from_buffer(column)) for column in (speed, e))
            return check(lib.gg_scene_set_restitution_table, scene, name, len(speed), *pointers)
        if self.address is not None:
            compiled = ffi.cast("gg_restitution *", self.address)
            return check(lib.gg_scene_set_restitution, scene, name, compiled, ffi.NULL)
        return check(lib.gg_scene_set_restitution, scene, name, lib.ggpy_law, self._handle)

    table = address = None
    takes_species = False

    def _recipe(self):
        return define_law, [self.function if self.table is None else [column.tolist() for column in self.table], self.name]


@ffi.def_extern(error=1.0, onerror=lambda *_: None)
def ggpy_law(context, speed, first, second):
    law = ffi.from_handle(context)
    try:
        return float(law.function(speed, first, second) if law.takes_species else law.function(speed))
    except BaseException as error:
        law.fail(error)
        return 1.0


def define_law(law, name="own") -> Law:
    """A law of restitution e(g), for scene.add(). It replaces collision.e and collision.law between grains.

    law   a function of the normal speed, or of the speed and the two species (from 0), that returns e, 0 to 1;
          a pair of arrays, ascending speeds and values of e: linear between them, constant beyond;
          a numba.cfunc("float64(voidptr, float64, int32, int32)"): context, speed, species, compiled

    Speeds have the units of results. The function is called at every collision; a table is the fastest. Values outside
    0 to 1 are clamped (NaN: 0) and counted in the result, with a warning.
    """
    if hasattr(law, "address"):
        _check_signature(str(getattr(law, "_sig", "")))
        made = Law(name, law)
        made.address = int(law.address)
    elif callable(law):
        made = Law(name, law)
        made.takes_species = _positional(law) >= 3
    else:
        made = Law(name, None)
        made.table = _law_table(law)
    return made


def _check_signature(found):
    """Checks the signature of a numba.cfunc: with another one the library would read other registers."""
    if found and not re.fullmatch(r"\(\S+\*, float64, int32, int32\) -> float64", found):
        raise TypeError(f'define_law: the compiled function is {found}; expected '
                        'numba.cfunc("float64(voidptr, float64, int32, int32)")')


def _positional(function):
    try:
        parameters = inspect.signature(function).parameters.values()
    except (TypeError, ValueError):
        return 1
    kinds = inspect.Parameter.POSITIONAL_ONLY, inspect.Parameter.POSITIONAL_OR_KEYWORD
    return sum(p.kind in kinds and p.default is inspect.Parameter.empty for p in parameters)


def _law_table(law):
    try:
        speed, e = (np.ascontiguousarray(column, float) for column in law)
    except (TypeError, ValueError):
        raise TypeError("define_law: expected a function, a compiled function, or a pair of arrays: speeds and e") from None
    if speed.ndim != 1 or speed.shape != e.shape or not len(speed):
        raise BadInput(f"define_law: speeds and e need the same length, at least 1; shapes are {speed.shape} and {e.shape}")
    return speed, e
