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

from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import PIXELS, SAGITTA, sample_times
from hess_mechanics.dynamics.system import System
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.arguments import as_parts
from hess_mechanics.numerics.results import Array, Orbit, frozen
from hess_mechanics.rigid_body.inertia import require_finite, require_positive_definite
from hess_mechanics.suslov.equations import SYSTEM
from hess_mechanics.suslov.kharlamova_kernels import arcs

__all__ = [
    "MOST_SAMPLES",
    "Arc",
    "PlaneBody",
    "arc",
    "equipotentials",
    "fixed_point_kinds",
    "forbidden",
    "mirrored",
    "missed",
    "periods",
    "periods_all_round",
    "rescaled_time",
    "sampled_orbit",
    "state_at",
    "to_plane",
]

MOST_SAMPLES = 6000
"""Largest number of samples of an orbit in a plot."""

_ON_EQUATOR = 1e-12


@dataclass(frozen=True)
class PlaneBody:
    """Body of Kharlamova's case, I13 = I23 = 0 and b3 = 0.

    Parameters
    ----------
    I11 : float
        Moment of inertia about the first axis, I11 > 0.
    I22 : float
        Moment of inertia about the second axis, I22 > 0.
    b1 : float
        First component of **b** = −mg **r**, with **r** the centre of mass.
    b2 : float
        Second component of **b**.

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

    I11: float
    I22: float
    b1: float
    b2: float

    def __post_init__(self) -> None:
        require_finite(**vars(self))
        require_positive_definite(self.I11, self.I22)

    @property
    def system(self) -> System:
        """The equations of motion."""
        return SYSTEM

    @property
    def parameters(self) -> tuple[float, ...]:
        """The parameters p of the system "suslov"."""
        return (self.I11, self.I22, 0.0, 0.0, self.b1, self.b2, 0.0)

    @property
    def acceleration(self) -> Array:
        """The acceleration a (2,) of (γ1, γ2) in the time τ."""
        return np.array([-self.b1 / self.I22, -self.b2 / self.I11])

    @property
    def axes(self) -> tuple[float, float]:
        """The semi-axes √I11, √I22 of the elliptic domain (`Biz1360`)."""
        return math.sqrt(self.I11), math.sqrt(self.I22)

    def energy(self, state: Sequence[float]) -> float:
        """Return the energy E of a state.

        Parameters
        ----------
        state : sequence of five floats
            State (ω1, ω2, γ1, γ2, γ3).

        Returns
        -------
        float
            The energy.
        """
        return float(SYSTEM.integrals(state, self.parameters)["E"])

    def pixels_per_unit(self, h: float) -> tuple[float, ...]:
        """Return the pixels per unit of each variable in plots that fit the largest ω of the energy h.

        Parameters
        ----------
        h : float
            The energy.

        Returns
        -------
        tuple of five floats
            Pixels per unit of ω1, ω2, γ1, γ2, γ3.
        """
        radius = 0.5 * PIXELS
        largest = 2.0 * max(h + math.hypot(self.b1, self.b2), 1e-300)
        return (radius * math.sqrt(self.I11 / largest), radius * math.sqrt(self.I22 / largest), radius, radius, radius)

    def place(self, u: Array) -> Array:
        """Return the point q of the plane for u = (γ1, γ2).

        Parameters
        ----------
        u : ndarray of float, shape (m, 2)
            Components γ1 and γ2.

        Returns
        -------
        ndarray of float, shape (m, 2)
            Points q = (√I11 γ2, −√I22 γ1).
        """
        r1, r2 = self.axes
        return np.column_stack([r1 * u[:, 1], -r2 * u[:, 0]])

    def potential(self, q: Array) -> Array:
        """Return the potential V = b2 q1/√I11 − b1 q2/√I22.

        Parameters
        ----------
        q : ndarray of float, shape (..., 2)
            Points of the plane.

        Returns
        -------
        ndarray of float, shape (...)
            Values of V.

        References
        ----------
        `eqs03`; `Biz136` with its signs corrected.
        """
        r1, r2 = self.axes
        return np.asarray(self.b2 / r1 * q[..., 0] - self.b1 / r2 * q[..., 1])


def to_plane(body: PlaneBody, states: Array) -> tuple[Array, Array]:
    """Return q and p (m, 2) of the motion in the plane (`Biz136`) from states (m, 5), for either sign of γ3."""
    r1, r2 = body.axes
    return body.place(states[:, 2:4]), np.column_stack([r1 * states[:, 0], r2 * states[:, 1]])


def state_at(body: PlaneBody, q: Sequence[float], p: Sequence[float]) -> tuple[float, ...]:
    """Return the state (5,) with γ3 ≥ 0 at q and p (2,).

    A state within 1e-12 of the equator is moved onto it; if ω ∥ γ there to 1e-12, ω is made exactly parallel to γ,
    which gives a fixed point. Raises `InvalidParameter` if q is outside the elliptic domain (`Biz1360`).
    """
    require_finite(q1=q[0], q2=q[1], p1=p[0], p2=p[1])
    r1, r2 = body.axes
    g1, g2 = -q[1] / r2, q[0] / r1
    omega = (p[0] / r1, p[1] / r2)
    left = 1.0 - g1 * g1 - g2 * g2
    if left < -_ON_EQUATOR:
        raise InvalidParameter(
            f"q = ({q[0]:.6g}, {q[1]:.6g}) is outside the ellipse q₁²/I₁₁ + q₂²/I₂₂ = 1, where γ₃² would be negative: "
            "choose a start inside it."
        )
    if left > _ON_EQUATOR:
        return (*omega, g1, g2, math.sqrt(left))
    length = math.hypot(g1, g2)
    g1, g2 = g1 / length, g2 / length
    if abs(omega[0] * g2 - omega[1] * g1) <= _ON_EQUATOR * math.hypot(*omega):
        along = omega[0] * g1 + omega[1] * g2
        omega = (along * g1, along * g2)
    return (*omega, g1, g2, 0.0)


def mirrored(states: Array) -> Array:
    """Return states (..., 5) under γ3 → −γ3, which together with t → −t maps orbits with b3 = 0 to orbits."""
    image: Array = np.asarray(states, float) * np.array([1.0, 1.0, 1.0, 1.0, -1.0])
    return image


@dataclass(frozen=True)
class Arc:
    """Arc of the parabola on which an orbit oscillates.

    kind : "periodic", "asymptotic" (to a fixed point on the equator, both ways) or "fixed".
    u0, v0, a : (2,), see the module; rate : ν = max(|v0|, √|a|).
    tau : (τ₋, τ₊) where it meets the equator, with the start at τ = 0; touch : the one reached in infinite time.
    other : (τ₋, τ₊) of another orbit on the same parabola, or None; period : T, ∞ if asymptotic.
    stable : for a fixed point, True if nearby orbits stay near; otherwise None.
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
        """Return (γ1, γ2) at τ (m,); shape (m, 2)."""
        t = np.asarray(tau, float)[:, None]
        u: Array = self.u0 + t * (self.v0 + 0.5 * t * self.a)
        return u

    def height(self, tau: Array) -> Array:
        """Return |γ3| at τ (m,); it is 0 where the parabola is outside the domain."""
        u = self.u(tau)
        height: Array = np.sqrt(np.maximum(0.0, 1.0 - np.sum(u * u, axis=1)))
        return height

    @property
    def ends(self) -> tuple[float, float]:
        """The ends in τ of all arcs inside the domain, that of the other orbit included."""
        both = self.tau + (self.other or ())
        return min(both), max(both)

    @property
    def length(self) -> float:
        """The length in τ of the part inside the domain; for a fixed point the time scale 1/ν."""
        low, high = self.ends
        return (high - low) or 1.0 / (self.rate or 1.0)

    @property
    def crossing_speeds(self) -> list[float]:
        """The values |γ̇3| = |(u, v)| at τ₋ and τ₊, where the orbit crosses the equator."""
        tau = np.array(self.tau)
        speeds = np.abs(np.sum(self.u(tau) * (self.v0 + tau[:, None] * self.a), axis=1))
        return [float(speed) for speed in speeds]

    def oval(self, ends: tuple[float, float]) -> Array:
        """Return (τ, γ3), (m, 2), on γ3² = P(τ) over τ from one end to the other, both signs."""
        angle = np.linspace(0.0, 2.0 * math.pi, 241)
        tau = 0.5 * (ends[0] + ends[1]) + 0.5 * (ends[1] - ends[0]) * np.cos(angle)
        return np.column_stack([tau, np.copysign(self.height(tau), np.sin(angle))])


