# SPDX-License-Identifier: GPL-3.0-or-later
"""A figure as tables: NAME.csv, and NAME_numbers.csv."""
import csv
import io
import math
import os

POINTS = "panel x_name y_name y_unit method line x x_stderr y y_stderr settled".split()
NUMBERS = "name what where paper paper_error method x mean stderr z".split()


def _cell(value):
    if isinstance(value, bool):
        return "yes" if value else "no"
    return "" if value is None or (isinstance(value, float) and not math.isfinite(value)) else value


def write(path, content):
    """Write the file atomically: whole or not at all."""
    binary = isinstance(content, bytes)
    with open(path + ".part", "wb" if binary else "w", **({} if binary else {"encoding": "utf-8", "newline": ""})) as file:
        file.write(content)
    os.replace(path + ".part", path)


def _write_csv(path, head, rows):
    text = io.StringIO()
    writer = csv.writer(text, lineterminator="\n")
    writer.writerow(head)
    writer.writerows([_cell(value) for value in row] for row in rows)
    write(path, text.getvalue())


def write_points(path, tables):
    _write_csv(path, POINTS, ([k, t.x_label, t.y_label, t.y_unit or "1", line.method, line.group, *row]
                              for k, t in enumerate(tables, 1) for line in t.lines for row in line.rows))


def write_numbers(path, rows):
    _write_csv(path, NUMBERS, ([row.number.name, row.number.what, row.number.where, row.number.paper,
                                row.number.paper and row.number.paper_error, row.method, row.x, *row.value[:2], row.z]
                               for row in rows))


def read(path):
    with open(path, encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))
