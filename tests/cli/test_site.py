# SPDX-License-Identifier: GPL-3.0-or-later
"""scripts/build-site makes pages of all documents, of the C interface and of the Python module, without a warning of
Sphinx or Doxygen and without a dead link. Skipped where its tools are not installed; notebooks have tests of their own."""
import importlib.util
import json
import os
import re
import shutil
import subprocess
import sys
import tempfile

from tap import PATIENCE, SANITIZERS, Skip, check, main

SOURCE, BUILD = os.environ["SOURCE"], os.environ["BUILD"]
FOLDER = tempfile.TemporaryDirectory()
HTML = os.path.join(FOLDER.name, "html")


def page(*name):
    with open(os.path.join(HTML, *name), encoding="utf-8") as file:
        return file.read()


def site():
    """Built once, with a page for the front."""
    if os.path.exists(HTML):
        return
    if SANITIZERS != "none":
        raise Skip("sanitizers would have to be loaded before Python")
    if not os.path.isdir(os.path.join(BUILD, "python", "graingas")):
        raise Skip("this build has no Python module")
    for tool in "doxygen", "sphinx-build", "pandoc", "esbuild":
        if not shutil.which(tool):
            raise Skip(f"{tool} is not installed")
    for module in "sphinx", "myst_parser", "furo", "breathe", "nbsphinx", "cffi", "numpy", "matplotlib", "pandas", "xarray", "ipykernel":
        if importlib.util.find_spec(module) is None:
            raise Skip(f"{module} is not installed")
    if not os.path.exists("/usr/share/javascript/mathjax"):
        raise Skip("MathJax is not installed")
    with open("a.html", "w", encoding="utf-8") as file:
        file.write("<p>grains</p>")
    done = subprocess.run([os.path.join(SOURCE, "scripts", "build-site"), "--quick", "--build", BUILD, "--page", "a.html", FOLDER.name],
                          capture_output=True, text=True, timeout=500 * PATIENCE)
    check(done.returncode == 0, done.stdout[-3000:], done.stderr[-3000:])


def dead_links():
    return subprocess.run([sys.executable, os.path.join(SOURCE, "site", "check_links.py"), HTML], capture_output=True, text=True)


def test_every_document_is_a_page():
    site()
    for where, _, files in os.walk(os.path.join(SOURCE, "docs")):
        for name in files:
            if name.endswith(".md"):
                path = os.path.relpath(os.path.join(where, name), SOURCE)[:-3] + ".html"
                check(os.path.exists(os.path.join(HTML, path)), path)
    check('src="page.html"' in page("index.html") and page("page.html") == "<p>grains</p>")


def test_c_interface():
    """Every function of the header has an entry with its comment, and links lead from C to Python and back."""
    site()
    with open(os.path.join(SOURCE, "include", "graingas.h"), encoding="utf-8") as header:
        text = header.read().split("---- Sizes ----")[0]
    names = set(re.findall(r"^GG_API [^;]*?\b(gg_\w+)\(", text, re.MULTILINE))
    pages = "".join(page("site", "c", name) for name in os.listdir(os.path.join(HTML, "site", "c")))
    missing = {name for name in names if f'id="c.{name}"' not in pages}
    check(len(names) > 90 and not missing, missing)
    members = set(re.findall(r"^  (?:const )?(?:char|double|int|size_t|uint64_t) (?:\*)?(\w+);", text, re.MULTILINE))
    missing = {name for name in members if not re.search(rf'id="c\.gg_\w+\.{name}"', pages)}
    check(len(members) > 60 and not missing, missing)
    check("GG_OK; GG_BAD_INPUT with line, key and allowed values" in pages)
    check('python_module.html#graingas.Scene.copy"' in page("site", "c", "scenes.html"))
    check('c/scenes.html#c.gg_scene_copy"' in page("site", "python_module.html"))
    check(len(re.findall(r"python_module\.html#graingas\.[\w.]+", pages)) > 60)


def test_python_module():
    """Every public name of the module, with its documentation."""
    site()
    listed = subprocess.run(["/usr/bin/python3", "-c", "import graingas as gg; print(*(n for n in dir(gg) if n[0] != '_' and "
                             "getattr(getattr(gg, n), '__module__', '').startswith('graingas')))"], capture_output=True,
                            text=True, env=dict(os.environ, PYTHONPATH=os.path.join(BUILD, "python"))).stdout.split()
    text = page("site", "python_module.html")
    missing = {n for n in listed if n != "text" and not re.search(rf'id="graingas\.(?:\w+\.)?{n}"', text)}
    check(len(listed) > 25 and not missing, missing)


def test_formulas_and_search():
    """Formulas are set by MathJax of the site itself, and the search knows names of both interfaces."""
    site()
    text = page("docs", "explanation", "model_and_units.html")
    check(r"\[\mathbf g'\cdot\mathbf k" in text and "_static/mathjax/MathJax.js" in text)
    check(os.path.exists(os.path.join(HTML, "_static", "mathjax", "jax", "output", "CommonHTML", "jax.js")))
    check("gg_scene_copi" in page("searchindex.js") or "gg_scene_copy" in page("searchindex.js"))


def test_in_a_browser():
    """At 1366 columns, from the disk: no message, every style sheet, the contents on the screen, a button for the theme
    that acts, so that the theme's script runs."""
    site()
    node, script = shutil.which("node"), os.path.join(SOURCE, "tests", "cli", "site_in_browser.js")
    if not node or not any(map(shutil.which, ("chromium", "chromium-browser", "google-chrome"))):
        raise Skip("node or Chromium is not installed")
    names = "index", "docs/reference/quantities", "docs/howto/python", "docs/explanation/dsmc", "site/python_module", "site/c/scenes"
    done = subprocess.run([node, script, *(os.path.join(HTML, *name.split("/")) + ".html" for name in names)], capture_output=True, text=True,
                          timeout=200 * PATIENCE)
    check(done.returncode == 0, done.stderr)
    pages = [json.loads(line) for line in done.stdout.splitlines()]
    check(len(pages) == len(names), done.stdout)
    for one in pages:
        check(not one["said"] and not one["failed"] and not one["elsewhere"], one)
        check(one["margin"] == "0px", one)  # of normalize.css
        check(one["wide"] <= one["window"] == 1366 and one["theme"][0] != one["theme"][1], one)
        check(one["contents"] is None or 0 <= one["contents"][0] < one["contents"][1] <= 1366, one)
    check(sum(one["contents"] is not None for one in pages) >= 4, pages)


def test_dead_links_are_found():
    """A file that is not there, an anchor that is not there, and a script from elsewhere."""
    site()
    check(dead_links().returncode == 0)
    path = os.path.join(HTML, "docs", "validation.html")
    whole = page("docs", "validation.html")
    for link in '<a href="nothing.html">x</a>', '<a href="../index.html#nothing-of-this">x</a>', '<script src="https://example.org/a.js"></script>':
        with open(path, "w", encoding="utf-8") as file:
            file.write(whole + link)
        done = dead_links()
        check(done.returncode == 1 and "docs/validation.html: " in done.stderr and len(done.stderr.splitlines()) == 1, link, done.stderr)
    with open(path, "w", encoding="utf-8") as file:
        file.write(whole)


if __name__ == "__main__":
    main(sys.modules[__name__])
