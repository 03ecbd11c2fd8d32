"""The scheduler of requests: computed outside the thread that serves, one of a session at a time, fairly for all.

Fair in processor time, not in number: start-time fair queueing (Goyal, Vin and Cheng, 1996).  A request is tagged with
the time at which the session's last one would have ended, had the session had its share and no more; the least tag
comes first.  So a session whose requests take long waits for the others, and they hardly wait for it.
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

__all__ = ["MOST", "RequestQueue"]

logger = logging.getLogger("hess_explorer")

MOST = 20
"""The most requests that wait in a session: a page sends one and waits for its answer."""

# One thread more than there are cores: one that takes long keeps no other waiting.  Many more would keep the thread
# that serves from the interpreter's lock.
_pool = ThreadPoolExecutor(max_workers=THREADS + 1, thread_name_prefix="request")


class _Scheduler:
    """Which session is next.  Times are seconds of the processor that a session with its share has had."""

    def __init__(self) -> None:
        self._waiting: list[tuple[float, int, Callable[[float], None]]] = []
        self._number = itertools.count()
        self._now = 0.0
        self._lock = threading.Lock()

    def put(self, ended: float, run: Callable[[float], None]) -> None:
        """Call run(start) when it is next; ended : when the last request of the same session did."""
        with self._lock:
            # Of those that start at the same time the first comes first.
            heapq.heappush(self._waiting, (max(ended, self._now), next(self._number), run))
        queue_again(_pool, self._next)

    def _next(self) -> None:
        with self._lock:
            start, _, run = heapq.heappop(self._waiting)
            self._now = max(self._now, start)
        run(start)


_scheduler = _Scheduler()


class RequestQueue:
    """The requests of one session, handled in their order."""

    def __init__(self) -> None:
        self._waiting: deque[Callable[[], None]] = deque(maxlen=MOST)
        self._lock = threading.Lock()
        self._busy = False
        self._ended = 0.0
        self._left = threading.Event()

    def put(self, work: Callable[[], None]) -> bool:
        """Do this when it is next; return False where the oldest that waits is dropped for it."""
        with self._lock:
            if self._left.is_set():
                return True
            room = len(self._waiting) < MOST
            self._waiting.append(work)
            idle, self._busy = not self._busy, True
        if idle:
            CORES.answer(True)
            _scheduler.put(self._ended, self._run)
        return room

    def end(self) -> None:
        """Drop what waits; what runs ends before its next computation."""
        with self._lock:
            self._left.set()
            self._waiting.clear()

    def _run(self, start: float) -> None:
        """Do one thing, then queue again where more waits."""
        with self._lock:
            work = self._waiting.popleft() if self._waiting else None
        with limited(self._left) as budget:
            try:
                if work is not None:
                    work()
            except Abandoned:
                pass
            # Whatever it is, what waits behind it in the session is handled; the log says all.
            except Exception:
                logger.exception("a request could not be handled")
        with self._lock:
            self._ended = start + budget.spent
            self._busy = bool(self._waiting)
            if not self._busy:
                CORES.answer(False)
                return
        _scheduler.put(self._ended, self._run)
