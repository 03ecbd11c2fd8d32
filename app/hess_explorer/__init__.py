"""Python interface of the explorer: the data and pictures of any state, without the page.

>>> import hess_explorer as hess
>>> state = hess.state("suslov-hess", h=1.2, f=0.3, accuracy="draft")
>>> state.data("circle").layer("stable")["phi"].round(3)
array([-2.283])

The package `hess_mechanics` holds the mechanics, `hess_explorer.sweep` the parameter sweeps.  `hess-explorer docs`
builds and opens the documentation.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from hess_explorer.library.exploring import explore
    from hess_explorer.library.own_scene import scene
    from hess_explorer.library.state import SceneState, from_link, state

__all__ = ["SceneState", "explore", "from_link", "scene", "state"]

_PLACES = {
    "SceneState": "state",
    "explore": "exploring",
    "from_link": "state",
    "scene": "own_scene",
    "state": "state",
}


def __getattr__(name: str) -> Any:
    # Imported on first use, so that commands that only compute do not load the plotting libraries.
    if name not in _PLACES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    found = globals()[name] = getattr(importlib.import_module(f"{__name__}.library.{_PLACES[name]}"), name)
    return found


def __dir__() -> list[str]:
    return sorted({*globals(), *__all__})
