"""Serve the JavaScript modules and the style sheet for printing, under a URL that changes with their contents."""

from __future__ import annotations

import datetime
from typing import Any

from tornado.web import StaticFileHandler

from hess_explorer.assets import MODULES, STATIC, modules_path

__all__ = ["module_routes"]

_YEAR = 365 * 24 * 3600


class _Module(StaticFileHandler):
    """Handler of an immutable file, which a browser requests only once."""

    def get_cache_time(self, path: str, modified: datetime.datetime | None, mime_type: str) -> int:
        return _YEAR

    def set_extra_headers(self, path: str) -> None:
        self.set_header("Cache-Control", f"public, max-age={_YEAR}, immutable")
        self.set_header("X-Content-Type-Options", "nosniff")


def module_routes() -> list[tuple[str, type[_Module], dict[str, Any]]]:
    """Return the Tornado routes of the modules; no other file of the folder is served."""
    return [(rf"/{modules_path()}/({MODULES})", _Module, {"path": str(STATIC)})]
