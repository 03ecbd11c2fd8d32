"""`sweep` computes a quantity over one to three parameters; `explain` gives the status of a cell."""

from __future__ import annotations

import json
import signal
import threading
from collections.abc import Callable, Iterator, Mapping
from contextlib import ExitStack, contextmanager
from pathlib import Path
from types import FrameType
from typing import TYPE_CHECKING

import numpy as np

from hess_explorer.sweep.errors import Interrupted, StoreError, WorkersLost
from hess_explorer.sweep.function import quantity_of, sendable
from hess_explorer.sweep.grid import MAX_NUMBERS, Axis, Part, SweepGrid, expanded, size
from hess_explorer.sweep.progress import Report, reporting
from hess_explorer.sweep.quantities import quantity as named
from hess_explorer.sweep.quantity import Outcome, Quantity, evaluate
from hess_explorer.sweep.result import Memory, Storage, require_libraries
from hess_explorer.sweep.store import FILES, Store, opened, path_of
from hess_explorer.sweep.work import Chunk, cost_of_a_cell, version
from hess_explorer.sweep.work import named as cell_name
from hess_explorer.sweep.workers import WorkerCount, crew
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import Accuracy, Level
from hess_mechanics.numerics.arguments import as_level, as_level_name, as_number, as_parts, as_whole

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["explain", "seconds_of_a_piece", "sweep"]

_SHORTEST, _LONGEST = 0.25, 2.0
"""Duration of a piece in seconds: long compared with the overhead, short enough to lose."""
_PIECES = 16
"""Pieces per worker, so that all workers finish at about the same time; fewer if they would be too short."""
_RATE = 50.0
"""Maximum number of pieces per second for the scheduler and the writer."""
_MOST_PARTS = 10_000
_MOST_NUMBERS = 1_000_000
"""Maximum number of values of a piece, which take 8 MB."""


def seconds_of_a_piece(work: float, workers: int) -> float:
    """Return the duration of a piece in seconds, for a total work in seconds and a number of workers."""
    least = workers / _RATE
    return min(max(_LONGEST, least), max(_SHORTEST, least, work / (_PIECES * workers)))


def _cells_of_a_piece(what: Quantity, grid: SweepGrid, accuracy: Level, workers: int, parts: int) -> float:
    cost = cost_of_a_cell(what, grid, accuracy)
    wanted = min(seconds_of_a_piece(cost * grid.cells, workers) / cost, _MOST_NUMBERS / what.numbers)
    # Each part of a job array has several files, however cheap the cells are.
    return wanted if parts == 1 else min(wanted, grid.cells / (FILES * parts))


