# SPDX-License-Identifier: GPL-3.0-or-later
"""The first steps of the README, of docs/howto/python.md and of the tutorial in C, and the recipe of the container,
run as they stand in Debian without any other package. Skipped where mmdebstrap is missing, and for others than root."""
import os
import re
import shutil
import subprocess
import sys

sys.path.insert(0, os.path.join(os.environ["SOURCE"], "tests", "cli"))
from tap import Skip, check, main

SOURCE = os.environ["SOURCE"]
RELEASE = "bookworm"  # Debian 12, which the Containerfile names


def text(name):
    with open(os.path.join(SOURCE, name), encoding="utf-8") as file:
        return file.read()


def block(document, title):
    """The first block of shell below a title."""
    return re.search(rf"^## {re.escape(title)}.*?^```sh\n(.*?)^```", text(document), re.MULTILINE | re.DOTALL)[1]


def sources():
    """The files that git knows, as they stand."""
    listed = subprocess.run(["git", "-C", SOURCE, "ls-files", "-z"], capture_output=True, check=True).stdout
    subprocess.run(["tar", "-C", SOURCE, "--null", "-T", "-", "-cf", "sources.tar"], input=listed, check=True)


def in_bare_debian(root, code, timeout=3600):
    """A new root with apt alone, the sources in /source, and the shell's lines run there. The root stays."""
    if os.geteuid() != 0 or not shutil.which("mmdebstrap"):
        raise Skip("needs root and mmdebstrap")
    sources()
    made = subprocess.run(["mmdebstrap", "--quiet", "--variant=apt", "--aptopt=Acquire::Retries 3",
                           "--customize-hook=mkdir \"$1/source\"", "--customize-hook=tar-in sources.tar /source",
                           RELEASE, root], capture_output=True, text=True, timeout=600)
    check(made.returncode == 0, made.stderr[-2000:])
    return in_root(root, code, timeout)


def in_root(root, code, timeout=3600):
    """bash -e in that root; what it prints. /proc and /dev are those of the machine, and leave with the root's processes."""
    wrapped = 'mount -t proc proc "$0/proc"; mount --bind /dev "$0/dev"; cp /etc/resolv.conf "$0/etc/"; exec chroot "$0" bash -ec "$1"'
    done = subprocess.run(["unshare", "--mount", "sh", "-ec", wrapped, root, code], capture_output=True, text=True, timeout=timeout,
                          env={"PATH": "/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin", "HOME": "/root", "DEBIAN_FRONTEND": "noninteractive"})
    check(done.returncode == 0, code, done.stdout[-2000:], done.stderr[-3000:])
    return done.stdout


def test_readme_python_and_c():
    """./quickstart prints the README's table; then the module and a C program are built as their pages say."""
    table = in_bare_debian("readme", "cd /source && ./quickstart")
    number = re.search(r"^\| `temperature` .*?\| ([\d.]+\(\d+\)) \| ([\d.]+\(\d+\)) \|", text("README.md"), re.MULTILINE)
    row = re.search(r"^temperature .*$", table, re.MULTILINE)[0]
    check(number[1] in row and number[2] in row, row, number[0])
    packages = re.search(r"\(Debian: `(python3-cffi [^`]*)`\)", text("docs/howto/python.md"))[1]
    again = re.search(r"`(meson setup build --reconfigure [^`]*)`", text("docs/howto/python.md"))[1]
    module = block("docs/howto/python.md", "Build it").splitlines()[-1]
    found = in_root("readme", f"cd /source; apt-get install -y -q --no-install-recommends {packages} >&2; {{ {again}; }} >&2; {module}")
    check(re.search(r"^\d+\.\d+\.\d+", found), found)
    tutorial = text("docs/tutorial/first_program.md")
    program = re.search(r"<!-- file: gas\.c -->\n```c\n(.*?)```", tutorial, re.DOTALL)[1]
    printed = re.search(r"<!-- quick output of: cc gas\.c.*?```\n(.*?)```", tutorial, re.DOTALL)[1]
    with open("readme/source/gas.c", "w", encoding="utf-8") as file:
        file.write(program)
    install = block("docs/tutorial/first_program.md", "1. Install the library")
    build = block("docs/tutorial/first_program.md", "3. Build and run it")
    found = in_root("readme", f"cd /source; {{ {install} }} >&2; {build}\n./gas")
    check(found.endswith(printed), found, printed)


def stages():
    """The stages of the Containerfile: their commands, and what they copy. [["RUN", "..."], ["COPY", "..."], ...]"""
    joined = re.sub(r"\\\n\s*", " ", text("packaging/container/Containerfile"))
    lines = [line.split(None, 1) for line in joined.splitlines() if line and not line.startswith("#")]
    starts = [i for i, (word, _) in enumerate(lines) if word == "FROM"]
    return [lines[a:b] for a, b in zip(starts, starts[1:] + [len(lines)])]


def test_container():
    """Each stage of the recipe in a root of its own: its packages are enough to build, and to run."""
    build, run = ([f"({rest})" for word, rest in stage if word == "RUN"] for stage in stages())  # -e sees a && b fail
    in_bare_debian("build", "\n".join(build))
    in_bare_debian("run", run[0])
    subprocess.run(["cp", "-a", "build/installed/.", "run"], check=True)
    variables = "\n".join(f"export {rest}" for word, rest in stages()[1] if word == "ENV")
    found = in_root("run", variables + "\n" + "\n".join(run[1:]) + "\ngraingas theory /source/examples/usf.yaml")
    check("lun1991" in found, found)


if __name__ == "__main__":
    main(sys.modules[__name__])
