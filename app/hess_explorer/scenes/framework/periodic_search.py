"""Background computations for a periodic orbit: the orbit, its manifolds and their crossings."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, replace
from typing import Protocol

from hess_explorer.compute.cache import Task
from hess_mechanics.dynamics.manifolds import Intersection, Manifold, crossings_of, manifold
from hess_mechanics.dynamics.periodic import PeriodicOrbit, find_periodic
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.patience import check_limit

Point = tuple[float, ...]
Search = tuple[ReturnMap, Point, int | None, bool]
"""The map, the starting point, the period if one is given, and whether to search near that point only."""
BranchChoice = tuple[int, bool, int]
"""A branch of a manifold: index of the point of the orbit, True if stable, side ±1."""

NONE, ANY = "none", "any period"
_MOST = 12
PERIODS: Mapping[str, int | None] = {ANY: None, **{f"period {m}": m for m in range(1, _MOST + 1)}}
MAX_POINTS, _RETURNS = 2000, 20_000
"""Largest numbers of points of a branch, and of returns of the map for all its points together."""
MAX_CROSSINGS = 25
"""Largest number of crossings of two branches."""
_SAGITTA, _CHORD = 0.25, 10.0
"""Largest sagitta and chord of the drawn curves, in pixels."""
_PARTS = (1.0, 0.5, 0.25)
"""Shares of the requested length, tried in order until the branch is right to half a pixel."""
LENGTH_REACHED = "At its length."
_UNKNOWN = "What follows is not known to half a pixel: a higher accuracy may show it."


@dataclass(frozen=True)
class ClosedOrbit:
    """A periodic orbit of a section.

    Attributes
    ----------
    orbit : PeriodicOrbit
        The orbit of the return map.
    state : tuple of float
        State (d,) at its first point.
    time : float
        Time of one period; negative for a map backward in time.
    """

    orbit: PeriodicOrbit
    state: tuple[float, ...]
    time: float


@dataclass(frozen=True)
class NotFound:
    """The reason why there is no result.

    Attributes
    ----------
    reason : str
        A sentence for the user.
    """

    reason: str


class Periodic(Protocol):
    """The periodic orbit shown in place of the chosen orbit."""

    @property
    def closed_orbit(self) -> ClosedOrbit | None:
        """The orbit; None if none is requested or known."""

    @property
    def is_searching(self) -> bool:
        """True while the requested orbit is being searched for; False after a search without result, too."""

    @property
    def growth(self) -> tuple[float, float] | None:
        """Growth rate ln|μ₁|/T and mean divergence ln|μ₁μ₂|/T of the orbit; None until it is known."""


@dataclass(frozen=True)
class NotPeriodic:
    """Placeholder for `Periodic` in scenes that do not search for periodic orbits.

    Attributes
    ----------
    is_searching : bool
        True while the exponent has to wait, for example for a compilation.
    closed_orbit, growth : None
        There is no periodic orbit.
    """

    is_searching: bool = False
    closed_orbit: ClosedOrbit | None = None
    growth: tuple[float, float] | None = None


def find_orbit(map_: ReturnMap, aim: Point, period: int | None, near: bool) -> ClosedOrbit | NotFound:
    """Search for a periodic orbit near a point; return the orbit, or the reason why none was found.

    Parameters
    ----------
    map_ : ReturnMap
        The map.
    aim : tuple of float
        Coordinates of the point in the section.
    period : int or None
        Least period; None for the best one up to 12.
    near : bool
        True to search only from the point itself, not from later points of its orbit.
    """
    try:
        orbit = find_periodic(map_, aim, period, _MOST, near)
        first = orbit.points[0]
        return ClosedOrbit(
            replace(orbit, symmetric=tuple(map_.symmetries_of(orbit.points))),
            tuple(map(float, map_.state_at(first))),
            map_.time_of(first, orbit.period),
        )
    except ModelError as error:
        # Raise if the request was cancelled or is over its budget, so that no result is cached.
        check_limit()
        return NotFound(str(error))


def branch_of(search: Search, branch: BranchChoice, length: float, pixel: float) -> Manifold | NotFound:
    """Return one branch of a manifold, cut to 1, ½ or ¼ of its length so that its error stays below half a pixel.

    Parameters
    ----------
    search : Search
        Arguments of `find_orbit`, which must have found an orbit.
    branch : BranchChoice
        The branch.
    length : float
        Requested length, in units of the coordinates.
    pixel : float
        Size of a pixel, in the same units.

    Returns
    -------
    Manifold or NotFound
        The branch, or the reason why there is none: the orbit is not a saddle, or even ¼ is not accurate enough.
    """
    found = Task(find_orbit, *search).get()
    assert isinstance(found, ClosedOrbit), "only a closed orbit has branches"
    index, stable, side = branch
    for part in _PARTS:
        try:
            curve = manifold(
                search[0],
                found.orbit,
                part * length,
                stable=stable,
                side=side,
                index=index,
                sagitta=_SAGITTA * pixel,
                longest=_CHORD * pixel,
                most=MAX_POINTS,
                returns=_RETURNS,
            )
        except ModelError as error:
            check_limit()
            return NotFound(str(error))
        if curve.error_estimate < 0.5 * pixel:
            return curve if part == _PARTS[0] else replace(curve, end_reason=_UNKNOWN)
    return NotFound(_UNKNOWN)


def crossings_between(
    search: Search, unstable: BranchChoice, stable: BranchChoice, length: float, pixel: float
) -> tuple[Intersection, ...]:
    """Return up to 25 crossings of the drawn parts of two branches; empty if either branch cannot be drawn.

    Parameters
    ----------
    search, length, pixel
        As in `branch_of`.
    unstable, stable : BranchChoice
        The branches.
    """
    one, other = (Task(branch_of, search, branch, length, pixel).get() for branch in (unstable, stable))
    if isinstance(one, NotFound) or isinstance(other, NotFound):
        return ()
    return tuple(crossings_of(one, other, MAX_CROSSINGS))
