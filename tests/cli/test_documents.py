# SPDX-License-Identifier: GPL-3.0-or-later
"""Documents say what is true of the tree: the page of scene keys is the table's, every path that a document names
exists, and the commands that it shows are the command's. So do comments of the code."""
import glob
import json
import os
import re
import sys

from tap import check, main, page, run

SOURCE = os.environ["SOURCE"]
ROOMS = "src|tests|docs|examples|include|validation|scripts|web|python|site|debian|subprojects"


def documents():
    found = glob.glob(os.path.join(SOURCE, "*.md")) + glob.glob(os.path.join(SOURCE, "docs", "**", "*.md"), recursive=True)
    check(len(found) >= 6, found)
    return {os.path.relpath(path, SOURCE): open(path, encoding="utf-8").read() for path in found}


def none(missing):
    check(not missing, "named in documents, but not there:\n" + "\n".join(sorted(missing)))


def test_reference_pages():
    """Keys, quantities and commands, from the program's tables: a new key is a new line there."""
    for name in "scene", "quantities", "commands", "support":
        text = page(name)
        check(len(text) > 5000, name)
        check(text == documents()[f"docs/reference/{name}.md"], f"docs/reference/{name}.md is not what the program's tables say: "
              "scripts/reference-pages --write")


def test_each_public_function_is_documented():
    """Every function of the public header has a comment of its own in Doxygen form, which names its parameters. The
    header's first comment explains err, context and stop, which are the same for all functions."""
    with open(os.path.join(SOURCE, "include", "graingas.h"), encoding="utf-8") as header:
        text = header.read()
    wrong, n = set(), 0
    for found in re.finditer(r"(/\*\*(?:(?!\*/).)*\*/\n)?GG_API ([^;]*?)(gg_\w+)\(([^;]*)\);", text, re.DOTALL):
        comment, returns, name, arguments = found.groups()
        n += 1
        arguments = re.sub(r"\(\*(\w+)\)\([^()]*\)", r"\1", arguments)  # of functions their names alone
        names = [] if arguments == "void" else [re.findall(r"\w+", a)[-1] for a in arguments.split(",")]
        named = re.findall(r"@param (\w+)", comment or "")
        names = [name for name in names if name in named or name not in ("err", "context", "stop")]
        if not comment or named != names or (returns.strip() != "void") != ("@return" in comment):
            wrong.add(f"{name}: @param of {names}, @return unless void")
    check(n > 90 and not wrong, n, "in include/graingas.h, without such a comment:\n" + "\n".join(sorted(wrong)))


def test_one_version_stands_everywhere():
    """One version everywhere; of a release also one date."""
    text = {name: open(os.path.join(SOURCE, *name.split("/")), encoding="utf-8").read() for name in
            ("meson.build", "pyproject.toml", "CITATION.cff", "codemeta.json", "debian/changelog", "debian/control", "CHANGELOG.md", "include/graingas.h")}
    version = re.search(r"^  version: '(.*)',", text["meson.build"], re.MULTILINE)[1]
    found = {"pyproject.toml": re.search(r'^version = "(.*)"', text["pyproject.toml"], re.MULTILINE)[1],
             "CITATION.cff": re.search(r'^version: "?([^"\n]*)"?$', text["CITATION.cff"], re.MULTILINE)[1],
             "codemeta.json": json.loads(text["codemeta.json"])["version"],
             "debian/changelog": re.match(r"graingas \((.*)-\d+\)", text["debian/changelog"])[1],
             "CHANGELOG.md": re.search(r"^## (\S+)", text["CHANGELOG.md"], re.MULTILINE)[1],
             "include/graingas.h": re.search(r'GRAINGAS_VERSION "(.*)"', text["include/graingas.h"])[1],
             "include/graingas.h, numbers": ".".join(re.findall(r"^#define GRAINGAS_VERSION_[A-Z]+ (\d+)", text["include/graingas.h"], re.MULTILINE)),
             "graingas --version": re.match(r"graingas ([\d.]*\d)", run("--version").out)[1]}
    none({f"{name} has {other}, meson.build {version}" for name, other in found.items() if other != version})
    check(f"\nPackage: libgraingas{version.rsplit('.', 1)[0]}\n" in text["debian/control"], "debian/control has another soversion")
    dates = [re.search(pattern, text[name], re.MULTILINE) for name, pattern in
             (("CITATION.cff", r"^date-released: '?\"?([\d-]+)"), ("CHANGELOG.md", rf"^## {re.escape(version)} \(([\d-]+)\)"))]
    check(len({d and d[1] for d in dates}) == 1, "date-released of CITATION.cff is not the date in CHANGELOG.md")


