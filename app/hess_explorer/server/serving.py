"""Serving: one process, this machine only unless told otherwise."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Sequence

import panel as pn
from panel.io.server import WSHandler, per_app_patterns
from tornado.websocket import WebSocketClosedError

from hess_explorer.compute.cache import CACHE
from hess_explorer.page.page import page
from hess_explorer.server.warm import warm

__all__ = ["serve"]

MESSAGE_LIMIT = 256 * 1024
"""Bytes of one websocket message from the browser: slider values and clicks are far smaller."""

UNUSED_SESSION_MS = 60_000
REPORT_SECONDS = 60

logger = logging.getLogger("hess_explorer")


class PromptSocket(WSHandler):
    """The websocket of a page; without this the system keeps small messages back, up to 40 ms for each state."""

    def open(self) -> None:
        """Send every message at once."""
        super().open()
        self.set_nodelay(True)


def _is_news(record: logging.LogRecord) -> bool:
    """A page that was closed while an answer was on its way is no error."""
    return not (record.exc_info and isinstance(record.exc_info[1], WebSocketClosedError))


def _report() -> None:
    """Now and then a line "metrics name value …" in the log, when something has changed."""
    last = ""
    while True:
        line = CACHE.metrics()
        if line != last:
            logger.info("metrics %s", line)
        last = line
        time.sleep(REPORT_SECONDS)


def serve(port: int, address: str, show: bool, origins: Sequence[str]) -> None:
    """Serve the explorer until interrupted.

    Parameters: `address` to listen on; `show` opens the browser; `origins` are the HOST:PORT pairs
    whose pages may open a websocket, besides this machine's own.
    """
    logging.basicConfig(format="%(asctime)s %(name)s %(message)s")
    logger.setLevel(logging.INFO)
    logging.getLogger("asyncio").addFilter(_is_news)
    pn.extension()
    per_app_patterns[:] = [
        ("/ws", PromptSocket) if pattern[1] is WSHandler else pattern for pattern in per_app_patterns]
    # Kernels are compiled while the browser loads the page.
    threading.Thread(target=warm, name="warm", daemon=True).start()
    threading.Thread(target=_report, name="report", daemon=True).start()
    pn.serve(
        {"/": page},
        title="Hess Explorer",
        port=port,
        address=address,
        show=show,
        websocket_origin=[f"localhost:{port}", f"127.0.0.1:{port}", *origins],
        liveness=True,
        verbose=False,
        websocket_max_message_size=MESSAGE_LIMIT,
        unused_session_lifetime_milliseconds=UNUSED_SESSION_MS,
        check_unused_sessions_milliseconds=UNUSED_SESSION_MS // 4,
        session_token_expiration=3600,
    )
