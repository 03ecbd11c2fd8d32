"""Compute a piece of a sweep, here or on a worker, and measure what a cell costs."""

from __future__ import annotations

import pickle
import time
from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import lru_cache

import numpy as np

from hess_explorer.compute.cells import Outcome, evaluate
from hess_explorer.sweep.errors import WorkersLost
from hess_explorer.sweep.plan import Plan, version
from hess_mechanics.catalogue import catalogue, find
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.results import Array

__all__ = ["PieceResult", "compute", "compute_sent", "named", "seconds_of_a_cell", "sendable"]

_MOST_FAILURES = 100
"""Largest number of texts of exceptions of a piece."""
_LONG_ENOUGH = 0.05
"""Minimum duration in seconds of a trial that measures the cost of a cell."""
_PART = 128
"""A trial computes at most this fraction (1/128) of all cells."""


@dataclass(frozen=True)
class PieceResult:
    """The results of a piece in its shape, by variable, the status last; and the texts of exceptions by cell."""

    arrays: Mapping[str, Array]
    failures: Mapping[str, str]


def named(cell: Mapping[str, float]) -> str:
    """Return the coordinates of a cell in words, with all digits."""
    return ", ".join(f"{name} = {float(value)!r}" for name, value in cell.items())


def compute(piece: Plan) -> PieceResult:
    """Return the results at all cells of a plan."""
    columns = piece.columns()
    found = evaluate(piece.computation, piece.numbers, columns, as_level(piece.level))
    arrays = {own: found.values[name] for own, name in piece.variables.items()}
    arrays |= {f"{own}_error": found.errors[name] for own, name in piece.variables.items() if name in found.errors}
    failed = np.flatnonzero(found.status == Outcome.FAILED)[:_MOST_FAILURES].tolist()
    return PieceResult(
        {name: values.reshape(piece.shape) for name, values in {**arrays, "status": found.status}.items()},
        {named({name: columns[name][i] for name in piece.axes}): found.why[i] for i in failed},
    )


def sendable(plan: Plan) -> bytes:
    """Return a plan without its axes as workers receive it, with the text of functions of a notebook.

    Raises `InvalidParameter`.
    """
    import cloudpickle

    what = plan.computation
    known = catalogue().get(what.key) is what
    try:
        return bytes(cloudpickle.dumps((what.key if known else what, replace(plan, computation=None, axes={}))))
    # Whatever the objects that a function uses raise.
    except Exception as error:
        raise InvalidParameter(
            f"{what.key} cannot be sent to other processes ({error}): leave out workers, or define it without what "
            "cannot be pickled, such as open files and locks."
        ) from error


def compute_sent(content: bytes, needed: str, axes: Mapping[str, Array]) -> PieceResult:
    """Return the results of a piece of a plan that was sent.  Raises `WorkersLost` if the versions differ."""
    if needed != version():
        raise WorkersLost(
            f"A worker has version {version()} of hess-explorer, but the sweep needs {needed}: "
            "install the same version on all workers."
        )
    return compute(replace(_received(content), axes=axes))


@lru_cache(maxsize=1)
def _received(content: bytes) -> Plan:
    """Return the same object for all pieces, so that a function keeps what it has compiled."""
    what, plan = pickle.loads(content)
    return replace(plan, computation=find(what) if isinstance(what, str) else what)


def seconds_of_a_cell(plan: Plan) -> float:
    """Return the cost of a cell from trials at random cells of growing number; ∞ for few cells."""
    if plan.cells <= _PART // 4:
        return float("inf")
    random, count, level = np.random.default_rng(0), 1, as_level(plan.level)
    # The first cell compiles or loads kernels.
    evaluate(plan.computation, plan.numbers, plan.columns(np.zeros(1, int)), level)
    while True:
        columns, begun = plan.columns(random.integers(plan.cells, size=count)), time.perf_counter()
        evaluate(plan.computation, plan.numbers, columns, level)
        seconds = time.perf_counter() - begun
        if seconds >= _LONG_ENOUGH or 2 * count * _PART > plan.cells:
            return seconds / count
        count *= 2
