"""All scenes: those of this package and of plugins, those of the user, and "Speed and accuracy" of each."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache
from importlib.metadata import entry_points
from typing import Any

from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.scenes.speed_accuracy import speed_and_accuracy
from hess_mechanics.errors import InvalidParameter

PLUGINS = "hess_explorer.scenes"
"""Entry point group for scenes of other packages."""

_additions: list[Scene[Any]] = []


@cache
def scenes() -> dict[str, Scene[Any]]:
    """Return all scenes by name in menu order: added scenes first, "Speed and accuracy" scenes last.

    Raises `InvalidParameter` if two scenes have the same name, or an entry point is not a scene.
    """
    own = _package_scenes() + [_require_scene(one.load(), one.value) for one in entry_points(group=PLUGINS)]
    own = [*_additions, *sorted(own, key=lambda scene: scene.place)]
    found = {scene.name: scene for scene in [*own, *(speed_and_accuracy(scene) for scene in own if scene.trials)]}
    if len(found) < len(own) + sum(bool(scene.trials) for scene in own):
        raise InvalidParameter("Two scenes have the same name: rename your system or file.")
    return found


def _package_scenes() -> list[Scene[Any]]:
    modules = (importlib.import_module(f"{__name__}.{module.name}") for module in pkgutil.iter_modules(__path__))
    return [module.SCENE for module in modules if isinstance(getattr(module, "SCENE", None), Scene)]


def scene_named(name: str) -> Scene[Any] | None:
    """Return the scene of this name, or None; imports only the module of the scene if possible."""
    own = {module.name for module in pkgutil.iter_modules(__path__)}
    module = name.replace("-", "_")
    found = getattr(importlib.import_module(f"{__name__}.{module}"), "SCENE", None) if module in own else None
    return found if isinstance(found, Scene) and found.name == name else scenes().get(name)


def add(scene: Any, source: str) -> None:
    """Add a scene before the page is served.

    Parameters
    ----------
    scene : Scene
        The scene.
    source : str
        Where it comes from, for error messages.

    Raises
    ------
    InvalidParameter
        If it is not a scene, or its name is taken; then the scene is not added.
    """
    _additions.append(_require_scene(scene, source))
    scenes.cache_clear()
    try:
        scenes()
    except InvalidParameter:
        _additions.pop()
        scenes.cache_clear()
        raise


def _require_scene(scene: Any, source: str) -> Scene[Any]:
    if not isinstance(scene, Scene):
        raise InvalidParameter(f"{source} is {scene!r}, not a scene: create one with hess.scene(system, pictures).")
    return scene
