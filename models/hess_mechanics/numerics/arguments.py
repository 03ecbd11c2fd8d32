"""What is given by hand, checked: numbers, whole numbers, pairs and places; what is wrong is said in a sentence."""

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
    """What was given, if it is of this kind.  Raises `InvalidParameter`, as all of these."""
    if not isinstance(body, kind):
        raise InvalidParameter(f"{body!r} is no {kind.__name__}: give the body as hess_mechanics.{kind.__name__}(…).")
    return body


def as_level(accuracy: Accuracy) -> Level:
    """A level, given as it is or by its name."""
    return accuracy if isinstance(accuracy, Level) else level(accuracy)


def as_level_name(accuracy: Accuracy) -> str:
    """The name of one of the four levels, given by it or as the level itself."""
    found = as_level(accuracy)
    if LEVELS.get(found.name) != found:
        raise InvalidParameter(f"Only a level that has a name can be kept here: choose one of {', '.join(LEVELS)}.")
    return found.name


def as_number(name: str, value: Any) -> float:
    """A finite number."""
    if isinstance(value, bool) or not isinstance(value, Real):
        raise InvalidParameter(f"{name} = {value!r} is not a number; write it like 1.5 or -2e-3.")
    if not math.isfinite(value):
        raise InvalidParameter(f"{name} is not a finite number; write one like 1.5 or -2e-3.")
    return float(value)


def as_whole(name: str, value: Any, low: int, high: int) -> int:
    """A whole number between these."""
    if isinstance(value, bool) or not isinstance(value, Integral) or not low <= int(value) <= high:
        raise InvalidParameter(f"{name} = {value!r} is not a whole number from {low} to {high}.")
    return int(value)


def as_cells(cells: Any) -> tuple[int, int]:
    """How many cells a window has across and up."""
    m, n = (as_whole("cells", side, 1, _MOST_CELLS) for side in cells)
    if m * n > _MOST_CELLS:
        raise InvalidParameter(f"These are {m * n} cells; at most {_MOST_CELLS} are allowed: choose fewer.")
    return m, n


def as_pairs(name: str, places: Any) -> list[tuple[float, float]]:
    """Places of a plane."""
    try:
        return [(as_number(name, x), as_number(name, y)) for x, y in places]
    except InvalidParameter:
        raise
    except (TypeError, ValueError):
        raise InvalidParameter(
            f"{name} = {places!r} are no places; write them like [(0.0, 0.5), (1.0, 0.2)]."
        ) from None


def as_place(names: tuple[str, ...], place: Any) -> tuple[float, ...]:
    """A place with one number for each of these coordinates."""
    try:
        return tuple(as_number(name, x) for name, x in zip(names, place, strict=True))
    except InvalidParameter:
        raise
    except (TypeError, ValueError):
        raise InvalidParameter(f"{place!r} is no place here: give {len(names)} numbers, {', '.join(names)}.") from None
