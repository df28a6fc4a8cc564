# SPDX-License-Identifier: GPL-3.0-or-later
"""Entries: validation/figures/NAME.yaml, every key checked. Errors name the file, the line and the key."""
import copy
import difflib
import os
import re
from dataclasses import dataclass, field

import graingas as gg
import yaml
from graingas.scene import KEYS
from graingas.yaml import write

from . import curves
from .formula import Formula

FOLDER = os.path.join(os.path.dirname(os.path.dirname(os.path.abspath(__file__))), "figures")
VERDICTS = "agrees", "differs", "not comparable", "open"
ENGINES = "md", "dsmc"
FINDS = "value", "zero", "minimum", "maximum", "prefactor", "exponent"
KINDS = "quantity", "number", "curve", "series", "frames", "snapshot"  # what a panel shows
TAILS = ["2", "4.5"], ["3.3", "5.5"]
MARKERS = {"circle": "o", "square": "s", "triangle": "^", "diamond": "D", "inverted triangle": "v", "plus": "P", "cross": "X"}
THEORIES, QUANTITIES = gg.catalogue.theories(), gg.catalogue.quantities()


class BadEntry(Exception):
    """FILE:LINE: key 'KEY': what is wrong."""


class Map(dict):
    """A map of the file, with the lines of its keys."""

    def __deepcopy__(self, memo):
        return {key: copy.deepcopy(value, memo) for key, value in self.items()}

    def __init__(self, reader, node):
        self.reader, self.line, self.lines = reader, node.start_mark.line + 1, {}
        for key, value in node.value:
            if key.value in self:
                reader.refuse(key.start_mark.line + 1, key.value, "is given twice")
            self[key.value], self.lines[key.value] = reader.read(value), key.start_mark.line + 1

    def refuse(self, key, what):
        self.reader.refuse(self.lines.get(key, self.line), key, what)

    def only(self, *allowed):
        for key in self:
            if key not in allowed:
                near = difflib.get_close_matches(key, allowed, 1)
                self.refuse(key, f"did you mean '{near[0]}'?" if near else f"is not known; allowed: {', '.join(allowed)}")
        return self

    def texts(self, key):
        """A text or a list of them, as a list."""
        value = self.get(key, [])
        value = value if isinstance(value, list) else [value]
        if not all(isinstance(text, str) for text in value):
            self.refuse(key, "is a text or a list of texts")
        return value

    def number(self, key, default=None):
        try:
            return float(self[key]) if key in self else default
        except (TypeError, ValueError):
            self.refuse(key, f"'{self[key]}' is no number")

    def formula(self, key):
        try:
            return Formula(self[key]) if key in self else None
        except (AttributeError, ValueError) as error:
            self.refuse(key, str(error))

    def flag(self, key, default=False):
        if self.get(key, "true") not in ("true", "false"):
            self.refuse(key, "is true or false")
        return self[key] == "true" if key in self else default

    def map(self, key):
        if not isinstance(self.get(key), (Map, type(None))):
            self.refuse(key, "is a map")
        return self.get(key)

    def maps(self, key):
        value = self.get(key, [])
        if not isinstance(value, list) or not all(isinstance(one, Map) for one in value):
            self.refuse(key, "is a list of maps")
        return value

    def scene_keys(self, key):
        """{collision.e: 0.9, phi: [0.1, 0.3]}: keys of scenes with the values that they may have."""
        found = self.map(key)
        return {name: _scene_key(found, name) and found.texts(name) for name in found} if found else {}

    def names(self, key, known, what):
        for name in self.texts(key):
            if name not in known:
                self.refuse(key, f"there is no {what} '{name}'")
        return self.texts(key)


class Reader:
    """Texts, lists and Maps of one file."""

    def __init__(self, path, text):
        self.file = os.path.basename(path)
        try:
            self.root = yaml.compose(text, yaml.BaseLoader)
        except yaml.YAMLError as error:
            self.refuse(error.problem_mark.line + 1, None, error.problem)
        if not isinstance(self.root, yaml.MappingNode):
            self.refuse(1, None, "is no map")

    def read(self, node):
        if isinstance(node, yaml.MappingNode):
            return Map(self, node)
        return [self.read(part) for part in node.value] if isinstance(node, yaml.SequenceNode) else node.value

    def refuse(self, line, key, what):
        raise BadEntry(f"{self.file}:{line}: " + (f"key '{key}': " if key else "") + what)


