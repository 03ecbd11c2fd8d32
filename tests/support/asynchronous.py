"""Coroutines in tests that share their process with a browser."""

import asyncio
from concurrent.futures import ThreadPoolExecutor


def finished(coroutine):
    """The result of a coroutine, run in a thread of its own: in that of the tests Playwright's loop may be running."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, coroutine).result()
