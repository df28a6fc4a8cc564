# SPDX-License-Identifier: GPL-3.0-or-later
"""README and tutorial show what their commands print: scripts/refresh-documents on those that take under 3 s each."""
import os
import shutil
import subprocess
import sys

from tap import GRAINGAS, PATIENCE, SANITIZERS, Skip, check, main

SOURCE, BUILD = os.environ["SOURCE"], os.environ["BUILD"]
SCRIPT = os.path.join(SOURCE, "scripts", "refresh-documents")


def refresh(*args, script=SCRIPT):
    return subprocess.run([sys.executable, script, *args], capture_output=True, text=True, timeout=200 * PATIENCE,
                          env=dict(os.environ, BUILD=BUILD, GRAINGAS=GRAINGAS))


def needed():
    if SANITIZERS != "none":
        raise Skip("the programs of the tutorial are built without sanitizers")
    for tool in "bash", "cc", "pkg-config":
        if not shutil.which(tool):
            raise Skip(f"{tool} is not installed")


def test_pages_are_up_to_date():
    """If not: scripts/refresh-documents"""
    needed()
    done = refresh("--check", "--quick")
    check(done.returncode == 0, "run scripts/refresh-documents:\n" + done.stdout + done.stderr)


def test_a_wrong_number_is_found_and_mended():
    needed()
    os.makedirs("scripts")
    os.makedirs("examples")
    os.makedirs("docs/images")
    open("docs/images/p.svg", "w").close()
    script = shutil.copy(SCRIPT, "scripts")
    page = "# A\n\n<!-- quick output of: echo 1; echo 2 -->\n```\n1\n3\n```\n\n| a |\n\n<!-- run -->\n```sh\necho '<svg/>' > p.svg; echo 7\n```\n\n" \
           "<!-- output of: the block above -->\n```\n```\n![p](docs/images/p.svg)\nEnd.\n"
    with open("README.md", "w") as f:
        f.write(page)
    done = refresh("--check", "--quick", script=os.path.abspath(script))
    check(done.returncode == 1 and "-3\n+2\n" in done.stdout, done.stdout, done.stderr)
    check(open("README.md").read() == page, "--check writes")
    check(refresh(script=os.path.abspath(script)).returncode == 0)
    check(open("README.md").read() == page.replace("3\n", "2\n").replace("```\n```\n!", "```\n7\n```\n!"))
    check(refresh("--check", script=os.path.abspath(script)).returncode == 0)


def test_a_picture_of_another_run_is_found():
    """The picture of a page carries a stamp of the page's numbers. That of the README has one."""
    needed()
    os.makedirs("scripts")
    os.makedirs("examples")
    os.makedirs("docs/images")
    open("docs/images/p.svg", "w").close()
    script = os.path.abspath(shutil.copy(SCRIPT, "scripts"))
    page = "<!-- run -->\n```sh\necho '<svg/>' > p.svg; echo 7\n```\n\n<!-- output of: the block above -->\n```\n1\n```\n![p](docs/images/p.svg)\n"
    with open("README.md", "w") as f:
        f.write(page)
    check(refresh(script=script).returncode == 0 and refresh("--check", "--quick", script=script).returncode == 0)
    check("<svg/>\n<!-- numbers: " in open("docs/images/p.svg").read())
    with open("README.md", "w") as f:
        f.write(page.replace("\n1\n", "\n8\n"))
    done = refresh("--check", "--quick", script=script)
    check(done.returncode == 1 and "docs/images/p.svg is of another run" in done.stdout, done.stdout)
    with open(os.path.join(SOURCE, "README.md"), encoding="utf-8") as f:
        pictures = [name for name in ("docs/images/usf.svg",) if f"({name})" in f.read()]
    check(pictures and all("<!-- numbers: " in open(os.path.join(SOURCE, name)).read() for name in pictures), pictures)


if __name__ == "__main__":
    main(sys.modules[__name__])
