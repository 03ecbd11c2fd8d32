"""The Chaplygin ball with Suslov's constraint (`eq29`, `eq30`).

A body with the constraint ω3 = 0 along e = e3 and I12 = 0, whose spherical cavity rolls on a ball with a fixed centre,
potential (b, γ).  State y = (ω1, ω2, γ1, γ2, γ3), parameters p = (I11, I22, I13, I23, 𝒟, b1, b2, b3).
For 𝒟 = 0 this is `Biz131`.

The inverse of Î is written without a difference of large terms, for all 𝒟 ≥ 0.  With J_i = I_ii + 𝒟γ² and F the
right-hand side of `eq29`, γ̇ ⊥ ω gives

    ω̇_i = f_i + (𝒟γ²/J_i) γ_i z,   f_i = F_i/J_i,   d z = γ1 f1 + γ2 f2,   d = (I11/J1) γ1² + (I22/J2) γ2² + γ3²;

z is the rate of (ω, γ), divided by γ².
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hess_mechanics.dynamics.system import System
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.batch import one_by_one
from hess_mechanics.numerics.events import crossing_finder
from hess_mechanics.numerics.jit import inner, kernel
from hess_mechanics.numerics.results import Array
from hess_mechanics.numerics.taylor import Quadratic, orbit_integrator
from hess_mechanics.rigid_body.inertia import require_finite, require_positive_definite

__all__ = ["SYSTEM", "BallBody"]


@dataclass(frozen=True)
class BallBody:
    """Inertia tensor of the body, 𝒟 = (R/R_s)² I_s of the ball inside it, and b.

    Raises `InvalidParameter` (not finite, 𝒟 < 0), `NotPositiveDefinite`.
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
    def parameters(self) -> tuple[float, ...]:
        """p = (I11, I22, I13, I23, 𝒟, b1, b2, b3)."""
        return (self.I11, self.I22, self.I13, self.I23, self.D, self.b1, self.b2, self.b3)


def _require_not_negative(D: float) -> None:
    if D < 0:
        raise InvalidParameter(f"𝒟 = {D:g}, but it is the ball's moment of inertia times a square: choose 𝒟 ≥ 0.")


def field(y: Sequence[Any], p: Sequence[Any]) -> tuple[Any, ...]:
    """The right-hand side of `eq29`, solved for ω̇ by Cramer's rule."""
    w1, w2, g1, g2, g3 = y
    I11, I22, I13, I23, D, b1, b2, b3 = p
    s = I13 * w1 + I23 * w2
    F1, F2 = -s * w2 + b3 * g2 - b2 * g3, s * w1 + b1 * g3 - b3 * g1
    A11, A12, A22 = I11 + D * (g2**2 + g3**2), -D * g1 * g2, I22 + D * (g1**2 + g3**2)
    det = determinant((g1, g2, g3), p)
    return (
        (A22 * F1 - A12 * F2) / det,
        (A11 * F2 - A12 * F1) / det,
        -g3 * w2,
        g3 * w1,
        g1 * w2 - g2 * w1,
    )


def determinant(gamma: Sequence[Any], p: Sequence[Any]) -> Any:
    """det Î of `eq29`, multiplied out."""
    g1, g2, g3 = gamma
    I11, I22, D = p[0], p[1], p[4]
    return I11 * I22 + D * (I11 * (g1**2 + g3**2) + I22 * (g2**2 + g3**2) + D * g3**2 * (g1**2 + g2**2 + g3**2))


def kinetic_energy(y: Sequence[Any], p: Sequence[Any]) -> Any:
    """½(Îω, ω) of `eq30`, as a sum of squares."""
    w1, w2, g1, g2, g3 = y
    I11, I22, D = p[0], p[1], p[4]
    return (I11 * w1**2 + I22 * w2**2 + D * ((g1 * w2 - g2 * w1) ** 2 + g3**2 * (w1**2 + w2**2))) / 2


def integrals(y: Sequence[Any], p: Sequence[Any]) -> Mapping[str, Any]:
    """Energy E and F1 = γ² (`eq30`)."""
    _, _, g1, g2, g3 = y
    b1, b2, b3 = p[5:]
    return {
        "E": kinetic_energy(y, p) + (b1 * g1 + b2 * g2 + b3 * g3),
        "F1": g1**2 + g2**2 + g3**2,
    }


_MAX_RATIO = 1e20
"""Beyond this ratio the slow motion is lost in round-off, in units of the fast one."""


def frequency(y: Array, p: Array) -> Array | float:
    """ν = √(2(E+|b||γ|)/min(I11, I22)) of a state (5,) or many (5, n): no angular velocity of the motion exceeds it.

    Raises `NotPositiveDefinite`, `InvalidParameter`.
    """
    I11, I22, D = p[0], p[1], p[4]
    require_positive_definite(I11, I22)
    _require_not_negative(D)
    smallest = min(I11, I22)
    if not 1.0 / _MAX_RATIO <= I11 / I22 <= _MAX_RATIO:
        raise InvalidParameter(f"The moments I11 and I22 are too different: choose a ratio below {_MAX_RATIO:g}.")
    length = np.sqrt(y[2] ** 2 + y[3] ** 2 + y[4] ** 2)
    if not np.all(D / smallest * length**2 <= _MAX_RATIO):
        raise InvalidParameter(f"𝒟 is too large: choose it below {_MAX_RATIO:g} times I11 and I22.")
    return np.sqrt(2 * (kinetic_energy(y, p) + 2 * math.hypot(*p[5:]) * length) / smallest)


def rescale(y: Array, p: Array, nu: float) -> tuple[Array, Array]:
    """Time in units of 1/ν: ω → ω/ν, b → b/ν²."""
    y, p = y.copy(), p.copy()
    y[:2] /= nu
    p[5:] /= nu * nu
    return y, p


