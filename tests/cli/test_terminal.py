# SPDX-License-Identifier: GPL-3.0-or-later
"""Progress where standard error is a terminal: one line, no wider than it, which is gone at the end."""
import fcntl
import os
import pty
import re
import struct
import subprocess
import sys
import termios
import threading

from tap import GRAINGAS, PATIENCE, check, main

SCENE = ("flow: usf\nphi: 0.2\nparticles: 300\ndsmc: {particles: 2000}\ncollision: {e: 0.9}\n"
         f"run: {{collisions: 1e8, warmup: 20, time_limit: {1.2 * PATIENCE}, replicas: 2}}\n")
SWEEP = "flow: usf\nphi: 0.2\nparticles: 200\nrun: {collisions: 3000}\nvary: {phi: [0.1, 0.2, 0.3]}\n"
WIDTH = 44


def on_terminal(*args, columns=WIDTH):
    """Standard error of a command, on a terminal of so many columns; its exit code; standard output."""
    near, far = pty.openpty()
    fcntl.ioctl(far, termios.TIOCSWINSZ, struct.pack("HHHH", 24, columns, 0, 0))
    seen = []

    def read():
        while True:
            try:
                data = os.read(near, 65536)
            except OSError:  # nobody writes any more
                return
            if not data:
                return
            seen.append(data)

    child = subprocess.Popen([GRAINGAS, *args], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=far)
    os.close(far)
    reader = threading.Thread(target=read)
    reader.start()
    out = child.communicate(timeout=100 * PATIENCE)[0].decode()
    reader.join()
    os.close(near)
    return b"".join(seen).decode(), child.returncode, out


def lines_of(text):
    """Successive texts of the progress line; an erasure of the rest follows each."""
    return [part[:-3] for part in text.split("\r") if part.endswith("\x1b[K")]


def assert_live(text, words, columns=WIDTH):
    shown = lines_of(text)
    check(any(re.search(words, s) for s in shown), words, repr(text[-400:]))
    check(all(len(s) < columns for s in shown), "wider than the terminal", max(shown, key=len))
    check("\r\x1b[K" in text, "the last is left there")


def test_a_run_shows_its_progress():
    with open("s.yaml", "w") as f:
        f.write(SCENE)
    text, code, out = on_terminal("run", "s.yaml")
    check(code in (0, 1) and "temperature" in out, code, text)
    assert_live(text, "^md (warm|averaging)")
    wide = on_terminal("run", "s.yaml", columns=200)[0]
    check(any("collisions" in s and "/s" in s and "replicas" in s for s in lines_of(wide)), wide[-300:])
    quiet = on_terminal("run", "s.yaml", "--quiet")[0]
    check("\r\x1b[K" not in quiet, quiet)


def test_a_comparison_shows_its_progress():
    with open("s.yaml", "w") as f:
        f.write(SCENE)
    text, code, out = on_terminal("compare", "s.yaml", "--picture", "none", columns=150)
    check(code in (0, 1), code, text)
    assert_live(text, r"md .*  \|  dsmc ", 150)


def test_a_sweep_shows_its_progress():
    with open("s.yaml", "w") as f:
        f.write(SWEEP)
    text, code, out = on_terminal("sweep", "s.yaml", "--threads", "1")
    check(code == 0, code, text)
    assert_live(text, "of 3 points done, ")


if __name__ == "__main__":
    main(sys.modules[__name__])
