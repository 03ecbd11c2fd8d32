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


class _Job:
    """The tasks of one state."""

    def __init__(self, tasks: Iterable[Task]) -> None:
        self.tasks = deque(tasks)
        self.running = 0
        self.error = ""

    def fail(self, error: str) -> None:
        """Leave out the tasks that have not begun."""
        self.error = error
        self.tasks.clear()


class Background:
    """The background work of one session: a new state discards what is left of the previous one."""

    def __init__(self) -> None:
        self._lock = threading.Lock()
        self._job = _Job(())
        # The tasks that have begun, of earlier states too, each with what ends it.
        self._begun: list[tuple[Task, threading.Event]] = []

    def follow(self, tasks: Iterable[Task]) -> None:
        """Compute these into the cache, and discard all earlier tasks but those of them that have begun."""
        wanted = list(tasks)
        self._discard(wanted)
        self._job = job = _Job(wanted)
        # No thread is woken for nothing.
        for _ in range(min(THREADS, len(wanted))):
            run_in_steps(lambda: self._step(job))

    def stop(self) -> None:
        """Discard all tasks; those that have begun end between two parts of their computations."""
        self._discard(())

    def _discard(self, but: Collection[Task]) -> None:
        with self._lock:
            self._job.tasks.clear()
            for task, left in self._begun:
                if task not in but:
                    left.set()

    def _step(self, job: _Job) -> bool:
        """Do one task; return whether there may be more."""
        with self._lock:
            if not job.tasks:
                return False
            task, left = begun = job.tasks.popleft(), threading.Event()
            job.running += 1
            self._begun.append(begun)
        try:
            # The mechanics check their results for overflow themselves.
            with np.errstate(all="ignore"), limited(left, SECONDS, WAIT, "A part of this state"):
                CACHE.get(task.function, *task.arguments)
        except Abandoned:
            pass
        except ModelError as error:
            job.fail(str(error))
        # A worker that died silently would leave the page waiting for ever: report here, details in the log.
        except Exception:
            logger.exception("a computation in the background failed: %s", task.function.__qualname__)
            job.fail("A part of this state could not be computed. Please report the link.")
        with self._lock:
            job.running -= 1
            self._begun.remove(begun)
        return True

    @property
    def left(self) -> int:
        """The number of tasks not finished."""
        with self._lock:
            return len(self._job.tasks) + self._job.running

    @property
    def error(self) -> str:
        """Message of a task that failed, which discards the others; empty if none did."""
        return self._job.error
