# SPDX-License-Identifier: GPL-3.0-or-later
"""Write the results: the two pages beside this file and the short tables of docs/appendix/mutants.md."""
import collections
import json
import os
import re

from canaries import NAMES

HERE = os.path.dirname(os.path.abspath(__file__))
# Not in the table of canaries.
BLIND = """Not tried, because they compare two sides that share the error, or do not validate physics:

- one path of an engine against another: dsmc/kernels, segments, splitting, threads, time_step, majorant; md/kernels,
  oracle, trajectory, invariance, queue; measure/blocks; run/own_law (a law of the user's that is a constant e);
- a run against itself: md/restart, dsmc/restart, measure/curve_resume, scene/resumption, physics/stopping,
  physics/wall_errors (errors against scatter), all of run/ but own_law;
- a state against what it was: md/conservation; how slow collisions are treated: md/contact_time;
- the collision rule itself: common/collision; the tables of flows, species and walls: common/flow, species, surfaces;
- synthetic numbers only: measure/curves, local_frame; statistics/*; files, api, the command line;
- programs that print tables without a verdict (validation/noise_free/shear_table, monte_carlo_bias, wall_errors,
  errors, definitions.py, time_left.py), or compare a theory with itself (stated_errors);
- validation/figures, which compare engines and theories with papers and take hours;
- tests of robustness: validation/stress, fuzz, interruption and soak.
"""
FATES = ["killed", "equivalent", "survived", "does not compile"]


def rows_of(folder, name):
    path = os.path.join(folder, name)
    return [json.loads(line) for line in open(path)] if os.path.exists(path) else []


def load(path, default):
    return json.load(open(path)) if os.path.exists(path) else default


def cell(text, most=60):
    text = " ".join(text.split()).replace("|", "\\|")
    return text if len(text) <= most else text[:most - 3] + "..."


def explained():
    """(file, old text, what) -> (equivalent or survived, why)."""
    return {(e["file"], e["old"], e["what"]): (e["fate"], e["why"]) for e in load(os.path.join(HERE, "explained.json"), [])}


def fates(folder):
    mutants = load(os.path.join(folder, "mutants.json"), [])
    results = {r["id"]: r for r in rows_of(folder, "results.jsonl")}  # the last word counts
    without = set(load(os.path.join(folder, "not_compiled.json"), []))
    why, reach = explained(), load(os.path.join(folder, "reach.json"), {})
    for m in mutants:
        r = results.get(m["id"])
        m["why"] = ""
        if m["id"] in without:
            m["fate"] = "does not compile"
        elif r and r["killer"]:
            m["fate"], m["killer"] = "killed", r["killer"]
            m["test"] = ", ".join(r.get("failed") or [r["how"]])
        else:
            m["fate"], m["why"] = why.get((m["file"], " ".join(m["old"].split()), m["what"]), ("survived", ""))
            tried = set(r["tried"]) if r else set()
            left = [n for n, t in reach.items() if m["id"] in t["reached"] and n not in tried]
            if not m["why"]:
                m["why"] = f"passed {len(tried)} tests that reach it; no explanation yet"
                m["why"] += "; not tried: " + ", ".join(left[:4]) + (" and more" if left[4:] else "") if left else ""
    return mutants


def counts(mutants, key):
    table = collections.defaultdict(collections.Counter)
    for m in mutants:
        table[m[key]][m["fate"]] += 1
        table["all"][m["fate"]] += 1
    print(f"| {key} | seeded | killed | equivalent | survived | does not compile | killed of those that are not equivalent |")
    print("| --- | --- | --- | --- | --- | --- | --- |")
    for name in sorted(table, key=lambda n: (n == "all", n)):
        c = table[name]
        real = c["killed"] + c["survived"]
        print(f"| {name} | {sum(c.values())} | " + " | ".join(str(c[f]) for f in FATES) +
              f" | {100 * c['killed'] / real:.0f} % |" if real else " |")
    print()


def mutants_page(mutants):
    with open(os.path.join(HERE, "mutants.md"), "w") as f:
        f.write("# The mutants and what noticed them\n\nMade by `validation/mutants/mutants.py FOLDER tables`. The first "
                "test that failed, quickest first; of those that none noticed, why.\n\n"
                "| | where | kind | right | wrong | noticed by |\n| --- | --- | --- | --- | --- | --- |\n")
        for m in mutants:
            by = f"{m['killer']}: {cell(m['test'], 80)}" if m["fate"] == "killed" else \
                f"**{m['fate']}** {cell(m['why'], 900)}"
            f.write(f"| {m['id']} | {m['file'][4:]}:{m['line']} | {m['kind']} | `{cell(m['old'])}` | {cell(m['what'])} | {by} |\n")


def canaries_page(folder):
    rows = rows_of(folder, "canaries.jsonl")
    judged = load(os.path.join(HERE, "passes.json"), {})
    found = {(r["test"], r["canary"]): r["code"] for r in rows}
    tests = sorted({r["test"] for r in rows})
    count = collections.Counter()
    lines, notes = [], []
    for test in tests:
        line = []
        for c in NAMES:
            code = found.get((test, c), "")
            word = "" if code == "" else "too long" if code is None else "passes" if code == 0 else "fails"
            if word == "passes":
                why = judged.get(f"{test} {NAMES[c]}") or judged.get(f"{test} *") or "SHOULD IT?"
                notes.append((test, NAMES[c], why))
                word = "passes"
            count[word] += 1
            line.append(word)
        lines.append((test, line))
    with open(os.path.join(HERE, "canaries.md"), "w") as f:
        f.write("# Validations and canaries\n\nMade by `validation/mutants/mutants.py FOLDER tables`. An empty cell: the "
                "validation does not go through what the canary changes, or the change is none there; too long: ended at more than about twice "
                "its processor time.\n\n| | " +
                " | ".join(NAMES.values()) + " |\n" + "| --- " * (len(NAMES) + 1) + "|\n")
        for test, line in lines:
            f.write(f"| {test} | " + " | ".join(line) + " |\n")
        f.write(f"\n{BLIND}")
        f.write("\nCanaries that a validation does not detect, and why:\n\n| validation | canary | why |\n| --- | --- | --- |\n")
        for note in notes:
            f.write("| " + " | ".join(note) + " |\n")
    print(dict(count))


def tables(folder):
    mutants = fates(folder)
    counts(mutants, "kind")
    counts(mutants, "room")
    killers = collections.Counter(re.sub(r"/.*", "", m["killer"]) for m in mutants if m["fate"] == "killed")
    print("killers by folder:", dict(killers.most_common()))
    print("most: ", collections.Counter(m["killer"] for m in mutants if m["fate"] == "killed").most_common(12))
    for m in mutants:
        if m["fate"] == "survived":
            print("survived:", m["id"], m["file"], m["line"], m["what"], cell(m["old"]), m["why"][:60])
    mutants_page(mutants)
    canaries_page(folder)
