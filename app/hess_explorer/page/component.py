"""The Panel component of the page: one ES module that builds the whole page in the browser.

"page/served.js" builds it, "page/shell.js" mounts its parts: the ES modules under `static/`.  They communicate only
through the events of "base/bus.js".
"""

from __future__ import annotations

from typing import ClassVar

import param
from panel.custom import JSComponent

from hess_explorer.assets import STATIC


def styles() -> dict[str, str]:
    """Return the style sheets of the parts by path, without those for offline files and followers."""
    return {
        f"{path.parent.name}/{path.name}": path.read_text(encoding="utf-8")
        for path in sorted(STATIC.glob("*/*.css"))
        if path.stem not in ("follow", "offline")
    }


class Explorer(JSComponent):
    """The page as a single component; states arrive on the websocket of `Connection`."""

    client = param.Dict(
        default={},
        doc="URL keys that the browser keeps: t, speed, az, el, large, theme, present, "
        "embed, pictures, controls, lesson, step.",
    )
    lesson = param.String(default="", doc="JSON of the lesson in the URL, or of the introduction without a query.")
    lessons = param.List(default=[], doc="{name, title, minutes} of each lesson.")
    scenes = param.List(default=[], doc="{name, title, summary, picture, examples, origin, group} of each scene.")
    files = param.Dict(
        default={},
        doc="program: name and version; formats: [suffix, label, category] of each format in the dialog; "
        "width, seconds: [minimum, maximum, default].",
    )
    sheets = param.Dict(default={}, doc="Style sheets by path, see `styles`.")

    # "page/start.js" renders the page; this module passes the model on.
    _esm = """
export function render(detail) {
  document.dispatchEvent(new CustomEvent("component", { detail }))
}
"""
    # The page loads its own style sheets.
    _stylesheets: ClassVar[list[str]] = []
