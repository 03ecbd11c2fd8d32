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
from hess_mechanics.numerics.results import Array, as_read_only

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
_TURNS = 40.0
"""Time limit per crossing, see `section_crossings`; less than by default, because many orbits stop crossing."""
_MOST_STEPS = 1_000_000
"""Limit of the steps of an orbit."""


@dataclass(frozen=True)
class MeanDivergence:
    """Mean divergence along an orbit.

    Attributes
    ----------
    times : ndarray, shape (n,)
        Times after the start, in units T.
    mean : ndarray, shape (n,)
        Mean divergence up to each time, in 1/T.
    """

    times: Array
    mean: Array


def mean_divergence(body: Body, start: Sequence[float], duration: float) -> MeanDivergence:
    """Return the mean divergence along an orbit up to each of 4000 times, at the accuracy level `draft`.

    Parameters
    ----------
    body : Body
        The body.
    start : sequence of float, shape (d,)
        Initial state.
    duration : float
        Duration, nonzero, in units T; negative for backward in time.

    Returns
    -------
    MeanDivergence
        The running means, at evenly spaced times.

    Raises
    ------
    InvalidParameter
        If a number is not finite.
    WorkLimit
        If the orbit needs too many steps.
    MotionEnds
        If the motion escapes to infinity, or reaches a state without finite rates.
    """
    times = np.linspace(0.0, duration, _SAMPLES + 1)
    rates = body.system.divergence(solve(body, start, times, DRAFT).states, body.parameters)
    steps = 0.5 * (rates[1:] + rates[:-1]) * np.diff(times)
    return MeanDivergence(as_read_only(times[1:]), as_read_only(np.cumsum(steps) / times[1:]))


@dataclass(frozen=True)
class Contraction:
    """Mean divergence along an orbit after its transient.

    Attributes
    ----------
    mean : float
        Mean divergence, in 1/T.
    error : float
        Standard error of the mean, ≥ 0.
    """

    mean: float
    error: float

    @property
    def attracts(self) -> bool:
        """True if the mean is negative by more than three times its error."""
        return bool(volume_sign(self.mean, self.error) < 0)


def contraction(body: Body, start: Sequence[float], duration: float) -> Contraction:
    """Return the mean divergence along an orbit over the last two thirds of a duration, with its error.

    The error is the standard error of the mean over 12 intervals of time, treated as independent.

    Parameters
    ----------
    body : Body
        The body.
    start : sequence of float, shape (d,)
        Initial state.
    duration : float
        Duration, positive, in units T.

    Returns
    -------
    Contraction
        Mean divergence and its standard error.

    Raises
    ------
    InvalidParameter
        If a number is not finite.
    WorkLimit
        If the orbit needs too many steps.
    MotionEnds
        If the motion escapes to infinity, or reaches a state without finite rates.
    """
    means = mean_divergence(body, start, duration)
    sums = np.concatenate([[0.0], means.mean * means.times])
    at = np.linspace(duration / 3.0, duration, _BATCHES + 1)
    stretches = np.diff(np.interp(at, np.concatenate([[0.0], means.times]), sums)) / np.diff(at)
    return Contraction(float(stretches.mean()), float(stretches.std(ddof=1) / math.sqrt(_BATCHES)))


@dataclass(frozen=True)
class SectionOrbits:
    """The orbits of a section forward in time, computed at one accuracy level; an `attraction.Orbits`.

    Parameters
    ----------
    section : PoincareSection
        The section.
    level : str or Level
        Accuracy level.
    """

    section: PoincareSection
    level: Accuracy

    def follow(self, starts: Array, crossings: int) -> list[Array]:
        """Return the next crossings of several orbits.

        Parameters
        ----------
        starts : ndarray, shape (k, d)
            Initial states.
        crossings : int
            Number of crossings of each orbit.

        Returns
        -------
        list of ndarray, shape (n, d)
            States at the crossings of each orbit; n < `crossings` if it crosses too rarely.

        Raises
        ------
        WorkLimit
            If an orbit needs too many steps, escapes to infinity or reaches a state without finite rates.
        """
        if not len(starts):
            return []
        result = section_crossings(
            self.section, starts, crossings, self.level, turns=_TURNS, threads=1, max_steps=_MOST_STEPS
        )
        return complete(result).states


@dataclass(frozen=True)
class Attractors:
    """The attractors of a section, and the mean divergence about each recurrent set.

    Attributes
    ----------
    sets : RecurrentSets
        The attractors.
    contractions : tuple of Contraction
        Mean divergence about each recurrent set, whether it is an attractor or not.
    """

    sets: RecurrentSets
    contractions: tuple[Contraction, ...]

    @property
    def count(self) -> int:
        """Number of attractors."""
        return len(self.sets.states)

    @property
    def all_attract(self) -> bool:
        """True if every recurrent set is an attractor; also if there is no recurrent set."""
        return all(one.attracts for one in self.contractions)

    @property
    def largest(self) -> Contraction | None:
        """Contraction about the recurrent set with the largest mean divergence; None if there is no recurrent set."""
        return max(self.contractions, key=lambda one: one.mean, default=None)


def attractors(section: PoincareSection, duration: float, accuracy: Accuracy) -> Attractors:
    """Return the attractors of a section.

    Parameters
    ----------
    section : PoincareSection
        A section with two coordinates.
    duration : float
        Duration of the orbit on each recurrent set, positive, in units T; see `contraction`.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    Attractors
        The attractors.

    Raises
    ------
    InvalidParameter
        If the duration is not finite.
    WorkLimit
        If an orbit needs too many steps, escapes to infinity or reaches a state without finite rates.
    """
    sets = recurrent_sets(SectionOrbits(section, accuracy))
    on_each = tuple(contraction(section, state, duration) for state in sets.states)
    return Attractors(sets.subset([one.attracts for one in on_each]), on_each)
