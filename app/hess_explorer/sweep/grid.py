"""The grid of a sweep: axes, fixed parameters, and boxes of cells as units of work."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import product

import numpy as np

from hess_explorer.sweep.quantity import CellArrays, Quantity
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.arguments import as_number
from hess_mechanics.numerics.results import Array
from hess_mechanics.parameters import Parameter

__all__ = ["HARD_LIMIT", "MAX_NUMBERS", "Axis", "Box", "Part", "SweepGrid", "boxes", "expanded", "size"]

MAX_NUMBERS = 10_000_000
"""Default limit of the number of values of a sweep, which take 90 MB in memory or on disk."""
HARD_LIMIT = 10_000_000_000
_MOST_AXES = 3

Axis = tuple[float, float, int] | Sequence[float] | Array
"""A tuple (low, high, count) with an integer count, for evenly spaced values with both ends; or the values."""

Box = tuple[tuple[int, int], ...]
"""Half-open range of indices along each axis."""

Part = tuple[int, int]
"""(k, n): part k of n of a job array, counted from 1."""


@dataclass(frozen=True)
class SweepGrid:
    """The Cartesian product of the axes, and the values of the fixed parameters."""

    axes: Mapping[str, Array]
    fixed: Mapping[str, float]

    @classmethod
    def of(cls, quantity: Quantity, over: Mapping[str, Axis], fixed: Mapping[str, float], most: float) -> SweepGrid:
        """Return the checked grid.  Raises `InvalidParameter`, `WorkLimit`."""
        if not 1 <= len(over) <= _MOST_AXES:
            raise InvalidParameter(f"A sweep takes one to {_MOST_AXES} parameters, not {len(over)}.")
        both = sorted(set(over) & set(fixed))
        if both:
            raise InvalidParameter(f"{both[0]} is both swept and fixed: give it only once.")
        for name in (*over, *fixed):
            quantity.parameter(name)
        counts = {name: _count(values, name) for name, values in over.items()}
        numbers = math.prod(counts.values()) * quantity.numbers
        if not 1 <= (most := as_number("most_cells", most)) <= HARD_LIMIT:
            raise WorkLimit(f"most_cells must lie between 1 and {HARD_LIMIT:g}, not be {most:g}.")
        if numbers > most:
            raise WorkLimit(
                f"The sweep has {numbers} numbers; at most {most:.0f} are allowed: choose fewer values, or raise "
                f"most_cells (on the command line --most-cells), up to {HARD_LIMIT:g}."
            )
        axes = {name: _axis(quantity.parameter(name), values) for name, values in over.items()}
        return cls(
            axes, {one.name: _value(one, quantity, fixed) for one in quantity.parameters if one.name not in over}
        )

    @property
    def shape(self) -> tuple[int, ...]:
        """The number of cells along each axis."""
        return tuple(values.size for values in self.axes.values())

    @property
    def cells(self) -> int:
        """The total number of cells."""
        return math.prod(self.shape)

    def pieces(self, box: Box) -> dict[str, Array]:
        """Return the parts of the axes in a box, by name."""
        return {name: values[low:high] for (name, values), (low, high) in zip(self.axes.items(), box, strict=True)}

    def cell(self, index: int) -> dict[str, float]:
        """Return all parameters of a cell, the last axis varying fastest."""
        places = np.unravel_index(index, self.shape)
        swept = {name: values[i].item() for (name, values), i in zip(self.axes.items(), places, strict=True)}
        return {**swept, **self.fixed}

    def box_of(self, cells: float) -> tuple[int, ...]:
        """Return the shape of boxes with at most `cells` cells, by halving the longest side."""
        shape = list(self.shape)
        while math.prod(shape) > max(1.0, cells):
            longest = max(range(len(shape)), key=shape.__getitem__)
            shape[longest] = -(-shape[longest] // 2)
        return tuple(shape)

    def boxes(self, shape: Sequence[int]) -> Iterator[Box]:
        """Yield all boxes of this shape; the last one along an axis may be smaller."""
        return boxes(tuple((0, whole) for whole in self.shape), shape)


def boxes(outer: Box, shape: Sequence[int]) -> Iterator[Box]:
    """Yield the boxes of this shape in a box; the last one along an axis may be smaller."""
    starts = [range(*ends, side) for ends, side in zip(outer, shape, strict=True)]
    for corner in product(*starts):
        yield tuple((low, min(low + side, end)) for low, side, (_, end) in zip(corner, shape, outer, strict=True))


def size(box: Box) -> int:
    """Return the number of cells of a box."""
    return math.prod(high - low for low, high in box)


def expanded(pieces: Mapping[str, Array], fixed: Mapping[str, float]) -> CellArrays:
    """Return the parameters at each cell of the product of the pieces; the last axis varies fastest."""
    swept = np.meshgrid(*pieces.values(), indexing="ij")
    count = swept[0].size
    return {
        **{name: np.ascontiguousarray(column.ravel()) for name, column in zip(pieces, swept, strict=True)},
        **{name: np.full(count, value) for name, value in fixed.items()},
    }


def _is_range(values: Axis) -> bool:
    return (
        isinstance(values, tuple)
        and len(values) == 3
        and isinstance(values[2], (int, np.integer))
        and not isinstance(values[2], bool)
    )


def _count(values: Axis, name: str) -> int:
    """Return the number of values of an axis without creating them."""
    if _is_range(values):
        count = int(values[2])
        if count < 2:
            raise InvalidParameter(f"The range of {name} has {count} values: choose 2 or more, as in (0.0, 1.0, 11).")
        return count
    try:
        return len(values)
    except TypeError:
        raise InvalidParameter(f"The range of {name} must be a list of values or (low, high, count).") from None


def _axis(one: Parameter, values: Axis) -> Array:
    if _is_range(values):
        low, high = (one.check(as_number(one.name, end)) for end in values[:2])
        found = np.linspace(low, high, int(values[2]))
    else:
        try:
            found = np.array(values, float)
        except (TypeError, ValueError, OverflowError):
            raise InvalidParameter(f"The values of {one.name} must all be numbers.") from None
    if found.ndim != 1 or found.size == 0:
        raise InvalidParameter(f"The values of {one.name} must be a one-dimensional list of numbers.")
    # Check only the smallest and the largest of many values.
    for value in (float(found.min()), float(found.max()), *(found.tolist() if one.whole else ())):
        one.check(value)
    if np.unique(found).size < found.size:
        raise InvalidParameter(f"A value of {one.name} occurs twice: give each value once.")
    return found


def _value(one: Parameter, quantity: Quantity, fixed: Mapping[str, float]) -> float:
    if one.name not in fixed and one.name in quantity.needed:
        raise InvalidParameter(f"{quantity.name} needs {one.name} ({one.label}): sweep over it, or give it a value.")
    return one.check(as_number(one.name, fixed.get(one.name, one.default)))
