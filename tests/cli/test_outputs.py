# SPDX-License-Identifier: GPL-3.0-or-later
"""An existing file, link, device or pipe at an output is written to, replaced by a whole file, or rejected before the run."""
import os
import re
import shlex
import shutil
import signal
import stat
import struct
import subprocess
import sys
import threading
import time
import zlib

from tap import GRAINGAS, PATIENCE, Skip, check, main, run

SCENE = ("flow: usf\nphi: 0.2\nparticles: 100\ncollision: {e: 0.9, beta: 0}\ndsmc: {particles: 500}\n"
         "run: {collisions: 20, warmup: 10}\n")
LONG = SCENE.replace("collisions: 20", "collisions: 1e9")
NOBODY = 65534


def everybody():
    """As whom to try: root can write where others cannot."""
    if os.geteuid() != 0:
        return [None]
    os.chmod(".", 0o777)
    try:
        reachable = subprocess.run([GRAINGAS, "--version"], capture_output=True, user=NOBODY).returncode == 0
    except PermissionError:  # the program lies below a folder of root's alone
        reachable = False
    return [None, NOBODY] if reachable else [None]


def written(*args, user=None, command="run", code=0):
    done = run(command, "scene.yaml", "--quiet", *args, user=user)
    check(done.code == code, done.code, done.err)
    return done


def refused(words, code, *args, user=None, command="run"):
    """Before the run, which would last for days, and with nothing left behind."""
    before = sorted(os.listdir("."))
    done = run(command, "long.yaml", *args, user=user, timeout=20)
    check(done.code == code and words in done.err, args, done.code, done.err)
    check(sorted(os.listdir(".")) == before, os.listdir("."))


def scenes():
    for name, scene in ("scene.yaml", SCENE), ("long.yaml", LONG):
        with open(name, "w") as f:
            f.write(scene)


def readable(path):
    done = run("info", path)
    check(done.code == 0, done.err)


def test_pipes_receive_outputs():
    scenes()
    os.mkfifo("pipe")
    os.chmod("pipe", 0o666)
    for user in everybody():
        refused("pipe: cannot be written: nobody reads from this pipe", 3, "--output", "pipe", user=user)
        got = []
        reader = threading.Thread(target=lambda: got.append(open("pipe", "rb").read()))
        reader.start()
        written("--output", "pipe", "--set", "output.trajectory_every=5", user=user)
        reader.join()
        with open("got.h5", "wb") as f:
            f.write(got[0])
        readable("got.h5")
        check(stat.S_ISFIFO(os.stat("pipe").st_mode))


def test_devices_remain():
    """Nodes of our own: a mistake here would cost the system its own."""
    scenes()
    try:
        for name, minor in ("null", 3), ("full", 7):
            os.mknod(name, 0o666 | stat.S_IFCHR, os.makedev(1, minor))
            os.chmod(name, 0o666)
        open("null", "w").close()
    except OSError as why:
        raise Skip(why)
    before = sorted(os.listdir("."))
    for command in "run", "compare":
        written("--output", "null", command=command)
        done = written("--output", "full", command=command, code=3)
        check("full: cannot be written: No space left on device" in done.err, done.err)
    check(sorted(os.listdir(".")) == before, os.listdir("."))
    check(all(stat.S_ISCHR(os.stat(name).st_mode) for name in ("null", "full")))
    refused("null keeps none", 2, "--output", "null", "--picture", "p.svg", command="compare")
    # A checkpoint is a file all the same, called as without --output.
    os.mkdir("there")
    child = subprocess.Popen([GRAINGAS, "run", "../long.yaml", "--quiet", "--output", "../null", "--set",
                              "output.checkpoint_every=0.01"], cwd="there", stdout=subprocess.DEVNULL,
                             stderr=subprocess.PIPE)
    wait_for("there/long.checkpoint.h5")
    child.send_signal(signal.SIGTERM)
    child.communicate(timeout=60 * PATIENCE)
    check(child.returncode == 130 and "long.checkpoint.h5" in os.listdir("there"), os.listdir("there"))


