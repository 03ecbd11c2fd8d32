"""Limit the messages of a websocket, and close all websockets when the server shuts down.

A page requests the next state only after the last one is painted.  A client that sends more than a page can is
disconnected with a reason.
"""

from __future__ import annotations

import asyncio
import time

from tornado.websocket import WebSocketHandler

__all__ = ["MESSAGE_LIMIT", "OPEN_SOCKETS", "RateLimit", "say_goodbye"]

MESSAGE_LIMIT = 256 * 1024
"""Maximum size of a frame in bytes; slider values and clicks are far smaller."""

RATE, BURST = 150.0, 300.0
"""Messages per second and burst size; a page sends at most one request per frame of the screen."""

# RFC 6455: the reason of a close frame has at most 123 bytes.
TOO_LARGE = f"A message may have at most {MESSAGE_LIMIT // 1024} KB: send a smaller one."
TOO_MANY = f"More than {RATE:.0f} messages per second: wait for each response before you send again."
ENDING = "The server is shutting down or restarting: open the page again in a moment."

OPEN_SOCKETS: set[WebSocketHandler] = set()
"""The open websockets of this process."""


class RateLimit:
    """Token bucket for the messages of one websocket; frames : number of frames per message."""

    def __init__(self, frames: int) -> None:
        self._frames = frames
        self._room, self._since = frames * BURST, time.monotonic()
        self._over = False

    def takes(self, socket: WebSocketHandler, frame: str | bytes) -> bool:
        """Return True if the frame is accepted; close the websocket if the rate or the size is too high."""
        now = time.monotonic()
        self._room = min(self._frames * BURST, self._room + self._frames * RATE * (now - self._since)) - 1.0
        self._since = now
        if self._over:
            return False
        if len(frame) > MESSAGE_LIMIT:
            self._over = True
            socket.close(1009, TOO_LARGE)
        elif self._room < 0.0:
            self._over = True
            socket.close(1008, TOO_MANY)
        return not self._over


async def say_goodbye(seconds: float) -> None:
    """Close all websockets and wait for the close handshakes, at most `seconds`."""
    for one in [*OPEN_SOCKETS]:
        one.close(1001, ENDING)
    ends = time.monotonic() + seconds
    while OPEN_SOCKETS and time.monotonic() < ends:
        await asyncio.sleep(0.02)
