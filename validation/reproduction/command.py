# SPDX-License-Identifier: GPL-3.0-or-later
"""The command validation/reproduce: one figure, all figures, their list, the page."""
import argparse
import os
import sys

import graingas as gg

from . import entry as entries
from . import numbers, panels, pictures, points, tables, texts

DOC = """Figures of Gayen's thesis and Montanero's review, simulated anew.

  validation/reproduce "thesis 3.5"   one figure; 3.5 alone works where one paper only has it
  validation/reproduce all --quick    every figure; finished runs are reused, so that it can be interrupted
  validation/reproduce list           all figures with points, run time and verdict
  validation/reproduce fill           numbers of the verdicts from the tables in docs/images/reproduction
  validation/reproduce page           docs/appendix/reproduction.md, to standard output

A figure is NAME.csv, NAME_numbers.csv if its text has numbers, and pictures. Results of the runs are kept in
figures.sweep of the output folder and serve every figure that shows them; remove it to run them again."""


def figure_of(entry, arguments):
    """Run the points of a figure and write its files. Returns whether every point met its criteria."""
    base = os.path.join(arguments.output, entry.base)
    found, reasons = points.run(entry, arguments.quick, os.path.join(arguments.output, "figures.sweep"), arguments.threads,
                                False if arguments.quiet else None)
    filled = [panels.Table(panel, found) for panel in entry.panels]
    rows = list(numbers.rows(entry, found))
    written = []
    if any(table.lines for table in filled):
        tables.write_points(base + ".csv", filled)
        written.append(base + ".csv")
    if rows:
        tables.write_numbers(base + "_numbers.csv", rows)
        written.append(base + "_numbers.csv")
    written += pictures.draw(entry, filled, arguments.quick, base, arguments.formats)
    report(entry, arguments, written, rows, reasons, pictures.unconverged(filled))
    return not reasons


def report(entry, arguments, written, rows, reasons, unconverged):
    for reason in reasons:
        print(f"warning: {entry.figure}: {reason}", file=sys.stderr)
    if arguments.quiet:
        return
    print("\n".join(written))
    for row in rows:
        if row.number.paper is not None and row.method in entries.ENGINES:
            print(f"{row.number.what} ({row.number.where}): paper {row.number.paper:.5g}, {row.method} "
                  f"{texts.format_number(*row.value[:2])} (z {row.z:+.1f})")
    if unconverged:
        print(f"{entry.figure}: {pictures.NOT_CONVERGED}: {'; '.join(unconverged)}")


def _duration(seconds):
    return f"{seconds:.2g} s" if seconds < 60 else f"{seconds / 60:.0f} min" if seconds < 7200 else f"{seconds / 3600:.1f} h"


def list_all(folder):
    found = [entries.read(path) for path in entries.files(folder)]
    print(f"{'figure':12}  {'engines':8}  {'points':>6}  {'--quick':>8}  {'full':>8}  {'verdict':14}  shows")
    total = {True: {}, False: {}}
    for entry in found:
        times, engines, n = {}, [], 0
        for quick in True, False:
            all_points = [(sweep, point) for sweep in points.sweeps(entry, quick, None).values() for point in sweep]
            times[quick], n = sum(point.seconds for _, point in all_points), len(all_points)
            total[quick].update({point.name: point.seconds for _, point in all_points})
            engines = {engine for sweep, point in all_points for engine in
                       (entries.ENGINES if sweep.does == "compare" else [point.scene["engine"]])}
        print(f"{entry.figure:12}  {', '.join(sorted(engines, reverse=True)):8}  {n:6}  {_duration(times[True]):>8}  "
              f"{_duration(times[False]):>8}  {entry.verdict:14}  {entry.shows}")
    print(f"\n{len(found)} figures: {texts.counts(found)}. All points, on one processor: "
          f"{_duration(sum(total[True].values()))} with --quick, {_duration(sum(total[False].values()))} in full.")


def parse(words):
    parser = argparse.ArgumentParser(prog="validation/reproduce", description=DOC,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("figure", metavar="FIGURE|all|list|fill|page")
    parser.add_argument("--quick", action="store_true", help="fewer points, larger errors: ten to twenty times as fast")
    parser.add_argument("--output", default=".", metavar="FOLDER", help="for all files; made if need be")
    parser.add_argument("--threads", type=int, default=1, metavar="N", help="results do not depend on it")
    parser.add_argument("--formats", default="svg,png", type=lambda text: text.split(","), help="of pictures: svg, png, pdf")
    parser.add_argument("--entries", default=entries.FOLDER, metavar="FOLDER", help="definitions (validation/figures)")
    parser.add_argument("--quiet", action="store_true")
    return parser.parse_args(words)


def reproduce(arguments):
    os.makedirs(arguments.output, exist_ok=True)
    if arguments.figure != "all":
        return figure_of(entries.read(entries.find(arguments.figure, arguments.entries)), arguments)
    short = []
    for path in entries.files(arguments.entries):
        entry = entries.read(path)
        try:
            if not figure_of(entry, arguments):
                short.append(entry.figure)
        except gg.RunFailed as error:
            print(f"warning: {entry.figure}: {error}", file=sys.stderr)
            short.append(entry.figure)
    if short:
        print(f"not as accurate as their entries ask for: {', '.join(short)}", file=sys.stderr)
    return not short


def main(words=None):
    arguments = parse(words)
    try:
        if arguments.figure == "list":
            list_all(arguments.entries)
        elif arguments.figure == "page":
            sys.stdout.write(texts.page(arguments.entries))
        elif arguments.figure == "fill":
            for path in entries.files(arguments.entries):
                if texts.fill(entries.read(path)):
                    print(path)
        else:
            return 0 if reproduce(arguments) else 1
    except (entries.BadEntry, gg.BadInput) as error:
        print(f"validation/reproduce: {error}", file=sys.stderr)
        return 2
    except (gg.GraingasError, OSError) as error:
        print(f"validation/reproduce: {error}", file=sys.stderr)
        return 3
    except KeyboardInterrupt as error:
        print(f"validation/reproduce: {error or 'interrupted'}; the same command continues", file=sys.stderr)
        return 130
    return 0
