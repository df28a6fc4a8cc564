#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Speed of graingas beside another program on the same gas, in turn, with spread.

    validation/peers/peers.py --scene SCENE.yaml --peer NAME --command "dynarun -c 1000000 c.xml" --events 1000000
    validation/peers/peers.py --scene SCENE.yaml --peer NAME --command "./run.sh" --pattern "collisions: ([0-9.e+]+)"

The other program is the user's: a command that simulates the gas of the scene, on one core. Its collisions are given
(--events), or a group of --pattern finds them in what it prints. Both programs run in turn, --repeat times.

The time is that of the processor, start included, so runs should be long: ten seconds and more. If the other program
prints the processor time of these collisions alone, --seconds "([0-9.]+) s" finds it. Then graingas counts the
collisions that it averages over and their processor time, without start and warm-up.

The table is Markdown, as in docs/explanation/performance.md: collisions a second (median, lowest, highest), and the ratio
to the other program, of the runs of each turn (median, lowest, highest)."""
import argparse
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile

ROOT = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..")


def timed(command, **more):
    """Output of a command, and its processor time with that of its children."""
    with tempfile.TemporaryFile("w+") as out:
        process = subprocess.Popen(command, stdout=out, stderr=subprocess.STDOUT, **more)
        _, status, usage = os.wait4(process.pid, 0)
        process.returncode = os.waitstatus_to_exitcode(status)
        out.seek(0)
        text = out.read()
    if process.returncode:
        sys.exit(f"peers: exit code {process.returncode} of {command}:\n{text[-2000:]}")
    return text, usage.ru_utime + usage.ru_stime


def own(options):
    """Collisions a second of graingas: of the whole run, or of averaging alone."""
    with tempfile.TemporaryDirectory() as folder:
        text, seconds = timed([options.graingas, "run", options.scene, "--engine", options.engine, "--threads", "1", "--quiet",
                               "--json", "--output", os.path.join(folder, "run.h5")])
    result = json.loads(text[text.index("{"):text.rindex("}") + 1])
    if options.seconds:
        return result["collisions"] / result["cpu_seconds"]
    return result["total"]["collisions"] / seconds


def last_number(pattern, text):
    found = re.findall(pattern, text)
    if not found:
        sys.exit(f"peers: nothing in the output is of the form {pattern!r}:\n{text[-2000:]}")
    return float(found[-1])


def peers(options):
    text, seconds = timed(["bash", "-c", options.command])
    if options.seconds:
        seconds = last_number(options.seconds, text)
    return (options.events or last_number(options.pattern, text)) / seconds


def spread(numbers):
    return f"{statistics.median(numbers):.4g} | {min(numbers):.4g} to {max(numbers):.4g}"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--scene", required=True)
    parser.add_argument("--engine", default="md", choices=("md", "dsmc"))
    parser.add_argument("--peer", required=True, metavar="NAME")
    parser.add_argument("--command", required=True)
    group = parser.add_mutually_exclusive_group(required=True)
    group.add_argument("--events", type=float, metavar="N")
    group.add_argument("--pattern", metavar="REGEX")
    parser.add_argument("--seconds", metavar="REGEX")
    parser.add_argument("--repeat", type=int, default=5, metavar="N")
    parser.add_argument("--graingas", default=os.path.join(ROOT, "build", "src", "cli", "graingas"))
    options = parser.parse_args()
    if options.repeat < 2:
        parser.error("--repeat: at least 2, for a spread")
    if options.pattern and re.compile(options.pattern).groups != 1:
        parser.error("--pattern: one group is needed, around the number of collisions")
    if options.seconds and re.compile(options.seconds).groups != 1:
        parser.error("--seconds: one group is needed, around the seconds")
    rates = {f"graingas {options.engine}": [], options.peer: []}
    for turn in range(options.repeat):
        for name in list(rates)[::1 if turn % 2 else -1]:  # neither program always runs first
            rates[name].append((peers if name == options.peer else own)(options))
    print(f"Scene: {os.path.basename(options.scene)}; {options.repeat} runs each, in turn, one core.\n")
    print("| program | collisions a second | lowest to highest | times | lowest to highest |\n| --- | --- | --- | --- | --- |")
    for name, found in rates.items():
        print(f"| {name} | {spread(found)} | {spread([mine / peer for mine, peer in zip(found, rates[options.peer])])} |")


if __name__ == "__main__":
    main()
