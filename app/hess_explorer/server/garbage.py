"""Run garbage collection when the server is idle: a full collection stops all threads, for 1.2 s with 60 open pages.

Reference counting frees most objects of a page at once; the collector is needed only for reference cycles.  Surviving
objects are frozen every few seconds, so that collections (including Panel's own, when a page closes) only traverse
newer objects.  A full collection runs when pages have closed and no requests arrive, or after ten minutes.
"""

from __future__ import annotations

import gc
import threading
import time
from collections.abc import Callable

__all__ = ["GARBAGE", "Garbage"]

PAUSE = 2.0
"""Seconds between two collections."""
OVERDUE = 600.0
"""Seconds after which a full collection runs under any load."""


class Garbage:
    """Schedules the garbage collections of one process."""

    def __init__(self) -> None:
        self._pages_gone = False

    def page_gone(self, context: object) -> None:
        """Record that a session was destroyed, which may leave reference cycles."""
        self._pages_gone = True

    def collect_when_quiet(
        self, asked: Callable[[], int], end: threading.Event, pause: float = PAUSE, overdue: float = OVERDUE
    ) -> None:
        """Collect garbage periodically until `end` is set; asked : returns the number of cache lookups so far."""
        before, last = -1, time.monotonic()
        while not end.wait(pause):
            now = asked()
            quiet, before = now == before, now
            if (self._pages_gone and quiet) or time.monotonic() - last > overdue:
                self._pages_gone, last = False, time.monotonic()
                gc.unfreeze()
                gc.collect()
            else:
                # Only the young generations, which takes hardly any time.
                gc.collect(1)
            gc.freeze()


GARBAGE = Garbage()
