"""All scenes made ready before they are asked for, out of the way of whoever uses one."""

from __future__ import annotations

import gc
import logging
import os
import subprocess
import sys
import time
from typing import Any

from hess_explorer.compute.cache import CACHE
from hess_explorer.page.description import describe
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.scene import Scene
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.jit import CACHE_FOLDER

__all__ = ["compile_all", "warm"]

logger = logging.getLogger("hess_explorer")

QUIET_SECONDS = 0.3
_MARK = None if CACHE_FOLDER is None else CACHE_FOLDER / "complete"
"""The file that says that everything is compiled."""


def compute(scene: Scene[Any], folded: bool = True) -> None:
    """Compile (or load) every kernel of a scene, by computing its default state once; folded: of all pictures.

    Of what it leaves to the background, one piece of each kind.
    """
    try:
        state = scene.compute(scene.defaults(), scene.pictures if folded else scene.open_pictures, False)
        for task in {task.function: task for task in state.work.todo}.values():
            CACHE.get(task.function, *task.arguments)
    except ModelError as error:
        # One scene that cannot be shown keeps no other from being ready.
        logger.warning("%s: %s", scene.name, error)


def compile_all() -> None:
    """Leave the kernels of all scenes on disk; ends early when the process that wanted it has ended."""
    parent = os.getppid()
    if _is_compiled():
        return
    for scene in scenes().values():
        if os.getppid() != parent:
            return
        compute(scene)
    if _MARK is not None:
        _MARK.touch()


def warm() -> None:
    """Make all scenes ready: the one that opens the page at once, the others while nobody asks for anything.

    Compiling holds the interpreter's lock: what is not on disk yet is compiled by another process.
    What is made here stays: garbage is collected again when the first scene stands, but not among these.
    """
    first, *others = scenes().values()
    try:
        compute(first, folded=False)
        describe(first.name)
    finally:
        gc.freeze()
        gc.enable()
    if _MARK is not None and not _is_compiled():
        subprocess.run([sys.executable, "-c", "import os; os.name == 'posix' and os.nice(10); "
                        "from hess_explorer.server.warm import compile_all; compile_all()"], check=False)
    _wait_until_quiet()
    compute(first)
    for scene in others:
        _wait_until_quiet()
        compute(scene)
        _wait_until_quiet()
        describe(scene.name)
    gc.freeze()


def _is_compiled() -> bool:
    return _MARK is not None and _MARK.exists()


def _wait_until_quiet() -> None:
    """Return when nobody has asked for a result for a moment."""
    asked = -1
    while asked != CACHE.asked:
        asked = CACHE.asked
        time.sleep(QUIET_SECONDS)
