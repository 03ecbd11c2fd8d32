"""Access control: origins that may connect to the server, and sites that may embed the page."""

import json
import re
import socket
from types import SimpleNamespace

import pytest
from tornado.httpclient import AsyncHTTPClient, HTTPClientError, HTTPRequest
from tornado.httputil import HTTPHeaders
from tornado.websocket import websocket_connect

from hess_explorer.assets import modules_path
from hess_explorer.server.handlers import replace_handlers
from hess_explorer.server.headers import GuardedDocument, policy
from hess_explorer.server.home import home_of
from hess_explorer.server.hosts import REFUSAL
from support.asynchronous import finished
from support.serving import served
from support.visitor import Visitor


def fetched(base, *paths):
    async def fetch():
        return [await AsyncHTTPClient().fetch(f"{base}/{path}") for path in paths]

    return finished(fetch())


async def opened(base, headers, path="states"):
    """The status of the response to a websocket request with these headers, and the text of a refusal."""
    request = HTTPRequest(f"ws{base.removeprefix('http')}/{path}", headers=headers)
    try:
        connection = await websocket_connect(request, subprotocols=["bokeh"])
    except HTTPClientError as refused:
        return refused.code, refused.response.body.decode()
    if path != "ws":
        connection.close()
    # The server closes that of Panel.
    while await connection.read_message() is not None:
        pass
    connection.close()
    return 101, ""


SOCKETS = ("states", "ws", "rooms/ABCDEF")
PATHS = (
    *("", "r/ABCDEF", "liveness", "metrics", "static/js/bokeh.min.js", "export?picture=circle", "qr.svg?text=a"),
    *("autoload.js", "favicon.ico", "nothing"),
    *(f"{modules_path()}/page/{name}.js" for name in ("start", "served")),
)


def test_requests_for_another_host_are_refused_whatever_their_path(caplog):
    """DNS rebinding: a page of evil.com names this server as its own host, so that both headers are alike."""

    async def status(base, path, host, method="GET"):
        request = HTTPRequest(f"{base}/{path}", headers={"Host": host}, method=method)
        answer = await AsyncHTTPClient().fetch(request, raise_error=False)
        return answer.code, answer.body.decode()

    async def refused(base):
        found = [await status(base, path, "evil.com", method) for path in PATHS for method in ("GET", "DELETE")]
        # The address of no connection here, and names that only look like allowed ones.
        for host in ("192.0.2.1", "127.0.0.1.evil.com", "localhost.evil.com", "evil.com:80", "evil-localhost", "[::2]"):
            found.append(await status(base, "", host))
        evil = {"Host": "evil.com", "Origin": "http://evil.com"}
        return {*found, *[await opened(base, evil, path) for path in SOCKETS]}

    async def allowed(base, *hosts):
        # Also where a port is forwarded to this one: then both headers name that.
        return {
            code
            for host in hosts
            for code, _ in (
                await status(base, "liveness", host),
                await opened(base, {"Host": host, "Origin": f"http://{host}"}),
            )
        }

    own = socket.gethostname()
    hosts = (
        "localhost:8888",
        "LOCALHOST",
        "[::1]:80",
        own,
        f"{own}.local",
        "example.org",
        "example.org:8443",
        "127.0.0.1",
    )
    with served(address="0.0.0.0", origins=("example.org:8443",)) as base:
        assert finished(refused(base)) == {(403, REFUSAL)}
        assert finished(allowed(base, *hosts, "example.org", "example.org:8443")) == {200, 101}
        # The address that a client has connected to is one of the machine.
        assert finished(allowed(base.replace("127.0.0.1", "127.0.0.2"), "127.0.0.2")) == {200, 101}
        assert finished(status(base, "liveness", "127.0.0.2"))[0] == 403
        # A proxy with the name of the server in its own requests.
        assert finished(opened(base, {"Host": "127.0.0.1", "Origin": "https://example.org:8443"}))[0] == 101
        # Panel's websocket without the token of a page is closed, and no error.
        assert finished(opened(base, {}, "ws")) == (101, "")
        for origin in ("http://evil.com", "http://example.org", "http://localhost:8888"):
            assert finished(opened(base, {"Host": "localhost", "Origin": origin}))[0] == 403
    assert "exception" not in caplog.text
    with served(origins=("*",)) as base:
        assert finished(allowed(base, "hub.example.org")) == {200, 101}


def test_the_page_runs_its_own_scripts_and_only_its_parts_are_shown_elsewhere():
    with served(embedders=("example.org",)) as base:
        whole, part, again, dark, forged = fetched(base, "", "?embed=1", "", "?theme=dark", "?theme=%22%3E")
        with pytest.raises(HTTPClientError, match="403"):
            finished(Visitor.open(base, origin="http://example.org"))
    policies = [
        dict(one.split(" ", 1) for one in answer.headers["Content-Security-Policy"].split("; "))
        for answer in (whole, part, again)
    ]
    for answer, given in zip((whole, part, again), policies, strict=True):
        text = answer.body.decode()
        # A hub serves it below a folder of the user.
        assert not re.search(r'\b(?:src|href)="/', text)
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
    # The first frame has the theme of the link.
    for answer, schemes in ((whole, "light dark"), (dark, "dark"), (forged, "light dark")):
        assert f'<meta name="color-scheme" content="{schemes}">' in answer.body.decode()
    replace_handlers([])
    assert policy("", GuardedDocument.embedders).endswith("frame-ancestors 'none'")
    assert "X-Frame-Options" not in part.headers


@pytest.mark.parametrize(
    ("host", "headers", "address"),
    [
        ("here:5006", {}, "http://here:5006/"),
        ("a b<c", {"Prefix": "/../<x>"}, "http://localhost/"),
        ("here:5006", {"Host": 'evil"><script>', "Proto": "javascript"}, "http://here:5006/"),
        ("a", {"Proto": "https, http", "Host": "hess.example.org", "Prefix": "/x"}, "https://hess.example.org/x/"),
    ],
)
def test_the_address_of_the_page_is_that_of_its_proxy_and_never_forged(host, headers, address):
    told = HTTPHeaders({f"X-Forwarded-{name}": value for name, value in headers.items()})
    assert home_of(SimpleNamespace(headers=told, host=host, protocol="http", path="/")) == address


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