def _take(m):
    """An abscissa, a range [from, to], a law of decay with its range, or a word."""
    if "take" not in m or m["take"] in curves.WORDS:
        return m.get("take")
    try:
        if isinstance(m["take"], list) and m["take"][0] in curves.DECAYS and len(m["take"]) == 3:
            return [m["take"][0], float(m["take"][1]), float(m["take"][2])]
        return [float(end) for end in m["take"]] if isinstance(m["take"], list) else float(m["take"])
    except ValueError:
        m.refuse("take", f"is an abscissa, a range [from, to], a law [{'|'.join(curves.DECAYS)}, from, to], or one of {', '.join(curves.WORDS)}")


def _scene_key(of, key):
    stem = re.sub(r"\.\d+$", "", key)
    if stem not in KEYS and not re.fullmatch(r"species\.\d+\.\w+", key):
        of.refuse(key, "is no key of a scene")
    return True


@dataclass
class Axis:
    label: str = None
    formula: Formula = None
    log: bool = False
    range: tuple = None

    @classmethod
    def of(cls, m):
        if ("from" in m) != ("to" in m) or m.number("from", 0) > m.number("to", 1e300):
            m.refuse("from", "and to come together, from below to")
        return cls(m.get("label"), m.formula("as"), m.flag("log"), ("from" in m and (m.number("from"), m.number("to"))) or None)


@dataclass
class Source:
    """The source of a panel or of a number of the text."""
    kind: str
    names: list  # quantities, curves, or the plane of a snapshot
    number: str = None  # kind "number": name of the number of the curve
    take: object = None  # kind "curve" in a number: abscissa, range or word, see curves.py
    frame: int = 0  # kind "snapshot": number of the frame, from the end
    beside: bool = True  # kind "curve": draw the law, too
    relative_to: dict = field(default_factory=dict)
    relative_theory: str = None
    formula: Formula = None

    @classmethod
    def of(cls, m):
        kinds = [kind for kind in KINDS if kind in m and not (kind == "curve" and "number" in m)]
        if len(kinds) != 1:
            m.refuse("y", f"names what is shown, one of: {', '.join(KINDS)}")
        names = m.texts("curve" if kinds[0] == "number" else kinds[0])
        if not names:
            m.refuse("number", "is that of a curve: give it")
        if kinds[0] in ("quantity", "series"):
            m.names(kinds[0], QUANTITIES, "quantity")
        if names[0] not in {"snapshot": ("xy", "zy"), "frames": ("velocity",)}.get(kinds[0], names):
            m.refuse(kinds[0], "is xy or zy" if kinds[0] == "snapshot" else "is velocity")
        number, to = m.get("number"), m.map("relative_to") or {}
        if "tail" in m and (m["tail"] not in TAILS or number not in ("alpha", "gamma")):
            m.refuse("tail", "is [2, 4.5] or [3.3, 5.5], and goes with number: alpha or gamma")
        if "tail" in m:
            number = "_".join([number, *m["tail"]])
        return cls(kinds[0], names, number, _take(m), int(m.number("frame", 0)), m.flag("beside", True),
                   {} if "theory" in to else m.scene_keys("relative_to"),
                   to.names("theory", THEORIES, "theory")[0] if "theory" in to else None, m.formula("as"))


