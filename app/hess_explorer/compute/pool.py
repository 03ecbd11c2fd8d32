"""The threads that compute: requests, and background tasks on the cores that requests leave free."""

from __future__ import annotations

import logging
import threading
import time
from collections import deque
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress

from hess_explorer.compute.budget import ClientGone, time_budget
from hess_mechanics.numerics.parallel import THREADS

logger = logging.getLogger("hess_explorer")

MAX_REQUESTS = 20
"""Maximum number of waiting requests of a session; a page sends one at a time."""

PATIENCE = 1.0
"""Maximum delay of a background task in seconds while requests occupy the cores."""


class Pool:
    """Runs the requests of all sessions in rotation, and background tasks when a core is free.

    Parameters
    ----------
    cores : int
        Number of cores; one more thread answers requests.
    """

    def __init__(self, cores: int) -> None:
        # One more thread than cores, so that a slow request does not block the others.  Many more threads would delay
        # the event loop, which competes with them for the interpreter lock.
        self._requests = ThreadPoolExecutor(cores + 1, thread_name_prefix="request")
        self._waiting: list[RequestQueue] = []
        self._busy = 0
        self._changed = threading.Condition()
        self.set_cores(cores)

    def set_cores(self, cores: int) -> None:
        """Set the number of cores, which is also the maximum number of running background tasks."""
        self.cores = max(1, cores)
        self._tasks = ThreadPoolExecutor(self.cores, thread_name_prefix="background")

    def answer(self, queue: RequestQueue) -> None:
        """Schedule the next request of a session; sessions that were served less recently come first."""
        with self._changed:
            self._waiting.append(queue)
            self._busy += 1
        self._submit(self._requests, self._answer_next)

    def add_task(self, task: Callable[[], None]) -> None:
        """Run a background task when a core is free, or after `PATIENCE` seconds."""

        def when_free() -> None:
            with self._changed:
                self._changed.wait_for(lambda: self._busy < self.cores, PATIENCE)
                self._busy += 1
            task()
            self._free()

        self._submit(self._tasks, when_free)

    def _answer_next(self) -> None:
        with self._changed:
            queue = min(self._waiting, key=lambda one: one.served)
            self._waiting.remove(queue)
        queue.answer_one()
        self._free()

    def _free(self) -> None:
        with self._changed:
            self._busy -= 1
            self._changed.notify_all()

    def _submit(self, threads: ThreadPoolExecutor, run: Callable[[], None]) -> None:
        # `submit` raises a RuntimeError while the interpreter shuts down.
        with suppress(RuntimeError):
            threads.submit(run)


POOL = Pool(THREADS)


class RequestQueue:
    """The requests of one session, processed one by one in their order.

    Attributes
    ----------
    served : float
        Time at which the last request ended, in seconds of the monotonic clock; 0 before.
    """

    def __init__(self) -> None:
        self.served = 0.0
        self._waiting: deque[Callable[[], None]] = deque(maxlen=MAX_REQUESTS)
        self._lock = threading.Lock()
        self._busy = False
        self._left = threading.Event()

    def put(self, request: Callable[[], None]) -> None:
        """Queue a request; if too many wait, the oldest is dropped.  After `end` it does nothing."""
        with self._lock:
            if self._left.is_set():
                return
            self._waiting.append(request)
            idle, self._busy = not self._busy, True
        if idle:
            POOL.answer(self)

    def end(self) -> None:
        """Drop the waiting and all later requests; the running one ends at the next check of its budget."""
        with self._lock:
            self._left.set()
            self._waiting.clear()

    def answer_one(self) -> None:
        """Process one request; the next one waits for those of other sessions."""
        with self._lock:
            request = self._waiting.popleft() if self._waiting else None
        with time_budget(self._left):
            try:
                if request is not None:
                    request()
            except ClientGone:
                pass
            # Log any error, and go on with the next request of the session.
            except Exception:
                logger.exception("a request could not be handled")
        with self._lock:
            self.served = time.monotonic()
            more = self._busy = bool(self._waiting)
        if more:
            POOL.answer(self)
