"""A process that ends with the one that started it.  This module imports nothing but the standard library."""

import os
import signal

__all__ = ["end_with_stdin"]


def end_with_stdin() -> None:
    """End this process at the end of its standard input, which comes when the parent process exits.

    Run it in a separate thread.
    """
    # Not `sys.stdin`: the interpreter would wait for its lock at exit.
    while os.read(0, 4096):
        pass
    signal.raise_signal(signal.SIGTERM)
