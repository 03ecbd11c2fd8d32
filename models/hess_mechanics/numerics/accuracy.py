"""Accuracy levels: four names, and their meaning for each kind of computation.

A Taylor series gains digits by its order, so an orbit costs about the same at every level: `reference` takes at most
two or three times as long as `draft`.  `draft` is cheaper where it also computes less: fewer crossings, a shorter time
or a coarser grid.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from enum import StrEnum

from hess_mechanics.errors import InvalidParameter

__all__ = [
    "DRAFT",
    "LEVELS",
    "MEANINGS",
    "PLANS",
    "PRECISE",
    "REFERENCE",
    "STANDARD",
    "Accuracy",
    "Kind",
    "Level",
    "Meaning",
    "Plan",
    "Status",
    "cheapest",
    "level",
    "levels_table",
    "plan",
]


_OTHER_STEP = 0.618
"""Ratio of the longest steps of two runs that are compared."""


class Status(StrEnum):
    """Outcome of a computation.

    `OK`: the error estimate is within the promise of the level.  `FLOOR`: it is not, at the floor of double precision.
    `PROMISE_NOT_MET`: it is not, at any other level.  `INCOMPLETE`: a motion ended before the last time.
    """

    OK = "ok"
    FLOOR = "double-precision floor"
    PROMISE_NOT_MET = "promise not met"
    INCOMPLETE = "incomplete"


@dataclass(frozen=True)
class Level:
    """An accuracy level.

    Parameters
    ----------
    name : str
        Name of the level.
    promise : float
        Largest global error of a result, positive, in units in which the state is O(1).  For `reference` it is nominal:
        this level goes down to the floor of double precision, which depends on the motion.
    tolerance : float
        Local error of a Taylor step in the first run, positive, in the same units.
    order : int
        Order of the Taylor series, at least 2.
    is_perturbed : bool, default False
        Start a few units in the last place beside the given state, see `measured.perturb`.
    """

    name: str
    promise: float
    tolerance: float
    order: int
    is_perturbed: bool = False

    @property
    def is_floor(self) -> bool:
        """True for the last level, whose error is round-off instead of truncation."""
        return self.tolerance <= FLOOR_TOLERANCE

    def status(self, error: float) -> Status:
        """Return the status of a result with a given error.

        Parameters
        ----------
        error : float
            Estimated error, in the units of the promise.

        Returns
        -------
        Status
            The status.
        """
        if error <= self.promise:
            return Status.OK
        return Status.FLOOR if self.is_floor else Status.PROMISE_NOT_MET

    def longest_step(self, limit: float) -> float:
        """Return the longest step of a run, at most a limit.

        Two runs that are compared take different steps, even if one step is enough for each.

        Parameters
        ----------
        limit : float
            The limit, for example the duration of the motion, of either sign and in any unit of time.

        Returns
        -------
        float
            The longest step, ≥ 0, in the unit of the limit.
        """
        return abs(limit) * (_OTHER_STEP if self.is_perturbed else 1.0)

    def tighter(self) -> Level:
        """Return the same level with about a hundredth of the tolerance, to measure the error of this level.

        The tolerance stops at the floor of double precision; for a level at the floor it is a thirtieth.  The order
        differs too, so that a motion that fits into one step is not compared with itself; and so does the start, so
        that the two runs do not make the same roundings.

        Returns
        -------
        Level
            The more accurate level.
        """
        if self.is_floor:
            return Level(self.name, self.promise, self.tolerance / 30.0, self.order - 3, not self.is_perturbed)
        order = self.order + 4 if self.tolerance > 1e-11 else REFERENCE.order
        # The factor is 200 instead of 100, because 1e-15 · 1e-2 rounds to more than 1e-17: the floor would be compared
        # with itself.
        tolerance = self.tolerance * 1e-2 if self.tolerance > 200.0 * FLOOR_TOLERANCE else FLOOR_TOLERANCE
        return Level(self.name, self.promise, tolerance, order, not self.is_perturbed)

    def variant(self) -> Level:
        """Return an equally accurate level whose runs round differently.

        Returns
        -------
        Level
            The level with another order.
        """
        return replace(self, order=self.order - 2)


FLOOR_TOLERANCE = 1e-17

DRAFT = Level("draft", 1e-3, 1e-5, 12)
STANDARD = Level("standard", 1e-6, 1e-8, 16)
PRECISE = Level("precise", 1e-9, 1e-11, 20)
REFERENCE = Level("reference", 1e-12, FLOOR_TOLERANCE, 24)

LEVELS: dict[str, Level] = {each.name: each for each in (DRAFT, STANDARD, PRECISE, REFERENCE)}


Accuracy = Level | str
"""An accuracy as an argument: a level or its name; `numerics.arguments.as_level` converts it."""


def level(name: str) -> Level:
    """Return the accuracy level with a given name.

    Parameters
    ----------
    name : {"draft", "standard", "precise", "reference"}
        Name of the level.

    Returns
    -------
    Level
        The level.

    Raises
    ------
    InvalidParameter
        If there is no such level; the message lists the names.

    Examples
    --------
    >>> from hess_mechanics import level
    >>> level("standard").promise
    1e-06
    """
    try:
        return LEVELS[name]
    except (KeyError, TypeError):
        raise InvalidParameter(f"There is no accuracy level {name!s:.20}: choose one of {', '.join(LEVELS)}.") from None


def cheapest(error: float) -> Level:
    """Return the first level that promises a given error or less.

    Parameters
    ----------
    error : float
        Largest error, in units in which the state is O(1).

    Returns
    -------
    Level
        The level; the last one if none promises this.
    """
    return next((each for each in LEVELS.values() if each.promise <= error), REFERENCE)


# ---- kinds of computation ---------------------------------------------------------------------------------------


class Kind(StrEnum):
    """Kinds of computation; each kind has its own meaning of the levels, see `MEANINGS`."""

    ORBIT = "orbit"
    SECTION = "section"
    ROTATION = "rotation number"
    GRID = "grid"
    LINE = "line"
    COLOURS = "colours"
    MAP = "map"
    CURVE = "curve"
    BASINS = "basins"
    INDICATOR = "indicator"
    EXPONENT = "exponent"
    CLOUD = "cloud"


@dataclass(frozen=True)
class Meaning:
    """Words for the numbers of the plans of one kind.

    Attributes
    ----------
    promise : str
        Quantity that `Plan.promise` limits or counts; empty if more cells, not more digits, make the result better.
    share, cells : str, default ""
        Quantities that `Plan.share` and `Plan.cells` scale; empty if each level computes all.
    """

    promise: str
    share: str = ""
    cells: str = ""


MEANINGS: Mapping[Kind, Meaning] = {
    Kind.ORBIT: Meaning("error, in units in which the state is O(1)"),
    Kind.SECTION: Meaning(
        "crossings right to half a pixel if neighbours part e-fold from one to the next", "crossings"
    ),
    Kind.ROTATION: Meaning("error of the rotation number of a closed curve, in turns", "crossings", "orbits"),
    Kind.GRID: Meaning("error of ρ, in turns, if |trace| is not within 1e-2 of 2", "", "cells along a side"),
    Kind.LINE: Meaning("as for a grid", "turns", "points"),
    Kind.COLOURS: Meaning("as for a grid; 256 colours resolve 4e-3", "", "cells along a side"),
    Kind.MAP: Meaning("error of θ⁺, in radians", "", "phases"),
    Kind.CURVE: Meaning("distance from the curve, in pixels, for |a| ≤ 1", "", "tori"),
    Kind.BASINS: Meaning("", "", "cells along a side"),
    Kind.INDICATOR: Meaning("", "", "cells along a side"),
    Kind.EXPONENT: Meaning("error of λ relative to the fastest angular velocity ν, for a time of 2000/ν", "time"),
    Kind.CLOUD: Meaning("error of ln|s|, of γ, and of ω relative to its largest size", "points"),
}


_CROSSED = Level("draft", 1e-3, 1e-6, 12)


@dataclass(frozen=True)
class Plan:
    """Meaning of an accuracy level for one kind of computation.

    Parameters
    ----------
    level : Level
        Order and tolerance of the Taylor steps, under the name of the level.
    promise : float
        Promised largest error, or for sections the number of crossings, positive, see `MEANINGS`; without a meaning
        there for basins and indicators.
    share : float, default 1
        Fraction of the requested crossings, turns, time or points that is computed, positive; see `MEANINGS`.
    cells : float, default 1
        Number of cells along each side of a grid relative to `standard`, positive; likewise phases of a map, orbits or
        tori on a line.
    """

    level: Level
    promise: float
    share: float = 1.0
    cells: float = 1.0

    def part(self, count: float, least: int = 1) -> int:
        """Return the number of crossings or points to compute.

        Parameters
        ----------
        count : float
            Requested number.
        least : int, default 1
            Smallest number, unless fewer are requested.

        Returns
        -------
        int
            The number.
        """
        return max(min(int(count), least), round(self.share * count))

    def side(self, count: int) -> int:
        """Return the number of cells along a side.

        Parameters
        ----------
        count : int
            Number of cells at `standard`.

        Returns
        -------
        int
            The number, at least 1.
        """
        return max(1, round(self.cells * count))

    def grid(self, sides: tuple[int, int]) -> tuple[int, int]:
        """Return the numbers of cells of a grid.

        Parameters
        ----------
        sides : (int, int)
            Numbers (m, n) of cells at `standard`.

        Returns
        -------
        (int, int)
            The numbers (m, n).
        """
        return self.side(sides[0]), self.side(sides[1])


def _plans(*rows: Plan) -> dict[str, Plan]:
    """Return the plans by the names of their levels."""
    return {row.level.name: row for row in rows}


_CELLS = _plans(
    Plan(_CROSSED, 0.05, cells=0.5),
    Plan(replace(_CROSSED, name="standard"), 0.03),
    Plan(replace(STANDARD, name="precise"), 0.03),
    Plan(replace(PRECISE, name="reference"), 0.02, cells=1.5),
)
_OF_A_MAP = Plan(STANDARD, 1e-6), Plan(PRECISE, 1e-9), Plan(REFERENCE, 1e-11)

PLANS: Mapping[Kind, Mapping[str, Plan]] = {
    Kind.ORBIT: _plans(*(Plan(each, each.promise) for each in LEVELS.values())),
    # A tolerance above 1e-6 loses crossings.
    Kind.SECTION: _plans(Plan(_CROSSED, 5, share=0.25), Plan(STANDARD, 9), Plan(PRECISE, 13), Plan(REFERENCE, 22)),
    Kind.ROTATION: _plans(
        Plan(_CROSSED, 1e-3, 0.3, 0.5), *(Plan(each, 1e-4) for each in (STANDARD, PRECISE, REFERENCE))
    ),
    Kind.GRID: _plans(Plan(DRAFT, 1e-3, cells=0.5), *_OF_A_MAP),
    # The turns of a perturbed map dominate the time, whatever the accuracy of the map.
    Kind.LINE: _plans(Plan(DRAFT, 1e-3, 0.15, 0.2), *_OF_A_MAP),
    Kind.COLOURS: _plans(
        Plan(DRAFT, 1e-3, cells=0.5),
        Plan(replace(DRAFT, name="standard"), 1e-3),
        Plan(replace(STANDARD, name="precise"), 1e-6),
        Plan(replace(PRECISE, name="reference"), 1e-9, cells=1.5),
    ),
    Kind.MAP: _plans(Plan(DRAFT, 1e-3, cells=0.4), *_OF_A_MAP),
    Kind.CURVE: _plans(
        Plan(DRAFT, 0.75, cells=0.5), Plan(STANDARD, 0.25), Plan(PRECISE, 0.25), Plan(REFERENCE, 0.1, cells=2.0)
    ),
    # Classifying an orbit needs few digits, whereas more cells show more detail.
    Kind.BASINS: _CELLS,
    Kind.INDICATOR: _CELLS,
    # The averaging time limits the accuracy of λ.
    Kind.EXPONENT: _plans(
        Plan(replace(DRAFT, tolerance=1e-10, order=16), 0.05, share=0.2),
        Plan(replace(STANDARD, tolerance=1e-14, order=24), 0.02),
        Plan(replace(PRECISE, tolerance=1e-15, order=24), 0.02),
        Plan(REFERENCE, 0.02),
    ),
    Kind.CLOUD: _plans(
        Plan(DRAFT, 1e-3, share=0.15), Plan(STANDARD, 1e-6), Plan(PRECISE, 1e-9), Plan(REFERENCE, 1e-12)
    ),
}


def plan(kind: Kind, accuracy: Accuracy) -> Plan:
    """Return the meaning of a level for a kind of computation.

    Parameters
    ----------
    kind : Kind
        Kind of computation.
    accuracy : str or Level
        Level or its name; a level that is not one of the four is used as it is.

    Returns
    -------
    Plan
        The plan.

    Raises
    ------
    InvalidParameter
        If there is no level of this name.
    """
    if isinstance(accuracy, Level) and LEVELS.get(accuracy.name) != accuracy:
        return Plan(accuracy, accuracy.promise)
    return PLANS[kind][accuracy.name if isinstance(accuracy, Level) else level(accuracy).name]


def levels_table() -> tuple[tuple[str, ...], ...]:
    """Return the table of the promises and settings of the levels, with a row for each kind of computation.

    Returns
    -------
    tuple of tuple of str
        The head, then for each kind its name, a cell for each level, and the quantity that is promised.  A level with
        the same numbers as an earlier one refers to that one.

    Examples
    --------
    >>> from hess_mechanics.numerics.accuracy import levels_table
    >>> levels_table()[2][:3]
    ('section', '5, 25 % of the crossings', '9')
    """
    return ("computation", *LEVELS, "promised"), *(
        (kind, *_cells(kind), MEANINGS[kind].promise or "nothing: more cells show more") for kind in Kind
    )


def _cells(kind: Kind) -> Iterator[str]:
    """Yield the meaning of each level for a kind."""
    meaning = MEANINGS[kind]
    shown: dict[tuple[float, float, float], str] = {}
    for each in PLANS[kind].values():
        before = shown.setdefault((each.promise, each.share, each.cells), each.level.name)
        if before != each.level.name:
            yield f"as {before}"
            continue
        if kind is Kind.ORBIT and each.level.is_floor:
            yield "round-off, which may exceed the error of precise"
            continue
        parts = ((each.share, meaning.share), (each.cells, meaning.cells))
        some = [f"{100.0 * part:.0f} % of the {what}" for part, what in parts if part != 1.0]
        yield ", ".join(([f"{each.promise:g}"] if meaning.promise else []) + some) or f"all {meaning.cells}"
