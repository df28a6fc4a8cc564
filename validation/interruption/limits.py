#!/usr/bin/env python3
# SPDX-License-Identifier: GPL-3.0-or-later
"""Commands with less and less memory (limit of the address space, as `ulimit -v` sets it). Each must succeed or fail
with an error that names memory.

    GRAINGAS=build/src/cli/graingas validation/interruption/limits.py [STEP in kB [COMMAND...]]

COMMAND is a name of COMMANDS below; default: all."""
import os
import resource
import subprocess
import sys
import tempfile

GRAINGAS = os.path.abspath(os.environ["GRAINGAS"])
SCENE = """flow: usf
phi: 0.2
particles: 300
collision: {e: 0.9, beta: 0}
measure: [rheology, velocity_distributions, structure]
run: {collisions: 40, warmup: 10}
output: {trajectory_every: 5, checkpoint_every: 1.0e-6}
"""
COMMANDS = {
    "run, md": ["run", "scene.yaml", "--output", "new.h5"],
    "run, dsmc": ["run", "scene.yaml", "--engine", "dsmc", "--set", "measure=[rheology]", "--output", "new.h5"],
    "compare": ["compare", "scene.yaml", "--output", "new.h5", "--picture", "none", "--set", "measure=[rheology]"],
    "theory": ["theory", "scene.yaml"],
    "sweep": ["sweep", "scene.yaml", "--vary", "phi=0.1,0.2", "--output", "new.sweep"],
    "info": ["info", "there.h5"],
    "export": ["export", "there.h5", "--output", "new"],
}


def limited(command, kilobytes):
    set_limit = lambda: resource.setrlimit(resource.RLIMIT_AS, (1024 * kilobytes,) * 2)
    return subprocess.run([GRAINGAS, *command, "--quiet"], capture_output=True, text=True, errors="replace",
                          preexec_fn=set_limit)


def clear():
    for top, folders, names in os.walk(".", topdown=False):
        for name in names:
            if name not in ("scene.yaml", "there.h5"):
                os.remove(os.path.join(top, name))
        for name in folders:
            os.rmdir(os.path.join(top, name))


def least(command):
    """Smallest limit in kB with which the command succeeds, by bisection."""
    low, enough = 0, 4000000
    while enough - low > 100:
        middle = (low + enough) // 2
        clear()
        if limited(command, middle).returncode == 0:
            enough = middle
        else:
            low = middle
    return enough


def main(step, names):
    bad = 0
    print("| command | enough (MB) | limits tried | done | out of memory, said | not started | ended otherwise |")
    print("|---|---|---|---|---|---|---|")
    for name in names or COMMANDS:
        command = COMMANDS[name]
        enough = least(command)
        tally = {"done": 0, "said": 0, "not started": 0, "otherwise": 0}
        limits = range(enough - 60 * step, enough + 2 * step, step)
        for limit in limits:
            clear()
            done = limited(command, limit)
            litter = [n for _, _, names in os.walk(".") for n in names if "graingas-tmp" in n or "graingas-lock" in n]
            if "shared librar" in done.stderr or "cannot allocate" in done.stderr.lower() and not done.stderr.startswith("graingas"):
                kind = "not started"
            elif done.returncode == 0:
                kind = "done"
            elif done.returncode > 0 and "memory" in done.stderr and not litter:
                kind = "said"
            else:
                kind = "otherwise"
                print(f"# {name}, {limit} kB: {done.returncode} {done.stderr.strip()[-200:]} {litter}")
            tally[kind] += 1
        bad += tally["otherwise"]
        print(f"| {name} | {enough / 1000:.1f} | {len(limits)} | {tally['done']} | {tally['said']} | "
              f"{tally['not started']} | {tally['otherwise']} |", flush=True)
    return bad > 0


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        with open("scene.yaml", "w") as f:
            f.write(SCENE)
        subprocess.run([GRAINGAS, "run", "scene.yaml", "--quiet", "--output", "there.h5"], capture_output=True)
        sys.exit(main(int(sys.argv[1]) if len(sys.argv) > 1 else 250, sys.argv[2:]))
