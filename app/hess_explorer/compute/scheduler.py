"""Scheduler of requests: one at a time per session, outside the thread of the event loop, fair between sessions.

It shares CPU time rather than the number of requests, by start-time fair queueing (Goyal, Vin and Cheng, 1996).  The
tag of a request is the virtual time at which the session's previous request ended; the smallest tag is served first.
A session with slow requests therefore waits for the others, which hardly wait for it.
"""

from __future__ import annotations

import heapq
import itertools
import logging
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager

from hess_explorer.compute.budget import Abandoned, limited
from hess_explorer.compute.cores import CORES, queue_again
from hess_mechanics.numerics.parallel import THREADS

__all__ = ["MOST", "RequestQueue"]

logger = logging.getLogger("hess_explorer")

MOST = 20
"""Maximum number of waiting requests of a session; a page sends one at a time."""

TURN = 0.03
"""Seconds after which a slow request no longer keeps others waiting."""

# One thread more than cores, so that a slow request does not block the others.  Many more threads would delay the event
# loop, which competes with them for the interpreter lock.
_pool = ThreadPoolExecutor(max_workers=THREADS + 1, thread_name_prefix="request")


class _Scheduler:
    """Chooses the next session.  Virtual time is measured in CPU seconds of a session with its fair share."""

    def __init__(self) -> None:
        self._waiting: list[tuple[float, int, Callable[[float], None]]] = []
        self._number = itertools.count()
        self._now = 0.0
        self._lock = threading.Lock()

    def put(self, ended: float, run: Callable[[float], None]) -> None:
        """Schedule run(start); ended : virtual end time of the session's previous request."""
        with self._lock:
            # The counter breaks ties in order of arrival.
            heapq.heappush(self._waiting, (max(ended, self._now), next(self._number), run))
        queue_again(_pool, self._next)

    def _next(self) -> None:
        with self._lock:
            start, _, run = heapq.heappop(self._waiting)
            self._now = max(self._now, start)
        run(start)


_scheduler = _Scheduler()


class _Turns:
    """Lets requests compute one after the other, in order of arrival.

    Several at a time would each wait for the interpreter lock after every call of NumPy, which doubles the CPU time.
    """

    def __init__(self) -> None:
        self._changed = threading.Condition()
        self._waiting: deque[object] = deque()
        # The request whose turn it is, and when its turn ends.
        self._owner: object = None
        self._until = 0.0

    @contextmanager
    def take(self) -> Iterator[None]:
        """Wait for a turn.  It lasts `TURN` seconds at most, even if the request takes longer."""
        me = object()
        with self._changed:
            self._waiting.append(me)
            while (left := self._until - time.monotonic()) > 0.0 or self._waiting[0] is not me:
                self._changed.wait(max(left, 0.0) or TURN)
            self._waiting.popleft()
            self._owner, self._until = me, time.monotonic() + TURN
        try:
            yield
        finally:
            with self._changed:
                if self._owner is me:
                    self._until = 0.0
                    self._changed.notify_all()


_turns = _Turns()


class RequestQueue:
    """The queue of one session's requests, processed in order."""

    def __init__(self) -> None:
        self._waiting: deque[Callable[[], None]] = deque(maxlen=MOST)
        self._lock = threading.Lock()
        self._busy = False
        self._ended = 0.0
        self._left = threading.Event()

    def put(self, work: Callable[[], None]) -> bool:
        """Queue a request; return False if the oldest waiting one was dropped to make room."""
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
        """Drop the waiting requests; the running one ends at the next check of its budget."""
        with self._lock:
            self._left.set()
            self._waiting.clear()

    def _run(self, start: float) -> None:
        """Process one request, then schedule the next one."""
        with self._lock:
            work = self._waiting.popleft() if self._waiting else None
        with limited(self._left) as budget:
            try:
                if work is not None:
                    with _turns.take():
                        work()
            except Abandoned:
                pass
            # Log any error, and go on with the next request of the session.
            except Exception:
                logger.exception("a request could not be handled")
        with self._lock:
            self._ended = start + budget.spent
            self._busy = bool(self._waiting)
            if not self._busy:
                CORES.answer(False)
                return
        _scheduler.put(self._ended, self._run)
