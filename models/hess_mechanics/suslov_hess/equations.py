"""The Suslov–Hess case (`bizi1`, `bizi2`) and its reduced equations (`eq02`, `eq01`, `eq03`).

I13 = 0, I11 I22 = I22² + I23², b1 = 0, I22 b2 + I23 b3 = 0.  A rotation about Ox1 through arctan a turns the equations
of the Suslov problem into the reduced ones: state (w1, w2, n1, n2, n3), parameters (a, b).
Rotations about n3 keep E, F1 and F2, and [u, v] = a w1 u with their field u; at f = 0 a function of n is kept, so the
system is holonomic there: see models/README.md.
Corrections to the paper: b = −b3/√(I22²+I23²) without a further mg, w2 = ω2/√(1+a²), and E, F2 of `eq03` are those of
the Suslov problem divided by I11.
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hess_mechanics.dynamics.system import System, in_units_of_time
from hess_mechanics.errors import InvalidParameter, NoField
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.attitude import with_attitude
from hess_mechanics.rigid_body.inertia import BodyCheck, body_check, require_finite, require_positive_definite
from hess_mechanics.suslov.equations import SuslovBody

__all__ = ["SYSTEM", "WITH_ATTITUDE", "HessBody"]


@dataclass(frozen=True)
class HessBody:
    """A body of the Hess case by its free parameters (I22, I23, b3).

    Raises `InvalidParameter` (not finite, or so large that I11 or a overflows),
    `NotPositiveDefinite` (I22 ≤ 0).

    >>> from hess_mechanics import HessBody
    >>> HessBody(I22=2.0, I23=0.5, b3=-1.0).a
    0.25
    """

    I22: float
    I23: float
    b3: float

    def __post_init__(self) -> None:
        require_finite(**vars(self))
        require_positive_definite(1.0, self.I22)
        if not (math.isfinite(self.a) and math.isfinite(self.I11) and math.isfinite(self.b)):
            raise InvalidParameter("I22 is too small beside I23 or b3: choose I23/I22 and b3/I22 below 1e150.")

    @property
    def a(self) -> float:
        """a = I23/I22."""
        return self.I23 / self.I22

    @property
    def b(self) -> float:
        """b = −b3/√(I22² + I23²)."""
        return -self.b3 / math.hypot(self.I22, self.I23)

    @property
    def I11(self) -> float:
        """I11 = (I22² + I23²)/I22 (`bizi1`)."""
        return self.I22 + self.I23 * self.a

    @property
    def b2(self) -> float:
        """b2 = −I23 b3/I22 (`bizi2`)."""
        return -self.a * self.b3

    @property
    def suslov(self) -> SuslovBody:
        """The same body as one of the general Suslov problem."""
        return SuslovBody(self.I11, self.I22, 0.0, self.I23, 0.0, self.b2, self.b3)

    @property
    def check(self) -> BodyCheck:
        """Whether this is a rigid body: under the Hess condition (`bizi1`) for |a| < 1, with a² ≤ I33/I22 ≤ 2 − a²."""
        if abs(self.a) < 1.0:
            return body_check((self.a**2 * self.I22, (2.0 - self.a**2) * self.I22))
        return body_check(None)

    @property
    def middle_I33(self) -> float | None:
        """I33 is no parameter of the problem: this is the middle of those of a rigid body, if this may be one."""
        return None if self.check.I33 is None else 0.5 * sum(self.check.I33)

    @property
    def n3(self) -> Array:
        """The direction of n3, in units b = 1, along the axes of the body; shape (3,)."""
        return np.asarray(math.copysign(1.0, self.b) * self.turn[2], float)

    def tensor(self, I33: float) -> Array:
        """The inertia tensor (3, 3) with this I33, in the axes of (n1, n2, n3)."""
        tensor = np.array([[self.I11, 0.0, 0.0], [0.0, self.I22, self.I23], [0.0, self.I23, I33]])
        return np.asarray(self.turn @ tensor @ self.turn.T)

    @property
    def turn(self) -> Array:
        """The rotation γ → n = turn γ (`eq02`); shape (3, 3)."""
        c, s = 1.0 / math.hypot(1.0, self.a), self.a / math.hypot(1.0, self.a)
        return np.array([[1.0, 0.0, 0.0], [0.0, c, s], [0.0, -s, c]])

    @property
    def frequency_unit(self) -> float:
        """√|b|: in units b = 1 time is t√|b| and angular velocity w/√|b|.  Raises `NoField`."""
        if self.b == 0.0:
            raise NoField("b3 = 0: without a field h and f have no unit. Choose b3 other than 0.")
        return math.sqrt(abs(self.b))

    def to_reduced(self, states: Array) -> Array:
        """(ω1, ω2, γ1, γ2, γ3) → (w1, w2, n1, n2, n3) (`eq02`); shape (..., 5)."""
        w1, w2, g1, g2, g3 = np.moveaxis(np.asarray(states, float), -1, 0)
        a, r = self.a, math.hypot(1.0, self.a)
        return np.stack([w1, w2 / r, g1, (g2 + a * g3) / r, (g3 - a * g2) / r], axis=-1)

    def from_reduced(self, states: Array) -> Array:
        """The inverse of `to_reduced`."""
        w1, w2, n1, n2, n3 = np.moveaxis(np.asarray(states, float), -1, 0)
        a, r = self.a, math.hypot(1.0, self.a)
        return np.stack([w1, w2 * r, n1, (n2 - a * n3) / r, (n3 + a * n2) / r], axis=-1)

    def in_units_of_b(self, reduced: Array) -> Array:
        """Reduced states (..., 5) with this b → with b = 1.  For b < 0 the vertical is reversed too, n → −n."""
        nu = self.frequency_unit
        sign = math.copysign(1.0, self.b)
        return np.multiply(reduced, [1 / nu, 1 / nu, sign, sign, sign])

    def from_units_of_b(self, reduced: Array) -> Array:
        """The inverse of `in_units_of_b`."""
        nu = self.frequency_unit
        sign = math.copysign(1.0, self.b)
        return np.multiply(reduced, [nu, nu, sign, sign, sign])


def field(y: Sequence[Any], p: Sequence[Any]) -> tuple[Any, ...]:
    """The right-hand side of the reduced equations (`eq01`)."""
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
    """Energy E, F1 = n², area integral F2 = w1 n1 + w2 n2 (`eq03`)."""
    w1, w2, n1, n2, n3 = y
    _, b = p
    return {
        "E": (w1**2 + w2**2) / 2 - b * n3,
        "F1": n1**2 + n2**2 + n3**2,
        "F2": w1 * n1 + w2 * n2,
    }


def frequency(y: Array, p: Array) -> Array | float:
    """ν = √(w² + 4|b||n|) of a state (5,) or many (5, n): no |w| of the motion exceeds it."""
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

WITH_ATTITUDE = with_attitude(SYSTEM)
"""`eq01`, ω = (w1, w2, −a w2), with e: state (w1, w2, n1, n2, n3, e1, e2, e3)."""
