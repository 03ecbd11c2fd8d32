"""Kharlamova's case of the Suslov problem: e on a principal axis, I13 = I23 = 0, and b3 = 0 (`Biz136`).

In the time τ of `principal_axis`, dτ = γ3 dt, nothing depends on γ3: with u = (γ1, γ2)

    u(τ) = u0 + v0 τ + a τ²/2,  v = u' = (−ω2, ω1),  a = (−b1/I22, −b2/I11),

a parabola (the paper says straight lines), and (dτ/dt)² = γ3² = P(τ) = 1 − |u(τ)|²: τ oscillates between two
neighbouring zeros of this quartic, and γ3 changes sign at each of them.  With τ = m + sx, P = (1 − x²)(A + Bx + Cx²)
and R± the second factor at x = ±1, the period is

    T = 2 ∫ dτ/√P = 2πs / AGM(√((A − C + √(R₊R₋))/2), (R₊R₋)^¼).

At a double zero, where u touches the circle |u| = 1 from inside, τ takes infinite time: the orbit is asymptotic to a
fixed point on the equator.  With a field P → −∞, so every arc ends on the equator.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.polynomial.polynomial import polyder, polyval

from hess_mechanics.dynamics import sampling
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.arguments import as_point
from hess_mechanics.numerics.results import Array, Orbit, as_read_only
from hess_mechanics.suslov.equations import SYSTEM
from hess_mechanics.suslov.kharlamova_kernels import arcs
from hess_mechanics.suslov.plane_potential import MOST_SAMPLES, PlaneProblem, closure_error

__all__ = [
    "Arc",
    "PlaneBody",
    "arc",
    "closure_error",
    "equipotentials",
    "fixed_point_kinds",
    "forbidden",
    "mirror_image",
    "periods_by_direction",
    "rescaled_time",
    "sampled_orbit",
    "state_at",
]

_ON_EQUATOR = 1e-12


@dataclass(frozen=True)
class PlaneBody(PlaneProblem):
    """Body of Kharlamova's case, I13 = I23 = 0 and b3 = 0.

    Parameters
    ----------
    I11 : float
        Moment of inertia about the first axis, I11 > 0; its unit is the unit I of moments of inertia.
    I22 : float
        Moment of inertia about the second axis, I22 > 0, in units I.
    b1 : float
        First component of **b** = −mg **r**, with **r** the centre of mass; any finite number, in units I/T².
    b2 : float
        Second component of **b**, any finite number, in units I/T².

    Raises
    ------
    InvalidParameter
        If a parameter is not finite.
    NotPositiveDefinite
        If I11 ≤ 0 or I22 ≤ 0.

    References
    ----------
    `Biz136`.

    Examples
    --------
    >>> from hess_mechanics import PlaneBody
    >>> body = PlaneBody(1.3, 0.8, 0.5, -0.2)
    >>> round(body.energy((0.3, 0.2, 0.6, 0.0, 0.8)), 6)
    0.3745
    """

    b1: float
    b2: float

    @property
    def parameters(self) -> tuple[float, ...]:
        """The parameters p of the system "suslov"."""
        return (self.I11, self.I22, 0.0, 0.0, self.b1, self.b2, 0.0)

    @property
    def acceleration(self) -> Array:
        """The acceleration a (2,) of (γ1, γ2) in the time τ."""
        return np.array([-self.b1 / self.I22, -self.b2 / self.I11])

    def pixels_per_unit(self, E: float) -> tuple[float, ...]:
        """Return the pixels per unit of each variable in plots that fit the largest ω of the energy E.

        Parameters
        ----------
        E : float
            Energy, any finite number.

        Returns
        -------
        tuple of five floats
            Pixels per unit of ω1, ω2, γ1, γ2, γ3.
        """
        radius = 0.5 * sampling.PIXELS
        largest = 2.0 * max(E + math.hypot(self.b1, self.b2), 1e-300)
        return (radius * math.sqrt(self.I11 / largest), radius * math.sqrt(self.I22 / largest), radius, radius, radius)


def state_at(body: PlaneBody, q: Sequence[float], p: Sequence[float]) -> tuple[float, ...]:
    """Return the state with γ3 ≥ 0 at given q and p.

    A state with γ3² ≤ 1e-12 is moved onto the equator.  If its ω is parallel to γ to 1e-12, it is made exactly
    parallel, which gives a fixed point.

    Parameters
    ----------
    body : PlaneBody
        The body.
    q : sequence of float, shape (2,)
        Point of the plane, inside or on the ellipse with the semi-axes `body.axes`.
    p : sequence of float, shape (2,)
        Momenta.

    Returns
    -------
    tuple of five floats
        State (ω1, ω2, γ1, γ2, γ3).

    Raises
    ------
    InvalidParameter
        If q is outside the ellipse (`Biz1360`), or a number is not finite.
    """
    q1, q2, p1, p2 = as_point(("q1", "q2", "p1", "p2"), (*q, *p))
    r1, r2 = body.axes
    u, omega = np.array([-q2 / r2, q1 / r1]), np.array([p1 / r1, p2 / r2])
    left = 1.0 - u[0] * u[0] - u[1] * u[1]
    if left < -_ON_EQUATOR:
        raise InvalidParameter(
            f"q = ({q1:.6g}, {q2:.6g}) is outside the ellipse q₁²/I₁₁ + q₂²/I₂₂ = 1, where γ₃² would be negative: "
            "choose a start inside it."
        )
    if left <= _ON_EQUATOR:
        u, left = u / np.linalg.norm(u), 0.0
        if abs(omega[0] * u[1] - omega[1] * u[0]) <= _ON_EQUATOR * np.linalg.norm(omega):
            omega = (omega @ u) * u
    return (*omega.tolist(), *u.tolist(), math.sqrt(left))


def mirror_image(states: Array) -> Array:
    """Return the states under γ3 → −γ3, which together with t → −t maps orbits with b3 = 0 to orbits.

    Parameters
    ----------
    states : ndarray, shape (..., 5)
        States (ω1, ω2, γ1, γ2, γ3).

    Returns
    -------
    ndarray, shape (..., 5)
        Their mirror images.
    """
    return np.asarray(states * np.array([1.0, 1.0, 1.0, 1.0, -1.0]))


@dataclass(frozen=True)
class Arc:
    """Arc of the parabola on which an orbit oscillates.

    Attributes
    ----------
    kind : str
        "periodic", "asymptotic" (to a fixed point on the equator, both ways) or "fixed".
    u0 : ndarray, shape (2,)
        Start (γ1, γ2) of the parabola, at τ = 0.
    v0 : ndarray, shape (2,)
        Velocity there, du/dτ.
    a : ndarray, shape (2,)
        Acceleration, the same everywhere.
    rate : float
        Rate ν = max(|v0|, √|a|), ν ≥ 0; 1/ν is the scale of τ.
    tau : (float, float)
        The times τ₋ ≤ 0 ≤ τ₊ at which the arc meets the equator; (0, 0) for a fixed point.
    touch : float or None
        That one of these two times at which the arc touches the equator, reached only as t → ±∞; None if neither.
    other : (float, float) or None
        The times (τ₋, τ₊) of another orbit on the same parabola; None if there is none.
    period : float
        Period T in time t; ∞ if the orbit is asymptotic, 0 for a fixed point.
    stable : bool or None
        For a fixed point, True if nearby orbits stay near, False if not; None if P'' = 0, and for other orbits.
    """

    kind: str
    u0: Array
    v0: Array
    a: Array
    rate: float
    tau: tuple[float, float]
    touch: float | None
    other: tuple[float, float] | None
    period: float
    stable: bool | None

    def u(self, tau: Array) -> Array:
        """Return points of the parabola.

        Parameters
        ----------
        tau : ndarray, shape (m,)
            Conformal times τ.

        Returns
        -------
        ndarray, shape (m, 2)
            Points (γ1, γ2).
        """
        t = tau[:, None]
        return np.asarray(self.u0 + t * (self.v0 + 0.5 * t * self.a))

    def height(self, tau: Array) -> Array:
        """Return |γ3| along the parabola.

        Parameters
        ----------
        tau : ndarray, shape (m,)
            Conformal times τ.

        Returns
        -------
        ndarray, shape (m,)
            Values of |γ3|; 0 where the parabola is outside the domain.
        """
        return np.asarray(np.sqrt(np.maximum(0.0, 1.0 - np.sum(self.u(tau) ** 2, axis=1))))

    @property
    def ends(self) -> tuple[float, float]:
        """The first and the last τ of the arc and of that of the other orbit, if there is one."""
        both = self.tau + (self.other or ())
        return min(both), max(both)

    @property
    def length(self) -> float:
        """The length in τ from the first to the last of `ends`; for a fixed point 1/ν, or 1 if ν = 0."""
        low, high = self.ends
        return (high - low) or 1.0 / (self.rate or 1.0)

    @property
    def crossing_speeds(self) -> Array:
        """The values |γ̇3| = |(u, v)| (2,) at τ₋ and τ₊, where the orbit meets the equator."""
        tau = np.array(self.tau)
        return np.asarray(np.abs(np.sum(self.u(tau) * (self.v0 + tau[:, None] * self.a), axis=1)))

    def oval(self, ends: tuple[float, float]) -> Array:
        """Return the curve γ3² = P(τ) over an interval of τ, with both signs of γ3.

        Parameters
        ----------
        ends : (float, float)
            Ends of the interval, two zeros of P.

        Returns
        -------
        ndarray, shape (241, 2)
            Points (τ, γ3) of the closed curve.
        """
        angle = np.linspace(0.0, 2.0 * math.pi, 241)
        tau = 0.5 * (ends[0] + ends[1]) + 0.5 * (ends[1] - ends[0]) * np.cos(angle)
        return np.column_stack([tau, np.copysign(self.height(tau), np.sin(angle))])


def rescaled_time(arc: Arc, states: Array) -> Array:
    """Return the conformal time τ of states of an orbit, from u − u0 = τ (v + v0)/2 and v − v0 = a τ by least squares.

    Parameters
    ----------
    arc : Arc
        The arc of the orbit.
    states : ndarray, shape (m, 5)
        States of the orbit.

    Returns
    -------
    ndarray, shape (m,)
        Conformal times τ.
    """
    v, unit = np.column_stack([-states[:, 1], states[:, 0]]), arc.rate or 1.0
    # Scale both equations to units in which ν is 1.
    slope = np.hstack([0.5 * (v + arc.v0) / unit, np.broadcast_to(arc.a / unit**2, v.shape)])
    change = np.hstack([states[:, 2:4] - arc.u0, (v - arc.v0) / unit])
    size = np.sum(slope * slope, axis=1)
    return np.asarray(np.sum(slope * change, axis=1) / np.where(size > 0.0, size, 1.0) / unit)


def _period(c: Array, low: Array, high: Array, side: Array) -> Array:
    """Return T (n,) between two zeros of each P (n, 5): ∞ if one is double, of small vibrations if P(0) = P'(0) = 0."""
    P, slope = c.T, polyder(c.T)
    s, m = 0.5 * (high - low), 0.5 * (high + low)
    with np.errstate(all="ignore"):
        root = 0.5 * s * np.sqrt(-polyval(low, slope, False) * polyval(high, slope, False))
        x, y = np.sqrt(0.5 * (polyval(m, P, False) + P[4] * s**4 + root)), np.sqrt(root)
        # 16 steps of the arithmetic–geometric mean converge for all zeros of P.
        for _ in range(16):
            x, y = 0.5 * (x + y), np.sqrt(x * y)
        T = np.where((side == 0.0) & (root > 0.0), 2.0 * math.pi * s / x, math.inf)
        T = np.where((P[0] == 0.0) & (P[1] == 0.0) & (P[2] < 0.0), 2.0 * math.pi / np.sqrt(-P[2]), T)
    return np.where(np.isnan(T), math.inf, T)