def rescaled_time(arc: Arc, states: Array) -> Array:
    """Return τ (m,) of states (m, 5) of the orbit, from the exact u − u0 = τ (v + v0)/2 and v − v0 = a τ."""
    u, v = states[:, 2:4], np.column_stack([-states[:, 1], states[:, 0]])
    if arc.rate == 0.0:
        return np.zeros(len(states))
    mean, bent = 0.5 * (v + arc.v0) / arc.rate, arc.a / arc.rate**2
    along = np.sum(mean * (u - arc.u0), axis=1) + ((v - arc.v0) / arc.rate) @ bent
    return np.asarray(along / (np.sum(mean * mean, axis=1) + bent @ bent) / arc.rate)


def _quartic(u0: Array, v0: Array, a: Array, height: float) -> tuple[Array, Array]:
    """Return the coefficients (n, 5) of P for each v0 (n, 2), in units of 1/ν, and ν (n,)."""
    rate = np.maximum(np.hypot(v0[:, 0], v0[:, 1]), math.sqrt(math.hypot(*a)))
    unit = np.where(rate > 0.0, rate, 1.0)
    v, bent = v0 / unit[:, None], a / (unit * unit)[:, None]
    slope = -2.0 * (v @ u0)
    if height == 0.0:
        # On the equator such a small slope is round-off, and the point is fixed.
        slope[np.abs(slope) <= 1e-15] = 0.0
    c = np.column_stack(
        [
            np.full(len(v), height * height),
            slope,
            -np.sum(v * v, axis=1) - bent @ u0,
            -np.sum(v * bent, axis=1),
            -0.25 * np.sum(bent * bent, axis=1),
        ]
    )
    return c, rate