def test_pictures_are_small():
    """Pictures are most of the repository, and each new version adds to it: below 8 MB in all, each below 0.5 MB."""
    paths = glob.glob(os.path.join(SOURCE, "docs", "images", "**", "*.*"), recursive=True)
    sizes = {path: os.path.getsize(path) for path in paths if path.endswith((".svg", ".png"))}
    largest = max(sizes, key=sizes.get)
    check(len(sizes) > 100 and sum(sizes.values()) < 8e6, "docs/images: bytes", sum(sizes.values()))
    check(sizes[largest] < 5e5, largest, sizes[largest])


def test_paths_exist():
    """Paths in documents exist: src/md/queue.h, examples/usf.yaml, src/dsmc/ ... A path is a known room, a slash and a
    name; <name> means any name. It may name a program of the tree, without .c."""
    missing = set()
    for name, text in documents().items():
        for path in re.findall(rf"(?<![\w/.<-])((?:{ROOMS})/[\w./*{{}},<>-]*\w)", text):
            if "<" in path or "{" in path or "*" in path:
                continue
            there = (os.path.exists(os.path.join(SOURCE, path + end)) for end in ("", ".c"))  # ".c": a program
            if not any(there):
                missing.add(f"{name}: {path}")
    none(missing)


def test_links_lead_somewhere():
    """Links of Markdown to files lead somewhere, from where the document stands."""
    missing = set()
    for name, text in documents().items():
        for target in re.findall(r"\[[^]]+\]\(([^)#\s]+)[^)\s]*\)", text):
            if "://" not in target and not os.path.exists(os.path.join(SOURCE, os.path.dirname(name), target)):
                missing.add(f"{name}: {target}")
    none(missing)


def test_file_names():
    """A source file named without its folder (`queue.h`) is somewhere in the tree."""
    known = {file for folder, _, files in os.walk(SOURCE) if "/build" not in folder for file in files}
    missing = set()
    for name, text in documents().items():
        for file in re.findall(r"`(\w+\.(?:h|c|py))`", text):
            if file not in known:
                missing.add(f"{name}: {file}")
    none(missing)


def test_functions_named_in_documents_exist():
    """Functions and types that documents speak of are in the code."""
    code = ""
    for folder in "src", "include":
        for path in glob.glob(os.path.join(SOURCE, folder, "**", "*.[hc]"), recursive=True):
            with open(path, encoding="utf-8") as source:
                code += source.read()
    known = set(re.findall(r"\bgg_\w+", code))
    check(len(known) > 500, len(known))
    missing = set()
    for name, text in documents().items():
        for word in re.findall(r"\bgg_\w+\b(?!_?`?<)", text):
            if word not in known and not any(k.startswith(word) for k in known if word.endswith("_")):
                missing.add(f"{name}: {word}")
    none(missing)


def test_licences():
    """Source files name their licence in their first two lines; .reuse/dep5 covers the rest."""
    missing, n = set(), 0
    for folder in "src", "include", "tests", "validation", "web", "python", "site", "scripts":
        for where, folders, names in os.walk(os.path.join(SOURCE, folder)):
            folders[:] = [f for f in folders if f not in ("node_modules", "__pycache__")]
            for path in (os.path.join(where, name) for name in names if name.endswith((".c", ".h", ".py", ".js", ".css"))):
                n += 1
                with open(path, encoding="utf-8") as source:
                    if "SPDX-License-Identifier: GPL-3.0-or-later" not in source.readline() + source.readline():
                        missing.add(os.path.relpath(path, SOURCE))
    none(missing)
    check(n > 800, n)


