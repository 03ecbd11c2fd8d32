"""How a request over HTTP is refused: a status and a sentence."""

from __future__ import annotations

from tornado.web import RequestHandler

__all__ = ["refuse"]


def refuse(handler: RequestHandler, status: int, sentence: str) -> None:
    """Answer with this status and a sentence as plain text."""
    handler.set_status(status)
    handler.set_header("Content-Type", "text/plain; charset=utf-8")
    handler.finish(sentence)
