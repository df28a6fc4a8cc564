# SPDX-License-Identifier: GPL-3.0-or-later
"""Scenes: descriptions of simulations."""
from __future__ import annotations

import html
import json
import os
import re
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, Mapping as MappingOf

from . import _c, calls, catalogue, yaml
from .errors import BadInput, check, encode, lib, look_up, not_found, owned_text, text
from .handles import Handle
from .names import SceneKeys
from .structs import Record, new, values

ffi = _c.ffi

KEYS = catalogue.keys()
GROUPS = sorted({key.partition(".")[0] for key in KEYS if "." in key})
PATIENCE = 10  # seconds that a thread waits for another one that uses the same scene


def _short_names():
    """seed -> run.seed: last words that only one key has. The names e, beta and mu mean `collision`, not `walls`."""
    last = {}
    for key in KEYS:
        last.setdefault(key.rpartition(".")[2], []).append(key)
    short = {word: keys[0] for word, keys in last.items() if len(keys) == 1 and "." in keys[0] and word not in GROUPS}
    return {**short, **{word: f"collision.{word}" for word in ("e", "beta", "mu")}}


SHORT = _short_names()


def _documentation(key):
    entry = KEYS[key]
    lines = [f"{key}: {entry.doc}", f"Allowed: {entry.allowed}."]
    if entry.unit:
        lines.append(f"Unit: {entry.unit}, in the units of the scene.")
    if entry.value:
        lines.append(f"Default: {entry.value}.")
    if entry.when:
        lines.append(f"Has an effect when: {entry.when}.")
    return "\n".join(lines)


class _Member:
    """A key of a scene as an attribute, with the documentation of the key."""

    def __init__(self, key):
        self.key, self.__doc__ = key, _documentation(key)

    def __get__(self, owner, kind=None):
        return self if owner is None else owner[self.key]

    def __set__(self, owner, value):
        owner[self.key] = value


class Group(Mapping):
    """The keys of a scene that begin with one word: scene.collision.e is scene["collision.e"]."""

    __slots__ = ("_scene", "_name")

    def __init__(self, scene, name):
        object.__setattr__(self, "_scene", scene)
        object.__setattr__(self, "_name", name)

    def __dir__(self):
        return [key.partition(".")[2] for key in KEYS if key.startswith(self._name + ".")]

    def __getitem__(self, name):
        return self._scene[f"{self._name}.{name}"]

    def __setitem__(self, name, value):
        self._scene[f"{self._name}.{name}"] = value

    def __iter__(self):
        return iter(dir(self))

    def __len__(self):
        return len(dir(self))

    def __getattr__(self, name):
        try:
            return self[name]
        except BadInput as error:
            raise AttributeError(str(error)) from None

    def __setattr__(self, name, value):
        self[name] = value

    def __repr__(self):
        return "\n".join(f"{self._name}.{name}: {getattr(self, name)}" for name in dir(self))


if TYPE_CHECKING:
    from typing_extensions import Unpack

    from .names import KeyWords


