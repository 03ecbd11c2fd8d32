"""The web server: one process, reachable from this machine only unless told otherwise."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable, Sequence

import panel as pn
from tornado.web import RequestHandler
from tornado.websocket import WebSocketClosedError

from hess_explorer.compute.cache import CACHE
from hess_explorer.lessons.lesson import Lesson
from hess_explorer.page.page import page
from hess_explorer.server.liveness import is_alive
from hess_explorer.server.modules import module_routes
from hess_explorer.server.prompt_socket import send_promptly
from hess_explorer.server.qr_code import QrCode
from hess_explorer.server.warm import warm

__all__ = ["serve"]

MESSAGE_LIMIT = 256 * 1024
"""Bytes of one websocket message from the browser: slider values and clicks are far smaller."""

UNUSED_SESSION_MS = 60_000
_EVERY_ADDRESS = ("", "0.0.0.0", "::")

logger = logging.getLogger("hess_explorer")


class Metrics(RequestHandler):
    """GET /metrics: the counters of the cache, one `name value` in a line, as Prometheus reads them."""

    def get(self) -> None:
        """Answer with the counters as they are now."""
        self.set_header("Content-Type", "text/plain; version=0.0.4; charset=utf-8")
        self.finish("".join(f"hess_explorer_{name} {value}\n" for name, value in CACHE.metrics().items()))


def _is_news(record: logging.LogRecord) -> bool:
    """False for a page that was closed while an answer was on its way: not an error."""
    return not (record.exc_info and isinstance(record.exc_info[1], WebSocketClosedError))


def _prepare(address: str, port: int, ready: Callable[[], None]) -> None:
    """Prepare all scenes; call `ready` once the first is prepared and the server answers."""
    host = "127.0.0.1" if address in _EVERY_ADDRESS else address

    def first_is_ready() -> None:
        while not is_alive(host, port):
            time.sleep(0.05)
        ready()

    warm(first_is_ready)


def serve(port: int, address: str, show: bool, origins: Sequence[str], ready: Callable[[], None],
          lesson: Lesson | None = None) -> None:
    """Serve the explorer until interrupted.

    address : to listen on; show : open the browser; origins : HOST:PORT pairs whose pages may open a websocket,
    besides this machine's own; ready : called from another thread when the page answers without compiling
    first; lesson : one besides those of the package.
    """
    logging.basicConfig(format="%(asctime)s %(name)s %(message)s")
    logger.setLevel(logging.INFO)
    logging.getLogger("asyncio").addFilter(_is_news)
    pn.extension()
    send_promptly()
    # Kernels are compiled while the browser loads the page.
    threading.Thread(target=_prepare, args=(address, port, ready), name="warm", daemon=True).start()
    pn.serve(
        {"/": lambda: page(lesson)},
        title="Hess Explorer",
        port=port,
        address=address,
        show=show,
        websocket_origin=[f"localhost:{port}", f"127.0.0.1:{port}", *origins],
        extra_patterns=[("/metrics", Metrics), ("/qr.svg", QrCode), *module_routes()],
        liveness=True,
        verbose=False,
        websocket_max_message_size=MESSAGE_LIMIT,
        unused_session_lifetime_milliseconds=UNUSED_SESSION_MS,
        check_unused_sessions_milliseconds=UNUSED_SESSION_MS // 4,
        session_token_expiration=3600,
    )
