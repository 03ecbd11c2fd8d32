"""Limit the sessions and the messages of a websocket, and close all websockets when the server shuts down.

A page requests the next state only after the last one is painted.  A client that exceeds this rate is disconnected with
a reason.
"""

from __future__ import annotations

import asyncio
import time

import panel as pn
from tornado.websocket import WebSocketHandler

MESSAGE_LIMIT = 256 * 1024
"""Maximum size of a frame in bytes; slider values and clicks are far smaller."""

RATE, BURST = 150.0, 300.0
"""Messages per second and burst size; a page sends at most one request per frame of the screen."""

# RFC 6455: the reason of a close frame has at most 123 bytes.
TOO_LARGE = "A message may have at most {} KB: send a smaller one."
TOO_MANY = "More than {:.0f} messages per second: wait for each response before you send again."
SHUTDOWN = "The server is shutting down or restarting: open the page again in a moment."

OPEN_SOCKETS: set[WebSocketHandler] = set()
"""The open websockets of this process."""


class Capacity:
    """Counts the open sessions of one process, because each takes memory; used only in the thread of the event loop.

    Parameters
    ----------
    most : int
        Maximum number of sessions.

    Attributes
    ----------
    most, sessions : int
        Maximum and current number of sessions.
    """

    def __init__(self, most: int) -> None:
        self.most = most
        self.sessions = 0

    def reserve(self) -> bool:
        """Count a new session until it is destroyed; return False if the server is full."""
        if self.sessions >= self.most:
            return False
        self.sessions += 1
        pn.state.on_session_destroyed(self._release)
        return True

    def _release(self, context: object) -> None:
        self.sessions -= 1

    @property
    def sentence(self) -> str:
        """The message of a server that is full."""
        return (
            f"The explorer is full: this server can have at most {self.most} open pages. Try again in a minute, or "
            "install the explorer on your own machine."
        )


class RateLimit:
    """Token bucket for the messages of one websocket.

    Parameters
    ----------
    frames : int
        Number of frames per message.
    rate, burst : float, optional
        Messages per second and burst size in messages; by default `RATE` and `BURST`.
    size : int
        Maximum size of a frame in bytes.
    """

    def __init__(
        self, frames: int = 1, *, rate: float | None = None, burst: float | None = None, size: int = MESSAGE_LIMIT
    ) -> None:
        self._rate, burst = RATE if rate is None else rate, BURST if burst is None else burst
        self._frames, self._size, self._burst = frames, size, frames * burst
        self._room, self._since = self._burst, time.monotonic()
        self._over = False

    def accepts(self, socket: WebSocketHandler, frame: str | bytes) -> bool:
        """Return whether a frame is accepted; close the websocket if the rate or the size is too high."""
        now = time.monotonic()
        self._room = min(self._burst, self._room + self._frames * self._rate * (now - self._since)) - 1.0
        self._since = now
        if self._over:
            return False
        if len(frame) > self._size:
            self._over = True
            socket.close(1009, TOO_LARGE.format(self._size // 1024))
        elif self._room < 0.0:
            self._over = True
            socket.close(1008, TOO_MANY.format(self._rate))
        return not self._over


async def close_websockets(seconds: float) -> None:
    """Close all websockets and wait for the close handshakes, at most `seconds`."""
    for one in [*OPEN_SOCKETS]:
        one.close(1001, SHUTDOWN)
    ends = time.monotonic() + seconds
    while OPEN_SOCKETS and time.monotonic() < ends:
        await asyncio.sleep(0.02)
