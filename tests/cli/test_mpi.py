# SPDX-License-Identifier: GPL-3.0-or-later
"""graingas under mpirun: the bits of one process, one voice, one writer; processes that are killed; what a build without
MPI says."""
import csv
import glob
import json
import os
import shutil
import signal
import subprocess
import sys
import time

from tap import GRAINGAS, PATIENCE, SANITIZERS, Skip, check, main, run

BARE = os.environ["GRAINGAS_WITHOUT_MPI"]
BOUND = 200 * PATIENCE  # s
SCENE = """{flow: usf, phi: 0.1, particles: 200, collision: {beta: 0}, run: {collisions: 200, replicas: 4},
measure: [rheology, velocity_distributions], output: {checkpoint_every: 0}}"""
LONG = ("--set", "run.collisions=1000", "--set", "output.checkpoint_every=0.1")


def mpirun(ranks, *args, options=(), program=GRAINGAS):
    if os.environ["WITH_MPI"] != "true" or not shutil.which("mpirun"):
        raise Skip("built without MPI, or no mpirun")
    root = ("--allow-run-as-root",) if os.geteuid() == 0 else ()
    return ["mpirun", "--oversubscribe", "-q", "--mca", "mpi_yield_when_idle", "1", *root, *watched(), *options, "-n", str(ranks), program, *args]


def watched():
    """With sanitizers libraries stay: so that scripts/leaks.txt can name those that forgot something; and the thread
    sanitizer ends the process where one that scripts/races.txt names is unloaded."""
    if SANITIZERS == "thread":
        return "-x", "LD_PRELOAD=" + os.environ["KEEP_LOADED"]
    if "address" not in SANITIZERS:
        return ()
    how = os.environ.get("ASAN_OPTIONS", "") + ":verify_asan_link_order=0:fast_unwind_on_malloc=0"
    return "-x", "LD_PRELOAD=" + os.environ["KEEP_LOADED"], "-x", "ASAN_OPTIONS=" + how


def several(ranks, *args, options=()):
    return subprocess.run(mpirun(ranks, *args, options=options), capture_output=True, text=True, timeout=BOUND,
                          stdin=subprocess.DEVNULL)


def start(ranks, *args, options=()):
    return subprocess.Popen(mpirun(ranks, *args, options=options), stdout=subprocess.PIPE, stderr=subprocess.PIPE,
                            text=True, stdin=subprocess.DEVNULL)


def write_scene():
    with open("scene.yaml", "w") as f:
        f.write(SCENE)


def numbers(text):
    """All there is but times."""
    def bare(x):
        if isinstance(x, dict):
            return {k: bare(v) for k, v in x.items() if "seconds" not in k}
        return [bare(v) for v in x] if isinstance(x, list) else x
    return bare(json.loads(text))


WHOLE = {}


def undisturbed(args):
    """Results of these arguments by one process."""
    if args not in WHOLE:
        WHOLE[args] = numbers(run(*args, "--output", "whole.h5").out)["results"]
    return WHOLE[args]


def process_of(job, rank):
    """The process of that rank which mpirun has started."""
    for pid in filter(str.isdigit, os.listdir("/proc")):
        try:
            parent = int(open(f"/proc/{pid}/stat").read().rsplit(")", 1)[1].split()[1])
            words = open(f"/proc/{pid}/environ").read().split("\0")
        except OSError:
            continue
        if parent == job.pid and f"OMPI_COMM_WORLD_RANK={rank}" in words:
            return int(pid)
    raise AssertionError("no rank %d" % rank)


def wait_for(path, job):
    until = time.time() + BOUND
    while not os.path.exists(path):
        check(job.poll() is None and time.time() < until, "no", path, job.poll())
        time.sleep(0.01)


