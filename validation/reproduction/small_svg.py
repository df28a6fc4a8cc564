# SPDX-License-Identifier: GPL-3.0-or-later
"""SVG of matplotlib in a fifth of its bytes. Coordinates keep a tenth of a point, curves only the points that bend them;
the same style of all marks of a line stands once.

    PYTHONPATH=validation python3 -m reproduction.small_svg FILE.svg ..."""
import math
import re
import sys
from xml.etree import ElementTree

from matplotlib.font_manager import FontProperties, findfont, get_font
from matplotlib.ft2font import LOAD_NO_HINTING

SVG, LINK = "http://www.w3.org/2000/svg", "http://www.w3.org/1999/xlink"
FONTS = "font-family:'DejaVu Sans',Verdana,sans-serif"  # of nearly the same widths
BEND = 0.06  # points (1/72 inch): what a curve may lose
ARGUMENTS = {"M": 2, "L": 2, "Q": 4, "C": 6, "Z": 0}
SPAN = f"{{{SVG}}}tspan"
GROUP, PATH, USE, HREF = f"{{{SVG}}}g", f"{{{SVG}}}path", f"{{{SVG}}}use", f"{{{LINK}}}href"
ElementTree.register_namespace("", SVG)
ElementTree.register_namespace("xlink", LINK)


def _number(x, digits):
    text = f"{x:.{digits}f}".rstrip("0").rstrip(".") if digits else f"{x:.0f}"
    text = "0" if text in ("-0", "") else text
    return re.sub(r"^(-?)0\.", r"\1.", text)


def _joined(numbers):
    """SVG needs no blank before a minus."""
    return re.sub(r" -", "-", " ".join(numbers))


def _bends(points, tolerance=BEND):
    """Douglas and Peucker: the points without which the curve would lie farther off than the tolerance."""
    keep, spans = {0, len(points) - 1}, [(0, len(points) - 1)]
    while spans:
        a, b = spans.pop()
        (x, y), (u, v) = points[a], points[b]
        length = math.hypot(u - x, v - y)
        worst, at = tolerance, None
        for k in range(a + 1, b):
            p, q = points[k][0] - x, points[k][1] - y
            off = abs(p * (v - y) - q * (u - x)) / length if length else math.hypot(p, q)
            if off > worst:
                worst, at = off, k
        if at is not None:
            keep.add(at)
            spans += [(a, at), (at, b)]
    return [points[k] for k in sorted(keep)]


def _pieces(d):
    """[(letter, numbers)] of a path with absolute coordinates; None: it has others."""
    found = re.findall(r"([A-Za-z])([^A-Za-z]*)", re.sub(r"e([-+]\d)", r"E\1", d.replace("E", "e"))) if "e" not in d else None
    if found is None or any(letter.upper() != letter and letter != "z" for letter, _ in found):
        return None
    pieces = []
    for letter, text in found:
        numbers, n = [float(x) for x in text.replace(",", " ").split()], ARGUMENTS.get(letter.upper())
        if n is None or (n == 0 and numbers) or (n and len(numbers) != n):
            return None
        pieces.append((letter.upper(), numbers))
    return pieces


def _without_straight_points(pieces):
    shorter, k = [], 0
    while k < len(pieces):
        end = k + 1
        while end < len(pieces) and pieces[end][0] == "L":
            end += 1
        if pieces[k][0] == "M" and end - k > 3:
            shorter += [("ML"[j > 0], list(p)) for j, p in enumerate(_bends([p for _, p in pieces[k:end]]))]
        else:
            shorter += pieces[k:end]
        k = end
    return shorter


def small_path(d, digits=1):
    """The path with relative coordinates of so many decimals; errors do not add up."""
    pieces = _pieces(d)
    if pieces is None:
        return d
    text, last, x, y, start = "", "", 0.0, 0.0, (0.0, 0.0)
    for letter, numbers in _without_straight_points(pieces):
        rounded = [round(v, digits) for v in numbers]
        if letter == "Z":
            text, last, (x, y) = text + "z", "Z", start
            continue
        offsets = [_number(v - (y if k % 2 else x), digits) for k, v in enumerate(rounded)]
        if letter == "L" and "0" in offsets:
            if offsets == ["0", "0"] and text.count("m") == 1 and last != "M":
                continue
            letter, offsets = ("H", offsets[:1]) if offsets[1] == "0" else ("V", offsets[1:])
        words = _joined(offsets)
        text += letter.lower() + words if letter != last else words if words[0] == "-" else " " + words
        x, y = rounded[-2:]
        start, last = ((x, y), "M") if letter == "M" else (start, letter)
    return text


