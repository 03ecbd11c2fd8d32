"""Coroutines in tests that share their process with a browser, and threads that are waited for."""

import asyncio
import time
from concurrent.futures import ThreadPoolExecutor
from functools import wraps


def finished(coroutine):
    """The result of a coroutine, run in a thread of its own: in that of the tests Playwright's loop may be running."""
    with ThreadPoolExecutor(1) as pool:
        return pool.submit(asyncio.run, coroutine).result()


def awaited(test):
    """Return the coroutine of a test as a test that waits for its end."""

    @wraps(test)
    def run(*arguments, **named):
        finished(test(*arguments, **named))

    return run


def wait_until(condition, seconds=60.0):
    """Wait for what another thread or process brings about."""
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "it does not come about"
        time.sleep(0.01)
