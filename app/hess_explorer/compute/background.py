"""Background computation of the missing parts of a state, task by task on all cores."""

from __future__ import annotations

import logging
import threading
from collections import deque
from collections.abc import Collection
from typing import Any

import numpy as np

from hess_explorer.compute.budget import ClientGone, time_budget
from hess_explorer.compute.cache import CACHE, Task
from hess_explorer.compute.pool import POOL
from hess_mechanics.errors import ModelError

SECONDS = 30.0
"""CPU time limit of one task in seconds, summed over all cores."""

WAIT = 600.0
"""Wall-clock limit of one task in seconds, for a busy machine."""

logger = logging.getLogger("hess_explorer")


class _Job:
    """The background tasks of one state."""

    def __init__(self) -> None:
        self.tasks: deque[Task[Any]] = deque()
        self.running = 0
        self.error = ""

    def fail(self, error: str) -> None:
        """Record the error and drop the tasks that have not started."""
        self.error = error
        self.tasks.clear()


class Background:
    """The background work of one session; a new state discards the remaining tasks of the previous one."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._job = _Job()
        # Each running task, including those of earlier states, with the event that cancels it.
        self._running: list[tuple[Task[Any], threading.Event]] = []

    def follow(self, tasks: Collection[Task[Any]]) -> None:
        """Compute these tasks into the cache.  Earlier tasks are discarded, except running ones that are listed."""
        self._discard(tasks)
        self._job = _Job()
        self.add(tasks)

    def add(self, tasks: Collection[Task[Any]]) -> None:
        """Queue further tasks of the present state behind its other tasks."""
        job = self._job
        with self._lock:
            job.tasks.extend(tasks)
        for _ in range(min(POOL.cores, len(tasks))):
            POOL.add_task(lambda: self._step(job))

    def stop(self) -> None:
        """Discard all tasks; running ones end at the next check of their budget."""
        self._discard(())

    def _discard(self, but: Collection[Task[Any]]) -> None:
        with self._lock:
            self._job.tasks.clear()
            for task, cancellation in self._running:
                if task not in but:
                    cancellation.set()

    def _step(self, job: _Job) -> None:
        """Run one task, and queue the next one behind those of other sessions."""
        with self._lock:
            if not job.tasks:
                return
            task, cancellation = begun = job.tasks.popleft(), threading.Event()
            job.running += 1
            self._running.append(begun)
        try:
            # `hess_mechanics` checks its results for overflow itself.
            with np.errstate(all="ignore"), time_budget(cancellation, SECONDS, WAIT, "A part of this state"):
                CACHE.get(task.function, *task.arguments)
        except ClientGone:
            pass
        except ModelError as error:
            job.fail(str(error))
        # Report any error: if the worker died silently, the page would wait for ever.
        except Exception:
            logger.exception("a computation in the background failed: %s", task.function.__qualname__)
            job.fail("A part of this state could not be computed. Please report the link.")
        with self._lock:
            job.running -= 1
            self._running.remove(begun)
        POOL.add_task(lambda: self._step(job))

    @property
    def backlog(self) -> int:
        """The number of unfinished tasks of the present state."""
        with self._lock:
            return len(self._job.tasks) + self._job.running

    @property
    def error(self) -> str:
        """The message of the task that failed and thereby discarded the others; empty if none failed."""
        return self._job.error