def _small_style(style):
    """Without the fonts, which the root has."""
    style = re.sub(r"font: (?:(oblique|italic) )?(?:(bold) )?([\d.]+)px [^;]*", lambda f: ";".join(
        filter(None, (f[1] and "font-style:" + f[1], f[2] and "font-weight:" + f[2], f"font-size:{f[3]}px"))), style)
    style = re.sub(r"\s*([:;])\s*", r"\1", style).strip("; ")
    return re.sub(r"#(.)\1(.)\2(.)\3(?![0-9a-f])", r"#\1\2\3", style)


def _rounded(text, digits):
    return re.sub(r"-?\d*\.\d+", lambda number: _number(float(number[0]), digits), text)


def _advance(character, font):
    """Width over the size of the font."""
    face = get_font(findfont(FontProperties(family="DejaVu Sans", style="oblique" if "oblique" in font else "normal",
                                            weight="bold" if "bold" in font else "normal")))
    face.set_size(100, 72)
    return face.load_char(ord(character), flags=LOAD_NO_HINTING).linearHoriAdvance / 65536 / 100


def _pieces_of_text(span):
    """Characters of a span that follow each other on one line: [left, height, end, size, text]. matplotlib gives each
    character a place of its own."""
    xs, ys, text, font = span.get("x", "0").split(), span.get("y", "0").split(), span.text or "", span.get("style", "")
    size = float(re.search(r"([\d.]+)px", font)[1])
    xs = xs if len(xs) == len(text) else [None] * len(text) if len(xs) != 1 else xs + [None] * (len(text) - 1)
    ys, found, last = ys if len(ys) == len(text) else ys[:1] * len(text), [], {}
    for character, x, y in zip(text, xs, map(float, ys)):  # by x: subscripts among superscripts
        piece = last.get(y)
        x = float(x) if x is not None else piece[2] if piece else 0.0
        if piece is None or abs(x - piece[2]) > 0.1 * size:
            piece = last[y] = [x, y, x, size, ""]
            found.append(piece)
        piece[2], piece[4] = x + size * _advance(character, font), piece[4] + character
    return [piece for piece in found if piece[4].strip()]


def _as_one_line(text):
    """A formula as pieces that follow each other, with steps up and down. Pieces with places of their own would lie over
    one another in other fonts than matplotlib's."""
    if not len(text) or any(span.tag != SPAN or span.get("dy") for span in text):
        return
    pieces = sorted(((piece, span) for span in text for piece in _pieces_of_text(span)), key=lambda one: one[0][0])
    if not pieces:
        return
    start, height = end, _ = pieces[0][0][:2]
    text[:] = []
    text.attrib.update({"x": _number(start, 2), "y": _number(height, 2)})
    for (left, y, right, size, characters), span in pieces:
        run = ElementTree.SubElement(text, SPAN, {"style": span.get("style", "")})
        run.text = characters.strip()
        left += size * _advance(" ", "") * (len(characters) - len(characters.lstrip()))
        right -= size * _advance(" ", "") * (len(characters) - len(characters.rstrip()))
        if left - end > 0.15 * size:  # some programs leave out blanks at the start of a piece
            run.set("dx", _number(left - end, 2))
        if abs(y - height) > 0.01:
            run.set("dy", _number(y - height, 2))
        height, end = y, max(end, right)


def _properties(element):
    return set(filter(None, element.get("style", "").split(";")))


def _state_styles_once(root):
    """A mark has its style where it is defined or where it is used, not at both places."""
    marks = {path.get("id"): path for path in root.iter(PATH) if path.get("id")}
    uses = [(use, marks[use.get(HREF)[1:]]) for use in root.iter(USE) if use.get(HREF, "")[1:] in marks]
    for use, mark in uses:
        if use.get("style") and _properties(use) <= _properties(mark):
            del use.attrib["style"]
    for mark in marks.values():
        users = [use for use, other in uses if other is mark]
        if mark.get("style") and users and all(_properties(mark) <= _properties(use) for use in users):
            del mark.attrib["style"]


def _share(element):
    """Move a style or clip path that all children have to their parent."""
    for name in "style", "clip-path":
        values = {child.get(name) for child in element}
        if len(element) > 1 and len(values) == 1 and None not in values and not element.get(name):
            element.set(name, values.pop())
            for child in element:
                del child.attrib[name]


