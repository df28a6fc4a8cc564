# SPDX-License-Identifier: GPL-3.0-or-later
"""Counts of gcov's, of all objects of src in a build folder, added up by line: coverage_count.py FOLDER COUNTS. See
scripts/coverage."""
import json
import os
import re
import subprocess
import sys
from itertools import zip_longest

AT_ONCE = 60  # objects that one gcov is given


def objects(folder):
    """Counts of each object, or that it was never run; without the kernels that tests build again at other levels."""
    with open(os.path.join(folder, "compile_commands.json")) as f:
        outputs = sorted({command["output"] for command in json.load(f)})
    for output in outputs:
        path = os.path.join(os.path.abspath(folder), output.removesuffix(".o"))
        if not re.search(r"_O\d\.a\.p/", output) and os.path.exists(path + ".gcno"):
            yield path + (".gcda" if os.path.exists(path + ".gcda") else ".gcno")


def answers(folder):
    every = list(objects(folder))
    for i in range(0, len(every), AT_ONCE):
        done = subprocess.run(["gcov", "--json-format", "--stdout", "--branch-probabilities", *every[i:i + AT_ONCE]],
                              cwd=folder, capture_output=True, text=True)
        for said in done.stderr.splitlines():  # tables have no functions, and what was never run has no counts
            if said and not said.endswith(("no functions found", "assuming not executed")):
                print(said, file=sys.stderr)
        yield from map(json.loads, filter(None, done.stdout.split("\n")))


def add(lines, line):
    """Threads count beside each other without waiting, so a count may be wrong, even negative; but none is none."""
    ran, ways = lines.get(line["line_number"], (False, []))
    taken = [way["count"] != 0 for way in line["branches"]]
    lines[line["line_number"]] = (ran or line["count"] != 0,
                                  [a or b for a, b in zip_longest(ways, taken, fillvalue=False)])


def left_out(path):
    """Numbers of lines that hold nothing but a brace, or that are marked; then those of which only branches are."""
    whole, branches, inside = set(), set(), False
    for number, text in enumerate(open(path), 1):
        inside = (inside or "GCOVR_EXCL_START" in text) and "GCOVR_EXCL_STOP" not in text
        if inside or re.fullmatch(r"[\s{};]*", text) or "GCOVR_EXCL_LINE" in text or "GCOVR_EXCL_STOP" in text:
            whole.add(number)
        if "GCOVR_EXCL_BR_LINE" in text:
            branches.add(number)
    return whole, branches


def main():
    folder, files = sys.argv[1], {}
    for answer in answers(folder):
        for entry in answer["files"]:
            path = os.path.relpath(os.path.join(answer["current_working_directory"], entry["file"]))
            if path.startswith("src/"):
                for line in entry["lines"]:
                    add(files.setdefault(path, {}), line)
    counts = {}
    for path in sorted(files):
        whole, branches = left_out(path)
        counts[path] = [(number, ran, [] if number in branches else ways)
                        for number, (ran, ways) in sorted(files[path].items()) if number not in whole]
    with open(sys.argv[2], "w") as out:
        json.dump(counts, out)


if __name__ == "__main__":
    main()
