"""Access control: origins that may connect to the server, and sites that may embed the page."""

import json
import re

import pytest
from tornado.httpclient import AsyncHTTPClient, HTTPClientError, HTTPRequest
from tornado.websocket import websocket_connect

from hess_explorer.server.handlers import replace_handlers
from hess_explorer.server.headers import GuardedDocument, policy
from support.asynchronous import finished
from support.serving import served
from support.visitor import Visitor


def fetched(base, *paths):
    async def fetch():
        return [await AsyncHTTPClient().fetch(f"{base}/{path}") for path in paths]

    return finished(fetch())


async def first_answer(base, origin):
    """The first frame of a websocket that a page of this origin opens, without a page of ours."""
    request = HTTPRequest(f"ws{base.removeprefix('http')}/states", headers={"Origin": origin})
    socket = await websocket_connect(request)
    first = await socket.read_message()
    socket.close()
    while await socket.read_message() is not None:
        pass
    return first


def test_the_page_runs_its_own_scripts_and_only_its_parts_are_shown_elsewhere():
    with served(embedders=("example.org",)) as base:
        whole, part, again = fetched(base, "", "?embed=1", "")
        with pytest.raises(HTTPClientError, match="403"):
            finished(Visitor.open(base, origin="http://example.org"))
        with pytest.raises(HTTPClientError, match="403"):
            finished(first_answer(base, "http://example.org"))
        assert finished(first_answer(base, base)) is not None
    policies = [
        dict(one.split(" ", 1) for one in answer.headers["Content-Security-Policy"].split("; "))
        for answer in (whole, part, again)
    ]
    for answer, given in zip((whole, part, again), policies, strict=True):
        text = answer.body.decode()
        nonces = re.findall(r'<script nonce="([^"]+)"', text)
        assert nonces
        assert len(nonces) == len(re.findall(r"<script\b", text))
        assert set(nonces) == {re.search(r"'nonce-([^']+)'", given["script-src"])[1]}
        assert "unsafe-inline" not in given["script-src"]
        assert given["default-src"] == "'none'"
        assert "http" not in answer.headers["Content-Security-Policy"]
    assert policies[0]["script-src"] != policies[2]["script-src"]
    assert (policies[0]["frame-ancestors"], whole.headers["X-Frame-Options"]) == ("'self'", "SAMEORIGIN")
    assert policies[1]["frame-ancestors"] == "example.org"
    assert "frame-ancestors" not in policy("", ("*",))
    replace_handlers([])
    assert policy("", GuardedDocument.embedders).endswith("frame-ancestors 'none'")
    assert "X-Frame-Options" not in part.headers


def test_a_page_whose_websocket_comes_to_another_process_asks_no_other_host():
    """As after a restart, or with several workers: the session is made by the websocket, and not with the HTML."""
    with served(unused_session_lifetime_milliseconds=1, check_unused_sessions_milliseconds=20) as base:

        async def late():
            visitor = await Visitor.open(base, "scene=scattering", pause=0.5)
            state = await visitor.ask(values={"theta": 1.0})
            await visitor.leave()
            return visitor.document, state

        document, state = finished(late())
    text = json.dumps(document)
    assert "static/extensions/panel/css/loading.css" in text
    assert not re.search(r"https?://(?!www\.w3\.org/)[\w.]*(?:cdn|holoviz|bokeh)[\w.]*/[^\"]*\.(?:css|js)", text)
    assert (state["scene"], state["answers"]) == ("scattering", 1)