def test_standard_output():
    """Its own tables would be mixed with the file's bytes. Links of our own, as /dev has them: see test_devices."""
    scenes()
    for place, number in ("stdout", 1), ("stderr", 2):
        os.symlink(f"/proc/self/fd/{number}", place)
        refused("choose a file", 3, "--output", place)
    with open("table", "w") as table:
        done = subprocess.run([GRAINGAS, "run", "long.yaml", "--output", "table"], stdout=table, stderr=subprocess.PIPE)
    check(done.returncode == 3 and b"choose a file" in done.stderr, done.stderr)


def test_links_are_followed():
    scenes()
    os.mkdir("far")
    os.chmod("far", 0o777)
    os.symlink("far/result.h5", "link.h5")
    for user in everybody():
        for _ in range(2):  # to nowhere yet, and to a file
            written("--output", "link.h5", user=user)
            check(os.path.islink("link.h5") and os.listdir("far") == ["result.h5"], os.listdir("far"))
        readable("far/result.h5")
        os.remove("far/result.h5")
    os.symlink("nowhere/result.h5", "lost.h5")
    refused("lost.h5: cannot be written: No such file or directory", 3, "--output", "lost.h5")
    os.symlink("loop.h5", "loop.h5")
    refused("loop.h5: cannot be written: Too many levels", 3, "--output", "loop.h5")


def test_protected_files():
    scenes()
    for user in everybody():
        written("--output", "kept.h5", user=user)
        before = open("kept.h5", "rb").read()
        os.chmod("kept.h5", 0o444)
        refused("kept.h5: cannot be written: it is write-protected", 3, "--output", "kept.h5", user=user)
        check(open("kept.h5", "rb").read() == before)
        os.chmod("kept.h5", 0o640)
        written("--output", "kept.h5", user=user)
        check(stat.S_IMODE(os.stat("kept.h5").st_mode) == 0o640)
        os.remove("kept.h5")


def test_owner_is_kept():
    if os.geteuid() != 0:
        raise Skip("only root can give files away")
    scenes()
    written("--output", "theirs.h5")
    os.chown("theirs.h5", NOBODY, NOBODY)
    written("--output", "theirs.h5")
    check(os.stat("theirs.h5").st_uid == NOBODY)
    # Others' files are refused to those who may not write them, also where the folder would let them.
    os.chown("theirs.h5", 0, 0)
    for user in everybody()[1:]:
        refused("theirs.h5: cannot be written: Permission denied", 3, "--output", "theirs.h5", user=user)


def test_one_file_for_two():
    scenes()
    open("z.h5", "w").close()
    os.link("z.h5", "hard.svg")
    os.symlink("z.h5", "soft.svg")
    for picture in "z.h5", "./z.h5", "hard.svg", "soft.svg":
        refused("would be both the result and the picture", 2, "--output", "z.h5", "--picture", picture,
                command="compare")
    refused("would be both the result and the picture", 2, "--output", "new.svg", command="compare")
    refused("would be both the picture and the scene", 2, "--picture", "long.yaml", command="compare")
    refused("long.yaml: would be overwritten by its own result", 2, "--output", "./long.yaml")
    for output in "long.checkpoint.h5", "long.checkpoint.h5.1":
        refused("would be both the result and the checkpoint", 2, "--resume", "long.checkpoint.h5", "--output", output)
    os.symlink("a.checkpoint.frames", "frames.svg")
    refused("would be both the picture and the frames beside the checkpoint", 2, "--output", "a.h5", "--picture",
            "frames.svg", "--set", "output.checkpoint_every=1", command="compare")
    os.rename("long.yaml", "a.checkpoint.h5")
    done = run("run", "a.checkpoint.h5", "--output", "a.h5", "--set", "output.checkpoint_every=1", timeout=20)
    check(done.code == 2 and "would be both the checkpoint and the scene" in done.err, done.err)


def test_empty_names():
    scenes()
    refused("empty name", 2, "--output", "")
    refused("a picture needs a name", 2, "--picture", "", command="compare")
    refused("the name is empty", 3, "--resume", "")