def _solve(u0: Array, v0: Array, a: Array, height: float) -> tuple[Array, Array, Array, Array]:
    """Return the rows of `arcs` (n, 5) and T (n,) for each v0 (n, 2), P (n, 5) in units of 1/ν, and ν (n,).

    Raises `InvalidParameter` if a motion is too fast for double precision.
    """
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        rate = np.maximum(np.hypot(v0[:, 0], v0[:, 1]), math.sqrt(math.hypot(*a)))
        unit = np.where(rate > 0.0, rate, 1.0)
        v, bent = v0 / unit[:, None], a / (unit * unit)[:, None]
        slope = -2.0 * (v @ u0)
        if height == 0.0:
            # On the equator such a small slope is round-off, and the point is fixed.
            slope[np.abs(slope) <= 1e-15] = 0.0
        bend = -np.sum(v * v, axis=1) - bent @ u0
        start = np.full(len(v), height * height)
        c = np.column_stack([start, slope, bend, -np.sum(v * bent, axis=1), -0.25 * np.sum(bent * bent, axis=1)])
    if not np.all(np.isfinite(c.T + rate)):
        raise InvalidParameter("The motion is too fast for double precision: choose less extreme parameters.")
    rows = np.empty((len(c), 5))
    arcs(c, rows)
    return rows / unit[:, None], _period(c, *rows.T[:3]) / unit, c, rate


