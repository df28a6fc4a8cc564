# SPDX-License-Identifier: GPL-3.0-or-later
"""graingas bench compare: ratios of planted records, what is beyond their spread, the limit and its exit code."""
import json
import subprocess
import sys
import time

from tap import GRAINGAS, PATIENCE, check, main, run

RATE, TIME = "collisions per CPU-second", "ns per collision"


def record(path, *rows):
    """A row: name, unit, value, lowest, highest, and what else it has."""
    with open(path, "w") as out:
        for name, unit, value, lowest, highest, *more in rows:
            row = {"name": name, "unit": unit, "value": value, "lowest": lowest, "highest": highest, "repeats": 3,
                   "threads": 1, "machine": {"cpu": "Planted CPU", "cores": 2}, "version": "0.1.0+gabc",
                   "instructions": "AVX2", "time": "2024-05-31T12:00:00Z"}
            print(json.dumps(row | (more[0] if more else {})), file=out)


def ratios(*options, code=0):
    done = run("bench", "compare", "a.json", "b.json", "--json", *options)
    check(done.code == code, done.code, done.err)
    return {r["name"]: r for r in map(json.loads, done.out.splitlines())}


def near(x, y):
    check(abs(x / y - 1) < 1e-9, x, y)


def test_ratios_are_of_times():
    """Rates and times both become ratios of times; bounds are those that the repeats allow."""
    record("a.json", ("rate", RATE, 100, 80, 110), ("time", TIME, 100, 90, 120), ("same", TIME, 5, 4, 6))
    record("b.json", ("same", TIME, 5, 4, 6), ("rate", RATE, 50, 40, 60), ("time", TIME, 50, 45, 60))
    got = ratios()
    check(list(got) == ["rate", "time", "same"], got)
    for name, value, lowest, highest, word in (("rate", 2, 80 / 60, 110 / 40, "slower"),
                                               ("time", 0.5, 45 / 120, 60 / 90, "faster"),
                                               ("same", 1, 4 / 6, 6 / 4, "")):
        near(got[name]["value"], value), near(got[name]["lowest"], lowest), near(got[name]["highest"], highest)
        check(got[name]["beyond_spread"] == word, got[name])


def test_a_comparison_prints_both_origins():
    """Both origins, a line a row, and the count."""
    record("a.json", ("rate", RATE, 100, 80, 110), ("same", TIME, 5, 4, 6))
    record("b.json", ("rate", RATE, 50, 40, 60), ("same", TIME, 5, 4, 6))
    done = run("bench", "compare", "a.json", "b.json")
    lines = done.out.splitlines()
    check(done.code == 0 and not done.err, done.err)
    check(lines[0] == "before: a.json, 0.1.0+gabc, Planted CPU, 2 cores, AVX2, 2024-05-31T12:00:00Z", lines[0])
    check(lines[1].startswith("after: b.json, 0.1.0+gabc"), lines[1])
    check(" 2.00 (1.33 - 2.75) slower      rate" in lines and " 1.00 (0.67 - 1.50)             same" in lines, done.out)
    check(lines[-1] == "2 rows in both with repeats; beyond their spread 1 slower, 0 faster", lines[-1])


def test_slower_rows_fail_beyond_the_limit():
    """A row 30 % slower of whose spread the least is 20 % slower: within 25 %, beyond 15 %. Faster rows are not."""
    record("a.json", ("slow", TIME, 100, 99, 100), ("fast", TIME, 100, 100, 100))
    record("b.json", ("slow", TIME, 130, 120, 140), ("fast", TIME, 10, 10, 10))
    check(ratios("--limit", "25")["slow"]["beyond_spread"] == "slower")
    check(ratios("--limit", "20")["slow"]["beyond_spread"] == "slower")
    got = ratios("--limit", "15", code=1)
    check(got["slow"]["beyond_spread"] == "over limit" and got["fast"]["beyond_spread"] == "faster", got)
    done = run("bench", "compare", "a.json", "b.json", "--limit", "15")
    check(done.code == 1 and "1 of 2 rows are slower by more than 15 % beyond their spread" in done.err, done.err)
    check("over limit  slow" in done.out, done.out)
    check(run("bench", "compare", "b.json", "a.json", "--limit", "1000").code == 0)


def test_rows_that_are_compared():
    """The last of a name counts; not rows of one file, of other units or threads, without repeats."""
    record("a.json", ("x", TIME, 1, 1, 1), ("x", TIME, 2, 2, 2), ("gone", TIME, 1, 1, 1), ("unit", TIME, 1, 1, 1),
           ("threads", TIME, 1, 1, 1), ("null", TIME, 1, None, None), ("zero", TIME, 0, 0, 0))
    record("b.json", ("x", TIME, 4, 4, 4), ("new", TIME, 1, 1, 1), ("unit", RATE, 1, 1, 1),
           ("threads", TIME, 1, 1, 1, {"threads": 2}), ("null", TIME, 1, 1, 1), ("zero", TIME, 1, 1, 1))
    got = ratios()
    check(list(got) == ["x"] and got["x"]["value"] == 2, got)


def test_cut_short():
    """Killed as soon as it has measured something, it leaves whole rows; bench compare reads them."""
    with open("cut.json", "w") as out:
        bench = subprocess.Popen([GRAINGAS, "bench", "--quick", "--json", "--quiet"], stdout=out)
    until = time.monotonic() + 60 * PATIENCE
    while not open("cut.json").read() and bench.poll() is None and time.monotonic() < until:
        time.sleep(0.01)
    bench.kill()
    check(bench.wait() < 0, "it ended before it was killed")
    text = open("cut.json").read()
    rows = [json.loads(line) for line in text.splitlines()]
    check(text.endswith("\n") and rows and all(r["value"] > 0 and r["version"] for r in rows), text)
    done = run("bench", "compare", "cut.json", "cut.json")
    check(done.code == 0 and f"\n{len(rows)} rows in both with repeats" in done.out, done.out, done.err)


def test_unlike_measurements_are_rejected():
    record("a.json", ("x", TIME, 1, 1, 1))
    record("b.json", ("y", TIME, 1, 1, 1))
    record("nasty.json", ("\x1b[2J", TIME, 1, 1, 1))
    for name, text in ("empty.json", ""), ("bad.json", "{\"name\": \"x\", \"unit\": \"s\"}\n[1]\n"):
        open(name, "w").write(text)
    for words, code, args in (("a.json and b.json have no rows in common", 3, ("compare", "a.json", "b.json")),
                              ("none.json: cannot be read: No such file", 3, ("compare", "a.json", "none.json")),
                              ("empty.json: no rows", 3, ("compare", "empty.json", "a.json")),
                              (".: no rows", 3, ("compare", ".", "a.json")),
                              ("bad.json, line 2: not a row", 3, ("compare", "a.json", "bad.json")),
                              ("nasty.json, line 1: not a row", 3, ("compare", "a.json", "nasty.json")),
                              ("bench compare needs two files", 2, ("compare", "a.json")),
                              ("'c.json' is one too many", 2, ("compare", "a.json", "b.json", "c.json")),
                              ("bench md takes no file; 'a.json' is one too many", 2, ("md", "a.json")),
                              ("'-1' is not allowed; allowed: a number from 0", 2,
                               ("compare", "a.json", "a.json", "--limit=-1")),
                              ("'nan' is not allowed", 2, ("compare", "a.json", "a.json", "--limit", "nan"))):
        done = run("bench", *args)
        check(done.code == code and words in done.err and "\x1b" not in done.err, args, done.code, done.err)


if __name__ == "__main__":
    main(sys.modules[__name__])
