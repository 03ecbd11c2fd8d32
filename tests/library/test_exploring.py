"""A scene in a notebook: its address and display, and the state it returns."""

import asyncio
import re
import sys
import threading
import time
import types
from contextlib import contextmanager
from html import escape

import pytest
from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.web import Application, RequestHandler
from tornado.websocket import WebSocketHandler, websocket_connect

import hess_explorer as hess
from hess_explorer.headless.browser import wait_ready
from hess_explorer.headless.screenshot import free_port
from hess_explorer.library import exploring
from hess_explorer.server.liveness import is_alive
from hess_mechanics.errors import InvalidParameter
from support.asynchronous import finished


def wait_reached(shown, h):
    """Wait until the state in Python is the one that was reached by hand."""
    end = time.monotonic() + 30.0
    while shown.state.parameters["h"] != h:
        assert time.monotonic() < end, shown.state
        time.sleep(0.05)


FORWARDED = set()
"""The open websockets of the proxy."""


class Forwarded(WebSocketHandler):
    """A websocket through the proxy, with the origin of the browser, as jupyter-server-proxy passes it."""

    def check_origin(self, origin):
        return True

    def select_subprotocol(self, offered):
        return offered[0] if offered else None

    async def open(self, port, rest):
        offered = self.request.headers.get("Sec-WebSocket-Protocol", "")
        request = HTTPRequest(
            f"ws://127.0.0.1:{port}/{rest}?{self.request.query}", headers={"Origin": self.request.headers["Origin"]}
        )
        self._far = await websocket_connect(
            request, subprotocols=[one.strip() for one in offered.split(",") if one], on_message_callback=self._back
        )

        FORWARDED.add(self)

    def on_close(self):
        self._far.close()

    def _back(self, message):
        if message is None:
            FORWARDED.discard(self)
            self.close()
        else:
            self.write_message(message, binary=isinstance(message, bytes))

    async def on_message(self, message):
        while not hasattr(self, "_far"):
            await asyncio.sleep(0.01)
        await self._far.write_message(message, binary=isinstance(message, bytes))


class Forward(RequestHandler):
    """A page or file through the proxy, which removes the folder of the user."""

    async def get(self, port, rest):
        address = f"http://127.0.0.1:{port}/{rest}?{self.request.query}"
        found = await AsyncHTTPClient().fetch(address, raise_error=False)
        self.set_status(found.code)
        for name in ("Content-Type", "Content-Security-Policy"):
            if name in found.headers:
                self.set_header(name, found.headers[name])
        self.finish(found.body or b"")


@contextmanager
def hub():
    """Yield the address of a proxy that serves 127.0.0.1:PORT/… at /user/me/proxy/PORT/…"""
    started, port = threading.Event(), free_port()

    async def run():
        at = r"/user/me/proxy/(\d+)/"
        routes = [(at + r"((?:ws|states|rooms/.*))", Forwarded), (at + "(.*)", Forward)]
        server = Application(routes, websocket_max_message_size=2**26).listen(port, "127.0.0.1")
        ended = asyncio.Event()
        loop.append((asyncio.get_running_loop(), ended))
        started.set()
        await ended.wait()
        server.stop()
        await server.close_all_connections()
        while FORWARDED:
            await asyncio.sleep(0.01)

    loop = []
    thread = threading.Thread(target=finished, args=(run(),))
    thread.start()
    assert started.wait(30)
    try:
        yield f"http://localhost:{port}"
    finally:
        loop[0][0].call_soon_threadsafe(loop[0][1].set)
        thread.join()


@pytest.mark.thorough
def test_a_scene_is_reached_through_the_proxy_of_a_hub(browser, monkeypatch):
    monkeypatch.setenv("JUPYTERHUB_SERVICE_PREFIX", "/user/me/")
    with hub() as address, hess.explore("suslov-hess", h=1.2, accuracy="draft") as shown:
        assert (shown.state.scene, shown.state.parameters["h"]) == ("suslov-hess", 1.2)
        port = int(re.match(r"/user/me/proxy/(\d+)/\?", shown.url)[1])
        assert f'src="{escape(shown.url)}&amp;embed=1"' in shown._repr_html_()
        page = browser.new_page()
        page.goto(address + shown.url)
        wait_ready(page)
        box = page.locator(".param-h input.exact")
        box.fill("0.5")
        box.press("Enter")
        wait_reached(shown, 0.5)
        assert shown.state.parameters["accuracy"] == "draft"
        page.close()
    assert not is_alive("127.0.0.1", port)


def test_a_scene_is_reached_by_its_port_and_in_colab_by_another_address(monkeypatch):
    assert exploring._reached(8123) == "http://127.0.0.1:8123/"
    asked = []
    colab = types.SimpleNamespace(eval_js=lambda code: asked.append(code) or "https://port.colab.example")
    monkeypatch.setitem(sys.modules, "google.colab.output", colab)
    assert exploring._reached(8123) == "https://port.colab.example/"
    assert asked == ["google.colab.kernel.proxyPort(8123)"]


def test_what_cannot_be_starts_nothing():
    with pytest.raises(InvalidParameter, match="no parameter 'height_of_it'"):
        hess.explore("suslov-hess", height_of_it=1.0)
