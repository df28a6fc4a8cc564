# SPDX-License-Identifier: GPL-3.0-or-later
"""Lines and branches that were run, from what coverage_count.py added up: coverage_table.py COUNTS [FILE]. See
scripts/coverage."""
import json
import sys

WORST = 25  # files that are listed


class Count:
    def __init__(self):
        self.lines = self.lines_run = self.branches = self.branches_taken = 0

    def add(self, ran, ways):
        self.lines += 1
        self.lines_run += ran
        self.branches += len(ways)
        self.branches_taken += sum(ways)

    def missed(self):
        return self.lines - self.lines_run + self.branches - self.branches_taken

    def row(self, name):
        def share(part, whole):
            return f"{part:6} of {whole:6} {100 * part / whole:6.1f} %" if whole else " " * 24
        print(f"{name:36} {share(self.lines_run, self.lines)}  {share(self.branches_taken, self.branches)}")


def table(files):
    whole, rooms, each = Count(), {}, {}
    for name, lines in files.items():
        counts = whole, rooms.setdefault("/".join(name.split("/")[:2]), Count()), each.setdefault(name, Count())
        for _, ran, ways in lines:
            for count in counts:
                count.add(ran, ways)
    print(f"{'':36} {'lines':>24}  {'branches':>24}")
    for room in sorted(rooms):
        rooms[room].row(room)
    whole.row("src")
    print("\nFiles with most lines missed:")
    for name in sorted(each, key=lambda name: -each[name].missed())[:WORST]:
        each[name].row(name)


def show(files, name):
    """Its lines that nothing ran (-), and those with a way out that nothing took (?, taken of all)."""
    text = open(name).read().splitlines()
    for number, ran, ways in files.get(name, []):
        if not ran:
            print(f"{number:5} -      {text[number - 1]}")
        elif not all(ways):
            print(f"{number:5} ? {sum(ways)}/{len(ways):<3}{text[number - 1]}")


def main():
    files = json.load(open(sys.argv[1]))
    if len(sys.argv) > 2:
        show(files, sys.argv[2])
    else:
        table(files)


if __name__ == "__main__":
    main()
