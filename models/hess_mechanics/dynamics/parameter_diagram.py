"""Orbit diagrams of a section over a parameter, period doublings, and the dynamics at one value of it.

A family gives the section at each value of the parameter; it also decides what is held fixed, for example the energy
or its height above the minimum.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.orbit_diagram import Cascade, Diagram, cascade, diagram_over
from hess_mechanics.dynamics.periodic import find_periodic
from hess_mechanics.dynamics.regime import Dynamics, compared, regime
from hess_mechanics.dynamics.return_map import PoincareSection, ReturnMap
from hess_mechanics.errors import ModelError, NoReturn, WorkLimit
from hess_mechanics.numerics.accuracy import PRECISE, Accuracy
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.results import Array, frozen

__all__ = ["Sets", "at_state", "diagram", "doublings", "nearest_place", "sets_of"]

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
    accuracy: Accuracy,
) -> Diagram:
    """Return the orbit diagram of the sections of a family; parameters as in `orbit_diagram`."""
    level = as_level(accuracy)
    return diagram_over(
        lambda value: ReturnMap(family(value), level, backward), name, values, start, transient, kept, follow, again
    )


def doublings(
    family: SectionFamily, name: str, at: float, places: tuple[Place, ...], end: float, most: int
) -> Cascade | str:
    """Return the period-doubling cascade of a periodic orbit, or the reason why there is none.

    places : points of the orbit on the section at the value `at` of the parameter; end : last value followed.
    """

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
    """Points (n, d) of an orbit after its transient, forward and backward in time; empty if it does not return."""

    attractor: Array
    repeller: Array


def sets_of(section: PoincareSection, start: Place, transient: int, kept: int, accuracy: Accuracy) -> Sets:
    """Return the attractor and repeller that the orbit from `start` reaches.  Raises `OutsideRegion`, `WorkLimit`."""
    level = as_level(accuracy)
    found = (
        ReturnMap(section, level, backward).orbit(np.array(start), transient + kept)[transient:]
        for backward in (False, True)
    )
    return Sets(*(frozen(one.copy()) for one in found))


def at_state(
    section: PoincareSection, start: Place, transient: int, kept: int, duration: float, accuracy: Accuracy
) -> Dynamics:
    """Classify the orbit from `start`; without comparisons if it does not return.  Raises `OutsideRegion`, `WorkLimit`.

    duration : averaging time.
    """
    map_ = ReturnMap(section, as_level(accuracy))
    motion = regime(map_, start, transient, min(kept, 400), duration)
    try:
        return compared(map_, motion, start, transient, kept)
    except NoReturn:
        return Dynamics(motion, motion.places[:0], motion.places[:0], ())


def nearest_place(diagrams: Sequence[Diagram], i: int, value: float, y: float) -> tuple[float, Place] | None:
    """Return the value nearest to `value` that has points, and its point with coordinate i nearest to y; or None."""
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
