"""The hosts by which browsers may reach the server, and the origins that may open its websockets.

A page of any site may name this server as its own host (DNS rebinding), so that its requests count as those of the same
origin.  Requests are therefore refused unless their Host header is in the list.
"""

from __future__ import annotations

import logging
import re
import socket
from collections.abc import Sequence
from ipaddress import ip_address
from typing import Any, cast
from urllib.parse import urlsplit

from bokeh.server.server import Server
from bokeh.server.tornado import BokehTornado
from bokeh.server.util import check_allowlist
from tornado.httputil import HTTPServerRequest
from tornado.routing import Matcher, Rule
from tornado.web import RequestHandler

from hess_explorer.server.refusal import refuse

REFUSAL = (
    "The explorer is not served under this name. Open it by an address or the name of its machine, or restart it with "
    "--allow-origin and the host that the address bar shows."
)

logger = logging.getLogger("hess_explorer")


class Hosts(Matcher):
    """The hosts of a server: localhost, addresses and names of the machine, and further hosts.

    A matcher of Tornado's router that matches the requests for other hosts.

    Parameters
    ----------
    address : str
        Address at which the server listens.
    origins : sequence of str
        Further hosts as HOST or HOST:PORT; "*" allows all.
    """

    def __init__(self, address: str, origins: Sequence[str]) -> None:
        own = socket.gethostname().lower()
        further = (re.sub(r":\d+$", "", one) for one in origins)
        self._names = {"localhost", "127.0.0.1", "::1", own, f"{own}.local", *map(_bare, (address, *further))}

    def match(self, request: HTTPServerRequest) -> dict[str, Any] | None:
        """Return the arguments of the handler that rejects the request, or None if the host is allowed."""
        name = _bare(request.host_name)
        allowed = name in self._names or "*" in self._names or name == _local_address(request)
        return None if allowed else {}

    def guard(self, server: Server) -> None:
        """Reject all requests for other hosts."""
        # Bokeh's server does not expose its Tornado application, where a rule for the host must come before all paths.
        server._tornado.default_router.rules.insert(0, Rule(self, _Refused))


class _Refused(RequestHandler):
    """Handler of requests for other hosts."""

    async def prepare(self) -> None:
        refuse(self, 403, REFUSAL)


def _bare(name: str) -> str:
    """Return a host name or address in its usual form, without brackets."""
    return name.strip("[]").rstrip(".").lower()


def _local_address(request: HTTPServerRequest) -> str:
    """Return the address of this machine to which the client has connected."""
    connection: Any = request.connection
    try:
        found = ip_address(connection.stream.socket.getsockname()[0].partition("%")[0])
    except (AttributeError, OSError, ValueError):
        # The client has disconnected.
        return ""
    return str(getattr(found, "ipv4_mapped", None) or found)


def is_allowed_origin(handler: RequestHandler, origin: str) -> bool:
    """Return whether the origin is the host of the request, or an allowed origin; log a warning if it is neither."""
    host, application = urlsplit(origin).netloc.lower(), cast(BokehTornado, handler.application)
    if host == handler.request.host.lower() or check_allowlist(host, [*application.websocket_origins]):
        return True
    logger.warning("a websocket of a page of %s was refused; --allow-origin %s would allow it", host, host)
    return False