@dataclass
class Panel:
    title: str
    sweeps: list  # empty: all
    x: Axis
    y: Axis
    key: str  # scene key on the x axis; None: see x_number
    x_number: str  # number of the curve on the x axis
    source: Source
    lines: dict  # scene keys, one line for each of their values, with their labels
    line_formula: Formula
    symbols: list  # of the lines, in their order
    surface: bool
    where: dict
    engines: list
    theories: list
    theories_at: dict  # scene keys with other values for theories
    guides: dict

    @classmethod
    def of(cls, m, sweeps):
        m.only("title", "of", "x", "y", "lines", "where", "engines", "theories", "theories_at", "guides", "symbols", "surface")
        x = m.map("x").only("key", "number", "label", "as", "from", "to", "log") if "x" in m else None
        y = m.map("y") if "y" in m else m.refuse("y", "must be given")
        y.only(*KINDS, "tail", "frame", "beside", "relative_to", "as", "label", "from", "to", "log")
        lines = m.map("lines").only("by", "label", "as") if "lines" in m else None
        source, key = Source.of(y), x.get("key") if x else None
        if key:
            _scene_key(x, key)
        over_key = source.kind == "quantity" or (source.kind == "number" and not (x and "number" in x))
        if over_key != bool(key):
            m.refuse("x", "needs the scene key that this is drawn over" if over_key else "has no scene key here")
        if m.get("theories") and source.kind not in ("quantity", "curve"):
            m.refuse("theories", "give quantities and curves alone")
        by = lines.texts("by") if lines else []
        labels = lines.texts("label") if lines and "label" in lines else [key_label(key) for key in by]
        if len(labels) != len(by) or not all(_scene_key(lines, key) for key in by):
            lines.refuse("label", "is one for each key of the lines")
        guides = {guide.only("label", "as").get("label"): guide.formula("as") for guide in m.maps("guides")}
        if None in [*guides, *guides.values()]:
            m.refuse("guides", "have a label and a formula each")
        return cls(m.get("title"), m.names("of", sweeps, "sweep"), Axis.of(x) if x else Axis(), Axis.of(y), key,
                   x and x.get("number"), source, dict(zip(by, labels)), lines and lines.formula("as"),
                   [MARKERS[name] for name in m.names("symbols", MARKERS, "symbol")], m.flag("surface"),
                   m.scene_keys("where"), m.names("engines", ENGINES, "engine"),
                   m.names("theories", THEORIES, "theory"), m.scene_keys("theories_at"), guides)


@dataclass
class Number:
    """A number of the paper's text (which has `paper`) or of the verdict (which has `name`)."""
    name: str
    what: str
    where: str
    sweep: str
    over: str
    paper: float
    paper_error: float
    find: str
    source: Source
    x: Formula
    at: dict
    theories: list

    @classmethod
    def of(cls, m, sweeps):
        m.only("name", "what", "where", "sweep", "over", "paper", "error", "find", "of", "x", "as", "at", "theories")
        if not ("name" in m or ("what" in m and "paper" in m)) or "of" not in m:
            m.refuse("numbers", "have `of` and either a name, or `what` they are and what the paper has")
        over, find = m.get("over"), m.get("find", "value")
        if over:
            _scene_key(m, over)
        if find not in FINDS or (find != "value" and not over):
            m.refuse("find", f"is one of {', '.join(FINDS)}, along the key `over`")
        if isinstance(m["of"], Map):
            source = Source.of(m["of"].only("quantity", "number", "curve", "take", "tail", "as", "relative_to"))
        else:
            source = Source("quantity", m.names("of", QUANTITIES, "quantity"))
        if source.kind not in ("quantity", "number") + ("curve",) * (source.take is not None) or len(source.names) != 1:
            m.refuse("of", "is one quantity, or of one curve a number or what to `take`")
        source.formula = m.formula("as") or source.formula
        digits = len(m["paper"].partition(".")[2]) if "paper" in m else 0
        return cls(m.get("name"), m.get("what", m.get("name")), m.get("where"),
                   (m.names("sweep", sweeps, "sweep") or [None])[0], over, m.number("paper"),
                   m.number("error", 0.5 * 10.0**-digits), find, source, m.formula("x"), m.scene_keys("at"),
                   m.names("theories", THEORIES, "theory"))


@dataclass
class Entry:
    path: str
    figure: str  # "thesis 3.5"
    shows: str
    sweeps: dict  # name -> a Sweep, or the name of the figure whose sweep is used
    quick: dict  # values of scene keys and of `vary` with --quick
    panels: list
    numbers: list
    verdict: str
    because: str

    @property
    def base(self):
        return os.path.basename(self.path)[:-len(".yaml")]


