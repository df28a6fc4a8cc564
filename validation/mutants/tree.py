# SPDX-License-Identifier: GPL-3.0-or-later
"""The mutants' tree: a copy of the sources in which every chosen site holds the right expression and the wrong one."""
import json
import os
import random
import re
import shlex
import subprocess
import sys

from canaries import TEXTS
from rooms import KINDS, ROOM_OF, ROOMS

HERE = os.path.dirname(os.path.abspath(__file__))
ROOT = os.path.dirname(os.path.dirname(HERE))
FIRST_CANARY = 900
LIBCLANG = "/usr/lib/llvm-14/lib/libclang-14.so.1"


def canary_sites():
    """(file, start, end, new) in the clean tree."""
    found = []
    for path, old, new in TEXTS:
        with open(os.path.join(ROOT, path), "rb") as f:
            data = f.read()
        at = data.find(old.encode())
        if at < 0 or data.find(old.encode(), at + 1) >= 0:
            sys.exit(f"canaries: {path} has not once: {old}")
        found.append((path, at, at + len(old.encode()), new))
    return found


def compilations(build):
    """The commands that see the physics, each file once for each way of searching and rule it is compiled for."""
    with open(os.path.join(build, "compile_commands.json")) as f:
        commands = json.load(f)
    seen = set()
    for c in commands:
        path = os.path.realpath(os.path.join(c["directory"], c["file"]))
        inside = os.path.relpath(path, ROOT)
        if not re.match(r"src/(common|md|dsmc|measure|theory)/", inside) or "_O1" in c["output"] or "_O2" in c["output"]:
            continue
        words = [w for w in shlex.split(c["command"]) if w.startswith(("-D", "-I", "-std", "-m"))]
        words = ["-I" + os.path.join(c["directory"], w[2:]) if re.match(r"-I[^/]", w) else w for w in words]
        key = inside, tuple(w for w in words if re.match(r"-DGG_(WAY|RULE|BOUNDARY|SIMD|LAW|SINGLE)", w))
        if key not in seen:
            seen.add(key)
            yield path, words


def gcc_headers():
    out = subprocess.run(["gcc", "-print-file-name=include"], capture_output=True, text=True, check=True).stdout.strip()
    return ["-I" + out]


def all_sites(build):
    from clang import cindex
    cindex.Config.set_library_file(LIBCLANG)
    import sites
    return sites.find(ROOT, [(p, a + gcc_headers()) for p, a in compilations(build)])


def overlaps(site, taken):
    return any(site[0] == t[0] and site[1] < t[2] and t[1] < site[2] for t in taken)


def choose(sites, seed):
    """So many of each room, by kinds, files as evenly as they come; never two of one line."""
    rng = random.Random(seed)
    taken = [(p, a, b) for p, a, b, _ in canary_sites()]
    lines, chosen = set(), []
    for room, (number, _) in ROOMS.items():
        here = [s for s in sites if ROOM_OF[s.file] == room]
        kinds = {k: share for k, share in KINDS.items() if any(s.kind == k for s in here)}
        quota = {k: round(number * share / sum(kinds.values())) for k, share in kinds.items()}
        quota[max(quota, key=quota.get)] += number - sum(quota.values())
        for kind, left in quota.items():
            files = {}
            for s in here:
                if s.kind == kind:
                    files.setdefault(s.file, []).append(s)
            order = []
            while left > 0 and files:
                if not order:
                    order = sorted(files)
                    rng.shuffle(order)
                path = order.pop()
                if path not in files:
                    continue
                rng.shuffle(files[path])
                while files[path]:
                    s = files[path].pop()
                    key = (s.file, s.line)
                    if key not in lines and not overlaps((s.file, s.start, s.end), taken):
                        lines.add(key)
                        taken.append((s.file, s.start, s.end))
                        chosen.append(s)
                        left -= 1
                        break
                if not files[path]:
                    del files[path]
    return [dict(s._asdict(), id=i, room=ROOM_OF[s.file]) for i, s in enumerate(chosen, 1)]


