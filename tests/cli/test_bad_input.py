# SPDX-License-Identifier: GPL-3.0-or-later
"""Every mistake a user can make: the message says what is wrong and what to do, the exit code says whose fault it is,
and no partial file is left."""
import os
import shutil
import subprocess
import sys

from tap import GRAINGAS, check, main, run

GOOD = "flow: usf\nphi: 0.2\nparticles: 100\nrun: {collisions: 200, warmup: 20}\n"


def refused(words, code, *args, **more):
    done = run(*(args or ("run", "scene.yaml")), **more)
    check(done.code == code, "exit", done.code, done.err)
    check(words in done.err, f"'{words}' not in '{done.err}'")
    check(done.out == "", "on stdout:", done.out)
    check(not done.new, "left behind:", done.new)


def test_unknown_key():
    refused("scene.yaml:3: key 'colision': no such key; did you mean 'collision'?", 2,
            scene="flow: usf\nphi: 0.3\ncolision: {e: 0.9}\n")


def test_wrong_type():
    refused("scene.yaml:2: key 'phi': value 'dense' is not allowed; allowed: a number from 0 to 0.6", 2,
            scene="flow: usf\nphi: dense\n")


def test_out_of_range():
    refused("scene.yaml:3: key 'collision.e': value '1.5' is not allowed; allowed: a number from 0 to 1", 2,
            scene="flow: usf\nphi: 0.3\ncollision: {e: 1.5}\n")


def test_phi_too_high():
    refused("scene.yaml:2: key 'phi': value '0.7' is not allowed; allowed: a number from 0 to 0.6", 2,
            scene="flow: usf\nphi: 0.7\n")


def test_two_particle_box():
    refused("particles", 2, scene="flow: usf\nphi: 0.3\nparticles: 2\nengine: md\n")
    check("phi" in run("run", "scene.yaml").err)


def test_missing_phi():
    refused("phi is missing", 2, scene="flow: usf\n")


def test_md_at_phi_0():
    refused("phi = 0 is for engine: dsmc", 2, scene="flow: usf\nphi: 0\n")


def test_empty_file():
    refused("scene.yaml: is empty", 2, scene="")


def test_binary_rubbish():
    refused("scene.yaml: is not a scene", 2, scene=bytes(range(256)) * 8)


def test_unreadable_file():
    refused("none.yaml: cannot be read: No such file or directory", 3, "run", "none.yaml")
    refused(".: cannot be read: it is a folder", 3, "compare", ".")
    if os.geteuid() != 0:
        run("info", "scene.yaml", scene=GOOD)
        os.chmod("scene.yaml", 0)
        refused("scene.yaml: cannot be read: Permission denied", 3)


def test_unwritable_file():
    """Said before the run, not after it: ten thousand collisions a grain would take minutes."""
    long = GOOD.replace("200", "100000").replace("100\n", "10000\n")
    for command in "run", "compare":
        refused("nowhere/r.h5: cannot be written: No such file or directory", 3, command, "scene.yaml", "--output",
                "nowhere/r.h5", scene=long)
    os.mkdir("folder.h5")
    refused("folder.h5: cannot be written: Is a directory", 3, "run", "scene.yaml", "--output", "folder.h5")


def test_disk_full():
    for command, output in ("run", "scene.h5"), ("compare", "scene.compare.h5"):
        done = run(command, "scene.yaml", "--quiet", scene=GOOD, limit=8192)
        check(done.code == 3, "exit", done.code, done.err)
        check(f"{output}: cannot be written: File too large" in done.err, done.err)
        check(not done.new, done.new)


def test_disk_full_in_picture():
    """A disk that fills while the picture is drawn: gnuplot does not notice, graingas does."""
    run("run", "scene.yaml", "--quiet", "--output", "r.h5",
        scene="flow: usf\nphi: 0.1\nparticles: 200\nrun: {collisions: 100}\n")
    done = run("plot", "r.h5", "--output", "r.svg", limit=30000)
    check(done.code == 3 and "whole" in done.err, done.code, done.err)
    check(not done.new, "left behind:", done.new)


def test_disk_full_in_trajectory():
    done = run("run", "scene.yaml", "--quiet", "--set", "output.trajectory_every=2", scene=GOOD, limit=100000)
    check(done.code == 3, "exit", done.code, done.err)
    check("scene.h5: cannot be written" in done.err and "HDF5: infinite loop" not in done.err, done.err)
    check(not done.new, done.new)


def test_full_standard_output():
    if os.path.exists("/dev/full"):
        import subprocess

        from tap import GRAINGAS

        run("info", "scene.yaml", scene=GOOD)
        with open("/dev/full", "w") as full:
            done = subprocess.run([GRAINGAS, "theory", "scene.yaml", "--json"], stdout=full, stderr=subprocess.PIPE,
                                  text=True)
        check(done.returncode == 3 and "standard output cannot be written" in done.stderr, done.returncode, done.stderr)


def test_wrong_overrides_are_rejected():
    refused("--set colision.e=1: key 'colision.e': no such key; did you mean 'collision.e'?", 2, "run", "scene.yaml",
            "--set", "colision.e=1", scene=GOOD)
    refused("--set collision.e=2: key 'collision.e': value '2' is not allowed; allowed: a number from 0 to 1", 2,
            "compare", "scene.yaml", "--set", "collision.e=2")
    refused("KEY=VALUE is expected", 2, "theory", "scene.yaml", "--set", "phi")
    refused("run.seed", 2, "run", "scene.yaml", "--seed", "seven")
    refused("--threads", 2, "run", "scene.yaml", "--threads", "0")


