"""What a state still lacks, computed piece by piece on all cores while the page goes on."""

from __future__ import annotations

import logging
import threading
from collections import deque
from collections.abc import Iterable
from concurrent.futures import ThreadPoolExecutor

from hess_explorer.compute.cache import CACHE, Task
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.parallel import THREADS

__all__ = ["Background"]

logger = logging.getLogger("hess_explorer")

_pool = ThreadPoolExecutor(max_workers=THREADS, thread_name_prefix="background")


class _Job:
    def __init__(self, tasks: Iterable[Task]) -> None:
        self.tasks = deque(tasks)
        self.error = ""
        self._lock = threading.Lock()
        self._running = 0

    def one(self) -> None:
        """One piece, and then back into the queue: so all sessions get their turns."""
        with self._lock:
            if not self.tasks:
                return
            task = self.tasks.popleft()
            self._running += 1
        try:
            CACHE.get(task.function, *task.arguments)
        except ModelError as error:
            self.error = str(error)
            self.tasks.clear()
        # A worker that ends would leave the page waiting for ever: it is told, and the log says all.
        except Exception:
            logger.exception("a computation in the background failed: %s", task.function.__qualname__)
            self.error = "A part of this state could not be computed. Please report the link."
            self.tasks.clear()
        with self._lock:
            self._running -= 1
        _pool.submit(self.one)

    @property
    def left(self) -> int:
        with self._lock:
            return len(self.tasks) + self._running


class Background:
    """The work of one session: a newer state ends what was left of the older one's."""

    def __init__(self) -> None:
        self._job = _Job(())

    def follow(self, tasks: Iterable[Task]) -> None:
        """Compute these, into the cache, and nothing else any more."""
        self.stop()
        self._job = _Job(tasks)
        for _ in range(THREADS):
            _pool.submit(self._job.one)

    def stop(self) -> None:
        """Pieces that have not begun are not computed."""
        self._job.tasks.clear()

    @property
    def left(self) -> int:
        """How many pieces are not computed yet."""
        return self._job.left

    @property
    def error(self) -> str:
        """The sentence of a piece that could not be computed, after which no other is."""
        return self._job.error
