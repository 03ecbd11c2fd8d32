"""The line by which a page asks for states and gets them: a message is a frame of text, an answer one of bytes.

By Panel's own messages, as changes of a document, each took 5 ms of a core more, and the answer itself takes 3 to 30.
What the page is, its own query says: it does not matter which process a line comes to.
"""

from __future__ import annotations

import json
from asyncio import Future
from collections.abc import Callable
from contextlib import suppress

from tornado.ioloop import IOLoop
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from hess_explorer.lessons.lesson import Lesson
from hess_explorer.page.desk import Desk
from hess_explorer.page.opening import query_of
from hess_explorer.server.capacity import Capacity
from hess_explorer.server.limits import THERE, Meter
from hess_explorer.server.page_socket import PageSocket

__all__ = ["Line"]

FULL = "The explorer is full: try again in a minute."
NO_JSON = "A message must be a text that is JSON."


class Line(WebSocketHandler):
    """The line of one page, and with it the page's session: both end together."""

    # What lies between keeps a line on which nothing is asked for.
    ping_interval = 30.0
    # Whoever is asleep may come back.
    ping_timeout = 0.0

    def initialize(self, capacity: Capacity, lesson: Lesson | None, follow: Callable[[str], None] | None) -> None:
        """As `serve` is told; so many lines as pages have room."""
        self._most, self._lesson, self._follow = capacity.most, lesson, follow
        self._desk: Desk | None = None
        self._sent: Future[None] | None = None

    def check_origin(self, origin: str) -> bool:
        """Who may open one is who may open Panel's."""
        # It looks into the application and nowhere else.
        return PageSocket.check_origin(self, origin)  # type: ignore[arg-type]

    def open(self) -> None:
        """Begin a session with the state of the query, if there is room."""
        if sum(isinstance(one, Line) for one in THERE) >= self._most:
            self.close(1013, FULL)
            return
        THERE.add(self)
        self.set_nodelay(True)
        self._meter, loop = Meter(frames=1), IOLoop.current()
        self._desk = Desk(query_of(self.request.arguments), self._lesson,
                          lambda frame: loop.add_callback(self._send, frame), self._follow)

    async def on_message(self, message: str | bytes) -> None:
        """Take a message, unless it is one too many or too large."""
        if self._desk is None or not self._meter.takes(self, message):
            return
        # Of who reads no answers nothing more is taken.
        if self._sent is not None:
            with suppress(WebSocketClosedError):
                await self._sent
        try:
            asked = json.loads(message)
        except (ValueError, RecursionError):
            self.close(1007, NO_JSON)
        else:
            self._desk.receive(asked)

    def on_close(self) -> None:
        """The page is gone, and nobody waits for what it asked."""
        THERE.discard(self)
        if self._desk is not None:
            self._desk.end()
            self._desk = None

    def _send(self, frame: bytes) -> None:
        with suppress(WebSocketClosedError):
            self._sent = self.write_message(frame, binary=True)
