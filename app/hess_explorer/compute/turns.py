"""What sessions ask for, handled outside the thread that serves: one thing of a session at a time, sessions in turn."""

from __future__ import annotations

import logging
import threading
from collections import deque
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

from hess_explorer.compute.budget import Abandoned, limited
from hess_explorer.compute.cores import CORES, queue_again
from hess_mechanics.numerics.parallel import THREADS

__all__ = ["MOST", "Turns"]

logger = logging.getLogger("hess_explorer")

MOST = 20
"""So many things may wait in a session; the page asks for one and waits for its answer."""

# One more than there are cores: one that takes long keeps no other waiting.  Many more would keep the thread that
# serves from its turns at the interpreter's lock.
_pool = ThreadPoolExecutor(max_workers=THREADS + 1, thread_name_prefix="turn")


def _nothing() -> None:
    """What waited has been forgotten."""


class Turns:
    """What one session has to do, in the order in which it was asked for."""

    def __init__(self) -> None:
        self._waiting: deque[Callable[[], None]] = deque(maxlen=MOST)
        self._lock = threading.Lock()
        self._working = False
        self._left = threading.Event()

    def take(self, work: Callable[[], None]) -> bool:
        """Do this when its turn comes; False where something that waited is forgotten for it."""
        with self._lock:
            if self._left.is_set():
                return True
            room = len(self._waiting) < MOST
            self._waiting.append(work)
            idle, self._working = not self._working, True
        if idle:
            CORES.answer(True)
            _pool.submit(self._one)
        return room

    def end(self) -> None:
        """Nobody waits any more: what has not begun is forgotten, what runs ends before its next computation."""
        with self._lock:
            self._left.set()
            self._waiting.clear()

    def _one(self) -> None:
        """Do one thing, then queue again where more waits."""
        with self._lock:
            work = self._waiting.popleft() if self._waiting else _nothing
        try:
            with limited(self._left):
                work()
        except Abandoned:
            pass
        # Whatever it is, what waits behind it in the session has its turn; the log says all.
        except Exception:
            logger.exception("a message could not be handled")
        with self._lock:
            self._working = bool(self._waiting)
            if not self._working:
                CORES.answer(False)
                return
        queue_again(_pool, self._one)
