#!/usr/bin/python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Mutants of the physics, and the tests that notice them.

  mutants.py FOLDER plant [SEED]   choose the mutants (from a build in ./build) and list them in FOLDER/mutants.json
  mutants.py FOLDER build          one build that holds them all
  mutants.py FOLDER reach [TESTS]  which test reaches which mutant, and how long each takes without any
  mutants.py FOLDER try [SECONDS [ROOM]]  each mutant against the tests that reach it, quickest first, until one fails;
                                   only tests of its room, of at most so long, and the quickest of the others (then
                                   `try` again, for those that are left, against all)
  mutants.py FOLDER canaries [TESTS]  every validation against every canary (canaries.py)
  mutants.py FOLDER tables         the tables of docs/appendix/mutants.md, and validation/mutants/survivors.md's rows

FOLDER is outside of the repository and holds everything. `try` and `canaries` go on where they stopped."""
import json
import os
import re
import resource
import signal
import subprocess
import sys
import threading
import time

import report
import tree
from canaries import NAMES

TESTS = r"(common|scene|theory|md|dsmc|statistics|measure|run|physics|api)/(?!trajectory_O|soak|workers|files|thread_pool)"
# Tests that validate physics: they must detect the canaries. report.BLIND gives the reasons of the others.
VALIDATIONS = (r"(theory/.*|compare/.*|physics/(?!wall_errors|stopping).*|md/(state_equation|flows)|common/(collision|model|restitution)"
               r"|dsmc/(collision_rate|cooling|mixture|shear|single|thermostat|conservation)"
               r"|measure/(rheology|pair_correlation|velocity_correlations|structure|cells|local_distributions|collisions|impact_speed"
               r"|profiles|diffusion|sonine|velocity_distributions|orientation))$")
ALL = 1e9  # seconds

# Elsewhere a theory only guesses the temperature to start from.
SETS_THEORIES = r"theory/|compare/|measure/(diffusion|sonine)|md/state_equation|physics/(theory_limits|viscosity)"


def run(command, mutant, seconds, reached=None, whole=False):
    """exit code (None: took too long), processor time, what failed. Ends with the first failure, unless whole."""
    env = dict(os.environ, CMOCKA_MESSAGE_OUTPUT="TAP", GG_MUTANT=str(mutant))
    if reached:
        env["GG_MUTANT_REACHED"] = reached

    def limited():
        resource.setrlimit(resource.RLIMIT_CPU, (int(seconds) + 1, int(seconds) + 2))
        resource.setrlimit(resource.RLIMIT_AS, (6 << 30, 6 << 30))
        resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

    child = subprocess.Popen(["stdbuf", "-oL", *command], env=env, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL,
                             preexec_fn=limited, text=True, errors="replace")
    late = threading.Timer(60 * seconds + 60, os.kill, (child.pid, signal.SIGKILL))  # waiting, not working
    late.start()
    failed, ended = [], False
    for line in child.stdout:
        found = re.match(r"not ok \d+ - (\w+)", line)
        if found:
            failed.append(found[1])
            if not whole:
                os.kill(child.pid, signal.SIGKILL)
                ended = True
                break
    child.stdout.close()
    _, status, usage = os.wait4(child.pid, 0)
    late.cancel()
    child.returncode = code = os.waitstatus_to_exitcode(status)
    cpu = usage.ru_utime + usage.ru_stime
    if ended:
        code = 1
    elif code in (-signal.SIGXCPU, -signal.SIGKILL):
        code = None
    return code, cpu, failed


def load(folder, name, default=None):
    path = os.path.join(folder, name)
    if not os.path.exists(path):
        return default
    with open(path) as f:
        return json.load(f)


def save(folder, name, what):
    path = os.path.join(folder, name)
    with open(f"{path}.{os.getpid()}", "w") as f:
        json.dump(what, f, indent=1)
    os.rename(f"{path}.{os.getpid()}", path)


def lines(folder, name):
    path = os.path.join(folder, name)
    if not os.path.exists(path):
        return []
    with open(path) as f:
        return [json.loads(line) for line in f if line.endswith("\n")]


def note(folder, name, row):
    with open(os.path.join(folder, name), "a") as f:
        f.write(json.dumps(row) + "\n")


def plant(folder, seed="19"):
    os.makedirs(folder, exist_ok=True)
    chosen = tree.choose(tree.all_sites(os.path.join(tree.ROOT, "build")), int(seed))
    save(folder, "mutants.json", chosen)
    print(len(chosen), "mutants")


def build(folder):
    print("without:", sorted(tree.compile_tree(folder, load(folder, "mutants.json"), TESTS, ["src/cli/graingas"])))


def reach(folder, wanted=TESTS):
    """Tests are those of the tree as it is; one that fails without any mutant would be of no use."""
    found = load(folder, "reach.json", {})
    for name, command in sorted(tree.targets(os.path.join(folder, "build"), f"{TESTS}|compare/").items()):
        if name in found or not re.match(wanted, name):
            continue
        told = os.path.join(folder, f"told{os.getpid()}")
        if os.path.exists(told):
            os.remove(told)
        code, cpu, failed = run(command, 0, 600, told, whole=True)
        if code != 0:
            print("fails by itself:", name, code, failed, flush=True)
        ids = sorted({int(i) for i in open(told)}) if os.path.exists(told) else []
        found = load(folder, "reach.json", {})
        found[name] = {"cpu": cpu, "code": code, "reached": ids}
        save(folder, "reach.json", found)
        print(f"{name} {cpu:.1f} s, {len(ids)}", flush=True)


def attempt(m, found, commands, most, before):
    """The tests that reach it and were not tried before, quickest first (those of its room earlier), until one fails;
    None: there is no such test."""
    at_home = m["room"].split("/")[0] + "/"
    left = [n for n, t in found.items() if m["id"] in t["reached"] and t["code"] == 0 and t["cpu"] <= most
            and (n.startswith(at_home) or t["cpu"] <= 0.6 or most == ALL)]
    row = {"id": m["id"], "tried": list(before), "killer": None}
    for name in sorted(set(left) - set(before), key=lambda n: found[n]["cpu"] * (1 if n.startswith(at_home) else 3)):
        code, cpu, failed = run(commands[name], m["id"], 2 * found[name]["cpu"] + 1)
        row["tried"].append(name)
        if code != 0:
            row.update(killer=name, how="too long" if code is None else f"signal {-code}" if code < 0 else "failed",
                       failed=failed[:3])
            break
    return row if len(row["tried"]) > len(before) else None


def try_all(folder, most=ALL, *only):
    """`only`: numbers of mutants that are tried anew, or the rooms (a pattern)."""
    found = load(folder, "reach.json")
    commands = tree.targets(os.path.join(folder, "build"), TESTS)
    done = {r["id"]: r for r in lines(folder, "results.jsonl")}
    without, explained = set(load(folder, "not_compiled.json", [])), report.explained()
    for m in load(folder, "mutants.json"):
        anew, last = str(m["id"]) in only, done.get(m["id"])
        known = explained.get((m["file"], " ".join(m["old"].split()), m["what"]), [""])[0]
        elsewhere = only and not anew and not any(re.match(o, m["room"]) for o in only)
        if m["id"] in without or known == "equivalent" or elsewhere or (last and last["killer"] and not anew):
            continue
        begin = time.time()
        row = attempt(m, found, commands, float(most), last["tried"] if last and not anew else [])
        if not row:
            continue
        note(folder, "results.jsonl", row)
        print(m["id"], m["file"], m["line"], m["kind"], m["what"], "->", row["killer"] or "survives", row.get("failed", ""),
              f"{time.time() - begin:.0f} s", flush=True)


def canaries(folder, wanted=VALIDATIONS):
    """Each with those that it goes through."""
    commands = {n: c for n, c in tree.targets(os.path.join(folder, "build"), VALIDATIONS).items() if re.match(wanted, n)}
    for name in sorted(commands):
        reach(folder, re.escape(name) + "$")
        found = load(folder, "reach.json")[name]
        done = {r["canary"] for r in lines(folder, "canaries.jsonl") if r["test"] == name}
        for canary in NAMES:
            guess = 920 < canary < 930 and not re.match(SETS_THEORIES, name)
            if canary in done or guess or canary not in found["reached"]:
                continue
            code, cpu, failed = run(commands[name], canary, 2 * found["cpu"] + 1)
            note(folder, "canaries.jsonl", {"test": name, "canary": canary, "code": code, "failed": failed, "cpu": cpu})
            print(name, NAMES[canary], "passes" if code == 0 else "fails", failed, flush=True)


def tables(folder):
    report.tables(folder)


if __name__ == "__main__":
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    steps = {"plant": plant, "build": build, "reach": reach, "try": try_all, "canaries": canaries, "tables": tables}
    steps[sys.argv[2]](os.path.abspath(sys.argv[1]), *sys.argv[3:])
