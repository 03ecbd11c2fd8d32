"""The motions of a swarm, computed as one batch, and starts of the same energy."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from hess_mechanics.dynamics.ensemble import ensemble
from hess_mechanics.numerics.accuracy import STANDARD
from hess_mechanics.numerics.results import Array

if TYPE_CHECKING:
    from hess_explorer.scenes.framework.scene import Motion

ERROR = 0.5
"""Largest error of a bead, in pixels; from then on it is not drawn."""
_ASIDE, _SAFETY = 2.0**-50, 4.0
"""Relative perturbation of the starts, and the factor from the distance of the two runs to the estimated error."""
_FEW, _FIRST, _STRIDE, _TRIALS = 12, 64, 50.0, 6
"""Approximate number of motions from which the spacing of the samples is chosen; least number of samples in the first
trial, and their largest distance in pixels; largest number of trials."""


def turned_starts(motion: Motion, angles: Array) -> Array:
    """Return states whose velocity is turned, with the energy of the motion's initial state.

    The angular velocity (ω1, ω2) of states (ω1, ω2, γ) is turned in its plane.  The angular momentum M of states (M, γ)
    is turned about γ, so that (M, γ) stays the same.

    Parameters
    ----------
    motion : Motion
        The motion; the first integral of its system is quadratic in the velocity.
    angles : array (n,)
        Angles in radians.

    Returns
    -------
    array (n, d)
        The states.
    """
    state = np.array(motion.start)
    cos, sin = np.cos(angles)[:, None], np.sin(angles)[:, None]
    k = 2 if state.size == 5 else 3
    p, gamma = state[:k], state[-3:]
    fixed = np.zeros(2) if k == 2 else (p @ gamma) * gamma
    q = p - fixed
    across = np.array([-q[1], q[0]]) if k == 2 else np.cross(gamma, q)
    along = cos * q + sin * across

    def scaled(scale: float | Array) -> Array:
        found = np.tile(state, (len(angles), 1))
        found[:, :k] = fixed + scale * along
        return found

    def energy(states: Array) -> Array:
        return np.asarray(next(iter(motion.system.integrals([*states.T], motion.parameters).values())))

    # The energy is a quadratic function of the scale of the velocity: E(s) = as² + bs + E(0).
    zero, plus, minus = (energy(scaled(scale)) for scale in (0.0, 1.0, -1.0))
    a, b = 0.5 * (plus + minus) - zero, 0.5 * (plus - minus)
    goal = energy(state)
    root = np.sqrt(np.maximum(b * b + 4.0 * a * (goal - zero), 0.0))
    scale = np.divide(root - b, 2.0 * a, out=np.ones_like(a), where=a > 0.0)
    return scaled(scale[:, None])


@dataclass(frozen=True)
class SwarmMotions:
    """Motions of a swarm at evenly spaced times.

    Attributes
    ----------
    times : array (m,)
        Times of the system, of either sign.
    states : array (n, m, d)
        States.
    halfway : array (n, m − 1, d)
        States halfway between these times.
    until : array (n,)
        Index of the sample up to which each motion is right to half a pixel, a multiple of ½.
    errors : array (n,)
        Largest error of each motion over all its samples, in pixels, including those after `until`.
    """

    times: Array
    states: Array
    halfway: Array
    until: Array
    errors: Array


def _midpoints(x: Array) -> Array:
    """Return values (n, m − 1, d) halfway between evenly spaced samples (n, m, d), as "swarm.js" interpolates them."""
    before, after = 3.0 * (x[:, :1] - x[:, 1:2]) + x[:, 2:3], 3.0 * (x[:, -1:] - x[:, -2:-1]) + x[:, -3:-2]
    p = np.concatenate([before, x, after], axis=1)
    return np.asarray((9.0 * (p[:, 1:-2] + p[:, 2:-1]) - p[:, :-3] - p[:, 3:]) / 16.0)


def _interpolation_errors(states: Array, weights: Array) -> Array:
    """Return the errors (n, m − 1), in pixels, of interpolation between the even ones of samples (n, 2m − 1, d)."""
    return np.asarray((np.abs(_midpoints(states[:, ::2]) - states[:, 1::2]) * weights).max(axis=2))


def swarm_motions(
    motion: Motion, starts: tuple[tuple[float, ...], ...], most: int, period: float | None
) -> SwarmMotions:
    """Return the motions from several starts, sampled for cubic interpolation with an error below half a pixel.

    Parameters
    ----------
    motion : Motion
        System, parameters, duration of either sign, and pixels per unit of each variable; its own start is not used.
    starts : tuple of tuple
        Initial states (n, d).
    most : int
        Largest number of samples, at least 4; if they do not suffice for the whole duration, the motions are shorter.
    period : float or None
        Period that is a multiple of the sample spacing, in the time of the system; None for any spacing.

    Returns
    -------
    SwarmMotions
        The motions, each with the sample up to which it is right; the last time may lie beyond the duration.
    """
    body, weights = motion.system.at(motion.parameters), np.array(motion.weights)

    def sampled(chosen: Any, span: float, m: int) -> Any:
        return ensemble(body, chosen, np.linspace(0.0, span, 2 * m - 1), STANDARD)

    few = starts[:: max(1, len(starts) // _FEW)]
    speed = max(float(np.max(np.abs(motion.system.field(one, motion.parameters)) * weights)) for one in few)
    spacing = abs(motion.duration) / max(_FIRST, speed * abs(motion.duration) / _STRIDE)
    for _ in range(_TRIALS):
        m = max(4, min(most, 1 + round(abs(motion.duration) / spacing)))
        states = sampled(few, math.copysign((m - 1) * spacing, motion.duration), m).states
        worst = float(np.nanmax(_interpolation_errors(states, weights), initial=0.0))
        if worst <= 0.5 * ERROR:
            break
        # The error is proportional to the fourth power of a small spacing.
        spacing *= 0.9 * (0.5 * ERROR / worst) ** 0.25
    if period is not None:
        spacing = period / math.ceil(period / spacing)
    m = max(4, min(most, 1 + math.ceil(abs(motion.duration) / spacing)))
    span = math.copysign((m - 1) * spacing, motion.duration)
    found = sampled(starts, span, m)
    errors = np.repeat(found.errors[:, None] * weights.max(), 2 * m - 2, axis=1)
    loose = np.flatnonzero(~(errors[:, 0] <= 0.1 * ERROR))
    if loose.size:
        # These motions miss the bound, usually because round-off grows: estimate its growth from perturbed starts.
        others = ensemble(body, np.array(starts)[loose] * (1.0 + _ASIDE), found.times, STANDARD)
        errors[loose] = _SAFETY * (np.abs(others.states - found.states[loose]) * weights).max(axis=2)[:, 1:]
    errors += np.repeat(_interpolation_errors(found.states, weights), 2, axis=1)
    wrong = ~(errors <= ERROR)
    until = np.where(wrong.any(axis=1), 0.5 * np.argmax(wrong, axis=1), m - 1.0)
    states, halfway = (found.states[:, i::2].copy() for i in range(2))
    return SwarmMotions(found.times[::2], states, halfway, until, found.errors * weights.max())
