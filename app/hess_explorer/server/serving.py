"""The web server; by default one process that listens only on this machine."""

from __future__ import annotations

import logging
import sys
import threading
import time
from collections.abc import Callable, Mapping, Sequence
from typing import Any, NoReturn

import panel as pn
from bokeh.document import Document
from bokeh.server.server import Server
from bokeh.util.logconfig import basicConfig
from panel.io.resources import LOCAL_DIST, patch_model_css
from panel.io.server import get_server
from tornado.process import task_id
from tornado.web import RequestHandler
from tornado.websocket import WebSocketClosedError

from hess_explorer.compute.cache import CACHE
from hess_explorer.compute.pool import POOL
from hess_explorer.lessons import package_lessons
from hess_explorer.lessons.lesson import Lesson
from hess_explorer.page.page import page
from hess_explorer.rooms.messages import CODE
from hess_explorer.rooms.registry import Rooms
from hess_explorer.server.export import Export
from hess_explorer.server.handlers import replace_handlers
from hess_explorer.server.hosts import Hosts
from hess_explorer.server.limits import MESSAGE_LIMIT, OPEN_SOCKETS, Capacity
from hess_explorer.server.liveness import is_alive
from hess_explorer.server.modules import module_routes
from hess_explorer.server.qr_code import QrCode
from hess_explorer.server.room_page import RoomPage
from hess_explorer.server.room_socket import RoomSocket
from hess_explorer.server.shutdown import Workers, end_on_signals, exit_process
from hess_explorer.server.warm import warm
from hess_explorer.server.websockets import StateSocket

BODY_LIMIT = 64 * 1024
"""Maximum size of a request body in bytes; no handler uses one."""

UNUSED_SESSION_MS = 60_000
_EVERY_ADDRESS = ("", "0.0.0.0", "::")

logger = logging.getLogger("hess_explorer")


class Metrics(RequestHandler):
    """GET /metrics: the counters of this worker in the Prometheus text format."""

    def initialize(self, capacity: Capacity, rooms: Rooms) -> None:
        """Store the counters of sessions and rooms."""
        self._capacity, self._rooms = capacity, rooms

    def get(self) -> None:
        """Respond with the current counters."""
        self.set_header("Content-Type", "text/plain; version=0.0.4; charset=utf-8")
        counters = {
            **CACHE.metrics(),
            **self._rooms.metrics(),
            "sessions": self._capacity.sessions,
            "websockets": len(OPEN_SOCKETS),
            "threads": threading.active_count(),
        }
        label = f'{{worker="{task_id() or 0}"}}'
        self.finish("".join(f"hess_explorer_{name}{label} {value}\n" for name, value in counters.items()))


def _is_news(record: logging.LogRecord) -> bool:
    """Return whether to log a record: not the error of a page that closed while a response was being sent."""
    return not (record.exc_info and isinstance(record.exc_info[1], WebSocketClosedError))


def _prepare(address: str, port: int, ready: Callable[[], None]) -> None:
    """Prepare all scenes; call `ready` when the first scene is prepared and the server responds."""
    host = "127.0.0.1" if address in _EVERY_ADDRESS else address

    def first_is_ready() -> None:
        while not is_alive(host, port):
            time.sleep(0.05)
        ready()

    warm(first_is_ready)


def _page(lessons: Sequence[Lesson], capacity: Capacity) -> Any:
    """Return the page with the style sheets of this server, or a message if the server is full."""
    if not capacity.reserve():
        return pn.pane.Str(capacity.sentence)
    document = pn.state.curdoc
    if document is not None:
        document.add_next_tick_callback(lambda: _own_styles(document))
    return page(lessons)


def _own_styles(document: Document) -> None:
    """Let style sheets refer to this server; Panel does so only in the process that writes the HTML."""
    for root in document.roots:
        patch_model_css(root, dist_url=LOCAL_DIST)


def _lessons(own: Sequence[Lesson]) -> Mapping[str, Lesson]:
    """Return the available lessons by name."""
    return {**{lesson.name: lesson for lesson in own}, **package_lessons()}