def test_comments_name_what_exists():
    """Files, functions, types and constants that comments of the code speak of are there."""
    remarks, code, files = {}, "", set()
    for folder in "src", "include", "tests", "examples", "validation":
        for where, _, names in os.walk(os.path.join(SOURCE, folder)):
            files.update(names)
            for name in names:
                if name.endswith((".c", ".h")):
                    text = open(os.path.join(where, name), encoding="utf-8").read()
                    remarks[os.path.join(where, name)] = re.findall(r"/\*.*?\*/", text, re.DOTALL)
                    code += re.sub(r"/\*.*?\*/", " ", text, flags=re.DOTALL)
                elif name == "meson.build":  # files that the build makes
                    files.update(re.findall(r"output: '([\w.]+)'", open(os.path.join(where, name)).read()))
    known = set(re.findall(r"\b(?:gg|GG)_\w+", code))
    check(len(remarks) > 300 and len(known) > 500, len(remarks), len(known))
    missing = set()
    for name, texts in remarks.items():
        name = os.path.relpath(name, SOURCE)
        for text in texts:
            missing.update(f"{name}: {file}" for file in re.findall(r"\b(\w+\.[ch])\b", text)
                           if file not in files)
            missing.update(f"{name}: {word}" for word in re.findall(r"\b(?:gg|GG)_\w+\b", text)
                           if word not in known and not (word.endswith("_") and any(k.startswith(word) for k in known)))
    check(not missing, "named in comments, but not there:\n" + "\n".join(sorted(missing)))


def definitions():
    """{function: files of src that define it}."""
    found = {}
    for path in glob.glob(os.path.join(SOURCE, "src", "**", "*.[hc]"), recursive=True):
        with open(path, encoding="utf-8") as source:
            for name in re.findall(r"^\w[\w *]*?\b(gg_\w+)\([^;{}]*\)\s*\{", source.read(), re.MULTILINE):
                found.setdefault(name, set()).add(os.path.relpath(path, os.path.join(SOURCE, "src")))
    return found


def test_signposts_name_the_file_that_defines_what_follows():
    """In a header "/* queue.c: ... */" stands before prototypes of functions of queue.c, up to a blank line."""
    defined, wrong, n = definitions(), set(), 0
    for path in glob.glob(os.path.join(SOURCE, "src", "**", "*.h"), recursive=True):
        header = os.path.relpath(path, os.path.join(SOURCE, "src"))
        with open(path, encoding="utf-8") as source:
            text = source.read()
        for file, block in re.findall(r"^/\* ([\w/]+\.c)\b(?:(?!\*/).)*\*/\n((?:(?!/\*|\n\n).)*)", text, re.MULTILINE | re.DOTALL):
            for name in re.findall(r"^\w[\w *]*?\b(gg_\w+)\([^;{]*\);", block, re.MULTILINE):
                n += 1
                if not any(("/" + one).endswith("/" + file) for one in defined.get(name, {file})):
                    wrong.add(f"{header}: {name}")
    check(n > 100, n)
    check(not wrong, "signposts that name a wrong file:\n" + "\n".join(f"{one}, of {defined[one.split(': ')[1]]}" for one in sorted(wrong)))


def test_commands_shown_are_valid():
    """graingas COMMAND --option --set key=value, wherever documents show it."""
    keys, helps, wrong = page("scene"), {}, set()
    for name, text in documents().items():
        text = text.replace("\\\n", " ")
        blocks = re.findall(r"^```.*?^```", text, re.MULTILINE | re.DOTALL)
        spans = re.findall(r"`[^`]+`", re.sub(r"^```.*?^```", "", text, flags=re.MULTILINE | re.DOTALL))
        code = "\n".join(blocks + [span.strip("`").replace("\n", " ") for span in spans])
        for shown in re.findall(r"^\s*(?:\$ )?graingas ([a-z]+\b[^\n;|]*)", code, re.MULTILINE):
            command = shown.split()[0]
            if command not in helps:
                helps[command] = run(command, "--help")
            if helps[command].code:
                wrong.add(f"{name}: graingas {command}")
            for option in re.findall(r"--[a-z]+", shown):
                if option not in helps[command].out:
                    wrong.add(f"{name}: graingas {command} {option}")
            for key in re.findall(r"--set \"?([\w.]+)=", shown):
                if f"| `{key}` |" not in keys:
                    wrong.add(f"{name}: --set {key}")
    check(not wrong, "shown in documents, but not so:\n" + "\n".join(sorted(wrong)))