def test_wrong_names_of_pictures_are_rejected():
    scenes()
    os.mkdir("folder.svg")
    os.mkfifo("pipe")
    for picture, code, words in (("none/x.svg", 3, "No such file or directory"), ("folder.svg", 3, "Is a directory"),
                                 ("q.eps", 2, "pictures are .svg, .png, .pdf or .gp, not .eps"),
                                 ("q", 2, "ends with .svg, .png, .pdf or .gp"),
                                 ("pipe", 2, "ends with .svg, .png, .pdf or .gp")):
        refused(words, code, "--picture", picture, command="compare")
    os.mkfifo("pipe.svg")
    refused("pictures are files", 3, "--picture", "pipe.svg", command="compare")
    written("--output", "z.h5")
    whole = open("z.h5", "rb").read()
    for picture in ("q.eps", "z.h5", "q.svg", "pipe.svg"):
        done = run("plot", "z.h5", "--output", picture, *(("--format", "png") if picture == "q.svg" else ()))
        check(done.code in (2, 3) and not done.new, picture, done.code, done.err)
    check(open("z.h5", "rb").read() == whole)


def test_pictures_for_paper():
    """PDF, as wide as asked for, of whatever a result has; a width that is none is refused before the run."""
    scenes()
    written("--output", "w.h5", "--set", "measure=[rheology, velocity_distributions]")
    done = run("plot", "w.h5", "--output", "w.pdf", "--width", "86mm")
    check(done.new == ["w.pdf", "w_snapshot.pdf", "w_velocity_distributions.pdf"], done.new, done.err)
    for name in done.new:
        with open(name, "rb") as f:
            data = f.read()
        box = re.search(rb"/MediaBox \[ *0 0 ([0-9.]+) ([0-9.]+)", data)
        check(data[:5] == b"%PDF-" and abs(float(box[1]) - 86 * 72 / 25.4) < 0.5, name, box)
    for width in "86", "8.6 km", "0mm", "nanmm":
        refused("mm, cm, in or pt, from 40mm to 1000mm", 2, "--picture", "q.pdf", "--width", width, command="compare")
    done = run("plot", "w.h5", "--format", "pdf", "--output", "v", "--quiet")
    check(done.code == 0 and "v" in done.new and "v_snapshot.pdf" in done.new, done.new, done.err)
    check(open("v", "rb").read(4) == b"%PDF")


def contents():
    """Bytes of all files in this folder."""
    kept = {}
    for name in sorted(os.listdir(".")):
        with open(name, "rb") as f:
            kept[name] = f.read()
    return kept


def untouched(words, code, *args, user=None):
    """Refused before anything ran or was drawn: every file is as it was."""
    before = contents()
    done = run(*args, user=user, timeout=20)
    check(done.code == code and words in done.err, args, done.code, done.err)
    check(contents() == before, args, os.listdir("."))


def test_pictures_beside_a_picture():
    """P_snapshot.svg and the pages of curves are outputs like all others, of `compare` ..."""
    scenes()
    untouched("would be both the result and a picture beside a.png", 2, "compare", "long.yaml", "--picture", "a.png",
              "--output", "a_snapshot.png")
    os.symlink("result.h5", "b_snapshot.svg")
    refused("would be both the result and a picture beside b.svg", 2, "--picture", "b.svg", "--output", "result.h5",
            command="compare")
    os.remove("b_snapshot.svg")
    shutil.copy("long.yaml", "p_snapshot.svg")
    shutil.copy("long.yaml", "p_dsmc_velocity_distributions.svg")
    os.link("p_dsmc_velocity_distributions.svg", "hard.yaml")
    measure = ("--set", "measure=[rheology, velocity_distributions]")
    for scene, picture in ("p_snapshot.svg", "p.svg"), ("p_snapshot.svg", "./p.svg"):
        untouched("would be both the scene and a picture beside", 2, "compare", scene, "--picture", picture, "--output",
                  "p.h5")
    for scene in "p_dsmc_velocity_distributions.svg", "hard.yaml":
        untouched("would be both the scene and a picture beside p.svg", 2, "compare", scene, "--picture", "p.svg",
                  "--output", "p.h5", *measure)
    os.remove("p_snapshot.svg")
    for name, role in (("q.checkpoint.h5", "the checkpoint"), ("q.checkpoint.h5.1", "the checkpoint before"),
                       ("q.checkpoint.frames", "the frames beside the checkpoint")):
        os.symlink(name, "p_snapshot.svg")
        refused(f"would be both {role} and a picture beside p.svg", 2, "--picture", "p.svg", "--output", "q.h5",
                "--set", "output.checkpoint_every=1", command="compare")
        os.remove("p_snapshot.svg")
    os.symlink("gone.h5", "p_snapshot.svg")
    refused("would be both the checkpoint to resume from and a picture beside p.svg", 2, "--picture", "p.svg",
            "--output", "q.h5", "--resume", "gone.h5", command="compare")
    os.remove("p_snapshot.svg")
    os.chmod("p_dsmc_velocity_distributions.svg", 0o444)
    for user in everybody():
        untouched("p_dsmc_velocity_distributions.svg: cannot be written: it is write-protected", 3, "compare",
                  "long.yaml", "--picture", "p.svg", "--output", "q.h5", *measure, user=user)
    written("--picture", "p.svg", "--output", "q.h5", command="compare")  # which has no such page
    check(os.path.exists("p_snapshot.svg"))


