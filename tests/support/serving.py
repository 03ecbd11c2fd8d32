"""Serve the page in the test's process, so that leftover objects can be counted."""

import logging
from contextlib import contextmanager

import panel as pn
from panel.io.threads import StoppableThread
from tornado.ioloop import IOLoop

from hess_explorer.headless.screenshot import free_port
from hess_explorer.server.handlers import replace_handlers
from hess_explorer.server.liveness import is_alive
from hess_explorer.server.serving import create_server
from support.asynchronous import wait_until


@contextmanager
def served(embedders=("*",), sessions=1000, lessons=(), address="127.0.0.1", origins=(), **changed):
    """Yield the URL of a server in another thread; changed : further arguments of `create_server`."""
    port, loop = free_port(), IOLoop(make_current=False)

    def run():
        server = create_server(port, address, origins, lessons, sessions=sessions, loop=loop, **changed)
        server.start()
        loop.start()
        return server

    pn.extension()
    replace_handlers(embedders)
    thread = StoppableThread(target=run, io_loop=loop, owns_loop=True)
    thread.start()
    # What pytest keeps of a log holds what it speaks of.
    logging.disable(logging.INFO)
    try:
        wait_until(lambda: is_alive("127.0.0.1", port), 30.0)
        yield f"http://127.0.0.1:{port}"
    finally:
        logging.disable(logging.NOTSET)
        thread.stop()
        thread.join(10.0)
        pn.state.kill_all_servers()
