"""The missing parts of a state, computed task by task on all cores while the page stays responsive."""

from __future__ import annotations

import logging
import threading
from collections import deque
from collections.abc import Callable, Iterable
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from hess_explorer.compute.cache import CACHE, Task
from hess_explorer.compute.cores import CORES, queue_again
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.parallel import THREADS

__all__ = ["Background", "in_turns"]

logger = logging.getLogger("hess_explorer")

_pool = ThreadPoolExecutor(max_workers=THREADS, thread_name_prefix="background")


def in_turns(step: Callable[[], bool]) -> None:
    """Call step() in the background until it is False, each time behind what others wait for: so all take turns."""

    def one() -> None:
        with CORES.fill():
            more = step()
        if more:
            queue_again(_pool, one)

    _pool.submit(one)


class _Job:
    def __init__(self, tasks: Iterable[Task]) -> None:
        self.tasks = deque(tasks)
        self.error = ""
        self._lock = threading.Lock()
        self._running = 0

    def one(self) -> bool:
        """Do one task; whether there may be more."""
        with self._lock:
            if not self.tasks:
                return False
            task = self.tasks.popleft()
            self._running += 1
        try:
            # The mechanics check their results for overflow themselves.
            with np.errstate(all="ignore"):
                CACHE.get(task.function, *task.arguments)
        except ModelError as error:
            self.error = str(error)
            self.tasks.clear()
        # A worker that died silently would leave the page waiting for ever: report here, details in the log.
        except Exception:
            logger.exception("a computation in the background failed: %s", task.function.__qualname__)
            self.error = "A part of this state could not be computed. Please report the link."
            self.tasks.clear()
        with self._lock:
            self._running -= 1
        return True

    @property
    def left(self) -> int:
        with self._lock:
            return len(self.tasks) + self._running


class Background:
    """The background work of one session: a new state discards what is left of the previous one."""

    def __init__(self) -> None:
        self._job = _Job(())

    def follow(self, tasks: Iterable[Task]) -> None:
        """Compute these into the cache, and discard all earlier tasks."""
        self.stop()
        self._job = job = _Job(tasks)
        # No thread is woken for nothing.
        for _ in range(min(THREADS, job.left)):
            in_turns(job.one)

    def stop(self) -> None:
        """Discard the tasks that have not begun."""
        self._job.tasks.clear()

    @property
    def left(self) -> int:
        """The number of tasks not finished."""
        return self._job.left

    @property
    def error(self) -> str:
        """Message of a task that failed, which discards the others; empty if none did."""
        return self._job.error
