# SPDX-License-Identifier: GPL-3.0-or-later
"""What programs that are already built rely on: the offsets of all public structs and the exported names, as abi.txt
beside this file holds them, and programs that were built with an older or a newer header than the library's.

While the major version is 0, a version of another minor number may change anything (its library has another soname):
`GRAINGAS=x SANITIZERS=none SOURCE=. BUILD=build python3 tests/cli/test_abi.py --write` writes abi.txt anew. Otherwise lines are only added."""
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


PROGRAM = r"""
#include <graingas.h>
#include <stdio.h>
#include <string.h>

static int calls;
static int stop(void *context) { (void)context; calls++; return 0; }

int main(void)
{
  gg_error err = {GG_OK, ""};
  gg_scene *scene = NULL;
  gg_result *result = NULL;
  gg_simulation *simulation = NULL;
  struct { gg_measurement m; char after[64]; } one;
  struct { gg_simulation_sums s; char after[64]; } two;
  struct { gg_run_options o; char after[512]; } three; /* what is beyond the end is no option */
  memset(&one, 0x5a, sizeof one);
  memset(&two, 0x5a, sizeof two);
  memset(&three, 0x5a, sizeof three);
  three.o = (gg_run_options){.stop = stop};
  gg_status status = gg_scene_parse("{flow: equilibrium, phi: 0.1, particles: 100, run: {collisions: 200}}", 0, &scene, &err);
  if (!status) status = gg_run(scene, &three.o, &result, &err);
  if (!status) status = gg_result_find(result, "pressure", &one.m, &err);
  if (!status) status = gg_simulation_new(scene, NULL, &simulation, &err);
  if (!status) status = gg_simulation_collide(simulation, 100, &err);
  if (!status) status = gg_simulation_take_sums(simulation, &two.s, &err);
  if (status) return printf("%d %s\n", status, err.message), 0;
  for (int i = 0; i < 64; i++)
    if (one.after[i] != 0x5a || two.after[i] != 0x5a) return puts("written beyond the end"), 0;
  if (one.m.mean > 0 && two.s.collisions == 100 && calls > 0) puts("works");
}
"""


def with_struct(text, name, change):
    """The header with another end of that struct."""
    begin = text.index(f"typedef struct {name} {{")
    end = text.index(f"}} {name};", begin)
    return text[:begin] + change(text[begin:end]) + text[end:]


def without_last(body):
    body = re.sub(r"/\*.*?\*/", "", body, flags=re.DOTALL).rstrip()
    return body[:body[:-1].rindex(";") + 1] + "\n"


def ran(name, text):
    os.makedirs(name, exist_ok=True)
    with open(os.path.join(name, "graingas.h"), "w", encoding="utf-8") as file:
        file.write(text)
    return sh(compiled(name + "_program", PROGRAM, "-L", BUILD, "-lgraingas", "-Wl,-rpath," + os.path.abspath(BUILD), folder=name))


def test_other_headers():
    """Built with an older header, a program works, and nothing is written beyond its structs; with a newer one, it is
    told so."""
    if SANITIZERS != "none":
        raise Skip("the library needs the sanitizer's own")
    names = "gg_measurement", "gg_simulation_sums", "gg_run_options"
    check(ran("same", header()) == "works\n")
    older = header()
    for name in names:
        older = with_struct(older, name, without_last)
    check(older != header() and ran("older", older) == "works\n", "older")
    for name, function in zip(names, ("gg_result_find", "gg_simulation_take_sums", "gg_run")):
        newer = ran("newer", with_struct(header(), name, lambda body: body + "  double more;\n"))
        check(newer.startswith(f"2 {function}_sized: {name} has ") and "build the program with the header" in newer, newer)


if __name__ == "__main__":
    if sys.argv[1:] == ["--write"]:
        import tempfile
        SOURCE, BUILD = os.path.abspath(SOURCE), os.path.abspath(BUILD)
        os.chdir(tempfile.mkdtemp())
        with open(TABLE, "w", encoding="utf-8") as file:
            file.write(layout() + exported())
    else:
        main(sys.modules[__name__])
