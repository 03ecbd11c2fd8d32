"""Accuracy levels: four names, and the error that each of them promises."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from hess_mechanics.errors import InvalidParameter

__all__ = ["DRAFT", "LEVELS", "PRECISE", "REFERENCE", "STANDARD", "Level", "Status", "cheapest", "level"]


class Status(StrEnum):
    """How a computation ended."""

    OK = "ok"
    FLOOR = "double-precision floor"
    PROMISE_NOT_MET = "promise not met"


@dataclass(frozen=True)
class Level:
    """One accuracy level.

    Parameters
    ----------
    name : what the user chooses.
    promise : the largest global error of a result, in units in which the state is O(1).
        For `reference` it is nominal: that level goes to the floor of double precision, which depends on the motion.
    tolerance : local error of one Taylor step, first attempt.
    order : of the Taylor series.
    """

    name: str
    promise: float
    tolerance: float
    order: int

    @property
    def is_floor(self) -> bool:
        """True for the last level, whose error is round-off and not truncation."""
        return self.tolerance <= FLOOR_TOLERANCE

    def tightened(self) -> Level:
        """The same level with a hundredth of the tolerance, against which its error is measured.

        The order differs too, so that a motion that fits into one step is not compared with itself.
        """
        if self.is_floor:
            return Level(self.name, self.promise, self.tolerance / 30.0, self.order - 3)
        order = self.order + 4 if self.tolerance > 1e-11 else REFERENCE.order
        return Level(self.name, self.promise, max(self.tolerance * 1e-2, FLOOR_TOLERANCE), order)


FLOOR_TOLERANCE = 1e-17

DRAFT = Level("draft", 1e-3, 1e-5, 12)
STANDARD = Level("standard", 1e-6, 1e-8, 16)
PRECISE = Level("precise", 1e-9, 1e-11, 20)
REFERENCE = Level("reference", 1e-12, FLOOR_TOLERANCE, 24)

LEVELS: dict[str, Level] = {each.name: each for each in (DRAFT, STANDARD, PRECISE, REFERENCE)}


def level(name: str) -> Level:
    """The level of this name.  Raises `InvalidParameter`, which lists the names."""
    try:
        return LEVELS[name]
    except KeyError:
        raise InvalidParameter(
            f"There is no accuracy level of that name; choose one of {', '.join(LEVELS)}."
        ) from None


def cheapest(error: float) -> Level:
    """The first level that promises this error or less; the last one if none does."""
    return next((each for each in LEVELS.values() if each.promise <= error), REFERENCE)
