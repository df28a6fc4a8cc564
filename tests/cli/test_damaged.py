# SPDX-License-Identifier: GPL-3.0-or-later
"""Damaged result files and checkpoints are refused in words: HDF5 does not see them, and nothing crashes."""
import glob
import os
import random
import shutil
import struct
import subprocess
import sys
import zlib

from tap import Skip, check, main, run

SCENE = ("flow: usf\nphi: 0.2\nparticles: 60\ncollision: {e: 0.9, beta: 0}\ndsmc: {particles: 100}\n"
         "measure: [rheology, velocity_distributions]\nrun: {collisions: 20, warmup: 10}\n"
         "output: {trajectory_every: 5}\n")


def mutations(whole, n, seed):
    """Half of them a flipped bit, the others cut off, zeroed or overwritten somewhere."""
    draw = random.Random(seed)
    for k in range(n):
        damaged = bytearray(whole)
        at = draw.randrange(len(damaged))
        length = min(draw.choice([1, 8, 64, 512, 4096]), len(damaged) - at)
        if k % 2 == 0:
            damaged[at] ^= 1 << draw.randrange(8)
        elif k % 8 == 1:
            del damaged[at:]
        elif k % 8 == 3:
            damaged[at:at + length] = bytes(length)
        elif k % 8 == 5:
            damaged[at:at + length] = draw.randbytes(length)
        else:
            del damaged[at:at + length]
        if damaged != whole:
            yield bytes(damaged)


def tried(path, n, seed, *command):
    with open(path, "rb") as f:
        whole = f.read()
    done = run(*command)
    check(done.code == 0, command, done.code, done.err)
    for i, damaged in enumerate(mutations(whole, n, seed)):
        with open(path, "wb") as f:
            f.write(damaged)
        if os.path.exists(path + ".1"):
            os.remove(path + ".1")
        done = run(*command)
        check(done.code == 3 and f"{path}: cannot be read" in done.err, path, i, done.code, done.err)
    with open(path, "wb") as f:
        f.write(whole)


def many():
    return int(os.environ.get("MUTATIONS", "60"))


def test_damaged_results_are_rejected():
    run("run", "scene.yaml", "--output", "r.h5", scene=SCENE)
    tried("r.h5", many(), 1, "info", "r.h5")


def test_damaged_comparisons_are_rejected():
    run("compare", "scene.yaml", "--output", "c.h5", "--picture", "none", scene=SCENE)
    tried("c.h5", many(), 2, "info", "c.h5", "--json")


def test_damaged_checkpoints_are_rejected():
    for engine, seed in ("md", 3), ("dsmc", 4):
        for left in glob.glob("scene.checkpoint*"):
            os.remove(left)
        stopped = ("--set", "output.checkpoint_every=100", "--set", "run.collisions=1e9")
        done = run("run", "scene.yaml", "--engine", engine, *stopped, "--set", "run.time_limit=0.1", scene=SCENE)
        check(done.code == 1, done.err)
        tried("scene.checkpoint.h5", many(), seed, "run", "scene.yaml", "--engine", engine, "--resume",
              "scene.checkpoint.h5", "--set", "output.trajectory_every=0", "--quiet", "--output", "o.h5")


def sealed(path):
    """As the manual page says how to vouch for a file."""
    with open(path, "r+b") as f:
        data = f.read()
        f.write(struct.pack("<8sQI", b"gg-crc32", len(data), zlib.crc32(data)))


def without_checksum(path):
    with open(path, "r+b") as f:
        f.truncate(os.path.getsize(path) - 20)


def assert_read(path, warning, *same_as):
    """By info, export and plot alike; `same_as`: the tables and the document of a file that nobody has changed."""
    texts = []
    for args in ("info", path, "--json"), ("export", path, "--output", "e", "--quiet"), ("plot", path, "--output", "p.svg"):
        if args[0] == "plot" and not shutil.which("gnuplot"):
            continue
        done = run(*args)
        check(done.code == 0, args, done.code, done.err)
        check(done.err == (f"warning: {path}: {warning}\n" if warning else ""), args, done.err)
        texts.append(done.out if args[0] == "info" else "")
    for name in sorted(n for n in os.listdir(".") if n.startswith("e") and n[1] in "._"):
        with open(name) as f:
            texts.append(name + f.read())
    check(not same_as or [texts] == list(same_as), path)
    return texts


