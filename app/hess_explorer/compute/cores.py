"""Share of the cores between requests and background work: requests come first, background work never stops."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress

from hess_mechanics.numerics.parallel import THREADS

__all__ = ["CORES", "PATIENCE", "Cores", "queue_again"]

PATIENCE = 1.0
"""Maximum delay of a background task in seconds while requests occupy the cores."""


class Cores:
    """Counts the cores in use."""

    def __init__(self, count: int) -> None:
        self.count = count
        self._answering, self._filling = 0, 0
        self._free = threading.Condition()

    def shared_by(self, processes: int) -> None:
        """Reduce the count to this process's share among several processes, at least one core."""
        with self._free:
            self.count = max(1, self.count // processes)
            self._free.notify_all()

    def answer(self, begins: bool) -> None:
        """Record that a session starts (True) or stops (False) processing requests."""
        with self._free:
            self._answering += 1 if begins else -1
            self._free.notify_all()

    @contextmanager
    def fill(self, patience: float = PATIENCE) -> Iterator[None]:
        """Reserve one core for background work.

        Waits up to `patience` seconds for a free core.  The number of background tasks never exceeds the number of
        cores.
        """
        with self._free:
            self._free.wait_for(lambda: self._answering + self._filling < self.count, patience)
            self._free.wait_for(lambda: self._filling < self.count)
            self._filling += 1
        try:
            yield
        finally:
            with self._free:
                self._filling -= 1
                self._free.notify_all()


CORES = Cores(THREADS)


def queue_again(pool: ThreadPoolExecutor, work: Callable[[], None]) -> None:
    """Queue work from a thread of the pool; does nothing if the interpreter is shutting down."""
    with suppress(RuntimeError):
        pool.submit(work)