def names_of(kind):
    """From the program itself: the words of `measure`, the theories that a scene is shown, those that refuse it too."""
    if kind == "observables":
        words = page("scene").split("### `measure`")[1].split("###")[0]
        return re.findall(r"^- `(\w+)`: \S", words, re.MULTILINE), words.count("\n- ")
    about = json.loads(run("theory", "-", "--json", typed="flow: usf\nphi: 0.1\ncollision: {beta: 0}\n").out)["theories"]
    return list(about), sum(all(t[k] for k in ("title", "citation", "assumptions")) for t in about.values())


def test_each_observable_is_described():
    """Every observable has a word of description in the list of them, a section in its document, a scene that measures
    it."""
    names, described = names_of("observables")
    check(len(names) == described >= 13, names, described)
    text, scenes = documents()["docs/reference/observables.md"], ""
    for path in glob.glob(os.path.join(SOURCE, "examples", "*.yaml")):
        scenes += "".join(re.findall(r"^measure:.*", open(path, encoding="utf-8").read(), re.MULTILINE))
    none({f"docs/reference/observables.md: a section on {name}" for name in names if name != "rheology"
          and f"\n## `{name}`\n" not in text})
    none({f"examples: a scene that measures {name}" for name in names if not re.search(rf"\b{name}\b", scenes)})


def test_sizes_of_pictures():
    """Pictures are most of what a clone loads."""
    sizes = {path: os.path.getsize(path) for path in glob.glob(os.path.join(SOURCE, "docs", "images", "**", "*.*"), recursive=True)}
    check(len(sizes) > 100)
    none({f"{os.path.basename(path)}: {size} bytes, 500000 allowed" for path, size in sizes.items() if size > 500_000})
    check(sum(sizes.values()) < 8_000_000, "docs/images has", sum(sizes.values()), "bytes, 8000000 allowed")


# Scenes for each condition under which the table of observables leaves one out: the conditions that hold in it.
GASES = {"flow: usf": "smooth grains, shear, collisions that lose energy", "flow: usf\ncollision: {beta: 0}": "shear, collisions that lose energy",
         "flow: hcs": "smooth grains, free cooling, collisions that lose energy",
         "flow: hcs\ncollision: {beta: 0}": "free cooling, collisions that lose energy",
         "flow: hcs\ncollision: {beta: 0, mu: 0.3}": "free cooling, friction, collisions that lose energy",
         "flow: hcs\nspecies: [{fraction: 0.5}, {fraction: 0.5, mass: 2}]": "smooth grains, mixtures, free cooling, collisions that lose energy",
         "flow: hss": "smooth grains, heating, collisions that lose energy", "flow: hss\ncollision: {beta: 0}": "heating, collisions that lose energy",
         "flow: equilibrium": "smooth grains", "flow: equilibrium\ncollision: {beta: 1}": "",
         "flow: small_shear": "smooth grains, shear, `small_shear`, collisions that lose energy",
         "flow: couette": "smooth grains, walls, collisions that lose energy", "flow: couette\ncollision: {beta: 0}": "walls, collisions that lose energy",
         "flow: fourier": "smooth grains, walls, collisions that lose energy", "flow: chute": "smooth grains, walls, collisions that lose energy"}


def flows_of(support, word):
    """{flow: cell} of a row of docs/reference/support.md."""
    head, row = (re.search(rf"^\| {name} \|(.*)\|$", support, re.MULTILINE)[1].split("|") for name in
                 ("observable" if f"| `{word}` |" in support.split("## Theories")[0] else "theory", f"`{word}`"))
    return {flow.strip().replace(" ", "_"): cell.strip() for flow, cell in zip(head, row) if flow.strip() != "not of"}


