"""The scenes: the `SCENE` of every module in this package, those from elsewhere, and "Speed and accuracy" for each."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache
from importlib.metadata import entry_points
from typing import Any

from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.scenes.speed_accuracy import speed_and_accuracy
from hess_mechanics.errors import InvalidParameter

__all__ = ["PLUGINS", "add", "scene_named", "scenes"]

PLUGINS = "hess_explorer.scenes"
"""Group of the entry points by which other packages bring their scenes."""

_added: list[Scene[Any]] = []


@cache
def scenes() -> dict[str, Scene[Any]]:
    """Return all scenes by name, in menu order: added ones first, and scenes derived from another scene last."""
    own = _shipped() + [_checked(one.load(), one.value) for one in entry_points(group=PLUGINS)]
    own = [*_added, *sorted(own, key=lambda scene: scene.place)]
    found = {scene.name: scene for scene in [*own, *(speed_and_accuracy(scene) for scene in own if scene.trials)]}
    if len(found) < len(own) + sum(bool(scene.trials) for scene in own):
        raise InvalidParameter("Two scenes have the same name: rename the system or the file of yours.")
    return found


def _shipped() -> list[Scene[Any]]:
    modules = (importlib.import_module(f"{__name__}.{module.name}") for module in pkgutil.iter_modules(__path__))
    return [module.SCENE for module in modules if isinstance(getattr(module, "SCENE", None), Scene)]


def scene_named(name: str) -> Scene[Any] | None:
    """Return a scene, or None if none has this name; a module of this package is imported without the others."""
    own = {module.name for module in pkgutil.iter_modules(__path__)}
    module = name.replace("-", "_")
    found = getattr(importlib.import_module(f"{__name__}.{module}"), "SCENE", None) if module in own else None
    return found if isinstance(found, Scene) and found.name == name else scenes().get(name)


def add(scene: Any, source: str) -> None:
    """Add a scene of one's own, before the page is served.

    Raises `InvalidParameter`, also if its name is taken.

    Parameters
    ----------
    source : str
        Where it comes from, for messages.
    """
    _added.append(_checked(scene, source))
    scenes.cache_clear()
    try:
        scenes()
    except InvalidParameter:
        _added.pop()
        scenes.cache_clear()
        raise


def _checked(scene: Any, source: str) -> Scene[Any]:
    if not isinstance(scene, Scene):
        raise InvalidParameter(f"{source} is {scene!r} and no scene: make one with hess.scene(system, pictures).")
    return scene
