"""Serve the JavaScript modules and the images of the scenes under a URL that contains their hash."""

from __future__ import annotations

import datetime
from typing import Any

from tornado.web import RequestHandler, StaticFileHandler

from hess_explorer.assets import STATIC, modules_path
from hess_explorer.bundle import bundle

_FILES = r"page/start\.js|thumbnails/[a-z-]+\.jpg"
_BUNDLES = r"page/(?:served|follow)\.js"
_YEAR = 365 * 24 * 3600


class _File(StaticFileHandler):
    """Handler of an immutable file, which a browser requests only once."""

    def get_cache_time(self, path: str, modified: datetime.datetime | None, mime_type: str) -> int:
        return _YEAR

    def set_extra_headers(self, path: str) -> None:
        _set_headers(self)


class _Bundle(RequestHandler):
    """Handler of a bundled module."""

    def get(self, path: str) -> None:
        self.set_header("Content-Type", "text/javascript; charset=utf-8")
        _set_headers(self)
        self.finish(bundle(path))


def _set_headers(handler: RequestHandler) -> None:
    handler.set_header("Cache-Control", f"public, max-age={_YEAR}, immutable")
    handler.set_header("X-Content-Type-Options", "nosniff")


def module_routes() -> list[tuple[Any, ...]]:
    """Return the Tornado routes; no other file of the folder is served."""
    return [
        (rf"/{modules_path()}/({_BUNDLES})", _Bundle),
        (rf"/{modules_path()}/({_FILES})", _File, {"path": str(STATIC)}),
    ]