class Scene(Mapping, SceneKeys):
    """The description of a simulation: a YAML file or YAML text, and keys.

    Scene("usf.yaml", e=0.8)
    Scene("flow: usf\\nphi: 0.1")
    Scene(flow="usf", phi=0.1, collision={"e": 0.9, "beta": 0})

    A mapping over the keys, which are attributes, too: s["collision.e.12"] = 0.8, s.collision.beta = 0, s.phi. Short
    names: e, beta and mu of collisions, and last words that only one key has (s.seed). Values are numbers (also
    Decimal, Fraction and those of numpy), texts, lists (also range, arrays, pandas.Series), dicts for pairs of species
    ({12: 0.8}), and None for `none`, in the units of the scene. s["theories"] has the theories of the text. `Scene.phi.__doc__`
    and `s.help("phi")` explain a key. Raises BadInput with the allowed values, BadFile.
    """

    def __init__(self, source: str | os.PathLike | MappingOf[str, Any] | None = None, **keys: Unpack[KeyWords]):
        changes = _flatten(keys)
        pointer = _load(source, changes)
        self._adopt(pointer, source._extensions if isinstance(source, Scene) else (), _file_of(source))
        for key, value in changes.items():
            self[key] = value

    def _adopt(self, pointer, extensions, file=None):
        object.__setattr__(self, "_handle", Handle(pointer, lib.gg_scene_free, "scene"))
        object.__setattr__(self, "_extensions", list(extensions))
        object.__setattr__(self, "_file", file)  # the file that it was read from, which no output may replace

    @classmethod
    def _from_pointer(cls, pointer, extensions=(), file=None):
        made = cls.__new__(cls)
        made._adopt(pointer, extensions, file)
        return made

    @classmethod
    def _copy_of(cls, pointer, extensions=(), file=None):
        """A copy of a scene that the library owns."""
        copy = ffi.new("gg_scene **")
        check(lib.gg_scene_copy, pointer, copy)
        return cls._from_pointer(copy[0], extensions, file)

    def held(self):
        return self._handle.held(PATIENCE)

    def __getitem__(self, key):
        key = SHORT.get(key, key)
        if key in GROUPS:
            return Group(self, key)
        if key == "theories":
            return json.loads(self.to_json()).get(key, {})
        value = yaml.read(self.text_of(key))
        if value == "none" and getattr(KEYS.get(key), "type", None) in ("number", "integer"):
            return None
        return value

    def text_of(self, key: str) -> str:
        """Value of a key in force, as YAML of one line."""
        buffer = ffi.new("char[]", 65536)
        with self.held() as scene:
            look_up(lib.gg_scene_get, scene, encode(key, "key"), buffer, len(buffer))
        return text(buffer)

    def __iter__(self):
        return iter(KEYS)

    def __len__(self):
        return len(KEYS)

    def __setitem__(self, key, value):
        if not isinstance(key, str):
            raise TypeError(f"a key of a scene is a text, not {type(key).__name__}")
        key = SHORT.get(key, key)
        if key in GROUPS and isinstance(value, dict):
            for name, part in value.items():
                self[f"{key}.{name}"] = part
            return
        if key == "theories":
            raise BadInput("theories: of a scene that is read they cannot be changed; give them to Scene(), or use "
                           "define_theory() and add()")
        with self.held() as scene:
            check(lib.gg_scene_set, scene, encode(key, "key"), encode(_written(key, value), key))

    def __getattr__(self, name: str) -> Any:
        if name.startswith("_"):
            raise AttributeError(name)
        try:
            return self[name]
        except BadInput as error:
            raise AttributeError(str(error)) from None

    def __setattr__(self, name, value):
        if name in ("_handle", "_extensions", "_file"):
            raise AttributeError(f"{name} cannot be set")
        self[name] = value

    def __dir__(self):
        return sorted({*object.__dir__(self), *(key for key in KEYS if "." not in key), *GROUPS, *SHORT})

    def _ipython_key_completions_(self):
        return list(KEYS)

    def keys(self) -> list[str]:
        """Names of all keys."""
        return list(KEYS)

    def given(self) -> dict:
        """Keys that were given, with their values; all others have their defaults."""
        return {key: self[key] for key in self._given_names()}

    def _given_names(self):
        with self.held() as scene:
            return [key for key, entry in catalogue.table(lib.GG_CATALOGUE_KEYS, scene).items() if entry.given]

    def to_yaml(self, all: bool = False) -> str:
        """YAML of the keys that were given; all=True: of every key with the value in force. With the theories that the
        text of the scene gives; not with what add() registered."""
        if not all:
            return yaml.nested(self._given_texts())
        made = ffi.new("char **")
        with self.held() as scene:
            check(lib.gg_scene_to_yaml, scene, made)
        return owned_text(made)

    def to_dict(self) -> dict:
        """The keys that were given, nested as in the file, with the theories of the text: Scene.from_dict() reads it."""
        found = {}
        for key, value in self.given().items():
            group, _, name = key.rpartition(".")
            (found.setdefault(group, {}) if group else found)[name] = value
        theories = self["theories"]
        return {**found, "theories": theories} if theories else found

    @classmethod
    def from_dict(cls, content: dict) -> Scene:
        """A scene from nested keys, as Scene(content)."""
        if not isinstance(content, dict):
            raise TypeError(f"from_dict: expected a dict, not {type(content).__name__}")
        return cls(content)

    def _given_texts(self):
        """The given values as YAML by key, theories last: JSON is YAML, too."""
        found, theories = {key: self.text_of(key) for key in self._given_names()}, self["theories"]
        return {**found, "theories": json.dumps(theories, ensure_ascii=False)} if theories else found

    def to_json(self) -> str:
        """Every key with the value in force, as JSON that Scene() reads; theories as to_yaml()."""
        made = ffi.new("char **")
        with self.held() as scene:
            check(lib.gg_scene_to_json, scene, made)
        return owned_text(made)

    def check(self) -> None:
        """Raises BadInput, with the reason, if the keys contradict each other."""
        with self.held() as scene:
            check(lib.gg_scene_check, scene)

    def copy(self, **keys: Unpack[KeyWords]) -> Scene:
        """A copy with some keys changed, and with the observables, theories and law of the scene."""
        with self.held() as scene:
            copy = Scene._copy_of(scene, self._extensions, self._file)
        for key, value in _flatten(keys).items():
            copy[key] = value
        return copy

    def add(self, *extensions) -> Scene:
        """Registers observables, theories and a law of define_observable(), define_theory(), define_law(); returns the
        scene."""
        for extension in extensions:
            if not hasattr(extension, "add_to"):
                raise TypeError(f"add: expected what define_observable(), define_theory() or define_law() returns, not "
                                f"{type(extension).__name__}")
            call = calls.Call()
            extension.calls.append(call)
            try:
                with self.held() as scene:
                    self._register(extension, scene, call)
            finally:
                extension.calls.remove(call)
        return self

    def _register(self, extension, scene, call):
        try:
            extension.add_to(scene)
        finally:
            self._extensions.append(extension)  # the library may use it from now on
        if call.error is not None:
            raise call.error

    @property
    def title(self) -> str:
        """One line: "Uniform shear flow, phi 0.3, e 0.9, smooth"."""
        buffer = ffi.new("char[]", 512)
        with self.held() as scene:
            check(lib.gg_scene_title, scene, buffer, len(buffer))
        return text(buffer)

    def needs(self, engine: str | None = None) -> Record:
        """Cost of a run on an engine: memory (bytes), cpu_seconds, collisions_per_grain, file (bytes)."""
        needs = new("gg_scene_needs")
        with self.held() as scene:
            check(lib.gg_scene_get_needs, scene, encode(engine or yaml.read(_get(scene, "engine")), "engine"), needs)
        return Record(**values(needs))

    def _lines(self, function, word):
        call = calls.Call()  # in a thread: an exception of Ctrl-C would be lost in the callback
        self._handle.read(lambda scene: check(function, scene, encode(word), lib.ggpy_line, call.c), PATIENCE)
        return call.lines

    def warnings(self, use: str = "theory") -> list[str]:
        """Keys that the scene gives and that have no effect: "md", "dsmc", "compare" or "theory"."""
        return self._lines(lib.gg_scene_warnings, use)

    def describe(self, engine: str) -> list[str]:
        """Features that an engine switches on and off for the scene, line by line."""
        return self._lines(lib.gg_scene_describe, engine)

    def help(self, key: str) -> None:
        """Prints what a key means, its unit, allowed values, default and value."""
        key = SHORT.get(key, key)
        try:
            value = self.text_of(key)
        except BadInput:
            raise not_found("key", key, KEYS) from None
        if key in KEYS:
            print(_documentation(key))
        print(f"Value: {value}")

    def __reduce__(self):
        return _restored, (self.to_yaml(), self._extensions, self._file)

    def __copy__(self):
        return self.copy()

    def __deepcopy__(self, memo):
        return self.copy()

    def __eq__(self, other):
        return isinstance(other, Scene) and self.to_yaml(all=True) == other.to_yaml(all=True) and \
            self._extensions == other._extensions

    __hash__ = None

    def __repr__(self):
        return f"<graingas.Scene: {self.title}>"

    def _repr_html_(self):
        return f"<p>{html.escape(self.title)}</p><pre>{html.escape(self.to_yaml())}</pre>"


