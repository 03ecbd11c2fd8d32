"""End a child process with its parent.  This module imports only the standard library."""

import os
import signal


def end_with_stdin() -> None:
    """Exit at the end of standard input, which the parent process closes when it exits.

    Run this in a separate thread.
    """
    # Read the file descriptor: with `sys.stdin` the interpreter would wait for its lock at exit.
    while os.read(0, 4096):
        pass
    signal.raise_signal(signal.SIGTERM)
