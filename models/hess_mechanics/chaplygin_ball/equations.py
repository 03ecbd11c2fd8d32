"""The Chaplygin ball with Suslov's constraint (`eq29`, `eq30`).

A body with the constraint ω3 = 0 along e = e3 and I12 = 0, whose spherical cavity rolls on a ball with a fixed centre,
in the potential (b, γ).  State y = (ω1, ω2, γ1, γ2, γ3), parameters p = (I11, I22, I13, I23, 𝒟, b1, b2, b3).
For 𝒟 = 0 this is `Biz131`.

The inverse of Î is written without a difference of large terms, for all 𝒟 ≥ 0.  With J_i = I_ii + 𝒟γ² and γ' = (γ1, γ2)
it is Î = diag(J1, J2) − 𝒟 γ' γ'ᵀ, so that for F on the right-hand side of `eq29`

    (Î⁻¹F)_i = f_i + (𝒟/J_i) γ_i z,   f_i = F_i/J_i,   z = (γ1 f1 + γ2 f2)/d,   d = det Î/(J1 J2).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hess_mechanics.dynamics.system import System, in_units_of_time
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array
from hess_mechanics.numerics.tracing import constant, positive
from hess_mechanics.rigid_body.inertia import (
    MAX_RATIO,
    require_comparable,
    require_finite,
    require_positive_definite,
)

__all__ = ["SYSTEM", "BallBody"]


@dataclass(frozen=True)
class BallBody:
    """Chaplygin ball with Suslov's constraint.

    Parameters
    ----------
    I11 : float
        Moment of inertia of the body about the first axis, I11 > 0; its unit is the unit I of all moments and products.
    I22 : float
        Moment of inertia about the second axis, I22 > 0, in units I; I11/I22 from 1e-20 to 1e20.
    I13 : float
        Product of inertia, any finite number, in units I.
    I23 : float
        Product of inertia, any finite number, in units I.
    D : float
        The constant 𝒟 = (R/R_s)² I_s of the inner ball, 𝒟 ≥ 0, in units I; 0 is the Suslov problem.
    b1 : float, optional
        First component of **b** = −mg **r**, with **r** the centre of mass; any finite number, in units I/T².
    b2 : float, optional
        Second component of **b**, any finite number, in units I/T².
    b3 : float, optional
        Third component of **b**, along the constraint; any finite number, in units I/T².

    Raises
    ------
    InvalidParameter
        If a parameter is not finite, or 𝒟 < 0.
    NotPositiveDefinite
        If I11 ≤ 0 or I22 ≤ 0.

    References
    ----------
    `eq29`, `eq30`.

    Examples
    --------
    >>> from hess_mechanics import BallBody
    >>> BallBody(2.0, 1.0, 0.3, 0.5, D=1.0).parameters
    (2.0, 1.0, 0.3, 0.5, 1.0, 0.0, 0.0, 0.0)
    """

    I11: float
    I22: float
    I13: float
    I23: float
    D: float
    b1: float = 0.0
    b2: float = 0.0
    b3: float = 0.0

    def __post_init__(self) -> None:
        require_finite(**vars(self))
        require_positive_definite(self.I11, self.I22)
        _require_not_negative(self.D)

    @property
    def system(self) -> System:
        """The equations of motion."""
        return SYSTEM

    @property
    def parameters(self) -> tuple[float, ...]:
        """The parameters p = (I11, I22, I13, I23, 𝒟, b1, b2, b3)."""
        return self.I11, self.I22, self.I13, self.I23, self.D, self.b1, self.b2, self.b3


def _require_not_negative(D: float) -> None:
    if D < 0:
        raise InvalidParameter(f"𝒟 = {D:g}, but it is the ball's moment of inertia times a square: choose 𝒟 ≥ 0.")


def field(y: Sequence[Any], p: Sequence[Any]) -> tuple[Any, ...]:
    """Return the right-hand side of `eq29`, solved for ω̇.

    Parameters
    ----------
    y : sequence, shape (5,)
        State (ω1, ω2, γ1, γ2, γ3): numbers, arrays or symbols.
    p : sequence, shape (8,)
        Parameters (I11, I22, I13, I23, 𝒟, b1, b2, b3).

    Returns
    -------
    tuple of length 5
        Rates of the state.
    """
    w1, w2, g1, g2, g3 = y
    I11, I22, I13, I23, D, b1, b2, b3 = p
    s = I13 * w1 + I23 * w2
    F = (-s * w2 + b3 * g2 - b2 * g3, s * w1 + b1 * g3 - b3 * g1)
    return (*inverse_times(F, (g1, g2, g3), I11, I22, D), -g3 * w2, g3 * w1, g1 * w2 - g2 * w1)


def inverse_times(F: Sequence[Any], gamma: Sequence[Any] | Array, I11: Any, I22: Any, D: Any) -> tuple[Any, Any]:
    """Return Î⁻¹F, see the docstring of the module.

    Parameters
    ----------
    F : sequence, shape (2,)
        Right-hand side of `eq29`.
    gamma : sequence or ndarray, shape (3,) or (3, n)
        Vertical γ.
    I11, I22 : object
        Moments of inertia, positive.
    D : object
        The constant 𝒟 ≥ 0.

    Returns
    -------
    tuple of length 2
        Components of Î⁻¹F.
    """
    g1, g2, g3 = gamma
    square = constant(g1**2 + g2**2 + g3**2)
    J1, J2 = I11 + D * square, I22 + D * square
    # Compute det Î/(J1 J2) term by term, because det Î itself may overflow.
    u1, u2, v1, v2 = I11 / J1, I22 / J2, D / J1, D / J2
    d = u1 * u2 + u1 * v2 * g1**2 + u2 * v1 * g2**2 + (u1 * v2 + u2 * v1 + v1 * v2 * square) * g3**2
    f1, f2 = F[0] / J1, F[1] / J2
    z = (g1 * f1 + g2 * f2) / positive(d)
    return f1 + v1 * (g1 * z), f2 + v2 * (g2 * z)


def determinant(gamma: Sequence[Any] | Array, p: Sequence[Any]) -> Any:
    """Return det Î of `eq29`, as a sum of terms that are not negative.

    Parameters
    ----------
    gamma : sequence or ndarray, shape (3,) or (3, n)
        Vertical γ.
    p : sequence, shape (8,)
        Parameters of the ball.

    Returns
    -------
    object
        The determinant, number or array.
    """
    g1, g2, g3 = gamma
    I11, I22, D = p[0], p[1], p[4]
    return I11 * I22 + D * (I11 * (g1**2 + g3**2) + I22 * (g2**2 + g3**2) + D * g3**2 * (g1**2 + g2**2 + g3**2))


def kinetic_energy(y: Sequence[Any] | Array, p: Sequence[Any] | Array) -> Any:
    """Return the kinetic energy ½(Îω, ω) of `eq30`, as a sum of squares.

    Parameters
    ----------
    y : sequence or ndarray, shape (5,) or (5, n)
        States (ω1, ω2, γ1, γ2, γ3).
    p : sequence or ndarray, shape (8,)
        Parameters of the ball.

    Returns
    -------
    object
        The energy, number or array.
    """
    w1, w2, g1, g2, g3 = y
    I11, I22, D = p[0], p[1], p[4]
    return (I11 * w1**2 + I22 * w2**2 + D * ((g1 * w2 - g2 * w1) ** 2 + g3**2 * (w1**2 + w2**2))) / 2


def integrals(y: Sequence[Any], p: Sequence[Any]) -> Mapping[str, Any]:
    """Return the energy E and F1 = γ² (`eq30`).

    Parameters
    ----------
    y : sequence, shape (5,)
        State (ω1, ω2, γ1, γ2, γ3): numbers, arrays or symbols.
    p : sequence, shape (8,)
        Parameters of the ball.

    Returns
    -------
    mapping of str to object
        Values of the integrals, by name.
    """
    _, _, g1, g2, g3 = y
    b1, b2, b3 = p[5:]
    return {
        "E": kinetic_energy(y, p) + (b1 * g1 + b2 * g2 + b3 * g3),
        "F1": g1**2 + g2**2 + g3**2,
    }


def frequency(y: Array, p: Array) -> Array | float:
    """Return ν = √(2(T + 2|b||γ|)/min(I11, I22)), an upper bound on |ω| along the motion; T is the kinetic energy.

    Parameters
    ----------
    y : ndarray, shape (5,) or (5, n)
        One or several states.
    p : ndarray, shape (8,)
        Parameters of the ball.

    Returns
    -------
    float or ndarray, shape (n,)
        The bound of each state, in rad/T.

    Raises
    ------
    NotPositiveDefinite
        If I11 ≤ 0 or I22 ≤ 0.
    InvalidParameter
        If the ratio of I11 and I22 is beyond 1e20, or 𝒟 is negative or too large.
    """
    I11, I22, D = p[0], p[1], p[4]
    require_comparable(I11, I22)
    _require_not_negative(D)
    smallest = min(I11, I22)
    length = np.sqrt(y[2] ** 2 + y[3] ** 2 + y[4] ** 2)
    if not np.all(D / smallest * length**2 <= MAX_RATIO):
        raise InvalidParameter(f"𝒟 is too large: choose it below {MAX_RATIO:g} times I11 and I22.")
    nu: Array | float = np.sqrt(2 * (kinetic_energy(y, p) + 2 * math.hypot(*p[5:]) * length) / smallest)
    return nu


_CLOSE = 1e-11
"""Distance from the line, in units of |ω|, below which steps of the usual size do not resolve the departure."""
_SHARE = 0.2
"""Step size close to the line, as a share of the radius of convergence of the series in time."""


def tolerance(y: Array, p: Array, order: int, default: float) -> float:
    """Return the tolerance for a start close to, but not on, the line I13ω1 + I23ω2 = 0 without a field.

    The distance from the line is tiny beside γ, so the step control would ignore it, and the series of 1/d too, and
    take steps that are too long.  The time of departure depends on all digits of that distance.

    Parameters
    ----------
    y : ndarray, shape (5,)
        Initial state.
    p : ndarray, shape (8,)
        Parameters of the ball.
    order : int
        Order of the Taylor series.
    default : float
        Tolerance of the level.

    Returns
    -------
    float
        The tolerance, at most `default`.
    """
    I11, I22, I13, I23, D = p[0], p[1], p[2], p[3], p[4]
    size, speed = math.hypot(I13, I23), math.hypot(y[0], y[1])
    distance = abs(I13 * y[0] + I23 * y[1])
    if p[5] != 0.0 or p[6] != 0.0 or p[7] != 0.0 or distance == 0.0 or distance > _CLOSE * size * speed:
        return default
    smallest = min(I11, I22)
    added = D * (y[2] * y[2] + y[3] * y[3] + y[4] * y[4])
    turn = _SHARE * min(math.sqrt(smallest / (smallest + added)), smallest / size)
    # γ rotates uniformly, with Taylor coefficients 1/k!.
    term = 1.0
    for k in range(order):
        term *= turn / (k + 1.0)
    return min(default, term)


SYSTEM = System(
    name="ball",
    title="Chaplygin ball with Suslov's constraint",
    source="section 3, equations (3.1), (3.2)",
    labels=("eq29", "eq30"),
    variables=("ω1", "ω2", "γ1", "γ2", "γ3"),
    parameters=("I11", "I22", "I13", "I23", "D", "b1", "b2", "b3"),
    angular_velocities=2,
    field=field,
    integrals=integrals,
    frequency=frequency,
    rescale=in_units_of_time(5),
    example=((0.5, 0.8, 0.36, 0.48, 0.8), (2.0, 1.0, 0.3, 0.5, 1.0, 0.3, -0.5, 1.0)),
    tolerance=tolerance,
)
