# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs: the command's numbers, progress, threads, Ctrl-C, checkpoints, files, processes."""
import json
import math
import os
import signal
import struct
import subprocess
import threading
import time
import zlib
from concurrent.futures import ProcessPoolExecutor, ThreadPoolExecutor
import multiprocessing

import numpy as np
import pytest

import graingas as gg


def means(result):
    return {name: estimate.mean for name, estimate in result.items()}


def test_no_output_replaces_the_scene(short):
    """No output replaces the scene's file, also under another name of the file, or that of a copy."""
    text = short.to_yaml()
    with open("s.yaml", "w", encoding="utf-8") as file:
        file.write(text)
    scene = gg.Scene("s.yaml")
    for call in (lambda: gg.run("s.yaml", output="./s.yaml"), lambda: gg.run(scene.copy(e=0.8), output="s.yaml"),
                 lambda: gg.compare(gg.Scene(scene), checkpoint=os.path.abspath("s.yaml"))):
        with pytest.raises(gg.BadInput, match="the scene"):
            call()
    with open("s.yaml", encoding="utf-8") as file:
        assert file.read() == text


def test_numbers_are_those_of_the_command(short):
    with open("s.yaml", "w", encoding="utf-8") as file:
        file.write(short.to_yaml())
    command = [os.environ["GRAINGAS"], "run", "s.yaml", "--json", "--quiet", "--output", "s.h5"]
    done = subprocess.run(command, capture_output=True, text=True)
    quantities = json.loads(done.stdout)["results"]
    result = gg.run("s.yaml", output="t.h5")
    for name, mean in means(result).items():
        assert mean == pytest.approx(quantities[name]["mean"], rel=1e-14), name
    assert means(gg.read("t.h5")) == means(gg.read("s.h5")) == means(result)


def test_keys_change_the_scene(short):
    """Keys of a call are those of a copy of the scene, which stays as it is."""
    other = short.copy(e=0.7)
    assert means(gg.run(short, e=0.7)) == means(gg.run(other)) != means(gg.run(short))
    assert gg.compare(short, e=0.7)["temperature"].md.mean == gg.compare(other)["temperature"].md.mean
    assert gg.theory(short, "gaussian_closure", e=0.7)["temperature"] == gg.theory(other, "gaussian_closure")["temperature"]
    assert gg.theories(short, e=0.7)["temperature"].theory == gg.theories(other)["temperature"].theory
    assert short.e != 0.7
    with pytest.raises(gg.BadInput, match="no such key"):
        gg.run(short, tempersture=1)


def test_threads_and_seeds(short):
    short["run.replicas"] = 3
    one = means(gg.run(short))
    assert one == means(gg.run(short, threads=2)) == means(gg.run(short, threads=None))
    assert one != means(gg.run(short.copy(seed=2)))


def test_two_runs_side_by_side(short):
    with ThreadPoolExecutor(2) as pool:
        both = list(pool.map(lambda seed: means(gg.run(short.copy(seed=seed))), (1, 2)))
    assert both == [means(gg.run(short.copy(seed=seed))) for seed in (1, 2)]


def test_processes_give_the_same_numbers(short):
    with ProcessPoolExecutor(2, mp_context=multiprocessing.get_context("spawn")) as pool:
        results = list(pool.map(gg.run, [short, short.copy(seed=2)]))
    assert means(results[0]) == means(gg.run(short))
    assert means(results[1]) != means(results[0])


def interrupt_after(seconds):
    sent = []

    def send():
        sent.append(time.monotonic())
        os.kill(os.getpid(), signal.SIGINT)
    timer = threading.Timer(seconds, send)
    timer.start()
    return sent


def interrupt_with_means(engines):
    """A function for progress that sends SIGINT as soon as that many engines have means with errors; and the time of
    sending.
    """
    known, sent = set(), []

    def progress(report):
        if math.isfinite(report.relative_error):
            known.add(report.engine)
        if len(known) == engines and not sent:
            sent.append(time.monotonic())
            os.kill(os.getpid(), signal.SIGINT)
    return progress, sent


