# SPDX-License-Identifier: GPL-3.0-or-later
"""The recipes of docs/howto/read_results_in_python.md are run as they stand: its shell block with graingas first, then each
python block in a process of its own. A recipe whose modules are not installed is skipped."""
import os
import re
import subprocess
import sys
import tempfile

from tap import GRAINGAS, PATIENCE, Skip, check, main

SOURCE = os.environ["SOURCE"]
PAGE = open(os.path.join(SOURCE, "docs", "howto", "read_results_in_python.md"), encoding="utf-8").read()
FOLDER = tempfile.TemporaryDirectory()


def blocks(language):
    """Code by the title of its section."""
    titled = re.split(r"^## (\w+).*$", "## before\n" + PAGE, flags=re.MULTILINE)[1:]
    return {title: code for title, text in zip(titled[::2], titled[1::2])
            for code in re.findall(rf"^```{language}\n(.*?)^```", text, re.MULTILINE | re.DOTALL)}


def files():
    """Results that the recipes read, made once."""
    if os.path.exists(os.path.join(FOLDER.name, "usf.sweep.csv")):
        return
    os.symlink(os.path.join(SOURCE, "examples"), os.path.join(FOLDER.name, "examples"))
    os.symlink(GRAINGAS, os.path.join(FOLDER.name, "graingas"))
    done = subprocess.run(["sh", "-ec", blocks("sh")["before"]], cwd=FOLDER.name, capture_output=True, text=True,
                          timeout=100 * PATIENCE, env=dict(os.environ, PATH=FOLDER.name + ":" + os.environ["PATH"]))
    check(done.returncode == 0, done.stdout[-1000:], done.stderr[-1000:])


def recipe(title):
    """The temperature that the recipe prints, if any, and all else."""
    code = blocks("python")[title]
    names = re.findall(r"^import (\w+)", code, re.MULTILINE)
    for name in names:
        probe = subprocess.run([sys.executable, "-W", "ignore", "-c", f"import {name}"], capture_output=True)
        if probe.returncode:
            raise Skip(f"{name} is not installed")
    files()
    done = subprocess.run([sys.executable, "-W", "ignore", "-c", code], cwd=FOLDER.name, capture_output=True, text=True,
                          timeout=100 * PATIENCE)
    check(done.returncode == 0, title, done.stderr)
    last = re.findall(r"\bT(?: of the last frame:| =) ([\d.]+)", done.stdout)
    return done.stdout, float(last[-1]) if last else None


def test_the_h5py_recipe_runs():
    out, T = recipe("h5py")
    check("samples until" in out and 0.2 < T < 0.6, out)


def test_the_crossing_recipe_finds_the_time():
    """1 + e^(-0.4 t) and 2 - 1.5 e^(-0.4 t) cross at ln(2.5)/0.4."""
    files()
    done = subprocess.run(["sh", "-ec", blocks("sh")["Crossing"]], cwd=FOLDER.name, capture_output=True, text=True,
                          timeout=100 * PATIENCE, env=dict(os.environ, PATH=FOLDER.name + ":" + os.environ["PATH"]))
    check(done.returncode == 0, done.stderr)
    when, error = map(float, re.findall(r"[\d.]+", recipe("Crossing")[0]))
    check(abs(when - 2.2907) < 5 * error and error < 0.05, when, error)


def test_the_pandas_recipe_runs():
    out, _ = recipe("pandas")
    check("stderr" in out and "enskog_hermite" in out, out)


def test_the_xarray_recipe_runs():
    if subprocess.run([sys.executable, "-c", "import xarray"], capture_output=True).returncode:
        raise Skip("xarray is not installed")
    out, _ = recipe("xarray")
    check("nan" not in out and len(re.findall(r"\d+\.\d", out)) >= 3, out)


def same_temperature(title):
    """The temperature of the last frame is that of the recipe with h5py."""
    out, T = recipe(title)
    expected = recipe("h5py")[1]
    check(abs(T / expected - 1) < 1e-4, out, expected)


def test_the_ase_recipe_has_the_temperature():
    same_temperature("ASE")


def test_the_mdanalysis_recipe_has_the_temperature():
    same_temperature("MDAnalysis")


def test_the_gsd_recipe_has_the_temperature_and_distances():
    """Also the nearest distances, by GSD's leaning cell: grains touch and do not overlap."""
    same_temperature("GSD")
    code = "import gsd.hoomd, numpy as np\n" \
           "s = gsd.hoomd.open('dense.gsd', 'rb')[-1]\nL, xy = s.configuration.box[:3], s.configuration.box[3]\n" \
           "h = np.diag(L).astype(float); h[1, 0] = xy * L[1]\n" \
           "d = s.particles.position[:, None].astype(float) - s.particles.position\n" \
           "f = np.linalg.solve(h.T, d.reshape(-1, 3).T).T; f -= np.round(f)\n" \
           "near = min(np.linalg.norm(((f + [i, 0, 0]) @ h).reshape(d.shape), axis=2)[np.triu_indices(len(d), 1)].min() for i in (-1, 0, 1))\n" \
           "print(near, abs(xy) > 1e-6)"
    done = subprocess.run([sys.executable, "-W", "ignore", "-c", code], cwd=FOLDER.name, capture_output=True, text=True)
    near, leans = done.stdout.split()
    check(0.9999 < float(near) < 1.05 and leans == "True", done.stdout, done.stderr)


def test_every_recipe_is_tried():
    check(sorted(blocks("python")) == sorted(["h5py", "Crossing", "pandas", "xarray", "ASE", "MDAnalysis", "GSD"]), list(blocks("python")))


if __name__ == "__main__":
    main(sys.modules[__name__])
