"""Orbits and limit cycles on one Suslov–Hess torus, in the variables (ω1, ω2, γ) of the Suslov problem.

h and f (`eq03`) are in units b = 1; time and angular velocity are in the units of the body.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, replace

import numpy as np

from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import PIXELS, SAGITTA, sample_times
from hess_mechanics.errors import Separatrix
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.results import Array, Orbit, as_read_only
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov_hess.bifurcation import TurningPoints, turning_points
from hess_mechanics.suslov_hess.circle_map import FixedPoint
from hess_mechanics.suslov_hess.equations import SYSTEM, HessBody

__all__ = [
    "Track",
    "annulus",
    "cycles",
    "pixels_per_unit",
    "start_of_track",
    "track",
]

MAX_RETURNS = 100
_MOST = 6000


@dataclass(frozen=True)
class Track:
    """One orbit on a torus, in the units of the body.

    Attributes
    ----------
    times : ndarray of float, shape (n,)
        Times, in the unit T of the body.
    omega : ndarray of float, shape (n, 2)
        Angular velocity (ω1, ω2), in rad/T.
    gamma : ndarray of float, shape (n, 3)
        Vertical γ.
    phi : ndarray of float, shape (n,)
        Angle φ of w = |w|(sin φ, cos φ) in (−π, π], in radians.
    n3 : ndarray of float, shape (n,)
        Third component of n, −1 to 1.
    orbit : Orbit
        The reduced orbit in units b = 1.
    """

    times: Array
    omega: Array
    gamma: Array
    phi: Array
    n3: Array
    orbit: Orbit


def _in_body_units(body: HessBody, orbit: Orbit) -> Track:
    w1, w2 = orbit.states[:, 0], orbit.states[:, 1]
    states = body.from_reduced(body.from_units_of_b(orbit.states))
    return Track(
        times=as_read_only(orbit.times / body.frequency_unit),
        omega=as_read_only(states[:, :2].copy()),
        gamma=as_read_only(states[:, 2:].copy()),
        phi=as_read_only(np.arctan2(w1, w2)),
        n3=as_read_only(orbit.states[:, 4].copy()),
        orbit=orbit,
    )


def start_of_track(body: HessBody, h: float, f: float, phi0: float, duration: float) -> tuple[Array, float]:
    """Return the initial state and the duration, in units b = 1, of the orbit that `track` follows.

    The separatrix (h = 1, f = 0) has no lower turning point: there the orbit starts at the maximum of n3.

    Parameters
    ----------
    body : HessBody
        The body.
    h : float
        Energy, h > −1, in units b = 1.
    f : float
        Area integral, |f| ≤ f_max(h), in units b = 1.
    phi0 : float
        Angle φ of w = |w|(sin φ, cos φ) at the start, in radians.
    duration : float
        Time, in the units of the body; negative: backward.

    Returns
    -------
    state : ndarray, shape (5,)
        State (w1, w2, n1, n2, n3).
    duration : float
        Time in units b = 1, at most `MAX_RETURNS` periods of n3, or 20 on the separatrix; not limited if negative.

    Raises
    ------
    OutsideRegion
        If no motion has this h and f.
    NoField
        If b = 0.
    InvalidParameter
        If a number is not finite.
    """
    require_finite(phi0=phi0, duration=duration)
    length = duration * body.frequency_unit
    try:
        turning: TurningPoints = turning_points(h, f)
    except Separatrix:
        return np.array([2.0 * math.sin(phi0), 2.0 * math.cos(phi0), 0.0, 0.0, 1.0]), min(length, 20.0)
    return turning.state_at_lower_turn(phi0), min(length, MAX_RETURNS * turning.period)


def pixels_per_unit(body: HessBody, half_width: float) -> Array:
    """Return the pixels per unit of each reduced variable, in units b = 1, in plots of `PIXELS`.

    The plots show ω within ± half_width, and γ within the unit circle.

    Parameters
    ----------
    body : HessBody
        The body.
    half_width : float
        Largest |ω| of the plot, positive, in rad/T.

    Returns
    -------
    ndarray, shape (5,)
        Pixels per unit of w1, w2, n1, n2, n3.

    Raises
    ------
    NoField
        If b = 0.
    """
    radius = 0.5 * PIXELS
    w = radius * body.frequency_unit / half_width
    return np.array([w, w * math.hypot(1.0, body.a), radius, radius, radius])


def track(
    body: HessBody, h: float, f: float, phi0: float, duration: float, accuracy: Accuracy, half_width: float
) -> Track:
    """Return the orbit of `start_of_track`, sampled for a plot.

    Parameters
    ----------
    body : HessBody
        The body.
    h : float
        Energy, h > −1, in units b = 1.
    f : float
        Area integral, |f| ≤ f_max(h), in units b = 1.
    phi0 : float
        Angle φ of w = |w|(sin φ, cos φ) at the start, in radians.
    duration : float
        Time, nonzero, in the units of the body; negative: backward.
    accuracy : str or Level
        Accuracy level.
    half_width : float
        Largest |ω| of the plot, positive, in rad/T.

    Returns
    -------
    Track
        The orbit, in the units of the body.

    Raises
    ------
    OutsideRegion
        If no motion has this h and f.
    NoField
        If b = 0.
    InvalidParameter
        If a number is not finite.
    WorkLimit
        If the orbit needs too many steps.
    """
    start, length = start_of_track(body, h, f, phi0, duration)
    times = _times(body, start, length, half_width)
    return _in_body_units(body, solve(SYSTEM.at((body.a, 1.0)), start, times, accuracy))


def _times(body: HessBody, start: Array, length: float, half_width: float) -> Array:
    weights = pixels_per_unit(body, half_width)
    return sample_times(SYSTEM.at(np.array([body.a, 1.0])), start, length, weights, SAGITTA, _MOST)


def cycles(
    body: HessBody, h: float, f: float, stable: FixedPoint, accuracy: Accuracy, half_width: float
) -> tuple[Track, Track]:
    """Return the stable and the unstable limit cycle, each over one period and sampled as in `track`.

    Only the stable cycle is integrated.  The reversor (w1, n1, t) → (−w1, −n1, −t) maps it to the unstable one.

    Parameters
    ----------
    body : HessBody
        The body.
    h : float
        Energy, h > −1, in units b = 1.
    f : float
        Area integral, |f| ≤ f_max(h), in units b = 1.
    stable : FixedPoint
        Stable fixed point of the circle map.
    accuracy : str or Level
        Accuracy level.
    half_width : float
        Largest |ω| of the plot, positive, in rad/T.

    Returns
    -------
    (Track, Track)
        The stable and the unstable cycle.

    Raises
    ------
    OutsideRegion
        If no motion has this h and f.
    Separatrix
        If h = 1 and f = 0.
    NoField
        If b = 0.
    WorkLimit
        If the orbit needs too many steps.
    """
    turning = turning_points(h, f)
    start = turning.state_at_lower_turn(stable.phi)
    times = _times(body, start, turning.period, half_width)
    orbit = solve(SYSTEM.at((body.a, 1.0)), start, times, accuracy)
    mirrored = orbit.states[::-1] * np.array([-1.0, 1.0, -1.0, 1.0, 1.0])
    image = replace(orbit, times=as_read_only(turning.period - orbit.times[::-1]), states=as_read_only(mirrored))
    return _in_body_units(body, orbit), _in_body_units(body, image)


def annulus(body: HessBody, h: float, turning_points: TurningPoints | None) -> tuple[Array, Array]:
    """Return the inner and the outer ellipse that bound the motion in the (ω1, ω2) plane.

    |w|² = 2(h + n3) between the turning points; on the separatrix |w|² lies between 0 and 4.

    Parameters
    ----------
    body : HessBody
        The body.
    h : float
        Energy, h > −1, in units b = 1.
    turning_points : TurningPoints or None
        Turning points of the torus; None on the separatrix.

    Returns
    -------
    tuple of two ndarray, shape (181, 2)
        Points (ω1, ω2) of both ellipses.

    Raises
    ------
    NoField
        If b = 0.
    """
    inner, outer = (0.0, 2.0) if turning_points is None else (turning_points.initial_rho, turning_points.final_rho)
    s = np.linspace(0.0, 2.0 * math.pi, 181)
    unit = body.frequency_unit * np.column_stack([np.sin(s), math.hypot(1.0, body.a) * np.cos(s)])
    return as_read_only(inner * unit), as_read_only(outer * unit)
