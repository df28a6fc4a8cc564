# SPDX-License-Identifier: GPL-3.0-or-later
"""A figure as a picture, by matplotlib, in the style of graingas.plot: a colour and a symbol for each line, dashes for
theories. If both engines are shown, md has filled symbols and solid curves, dsmc half-filled symbols and broken curves.
Open symbols: points that are not converged."""
import io
import os
import re
import textwrap

import graingas as gg
import matplotlib
import numpy as np
from PIL import Image
from graingas.plot import COLOURS, DASHES, STYLE

from .entry import ENGINES, THEORIES, key_label
from .parameters import titles
from .small_svg import small_svg
from .tables import write

matplotlib.use("Agg")
from matplotlib import pyplot  # noqa: E402
from matplotlib import ticker  # noqa: E402
from matplotlib.lines import Line2D  # noqa: E402

MARKERS = "osD^vPX"
BROKEN = (0, (4, 1.5))  # curves of dsmc
DOTTED = (0, (1.2, 1.2)), (0, (4, 1, 1, 1))  # theories beside curves of engines
WIDTH, HEIGHT, BESIDE = 3.0, 2.4, 1.1  # size of a panel and width of a legend in inches
MOST_SHOWN = 12  # snapshots
LARGEST = 120_000  # bytes of an SVG; above it curves become pixels


NOT_CONVERGED = "not settled"  # label in the published pictures
WORDS = {"md": "MD", "dsmc": "DSMC", "enskog_hermite": "Enskog", "gaussian_closure": "Gaussian closure",
         "navier_stokes": "Navier-Stokes", "newtonian_gas": "Newtonian gas"}  # in legends
MARK = r"[_^](?:\{[^{}]*\}|[^\W_])"  # a subscript or superscript


def mathematics(label):
    """C_x/σ, T_{cell}/T and G_{CC}^{xx} in the notation of matplotlib."""
    def upright(found):
        marks = "".join(f"{mark[0]}{{\\rm {mark[1:].strip('{}')}}}" for mark in re.findall(MARK, found[2]))
        return f"${found[1]}{marks}$"
    return re.sub(rf"([^\W_]+\*?)((?:{MARK})+)", upright, label.replace("\\_", "_"))


def formatted(title, width=44):
    """A title in lines of at most this width."""
    return "\n".join(mathematics(line) for line in textwrap.wrap(title, width, break_long_words=False))


