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


def test_exercises():
    """The closed forms of the solutions are theories of graingas, and their numbers stand in the page."""
    text = page("exercises")
    chi = lambda phi: (1 - phi / 2) / (1 - phi) ** 3
    e, beta, K = 0.95, 0, 0.4
    h = (1 + e) / 2
    ratio, zeta, nu = 5 * (1 - e) / (3 - e) / 3, 4 / 3 * math.sqrt(math.pi) * (1 - e * e), 16 / 5 * math.sqrt(math.pi) * h * (2 - h)
    n = 6 * 0.3 / math.pi
    rows = (("enskog", "{flow: equilibrium, phi: 0.3}", {"collision_rate": (4 * n * chi(0.3) * math.sqrt(math.pi / 2), "7.1182"),
                                                         "compressibility_factor": (1 + 1.2 * chi(0.3), "3.9738")}),
            ("haff1983", "{flow: hcs, phi: 0.1, collision: {e: 0.8}}", {"cooling_rate": (5 / 12 * 0.36 * chi(0.1), "0.1955")}),
            ("grad", "{flow: usf, phi: 0, collision: {e: 0.95}}", {"N1": (3 * ratio, "0.1220"), "temperature": (2 / 3 * (1 - ratio) / zeta / nu, "0.4897")}),
            ("lun1991", "{flow: usf, phi: 0.01, collision: {e: 0.9, beta: 0}}",
             {"temperature_ratio": (K * (1 + beta) / (1 + 2 * K - beta), "0.2222")}))
    for theory, scene, values in rows:
        done = subprocess.run([GRAINGAS, "theory", "-", "--json", "--theory", theory], input=scene, capture_output=True, text=True)
        found = json.loads(done.stdout)["theory"][theory]
        for name, (value, number) in values.items():
            check(abs(found[name]["mean"] / value - 1) < 1e-12, theory, name, found[name], value)
            check(abs(value - float(number)) < 6e-5 and number in text, number)
    for command in re.findall(r"`(\{flow: .*?\}+)`", text):
        check(subprocess.run([GRAINGAS, "info", "-"], input=command, capture_output=True, text=True).returncode == 0, command)


def peers(*more):
    """validation/peers with a peer that burns a twentieth of a second, prints its collisions and says a hundredth."""
    with open("s.yaml", "w", encoding="utf-8") as file:
        file.write("flow: hcs\nphi: 0.1\nparticles: 500\nrun: {collisions: 200, warmup: 20}\n")
    fake = (f"{sys.executable} -c 'import time\nwhile time.process_time() < 0.05: pass\n"
            "print(\"collisions: 1e3\\ncollisions: 4e5 in 0.01 s\")'")
    return subprocess.run([sys.executable, os.path.join(SOURCE, "validation", "peers", "peers.py"), "--graingas", GRAINGAS, "--scene", "s.yaml",
                           "--peer", "other", "--command", fake, "--repeat", "2", *more], capture_output=True, text=True)


def rows_of_peers(*more):
    done = peers(*more)
    check(done.returncode == 0, done.stderr)
    rows = [[cell.strip() for cell in line.strip("|").split("|")] for line in done.stdout.splitlines() if line.startswith("| ")][2:]
    check([row[0] for row in rows] == ["graingas md", "other"] and rows[1][3:] == ["1", "1 to 1"], rows)
    for row in rows:
        for median, ends in row[1:3], row[3:]:
            low, high = map(float, ends.split(" to "))
            check(0 < low <= float(median) <= high, row)
    return rows


def test_peers():
    """Rates from the last number that the peer prints or from --events, ratios of turns; errors with a reason."""
    for more, events in ((("--pattern", r"collisions: ([0-9.e+]+)"), 4e5), (("--events", "8e5"), 8e5)):
        rows = rows_of_peers(*more)
        check(events / 2 < float(rows[1][1]) <= events / 0.05, rows)
        low, high = (float(end) for end in rows[0][4].split(" to "))
        least, most = ([float(end) for end in row[2].split(" to ")] for row in rows)
        check(0.99 * least[0] / most[1] <= low <= high <= 1.01 * least[1] / most[0], rows)
    with open("fake", "w", encoding="utf-8") as file:
        file.write("#!/bin/sh\necho '{\"collisions\": 300, \"cpu_seconds\": 0.5, \"total\": {\"collisions\": 400}}'\n")
    os.chmod("fake", 0o755)
    rows = rows_of_peers("--events", "4e5", "--seconds", r"in ([0-9.]+) s", "--graingas", "./fake")
    check(rows[1][1:3] == ["4e+07", "4e+07 to 4e+07"], "the seconds that the peer prints", rows)
    check(rows[0][1:4] == ["600", "600 to 600", "1.5e-05"], "averaging alone", rows)
    done = peers("--pattern", "nothing ([0-9]+)")
    check(done.returncode == 1 and "nothing in the output" in done.stderr, done.stderr)
    done = peers("--events", "1", "--seconds", "nothing ([0-9]+)")
    check(done.returncode == 1 and "nothing in the output" in done.stderr, done.stderr)
    for option in "--pattern", "--seconds":
        done = peers(*(("--events", "1") if option == "--seconds" else ()), option, "collisions")
        check(done.returncode == 2 and "one group" in done.stderr, done.stderr)
    done = peers("--events", "1", "--command", "exit 3")
    check(done.returncode == 1 and "exit code 3" in done.stderr, done.stderr)


def test_mpi_gives_the_same_digits():
    """As without MPI, to the last digit."""
    if not shutil.which("mpirun"):
        raise Skip("mpirun is not installed")
    short = " --set particles=250 --set run.relative_error=0.02 --quiet --json"
    code = block("run_on_a_cluster", "One large run: MPI").replace("-n 4", "-n 2") + short + " --output a.h5"
    done = shell(code.replace("\n" + short, short))
    check(done.returncode == 0, done.stderr)
    alone = shell("graingas run examples/usf.yaml --set run.replicas=4" + short + " --output b.h5")
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