def _restored(text, extensions, file):
    scene = Scene(text)
    object.__setattr__(scene, "_file", file)
    return scene.add(*extensions)


def _written(key, value):
    """A value as YAML. A file may have any name but a word that the key takes (none)."""
    word = getattr(KEYS.get(key), "type", None) == "file" and isinstance(value, (str, os.PathLike)) and value != "none"
    return yaml.quoted(os.fspath(value)) if word else yaml.write(value)


def _get(scene, key):
    buffer = ffi.new("char[]", 256)
    check(lib.gg_scene_get, scene, encode(key), buffer, len(buffer))
    return text(buffer)


def _flatten(keys):
    """{"collision": {"e": 1}, "beta": 0} -> {"collision.e": 1, "collision.beta": 0}; flow first."""
    flat = {}
    for key, value in keys.items():
        key = SHORT.get(key, key)
        if key in GROUPS and isinstance(value, dict):
            flat.update({f"{key}.{name}": part for name, part in value.items()})
        else:
            flat[key] = value
    return flat


def _load(source, changes):
    """The C scene of a file, a text, or of the keys alone; used keys are removed from `changes`."""
    made = ffi.new("gg_scene **")
    if source is None:
        keys = {key: _written(key, value) for key, value in changes.items() if key in KEYS or key == "theories"}
        for key in keys:
            del changes[key]
        for key in changes if not keys else ():
            if key.rpartition(".")[0] not in KEYS:  # of pairs of species
                raise not_found("key", key, KEYS)
        check(lib.gg_scene_parse, encode(yaml.nested(keys), "scene"), b"scene", made)
    elif isinstance(source, Scene):
        with source.held() as scene:
            check(lib.gg_scene_copy, scene, made)
    elif isinstance(source, dict):
        keys = {key: _written(key, value) for key, value in _flatten(source).items()}
        check(lib.gg_scene_parse, encode(yaml.nested(keys), "scene"), b"scene", made)
    elif _is_text(source):
        check(lib.gg_scene_parse, encode(source, "scene"), b"scene", made)
    else:
        check(lib.gg_scene_load, encode(source, "file name"), made)
    return made[0]


def _is_text(source):
    """YAML, not the name of a file: several lines, or a key and its value, or a map. A name may have colons, too."""
    if not isinstance(source, str) or _is_file(source):
        return False
    return "\n" in source or source.lstrip()[:1] == "{" or \
        bool(re.search(r":(\s|$)", source)) and not source.endswith((".yaml", ".yml", ".json"))


def _file_of(source):
    if isinstance(source, Scene):
        return source._file
    return None if source is None or isinstance(source, dict) or _is_text(source) else os.path.abspath(source)


def _is_file(name):
    try:
        return os.path.exists(name)
    except ValueError:
        return False


def as_scene(source):
    """A scene as it is; a file name, text or dict as a new one."""
    if isinstance(source, Scene):
        return source
    if source is None:
        raise BadInput("a scene is missing")
    if not isinstance(source, (str, bytes, dict, os.PathLike)):
        raise TypeError(f"scene: expected a Scene, a file name, YAML text or a dict, not {type(source).__name__}")
    return Scene(source)


for _key in KEYS:
    if "." not in _key:
        setattr(Scene, _key, _Member(_key))
for _word, _key in SHORT.items():
    if not hasattr(Scene, _word):
        setattr(Scene, _word, _Member(_key))
