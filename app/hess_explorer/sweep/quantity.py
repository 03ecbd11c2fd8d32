"""What can be swept: a quantity, its parameters, and how each cell of a sweep ended."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, field, replace
from enum import IntEnum

import numpy as np
from numpy.typing import NDArray

from hess_explorer.compute.budget import Abandoned, OverBudget
from hess_explorer.sweep.errors import NoValue
from hess_mechanics.errors import (
    InvalidParameter,
    NoField,
    NotPositiveDefinite,
    OutsideRegion,
    Separatrix,
    WorkLimit,
)
from hess_mechanics.numerics.accuracy import Level, Status
from hess_mechanics.numerics.results import Array
from hess_mechanics.parameters import Parameter

__all__ = [
    "Cell",
    "CellArrays",
    "Found",
    "Outcome",
    "Outcomes",
    "Quantity",
    "evaluate",
    "one_by_one",
    "refused",
    "usual",
    "whole",
]

logger = logging.getLogger("hess_explorer")

CellArrays = Mapping[str, Array]
"""The value of every parameter at each cell, (n,) each."""

Outcomes = NDArray[np.uint8]


class Outcome(IntEnum):
    """How a cell ended.  From 10 on it has no number: the value is NaN, or ∞ where it is beyond double precision."""

    NOT_COMPUTED = 0
    OK = 1
    FLOOR = 2
    PROMISE_NOT_MET = 3
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
        """For people."""
        return _WORDS[self]


_WORDS = {
    Outcome.NOT_COMPUTED: "not computed",
    Outcome.OK: "ok",
    Outcome.FLOOR: "double-precision floor",
    Outcome.PROMISE_NOT_MET: "promise not met",
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

_OF_STATUS = {Status.OK: Outcome.OK, Status.FLOOR: Outcome.FLOOR, Status.PROMISE_NOT_MET: Outcome.PROMISE_NOT_MET}

_OF_ERROR: tuple[tuple[type[Exception], Outcome], ...] = (
    (OutsideRegion, Outcome.OUTSIDE_REGION),
    (Separatrix, Outcome.SEPARATRIX),
    (NoField, Outcome.NO_FIELD),
    (NotPositiveDefinite, Outcome.NO_BODY),
    (WorkLimit, Outcome.WORK_LIMIT),
    (NoValue, Outcome.NO_VALUE),
    (InvalidParameter, Outcome.INVALID_PARAMETER),
    (ArithmeticError, Outcome.BEYOND_RANGE),
)


def usual(of: Parameter, default: float, doc: str = "") -> Parameter:
    """Return a parameter with another default; doc : its meaning here, if it says more."""
    return replace(of, default=default, doc=doc or of.doc)


def whole(name: str, symbol: str, default: float, low: float, high: float, doc: str) -> Parameter:
    """Return a parameter of the computation that is a whole number."""
    return Parameter(name, symbol, doc, default, (low, high), 1.0, (low, high), doc, "Computation", whole=True)


@dataclass(frozen=True)
class Cell:
    """The outcome at one cell: the number or numbers, and its estimated error."""

    value: float | tuple[float, ...]
    error: float = math.nan
    status: Status = Status.OK


@dataclass(frozen=True)
class Found:
    """The outcome at cells: values (n,) or (n, m), errors (n,), status (n,), and the sentences of those that failed."""

    values: Array
    errors: Array
    status: Outcomes
    why: Mapping[int, str] = field(default_factory=dict)


Compute = Callable[[CellArrays, Level], Found]


@dataclass(frozen=True)
class Quantity:
    """One that can be swept.

    compute : its values at cells, each of which does not depend on the others; a `ModelError` says that at least one of
        the cells has no value.
    parts : the names of the numbers at one cell; none for a scalar.
    error : what its error estimate is; empty where there is none.
    turn : numbers that differ by it are the same, as rotation numbers by 1; 0 where all differ.
    needed : parameters that have no usual value here and must be given.
    """

    name: str
    symbol: str
    title: str
    units: str
    doc: str
    parameters: tuple[Parameter, ...]
    compute: Compute
    parts: tuple[str, ...] = ()
    error: str = ""
    turn: float = 0.0
    needed: tuple[str, ...] = ()

    @property
    def variable(self) -> str:
        """The name of its variable in a Dataset."""
        return self.name.replace("-", "_")

    @property
    def numbers(self) -> int:
        """How many of them there are at each cell."""
        return max(1, len(self.parts))

    def parameter(self, name: str) -> Parameter:
        """The parameter of this name.  Raises `InvalidParameter`, which lists the names."""
        for one in self.parameters:
            if one.name == name:
                return one
        raise InvalidParameter(
            f"{self.name} has no parameter {name!r}; choose from {', '.join(one.name for one in self.parameters)}."
        )


def refused(error: Exception, cell: Mapping[str, float]) -> tuple[Outcome, str]:
    """How a cell ended that raised, and the sentence; what is not an error of the mechanics goes to the log.

    Raises `Abandoned`, `OverBudget` again: these are of no cell, and end them all.
    """
    if isinstance(error, (Abandoned, OverBudget)):
        raise error
    for kind, outcome in _OF_ERROR:
        if isinstance(error, kind):
            return outcome, str(error)
    logger.error("a cell of a sweep failed: %s", cell, exc_info=error)
    return Outcome.FAILED, f"{type(error).__name__}: {error}"


def one_by_one(function: Callable[..., Cell], parts: int = 0) -> Compute:
    """`Quantity.compute` from a function of one cell, called with the level and the parameters by name."""

    def compute(cells: CellArrays, level: Level) -> Found:
        names = tuple(cells)
        rows = zip(*(cells[name].tolist() for name in names), strict=True)
        count = next(iter(cells.values())).size
        values = np.full((count, parts) if parts else count, np.nan)
        errors, status, why = np.full(count, np.nan), np.zeros(count, np.uint8), {}
        for i, row in enumerate(rows):
            try:
                found = function(level, **dict(zip(names, row, strict=True)))
                values[i], errors[i], status[i] = found.value, found.error, _OF_STATUS[found.status]
            # Whatever one cell raises must not end the sweep of a night.
            except Exception as error:
                status[i], why[i] = refused(error, dict(zip(names, row, strict=True)))
        return Found(values, errors, status, why)

    return compute


def evaluate(quantity: Quantity, cells: CellArrays, level: Level) -> Found:
    """The quantity at cells.  A cell that has no finite value says why, whatever the function made of it."""
    # The mechanics check their results for overflow themselves.
    with np.errstate(all="ignore"):
        found = _evaluated(quantity, cells, level)
    finite = np.isfinite(found.values)
    bad = ~(finite.all(axis=1) if finite.ndim > 1 else finite) & (found.status < Outcome.OUTSIDE_REGION)
    status = np.where(bad, Outcome.BEYOND_RANGE, found.status).astype(np.uint8)
    return Found(found.values, found.errors, status, found.why)


def _evaluated(quantity: Quantity, cells: CellArrays, level: Level) -> Found:
    count = next(iter(cells.values())).size
    try:
        return quantity.compute(cells, level)
    except Exception as error:
        if count == 1:
            outcome, said = refused(error, {name: column.item() for name, column in cells.items()})
            shape = (1, len(quantity.parts)) if quantity.parts else 1
            return Found(np.full(shape, np.nan), np.full(1, np.nan), np.full(1, outcome, np.uint8), {0: said})
    # One cell refuses all: find it by halves.
    middle = count // 2
    first, second = (
        _evaluated(quantity, {name: column[own] for name, column in cells.items()}, level)
        for own in (slice(None, middle), slice(middle, None))
    )
    return Found(
        np.concatenate([first.values, second.values]),
        np.concatenate([first.errors, second.errors]),
        np.concatenate([first.status, second.status]),
        {**first.why, **{middle + i: said for i, said in second.why.items()}},
    )
