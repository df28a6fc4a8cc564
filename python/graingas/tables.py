# SPDX-License-Identifier: GPL-3.0-or-later
"""Tables of results: text, HTML, pandas."""
import html
import math


def number(value):
    return "" if value is None or (isinstance(value, float) and math.isnan(value)) else f"{value:.4g}"


def as_text(head, rows):
    """Columns of equal width; the first to the left, the others to the right."""
    cells = [list(map(str, row)) for row in [head, *rows]]
    widths = [max(map(len, column)) for column in zip(*cells)]
    lines = ["  ".join([row[0].ljust(widths[0]), *(cell.rjust(w) for cell, w in zip(row[1:], widths[1:]))]).rstrip()
             for row in cells]
    return "\n".join([lines[0], "-" * len(lines[0]), *lines[1:]])


def as_html(title, head, rows, notes=()):
    def row(cells, tag):
        return "<tr>" + "".join(f"<{tag}>{html.escape(str(cell))}</{tag}>" for cell in cells) + "</tr>"
    parts = [f"<p>{html.escape(title)}</p>", "<table><thead>", row(head, "th"), "</thead><tbody>",
             *(row(cells, "td") for cells in rows), "</tbody></table>"]
    return "".join(parts + [f"<p>{html.escape(note)}</p>" for note in notes])
