"""The Suslov–Hess case (`bizi1`, `bizi2`) and its reduced equations (`eq02`, `eq01`, `eq03`).

I13 = 0, I11 I22 = I22² + I23², b1 = 0, I22 b2 + I23 b3 = 0.  A rotation about Ox1 through arctan a turns the equations
of the Suslov problem into the reduced equations, with the state (w1, w2, n1, n2, n3) and the parameters (a, b).
Rotations about n3 (vector field u) conserve E, F1 and F2, and [u, v] = a w1 u for the vector field v of the system.
At f = 0 a function of n is conserved, so the system is holonomic there: see models/README.md.
Corrections to the paper: b = −b3/√(I22²+I23²) without the factor mg, w2 = ω2/√(1+a²), and E, F2 of `eq03` are those of
the Suslov problem divided by I11.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hess_mechanics.dynamics.system import System, in_units_of_time
from hess_mechanics.errors import InvalidParameter, NoField
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.inertia import BodyCheck, body_check, require_finite, require_positive_definite
from hess_mechanics.suslov.equations import SuslovBody

__all__ = ["SYSTEM", "WITH_ATTITUDE", "HessBody"]


@dataclass(frozen=True)
class HessBody:
    """Body of the Suslov–Hess case, given by its free parameters.

    Parameters
    ----------
    I22 : float
        Moment of inertia about the second axis, I22 > 0; its unit is the unit I of moments of inertia.
    I23 : float
        Product of inertia, any finite number, in units I; |I23| < I22 for a rigid body.
    b3 : float
        Third component of **b** = −mg **r**, with **r** the centre of mass; any finite number, in units I/T².

    Raises
    ------
    InvalidParameter
        If a parameter is not finite, or I11, a or b overflows.
    NotPositiveDefinite
        If I22 ≤ 0.

    References
    ----------
    `bizi1`, `bizi2`.

    Examples
    --------
    >>> from hess_mechanics import HessBody
    >>> body = HessBody(I22=2.0, I23=0.5, b3=-1.0)
    >>> body.a, body.I11, body.b2
    (0.25, 2.125, 0.25)
    """

    I22: float
    I23: float
    b3: float

    def __post_init__(self) -> None:
        require_finite(**vars(self))
        require_positive_definite(1.0, self.I22)
        if not (math.isfinite(self.a) and math.isfinite(self.I11) and math.isfinite(self.b)):
            raise InvalidParameter("I22 is too small beside I23 or b3: choose |I23|/I22 and |b3|/I22 below 1e150.")

    @property
    def a(self) -> float:
        """The inertia parameter a = I23/I22, dimensionless, of either sign."""
        return self.I23 / self.I22

    @property
    def b(self) -> float:
        """The strength of the field, b = −b3/√(I22² + I23²), of either sign or 0, in 1/T²."""
        return -self.b3 / math.hypot(self.I22, self.I23)

    @property
    def I11(self) -> float:
        """The moment of inertia I11 = (I22² + I23²)/I22 (`bizi1`), in units I."""
        return self.I22 + self.I23 * self.a

    @property
    def b2(self) -> float:
        """The second component of **b**, b2 = −I23 b3/I22 (`bizi2`), in units I/T²."""
        return -self.a * self.b3

    @property
    def suslov(self) -> SuslovBody:
        """The same body as a `SuslovBody` of the general Suslov problem."""
        return SuslovBody(self.I11, self.I22, 0.0, self.I23, 0.0, self.b2, self.b3)

    @property
    def check(self) -> BodyCheck:
        """The check for a rigid body: the Hess condition (`bizi1`) allows |a| < 1, with a² ≤ I33/I22 ≤ 2 − a²."""
        if abs(self.a) < 1.0:
            return body_check((self.a**2 * self.I22, (2.0 - self.a**2) * self.I22))
        return body_check(None)

    @property
    def middle_I33(self) -> float | None:
        """The middle of the interval of I33 of a rigid body, in units I; None if |a| ≥ 1, where there is none."""
        return None if self.check.I33 is None else 0.5 * sum(self.check.I33)

    @property
    def n3(self) -> Array:
        """The unit vector of the n3 axis in the axes of the body, shape (3,); reversed if b < 0, as in units b = 1.

        If b = 0, its sign is arbitrary.
        """
        return np.asarray(math.copysign(1.0, self.b) * self.turn[2], float)

    def tensor(self, I33: float) -> Array:
        """Return the inertia tensor in the axes of (n1, n2, n3).

        Parameters
        ----------
        I33 : float
            The third moment of inertia, positive, in units I; the equations do not contain it.

        Returns
        -------
        ndarray of float, shape (3, 3)
            The symmetric tensor.

        Examples
        --------
        >>> from hess_mechanics import HessBody
        >>> HessBody(I22=2.0, I23=0.5, b3=-1.0).tensor(2.0).round(4)
        array([[2.125 , 0.    , 0.    ],
               [0.    , 2.2353, 0.4412],
               [0.    , 0.4412, 1.7647]])
        """
        tensor = np.array([[self.I11, 0.0, 0.0], [0.0, self.I22, self.I23], [0.0, self.I23, I33]])
        return np.asarray(self.turn @ tensor @ self.turn.T)

    @property
    def turn(self) -> Array:
        """The rotation matrix of γ → n = turn γ (`eq02`); shape (3, 3)."""
        c, s = 1.0 / math.hypot(1.0, self.a), self.a / math.hypot(1.0, self.a)
        return np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]])

    @property
    def frequency_unit(self) -> float:
        """The unit of frequency √|b|: in units b = 1 time is t√|b| and angular velocity w/√|b|.

        Raises
        ------
        NoField
            If b = 0.
        """
        if self.b == 0.0:
            raise NoField("b3 = 0: without a field h and f have no unit. Choose a nonzero b3.")
        return math.sqrt(abs(self.b))

    def to_reduced(self, states: Array) -> Array:
        """Return the reduced states (w1, w2, n1, n2, n3) of states (ω1, ω2, γ1, γ2, γ3).

        Parameters
        ----------
        states : array_like of float, shape (..., 5)
            States of the Suslov problem.

        Returns
        -------
        ndarray of float, shape (..., 5)
            States of the reduced equations.

        References
        ----------
        `eq02`, with w2 = ω2/√(1 + a²).

        Examples
        --------
        >>> from hess_mechanics import HessBody
        >>> HessBody(I22=2.0, I23=0.5, b3=-1.0).to_reduced([0.1, 0.2, 0.0, 0.0, 1.0]).round(4)
        array([0.1   , 0.194 , 0.    , 0.2425, 0.9701])
        """
        w1, w2, g1, g2, g3 = np.moveaxis(np.asarray(states, float), -1, 0)
        a, r = self.a, math.hypot(1.0, self.a)
        return np.stack([w1, w2 / r, g1, (g2 + a * g3) / r, (g3 - a * g2) / r], axis=-1)

    def from_reduced(self, states: Array) -> Array:
        """Return the states (ω1, ω2, γ1, γ2, γ3) of reduced states; the inverse of `to_reduced`.

        Parameters
        ----------
        states : array_like of float, shape (..., 5)
            States (w1, w2, n1, n2, n3) of the reduced equations.

        Returns
        -------
        ndarray of float, shape (..., 5)
            States of the Suslov problem.
        """
        w1, w2, n1, n2, n3 = np.moveaxis(np.asarray(states, float), -1, 0)
        a, r = self.a, math.hypot(1.0, self.a)
        return np.stack([w1, w2 * r, n1, (n2 - a * n3) / r, (n3 + a * n2) / r], axis=-1)

    def in_units_of_b(self, reduced: Array) -> Array:
        """Return reduced states in units b = 1.

        Parameters
        ----------
        reduced : array_like of float, shape (..., 5)
            States (w1, w2, n1, n2, n3) with the b of this body.

        Returns
        -------
        ndarray of float, shape (..., 5)
            States with b = 1.  If b < 0 the vertical is reversed too, n → −n.

        Raises
        ------
        NoField
            If b = 0.
        """
        nu = self.frequency_unit
        sign = math.copysign(1.0, self.b)
        return np.multiply(reduced, [1 / nu, 1 / nu, sign, sign, sign])

    def from_units_of_b(self, reduced: Array) -> Array:
        """Return reduced states with the b of this body; the inverse of `in_units_of_b`.

        Parameters
        ----------
        reduced : array_like of float, shape (..., 5)
            States (w1, w2, n1, n2, n3) with b = 1.

        Returns
        -------
        ndarray of float, shape (..., 5)
            States with the b of this body.

        Raises
        ------
        NoField
            If b = 0.
        """
        nu = self.frequency_unit
        sign = math.copysign(1.0, self.b)
        return np.multiply(reduced, [nu, nu, sign, sign, sign])


def field(y: Sequence[Any], p: Sequence[Any]) -> tuple[Any, ...]:
    """Return the right-hand side of the reduced equations (`eq01`).

    Parameters
    ----------
    y : sequence, shape (5,)
        State (w1, w2, n1, n2, n3): numbers, arrays or symbols.
    p : sequence, shape (2,)
        Parameters (a, b).

    Returns
    -------
    tuple of length 5
        Rates of the state.
    """
    w1, w2, n1, n2, n3 = y
    a, b = p
    return (
        -a * w2**2 - b * n2,
        a * w1 * w2 + b * n1,
        -(a * n2 + n3) * w2,
        a * w2 * n1 + w1 * n3,
        n1 * w2 - n2 * w1,
    )


def integrals(y: Sequence[Any], p: Sequence[Any]) -> Mapping[str, Any]:
    """Return the energy E, F1 = n² and the area integral F2 = w1 n1 + w2 n2 (`eq03`).

    Parameters
    ----------
    y : sequence, shape (5,)
        State (w1, w2, n1, n2, n3): numbers, arrays or symbols.
    p : sequence, shape (2,)
        Parameters (a, b).

    Returns
    -------
    mapping of str to object
        Values of the integrals, by name.
    """
    w1, w2, n1, n2, n3 = y
    _, b = p
    return {
        "E": (w1**2 + w2**2) / 2 - b * n3,
        "F1": n1**2 + n2**2 + n3**2,
        "F2": w1 * n1 + w2 * n2,
    }


def frequency(y: Array, p: Array) -> Array | float:
    """Return ν = √(w² + 4|b||n|), an upper bound on |w| along the motion.

    Parameters
    ----------
    y : ndarray, shape (5,) or (5, n)
        One or several states.
    p : ndarray, shape (2,)
        Parameters (a, b).

    Returns
    -------
    float or ndarray, shape (n,)
        The bound of each state, in rad/T.
    """
    nu: Array | float = np.sqrt(y[0] ** 2 + y[1] ** 2 + 4 * abs(p[1]) * np.sqrt(y[2] ** 2 + y[3] ** 2 + y[4] ** 2))
    return nu


SYSTEM = System(
    name="hess",
    title="Suslov–Hess case, reduced",
    source="section 2, equations (2.18), (2.19)",
    labels=("eq01", "eq03"),
    variables=("w1", "w2", "n1", "n2", "n3"),
    parameters=("a", "b"),
    angular_velocities=2,
    field=field,
    integrals=integrals,
    frequency=frequency,
    rescale=in_units_of_time(1),
    example=((0.3, 0.9, 0.6, 0.0, 0.8), (0.75, 1.0)),
)


def _field_with_attitude(y: Sequence[Any], p: Sequence[Any]) -> tuple[Any, ...]:
    # A direction fixed in space obeys the equation of the vertical.
    return (*field(y[:5], p), *field((*y[:2], *y[5:]), p)[2:])


def _integrals_with_attitude(y: Sequence[Any], p: Sequence[Any]) -> Mapping[str, Any]:
    *_, n1, n2, n3, e1, e2, e3 = y
    return {**integrals(y[:5], p), "e²": e1**2 + e2**2 + e3**2, "(e,γ)": e1 * n1 + e2 * n2 + e3 * n3}


WITH_ATTITUDE = replace(
    SYSTEM,
    name="hess-attitude",
    title="Suslov–Hess case, reduced, with the attitude",
    variables=(*SYSTEM.variables, "e1", "e2", "e3"),
    field=_field_with_attitude,
    integrals=_integrals_with_attitude,
    example=((0.3, 0.9, 0.6, 0.0, 0.8, 0.0, 1.0, 0.0), (0.75, 1.0)),
)
"""`eq01` with ω = (w1, w2, −a w2) and e: state (w1, w2, n1, n2, n3, e1, e2, e3)."""
