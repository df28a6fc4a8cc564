# SPDX-License-Identifier: GPL-3.0-or-later
"""A call that changes a file fails, for every such call of a command in turn: the exit code and the message say so, what
was there before is whole, and nothing half-written or temporary is left but what the message names. Writes that take less than they were given are
continued. The test tries the first twenty calls and every 37th, without NIGHTLY a third of these. EVERY_KIND=1 tries all kinds of failure at every call, and prints a table (validation/interruption)."""
import errno
import os
import shutil
import subprocess
import sys

from tap import Skip, check
from faults import GRAINGAS, Page, bits, difference, environment, main_with_h5py

SCENE = """flow: usf
phi: 0.2
particles: 60
collision: {e: 0.9, beta: 0.3, mu: 0.4}
dsmc: {particles: 100}
measure: [rheology, velocity_distributions]
run: {collisions: 40, warmup: 10}
output: {trajectory_every: 5}
"""
KEEPS = "output.checkpoint_every=1e-6"
# name: what is there before, the command, its exit code where it fails (3, too, where nothing could be begun)
CASES = {
    "run": ([], ["run", "scene.yaml", "--output", "old.h5"], 3),
    "run, dsmc": ([], ["run", "scene.yaml", "--engine", "dsmc", "--output", "old.h5"], 3),
    "run, checkpoints": ([], ["run", "scene.yaml", "--output", "old.h5", "--set", KEEPS], 3),
    "resume": (["stopped"], ["run", "scene.yaml", "--output", "old.h5", "--set", KEEPS, "--set", "run.collisions=60",
                             "--resume", "old.checkpoint.h5"], 3),
    # without friction: Enskog's equation takes a third of the time
    "compare": ([], ["compare", "scene.yaml", "--output", "old.h5", "--picture", "none", "--set", KEEPS, "--set",
                     "collision.mu=inf"], 3),
    "sweep": ([], ["sweep", "scene.yaml", "--vary", "phi=0.1,0.2", "--threads", "1", "--set", KEEPS], 1),
    "collect": (["swept"], ["sweep", "scene.yaml", "--vary", "phi=0.1,0.2", "--collect", "--picture", "none"], 3),
    "export": (["exported"], ["export", "old.h5", "--output", "old"], 3),
    "plot": (["plotted"], ["plot", "old.h5", "--output", "old.svg"], 3),
}
PREPARED = {
    "stopped": ["run", "scene.yaml", "--output", "old.h5", "--set", KEEPS, "--set", "run.collisions=1e9", "--set",
                "run.time_limit=0.05"],
    "swept": ["sweep", "scene.yaml", "--vary", "phi=0.1,0.2"],
    "exported": ["export", "old.h5", "--output", "old"],
    "plotted": ["plot", "old.h5", "--output", "old.svg"],
}
FULL = "EVERY_KIND" in os.environ
SHARE = 1 if "NIGHTLY" in os.environ else 3  # odd: kinds of failure take turns
KINDS = [(kind, last) for kind in ("ENOSPC", "EIO", "EDQUOT") for last in (False, True)] if FULL else [None]
IN_TURN = ("ENOSPC", True), ("EIO", False)  # by the number of the call


def files():
    return {os.path.relpath(os.path.join(top, name)) for top, _, names in os.walk(".") for name in names}


def content(path):
    with open(path, "rb") as f:
        return f.read()


def of_target(what):
    """The file that a temporary one or a lock stands for, as messages name it; of "pwrite /x/usf.h5.graingas-tmp"."""
    name = os.path.basename(what.split(" ", 1)[1])
    for ending in (".graingas-tmp", ".graingas-lock", ".graingas-kept", ".new", ".1"):
        name = name.removesuffix(ending)
    return name


