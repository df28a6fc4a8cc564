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
    script = shutil.copy(SCRIPT, "scripts")
    page = "# A\n\n<!-- quick output of: echo 1; echo 2 -->\n```\n1\n3\n```\n\n| a |\n\n<!-- run -->\n```sh\necho 7\n```\n\n" \
           "<!-- output of: the block above -->\n```\n```\nEnd.\n"
    with open("README.md", "w") as f:
        f.write(page)
    done = refresh("--check", "--quick", script=os.path.abspath(script))
    check(done.returncode == 1 and "-3\n+2\n" in done.stdout, done.stdout, done.stderr)
    check(open("README.md").read() == page, "--check writes")
    check(refresh(script=os.path.abspath(script)).returncode == 0)
    check(open("README.md").read() == page.replace("3\n", "2\n").replace("```\n```\nEnd", "```\n7\n```\nEnd"))
    check(refresh("--check", script=os.path.abspath(script)).returncode == 0)


if __name__ == "__main__":
    main(sys.modules[__name__])
