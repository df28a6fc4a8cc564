# SPDX-License-Identifier: GPL-3.0-or-later
"""Progress of long calls: a bar by tqdm where it is installed, or a function of the caller."""
import sys

from . import _c, calls
from .structs import Record, values

ffi, lib = _c.ffi, _c.lib


@ffi.def_extern(error=0, onerror=lambda *_: None)
def ggpy_progress(context, progress):
    call = calls.of(context)
    report = Record(**values(progress))
    call.progress[report.engine] = report
    return 0


def fraction(call, engines):
    """Finished fraction of the whole call, from the fractions of its engines."""
    overall = [report.overall for report in call.progress.values() if hasattr(report, "overall")]
    if overall:
        return max(overall)
    return sum(report.fraction for report in call.progress.values()) / max(engines, len(call.progress), 1)


def _interactive():
    return sys.stderr.isatty() or hasattr(sys.modules.get("builtins"), "__IPYTHON__")


def _tqdm():
    """The class for a notebook with widgets, otherwise for a terminal; None without tqdm."""
    try:
        import ipywidgets  # noqa: F401
        from tqdm.auto import tqdm
    except ImportError:
        try:
            from tqdm import tqdm
        except ImportError:
            return None
    return tqdm


class Bar:
    """A bar from 0 to 1."""

    def __init__(self, engines=1, describe=None):
        self._engines, self._describe = engines, describe or describe_run
        form = "{desc}: {percentage:3.0f}%|{bar}| {elapsed}<{remaining}"
        kind = _tqdm()
        self._bar = kind(total=1.0, bar_format=form, leave=False) if kind else None

    def __call__(self, call):
        if self._bar is None:
            return
        part, words = self._describe(call, self._engines)
        self._bar.set_description_str(words, refresh=False)
        self._bar.update(max(0.0, part - self._bar.n))

    def close(self):
        if self._bar is not None:
            self._bar.close()


def describe_run(call, engines):
    words = ", ".join(f"{name} {report.phase}" for name, report in call.progress.items())
    return fraction(call, engines), words or "start"


class Reports:
    """Calls a function with every new report, in the thread that made the call."""

    def __init__(self, function):
        self._function, self._last = function, {}

    def __call__(self, call):
        for engine, report in list(call.progress.items()):
            if self._last.get(engine) is not report:
                self._last[engine] = report
                self._function(report)

    def close(self):
        pass


def reporter(progress, engines=1, describe=None):
    """progress: True, False, None (a bar in a terminal or notebook), or a function of a report."""
    if callable(progress):
        return Reports(progress)
    if progress or (progress is None and _interactive()):
        return Bar(engines, describe)
    return None