def arc(body: PlaneBody, state: Sequence[float]) -> Arc:
    """Return the arc of the orbit through a state, in closed form.

    Parameters
    ----------
    body : PlaneBody
        The body.
    state : sequence of float, shape (5,)
        The state (ω1, ω2, γ1, γ2, γ3).

    Returns
    -------
    Arc
        The arc, with its kind and period.

    Raises
    ------
    InvalidParameter
        If the state does not have five finite numbers, or the motion is too fast for double precision.

    Examples
    --------
    >>> from hess_mechanics import PlaneBody, arc
    >>> arc(PlaneBody(1.3, 0.8, 0.5, -0.2), (1.0, -0.5, 0.0, 0.6, 0.8)).kind
    'periodic'
    """
    w1, w2, g1, g2, g3 = as_point(SYSTEM.variables, state)
    u0, v0, a = np.array([g1, g2]), np.array([-w2, w1]), body.acceleration
    rows, (period,), (c,), (rate,) = _solve(u0, v0[None], a, g3)
    low, high, side, before, after = map(float, rows[0])
    frame = (as_read_only(u0), as_read_only(v0), as_read_only(a), float(rate))
    if rate == 0.0 or (c[0] == 0.0 and c[1] == 0.0):
        stable = bool(c[2] < 0.0) if c[2] != 0.0 else None
        return Arc("fixed", *frame, (0.0, 0.0), None, None, 0.0, stable)
    touch = low if side < 0.0 else high if side > 0.0 else None
    kind = "periodic" if math.isfinite(period) else "asymptotic"
    return Arc(kind, *frame, (low, high), touch, (before, after) if before < after else None, float(period), None)


