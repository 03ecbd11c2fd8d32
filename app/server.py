"""Serving: one process, this machine only unless told otherwise."""

from __future__ import annotations

import gc
import logging
import threading
import time
from collections.abc import Sequence

import panel as pn
from tornado.websocket import WebSocketClosedError

from app.compute import CACHE, warm
from app.description import describe
from app.page import page
from app.scenes import scenes

__all__ = ["serve"]

MESSAGE_LIMIT = 256 * 1024
"""Bytes of one websocket message from the browser: slider values and clicks are far smaller."""

UNUSED_SESSION_MS = 60_000
REPORT_SECONDS = 60

logger = logging.getLogger("hess_explorer")


def _warm() -> None:
    """Compile or load the kernels, build the pictures; then collect garbage again, but not among all these."""
    try:
        warm()
        for name in scenes():
            describe(name)
    finally:
        gc.freeze()
        gc.enable()


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
    # Kernels are compiled while the browser loads the page.
    threading.Thread(target=_warm, name="warm", daemon=True).start()
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