def test_pictures_beside_a_plot():
    """... and of `plot`."""
    scenes()
    written("--output", "b_snapshot.svg.h5", "--set", "measure=[rheology, velocity_distributions]")
    os.rename("b_snapshot.svg.h5", "b_snapshot.svg")
    untouched("would be both the result and a picture beside b.svg", 2, "plot", "b_snapshot.svg", "--output", "b.svg")
    for page in "r_snapshot.png", "r_velocity_distributions.png":
        shutil.copy("scene.yaml", page)
        os.chmod(page, 0o444)
        untouched(f"{page}: cannot be written: it is write-protected", 3, "plot", "b_snapshot.svg", "--output",
                  "r.png")
        os.remove(page)
    done = run("plot", "b_snapshot.svg", "--output", "r.png")
    check(done.code == 0, done.code, done.err)
    check(done.new == ["r.png", "r_snapshot.png", "r_velocity_distributions.png"], done.new)


def test_results_called_like_other_files():
    """A result with the name of a picture, table or text is rejected: no other scene or notes are overwritten."""
    scenes()
    shutil.copy("scene.yaml", "other.yaml")
    for command in "run", "compare":
        for output in "q.pdf", "o.svg", "o.png", "o.PNG", "o.csv", "notes.txt", "o.json", "other.yaml":
            untouched(f"{output}: results are HDF5: choose FILE.h5", 2, command, "long.yaml", "--output",
                      output, *(("--picture", "none") if command == "compare" else ()))


def test_names_that_are_commands():
    """File names with characters of gnuplot or the shell are names."""
    scenes()
    written("--output", "r.h5")
    for name in ("it's", "|touch harm #", "p\nsystem 'touch harm'\n", "`touch harm`", "phi_0.1"):
        os.link("r.h5", name + ".h5")
        done = run("plot", name + ".h5")
        check(done.code == 0 and sorted(done.new) == [name + ".svg", name + "_snapshot.svg"], name, done.new, done.err)
    os.symlink("other's.svg", "link.svg")
    done = run("plot", "r.h5", "--output", "link.svg")
    check(done.code == 0 and os.path.exists("other's.svg"), done.err)
    check("phi_0.2.svg" in run("compare", "scene.yaml", "--quiet", "--output", "phi_0.2").new)


def sealed(body):
    return body + b"gg-crc32" + struct.pack("<QI", len(body), zlib.crc32(body))


def test_texts_that_are_commands():
    """A result may come from anybody: what it says is drawn or refused, and not done by gnuplot."""
    scenes()
    written("--output", "r.h5", "--set", "measure=[rheology, velocity_distributions]", command="compare")
    whole = open("r.h5", "rb").read()
    body = whole[:whole.rindex(b"gg-crc32")]
    check(sealed(body) == whole)
    theory = body.replace(b'"gaussian_closure"', b'"`touch harm_abc`"')
    panel = re.sub(rb'"panel": "([^"]{20,})"', lambda m: b'"panel": "' + b"'\\n!touch harm\\n#".ljust(len(m[1])) + b'"', body)
    # Without engines ratios are to the first theory, whose name then stands beside the axis.
    alone = body.replace(b'"md": {', b'"m_": {').replace(b'"dsmc": {', b'"dsm_": {')
    first = b'"lun1991": {\n   "temperature": {\n    "mean"'
    name = rb'''"'\n!touch harm #":{"temperature":{'''
    axis = alone.replace(first, name.ljust(len(first) - 6) + b'"mean"')
    check(alone != body and axis != alone)
    for i, hostile in enumerate((theory, panel, axis)):
        check(hostile != body and len(hostile) == len(body), i)
        with open("h.h5", "wb") as f:
            f.write(sealed(hostile))
        done = run("plot", "h.h5")
        check(not [f for f in os.listdir(".") if f.startswith("harm")], i, done.code, done.err)
        named = "has a name that is not allowed" in done.err  # of a theory; texts are drawn
        check(done.code == (0 if hostile == panel else 3) and named == (hostile != panel), i, done.code, done.err)


