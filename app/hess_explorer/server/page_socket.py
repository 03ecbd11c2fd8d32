"""The websocket by which Panel speaks with a page: of its theme, and once of what stands where.

All that is changed in Panel's server is how much of it is taken and that it is told when the server ends; the handler
of "/ws" stands in the public list `bokeh.server.urls.per_app_patterns`, where Panel puts its own in the same way.
"""

from __future__ import annotations

import logging
from typing import Any

from bokeh.server.urls import per_app_patterns
from panel.io.server import WSHandler

from hess_explorer.server.limits import THERE, Meter

__all__ = ["PageSocket", "use"]

logger = logging.getLogger("hess_explorer")


class PageSocket(WSHandler):
    """Panel's websocket of one page."""

    def open(self) -> None:
        """It is there."""
        # Of a message there are the header, the metadata and the content.
        self._meter = Meter(frames=3)
        super().open()  # type: ignore[no-untyped-call]  # Panel declares no types
        THERE.add(self)

    def on_close(self) -> None:
        """It is there no more."""
        THERE.discard(self)
        super().on_close()

    async def on_message(self, fragment: str | bytes) -> None:
        """Take a frame, unless it is one too many or too large."""
        if self._meter.takes(self, fragment):
            await super().on_message(fragment)


def use() -> None:
    """From the next server on; where the list is not what it was the page works, without these limits."""
    handlers: list[Any] = [route[1] for route in per_app_patterns]
    if PageSocket in handlers:
        return
    if WSHandler not in handlers:
        logger.warning("Panel's websocket handler was not found: nothing limits how many messages are taken there.")
        return
    i = handlers.index(WSHandler)
    per_app_patterns[i] = (per_app_patterns[i][0], PageSocket)
