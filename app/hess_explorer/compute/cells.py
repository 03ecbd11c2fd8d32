"""Numbers of a computation at many cells, for sweeps and charts: each cell has a status, or a reason for its lack."""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import IntEnum
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from hess_explorer.compute.budget import Abandoned, OverBudget
from hess_mechanics.catalogue import Computation, NoValue
from hess_mechanics.errors import (
    InvalidParameter,
    ModelError,
    NoField,
    NotPositiveDefinite,
    OutsideRegion,
    Separatrix,
    WorkLimit,
)
from hess_mechanics.numerics.accuracy import Level, Status
from hess_mechanics.numerics.results import Array

__all__ = ["CellResults", "Outcome", "Outcomes", "evaluate", "refused"]

logger = logging.getLogger("hess_explorer")

Outcomes: TypeAlias = NDArray[np.uint8]


class Outcome(IntEnum):
    """Status of a cell.  From 10 on it has no number: NaN, or ∞ if the number exceeds double precision."""

    NOT_COMPUTED = 0
    OK = 1
    FLOOR = 2
    PROMISE_NOT_MET = 3
    INCOMPLETE = 4
    OUTSIDE_REGION = 10
    SEPARATRIX = 11
    INVALID_PARAMETER = 12
    NO_BODY = 13
    NO_FIELD = 14
    WORK_LIMIT = 15
    BEYOND_RANGE = 16
    NO_VALUE = 17
    FAILED = 18

    @property
    def words(self) -> str:
        """The status in words."""
        return _WORDS[self]


_WORDS = {
    Outcome.NOT_COMPUTED: "not computed",
    Outcome.OK: "ok",
    Outcome.FLOOR: "double-precision floor",
    Outcome.PROMISE_NOT_MET: "promise not met",
    Outcome.INCOMPLETE: "incomplete",
    Outcome.OUTSIDE_REGION: "no such motion",
    Outcome.SEPARATRIX: "separatrix",
    Outcome.INVALID_PARAMETER: "invalid parameter",
    Outcome.NO_BODY: "moment of inertia not positive",
    Outcome.NO_FIELD: "no field",
    Outcome.WORK_LIMIT: "too much work",
    Outcome.BEYOND_RANGE: "beyond double precision",
    Outcome.NO_VALUE: "no value",
    Outcome.FAILED: "failed",
}

_OF_STATUS = {
    Status.OK: Outcome.OK,
    Status.FLOOR: Outcome.FLOOR,
    Status.PROMISE_NOT_MET: Outcome.PROMISE_NOT_MET,
    Status.INCOMPLETE: Outcome.INCOMPLETE,
}

_OF_ERROR: tuple[tuple[type[Exception], Outcome], ...] = (
    (OutsideRegion, Outcome.OUTSIDE_REGION),
    (Separatrix, Outcome.SEPARATRIX),
    (NoField, Outcome.NO_FIELD),
    (NotPositiveDefinite, Outcome.NO_BODY),
    (WorkLimit, Outcome.WORK_LIMIT),
    (NoValue, Outcome.NO_VALUE),
    (InvalidParameter, Outcome.INVALID_PARAMETER),
    (ModelError, Outcome.NO_VALUE),
    (ArithmeticError, Outcome.BEYOND_RANGE),
)


@dataclass(frozen=True)
class CellResults:
    """The results at n cells.

    values, errors : by the name of the number, each (n,); errors only of numbers with an estimate.
    status : (n,).  why : by cell, the reason why it has no number, or which of its numbers is missing.
    """

    values: Mapping[str, Array]
    errors: Mapping[str, Array]
    status: Outcomes
    why: Mapping[int, str] = field(default_factory=dict)


def refused(error: Exception, cell: Mapping[str, object]) -> tuple[Outcome, str]:
    """Return the status and message of a cell that raised an error; unexpected errors are logged.

    Raises `Abandoned` and `OverBudget` again, because they end the whole computation.
    """
    if isinstance(error, (Abandoned, OverBudget)):
        raise error
    for kind, outcome in _OF_ERROR:
        if isinstance(error, kind):
            return outcome, str(error)
    logger.error("a cell failed: %s", cell, exc_info=error)
    return Outcome.FAILED, f"{type(error).__name__}: {error}"


def evaluate(what: Computation, numbers: Sequence[str], columns: Mapping[str, Array], level: Level) -> CellResults:
    """Return numbers of a computation at cells; columns : values (n,) of parameters, the others have their defaults.

    Each cell without any finite number has a status and a message.
    """
    count = next(iter(columns.values())).size
    with np.errstate(all="ignore"):
        if what.many is not None and (many := _at_once(what, numbers, columns, level, count)) is not None:
            return many
        return _one_by_one(what, numbers, columns, level, count)


def _at_once(
    what: Computation, numbers: Sequence[str], columns: Mapping[str, Array], level: Level, count: int
) -> CellResults | None:
    """Return the numbers of all cells at once; None if some of them are computed one by one only, or one fails."""
    assert what.many is not None
    every = {one.name: np.full(count, one.default) for one in what.parameters} | dict(columns)
    try:
        found = what.many(level, **every)
    except ModelError:
        # One by one tells which cells are wrong.
        return None
    if not set(numbers) <= set(found.numbers):
        return None
    status: Outcomes = np.full(count, Outcome.OK, np.uint8)
    why: dict[int, str] = {}
    for kind, there in found.missing.items():
        outcome = next(outcome for error, outcome in _OF_ERROR if issubclass(kind, error))
        status[there] = outcome
        why |= dict.fromkeys(np.flatnonzero(there).tolist(), f"{outcome.words}.")
    values = {name: np.asarray(found.numbers[name], float) for name in numbers}
    finite = np.any([np.isfinite(one) for one in values.values()], axis=0)
    status[~finite & (status < Outcome.OUTSIDE_REGION)] = Outcome.BEYOND_RANGE
    return CellResults(values, {}, status, why)


def _one_by_one(
    what: Computation, numbers: Sequence[str], columns: Mapping[str, Array], level: Level, count: int
) -> CellResults:
    values = {name: np.full(count, np.nan) for name in numbers}
    errors = {name: np.full(count, np.nan) for name in numbers if what.number(name).error_reader is not None}
    status: Outcomes = np.zeros(count, np.uint8)
    why: dict[int, str] = {}
    rows = zip(*(column.tolist() for column in columns.values()), strict=True)
    for i, row in enumerate(rows):
        cell = dict(zip(columns, row, strict=True))
        try:
            found = what.compute(cell, level)
        # An error in one cell must not stop the others.
        except Exception as error:
            status[i], why[i] = refused(error, cell)
            continue
        status[i] = _OF_STATUS.get(getattr(found, "status", Status.OK), Outcome.OK)
        outcomes = []
        for name in numbers:
            one = what.number(name)
            try:
                values[name][i] = one.read(found)
                if name in errors:
                    errors[name][i] = one.error(found)
            except Exception as error:
                outcome, why[i] = refused(error, cell)
                outcomes.append(outcome)
                continue
            if not math.isfinite(values[name][i]):
                outcomes.append(Outcome.BEYOND_RANGE)
        # A cell with some of its numbers is not without a value.
        if len(outcomes) == len(numbers):
            status[i] = outcomes[0]
    return CellResults(values, errors, status, why)
