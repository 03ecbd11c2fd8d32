"""Attitude of a body in space, from a second direction fixed in space that is followed beside the vertical.

Every direction fixed in space obeys the equation of the vertical, ė = e × ω.  So the field of a system whose last
three variables are the vertical γ is evaluated a second time with e in place of γ.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.sampling import sample_times
from hess_mechanics.dynamics.system import Body, System
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.results import Array, Orbit, frozen

__all__ = ["Attitude", "Lying", "across", "attitude", "attitude_along", "travelled", "with_attitude"]


def with_attitude(system: System) -> System:
    """Return the system with the variables e1, e2, e3 added; its last three variables must be the vertical γ.

    Its integrals include e² = 1 and (e, γ) = 0.
    """
    n = len(system.variables)

    def field(y: Sequence[Any], p: Sequence[Any]) -> tuple[Any, ...]:
        return (*system.field(y[:n], p), *system.field((*y[: n - 3], *y[n:]), p)[-3:])

    def integrals(y: Sequence[Any], p: Sequence[Any]) -> Mapping[str, Any]:
        g, e = y[n - 3 : n], y[n:]
        return {
            **system.integrals(y[:n], p),
            "e²": e[0] ** 2 + e[1] ** 2 + e[2] ** 2,
            "(e,γ)": e[0] * g[0] + e[1] * g[1] + e[2] * g[2],
        }

    def frequency(y: Array, p: Array) -> Array | float:
        return system.frequency(y[:n], p)

    def rescale(y: Array, p: Array, nu: float) -> tuple[Array, Array]:
        scaled, p = system.rescale(y[:n], p, nu)
        return np.concatenate([scaled, y[n:]]), p

    state, p = system.example
    return replace(
        system,
        name=f"{system.name}-attitude",
        title=f"{system.title}, with the attitude",
        variables=(*system.variables, "e1", "e2", "e3"),
        field=field,
        integrals=integrals,
        frequency=frequency,
        rescale=rescale,
        example=((*state, *across(state[-3:])), p),
    )


def across(vertical: Sequence[float] | Array) -> Array:
    """Return a unit vector (3,) normal to the vertical, as an arbitrary start of e."""
    return _frames(np.array(vertical, float, ndmin=2))[1][:, 0]


@dataclass(frozen=True)
class Attitude:
    """Attitude of a body in space along an orbit.

    Attributes
    ----------
    times : ndarray of float, shape (n,)
        Times.
    axes : ndarray of float, shape (n, 3, 3)
        The vertical γ, e and γ × e in the axes of the body, in rows, orthonormal to round-off.
    defect : float
        Largest deviation of γ and e from orthonormality before that correction.
    orbit : Orbit
        The computation.
    """

    times: Array
    axes: Array
    defect: float
    orbit: Orbit

    def in_space(self, vector: Sequence[float] | Array) -> Array:
        """Return the components along γ, e, γ × e (n, 3) of a direction of the body, (3,) or (n, 3)."""
        return np.asarray(np.einsum("nij,nj->ni", self.axes, np.broadcast_to(vector, self.axes.shape[:2])))


@dataclass(frozen=True)
class Lying:
    """Attitude of a body in space along an orbit, for a plot.

    times : (n,); axes : (n, 3, 3), as in `Attitude`; defect : largest angle, in radians, between a sample of γ and
    the quadrature from the sample before it.
    """

    times: Array
    axes: Array
    defect: float

    def every_second(self) -> Lying:
        """Return the first, every second and the last of the samples, for a preview."""
        kept = [*range(0, len(self.times) - 1, 2), len(self.times) - 1]
        return replace(self, times=frozen(self.times[kept]), axes=frozen(self.axes[kept]))


TURN = 0.1
"""Largest rotation, in radians, from one sample of `attitude_along` to the next, unless the orbit rotates faster."""
MOST_TURNS = 4000
"""Largest number of samples, besides those of the orbit."""


def attitude_along(times: Array, omega: Array, gamma: Array) -> Lying:
    """Return the attitude along an orbit from its samples: times (n,), ω (n, 3) and |γ| = 1 (n, 3) in axes of the body.

    The rotation between two samples is that of the Magnus expansion of fourth order, with the derivative of ω from its
    neighbours; only the turn about γ is used, because γ is known.  The result has a sample for every `TURN` of
    rotation, also between those of the orbit, so that the chord of two neighbours approximates the rotation.
    """
    w, step = omega.T, np.diff(times)
    slope = np.gradient(w, times, axis=1) if len(times) > 2 else np.zeros_like(w)
    # ė = e × ω is e → exp(−v×) e over a step.
    v = 0.5 * step * (w[:, :-1] + w[:, 1:])
    v += step**2 / 12.0 * (slope[:, :-1] - slope[:, 1:] + _cross(w[:, :-1], w[:, 1:]))
    length = np.sqrt(np.einsum("kn,kn->n", v, v))
    g, e, f = _frames(gamma)
    moved_g, moved_e = _turned((g[:, :-1], e[:, :-1]), v, length)
    defect = float(np.max(np.abs(moved_g - g[:, 1:]), initial=0.0))
    turn = np.arctan2(np.einsum("kn,kn->n", moved_e, f[:, 1:]), np.einsum("kn,kn->n", moved_e, e[:, 1:]))
    angle = np.concatenate([[0.0], np.cumsum(turn)])
    e = np.cos(angle) * e + np.sin(angle) * f
    # Sample the total rotation in steps of TURN; the small term avoids a division by 0 for a body at rest.
    turned = np.concatenate([[0.0], np.cumsum(length + 1e-12)])
    at = np.linspace(0.0, turned[-1], max(2, int(min(MOST_TURNS, np.ceil(turned[-1] / TURN))) + 1))
    i = np.clip(np.searchsorted(turned, at, side="right") - 1, 0, len(step) - 1)
    share = (at - turned[i]) / (turned[i + 1] - turned[i])
    v, length = share * v[:, i], share * length[i]
    g, e = _turned((g[:, i], e[:, i]), v, length)
    axes = np.stack([g.T, e.T, _cross(g, e).T], axis=1)
    return Lying(frozen(times[i] + share * step[i]), frozen(axes), defect)


def travelled(axes: Array, at: Sequence[float] | Array, e: Sequence[float] | Array) -> Array:
    """Return the arc (n,) that the contact point of a wheel has travelled on the unit sphere, positive towards e.

    The contact `at` has the velocity ω × at, and its component along e is (ω, at × e).

    axes : (n, 3, 3), as in `Attitude`; between two samples ω is constant.
    """
    steps = axes[:-1].transpose(0, 2, 1) @ axes[1:]
    # The antisymmetric part is sin θ times the axis of the rotation.
    sine = 0.5 * np.stack([steps[:, i, j] - steps[:, j, i] for i, j in ((2, 1), (0, 2), (1, 0))], axis=1)
    length = np.linalg.norm(sine, axis=1)
    angle = np.arctan2(length, 0.5 * (np.trace(steps, axis1=1, axis2=2) - 1.0))
    arcs = angle / np.maximum(length, 1e-300) * (sine @ np.cross(at, e))
    return frozen(np.concatenate([[0.0], np.cumsum(arcs)]))


def _cross(u: Array, v: Array) -> Array:
    """Return u × v of columns (3, n); `np.cross` takes several times as long."""
    found = np.empty(u.shape)
    for k in range(3):
        i, j = (k + 1) % 3, (k + 2) % 3
        np.subtract(u[i] * v[j], u[j] * v[i], out=found[k])
    return found


def _frames(gamma: Array) -> tuple[Array, Array, Array]:
    """Return for each γ of (n, 3) a right-handed frame with γ as the first axis, (3, n) each."""
    g = (gamma / np.linalg.norm(gamma, axis=1)[:, None]).T
    e = np.zeros_like(g)
    smallest, all_of = np.argmin(np.abs(g), axis=0), np.arange(g.shape[1])
    e[smallest, all_of] = 1.0
    e -= g * g[smallest, all_of]
    e /= np.sqrt(np.einsum("kn,kn->n", e, e))
    return g, e, _cross(g, e)


def _turned(several: tuple[Array, ...], v: Array, length: Array) -> tuple[Array, ...]:
    """Return exp(−v×) u of each of several columns u (3, n), |v| = length (n,)."""
    sine, cosine = np.sinc(length / np.pi), 0.5 * np.sinc(0.5 * length / np.pi) ** 2
    crossed = [(u, _cross(u, v)) for u in several]
    return tuple(u + sine * first + cosine * _cross(first, v) for u, first in crossed)


def attitude(
    body: Body,
    start: Sequence[float] | Array,
    duration: float,
    accuracy: Accuracy,
    weights: Sequence[float],
    sagitta: float,
    most: int,
) -> Attitude:
    """Return the attitude along the orbit of a body with an extended system from `start`, |γ| = |e| = 1, (e, γ) = 0.

    weights, sagitta, most : as for `sample_times`.  Raises `InvalidParameter`, `WorkLimit`.
    """
    state = np.asarray(start, float)
    times = sample_times(body, state, duration, np.asarray(weights), sagitta, most)
    orbit = solve(body, state, times, accuracy)
    axes, defect = _orthonormal(orbit.states[:, -6:-3], orbit.states[:, -3:])
    return Attitude(orbit.times, frozen(axes), defect, orbit)


def _orthonormal(g: Array, e: Array) -> tuple[Array, float]:
    """Return γ, e and γ × e, rows of (n, 3, 3), and the largest of | |γ|−1 |, | |e|−1 |, |(e, γ)| before."""
    long_g, long_e = np.linalg.norm(g, axis=1), np.linalg.norm(e, axis=1)
    defect = max(np.max(np.abs(x)) for x in (long_g - 1.0, long_e - 1.0, np.sum(g * e, axis=1)))
    g = g / long_g[:, None]
    # A second pass removes what round-off leaves along γ after the first.
    for _ in range(2):
        e = e - g * np.sum(g * e, axis=1)[:, None]
        e = e / np.linalg.norm(e, axis=1)[:, None]
    return np.stack([g, e, np.cross(g, e)], axis=1), float(defect)
