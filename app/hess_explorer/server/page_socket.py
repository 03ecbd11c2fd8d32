"""The websocket of a page: sent at once, no more taken than a page sends, told when the server ends.

That is all that this package changes in Panel's server; the handler of "/ws" stands in the public list
`bokeh.server.urls.per_app_patterns`, where Panel puts its own in the same way.

A state goes as several small frames.  The system's default (Nagle's algorithm) keeps each back until the one before is
confirmed, and a browser confirms up to 40 ms later: `benchmark_page.py` measures it as the latency of a slider.
Tornado has the option, `WebSocketHandler.set_nodelay`, but neither Bokeh nor Panel passes it on.

A page asks for a state, and not again before that is painted.  What sends more than a page can is no page, and reads
why it was cut off.
"""

from __future__ import annotations

import asyncio
import logging
import time
from typing import Any

from bokeh.server.urls import per_app_patterns
from panel.io.server import WSHandler

__all__ = ["MESSAGE_LIMIT", "PageSocket", "say_goodbye", "use"]

logger = logging.getLogger("hess_explorer")

MESSAGE_LIMIT = 256 * 1024
"""Bytes of one frame: slider values and clicks are far smaller."""

RATE, BURST = 450.0, 900.0
"""Frames in a second, and at once.  A message is three frames; a page asks for as many states as its screen shows."""

# RFC 6455: no more than 123 bytes.
TOO_LARGE = f"A message may have {MESSAGE_LIMIT // 1024} KB: send a smaller one."
TOO_MANY = f"More than {RATE / 3.0:.0f} messages in a second: wait for each answer before you ask again."
ENDING = "The server ends or is started anew: open the page again in a moment."


class PageSocket(WSHandler):
    """The websocket of one page."""

    there: set[PageSocket] = set()  # noqa: RUF012  # one process serves one explorer

    def open(self) -> None:
        """Send every message at once."""
        self._room, self._since, self._cut_off = BURST, time.monotonic(), False
        super().open()  # type: ignore[no-untyped-call]  # Panel declares no types
        self.set_nodelay(True)
        PageSocket.there.add(self)

    def on_close(self) -> None:
        """It is there no more."""
        PageSocket.there.discard(self)
        super().on_close()

    async def on_message(self, fragment: str | bytes) -> None:
        """Take a frame, unless it is one too many or too large."""
        now = time.monotonic()
        self._room = min(BURST, self._room + RATE * (now - self._since)) - 1.0
        self._since = now
        if self._cut_off:
            return
        if len(fragment) > MESSAGE_LIMIT:
            self._cut(1009, TOO_LARGE)
        elif self._room < 0.0:
            self._cut(1008, TOO_MANY)
        else:
            await super().on_message(fragment)

    def _cut(self, code: int, why: str) -> None:
        self._cut_off = True
        self.close(code, why)


async def say_goodbye(seconds: float) -> None:
    """Tell all pages that the server ends, and wait so long at most until they have heard it."""
    for one in [*PageSocket.there]:
        one.close(1001, ENDING)
    ends = time.monotonic() + seconds
    while PageSocket.there and time.monotonic() < ends:
        await asyncio.sleep(0.02)


def use() -> None:
    """From the next server on; where the list is not what it was the page works, slower and without these limits."""
    handlers: list[Any] = [route[1] for route in per_app_patterns]
    if PageSocket in handlers:
        return
    if WSHandler not in handlers:
        logger.warning("Panel's websocket handler was not found: small messages may be delayed by up to 40 ms, and "
                       "nothing limits how many are taken.")
        return
    i = handlers.index(WSHandler)
    per_app_patterns[i] = (per_app_patterns[i][0], PageSocket)
