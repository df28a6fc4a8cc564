# SPDX-License-Identifier: GPL-3.0-or-later
"""Structs of the header in Python: creation, copies in numpy, reading as simple values."""
import numpy as np

from . import _c
from .errors import text

ffi = _c.ffi

SCALARS = {"double": "f8", "int": "i4", "uint64_t": "u8", "int64_t": "i8", "size_t": "u8", "unsigned char": "u1"}


def new(name):
    """A zeroed struct; options have their size."""
    made = ffi.new(name + " *")
    if name.endswith("_options"):
        made.size = ffi.sizeof(name)
    return made


def _field_format(kind):
    shape = ()
    while kind.kind == "array":
        shape, kind = shape + (kind.length,), kind.item
    return SCALARS[kind.cname], shape


def dtype(name):
    """The numpy type of a struct of numbers, for copies of whole structs."""
    names, formats, offsets = [], [], []
    for field, description in ffi.typeof(name).fields:
        if description.type.kind == "pointer":
            continue
        names.append(field)
        formats.append(_field_format(description.type))
        offsets.append(description.offset)
    return np.dtype((np.record, {"names": names, "formats": formats, "offsets": offsets, "itemsize": ffi.sizeof(name)}))


def copy_of(pointer, kind):
    """One struct behind a pointer, copied as a record with attributes."""
    whole = np.frombuffer(ffi.buffer(pointer, kind.itemsize), kind)
    return whole.copy().view(np.recarray)[0]


def array(pointer, *shape, kind="f8"):
    """A copy of numbers behind a pointer; None for NULL."""
    if pointer == ffi.NULL:
        return None
    count = int(np.prod(shape))
    size = count * np.dtype(kind).itemsize
    return np.frombuffer(ffi.buffer(pointer, size), kind).copy().reshape(shape) if size else np.zeros(shape, kind)


def address(values, kind):
    """A pointer into a numpy array, which has to outlive it."""
    return ffi.cast(kind, ffi.from_buffer(values)) if values is not None else ffi.NULL


def value(member):
    """A member as float, int, str or nested tuples."""
    if isinstance(member, (int, float)):
        return member
    if isinstance(member, bytes):
        return member.decode("utf-8", "replace")
    kind = ffi.typeof(member)
    if kind.kind == "pointer":
        return text(member)
    if kind.kind == "array" and kind.item.cname == "char":
        return text(ffi.cast("char *", member))
    return tuple(value(part) for part in member)


def values(struct, *leave_out):
    """All members of a struct by name."""
    names = (name for name, _ in ffi.typeof(struct).item.fields)
    return {name: value(getattr(struct, name)) for name in names if name not in leave_out}


class Record:
    """Named values: attributes, completion, and a repr with a line for each."""

    def __init__(self, **members):
        self.__dict__.update(members)

    def __repr__(self):
        width = max(map(len, self.__dict__), default=0)
        return "\n".join(f"{name:{width}}  {member!r}" for name, member in self.__dict__.items())

    def __eq__(self, other):
        return isinstance(other, Record) and self.__dict__ == other.__dict__
