"""The Chaplygin ball with Suslov's constraint at a given energy, E = h (`eq30`; figures 9 and 10).

Without a field the surface E = h, F1 = 1 projects onto a strip of the (ω1, ω2) plane, between the ellipses

    σ1: 2h = I11 ω1² + I22 ω2²,   σ2: 2h = (I11+𝒟) ω1² + (I22+𝒟) ω2²

(in σ2 the paper writes mR² for 𝒟).  On the line I13 ω1 + I23 ω2 = 0 along ξ = (I23, −I13)/√(I13² + I23²) ω is
constant; every other motion goes from its half N^u, ω along +ξ, to its half N^s, ω along −ξ.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.chaplygin_ball.equations import BallBody, kinetic_energy
from hess_mechanics.errors import InvalidParameter, OutsideRegion
from hess_mechanics.numerics.arguments import as_a
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.inertia import require_finite

__all__ = ["Strip", "line_of_rest", "lowest_energy", "omega_of_energy"]

_GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0


def line_of_rest(body: BallBody) -> tuple[Array, Array]:
    """Return the directions along and across the line of equilibria, I13 ω1 + I23 ω2 = 0.

    Parameters
    ----------
    body : BallBody
        The ball.

    Returns
    -------
    xi : ndarray, shape (2,)
        Unit vector ξ = (I23, −I13)/|…| along the line.
    eta : ndarray, shape (2,)
        Unit vector η = (I13, I23)/|…| across it.

    Raises
    ------
    InvalidParameter
        If I13 = I23 = 0, so that without a field every ω is constant.
    """
    length = math.hypot(body.I13, body.I23)
    if length == 0.0:
        raise InvalidParameter("I13 = I23 = 0: there is no line of equilibria. Choose a nonzero I13 or I23.")
    along, across = body.I13 / length, body.I23 / length
    return np.array([across, -along]), np.array([along, across])


@dataclass(frozen=True)
class Strip:
    """Strip of the (ω1, ω2) plane in which a ball without a field moves at the energy h.

    Parameters
    ----------
    body : BallBody
        Ball with b = 0.
    h : float
        The energy, h > 0.

    Raises
    ------
    InvalidParameter
        If the ball has a field, or h is not positive.

    References
    ----------
    `eq30`, figure 9.

    Examples
    --------
    >>> from hess_mechanics import BallBody, Strip
    >>> strip = Strip(BallBody(2.0, 1.0, 0.3, 0.5, D=1.0), 1.0)
    >>> strip.outer.round(4), strip.inner.round(4)
    (array([1.    , 1.4142]), array([0.8165, 1.    ]))
    """

    body: BallBody
    h: float

    def __post_init__(self) -> None:
        as_a(BallBody, self.body)
        require_finite(h=self.h)
        if any(self.body.parameters[5:]):
            raise InvalidParameter("The strip between two ellipses needs a ball without a field: set b1 = b2 = b3 = 0.")
        if not self.h > 0.0:
            raise InvalidParameter(f"h = {self.h:g}, but without a field the energy is positive: choose h > 0.")

    @property
    def xi(self) -> Array:
        """The unit vector ξ (3,) along the line on which ω is constant.

        Raises
        ------
        InvalidParameter
            If I13 = I23 = 0.
        """
        return np.append(line_of_rest(self.body)[0], 0.0)

    @property
    def outer(self) -> Array:
        """The semi-axes (2,) of σ1 along ω1 and ω2."""
        return self._axes(0.0)

    @property
    def inner(self) -> Array:
        """The semi-axes (2,) of σ2 along ω1 and ω2."""
        return self._axes(self.body.D)

    def _axes(self, added: float) -> Array:
        return np.asarray(np.sqrt(2.0 * self.h / (np.array([self.body.I11, self.body.I22]) + added)))

    def _ellipse(self, angles: Sequence[float] | Array, axes: Array) -> Array:
        angles = np.asarray(angles, float)
        return np.stack([np.cos(angles), np.sin(angles)], axis=-1) * axes

    def sigma1(self, angles: Sequence[float] | Array) -> Array:
        """Return points of the outer ellipse σ1.

        Parameters
        ----------
        angles : array_like of float, shape (n,)
            Parameters α of the points, in radians.

        Returns
        -------
        ndarray of float, shape (n, 2)
            Points (√(2h/I11) cos α, √(2h/I22) sin α).
        """
        return self._ellipse(angles, self.outer)

    def sigma2(self, angles: Sequence[float] | Array) -> Array:
        """Return points of the inner ellipse σ2.

        Parameters
        ----------
        angles : array_like of float, shape (n,)
            Parameters α of the points, in radians.

        Returns
        -------
        ndarray of float, shape (n, 2)
            Points as for `sigma1`, with I + 𝒟 in place of I.
        """
        return self._ellipse(angles, self.inner)

    def spread(self, count: int) -> Array:
        """Return states with E = h whose ω are spread evenly over the strip.

        Parameters
        ----------
        count : int
            Number of states.

        Returns
        -------
        ndarray of float, shape (count, 5)
            States (ω1, ω2, γ1, γ2, γ3).
        """
        states = np.empty((count, 5))
        for i in range(count):
            angle, turn = 2.0 * math.pi * _GOLDEN * (i + 0.5), 2.0 * math.pi * math.sqrt(2.0) * i
            along = np.array([math.cos(angle), math.sin(angle), 0.0])
            # γ varies from γ ∥ ω, on σ1, to γ ⊥ ω, on σ2.
            sine = math.sqrt((i + 0.5) / count)
            across = math.cos(turn) * np.array([-along[1], along[0], 0.0]) + math.sin(turn) * np.array([0.0, 0.0, 1.0])
            gamma = math.sqrt(1.0 - sine * sine) * along + sine * across
            states[i] = *omega_of_energy(self.body, along[:2].tolist(), gamma.tolist(), self.h), *gamma
        return states

    @property
    def unstable(self) -> Array:
        """The ends of N^u on σ2 and on σ1 in the (ω1, ω2) plane, shape (2, 2).

        Raises
        ------
        InvalidParameter
            If I13 = I23 = 0.
        """
        xi, _ = line_of_rest(self.body)
        moment = self.body.I11 * xi[0] ** 2 + self.body.I22 * xi[1] ** 2
        ends: Array = np.sqrt(2.0 * self.h / np.array([[moment + self.body.D], [moment]])) * xi
        return ends

    @property
    def stable(self) -> Array:
        """The ends of N^s on σ2 and on σ1, see `unstable`."""
        return -self.unstable


def lowest_energy(body: BallBody) -> float:
    """Return −|b|, the minimum of E over states with F1 = 1: the ball at rest, its centre of mass at the bottom.

    Parameters
    ----------
    body : BallBody
        The ball.

    Returns
    -------
    float
        The lowest energy, ≤ 0.
    """
    return -math.hypot(body.b1, body.b2, body.b3)


def omega_of_energy(
    body: BallBody, direction: Sequence[float], gamma: Sequence[float], h: float
) -> tuple[float, float]:
    """Return the angular velocity along a direction that has a given energy.

    Parameters
    ----------
    body : BallBody
        The ball.
    direction : sequence of float, shape (2,)
        Direction of (ω1, ω2), nonzero.
    gamma : sequence of float, shape (3,)
        Vertical γ.
    h : float
        Energy, at least (b, γ).

    Returns
    -------
    tuple of two floats
        Angular velocity (ω1, ω2), in rad/T.

    Raises
    ------
    OutsideRegion
        If h < (b, γ).
    InvalidParameter
        If the direction is 0 or not finite.
    """
    length = math.hypot(*direction)
    if not (math.isfinite(length) and length > 0.0):
        raise InvalidParameter(f"The direction of ω has the length {length:g}: give a finite nonzero vector.")
    potential = sum(b * g for b, g in zip(body.parameters[5:], gamma, strict=True))
    if not h >= potential:
        raise OutsideRegion(f"With this γ the ball at rest has the energy {potential:.6g}: choose h above it.")
    w1, w2 = direction[0] / length, direction[1] / length
    speed = math.sqrt((h - potential) / kinetic_energy((w1, w2, *gamma), body.parameters))
    return speed * w1, speed * w2
