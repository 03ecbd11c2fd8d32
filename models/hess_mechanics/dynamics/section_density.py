"""How often orbits visit the cells of a Poincaré section: pictures of millions of crossings."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.dynamics.cells import Window
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.dynamics.section import section_points
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.results import Array, frozen

__all__ = ["Visits", "visits"]

_TURNS = 60.0
"""Time limit per crossing, in units of 1/ν times the slowness of the section."""
_TOGETHER = 8
"""Orbits whose crossings are in memory at the same time."""


@dataclass(frozen=True)
class Visits:
    """Crossings of some orbits, counted in the cells of a window.

    counts : crossings (n, m) in each cell, rows of equal y; ends : the last crossing (k, d) of each orbit.
    points : number of counted crossings, which are those within the window; drift : the largest drift of each integral.
    """

    counts: NDArray[np.uint32]
    ends: Array
    points: int
    drift: Mapping[str, float]

    def after(self, before: Visits) -> Visits:
        """Return these visits added to those of the same orbits before."""
        drift = {name: max(value, before.drift[name]) for name, value in self.drift.items()}
        return replace(
            self, counts=frozen(self.counts + before.counts), points=self.points + before.points, drift=drift
        )


def visits(
    section: PoincareSection,
    window: Window,
    cells: tuple[int, int],
    starts: Sequence[Sequence[float]] | Array,
    crossings: int,
    forward: bool,
    level: Accuracy,
) -> Visits:
    """Return the visits of the first `crossings` crossings of each orbit from `starts` (k, d), on one core.

    cells : (m, n) cells across and up the window.  Crossings elsewhere, or on another sheet, are not counted.  Raises
    as `section_points`.
    """
    # Counting in NumPy takes a hundredth of the time of the orbits: no kernel or library would be noticed.
    low, high = np.array(window)
    counts = np.zeros(cells[0] * cells[1], np.uint32)
    ends, points, drift = list[Array](), 0, dict[str, float]()
    starts = np.asarray(starts, float)
    for first in range(0, len(starts), _TOGETHER):
        some = starts[first : first + _TOGETHER]
        fastest = float(np.max(section.system.frequency(some.T, np.array(section.parameters))))
        end = _TURNS * crossings * section.slowness / (fastest or 1.0)
        found = section_points(section, some, section.surface, end if forward else -end, level, crossings, threads=1)
        for states in found.states:
            places = section.places_of(states[section.is_on(states)])
            within = places[np.all((places >= low) & (places < high), axis=1)]
            at = ((within - low) * (cells / (high - low))).astype(int)
            np.add.at(counts, at[:, 1] * cells[0] + at[:, 0], 1)
            points += len(within)
            ends.extend(states[-1:])
        drift |= {name: max(value, drift.get(name, 0.0)) for name, value in found.drift.items()}
    return Visits(
        frozen(counts.reshape(cells[::-1])), frozen(np.array(ends).reshape(-1, starts.shape[1])), points, drift
    )
