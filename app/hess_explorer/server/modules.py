"""The JavaScript modules of the page and the styles of what is printed, under a URL that changes when they do."""

from __future__ import annotations

import datetime
from typing import Any

from tornado.web import StaticFileHandler

from hess_explorer.assets import MODULES, STATIC, modules_path

__all__ = ["module_routes"]

_YEAR = 365 * 24 * 3600


class _Module(StaticFileHandler):
    """A file that never changes at its URL: a browser asks for it once."""

    def get_cache_time(self, path: str, modified: datetime.datetime | None, mime_type: str) -> int:
        return _YEAR

    def set_extra_headers(self, path: str) -> None:
        self.set_header("Cache-Control", f"public, max-age={_YEAR}, immutable")
        self.set_header("X-Content-Type-Options", "nosniff")


def module_routes() -> list[tuple[str, type[_Module], dict[str, Any]]]:
    """Routes for Tornado; nothing else of that folder can be fetched."""
    return [(rf"/{modules_path()}/({MODULES})", _Module, {"path": str(STATIC)})]
