"""Damaged result files and checkpoints are refused in words: HDF5 does not see them, and nothing crashes."""
import os
import random
import sys

from tap import check, main, run

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


def test_results():
    run("run", "scene.yaml", "--output", "r.h5", scene=SCENE)
    tried("r.h5", many(), 1, "info", "r.h5")


def test_comparisons():
    run("compare", "scene.yaml", "--output", "c.h5", "--picture", "none", scene=SCENE)
    tried("c.h5", many(), 2, "info", "c.h5", "--json")


def test_checkpoints():
    for engine, seed in ("md", 3), ("dsmc", 4):
        stopped = ("--set", "output.checkpoint_every=100", "--set", "run.collisions=1e9")
        done = run("run", "scene.yaml", "--engine", engine, *stopped, "--set", "run.time_limit=0.1", scene=SCENE)
        check(done.code == 1, done.err)
        tried("scene.checkpoint.h5", many(), seed, "run", "scene.yaml", "--engine", engine, "--resume",
              "scene.checkpoint.h5", "--set", "output.trajectory_every=0", "--quiet", "--output", "o.h5")


def test_a_file_of_another_program():
    """Without its checksum a file is refused, and the manual page's way to vouch for it works."""
    import struct
    import zlib

    run("run", "scene.yaml", "--output", "r.h5", scene=SCENE)
    with open("r.h5", "rb") as f:
        whole = f.read()
    with open("r.h5", "wb") as f:
        f.write(whole[:-20])
    done = run("info", "r.h5")
    check(done.code == 3 and "its checksum is missing" in done.err and "another program" in done.err, done.err)
    with open("r.h5", "r+b") as f:
        data = f.read()
        f.write(struct.pack("<8sQI", b"gg-crc32", len(data), zlib.crc32(data)))
    check(run("info", "r.h5").code == 0)
    check(open("r.h5", "rb").read() == whole)


if __name__ == "__main__":
    main(sys.modules[__name__])
