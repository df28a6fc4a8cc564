# SPDX-License-Identifier: GPL-3.0-or-later
"""Who, what, where, which licence: CITATION.cff, codemeta.json, pyproject.toml, debian, the recipes of packaging and the
BibTeX entry agree, and every address comes from scripts/addresses."""
import glob
import json
import os
import re
import shutil
import subprocess
import sys
import types

SOURCE = os.environ["SOURCE"]
sys.path.insert(0, os.path.join(SOURCE, "tests", "cli"))
os.environ.setdefault("GRAINGAS", "none")
from tap import Skip, check, main

SPDX = "GPL-3.0-or-later"


def read(name):
    with open(os.path.join(SOURCE, name), encoding="utf-8") as file:
        return file.read()


def one(pattern, name):
    found = re.findall(pattern, read(name), re.MULTILINE)
    check(len(found) == 1, name, pattern, found)
    return found[0]


def project():
    try:
        import tomllib
    except ImportError:
        raise Skip("Python is older than 3.11") from None
    return tomllib.loads(read("pyproject.toml"))["project"]


def recipe_of_spack():
    """Run package.py with a spack of a few lines; its statements."""
    said = {"depends": {}, "license": [], "version": [], "variant": []}
    spack = types.ModuleType("spack.package")
    spack.MesonPackage = object
    spack.depends_on = lambda spec, **more: said["depends"].update({re.split(r"[@+]", spec)[0]: more})
    spack.license = said["license"].append
    spack.version = lambda name, **more: said["version"].append(name)
    spack.variant = lambda name, **more: said["variant"].append(name)
    spack.extends = lambda *a, **more: None
    spack.__all__ = ["MesonPackage", "depends_on", "license", "version", "variant", "extends"]
    sys.modules.update({"spack": types.ModuleType("spack"), "spack.package": spack})
    space = {}
    exec(compile(read("packaging/spack/packages/graingas/package.py"), "package.py", "exec"), space)  # pylint: disable=exec-used
    return said, space["Graingas"]


def conda():
    """The recipe, with its few words of Jinja replaced."""
    try:
        import yaml
    except ImportError:
        raise Skip("yaml is not installed") from None
    text = read("packaging/conda/meta.yaml")
    version = one(r'^\{% set version = "(.*)" %\}', "packaging/conda/meta.yaml")
    text = re.sub(r"^\{%.*\n", "", text, flags=re.MULTILINE).replace("{{ version }}", version).replace('{{ compiler("c") }}', "c-compiler")
    return yaml.safe_load(text)


def test_one_licence():
    found = {"CITATION.cff": one(r"^license: (.*)", "CITATION.cff"),
             "codemeta.json": json.loads(read("codemeta.json"))["license"].rpartition("/")[2],
             "pyproject.toml": project()["license"]["text"], "debian/copyright": one(r"^Files: \*\n.*\nLicense: (.*)", "debian/copyright"),
             "conda": conda()["about"]["license"], "spack": recipe_of_spack()[0]["license"][0],
             "container": one(r'licenses="(.*)"', "packaging/container/Containerfile")}
    check(set(found.values()) == {SPDX}, found)
    check("GNU General Public License v3 or later" in " ".join(project()["classifiers"]))


def test_one_version():
    version = one(r"^  version: '(.*)',", "meson.build")
    found = {"conda": conda()["package"]["version"], "container": one(r'image\.version="(.*)"', "packaging/container/Containerfile"),
             "references.bib": one(r"^  version = \{(.*)\},", "src/theory/references.bib"), "spack": recipe_of_spack()[0]["version"][-1]}
    check(set(found.values()) == {version}, found, version)


def test_one_author_name_and_summary():
    authors = {"CITATION.cff": one(r'^  - name: "(.*)"', "CITATION.cff"), "codemeta.json": json.loads(read("codemeta.json"))["author"][0]["name"],
               "pyproject.toml": project()["authors"][0]["name"], "debian/control": one(r"^Maintainer: (.*) <", "debian/control"),
               "debian/copyright": one(r"^Copyright: \d+ (.*)", "debian/copyright"),
               "references.bib": one(r"@software\{graingas,\n  author = \{\{(.*)\}\},", "src/theory/references.bib")}
    check(set(authors.values()) == {"The graingas developers"}, authors)
    titles = {one(r'^title: "(.*)"', "CITATION.cff"), one(r"@software\{graingas,\n.*\n  title = \{(.*)\},", "src/theory/references.bib")}
    check(len(titles) == 1, titles)
    check(conda()["about"]["summary"] == project()["description"] == recipe_of_spack()[1].__doc__.rstrip("."), project()["description"])
    words = [set(project()["keywords"]), set(json.loads(read("codemeta.json"))["keywords"]),
             set(re.findall(r"^  - (.*)", read("CITATION.cff").split("keywords:\n")[1].split("references:")[0], re.MULTILINE))]
    check(words[0] == words[1] == words[2], words)


