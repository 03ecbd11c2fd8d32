"""Attractors of the orbits of a section: groups of their averages, and the contraction of volume in each group.

Phase volume about an orbit grows by exp ∫div ẏ dt.  If the mean divergence is negative, beyond its error, the orbits of
a group approach a set of volume 0: an attractor.  If it is 0 they only fill different parts of phase space.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from hess_mechanics.dynamics.attraction import RecurrentSets, recurrent_sets
from hess_mechanics.dynamics.cells import Window
from hess_mechanics.dynamics.spectrum import volume_sign
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.results import Array, Mask
from hess_mechanics.suslov.equations import SuslovBody
from hess_mechanics.suslov.section import SuslovSection, mean_divergence

__all__ = [
    "Attractors",
    "Contraction",
    "SectionOrbits",
    "attractors",
    "contraction",
    "contraction_at",
    "count_attractors",
    "groups",
    "groups_of_cells",
    "middle_cells",
    "middles",
]

_NARROWEST = 1e-3
"""Averages closer than this are equal."""
_GAP = 0.1
"""Least gap between two groups, as a share of the range of all averages."""
_FEWEST = 0.02
"""Smallest group, as a share of all orbits; smaller ones join the nearest group."""
_BATCHES = 12
_MOST_STEPS = 1_000_000
"""Limit of the steps of an orbit."""


@dataclass(frozen=True)
class Contraction:
    """Mean divergence along an orbit after its transient, and the standard error of that mean."""

    mean: float
    error: float

    @property
    def attracts(self) -> bool:
        """True if the mean is negative beyond its error."""
        return bool(volume_sign(self.mean, self.error) < 0)


def contraction(body: SuslovBody, start: Sequence[float], span: float) -> Contraction:
    """Return the contraction along the orbit from `start` (5,), over the last two thirds of the time `span`.

    The error is that of the means over 12 intervals of time, treated as independent.  Raises as `solve`.
    """
    course = mean_divergence(body, start, span)
    sums = np.concatenate([[0.0], course.mean * course.times])
    at = np.linspace(span / 3.0, span, _BATCHES + 1)
    stretches = np.diff(np.interp(at, np.concatenate([[0.0], course.times]), sums)) / np.diff(at)
    return Contraction(float(stretches.mean()), float(stretches.std(ddof=1) / math.sqrt(_BATCHES)))


def groups(averages: Array) -> Array:
    """Return the group (n,) of each orbit, 0, 1, … by increasing averages (n,); 0 if there are no distinct groups.

    A gap between two groups is at least a tenth of the whole range, and wider than either group without the outermost
    tenths of its orbits.  A group has at least a fiftieth of the orbits.
    """
    if averages.size == 0 or np.ptp(averages) < _NARROWEST:
        return np.zeros(averages.size)
    order = np.sort(averages)
    cuts = np.flatnonzero(np.diff(order) >= _GAP * np.ptp(order)) + 1
    least = max(2.0, _FEWEST * order.size)
    parts = [part for part in np.split(order, cuts) if part.size >= least] or [order]
    kept = [parts[0]]
    for part in parts[1:]:
        if part[0] - kept[-1][-1] > max(_width(kept[-1]), _width(part)):
            kept.append(part)
        else:
            kept[-1] = np.concatenate([kept[-1], part])
    edges = [0.5 * (left[-1] + right[0]) for left, right in pairwise(kept)]
    return np.asarray(np.searchsorted(edges, averages), float)


def middles(averages: Array, group: Array) -> list[int]:
    """Return the index of the orbit with the median average of each group."""
    members = [np.flatnonzero(group == one) for one in range(int(group.max(initial=-1)) + 1)]
    return [int(own[np.argsort(averages[own])[own.size // 2]]) for own in members]


def groups_of_cells(ends: Array) -> Array:
    """Return the group of each cell of `SuslovSection.ends`, of the same shape; −1 for cells without an orbit."""
    there, cells = np.isfinite(ends), np.full(ends.shape, -1.0)
    cells[there] = groups(ends[there])
    return cells


def middle_cells(ends: Array, cells: Array) -> list[tuple[int, int]]:
    """Return row and column of the median cell of each group, from `ends` (n, m) and its `groups_of_cells`."""
    there = cells >= 0.0
    return [(row, column) for row, column in np.argwhere(there)[middles(ends[there], cells[there])].tolist()]


def contraction_at(
    section: SuslovSection, window: Window, cells: tuple[int, int], row: int, column: int, span: float
) -> Contraction:
    """Return the `contraction` of the orbit from the centre of one of the cells (m, n) of a window."""
    states, _ = section.cells_of_row(window, cells, row)
    return contraction(section.body, states[column].tolist(), span)


def _width(part: Array) -> float:
    low, high = np.quantile(part, [0.1, 0.9])
    return float(high - low)


def count_attractors(
    section: SuslovSection, cells: tuple[int, int], crossings: int, span: float, level: Accuracy
) -> int:
    """Return the number of attracting groups of a whole section, from the orbits of cells (m, n).

    crossings : number of crossings of each orbit; span : time over which the divergence of one orbit of each group is
    averaged.  The result is 0 if no motion is possible.  Raises `InvalidParameter`, `WorkLimit`.
    """
    window = ((-math.pi, 0.0), (math.pi, math.pi))
    ends = np.array([section.ends(window, cells, row, crossings, level=level) for row in range(cells[1])])
    return sum(
        contraction_at(section, window, cells, *cell, span).attracts
        for cell in middle_cells(ends, groups_of_cells(ends))
    )


@dataclass(frozen=True)
class SectionOrbits:
    """The orbits of a section forward in time, at a level, as `attraction.Orbits`."""

    section: SuslovSection
    level: Accuracy

    @property
    def turns(self) -> tuple[float, ...]:
        """Period of each coordinate, ∞ if it is not an angle."""
        return self.section.turns

    @property
    def window(self) -> tuple[tuple[float, float], ...]:
        """Range of each coordinate."""
        return self.section.window

    def states_at(self, x: Array, y: Array) -> tuple[Array, Mask]:
        """Return the states (n, 5) at (ψ, δ) (n,), and the mask (n,) of the places with motion."""
        return self.section.states_at(x, y)

    def places_of(self, states: Array) -> Array:
        """Return (ψ, δ) (n, 2) of states (n, 5)."""
        return self.section.places_of(states)

    def follow(self, starts: Array, crossings: int) -> list[Array]:
        """Return the next crossings (n, 5) of each orbit from `starts` (k, 5).  Raises `WorkLimit`."""
        if not len(starts):
            return []
        return self.section.points(
            starts.tolist(), crossings, True, self.level, threads=1, most_steps=_MOST_STEPS
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


def attractors(section: SuslovSection, span: float, level: Accuracy) -> Attractors:
    """Return the attractors of a section; `span` is the time over which a divergence is averaged.

    Raises `InvalidParameter`, `WorkLimit`.
    """
    found = recurrent_sets(SectionOrbits(section, level))
    on_each = tuple(contraction(section.body, state, span) for state in found.states)
    return Attractors(found.kept([one.attracts for one in on_each]), on_each)
