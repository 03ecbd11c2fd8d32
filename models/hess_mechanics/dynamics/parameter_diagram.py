"""Orbit diagrams of a section over a parameter, with their doublings, and what there is at one value of it.

A family gives the section at each value: what stays beside the parameter, an energy or its height above the lowest, is
for the family to say.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.orbit_diagram import Cascade, Diagram, cascade, diagram_over
from hess_mechanics.dynamics.periodic import find_periodic
from hess_mechanics.dynamics.regime import Dynamics, Regime, compared, regime
from hess_mechanics.dynamics.return_map import PoincareSection, ReturnMap
from hess_mechanics.errors import ModelError, NoReturn, WorkLimit
from hess_mechanics.numerics.accuracy import PRECISE, Accuracy
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.results import Array, frozen

__all__ = ["AtState", "Sets", "at_state", "diagram", "doublings", "nearest_place", "sets_of"]

Place = tuple[float, ...]
SectionFamily = Callable[[float], PoincareSection]


def diagram(
    family: SectionFamily,
    name: str,
    values: tuple[float, ...],
    start: Place,
    again: Place,
    transient: int,
    kept: int,
    follow: bool,
    backward: bool,
    level: Accuracy,
) -> Diagram:
    """`orbit_diagram` of the sections of a family."""
    level = as_level(level)
    return diagram_over(
        lambda value: ReturnMap(family(value), level, backward), name, values, start, transient, kept, follow, again
    )


def doublings(
    family: SectionFamily, name: str, at: float, places: tuple[Place, ...], end: float, most: int
) -> Cascade | str:
    """The cascade of the orbit with these places at a value of the parameter, towards another; or why there is none."""

    def map_at(value: float) -> ReturnMap:
        return ReturnMap(family(value), PRECISE)

    try:
        return cascade(map_at, name, find_periodic(map_at(at), np.array(places), len(places)), at, end, most)
    except WorkLimit:
        raise
    except ModelError as error:
        return str(error)


@dataclass(frozen=True)
class Sets:
    """Where an orbit is after its transient (n, d), forward and backward in time, empty where it does not come back."""

    attractor: Array
    repeller: Array


def sets_of(section: PoincareSection, start: Place, transient: int, kept: int, level: Accuracy) -> Sets:
    """Of the orbit from a place.  Raises `OutsideRegion`, `WorkLimit`."""
    level = as_level(level)
    found = (
        ReturnMap(section, level, backward).orbit(np.array(start), transient + kept)[transient:]
        for backward in (False, True)
    )
    return Sets(*(frozen(one.copy()) for one in found))


@dataclass(frozen=True)
class AtState:
    """The kind of a motion, and of the dynamics about it; None where an orbit is not seen to come back."""

    regime: Regime
    dynamics: Dynamics | None


def at_state(section: PoincareSection, start: Place, transient: int, kept: int, t: float, level: Accuracy) -> AtState:
    """Return both for the orbit from a place; t : the time of the averages.

    Raises `OutsideRegion`, `WorkLimit`.
    """
    level = as_level(level)
    map_ = ReturnMap(section, level)
    found = regime(map_, start, transient, min(kept, 400), t)
    try:
        return AtState(found, compared(map_, found, start, transient, kept))
    except NoReturn:
        return AtState(found, None)


def nearest_place(diagrams: Sequence[Diagram], i: int, value: float, y: float) -> tuple[float, Place] | None:
    """Of the places over the value nearest to `value` that whose coordinate i is nearest to y; None if none is."""
    found: list[tuple[float, float, float, Place]] = []
    for one in diagrams:
        there = [k for k in range(len(one.values)) if len(one.places[k])]
        if there:
            k = min(there, key=lambda k: abs(one.values[k] - value))
            place = one.places[k][np.argmin(np.abs(one.places[k][:, i] - y))]
            at = float(one.values[k])
            # Diagrams of one range have the same values but for round-off.
            found.append((round(abs(at - value), 12), abs(float(place[i]) - y), at, tuple(map(float, place))))
    return min(found)[2:] if found else None
