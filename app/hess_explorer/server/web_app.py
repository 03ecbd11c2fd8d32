"""The page as an app that a browser installs: manifest, icons, and a page for when the server does not run."""

from __future__ import annotations

import json
from typing import Any

from tornado.web import RequestHandler, StaticFileHandler

from hess_explorer.assets import STATIC, modules_path

__all__ = ["HEAD", "MANIFEST", "web_app_routes"]

_FILES = r"service_worker\.js|offline\.html|icon-(?:192|512)\.png"
_SIZES = (192, 512)

# All addresses are relative, for proxies that add a folder.
MANIFEST = {
    "name": "Hess Explorer",
    "short_name": "Hess",
    "description": "The Suslov problem, its Hess case and their relatives",
    "start_url": "./",
    "scope": "./",
    "display": "standalone",
    "background_color": "#ffffff",
    "theme_color": "#16324f",
    "icons": [{"src": f"icon-{size}.png", "sizes": f"{size}x{size}", "type": "image/png"} for size in _SIZES],
}
"""The web app manifest."""

# With credentials, for pages behind a login.
HEAD = (
    '<link rel="manifest" href="app.webmanifest" crossorigin="use-credentials">\n    '
    f'<script type="module" src="{modules_path()}/page/web_app.js"></script>\n    '
)
"""Elements of the head of the page."""


class _Manifest(RequestHandler):
    """GET /app.webmanifest."""

    def get(self) -> None:
        """Respond with the manifest."""
        self.set_header("Content-Type", "application/manifest+json")
        self.set_header("X-Content-Type-Options", "nosniff")
        self.finish(json.dumps(MANIFEST))


class _File(StaticFileHandler):
    """Handler of the other files, which browsers check for changes."""

    def set_extra_headers(self, path: str) -> None:
        self.set_header("Cache-Control", "no-cache")
        self.set_header("X-Content-Type-Options", "nosniff")


def web_app_routes() -> list[tuple[Any, ...]]:
    """Return the Tornado routes of the app; the worker is beside the page, which it serves only from there."""
    return [("/app.webmanifest", _Manifest), (f"/({_FILES})", _File, {"path": str(STATIC / "app")})]
