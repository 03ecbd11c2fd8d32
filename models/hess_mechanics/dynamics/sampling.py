"""Sampling times at which the polyline through the samples of an orbit looks like the curve.

Between two samples Δt apart, a curve x(t) stays within |ẍ| Δt²/8 of its chord at every time.  This bounds the error of
the drawn line and of a point that moves along it; hence the density of samples is √(|ẍ|/(8 sagitta)).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from hess_mechanics.dynamics.orbit import LARGEST, end_of, precise_run, solve
from hess_mechanics.dynamics.system import Body, Problem
from hess_mechanics.errors import MotionEnds
from hess_mechanics.numerics.accuracy import Accuracy, Status
from hess_mechanics.numerics.results import Array, Orbit

__all__ = ["HALF_A_PIXEL", "MOST_SAMPLES", "PIXELS", "SAGITTA", "sample_times", "sampled_orbit"]

PIXELS = 600.0
"""Width, in pixels, of the pictures for which orbits are sampled; in a wider picture errors grow in proportion."""
SAGITTA = 0.25
"""Largest distance between an orbit and its chords in those pictures, in pixels."""
MOST_SAMPLES = 4000
"""Largest number of samples of one orbit in those pictures."""
HALF_A_PIXEL = 1.0 / PIXELS
"""Half a pixel where the state is O(1) and spans the picture from −1 to 1."""

_COARSE = 0.2
"""Spacing of the first pass, in units in which the fastest angular velocity is 1."""
_MOST_COARSE = 40_000
_SAMPLES_PER_STEP = 16


def sample_times(body: Body, state: Array, duration: float, weights: Array, sagitta: float, most: int) -> Array:
    """Return times at which the polyline through the states of an orbit looks like the curve.

    If the orbit cannot be computed, the times are evenly spaced, and computing the orbit at them raises the error.

    Parameters
    ----------
    body : Body
        The body.
    state : ndarray, shape (d,)
        Initial state.
    duration : float
        Time, nonzero; negative: backward.
    weights : ndarray, shape (d,)
        Pixels per unit of each variable.
    sagitta : float
        Largest distance between curve and chord, positive, in pixels.
    most : int
        Largest number of times, at least 2; if it is reached, the distance may be larger.

    Returns
    -------
    ndarray, shape (n,)
        Times from 0 to `duration`, both included.

    Raises
    ------
    InvalidParameter
        If the state does not fit the body, or a number is not finite.
    """
    problem = Problem.of(body, np.array(state, float, ndmin=2))
    count = int(min(_MOST_COARSE, max(64.0, abs(duration) * problem.nu / _COARSE))) + 1
    while True:
        even = np.linspace(0.0, duration, count)
        steps, _, states = precise_run(problem, problem.states[0], even * problem.nu)
        if steps < 0 or not np.all(np.isfinite(states)):
            return np.linspace(0.0, duration, min(most, count))
        # Short steps mean that the motion is faster than its angular velocity suggests: sample it more densely.
        needed_count = min(_MOST_COARSE, _SAMPLES_PER_STEP * steps) + 1
        if count >= needed_count:
            break
        count = needed_count
    rates = body.system.rates(states * problem.scale, body.parameters)
    accelerations = np.gradient(rates, duration / (count - 1), axis=0) * weights
    density = np.sqrt(np.linalg.norm(accelerations, axis=1) / (8.0 * sagitta))
    density = np.maximum(density, 16.0 / abs(duration))  # Take some samples of a motion at rest, too.
    needed = np.concatenate([[0.0], np.cumsum(0.5 * (density[1:] + density[:-1]) * (abs(duration) / (count - 1)))])
    samples = int(min(most - 1, np.ceil(needed[-1]))) + 1
    times = np.interp(np.linspace(0.0, needed[-1], samples), needed, even)
    times[0], times[-1] = 0.0, duration
    return times


def sampled_orbit(
    body: Body,
    start: Sequence[float],
    duration: float,
    weights: Sequence[float],
    accuracy: Accuracy,
    most: int = MOST_SAMPLES,
    max_step: float | None = None,
) -> Orbit:
    """Return an orbit at the times of `sample_times`, with the sagitta `SAGITTA`.

    A motion that ends earlier is followed up to its end, or until its variables are too large for a picture; its status
    is then INCOMPLETE, with a reason.

    Parameters
    ----------
    body : Body
        The body.
    start : sequence of float, shape (d,)
        Initial state.
    duration : float
        Time, nonzero; negative: backward.
    weights : sequence of float, shape (d,)
        Pixels per unit of each variable.
    accuracy : str or Level
        Accuracy level.
    most : int, default 4000
        Largest number of times, at least 2.
    max_step : float, optional
        Longest step, see `solve`.

    Returns
    -------
    Orbit
        The orbit.

    Raises
    ------
    InvalidParameter
        As `solve`.
    WorkLimit
        As `solve`.
    MotionEnds
        If the motion ends at its start.
    """

    def sampled(duration: float) -> Orbit:
        times = sample_times(body, np.array(start), duration, np.array(weights), SAGITTA, most)
        return solve(body, start, times, accuracy, max_step=max_step)

    try:
        return sampled(duration)
    except MotionEnds as error:
        if not abs(error.time) > 0.0:
            raise
        problem = Problem.of(body, [start])
        reason = str(end_of(problem, problem.states[0], duration * problem.nu) or error)
        return replace(sampled(_drawn_until(body, start, error.time)), status=Status.INCOMPLETE, reason=reason)


def _drawn_until(body: Body, start: Sequence[float], end: float) -> float:
    """Return the time until which a motion that ends is drawn: before its variables are too large for a picture."""
    problem = Problem.of(body, [start])
    times = np.linspace(0.0, end, _MOST_COARSE)[:-1]
    _, _, states = precise_run(problem, problem.states[0], times * problem.nu)
    large = np.abs(states).max(axis=1) > LARGEST
    return float(times[int(np.argmax(large)) if large.any() else -1])
