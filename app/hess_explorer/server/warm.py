"""Compile and load the kernels of all scenes, and build their descriptions, before they are requested."""

from __future__ import annotations

import gc
import logging
import time
from collections.abc import Callable
from concurrent.futures import ProcessPoolExecutor
from multiprocessing import get_context

from hess_explorer.compute.cache import CACHE
from hess_explorer.page.description import describe
from hess_explorer.protocol.wire import Wire
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.stage import Stage
from hess_explorer.server.compiled import KEEPS_KERNELS, all_compiled, compiler, mark_all_compiled
from hess_explorer.views.tag_kernels import compile_labels
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.taylor_kernels import compile_shared

logger = logging.getLogger("hess_explorer")

QUIET_SECONDS, PAGE_SECONDS = 0.3, 8.0


def compute(name: str, folded: bool = True) -> None:
    """Compile or load the kernels of a scene by computing its default state and one background task of each kind.

    A `ModelError` is logged as a warning, and not raised.

    Parameters
    ----------
    name : str
        Name of the scene.
    folded : bool
        True to include charts and pictures that are hidden at first.
    """
    scene = scenes()[name]
    try:
        state = scene.compute(scene.defaults(), scene.pictures if folded else scene.open_pictures, False)
        todo = Stage(scene, Wire()).show(state, hold_axes=False).todo
        for task in {task.function: task for task in reversed(todo)}.values():
            CACHE.get(task.function, *task.arguments)
        if folded and scene.chart_set is not None:
            scene.chart_set.load(state)
    except ModelError as error:
        # A scene that fails must not stop the others.
        logger.warning("%s: %s", name, error)


def compile_all(processes: int = 1) -> None:
    """Compile the kernels of all scenes into the cache on disk, unless all of them are there.

    Parameters
    ----------
    processes : int
        Number of processes that share the scenes.
    """
    if all_compiled():
        return
    if processes == 1:
        for name in scenes():
            compute(name)
    else:
        with ProcessPoolExecutor(processes, get_context("spawn")) as pool:
            for _ in pool.map(compute, scenes()):
                pass
    mark_all_compiled()


def warm(first_is_ready: Callable[[], None] = lambda: None) -> None:
    """Prepare all scenes: the first one immediately, the others while the server is idle.

    Compilation holds the interpreter lock, so a separate process compiles missing kernels.  All objects created here
    live as long as the process; the garbage collector, which is off until then, is enabled after the first scene and
    skips them.

    Parameters
    ----------
    first_is_ready : callable
        Called as soon as the page can be shown without compiling.
    """
    first, *others = scenes()
    try:
        describe(first)
        # At a first start another process compiles the circle map meanwhile, so load the circle map last.
        compile_labels()
        compute(first, folded=False)
    finally:
        gc.freeze()
        gc.enable()
        first_is_ready()
    if KEEPS_KERNELS and not all_compiled():
        with compiler("from hess_explorer.server.warm import compile_all; compile_all()", patience=10) as process:
            process.wait()
    _wait_for_a_page()
    _wait_until_quiet()
    compute(first)
    for name in others:
        _wait_until_quiet()
        compute(name)
        _wait_until_quiet()
        describe(name)
    _wait_until_quiet()
    # Formulas typed on the page need this kernel.
    compile_shared()
    gc.freeze()


def _wait_for_a_page() -> None:
    """Wait until a page requests a state, at most `PAGE_SECONDS`: a browser may be loading it on the same cores."""
    asked, ends = CACHE.lookups, time.monotonic() + PAGE_SECONDS
    while CACHE.lookups == asked and time.monotonic() < ends:
        time.sleep(0.05)


def _wait_until_quiet() -> None:
    """Wait until no result has been requested for `QUIET_SECONDS`."""
    asked = -1
    while asked != CACHE.lookups:
        asked = CACHE.lookups
        time.sleep(QUIET_SECONDS)
