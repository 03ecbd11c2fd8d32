"""The missing parts of a state, computed task by task on all cores while the page stays responsive."""

from __future__ import annotations

import logging
import threading
from collections import deque
from collections.abc import Callable, Collection, Iterable
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from hess_explorer.compute.budget import Abandoned, limited
from hess_explorer.compute.cache import CACHE, Task
from hess_explorer.compute.cores import CORES, queue_again
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.parallel import THREADS

__all__ = ["SECONDS", "Background", "run_in_steps"]

SECONDS = 30.0
"""Of the processor, all cores together, for one piece."""

WAIT = 600.0
"""Seconds by the clock for one, on a machine that has much else to do."""

logger = logging.getLogger("hess_explorer")

_pool = ThreadPoolExecutor(max_workers=THREADS, thread_name_prefix="background")


def run_in_steps(step: Callable[[], bool]) -> None:
    """Call step() in the background until it returns False, each time behind what others have queued."""

    def one() -> None:
        with CORES.fill():
            more = step()
        if more:
            queue_again(_pool, one)

    _pool.submit(one)


class _Begun:
    """The pieces of a session that have begun, each with what ends it."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._all: list[tuple[Task, threading.Event]] = []

    def compute(self, task: Task) -> None:
        """The result of this task for the cache.  Raises as the task and `budget.check`."""
        one = (task, threading.Event())
        with self._lock:
            self._all.append(one)
        try:
            # The mechanics check their results for overflow themselves.
            with np.errstate(all="ignore"), limited(one[1], SECONDS, WAIT, "A part of this state"):
                CACHE.get(task.function, *task.arguments)
        finally:
            with self._lock:
                self._all.remove(one)

    def abandon(self, but: Collection[Task]) -> None:
        """End all but these, each between two parts of its computation."""
        with self._lock:
            for task, left in self._all:
                if task not in but:
                    left.set()


class _Job:
    def __init__(self, tasks: Iterable[Task], begun: _Begun) -> None:
        self.tasks = deque(tasks)
        self.error = ""
        self._begun = begun
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
            self._begun.compute(task)
        except Abandoned:
            pass
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
        self._begun = _Begun()
        self._job = _Job((), self._begun)

    def follow(self, tasks: Iterable[Task]) -> None:
        """Compute these into the cache, and discard all earlier tasks but those of them that have begun."""
        wanted = list(tasks)
        self._discard(wanted)
        self._job = job = _Job(wanted, self._begun)
        # No thread is woken for nothing.
        for _ in range(min(THREADS, job.left)):
            run_in_steps(job.one)

    def stop(self) -> None:
        """Discard all tasks; those that have begun end between two parts of their computations."""
        self._discard(())

    def _discard(self, but: Collection[Task]) -> None:
        self._job.tasks.clear()
        self._begun.abandon(but)

    @property
    def left(self) -> int:
        """The number of tasks not finished."""
        return self._job.left

    @property
    def error(self) -> str:
        """Message of a task that failed, which discards the others; empty if none did."""
        return self._job.error
