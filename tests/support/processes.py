"""Child processes that can be interrupted."""

import signal
from contextlib import contextmanager

__all__ = ["interruptible"]


@contextmanager
def interruptible():
    """Children started inside obey Ctrl-C, even where a shell runs the tests in the background.

    Such a shell lets its children ignore SIGINT, and they hand that on; a handler is reset to the default instead.
    """
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    try:
        yield
    finally:
        signal.signal(signal.SIGINT, before)
