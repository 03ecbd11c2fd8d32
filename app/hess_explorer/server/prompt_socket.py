"""Small messages of the websocket sent at once: all that this package changes in Panel's server.

A state goes as several small frames.  The system's default (Nagle's algorithm) keeps each back until the one before is
confirmed, and a browser confirms up to 40 ms later: `benchmark_page.py` measures it as the latency of a slider.
Tornado has the option, `WebSocketHandler.set_nodelay`, but neither Bokeh nor Panel passes it on; the handler of "/ws"
stands in the public list `bokeh.server.urls.per_app_patterns`, where Panel puts its own in the same way.
"""

from __future__ import annotations

import logging

from bokeh.server.urls import per_app_patterns
from panel.io.server import WSHandler

__all__ = ["send_promptly"]

logger = logging.getLogger("hess_explorer")


class PromptSocket(WSHandler):
    """The websocket of a page, without that delay."""

    def open(self) -> None:
        """Send every message at once."""
        super().open()  # type: ignore[no-untyped-call]  # Panel declares no types
        self.set_nodelay(True)


def send_promptly() -> None:
    """From the next server on; where the list is not what it was the page works, some 40 ms slower for each state."""
    places = [i for i, route in enumerate(per_app_patterns) if route[1] is WSHandler]
    if not places:
        logger.warning("Panel's websocket handler was not found: small messages may be delayed by up to 40 ms")
    for i in places:
        per_app_patterns[i] = (per_app_patterns[i][0], PromptSocket)
