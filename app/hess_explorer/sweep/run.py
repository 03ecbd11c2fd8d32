"""`sweep` computes a quantity over one to three parameters; `explain` gives the status of a cell."""

from __future__ import annotations

import json
import math
import signal
import threading
from collections.abc import Iterable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING

import numpy as np

from hess_explorer.sweep.errors import Interrupted, StoreError, WorkersLost
from hess_explorer.sweep.grid import MAX_NUMBERS, Axis, Box, SweepGrid, expanded
from hess_explorer.sweep.progress import Report, reporting
from hess_explorer.sweep.quantities import quantity as named
from hess_explorer.sweep.quantity import Outcome, Quantity, evaluate
from hess_explorer.sweep.result import Memory, Storage, Store, opened, require_libraries
from hess_explorer.sweep.work import Chunk, cost_of_a_cell, version
from hess_explorer.sweep.workers import WorkerCount, crew
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import Accuracy, Level
from hess_mechanics.numerics.arguments import as_level, as_level_name

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["explain", "seconds_of_a_piece", "sweep"]

_SHORTEST, _LONGEST = 0.25, 2.0
"""Duration of a piece in seconds: long compared with the overhead, short enough to lose."""
_PIECES = 16
"""Pieces per worker, so that all workers finish at about the same time; fewer if they would be too short."""
_RATE = 50.0
"""Maximum number of pieces per second for the scheduler and the writer."""
_MOST_NUMBERS = 1_000_000
"""Maximum number of values of a piece, which take 8 MB."""


def seconds_of_a_piece(work: float, workers: int) -> float:
    """Return the duration of a piece in seconds, for a total work in seconds and a number of workers."""
    least = workers / _RATE
    return min(max(_LONGEST, least), max(_SHORTEST, least, work / (_PIECES * workers)))


def _cells_of_a_piece(what: Quantity, grid: SweepGrid, accuracy: Level, workers: int) -> float:
    cost = cost_of_a_cell(what, grid, accuracy)
    return min(seconds_of_a_piece(cost * grid.cells, workers) / cost, _MOST_NUMBERS / what.numbers)


def sweep(
    quantity: str,
    over: Mapping[str, Axis],
    *,
    level: Accuracy = "precise",
    store: str | Path | None = None,
    workers: WorkerCount = None,
    progress: bool | Report | None = None,
    most_cells: int = MAX_NUMBERS,
    stop: threading.Event | None = None,
    **fixed: float,
) -> xr.Dataset:
    """Compute a quantity over one to three of its parameters.

    Parameters
    ----------
    quantity : str
        A name in `QUANTITIES`, which defines the parameters, their bounds and defaults.
    over : mapping of str
        The swept parameters: (low, high, count) for evenly spaced values with both ends, or a list of values.
    level : str or Level
        "draft", "standard", "precise" or "reference".
    store : str or Path, optional
        Folder of a Zarr store that saves every finished piece.  The same call resumes an interrupted sweep.
        Simultaneous runs are safe but repeat work.
    workers : None, "all", int or str
        None computes in this thread; "all" starts a process per core; an integer is a number of processes; "tcp://…" is
        the address of a Dask scheduler, whose workers need the same version of this package.
    progress : bool or callable, optional
        True shows a progress bar; a function is called with a `Progress`.
    most_cells : int
        Maximum number of values.
    stop : threading.Event, optional
        Stops the sweep when it is set; unfinished cells have the status 0.
    **fixed : float
        Values of the other parameters that differ from their defaults.

    Returns
    -------
    xarray.Dataset
        The values, their `status` (see `Outcome` and `explain`) and, if available, the estimated `error`.  On one kind
        of processor the values do not depend on `store` and `workers`.

    Raises
    ------
    InvalidParameter
        If a name or a value is not allowed.
    WorkLimit
        If the sweep has too many values.
    MissingLibrary
        If a required library is not installed.
    StoreError
        If the store cannot be read or written.
    OtherSweep
        If the store contains a different sweep.
    WorkersLost
        If the workers cannot be reached or die.
    Interrupted
        On Ctrl-C, with the finished cells.

    Examples
    --------
    >>> from hess_explorer.sweep import sweep
    >>> found = sweep("rotation-number", over={"h": (1.2, 1.6, 3), "f": [0.1, 0.6]}, a=0.5)
    >>> found.rotation_number.dims, found.status.values.tolist()
    (('h', 'f'), [[1, 1], [1, 1], [1, 1]])
    """
    require_libraries()
    what, level = named(quantity), as_level_name(level)
    accuracy = as_level(level)
    grid = SweepGrid.of(what, over, fixed, most_cells)
    path = None if store is None else Path(store)
    begun = None if path is None else opened(path, what, grid, level)
    kept: Storage | None = begun
    todo: Iterable[Box] = ()
    missing = grid.cells
    if begun is not None:
        todo = [box for box in grid.boxes(begun.shape) if not begun.has(box)]
        missing = sum(map(_size, todo))
        if not missing:
            return begun.dataset()
    try:
        with ExitStack() as stack:
            interrupted = stack.enter_context(_ctrl_c())

            def stopped() -> bool:
                return interrupted.is_set() or (stop is not None and stop.is_set())

            hands = stack.enter_context(crew(workers, stopped))
            if kept is None:
                if interrupted.is_set():
                    raise KeyboardInterrupt("stopped before anything was computed.")
                shape = grid.box_of(_cells_of_a_piece(what, grid, accuracy, hands.size))
                kept = Memory(what, grid, level) if path is None else Store.create(path, what, grid, level, shape)
                todo = grid.boxes(shape)
            pieces = ((box, Chunk(what.name, level, version(), grid.pieces(box), grid.fixed)) for box in todo)
            report = stack.enter_context(reporting(progress, grid.cells, grid.cells - missing))
            for box, done in hands.run(pieces, stopped):
                kept.write(box, done)
                report(_size(box))
        if interrupted.is_set():
            raise KeyboardInterrupt
    except KeyboardInterrupt as error:
        if kept is None:
            raise
        found = kept.dataset()
        ended = int(np.count_nonzero(found.status))
        raise Interrupted(
            " ".join([f"stopped after {ended} of {grid.cells} cells.", kept.resume_hint]).strip(), found
        ) from error
    except WorkersLost as error:
        raise WorkersLost(" ".join([str(error), kept.resume_hint if kept else ""]).strip()) from error
    return kept.dataset()


