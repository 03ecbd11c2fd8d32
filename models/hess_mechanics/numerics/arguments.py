"""Validation of arguments: numbers, integers, pairs and points.  All functions raise `InvalidParameter`."""

from __future__ import annotations

import math
from numbers import Integral, Real
from typing import Any, TypeVar

from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import LEVELS, Accuracy, Level, level

__all__ = ["as_a", "as_cells", "as_level", "as_level_name", "as_number", "as_pairs", "as_place", "as_whole"]

T = TypeVar("T")
_MOST_CELLS = 100_000


def as_a(kind: type[T], body: object) -> T:
    """Return the argument if it is an instance of `kind`."""
    if not isinstance(body, kind):
        raise InvalidParameter(f"{body!r} is not a {kind.__name__}: give a hess_mechanics.{kind.__name__}(…).")
    return body


def as_level(accuracy: Accuracy) -> Level:
    """Return an accuracy level, given as it is or by its name."""
    return accuracy if isinstance(accuracy, Level) else level(accuracy)


def as_level_name(accuracy: Accuracy) -> str:
    """Return the name of one of the four levels, given by name or as the level itself."""
    found = as_level(accuracy)
    if LEVELS.get(found.name) != found:
        raise InvalidParameter(f"Only a named level is possible here: choose one of {', '.join(LEVELS)}.")
    return found.name


def as_number(name: str, value: Any) -> float:
    """Return a finite number as a float."""
    if isinstance(value, bool) or not isinstance(value, Real):
        raise InvalidParameter(f"{name} = {value!r} is not a number; write it like 1.5 or -2e-3.")
    if not math.isfinite(value):
        raise InvalidParameter(f"{name} is not a finite number; write one like 1.5 or -2e-3.")
    return float(value)


def as_whole(name: str, value: Any, low: int, high: int) -> int:
    """Return an integer between `low` and `high`."""
    if isinstance(value, bool) or not isinstance(value, Integral) or not low <= int(value) <= high:
        raise InvalidParameter(f"{name} = {value!r} is not a whole number from {low} to {high}.")
    return int(value)


def as_cells(cells: Any) -> tuple[int, int]:
    """Return the numbers of cells of a window, across and up."""
    m, n = (as_whole("cells", side, 1, _MOST_CELLS) for side in cells)
    if m * n > _MOST_CELLS:
        raise InvalidParameter(f"{m * n} cells are too many: at most {_MOST_CELLS} are allowed.")
    return m, n


def as_pairs(name: str, places: Any) -> list[tuple[float, float]]:
    """Return points of a plane as pairs of floats."""
    try:
        return [(as_number(name, x), as_number(name, y)) for x, y in places]
    except InvalidParameter:
        raise
    except (TypeError, ValueError):
        raise InvalidParameter(
            f"{name} = {places!r} is not a list of points; write them like [(0.0, 0.5), (1.0, 0.2)]."
        ) from None


def as_place(names: tuple[str, ...], place: Any) -> tuple[float, ...]:
    """Return a point with one float for each of the named coordinates."""
    try:
        return tuple(as_number(name, x) for name, x in zip(names, place, strict=True))
    except InvalidParameter:
        raise
    except (TypeError, ValueError):
        raise InvalidParameter(
            f"{place!r} is not a point here: give {len(names)} numbers, {', '.join(names)}."
        ) from None
