# SPDX-License-Identifier: GPL-3.0-or-later
"""The library as it is installed: header, pkg-config file, manual page, command; examples/*.c and the program of
docs/tutorial/first_program.md build and run against it; what names it exports, and how names inside are made."""
import glob
import json
import os
import re
import shutil
import subprocess
import sys

from tap import GRAINGAS, PATIENCE, SANITIZERS, Skip, check, main, page

SOURCE, BUILD = os.environ["SOURCE"], os.environ["BUILD"]


def sh(*command, **more):
    done = subprocess.run(command, capture_output=True, text=True, **more)
    check(done.returncode == 0, " ".join(command), done.stdout[-2000:], done.stderr[-2000:])
    return done.stdout


def install():
    sh("meson", "install", "-C", BUILD, "--no-rebuild", "--destdir", os.path.abspath("root"))
    def found(name):
        files = glob.glob(f"root/**/{name}", recursive=True)
        check(files, name, "is not installed")
        return os.path.abspath(files[0])
    return found


def test_installed_files():
    found = install()
    check("graingas" in sh(found("bin/graingas"), "--version"))
    check("#ifndef GRAINGAS_H" in open(found("graingas.h")).read())
    if os.path.exists(os.path.join(SOURCE, "build-page", "page.html")):
        check("<title>graingas</title>" in open(found("graingas/page.html"), encoding="utf-8").read())
    manual = open(found("graingas.1")).read()
    for word in ".TH GRAINGAS", "collision.e", "shear_viscosity", "lun1991", "\\-\\-resume":
        check(word in manual, word)
    if shutil.which("man"):
        done = subprocess.run(["man", "--warnings", "-l", found("graingas.1")], capture_output=True, text=True,
                              env={**os.environ, "LC_ALL": "C.UTF-8", "MANWIDTH": "100"})
        check(done.returncode == 0 and not done.stderr, done.stderr)


def test_command_and_library_are_hardened():
    """Command and library: copies are checked, stacks guarded, functions bound before anything is read."""
    if SANITIZERS != "none" or not shutil.which("readelf"):
        raise Skip("sanitizers do it, or there is no readelf")
    found = install()
    for name in "bin/graingas", "libgraingas.so":
        check("NOW" in sh("readelf", "-dW", found(name)), name)
        symbols = sh("readelf", "-sW", found(name))
        check("__stack_chk_fail" in symbols and "_chk@" in symbols, name)
    check("PIE" in sh("readelf", "-dW", found("bin/graingas")))


def test_examples_build_against_it():
    found = install()
    pc = os.path.dirname(found("graingas.pc"))
    env = {**os.environ, "PKG_CONFIG_PATH": pc, "PKG_CONFIG_SYSROOT_DIR": os.path.abspath("root")}
    flags = sh("pkg-config", "--cflags", "--libs", "graingas", env=env).split()
    examples = sorted(glob.glob(os.path.join(SOURCE, "examples", "*.c")))
    check(examples, "no examples")
    with open("gas.c", "w") as program:
        program.write(re.search(r"```c\n(.*?)```", open(os.path.join(SOURCE, "docs", "tutorial", "first_program.md")).read(), re.DOTALL)[1])
    examples.append("gas.c")
    env["LD_LIBRARY_PATH"] = os.path.dirname(found("libgraingas.so"))
    strict = ["-Wall", "-Wextra", "-Wpedantic", "-Werror", "-pthread"]
    if SANITIZERS != "none":
        strict.append("-fsanitize=" + SANITIZERS)
    for example in examples:
        check(len(open(example).readlines()) <= 50, example, "is longer than 50 lines")
        program = os.path.abspath(os.path.splitext(os.path.basename(example))[0])
        if shutil.which("c++"):
            sh("c++", "-x", "c++", "-std=c++11", *strict, example, "-o", program, "-x", "none", *flags)
        sh("cc", "-std=c99", *strict, example, "-o", program, *flags)
        sh("cc", "-std=c17", *strict, example, "-o", program, *flags)
        out = sh(program, env=env, timeout=60 * PATIENCE)
        check(len(out.splitlines()) >= 1, out)