def _size(box: Box) -> int:
    return math.prod(high - low for low, high in box)


@contextmanager
def _ctrl_c() -> Iterator[threading.Event]:
    """Yield an event that the first Ctrl-C sets instead of interrupting a library; the second one raises."""
    pressed = threading.Event()
    if threading.current_thread() is not threading.main_thread():
        yield pressed
        return

    def press(number: int, frame: FrameType | None) -> None:
        if pressed.is_set():
            raise KeyboardInterrupt
        pressed.set()

    before = signal.signal(signal.SIGINT, press)
    try:
        yield pressed
    finally:
        signal.signal(signal.SIGINT, before)


def explain(found: xr.Dataset, **cell: float) -> str:
    """Return a sentence on the status of a cell, which is computed once more.

    Parameters
    ----------
    found : xarray.Dataset
        A result of `sweep` or `read`.
    **cell : float
        Coordinates of the cell by name.

    Returns
    -------
    str
        The message of a failed cell, otherwise its status in words.

    Raises
    ------
    InvalidParameter
        If the coordinates do not match the sweep.
    StoreError
        If the Dataset is not a result of `sweep`.
    """
    if "quantity" not in found.attrs:
        raise StoreError("This Dataset is not the result of a sweep: pass one returned by `sweep` or `read`.")
    axes = tuple(map(str, found.status.dims))
    if set(cell) != set(axes):
        raise InvalidParameter(f"A cell of this sweep has the coordinates {', '.join(axes)}: give all of them.")
    if "state" in found.attrs:
        # The cells of a chart are states of a scene.
        from hess_explorer.sweep.chart_file import chart_of

        return chart_of(found).why(*(cell[name] for name in axes))
    what, accuracy = named(found.attrs["quantity"]), as_level(found.attrs["level"])
    fixed = json.loads(found.attrs["parameters"])
    grid = SweepGrid.of(what, {name: [cell[name]] for name in axes}, fixed, what.numbers)
    outcome = evaluate(what, expanded(grid.axes, grid.fixed), accuracy)
    return outcome.why.get(0, f"{Outcome(int(outcome.status[0])).words}.")
