"""The page of a follower: static HTML without a session, the same for all rooms."""

from __future__ import annotations

import json
from functools import cache

from tornado.web import RequestHandler

from hess_explorer.assets import STATIC, modules_path
from hess_explorer.page.component import styles

_PAGE = """<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<base href="../">
<title>Hess Explorer</title>
<link rel="icon" href="data:,">
<style>{style}</style>
<script type="application/json" id="sheets">{sheets}</script>
<script src="static/js/bokeh.min.js"></script>
<script type="module" src="{modules}/page/follow.js"></script>
</head>
<body></body>
</html>
"""

_POLICY = "; ".join(
    [
        "default-src 'none'",
        "script-src 'self'",
        "style-src 'self' 'unsafe-inline'",
        "img-src 'self' data: blob:",
        "connect-src 'self'",
        "base-uri 'self'",
        "form-action 'none'",
        "frame-ancestors 'self'",
    ]
)


@cache
def _page() -> str:
    return _PAGE.format(
        style=(STATIC / "page/follow.css").read_text(encoding="utf-8"),
        sheets=json.dumps(styles()).replace("<", "\\u003c"),
        modules=modules_path(),
    )


class RoomPage(RequestHandler):
    """GET /r/CODE: the page of a follower; its websocket reports whether the room exists."""

    def get(self, code: str) -> None:
        """Respond with the page."""
        for name, value in {
            "Content-Security-Policy": _POLICY,
            "X-Content-Type-Options": "nosniff",
            "Referrer-Policy": "same-origin",
            "Cache-Control": "no-cache",
        }.items():
            self.set_header(name, value)
        self.finish(_page())
