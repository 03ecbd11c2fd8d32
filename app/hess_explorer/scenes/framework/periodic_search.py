"""What is computed of a periodic orbit behind an answer, each a piece of its own: the orbit, its manifolds, where they
cross."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace

from hess_explorer.compute.cache import CACHE
from hess_mechanics.dynamics.manifolds import Intersection, Manifold, crossings_of, grown
from hess_mechanics.dynamics.periodic import PeriodicOrbit, find_periodic
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.patience import go_on

__all__ = [
    "ANY",
    "AT_ITS_LENGTH",
    "MOST_CROSSINGS",
    "MOST_POINTS",
    "NONE",
    "PERIODS",
    "BranchChoice",
    "Closed",
    "Missed",
    "Place",
    "Search",
    "branch_of",
    "crossings_between",
    "none_closed",
    "sought",
]

Place = tuple[float, ...]
Search = tuple[ReturnMap, Place, int | None, bool]
"""The map, where it is begun, the period where one is given, and whether that is all that is tried."""
BranchChoice = tuple[int, bool, int]
"""Of a manifold: from which of the places of the orbit, whether stable, which side."""

NONE, ANY = "none", "any period"
_MOST = 12
PERIODS: Mapping[str, int | None] = {ANY: None, **{f"period {m}": m for m in range(1, _MOST + 1)}}
MOST_POINTS, _RETURNS = 2000, 20_000
"""Of each branch, at most: returns of the map, for all of its points together."""
MOST_CROSSINGS = 25
"""Of two branches."""
_SAGITTA, _CHORD = 0.25, 10.0
"""Of the curves drawn, in pixels."""
_PARTS = (1.0, 0.5, 0.25)
"""Of the length wanted, where the whole is not known to half a pixel."""
AT_ITS_LENGTH = "At its length."
_UNKNOWN = "What follows is not known to half a pixel: a more exact level may show it."


@dataclass(frozen=True)
class Closed:
    """A periodic orbit, the state at its first place, and the time after which it closes."""

    orbit: PeriodicOrbit
    state: tuple[float, ...]
    time: float


@dataclass(frozen=True)
class Missed:
    """Why none was found."""

    reason: str


def none_closed() -> Closed | None:
    """Return None: no periodic orbit is shown in place of the chosen one."""
    return None


def sought(map_: ReturnMap, aim: Place, period: int | None, near: bool) -> Closed | Missed:
    """The periodic orbit."""
    try:
        orbit = find_periodic(map_, aim, period, _MOST, near)
        first = orbit.places[0]
        return Closed(
            replace(orbit, symmetric=tuple(map_.symmetries_of(orbit.places))),
            tuple(map(float, map_.state_at(first))),
            map_.time_of(first, orbit.period),
        )
    except ModelError as error:
        # Where time is up nothing is known of the orbit.
        go_on()
        return Missed(str(error))


def branch_of(search: Search, branch: BranchChoice, length: float, pixel: float) -> Manifold | Missed:
    """One branch of a manifold, as far as it is right to half a pixel."""
    found, _ = CACHE.get(sought, *search)
    place, stable, side = branch
    for part in _PARTS:
        try:
            curve = grown(
                search[0],
                found.orbit,
                part * length,
                stable,
                side,
                place,
                _SAGITTA * pixel,
                _CHORD * pixel,
                MOST_POINTS,
                _RETURNS,
            )
        except ModelError as error:
            go_on()
            return Missed(str(error))
        if curve.error_estimate < 0.5 * pixel:
            return curve if part == _PARTS[0] else replace(curve, ended=_UNKNOWN)
    return Missed(_UNKNOWN)


def crossings_between(
    search: Search, unstable: BranchChoice, stable: BranchChoice, length: float, pixel: float
) -> tuple[Intersection, ...]:
    """Where two branches cross, as far as they are drawn."""
    one, other = (CACHE.get(branch_of, search, branch, length, pixel)[0] for branch in (unstable, stable))
    if isinstance(one, Missed) or isinstance(other, Missed):
        return ()
    return tuple(crossings_of(one, other, MOST_CROSSINGS))
