# SPDX-License-Identifier: GPL-3.0-or-later
"""`compare`'s own verdict as a test: both engines agree with Enskog's equation, which is solved without random numbers."""
import os
import subprocess
import sys
import tempfile

SCENES = {
    "smooth": "flow: usf\nphi: 0.01\nparticles: 1000\ncollision: {e: 0.9, beta: -1}\n",
    "rough": "flow: usf\nphi: 0.01\nparticles: 1000\ncollision: {e: 0.9, beta: 0}\n",
}
COMMON = "dsmc: {particles: 2000}\nrun: {relative_error: 0.004, seed: 2}\nmeasure: [rheology]\n"

if __name__ == "__main__":
    command, which = sys.argv[1:]
    with tempfile.TemporaryDirectory() as folder:
        with open(os.path.join(folder, "scene.yaml"), "w") as f:
            f.write(SCENES[which] + COMMON)
        done = subprocess.run([command, "compare", "scene.yaml", "--quiet", "--picture", "none"], cwd=folder, text=True,
                              capture_output=True)
    text = " ".join(done.stdout.split())
    failed = done.returncode != 0
    for number, engine in enumerate(("md", "dsmc"), 1):
        agrees = f"{engine} agrees with Enskog's equation" in text
        failed |= not agrees
        print("ok" if agrees else "not ok", number, "-", engine)
    sys.exit(failed)
