"""Attractors of a section: recurrent sets about which phase volume shrinks.

Phase volume about an orbit grows by exp ∫div ẏ dt.  If the mean divergence is negative, beyond its error, the orbits
approach a set of volume 0: an attractor.  If it is 0 they only fill different parts of phase space.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.attraction import RecurrentSets, recurrent_sets
from hess_mechanics.dynamics.birkhoff import volume_sign
from hess_mechanics.dynamics.ensemble import complete
from hess_mechanics.dynamics.orbit import solve
from hess_mechanics.dynamics.return_map import PoincareSection, section_crossings
from hess_mechanics.dynamics.system import Body
from hess_mechanics.numerics.accuracy import DRAFT, Accuracy
from hess_mechanics.numerics.results import Array, frozen

__all__ = [
    "Attractors",
    "Contraction",
    "MeanDivergence",
    "SectionOrbits",
    "attractors",
    "contraction",
    "mean_divergence",
]

_BATCHES = 12
_SAMPLES = 4000
_MOST_STEPS = 1_000_000
"""Limit of the steps of an orbit."""


@dataclass(frozen=True)
class MeanDivergence:
    """Mean divergence (n,) along an orbit up to the times (n,)."""

    times: Array
    mean: Array


def mean_divergence(body: Body, start: Sequence[float], duration: float) -> MeanDivergence:
    """Return the mean divergence along the orbit from `start` (d,), at 4000 times in `duration`.  Raises as `solve`."""
    times = np.linspace(0.0, duration, _SAMPLES + 1)
    rates = body.system.divergence(solve(body, start, times, DRAFT).states, body.parameters)
    steps = 0.5 * (rates[1:] + rates[:-1]) * np.diff(times)
    return MeanDivergence(frozen(times[1:]), frozen(np.cumsum(steps) / times[1:]))


@dataclass(frozen=True)
class Contraction:
    """Mean divergence along an orbit after its transient, and the standard error of that mean."""

    mean: float
    error: float

    @property
    def attracts(self) -> bool:
        """True if the mean is negative beyond its error."""
        return bool(volume_sign(self.mean, self.error) < 0)


def contraction(body: Body, start: Sequence[float], duration: float) -> Contraction:
    """Return the contraction along the orbit from `start` (d,), over the last two thirds of the time `duration`.

    The error is that of the means over 12 intervals of time, treated as independent.  Raises as `solve`.
    """
    course = mean_divergence(body, start, duration)
    sums = np.concatenate([[0.0], course.mean * course.times])
    at = np.linspace(duration / 3.0, duration, _BATCHES + 1)
    stretches = np.diff(np.interp(at, np.concatenate([[0.0], course.times]), sums)) / np.diff(at)
    return Contraction(float(stretches.mean()), float(stretches.std(ddof=1) / math.sqrt(_BATCHES)))


@dataclass(frozen=True)
class SectionOrbits:
    """The orbits of a section forward in time, at a level, as `attraction.Orbits`."""

    section: PoincareSection
    level: Accuracy

    def follow(self, starts: Array, crossings: int) -> list[Array]:
        """Return the next crossings (n, d) of each orbit from `starts` (k, d).  Raises `WorkLimit`."""
        if not len(starts):
            return []
        return complete(
            section_crossings(self.section, starts, crossings, self.level, threads=1, most_steps=_MOST_STEPS)
        ).states


@dataclass(frozen=True)
class Attractors:
    """The attractors of a section, and the contraction about each recurrent set, of attractors and others."""

    sets: RecurrentSets
    contractions: tuple[Contraction, ...]

    @property
    def count(self) -> int:
        """Number of attractors."""
        return len(self.sets.states)

    @property
    def alone(self) -> bool:
        """True if every recurrent set attracts."""
        return all(one.attracts for one in self.contractions)

    @property
    def largest(self) -> Contraction | None:
        """The largest mean divergence about a recurrent set; None without one."""
        return max(self.contractions, key=lambda one: one.mean, default=None)


def attractors(section: PoincareSection, duration: float, accuracy: Accuracy) -> Attractors:
    """Return the attractors of a section; `duration` is the time over which a divergence is averaged.

    Raises `InvalidParameter`, `WorkLimit`.
    """
    found = recurrent_sets(SectionOrbits(section, accuracy))
    on_each = tuple(contraction(section, state, duration) for state in found.states)
    return Attractors(found.kept([one.attracts for one in on_each]), on_each)
