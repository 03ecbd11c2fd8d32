"""Title, description and picture of a shared link, for chats and posts (Open Graph)."""

from __future__ import annotations

import asyncio
import threading
from collections import OrderedDict
from html import escape
from typing import ClassVar

import numpy as np
from tornado.httputil import HTTPServerRequest
from tornado.web import RequestHandler

from hess_explorer.assets import STATIC
from hess_explorer.compute.budget import Abandoned, limited
from hess_explorer.export.card import SIZE, card
from hess_explorer.export.picture_data import CLIENT_KEPT, Address, compute
from hess_explorer.page.opening import THEME, Opening, opening
from hess_explorer.protocol.parameters import MAX_QUERY, Number
from hess_explorer.server.export import FILES
from hess_explorer.server.home import home_of
from hess_explorer.server.refusal import refuse
from hess_explorer.views.text import digits
from hess_mechanics.errors import ModelError

__all__ = ["KEPT", "MOST", "Preview", "tags"]

KEPT, MOST = 64, 4
"""Number of cards in the cache, and of requests that may wait for a card."""
_SECONDS = 10.0
"""CPU time limit of a card in seconds."""
_USUAL = "suslov-hess-two-limit-cycles"


def _shown(opened: Opening) -> Address:
    """Return the picture that stands for a page: the enlarged one, or the first of the open ones."""
    name = opened.client["large"].split(",")[0] or next(iter(opened.pictures), "")
    views = opened.scene.views
    picture = next((view for view in views if view.name == name), views[0])
    client = {spec.name: float(opened.client[spec.name]) for spec in CLIENT_KEPT}
    return Address(opened.scene, picture, opened.values, client)


def _described(opened: Opening) -> tuple[str, str]:
    """Return title and description of a page; its numbers are admitted values, and its words are our own."""
    scene, values = opened.scene, opened.values
    if opened.reading is not None:
        return f"{opened.reading.title} — Hess Explorer", scene.summary
    named = (one.name for one in scene.presets if scene.example(one).items() <= dict(values).items())
    numbers = [
        f"{spec.label} = {digits(float(values[spec.name]))}"
        for spec in scene.specs
        if isinstance(spec, Number) and spec.name in scene.essential
    ]
    example = next(named, "")
    return f"{scene.title} — Hess Explorer", " ".join(
        [scene.summary, *([f"{example.rstrip('.')}."] if example else []), ", ".join(numbers)]
    ).strip()


def tags(request: HTTPServerRequest, query: str) -> str:
    """Return the meta elements of the page of a query, which may be anything."""
    opened = opening(query[:MAX_QUERY])
    title, description = _described(opened)
    shown, home = _shown(opened), home_of(request)
    # The browser paints the first frame with it.
    schemes = "light dark" if opened.theme == THEME.default else opened.theme
    names = {"description": opened.scene.summary, "color-scheme": schemes}
    facts = {
        "og:type": "website",
        "og:site_name": "Hess Explorer",
        "og:title": title,
        "og:description": description,
        "og:url": f"{home}?{shown.link}",
        "og:image": f"{home}preview?{shown.link}&large={shown.picture.name}",
        "og:image:width": str(SIZE[0]),
        "og:image:height": str(SIZE[1]),
        "og:image:alt": description,
        "twitter:card": "summary_large_image",
    }
    return "".join(
        f'<meta {key}="{name}" content="{escape(text)}">\n    '
        for key, pairs in (("name", names), ("property", facts))
        for name, text in pairs.items()
    )


def _made(shown: Address) -> bytes:
    with limited(threading.Event(), _SECONDS), np.errstate(all="ignore"):
        return card(compute(shown))


class Preview(RequestHandler):
    """GET /preview?<state>: the card of a state as PNG, or a fixed picture of its scene if there can be none now."""

    kept: ClassVar[OrderedDict[str, bytes]] = OrderedDict()
    making: ClassVar[dict[str, asyncio.Future[bytes]]] = {}

    async def get(self) -> None:
        """Respond with the picture; with 400 if the link is too long."""
        self.set_header("X-Content-Type-Options", "nosniff")
        if len(self.request.query) > MAX_QUERY:
            refuse(self, 400, f"The link is longer than {MAX_QUERY} characters.")
            return
        shown = _shown(opening(self.request.query))
        key = f"{shown.picture.name} {shown.link}"
        if key in self.kept:
            self.kept.move_to_end(key)
            self._send("image/png", self.kept[key])
            return
        if key not in self.making:
            if len(self.making) >= MOST:
                self._send_fixed(shown.scene.name)
                return
            made = asyncio.get_running_loop().run_in_executor(FILES, _made, shown)
            self.making[key] = made
            made.add_done_callback(lambda _: self.making.pop(key, None))
        try:
            # A client that leaves does not cancel what others wait for.
            png = await asyncio.shield(self.making[key])
        except (ModelError, Abandoned):
            self._send_fixed(shown.scene.name)
            return
        self.kept[key] = png
        while len(self.kept) > KEPT:
            self.kept.popitem(last=False)
        self._send("image/png", png)

    def _send_fixed(self, scene: str) -> None:
        """Respond with a picture of the gallery, for a short time."""
        files = [*sorted(STATIC.glob(f"thumbnails/{scene}-*-light.jpg")), STATIC / f"thumbnails/{_USUAL}-light.jpg"]
        self._send("image/jpeg", files[0].read_bytes(), 60)

    def _send(self, media: str, data: bytes, seconds: int = 86_400) -> None:
        self.set_header("Content-Type", media)
        self.set_header("Cache-Control", f"public, max-age={seconds}")
        self.finish(data)
