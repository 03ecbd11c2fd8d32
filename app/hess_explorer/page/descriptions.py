"""Descriptions of scenes for the browser, sent once each and kept on disk.

HoloViews and Bokeh draw the empty pictures of a scene once per installation, which takes a second, and are not loaded
otherwise.
"""

from __future__ import annotations

import hashlib
import json
import threading
from collections.abc import Mapping
from contextlib import suppress
from functools import cache
from importlib.metadata import version
from pathlib import Path
from typing import Any

import hess_mechanics
from hess_explorer.scenes import is_shipped
from hess_mechanics.numerics.files import write_whole
from hess_mechanics.numerics.jit import CACHE_FOLDER

__all__ = ["describe", "without_gestures"]

_LIBRARIES = ("bokeh", "holoviews", "markdown-it-py", "mdit-py-plugins", "numpy", "panel")
_SOURCES = (Path(__file__).parents[1], Path(hess_mechanics.__file__).parent)

_one_at_a_time = threading.Lock()


@cache
def describe(name: str) -> str:
    """Return the description of a scene as JSON, which all sessions share."""
    # The options of HoloViews are global, and two sessions may enter the scene at once.
    with _one_at_a_time:
        file = CACHE_FOLDER / f"scene-{name}.json" if CACHE_FOLDER and is_shipped(name) else None
        kept = _read(file)
        if kept is None:
            from hess_explorer.page.description import description

            kept = description(name)
            if file:
                # The file only saves work.
                with suppress(OSError):
                    write_whole(file, json.dumps([_made_from(), kept]).encode())
        return kept


def _read(file: Path | None) -> str | None:
    """Return the description in a file; None if there is none, or it was made from other sources."""
    try:
        made_from, kept = json.loads(file.read_bytes()) if file else (None, None)
    except (OSError, ValueError, TypeError):
        return None
    return str(kept) if made_from == _made_from() else None


@cache
def _made_from() -> list[Any]:
    """Return the versions of the libraries, and time and size of all files of this program, as JSON has them."""
    files = sorted(path for root in _SOURCES for path in root.rglob("*") if path.suffix not in ("", ".pyc"))
    stats = [(str(path), path.stat()) for path in files]
    return [
        [version(library) for library in _LIBRARIES],
        hashlib.sha256(repr([(path, one.st_mtime_ns, one.st_size) for path, one in stats]).encode()).hexdigest(),
    ]


def without_gestures(picture: Mapping[str, Any]) -> dict[str, Any]:
    """Return the description of an open picture without the gestures that change the state.

    Parameters
    ----------
    picture : mapping
        An element of "pictures" in the description of a scene.

    Returns
    -------
    dict
        The changed description.
    """
    picks: dict[str, Any] = {"picks": [], "handle": None} if "picks" in picture else {}
    return {**picture, "folded": None, "hands": "", **picks}
