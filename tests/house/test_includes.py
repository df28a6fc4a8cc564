# SPDX-License-Identifier: GPL-3.0-or-later
"""The plan of the house, read from the #include lines: rooms include downwards only, the core includes nothing of the
rest, and few files depend on the headers that change most."""
import glob
import os
import re
import sys

SOURCE = os.environ["SOURCE"]
sys.path.insert(0, os.path.join(SOURCE, "tests", "cli"))
os.environ.setdefault("GRAINGAS", "none")
from tap import check, main

CORE = ["base", "simd", "common", "md", "dsmc", "statistics", "measure", "theory"]
# Headers that a core file must not include: those of formats, and the public one, which is for callers of the library.
OUTSIDE = r'<(?:jansson|yaml|hdf5|zlib)\.h>|"graingas\.h"'
# Definitions that users make are structs of the public header: these files read them.
USER_DEFINED = {"src/common/extension.c", "src/common/quantity.c", "src/measure/user_observable.c",
                "src/theory/user_theory.c", "src/theory/formula.c"}
# Number of .c files of src that are compiled anew after a change of a header, at most.
REBUILT = {"src/scene/scene.h": 88, "include/graingas.h": 70}


def sources():
    names = glob.glob(os.path.join(SOURCE, "src", "**", "*.[ch]"), recursive=True)
    found = {os.path.relpath(name, SOURCE): open(name, encoding="utf-8").read() for name in names}
    check(len(found) > 400, "sources:", len(found))
    return found


def room(path):
    return path.split("/")[1]


def included(text):
    """Paths from the root of the repository."""
    names = re.findall(r'^\s*#\s*include\s+["<]([^">]+)[">]', text, re.MULTILINE)
    return ["include/graingas.h" if name == "graingas.h" else "src/" + name for name in names]


def test_the_core_includes_nothing_of_the_rest():
    wrong = []
    for path, text in sources().items():
        if room(path) not in CORE:
            continue
        wrong += [f"{path} includes {name}" for name in included(text)
                  if name.startswith("src/") and "/" in name[4:] and room(name) not in CORE and os.path.exists(os.path.join(SOURCE, name))]
        if path not in USER_DEFINED:
            wrong += [f"{path}: {line}" for line in re.findall(OUTSIDE, text)]
        if re.search(r"\bgg_scene\b", re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)):
            wrong.append(f"{path} names gg_scene")
    check(not wrong, "the core knows no scene, file format or public handle:\n" + "\n".join(wrong))


def test_rooms_include_downwards():
    order = [["base"], ["io"], ["simd", "common"], ["md"], ["dsmc"], ["statistics"], ["measure"], ["theory"], ["scene"],
             ["run"], ["files"], ["plot"], ["sweep"], ["bench"], ["api"], ["cli"]]
    place = {name: i for i, names in enumerate(order) for name in names}
    beside = {"md", "dsmc", "statistics"}  # these do not include each other
    wrong = []
    for path, text in sources().items():
        here = room(path)
        check(here in place, path, "is in no known room")
        for name in included(text):
            there = room(name) if name.count("/") > 1 else here
            if there in place and there != here and (place[there] > place[here] or {here, there} <= beside):
                wrong.append(f"{path} includes {name}")
    check(not wrong, "against the way the data goes:\n" + "\n".join(wrong))


def test_types_of_a_room_are_defined_there():
    """A type named gg_<room>_... is in that room. (Functions: tests/cli/test_library.py, by their symbols.)"""
    found = sources()
    rooms = {room(path) for path in found}
    wrong, seen = [], 0
    for path, text in found.items():
        for name in re.findall(r"^(?:typedef )?(?:struct|enum|union) (gg_\w+) \{", text, re.MULTILINE):
            named = name.split("_")[1]
            seen += named in rooms
            if named in rooms and named != room(path):
                wrong.append(f"{path} defines {name}")
    check(seen > 20 and not wrong, seen, "types with the name of another room:\n" + "\n".join(wrong))


def test_changes_of_the_large_headers_rebuild_few_files():
    found = sources()
    found["include/graingas.h"] = ""

    def reached(path, seen):
        for name in included(found[path]):
            if name in found and name not in seen:
                seen.add(name)
                reached(name, seen)
        return seen

    files = [path for path in found if path.endswith(".c")]
    reach = {path: reached(path, set()) for path in files}
    for header, most in REBUILT.items():
        users = [path for path in files if header in reach[path]]
        print(f"# {header}: {len(users)} of {len(files)} files are rebuilt, at most {most}")
        check(0 < len(users) <= most, header, "rebuilds", len(users), "files, at most", most)


def test_a_thermostat_is_a_row():
    """A thermostat is named by its row, the flows that take it and its keys, no more. How one acts on grains is named
    by the engines and by theories with other formulas for it."""
    named = {"thermostats": (r"\bGG_(GAUSSIAN|WHITE_NOISE|BATH)\b", 5),
             "ways to act": (r"\bGG_HEAT_(SCALES|KICKS|BATHES)\b", 24)}
    for what, (names, most) in named.items():
        users = [path for path, text in sources().items() if re.search(names, text) and room(path) != "bench"]
        print(f"# {what}: {len(users)} files, at most {most}")
        check(0 < len(users) <= most, what, "are named in", len(users), "files, at most", most, users)


if __name__ == "__main__":
    main(sys.modules[__name__])