def test_first_program_as_the_page_says():
    """Its lines of shell, from the installation into a prefix to the program's output."""
    page = open(os.path.join(SOURCE, "docs", "tutorial", "first_program.md")).read()
    with open("gas.c", "w") as program:
        program.write(re.search(r"```c\n(.*?)```", page, re.DOTALL)[1])
    install_it, build_it = re.findall(r"```sh\n(.*?)```", page, re.DOTALL)[:2]
    check("meson install -C build --destdir /tmp/graingas " in install_it and build_it.startswith("cc gas.c"), install_it, build_it)
    lines = install_it.replace("-C build ", f"-C {BUILD} --no-rebuild ") + build_it
    if SANITIZERS != "none":
        lines = lines.replace("cc gas.c", "cc -fsanitize=" + SANITIZERS + " gas.c")
    clean = {k: v for k, v in os.environ.items() if k not in ("PKG_CONFIG_PATH", "PKG_CONFIG_SYSROOT_DIR", "LD_LIBRARY_PATH", "DESTDIR")}
    out = sh("sh", "-e", "-c", lines.replace("/tmp/graingas", os.path.abspath("prefix")) + "./gas", env=clean)
    check(len(re.findall(r"^strain +\d+\.0  T = \d+\.\d+$", out, re.MULTILINE)) == 10, out)


def test_another_processor():
    """valgrind is one that has not all instructions of this machine: the message says what to do, or it runs."""
    if SANITIZERS != "none" or not shutil.which("valgrind"):
        raise Skip("sanitizers do not go with valgrind, or it is not installed")
    with open("scene.yaml", "w") as f:
        f.write("{flow: usf, phi: 0.1, particles: 20, run: {collisions: 4, warmup: 2}}")
    done = subprocess.run(["valgrind", "-q", GRAINGAS, "run", "scene.yaml", "--quiet"], capture_output=True, text=True)
    refused = done.returncode == 1 and "for another processor: build it here, or with -Dinstructions=all" in done.stderr
    check(refused or done.returncode == 0 and "temperature" in done.stdout, done)


def test_example_scenes():
    """Every scene that newcomers copy is one; among them is each flow, and each observable in some."""
    scenes = glob.glob(os.path.join(SOURCE, "examples", "*.yaml"))
    flows, measured = set(), set()
    for scene in scenes:
        values = json.loads(sh(GRAINGAS, "info", scene, "--json"))
        flows.add(values["flow"])
        measured.update(values["measure"])
    scene_page = page("scene")
    for shown, key in (flows, "flow"), (measured, "measure"):
        words = set(re.findall(r"^- `(\w+)`", scene_page.split(f"### `{key}`")[1].split("###")[0], re.MULTILINE))
        check(len(words) >= 7 and shown == words, key, "without an example:", words - shown)


def test_header_in_other_languages():
    """Every C standard since 1999, and C++."""
    header = os.path.join(SOURCE, "include", "graingas.h")
    for standard in "c99", "c11", "c17":
        sh("cc", "-std=" + standard, "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only", "-x", "c", header)
    if not shutil.which("c++"):
        raise Skip("no C++ compiler")
    sh("c++", "-std=c++11", "-Wall", "-Wextra", "-Wpedantic", "-Werror", "-fsyntax-only", "-x", "c++", header)


def test_command_uses_the_public_header():
    """The command includes the public header and its own files only. `bench` looks inside, and main() prepares the process
    for HDF5, which a library must not do. MPI is the command's."""
    sources = glob.glob(os.path.join(SOURCE, "src", "cli", "*.[ch]"))
    messages = glob.glob(os.path.join(SOURCE, "src", "cli", "mpi", "*.[ch]"))
    check(len(sources) > 20 and len(messages) >= 3)
    others = {"bench.c": "bench/", "processes.c": "cli/mpi/", "main.c": "files/process.h"}
    for source in sources:
        for name in re.findall(r'#include "([^"]+)"', open(source).read()):
            allowed = name.startswith("cli/") or name.startswith(others.get(os.path.basename(source), "cli/"))
            check(allowed, source, "includes", name)
    for source in messages:
        for name in re.findall(r'#include "([^"]+)"', open(source).read()):
            check(name.startswith("cli/mpi/"), source, "includes", name)
    for source in glob.glob(os.path.join(SOURCE, "tests", "api", "*.[ch]")):
        own = [os.path.basename(h) for h in glob.glob(os.path.join(SOURCE, "tests", "api", "*.h"))]
        own.append("../faults/failing_malloc.h")
        inside = [n for n in re.findall(r'#include "([^"]+)"', open(source).read()) if n not in own]
        check(not inside, source, "includes", inside)


