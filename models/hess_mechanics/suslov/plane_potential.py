"""The plane problem: the Suslov problem with e on a principal axis, as a point in a potential inside an ellipse.

With q = (√I11 γ2, −√I22 γ1), p = (√I11 ω1, √I22 ω2) and the time τ, dτ = γ3 dt, a potential U(γ1, γ2) gives a natural
Hamiltonian system in the plane (`eqs03`), H = ½p² + V(q), V(q) = U, inside the ellipse γ3² = 1 − γ1² − γ2² ≥ 0; at its
edge the orbit reverses with the other sign of γ3 and dτ < 0.  `kharlamova` is the case of a linear U, in closed form;
`quartic` has another plane, for U = b3γ3.  The others are

    U = ½(c1γ1² + c2γ2²) + λ(γ1²γ2 − γ2³/3) + μγ1²γ2²,

of which there are three choices, see `POTENTIALS`:

- quadratic, λ = μ = 0: the variables separate, and F2 = ½(I11ω1² + c2γ2²) is an integral besides E and F1, for all I11,
  I22, c1, c2.  The paper quotes this case from V. V. Kozlov.
- Hénon–Heiles, c1 = c2, μ = 0, and quartic, c1 = c2, λ = 0: for I11 = I22 the systems of these names, not integrable.

In every potential, an orbit that crosses the equator twice is periodic (`chaplygin_ball.integrable_cases`, 𝒟 = 0).
So only orbits that stay away from the equator can be chaotic, such as all those with an energy below the minimum of U
on γ1² + γ2² = 1.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.plane_section import Plane, section
from hess_mechanics.dynamics.sampling import PIXELS, sampled_orbit
from hess_mechanics.dynamics.system import Body, System, in_units_of_time
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.results import Array, Orbit, as_read_only
from hess_mechanics.rigid_body.inertia import require_comparable, require_finite, require_positive_definite
from hess_mechanics.suslov import equations

__all__ = [
    "MOST_SAMPLES",
    "POTENTIALS",
    "PlaneMotion",
    "PlaneProblem",
    "PotentialBody",
    "closure_error",
    "forbidden",
    "level_curve",
    "motion_from",
]

MOST_SAMPLES = 6000
"""Largest number of samples of an orbit in a plot."""
_EITHER_WAY = Plane((0.0, 0.0, 0.0, 0.0, 1.0), sense=0)


@dataclass(frozen=True)
class PlaneProblem(Body):
    """Base of bodies with I13 = I23 = 0, whose motion is that of a point in the plane.

    Parameters
    ----------
    I11 : float
        Moment of inertia about the first axis, I11 > 0.
    I22 : float
        Moment of inertia about the second axis, I22 > 0, in the unit of I11.

    Raises
    ------
    InvalidParameter
        If a parameter is not finite.
    NotPositiveDefinite
        If I11 ≤ 0 or I22 ≤ 0.

    References
    ----------
    `eqs03`, `Biz1360`.
    """

    I11: float
    I22: float

    def __post_init__(self) -> None:
        require_finite(**vars(self))
        require_positive_definite(self.I11, self.I22)

    @property
    def system(self) -> System:
        """The equations of motion."""
        return equations.SYSTEM

    @property
    def axes(self) -> tuple[float, float]:
        """The semi-axes √I11 along q1 and √I22 along q2 of the ellipse (`Biz1360`)."""
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
        return float(self.system.integrals(state, self.parameters)["E"])

    def q_of(self, u: Array) -> Array:
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

    def to_plane(self, states: Array) -> tuple[Array, Array]:
        """Return q and p of states.

        Parameters
        ----------
        states : ndarray of float, shape (m, 5)
            States (ω1, ω2, γ1, γ2, γ3).

        Returns
        -------
        q : ndarray of float, shape (m, 2)
            Points of the plane.
        p : ndarray of float, shape (m, 2)
            Their momenta.
        """
        return self.q_of(states[:, 2:4]), states[:, :2] * np.array(self.axes)


def closure_error(body: Body, start: Sequence[float], period: float, accuracy: Accuracy) -> float:
    """Return the distance between the start of an orbit and its state after one period.

    Parameters
    ----------
    body : Body
        The body.
    start : sequence of float, shape (d,)
        Initial state.
    period : float
        Period of the orbit, nonzero; negative: backward.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    float
        Largest absolute difference of a component.

    Raises
    ------
    InvalidParameter
        If a number is not finite or out of range, or the motion exceeds the range of double precision.
    WorkLimit
        If the motion needs too many steps, or ends.
    """
    after = solve(body, start, [period], accuracy).states[0]
    return float(np.abs(after - np.array(start)).max())


@dataclass(frozen=True)
class PotentialBody(PlaneProblem):
    """Plane problem with the potential U = ½(c1γ1² + c2γ2²) + λ(γ1²γ2 − γ2³/3) + μγ1²γ2².

    Parameters
    ----------
    I11 : float
        Moment of inertia about the first axis, I11 > 0.
    I22 : float
        Moment of inertia about the second axis, I22 > 0, in the unit of I11.
    c1, c2 : float
        Coefficients of γ1² and γ2², any finite numbers.
    cubic : float, default 0.0
        Coefficient λ, any finite number.
    quartic : float, default 0.0
        Coefficient μ, any finite number.

    Raises
    ------
    InvalidParameter
        If a parameter is not finite.
    NotPositiveDefinite
        If I11 ≤ 0 or I22 ≤ 0.
    """

    c1: float
    c2: float
    cubic: float = 0.0
    quartic: float = 0.0

    @property
    def system(self) -> System:
        """The equations of motion."""
        return SYSTEM

    @property
    def parameters(self) -> tuple[float, ...]:
        """The parameters p = (I11, I22, c1, c2, λ, μ) of the equations."""
        return tuple(vars(self).values())

    @property
    def separates(self) -> bool:
        """True if the potential is quadratic, so that F2 = ½(I11ω1² + c2γ2²) is an integral."""
        return self.cubic == self.quartic == 0.0

    def potential(self, u: Array) -> Array:
        """Return the potential U.

        Parameters
        ----------
        u : ndarray, shape (..., 2)
            Points (γ1, γ2).

        Returns
        -------
        ndarray, shape (...,)
            Values of U.
        """
        return np.asarray(potential(u[..., 0], u[..., 1], self.parameters))


POTENTIALS: Mapping[str, tuple[float, float, float, float]] = {
    "quadratic": (1.0, 0.6, 0.0, 0.0),
    "Hénon–Heiles": (1.0, 1.0, 1.0, 0.0),
    "quartic": (0.2, 0.2, 0.0, 6.0),
}
"""Coefficients c1, c2, λ, μ of one integrable potential and two that are not integrable."""


def potential(g1: Any, g2: Any, p: Sequence[Any]) -> Any:
    """Return the potential U(γ1, γ2).

    Parameters
    ----------
    g1, g2 : object
        Components γ1 and γ2: numbers, arrays or symbols.
    p : sequence, shape (6,)
        Parameters (I11, I22, c1, c2, λ, μ).

    Returns
    -------
    object
        Values of U.
    """
    _, _, c1, c2, cubic, quartic = p
    return (c1 * g1**2 + c2 * g2**2) / 2 + cubic * (g1**2 * g2 - g2**3 / 3) + quartic * (g1**2 * g2**2)


def gradient(g1: Any, g2: Any, p: Sequence[Any]) -> tuple[Any, Any]:
    """Return the derivatives ∂U/∂γ1 and ∂U/∂γ2.

    Parameters
    ----------
    g1, g2 : object
        Components γ1 and γ2: numbers, arrays or symbols.
    p : sequence, shape (6,)
        Parameters (I11, I22, c1, c2, λ, μ).

    Returns
    -------
    tuple of length 2
        The two derivatives.
    """
    _, _, c1, c2, cubic, quartic = p
    both = g1 * g2
    return (
        c1 * g1 + 2 * cubic * both + 2 * quartic * (both * g2),
        c2 * g2 + cubic * (g1**2 - g2**2) + 2 * quartic * (both * g1),
    )


def field(y: Sequence[Any], p: Sequence[Any]) -> tuple[Any, ...]:
    """Return the right-hand side of `Biz01` with this potential.

    Iω̇ = γ × ∂U/∂γ without its third component, γ̇ = γ × ω.

    Parameters
    ----------
    y : sequence, shape (5,)
        State (ω1, ω2, γ1, γ2, γ3): numbers, arrays or symbols.
    p : sequence, shape (6,)
        Parameters (I11, I22, c1, c2, λ, μ).

    Returns
    -------
    tuple of length 5
        Rates of the state.
    """
    w1, w2, g1, g2, g3 = y
    U1, U2 = gradient(g1, g2, p)
    return -g3 * U2 / p[0], g3 * U1 / p[1], -g3 * w2, g3 * w1, g1 * w2 - g2 * w1


def integrals(y: Sequence[Any], p: Sequence[Any]) -> Mapping[str, Any]:
    """Return the energy E and F1 = γ².

    Parameters
    ----------
    y : sequence, shape (5,)
        State (ω1, ω2, γ1, γ2, γ3): numbers, arrays or symbols.
    p : sequence, shape (6,)
        Parameters (I11, I22, c1, c2, λ, μ).

    Returns
    -------
    mapping of str to object
        Values of the integrals, by name.
    """
    w1, w2, g1, g2, g3 = y
    return {"E": (p[0] * w1**2 + p[1] * w2**2) / 2 + potential(g1, g2, p), "F1": g1**2 + g2**2 + g3**2}


def frequency(y: Array, p: Array) -> Array | float:
    """Return ν = √(2(T + 2 max|U|)/min(I11, I22)), an upper bound on |ω| along the motion.

    Parameters
    ----------
    y : ndarray, shape (5,) or (5, n)
        One or several states.
    p : ndarray, shape (6,)
        Parameters (I11, I22, c1, c2, λ, μ).

    Returns
    -------
    float or ndarray, shape (n,)
        The bound of each state, in rad/T.

    Raises
    ------
    NotPositiveDefinite
        If I11 ≤ 0 or I22 ≤ 0.
    InvalidParameter
        If the larger of I11 and I22 exceeds 1e20 times the smaller.
    """
    I11, I22 = p[0], p[1]
    require_comparable(I11, I22)
    square = y[2] ** 2 + y[3] ** 2 + y[4] ** 2
    # Bounds: |γ1²γ2 − γ2³/3| ≤ |γ|³/3 and γ1²γ2² ≤ |γ|⁴/4.
    largest = (
        0.5 * max(abs(p[2]), abs(p[3])) * square + abs(p[4]) / 3 * square * np.sqrt(square) + abs(p[5]) / 4 * square**2
    )
    nu: Array | float = np.sqrt((I11 * y[0] ** 2 + I22 * y[1] ** 2 + 4 * largest) / min(I11, I22))
    return nu


SYSTEM = System(
    name="plane-potential",
    title="Suslov problem on a principal axis, potential U(γ1, γ2)",
    source="section 2, equations (2.2), (2.13)",
    labels=("Biz01", "eqs03"),
    variables=("ω1", "ω2", "γ1", "γ2", "γ3"),
    parameters=("I11", "I22", "c1", "c2", "cubic", "quartic"),
    angular_velocities=2,
    field=field,
    integrals=integrals,
    frequency=frequency,
    rescale=in_units_of_time(2),
    example=((0.35, 0.45, 0.1, -0.2, 0.9746794344808963), (1.2, 1.0, 1.0, 0.8, 1.0, 0.5)),
)


def _separable_integral(body: PotentialBody, states: Array) -> Array:
    """Return F2 = ½(I11ω1² + c2γ2²), an integral if the body `separates`.

    Parameters
    ----------
    body : PotentialBody
        The body.
    states : ndarray, shape (..., 5)
        States (ω1, ω2, γ1, γ2, γ3).

    Returns
    -------
    ndarray, shape (...,)
        Values of F2.
    """
    return np.asarray(0.5 * (body.I11 * states[..., 0] ** 2 + body.c2 * states[..., 3] ** 2))


# ---- Plots ------------------------------------------------------------------------------------------------------

_ANGLE = np.linspace(0.0, 2.0 * math.pi, 241)
_ALL_ROUND = np.stack([np.cos(_ANGLE), np.sin(_ANGLE)], axis=-1)
"""Points (γ1, γ2) of the equator."""
_BISECTIONS = 32
_EDGE = 1.0 - 1e-9
"""Radius from which a point lies on the equator."""


@dataclass(frozen=True)
class PlaneMotion:
    """One motion of a plane problem, and whether it is periodic.

    Attributes
    ----------
    orbit : Orbit
        The motion at the sample times of a plot.
    energy : float
        Energy of the motion.
    period : float or None
        Period 2(t2 − t1), from the first two crossings of the equator, negative for backward motion; None if there are
        fewer within the duration.
    closure_error : float
        Distance from the start after one period; ∞ without a period.
    is_fixed_point : bool
        True if the state is an equilibrium.
    is_one_sided : bool
        True if the energy is below U everywhere on the equator, which the motion then cannot reach.
    integral : float
        Range of F2 = ½(I11ω1² + c2γ2²) along the motion, relative to the largest |F2|; round-off if F2 is an integral.
    """

    orbit: Orbit
    energy: float
    period: float | None
    closure_error: float
    is_fixed_point: bool
    is_one_sided: bool
    integral: float


def motion_from(body: PotentialBody, start: tuple[float, ...], duration: float, accuracy: Accuracy) -> PlaneMotion:
    """Return the motion from a state, sampled for a plot of the plane.

    Parameters
    ----------
    body : PotentialBody
        The body.
    start : tuple of five floats
        Initial state (ω1, ω2, γ1, γ2, γ3).
    duration : float
        Time, nonzero; negative: backward.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    PlaneMotion
        The motion.

    Raises
    ------
    InvalidParameter
        If a number is out of range.
    WorkLimit
        If the motion needs too many steps.
    """
    orbit = sampled_orbit(body, start, duration, (0.0, 0.0, *(0.5 * PIXELS,) * 3), accuracy, MOST_SAMPLES)
    fixed = not np.any(np.array(SYSTEM.field(start, body.parameters)))
    F2 = _separable_integral(body, orbit.states)
    integral = float(np.ptp(F2)) / max(float(np.abs(F2).max()), 1e-300)
    period, left = None, math.inf
    if not fixed:
        times = section(body, start, _EITHER_WAY, duration, accuracy, crossings=2).times
        if len(times) == 2:
            period = 2.0 * float(times[1] - times[0])
            left = closure_error(body, start, period, accuracy)
    energy = body.energy(start)
    one_sided = bool(np.all(body.potential(_ALL_ROUND) > energy))
    return PlaneMotion(orbit, energy, period, left, fixed, one_sided, integral)


def _radius(body: PotentialBody, value: float) -> Array:
    """Return the largest radius (n,) ≤ 1 with U ≤ value along each of `_ALL_ROUND`, where U increases outwards."""
    low, high = np.zeros(_ANGLE.size), np.ones(_ANGLE.size)
    for _ in range(_BISECTIONS):
        middle = 0.5 * (low + high)
        below = body.potential(middle[:, None] * _ALL_ROUND) <= value
        low, high = np.where(below, middle, low), np.where(below, high, middle)
    return low


def level_curve(body: PotentialBody, value: float) -> list[Array]:
    """Return the curve U = value inside γ1² + γ2² = 1, for one of the `POTENTIALS`.

    Parameters
    ----------
    body : PotentialBody
        The body.
    value : float
        Value of U.

    Returns
    -------
    list of ndarray, shape (m, 2)
        Points (γ1, γ2) of each part of the curve; empty if U ≤ value everywhere.
    """
    radius = _radius(body, value)
    cuts = np.flatnonzero(np.diff(radius < _EDGE)) + 1
    parts = np.split(radius[:, None] * _ALL_ROUND, cuts)
    return [as_read_only(part) for part in parts if len(part) > 1 and math.hypot(*part[0]) < _EDGE]


def forbidden(body: PotentialBody, energy: float) -> list[Array]:
    """Return the part of the disk where U exceeds the energy, for one of the `POTENTIALS`.

    Parameters
    ----------
    body : PotentialBody
        The body.
    energy : float
        Energy, any finite number.

    Returns
    -------
    list of ndarray, shape (482, 2)
        One closed curve of points (γ1, γ2), the equator and the inner boundary; empty if there is no such part.
    """
    radius = _radius(body, energy)
    return (
        []
        if np.all(radius >= _EDGE)
        else [as_read_only(np.concatenate([_ALL_ROUND, (radius[:, None] * _ALL_ROUND)[::-1]]))]
    )
