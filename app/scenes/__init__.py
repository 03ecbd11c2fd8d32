"""The scenes: every module of this package with a `SCENE`."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache

from app.scenes.base import Scene

__all__ = ["scenes"]


@cache
def scenes() -> dict[str, Scene]:
    """All scenes by name."""
    found = {}
    for module in pkgutil.iter_modules(__path__):
        scene = getattr(importlib.import_module(f"{__name__}.{module.name}"), "SCENE", None)
        if isinstance(scene, Scene):
            found[scene.name] = scene
    return found
