"""The page, a single Panel component.

Panel does not handle states; they use a separate websocket ("server/websockets.py").
"""

from __future__ import annotations

import logging
from collections.abc import Sequence
from importlib.metadata import version
from pathlib import Path
from typing import Any

import panel as pn

from hess_explorer.assets import STATIC
from hess_explorer.export.formats import FORMATS, SERVED_SECONDS, WIDTHS, FileRequest
from hess_explorer.lessons.lesson import Lesson
from hess_explorer.page.component import Explorer, styles
from hess_explorer.page.lesson_description import describe_lesson
from hess_explorer.page.opening import opening, query_of
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene

logger = logging.getLogger("hess_explorer")

_FILES = {
    "program": f"hess-explorer {version('hess-explorer')}",
    "formats": [[kind, one.words, one.content] for kind, one in FORMATS.items() if one.words],
    "width": [*WIDTHS, FileRequest.width],
    "seconds": [*SERVED_SECONDS, FileRequest.seconds],
}


def page(own: Sequence[Lesson] = ()) -> Any:
    """Return a new page for the current request.

    Parameters
    ----------
    own : sequence of Lesson
        Lessons in addition to those of the package.
    """
    try:
        return _page(_query(), own)
    # Log any error; the user sees a short message.
    except Exception:
        logger.exception("the page could not be built")
        return pn.pane.Str("The page could not be built. Remove the part of its address after “?” and try again.")


def _query() -> str:
    """Return the query of the request that opened this page."""
    context = pn.state.curdoc.session_context if pn.state.curdoc else None
    return query_of(getattr(getattr(context, "request", None), "arguments", None) or {})


def _page(query: str, own: Sequence[Lesson]) -> Explorer:
    opened = opening(query, own)
    # Only the browser knows whether this is a first visit.
    reading = opened.reading or (None if query else opened.lessons["introduction"])
    return Explorer(
        client=opened.client,
        lesson=describe_lesson(reading) if reading else "",
        lessons=[{"name": one.name, "title": one.title, "minutes": one.minutes} for one in opened.lessons.values()],
        scenes=[_entry(one) for one in scenes().values()],
        files=_FILES,
        sheets=styles(),
        sizing_mode="stretch_both",
    )


def _entry(scene: Scene[Any]) -> dict[str, str | None]:
    """Return the entry of a scene in the menu; only scenes of this package have an image."""
    picture = Path(scene.module).stem.replace("_", "-")
    return {
        "name": scene.name,
        "title": scene.title,
        "summary": scene.summary,
        "picture": picture if (STATIC / f"thumbnails/{picture}-light.jpg").exists() else "",
        "examples": " ".join(preset.name for preset in scene.presets),
        "origin": scene.origin,
        "group": scene.group,
    }
