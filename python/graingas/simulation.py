# SPDX-License-Identifier: GPL-3.0-or-later
"""Simulations, step by step."""
from __future__ import annotations

import html
import warnings
from contextlib import contextmanager, nullcontext
from typing import Any, Callable, Iterator, Optional

import numpy as np

from . import _c, calls, tables, yaml
from .arguments import real, whole
from .errors import BadInput, check, encode, exception, lib, new_error, text
from .grains import Grains, copy_grains, grains_from
from .handles import Handle
from .result import bytes_of, from_bytes
from .run import serving
from .scene import GROUPS, KEYS, SHORT, Scene, as_scene
from .structs import Record, array, dtype, new, values

ffi = _c.ffi

ADVANCED = "the simulation can be advanced further"  # text of KeyboardInterrupt

EVENT = dtype("gg_collision_event")


class Event:
    """A collision of two grains, in units of results.

    grain (2) places in the arrays of `grains`; species (2) from 0; k (3) unit vector from the first to the second;
    velocity (3) of the first relative to the second, before; normal_speed, > 0; impulse (3) on the second; time
    """

    __slots__ = ("_bytes",)

    def __init__(self, content):
        self._bytes = content

    def __getattr__(self, name):
        if name not in EVENT.names:
            raise AttributeError(name)
        return np.frombuffer(self._bytes, EVENT)[0][name]

    def __dir__(self):
        return list(EVENT.names)

    def __repr__(self):
        return f"<collision of {self.grain[0]} and {self.grain[1]} at time {self.time:g}>"


class _Watcher:
    """The callback for collisions, and the call in which they occur."""

    def __init__(self):
        self.function = self.call = None
        self.c = ffi.new("ggpy_watch *")
        self._handle = ffi.new_handle(self)
        self.c.self = self._handle

    def set(self, function):
        self.function = function
        self.c.watching = function is not None

    def install(self, simulation):
        if self.c.watching:
            check(lib.gg_simulation_on_collision, simulation, ffi.addressof(lib, "ggpy_show"), self.c)

    def finished(self):
        """After a call: is the callback no longer registered?"""
        return not self.c.watching


class _Recorder:
    """Records the collisions of one call, in place of the watcher."""

    def __init__(self):
        self.call, self.c = None, ffi.gc(ffi.new("ggpy_watch *"), lib.ggpy_forget)

    def install(self, simulation):
        check(lib.gg_simulation_on_collision, simulation, ffi.addressof(lib, "ggpy_record"), self.c)

    def finished(self):
        return True

    def events(self):
        if self.c.lost:
            raise MemoryError("events: no memory for all collisions; record fewer at a time")
        found = array(self.c.events, self.c.n, kind=EVENT)
        return (np.zeros(0, EVENT) if found is None else found).view(np.recarray)


@ffi.def_extern(onerror=lambda *_: None)
def ggpy_collision(context, event):
    watcher = ffi.from_handle(context)
    try:
        watcher.function(Event(bytes(ffi.buffer(event, EVENT.itemsize))))
    except BaseException as error:
        watcher.set(None)
        watcher.call.fail(error)


def followed(scene):
    """The keys for transient runs that a scene gives; "": none."""
    given = [key for key, value in scene.given().items() if key in ("run.duration", "protocol") and value]
    return " and ".join(given)