def test_info_names_the_flows_of_the_page():
    """`graingas info` of an observable names the flows that the page of support has, of a flow the thermostats; scenes
    with them are accepted, others rejected or warned of."""
    support, (names, _) = documents()["docs/reference/support.md"], names_of("observables")
    for name in names:
        told = run("info", name, "--all").out
        for engine in "md", "dsmc":
            flows = re.search(rf"^  {engine} +((?:.|\n   )*)", told, re.MULTILINE)[1].split()
            expected = [flow for flow, cell in flows_of(support, name).items() if engine[0] in cell]
            check([flow.strip(",") for flow in flows] == (expected or ["none"]), name, engine, told)
    for flow, thermostats in re.findall(r"^\| `(\w+)` \|.*\| ([^|]*) \|$", support.split("## Observables")[0], re.MULTILINE):
        thermostats = thermostats.replace("\\", "")
        check(f"\n  thermostats  {thermostats}\n" in run("info", flow, "--all").out, flow, thermostats)
        for one in "none", "gaussian", "white_noise", "bath":
            done = run("info", "-", typed=f"flow: {flow}\nphi: 0.1\nthermostat: {one}\nbath: {{drag: 1, temperature: 1}}\n")
            check((one in thermostats.split(", ")) == ("thermostat" not in done.err), flow, one, done.err)


def test_flows_of_theories():
    """The table of theories names flows as the program does."""
    words = {"shear": {"usf"}, "shear, also in a bath": {"usf"}, "cooling": {"hcs", "small_shear"}, "heated": {"hss", "small_shear"},
             "Gaussian-heated": {"hss", "small_shear"}, "Gaussian heating": {"hss", "small_shear"}, "equilibrium": {"equilibrium"}, "Couette": {"couette"},
             "Poiseuille": {"poiseuille"}, "closed chute": {"chute"}, "Fourier": {"fourier"}, "shear (also heated)": {"usf", "heated_shear"},
             "in a bath": {"usf", "hss"}, "heated by a bath": {"hss"}, "by noise of given strength": {"hss"}, "at a given rate": {"hss"},
             "in shear as a scale": {"usf"}, "also in a bath": {"usf"}, "the same": {"hcs", "hss", "small_shear"}}
    support, wrong = documents()["docs/reference/support.md"], set()
    for names, flows in re.findall(r"^\| (`\w+`(?:, `\w+`)*) \| ([^|]+) \|[^|]*\|[^|]*\|[^|]*\|$", documents()["docs/reference/theories.md"], re.MULTILINE):
        for name in re.findall(r"\w+", names):
            said = set().union(*(words[word.strip()] for word in re.split(r"[,;] ", flows)))
            does = {flow for flow, cell in flows_of(support, name).items() if cell}
            if not does <= said or not said - {"small_shear"} <= does:
                wrong.add(f"{name}: {flows}; the program: {', '.join(sorted(does))}")
    none(wrong)


def test_one_claim_of_speed():
    """Factors of speed in documents are those of the table of run time against error."""
    pages = documents()
    rows, mean = {}, ""
    for state, quantity, factor in re.findall(r"^\|([^|]*)\| (T|N1) \|(?:[^|]*\|){5} (\d+) \|$", pages["docs/explanation/performance.md"], re.MULTILINE):
        rows.setdefault(quantity, []).append(int(factor))
    check(len(rows["T"]) >= 4 and len(rows["N1"]) >= 4, rows)
    words = "%d to %d times faster%s for T, %d to %d times for N1"
    expected = [words % (min(rows["T"]), max(rows["T"]), than, min(rows["N1"]), max(rows["N1"])) for than in (" than md", "")]
    check(expected[0] in pages["docs/explanation/performance.md"] and expected[1] in pages["docs/howto/choose_md_or_dsmc.md"], expected)
    none({name for name, text in pages.items() for found in re.findall(r"dsmc\W[^.|\n]*\d times faster[^.|\n]*", text) if not any(one in found for one in expected)})