def test_command_line():
    refused("unknown command 'comparr'; did you mean 'compare'?", 2, "comparr")
    refused("unknown option '--outptu'; did you mean '--output'?", 2, "run", "scene.yaml", "--outptu", "x.h5")
    refused("option '--output' needs a value", 2, "run", "--output")
    refused("'-' is not a file to write", 2, "run", "scene.yaml", "--output", "-", scene="flow: usf\nphi: 0.1\n")
    refused("run needs SCENE.yaml", 2, "run")
    refused("nofolder/x.svg: cannot be written", 3, "bench", "error", "--picture", "nofolder/x.svg", timeout=20)
    refused("one too many", 2, "run", "a.yaml", "b.yaml")


def test_foreign_characters():
    """Names and options reach no terminal as they are: neither line ends, nor escapes, nor marks of writing direction,
    nor bytes that are no UTF-8."""
    bad = b"x\x1b[31m\n\xe2\x80\xae\xfc"
    calls = [[b"run", bad + b".yaml"], [b"run", b"scene.yaml", b"--" + bad], [bad], [b"run", b"scene.yaml", b"--engine", bad],
             [b"run", b"scene.yaml", b"--set", bad + b"=1"], [b"info", bad + b".h5"], [b"export", bad + b".h5"],
             [b"compare", b"scene.yaml", b"--threads", bad], [b"sweep", b"scene.yaml", b"--vary", bad],
             [b"run", b"scene.yaml", b"--resume", bad], [b"plot", bad], [b"info", bad],
             [b"export", b"scene.yaml", b"--only", bad]]
    with open("scene.yaml", "w") as f:
        f.write(GOOD)
    for call in calls:
        done = subprocess.run([GRAINGAS.encode(), *call], capture_output=True)
        text = done.stdout + done.stderr
        check(done.returncode in (2, 3) and b"x?[31m???" in text, call, done)
        check(text.count(b"\n") == 1 and not any(c in text for c in (b"\x1b", b"\xe2\x80\xae", b"\xfc")), call, text)
    done = subprocess.run([GRAINGAS.encode(), b"run", b"scene.yaml", b"--output", bad + b".h5"], capture_output=True)
    check(done.returncode == 0 and b"results: x?[31m???.h5" in done.stderr, done)
    done = subprocess.run([GRAINGAS.encode(), b"info", bad + b".h5"], capture_output=True)
    check(done.returncode == 0 and b"\xe2\x80\xae" not in done.stderr, done.stderr)
    done = subprocess.run([GRAINGAS.encode(), b"export", bad + b".h5", b"--only", b"results"], capture_output=True)
    check(done.stdout == bad + b".csv\n", "scripts get names as they are", done)


def test_page_without_a_scene():
    """Options for a scene that is missing are rejected, not ignored."""
    for option in (("--set", "phi=3"), ("--seed", "7")):
        done = run("page", *option, "--output", "page.html")
        check(done.code == 2 and "are for a scene" in done.err and not done.new, done.err)


def test_page_of_the_build_folder():
    """A build hands out the page in its own folder, if nobody else can write there; an installed command does not look
    beside itself."""
    page = '<html>"@given@"</html>'
    os.makedirs("build/src/cli")
    shutil.copy(GRAINGAS, "build/src/cli/graingas")
    with open("build/page.html", "w") as f:
        f.write(page)

    def asked():
        return subprocess.run(["build/src/cli/graingas", "page", "--output", "o.html"], capture_output=True, text=True)

    done = asked()
    check(done.returncode == 3 or open("o.html").read() != page.replace('"@given@"', "null"), done)  # no build folder
    open("build/build.ninja", "w").close()
    for path in "build", "build/page.html":
        os.chmod(path, 0o777)
        done = asked()
        check(done.returncode == 3 and "others can write there" in done.stderr, path, done)
        os.chmod(path, 0o755)
    done = asked()
    check(done.returncode == 0 and open("o.html").read() == page.replace('"@given@"', "null"), done)


def test_page_of_a_release():
    """A page that was downloaded is named; what is none is refused."""
    for name, text in ("page.html", '<html>"@given@"</html>'), ("other.html", "<html></html>"):
        with open(name, "w") as f:
            f.write(text)
    done = run("page", "scene.yaml", "--page", "page.html", "--output", "o.html", scene=GOOD)
    check(done.code == 0 and "usf" in open("o.html").read() and "@given@" not in open("o.html").read(), done)
    for name, words in ("other.html", "no page of graingas"), ("none.html", "none.html: cannot be read"):
        done = run("page", "--page", name, "--output", "p.html")
        check(done.code == 3 and words in done.err and not os.path.exists("p.html"), done)
    done = run("page", "--page", ".", "--output", "p.html")
    check(done.code != 0 and ".: is no file" in done.err and not done.new, done)


def test_flow_of_another_engine():
    refused("walls.ridges", 2, "run", "scene.yaml", "--engine", "dsmc", scene="{flow: poiseuille, phi: 0.3, walls: {ridges: 1}}\n")


def test_output_over_the_input():
    refused("scene.yaml: would be overwritten by its own result", 2, "run", "scene.yaml", "--output", "scene.yaml",
            scene=GOOD)
    check(open("scene.yaml").read() == GOOD)


def test_results_that_are_none():
    refused("rubbish.h5: cannot be read", 3, "plot", "rubbish.h5", scene="rubbish", name="rubbish.h5")
    refused("none.h5: cannot be read", 3, "plot", "none.h5")
    refused("none.h5: cannot be read", 3, "run", "scene.yaml", "--resume", "none.h5", scene=GOOD)


if __name__ == "__main__":
    main(sys.modules[__name__])