def test_same_bits():
    write_scene()
    one = run("run", "scene.yaml", "--json", "--quiet", "--threads", "1")
    two = run("run", "scene.yaml", "--json", "--quiet", "--threads", "2")
    three = several(3, "run", "scene.yaml", "--json", "--output", "three.h5")
    check(three.returncode == 0 and three.stderr.count("results: three.h5") == 1, three.returncode, three.stderr)
    check(numbers(one.out) == numbers(two.out) == numbers(three.stdout), "bits differ")
    check(len(numbers(one.out)["results"]) > 5 and os.path.exists("three.h5"))
    both = run("compare", "scene.yaml", "--json", "--quiet", "--threads", "1", "--set", "run.collisions=50")
    shared = several(3, "compare", "scene.yaml", "--json", "--quiet", "--set", "run.collisions=50")
    check(numbers(both.out) == numbers(shared.stdout), shared.stderr)


def test_the_default_number_of_grains():
    """Rank 0 chooses it, and all have the same."""
    scene = "flow: hcs\nphi: 0.2\ncollision: {e: 0.85}\nrun: {warmup: 20, collisions: 60, replicas: 2}\n"
    one = run("run", "scene.yaml", "--json", "--quiet", scene=scene)
    two = several(2, "run", "scene.yaml", "--json", "--quiet", "--output", "two.h5")
    check(json.loads(one.out)["particles"] < 1000 and numbers(one.out) == numbers(two.stdout), two.stderr)


def test_one_voice():
    write_scene()
    done = several(3, "run", "nothing.yaml")
    check(done.returncode == 3 and done.stdout == "" and done.stderr.count("nothing.yaml") == 1, done)
    done = several(3, "run", "scene.yaml", "--set", "phi=2")
    check(done.returncode == 2 and done.stderr.count("phi") <= 2, done)
    done = several(2, "theory", "scene.yaml", "--json")
    check(done.returncode == 0 and json.loads(done.stdout)["theory"], done.stderr)
    check(sorted(os.listdir(".")) == ["scene.yaml"], os.listdir("."))


def test_interrupted_and_resumed():
    """The signal goes to rank 0, as srun sends it to all; the checkpoint is that of any run."""
    write_scene()
    args = "run", "scene.yaml", "--json", "--quiet", *LONG
    whole = undisturbed(args)
    job = start(3, *args)
    wait_for("scene.checkpoint.h5", job)
    for rank in 1, 0:
        os.kill(process_of(job, rank), signal.SIGTERM)
    out, err = job.communicate(timeout=BOUND)
    check(job.returncode == 130 and "interrupted" in err, job.returncode, err)
    done = several(2, *args, "--resume", "scene.checkpoint.h5")
    check(done.returncode == 0 and numbers(done.stdout)["results"] == whole, done.stderr)
    check(not os.path.exists("scene.checkpoint.h5"))


def test_a_killed_rank_ends_the_job():
    """mpirun ends the job when a process is killed, and says so; the run goes on from its checkpoint. In the second that
    mpirun leaves it, it may have come to its end without the lost one; what it printed then may be cut short, its file
    is whole."""
    write_scene()
    args = "run", "scene.yaml", "--json", "--quiet", *LONG
    whole = undisturbed(args)
    job = start(3, *args)
    wait_for("scene.checkpoint.h5", job)
    os.kill(process_of(job, 2), signal.SIGKILL)
    out, err = job.communicate(timeout=BOUND)
    check(job.returncode not in (0, None), job.returncode, err)
    if not os.path.exists("scene.h5"):
        run(*args, "--resume", "scene.checkpoint.h5")
    check(numbers(run("info", "scene.h5", "--json").out)["results"] == whole, err)


def test_killed_and_done_again():
    """With --enable-recovery the others go on: what the lost one had is done again."""
    write_scene()
    args = "run", "scene.yaml", "--json", "--quiet", *LONG
    whole = undisturbed(args)
    job = start(3, *args, options=["--enable-recovery"])
    wait_for("scene.checkpoint.h5", job)
    os.kill(process_of(job, 1), signal.SIGKILL)
    out, err = job.communicate(timeout=BOUND)
    check("process 1 of 3 is gone" in err and os.path.exists("scene.h5"), err)
    check(numbers(out)["results"] == whole, err)


