# SPDX-License-Identifier: GPL-3.0-or-later
"""Handles of the library: freed once, never used after that, used by one call at a time."""
import threading
from contextlib import contextmanager

from . import _c, calls
from .errors import BadInput, Busy

ffi = _c.ffi

LEFT = 60  # seconds to wait for a call that still runs after Ctrl-C


class Handle:
    """Owns a pointer. `held` gives it to one thread at a time."""

    def __init__(self, pointer, free, what):
        self._pointer, self._what = ffi.gc(pointer, free), what
        self._lock = threading.Lock()
        self._left = []  # the end events of calls that still run after Ctrl-C

    @contextmanager
    def held(self, patience=0):
        """The pointer, for the duration of a call. patience: seconds to wait for another thread."""
        if not all(ended.is_set() for ended in self._left):
            patience = LEFT
        if not (self._lock.acquire(timeout=patience) if patience else self._lock.acquire(blocking=False)):
            raise Busy(f"this {self._what} is in use by another thread, or by the call whose callback uses it; "
                       f"use it after that call, or use another one")
        try:
            if self._pointer is None:
                raise BadInput(f"this {self._what} is closed")
            yield self._pointer
        finally:
            self._lock.release()

    def read(self, function, patience=0, call=None):
        """Runs function(pointer), which changes nothing, in a thread. Ctrl-C does not wait for it and stops call (if
        any); later calls wait for its end.
        """
        ended = threading.Event()

        def work():
            try:
                with self.held(patience) as pointer:
                    return function(pointer)
            finally:
                ended.set()
        try:
            return calls.left_behind(work, call)
        except KeyboardInterrupt:
            self._left = [other for other in self._left if not other.is_set()] + [ended]
            raise

    def close(self):
        """Frees the memory. Later calls raise BadInput; closing twice does nothing."""
        if self._pointer is None:
            return
        with self.held() as pointer:
            self._pointer = None
            ffi.release(pointer)

    @property
    def closed(self):
        return self._pointer is None
