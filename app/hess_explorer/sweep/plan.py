"""The plan of a sweep: everything that determines its values."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from importlib import metadata

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.catalogue import Computation
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.arguments import as_number
from hess_mechanics.numerics.results import Array
from hess_mechanics.parameters import Parameter

__all__ = ["MAX_CELLS", "Axis", "Plan", "Region", "version"]

MAX_CELLS = 10_000_000
"""Default limit of the number of cells of a sweep."""
_HARD_LIMIT = 10_000_000_000
_MOST_AXES = 3

Axis = tuple[float, float, int] | Sequence[float] | Array
"""A tuple (low, high, count) with an integer count, for evenly spaced values with both ends; or the values."""

Region = Mapping[str, slice]
"""Indices along each axis, as xarray takes them."""


@cache
def version() -> str:
    """Return the version of this package; results of different versions are not mixed."""
    try:
        return metadata.version("hess-explorer")
    except metadata.PackageNotFoundError:
        return "not installed"


@dataclass(frozen=True)
class Plan:
    """Numbers of a computation over the Cartesian product of the axes.

    Attributes
    ----------
    fixed : values of the parameters that are not swept.
    source : text of a function of the user, empty for other computations.
    """

    computation: Computation
    numbers: tuple[str, ...]
    level: str
    axes: Mapping[str, Array]
    fixed: Mapping[str, float]
    source: str = ""

    @classmethod
    def of(
        cls,
        what: Computation,
        numbers: Sequence[str],
        level: str,
        over: Mapping[str, Axis],
        fixed: Mapping[str, float],
        most_cells: float,
        source: str = "",
    ) -> Plan:
        """Return the checked plan.  Raises `InvalidParameter`, `WorkLimit`."""
        if not 1 <= len(over) <= _MOST_AXES:
            raise InvalidParameter(f"A sweep takes one to {_MOST_AXES} parameters, not {len(over)}.")
        if both := sorted(over.keys() & fixed):
            raise InvalidParameter(f"{both[0]} is both swept and fixed: give it only once.")
        known = {name: what.parameter(name) for name in (*over, *fixed)}
        for name in numbers:
            what.number(name)
        if not 1 <= (most := as_number("most_cells", most_cells)) <= _HARD_LIMIT:
            raise WorkLimit(f"most_cells must lie between 1 and {_HARD_LIMIT:g}, not be {most:g}.")
        # Before any value is created.
        cells = math.prod(int(values[2]) if _is_range(values) else np.size(values) for values in over.values())
        if cells > most:
            raise WorkLimit(
                f"The sweep has {cells} cells; at most {most:.0f} are allowed: choose fewer values, or raise "
                f"most_cells (on the command line --most-cells), up to {_HARD_LIMIT:g}."
            )
        axes = {name: _axis(known[name], values) for name, values in over.items()}
        others = {one.name: _value(what, one, fixed) for one in what.parameters if one.name not in over}
        return cls(what, tuple(numbers), level, axes, others, source)

    @property
    def variables(self) -> dict[str, str]:
        """The names of the numbers by that of their variable in a Dataset."""
        return {f"{name.replace('-', '_')}{'_value' if name in self.axes else ''}": name for name in self.numbers}

    @property
    def shape(self) -> tuple[int, ...]:
        """The number of cells along each axis."""
        return tuple(values.size for values in self.axes.values())

    @property
    def cells(self) -> int:
        """The total number of cells."""
        return math.prod(self.shape)

    def part(self, region: Region) -> Plan:
        """Return the plan of the cells in a region."""
        return replace(self, axes={name: values[region[name]] for name, values in self.axes.items()})

    def columns(self, cells: NDArray[np.int64] | None = None) -> dict[str, Array]:
        """Return all parameters at each cell, or at these cells, the last axis varying fastest."""
        every = np.arange(self.cells) if cells is None else cells
        at = zip(self.axes.items(), np.unravel_index(every, self.shape), strict=True)
        fixed = {name: np.full(every.size, value) for name, value in self.fixed.items()}
        return {name: values[i] for (name, values), i in at} | fixed


def _is_range(values: Axis) -> bool:
    return isinstance(values, tuple) and len(values) == 3 and isinstance(values[2], (int, np.integer))


def _axis(one: Parameter, values: Axis) -> Array:
    if _is_range(values):
        low, high = (one.check(as_number(one.name, end)) for end in values[:2])
        if values[2] < 2:
            raise InvalidParameter(f"The range of {one.name} has {values[2]} values: choose 2 or more.")
        return np.linspace(low, high, int(values[2]))
    try:
        found = np.array(values, float)
    except (TypeError, ValueError, OverflowError):
        raise InvalidParameter(f"The values of {one.name} must all be numbers.") from None
    if found.ndim != 1 or not found.size:
        raise InvalidParameter(f"The values of {one.name} must be a list of numbers or (low, high, count).")
    for value in found.tolist():
        one.check(value)
    if np.unique(found).size < found.size:
        raise InvalidParameter(f"A value of {one.name} occurs twice: give each value once.")
    return found


def _value(what: Computation, one: Parameter, fixed: Mapping[str, float]) -> float:
    value = fixed.get(one.name, one.default)
    # Parameters of the user's functions may have no default.
    if one.name not in fixed and math.isnan(value):
        raise InvalidParameter(f"{what.key} needs {one.name}: sweep over it, or give it a value.")
    return one.check(as_number(one.name, value))
