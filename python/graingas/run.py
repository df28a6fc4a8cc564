# SPDX-License-Identifier: GPL-3.0-or-later
"""Runs and comparisons, until the scene's stopping criteria are met."""
from __future__ import annotations

import os
import warnings
from contextlib import contextmanager
from typing import Callable, Optional, Union

from . import _c, calls
from .arguments import whole
from .comparison import Comparison, read_comparison
from .errors import BadFile, BadInput, PartialResult, check, encode, exception, lib, new_error, text
from .progress import reporter
from .result import Result, read_result
from .scene import Scene, as_scene
from .structs import new

ffi = _c.ffi


@contextmanager
def serving(scene, call):
    """The callbacks of a scene's observables, theories and law report their exceptions to this call."""
    for extension in scene._extensions:
        extension.calls.append(call)
    try:
        yield
    finally:
        for extension in scene._extensions:
            extension.calls.remove(call)


@contextmanager
def reporting(progress, engines=1, describe=None):
    report = reporter(progress, engines, describe)
    try:
        yield report
    finally:
        if report is not None:
            report.close()


def thread_count(threads):
    """A number of threads; None: all processors."""
    if threads is None:
        return lib.gg_processors()
    return whole(threads, "threads", 1, 10000, "a whole number from 1 to 10000, or None for all")


def _options(call, threads, accept_version, files):
    """The struct of options; call.keep has the objects that have to outlive it."""
    options = new("gg_run_options")
    options.threads, options.accept_version = thread_count(threads), bool(accept_version)
    options.context, options.stop = call.c, ffi.addressof(lib, "ggpy_stop")
    options.progress, options.warn = lib.ggpy_progress, lib.ggpy_warn
    call.keep.append(ffi.new("char[]", b"graingas (Python)"))
    options.command = call.keep[-1]
    for name, path in files.items():
        if path is not None:
            call.keep.append(ffi.new("char[]", encode(path, name)))
            setattr(options, name, call.keep[-1])
    return options


def _finish(call, status, error, made):
    """The result of a run, whole or partial; or the exception."""
    for line in call.warnings:
        warnings.warn(line, stacklevel=4)
    failure = None if status == lib.GG_OK else exception(status, error)
    if made is None:
        raise KeyboardInterrupt(str(failure)) if call.interrupted else failure
    if failure is None:
        return made
    made.partial = str(failure)
    if status not in (lib.GG_FAILED, lib.GG_INTERRUPTED):
        failure.result = made
        raise failure
    warnings.warn(made.partial, PartialResult, stacklevel=4)
    return made


def _state_of(result):
    """The checkpoint beside a result."""
    return os.path.splitext(result)[0] + ".checkpoint.h5" if str(result).endswith(".h5") else f"{result}.checkpoint.h5"


def _long_run(function, kind, engines, scene, keys, threads, progress, accept_version, files):
    scene = as_scene(scene).copy(**keys)
    if scene["output.state"] == "kept" and files["output"] and not files["checkpoint"]:
        files = {**files, "checkpoint": _state_of(os.fspath(files["output"]))}
    call, error = calls.Call(), new_error()
    options = _options(call, threads, accept_version, {**files, "input": scene._file})
    made = ffi.new(kind + " **")
    with serving(scene, call), reporting(progress, engines) as report:
        with scene.held() as pointer:
            status = calls.interruptible(lambda: function(pointer, options, made, error), call, report)
    wrap = Comparison if engines == 2 else Result
    return _finish(call, status, error, wrap(made[0], scene=scene) if made[0] != ffi.NULL else None)


def run(scene, threads: Optional[int] = 1, output=None, checkpoint=None, resume=None,
        progress: Union[bool, None, Callable] = None, accept_version: bool = False, **keys) -> Result:
    """Runs the scene's engine until its stopping criteria are met; returns a Result.

    scene        a Scene, a file name, YAML text, or a dict
    keys         keys of the scene to change: run(s, e=0.8, phi=0.3)
    threads      for replicas and large Monte Carlo ensembles; None: all processors. Results do not depend on it.
    output       result file to write (HDF5); a run that Ctrl-C ends writes none: result.write(path) does
    checkpoint   file to keep checkpoints in; the run writes one when it is interrupted
    resume       checkpoint to continue from, bit for bit
    progress     True, False, None (a bar in a terminal or notebook), or a function of a report
    accept_version
                 also resume a checkpoint of another build of graingas, whose numbers may differ

    Ctrl-C ends the run within 0.1 s (a million grains of md: 0.2 s) and returns what there is, with a warning
    PartialResult and `partial` set; a run that ends before its criteria likewise. Raises BadInput, BadFile,
    RunFailed, and exceptions of callbacks.
    """
    return _long_run(lib.gg_run, "gg_result", 1, scene, keys, threads, progress, accept_version,
                     {"output": output, "checkpoint": checkpoint, "resume": resume})


def compare(scene, threads: Optional[int] = 1, output=None, checkpoint=None, resume=None,
            progress: Union[bool, None, Callable] = None, accept_version: bool = False, **keys) -> Comparison:
    """Runs both engines and evaluates every theory; returns a Comparison. Parameters and errors are those of run()."""
    return _long_run(lib.gg_compare, "gg_comparison", 2, scene, keys, threads, progress, accept_version,
                     {"output": output, "checkpoint": checkpoint, "resume": resume})


def extend(result, threads: Optional[int] = 1, output=None, progress: Union[bool, None, Callable] = None,
           accept_version: bool = False, **keys) -> Union[Result, Comparison]:
    """Continues a finished run or comparison to other stopping criteria: extend("usf.h5", relative_error=0.001).

    result       its file, of a scene with output.state: kept; its state is beside it (usf.checkpoint.h5 for usf.h5)
    keys         keys to change: stopping criteria (run.relative_error, run.until, run.collisions, run.time_limit) and output
    output       file of the new result; by default it takes the place of the old one
    threads, progress, accept_version: as of run()

    The numbers are, bit for bit, those of a run that had these criteria from the start; a warning of the result says where
    they may differ. Raises BadFile if no state was kept.
    """
    result = os.fspath(result)
    state, made, error = _state_of(result), ffi.new("gg_scene **"), new_error()
    if not os.path.exists(state):
        raise BadFile(f"{result}: has no state to continue from: {state} is not there (it stays after a run of a scene with "
                      "output.state: kept)")
    info = ffi.new("gg_checkpoint_info *")
    if os.path.exists(result):
        check(lib.gg_checkpoint_check_result, encode(state, "file name"), encode(result, "file name"))
    status = lib.gg_checkpoint_about(encode(state, "file name"), info, made, error)
    if status != lib.GG_OK:
        raise exception(status, error)
    scene = Scene._from_pointer(made[0])
    work = compare if text(info.kind) == "comparison" else run
    return work(scene, threads=threads, output=output or result, resume=state, progress=progress,
                accept_version=accept_version, **keys)


def _read(path):
    try:
        return read_result(path)
    except BadInput as error:
        if "gg_comparison_read" not in str(error):
            raise
        return read_comparison(path)


def read(path) -> Union[Result, Comparison]:
    """A result file: a Result of one engine's run, or a Comparison. Raises BadFile. Warns
    if another program has changed it."""
    found = calls.left_behind(lambda: _read(path))
    notice = ffi.new("char[]", 1024)
    check(lib.gg_result_file_notice, encode(path, "file name"), notice, len(notice))
    if text(notice):
        warnings.warn(text(notice), stacklevel=2)
    return found