def _unwrap(element):
    """A group without attributes is its children."""
    for k, child in reversed(list(enumerate(element))):
        _unwrap(child)
        if child.tag == GROUP and not child.attrib:
            element[k:k + 1] = list(child)


def _merge_lines(element):
    """Neighbours without an area and with the same style become one path: nothing depends on which is drawn first."""
    kept = []
    for child in element:
        same = {k: v for k, v in child.items() if k != "d"}
        if child.tag == PATH and "fill:none" in child.get("style", element.get("style", "")) and "id" not in same:
            if re.fullmatch(r"m\S+( \S+)? 0[ ,]0|m\S+( \S+)?h0", child.get("d")):
                continue  # a bar of no length
            if kept and kept[-1].tag == PATH and same == {k: v for k, v in kept[-1].items() if k != "d"}:
                kept[-1].set("d", kept[-1].get("d") + re.sub("^m", "M", child.get("d")))
                continue
        kept.append(child)
    element[:] = kept


def _caps_as_paths(root):
    """Uses of a mark that is one straight line become lines."""
    marks = {path.get("id"): path.get("d") for path in root.iter(PATH)
             if path.get("id") and [letter for letter, _ in _pieces(path.get("d")) or []] == ["M", "L"]}
    for group in root.iter(GROUP):
        for use in group:
            d = marks.get(use.get(HREF, "")[1:]) if use.tag == USE else None
            if d and "transform" not in use.attrib:
                place = float(use.get("x", 0)), float(use.get("y", 0))
                moved = [(letter, [v + place[k % 2] for k, v in enumerate(numbers)]) for letter, numbers in _pieces(d)]
                use.tag, use.attrib = PATH, {k: v for k, v in use.items() if k not in (HREF, "x", "y")}
                use.set("d", " ".join([letter + " " + " ".join(map(repr, numbers)) for letter, numbers in moved]))
                use.set("style", "fill:none;" + re.sub(r"fill: ?[^;]*(; ?|$)", "", use.get("style", "")))
    for parent in list(root.iter()):
        for child in list(parent):
            if child.tag == PATH and child.get("id") in marks:
                parent.remove(child)


def small_svg(text):
    root = ElementTree.fromstring(text)
    for metadata in root.findall(f"{{{SVG}}}metadata"):
        root.remove(metadata)
    root.set("style", FONTS)
    _caps_as_paths(root)
    for label in root.iter(f"{{{SVG}}}text"):
        _as_one_line(label)
    referenced = set(re.findall(r'(?:href="|url\()#([^")]+)', text))
    short = {name: f"{'' if k < 26 else k // 26}{chr(97 + k % 26)}"[::-1] for k, name in enumerate(sorted(referenced))}
    for element in root.iter():
        element.tail = None
        if element.text is not None and not element.text.strip() and element.tag != f"{{{SVG}}}tspan":
            element.text = None
        for name, value in list(element.items()):
            if name == "d":
                element.set(name, small_path(value, 2 if element.get("id") and len(value) < 400 else 1))
            elif name == "style":
                element.set(name, _small_style(value))
            elif name == "id":
                if value in referenced:
                    element.set(name, short[value])
                else:
                    del element.attrib[name]
            elif name == HREF and value.startswith("#"):
                element.set(name, "#" + short[value[1:]])
            elif name == "clip-path":
                element.set(name, re.sub(r"#([^)]+)", lambda found: "#" + short[found[1]], value))
            elif name in ("x", "y", "width", "height", "transform") and element.tag != f"{{{SVG}}}image":
                value = re.sub(r"rotate\(-?0 [^)]*\)", "", value)
                element.set(name, _rounded(value, 1 if name in "xy" and element.tag != f"{{{SVG}}}tspan" else 2))
                if not value:
                    del element.attrib[name]
        if element.tag == f"{{{SVG}}}text" and len(element) == 0 and element.text:
            element.text = element.text.strip()
    for definitions in [d for d in root.iter(f"{{{SVG}}}defs") if len(d) == 0]:
        next(parent for parent in root.iter() if definitions in list(parent)).remove(definitions)
    _state_styles_once(root)
    for element in root.iter(GROUP):
        _share(element)
    _unwrap(root)
    for element in root.iter(GROUP):
        _merge_lines(element)
    return ElementTree.tostring(root, encoding="unicode").replace(" />", "/>") + "\n"


def main(paths):
    for path in paths:
        with open(path, encoding="utf-8") as file:
            text = file.read()
        with open(path, "w", encoding="utf-8") as file:
            file.write(small_svg(text))


if __name__ == "__main__":
    main(sys.argv[1:])
