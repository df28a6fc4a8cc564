# SPDX-License-Identifier: GPL-3.0-or-later
"""Sphinx: the site of the documents. scripts/build-site lays the tree out for it, and sets the variables read here."""
import ast
import os
import re
import sys

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import pages  # noqa: E402

project = "graingas"
author = "the graingas developers"
version = release = os.environ["GRAINGAS_VERSION"]
extensions = ["myst_parser", "breathe", "sphinx.ext.autodoc", "sphinx.ext.mathjax", "nbsphinx"]
root_doc = "index"
exclude_patterns = ["**/.ipynb_checkpoints"]
html_theme = "furo"
html_title = f"graingas {version}"
html_static_path = [os.environ["GRAINGAS_STATIC"]]
html_css_files = ["site.css"]
html_copy_source = False
myst_enable_extensions = ["dollarmath", "amsmath"]
myst_heading_anchors = 4
mathjax_path = "mathjax/MathJax.js?config=TeX-AMS_CHTML"
mathjax2_config = {"tex2jax": {"inlineMath": [["\\(", "\\)"]], "displayMath": [["\\[", "\\]"]]}}
breathe_projects = {"graingas": os.environ["GRAINGAS_DOXYGEN"]}
breathe_default_project = "graingas"
breathe_domain_by_extension = {"h": "c"}
nbsphinx_execute = os.environ["GRAINGAS_NOTEBOOKS"]
nbsphinx_requirejs_path = ""
nbsphinx_timeout = 600
autodoc_member_order = "bysource"
autodoc_typehints = "signature"

CALLS = {}
for function, names in pages.calls_of_python().items():
    for name in names:
        CALLS.setdefault("graingas." + name, []).append(function)


def other_places(app, name, source):
    """Links of documents to files that are pages here: README, folders, examples, the header."""
    if not os.path.exists(app.env.doc2path(name)) or not app.env.doc2path(name).endswith(".md"):
        return
    up = "../" * name.count("/")
    for pattern, page in ((r"README\.md", "index.md"), (r"\.github/SECURITY\.md", "SECURITY.md"), (r"validation/README\.md", "docs/validation.md"), (r"examples", "site/examples.md"), (r"docs/(?:howto|reference|explanation)", "index.md"),
                          (r"python/notebooks", "site/notebooks.md"), (r"include/graingas\.h", "site/c/index.rst"), (r"examples/(\w+)\.(yaml|c)", r"site/examples.md#\1\2")):
        source[0] = re.sub(rf"\]\((?:\.\./)*{pattern}\)", rf"]({up}{page})", source[0])


def is_code(paragraph):
    try:
        ast.parse(paragraph)
    except SyntaxError:
        return False
    return bool(re.search(r"[(=]", paragraph))


def escaped(text):
    return re.sub(r"[*|\\]|_(?=\W|$)|^[+-](?= )", r"\\\g<0>", re.sub(r"`([^`]+)`", r"``\1``", text), flags=re.MULTILINE)


def paragraph_as_rst(paragraph):
    """Code becomes a block; names with explanations behind blanks become a list of definitions."""
    lines = paragraph.splitlines()
    if paragraph.startswith("    ") or is_code(paragraph):
        return ["::", "", *("    " + line for line in lines), ""]
    if not re.match(r"\S.*? {2,}\S", lines[0]):
        return [*escaped(paragraph).splitlines(), ""]
    text = []
    for line in lines:
        term, _, meaning = (" " + line if line[0] == " " else line).partition("  ")
        text += ["", escaped(term)] * bool(term.strip()) + ["    " + escaped(meaning.strip())] * bool(meaning.strip())
    return [*text[1:], ""]


def plain_docstring(app, what, name, obj, options, lines):
    """Docstrings are plain text; the C functions that a member calls follow."""
    text = []
    for paragraph in re.split(r"\n\s*\n", "\n".join(lines).strip("\n")):
        text += paragraph_as_rst(paragraph) if paragraph.strip() else []
    calls = sorted(CALLS.get(name, []))
    if calls:
        text += ["C: " + ", ".join(f":c:func:`{c}`" for c in calls), ""]
    lines[:] = text


def setup(app):
    app.connect("source-read", other_places)
    app.connect("autodoc-process-docstring", plain_docstring)