def _solved(u0: Array, v0: Array, a: Array, height: float) -> tuple[Array, Array, Array]:
    """Return the rows of `arcs` (n, 6) in the user's time, the coefficients of P (n, 5) and ν (n,).

    Raises `InvalidParameter`.
    """
    with np.errstate(over="ignore", under="ignore", invalid="ignore"):
        c, rate = _quartic(u0, v0, a, height)
    if not (np.all(np.isfinite(c)) and np.all(np.isfinite(rate))):
        raise InvalidParameter("The motion is too fast for double precision: choose less extreme parameters.")
    rows = np.empty((len(c), 6))
    arcs(c, rows)
    unit = np.where(rate > 0.0, rate, 1.0)[:, None]
    rows[:, [0, 1, 2, 4, 5]] /= unit
    return rows, c, rate


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
        If the state has not five finite numbers.

    Examples
    --------
    >>> from hess_mechanics import PlaneBody, arc
    >>> arc(PlaneBody(1.3, 0.8, 0.5, -0.2), (1.0, -0.5, 0.0, 0.6, 0.8)).kind
    'periodic'
    """
    state = as_parts("state", state, 5)
    require_finite(**dict(zip(SYSTEM.variables, map(float, state), strict=True)))
    u0, v0, a = np.array(state[2:4]), np.array([-state[1], state[0]]), body.acceleration
    rows, coefficients, rates = _solved(u0, v0[None], a, float(state[4]))
    low, high, period, side, other_low, other_high = map(float, rows[0])
    c, rate = coefficients[0], float(rates[0])
    frame = (frozen(u0), frozen(v0), frozen(a), rate)
    other = (other_low, other_high) if other_high > other_low else None
    if rate == 0.0 or (c[0] == 0.0 and c[1] == 0.0):
        stable = bool(c[2] < 0.0) if c[2] != 0.0 else None
        return Arc("fixed", *frame, (0.0, 0.0), None, other, 0.0, stable)
    touch = {-1.0: low, 1.0: high}.get(side)
    return Arc("periodic" if math.isfinite(period) else "asymptotic", *frame, (low, high), touch, other, period, None)


def periods(body: PlaneBody, q: Sequence[float], speed: float, directions: Array) -> Array:
    """Return the periods (n,) of the orbits from q (2,) with p = speed (cos α, sin α), for directions α (n,).

    ∞ for asymptotic orbits and equilibria (speed 0, no field).  Raises `InvalidParameter`.
    """
    state = state_at(body, q, (0.0, 0.0))
    r1, r2 = body.axes
    v0 = speed * np.column_stack([-np.sin(directions) / r2, np.cos(directions) / r1])
    rows, _, rate = _solved(np.array(state[2:4]), v0, body.acceleration, state[4])
    return np.where(rate > 0.0, rows[:, 2], math.inf)


def periods_all_round(body: PlaneBody, q: Sequence[float], speed: float) -> Array:
    """Return (α, T), (n, 2), of `periods` for α from −π to π."""
    directions = np.linspace(-math.pi, math.pi, 721)
    return frozen(np.column_stack([directions, periods(body, q, speed, directions)]))


def missed(body: PlaneBody, start: Sequence[float], period: float, accuracy: Accuracy) -> float:
    """Return the distance between the start (5,) of an orbit and its state after one period, in the maximum norm."""
    after = solve(body, start, [period], accuracy).states[0]
    return float(np.abs(after - np.array(start)).max())


def fixed_point_kinds(body: PlaneBody, h: float, count: int = 361) -> tuple[Array, Array]:
    """Return points q (n, 2) on the boundary, and the kind (n,) of the fixed points with E = h there.

    1: stable, −1: unstable, 0: none with this energy.  States on the equator with ω ∥ γ are fixed, and near them
    τ̈ = P''τ/2, P'' = −2(|v|² + (u, a)).
    """
    angle = np.linspace(0.0, 2.0 * math.pi, count)
    u = np.column_stack([np.cos(angle), np.sin(angle)])
    kinetic = h - u @ np.array([body.b1, body.b2])
    squared = 2.0 * kinetic / (body.I11 * u[:, 0] ** 2 + body.I22 * u[:, 1] ** 2)
    kind = np.where(kinetic < 0.0, 0.0, np.where(squared + u @ body.acceleration > 0.0, 1.0, -1.0))
    return frozen(body.place(u)), frozen(kind)


def _along_the_force(body: PlaneBody) -> tuple[Array, Array]:
    """Return unit vectors of the plane of u: b/|b| and its normal."""
    n = np.array([body.b1, body.b2]) / math.hypot(body.b1, body.b2)
    return n, np.array([-n[1], n[0]])


def equipotentials(body: PlaneBody, levels: Sequence[float]) -> list[Array]:
    """Return chords q (2, 2) of the ellipse where V is the given share of its maximum; none without a field."""
    if body.b1 == 0.0 == body.b2:
        return []
    n, across = _along_the_force(body)
    half = [math.sqrt(1.0 - share * share) for share in levels]
    return [body.place(share * n + np.outer([-end, end], across)) for share, end in zip(levels, half, strict=True)]


def forbidden(body: PlaneBody, h: float) -> list[Array]:
    """Return the part of the ellipse where V exceeds the energy h, as closed curves q (m, 2), or []."""
    size = math.hypot(body.b1, body.b2)
    if size == 0.0 or h >= size:
        return []
    n, across = _along_the_force(body)
    half_angle = math.acos(max(-1.0, h / size))
    s = np.linspace(-half_angle, half_angle, 91)
    return [body.place(np.outer(np.cos(s), n) + np.outer(np.sin(s), across))]


def sampled_orbit(body: PlaneBody, start: Sequence[float], span: float, accuracy: Accuracy) -> tuple[Orbit, Array]:
    """Return the orbit at the sample times of a plot, and the mirror image (m, 5) of its past at the same times."""
    weights = np.array(body.pixels_per_unit(body.energy(start)))
    times = sample_times(SYSTEM.at(np.array(body.parameters)), np.array(start), span, weights, SAGITTA, MOST_SAMPLES)
    past = solve(body, start, -times, accuracy)
    return solve(body, start, times, accuracy), frozen(mirrored(past.states))