@pytest.mark.parametrize("function", [gg.run, gg.compare])
def test_interrupted_run_keeps_what_there_is(endless, function):
    endless.particles, endless["dsmc.particles"] = 200, 500
    progress, sent = interrupt_with_means(1 if function is gg.run else 2)
    with pytest.warns(gg.PartialResult):
        result = function(endless, threads=2, progress=progress)
    assert time.monotonic() - sent[0] < 0.5  # 0.02 s on an idle machine
    assert "interrupted" in result.partial
    md = result.md if function is gg.compare else result
    assert md["temperature"].mean > 0


def test_interrupted_before_anything_is_there(endless):
    endless.particles = 2000000
    interrupt_after(0.4)
    with pytest.raises(KeyboardInterrupt):
        gg.run(endless)


def test_interrupted_run_can_be_resumed(short):
    short["run.collisions"] = 3000
    whole = means(gg.run(short))
    interrupt_after(0.3)
    with pytest.warns(gg.PartialResult):
        gg.run(short, checkpoint="c.h5")
    assert means(gg.run(short, resume="c.h5")) == whole


def test_checkpoint_of_another_build(short):
    h5py = pytest.importorskip("h5py")
    short["run.collisions"] = 60000
    interrupt_after(0.5)
    with pytest.warns(gg.PartialResult):
        gg.run(short, checkpoint="c.h5")
    short["run.collisions"] = 100
    with h5py.File("c.h5", "r+") as file:
        file["checkpoint/version"].attrs["identity"] = np.bytes_("another")
    with open("c.h5", "r+b") as file:  # its checksum
        content = file.read()
        file.write(b"gg-crc32" + struct.pack("<QI", len(content), zlib.crc32(content)))
    with pytest.raises(gg.BadFile, match=r"--accept-version \(in programs accept_version\)"):
        gg.run(short, resume="c.h5")
    assert gg.run(short, resume="c.h5", accept_version=True)["temperature"].mean > 0


def test_ended_before_its_criteria():
    s = gg.Scene(flow="usf", phi=0.1, particles=200, run={"relative_error": 1e-5, "time_limit": 0.5})
    with pytest.warns(gg.PartialResult):
        result = gg.run(s)
    assert result.partial and result["temperature"].mean > 0


def test_progress_is_reported_in_this_thread(endless):
    seen = []

    def report(r):
        assert threading.current_thread() is threading.main_thread()
        seen.append(r)
        if len(seen) == 3:
            raise LookupError("enough")
    with pytest.raises(LookupError, match="enough"):
        gg.run(endless, progress=report)
    assert seen[-1].engine == "md" and 0 <= seen[0].fraction <= seen[-1].fraction <= 1


def test_bar_is_shown_on_request(short, capsys):
    pytest.importorskip("tqdm")
    short["run.collisions"] = 2000
    gg.run(short, progress=True)
    assert "md" in capsys.readouterr().err
    short["run.collisions"] = 300
    gg.run(short, progress=False)
    assert capsys.readouterr().err == ""


def test_failures_raise_their_exceptions(short, endless):
    with pytest.raises(gg.BadInput, match="phi is missing"):
        gg.run("flow: usf")
    with pytest.raises(gg.BadFile):
        gg.run(short, output="no/such/folder.h5")
    with pytest.raises(gg.RunFailed, match="memory"):
        gg.run(gg.Scene(flow="usf", phi=0.1, particles=100000000, run={"replicas": 1000}))
    with pytest.raises(gg.BadFile):
        gg.read("nowhere.h5")


def test_warnings_are_pythons(short):
    short["walls.speed"] = 2
    with pytest.warns(UserWarning, match="walls.speed"):
        gg.run(short)
