"""A quantity that can be swept, its parameters, and the status of each cell of a sweep."""

from __future__ import annotations

import logging
import math
from collections.abc import Callable, Iterable, Mapping
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
    "CellResults",
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
"""The values of each parameter at the cells (n,)."""

Outcomes = NDArray[np.uint8]


class Outcome(IntEnum):
    """Status of a cell.  From 10 on it has no value: NaN, or ∞ if the value exceeds double precision."""

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
        """The status in words."""
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
    """Return a parameter with another default; doc : replaces its description."""
    return replace(of, default=default, doc=doc or of.doc)


def whole(name: str, symbol: str, default: float, low: float, high: float, doc: str) -> Parameter:
    """Return an integer parameter of the computation."""
    return Parameter(name, symbol, doc, default, (low, high), 1.0, (low, high), doc, "Computation", whole=True)


@dataclass(frozen=True)
class Cell:
    """The result at one cell: its value or values, and the estimated error."""

    value: float | tuple[float, ...]
    error: float = math.nan
    status: Status = Status.OK


@dataclass(frozen=True)
class CellResults:
    """The results at cells: values (n,) or (n, m), errors (n,), status (n,), and messages of failed cells."""

    values: Array
    errors: Array
    status: Outcomes
    why: Mapping[int, str] = field(default_factory=dict)


Compute = Callable[[CellArrays, Level], CellResults]


@dataclass(frozen=True)
class Quantity:
    """A quantity that can be swept.

    Attributes
    ----------
    compute : returns the values at cells, which are independent of each other; it raises `ModelError` if a cell has no
        value.
    parts : names of the numbers at a cell, empty for a scalar.
    error : description of the error estimate, empty without one.
    turn : period of the values, for example 1 for rotation numbers; 0 if they are not periodic.
    needed : names of the parameters without a default.
    named : values that stand for categories, with their names, by part ("" for a scalar).
    source : text of a function of the user, whose parts are variables of their own; None for a quantity of the table.
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
    named: Mapping[str, Mapping[int, str]] = field(default_factory=dict)
    source: str | None = None

    @property
    def variable(self) -> str:
        """The name of the variable in a Dataset."""
        return self.name.replace("-", "_")

    @property
    def separate(self) -> bool:
        """True if each part is a variable of its own."""
        return self.source is not None and bool(self.parts)

    @property
    def variables(self) -> tuple[str, ...]:
        """The names of all variables with values in a Dataset."""
        return self.parts if self.separate else (self.variable,)

    def columns(self, values: Array) -> Iterable[Array]:
        """Return the values of each of the variables; values : (…) or (…, m)."""
        return np.moveaxis(values, -1, 0) if self.separate else (values,)

    @property
    def numbers(self) -> int:
        """The number of values at each cell."""
        return max(1, len(self.parts))

    def parameter(self, name: str) -> Parameter:
        """Return the parameter of this name.  Raises `InvalidParameter`, which lists the names."""
        for one in self.parameters:
            if one.name == name:
                return one
        raise InvalidParameter(
            f"{self.name} has no parameter {name!r}; choose from {', '.join(one.name for one in self.parameters)}."
        )


def refused(error: Exception, cell: Mapping[str, float]) -> tuple[Outcome, str]:
    """Return the status and message of a cell that raised an error; unexpected errors are logged.

    Raises `Abandoned` and `OverBudget` again, because they end the whole computation.
    """
    if isinstance(error, (Abandoned, OverBudget)):
        raise error
    for kind, outcome in _OF_ERROR:
        if isinstance(error, kind):
            return outcome, str(error)
    logger.error("a cell of a sweep failed: %s", cell, exc_info=error)
    return Outcome.FAILED, f"{type(error).__name__}: {error}"


def one_by_one(function: Callable[..., Cell], parts: int = 0) -> Compute:
    """Return a `Quantity.compute` from a function of one cell, called with the level and the parameters by name."""

    def compute(cells: CellArrays, level: Level) -> CellResults:
        names = tuple(cells)
        rows = zip(*(cells[name].tolist() for name in names), strict=True)
        count = next(iter(cells.values())).size
        values = np.full((count, parts) if parts else count, np.nan)
        errors, status, why = np.full(count, np.nan), np.zeros(count, np.uint8), {}
        for i, row in enumerate(rows):
            try:
                found = function(level, **dict(zip(names, row, strict=True)))
                values[i], errors[i], status[i] = found.value, found.error, _OF_STATUS[found.status]
            # An error in one cell must not stop the sweep.
            except Exception as error:
                status[i], why[i] = refused(error, dict(zip(names, row, strict=True)))
        return CellResults(values, errors, status, why)

    return compute


def evaluate(quantity: Quantity, cells: CellArrays, level: Level) -> CellResults:
    """Return the quantity at cells; each cell without a finite value has a status and a message."""
    # `hess_mechanics` checks its results for overflow itself.
    with np.errstate(all="ignore"):
        found = _evaluated(quantity, cells, level)
    finite = np.isfinite(found.values)
    bad = ~(finite.all(axis=1) if finite.ndim > 1 else finite) & (found.status < Outcome.OUTSIDE_REGION)
    status = np.where(bad, Outcome.BEYOND_RANGE, found.status).astype(np.uint8)
    return CellResults(found.values, found.errors, status, found.why)


def _evaluated(quantity: Quantity, cells: CellArrays, level: Level) -> CellResults:
    count = next(iter(cells.values())).size
    try:
        return quantity.compute(cells, level)
    except Exception as error:
        if count == 1:
            outcome, explanation = refused(error, {name: column.item() for name, column in cells.items()})
            shape = (1, len(quantity.parts)) if quantity.parts else 1
            return CellResults(
                np.full(shape, np.nan), np.full(1, np.nan), np.full(1, outcome, np.uint8), {0: explanation}
            )
    # At least one cell raised an error: find it by bisection.
    middle = count // 2
    first, second = (
        _evaluated(quantity, {name: column[own] for name, column in cells.items()}, level)
        for own in (slice(None, middle), slice(middle, None))
    )
    return CellResults(
        np.concatenate([first.values, second.values]),
        np.concatenate([first.errors, second.errors]),
        np.concatenate([first.status, second.status]),
        {**first.why, **{middle + i: explanation for i, explanation in second.why.items()}},
    )
