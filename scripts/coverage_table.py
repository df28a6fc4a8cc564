"""Lines and branches that were run, from gcovr's JSON: coverage_table.py COUNTS [FILE]. See scripts/coverage."""
import json
import sys

WORST = 25  # files that are listed


class Count:
    def __init__(self):
        self.lines = self.lines_run = self.branches = self.branches_taken = 0

    def add(self, line):
        self.lines += 1
        self.lines_run += line["count"] > 0
        self.branches += len(line["branches"])
        self.branches_taken += taken(line)

    def missed(self):
        return self.lines - self.lines_run + self.branches - self.branches_taken

    def row(self, name):
        def share(part, whole):
            return f"{part:6} of {whole:6} {100 * part / whole:6.1f} %" if whole else " " * 24
        print(f"{name:36} {share(self.lines_run, self.lines)}  {share(self.branches_taken, self.branches)}")


def taken(line):
    return sum(branch["count"] > 0 for branch in line["branches"])


def code_of(entry):
    return [line for line in entry["lines"] if not line.get("gcovr/noncode")]


def table(files):
    whole, rooms, each = Count(), {}, {}
    for entry in files:
        name = entry["file"]
        counts = whole, rooms.setdefault("/".join(name.split("/")[:2]), Count()), each.setdefault(name, Count())
        for line in code_of(entry):
            for count in counts:
                count.add(line)
    print(f"{'':36} {'lines':>24}  {'branches':>24}")
    for room in sorted(rooms):
        rooms[room].row(room)
    whole.row("src")
    print("\nWhere most is missed:")
    for name in sorted(each, key=lambda name: -each[name].missed())[:WORST]:
        each[name].row(name)


def show(files, name):
    """Its lines that nothing ran (-), and those with a way out that nothing took (?, taken of all)."""
    text = open(name).read().splitlines()
    for entry in files:
        if entry["file"] != name:
            continue
        for line in code_of(entry):
            number, ways = line["line_number"], len(line["branches"])
            if line["count"] == 0:
                print(f"{number:5} -      {text[number - 1]}")
            elif taken(line) < ways:
                print(f"{number:5} ? {taken(line)}/{ways:<3}{text[number - 1]}")


def main():
    files = json.load(open(sys.argv[1]))["files"]
    if len(sys.argv) > 2:
        show(files, sys.argv[2])
    else:
        table(files)


if __name__ == "__main__":
    main()
