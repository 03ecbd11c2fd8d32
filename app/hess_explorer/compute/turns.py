"""What sessions ask for, handled outside the thread that serves: one thing of a session at a time, sessions in turn.

Turns are fair in seconds of the processor, not in number: start-time fair queueing (Goyal, Vin and Cheng, 1996).  What
a session asks for is tagged with the time at which its last thing would have ended, had it had its share and no more;
the least tag comes first.  So who asks for what takes long waits for the others, and they hardly wait for that one.
"""

from __future__ import annotations

import heapq
import itertools
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


class _Order:
    """Whose turn is next.  Times are seconds of the processor that a session with its share has had."""

    def __init__(self) -> None:
        self._waiting: list[tuple[float, int, Callable[[float], None]]] = []
        self._number = itertools.count()
        self._now = 0.0
        self._lock = threading.Lock()

    def enter(self, ended: float, one: Callable[[float], None]) -> None:
        """Call one(begins) in its turn; ended : of the same session's last thing."""
        with self._lock:
            # Of things that begin at the same time the first comes first.
            heapq.heappush(self._waiting, (max(ended, self._now), next(self._number), one))
        queue_again(_pool, self._next)

    def _next(self) -> None:
        with self._lock:
            begins, _, one = heapq.heappop(self._waiting)
            self._now = max(self._now, begins)
        one(begins)


_order = _Order()


def _nothing() -> None:
    """What waited has been forgotten."""


class Turns:
    """What one session has to do, in the order in which it was asked for."""

    def __init__(self) -> None:
        self._waiting: deque[Callable[[], None]] = deque(maxlen=MOST)
        self._lock = threading.Lock()
        self._working = False
        self._ended = 0.0
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
            _order.enter(self._ended, self._one)
        return room

    def end(self) -> None:
        """Nobody waits any more: what has not begun is forgotten, what runs ends before its next computation."""
        with self._lock:
            self._left.set()
            self._waiting.clear()

    def _one(self, begins: float) -> None:
        """Do one thing, then wait for another turn where more waits."""
        with self._lock:
            work = self._waiting.popleft() if self._waiting else _nothing
        with limited(self._left) as budget:
            try:
                work()
            except Abandoned:
                pass
            # Whatever it is, what waits behind it in the session has its turn; the log says all.
            except Exception:
                logger.exception("a message could not be handled")
        with self._lock:
            self._ended = begins + budget.spent
            self._working = bool(self._waiting)
            if not self._working:
                CORES.answer(False)
                return
        _order.enter(self._ended, self._one)
