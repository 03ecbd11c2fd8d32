"""All scenes made ready before they are asked for, out of the way of whoever uses one."""

from __future__ import annotations

import gc
import os
import subprocess
import sys
import time
from pathlib import Path

from app.compute import CACHE
from app.description import describe
from app.scenes import scenes
from app.scenes.base import Scene
from models.jit import CACHE_FOLDER

__all__ = ["compile_all", "warm"]

QUIET_SECONDS = 0.3


def compute(scene: Scene, folded: bool = True) -> None:
    """Compile (or load) every kernel of a scene, by computing its default state once; folded: of all pictures."""
    scene.compute(scene.defaults(), scene.pictures if folded else scene.open_pictures, False)


def compile_all() -> None:
    """Leave the kernels of all scenes on disk; ends early when the process that wanted it has ended."""
    parent = os.getppid()
    if CACHE_FOLDER is not None and _mark(CACHE_FOLDER).exists():
        return
    for scene in scenes().values():
        if os.getppid() != parent:
            return
        compute(scene)
    if CACHE_FOLDER is not None:
        _mark(CACHE_FOLDER).touch()


def warm() -> None:
    """Make all scenes ready: the one that opens the page at once, the others while nobody asks for anything.

    Compiling holds the interpreter's lock: what is not on disk yet is compiled by another process.
    Until the end no garbage is collected, and then not among all these.
    """
    gc.disable()
    try:
        first, *others = scenes().values()
        compute(first, folded=False)
        describe(first.name)
        if CACHE_FOLDER is not None and not _mark(CACHE_FOLDER).exists():
            subprocess.run([sys.executable, "-c", "import os; os.name == 'posix' and os.nice(10); "
                            "from app.warm import compile_all; compile_all()"], check=False)
        _wait_until_quiet()
        compute(first)
        for scene in others:
            _wait_until_quiet()
            compute(scene)
            _wait_until_quiet()
            describe(scene.name)
    finally:
        gc.freeze()
        gc.enable()


def _mark(folder: Path) -> Path:
    """The file that says that everything is compiled."""
    return folder / "complete"


def _wait_until_quiet() -> None:
    """Return when nobody has asked for a result for a moment."""
    asked = -1
    while asked != CACHE.asked:
        asked = CACHE.asked
        time.sleep(QUIET_SECONDS)
