"""The page's component for Panel: one ES module that builds the whole page in the browser.

Its parts are ES modules under `static/`, mounted by "page/shell.js".  They know each other only by the events of
"page/bus.js".
"""

from __future__ import annotations

import param
from panel.custom import JSComponent

from hess_explorer.assets import STATIC, modules_path

__all__ = ["Explorer", "styles"]


def styles() -> dict[str, str]:
    """Return the style sheets of the parts by their paths; that of what is printed is fetched by itself."""
    return {
        f"{path.parent.name}/{path.name}": path.read_text(encoding="utf-8")
        for path in sorted(STATIC.glob("*/*.css"))
        if path.stem not in ("handout", "offline")
    }


class Explorer(JSComponent):
    """The page, from which the browser builds everything else; states come by the websocket of `Connection`."""

    client = param.Dict(
        default={},
        doc="URL keys that the browser itself keeps: t, speed, az, el, large, present, "
        "embed, pictures, controls, lesson, step.",
    )
    lesson = param.String(default="", doc="JSON: the lesson that the link names, see `description`.")
    lessons = param.List(default=[], doc="{name, title, minutes} of each lesson.")
    scenes = param.List(default=[], doc="{name, title, summary, picture, origin, group} of each.")
    palettes = param.Dict(default={}, doc="Colours of a chart: of numbers, and of turns.")
    files = param.Dict(
        default={},
        doc="formats: [kind, words, what it holds] of each that Export offers; width, seconds: least, most and usual.",
    )
    sheets = param.Dict(default={}, doc="`styles()`.")

    # Panel fetches the module from its own URL, also where a proxy serves the page under a prefix.
    _esm = f"""
export const render = async (component) => {{
  const module = await import(new URL("{modules_path()}/page/shell.js", document.baseURI).href)
  return module.render(component)
}}
"""
    _stylesheets = [(STATIC / name).read_text(encoding="utf-8") for name in ("page/base.css", "page/shell.css")]
