"""Check that a server responds."""

from __future__ import annotations

from http.client import HTTPConnection, HTTPException


def is_alive(host: str, port: int) -> bool:
    """Return whether an explorer responds at this address within 5 s."""
    connection = HTTPConnection(host, port, timeout=5)
    try:
        connection.request("GET", "/liveness")
        return connection.getresponse().status == 200
    except (OSError, HTTPException):
        return False
    finally:
        connection.close()
