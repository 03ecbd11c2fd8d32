"""Previews of links: the words and the picture of a state, for any link."""

import asyncio
import io
import threading
from html.parser import HTMLParser
from types import SimpleNamespace
from urllib.parse import urlencode, urlsplit
from urllib.request import Request, urlopen

import pytest
from PIL import Image
from tornado.httpclient import AsyncHTTPClient
from tornado.httpserver import HTTPServer
from tornado.httputil import HTTPHeaders
from tornado.testing import bind_unused_port
from tornado.web import Application

from hess_explorer.scenes import scenes
from hess_explorer.server import preview
from hess_explorer.server.preview import KEPT, MOST, Preview, tags
from hess_mechanics.errors import WorkLimit
from support.asynchronous import finished


class Head(HTMLParser):
    """The meta elements by property or name, and the names of all elements."""

    def __init__(self, html):
        super().__init__()
        self.facts, self.elements = {}, set()
        self.feed(html)

    def handle_starttag(self, tag, attrs):
        found = dict(attrs)
        self.elements.add((tag, *sorted(found)))
        self.facts[found.get("property", found.get("name"))] = found.get("content")


def head(query, host="here:5006", **headers):
    told = HTTPHeaders({name.replace("_", "-"): value for name, value in headers.items()})
    return Head(tags(SimpleNamespace(headers=told, host=host, protocol="http", path="/"), query))


@pytest.mark.parametrize("scene", scenes().values(), ids=scenes())
def test_words_and_picture_are_those_of_the_state(scene):
    for preset in scene.presets[:1]:
        facts = head(urlencode({"scene": scene.name, **preset.values, "t": "3"})).facts
        assert facts["og:title"].startswith(scene.title)
        assert facts["og:description"].startswith(scene.summary)
        assert facts["description"] == scene.summary
        assert preset.name.rstrip(".") in facts["og:description"]
        image = urlsplit(facts["og:image"])
        assert (image.scheme, image.netloc, image.path) == ("http", "here:5006", "/preview")
        assert f"scene={scene.name}&" in image.query
        assert "&t=3.0" in image.query
    moved = head("scene=suslov-hess&h=1.2345&large=omega").facts
    assert "1.234" in moved["og:description"] or "1.235" in moved["og:description"]
    assert "large=omega" in moved["og:image"]


@pytest.mark.parametrize(
    "query, headers",
    [
        ('scene="><script>alert(1)</script>', {}),
        ("scene=suslov-hess&h=%22%3E%3Cimg+src%3Dx+onerror%3Dalert(1)%3E&large=%3Cb%3E&lesson=%22%3E", {}),
        ("h=nan&" + "f=1&" * 20000, {"X_Forwarded_Host": 'evil"><script>', "X_Forwarded_Proto": "javascript"}),
        ("t=1e999&az=x", {"host": "a b<c", "X_Forwarded_Prefix": "/../<x>"}),
    ],
)
def test_a_forged_link_adds_no_element_and_no_address(query, headers):
    found = head(query, **headers)
    assert found.elements == {("meta", "content", "property"), ("meta", "content", "name")}
    for name in ("og:url", "og:image"):
        parts = urlsplit(found.facts[name])
        assert (parts.scheme, parts.netloc) in {("http", "here:5006"), ("http", "localhost")}
        assert not set('<>"') & set(found.facts[name])


@pytest.mark.parametrize(("query", "schemes"), [("", "light dark"), ("theme=dark", "dark"), ("theme=light", "light")])
def test_the_first_frame_has_the_theme_of_the_link(query, schemes):
    assert head(query).facts["color-scheme"] == schemes


def test_behind_a_proxy_the_addresses_are_those_of_the_proxy():
    forwarded = {"X_Forwarded_Proto": "https, http", "X_Forwarded_Host": "hess.example.org", "X_Forwarded_Prefix": "/x"}
    assert head("h=1.2", **forwarded).facts["og:image"].startswith("https://hess.example.org/x/preview?")


def test_the_page_names_a_picture_that_there_is(server):
    with urlopen(Request(f"{server}/?scene=kharlamova&accuracy=draft", headers={"User-Agent": "bot"})) as answer:
        facts = Head(answer.read().decode()).facts
    with urlopen(facts["og:image"]) as answer:
        assert answer.headers["Content-Type"] == "image/png"
        assert Image.open(io.BytesIO(answer.read())).size == (1200, 630)
    assert facts["og:title"].startswith(scenes()["kharlamova"].title)


def test_equal_states_are_drawn_once_and_a_busy_server_sends_a_fixed_picture(monkeypatch):
    drawn, go = [], threading.Event()

    def made(shown):
        go.wait(30.0)
        drawn.append(shown.link)
        if "h=0.5" in shown.link:
            raise WorkLimit("too long")
        return b"a card"

    monkeypatch.setattr(preview, "_made", made)
    monkeypatch.setattr(Preview, "kept", type(Preview.kept)())

    async def run():
        socket, port = bind_unused_port()
        server = HTTPServer(Application([("/preview", Preview)]))
        server.add_socket(socket)
        client = AsyncHTTPClient(max_clients=50)

        async def get(query):
            answer = await client.fetch(f"http://127.0.0.1:{port}/preview?{query}", raise_error=False)
            return answer.headers["Content-Type"], answer.body

        same = [asyncio.ensure_future(get(query)) for query in ("h=1.5", "h=1.50&f=0.6", "f=0.6&h=1.5&theme=dark")]
        others = [asyncio.ensure_future(get(f"h=1.{k}")) for k in range(1, MOST)]
        await asyncio.sleep(1.0)
        refused = await get("h=0.9")
        go.set()
        made = await asyncio.gather(*same, *others)
        failed = await get("h=0.5")
        for k in range(KEPT):
            await get(f"h=2.{k:03}")
        assert (await client.fetch(f"http://127.0.0.1:{port}/preview?{'x' * 9000}", raise_error=False)).code == 400
        server.stop()
        return refused, made, failed

    refused, made, failed = finished(run())
    assert set(made) == {("image/png", b"a card")}
    for kind, body in (refused, failed):
        assert kind == "image/jpeg"
        assert Image.open(io.BytesIO(body)).size[0] > 200
    assert sum("h=1.5&" in link for link in drawn) == 1
    assert len(Preview.kept) == KEPT
