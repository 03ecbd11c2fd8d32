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
from hess_mechanics.numerics.results import Array, Orbit, frozen
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
    """Return the motion of `eq01` from a state (5,), units b = 1, at equidistant times: it stays on the manifold."""
    return solve(REDUCED.at((a, 1.0)), start, np.linspace(0.0, duration, count), REFERENCE)


@dataclass(frozen=True)
class FreeRun:
    """Orbit of the Euler–Poisson equations, computed once at one level, with its leak off the Hess manifold.

    times : (n,); states : (n, 6); off : (n,), (r, M)/(|r| max |M|); steps : number of steps; drift : as in `Orbit`.
    """

    level: str
    times: Array
    states: Array
    off: Array
    steps: int
    drift: Mapping[str, float]

    @cached_property
    def andoyer(self) -> Array:
        """The coordinates (l, L/G) along the orbit, (n, 2)."""
        return frozen(coordinates(self.states))


_BEFORE_HELD = 3.0
"""Largest growth of ln |(r, M)| between two projections."""
_HELD_SAMPLES = 32


def run_free(
    body: HeavyBody, start: tuple[float, ...], duration: float, count: int, accuracy: Accuracy, held: bool = False
) -> FreeRun:
    """Return the Euler–Poisson orbit from a state on the Hess manifold, at `count` even times from 0 to `duration`.

    It is computed once: `solve` would repeat it with smaller tolerances until the leak is that of round-off.
    held : if true, M is projected onto the manifold so often that the leak cannot grow.  This integrates the
    restriction to the manifold (`gess05`) in the variables and with the kernel of Euler–Poisson.
    Raises `InvalidParameter`, `WorkLimit`.
    """
    level = as_level(accuracy)
    times = frozen(np.linspace(0.0, duration, count))
    problem = Problem.of(body, [start])
    scaled = problem.times(times)
    axis, a = np.array(body.r) / math.hypot(*body.r), body.a[1]
    # |w| of the motion on the manifold is at most `fastest`.
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
        found = np.empty((piece.size, 6))
        longest = SYSTEM.longest_step(level, piece[-1])
        steps, _ = SYSTEM.orbit(
            state, problem.parameters, piece, level.order, level.tolerance, longest, MAX_STEPS, found
        )
        if steps < 0:
            raise WorkLimit(f"This motion needs more than {MAX_STEPS} steps: choose a shorter time span.")
        require_finite_states(found)
        total += steps
        out[first[i] : first[i + 1]] = found[:-1]
        state = found[-1].copy()
    out[first[-1] :] = state
    states = out * problem.scale
    drift = drift_of(SYSTEM, states[0], states, np.array(body.parameters))
    off = states[:, :3] @ axis / (np.linalg.norm(states[:, :3], axis=1).max() or 1.0)
    return FreeRun(level.name, times, frozen(states), frozen(off), total, drift)


@dataclass(frozen=True)
class SuslovDistance:
    """Distance of the Euler–Poisson motion, held on the manifold and left free, from the motion of the Suslov problem.

    times, held, free : (n,), units b = 1, both at the level `reference`; error : estimate of the Suslov motion, in its
    own units.
    """

    times: Array
    held: Array
    free: Array
    error: float


def difference(bridge: Bridge, start: tuple[float, ...], duration: float, count: int) -> SuslovDistance:
    """Return the distance along the motion from a state (5,) of `eq01` with b = 1, over a `duration` of the bodies.

    Raises `InvalidParameter`, `WorkLimit`.
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
    return SuslovDistance(frozen(times), frozen(held), frozen(free), orbit.error_estimate)


_STRAIGHT = (3e-14, 1e-3)
"""Range of exponential growth of the leak: below it round-off still adds to it, above it growth is nonlinear."""


@dataclass(frozen=True)
class LeakGrowth:
    """Growth of ln |(r, M)| per period of n3, measured over `periods` periods from the period `first` on."""

    per_period: float
    first: int
    periods: int


@dataclass(frozen=True)
class Leak:
    """A free run and the exact motion from the same state.

    run : in the time of the bodies; exact : motion of the reduced system at the same times, units b = 1;
    samples : number per period of n3.
    """

    bridge: Bridge
    run: FreeRun
    exact: Orbit
    samples: int

    @cached_property
    def apart(self) -> Array:
        """The distance (n,) from the exact motion, in units b = 1."""
        return self.bridge.distance(self.run.states, self.exact.states)

    @cached_property
    def growth(self) -> LeakGrowth | None:
        """The growth of (r, M) while it is exponential; None if that lasts less than two periods.

        It is the slope of ln |(r, M)| against the number of the period, in a least-squares fit of a straight line plus
        a function of that period.
        """
        off, samples = self.run.off, self.samples
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
        """The sign of (r, M) when it becomes visible (0: never), and True if it does not change afterwards."""
        off = self.run.off[np.abs(self.run.off) > _STRAIGHT[1]]
        return (int(np.sign(off[0])), bool(np.all(off * off[0] > 0.0))) if off.size else (0, True)

    def straight_line(self, per_period: float, ends: tuple[float, float]) -> list[Array]:
        """Return (t, lg |(r, M)|), (2, 2), of a given growth through the middle of the exponential part, or [].

        per_period : growth of ln |(r, M)|; ends : values of lg at both ends.
        """
        if self.growth is None or per_period == 0.0:
            return []
        seen = slice(self.growth.first * self.samples, (self.growth.first + self.growth.periods) * self.samples)
        t, height = (float(np.mean(one[seen])) for one in (self.run.times, np.log10(np.abs(self.run.off))))
        period = self.run.times[-1] * self.samples / (self.run.times.size - 1)
        rate, lg = per_period / (period * math.log(10.0)), np.array(ends)
        return [np.column_stack([t + (lg - height) / rate, lg])]


def exact_growth(theta: CircleMap) -> float:
    """Return the growth of ln |(r, M)| in one period of n3 on the stable cycle; 0 without cycles."""
    return abs(theta.fixed_points[0].log_multiplier) if theta.fixed_points else 0.0
