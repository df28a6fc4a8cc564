"""Documents say what is true of the tree: the page of scene keys is the table's."""
import glob
import os
import sys

from tap import check, main, run

SOURCE = os.environ["SOURCE"]


def documents():
    found = glob.glob(os.path.join(SOURCE, "*.md")) + glob.glob(os.path.join(SOURCE, "docs", "*.md"))
    check(len(found) >= 6, found)
    return {os.path.relpath(path, SOURCE): open(path, encoding="utf-8").read() for path in found}


def test_scene_page():
    """A new key is a new line there: graingas --scene-page > docs/scene.md"""
    page = run("--scene-page")
    check(page.code == 0 and not page.err and "collision.beta" in page.out)
    check(page.out == documents()["docs/scene.md"], "docs/scene.md is not what `graingas --scene-page` prints: redirect "
          "it there")


if __name__ == "__main__":
    main(sys.modules[__name__])
