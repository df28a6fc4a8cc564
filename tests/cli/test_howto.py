# SPDX-License-Identifier: GPL-3.0-or-later
"""Recipes of docs/howto are run as they stand: the Slurm array with an sbatch that runs each task here, MPI, and the
tables by which others check their programs, anew with other seeds and larger errors."""
import json
import math
import os
import re
import shutil
import subprocess
import sys

from tap import GRAINGAS, PATIENCE, Skip, check, main

SOURCE = os.environ["SOURCE"]
SBATCH = """#!/bin/bash
set -e
[[ $(grep '^#SBATCH --array=' "$1") =~ =([0-9]+)-([0-9]+) ]]
for ((i = BASH_REMATCH[1]; i <= BASH_REMATCH[2]; i++)); do SLURM_ARRAY_TASK_ID=$i SLURM_CPUS_PER_TASK=1 bash "$1"; done
"""


def page(name):
    with open(os.path.join(SOURCE, "docs", "howto", name + ".md"), encoding="utf-8") as file:
        return file.read()


def block(name, title):
    """The first block of shell below a title."""
    return re.search(rf"^## {re.escape(title)}.*?^```sh\n(.*?)^```", page(name), re.MULTILINE | re.DOTALL)[1]


def shell(code, timeout=200):
    if not os.path.exists("bin"):
        os.mkdir("bin")
        os.symlink(GRAINGAS, "bin/graingas")
        os.symlink(os.path.join(SOURCE, "examples"), "examples")
    path = os.path.abspath("bin") + ":" + os.environ["PATH"]
    return subprocess.run(["bash", "-ec", code], capture_output=True, text=True, timeout=timeout * PATIENCE,
                          env=dict(os.environ, PATH=path, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                                   OMPI_MCA_rmaps_base_oversubscribe="1"))


def test_slurm_array():
    """Theory alone, so that it takes a second; every point is done once, and the table has them all."""
    code = block("run_on_a_cluster", "Many scenes: a Slurm array")
    check(code.count("--does compare") == 2 and "sbatch sweep.sh" in code, code)
    shell("true")
    with open("bin/sbatch", "w", encoding="utf-8") as file:
        file.write(SBATCH)
    os.chmod("bin/sbatch", 0o755)
    done = shell(code.replace("--does compare", "--does theory").replace("--collect", "--collect --picture none"))
    check(done.returncode == 0, done.stdout, done.stderr)
    with open("usf.sweep.csv", encoding="utf-8") as file:
        rows = file.read()
    for e in "0.5", "0.6", "0.7", "0.8", "0.9":
        check(re.search(rf"^(?:.*,)?{e},", rows, re.MULTILINE), e, rows[:300])


def test_mpi_gives_the_same_digits():
    """As without MPI, to the last digit."""
    if not shutil.which("mpirun"):
        raise Skip("mpirun is not installed")
    code = block("run_on_a_cluster", "One large run: MPI").replace("-n 4", "-n 2") + " --quiet --json --output a.h5"
    done = shell(code.replace("\n --quiet", " --quiet"))
    check(done.returncode == 0, done.stderr)
    alone = shell("graingas run examples/usf.yaml --set run.replicas=4 --quiet --json --output b.h5")
    for text in done.stdout, alone.stdout:
        check('"temperature"' in text)
    mean = [re.search(r'"temperature": *\{[^}]*"mean": *([\d.e+-]+)', text)[1] for text in (done.stdout, alone.stdout)]
    check(mean[0] == mean[1], mean)


def estimate(text):
    """1.234(56) as numbers."""
    mean, error = re.fullmatch(r"(-?[\d.]+)\((\d+)\)", text).groups()
    return float(mean), int(error) * 10.0 ** -len(mean.partition(".")[2])


def table(text):
    return {cells[1].strip(" `"): cells[2:-1] for cells in (line.split("|") for line in text.splitlines() if line.startswith("| `"))}


def test_values_to_check_programs_by():
    """Each state of the page again, another seed, errors of 0.5 %: within four errors, and Enskog's digits the same. In
    ./check two of them."""
    text = page("check_your_program")
    commands = re.findall(r"^graingas compare .*? --output (\S+)\.h5$", text, re.MULTILINE)
    lines = {name: re.search(rf"^(graingas compare .*?) \$more --output {re.escape(name)}\.h5$", text, re.MULTILINE)[1] for name in commands}
    tables = {name: table(rows) for name, rows in re.findall(r"<!-- table of: (\S+)\.h5;.*?-->\n((?:\|.*\n)+)", text)}
    check(len(lines) == 8 and sorted(lines) == sorted(tables), sorted(lines), sorted(tables))
    for name, line in lines.items() if "NIGHTLY" in os.environ else list(lines.items())[::4]:
        done = shell(line + " --set run.relative_error=0.005 --set run.collisions=20000 --set run.seed=77 --quiet --picture none --json --output x.h5")
        check(done.returncode == 0, line, done.stderr)
        found = json.loads(done.stdout)
        for quantity, (_, md, dsmc, z, enskog) in tables[name].items():
            for engine, stated in ("md", md), ("dsmc", dsmc):
                mean, error = estimate(stated.strip())
                new = found[engine]["results"][quantity]
                away = abs(new["mean"] - mean) / math.hypot(error, new["stderr"])
                check(away < 4.5, name, engine, quantity, stated, new["mean"], new["stderr"])
            solved = found["theory"]["enskog_hermite"][quantity]["mean"]
            check(f"{solved:.4g}" == enskog.strip(), name, quantity, solved, enskog)


if __name__ == "__main__":
    main(sys.modules[__name__])