@dataclass
class Sweep:
    """A sweep file within an entry. Its text has the lines of the entry, for messages."""
    text: str
    keys: dict

    def quick(self, changes):
        """The text with the values of `changes`. A map `vary` replaces values of single keys, which then come last;
        lists of maps are replaced as a whole."""
        keys = copy.deepcopy(dict(self.keys))
        for key, value in changes.items():
            if key == "vary":
                if isinstance(value, dict) and isinstance(keys["vary"], dict):
                    value = {**{k: v for k, v in keys["vary"].items() if k not in value}, **value}
                keys["vary"] = value
                continue
            head, _, rest = key.partition(".")
            keys[head] = {**keys.get(head, {}), rest: value} if rest else value
        return write(keys)


def _sweep(text, reader, node):
    if not isinstance(node, yaml.MappingNode):
        return node.value
    start = node.start_mark
    return Sweep("\n" * start.line + " " * start.column + text[start.index:node.end_mark.index] + "\n", reader.read(node))


def read(path):
    with open(path, encoding="utf-8") as file:
        text = file.read()
    reader = Reader(path, text)
    root = reader.read(reader.root).only("figure", "shows", "sweep", "sweeps", "quick", "panels", "numbers", "verdict", "because")
    for key in "figure", "shows", "panels":
        if key not in root:
            root.refuse(key, "must be given")
    if ("sweep" in root) == ("sweeps" in root):
        root.refuse("sweep", "or sweeps must be given, one of them")
    nodes = {key.value: value for key, value in reader.root.value}
    named = {"": nodes["sweep"]} if "sweep" in root else {key.value: value for key, value in nodes["sweeps"].value}
    quick = root.map("quick") or {}
    vary = [] if "vary" not in quick else quick.maps("vary") if isinstance(quick["vary"], list) else [quick.map("vary")]
    for of in [quick, *vary]:
        for key in of:
            if of is not quick or key != "vary":
                _scene_key(of, key)
    if root.get("verdict", "open") not in VERDICTS:
        root.refuse("verdict", f"'{root['verdict']}' is not allowed; allowed: {', '.join(VERDICTS)}")
    return Entry(path, root["figure"], root["shows"], {name: _sweep(text, reader, node) for name, node in named.items()}, quick,
                 [Panel.of(panel, named) for panel in root.maps("panels")],
                 [Number.of(number, named) for number in root.maps("numbers")], root.get("verdict", "open"),
                 root.get("because", "").strip())


def files(folder=FOLDER):
    """Paths of all entries: the thesis's, then the review's, then those of other papers, each by number."""
    names = [name for name in os.listdir(folder) if name.endswith(".yaml")]
    return [os.path.join(folder, name) for name in sorted(names, key=lambda name: (not name.startswith("thesis"), name.startswith("arxiv"), name))]


def _simple(name):
    """"Thesis_3.05", "fig. thesis-3.5" -> "thesis 3.5"."""
    words = re.sub(r"[ _:-]+", " ", name.lower()).strip().removesuffix(".yaml")
    return re.sub(r"(?<=[ .])0+(?=\d)", "", words)


def find(name, folder=FOLDER):
    """The path of "thesis 3.5", "thesis-3.05", "3.5". Raises BadEntry, which names the nearest."""
    wanted = _simple(name)
    names = {_simple(os.path.basename(path)): path for path in files(folder)}
    found = [one for one in names if wanted in (one, one.partition(" ")[2])]
    if len(found) == 1:
        return names[found[0]]
    if found:
        raise BadEntry(f"figure '{name}' is in several papers: {' or '.join(found)}?")
    near = difflib.get_close_matches(wanted, names, 1, 0.5)
    hint = f"; did you mean '{near[0]}'?" if near else ""
    raise BadEntry(f"there is no figure '{name}'{hint} (validation/reproduce list names all)")


LABELS = {"collision.e": "e", "collision.beta": "β", "collision.mu": "μ", "phi": "φ", "particles": "N", "mass": "m",
          "diameter": "σ", "fraction": "x"}


def key_label(key):
    """"species.2.mass" -> "m_{2}"."""
    species = re.fullmatch(r"species\.(\d+)\.(\w+)", key)
    return f"{LABELS.get(species[2], species[2])}_{{{species[1]}}}" if species else LABELS.get(key, key)
