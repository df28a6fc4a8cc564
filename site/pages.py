#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Pages of the site that are made from the tree: the C interface, the Python module, examples, figures of papers.

    site/pages.py header > FILE   include/graingas.h with every comment in Doxygen form
    site/pages.py FOLDER          the pages, into FOLDER; the module `graingas` has to be on PYTHONPATH
"""
import ast
import glob
import inspect
import os
import re
import sys

ROOT = os.path.dirname(os.path.dirname(os.path.abspath(__file__)))


def read(*path):
    with open(os.path.join(ROOT, *path), encoding="utf-8") as file:
        return file.read()


def write(folder, name, text):
    os.makedirs(os.path.dirname(os.path.join(folder, name)), exist_ok=True)
    with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
        file.write(text)


def header():
    """Members and types have plain comments in the header."""
    text = read("include", "graingas.h")
    text = re.sub(r"^/\* (?=graingas:)", "/** @file\n * ", text)
    text = re.sub(r"^/\* (?!----)((?:(?!\*/).)*\*/\n(?:typedef|enum|#define))", r"/** \1", text, flags=re.MULTILINE | re.DOTALL)
    text = re.sub(r"(?<=[;,\w{})]) +/\* ", " /**< ", text)
    return re.sub(r"/\*\*.*?\*/", lambda c: c[0][:4] + re.sub(r"[<>&#]", r"\\\g<0>", c[0][4:]), text, flags=re.DOTALL)


def calls_of_python():
    """gg_function -> public names of the module whose code calls it, also by way of private helpers of their file."""
    import graingas as gg
    found = {}
    for path in glob.glob(os.path.join(os.path.dirname(gg.__file__), "*.py")):
        with open(path, encoding="utf-8") as file:
            tree = ast.parse(file.read())
        bodies = {}
        for node in tree.body:
            inner = [(f"{node.name}.", n) for n in node.body] if isinstance(node, ast.ClassDef) else [("", node)]
            bodies.update({prefix + n.name: n for prefix, n in inner if isinstance(n, ast.FunctionDef)})

        def uses(name, seen):
            names = {n.attr if isinstance(n, ast.Attribute) else n.id for n in ast.walk(bodies[name])
                     if isinstance(n, (ast.Attribute, ast.Name))}
            functions = {n for n in names if n.startswith("gg_")}
            for other in bodies:
                if other.split(".")[-1] in names and other.split(".")[-1].startswith("_") and other not in seen:
                    functions |= uses(other, seen | {other})
            return functions

        for name in bodies:
            owner, _, last = name.rpartition(".")
            public = inspect.getattr_static(getattr(gg, owner, None) if owner else gg, last, None)
            inits = last == "__init__"
            if public is None or (last.startswith("_") and not inits) or (owner and not hasattr(gg, owner)):
                continue
            for function in uses(name, {name}):
                found.setdefault(function, set()).add(owner if inits else name)
    return found


def c_pages(folder):
    """A page for each section of the header; after each function its callers in Python."""
    text = header()
    python = calls_of_python()
    parts = re.split(r"^/\* ---- (.*?) ----(.*?)\*/\n", text, flags=re.MULTILINE | re.DOTALL)
    preamble = re.search(r"Rules for all functions:(.*?)\*/", read("include", "graingas.h"), re.DOTALL).group(1)
    index = ["C interface", "===========", "", "The header `graingas.h`; link with ``pkg-config --libs graingas``. "
             ":doc:`First program <../../docs/tutorial/first_program>`, :doc:`own theories and observables "
             "<../../docs/howto/extend>`, :doc:`examples <../examples>`. Each function names the members of the "
             ":doc:`Python module <../python_module>` that call it.", "", prose(preamble), "", ".. toctree::", ""]
    documented = set()
    for title, about, body in zip(parts[1::3], parts[2::3], parts[3::3]):
        short = title.split(":")[0].split(",")[0]
        name = re.sub(r"\W+", "_", short.lower())
        index.append(f"   {name}")
        lines = [short, "=" * len(short), "", (title + "." if title != short else ""), "", prose(about), ""]
        for kind, item in declarations(body):
            if item in documented:
                continue
            documented.add(item)
            lines += [f".. doxygen{kind}:: {item}"] + ["   :members:", "   :undoc-members:"] * (kind == "struct") + [""]
            if kind == "function" and item in python:
                lines += ["Python: " + ", ".join(role(n) for n in sorted(python[item])), ""]
        write(folder, f"c/{name}.rst", "\n".join(lines))
    write(folder, "c/index.rst", "\n".join(index) + "\n")


def role(name):
    return f":py:obj:`graingas.{name}`"


def prose(comment):
    """A comment of the header as paragraphs."""
    lines = [re.sub(r"^ \*? ?", "", line) for line in comment.strip().split("\n")]
    return re.sub(r"(?<!\w)(gg_\w+)\(\)", r":c:func:`\1`", re.sub(r"[*|`]|_(?=\W)", r"\\\g<0>", "\n".join(lines)))


def declarations(body):
    """Kind and name of what a section declares, in order."""
    plain = re.sub(r"/\*.*?\*/", lambda c: re.sub(r"[^\n]", " ", c[0]), body, flags=re.DOTALL)
    pattern = re.compile(r"^#define (?P<define>GRAINGAS_\w+)|^typedef struct (?P<struct>gg_\w+) \{|^typedef enum (?P<enum>gg_\w+) \{"
                         r"|^typedef struct \w+ (?P<typedef>gg_\w+);|^typedef [^;{]*?\(\*(?P<pointer>gg_\w+)\)"
                         r"|^GG_API [^;]*?\b(?P<function>gg_\w+)\(", re.MULTILINE)
    for found in pattern.finditer(plain):
        kind = found.lastgroup
        if kind == "typedef" and re.search(rf"^typedef struct {found[kind]} \{{", plain, re.MULTILINE):
            continue
        yield {"pointer": "typedef"}.get(kind, kind), found[kind]


def python_page(folder):
    import graingas as gg
    names = [n for n in sorted(dir(gg), key=str.lower) if not n.startswith("_")]
    objects = {n: getattr(gg, n) for n in names}
    mine = {n: o for n, o in objects.items() if getattr(o, "__module__", "").startswith("graingas") and n not in ("lib", "text")}
    errors = [n for n, o in mine.items() if inspect.isclass(o) and issubclass(o, Exception)]
    classes = [n for n, o in mine.items() if inspect.isclass(o) and n not in errors]
    functions = [n for n in mine if n not in errors and n not in classes]
    lines = ["Python module", "=============", "", "``import graingas``. How to use it: :doc:`Python module <../docs/howto/python>`, "
             ":doc:`notebooks <notebooks>`. Each member names the functions of the :doc:`C interface <c/index>` that it calls.", ""]
    for title, some, kind in (("Functions", functions, "function"), ("Classes", classes, "class"), ("Errors", errors, "exception")):
        lines += [title, "-" * len(title), ""]
        for name in some:
            lines += [f".. auto{kind}:: graingas.{name}", *["   :members:", "   :inherited-members: Exception, tuple"] * (kind != "function"), ""]
    write(folder, "python_module.rst", "\n".join(lines))


def examples_page(folder):
    """Every scene and program of `examples`, by name."""
    lines = ["# Examples", ""]
    for kind, title, language in ("yaml", "Scenes", "yaml"), ("c", "Programs in C", "c"):
        lines += [f"## {title}", ""]
        for path in sorted(glob.glob(os.path.join(ROOT, "examples", "*." + kind))):
            name = os.path.basename(path)
            lines += [f"### {name}", "", f"```{{literalinclude}} ../examples/{name}", f":language: {language}", "```", ""]
    write(folder, "examples.md", "\n".join(lines))


def gallery_page(folder):
    """Pictures of the documents, then the figures of papers with links to their verdicts."""
    lines = ["# Gallery", "", "Pictures that `graingas compare` and `graingas plot` draw, and where they are explained.", ""]
    where = {}
    for path in ["README.md", *sorted(glob.glob("docs/**/*.md", root_dir=ROOT, recursive=True))]:
        for text, picture in re.findall(r"!\[([^]]*)\]\(([^)]+\.png)\)", read(path)):
            where.setdefault(os.path.normpath(os.path.join(os.path.dirname(path), picture)), (text, path))
    for picture, (text, path) in sorted(where.items()):
        if "reproduction" not in picture:
            lines += [f"[![{text}](../{picture})](../{path})", "", f"{text}: [{os.path.basename(path)}](../{path})", ""]
    lines += ["## Figures of two papers", "", "Simulated anew; each links to its verdict.", ""]
    page = read("docs", "appendix", "reproduction.md")
    for title, picture in re.findall(r"^## (.*)\n\n!\[[^]]*\]\(\.\./(images/reproduction/[^)]+)\)", page, re.MULTILINE):
        anchor = re.sub(r"[^\w\- ]", "", title.lower()).replace(" ", "-")
        lines.append(f"[![{title}](../docs/{picture})](../docs/appendix/reproduction.md#{anchor})")
    write(folder, "gallery.md", "\n".join(lines) + "\n")


def notebooks_page(folder):
    lines = ["# Notebooks", "", "Executed when the site is built; the files are in `python/notebooks`.", "", "```{toctree}"]
    lines += [f"../python/notebooks/{os.path.basename(path)[:-6]}" for path in sorted(glob.glob(os.path.join(ROOT, "python", "notebooks", "*.ipynb")))]
    write(folder, "notebooks.md", "\n".join(lines + ["```", ""]))


if __name__ == "__main__":
    if sys.argv[1:] == ["header"]:
        sys.stdout.write(header())
    else:
        for make in c_pages, python_page, examples_page, gallery_page, notebooks_page:
            make(sys.argv[1])
