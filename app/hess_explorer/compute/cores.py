"""Who waits for an answer goes first: what is filled in behind it has the cores that are left, and never stops."""

from __future__ import annotations

import threading
from collections.abc import Callable, Iterator
from concurrent.futures import ThreadPoolExecutor
from contextlib import contextmanager, suppress

from hess_mechanics.numerics.parallel import THREADS

__all__ = ["CORES", "PATIENCE", "Cores", "queue_again"]

PATIENCE = 1.0
"""Seconds after which a piece is computed though others wait for answers: under any load it goes on."""


class Cores:
    """How many of the cores are asked for."""

    def __init__(self, count: int) -> None:
        self.count = count
        self._answering, self._filling = 0, 0
        self._free = threading.Condition()

    def shared_by(self, processes: int) -> None:
        """Of the cores each of so many processes has its share, and at least one."""
        with self._free:
            self.count = max(1, self.count // processes)
            self._free.notify_all()

    def answer(self, begins: bool) -> None:
        """A session that somebody waits for has something to do, or nothing any more."""
        with self._free:
            self._answering += 1 if begins else -1
            self._free.notify_all()

    @contextmanager
    def fill(self, patience: float = PATIENCE) -> Iterator[None]:
        """Inside, one core computes what nobody waits for; one that is left is waited for as long as that.

        Never more than there are cores.
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
    """In a thread of the pool: do this behind what waits there; not at all where the interpreter ends meanwhile."""
    with suppress(RuntimeError):
        pool.submit(work)
