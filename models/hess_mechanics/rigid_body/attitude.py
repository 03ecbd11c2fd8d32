"""Attitude of a body in space, from a second direction e fixed in space: ė = e × ω, as γ̇ = γ × ω for the vertical."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hess_mechanics.numerics.results import Array, frozen

__all__ = ["Attitude", "attitude_along", "contact_arc", "orthonormal", "second_directions"]


@dataclass(frozen=True)
class Attitude:
    """Attitude of a body in space along an orbit.

    Attributes
    ----------
    times : ndarray, shape (n,)
        Times.
    axes : ndarray, shape (n, 3, 3)
        The vertical γ, e and γ × e in the axes of the body, in rows, orthonormal to round-off.
    defect : float
        Estimate of their error, ≥ 0, see `orthonormal` and `attitude_along`.
    """

    times: Array
    axes: Array
    defect: float

    def in_space(self, vector: Sequence[float] | Array) -> Array:
        """Return the components of a direction of the body along γ, e and γ × e.

        Parameters
        ----------
        vector : array_like, shape (3,) or (n, 3)
            Direction in the axes of the body, the same at all times or one for each.

        Returns
        -------
        ndarray, shape (n, 3)
            Components in space.
        """
        return np.asarray(np.einsum("nij,nj->ni", self.axes, np.broadcast_to(vector, self.axes.shape[:2])))

    def every_second(self) -> Attitude:
        """Return the first, every second and the last of the samples, for a preview.

        Returns
        -------
        Attitude
            The attitude at these times.
        """
        samples = [*range(0, len(self.times) - 1, 2), len(self.times) - 1]
        return replace(self, times=frozen(self.times[samples]), axes=frozen(self.axes[samples]))


TURN = 0.1
"""Largest rotation, in radians, from one sample of `attitude_along` to the next, unless the orbit rotates faster."""
MOST_TURNS = 4000
"""Largest number of samples, besides those of the orbit."""


def attitude_along(times: Array, omega: Array, gamma: Array) -> Attitude:
    """Return the attitude of a body along an orbit, from samples of the orbit.

    The rotation between two samples is that of the Magnus expansion of fourth order, with the derivative of ω from its
    neighbours; only the turn about γ is used, because γ is known.  The result has a sample for every `TURN` of
    rotation, also between those of the orbit, so that the chord of two neighbours approximates the rotation.  Its
    defect is the largest angle, in radians, between a sample of γ and the quadrature from the sample before it.

    Parameters
    ----------
    times : ndarray, shape (n,)
        Times in order.
    omega : ndarray, shape (n, 3)
        Angular velocities in the axes of the body, in rad/T.
    gamma : ndarray, shape (n, 3)
        Unit vectors γ in the axes of the body.

    Returns
    -------
    Attitude
        The attitude at more times.
    """
    (g, e, _), v, moved_g = _carried(times, omega.T, gamma.T)
    step, length = np.diff(times), _length(v)
    defect = float(np.max(np.abs(moved_g - g[:, 1:]), initial=0.0))
    # Sample the total rotation in steps of TURN; the small term avoids a division by 0 for a body at rest.
    total = np.concatenate([[0.0], np.cumsum(length + 1e-12)])
    at = np.linspace(0.0, total[-1], max(2, int(min(MOST_TURNS, np.ceil(total[-1] / TURN))) + 1))
    i = np.clip(np.searchsorted(total, at, side="right") - 1, 0, len(step) - 1)
    share = (at - total[i]) / (total[i + 1] - total[i])
    v, length = share * v[:, i], share * length[i]
    g, e = _rotate((g[:, i], e[:, i]), v, length)
    axes = np.stack([g.T, e.T, _cross(g, e).T], axis=1)
    return Attitude(frozen(times[i] + share * step[i]), frozen(axes), defect)


def second_directions(times: Array, omega: Array, gamma: Array) -> Array:
    """Return a second direction e, fixed in space, along several orbits, as `attitude_along` follows it.

    Parameters
    ----------
    times : ndarray, shape (m,)
        Times in order, the same for all orbits.
    omega : ndarray, shape (n, m, 3)
        Angular velocities in the axes of the body, in rad/T.
    gamma : ndarray, shape (n, m, 3)
        Unit vectors γ in the axes of the body.

    Returns
    -------
    ndarray, shape (n, m, 3)
        Unit vectors e in the axes of the body, orthogonal to γ.
    """
    (_, e, _), *_ = _carried(times, np.moveaxis(omega, 2, 0), np.moveaxis(gamma, 2, 0))
    return np.moveaxis(e, 0, 2)


def contact_arc(axes: Array, at: Sequence[float] | Array, e: Sequence[float] | Array) -> Array:
    """Return the arc that the contact point of a wheel has travelled on the unit sphere.

    The contact `at` has the velocity ω × at, and its component along e is (ω, at × e).

    Parameters
    ----------
    axes : ndarray, shape (n, 3, 3)
        Axes of an `Attitude`; between two samples ω is constant.
    at : array_like, shape (3,)
        Contact point in the axes of the body.
    e : array_like, shape (3,)
        Direction in which the wheel rolls.

    Returns
    -------
    ndarray, shape (n,)
        Arc from the first sample, in radians, positive towards e.
    """
    steps = axes[:-1].transpose(0, 2, 1) @ axes[1:]
    # The antisymmetric part is sin θ times the axis of the rotation.
    sine = 0.5 * np.stack([steps[:, i, j] - steps[:, j, i] for i, j in ((2, 1), (0, 2), (1, 0))], axis=1)
    length = np.linalg.norm(sine, axis=1)
    angle = np.arctan2(length, 0.5 * (np.trace(steps, axis1=1, axis2=2) - 1.0))
    arcs = angle / np.maximum(length, 1e-300) * (sine @ np.cross(at, e))
    return frozen(np.concatenate([[0.0], np.cumsum(arcs)]))


def _carried(times: Array, w: Array, gamma: Array) -> tuple[tuple[Array, Array, Array], Array, Array]:
    """Return γ, e and γ × e along orbits, the rotation of each step, and γ after it; columns (3, …, m) of ω and γ."""
    step = np.diff(times)
    slope = np.gradient(w, times, axis=-1) if len(times) > 2 else np.zeros_like(w)
    # ė = e × ω is e → exp(−v×) e over a step.
    v = 0.5 * step * (w[..., :-1] + w[..., 1:])
    v += step**2 / 12.0 * (slope[..., :-1] - slope[..., 1:] + _cross(w[..., :-1], w[..., 1:]))
    g, e, f = _frames(gamma)
    moved_g, moved_e = _rotate((g[..., :-1], e[..., :-1]), v, _length(v))
    turn = np.arctan2(_dot(moved_e, f[..., 1:]), _dot(moved_e, e[..., 1:]))
    angle = np.concatenate([np.zeros_like(turn[..., :1]), np.cumsum(turn, axis=-1)], axis=-1)
    e = np.cos(angle) * e + np.sin(angle) * f
    return (g, e, _cross(g, e)), v, moved_g


def _dot(u: Array, v: Array) -> Array:
    return np.asarray(np.einsum("k...,k...->...", u, v))


def _length(v: Array) -> Array:
    return np.asarray(np.sqrt(_dot(v, v)))


def _cross(u: Array, v: Array) -> Array:
    """Return u × v of columns (3, …); `np.cross` takes several times as long."""
    product = np.empty(u.shape)
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        np.subtract(u[i] * v[j], u[j] * v[i], out=product[k])
    return product


def _frames(gamma: Array) -> tuple[Array, Array, Array]:
    """Return for each γ of (3, …) a right-handed frame with γ as the first axis."""
    g = gamma / _length(gamma)
    smallest = np.argmin(np.abs(g), axis=0)[None]
    e = -g * np.take_along_axis(g, smallest, 0)
    np.put_along_axis(e, smallest, np.take_along_axis(e, smallest, 0) + 1.0, 0)
    e /= _length(e)
    return g, e, _cross(g, e)


def _rotate(several: tuple[Array, ...], v: Array, length: Array) -> tuple[Array, ...]:
    """Return exp(−v×) u of each of several columns u (3, …), |v| = length (…)."""
    sine, cosine = np.sinc(length / np.pi), 0.5 * np.sinc(0.5 * length / np.pi) ** 2
    crossed = [(u, _cross(u, v)) for u in several]
    return tuple(u + sine * first + cosine * _cross(first, v) for u, first in crossed)


def orthonormal(g: Array, e: Array) -> tuple[Array, float]:
    """Return right-handed orthonormal axes from γ and e, and their defect.

    Parameters
    ----------
    g : ndarray, shape (n, 3)
        Verticals γ.
    e : ndarray, shape (n, 3)
        Second direction.

    Returns
    -------
    axes : ndarray, shape (n, 3, 3)
        The axes γ, e and γ × e, in rows.
    defect : float
        Largest of ||γ| − 1|, ||e| − 1| and |(e, γ)| before.
    """
    long_g, long_e = np.linalg.norm(g, axis=1), np.linalg.norm(e, axis=1)
    defect = max(np.max(np.abs(x)) for x in (long_g - 1.0, long_e - 1.0, np.sum(g * e, axis=1)))
    g = g / long_g[:, None]
    # A second pass removes what round-off leaves along γ after the first.
    for _ in range(2):
        e = e - g * np.sum(g * e, axis=1)[:, None]
        e = e / np.linalg.norm(e, axis=1)[:, None]
    return np.stack([g, e, np.cross(g, e)], axis=1), float(defect)
