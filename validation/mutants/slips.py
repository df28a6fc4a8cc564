#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Slips that a developer could make between the samples and the files, planted by hand, and the tests that notice them.

  slips.py FOLDER build            a copy of the tree in FOLDER that holds them all, and its build
  slips.py FOLDER reach [TESTS]    which test of suites unit and cli reaches which slip
  slips.py FOLDER try [NUMBER ...] each slip against the tests that reach it, those of its room first, until one fails
  slips.py FOLDER table            slips.md beside this file

FOLDER is outside of the repository. `try` goes on where it stopped; numbers are tried anew."""
import concurrent.futures
import json
import os
import re
import subprocess
import sys

import mutants
import tree
from slip_list import SLIPS

HERE = os.path.dirname(os.path.abspath(__file__))
# Others look at the tree itself or at exported names, or take minutes to kill and fail what no slip changes.
TESTS = (r"(run|statistics|sweep|files|measure|bench)/|api/(?!workers|memory)|scene/resumption"
         r"|cli/(export|files|independent|numbers|options|outputs|stopping|trajectory|validate|wall_frames)$")
AT_ONCE = 3


def parts(text):
    """Source as it is, and with both: «right ¦ wrong»; a statement that is left out has nothing behind the bar."""
    right = re.sub(r"«(.*?) ¦ ?(.*?)»", lambda m: m[1], text, flags=re.S)
    where = re.search(r"«(.*?) ¦ ?(.*?)»", text, flags=re.S)
    return right, where.start(), where[1], where[2]


def planted():
    """Number, file, line, right, wrong, what: and where in the file the right one stands."""
    for i, (path, text, what) in enumerate(SLIPS, 1):
        with open(os.path.join(tree.ROOT, path), encoding="utf-8") as f:
            source = f.read()
        whole, offset, right, wrong = parts(text)
        if source.count(whole) != 1:
            sys.exit(f"slip {i}: {path} has {source.count(whole)} times: {whole}")
        at = source.index(whole) + offset
        yield {"id": i, "file": path, "line": source.count("\n", 0, at) + 1, "at": at, "right": right, "wrong": wrong,
               "what": what, "room": path.split("/")[1]}


def with_slips(source, here):
    for s in sorted(here, key=lambda s: -s["at"]):
        both = (f"(GG_MUTANT({s['id']}) ? ({s['wrong']}) : ({s['right']}))" if s["wrong"] else
                f"if (!GG_MUTANT({s['id']})) {{ {s['right']} }}")
        source = source[:s["at"]] + both + source[s["at"] + len(s["right"]):]
    quiet = "".join(f'#pragma GCC diagnostic ignored "-W{w}"\n' for w in ("extra", "shadow", "pedantic", "unused"))
    return quiet + '#include "common/mutants.h"\n#line 1\n' + source


def write(folder):
    edits = {}
    for s in planted():
        edits.setdefault(s["file"], []).append(s)
    listed = subprocess.run(["git", "-C", tree.ROOT, "ls-files"], capture_output=True, text=True, check=True).stdout
    for path in filter(None, listed.split("\n")):
        source = os.path.join(tree.ROOT, path)
        if not os.path.isfile(source):
            continue
        with open(source, "rb") as f:
            data = f.read()
        if path in edits:
            data = with_slips(data.decode(), edits[path]).encode()
        if path == "src/common/meson.build":
            data = data.replace(b"common_sources = files(", b"common_sources = files('mutants.c',")
        tree.put(os.path.join(folder, "tree", path), data, os.stat(source).st_mode)
    for name in "mutants.c", "mutants.h":
        with open(os.path.join(HERE, name), "rb") as f:
            tree.put(os.path.join(folder, "tree/src/common", name), f.read(), 0o644)


def build(folder):
    write(folder)
    where = os.path.join(folder, "tree/build")  # paths as in any build: the compiler's cache knows most of it
    if not os.path.exists(os.path.join(where, "build.ninja")):
        subprocess.run(["meson", "setup", where, os.path.join(folder, "tree"), "-Dtests=true", "-Dwerror=true"], check=True,
                       stdout=subprocess.DEVNULL)
    subprocess.run(["ninja", "-j2", "-C", where], check=True)


def tests(folder):
    """Name -> command and environment."""
    out = subprocess.run(["meson", "introspect", "--tests", os.path.join(folder, "tree/build")], capture_output=True, text=True,
                         check=True).stdout
    return {t["name"]: (["env", *(f"{k}={v}" for k, v in t["env"].items()), *t["cmd"]]) for t in json.loads(out)
            if re.match(TESTS, t["name"]) and re.search(r":(unit|cli)$", t["suite"][0])}


def reach(folder, wanted=""):
    found = mutants.load(folder, "reach.json", {})

    def one(item):
        name, command = item
        told = os.path.join(folder, "told-" + name.replace("/", "-"))
        open(told, "w").close()
        code, cpu, failed = mutants.run(command, 0, 600, told, whole=True)
        with open(told) as f:
            return name, code, cpu, failed, sorted({int(i) for i in f})

    left = [(n, c) for n, c in sorted(tests(folder).items()) if n not in found and re.match(wanted, n)]
    with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
        for name, code, cpu, failed, ids in pool.map(one, left):
            found[name] = {"cpu": cpu, "code": code, "reached": ids}
            mutants.save(folder, "reach.json", found)
            print(f"{name} {cpu:.1f} s, {len(ids)}{'' if code == 0 else f', fails by itself: {failed}'}", flush=True)


def attempt(s, found, commands):
    """The tests that reach it, of its file and its room first, and quickest first; an independent computation early."""
    row = {"id": s["id"], "tried": [], "killer": None}
    left = [n for n, t in found.items() if s["id"] in t["reached"] and t["code"] == 0 and n in commands]
    stem = os.path.splitext(os.path.basename(s["file"]))[0]
    weight = {s["room"]: 1, "cli": 0.3}
    for name in sorted(left, key=lambda n: (stem not in n, found[n]["cpu"] * weight.get(n.split("/")[0], 3))):
        code, _, failed = mutants.run(commands[name], s["id"], 3 * found[name]["cpu"] + 20)
        row["tried"].append(name)
        if code != 0:
            row.update(killer=name, failed=failed[:3])
            break
    return row


def try_all(folder, *only):
    found, commands = mutants.load(folder, "reach.json"), tests(folder)
    done = {r["id"] for r in mutants.lines(folder, "results.jsonl")}
    left = [s for s in planted() if (str(s["id"]) in only if only else s["id"] not in done)]
    left.sort(key=lambda s: only.index(str(s["id"])) if only else 0)
    with concurrent.futures.ThreadPoolExecutor(AT_ONCE) as pool:
        begun = {pool.submit(attempt, s, found, commands): s for s in left}
        for one in concurrent.futures.as_completed(begun):
            s, row = begun[one], one.result()
            mutants.note(folder, "results.jsonl", row)
            print(s["id"], s["file"], s["line"], s["what"], "->", row["killer"] or "SURVIVES", row.get("failed", ""),
                  len(row["tried"]), flush=True)


def table(folder):
    results = {r["id"]: r for r in mutants.lines(folder, "results.jsonl")}  # the last word counts
    rows = list(planted())
    killed = [s for s in rows if results.get(s["id"], {}).get("killer")]
    with open(os.path.join(HERE, "slips.md"), "w") as f:
        f.write("# Slips and what noticed them\n\nMade by `validation/mutants/slips.py FOLDER table`. The first test that "
                f"failed, those of the room first. {len(killed)} of {len(rows)} are detected; open: not yet tried against all tests that reach it.\n\n"
                "| | where | slip | detected by |\n| --- | --- | --- | --- |\n")
        for s in rows:
            r = results.get(s["id"]) or {}
            by = f"{r['killer']}: {', '.join(r.get('failed') or ['its end'])}" if r.get("killer") else "open"
            f.write(f"| {s['id']} | {s['file'][4:]}:{s['line']} | {s['what']} | {by} |\n")
    print(len(killed), "of", len(rows))


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    steps = {"build": build, "reach": reach, "try": try_all, "table": table}
    steps[sys.argv[2]](os.path.abspath(sys.argv[1]), *sys.argv[3:])
