"""Serving: one process, this machine only unless told otherwise."""

from __future__ import annotations

import gc
import logging
import threading
from collections.abc import Sequence

import panel as pn

from app.compute import warm
from app.page import page

__all__ = ["serve"]

MESSAGE_LIMIT = 256 * 1024
"""Bytes of one websocket message from the browser: slider values and clicks are far smaller."""

UNUSED_SESSION_MS = 60_000


def _warm() -> None:
    """Compile or load the kernels, and from then on collect garbage, but not among what is there already."""
    try:
        warm()
    finally:
        gc.freeze()
        gc.enable()


def serve(port: int, address: str, show: bool, origins: Sequence[str]) -> None:
    """Serve the explorer until interrupted.

    Parameters: `address` to listen on; `show` opens the browser; `origins` are the HOST:PORT pairs
    whose pages may open a websocket, besides this machine's own.
    """
    logging.getLogger("hess_explorer").setLevel(logging.INFO)
    pn.extension()
    # Kernels are compiled while the browser loads the page.
    threading.Thread(target=_warm, name="warm", daemon=True).start()
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
