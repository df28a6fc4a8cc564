# SPDX-License-Identifier: GPL-3.0-or-later
"""The texts of verdicts, whose numbers come from NAME_numbers.csv, and the page of all figures.

{kurtosis: 3.51(1), 3.04(1)} in a text has the values of `kurtosis` in the table, in the order of the key that it is
over. Words after the name select: an engine or theory; `at 0.5`; `range`, `min`, `max`; `bare` omits errors,
`percent` is 100 times the number, `size` its absolute value, `z` the number over its error.
"""
import math
import os
import re
import textwrap

from . import entry as entries
from .tables import read, write

ROOT = os.path.dirname(os.path.dirname(entries.FOLDER))
PICTURES = os.path.join(ROOT, "docs", "images", "reproduction")
FILLED = re.compile(r"\{([^{}:]+):\s+([^{}]*)\}")
CHOICES = "range", "min", "max", "bare", "percent", "size", "z", "at"


def format_number(mean, error, bare=False):
    """1.364, 0.021 -> "1.36(2)". Errors that begin with 1 have two digits. Unknown error: three digits of the mean."""
    if not error > 0:
        return f"{mean:.3g}"
    digits = -int(f"{error:.0e}".partition("e")[2])
    if f"{error:.0e}"[0] == "1" and not bare:
        digits += 1
    digits = max(digits, 0)
    mean = round(mean, digits) + 0.0  # no "-0.0"
    return f"{mean:.{digits}f}" if bare else f"{mean:.{digits}f}({error * 10**digits:.0f})"


def _words(words):
    """Parse "lun1991 at 0.5 bare": returns the method and a map of the choices."""
    parts, found, method = words.split(), {}, None
    while parts:
        word = parts.pop(0)
        if word == "at" and parts:
            found["at"] = float(parts.pop(0))
        elif word in CHOICES:
            found[word] = True
        else:
            method = word
    return method, found


def filled(words, table):
    """The text of one number. Raises KeyError if it is not in the table."""
    name, _, rest = words.partition(" ")
    method, choice = _words(rest)
    rows = [row for row in table if row["name"] == name]
    methods = [row["method"] for row in rows]
    method = method or next((engine for engine in entries.ENGINES if engine in methods), None)
    rows = [row for row in rows if row["method"] == method
            and ("at" not in choice or abs(float(row["x"]) - choice["at"]) < 1e-9)]
    if not rows:
        raise KeyError(words)
    scale = 100 if "percent" in choice else 1
    values = [(scale * float(row["mean"]), scale * float(row["stderr"] or "nan")) for row in rows]
    values = [(abs(mean) if "size" in choice else mean, error) for mean, error in values]
    if "z" in choice:
        values = [(mean / error, 0.0) for mean, error in values if error > 0] or [(math.nan, 0.0)]
    least, largest = min(values), max(values)
    values = [least, largest] if "range" in choice else [least] if "min" in choice else [largest] if "max" in choice else values
    return (" to " if "range" in choice else ", ").join(f"{value[0]:+.1f}" if "z" in choice else format_number(*value, "bare" in choice) for value in values)


def plain(text):
    """The text without the braces and names of its numbers."""
    return FILLED.sub(r"\2", text)


def from_table(text, table):
    """The text with its numbers replaced by those of the table."""
    return FILLED.sub(lambda m: f"{{{' '.join(m[1].split())}: {filled(' '.join(m[1].split()), table)}}}", text)


def fill(entry, folder=PICTURES):
    """Write the numbers of FOLDER/NAME_numbers.csv into the verdict of an entry. Returns whether the entry changed."""
    path = os.path.join(folder, entry.base + "_numbers.csv")
    if not os.path.exists(path):
        return False
    try:
        because = from_table(entry.because, read(path))
    except KeyError as missing:
        raise entries.BadEntry(f"{entry.base}.yaml: key 'because': {path} has no number '{missing.args[0]}'") from None
    if because == entry.because:
        return False
    with open(entry.path, encoding="utf-8") as file:
        head = file.read().partition("\nbecause:")[0]
    lines = textwrap.wrap(because, 118, break_long_words=False, break_on_hyphens=False)
    write(entry.path, head + "\nbecause: >\n" + "".join(f"  {line}\n" for line in lines))
    return True


def counts(all_entries):
    found = {verdict: sum(entry.verdict == verdict for entry in all_entries) for verdict in entries.VERDICTS}
    return ", ".join(f"{verdict} {n}" for verdict, n in found.items() if n)


def page(folder=entries.FOLDER):
    """The text of docs/appendix/reproduction.md: head.md and a section for each figure."""
    with open(os.path.join(folder, "head.md"), encoding="utf-8") as file:
        parts = [file.read()]
    found = [entries.read(path) for path in entries.files(folder)]
    parts.append(f"\n# {len(found)} figures\n\n{counts(found)}.\n")
    for entry in found:
        kind = next((kind for kind in ("svg", "png") if os.path.exists(f"{PICTURES}/{entry.base}.{kind}")), None)
        picture = f"![{entry.figure}](../images/reproduction/{entry.base}.{kind})\n\n" if kind else ""
        text = f"{entry.shows}. **{entry.verdict.capitalize()}.** {plain(entry.because)}"
        wrapped = textwrap.fill(text, 120, break_long_words=False, break_on_hyphens=False)
        parts.append(f"\n## {entry.figure}\n\n{picture}{wrapped}\n")
    return "".join(parts)
