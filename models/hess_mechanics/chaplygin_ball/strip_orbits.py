"""Orbits of the Chaplygin ball across the strip of the (ω1, ω2) plane, from N^u to N^s, as curves for plots."""

from __future__ import annotations

import math
from collections.abc import Sequence

import numpy as np

from hess_mechanics.chaplygin_ball.energy_surface import Strip, line_of_rest
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.dynamics.ensemble import complete, ensemble
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.dynamics.shadowing import distances_to_curve
from hess_mechanics.numerics.accuracy import DRAFT, Accuracy
from hess_mechanics.numerics.results import Array, as_read_only

__all__ = ["StripOrbit", "largest_distance", "strip_orbits"]

StripOrbit = tuple[Array, int]
"""ω (m, 2), a point for each pixel of a plot of the strip, and the index of the initial state."""


def strip_orbits(body: BallBody, count: int, accuracy: Accuracy = DRAFT) -> tuple[StripOrbit, ...]:
    """Return orbits across the strip of E = 1, b = 0, nearly from N^u to N^s.

    Without a field the energy only sets the unit of time: the ω of E = h are √h times as large.

    Parameters
    ----------
    body : BallBody
        Ball with b = 0 and I13 or I23 nonzero.
    count : int
        Number of orbits; their states are spread evenly over the strip.
    accuracy : str or Level, default DRAFT
        Accuracy level.

    Returns
    -------
    tuple of StripOrbit
        The orbits.

    Raises
    ------
    InvalidParameter
        If the ball has a field, or I13 = I23 = 0.
    WorkLimit
        If the motions need too many steps.
    """
    states = Strip(body, 1.0).spread(count)
    _, eta = line_of_rest(body)
    speed = math.sqrt(2.0 / min(body.I11, body.I22))
    tick = 2.0 * 1.1 * speed / PIXELS
    times = _times(body, speed)
    there = complete(ensemble(body, states, times, accuracy)).states[:, :, :2]
    back = complete(ensemble(body, states, -times, accuracy)).states[:, :, :2]
    orbits = []
    for i in range(count):
        before, after = (_as_far_as_the_line(states[i, :2], half[i], eta, tick) for half in (back, there))
        track = np.concatenate([before[:0:-1], after])
        length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(track, axis=0), axis=1))])
        indices = np.unique(np.floor(length / tick), return_index=True)[1]
        orbits.append((as_read_only(track[indices]), int(np.searchsorted(indices, len(before) - 1))))
    return tuple(orbits)


def largest_distance(orbits: Sequence[StripOrbit], exact: Sequence[StripOrbit]) -> float:
    """Return the largest distance of points of orbits from the curves of the same orbits at higher accuracy.

    Parameters
    ----------
    orbits : sequence of StripOrbit
        Orbits of `strip_orbits`.
    exact : sequence of StripOrbit
        The same orbits at a finer level.

    Returns
    -------
    float
        The distance, in rad/T.
    """
    return float(max(distances_to_curve(one, other).max() for (one, _), (other, _) in zip(orbits, exact, strict=True)))


def _times(body: BallBody, speed: float) -> Array:
    """Return the times at which to follow the orbits; `speed` is the largest |ω|."""
    # `rate` is a lower bound on the rate of departure and arrival; the second bound limits the turns of γ.
    moment = 2.0 / float(np.sum(Strip(body, 1.0).unstable[1] ** 2))
    rate = math.hypot(body.I13, body.I23) * math.sqrt(2.0 * moment) / (body.I11 + body.D) / (body.I22 + body.D)
    end = min(10.0 / max(rate, 1e-290), 250.0 / speed)
    return np.linspace(0.0, end, int(min(1200.0, max(60.0, end * speed / 0.2))) + 1)[1:]


def _as_far_as_the_line(first: Array, others: Array, eta: Array, tick: float) -> Array:
    """Return the points of half an orbit up to the first one after which all are within a pixel of the line."""
    track = np.vstack([first, others])
    away = np.flatnonzero(np.abs(track @ eta) > tick)
    return track[: away[-1] + 2] if away.size else track[:1]
