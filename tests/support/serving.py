"""Serve the page in the test's process, so that leftover objects can be counted."""

import logging
import time
from contextlib import contextmanager

import panel as pn

from hess_explorer.headless.screenshot import free_port
from hess_explorer.server import serving
from hess_explorer.server.handlers import replace_handlers
from hess_explorer.server.liveness import is_alive


@contextmanager
def served(embedders=("*",), sessions=1000, lessons=(), **changed):
    """Yield the URL of a server in another thread, with the options of `serve` except those given."""
    port = free_port()
    options = {**serving.options(port, "127.0.0.1", [], lessons, sessions=sessions), **changed}
    pn.extension()
    replace_handlers(embedders)
    thread = pn.serve(show=False, threaded=True, **options)
    # What pytest keeps of a log holds what it speaks of.
    logging.disable(logging.INFO)
    try:
        end = time.monotonic() + 30.0
        while not is_alive("127.0.0.1", port):
            assert time.monotonic() < end, "the server does not answer"
            time.sleep(0.02)
        yield f"http://127.0.0.1:{port}"
    finally:
        logging.disable(logging.NOTSET)
        thread.stop()
        thread.join(10.0)
        pn.state.kill_all_servers()