class Simulation:
    """The grains of a scene, advanced step by step. Nothing is averaged: run() does that.

    Simulation(scene, stream=0)      the scene's engine and seed; other streams are independent copies
    Simulation(scene, positions=x, velocities=v, spins=w, species=k)
                                     grains from outside, arrays of shape (n, 3) and (n,) as of `grains`; dsmc has no
                                     positions. Raises BadInput, which names two grains that overlap

    A protocol of the scene is not applied: change keys by sim[key] = value, or use run() or relax().

    The same scene, seed and stream give the same trajectory, bit for bit. Numbers have the units of results. One thread
    at a time may use a simulation: other uses, also from its own callback, raise Busy. Ctrl-C ends an advance within
    0.1 s and raises KeyboardInterrupt; the simulation can be advanced further. It ends a start, too, and copying,
    saving and loading.
    """

    def __init__(self, scene, stream: int = 0, *, positions=None, velocities=None, spins=None, species=None):
        scene = as_scene(scene).copy()
        if followed(scene):
            warnings.warn(f"{followed(scene)} of the scene: no effect on a Simulation; run() follows it", stacklevel=2)
        grains = grains_from(None, position=positions, velocity=velocities, spin=spins, species=species)
        self._start(scene, stream, calls.Call(), *grains)

    def _start(self, scene, stream, call, *grains, together=None):
        calls.left_behind(lambda: self._adopt(_started(scene, stream, call, *grains), scene, together), call,
                          "the simulation was not started")

    def __setattr__(self, name, value):
        if (name in KEYS or name in GROUPS or name in SHORT) and not hasattr(Simulation, name):
            raise AttributeError(f"{name} is a key of the scene; change it by sim[{SHORT.get(name, name)!r}]")
        object.__setattr__(self, name, value)

    def _adopt(self, pointer, scene, together=None):
        self._scene = Scene._copy_of(lib.gg_simulation_scene(pointer), scene._extensions if scene else ())
        self._handle = Handle(pointer, lib.gg_simulation_free, "simulation")
        self._watcher, self._together = _Watcher(), together
        self._stop = together.c if together else ffi.new("ggpy_call *")
        check(lib.gg_simulation_on_stop, pointer, ffi.addressof(lib, "ggpy_stop"), self._stop)

    @classmethod
    def _one_of(cls, scene, stream, together):
        """One of several simulations that stop together, from their start to their last advance: all use one Call."""
        made = cls.__new__(cls)
        made._start(scene, stream, together, together=together)
        return made

    @classmethod
    def _from_pointer(cls, pointer, scene):
        made = cls.__new__(cls)
        made._adopt(pointer, scene)
        return made

    @contextmanager
    def _in_use(self):
        """The pointer and the Call of a long call."""
        call = self._together
        with self._handle.held() as pointer:
            if call is None:
                call = calls.Call()
                self._stop.stop, call.c = 0, self._stop
            with serving(self._scene, call):
                yield pointer, call

    def _advance(self, function, amount, recorder=None):
        watcher = recorder or self._watcher
        with self._in_use() as (pointer, call):
            watcher.install(pointer)
            watcher.call = call
            try:
                calls.finished(lambda error: function(pointer, amount, error), call, ADVANCED)
            finally:
                if watcher.finished():
                    check(lib.gg_simulation_on_collision, pointer, ffi.NULL, ffi.NULL)

    def advance(self, time: float) -> Simulation:
        """Advances by a time. Raises RunFailed: inelastic collapse."""
        self._advance(lib.gg_simulation_advance, real(time, "time"))
        return self

    def collide(self, collisions: int) -> Simulation:
        """Advances by a number of collisions between grains; each counts once."""
        self._advance(lib.gg_simulation_collide, whole(collisions, "collisions"))
        return self

    def view(self, every: Optional[float] = None, size: int = 360, rate: float = 8):
        """A live View for a notebook: every: time between pictures (None: a fifth of a diameter at the thermal speed);
        size: of the picture in pixels; rate: pictures in a second, at most. For md.
        """
        from .live import View
        return View(self, every, size, rate)

    def frames(self, every: float, n: Optional[int] = None) -> Iterator[Simulation]:
        """Advances by `every`, n times (None: without end): for sim in sim.frames(0.1, 50)."""
        k, every, n = 0, real(every, "every"), n if n is None else whole(n, "n")
        while n is None or k < n:
            yield self.advance(every)
            k += 1

    def on_collision(self, function: Optional[Callable[[Any], None]]):
        """Calls function(event) at every collision between grains, with grain, species, k, velocity, normal_speed,
        impulse, time. None removes the callback, also from within the function. Callbacks cost time, and Monte Carlo
        has another trajectory meanwhile. An exception of the function ends the advance, which raises it."""
        if function is not None and not callable(function):
            raise TypeError("on_collision: expected a function or None")
        self._watcher.set(function)
        return function

    def events(self, collisions: int) -> np.ndarray:
        """Advances by a number of collisions and returns them: a record array of shape (n,) with grain (2), species (2),
        k (3), velocity (3), normal_speed, impulse (3), time. Monte Carlo records its whole last step."""
        recorder = _Recorder()
        self._advance(lib.gg_simulation_collide, whole(collisions, "collisions"), recorder)
        return recorder.events()

    @property
    def scene(self) -> Scene:
        """A copy of the scene, with the keys that were changed."""
        return self._scene.copy()

    def __getitem__(self, key):
        return self._scene[key]

    def __setitem__(self, key, value):
        """Changes a key on the way: sim["collision.e"] = 0.8. Allowed: collision.*, bath.*, thermostat,
        gaussian_rate, noise_strength, shear_rate, md.contact_time, dsmc.time_step, walls.e, walls.beta,
        walls.mu, walls.temperature, walls.accommodation, gravity. Grains, time, counts, random stream and units (of
        time: 1/shear_rate of the start) stay. The simulation is unchanged if this raises BadInput."""
        if not isinstance(key, str):
            raise TypeError(f"a key of a scene is a text, not {type(key).__name__}")
        key = SHORT.get(key, key)
        name, value = encode(key, "key"), encode(yaml.write(value), key)
        with self._in_use() as (pointer, call):
            try:
                calls.finished(lambda error: lib.gg_simulation_set(pointer, name, value, error), call, ADVANCED)
            finally:  # Ctrl-C may come after the change
                self._scene = Scene._copy_of(lib.gg_simulation_scene(pointer), self._scene._extensions)

    @property
    def state(self) -> Record:
        """time, collisions, collisions_per_grain, grains, temperature, rotational_temperature, kinetic_stress (3, 3),
        strain, image_offset, box (3; 0 without positions), periodic (3: the box repeats along x, y, z)."""
        state = new("gg_simulation_state")
        with self._handle.held() as pointer:
            check(lib.gg_simulation_get_state, pointer, state)
        return Record(**values(state))

    @property
    def time(self) -> float:
        return self.state.time

    @property
    def temperature(self) -> float:
        return self.state.temperature

    @property
    def species(self) -> list:
        """Properties of each species: grains, diameter, mass, inertia (4I/(m d^2)), temperature,
        rotational_temperature.
        """
        with self._handle.held() as pointer:
            return species_of(lib.gg_simulation_get_species, pointer, lib.gg_simulation_species(pointer))

    @property
    def grains(self) -> Grains:
        """A copy of positions, velocities, spins and species. In md the order of grains never changes."""
        state = self.state
        with self._handle.held() as pointer:
            return copy_grains(lib.gg_simulation_get_grains, pointer, state.grains, state.box[0] > 0)

    def set_grains(self, positions=None, velocities=None, spins=None, species=None) -> None:
        """Replaces positions, velocities, spins or species; None keeps the present ones. Time, counts and random stream
        continue. The simulation is unchanged if this raises BadInput: a wrong shape, overlapping grains.
        """
        n = self.state.grains
        grains, kept, _ = grains_from(n, position=positions, velocity=velocities, spin=spins, species=species)
        with self._in_use() as (pointer, call):
            calls.finished(lambda error: lib.gg_simulation_set_grains(pointer, grains, n, error), call, ADVANCED)
        del kept

    @property
    def hash(self) -> int:
        """Hash of the state, to the last bit."""
        found = ffi.new("uint64_t *")
        with self._handle.held() as pointer:
            check(lib.gg_simulation_hash, pointer, found)
        return found[0]

    @property
    def walls(self) -> list:
        """Names of the walls."""
        with self._handle.held() as pointer:
            names = (lib.gg_simulation_wall(pointer, i) for i in range(lib.GG_WALLS))
            return [text(name) for name in names if name != ffi.NULL]

    def take_sums(self) -> Record:
        """Collision sums since the last call or the start, and resets them: time, collisions, wall_collisions,
        collisional_stress (3, 3), dissipation, wall_impulse, wall_loss, wall_heat, injection."""
        sums = new("gg_simulation_sums")
        with self._handle.held() as pointer:
            check(lib.gg_simulation_take_sums, pointer, sums)
        return Record(**values(sums))

    def save(self, path) -> None:
        """Writes everything needed to continue with bit-identical results. The file appears whole or not at all."""
        path, call = encode(path, "file name"), calls.Call()
        with self._handle.held() as pointer:
            calls.finished(lambda error: lib.gg_simulation_save(pointer, path, *call.stopping, error), call,
                           "the file is whole or unchanged")

    @classmethod
    def load(cls, path, scene=None) -> Simulation:
        """A saved simulation, without its callbacks. scene: the scene that was saved; None: the stored one."""
        path = encode(path, "file name")

        def load(*more):
            made = ffi.new("gg_simulation **")
            check(lib.gg_simulation_load, path, *more, made)
            return made[0]
        return cls._read(load, scene)

    def to_bytes(self) -> bytes:
        """The content of the file of save(), in memory."""
        call = calls.Call()
        return self._handle.read(lambda pointer: bytes_of(lib.gg_simulation_to_bytes, pointer, *call.stopping), call=call)

    @classmethod
    def from_bytes(cls, content: bytes, scene=None) -> Simulation:
        """A simulation from the bytes of a saved file or of to_bytes(); scene as for load(). Raises BadFile if they are
        damaged."""
        return cls._read(lambda *more: from_bytes(lib.gg_simulation_from_bytes, "gg_simulation **", content, *more), scene)

    @classmethod
    def _read(cls, function, scene):
        """The simulation that function(pointer of a scene or NULL, *call.stopping) reads."""
        scene, call = scene if scene is None else as_scene(scene).copy(), calls.Call()

        def work():
            with nullcontext(ffi.NULL) if scene is None else scene.held() as pointer:
                return cls._from_pointer(function(pointer, *call.stopping), scene)
        return calls.left_behind(work, call)

    def copy(self) -> Simulation:
        """A copy that continues with the same bits, without the callback."""
        scene, call = self._scene, calls.Call()

        def copy(pointer):
            made = ffi.new("gg_simulation **")
            check(lib.gg_simulation_copy, pointer, *call.stopping, made)
            return Simulation._from_pointer(made[0], scene)
        return self._handle.read(copy, call=call)

    def __reduce__(self):
        return Simulation.from_bytes, (self.to_bytes(), self._scene)

    def close(self) -> None:
        """Frees the memory; later uses raise BadInput."""
        self._handle.close()

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def _repr_html_(self):
        if self._handle.closed:
            return "<p>closed simulation</p>"
        try:
            state, species = self.state, self.species
        except BadInput as error:
            return f"<p>{html.escape(str(error))}</p>"
        rows = [["time", f"{state.time:g}"], ["collisions", state.collisions],
                ["collisions per grain", f"{state.collisions_per_grain:.4g}"], ["grains", state.grains],
                *([f"temperature{f' {i}' * (len(species) > 1)}", f"{one.temperature:.4g}"] for i, one in enumerate(species, 1)),
                ["rotational temperature", tables.number(state.rotational_temperature)]]
        return tables.as_html(self._scene.title, ["state", self._scene["engine"]], rows)

    def __repr__(self):
        if self._handle.closed:
            return "<graingas.Simulation: closed>"
        try:
            state = self.state
        except BadInput as error:
            return f"<graingas.Simulation: {error}>"
        return (f"<graingas.Simulation: {self._scene.title}; {state.grains} grains, time {state.time:g}, "
                f"{state.collisions} collisions>")


def _started(scene, stream, call, grains=None, kept=(), n=0):
    """The pointer of a new simulation; the call can stop its start."""
    made, options = ffi.new("gg_simulation **"), new("gg_start_options")
    options.stream, options.context, options.stop = whole(stream, "stream"), call.c, ffi.addressof(lib, "ggpy_stop")
    with scene.held() as pointer, serving(scene, call):
        if kept:
            check(lib.gg_simulation_from_grains, pointer, grains, n, options, made)
        else:
            check(lib.gg_simulation_new, pointer, options, made)
    return made[0]


def species_of(function, pointer, n):
    found = []
    for i in range(n):
        state = new("gg_species_state")
        check(function, pointer, i, state)
        found.append(Record(**values(state)))
    return found