_TINY = 1e-300


@inner
def constants(y, p):
    """What stays the same during a step: 1/J1, 1/J2, 𝒟γ² (γ² is an integral) and 1/d at its start."""
    _, _, g1, g2, g3 = y
    I11, I22, _, _, D, _, _, _ = p
    added = D * (g1 * g1 + g2 * g2 + g3 * g3)
    inverse1, inverse2 = 1.0 / (I11 + added), 1.0 / (I22 + added)
    d = I11 * inverse1 * g1 * g1 + I22 * inverse2 * g2 * g2 + g3 * g3
    # For γ = 0, where Î is diagonal, z = 0.
    return inverse1, inverse2, added, 1.0 / max(d, _TINY)


@inner
def denominator_and_forces(y, q, p):
    """d, f1, f2."""
    _, _, g1, g2, g3 = y
    I11, I22, I13, I23, _, b1, b2, b3, inverse1, inverse2, _, _ = p
    w1w2, w2w2, w1w1, _, _, _, _, g1g1, g2g2, g3g3, _, _, _, _, _ = q
    return (
        I11 * inverse1 * g1g1 + I22 * inverse2 * g2g2 + g3g3,
        (b3 * g2 - b2 * g3 - I13 * w1w2 - I23 * w2w2) * inverse1,
        (b1 * g3 - b3 * g1 + I13 * w1w1 + I23 * w1w2) * inverse2,
    )


@inner
def quotient(y, q, p):
    """z from d z = γ1 f1 + γ2 f2."""
    _, _, _, _, _, _, _, _, _, _, g1f1, g2f2, dz, _, _ = q
    _, _, _, _, _, _, _, _, _, _, _, inverse_d = p
    return ((g1f1 + g2f2 - dz) * inverse_d,)


@inner
def rates(y, q, p):
    """`eq29` in terms of its products."""
    _, _, _, _, _, _, f1, f2, _ = y
    _, _, _, _, _, _, _, _, inverse1, inverse2, added, _ = p
    _, _, _, g3w2, g3w1, g1w2, g2w1, _, _, _, _, _, _, g1z, g2z = q
    return (
        f1 + added * inverse1 * g1z,
        f2 + added * inverse2 * g2z,
        -g3w2,
        g3w1,
        g1w2 - g2w1,
    )


QUADRATIC = Quadratic(
    "w1 w2 g1 g2 g3",
    "w1*w2 w2*w2 w1*w1 g3*w2 g3*w1 g1*w2 g2*w1 g1*g1 g2*g2 g3*g3 g1*f1 g2*f2 d*z g1*z g2*z",
    rates,
    parameters=8,
    stages=(("d f1 f2", denominator_and_forces), ("z", quotient)),
    constants=("1/J1 1/J2 𝒟γ² 1/d", constants),
)
_orbit = orbit_integrator(QUADRATIC)
_cross = crossing_finder(QUADRATIC)


_CLOSE = 1e-11
"""A distance from the line, in units of |ω|, of which a run with the usual steps cannot say when it is left."""
_SHARE = 0.2
"""Steps are this part of the time in which the series of a motion close to the line converges."""


@inner
def _tolerance(y, p, order, tolerance):
    """The tolerance for a start y (5,) that without a field is close to the line I13ω1 + I23ω2 = 0, but not on it.

    Beside γ its distance from the line is nothing, and the steps would be too long for it: the series of 1/d has no
    part in them.  When it leaves depends on all digits of that distance.
    """
    I11, I22, I13, I23, D = p[0], p[1], p[2], p[3], p[4]
    size, speed = math.hypot(I13, I23), math.hypot(y[0], y[1])
    distance = abs(I13 * y[0] + I23 * y[1])
    if p[5] != 0.0 or p[6] != 0.0 or p[7] != 0.0 or distance == 0.0 or distance > _CLOSE * size * speed:
        return tolerance
    smallest = min(I11, I22)
    added = D * (y[2] * y[2] + y[3] * y[3] + y[4] * y[4])
    turn = _SHARE * min(math.sqrt(smallest / (smallest + added)), smallest / size)
    # γ turns uniformly, with coefficients 1/k!.
    term = 1.0
    for k in range(order):
        term *= turn / (k + 1.0)
    return min(tolerance, term)


@kernel
def orbit(y, p, times, order, tolerance, max_steps, out):
    """One orbit of `eq29`, see `orbit_integrator`."""
    return _orbit(y, p, times, order, _tolerance(y, p, order, tolerance), max_steps, out)


_ensemble = one_by_one(orbit)


@kernel
def ensemble(states, p, times, order, tolerance, max_steps, out):
    """Many orbits of `eq29`, see `one_by_one`."""
    return _ensemble(states, p, times, order, tolerance, max_steps, out)


@kernel
def cross(y, p, normal, offset, sense, end, order, tolerance, max_steps, times, states):
    """Crossings of a plane by one orbit of `eq29`, see `crossing_finder`."""
    return _cross(y, p, normal, offset, sense, end, order, _tolerance(y, p, order, tolerance), max_steps, times, states)


SYSTEM = System(
    name="ball",
    title="Chaplygin ball with Suslov's constraint",
    labels=("eq29", "eq30"),
    variables=("ω1", "ω2", "γ1", "γ2", "γ3"),
    parameters=("I11", "I22", "I13", "I23", "D", "b1", "b2", "b3"),
    field=field,
    integrals=integrals,
    frequency=frequency,
    rescale=rescale,
    orbit=orbit,
    ensemble=ensemble,
    cross=cross,
    example=((0.5, 0.8, 0.36, 0.48, 0.8), (2.0, 1.0, 0.3, 0.5, 1.0, 0.3, -0.5, 1.0)),
)
