"""The Hess manifold of the Euler–Poisson equations in numerics: how fast orbits leave it, and how to stay on it.

On r1 M1 + r3 M3 = 0 (`g2p6f1`) the equations of a body with the Hess condition (`gess-*1`) are closed.  Off it
u = (r, M)/|r| obeys u' = −b' M2 u, so close to a motion on the manifold u grows as exp(−∫a w1 dt), with a and w1 of
`hess_isomorphism`: over a period of n3 on the stable limit cycle by the multiplier of the unstable one.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hess_mechanics.dynamics.orbit import MAX_STEPS, drift_of, require_finite_states, solve
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.errors import WorkLimit
from hess_mechanics.euler_poisson.andoyer import coordinates
from hess_mechanics.euler_poisson.equations import SYSTEM, HeavyBody
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge
from hess_mechanics.numerics.accuracy import REFERENCE, Accuracy
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.results import Array, Orbit, as_read_only
from hess_mechanics.suslov_hess.circle_map import CircleMap
from hess_mechanics.suslov_hess.equations import SYSTEM as REDUCED

__all__ = [
    "FreeRun",
    "Leak",
    "LeakGrowth",
    "SuslovDistance",
    "difference",
    "exact_growth",
    "exact_motion",
    "run_free",
]


def exact_motion(a: float, start: tuple[float, ...], duration: float, count: int) -> Orbit:
    """Return the motion of the reduced equations (`eq01`), which stays on the Hess manifold, at equidistant times.

    Parameters
    ----------
    a : float
        Inertia parameter a.
    start : tuple of five floats
        Initial state (w1, w2, n1, n2, n3), in units b = 1.
    duration : float
        Time, in units b = 1.
    count : int
        Number of times, both ends included.

    Returns
    -------
    Orbit
        The motion, in units b = 1.

    Raises
    ------
    InvalidParameter
        If a number is not finite.
    WorkLimit
        If the motion needs too many steps.
    """
    return solve(REDUCED.at((a, 1.0)), start, np.linspace(0.0, duration, count), REFERENCE)


@dataclass(frozen=True)
class FreeRun:
    """Orbit of the Euler–Poisson equations, computed once at one level, with its leak off the Hess manifold.

    Attributes
    ----------
    level : str
        Name of the accuracy level.
    times : ndarray, shape (n,)
        Times.
    states : ndarray, shape (n, 6)
        States (M1, M2, M3, γ1, γ2, γ3).
    offset : ndarray, shape (n,)
        The leak (r, M)/(|r| max |M|), 0 on the manifold.
    steps : int
        Number of steps.
    drift : mapping of str to float
        Drift of each integral, as in `Orbit`.
    """

    level: str
    times: Array
    states: Array
    offset: Array
    steps: int
    drift: Mapping[str, float]

    @cached_property
    def andoyer(self) -> Array:
        """The coordinates (l, L/G) along the orbit, shape (n, 2); l in radians."""
        return as_read_only(coordinates(self.states))


_BEFORE_HELD = 3.0
"""Largest growth of ln |(r, M)| between two projections."""
_HELD_SAMPLES = 32


def run_free(
    body: HeavyBody, start: tuple[float, ...], duration: float, count: int, accuracy: Accuracy, held: bool = False
) -> FreeRun:
    """Return an Euler–Poisson orbit from a state on the Hess manifold, computed once, at equidistant times.

    `solve` would repeat it with smaller tolerances until the leak is that of round-off.

    Parameters
    ----------
    body : HeavyBody
        Body in the Hess case.
    start : tuple of six floats
        Initial state (M1, M2, M3, γ1, γ2, γ3) on the manifold.
    duration : float
        Time, positive.
    count : int
        Number of times, both ends included.
    accuracy : str or Level
        Accuracy level.
    held : bool, default False
        Project M onto the manifold so often that the leak cannot grow.  This integrates the restriction to the manifold
        (`gess05`) in the variables and with the kernel of Euler–Poisson.

    Returns
    -------
    FreeRun
        The orbit and its leak.

    Raises
    ------
    InvalidParameter
        If a number is out of range.
    WorkLimit
        If the motion needs too many steps or projections, or exceeds the range of double precision.
    """
    level = as_level(accuracy)
    times = as_read_only(np.linspace(0.0, duration, count))
    problem = Problem.of(body, [start])
    scaled = problem.times(times)
    axis, a = np.array(body.r) / math.hypot(*body.r), body.a[1]
    # `fastest` is an upper bound on |w| of the motion on the manifold.
    fastest = math.sqrt((a * math.hypot(*start[:3])) ** 2 + 4.0 * a * body.strength)
    growth = body.hess_a * fastest * duration
    pieces = math.ceil(max((count - 1) / _HELD_SAMPLES, growth / _BEFORE_HELD)) if held else 1
    if pieces > MAX_STEPS:
        raise WorkLimit("The manifold is too unstable to stay on it over this time span: choose a shorter one.")
    edges = np.linspace(0.0, scaled[-1], pieces + 1)
    first = np.searchsorted(scaled, edges)
    out = np.empty((count, 6))
    state = problem.states[0].copy()
    total = 0
    for i in range(pieces):
        if held:
            state[:3] -= (state[:3] @ axis) * axis
        piece = np.append(scaled[first[i] : first[i + 1]], edges[i + 1]) - edges[i]
        rows = np.empty((piece.size, 6))
        longest = SYSTEM.longest_step(level, piece[-1])
        steps, _ = SYSTEM.orbit(
            state, problem.parameters, piece, level.order, level.tolerance, longest, MAX_STEPS, rows
        )
        if steps < 0:
            raise WorkLimit(f"This motion needs more than {MAX_STEPS} steps or overflows: choose a shorter time span.")
        require_finite_states(rows)
        total += steps
        out[first[i] : first[i + 1]] = rows[:-1]
        state = rows[-1].copy()
    out[first[-1] :] = state
    states = out * problem.scale
    drift = drift_of(SYSTEM, states[0], states, np.array(body.parameters))
    off = states[:, :3] @ axis / (np.linalg.norm(states[:, :3], axis=1).max() or 1.0)
    return FreeRun(level.name, times, as_read_only(states), as_read_only(off), total, drift)


@dataclass(frozen=True)
class SuslovDistance:
    """Distance of the Euler–Poisson motion from the motion of the Suslov problem.

    Attributes
    ----------
    times : ndarray, shape (n,)
        Times.
    constrained : ndarray, shape (n,)
        Distance of the motion that is held on the manifold, in units b = 1.
    free : ndarray, shape (n,)
        Distance of the motion without projection, in units b = 1.
    error : float
        Error estimate of the Suslov motion, in its own units.
    """

    times: Array
    constrained: Array
    free: Array
    error: float


def difference(bridge: Bridge, start: tuple[float, ...], duration: float, count: int) -> SuslovDistance:
    """Return the distance between the motions of a heavy body and of its Suslov body from the same state.

    Parameters
    ----------
    bridge : Bridge
        The pair of bodies.
    start : tuple of five floats
        Initial state (w1, w2, n1, n2, n3), in units b = 1.
    duration : float
        Time, in the units of the bodies.
    count : int
        Number of times, both ends included.

    Returns
    -------
    SuslovDistance
        The distance, with and without projection onto the Hess manifold.

    Raises
    ------
    InvalidParameter
        If a number is out of range.
    WorkLimit
        If a motion needs too many steps.
    """
    hess = bridge.hess
    reduced = hess.from_units_of_b(np.array(start))
    times = np.linspace(0.0, duration, count)
    orbit = solve(hess.suslov, hess.from_reduced(reduced), times, REFERENCE)
    there = hess.in_units_of_b(hess.to_reduced(orbit.states))
    heavy = tuple(bridge.from_reduced(reduced).tolist())
    held, free = (
        bridge.distance(run_free(bridge.heavy, heavy, duration, count, REFERENCE, held).states, there)
        for held in (True, False)
    )
    return SuslovDistance(as_read_only(times), as_read_only(held), as_read_only(free), orbit.error_estimate)


_STRAIGHT = (3e-14, 1e-3)
"""Range of exponential growth of the leak: below it round-off still adds to it, above it growth is nonlinear."""


@dataclass(frozen=True)
class LeakGrowth:
    """Growth of the leak off the Hess manifold, measured over some periods of n3.

    Attributes
    ----------
    per_period : float
        Growth of ln |(r, M)| per period.
    first : int
        Number of the first period measured, from 0.
    periods : int
        Number of periods measured, at least 2.
    """

    per_period: float
    first: int
    periods: int


@dataclass(frozen=True)
class Leak:
    """A free run and the exact motion from the same state.

    Attributes
    ----------
    bridge : Bridge
        The pair of bodies.
    run : FreeRun
        The free run, in the time of the bodies.
    exact : Orbit
        Motion of the reduced system at the same times, in units b = 1.
    samples : int
        Number of samples per period of n3.
    """

    bridge: Bridge
    run: FreeRun
    exact: Orbit
    samples: int

    @cached_property
    def distance(self) -> Array:
        """The distance from the exact motion, shape (n,), in units b = 1."""
        return self.bridge.distance(self.run.states, self.exact.states)

    @cached_property
    def growth(self) -> LeakGrowth | None:
        """The growth of (r, M) while it is exponential; None if that lasts less than two periods.

        It is the slope of ln |(r, M)| against the number of the period, in a least-squares fit of a straight line plus
        a periodic function.
        """
        off, samples = self.run.offset, self.samples
        rows = (off.size - 1) // samples
        table = np.abs(off[: rows * samples].reshape(rows, samples))
        low, high = _STRAIGHT
        over = np.flatnonzero(table.max(axis=1) > high)
        last = int(over[0]) if over.size else rows
        begun = np.flatnonzero(table[:last].min(axis=1) < low)
        first = int(begun[-1]) + 1 if begun.size else 0
        if last - first < 2:
            return None
        count = np.arange(last - first) - 0.5 * (last - first - 1)
        slope = float(count @ np.log(table[first:last]).mean(axis=1) / (count @ count))
        return LeakGrowth(slope, first, last - first)

    @property
    def side(self) -> tuple[int, bool]:
        """The sign of (r, M) when it becomes visible, and whether it is kept afterwards; (0, True) if it never does."""
        off = self.run.offset[np.abs(self.run.offset) > _STRAIGHT[1]]
        return (int(np.sign(off[0])), bool(np.all(off * off[0] > 0.0))) if off.size else (0, True)

    def straight_line(self, per_period: float, ends: tuple[float, float]) -> list[Array]:
        """Return a line of given growth through the middle of the exponential part of the leak.

        Parameters
        ----------
        per_period : float
            Growth of ln |(r, M)| per period of n3.
        ends : (float, float)
            Values of log10 of the leak, see `FreeRun.offset`, at both ends.

        Returns
        -------
        list of ndarray, shape (2, 2)
            Points (t, log10 of the leak) of the line; empty if there is no exponential part, or `per_period` is 0.
        """
        if self.growth is None or per_period == 0.0:
            return []
        seen = slice(self.growth.first * self.samples, (self.growth.first + self.growth.periods) * self.samples)
        t, height = (float(np.mean(one[seen])) for one in (self.run.times, np.log10(np.abs(self.run.offset))))
        period = self.run.times[-1] * self.samples / (self.run.times.size - 1)
        rate, lg = per_period / (period * math.log(10.0)), np.array(ends)
        return [np.column_stack([t + (lg - height) / rate, lg])]


def exact_growth(theta: CircleMap) -> float:
    """Return the growth of ln |(r, M)| in one period of n3 along the stable limit cycle.

    Parameters
    ----------
    theta : CircleMap
        Circle map of the torus.

    Returns
    -------
    float
        The growth, ≥ 0; 0 if the map is not hyperbolic.
    """
    return abs(theta.fixed_points[0].log_multiplier) if theta.fixed_points else 0.0