def periods_by_direction(body: PlaneBody, q: Sequence[float], speed: float) -> Array:
    """Return the periods of the orbits from a point of the plane in all directions.

    Parameters
    ----------
    body : PlaneBody
        The body.
    q : sequence of float, shape (2,)
        Point of the plane, inside or on the ellipse with the semi-axes `body.axes`.
    speed : float
        Size |p| of the momentum, ≥ 0.

    Returns
    -------
    ndarray, shape (721, 2)
        Angle α of p from −π to π, in radians, and the period T: that of small oscillations for a stable equilibrium, ∞
        for asymptotic orbits and other equilibria.

    Raises
    ------
    InvalidParameter
        If q is outside the ellipse, or a motion is too fast for double precision.
    """
    state = state_at(body, q, (0.0, 0.0))
    r1, r2 = body.axes
    angle = np.linspace(-math.pi, math.pi, 721)
    v0 = speed * np.column_stack([-np.sin(angle) / r2, np.cos(angle) / r1])
    return as_read_only(np.column_stack([angle, _solve(np.array(state[2:4]), v0, body.acceleration, state[4])[1]]))


def fixed_point_kinds(body: PlaneBody, E: float, count: int = 361) -> tuple[Array, Array]:
    """Return points of the ellipse that bounds the plane, and the stability of the fixed points there.

    States on the equator with ω ∥ γ are fixed, and near them τ̈ = P''τ/2, P'' = −2(|v|² + (u, a)).

    Parameters
    ----------
    body : PlaneBody
        The body.
    E : float
        Energy, any finite number.
    count : int, default 361
        Number of points.

    Returns
    -------
    points : ndarray, shape (count, 2)
        Points q of the ellipse.
    kind : ndarray, shape (count,)
        1: stable, −1: unstable, 0: no fixed point has this energy there.
    """
    angle = np.linspace(0.0, 2.0 * math.pi, count)
    u = np.column_stack([np.cos(angle), np.sin(angle)])
    kinetic = E - u @ np.array([body.b1, body.b2])
    squared = 2.0 * kinetic / (body.I11 * u[:, 0] ** 2 + body.I22 * u[:, 1] ** 2)
    kind = np.where(kinetic < 0.0, 0.0, np.where(squared + u @ body.acceleration > 0.0, 1.0, -1.0))
    return as_read_only(body.q_of(u)), as_read_only(kind)


