# SPDX-License-Identifier: GPL-3.0-or-later
"""Long calls: without Python's lock, in a thread, interruptible.

The main thread waits on an Event, never in Thread.join: before Python 3.12 an interrupted join takes the thread for
dead. Ctrl-C sets an integer that the library reads several times a second without Python. Calls that change nothing
are then left running in their thread (left_behind)."""
import threading

from . import _c
from .errors import exception, new_error

ffi, lib = _c.ffi, _c.lib

PERIOD = 0.1  # seconds between two reports of progress


class Call:
    """The object that the callbacks of one call share; its `c` is their context."""

    def __init__(self):
        self.c = ffi.new("ggpy_call *")
        self._handle = ffi.new_handle(self)
        self.c.self = self._handle
        self.error = None  # the first exception of a callback
        self.interrupted = False
        self.progress = {}  # the last report of each engine
        self.warnings = []
        self.lines = []
        self.events = []
        self.keep = []  # texts and arrays that the library reads during the call

    def stop(self):
        self.c.stop = 1

    @property
    def stopping(self):
        """The library's callback that requests a stop, and its context."""
        return ffi.addressof(lib, "ggpy_stop"), self.c

    def fail(self, error):
        """An exception of a callback: the call ends, and raises it."""
        if self.error is None:
            self.error = error
        self.stop()

    def interrupt(self):
        self.interrupted = True
        self.stop()


def of(context):
    """The Call behind the context of a callback."""
    return ffi.from_handle(ffi.cast("ggpy_call *", context).self)


class _Task:
    def __init__(self, function, call):
        self.function, self.first = function, threading.Lock()
        self.call = call  # lives as long as the thread
        self.value = self.error = None
        self.ended, self.running = False, threading.Lock()  # held until the work has ended
        self.running.acquire()

    def wait(self):
        """Waits for the end, for PERIOD at most; returns whether it came. Not by threading.Event: a Ctrl-C inside its
        wait can leave its lock released twice, and the thread that sets it then fails.
        """
        if not self.ended and self.running.acquire(timeout=PERIOD):
            self.running.release()
        return self.ended

    def cancel(self):
        """Prevents work that has not begun, and returns whether it did. A thread may begin after the Ctrl-C that came
        as it started.
        """
        return self.first.acquire(blocking=False)

    def work(self):
        if not self.first.acquire(blocking=False):
            return
        try:
            self.value = self.function()
        except BaseException as error:
            self.error = error
        finally:
            self.ended = True
            self.running.release()


def interruptible(function, call, poll=None):
    """Runs function() in a thread, and poll(call) ten times a second meanwhile. Returns its value; raises exceptions of
    callbacks and of poll. Ctrl-C stops the call and sets call.interrupted."""
    task = _Task(function, call)
    thread = threading.Thread(target=task.work, daemon=True, name="graingas")
    started = False
    while not task.ended:
        try:
            if not started:
                started = True
                thread.start()
            if not task.wait() and poll:
                poll(call)
        except KeyboardInterrupt:
            call.interrupt()
            if task.cancel():
                raise
        except BaseException as error:
            call.fail(error)
            if task.cancel():
                raise
    return _outcome(task, call)


def finished(function, call, words):
    """Runs function(error), a long call of the library; raises the error that it reports. words: text of
    KeyboardInterrupt.
    """
    error = new_error()
    status = interruptible(lambda: function(error), call)
    if call.interrupted:
        raise KeyboardInterrupt(words)
    if status != lib.GG_OK:
        raise exception(status, error)


def left_behind(function, call=None, words=""):
    """Runs function() in a thread that Ctrl-C does not wait for: KeyboardInterrupt(words) comes at once, call (if any)
    is stopped, and the value of the thread is dropped. For functions that only read, or make something new.
    """
    task = _Task(function, call)
    if threading.current_thread() is not threading.main_thread():  # Ctrl-C comes to the main thread alone
        task.work()
        return _outcome(task, call)
    try:
        threading.Thread(target=task.work, daemon=True, name="graingas").start()
        while not task.wait():  # with a limit: a signal just before a wait without end would be handled late
            pass
    except KeyboardInterrupt:
        if call is not None:
            call.interrupt()
        raise KeyboardInterrupt(words) from None
    return _outcome(task, call)


def _outcome(task, call):
    if call is not None and call.error is not None:
        raise call.error
    if task.error is not None:
        raise task.error
    return task.value


@ffi.def_extern(onerror=lambda *_: None)
def ggpy_warn(context, message):
    of(context).warnings.append(ffi.string(message).decode("utf-8", "replace"))


@ffi.def_extern(onerror=lambda *_: None)
def ggpy_line(context, message):
    of(context).lines.append(ffi.string(message).decode("utf-8", "replace"))
