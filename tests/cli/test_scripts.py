# SPDX-License-Identifier: GPL-3.0-or-later
"""quickstart and check where there is no apt-get: what is missing is named, with the packages of the system.
Version of a build, and changes that alter its identity."""
import os
import shutil
import subprocess
import sys

from tap import check, main

SOURCE = os.environ["SOURCE"]
TOOLS = ("gcc", "clang", "cc", "meson", "ninja", "pkg-config", "gnuplot", "python3", "man", "h5repack")
SHELL = "sh", "awk", "sed", "cat", "tr", "dirname"  # what every system has


def without_apt(script, *arguments, present=(), fake=(), says={}, CC=None):
    """Run a script of an otherwise empty tree with nothing on the PATH but the named programs and fakes, which do
    nothing, successfully, or what `says` has for them."""
    os.makedirs("tree/scripts", exist_ok=True)
    for name in "quickstart", "check", "scripts/packages.sh", "scripts/needs.txt", "meson.build":
        shutil.copy(os.path.join(SOURCE, name), os.path.join("tree", name))
    shutil.rmtree("bin", ignore_errors=True)
    os.mkdir("bin")
    for name in (*SHELL, *present):
        os.symlink(shutil.which(name), f"bin/{name}")
    for name in fake:
        with open(f"bin/{name}", "w") as f:
            f.write("#!/bin/sh\n" + says.get(name, ""))
        os.chmod(f"bin/{name}", 0o755)
    clean = {k: v for k, v in os.environ.items() if k not in ("CC", "CPPFLAGS", "CFLAGS")}
    if CC:
        clean["CC"] = CC
    return subprocess.run([f"tree/{script}", *arguments], capture_output=True, text=True,
                          env={**clean, "PATH": os.path.abspath("bin")})


def test_missing_things_are_named():
    done = without_apt("quickstart")
    check(done.returncode == 1 and done.stdout == "", done)
    for word in ("meson", "gsl", "Random123/philox.h", "gnuplot", "sudo apt-get install", "sudo dnf install",
                 "brew install", "gsl-devel", "libgsl-dev", "CPPFLAGS=-I"):
        check(word in done.stderr, word, done.stderr)
    check("cmocka" not in done.stderr and "clang" not in done.stderr, "quickstart asks for what tests need", done.stderr)


def test_only_this_system_is_told_of():
    done = without_apt("quickstart", fake=["dnf"])
    check(done.returncode == 1 and "dnf install" in done.stderr and "brew" not in done.stderr, done.stderr)


def test_what_is_there_is_not_asked_for():
    done = without_apt("quickstart", fake=["meson", "ninja", "pkg-config", "dnf"])
    missing = done.stderr.split("Install it")[0]
    check(done.returncode == 1 and "gnuplot" in missing, done.stderr)
    for word in "meson", "ninja", "gsl", "hdf5":
        check(word not in done.stderr.split(), word, done.stderr)


def test_what_is_half_there_is_named():
    """An old meson, a clang without its headers, a meson that fails: in a line, and what to do."""
    for version, old in ("0.56.2", True), ("0.9.9", True), ("1.0.1", False), ("1.10.0", False), ("2.0", False):
        done = without_apt("quickstart", fake=TOOLS, says={"meson": f"[ $1 != --version ] || echo {version}"})
        check(("too old: install meson 1.0.0 or later" in done.stderr) == old, version, done)
        check(not old or done.returncode == 1 and len(done.stderr.splitlines()) == 1, version, done)
    bare = '[ $1 != -dumpversion ] || { echo 14.0.6; exit; }\nread line\n[ "$line" != "#include <stddef.h>" ]'
    for script, CC in ("quickstart", "clang"), ("check", None):
        done = without_apt(script, fake=TOOLS, says={"clang": bare}, CC=CC)
        check(done.returncode == 1 and "sudo apt-get install libclang-common-14-dev" in done.stderr, script, done)
    done = without_apt("quickstart", fake=TOOLS, says={"meson": "[ $1 = --version ] || { echo because; exit 1; }"})
    check(done.returncode == 1 and done.stderr == "because\n", done)


