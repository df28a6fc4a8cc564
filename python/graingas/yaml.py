# SPDX-License-Identifier: GPL-3.0-or-later
"""Values of scene keys: from Python to YAML of one line, and back."""
import json
import math
import numbers
import os
import re
from collections.abc import Iterable, Mapping
from decimal import Decimal

import numpy as np

QUOTED = re.compile(r"""\"(?:[^"\\]|\\.)*"|'(?:[^']|'')*'""")
TOKEN = re.compile(rf"\s*({QUOTED.pattern}|[][{{}},:]|[^][{{}},:\s][^][{{}},:]*)")
PLAIN = re.compile(r"(?!- |-$)[\w.+-](([\w.+/ -]|:(?=[\w.+-]))*[\w.+/-])?")  # a text that needs no quotation marks


def write(value):
    """0.9 -> "0.9", [1, 2] -> "[1, 2]", {12: 0.8} -> "{12: 0.8}", None -> "none"; a text as one value, whatever it
    contains: in quotation marks unless it is a word, a number, a list or a map."""
    if value is None:
        return "none"
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, (numbers.Real, Decimal)) or hasattr(value, "mean") and hasattr(value, "error"):
        return _number(float(value))
    if isinstance(value, (str, os.PathLike)):
        return _text(os.fspath(value))
    if isinstance(value, Mapping):
        return "{" + ", ".join(f"{write(key)}: {write(part)}" for key, part in value.items()) + "}"
    if hasattr(value, "tolist"):  # of numpy and pandas
        return write(value.tolist())
    if isinstance(value, Iterable) and not isinstance(value, (bytes, bytearray)):
        return "[" + ", ".join(map(write, value)) + "]"
    raise TypeError(f"a value of type {type(value).__name__} is no value of a scene key")


def _number(value):
    """1e-07 would be a text in YAML 1.1: 1.0e-07."""
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    digits, e, exponent = repr(value).partition("e")
    return f"{digits}.0e{exponent}" if e and "." not in digits else repr(value)


def _text(words):
    return words if PLAIN.fullmatch(words) or _is_flow(words) else quoted(words)


def _is_flow(words):
    """Is a text one list or map of YAML that ends with its last character?"""
    depth, at, begins = 0, 0, False
    while at < len(words) and (depth or at == 0):
        c = words[at]
        if c in "\n\r#":
            return False
        if begins and c in "\"'":
            if not (found := QUOTED.match(words, at)):
                return False
            at = found.end() - 1
        depth += (c in "[{") - (c in "]}")
        begins = c in "[{," or begins and c.isspace() or c == ":" and words[at + 1:at + 2].isspace()
        at += 1
    return depth == 0 and at == len(words) and words[:1] in ("[", "{")


def quoted(words):
    """A text in quotation marks, which YAML does not read as a number, a list or a map. YAML's line breaks and
    unprintable characters are escaped, in a way that JSON has, too.
    """
    def escaped(c):
        return "\\" + c if c in '"\\' else c if c.isprintable() or ord(c) > 0xffff else f"\\u{ord(c):04x}"
    return '"' + "".join(map(escaped, words)) + '"'


def read(text):
    """Reads the YAML of write() and of the library."""
    if text[:1] not in ("[", "{"):
        return _scalar(text)
    value, _ = _read(TOKEN.findall(text), 0)
    return value


def _scalar(text):
    text = text.strip()
    if text[:1] == text[-1:] == '"' and len(text) > 1:
        return json.loads(text)
    if text[:1] == text[-1:] == "'" and len(text) > 1:
        return text[1:-1].replace("''", "'")
    for kind in int, float:
        try:
            return kind(text)
        except ValueError:
            pass
    return text


def _read(tokens, at):
    if tokens[at] == "[":
        return _read_list(tokens, at + 1)
    if tokens[at] == "{":
        return _read_map(tokens, at + 1)
    return _scalar(tokens[at]), at + 1


def _read_list(tokens, at):
    found = []
    while tokens[at] != "]":
        value, at = _read(tokens, at)
        found.append(value)
        at += tokens[at] == ","
    return found, at + 1


def _read_map(tokens, at):
    found = {}
    while tokens[at] != "}":
        key = _scalar(tokens[at])
        value, at = _read(tokens, at + 2)
        found[key] = value
        at += tokens[at] == ","
    return found, at + 1


def nested(flat):
    """{"collision.e": "0.9"} as YAML with maps in maps."""
    groups, lines = {}, []
    for key, value in flat.items():
        head, _, rest = key.partition(".")
        if rest:
            groups.setdefault(head, {})[_text(rest)] = value
        else:
            lines.append(f"{_text(key)}: {value}")
    for head, members in groups.items():
        lines.append(f"{_text(head)}: {{" + ", ".join(f"{key}: {value}" for key, value in members.items()) + "}")
    return "\n".join(lines) + "\n"
