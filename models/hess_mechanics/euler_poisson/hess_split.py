"""Split of the separatrices of the Hess manifold: they are one curve in the Hess case, and two curves outside it.

If the torus of the Hess manifold at H = h, F1 = f has two limit cycles, both are saddles of the section: one repels
along the manifold, the other attracts along it.  In the Hess case the unstable manifold of the first and the stable
manifold of the second are the Hess curve x = x(l) between them.  If r is rotated by an angle ε, they differ in their
heights x = L/G at the l half-way between the two saddles of the Hess case: this difference is the split.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hess_mechanics.dynamics.manifolds import Manifold, manifold, split
from hess_mechanics.dynamics.periodic import difference, find_periodic
from hess_mechanics.dynamics.return_map import ReturnMap, section_crossings
from hess_mechanics.errors import NotConverged, OutsideRegion
from hess_mechanics.euler_poisson.andoyer import AndoyerSection, hess_curve
from hess_mechanics.euler_poisson.equations import HeavyBody
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge
from hess_mechanics.numerics.accuracy import REFERENCE, Accuracy
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.results import Array, as_read_only
from hess_mechanics.suslov_hess.bifurcation import turning_points
from hess_mechanics.suslov_hess.circle_map import circle_map

__all__ = ["HessTorus", "Saddles", "Split", "saddles", "slope_of", "split_at"]

_SAGITTA, _CHORD = 3e-3, 0.3
"""Resolution of the manifolds; their points are refined where they are compared."""
_ROOM = 0.3
"""Length of a manifold beyond that of the Hess curve to the point of comparison."""
_ELSEWHERE = 0.3
"""Largest distance of an orbit from its saddle in the Hess case; beyond it the orbit is a different one."""


@dataclass(frozen=True)
class HessTorus:
    """Torus of the Hess manifold.

    Parameters
    ----------
    moments : tuple of three floats
        Moments of inertia I1, I2, I3, positive, with I2 between the others.
    strength : float
        The product μ|r|, nonzero.
    h : float
        Energy H.
    f : float
        Area integral F1.
    """

    moments: tuple[float, float, float]
    strength: float
    h: float
    f: float

    def map_at(self, away: float, accuracy: Accuracy) -> ReturnMap:
        """Return the return map of g = π/2 with r rotated off the Hess condition.

        Parameters
        ----------
        away : float
            Angle of the rotation, in radians.
        accuracy : str or Level
            Accuracy level.

        Returns
        -------
        ReturnMap
            The return map.

        Raises
        ------
        InvalidParameter
            If the moments do not allow the Hess condition.
        """
        level = as_level(accuracy)
        return ReturnMap(AndoyerSection(HeavyBody.hess(self.moments, self.strength, away), self.h, self.f), level)


@dataclass(frozen=True)
class Saddles:
    """The two limit cycles of a torus in the section of the Hess case.

    Attributes
    ----------
    repels : ndarray, shape (m, 2)
        Points (l, L/G) of the cycle that repels along the manifold.
    attracts : ndarray, shape (m, 2)
        Points (l, L/G) of the cycle that attracts along it.
    l : float
        Angle half-way between their first points, the shorter way round, in radians.
    """

    repels: Array
    attracts: Array
    l: float


@dataclass(frozen=True)
class Split:
    """Distance of the two manifolds at one angle l; the result of `split_at`.

    Attributes
    ----------
    away : float
        Angle by which r is rotated off the Hess condition, in radians.
    l : float
        Angle l of the comparison, in radians.
    value : float
        L/G of the unstable manifold minus that of the stable one.
    error : float
        Estimated error of the value, ≥ 0.
    """

    away: float
    l: float
    value: float
    error: float


def saddles(torus: HessTorus, accuracy: Accuracy) -> Saddles:
    """Return the two limit cycles of a torus in the section of the Hess case.

    Parameters
    ----------
    torus : HessTorus
        The torus.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    Saddles
        The two cycles.

    Raises
    ------
    InvalidParameter
        If the moments do not allow the Hess condition.
    OutsideRegion
        If the torus does not exist or does not have two limit cycles, or one of them does not cross the section.
    Separatrix
        If the torus is the separatrix, h = 1 and f = 0 in units b = 1.
    NoField
        If the strength is 0.
    NotConverged
        If Newton's method does not find a cycle in the section.
    """
    body = HeavyBody.hess(torus.moments, torus.strength)
    bridge = Bridge.of_heavy(body)
    h, f = bridge.in_units_of_b(torus.h, torus.f)
    try:
        theta = circle_map(bridge.hess.a, h, f, REFERENCE)
    except OutsideRegion as reason:
        # Raise a new error, because the numbers in the original message are in other units.
        raise OutsideRegion(
            "The Hess manifold has no motion with these h and f, so no separatrices: choose a larger h "
            "or a smaller |f|."
        ) from reason
    if theta.kind != "hyperbolic":
        raise OutsideRegion(
            "The torus of the Hess manifold has no limit cycles here, so no separatrices: choose an h "
            "and f where |trace| of the circle map is larger than 2."
        )
    turning, map_ = turning_points(h, f), torus.map_at(0.0, accuracy)
    cycles = []
    for point in sorted(theta.fixed_points, key=lambda one: one.stable):
        state = bridge.from_reduced(bridge.hess.from_units_of_b(turning.state_at_lower_turn(point.phi)[None]))[0]
        crossing = section_crossings(AndoyerSection(body, torus.h, torus.f), state[None], 1, REFERENCE, threads=1)
        if not len(crossing.states[0]):
            raise OutsideRegion(
                "A limit cycle of the Hess manifold does not cross the section g = π/2 here: choose other h and f."
            )
        cycles.append(find_periodic(map_, map_.section.points_of(crossing.states[0])[0], near=True).points)
    repels, attracts = cycles
    half = 0.5 * math.remainder(float(attracts[0, 0] - repels[0, 0]), 2.0 * math.pi)
    return Saddles(repels, attracts, float(repels[0, 0]) + half)


def split_at(torus: HessTorus, away: float, accuracy: Accuracy) -> Split:
    """Return the split of the separatrices with r rotated off the Hess condition.

    Parameters
    ----------
    torus : HessTorus
        The torus.
    away : float
        Angle of the rotation, in radians.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    Split
        The split and its error.

    Raises
    ------
    InvalidParameter
        If the moments do not allow the Hess condition, or `away` is not finite.
    OutsideRegion
        If `saddles` does not find two limit cycles in the section.
    Separatrix
        As `saddles`.
    NoField
        As `saddles`.
    NotConverged
        If a saddle is not found, or a separatrix ends too early.
    """
    known, map_ = saddles(torus, accuracy), torus.map_at(away, accuracy)
    unstable = _towards(map_, known.repels, known.l, stable=False)
    stable = _towards(map_, known.attracts, known.l, stable=True)
    try:
        value, error = split(unstable, stable, 0, known.l)
    except NotConverged as reason:
        raise NotConverged(
            "A separatrix ends before it is half-way to the other saddle: choose a smaller |ε|, nearer the Hess case."
        ) from reason
    return Split(away, known.l, value, error)


def _towards(map_: ReturnMap, points: Array, l: float, stable: bool) -> Manifold:
    """Return the branch along the Hess manifold, from the saddle near these points to beyond the angle l."""
    orbit = find_periodic(map_, points if len(points) > 1 else points[0], None if len(points) > 1 else 1, near=True)
    if (
        not orbit.kind.startswith("saddle")
        or orbit.period != len(points)
        or np.abs(difference(map_.turns, orbit.points, points)).max() > _ELSEWHERE
    ):
        raise NotConverged(
            "The limit cycles of the Hess manifold are not found as saddles of the section: choose a "
            "smaller |ε|, or other h and f."
        )
    sheet = map_.section
    assert isinstance(sheet, AndoyerSection)
    from_ = float(orbit.points[0, 0])
    way = math.remainder(l - from_, 2.0 * math.pi)
    along = np.linspace(from_, from_ + way, 200)
    curve = np.column_stack([along, hess_curve(sheet.body, along)])
    length = float(np.hypot(*np.diff(curve, axis=0).T).sum())
    # `manifold` takes the direction whose larger component is positive.
    d = curve[1] - curve[0]
    side = 1 if d[int(np.argmax(np.abs(d)))] > 0.0 else -1
    branch = manifold(map_, orbit, length + _ROOM, stable=stable, side=side, sagitta=_SAGITTA, longest=_CHORD)
    # The angles continue without jumps; shift them to the turn that contains l.
    shift = (l - from_) - way
    return replace(branch, points=as_read_only(branch.points + np.array([shift, 0.0])))


def slope_of(close: Sequence[Split]) -> tuple[float, float]:
    """Return the derivative of the split with respect to the angle ε at ε = 0, by fourth-order differences.

    Parameters
    ----------
    close : sequence of Split
        Four splits, at ε = e, −e, 2e, −2e.

    Returns
    -------
    slope : float
        The derivative, per radian.
    error : float
        Its estimated error, ≥ 0.
    """
    e = close[0].away
    first, second = ((one.value - other.value) / (one.away - other.away) for one, other in (close[:2], close[2:]))
    return (4.0 * first - second) / 3.0, abs(second - first) + sum(one.error for one in close) / abs(e)
