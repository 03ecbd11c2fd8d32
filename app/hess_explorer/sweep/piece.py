"""Compute a piece of a sweep, here or on a worker, and choose its size."""

from __future__ import annotations

import pickle
import time
from collections.abc import Mapping
from dataclasses import replace
from functools import lru_cache
from typing import Any

import numpy as np

from hess_explorer.compute.cells import Outcome, evaluate
from hess_explorer.sweep.errors import WorkersLost
from hess_explorer.sweep.plan import SweepPlan, version
from hess_mechanics.catalogue import catalogue, find
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.results import Array

PieceResult = tuple[dict[str, Array], dict[str, str]]
"""Arrays in the shape of a piece by variable, the status last; and texts of exceptions by cell."""
_SHORTEST, _LONGEST = 0.25, 2.0
"""Duration of a piece in seconds: long compared with the overhead, short enough to lose."""
_PIECES = 16
"""Pieces per worker, so that all workers finish at about the same time; fewer if they would be too short."""
_MOST_NUMBERS = 1_000_000
"""Maximum number of values of a piece, which take 8 MB."""
_LONG_ENOUGH = 0.05
"""Minimum duration in seconds of a trial that measures the cost of a cell."""
_PART = 128
"""A trial computes at most this fraction (1/128) of all cells."""


def cell_name(cell: Mapping[str, float]) -> str:
    """Return the coordinates of a cell as text, with all digits."""
    return ", ".join(f"{name} = {float(value)!r}" for name, value in cell.items())


def compute(piece: SweepPlan) -> PieceResult:
    """Compute all cells of a plan in this process."""
    columns = piece.columns()
    found = evaluate(piece.computation, piece.numbers, columns, as_level(piece.accuracy))
    arrays: dict[str, Any] = {}
    for own, name in piece.variables.items():
        arrays[own] = found.values[name]
        if name in found.errors:
            arrays[f"{own}_error"] = found.errors[name]
    arrays["status"] = found.status
    failed = np.flatnonzero(found.status == Outcome.FAILED).tolist()
    failures = {cell_name({name: columns[name][i] for name in piece.axes}): found.reasons[i] for i in failed}
    return {name: values.reshape(piece.shape) for name, values in arrays.items()}, failures


def serialize(plan: SweepPlan) -> bytes:
    """Serialize a plan without its axes and source, including functions that are defined in a notebook.

    Raises `InvalidParameter` if the computation cannot be pickled.
    """
    import cloudpickle

    what = plan.computation
    # Serialize importable functions by name: a copy of a system would have to compile its kernels.
    known = catalogue().get(what.key) is what
    try:
        return bytes(cloudpickle.dumps((what.key if known else what, plan.numbers, plan.accuracy, plan.fixed)))
    # Serialization runs code of the user's objects, which may raise any exception.
    except Exception as error:
        raise InvalidParameter(
            f"{what.key} cannot be sent to other processes ({error}): omit workers and scheduler, or avoid objects "
            "that cannot be pickled, such as open files and locks."
        ) from error


@lru_cache(maxsize=1)
def _plan_of(content: bytes) -> SweepPlan:
    """Return the plan from its serialized form.

    All pieces share one object, so that a function stays compiled.
    """
    what, numbers, accuracy, fixed = pickle.loads(content)
    return SweepPlan(find(what) if isinstance(what, str) else what, numbers, accuracy, {}, fixed)


def compute_sent(content: bytes, release: str, axes: Mapping[str, Array]) -> PieceResult:
    """Compute a piece of a serialized plan on a worker.  Raises `WorkersLost` if the versions differ."""
    if release != version():
        raise WorkersLost(
            f"A worker has version {version()} of hess-explorer, but the sweep needs {release}: "
            "install the same version on all workers."
        )
    return compute(replace(_plan_of(content), axes=axes))


def piece_size(plan: SweepPlan, workers: int) -> float:
    """Return the maximum number of cells of a piece, from the measured cost of random cells."""
    cost = _seconds_of_a_cell(plan)
    seconds = min(_LONGEST, max(_SHORTEST, cost * plan.cells / (_PIECES * workers)))
    return max(1.0, min(seconds / cost, _MOST_NUMBERS / len(plan.numbers)))


def _seconds_of_a_cell(plan: SweepPlan) -> float:
    """Return the mean time of a cell in seconds; ∞ for a small sweep, which has one cell per piece."""
    if plan.cells < _PART // 4:
        return np.inf
    random = np.random.default_rng(0)

    def trial(count: int) -> float:
        columns, begun = plan.columns(random.integers(plan.cells, size=count)), time.perf_counter()
        evaluate(plan.computation, plan.numbers, columns, as_level(plan.accuracy))
        return time.perf_counter() - begun

    # Do not time the first cell, which compiles or loads kernels.
    trial(1)
    count = 1
    while (seconds := trial(count)) < _LONG_ENOUGH and 2 * count * _PART <= plan.cells:
        count *= 2
    return seconds / count
