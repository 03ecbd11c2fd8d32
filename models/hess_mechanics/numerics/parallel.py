"""Work shared between threads; kernels release the global interpreter lock."""

from __future__ import annotations

import os
from collections.abc import Callable
from concurrent.futures import ThreadPoolExecutor

__all__ = ["THREADS", "share"]

THREADS = min(8, os.cpu_count() or 1)

_pool = ThreadPoolExecutor(max_workers=THREADS, thread_name_prefix="kernel")


def share(work: Callable[[int], None], parts: int, threads: int = THREADS) -> None:
    """Run work(0), …, work(parts − 1) on the pool, or in order if `threads` is 1; the first error is raised."""
    if threads == 1 or parts == 1:
        for part in range(parts):
            work(part)
    else:
        list(_pool.map(work, range(parts)))
