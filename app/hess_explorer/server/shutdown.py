"""Shut down the server on Ctrl-C or SIGTERM: notify the pages and end all processes within seconds."""

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

from hess_explorer.server.limits import close_websockets

GOODBYE = 2.0
"""Timeout for closing the websockets, in seconds."""

_SIGNALS = (signal.SIGINT, signal.SIGTERM)


class Workers:
    """Stops the workers when the parent process exits.

    The workers watch a pipe whose write end only the parent holds.  The parent closes it on a signal, and the operating
    system closes it when the parent exits for any reason.
    """

    def __init__(self) -> None:
        self._read, self._write = os.pipe()
        self._open = True
        for one in _SIGNALS:
            signal.signal(one, self._end)

    def _end(self, number: int, frame: FrameType | None) -> None:
        # Tornado waits for the workers and then ends the parent process.
        if self._open:
            self._open = False
            os.close(self._write)

    def end_with_parent(self, loop: IOLoop) -> None:
        """Stop the event loop of this worker when the parent process exits."""

        def stop(*_: object) -> None:
            # A closed pipe stays readable, and the loop would call this handler again.
            loop.remove_handler(self._read)
            loop.stop()

        self._end(0, None)
        loop.add_handler(self._read, stop, IOLoop.READ)


def end_on_signals(loop: IOLoop) -> None:
    """Stop the event loop on SIGINT and SIGTERM."""

    def stop(number: int, frame: FrameType | None) -> None:
        loop.add_callback_from_signal(loop.stop)

    for one in _SIGNALS:
        signal.signal(one, stop)


def exit_process(server: Server) -> NoReturn:
    """End this process with exit status 0 after its event loop has stopped."""
    with suppress(Exception):
        server.stop()
    with suppress(Exception):
        server.io_loop.run_sync(lambda: close_websockets(GOODBYE))
    logging.shutdown()
    for stream in (sys.stdout, sys.stderr):
        with suppress(OSError, ValueError):
            stream.flush()
    # A normal exit would wait for running computations, whose results are no longer needed.
    os._exit(0)
