"""Garbage is collected when nobody waits: a full collection stops all threads, for 1.2 s where 60 pages are open.

Most of what a page leaves is freed at once; collections are for objects that refer to each other in circles.  What has
survived is set aside every few seconds, so collections, Panel's own when a page has gone among them, go only through
what has been made since.  A full one comes when pages have gone and nobody asks for anything, or after ten minutes.
"""

from __future__ import annotations

import gc
import threading
import time
from collections.abc import Callable

__all__ = ["GARBAGE", "Garbage"]

PAUSE = 2.0
"""Seconds."""
OVERDUE = 600.0
"""Seconds after which all is collected under any load."""


class Garbage:
    """Of one process."""

    def __init__(self) -> None:
        self._pages_gone = False

    def page_gone(self, context: object) -> None:
        """A session has been destroyed: there may be circles to collect."""
        self._pages_gone = True

    def collect_when_quiet(
        self, asked: Callable[[], int], end: threading.Event, pause: float = PAUSE, overdue: float = OVERDUE
    ) -> None:
        """Collect until `end` is set; asked() : how many results have been asked for, so nobody does where it stays."""
        before, last = -1, time.monotonic()
        while not end.wait(pause):
            now = asked()
            quiet, before = now == before, now
            if (self._pages_gone and quiet) or time.monotonic() - last > overdue:
                self._pages_gone, last = False, time.monotonic()
                gc.unfreeze()
                gc.collect()
            else:
                # The young alone: hardly any time.
                gc.collect(1)
            gc.freeze()


GARBAGE = Garbage()