def write(folder, mutants, without):
    """Files are only written where they change, so that little is compiled again."""
    tree = os.path.join(folder, "tree")
    edits = {}
    for path, a, b, new in canary_sites():
        edits.setdefault(path, []).append((a, b, new))
    for m in mutants:
        if m["id"] not in without:
            with open(os.path.join(ROOT, m["file"]), "rb") as f:
                if f.read()[m["start"]:m["end"]].decode() != m["old"]:
                    sys.exit(f"{m['file']}:{m['line']} is not what it was when the mutants were planted: plant them anew")
            edits.setdefault(m["file"], []).append((m["start"], m["end"], m["new"].replace("{id}", str(m["id"]))))
    listed = subprocess.run(["git", "-C", ROOT, "ls-files"], capture_output=True, text=True, check=True).stdout.split("\n")
    for path in filter(None, listed):
        source = os.path.join(ROOT, path)
        if not os.path.isfile(source):
            continue
        with open(source, "rb") as f:
            data = f.read()
        for a, b, new in sorted(edits.get(path, []), reverse=True):
            data = data[:a] + new.encode() + data[b:]
        if path == "src/common/meson.build":
            data = data.replace(b"common_sources = files(", b"common_sources = files('mutants.c', 'canaries.c',")
        put(os.path.join(tree, path), data, os.stat(source).st_mode)
    for name in "mutants.c", "canaries.c", "mutants.h":
        with open(os.path.join(HERE, name), "rb") as f:
            put(os.path.join(tree, "src/common", name), f.read(), 0o644)


def put(path, data, mode):
    os.makedirs(os.path.dirname(path), exist_ok=True)
    if os.path.isfile(path):
        with open(path, "rb") as f:
            if f.read() == data:
                return
    with open(path, "wb") as f:
        f.write(data)
    os.chmod(path, mode)


def targets(build, wanted):
    """Name -> command of the tests whose names match."""
    out = subprocess.run(["meson", "introspect", "--tests", build], capture_output=True, text=True, check=True).stdout
    found = {t["name"]: t["cmd"] for t in json.loads(out) if re.match(wanted, t["name"])}
    for scene in "smooth", "rough":
        if re.match(wanted, "compare/" + scene):
            found["compare/" + scene] = [sys.executable, os.path.join(HERE, "verdict.py"),
                                         os.path.join(build, "src/cli/graingas"), scene]
    return found


def compile_tree(folder, mutants, wanted, more=()):
    """Build the tests; what does not compile is taken out and named."""
    tree, build = os.path.join(folder, "tree"), os.path.join(folder, "build")
    failed_file = os.path.join(folder, "not_compiled.json")
    without = set(json.load(open(failed_file))) if os.path.exists(failed_file) else set()
    while True:
        write(folder, mutants, without)
        if not os.path.exists(os.path.join(build, "build.ninja")):
            env = dict(os.environ, CFLAGS=f"-w -include {tree}/src/common/mutants.h")
            subprocess.run(["meson", "setup", build, tree, "-Dtests=true", "-Doptimization=2"], env=env, check=True, stdout=subprocess.DEVNULL)
        exes = [os.path.relpath(c[0], build) for c in targets(build, wanted).values() if c[0].startswith(build)]
        done = subprocess.run(["ninja", "-j", "2", "-C", build, "-k", "0", *exes, *more], capture_output=True, text=True)
        if done.returncode == 0:
            return without
        bad = set()
        for path, line in re.findall(r"tree/(src/[\w/.]+):(\d+):\d+: (?:fatal )?error", done.stdout):
            text = open(os.path.join(tree, path)).read().split("\n")[int(line) - 1]
            bad |= {int(i) for i in re.findall(r"GG_MUTANT\((\d+)\)", text) if int(i) < FIRST_CANARY}
        if not bad - without:
            sys.exit(done.stdout[-4000:])
        without |= bad
        print("do not compile:", sorted(bad), flush=True)
        with open(failed_file, "w") as f:
            json.dump(sorted(without), f)