class Case:
    def __init__(self, name):
        self.name, (before, self.command, self.code) = name, CASES[name]
        with open("scene.yaml", "w") as f:
            f.write(SCENE)
        for command in (["run", "scene.yaml", "--output", "old.h5", "--seed", "5"], *(PREPARED[b] for b in before)):
            subprocess.run([GRAINGAS, *command, "--quiet"], capture_output=True)
        shutil.copytree(".", "../before")
        self.before = {f: content(f) for f in files()}
        self.page = Page("../page")
        self.calls = self.faults = self.clean = self.harmless = 0
        self.wrong = []
        done = self.run()
        check(done.returncode == 0, done.stderr)
        self.expected = {f: self.bits(f) for f in files()}

    def restore(self):
        for f in files():
            if content(f) != self.before.get(f):
                os.remove(f)
        for f, data in self.before.items():
            if not os.path.exists(f):
                os.makedirs(os.path.dirname(f) or ".", exist_ok=True)
                with open(f, "wb") as out:
                    out.write(data)

    def run(self, at=0, kind=None, last=False):
        self.page.clear()
        done = subprocess.run([GRAINGAS, *self.command, "--quiet"], env=environment(self.page, at, kind, last=last),
                              capture_output=True, text=True, errors="replace", timeout=60)
        self.page.read()
        return done

    def bits(self, path):
        if not path.endswith(".h5") or path.endswith(".checkpoint.h5"):
            return content(path)
        found = bits(path)
        if self.name == "resume":  # it began at another moment
            found = {k: v for k, v in found.items() if "document" not in k}
        return found

    def may_be_ignored(self):
        """A lock holds without its words; a folder that cannot be flushed, and a close after the flush, lose nothing."""
        call, path = self.page.what.split(" ", 1)
        return call in ("open", "close") or path.endswith(".graingas-lock") or os.path.isdir(path)

    def check_whole(self):
        """It is as if nothing had happened."""
        now = files()
        check(now == set(self.expected), self.page.what, now ^ set(self.expected))
        for path, expected in self.expected.items():
            now = self.bits(path)
            same = difference(now, expected) if isinstance(expected, dict) else None if now == expected else "bytes"
            check(same is None, self.page.what, path, same)

    def check_clean(self, done, kind, last):
        """After an error the files are those from before. Checkpoints that can be resumed may be new or updated."""
        number = getattr(errno, kind)
        said = done.stderr
        check(done.returncode in (3, self.code), self.page.what, done.returncode, said)
        # If all later calls fail, too, the first may be harmless; then the message names the file of a later one.
        named = of_target(self.page.what) in said or (last and ": cannot be written: " in said)
        check(os.strerror(number) in said and named, self.page.what, said)
        now = files()
        left = {f for f in now if f.endswith((".graingas-kept", ".graingas-tmp", ".work.h5"))
                and "kept in" in said and os.path.basename(f) in said}  # the only copy, named in the message
        kept = {f for f in now | set(self.before) if ".checkpoint." in f} - left
        ends = {f for f in now if f in self.expected and f not in self.before}  # whole files of a set, as of a sweep
        check(now - kept - ends - left == set(self.before) - kept, self.page.what, now ^ set(self.before))
        for f in now - kept - left:
            was = content(f) == self.before.get(f)
            check(was or self.whole(f), self.page.what, f, "is neither the old nor the new")
        heads = {f[:f.index(".checkpoint.")] + ".checkpoint.h5" for f in kept if f in now}
        for head in heads | {f for f in self.before if f.endswith("checkpoint.h5")}:
            info = subprocess.run([GRAINGAS, "info", head], capture_output=True, text=True)
            check(info.returncode == 0, self.page.what, head, now, info.stderr)

    def whole(self, path):
        return path in self.expected and self.bits(path) == self.expected[path]

    def judge(self, done, what, kind, last=False):
        self.faults += 1
        try:
            check(done.returncode >= 0, self.page.what, "signal", -done.returncode)
            if done.returncode == 0:
                self.harmless += 1
                check(kind is None or self.may_be_ignored(), self.page.what, "was not told")
                self.check_whole()
            else:
                check(kind, self.page.what, done.stderr)
                self.clean += 1
                self.check_clean(done, kind, last)
        except AssertionError as why:
            self.wrong.append(f"{self.name}, call {what}: {why}")

    def try_every(self):
        for one in KINDS:
            at = 1
            while True:
                kind, last = one or IN_TURN[at % 2]
                self.restore()
                done = self.run(at, kind, last)
                if not self.page.faults:
                    break
                self.judge(done, f"{at} {kind}{' and later' if last else ''}", kind, last)
                self.calls = max(self.calls, at)
                at += 1 if FULL else SHARE * (1 if at < 20 else 37)  # the first ones, and of hundreds of HDF5's a share
        for at in range(1, self.calls + 1, 7) if FULL else [1]:
            self.restore()
            self.judge(self.run(at, "short", last=at == 1), f"{at} short", None)
        if FULL:
            print(f"# | {self.name} | {self.calls} | {self.faults} | {self.clean} | {self.harmless} |", flush=True)
        check(not self.wrong, f"{len(self.wrong)} of {self.faults}:", *("\n" + w for w in self.wrong[:40]))


def of(name):
    def test():
        os.mkdir("here")
        os.chdir("here")
        if name == "plot" and not shutil.which("gnuplot"):
            raise Skip("gnuplot is not installed")
        Case(name).try_every()
        os.chdir("..")

    return test


def test_only_copy():
    """A result that could not be renamed, or not be flushed, is kept under a name of its own, and named."""
    with open("scene.yaml", "w") as f:
        f.write(SCENE)
    page, names = Page("page"), {}
    for at in range(1, 200):
        page.clear()
        done = subprocess.run([GRAINGAS, "run", "scene.yaml", "--quiet", "--set", "output.trajectory_every=0"],
                              env=environment(page, at, "EIO"), capture_output=True, text=True)
        page.read()
        if not page.faults:
            break
        call, path = page.what.split(" ", 1)
        if call == "rename" or (call == "fsync" and path.endswith(".h5.graingas-tmp")):
            kept = "scene.h5.graingas-kept"
            check(done.returncode == 3 and done.stderr.strip().endswith("kept in " + kept), page.what, done.stderr)
            check(bits(kept).keys(), kept)
            names[call] = kept
        for name in "scene.h5", "scene.h5.graingas-kept":
            if os.path.exists(name):
                os.remove(name)
    check(sorted(names) == ["fsync", "rename"], names)


def test_standard_output():
    """A table that did not arrive is no success."""
    with open("scene.yaml", "w") as f:
        f.write(SCENE.replace(", mu: 0.4", ""))  # theories take a third of the time
    runs = [["run", "scene.yaml"], ["compare", "scene.yaml", "--picture", "none"], ["info", "scene.h5"],
            ["info", "scene.yaml"], ["theory", "scene.yaml"], ["export", "scene.h5"], ["--help"], ["run", "--help"],
            ["--version"], ["sweep", "scene.yaml", "--vary", "phi=0.1,0.2", "--list"]]
    for command in runs + [[*c, "--json"] for c in runs[:5]]:
        with open("/dev/full", "w") as full:
            done = subprocess.run([GRAINGAS, *command], stdout=full, stderr=subprocess.PIPE, text=True)
        check(done.returncode == 3 and "standard output cannot be written" in done.stderr, command, done)


for case in CASES:
    globals()["test_" + case] = of(case)

if __name__ == "__main__":
    main_with_h5py(sys.modules[__name__])