def test_the_table_of_observables():
    """The engines and conditions of the table are those of the program: what each engine measures in each of GASES. So
    are the flows on the page of support."""
    names, _ = names_of("observables")
    rows = dict((name, (engines.split(", "), set(filter(None, without.split(", "))))) for name, engines, without in re.findall(
        r"^\| \[?`(\w+)`\]?[^|]*\| [^|]* \| ([^|]*) \| ([^|]*?) ?\|", documents()["docs/reference/observables.md"], re.MULTILINE) if name in names)
    check(set(rows) == set(names), set(names) ^ set(rows))
    known = set(", ".join(GASES.values()).split(", ")) | {"flows without walls", "other flows than `small_shear`", "scenes without `start.wave`", "rough grains"}
    none({f"condition of no scene here: {word}" for _, without in rows.values() for word in without - known})
    wrong, support = set(), documents()["docs/reference/support.md"]
    for gas, its in GASES.items():
        holds = set(its.split(", ")) | ({"flows without walls"} if "walls" not in its else set())
        holds |= {"other flows than `small_shear`"} if "`small_shear`" not in its else set()
        holds |= {"scenes without `start.wave`"}  # test_wave.py of the module has such scenes
        for engine in "md", "dsmc":
            done = run("run", "-", "--engine", engine, "--quiet", "--json", "--set", f"measure=[{', '.join(names)}]",
                       "--set", "particles=300", "--set", "dsmc.particles=300", "--set", "run.collisions=4", "--set", "run.warmup=1",
                       typed=gas + "\nphi: 0.1\n")
            check(done.code in (0, 1), gas, engine, done.err)
            out = set(re.findall(r"(\w+) is not measured", " ".join(json.loads(done.out)["warnings"])))
            for name, (engines, without) in rows.items():
                if (engine in engines and not without & holds) != (name not in out):
                    wrong.add(f"{name}: {'not ' * (name in out)}measured by {engine} in {gas!r}")
                said = engine[0] in flows_of(support, name).get(gas.split()[1], "")
                if said < (name not in out) or ("beta" in gas and "mu" not in gas and name != "shear_wave" and said != (name not in out)):
                    wrong.add(f"support.md: {name} of {engine} in {gas!r}")
    none(wrong)


def test_each_theory_is_described():
    """Every theory describes itself, stands in the table of theories, and is spoken of below it."""
    names, described = names_of("theories")
    check(len(names) == described >= 18, names, described)
    lines = documents()["docs/reference/theories.md"].splitlines()
    table, text = "".join(l for l in lines if l.startswith("|")), "\n".join(l for l in lines if not l.startswith("|"))
    none({f"docs/reference/theories.md: a row of {name} in the table" for name in names if f"`{name}`" not in table})
    none({f"docs/reference/theories.md: a section on {name}" for name in names if not re.search(rf"\b{name}\b", text)})


def test_answers_of_theories():
    """The page of quantities names a theory wherever it answers in a scene of examples."""
    rows = dict(re.findall(r"^\| `(\w+)` \|.*\| ([^|]*) \|$", documents()["docs/reference/quantities.md"], re.MULTILINE))
    rows = {name: theories.replace("\\", "").split(", ") for name, theories in rows.items()}
    missing, n = set(), 0
    for flow, more in (("usf", ""), ("usf", "collision: {beta: 0}"), ("hcs", ""), ("hcs", "collision: {beta: 0.5}"), ("equilibrium", ""),
                       ("hss", "species: [{fraction: 0.5}, {fraction: 0.5, mass: 2}]"), ("small_shear", "engine: dsmc")):
        done = run("theory", "-", "--json", typed=f"flow: {flow}\nphi: 0.03\n{more}\n")
        check(done.code == 0, flow, done.err)
        for theory, quantities in json.loads(done.out)["theory"].items():
            for name, value in quantities.items():
                n += 1
                if value["mean"] is not None and theory not in rows[name]:
                    missing.add(f"{name}: {theory}")
    check(n > 100)
    none(missing)


if __name__ == "__main__":
    main(sys.modules[__name__])
