"""`sweep` computes numbers over one to three parameters; `explain` describes the status of a cell."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping, Sequence
from contextlib import closing, nullcontext
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hess_explorer.compute.cells import Outcome, evaluate
from hess_explorer.sweep.errors import Interrupted, StoreError, WorkersLost
from hess_explorer.sweep.function import computation_of
from hess_explorer.sweep.piece import cell_name, piece_size
from hess_explorer.sweep.plan import Axis, SweepPlan
from hess_explorer.sweep.progress import Report, progress_report
from hess_explorer.sweep.store import create, exists, load, missing, require_libraries, write
from hess_explorer.sweep.workers import connection, results, size
from hess_mechanics.catalogue import Computation, find
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.arguments import as_level, as_level_name, as_number

if TYPE_CHECKING:
    import xarray as xr
    from distributed import Client


def sweep(
    computation: str | Computation | Callable[..., object],
    over: Mapping[str, Axis],
    *,
    numbers: Sequence[str] | None = None,
    accuracy: Accuracy = "precise",
    store: str | Path | None = None,
    workers: str | int | None = None,
    scheduler: str | Client | None = None,
    progress: bool | Report | None = None,
    **fixed: float,
) -> xr.Dataset:
    """Compute numbers of a computation over one to three of its parameters.

    Parameters
    ----------
    computation : str, Computation or callable
        Name of a computation of the catalogue, such as "circle-map" or "lyapunov suslov", which defines the
        parameters, their bounds and defaults; or a computation of your own system; or a function.  A function takes
        numbers by name and returns a number or a named tuple of numbers, whose fields become variables; its parameter
        `accuracy`, if any, receives the level.  Before the sweep begins it is called at
        one cell, or at up to 16 until one has a result.
    over : mapping of str
        The swept parameters: (low, high, count) for evenly spaced values with both ends, or a list of values.
    numbers : sequence of str, optional
        Numbers to compute: by default the first one of a computation, all of a function.  Each becomes a variable, with
        `_` instead of `-` in its name.
    accuracy : str or Level
        Level of accuracy: "draft", "standard", "precise" or "reference".
    store : str or Path, optional
        Folder of a Zarr group that stores every finished piece.  The same call resumes an interrupted sweep.
        Simultaneous runs are safe but repeat work.
    workers : None, "all" or int
        None or 1 computes in this thread, an integer up to 1000 in that many new processes, "all" in one process per
        core.  A script must then call `sweep` below ``if __name__ == "__main__":``.  Not used with a `scheduler`.
    scheduler : str or distributed.Client, optional
        Address of a Dask scheduler, "tcp://…" or "tls://…", or a Client.  Its workers need the same version of this
        package.
    progress : bool or callable, optional
        True shows a progress bar, which is updated every 30 seconds if stderr is not a terminal.  A function is called
        with a `Progress` at the beginning and after each piece.
    **fixed : float
        Values of other parameters that differ from their defaults.

    Returns
    -------
    xarray.Dataset
        The numbers over the swept parameters, their estimated errors `<name>_error` where estimates exist, and the
        `status` of each cell (see `Outcome` and `explain`).  The attribute `failures` contains the exceptions of up to
        1000 failed cells as JSON.  On one kind of processor the values do not depend on `store`, `workers` and
        `scheduler`.

    Raises
    ------
    InvalidParameter
        If a name or a value is not allowed.
    WorkLimit
        If the sweep has more than ten million cells.
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
    >>> chart = sweep("circle-map", over={"h": (1.2, 1.6, 3), "f": [0.1, 0.6]}, numbers=("trace",), a=0.5)
    >>> chart.trace.dims, chart.status.values.tolist()
    (('h', 'f'), [[1, 1], [1, 1], [1, 1]])
    >>> def area(width, height=2.0):
    ...     return width * height
    >>> sweep(area, over={"width": [1.0, 3.0]}).area.values.tolist()
    [2.0, 6.0]
    """
    require_libraries()
    level = as_level_name(accuracy)
    if callable(computation):
        what, source = computation_of(computation, over, fixed, level)
    else:
        what, source = computation if isinstance(computation, Computation) else find(computation), ""
    names = [*what.numbers]
    plan = SweepPlan.of(what, numbers or (names if source else names[:1]), level, over, fixed, source)
    path = None if store is None else Path(store)
    place: Any = path if path is not None and exists(path, plan) else None
    todo = None if place is None else missing(place, plan)
    hint = "" if path is None else f"  Finished cells are saved in {str(path)!r}: run the same sweep again to continue."
    try:
        # A finished sweep needs no workers.
        with nullcontext() if todo == [] else connection(workers, scheduler) as client:
            if todo is None:
                place = create(path, plan, piece_size(plan, size(client)))
                todo = missing(place, plan)
            done = plan.cells - sum(plan.part(region).cells for region in todo)
            pieces = results(client, plan, todo)
            with progress_report(progress, plan.cells, done) as report, closing(pieces):
                for region, found in pieces:
                    write(place, region, found)
                    report(plan.part(region).cells)
    except KeyboardInterrupt as error:
        if place is None:
            raise
        kept = load(place)
        message = f"stopped after {np.count_nonzero(kept.status)} of {plan.cells} cells."
        raise Interrupted(f"{message}{hint}", kept) from error
    except (StoreError, WorkersLost) as error:
        raise type(error)(f"{error}{hint if place else ''}") from error
    return load(place)


def explain(result: xr.Dataset, **cell: float) -> str:
    """Return a sentence on the status of a cell.

    The cell is computed again unless its exception is stored in `result`.

    Parameters
    ----------
    result : xarray.Dataset
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
        If the names of the coordinates are not those of the swept parameters, the computation is not in the catalogue,
        or no exception of your own function is stored for the cell.

    Examples
    --------
    >>> from hess_explorer.sweep import explain, sweep
    >>> result = sweep("circle-map", over={"h": [-0.9, 1.5]}, f=1.0)
    >>> result.status.values.tolist()
    [10, 1]
    >>> explain(result, h=-0.9)
    'no such motion.'
    """
    facts = result.attrs
    if {*cell} != {*result.status.dims}:
        raise InvalidParameter(
            f"A cell cannot be given by {' and '.join(cell) or 'nothing'}: pass values of "
            f"{', '.join(map(str, result.status.dims))}."
        )
    cell = {name: as_number(name, cell[name]) for name in map(str, result.status.dims)}
    if (failure := json.loads(facts["failures"]).get(cell_name(cell))) is not None:
        return str(failure)
    if facts["source"]:
        raise InvalidParameter(
            f"No exception is stored for this cell of {facts['title']}, your own function: call it with these values."
        )
    columns = {name: np.array([value]) for name, value in {**json.loads(facts["parameters"]), **cell}.items()}
    numbers = facts["numbers"].split(", ")
    outcome = evaluate(find(facts["computation"]), numbers, columns, as_level(facts["accuracy"]))
    return outcome.reasons.get(0, f"{Outcome(int(outcome.status[0])).words}.")
