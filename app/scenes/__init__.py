"""The scenes: every module of this package with a `SCENE`, and "Speed and accuracy" of each that shows a motion."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache

from app.scenes.base import Scene
from app.scenes.speed_accuracy import looking_into

__all__ = ["scenes"]


@cache
def scenes() -> dict[str, Scene]:
    """All scenes by name."""
    found = {}
    for module in pkgutil.iter_modules(__path__):
        scene = getattr(importlib.import_module(f"{__name__}.{module.name}"), "SCENE", None)
        if isinstance(scene, Scene):
            found[scene.name] = scene
            if scene.motion is not None:
                own = looking_into(scene)
                found[own.name] = own
    return found