def test_recipes_have_the_libraries_of_the_build():
    """Every library of scripts/needs.txt, by the name of each system; nothing that the build does not need."""
    rows = [line.split() for line in read("scripts/needs.txt").splitlines() if line.startswith("build")]
    debian = {row[2] for row in rows}
    container = read("packaging/container/Containerfile").split("\nFROM")[1]
    check(debian - {"gnuplot-nox"} <= set(container.split()), debian - set(container.split()))
    libraries = {re.split(r"[-,/]", row[1].partition(":")[2])[0].lower() for row in rows if row[1].startswith(("module", "header:R"))}
    check(libraries == {"gsl", "fftw3", "hdf5", "zlib", "yaml", "jansson", "random123"}, libraries)
    spack = set(recipe_of_spack()[0]["depends"]) - {"c", "meson", "ninja", "pkgconfig", "gnuplot", "mpi", "python", "py-cffi", "py-numpy"}
    check({n.replace("fftw", "fftw3").replace("zlib-api", "zlib").replace("libyaml", "yaml") for n in spack} == libraries, spack)
    host = set(conda()["requirements"]["host"]) - {"python", "cffi", "numpy"}
    check({n.replace("fftw", "fftw3") for n in host} == libraries, host)
    options = set(re.findall(r"^option\('(\w+)'", read("meson_options.txt"), re.MULTILINE))
    for name in glob.glob(os.path.join(SOURCE, "packaging", "*", "**", "*"), recursive=True):
        if os.path.isfile(name):
            with open(name, encoding="utf-8") as file:
                used = set(re.findall(r"-D(\w+)=", file.read()))
            check(used <= options | {"python"}, name, used - options)


def test_spack_passes_options():
    class Spec:
        def satisfies(self, what):
            return what == "+mpi"
    package = recipe_of_spack()[1]()
    package.spec = Spec()
    check(package.meson_args() == ["-Dinstructions=native", "-Dmpi=enabled", "-Dpython=disabled"], package.meson_args())


def set_address(folder, *args):
    return subprocess.run([sys.executable, os.path.join(folder, "scripts", "set-address"), *args], capture_output=True, text=True)


def tracked():
    done = subprocess.run(["git", "ls-files"], cwd=SOURCE, capture_output=True, text=True)
    if done.returncode or not done.stdout:
        raise Skip("git names no files here")
    return done.stdout.splitlines()


def test_addresses_are_set_everywhere():
    """In a copy: another address reaches every place, twice the same, and the old one stays nowhere."""
    check(set_address(SOURCE, "--check").returncode == 0, "run scripts/set-address")
    places = re.findall(r'^    \("(\S+)", ', read("scripts/set-address"), re.MULTILINE)
    check(len(places) > 15, places)
    for name in {*places, "scripts/set-address", "scripts/addresses"}:
        os.makedirs(os.path.dirname(name) or ".", exist_ok=True)
        shutil.copy(os.path.join(SOURCE, name), name)
    with open("scripts/addresses", "w") as file:
        file.write("# a comment\nrepository https://forge.test/a/grains\nmail help@forge.test\n")
    check(set_address(".", "--check").returncode == 1)
    done = set_address(".")
    check(done.returncode == 0 and done.stdout.count(",") == len(set(places)) - 1, done.stdout, done.stderr)
    for name in set(places):
        with open(name, encoding="utf-8") as file:
            check("example.org" not in file.read(), name)
    check(set_address(".", "--check").returncode == 0 and set_address(".").stdout == "")
    check(json.loads(open("codemeta.json").read())["issueTracker"] == "https://forge.test/a/grains/issues")
    check("/releases/download/v{{ version }}/graingas-{{ version }}.tar.xz" in open("packaging/conda/meta.yaml").read())


def test_no_other_file_has_the_address():
    """example.org stands where scripts/set-address replaces it, and in tests as a name of nothing."""
    places = set(re.findall(r'^    \("(\S+)", ', read("scripts/set-address"), re.MULTILINE))
    own = {"scripts/addresses", "scripts/set-address", "CONTRIBUTING.md"}
    other = []
    for name in tracked():
        if name in places | own or name.startswith(("tests/", "python/tests/")) or not os.path.isfile(os.path.join(SOURCE, name)):
            continue
        with open(os.path.join(SOURCE, name), "rb") as file:
            if b"example.org" in file.read():
                other.append(name)
    check(not other, other)


def entries(name):
    found = re.findall(r"^@\w+\{(\w+),\n(.*?)^\}", read(name), re.MULTILINE | re.DOTALL)
    return {key: re.sub(r"^  graingas = .*\n", "", body, flags=re.MULTILINE) for key, body in found}


def test_paper():
    """The form that JOSS asks for: length, sections, figures that a script makes; every citation has an entry, every
    entry is cited, and entries of references.bib are the same here."""
    text, bib, own = read("paper/paper.md"), entries("paper/paper.bib"), entries("src/theory/references.bib")
    _, head, body = text.split("---\n", 2)
    check(750 <= len(body.split()) <= 1750, len(body.split()), "words")
    for key in "title", "tags", "authors", "affiliations", "date", "bibliography":
        check(re.search(rf"^{key}:", head, re.MULTILINE), key)
    for title in "Summary", "Statement of need", "State of the field", "References":
        check(f"\n# {title}\n" in body, title)
    cited = set(re.findall(r"@(\w+)", body))
    check(cited == set(bib), "cited without an entry, or not cited:", cited ^ set(bib))
    check(len(own) > 40 and sum(key in own for key in bib) >= 8)
    for key in set(bib) & set(own):
        check(bib[key] == own[key], key)
    for picture in re.findall(r"!\[[^]]*\]\((\S+)\)", body):
        check(os.path.exists(os.path.join(SOURCE, "paper", picture)) and picture in read("paper/make-figures"), picture)


if __name__ == "__main__":
    main(sys.modules[__name__])