def public_functions():
    header = open(os.path.join(SOURCE, "include", "graingas.h")).read()
    return set(re.findall(r"GG_API [^;]*?(gg_\w+)\(", header))


def objects():
    """Pairs of a source, from src on, and the object that the library or the command has of it."""
    for one in json.load(open(os.path.join(BUILD, "compile_commands.json"))):
        source = os.path.relpath(os.path.join(one["directory"], one["file"]), SOURCE)
        found = os.path.join(BUILD, one["output"])
        if source.startswith("src/") and not one["output"].startswith(("tests/", "validation/")):
            check(os.path.exists(found), found, "is not built")
            yield source, found


def test_exported_names():
    """The shared library exports the functions of the public header and nothing else."""
    if SANITIZERS != "none":
        raise Skip("sanitizers add names of their own")
    shared = glob.glob(os.path.join(BUILD, "libgraingas.so"))[0]
    seen = {line.split()[-1] for line in sh("nm", "-D", "--defined-only", shared).splitlines()}
    check(seen == public_functions(), "differ:", seen ^ public_functions())


def test_external_names_carry_their_room():
    """An external name begins with gg_ and a folder of its source: gg_<room>_<object>_<verb>. Public names have no room."""
    if SANITIZERS != "none":
        raise Skip("sanitizers add names of their own")
    public, wrong, seen = public_functions(), [], set()
    source_of = {built: source for source, built in objects()}
    for line in sh("nm", "-A", "-g", "--defined-only", "--format=posix", *source_of).splitlines():
        built, name = line.split()[:2]
        source = source_of[built.rstrip(":")]
        seen.add(name)
        if name not in public and name != "main" and not name.startswith(tuple(f"gg_{room}_" for room in source.split("/")[1:-1])):
            wrong.append(f"{source}: {name}")
    check(len(source_of) > 200, "objects")
    check(len(seen) > 500 and not wrong, "without their room:", *wrong)


# A list and its entries need each other: subcommands, tables of benchmarks, a theory that computes with others.
LISTS = {"src/cli/commands.c", "src/bench/bench.c", "src/theory/theories.c"}


def circles(needs):
    """Sets of nodes that reach each other in a graph {node: nodes}."""
    def reached(node):
        seen, todo = set(), [node]
        while todo:
            new = needs.get(todo.pop(), set()) - seen
            seen |= new
            todo += new
        return seen
    reach = {node: reached(node) for node in needs}
    return [set(one) for one in {frozenset(b for b in reach[a] if a in reach.get(b, ())) for a in needs if a in reach[a]}]


def test_files_of_a_room_are_in_order():
    """No two files of a room need functions of each other, directly or through others."""
    if SANITIZERS != "none":
        raise Skip("sanitizers add names of their own")
    check(circles({1: {2}, 2: {3}, 3: {2, 4}, 4: set()}) == [{2, 3}], "circles")
    source_of = {built: source for source, built in objects()}
    defined, used, needs = {}, {}, {}
    for line in sh("nm", "-A", "-g", "--format=posix", *source_of).splitlines():
        built, name, kind = line.split()[:3]
        source = source_of[built.rstrip(":")]
        if kind == "U":
            used.setdefault(source, set()).add(name)
        else:
            defined[name] = source
    for source, names in used.items():
        there = {defined[name] for name in names if name in defined} - {source}
        needs[source] = {other for other in there if other.split("/")[1] == source.split("/")[1]}
    check(sum(map(len, needs.values())) > 500, "edges:", sum(map(len, needs.values())))
    found = [one for one in circles(needs) if not one & LISTS]
    check(not found, "circles:", *found)


def test_structs_have_one_name_each():
    places = {}
    for source in glob.glob(os.path.join(SOURCE, "src", "**", "*.[ch]"), recursive=True):
        for name in re.findall(r"^\s*(?:typedef )?struct (gg_\w+) \{", open(source).read(), re.MULTILINE):
            places.setdefault(name, []).append(os.path.relpath(source, SOURCE))
    twice = {name: files for name, files in places.items() if len(files) > 1}
    check(len(places) > 100 and not twice, "defined twice:", twice)


if __name__ == "__main__":
    main(sys.modules[__name__])
