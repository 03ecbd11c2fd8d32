"""The Suslov problem with e on a principal axis, I13 = I23 = 0, in conformally Hamiltonian form (`Biz135`, `Biz133`).

The vector field is γ3 P ∇E with a Poisson structure P: Hamiltonian in the time τ, dτ = γ3 dt.  It conserves the
standard measure (its divergence is 0), in τ the measure γ3 dω dγ.  The case b3 = 0 is `kharlamova`, the
case b1 = b2 = 0 is `quartic`; for general b the motion is chaotic, without attractors.

On the equator γ3 = 0 two of the brackets are infinite and τ reverses, while the motion itself is regular.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.results import Array, Orbit, as_read_only
from hess_mechanics.suslov.equations import SYSTEM, SuslovBody

__all__ = ["Conformal", "conformal", "divergence", "energy_gradient", "poisson_matrix"]


def poisson_matrix(y: Sequence[Any], p: Sequence[Any]) -> tuple[tuple[Any, ...], ...]:
    """Return the Poisson brackets {x_i, x_j} of x = (ω1, ω2, γ1, γ2, γ3) (`Biz133`).

    The matrix has rank 4 and is singular on the equator γ3 = 0.

    Parameters
    ----------
    y : sequence, shape (5,)
        State (ω1, ω2, γ1, γ2, γ3): numbers, arrays or symbols.
    p : sequence, shape (7,)
        Parameters of a `SuslovBody`.

    Returns
    -------
    tuple, shape (5, 5)
        Rows of the matrix.
    """
    _, _, g1, g2, g3 = y
    I11, I22 = p[0], p[1]
    one = (0, 0, 0, -1 / I11, g2 / (I11 * g3))
    two = (0, 0, 1 / I22, 0, -g1 / (I22 * g3))
    return one, two, (0, -two[2], 0, 0, 0), (-one[3], 0, 0, 0, 0), (-one[4], -two[4], 0, 0, 0)


def energy_gradient(y: Sequence[Any], p: Sequence[Any]) -> tuple[Any, ...]:
    """Return the gradient ∇E of the energy (`Biz11`).

    Parameters
    ----------
    y : sequence, shape (5,)
        State (ω1, ω2, γ1, γ2, γ3): numbers, arrays or symbols.
    p : sequence, shape (7,)
        Parameters of a `SuslovBody`.

    Returns
    -------
    tuple of length 5
        Derivatives of E with respect to the state.
    """
    return (p[0] * y[0], p[1] * y[1], p[4], p[5], p[6])


def divergence(y: Sequence[Any], p: Sequence[Any]) -> Any:
    """Return the divergence Σ ∂ẏ_i/∂y_i of the field (`Biz131`), which is 0 everywhere only for I13 = I23 = 0.

    Parameters
    ----------
    y : sequence, shape (5,)
        State (ω1, ω2, γ1, γ2, γ3): numbers, arrays or symbols.
    p : sequence, shape (7,)
        Parameters of a `SuslovBody`.

    Returns
    -------
    object
        The divergence, in 1/T.
    """
    I11, I22, I13, I23 = p[:4]
    return I23 * y[0] / I22 - I13 * y[1] / I11


@dataclass(frozen=True)
class Conformal:
    """One motion in the time t and in the conformal time τ.

    Attributes
    ----------
    orbit : Orbit
        The motion at equidistant times t.
    tau : ndarray, shape (n,)
        Conformal time τ, 0 at t = 0.
    brackets : ndarray, shape (n, 2)
        Brackets {ω1, γ3} and {ω2, γ3}; ±∞ or NaN on the equator.
    residual : float
        Largest |ẋ − γ3{x, E}| off the equator, relative to the largest |ẋ|; of the size of round-off.
    """

    orbit: Orbit
    tau: Array
    brackets: Array
    residual: float

    @property
    def turns(self) -> int:
        """Number of reversals of τ, that is, of crossings of the equator, seen in the samples."""
        sign = np.sign(self.orbit.states[:, 4])
        return int(np.count_nonzero(np.diff(sign[sign != 0.0])))


_SPACING = 0.04
"""Distance between two samples in units of 1/ν: the quadrature of γ3 is then exact to about 1e-11 of the duration."""
_MOST = 100_000


def conformal(body: SuslovBody, start: Sequence[float], duration: float, accuracy: Accuracy) -> Conformal:
    """Return a motion with its conformal time τ and its Poisson brackets (`Biz135`).

    Parameters
    ----------
    body : SuslovBody
        Body with I13 = I23 = 0.
    start : sequence of float, shape (5,)
        Initial state (ω1, ω2, γ1, γ2, γ3).
    duration : float
        Time, nonzero; negative: backward.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    Conformal
        The motion at 17 to 100 001 equidistant times.

    Raises
    ------
    InvalidParameter
        If I13 or I23 is nonzero, or the duration is 0 or not finite.
    WorkLimit
        If the motion needs too many samples or steps.
    """
    if body.I13 != 0.0 or body.I23 != 0.0:
        raise InvalidParameter("The conformally Hamiltonian form needs I13 = I23 = 0: set these to 0.")
    if not (math.isfinite(duration) and duration != 0.0):
        raise InvalidParameter(f"The time span is {duration:g}: choose a finite nonzero number.")
    p = body.parameters
    nu = float(SYSTEM.frequency(np.array(start, float), np.array(p)))
    pairs = max(8.0, abs(duration) * nu / (2.0 * _SPACING))
    if not pairs <= _MOST / 2:
        raise WorkLimit(f"The motion needs more than {_MOST} samples: choose a shorter time span.")
    orbit = solve(body, start, np.linspace(0.0, duration, 2 * math.ceil(pairs) + 1), accuracy)
    y = list(orbit.states.T)
    g3, rates, step = y[4], np.array(SYSTEM.field(y, p)), orbit.times[1]
    # Interpolate γ3 by cubic Hermite polynomials.
    pieces = 0.5 * step * (g3[1:] + g3[:-1]) + step * step / 12.0 * (rates[4, :-1] - rates[4, 1:])
    with np.errstate(divide="ignore", invalid="ignore"):
        P, gradient = poisson_matrix(y, p), energy_gradient(y, p)
        by_brackets = np.array([g3 * sum(a * b for a, b in zip(row, gradient, strict=True)) for row in P])
    residual = np.abs(by_brackets - rates)[:, g3 != 0.0].max(initial=0.0) / max(np.abs(rates).max(), 1e-300)
    tau = np.concatenate([[0.0], np.cumsum(pieces)])
    return Conformal(orbit, as_read_only(tau), as_read_only(np.stack([P[0][4], P[1][4]], axis=-1)), float(residual))
