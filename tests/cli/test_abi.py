# SPDX-License-Identifier: GPL-3.0-or-later
"""The interface of the built library is that of abi.txt, beside this file: the offsets of all public structs and the
exported names. Programs that are already built rely on both.

While the major version is 0, a version of another minor number may change anything (its library has another soname):
`GRAINGAS=x SANITIZERS=none SOURCE=. BUILD=build python3 tests/cli/test_abi.py --write` writes abi.txt anew.
Otherwise only lines are added, and only structs of options (`size` first) grow, at their end."""
import glob
import os
import re
import subprocess
import sys

from tap import SANITIZERS, Skip, check, main

SOURCE, BUILD = os.environ["SOURCE"], os.environ["BUILD"]
TABLE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "abi.txt")


def sh(*command):
    done = subprocess.run(command, capture_output=True, text=True)
    check(done.returncode == 0, " ".join(command), done.stdout[-2000:], done.stderr[-2000:])
    return done.stdout


def header():
    with open(os.path.join(SOURCE, "include", "graingas.h"), encoding="utf-8") as file:
        return file.read()


def structs(text):
    """Members of every struct with a body, in order."""
    text = re.sub(r"/\*.*?\*/", "", text, flags=re.DOTALL)
    for found in re.finditer(r"typedef struct \w+ \{(.*?)\} *(\w+);", text, re.DOTALL):
        body, name = found.groups()
        members = []
        for one in filter(None, (" ".join(m.split()) for m in body.split(";"))):
            function = re.search(r"\(\*(\w+)\)", one)
            members += [function[1]] if function else [re.findall(r"\w+", m.split("[")[0])[-1] for m in one.split(",")]
        yield name, members


def compiled(name, program, *more, folder=None):
    with open(f"{name}.c", "w", encoding="utf-8") as file:
        file.write(program)
    sh("cc", "-std=c11", "-I", folder or os.path.join(SOURCE, "include"), f"{name}.c", "-o", name, *more)
    return os.path.abspath(name)


def layout():
    lines = []
    for name, members in structs(header()):
        lines.append(f'printf("{name}: %zu\\n", sizeof({name}));')
        lines += [f'printf("{name}.{m} %zu %zu\\n", offsetof({name}, {m}), sizeof((({name} *)0)->{m}));' for m in members]
    program = "#include <stddef.h>\n#include <stdio.h>\n#include <graingas.h>\nint main(void)\n{\n" + "\n".join(lines) + "\n}\n"
    return sh(compiled("layout", program))


def exported():
    names = sh("nm", "-D", "--defined-only", os.path.join(BUILD, "libgraingas.so"))
    return "".join(sorted(line.split()[-1] + "\n" for line in names.splitlines()))


def test_table():
    """Offsets (x86-64 and other machines with 64-bit pointers) and names are those that are written down."""
    if SANITIZERS != "none" or sys.maxsize < 2**32:
        raise Skip("sanitizers export names of their own, and the table is for 64-bit pointers")
    now = set((layout() + exported()).splitlines())
    with open(TABLE, encoding="utf-8") as file:
        table = set(file.read().splitlines())
    check(len(now) > 400, len(now))
    check(now == table, "differ from tests/cli/abi.txt:", sorted(now ^ table))


def test_version():
    """The macros are the version of the project, and of the name that the loader looks for."""
    with open(os.path.join(SOURCE, "meson.build"), encoding="utf-8") as file:
        version = re.search(r"version: '([\d.]+)'", file.read())[1]
    found = dict(re.findall(r"#define GRAINGAS_(VERSION\w*) +\"?([\d.]+)\"?", header()))
    major, minor, patch = version.split(".")
    check(found == {"VERSION": version, "VERSION_MAJOR": major, "VERSION_MINOR": minor, "VERSION_PATCH": patch}, found)
    soname = re.search(r"SONAME.*\[(.*)\]", sh("readelf", "-d", os.path.join(BUILD, "libgraingas.so")))[1]
    check(soname == f"libgraingas.so.{major}.{minor}", soname)


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        import tempfile
        SOURCE, BUILD = os.path.abspath(SOURCE), os.path.abspath(BUILD)
        os.chdir(tempfile.mkdtemp())
        with open(TABLE, "w", encoding="utf-8") as file:
            file.write(layout() + exported())
    else:
        main(sys.modules[__name__])
