# SPDX-License-Identifier: GPL-3.0-or-later
"""Shared by tests of failing writes and kills and by validation/interruption: graingas behind the interposed library of
tests/faults, what it saw, and two result files compared bit for bit."""
import json
import os
import signal
import struct
import subprocess
import time

GRAINGAS = os.path.abspath(os.environ["GRAINGAS"])
LIBRARY = os.path.abspath(os.environ["FAILING_WRITES"])


class Page:
    """Report of the interposed library while the program runs, and after it was killed."""

    def __init__(self, path):
        self.path = path
        self.clear()

    def clear(self):
        with open(self.path, "wb") as f:
            f.write(bytes(4096))

    def read(self):
        with open(self.path, "rb") as f:
            data = f.read(288)
        self.calls, self.faults, self.stored, used = struct.unpack("4Q", data[:32])
        self.used = 1e-9 * used  # processor time at the last checkpoint
        self.what = data[32:].split(b"\0")[0].decode()
        return self


def environment(page, at=0, fails=None, on=None, last=False):
    extra = {"LD_PRELOAD": LIBRARY, "FAULT_PAGE": page.path, "FAULT_AT": str(at)}
    if fails:
        extra["FAULT_WITH"] = fails
    if on:
        extra["FAULT_ON"] = on
    if last:
        extra["FAULT_LAST"] = "1"
    return {**{k: v for k, v in os.environ.items() if not k.startswith("FAULT_")}, **extra}


def start(args, env):
    return subprocess.Popen([GRAINGAS, *args], stdin=subprocess.DEVNULL, stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE, env=env)


def cpu_of(pid):
    """Processor time that a process has used, in seconds."""
    try:
        return time.clock_gettime((~pid << 3) | 2)
    except OSError:
        return None


def kill_at(child, seconds):
    """kill -9 once it has used so much processor time; then what it used in all, its exit code, and its words. Seconds
    None: wait for its end."""
    while seconds is not None:
        if os.waitid(os.P_PID, child.pid, os.WEXITED | os.WNOHANG | os.WNOWAIT):
            break
        used = cpu_of(child.pid)
        if used is None or used >= seconds:
            child.send_signal(signal.SIGKILL)
            break
        time.sleep(max(0.0005, 0.7 * (seconds - used)))
    err = child.stderr.read().decode(errors="replace")
    _, status, usage = os.wait4(child.pid, 0)
    child.returncode = os.waitstatus_to_exitcode(status)
    child.stderr.close()
    return usage.ru_utime + usage.ru_stime, child.returncode, err


def is_of_the_clock(name):
    """Fields in which two runs of the same bits may differ."""
    return name in ("/graingas/date", "/graingas/command") or name.endswith(("cpu_seconds", "wall_seconds"))


def timeless(value):
    if isinstance(value, dict):
        return {k: timeless(v) for k, v in value.items() if k not in ("cpu_seconds", "wall_seconds")}
    return [timeless(v) for v in value] if isinstance(value, list) else value


def bits(path):
    """Contents of all datasets and attributes of a file, by name; needs h5py, whose quick functions these are: the tests
    read hundreds of files."""
    import h5py
    import numpy

    found = {}

    def put(name, value):
        if name == "/graingas/document":
            found[name] = timeless(json.loads(value.item()))
        elif not is_of_the_clock(name):
            found[name] = (str(value.dtype), value.shape, value.tobytes()) if hasattr(value, "dtype") else value

    def values(of):
        into = numpy.empty(of.shape, of.dtype)
        of.read(*([h5py.h5s.ALL, h5py.h5s.ALL] if isinstance(of, h5py.h5d.DatasetID) else []), into)
        return into

    def visit(name):
        thing, path = h5py.h5o.open(f.id, name), "/" + name.decode().removeprefix(".")
        for i in range(h5py.h5a.get_num_attrs(thing)):
            of = h5py.h5a.open(thing, index=i)
            put(f"{path}@{of.name.decode()}", values(of))
        if isinstance(thing, h5py.h5d.DatasetID):
            put(path, values(thing))

    with h5py.File(path, "r") as f:
        visit(b".")
        h5py.h5o.visit(f.id, visit)
    return found


def difference(one, two):
    """The first name in which two files' bits differ; None: in nothing."""
    for name in sorted(set(one) | set(two)):
        if one.get(name) != two.get(name):
            return name
    return None


def main_with_h5py(module):
    import tap

    try:
        import h5py  # noqa: F401
    except ImportError:
        print("1..0 # SKIP h5py is not installed")
        return
    tap.main(module)
