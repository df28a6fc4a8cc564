# SPDX-License-Identifier: GPL-3.0-or-later
"""Types of the module for editors and type checkers: names.py is of the library's tables, and pyright, if it is installed,
accepts right programs and finds wrong ones."""
import os
import shutil
import subprocess
import sys

import pytest

import graingas as gg
from graingas import names
from graingas.scene import GROUPS, KEYS

SOURCE = os.environ.get("SOURCE", os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", ".."))

RIGHT = """
import graingas as gg
s = gg.Scene(flow="usf", phi=0.1, e=0.9, collision={"mu": 0.1})
density: float = s.phi + 1
drag: float = s.bath.drag
c = gg.compare(s)
mean: float = c["temperature"].md.mean
answer: float = c["temperature"].theory["lun1991"]
r = gg.run(s, engine="dsmc")
error: float = r["N1"].error
text: str = gg.cite(c, "md")
"""
WRONG = """
import graingas as gg
s = gg.Scene(flow="usf", phy=0.1)
s.bath.drug
gg.run(s)["temperature"].men
"""


def test_names_are_of_the_tables():
    """If not: scripts/make-names > python/graingas/names.py"""
    script = os.path.join(SOURCE, "scripts", "make-names")
    made = subprocess.run([sys.executable, script], capture_output=True, text=True, check=True).stdout
    with open(os.path.join(SOURCE, "python", "graingas", "names.py"), encoding="utf-8") as file:
        assert made == file.read(), "run scripts/make-names"


def test_every_key_has_a_type():
    for key in KEYS:
        group, _, name = key.rpartition(".")
        owner = getattr(names, f"{group.capitalize()}Keys") if group else names.SceneKeys
        assert name in owner.__annotations__, key
        assert (key if not group else group) in names.KeyWords.__annotations__
    assert set(GROUPS) <= set(names.SceneKeys.__annotations__)
    assert not any(name in vars(names.SceneKeys) for name in names.SceneKeys.__annotations__), "types only"


def checked(text):
    checker = os.environ.get("PYRIGHT") or shutil.which("pyright")
    if not checker:
        pytest.skip("pyright is not installed")
    with open("program.py", "w", encoding="utf-8") as file:
        file.write(text)
    with open("pyrightconfig.json", "w", encoding="utf-8") as file:
        file.write('{"extraPaths": ["%s"], "reportMissingModuleSource": false, "reportAttributeAccessIssue": true}' %
                   os.path.dirname(os.path.dirname(gg.__file__)))
    done = subprocess.run([checker, "program.py"], capture_output=True, text=True)
    return done.stdout


def test_right_programs_pass():
    said = checked(RIGHT)
    assert "0 errors" in said, said


def test_wrong_programs_do_not():
    said = checked(WRONG)
    assert "phy" in said and "drug" in said and "men" in said and "3 errors" in said, said
