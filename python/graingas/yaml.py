# SPDX-License-Identifier: GPL-3.0-or-later
"""Values of scene keys: from Python to YAML of one line, and back."""
import json
import math
import re

import numpy as np

TOKEN = re.compile(r'\s*([][{},:]|"(?:[^"\\]|\\.)*"|[^][{},:\s][^][{},:]*)')


def write(value):
    """0.9 -> "0.9", [1, 2] -> "[1, 2]", {12: 0.8} -> "{12: 0.8}", None -> "none"; a text as it is."""
    if value is None:
        return "none"
    if isinstance(value, (bool, np.bool_)):
        return "true" if value else "false"
    if isinstance(value, (int, np.integer)):
        return str(int(value))
    if isinstance(value, (float, np.floating)):
        return _number(float(value))
    if isinstance(value, str):
        return value
    if isinstance(value, dict):
        return "{" + ", ".join(f"{write(key)}: {write(part)}" for key, part in value.items()) + "}"
    if isinstance(value, np.ndarray):
        return write(value.tolist())
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(write, value)) + "]"
    if hasattr(value, "mean") and hasattr(value, "error"):
        return _number(float(value.mean))
    raise TypeError(f"a value of type {type(value).__name__} is no value of a scene key")


def _number(value):
    if math.isinf(value):
        return "inf" if value > 0 else "-inf"
    digits, mark, exponent = repr(value).partition("e")
    return f"{digits}.0e{exponent}" if mark and "." not in digits else repr(value)  # "1e-07" is a text to YAML 1.1


def quote(text):
    """The text itself, whatever YAML reads in it: in double quotes."""
    return '"' + "".join("\\" + c if c in '"\\' else c if c.isprintable() else f"\\U{ord(c):08x}" for c in text) + '"'


def read(text):
    """What write() wrote, and what the library prints."""
    if text[:1] not in "[{":
        return _scalar(text)
    value, _ = _read(TOKEN.findall(text), 0)
    return value


def _scalar(text):
    text = text.strip()
    if text[:1] == '"':
        return json.loads(text)
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
            groups.setdefault(head, {})[rest] = value
        else:
            lines.append(f"{key}: {value}")
    for head, members in groups.items():
        lines.append(f"{head}: {{" + ", ".join(f"{key}: {value}" for key, value in members.items()) + "}")
    return "\n".join(lines) + "\n"
