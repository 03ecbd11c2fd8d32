"""Relay a websocket to the worker that has its room.

All workers accept connections at the same port, so a follower reaches any of them.  Each worker also listens at a Unix
socket, which is bound before the workers are forked.  A worker that gets a request for a room of another one sends it
there unchanged, and then passes the bytes of the connection both ways.
"""

from __future__ import annotations

import asyncio
import socket
import tempfile
from contextlib import suppress
from pathlib import Path

from tornado.httpserver import HTTPServer
from tornado.iostream import IOStream, StreamClosedError
from tornado.netutil import bind_unix_socket
from tornado.process import task_id
from tornado.web import Application, RequestHandler

__all__ = ["Relay"]

_CHUNK = 64 * 1024


class Relay:
    """The Unix sockets of all workers; create it before they are forked.

    Parameters
    ----------
    workers : int
        Number of workers; a single one needs no sockets.
    """

    def __init__(self, workers: int) -> None:
        self.workers = workers
        self._folder = tempfile.TemporaryDirectory(prefix="hess-explorer-") if workers > 1 else None
        self._paths = [str(Path(self._folder.name) / str(worker)) for worker in range(workers)] if self._folder else []
        self._listening = [bind_unix_socket(path, mode=0o600) for path in self._paths]

    @property
    def own(self) -> int:
        """Index of this worker."""
        return task_id() or 0

    def listen(self, application: Application) -> None:
        """Serve an application to the other workers."""
        if self._listening:
            HTTPServer(application).add_socket(self._listening[self.own])

    async def connect(self, handler: RequestHandler, worker: int) -> None:
        """Connect the client of a request to another worker until one of them closes."""
        request = handler.request
        lines = [f"{request.method} {request.uri} {request.version}"]
        lines += [f"{name}: {value}" for name, value in request.headers.get_all()]
        there = IOStream(socket.socket(socket.AF_UNIX))
        try:
            await there.connect(self._paths[worker])
            await there.write("\r\n".join([*lines, "", ""]).encode("latin-1"))
        except (OSError, StreamClosedError):
            there.close()
            handler.send_error(503)
            return
        here = handler.detach()
        here.set_nodelay(True)
        await asyncio.gather(_pass(here, there), _pass(there, here))


async def _pass(source: IOStream, target: IOStream) -> None:
    """Pass bytes on until one end closes, no faster than they are taken."""
    with suppress(StreamClosedError):
        while True:
            await target.write(await source.read_bytes(_CHUNK, partial=True))
    source.close()
    target.close()
