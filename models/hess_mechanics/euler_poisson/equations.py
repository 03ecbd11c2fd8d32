"""The Euler–Poisson equations of a heavy rigid body with a fixed point, and their Hess case (`hh01`, `hh001`).

State y = (M1, M2, M3, γ1, γ2, γ3): angular momentum and vertical in the principal axes of the body.
Parameters p = (a1, a2, a3, r1, r2, r3, μ): inverse moments, centre of mass, weight; ω = AM, potential −μ(r, γ).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hess_mechanics.dynamics.system import System
from hess_mechanics.errors import InvalidParameter, NotPositiveDefinite
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.inertia import MAX_RATIO, BodyCheck, require_finite

__all__ = ["SYSTEM", "HeavyBody"]


def _require_positive(symbol: str, moments: Sequence[float]) -> None:
    for i, value in enumerate(moments, 1):
        if not value > 0:
            name = f"{symbol}{i}"
            raise NotPositiveDefinite(
                f"{name} = {value:g}, but moments of inertia and their inverses are positive: choose {name} > 0."
            )
    if max(moments) / min(moments) > MAX_RATIO:
        raise InvalidParameter(f"The moments of inertia are too different: choose ratios of at most {MAX_RATIO:g}.")


@dataclass(frozen=True)
class HeavyBody:
    """Heavy rigid body with a fixed point, in its principal axes.

    Parameters
    ----------
    a : tuple of three floats
        Inverse moments of inertia a1, a2, a3 > 0, in units 1/I; their ratios are at most 1e20.
    r : tuple of three floats
        Position (r1, r2, r3) of the centre of mass in any unit, as only μr matters; any finite numbers.
    mu : float
        Weight μ, any finite number; the potential is −μ(r, γ), in units I/T².

    Raises
    ------
    InvalidParameter
        If a parameter is not finite, a or r is not a tuple of three numbers, or the moments are too different.
    NotPositiveDefinite
        If a1, a2 or a3 is not positive.

    References
    ----------
    `hh01`, `hh001`.

    Examples
    --------
    >>> from hess_mechanics import HeavyBody
    >>> HeavyBody.hess(moments=(1.0, 1.5, 2.0), strength=3.0).is_hess  # from moments and μ|r|
    True
    >>> HeavyBody(a=(1.0, 0.8, 0.5), r=(0.6, 0.0, 0.8), mu=3.0).strength  # from A = I⁻¹, r and μ
    3.0
    """

    a: tuple[float, float, float]
    r: tuple[float, float, float]
    mu: float

    def __post_init__(self) -> None:
        names = ("a1", "a2", "a3", "r1", "r2", "r3", "μ")
        for name, value in (("a", self.a), ("r", self.r)):
            if not isinstance(value, tuple) or len(value) != 3:
                raise InvalidParameter(f"{name} = {value!r} is not a tuple of three numbers: write (1.0, 1.6, 2.7).")
        require_finite(**dict(zip(names, self.parameters, strict=True)))
        _require_positive("a", self.a)

    @classmethod
    def hess(cls, moments: tuple[float, float, float], strength: float, away: float = 0.0) -> HeavyBody:
        """Return the body with these moments in the Hess case, or close to it.

        Parameters
        ----------
        moments : tuple of three floats
            Moments of inertia I1, I2, I3 with I2 between I1 and I3.
        strength : float
            The product μ|r|, any finite number, in units I/T²; |r| = 1, and r1, r3 ≥ 0 in the Hess case.
        away : float, default 0.0
            Angle in radians by which r is rotated from the direction of the Hess case, positive from Ox1 to Ox3.

        Returns
        -------
        HeavyBody
            The body.

        Raises
        ------
        InvalidParameter
            If I2 is not between I1 and I3, I1 = I3, the moments are too different, or an argument is not finite.
        NotPositiveDefinite
            If a moment is not positive.

        References
        ----------
        `gess-*1`.
        """
        require_finite(I1=moments[0], I2=moments[1], I3=moments[2], away=away)
        _require_positive("I", moments)
        a1, a2, a3 = (1.0 / moment for moment in moments)
        if not (a2 - a1) * (a3 - a2) >= 0.0 or a1 == a3:
            raise InvalidParameter(
                f"I2 = {moments[1]:g} must lie between I1 = {moments[0]:g} and I3 = {moments[2]:g}, which must differ, "
                "for the Hess condition: choose I1 ≤ I2 ≤ I3 or I1 ≥ I2 ≥ I3, and I1 ≠ I3."
            )
        angle = math.atan2(math.sqrt(abs(a3 - a2)), math.sqrt(abs(a2 - a1))) + away
        return cls((a1, a2, a3), (math.cos(angle), 0.0, math.sin(angle)), strength)

    @property
    def system(self) -> System:
        """The equations of motion."""
        return SYSTEM

    @property
    def parameters(self) -> tuple[float, ...]:
        """The parameters p = (a1, a2, a3, r1, r2, r3, μ)."""
        return (*self.a, *self.r, self.mu)

    @property
    def strength(self) -> float:
        """The product |μ||r|, the maximum of the potential."""
        return abs(self.mu) * math.hypot(*self.r)

    @property
    def hess_a(self) -> float:
        """The size √((a3 − a2)(a2 − a1))/a2 of the parameter a of the reduced equations (`eq01`) on the Hess manifold.

        It is 0 if a2 is not between a1 and a3.
        """
        a1, a2, a3 = self.a
        return math.sqrt(max(0.0, (a3 - a2) * (a2 - a1))) / a2

    @property
    def is_hess(self) -> bool:
        """True if the Hess condition (`gess-*1`) holds, to round-off for r1 and r3; also for r = 0."""
        a1, a2, a3 = self.a
        r1, r2, r3 = self.r
        if (a2 - a1) * (a3 - a2) < 0.0:
            return False
        left, right = abs(r1) * math.sqrt(abs(a3 - a2)), abs(r3) * math.sqrt(abs(a2 - a1))
        return r2 == 0.0 and abs(left - right) <= 1e-14 * (left + right)

    def integrable_at(self, f: float) -> str:
        """Return the name of the integrable case to which the motions with the area integral f belong.

        Parameters
        ----------
        f : float
            Area integral (M, γ), any finite number, in units I/T.

        Returns
        -------
        str
            The name; empty if no integrable case applies.

        Notes
        -----
        The conditions must hold exactly: μr = 0 (Euler); a_i = a_j, r along the third axis (Lagrange); a_i = a_j =
        a_k/2, r normal to it (Kovalevskaya); a_i = a_j = a_k/4, r normal to it, f = 0 (Goryachev and Chaplygin).

        Examples
        --------
        >>> from hess_mechanics import HeavyBody
        >>> HeavyBody((1.0, 1.0, 2.0), (1.0, 0.0, 0.0), 1.0).integrable_at(f=0.5)
        "Kovalevskaya's integrable case"
        """
        if self.strength == 0.0:
            return "Euler's integrable case"
        for k in range(3):
            i, j = (axis for axis in range(3) if axis != k)
            if self.a[i] != self.a[j]:
                continue
            if self.r[i] == self.r[j] == 0.0:
                return "Lagrange's integrable case"
            if self.r[k] == 0.0 and self.a[k] == 2.0 * self.a[i]:
                return "Kovalevskaya's integrable case"
            if self.r[k] == f == 0.0 and self.a[k] == 4.0 * self.a[i]:
                return "the integrable case of Goryachev and Chaplygin"
        return ""

    @property
    def check(self) -> BodyCheck:
        """The check of the triangle inequality for the moments of inertia."""
        moments = sorted(1.0 / a for a in self.a)
        if moments[2] <= (moments[0] + moments[1]) * (1 + 1e-15):
            return BodyCheck(True, None, "A rigid body: its moments satisfy the triangle inequality.")
        return BodyCheck(
            False,
            None,
            "Not a rigid body: one moment is larger than the sum of the other two. The equations are still shown.",
        )


def field(y: Sequence[Any], p: Sequence[Any]) -> tuple[Any, ...]:
    """Return the right-hand side of the equations of motion (`hh01`).

    Parameters
    ----------
    y : sequence, shape (6,)
        State (M1, M2, M3, γ1, γ2, γ3): numbers, arrays or symbols.
    p : sequence, shape (7,)
        Parameters (a1, a2, a3, r1, r2, r3, μ).

    Returns
    -------
    tuple of length 6
        Rates of the state.
    """
    M1, M2, M3, g1, g2, g3 = y
    a1, a2, a3, r1, r2, r3, mu = p
    return (
        (a3 - a2) * M2 * M3 + mu * (r2 * g3 - r3 * g2),
        (a1 - a3) * M3 * M1 + mu * (r3 * g1 - r1 * g3),
        (a2 - a1) * M1 * M2 + mu * (r1 * g2 - r2 * g1),
        a3 * g2 * M3 - a2 * g3 * M2,
        a1 * g3 * M1 - a3 * g1 * M3,
        a2 * g1 * M2 - a1 * g2 * M1,
    )


def integrals(y: Sequence[Any], p: Sequence[Any]) -> Mapping[str, Any]:
    """Return the energy H, the area integral F1 = (M, γ), and F2 = γ² (`hh001`).

    Parameters
    ----------
    y : sequence, shape (6,)
        State (M1, M2, M3, γ1, γ2, γ3): numbers, arrays or symbols.
    p : sequence, shape (7,)
        Parameters (a1, a2, a3, r1, r2, r3, μ).

    Returns
    -------
    mapping of str to object
        Values of the integrals, by name.
    """
    M1, M2, M3, g1, g2, g3 = y
    a1, a2, a3, r1, r2, r3, mu = p
    return {
        "H": (a1 * M1**2 + a2 * M2**2 + a3 * M3**2) / 2 - mu * (r1 * g1 + r2 * g2 + r3 * g3),
        "F1": M1 * g1 + M2 * g2 + M3 * g3,
        "F2": g1**2 + g2**2 + g3**2,
    }


def frequency(y: Array, p: Array) -> Array | float:
    """Return ν = √(2 max(a) (T + 2|μ||r||γ|)), an upper bound on |ω| along the motion.

    Parameters
    ----------
    y : ndarray, shape (6,) or (6, n)
        One or several states.
    p : ndarray, shape (7,)
        Parameters (a1, a2, a3, r1, r2, r3, μ).

    Returns
    -------
    float or ndarray, shape (n,)
        The bound of each state, in rad/T.

    Raises
    ------
    NotPositiveDefinite
        If a1, a2 or a3 is not positive.
    InvalidParameter
        If the ratio of two of these exceeds 1e20.
    """
    a = np.asarray(p[:3])
    _require_positive("a", a.tolist())
    kinetic = (a[0] * y[0] ** 2 + a[1] * y[1] ** 2 + a[2] * y[2] ** 2) / 2
    strength = abs(p[6]) * math.hypot(*p[3:6]) * np.sqrt(y[3] ** 2 + y[4] ** 2 + y[5] ** 2)
    nu: Array | float = np.sqrt(2 * a.max() * (kinetic + 2 * strength))
    return nu


def rescale(y: Array, p: Array, nu: float) -> tuple[Array, Array]:
    """Return state and parameters with time in units of 1/ν and moments of inertia in units of the largest.

    a → a/min(a), M → M min(a)/ν, μ → μ min(a)/ν².

    Parameters
    ----------
    y : ndarray, shape (6,) or (6, n)
        One or several states.
    p : ndarray, shape (7,)
        Parameters (a1, a2, a3, r1, r2, r3, μ).
    nu : float
        Frequency ν, positive.

    Returns
    -------
    y : ndarray
        The rescaled states, of the shape of `y`.
    p : ndarray, shape (7,)
        The rescaled parameters.
    """
    y, p = y.copy(), p.copy()
    smallest = float(p[:3].min())
    y[:3] *= smallest / nu
    p[:3] /= smallest
    p[6] *= smallest / (nu * nu)
    return y, p


def _momentum_unit(p: Array) -> float:
    """Return 1/min(a), the unit of momentum of `rescale` at ν = 1."""
    return 1.0 / float(p[:3].min())


SYSTEM = System(
    name="euler-poisson",
    title="Euler–Poisson equations",
    source="appendix, equations (3.3), (3.4)",
    labels=("hh01", "hh001"),
    variables=("M1", "M2", "M3", "γ1", "γ2", "γ3"),
    parameters=("a1", "a2", "a3", "r1", "r2", "r3", "mu"),
    angular_velocities=3,
    field=field,
    integrals=integrals,
    frequency=frequency,
    rescale=rescale,
    unit=_momentum_unit,
    example=((0.8, -0.4, 0.5, 0.36, 0.48, 0.8), (1.0, 1.25, 1.6, 0.3, -0.5, 1.0, 0.5)),
)
