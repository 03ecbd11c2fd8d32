"""The two websockets of a page: the explorer's own, by which it asks for states, and Panel's for the document.

By Panel's messages, as changes of a document, a state takes 5 ms of a core more, and computing it takes 3 to 30.
What a page is, its own query says: it does not matter which process its websocket comes to.
"""

from __future__ import annotations

import json
from asyncio import Future
from collections.abc import Callable
from contextlib import suppress

from panel.io.server import WSHandler
from tornado.ioloop import IOLoop
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from hess_explorer.lessons.lesson import Lesson
from hess_explorer.page.connection import Connection
from hess_explorer.page.opening import query_of
from hess_explorer.server.capacity import Capacity
from hess_explorer.server.limits import OPEN_SOCKETS, RateLimit

__all__ = ["PanelSocket", "StateSocket"]

FULL = "The explorer is full: try again in a minute."
NO_JSON = "A message must be a text that is JSON."


class PanelSocket(WSHandler):
    """Panel's websocket of a page, with a rate limit; it is told when the server ends."""

    def open(self) -> None:
        """Count it among the open websockets."""
        # Of a message there are the header, the metadata and the content.
        self._limit = RateLimit(frames=3)
        super().open()  # type: ignore[no-untyped-call]  # Panel declares no types
        OPEN_SOCKETS.add(self)

    def on_close(self) -> None:
        """Count it no more."""
        OPEN_SOCKETS.discard(self)
        super().on_close()

    async def on_message(self, fragment: str | bytes) -> None:
        """Take a frame, unless it is one too many or too large."""
        if self._limit.takes(self, fragment):
            await super().on_message(fragment)


class StateSocket(WebSocketHandler):
    """The websocket by which a page asks for states; its session begins and ends with it.

    A request is a text frame, an answer a binary one, see `hess_explorer.protocol.messages`.
    """

    # What lies between keeps a websocket on which nothing is sent.
    ping_interval = 30.0
    # Whoever is asleep may come back.
    ping_timeout = 0.0

    def initialize(self, capacity: Capacity, lesson: Lesson | None, follow: Callable[[str], None] | None) -> None:
        """Take the options of `serve`; there is room for as many websockets as pages."""
        self._most, self._lesson, self._follow = capacity.most, lesson, follow
        self._connection: Connection | None = None
        self._sent: Future[None] | None = None

    def check_origin(self, origin: str) -> bool:
        """Return whether a page of this origin may open one: those that may open Panel's."""
        # It looks into the application and nowhere else.
        return PanelSocket.check_origin(self, origin)  # type: ignore[arg-type]

    def open(self) -> None:
        """Begin a session with the state of the query, if there is room."""
        if sum(isinstance(one, StateSocket) for one in OPEN_SOCKETS) >= self._most:
            self.close(1013, FULL)
            return
        OPEN_SOCKETS.add(self)
        self.set_nodelay(True)
        self._limit, loop = RateLimit(frames=1), IOLoop.current()
        self._connection = Connection(
            query_of(self.request.arguments),
            self._lesson,
            lambda frame: loop.add_callback(self._send, frame),
            self._follow,
        )

    async def on_message(self, message: str | bytes) -> None:
        """Take a request, unless it is one too many or too large."""
        if self._connection is None or not self._limit.takes(self, message):
            return
        # Of who reads no answers nothing more is taken.
        if self._sent is not None:
            with suppress(WebSocketClosedError):
                await self._sent
        try:
            request = json.loads(message)
        except (ValueError, RecursionError):
            self.close(1007, NO_JSON)
        else:
            self._connection.receive(request)

    def on_close(self) -> None:
        """End the session: the page is gone."""
        OPEN_SOCKETS.discard(self)
        if self._connection is not None:
            self._connection.end()
            self._connection = None

    def _send(self, frame: bytes) -> None:
        with suppress(WebSocketClosedError):
            self._sent = self.write_message(frame, binary=True)
