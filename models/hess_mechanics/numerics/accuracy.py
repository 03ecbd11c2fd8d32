"""Accuracy levels: four names, and what each of them means for each kind of computation.

A Taylor series pays for digits by its order, so one orbit costs about the same at every level: `reference` takes at
most two or three times as long as `draft`.  `draft` is cheaper where it also computes less, as fewer crossings, a
shorter time or a coarser grid.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from enum import StrEnum

from hess_mechanics.errors import InvalidParameter

__all__ = [
    "DRAFT",
    "LEVELS",
    "PLANS",
    "PRECISE",
    "REFERENCE",
    "STANDARD",
    "Accuracy",
    "Computation",
    "Level",
    "Plan",
    "Status",
    "cheapest",
    "level",
    "plan",
]


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
    aside : whether motions start a few units in the last place beside their start, see `measured.nearby`.
    """

    name: str
    promise: float
    tolerance: float
    order: int
    aside: bool = False

    @property
    def is_floor(self) -> bool:
        """True for the last level, whose error is round-off and not truncation."""
        return self.tolerance <= FLOOR_TOLERANCE

    def status(self, error: float) -> Status:
        """Return the status of a result with this error estimate, in the units of the promise."""
        if error <= self.promise:
            return Status.OK
        return Status.FLOOR if self.is_floor else Status.PROMISE_NOT_MET

    def tightened(self) -> Level:
        """The same level with a hundredth of the tolerance, against which its error is measured.

        The order differs too, so that a motion that fits into one step is not compared with itself, and so does the
        start, so that two runs do not make the same roundings.
        """
        if self.is_floor:
            return Level(self.name, self.promise, self.tolerance / 30.0, self.order - 3, not self.aside)
        order = self.order + 4 if self.tolerance > 1e-11 else REFERENCE.order
        # A hundredth of 1e-15 is a little more than 1e-17: the floor would be compared with itself.
        tolerance = self.tolerance * 1e-2 if self.tolerance > 200.0 * FLOOR_TOLERANCE else FLOOR_TOLERANCE
        return Level(self.name, self.promise, tolerance, order, not self.aside)


FLOOR_TOLERANCE = 1e-17

DRAFT = Level("draft", 1e-3, 1e-5, 12)
STANDARD = Level("standard", 1e-6, 1e-8, 16)
PRECISE = Level("precise", 1e-9, 1e-11, 20)
REFERENCE = Level("reference", 1e-12, FLOOR_TOLERANCE, 24)

LEVELS: dict[str, Level] = {each.name: each for each in (DRAFT, STANDARD, PRECISE, REFERENCE)}


Accuracy = Level | str
"""What callers may give for an accuracy: a level, or the name of one; `numerics.arguments.as_level` reads it."""


def level(name: str) -> Level:
    """The level of this name.  Raises `InvalidParameter`, which lists the names.

    >>> from hess_mechanics import level
    >>> level("standard").promise
    1e-06
    """
    try:
        return LEVELS[name]
    except (KeyError, TypeError):
        raise InvalidParameter(f"There is no accuracy level of that name; choose one of {', '.join(LEVELS)}.") from None


def cheapest(error: float) -> Level:
    """The first level that promises this error or less; the last one if none does."""
    return next((each for each in LEVELS.values() if each.promise <= error), REFERENCE)


# ---- kinds of computation ---------------------------------------------------------------------------------------


class Computation(StrEnum):
    """The kinds of computation, each with its own meaning of the levels and of the promise of a `Plan`."""

    ORBIT = "orbit"
    """Promised is the error where the state is O(1)."""
    SECTION = "section"
    """Promised are the crossings right to half a pixel where neighbours part e-fold from one to the next."""
    ROTATION = "rotation number"
    """Promised is the error of the rotation number of a closed curve, in turns."""
    GRID = "grid"
    """Promised is the error of ρ where |trace| is not within 1e-2 of 2, in turns."""
    LINE = "line"
    """Promised is the same as of a grid."""
    COLOURS = "colours"
    """Promised is the same as of a grid; 256 colours tell 4e-3 apart."""
    MAP = "map"
    """Promised is the error of θ⁺, in radians."""
    CURVE = "curve"
    """Promised is the distance from the curve, in pixels, for |a| ≤ 1."""
    BASINS = "basins"
    """Promised is the share of the cells that twice as many along each side change, where the boundary is a curve."""
    INDICATOR = "indicator"
    """Promised is the same as of basins."""
    EXPONENT = "exponent"
    """Promised is the error of λ beside the fastest angular velocity ν, for a time of 2000/ν."""
    CLOUD = "cloud"
    """Promised is the error of ln|s|, of γ, and of ω beside its largest size."""