CHANGED = "another program has changed it since graingas wrote it"


def test_a_file_of_another_program():
    """A result without its checksum is read with a warning; one of which a byte is missing, and a checkpoint, are not.
    With a checksum, as the manual page says how to add it, there is no warning."""
    run("run", "scene.yaml", "--output", "r.h5", scene=SCENE)
    with open("r.h5", "rb") as f:
        whole = f.read()
    texts = assert_read("r.h5", "")
    without_checksum("r.h5")
    assert_read("r.h5", CHANGED, texts)
    sealed("r.h5")
    assert_read("r.h5", "", texts)
    check(open("r.h5", "rb").read() == whole)
    for length in len(whole) - 21, len(whole) - 19, len(whole) - 1, len(whole) // 2:
        with open("r.h5", "wb") as f:
            f.write(whole[:length])
        done = run("info", "r.h5")
        check(done.code == 3 and "cut off or damaged" in done.err and "another program" in done.err, length, done.err)
    run("run", "scene.yaml", "--set", "output.checkpoint_every=100", "--set", "run.collisions=1e9", "--set",
        "run.time_limit=0.1", "--quiet")
    without_checksum("scene.checkpoint.h5")
    if os.path.exists("scene.checkpoint.h5.1"):
        os.remove("scene.checkpoint.h5.1")
    done = run("run", "scene.yaml", "--resume", "scene.checkpoint.h5", "--quiet")
    check(done.code == 3 and "its checksum is missing" in done.err, done.err)


def test_changed_by_h5py():
    """Attributes and datasets that users added with h5py to the file or to a quantity, and changed numbers."""
    try:
        import h5py
    except ImportError as why:
        raise Skip(why)
    run("compare", "scene.yaml", "--output", "r.h5", "--picture", "none", scene=SCENE)
    texts = assert_read("r.h5", "")
    with h5py.File("r.h5", "r+") as f:
        f.attrs["note"] = "the run with the new wall"
        f["graingas/md/results/temperature"].attrs["mine"] = [1.5, 2.5]
        f["mine"] = list(range(1000))
    assert_read("r.h5", CHANGED, texts)
    with h5py.File("r.h5", "r+") as f:
        for i in range(50):
            f[f"notes/{i}"] = i
            f["particles/grains"].attrs[f"note {i}"] = "text " * i
    assert_read("r.h5", CHANGED, texts)


def test_repacked_results_are_read():
    """Compressed by h5repack in the ways that it has; what graingas does not read is named."""
    if not shutil.which("h5repack"):
        raise Skip("no h5repack")
    run("run", "scene.yaml", "--output", "whole.h5", scene=SCENE.replace("particles: 60", "particles: 2000"))
    shutil.copy("whole.h5", "r.h5")
    texts = assert_read("r.h5", "")
    for filters in ["GZIP=6"], ["SHUF", "GZIP=9"], ["FLET"], ["SHUF", "GZIP=1", "FLET"], ["NONE"]:
        more = [word for f in filters for word in ("-f", f)]
        subprocess.run(["h5repack", *more, "whole.h5", "r.h5"], check=True)
        assert_read("r.h5", CHANGED, texts)
    subprocess.run(["h5repack", "-f", "NBIT", "whole.h5", "r.h5"], check=True)
    done = run("info", "r.h5")
    check(done.code == 3 and "is compressed by another filter than gzip" in done.err and "h5repack -f NONE" in done.err,
          done.err)


def test_newer_version():
    """It is read, and one line says what it is."""
    try:
        import h5py
        import numpy
    except ImportError as why:
        raise Skip(why)
    run("run", "scene.yaml", "--output", "r.h5", scene=SCENE)
    texts = assert_read("r.h5", "")
    here = run("--version").out.split()[1]
    for version, newer in ("9.9.9", True), ("0.0.9+g1234567", False):
        with h5py.File("r.h5", "r+") as f:
            del f["graingas/version"]
            f["graingas"].create_dataset("version", data=numpy.bytes_(version))
        sealed("r.h5")
        assert_read("r.h5", f"graingas {version} wrote it, and this is {here}: what is newer in it is not shown" if newer
                    else "", texts)
        without_checksum("r.h5")


if __name__ == "__main__":
    main(sys.modules[__name__])
