"""The scenes: the `SCENE` of every module in this package, and "Speed and accuracy" for each."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache
from typing import Any

from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.scenes.speed_accuracy import speed_and_accuracy

__all__ = ["scenes"]


@cache
def scenes() -> dict[str, Scene[Any]]:
    """Return all scenes by name, in menu order; scenes derived from another scene come last."""
    modules = (importlib.import_module(f"{__name__}.{module.name}") for module in pkgutil.iter_modules(__path__))
    own = [module.SCENE for module in modules if isinstance(getattr(module, "SCENE", None), Scene)]
    own += [speed_and_accuracy(scene) for scene in own if scene.trials]
    return {scene.name: scene for scene in sorted(own, key=lambda scene: (scene.origin is not None, scene.place))}