_CROSSED = Level("draft", 1e-3, 1e-6, 12)


@dataclass(frozen=True)
class Plan:
    """What a level means for a kind of computation.

    Parameters
    ----------
    level : order and tolerance of the Taylor steps, under the name of the level.
    promise : see `Computation`.
    share : of the crossings, of the turns, of the time, of the points asked for, the part that is computed.
    cells : cells along each side of a grid, as a multiple of those at `standard`; phases of a map, orbits on a line,
        tori on one.
    """

    level: Level
    promise: float
    share: float = 1.0
    cells: float = 1.0

    def part(self, count: float, least: int = 1) -> int:
        """How many of `count` crossings or points are computed: at least `least`, if so many are asked for."""
        return max(min(int(count), least), round(self.share * count))

    def side(self, count: int) -> int:
        """The cells along a side that has `count` where `cells` is 1."""
        return max(1, round(self.cells * count))

    def grid(self, sides: tuple[int, int]) -> tuple[int, int]:
        """The cells (m, n) of a grid that has `sides` where `cells` is 1."""
        return self.side(sides[0]), self.side(sides[1])


def _plans(*rows: Plan) -> dict[str, Plan]:
    """The plans by the names of their levels."""
    return {row.level.name: row for row in rows}


_CELLS = _plans(
    Plan(_CROSSED, 0.05, cells=0.5),
    Plan(replace(_CROSSED, name="standard"), 0.03),
    Plan(replace(STANDARD, name="precise"), 0.03),
    Plan(replace(PRECISE, name="reference"), 0.02, cells=1.5),
)
_OF_A_MAP = Plan(STANDARD, 1e-6), Plan(PRECISE, 1e-9), Plan(REFERENCE, 1e-11)

PLANS: Mapping[Computation, Mapping[str, Plan]] = {
    Computation.ORBIT: _plans(*(Plan(each, each.promise) for each in LEVELS.values())),
    # A tolerance above 1e-6 loses crossings.
    Computation.SECTION: _plans(
        Plan(_CROSSED, 5, share=0.25), Plan(STANDARD, 9), Plan(PRECISE, 13), Plan(REFERENCE, 22)
    ),
    Computation.ROTATION: _plans(
        Plan(_CROSSED, 1e-3, 0.3, 0.5), *(Plan(each, 1e-4) for each in (STANDARD, PRECISE, REFERENCE))
    ),
    Computation.GRID: _plans(Plan(DRAFT, 1e-3, cells=0.5), *_OF_A_MAP),
    # Turns of a perturbed map take the time, whatever the accuracy of the map.
    Computation.LINE: _plans(Plan(DRAFT, 1e-3, 0.15, 0.2), *_OF_A_MAP),
    Computation.COLOURS: _plans(
        Plan(DRAFT, 1e-3, cells=0.5),
        Plan(replace(DRAFT, name="standard"), 1e-3),
        Plan(replace(STANDARD, name="precise"), 1e-6),
        Plan(replace(PRECISE, name="reference"), 1e-9, cells=1.5),
    ),
    Computation.MAP: _plans(Plan(DRAFT, 1e-3, cells=0.4), *_OF_A_MAP),
    Computation.CURVE: _plans(
        Plan(DRAFT, 0.75, cells=0.5), Plan(STANDARD, 0.25), Plan(PRECISE, 0.25), Plan(REFERENCE, 0.1, cells=2.0)
    ),
    # To which attractor an orbit comes, and whether it is chaotic, needs no digits: more cells tell more.
    Computation.BASINS: _CELLS,
    Computation.INDICATOR: _CELLS,
    # The neighbour is 1e-7 away, and steps must be exact beside that; the time decides how well λ is known.
    Computation.EXPONENT: _plans(
        Plan(replace(DRAFT, tolerance=1e-10, order=16), 0.05, share=0.2),
        Plan(replace(STANDARD, tolerance=1e-14, order=24), 0.02),
        Plan(replace(PRECISE, tolerance=1e-15, order=24), 0.02),
        Plan(REFERENCE, 0.02),
    ),
    Computation.CLOUD: _plans(
        Plan(DRAFT, 1e-3, share=0.15), Plan(STANDARD, 1e-6), Plan(PRECISE, 1e-9), Plan(REFERENCE, 1e-12)
    ),
}


def plan(kind: Computation, accuracy: Accuracy) -> Plan:
    """What a level means for a kind of computation, all of it at a level that is none of the four.

    Raises `InvalidParameter`.
    """
    if isinstance(accuracy, Level) and LEVELS.get(accuracy.name) != accuracy:
        return Plan(accuracy, accuracy.promise)
    return PLANS[kind][accuracy.name if isinstance(accuracy, Level) else level(accuracy).name]