def test_the_page_is_built_where_it_can_be():
    """check says why the page's tests are skipped; where all is there but the sources, too; else it builds the page."""
    done = without_apt("check", fake=TOOLS)
    check("The page's tests are skipped: emcc is not installed (./check --page installs it), node" in done.stderr,
          done.stderr)
    check("chromium is not installed" in done.stderr and not os.path.exists("tree/built"), done.stderr)
    for fetched in 1, 0:
        for name, line in ("fetch-sources", f"exit {fetched}"), ("build-page", 'echo >"${0%/*}/../built"'):
            with open(f"tree/scripts/{name}", "w") as f:
                f.write(f"#!/bin/sh\n{line}\n")
            os.chmod(f"tree/scripts/{name}", 0o755)
        done = without_apt("check", fake=(*TOOLS, "emcc", "node", "chromium-browser"))
        skipped = "skipped: the sources of its libraries could not be had" in done.stderr
        check(skipped == bool(fetched) and os.path.exists("tree/built") == (not fetched), fetched, done.stderr)


def test_steps_ask_for_what_they_need():
    unit, whole = without_apt("check", "--suite", "unit"), without_apt("check")
    check(unit.returncode == 1 and whole.returncode == 1)
    check("cmocka" in unit.stderr and "clang" not in unit.stderr, unit.stderr)
    check("cmocka" in whole.stderr and "clang" in whole.stderr and "MDAnalysis" not in whole.stderr, whole.stderr)


def identity(tree):
    return subprocess.run([sys.executable, f"{tree}/scripts/build-identity", tree], capture_output=True, text=True, check=True).stdout


def test_identity_has_all_that_makes_numbers():
    """One byte in any folder of the sources; not what prints, draws or times results."""
    shutil.copytree(os.path.join(SOURCE, "src"), "tree/src", dirs_exist_ok=True)
    os.makedirs("tree/scripts", exist_ok=True)
    shutil.copy(os.path.join(SOURCE, "scripts/build-identity"), "tree/scripts")
    before, others = identity("tree"), []
    for folder in sorted(os.listdir("tree/src")):
        name = next(os.path.join(path, n) for path, _, names in sorted(os.walk(f"tree/src/{folder}")) for n in sorted(names)
                    if n.endswith((".c", ".h")))
        with open(name, "a", encoding="utf-8") as file:
            file.write("\n")
        others += [folder] if identity("tree") == before else []
        os.truncate(name, os.path.getsize(name) - 1)
    check(others == ["bench", "cli", "plot"], "no change of these changes the identity", others)
    check(identity("tree") == before and len(before.strip()) == 16, before)


def version(tree, *more, **env):
    done = subprocess.run(["sh", f"{tree}/scripts/version", "0.1.0", *more], capture_output=True, text=True, check=True,
                          env={**os.environ, "GIT_CONFIG_GLOBAL": "/dev/null", **env})
    check(done.stderr == "", done.stderr)
    return done.stdout.strip()


def test_what_a_build_calls_itself():
    """The commit; where git names none, as in the tree of another user, a hash of the sources, and why."""
    shutil.copytree(os.path.join(SOURCE, "src/base"), "clone/src/base")
    os.mkdir("clone/scripts")
    for name in "version", "build-identity":
        shutil.copy(os.path.join(SOURCE, "scripts", name), "clone/scripts")
    unnamed = "0.1.0+unknown." + identity("clone")[:8]
    check(version("clone") == unnamed and "not a git repository" in version("clone", "why"), version("clone", "why"))
    with open("clone/src/base/text.c", "a", encoding="utf-8") as file:
        file.write("\n")
    check(version("clone") != unnamed, "other sources have another name")
    if not shutil.which("git"):
        return
    git = ["git", "-C", "clone", "-c", "user.name=a", "-c", "user.email=a@b"]
    for command in ["init", "-q"], ["add", "."], ["commit", "-q", "-m", "all"]:
        subprocess.run([*git, *command], check=True)
    commit = subprocess.run([*git, "rev-parse", "--short=8", "HEAD"], capture_output=True, text=True, check=True).stdout.strip()
    check(version("clone") == "0.1.0+g" + commit and version("clone", "why") == "", version("clone"))
    another = {"GIT_TEST_ASSUME_DIFFERENT_OWNER": "1"}
    check(version("clone", **another).startswith("0.1.0+unknown."), version("clone", **another))
    check("dubious ownership" in version("clone", "why", **another), version("clone", "why", **another))
    subprocess.run([*git, "tag", "v0.1.0"], check=True)
    check(version("clone") == "0.1.0")
    with open("clone/src/base/text.c", "a", encoding="utf-8") as file:
        file.write("\n")
    check(version("clone") == f"0.1.0+g{commit}.dirty", version("clone"))


if __name__ == "__main__":
    main(sys.modules[__name__])
