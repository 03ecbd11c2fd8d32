"""The public address of the page."""

from __future__ import annotations

import re

from tornado.httputil import HTTPServerRequest

_HOST = re.compile(r"[\w.-]+(:\d{1,5})?|\[[\da-fA-F:]+\](:\d{1,5})?", re.ASCII)
_SCHEME = re.compile("https?")
_PREFIX = re.compile(r"(/[\w.-]+)+", re.ASCII)


def home_of(request: HTTPServerRequest) -> str:
    """Return the public address of the page, with a slash at the end; respects X-Forwarded-Proto, -Host, -Prefix."""

    def told(name: str, allowed: re.Pattern[str], otherwise: str) -> str:
        # Each proxy appends to the header, so the first entry comes from the proxy that the browser addressed.
        value = request.headers.get(f"X-Forwarded-{name}", "").split(",")[0].strip()
        return value if allowed.fullmatch(value) else otherwise

    scheme = told("Proto", _SCHEME, request.protocol)
    host = told("Host", _HOST, request.host if _HOST.fullmatch(request.host) else "localhost")
    folder = request.path.rpartition("/")[0]
    return f"{scheme}://{host}{told('Prefix', _PREFIX, '')}{folder}/"
