# SPDX-License-Identifier: GPL-3.0-or-later
"""A few lines of TAP around functions named test_*, and the graingas command run in a folder of its own."""
import os
import signal
import subprocess
import sys
import tempfile
import traceback

GRAINGAS = os.path.abspath(os.environ["GRAINGAS"])
SANITIZERS = os.environ.get("SANITIZERS", "none")  # that it is built with
os.environ.pop("COLUMNS", None)  # of the terminal of whoever runs the tests: texts are 80 wide
PATIENCE = float(os.environ.get("PATIENCE", 1 if SANITIZERS == "none" else 20))  # with a slow build, or a busy machine


class Skip(Exception):
    pass


class Done:
    """Outcome of a command: exit code, texts, new files."""

    def __init__(self, code, out, err, new):
        self.code, self.out, self.err, self.new = code, out, err, new


def run(*args, scene=None, name="scene.yaml", limit=None, timeout=100, columns=None, typed=None, user=None):
    """Run graingas in the current folder; `scene` is written first; `limit`: largest file in bytes, as on a full disk;
    `columns`: how wide lines may be; `typed`: what stands on standard input; `user`: as whom, where root runs the
    tests."""
    if scene is not None:
        with open(name, "wb") as f:
            f.write(scene if isinstance(scene, bytes) else scene.encode())
    before = set(os.listdir("."))

    def limited():
        import resource

        resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))

    done = subprocess.run([GRAINGAS, *args], capture_output=True, timeout=PATIENCE * timeout, text=True, input=typed,
                          env=dict(os.environ, COLUMNS=str(columns)) if columns else None,
                          preexec_fn=limited if limit else None, user=user)
    return Done(done.returncode, done.stdout, done.stderr, sorted(set(os.listdir(".")) - before))


def page(name):
    """A page of docs/reference or the manual page, made of the program's tables."""
    tables = run("--tables")
    check(tables.code == 0 and not tables.err, tables.err)
    with open("tables.json", "w", encoding="utf-8") as out:
        out.write(tables.out)
    script = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "scripts", "reference-pages")
    return subprocess.run([sys.executable, script, name, "tables.json"], capture_output=True, check=True, encoding="utf-8").stdout


def check(condition, *what):
    if not condition:
        raise AssertionError(" ".join(str(w) for w in what))


def main(module):
    if signal.getsignal(signal.SIGINT) == signal.SIG_IGN:  # of a shell in the background; graingas would keep it so
        signal.signal(signal.SIGINT, signal.default_int_handler)
    tests = [(n[5:], f) for n, f in vars(module).items() if n.startswith("test_") and callable(f)]
    print(f"1..{len(tests)}")
    failed = 0
    for i, (name, test) in enumerate(tests, 1):
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                test()
                print(f"ok {i} - {name}")
            except Skip as why:
                print(f"ok {i} - {name} # SKIP {why}")
            except Exception:
                failed += 1
                print(f"not ok {i} - {name}")
                print(traceback.format_exc(), file=sys.stderr)  # the runner shows this, but no line of TAP beside it
            os.chdir("/")
    sys.exit(failed > 0)
