"""Orbit diagrams of the Suslov problem over a parameter of the body or its energy above the bottom, h = E + |b|.

Along a component of b it is h that stays, as where motions begin to be possible moves with |b|.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hess_mechanics.dynamics.orbit_diagram import Cascade, Diagram, cascade, orbit_diagram
from hess_mechanics.dynamics.periodic import find_periodic
from hess_mechanics.dynamics.regime import Dynamics, Regime, compared, regime
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.errors import InvalidParameter, ModelError, WorkLimit
from hess_mechanics.numerics.accuracy import PRECISE, Level
from hess_mechanics.numerics.results import Array, frozen
from hess_mechanics.suslov.section import SuslovSection

__all__ = ["AtState", "Sets", "at_state", "diagram", "doublings", "moved", "sets_of"]

Place = tuple[float, ...]


def moved(section: SuslovSection, name: str, value: float) -> SuslovSection:
    """The section with another value of h, or of a parameter of the body at the same h.  Raises as the body."""
    b = section.body
    h = section.E + math.hypot(b.b1, b.b2, b.b3)
    if name == "h":
        return replace(section, E=section.E + value - h)
    b = replace(b, **{name: value})
    return replace(section, body=b, E=h - math.hypot(b.b1, b.b2, b.b3))


def diagram(section: SuslovSection, name: str, values: tuple[float, ...], start: Place, again: Place, transient: int,
            kept: int, follow: bool, backward: bool, level: Level) -> Diagram:
    """`orbit_diagram` of the section along a parameter."""
    return orbit_diagram(lambda value: ReturnMap(moved(section, name, value), level, backward), name, values, start,
                         transient, kept, follow, again)


def doublings(section: SuslovSection, name: str, at: float, places: tuple[Place, ...], end: float, most: int
              ) -> Cascade | str:
    """The cascade of the orbit with these places at a value of the parameter, towards another; or why there is none."""
    map_ = ReturnMap(section, PRECISE)

    def family(value: float) -> ReturnMap:
        return replace(map_, sheet=moved(section, name, value))

    try:
        return cascade(family, name, find_periodic(family(at), np.array(places), len(places)), at, end, most)
    except WorkLimit:
        raise
    except ModelError as error:
        return str(error)


@dataclass(frozen=True)
class Sets:
    """Where an orbit is after its transient (n, d), forward and backward in time, empty where it does not come back."""

    attractor: Array
    repeller: Array


def sets_of(section: SuslovSection, start: Place, transient: int, kept: int, level: Level) -> Sets:
    """Of the orbit from a place.  Raises `OutsideRegion`, `WorkLimit`."""
    found = (ReturnMap(section, level, backward).orbit(np.array(start), transient + kept)[transient:]
             for backward in (False, True))
    return Sets(*(frozen(one.copy()) for one in found))


@dataclass(frozen=True)
class AtState:
    """What kind of motion this is, and of what kind the dynamics are; None where that cannot be told."""

    regime: Regime
    dynamics: Dynamics | None


def at_state(section: SuslovSection, start: Place, sets: Sets, transient: int, kept: int, t: float, level: Level
             ) -> AtState:
    """Of the orbit from a place, whose `sets_of` are known; t : the time of the averages.

    Raises `OutsideRegion`, `WorkLimit`.
    """
    map_ = ReturnMap(section, level)
    found = regime(map_, start, transient, min(kept, 400), t)
    if min(len(sets.attractor), len(sets.repeller)) < kept:
        return AtState(found, None)
    try:
        return AtState(found, compared(map_, sets.attractor, sets.repeller, t))
    except InvalidParameter:
        raise
    except ModelError:
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
