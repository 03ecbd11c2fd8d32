"""Thread pool for kernels, which release the global interpreter lock."""

from __future__ import annotations

import os
import time
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor
from contextvars import copy_context

from hess_mechanics.numerics.patience import charge, check_limit

__all__ = ["THREADS", "run_in_threads"]

THREADS = min(8, os.cpu_count() or 1)

_pool = ThreadPoolExecutor(max_workers=THREADS, thread_name_prefix="kernel")


def run_in_threads(work: Callable[[int], None], count: int, threads: int = THREADS, at_once: int = 1) -> None:
    """Run work(0), …, work(count − 1) on the thread pool; raise the error of the first item that fails.

    `check_limit` is called before each item and may raise, see `patience`.

    Parameters
    ----------
    work : callable
        Function of the index of an item.
    count : int
        Number of items.
    threads : int, default THREADS
        1 to run the items in order on the calling thread; any other number uses the whole pool of `THREADS` threads.
    at_once : int, default 1
        Number of items that a thread takes at a time; if `count` is at most this, they run on the calling thread.
    """

    def some(first: int, after: int) -> None:
        for i in range(first, min(after, count)):
            check_limit()
            work(i)

    if threads == 1 or count <= at_once:
        some(0, count)
        return

    def part(first: int) -> None:
        begun = time.thread_time()
        try:
            some(first, first + at_once)
        finally:
            charge(time.thread_time() - begun)

    # Copy the context for each part, because two threads cannot enter the same one.
    list(_pool.map(lambda both: both[0].run(part, both[1]), [(copy_context(), i) for i in range(0, count, at_once)]))
