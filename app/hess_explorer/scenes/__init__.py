"""The scenes: every module of this package with a `SCENE`, and "Speed and accuracy" of each."""

from __future__ import annotations

import importlib
import pkgutil
from functools import cache
from typing import Any

from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.scenes.speed_accuracy import looking_into
from hess_explorer.scenes.speed_accuracy_of_maps import without_motion

__all__ = ["scenes"]


@cache
def scenes() -> dict[str, Scene[Any]]:
    """All scenes by name, in the order of the menu; those that look into another one come last."""
    modules = (importlib.import_module(f"{__name__}.{module.name}") for module in pkgutil.iter_modules(__path__))
    own = [module.SCENE for module in modules if isinstance(getattr(module, "SCENE", None), Scene)]
    own += [(looking_into if scene.has_motion else without_motion)(scene) for scene in own]
    return {scene.name: scene for scene in sorted(own, key=lambda scene: (scene.origin is not None, scene.place))}
