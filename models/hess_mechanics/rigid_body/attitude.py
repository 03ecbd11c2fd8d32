"""Attitude of a body in space, from a second direction e fixed in space: ė = e × ω, as γ̇ = γ × ω for the vertical."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hess_mechanics.numerics.results import Array, as_read_only
from hess_mechanics.rigid_body.attitude_kernels import carry, rotate

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
        Estimate of the error of the axes, ≥ 0, see `orthonormal` and `attitude_along`.
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

    def thin(self) -> Attitude:
        """Return the first, every second and the last of the samples, for a preview.

        Returns
        -------
        Attitude
            The attitude at these times.
        """
        samples = [*range(0, len(self.times) - 1, 2), len(self.times) - 1]
        return replace(self, times=as_read_only(self.times[samples]), axes=as_read_only(self.axes[samples]))


TURN = 0.1
"""Largest rotation, in radians, from one sample of `attitude_along` to the next, unless `MAX_TURNS` is reached."""
MAX_TURNS = 4000
"""Largest number of intervals between the samples of `attitude_along`."""


def attitude_along(times: Array, omega: Array, gamma: Array) -> Attitude:
    """Return the attitude of a body along an orbit, from samples of the orbit.

    The rotation between two samples is that of the Magnus expansion of fourth order, with the derivative of ω from its
    neighbours; only the turn about γ is used, because γ is known.  The samples of the result are equal angles of
    rotation apart, of `TURN` at most, so that the chord of two neighbours approximates the rotation; long orbits have
    `MAX_TURNS` steps of a larger angle.  The defect is the largest difference in a component between a sample of γ and
    the rotated sample before it.

    Parameters
    ----------
    times : ndarray, shape (n,)
        Times in order, n ≥ 2.
    omega : ndarray, shape (n, 3)
        Angular velocities in the axes of the body, in rad/T.
    gamma : ndarray, shape (n, 3)
        Unit vectors γ in the axes of the body.

    Returns
    -------
    Attitude
        The attitude at other times, from the first to the last one given.
    """
    e, v, moved = (found[0] for found in _carry_orbits(times, omega[None], gamma[None]))
    g = gamma / np.linalg.norm(gamma, axis=1)[:, None]
    step, length = np.diff(times), np.linalg.norm(v, axis=1)
    defect = float(np.max(np.abs(moved - g[1:]), initial=0.0))
    # Sample the total rotation in steps of TURN; the small term avoids a division by 0 for a body at rest.
    total = np.concatenate([[0.0], np.cumsum(length + 1e-12)])
    at = np.linspace(0.0, total[-1], max(2, int(min(MAX_TURNS, np.ceil(total[-1] / TURN))) + 1))
    i = np.clip(np.searchsorted(total, at, side="right") - 1, 0, len(step) - 1)
    share = (at - total[i]) / (total[i + 1] - total[i])
    g, e = (_rotated(one[i], share[:, None] * v[i]) for one in (g, e))
    axes = np.stack([g, e, np.cross(g, e)], axis=1)
    return Attitude(as_read_only(times[i] + share * step[i]), as_read_only(axes), defect)


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
    return _carry_orbits(times, omega, gamma)[0]


def contact_arc(axes: Array, at: Sequence[float] | Array, e: Sequence[float] | Array) -> Array:
    """Return the arc that the contact point of a wheel has travelled on the unit sphere.

    The contact `at` has the velocity ω × at, whose component along e is (ω, at × e).

    Parameters
    ----------
    axes : ndarray, shape (n, 3, 3)
        Axes of an `Attitude`; ω is taken as constant between two samples.
    at : array_like, shape (3,)
        Contact point in the axes of the body, a unit vector.
    e : array_like, shape (3,)
        Direction in which the wheel rolls, a unit vector in the axes of the body.

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
    return as_read_only(np.concatenate([[0.0], np.cumsum(arcs)]))


def _carry_orbits(times: Array, omega: Array, gamma: Array) -> tuple[Array, Array, Array]:
    """Return e, the rotation of each step, and γ after it, of several orbits, see `carry`."""
    n, m, _ = gamma.shape
    e, v, moved = np.empty((n, m, 3)), np.empty((n, m - 1, 3)), np.empty((n, m - 1, 3))
    carry(*map(np.ascontiguousarray, (times, omega, gamma)), e, v, moved)
    return e, v, moved


def _rotated(u: Array, v: Array) -> Array:
    """Return exp(−v×) u for rows of u and v (n, 3)."""
    out = np.empty(u.shape)
    rotate(u, v, out)
    return out


def orthonormal(g: Array, e: Array) -> tuple[Array, float]:
    """Return right-handed orthonormal axes from γ and e, and their defect.

    Parameters
    ----------
    g : ndarray, shape (n, 3)
        Verticals γ.
    e : ndarray, shape (n, 3)
        Second directions, not parallel to γ.

    Returns
    -------
    axes : ndarray, shape (n, 3, 3)
        The axes γ, e and γ × e, in rows.
    defect : float
        Largest of ||γ| − 1|, ||e| − 1| and |(e, γ)| of the arguments.
    """
    long_g, long_e = np.linalg.norm(g, axis=1), np.linalg.norm(e, axis=1)
    defect = max(np.max(np.abs(x)) for x in (long_g - 1.0, long_e - 1.0, np.sum(g * e, axis=1)))
    g = g / long_g[:, None]
    # A second pass removes what round-off leaves along γ after the first.
    for _ in range(2):
        e = e - g * np.sum(g * e, axis=1)[:, None]
        e = e / np.linalg.norm(e, axis=1)[:, None]
    return np.stack([g, e, np.cross(g, e)], axis=1), float(defect)
