"""The torus M²(h, f) in three dimensions, by a formula.  Not in the paper.

In units b = 1 a reduced state (w1, w2, n1, n2, n3) (`eq01`) of the energy h is shown at

    X = w1/ρ0,  Y = w2/ρ0,  Z = ṅ3/ρ0²,  ρ0² = 2(h + 1),  ṅ3 = n1 w2 − n2 w1.

ρ0 is the largest |w| of this energy, and all points lie in the unit ball.  By `eq03` a torus is the surface of
revolution

    ṅ3² + f² = w²(1 − (w²/2 − h)²),

whose angle about the Z axis is φ.  If w ≠ 0, the point and (h, f) determine the state: n3 = w²/2 − h, and (n1, n2) has
the component f/|w| along w and ṅ3/|w| across it.  So the map is an embedding of every torus with f ≠ 0, and of those
with f = 0, h > 1.  For f = 0, h < 1 a circle of states has w = 0, and the origin represents all of it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.results import Array, Complex, as_read_only
from hess_mechanics.suslov_hess.bifurcation import TurningPoints, turning_points
from hess_mechanics.suslov_hess.circle_map import CircleMap
from hess_mechanics.suslov_hess.invariant_measure import zeta_at

__all__ = ["CrossSection", "cross_section", "density_along", "embed"]


@dataclass(frozen=True)
class CrossSection:
    """The closed curve whose revolution about the Z axis is the torus; it begins and ends at the lowest n3.

    Attributes
    ----------
    radius : ndarray, shape (n,)
        Distance √(X² + Y²) from the axis, 0 to 1.
    height : ndarray, shape (n,)
        Height Z, −1 to 1; n3 grows along the first half.
    times : ndarray, shape (n,)
        Times since the lowest n3, in units b = 1; on the separatrix all but the first are infinite.
    """

    radius: Array
    height: Array
    times: Array


def embed(reduced: Array, h: float) -> Array:
    """Return the points of the unit ball that represent reduced states.

    Parameters
    ----------
    reduced : ndarray, shape (n, 5)
        States (w1, w2, n1, n2, n3) of the energy h, in units b = 1.
    h : float
        Energy, h > −1, in units b = 1.

    Returns
    -------
    ndarray, shape (n, 3)
        Points (X, Y, Z).
    """
    w1, w2, n1, n2, _ = reduced.T
    square = 2.0 * (h + 1.0)
    return np.column_stack([w1, w2, (n1 * w2 - n2 * w1) / math.sqrt(square)]) / math.sqrt(square)


def cross_section(h: float, turning_points: TurningPoints | None, count: int) -> CrossSection:
    """Return the cross-section of a torus, at angles θ evenly spaced from 0 to 2π.

    n3 = ½(ν1 + ν2) − ½(ν2 − ν1) cos θ between the turning points ν1 < ν2 of n3.

    Parameters
    ----------
    h : float
        Energy, h > −1, in units b = 1.
    turning_points : TurningPoints or None
        Turning points of the torus (h, f); None on the separatrix.
    count : int
        Number of points, at least 3.

    Returns
    -------
    CrossSection
        The closed curve.

    Raises
    ------
    InvalidParameter
        If there are too few points.
    """
    if count < 3:
        raise InvalidParameter(f"A closed curve needs at least three points, not {count}.")
    n0, n1, n2 = (-1.0, -1.0, 1.0) if turning_points is None else turning_points.roots
    lowest = 0.0 if turning_points is None else turning_points.w_squared
    square = 2.0 * (h + 1.0)
    theta = np.linspace(0.0, 2.0 * math.pi, count)
    sine = np.sin(0.5 * theta)
    rise = (n2 - n1) * sine * sine
    # ṅ3² = 2(n3 − n0)(n3 − n1)(n2 − n3); θ and 2π − θ differ in its sign.
    speed = (n2 - n1) * sine * np.cos(0.5 * theta) * np.sqrt(2.0 * (n1 - n0 + rise))
    speed[-1] = 0.0
    return CrossSection(
        as_read_only(np.sqrt((lowest + 2.0 * rise) / square)),
        as_read_only(speed / square),
        as_read_only(_times(n0, n1, n2, theta)),
    )


def _times(n0: float, n1: float, n2: float, theta: Array) -> Array:
    """Return the times at the angles θ from the lowest n3, by the elliptic integral of the first kind."""
    if n1 == n0:
        return np.where(theta > 0.0, math.inf, 0.0)
    m = (n2 - n1) / (n2 - n0)
    # Imported here because the import takes 0.2 s, and few commands draw a torus.
    from scipy.special import ellipk, ellipkinc

    times = math.sqrt(2.0 / (n2 - n0)) * (ellipk(m) - ellipkinc(0.5 * (math.pi - theta), m))
    return np.asarray(np.maximum(0.0, times))


def density_along(theta: CircleMap, count: int, accuracy: Accuracy) -> Complex:
    """Return the points ζ_s of the invariant density along the cross-section of a torus.

    Parameters
    ----------
    theta : CircleMap
        The circle map of the torus.
    count : int
        Number of points, at least 3.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    ndarray of complex, shape (count,)
        Points ζ_s of the unit disk, which determine the density p(φ; ζ_s).

    Raises
    ------
    InvalidParameter
        As `zeta_at`, or if `count` is below 3.
    WorkLimit
        As `zeta_at`.
    """
    times = cross_section(theta.h, turning_points(theta.h, theta.f), count).times
    return zeta_at(theta, times, accuracy)