def _segment(body: PlaneBody, share: float, count: int) -> Array:
    """Return `count` points q of the arc of the ellipse where V exceeds the given share of its maximum."""
    half = math.acos(max(-1.0, share))
    angle = math.atan2(body.b2, body.b1) + np.linspace(-half, half, count)
    return body.q_of(np.column_stack([np.cos(angle), np.sin(angle)]))


def equipotentials(body: PlaneBody, levels: Sequence[float]) -> list[Array]:
    """Return the chords of the ellipse on which V has given values.

    Parameters
    ----------
    body : PlaneBody
        The body.
    levels : sequence of float
        Values of V as shares of its maximum, −1 to 1.

    Returns
    -------
    list of ndarray, shape (2, 2)
        Ends q of each chord; empty without a field.
    """
    return [_segment(body, share, 2) for share in levels] if body.b1 or body.b2 else []


def forbidden(body: PlaneBody, E: float) -> list[Array]:
    """Return the boundary of the part of the ellipse where V exceeds the energy.

    Parameters
    ----------
    body : PlaneBody
        The body.
    E : float
        Energy, any finite number.

    Returns
    -------
    list of ndarray, shape (91, 2)
        One polygon of points q on the ellipse, which a chord closes; empty if V nowhere exceeds E.
    """
    size = math.hypot(body.b1, body.b2)
    return [_segment(body, E / size, 91)] if size > E else []


def sampled_orbit(body: PlaneBody, start: Sequence[float], duration: float, accuracy: Accuracy) -> tuple[Orbit, Array]:
    """Return an orbit at the sample times of a plot, and the mirror image of its continuation in the other direction.

    Parameters
    ----------
    body : PlaneBody
        The body.
    start : sequence of float, shape (5,)
        Initial state.
    duration : float
        Time, nonzero; negative: backward.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    orbit : Orbit
        The orbit.
    mirror : ndarray, shape (m, 5)
        Mirror images, γ3 → −γ3, of the states at the opposite times.

    Raises
    ------
    InvalidParameter
        If a number is out of range.
    WorkLimit
        If the motion needs too many steps.
    """
    weights = body.pixels_per_unit(body.energy(start))
    orbit = sampling.sampled_orbit(body, start, duration, weights, accuracy, MOST_SAMPLES)
    return orbit, as_read_only(mirror_image(solve(body, start, -orbit.times, accuracy).states))