def test_killed_with_messages_under_way():
    """Who sent them gives them up, and ends at once; with the leak sanitizer, nothing of them is left."""
    job = mpirun(3, options=["--enable-recovery"], program=os.environ.get("LOST_RANK"))
    done = subprocess.run(job, capture_output=True, text=True, timeout=BOUND)
    check(done.returncode == 0 and float(done.stdout) < 3, done)


def test_message_in_parts():
    """Above a gigabyte a message goes in parts; the block that they are in lives until the last of them was read."""
    job = mpirun(2, program=os.environ.get("MESSAGE_PARTS"))
    done = subprocess.run(job, capture_output=True, text=True, timeout=BOUND)
    check(done.returncode == 0, done)


SWEEP = """{flow: usf, phi: 0.1, particles: 100, run: {collisions: 150, warmup: 20, replicas: 2},
vary: {collision.e: [0.7, 0.8, 0.9], engine: [md, dsmc]}}"""
LONGER = "--set", "run.collisions=1200"  # a second: a process is killed on the way


def table_of(folder, *args):
    """All that a sweep came to, but times."""
    done = run("sweep", "sweep.yaml", *args, "--collect", "--output", folder, "--picture", "none")
    check(done.code == 0, done.err)
    with open(folder + ".csv", newline="") as f:
        return [{k: v for k, v in row.items() if k != "seconds"} for row in csv.DictReader(f)]


def killed_sweep(folder, rank, options=()):
    """The sweep whose rank was killed once the first point was done."""
    job = start(3, "sweep", "sweep.yaml", "--quiet", *LONGER, "--output", folder, options=options)
    until = time.time() + BOUND
    while not glob.glob(folder + "/????????????????.h5") and job.poll() is None and time.time() < until:
        time.sleep(0.01)
    os.kill(process_of(job, rank), signal.SIGKILL)
    err = job.communicate(timeout=BOUND)[1]
    return job.returncode, err


def test_a_sweep_runs_over_ranks():
    """Points and their replicas over ranks; a rank that is killed, with mpirun's default and with recovery."""
    with open("sweep.yaml", "w") as f:
        f.write(SWEEP)
    check(run("sweep", "sweep.yaml", "--quiet", *LONGER, "--output", "one.sweep").code == 0)
    whole = table_of("one.sweep", *LONGER)
    check(len(whole) > 60, len(whole))
    code, err = killed_sweep("killed.sweep", 2)
    check(code != 0, "a process was killed, and all is well?")
    done = several(2, "sweep", "sweep.yaml", "--quiet", *LONGER, "--output", "killed.sweep")
    check(done.returncode == 0 and table_of("killed.sweep", *LONGER) == whole, done.stderr)
    code, err = killed_sweep("whole.sweep", 1, ["--enable-recovery"])
    check("process 1 of 3 is gone" in err and table_of("whole.sweep", *LONGER) == whole, err)


def test_without_mpi():
    """K processes of a build without MPI say so; alone, or with mpirun -n 1, it is as any other."""
    write_scene()
    several_of = {**os.environ, "OMPI_COMM_WORLD_SIZE": "3", "OMPI_COMM_WORLD_RANK": "0"}
    done = subprocess.run([BARE, "run", "scene.yaml"], env=several_of, capture_output=True, text=True)
    check(done.returncode == 1 and "without MPI" in done.stderr and "libopenmpi-dev" in done.stderr, done)
    check(os.listdir(".") == ["scene.yaml"] and done.stdout == "")
    done = subprocess.run([BARE, "theory", "scene.yaml"], env={**several_of, "OMPI_COMM_WORLD_SIZE": "1"},
                          capture_output=True, text=True)
    check(done.returncode == 0, done)


if __name__ == "__main__":
    main(sys.modules[__name__])
