"""The two websockets of a page: the explorer's own for states, and Panel's for the document.

Sending a state as a change of Panel's document would take 5 ms more CPU time; computing it takes 3 to 30 ms.  The query
of the websocket defines the whole page, so any worker can accept it.
"""

from __future__ import annotations

import json
from asyncio import Future
from collections.abc import Callable, Sequence
from contextlib import suppress

from bokeh.protocol.exceptions import ProtocolError
from panel.io.server import WSHandler
from tornado.ioloop import IOLoop
from tornado.websocket import WebSocketClosedError, WebSocketHandler

from hess_explorer.lessons.lesson import Lesson
from hess_explorer.page.connection import Connection
from hess_explorer.page.opening import query_of
from hess_explorer.protocol.messages import ALIVE
from hess_explorer.server.hosts import is_allowed_origin
from hess_explorer.server.limits import OPEN_SOCKETS, Capacity, RateLimit

FULL = "The explorer is full: try again in a minute."
NO_JSON = "A message must be a text frame of JSON."


class PanelSocket(WSHandler):
    """Panel's websocket with a rate limit; it is closed when the server shuts down."""

    def check_origin(self, origin: str) -> bool:
        """Return whether the origin is allowed."""
        return is_allowed_origin(self, origin)

    def open(self) -> None:
        """Register this websocket as open."""
        # Each message consists of three frames: header, metadata and content.
        self._limit = RateLimit(frames=3)
        # Panel raises ProtocolError for a client without the token of a page, and has then closed the websocket.
        with suppress(ProtocolError):
            super().open()  # type: ignore[no-untyped-call]  # Panel declares no types
            OPEN_SOCKETS.add(self)

    def on_close(self) -> None:
        """Unregister this websocket."""
        OPEN_SOCKETS.discard(self)
        super().on_close()

    async def on_message(self, fragment: str | bytes) -> None:
        """Process a frame within the limits."""
        if self._limit.accepts(self, fragment):
            await super().on_message(fragment)


class StateSocket(WebSocketHandler):
    """The websocket for states; a session starts and ends with it.

    Requests are text frames and responses binary frames, see `hess_explorer.protocol.messages`.
    """

    # Pings keep proxies from closing an idle websocket.
    ping_interval = 30.0
    # Keep the websocket without a pong: a sleeping device may return.
    ping_timeout = 0.0

    def initialize(self, capacity: Capacity, lessons: Sequence[Lesson], follow: Callable[[str], None] | None) -> None:
        """Store the options of `serve`; websockets have the same limit as pages."""
        self._most, self._lessons, self._follow = capacity.most, lessons, follow
        self._connection: Connection | None = None
        self._sent: Future[None] | None = None

    def check_origin(self, origin: str) -> bool:
        """Return whether the origin is allowed."""
        return is_allowed_origin(self, origin)

    def open(self) -> None:
        """Start a session with the state of the query; close the websocket if the server is full."""
        if sum(isinstance(one, StateSocket) for one in OPEN_SOCKETS) >= self._most:
            self.close(1013, FULL)
            return
        OPEN_SOCKETS.add(self)
        self.set_nodelay(True)
        self._limit, loop = RateLimit(frames=1), IOLoop.current()
        self._connection = Connection(
            query_of(self.request.arguments),
            self._lessons,
            lambda frame: loop.add_callback(self._send, frame),
            self._follow,
        )

    async def on_message(self, message: str | bytes) -> None:
        """Process a request within the limits."""
        if self._connection is None or not self._limit.accepts(self, message):
            return
        # Back pressure: wait until the client has received the last response.
        if self._sent is not None:
            with suppress(WebSocketClosedError):
                await self._sent
        try:
            request = json.loads(message)
        except (ValueError, RecursionError):
            self.close(1007, NO_JSON)
        else:
            if request == ALIVE:
                self._send("")
            else:
                self._connection.receive(request)

    def on_close(self) -> None:
        """End the session, if there is one, when the websocket has closed."""
        OPEN_SOCKETS.discard(self)
        if self._connection is not None:
            self._connection.end()
            self._connection = None

    def _send(self, frame: bytes | str) -> None:
        with suppress(WebSocketClosedError):
            self._sent = self.write_message(frame, binary=isinstance(frame, bytes))