def create_server(
    port: int,
    address: str,
    origins: Sequence[str],
    lessons: Sequence[Lesson] = (),
    *,
    sessions: int,
    follow: Callable[[str], None] | None = None,
    workers: int = 1,
    **changed: Any,
) -> Server:
    """Return a server that listens but is not started.

    Parameters
    ----------
    port, address, origins, lessons, sessions, follow, workers
        As in `serve`.
    **changed
        Options of `panel.io.server.get_server` that replace the defaults.

    Returns
    -------
    bokeh.server.server.Server
        The server; with several workers, this returns in each of them, but not in their parent process.
    """
    capacity, rooms = Capacity(sessions), Rooms(_lessons(lessons))
    patterns = [
        ("/states", StateSocket, {"capacity": capacity, "lessons": lessons, "follow": follow}),
        ("/metrics", Metrics, {"capacity": capacity, "rooms": rooms}),
        (f"/r/({CODE})", RoomPage),
        (f"/rooms/({CODE})", RoomSocket, {"rooms": rooms, "workers": workers}),
        ("/qr.svg", QrCode),
        ("/export", Export),
        *module_routes(),
    ]
    options = {
        "title": "Hess Explorer",
        "port": port,
        "address": address,
        "websocket_origin": [f"localhost:{port}", f"127.0.0.1:{port}", *origins],
        "extra_patterns": patterns,
        "liveness": True,
        "num_procs": workers,
        "verbose": False,
        # Allow more than `RateLimit`, whose error message is clearer than that of Tornado.
        "websocket_max_message_size": 4 * MESSAGE_LIMIT,
        # Disconnect slow clients after these timeouts in seconds.
        "http_server_kwargs": {"max_body_size": BODY_LIMIT, "body_timeout": 20.0, "idle_connection_timeout": 300.0},
        "unused_session_lifetime_milliseconds": UNUSED_SESSION_MS,
        "check_unused_sessions_milliseconds": UNUSED_SESSION_MS // 4,
        "session_token_expiration": 3600,
    }
    # With several workers, `get_server` forks and returns in each worker; the parent process supervises them.
    server = get_server({"/": lambda: _page(lessons, capacity)}, start=False, **{**options, **changed})
    Hosts(address, origins).guard(server)
    return server


def serve(
    port: int,
    address: str,
    show: bool,
    origins: Sequence[str],
    ready: Callable[[], None],
    lessons: Sequence[Lesson] = (),
    embedders: Sequence[str] = ("*",),
    workers: int = 1,
    *,
    sessions: int,
    follow: Callable[[str], None] | None = None,
) -> NoReturn:
    """Serve the explorer until Ctrl-C or SIGTERM, then end the process with exit status 0.

    Parameters
    ----------
    port : int
        TCP port to listen on.
    address : str
        Address to listen on.
    show : bool
        True to open the page in a browser.
    origins : sequence of str
        HOST or HOST:PORT of further hosts by which browsers reach the server; "*" allows all.  Those of this machine
        are always allowed.
    ready : callable
        Called once, from another thread, when the page can be shown without compiling first.
    lessons : sequence of Lesson
        Lessons in addition to those of the package.
    embedders : sequence of str
        Hosts that may embed parts of the page; "*" allows all.
    workers : int
        Number of worker processes.  A session stays with the worker that accepted its websocket.
    sessions : int
        Maximum number of sessions per worker.
    follow : callable or None
        Called with the query of every state that a page shows, from any thread.

    Raises
    ------
    HandlerMissing
        If the installed version of Panel or Bokeh is not supported.
    """
    # Use Bokeh's `basicConfig`, because the handler of its logger prints no times.
    basicConfig(format="%(asctime)s %(name)s %(message)s", datefmt="%Y-%m-%dT%H:%M:%S%z")
    logging.captureWarnings(True)
    logger.setLevel(logging.INFO)
    logging.getLogger("asyncio").addFilter(_is_news)
    # Longest wait of the event loop for the interpreter lock behind a computing thread; the default is 5 ms.
    sys.setswitchinterval(0.001)
    pn.extension()
    replace_handlers(embedders)
    together = Workers() if workers > 1 else None
    server = create_server(
        port,
        address,
        origins,
        lessons,
        sessions=sessions,
        follow=follow,
        workers=workers,
        show=show and workers == 1,
    )
    end_on_signals(server.io_loop)
    if together is not None:
        # Only one worker reports that the explorer is ready, and all end with the parent process.
        ready = ready if task_id() == 0 else lambda: None
        together.end_with_parent(server.io_loop)
        POOL.set_cores(POOL.cores // workers)
    # Compile kernels while the browser loads the page.
    threading.Thread(target=_prepare, args=(address, port, ready), name="warm", daemon=True).start()
    server.start()
    server.io_loop.start()
    exit_process(server)