def test_start_of_gnuplot_is_ours():
    """Start files of gnuplot change no picture; nor does a parent that ignores its children."""
    scenes()
    written("--output", "r.h5")
    with open(".gnuplot", "w") as f:
        f.write("set datafile separator ','\nset logscale y\n")
    check(run("plot", "r.h5", "--output", "a.svg").code == 0)
    done = subprocess.run([GRAINGAS, "plot", "r.h5", "--output", "b.svg", "--quiet"], env=dict(os.environ, HOME=os.getcwd()),
                          preexec_fn=lambda: signal.signal(signal.SIGCHLD, signal.SIG_IGN))
    check(done.returncode == 0 and open("a.svg").read() == open("b.svg").read())


def test_closed_streams():
    """Their numbers go to no file of ours."""
    scenes()
    for streams, code in (("<&- 2>&-", 0), ("<&-", 0), ("2>&-", 0), (">&- 2>&-", 3)):
        done = subprocess.run(["sh", "-c", f'"$0" run scene.yaml --output r.h5 {streams}', GRAINGAS], capture_output=True)
        check(done.returncode == code, streams, done.returncode)
        readable("r.h5")
        os.remove("r.h5")


def test_how_to_go_on():
    """The command printed after an interruption can be typed."""
    scenes()
    os.rename("long.yaml", "my long.yaml")
    keeps = ["--set", "output.checkpoint_every=0.02"]
    for words, expected in ((["my long.yaml", *keeps, "--output", "my.h5"], ["my.checkpoint.h5"]),
                            ([*keeps, "--output", "x.h5", "--", "my long.yaml"], ["x.checkpoint.h5", "--", "my long.yaml"])):
        child = subprocess.Popen([GRAINGAS, "run", "--quiet", *words], stderr=subprocess.PIPE, stdout=subprocess.DEVNULL)
        wait_for(words[words.index("--output") + 1].replace(".h5", ".checkpoint.h5"))
        child.send_signal(signal.SIGINT)
        said = child.communicate(timeout=60 * PATIENCE)[1].decode()
        again = shlex.split(said.split("continue with: ")[1].splitlines()[0])
        before = [GRAINGAS, "run", "--quiet", *words]
        there = before.index("--") if "--" in before else len(before)
        check(again == before[:there] + ["--resume", expected[0]] + before[there:], said)


def test_picture_that_fails():
    """Asked for, and not there: the exit code says so, and the results are kept."""
    scenes()
    os.mkdir("empty")
    environment = dict(os.environ, PATH=os.path.abspath("empty"))
    for asked, code in (["--picture", "p.svg"], 1), ([], 0):
        done = subprocess.run([GRAINGAS, "compare", "scene.yaml", "--quiet", *asked], env=environment,
                              capture_output=True, text=True)
        check(done.returncode == code and "gnuplot is not installed" in done.stderr, done.returncode, done.stderr)
        readable("scene.compare.h5")


def wait_for(path):
    deadline = time.monotonic() + 60 * PATIENCE
    while not os.path.exists(path) and time.monotonic() < deadline:
        time.sleep(0.01)
    check(os.path.exists(path), path, "does not come")


def started(*args):
    return subprocess.Popen([GRAINGAS, "run", "long.yaml", "--quiet", *args], stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE)


def ended(child, sig):
    child.send_signal(sig)
    child.communicate(timeout=60 * PATIENCE)


