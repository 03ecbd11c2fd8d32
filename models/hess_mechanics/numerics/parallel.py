"""Work shared between threads; kernels release the global interpreter lock."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextvars import copy_context

from hess_mechanics.numerics.patience import go_on, worked

__all__ = ["THREADS", "share"]

THREADS = min(8, os.cpu_count() or 1)

_pool = ThreadPoolExecutor(max_workers=THREADS, thread_name_prefix="kernel")


def share(work: Callable[[int], None], parts: int, threads: int = THREADS) -> None:
    """Run work(0), …, work(parts − 1) on the pool, or in order if `threads` is 1; the first error is raised.

    Between parts it ends where who asked does not want to wait any longer: see `patience`.
    """
    if threads == 1 or parts == 1:
        for part in range(parts):
            go_on()
            work(part)
        return

    def one(part: int) -> None:
        go_on()
        begun = time.thread_time()
        try:
            work(part)
        finally:
            worked(time.thread_time() - begun)

    # Each part in a context of its own, as two threads cannot be in one.
    list(_pool.map(lambda both: both[0].run(one, both[1]), [(copy_context(), part) for part in range(parts)]))