def sweep(
    quantity: str | Callable[..., object],
    over: Mapping[str, Axis],
    *,
    level: Accuracy = "precise",
    store: str | Path | None = None,
    part: Part | None = None,
    workers: WorkerCount = None,
    progress: bool | Report | None = None,
    most_cells: int = MAX_NUMBERS,
    stop: threading.Event | None = None,
    **fixed: float,
) -> xr.Dataset:
    """Compute a quantity over one to three of its parameters.

    Parameters
    ----------
    quantity : str or callable
        A name in `QUANTITIES`, which defines the parameters, their bounds and defaults.  Or your function: its
        parameters are numbers given by name, and it returns a number or a named tuple of numbers, whose fields become
        variables.  A parameter `level` receives the level.  The function is called once before the sweep begins.
    over : mapping of str
        The swept parameters: (low, high, count) for evenly spaced values with both ends, or a list of values.
    level : str or Level
        "draft", "standard", "precise" or "reference".
    store : str or Path, optional
        Folder of a Zarr store that saves every finished piece.  The same call resumes an interrupted sweep.
        Simultaneous runs are safe but repeat work.
    part : (int, int), optional
        (3, 40) computes part 3 of 40, counted from 1: the jobs of an array share a store, and each one writes its own
        files.
    workers : None, "all", int, str or distributed.Client
        None computes in this thread; "all" starts a process per core; an integer is a number of processes.  "tcp://…"
        or "tls://…" is the address of a Dask scheduler, and a Client of Dask is used as it is; its workers need the
        same version of this package.
    progress : bool or callable, optional
        True shows a progress bar, or prints a line every 30 seconds if standard error is not a terminal; a function is
        called with a `Progress`.
    most_cells : int
        Maximum number of values.
    stop : threading.Event, optional
        Stops the sweep when it is set; unfinished cells have the status 0.
    **fixed : float
        Values of the other parameters that differ from their defaults.

    Returns
    -------
    xarray.Dataset
        The values, their `status` (see `Outcome` and `explain`) and, if available, the estimated `error`; the attribute
        `failures` has the exceptions of up to 1000 failed cells, as JSON.  On one kind of processor the values do not
        depend on `store`, `part` and `workers`.

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
    >>> def area(width, height=2.0):
    ...     return width * height
    >>> sweep(area, over={"width": [1.0, 3.0]}).area.values.tolist()
    [2.0, 6.0]
    """
    require_libraries()
    if not (progress is None or isinstance(progress, bool) or callable(progress)):
        raise InvalidParameter(f"progress = {progress!r} is not a function: give True for a bar or a log.")
    level = as_level_name(level)
    accuracy = as_level(level)
    if not isinstance(over, Mapping):
        raise InvalidParameter(f"over = {over!r} is not a mapping: write it like {{'h': (1.2, 1.6, 3)}}.")
    what = named(quantity) if isinstance(quantity, str) else quantity_of(quantity, over, fixed, accuracy, most_cells)
    grid = SweepGrid.of(what, over, fixed, most_cells)
    path = None if store is None else path_of(store)
    parts = _parts(part, path)
    kept: Storage | None = None if path is None else opened(path, what, grid, level, parts)
    todo = [] if kept is None else kept.missing(part)
    if kept is not None and not todo:
        return kept.dataset()
    try:
        with ExitStack() as stack:
            interrupted = stack.enter_context(_ctrl_c())

            def stopped() -> bool:
                return interrupted.is_set() or (stop is not None and stop.is_set())

            hands = stack.enter_context(crew(workers, stopped))
            if kept is None:
                if interrupted.is_set():
                    raise KeyboardInterrupt("stopped before anything was computed.")
                shape = grid.box_of(_cells_of_a_piece(what, grid, accuracy, parts * hands.size, parts))
                kept = (
                    Memory(what, grid, level, shape)
                    if path is None
                    else Store.create(path, what, grid, level, shape, parts)
                )
                todo = kept.missing(part)
            sent = sendable(what, workers in (None, 1))
            pieces = ((box, Chunk(sent, level, version(), grid.pieces(box), grid.fixed)) for box in todo)
            cells = kept.cells(part)
            report = stack.enter_context(reporting(progress, cells, cells - sum(map(size, todo))))
            for box, done in hands.run(pieces, stopped):
                kept.write(box, done)
                report(size(box))
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


def _parts(part: Part | None, path: Path | None) -> int:
    """Return the number of parts of a job array, 1 without one.  Raises `InvalidParameter`."""
    if part is None:
        return 1
    number, parts = (as_whole("part", one, 0, 10**9) for one in as_parts("part", part, 2))
    if not 1 <= number <= parts <= _MOST_PARTS:
        raise InvalidParameter(f"Part {number} of {parts} does not exist: count from 1, up to {_MOST_PARTS} parts.")
    if path is None:
        raise InvalidParameter("The parts of a sweep need a store that they share: name its folder.")
    return parts


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
    """Return a sentence on the status of a cell, which is computed once more unless the text of its exception is kept.

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
        If the coordinates do not match the sweep, or the sweep is one of a function of your own.
    StoreError
        If the Dataset is not a result of `sweep`.
    """
    if "quantity" not in getattr(found, "attrs", {}):
        raise StoreError("This Dataset is not the result of a sweep: pass one returned by `sweep` or `read`.")
    axes = tuple(map(str, found.status.dims))
    cell = {name: as_number(name, value) for name, value in cell.items()}
    if set(cell) != set(axes):
        raise InvalidParameter(f"A cell of this sweep has the coordinates {', '.join(axes)}: give all of them.")
    if "state" in found.attrs:
        # The cells of a chart are states of a scene.
        from hess_explorer.sweep.chart_file import chart_of

        return chart_of(found).why(*(cell[name] for name in axes))
    failures = json.loads(found.attrs.get("failures", "{}"))
    if (failure := failures.get(cell_name({name: cell[name] for name in axes}))) is not None:
        return str(failure)
    if "source" in found.attrs:
        raise InvalidParameter(
            f"{found.attrs['quantity']} is a function of your own: call it with the values of the cell for the reason."
        )
    what, accuracy = named(found.attrs["quantity"]), as_level(found.attrs["level"])
    fixed = json.loads(found.attrs["parameters"])
    grid = SweepGrid.of(what, {name: [cell[name]] for name in axes}, fixed, what.numbers)
    outcome = evaluate(what, expanded(grid.axes, grid.fixed), accuracy)
    return outcome.why.get(0, f"{Outcome(int(outcome.status[0])).words}.")
