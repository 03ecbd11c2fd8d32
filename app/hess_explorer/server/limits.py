"""What one websocket may send, and how all of them are told that the server ends.

A page asks for a state, and not again before that is painted.  What sends more than a page can is no page, and reads
why it was cut off.
"""

from __future__ import annotations

import asyncio
import time

from tornado.websocket import WebSocketHandler

__all__ = ["MESSAGE_LIMIT", "OPEN_SOCKETS", "RateLimit", "say_goodbye"]

MESSAGE_LIMIT = 256 * 1024
"""Bytes of one frame: slider values and clicks are far smaller."""

RATE, BURST = 150.0, 300.0
"""Messages in a second, and at once: a page asks for as many states as its screen shows."""

# RFC 6455: no more than 123 bytes.
TOO_LARGE = f"A message may have {MESSAGE_LIMIT // 1024} KB: send a smaller one."
TOO_MANY = f"More than {RATE:.0f} messages in a second: wait for each answer before you ask again."
ENDING = "The server ends or is started anew: open the page again in a moment."

OPEN_SOCKETS: set[WebSocketHandler] = set()
"""All websockets of this process."""


class RateLimit:
    """Counts what comes in by one websocket.

    frames : of which a message consists.
    """

    def __init__(self, frames: int) -> None:
        self._frames = frames
        self._room, self._since = frames * BURST, time.monotonic()
        self._over = False

    def takes(self, socket: WebSocketHandler, frame: str | bytes) -> bool:
        """Whether this frame is taken; if it is one too many or too large, the websocket is closed with a sentence."""
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
    """Tell all pages that the server ends, and wait so long at most until they have heard it."""
    for one in [*OPEN_SOCKETS]:
        one.close(1001, ENDING)
    ends = time.monotonic() + seconds
    while OPEN_SOCKETS and time.monotonic() < ends:
        await asyncio.sleep(0.02)
