"""Evaluate a computation at many cells, for sweeps and charts; each cell has a status."""

from __future__ import annotations

import logging
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import IntEnum
from typing import Self, TypeAlias

import numpy as np
from numpy.typing import NDArray

from hess_explorer.compute.budget import ClientGone, OverBudget
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

logger = logging.getLogger("hess_explorer")

Outcomes: TypeAlias = NDArray[np.uint8]


class UserError(Exception):
    """An exception that a user's function raised; the message has its type and text."""


class Outcome(IntEnum):
    """Status of a cell.  From 10 on all numbers of the cell are NaN, or infinite beyond the range of doubles."""

    words: str
    """The status in words."""

    def __new__(cls, code: int, words: str = "") -> Self:
        """Return the member with a code and its words."""
        found = int.__new__(cls, code)
        found._value_, found.words = code, words
        return found

    NOT_COMPUTED = 0, "not computed"
    OK = 1, "ok"
    FLOOR = 2, "double-precision floor"
    PROMISE_NOT_MET = 3, "promise not met"
    INCOMPLETE = 4, "incomplete"
    OUTSIDE_REGION = 10, "no such motion"
    SEPARATRIX = 11, "separatrix"
    INVALID_PARAMETER = 12, "invalid parameter"
    NO_BODY = 13, "moment of inertia not positive"
    NO_FIELD = 14, "no field"
    WORK_LIMIT = 15, "too much work"
    BEYOND_RANGE = 16, "beyond double precision"
    NO_VALUE = 17, "no value"
    FAILED = 18, "failed"


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
    (UserError, Outcome.FAILED),
)


@dataclass(frozen=True)
class CellResults:
    """The results at n cells.

    Attributes
    ----------
    values : mapping of str to array (n,)
        The numbers by name.
    errors : mapping of str to array (n,)
        Their estimated errors, where estimates exist.
    status : array (n,) of uint8
        Status of each cell, an `Outcome`.
    reasons : mapping of int to str
        The reason why a cell has no number, or why one of its numbers is missing, by index of the cell; no entry for a
        cell that is only beyond double precision.
    """

    values: Mapping[str, Array]
    errors: Mapping[str, Array]
    status: Outcomes
    reasons: Mapping[int, str] = field(default_factory=dict)


def failure(error: Exception, cell: Mapping[str, object]) -> tuple[Outcome, str]:
    """Return the status and message of a cell that raised an error; log unexpected errors.

    `ClientGone` and `OverBudget` are raised again, because they end the whole computation.
    """
    if isinstance(error, (ClientGone, OverBudget)):
        raise error
    for kind, outcome in _OF_ERROR:
        if isinstance(error, kind):
            return outcome, str(error)
    logger.error("a cell failed: %s", cell, exc_info=error)
    return Outcome.FAILED, f"{type(error).__name__}: {error}"


def evaluate(what: Computation, numbers: Sequence[str], columns: Mapping[str, Array], level: Level) -> CellResults:
    """Return numbers of a computation at n cells.

    A cell without any finite number has a status of 10 or more.

    Parameters
    ----------
    what : Computation
        The computation.
    numbers : sequence of str
        Names of its numbers.
    columns : mapping of str to array (n,)
        Values of parameters; all others have their defaults.
    level : Level
        Level of accuracy.

    Returns
    -------
    CellResults
        Values, errors and status of the cells.

    Raises
    ------
    ClientGone, OverBudget
        As `budget.check`.
    """
    count = next(iter(columns.values())).size
    with np.errstate(all="ignore"):
        if what.vectorized is not None and (many := _at_once(what, numbers, columns, level, count)) is not None:
            return many
        return _one_by_one(what, numbers, columns, level, count)


def _at_once(
    what: Computation, numbers: Sequence[str], columns: Mapping[str, Array], level: Level, count: int
) -> CellResults | None:
    """Evaluate all cells in one call; return None if it does not give all of the numbers, or raises a `ModelError`."""
    assert what.vectorized is not None
    every = {one.name: np.full(count, one.default) for one in what.parameters} | dict(columns)
    try:
        known, missing = what.vectorized(level, **every)
    except ModelError:
        # The caller then computes the cells one by one, which shows where the error is.
        return None
    if not {*numbers} <= known.keys():
        return None
    status: Outcomes = np.full(count, Outcome.OK, np.uint8)
    reasons: dict[int, str] = {}
    for kind, there in missing.items():
        outcome = next(outcome for error, outcome in _OF_ERROR if issubclass(kind, error))
        status[there] = outcome
        reasons |= dict.fromkeys(np.flatnonzero(there).tolist(), f"{outcome.words}.")
    values = {name: known[name] for name in numbers}
    finite = np.any([np.isfinite(one) for one in values.values()], axis=0)
    status[~finite & (status < Outcome.OUTSIDE_REGION)] = Outcome.BEYOND_RANGE
    return CellResults(values, {}, status, reasons)


def _one_by_one(
    what: Computation, numbers: Sequence[str], columns: Mapping[str, Array], level: Level, count: int
) -> CellResults:
    values = {name: np.full(count, np.nan) for name in numbers}
    errors = {name: np.full(count, np.nan) for name in numbers if what.number(name).error_reader is not None}
    status: Outcomes = np.zeros(count, np.uint8)
    reasons: dict[int, str] = {}
    rows = zip(*(column.tolist() for column in columns.values()), strict=True)
    for i, row in enumerate(rows):
        cell = dict(zip(columns, row, strict=True))
        try:
            found = what.compute(cell, level)
        # An error in one cell must not stop the others.
        except Exception as error:
            status[i], reasons[i] = failure(error, cell)
            continue
        status[i] = Outcome[getattr(found, "status", Status.OK).name]
        outcomes = []
        for name in numbers:
            one = what.number(name)
            try:
                values[name][i] = one.read(found)
                if name in errors:
                    errors[name][i] = one.error(found)
            except Exception as error:
                outcome, reasons[i] = failure(error, cell)
                outcomes.append(outcome)
                continue
            if not math.isfinite(values[name][i]):
                outcomes.append(Outcome.BEYOND_RANGE)
        # A cell with at least one finite number counts as computed.
        if len(outcomes) == len(numbers):
            status[i] = outcomes[0]
    return CellResults(values, errors, status, reasons)
