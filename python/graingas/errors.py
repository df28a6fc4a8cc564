# SPDX-License-Identifier: GPL-3.0-or-later
"""Errors of the library as exceptions. The text is the library's: what is wrong, where, what is allowed."""
from . import _c

ffi, lib = _c.ffi, _c.lib


class GraingasError(Exception):
    """Base of all errors. `result` is what a run had when it failed, or None."""

    result = None
    __str__ = Exception.__str__


class BadInput(GraingasError, ValueError):
    """A scene or an argument is wrong."""


class NotFound(BadInput, KeyError):
    """There is no quantity, theory or point of this name here."""


class BadFile(GraingasError, OSError):
    """A file could not be read or written."""


class RunFailed(GraingasError, RuntimeError):
    """The run failed: no memory, inelastic collapse, grains that no longer collide."""


class Busy(BadInput):
    """The object is in use by another thread, or by the call whose callback uses it."""


class PartialResult(UserWarning):
    """A run ended before its stopping criteria; its result has the means so far."""


KINDS = {lib.GG_BAD_INPUT: BadInput, lib.GG_BAD_FILE: BadFile, lib.GG_FAILED: RunFailed}


def new_error():
    return ffi.new("gg_error *")


def text(pointer):
    """A borrowed C string as str; None for NULL."""
    return None if pointer == ffi.NULL else ffi.string(pointer).decode("utf-8", "replace")


def exception(status, error):
    return KINDS.get(status, GraingasError)(text(error.message) or "the call failed without a message")


def check(function, *arguments):
    """Calls a function whose last argument is the error; raises the error that it reports."""
    error = new_error()
    status = function(*arguments, error)
    if status != lib.GG_OK:
        raise exception(status, error)


def look_up(function, *arguments):
    """check() for names: BadInput becomes NotFound."""
    try:
        check(function, *arguments)
    except BadInput as error:
        raise NotFound(str(error)) from None


def not_found(what, name, known, none=""):
    """The NotFound for a name that is not among the known ones. none: advice if no names are known."""
    words = [ffi.new("char[]", encode(word)) for word in known]
    near = text(lib.gg_nearest_word(encode(str(name)), ffi.new("char *[]", words + [ffi.NULL])))
    there_are = ", ".join(list(known)[:40]) + ", ..." * (len(known) > 40) or f"none{none}"
    return NotFound(f"there is no {what} called {name!r}; "
                    + (f"did you mean {near!r}?" if near else f"there are: {there_are}"))


class ByName(dict):
    """A dict whose error for a missing name lists the known names."""

    what = none = ""

    @classmethod
    def of(cls, what, content, none=""):
        made = cls(content)
        made.what, made.none = what, none
        return made

    def __missing__(self, name):
        raise not_found(self.what, name, self, self.none)


def encode(value, what="text"):
    """str, bytes or a path as the C string of a call."""
    if hasattr(value, "__fspath__"):
        value = value.__fspath__()
    if isinstance(value, str):
        try:
            value = value.encode("utf-8", "surrogateescape")
        except UnicodeEncodeError as error:
            raise BadInput(f"{what}: is no valid text: {error.reason}") from None
    if not isinstance(value, bytes):
        raise TypeError(f"{what}: expected a text, not {type(value).__name__}")
    if b"\0" in value:
        raise BadInput(f"{what}: contains a null character")
    return value


def owned_text(pointer):
    """The text behind a char ** that the caller frees."""
    try:
        return text(pointer[0])
    finally:
        lib.free(pointer[0])
