"""Reject an HTTP request with a status and a message."""

from __future__ import annotations

from tornado.web import RequestHandler


def refuse(handler: RequestHandler, status: int, sentence: str) -> None:
    """Respond with an HTTP status and a plain-text message."""
    handler.set_status(status)
    handler.set_header("Content-Type", "text/plain; charset=utf-8")
    handler.finish(sentence)
