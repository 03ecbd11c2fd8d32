"""The Suslov problem with gravity (`Biz131`, `Biz11`).

A rigid body with a fixed point, the constraint ω3 = 0 along e = e3, I12 = 0, and the potential (b, γ).
State y = (ω1, ω2, γ1, γ2, γ3), parameters p = (I11, I22, I13, I23, b1, b2, b3).
"""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hess_mechanics.dynamics.system import System, in_units_of_time
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.inertia import require_comparable, require_finite, require_positive_definite

__all__ = ["SYSTEM", "SuslovBody"]


@dataclass(frozen=True)
class SuslovBody:
    """Body of the Suslov problem: inertia tensor and field.

    Parameters
    ----------
    I11 : float
        Moment of inertia about the first axis, I11 > 0; its unit is the unit I of all moments and products.
    I22 : float
        Moment of inertia about the second axis, I22 > 0, in units I; motions need I11/I22 from 1e-20 to 1e20.
    I13 : float
        Product of inertia, any finite number, in units I.
    I23 : float
        Product of inertia, any finite number, in units I.
    b1 : float, optional
        First component of **b** = −mg **r**, with **r** the centre of mass; any finite number, in units I/T².
    b2 : float, optional
        Second component of **b**, any finite number, in units I/T².
    b3 : float, optional
        Third component of **b**, along the constraint; any finite number, in units I/T².

    Raises
    ------
    InvalidParameter
        If a parameter is not finite.
    NotPositiveDefinite
        If I11 ≤ 0 or I22 ≤ 0.

    References
    ----------
    `Biz03`, `Biz131`.

    Examples
    --------
    >>> from hess_mechanics import SuslovBody
    >>> SuslovBody(2.0, 1.0, 0.3, 0.5, b3=1.0).parameters
    (2.0, 1.0, 0.3, 0.5, 0.0, 0.0, 1.0)
    """

    I11: float
    I22: float
    I13: float
    I23: float
    b1: float = 0.0
    b2: float = 0.0
    b3: float = 0.0

    def __post_init__(self) -> None:
        require_finite(**vars(self))
        require_positive_definite(self.I11, self.I22)

    @property
    def system(self) -> System:
        """The equations of motion."""
        return SYSTEM

    @property
    def parameters(self) -> tuple[float, ...]:
        """The parameters p = (I11, I22, I13, I23, b1, b2, b3)."""
        return self.I11, self.I22, self.I13, self.I23, self.b1, self.b2, self.b3


def field(y: Sequence[Any], p: Sequence[Any]) -> tuple[Any, ...]:
    """Return the right-hand side of the equations of motion (`Biz131`).

    Parameters
    ----------
    y : sequence, shape (5,)
        State (ω1, ω2, γ1, γ2, γ3): numbers, arrays or symbols.
    p : sequence, shape (7,)
        Parameters (I11, I22, I13, I23, b1, b2, b3).

    Returns
    -------
    tuple of length 5
        Rates of the state.
    """
    w1, w2, g1, g2, g3 = y
    I11, I22, I13, I23, b1, b2, b3 = p
    s = I13 * w1 + I23 * w2
    return (
        (-w2 * s + b3 * g2 - b2 * g3) / I11,
        (w1 * s + b1 * g3 - b3 * g1) / I22,
        -g3 * w2,
        g3 * w1,
        g1 * w2 - g2 * w1,
    )


def integrals(y: Sequence[Any], p: Sequence[Any]) -> Mapping[str, Any]:
    """Return the energy E and F1 = γ² (`Biz11`).

    Parameters
    ----------
    y : sequence, shape (5,)
        State (ω1, ω2, γ1, γ2, γ3): numbers, arrays or symbols.
    p : sequence, shape (7,)
        Parameters (I11, I22, I13, I23, b1, b2, b3).

    Returns
    -------
    mapping of str to object
        Values of the integrals, by name.
    """
    w1, w2, g1, g2, g3 = y
    I11, I22, _, _, b1, b2, b3 = p
    return {
        "E": (I11 * w1**2 + I22 * w2**2) / 2 + (b1 * g1 + b2 * g2 + b3 * g3),
        "F1": g1**2 + g2**2 + g3**2,
    }


def frequency(y: Array, p: Array) -> Array | float:
    """Return ν = √(2(E+|b||γ|)/min(I11, I22)), an upper bound on |ω| along the motion.

    Parameters
    ----------
    y : ndarray, shape (5,) or (5, n)
        One or several states.
    p : ndarray, shape (7,)
        Parameters (I11, I22, I13, I23, b1, b2, b3).

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
    field_strength = math.hypot(*p[4:7]) * np.sqrt(y[2] ** 2 + y[3] ** 2 + y[4] ** 2)
    kinetic_now = (I11 * y[0] ** 2 + I22 * y[1] ** 2) / 2
    nu: Array | float = np.sqrt(2 * (kinetic_now + 2 * field_strength) / min(I11, I22))
    return nu


SYSTEM = System(
    name="suslov",
    title="Suslov problem with gravity",
    source="section 2, equations (2.4), (2.5)",
    labels=("Biz131", "Biz11"),
    variables=("ω1", "ω2", "γ1", "γ2", "γ3"),
    parameters=("I11", "I22", "I13", "I23", "b1", "b2", "b3"),
    angular_velocities=2,
    field=field,
    integrals=integrals,
    frequency=frequency,
    rescale=in_units_of_time(4),
    example=((0.8, -0.4, 0.6, 0.0, 0.8), (2.0, 1.0, 0.3, 0.5, 0.3, -0.5, 1.0)),
)