def test_two_runs_at_once():
    """The second is refused, and the first named; a dead one is in nobody's way, and what it left goes."""
    scenes()
    first = started("--output", "one.h5")
    wait_for("one.h5.graingas-lock")
    wait_for("one.h5.graingas-tmp")  # made after the lock; the folder's listings are compared from here on
    os.symlink("one.h5", "link.h5")
    for output in "one.h5", "link.h5":
        refused(f"{output}: cannot be written: another process is writing it (process {first.pid} on ", 3, "--output", output)
    refused("is writing it", 3, "--output", "one.h5", command="compare")
    ended(first, signal.SIGKILL)
    check("one.h5.graingas-tmp" in os.listdir("."), os.listdir("."))
    written("--output", "one.h5")
    check(sorted(os.listdir(".")) == ["link.h5", "long.yaml", "one.h5", "scene.yaml"], os.listdir("."))


def test_locks_of_others():
    """Files left by another user's dead run do not block a run."""
    scenes()
    for mode in 0o777, 0o1777:  # in a folder like /tmp nobody may remove it
        for user in everybody():
            os.chmod(".", mode)
            with open("one.h5.graingas-lock", "w") as f:
                f.write("process 1 on nowhere\n")
            written("--output", "one.h5", user=user)
            readable("one.h5")
            os.remove("one.h5")
            if os.path.exists("one.h5.graingas-lock"):
                check(mode == 0o1777 and user)
                os.remove("one.h5.graingas-lock")


def test_one_checkpoint_for_two():
    scenes()
    keep = ("--set", "output.checkpoint_every=0.01")
    first = started(*keep)
    wait_for("long.checkpoint.h5.1")
    ended(first, signal.SIGKILL)
    resume = (*keep, "--resume", "long.checkpoint.h5")
    first = started(*resume)
    deadline = time.monotonic() + 60 * PATIENCE
    while f"process {first.pid} " not in open("long.h5.graingas-lock").read() and time.monotonic() < deadline:
        time.sleep(0.01)  # until then it is the dead one's
    done = run("run", "long.yaml", "--quiet", *resume, timeout=20)
    check(done.code == 3 and f"another process is writing it (process {first.pid} on " in done.err, done.code, done.err)
    ended(first, signal.SIGTERM)
    check(first.returncode == 130, first.returncode)
    left = [name for name in os.listdir(".") if "graingas" in name]
    check(not left, left)


def of_hours(path):
    """The same result, said to have taken longer than it did."""
    with open(path, "rb") as f:
        body = f.read()
    body = re.sub(rb'("cpu_seconds": ?)([0-9.e-]{6,})', lambda m: m[1] + b"9000.".ljust(len(m[2]), b"0"),
                  body[:body.rindex(b"gg-crc32")])
    with open(path, "wb") as f:
        f.write(sealed(body))


def test_what_took_long_is_named():
    """A result that is replaced, before it is; and a comparison does not replace a run."""
    scenes()
    for command, result, what in ("run", "scene.h5", "run"), ("compare", "scene.compare.h5", "comparison"):
        again = (command, "scene.yaml", "--quiet", "--set", "output.checkpoint_every=0")
        done = run(*again)
        check(done.code == 0 and result in done.new and "scene.h5" in os.listdir("."), done.err, done.new)
        check("replaced" not in run(*again).err)
        of_hours(result)
        said = run(*again).err
        check(f"warning: {result} holds a {what} of " in said and " h of processor time from 2" in said, said)


def test_checkpoints_go_when_all_is_done():
    """A run that is done removes its checkpoints and the one that it resumed from. An interrupted or incomplete run
    keeps them."""
    scenes()
    keep = ("--set", "output.checkpoint_every=0.001")
    for command, result in ("run", "scene"), ("compare", "scene.compare"):
        there = [result + ".checkpoint.h5", result + ".checkpoint.h5.1"]
        short = ("--set", "run.collisions=1e9", "--set", "run.time_limit=0.5")
        done = run(command, "scene.yaml", "--quiet", *keep, *short)
        check(done.code == 1, done.code, done.err)
        check([name for name in there if os.path.exists(name)] == there, os.listdir("."))
        done = run(command, "scene.yaml", "--quiet", "--set", "run.collisions=20", "--resume", there[command == "run"],
                   "--set", "output.checkpoint_every=1000", "--output", result + ".h5")
        check(done.code == 0, done.code, done.err)
        check(os.path.exists(result + ".h5") and not any(os.path.exists(name) for name in there), os.listdir("."))


if __name__ == "__main__":
    main(sys.modules[__name__])