def layout(panels):
    """Rows and columns of panels with the fewest holes; at most three side by side."""
    columns = min((3, 2), key=lambda n: -panels % n) if panels > 3 else panels
    return -(-panels // columns), columns


def label_narrow_axis(axis):
    """Label 2 and 5 times powers of ten, too, where a logarithmic axis has fewer than two of these powers."""
    low, high = sorted(axis.get_view_interval())
    if low > 0 and high < 100 * low:
        axis.set_major_locator(ticker.LogLocator(subs=(1, 2, 5) if high > 3 * low else (1, 1.5, 2, 3, 5, 7)))
        axis.set_major_formatter(ticker.FormatStrFormatter("%g"))
        axis.set_minor_formatter(ticker.NullFormatter())


def _axis_label(label, unit):
    return mathematics(label) + (f" [{gg.plot.unit_text(unit)}]" if unit not in ("", "1") else "")


def method_label(method, panel):
    """"lun1991" -> "Lun (1991)", with values of scene keys that are the theory's alone."""
    if method not in THEORIES and method not in WORDS:
        return mathematics(method)
    words = re.fullmatch(r"([a-z_]+)(\d{4})", method)
    name = f"{words[1].title().replace('_', ', ')} ({words[2]})" if words else WORDS.get(method, method.replace("_", " "))
    instead = ["constant β" if (key, value) == ("collision.mu", ["inf"]) else f"{key_label(key)} = {value[0]}"
               for key, value in panel.theories_at.items()]
    return ", ".join([name, *instead])


class _Drawing:
    """One panel in its axes."""

    def __init__(self, ax, table, rasterized):
        self.ax, self.table, self.of, self.rasterized = ax, table, table.of, rasterized
        measured = [line for line in table.lines if line.method in ENGINES]
        self.groups = list(dict.fromkeys(line.group for line in measured)) or [""]
        self.methods = list(dict.fromkeys(line.method for line in table.lines if line.method not in ENGINES and line.rows))
        self.both = len({line.method for line in measured}) == 2
        self.unconverged = False

    def _colour(self, group):
        return COLOURS[self.groups.index(group) % len(COLOURS)] if group in self.groups else "black"

    def _marker(self, group):
        marks = self.of.symbols or MARKERS
        return marks[self.groups.index(group) % len(marks)] if group in self.groups else "o"

    def _dash(self, method):
        """Theories in the colours of the curves of engines are neither solid nor broken."""
        k = self.methods.index(method)
        coloured = any(line.style == "line" and line.group for line in self.table.lines)
        beside = coloured and any(line.style == "band" for line in self.table.lines)
        return DOTTED[k % len(DOTTED)] if beside else DASHES[k % len(DASHES)]

    def draw(self):
        for line in filter(lambda line: line.rows, self.table.lines):
            {"points": self._points, "band": self._band, "line": self._line}[line.style](line)
        of = self.of
        self.ax.set(xlabel=_axis_label(self.table.x_label, self.table.x_unit),
                    ylabel=_axis_label(self.table.y_label, self.table.y_unit), title=formatted(self.table.title),
                    xscale="log" if of.x.log else "linear", yscale="log" if of.y.log else "linear")
        for axis in [self.ax.xaxis] * of.x.log + [self.ax.yaxis] * of.y.log:
            label_narrow_axis(axis)
        if of.x.range:
            self.ax.set_xlim(of.x.range)
        if of.y.range:
            self.ax.set_ylim(of.y.range)
        return self.legend()

    def _points(self, line):
        converged, (x, x_error, y, error) = np.array([row[4] for row in line.rows]), line.columns
        fill = "bottom" if self.both and line.method == "dsmc" else "full"
        for some, style in (converged, fill), (~converged, "none"):
            self.unconverged |= style == "none" and some.any()
            if some.any():
                self.ax.errorbar(x[some], y[some], np.nan_to_num(error[some]), np.nan_to_num(x_error[some]), linestyle="none",
                                 color=self._colour(line.group), marker=self._marker(line.group), fillstyle=style,
                                 markerfacecoloralt="white", elinewidth=0.7)

    def _band(self, line):
        x, _, y, error = line.columns
        converged, colour = line.rows[0][4], self._colour(line.group)
        self.unconverged |= not converged
        solid = BROKEN if self.both and line.method == "dsmc" else "-"
        self.ax.plot(x, y, color=colour, linestyle=solid if converged else (0, (1, 1)), rasterized=self.rasterized)
        known = np.isfinite(error)
        if known.any():
            self.ax.fill_between(x[known], (y - error)[known], (y + error)[known], color=colour, alpha=0.25, linewidth=0,
                                 rasterized=self.rasterized)

    def _line(self, line):
        x, _, y, _ = line.columns
        colour = self._colour(line.group) if line.group and len(self.groups) > 1 else "black"
        self.ax.plot(x, y, color=colour, linestyle=self._dash(line.method), zorder=1)

    def legend(self):
        """Entries of the legend for colours, symbols and dashes."""
        points = any(line.style == "points" for line in self.table.lines)
        found = [Line2D([], [], color=self._colour(group), label=mathematics(group),
                        **({"marker": self._marker(group), "linestyle": "none"} if points else {}))
                 for group in self.groups if group]
        found += [Line2D([], [], color="black", linestyle=self._dash(method), label=method_label(method, self.of))
                  for method in self.methods]
        mark = {"color": "black", "marker": "o", "linestyle": "none"}
        if self.both and points:
            found += [Line2D([], [], label=WORDS["md"], **mark),
                      Line2D([], [], label=WORDS["dsmc"], fillstyle="bottom", markerfacecoloralt="white", **mark)]
        elif self.both:
            found += [Line2D([], [], label=WORDS["md"], color="black"),
                      Line2D([], [], label=WORDS["dsmc"], color="black", linestyle=BROKEN)]
        if self.unconverged:
            found.append(Line2D([], [], label=NOT_CONVERGED, fillstyle="none", **mark) if points
                         else Line2D([], [], label=NOT_CONVERGED, color="black", linestyle=(0, (1, 1))))
        return found


def _surface(ax, table):
    """Surface y over x and the key of the lines; md only."""
    lines = {float(line.group.rpartition("= ")[2]): line.columns for line in table.lines if line.method == "md"}
    x, across = sorted({value for columns in lines.values() for value in columns[0]}), sorted(lines)
    height = np.array([[dict(zip(lines[b][0], lines[b][2])).get(a, np.nan) for a in x] for b in across])
    if height.ndim == 2:
        ax.plot_surface(*np.meshgrid(x, across), height, cmap="viridis", edgecolor="black", linewidth=0.3)
    label = next(iter(table.of.lines.values()))
    ax.set(xlabel=mathematics(table.x_label), ylabel=mathematics(label), title=formatted(f"{table.title}: {table.y_label}"))
    ax.view_init(25, -130)
    ax.tick_params(pad=0)


def _shown(tables):
    """Panels with their snapshots in place: (table, point or None)."""
    found = []
    for table in tables:
        if table.of.source.kind != "snapshot":
            found.append((table, None))
            continue
        found += [(table, point) for point in table.points if table.takes(point)]
    return found[:MOST_SHOWN + len(tables)]


def _snapshot(ax, table, point):
    """The grains of a frame, projected."""
    source, frames = table.of.source, gg.trajectory(point.file)
    frame = frames[max(len(frames) - 1 - source.frame, 0)]
    across, box = (2 if source.names[0][0] == "z" else 0), frame.state.box
    x, y = (frame.grains.position[:, a] % box[a] for a in (across, 1))
    ax.plot(x, y, ",", color=COLOURS[0], rasterized=True) if len(x) > 20000 else ax.scatter(
        x, y, s=3, color=COLOURS[0], linewidths=0, rasterized=True)
    words = [word for word in (table.title, table.group(point, "")) if word]
    words.append(f"{frame.state.collisions_per_grain:.0f} collisions per grain")
    ax.set(xlim=(0, box[across]), ylim=(0, box[1]), aspect="equal", xlabel="z [d]" if across else "x [d]", ylabel="y [d]")
    ax.set_title(mathematics(", ".join(words)), fontsize=8)


def _covers(ax):
    """Whether the legend of a panel covers a point or a line."""
    box = ax.get_legend().get_window_extent()
    for line in ax.lines:
        path = line.get_path().transformed(line.get_transform())
        if line.get_linestyle() == "None":
            if box.count_contains(path.vertices[np.isfinite(path.vertices).all(1)]):
                return True
        elif path.intersects_bbox(box, filled=False):
            return True
    return False


def _explain(figure, panels):
    """Place the legends. Panels whose entries are part of another panel's share its legend. It is in the first of these
    panels where it covers nothing, else beside the last panel of the first one's row."""
    shared = {}
    for ax, handles in sorted(panels, key=lambda panel: -len(panel[1])):
        entries = frozenset((one.get_label(), one.get_marker(), one.get_linestyle(), one.get_color()) for one in handles)
        if handles:
            host = next((other for other in shared if entries <= other), entries)
            shared.setdefault(host, (handles, []))[1].append(ax)
    figure.draw_without_rendering()  # computes the layout
    beside = 0
    for handles, axes in shared.values():
        axes.sort(key=lambda ax: ax.get_subplotspec().num1)
        for ax in axes:
            ax.legend(handles=handles, ncols=1 + len(handles) // 7, handlelength=1.6)
            if not _covers(ax):
                break
            ax.get_legend().remove()
        else:
            row = [ax for ax in axes if ax.get_subplotspec().rowspan == axes[0].get_subplotspec().rowspan]
            row[-1].legend(handles=handles, handlelength=1.6, loc="upper left", bbox_to_anchor=(1.02, 1), borderaxespad=0)
            beside += 1
    figure.set_size_inches(figure.get_figwidth() + BESIDE * min(beside, 3), figure.get_figheight())


def _page(entry, tables, note, rasterized):
    title, titles_of_panels = titles(entry, tables[0].points)
    for table, its in zip(tables, titles_of_panels):
        table.title = its
    shown = _shown(tables)
    rows, columns = layout(len(shown))
    figure = pyplot.figure(figsize=(columns * WIDTH, rows * HEIGHT + 0.4), dpi=150, layout="constrained")
    panels = []
    for k, (table, point) in enumerate(shown, 1):
        ax = figure.add_subplot(rows, columns, k, projection="3d" if table.of.surface else None)
        if point is not None:
            _snapshot(ax, table, point)
        elif table.of.surface:
            _surface(ax, table)
        else:
            panels.append((ax, _Drawing(ax, table, rasterized).draw()))
    figure.suptitle(formatted(title + note, 32 * columns), fontsize=10)
    still = unconverged(tables, key_label)
    if still:
        figure.supxlabel("\n".join(textwrap.wrap(f"{NOT_CONVERGED}: {'; '.join(still)}", 45 * columns)),
                         fontsize=6)
    _explain(figure, panels)
    return figure


def unconverged(tables, name=str):
    """Names of the points that are not converged: "collision.e = 0.5, phi = 0.1 (md)"."""
    found = {}
    for table in tables:
        for engine, point in table.unconverged:
            keys = ", ".join(f"{name(key)} = {point.scene.text_of(key)}" for key in point.varied
                             if not key.startswith(("run.", "frame")))
            found.setdefault(f"{keys} ({engine})" if keys else engine)
    return list(found)


def _small(image, ending):
    """The image in fewer bytes (small SVG, PNG with a palette), since pictures are most of the repository."""
    if ending == "svg":
        return small_svg(image.getvalue().decode()).encode()
    if ending == "png":
        palette = io.BytesIO()
        Image.open(image).convert("RGB").quantize(256).save(palette, format="png", optimize=True)
        return palette.getvalue()
    return image.getvalue()


def draw(entry, tables, quick, base, formats):
    """Writes the picture in every format; returns the paths."""
    paths = []
    with matplotlib.rc_context({**STYLE, "axes.titlesize": 9, "svg.hashsalt": "graingas"}):
        for ending in formats:
            for rasterized in False, True:
                figure, image = _page(entry, tables, " (quick)" if quick else "", rasterized), io.BytesIO()
                figure.savefig(image, format=ending, metadata={"Date": None} if ending == "svg" else None)
                pyplot.close(figure)
                content = _small(image, ending)
                if ending != "svg" or len(content) <= LARGEST:
                    break
            paths.append(f"{base}.{ending}")
            write(paths[-1], content)
    return paths
