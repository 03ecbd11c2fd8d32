"""How the server ends: on Ctrl-C or SIGTERM its pages are told, and all its processes are gone within seconds."""

from __future__ import annotations

import logging
import os
import signal
import sys
from contextlib import suppress
from types import FrameType
from typing import NoReturn

from bokeh.server.server import Server
from tornado.ioloop import IOLoop

from hess_explorer.server.limits import say_goodbye

__all__ = ["Workers", "end_on_signals", "end_with_stdin", "leave"]

GOODBYE = 2.0
"""Seconds for the pages to hear of it."""

_SIGNALS = (signal.SIGINT, signal.SIGTERM)


class Workers:
    """Ties the processes that serve to the one that began and watches over them.

    They read from a pipe that it alone can write to: it is closed when that process is told to end, and by the system
    when it is gone, however that came.
    """

    def __init__(self) -> None:
        self._read, self._write = os.pipe()
        self._open = True
        for one in _SIGNALS:
            signal.signal(one, self._end)

    def _end(self, number: int, frame: FrameType | None) -> None:
        # Tornado waits for the workers, and ends the process when all have ended.
        if self._open:
            self._open = False
            os.close(self._write)

    def end_together(self, loop: IOLoop) -> None:
        """In a worker: its loop stops when the process that began ends."""

        def stop(*_: object) -> None:
            # What is closed can be read from for ever, and the loop runs once more.
            loop.remove_handler(self._read)
            loop.stop()

        self._end(0, None)
        loop.add_handler(self._read, stop, IOLoop.READ)


def end_on_signals(loop: IOLoop) -> None:
    """In a process that serves: from now on both signals stop its loop."""

    def stop(number: int, frame: FrameType | None) -> None:
        loop.add_callback_from_signal(loop.stop)

    for one in _SIGNALS:
        signal.signal(one, stop)


def end_with_stdin() -> None:
    """End this process when its standard input is closed, as it is when the process that holds the other end is gone.

    To be run in a thread of its own.
    """
    # Not `sys.stdin`, whose lock an interpreter that ends would wait for.
    while os.read(0, 4096):
        pass
    signal.raise_signal(signal.SIGTERM)


def leave(server: Server) -> NoReturn:
    """End this process, whose loop has stopped, with exit code 0."""
    with suppress(Exception):
        server.stop()
    with suppress(Exception):
        server.io_loop.run_sync(lambda: say_goodbye(GOODBYE))
    logging.shutdown()
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):
            stream.flush()
    # Python would wait for all that is still computed, for whom nobody waits any more.
    os._exit(0)
