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
from hess_mechanics.numerics.arguments import as_number, as_parts
from hess_mechanics.numerics.results import Array
from hess_mechanics.parameters import Parameter

MAX_CELLS = 10_000_000
"""Maximum number of cells of a sweep."""
_MOST_AXES = 3

Axis = tuple[float, float, int] | Sequence[float] | Array
"""A tuple (low, high, count) with an integer count, for evenly spaced values with both ends; or the values."""

Region = Mapping[str, slice]
"""Indices along each axis, as xarray takes them."""


@cache
def version() -> str:
    """Return the version of this package; results of different versions are not mixed."""
    return metadata.version("hess-explorer")


@dataclass(frozen=True)
class SweepPlan:
    """Numbers of a computation over the Cartesian product of the axes.

    Attributes
    ----------
    computation : Computation
        The computation.
    numbers : tuple of str
        Names of the numbers to compute.
    accuracy : str
        Level of accuracy.
    axes : mapping of str to array
        Values (n,) of the swept parameters.
    fixed : mapping of str to float
        Values of all other parameters.
    source : str
        Source code of a user's function; empty for other computations.
    """

    computation: Computation
    numbers: tuple[str, ...]
    accuracy: str
    axes: Mapping[str, Array]
    fixed: Mapping[str, float]
    source: str = ""

    @classmethod
    def of(
        cls,
        what: Computation,
        numbers: Sequence[str],
        accuracy: str,
        over: Mapping[str, Axis],
        fixed: Mapping[str, float],
        source: str = "",
    ) -> SweepPlan:
        """Return a validated plan.  Raises `InvalidParameter`, and `WorkLimit` above `MAX_CELLS` cells."""
        if not isinstance(over, Mapping) or not 1 <= len(over) <= _MOST_AXES:
            raise InvalidParameter(
                f"over = {over!s:.80} is not a valid mapping: map one to {_MOST_AXES} parameters to their values."
            )
        if both := over.keys() & fixed:
            raise InvalidParameter(f"{min(both)} is both swept and fixed: give it only once.")
        for name in as_parts("numbers", numbers):
            what.number(name)
        axes = {name: _axis(what.parameter(name), values) for name, values in over.items()}
        given = what.values(fixed)
        others = {one.name: float(given[one.name]) for one in what.parameters if one.name not in over}
        plan = cls(what, tuple(numbers), accuracy, axes, others, source)
        if plan.cells > MAX_CELLS:
            raise WorkLimit(
                f"The sweep has {plan.cells} cells, but at most {MAX_CELLS} are allowed: choose fewer values."
            )
        return plan

    @property
    def variables(self) -> dict[str, str]:
        """The name of the number in each variable of the Dataset, by the name of the variable."""
        taken = (*self.axes, "status")
        return {f"{name.replace('-', '_')}{'_value' if name in taken else ''}": name for name in self.numbers}

    @property
    def shape(self) -> tuple[int, ...]:
        """The number of cells along each axis."""
        return tuple(values.size for values in self.axes.values())

    @property
    def cells(self) -> int:
        """The total number of cells."""
        return math.prod(self.shape)

    def part(self, region: Region) -> SweepPlan:
        """Return the plan of the cells in a region, which has a slice for each axis."""
        return replace(self, axes={name: values[region[name]] for name, values in self.axes.items()})

    def columns(self, cells: NDArray[np.int64] | None = None) -> dict[str, Array]:
        """Return the values (n,) of all parameters at n cells, by default all cells.

        The last axis varies fastest.
        """
        every = np.arange(self.cells) if cells is None else cells
        at = zip(self.axes.items(), np.unravel_index(every, self.shape), strict=True)
        fixed = {name: np.full(every.size, value) for name, value in self.fixed.items()}
        return {name: values[i] for (name, values), i in at} | fixed


def _axis(one: Parameter, values: Axis) -> Array:
    if isinstance(values, tuple) and len(values) == 3 and isinstance(values[2], (int, np.integer)):
        if not 2 <= values[2] <= MAX_CELLS:
            raise InvalidParameter(f"The range of {one.name} has {values[2]} values: choose 2 to {MAX_CELLS}.")
        low, high = (one.check(as_number(one.name, end)) for end in values[:2])
        return np.linspace(low, high, int(values[2]))
    found = np.array([one.check(as_number(one.name, value)) for value in as_parts(one.name, values)])
    if np.unique(found).size < max(found.size, 1):
        raise InvalidParameter(
            f"The values of {one.name} are empty or repeat a number: give one or more different numbers."
        )
    return found
