"""Visits of orbits to the cells of a section or of an orbit diagram: pictures of millions of crossings."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.dynamics.cells import Window
from hess_mechanics.dynamics.ensemble import complete
from hess_mechanics.dynamics.return_map import PoincareSection, section_crossings
from hess_mechanics.errors import ModelError, WorkLimit
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.results import Array, as_read_only

__all__ = ["Visits", "visits", "visits_over"]

_TOGETHER = 8
"""Orbits whose crossings are in memory at the same time."""


@dataclass(frozen=True)
class Visits:
    """Crossings of some orbits, counted in cells; the result of `visits` and `visits_over`.

    Attributes
    ----------
    counts : ndarray of int, shape (n, m)
        Crossings in each cell, rows of equal y in increasing order.
    ends : ndarray, shape (k, d)
        Last crossing of each orbit.  `visits`: a state, for the orbits that have one.  `visits_over`: a point for each
        value, NaN if there is none.
    points : int
        Number of counted crossings, which are those within the window.
    drift : mapping of str to float
        Largest drift of each integral, by name.
    """

    counts: NDArray[np.uint32]
    ends: Array
    points: int
    drift: Mapping[str, float]

    def combine(self, before: Visits) -> Visits:
        """Return these visits added to earlier visits of the same orbits.

        Parameters
        ----------
        before : Visits
            The earlier visits.

        Returns
        -------
        Visits
            The sums of the counts, the larger drifts, and the ends of these visits.
        """
        drift = _larger(before.drift, self.drift)
        return replace(
            self, counts=as_read_only(self.counts + before.counts), points=self.points + before.points, drift=drift
        )


def visits(
    section: PoincareSection,
    window: Window,
    cells: tuple[int, int],
    starts: Sequence[Sequence[float]] | Array,
    crossings: int,
    forward: bool,
    accuracy: Accuracy,
) -> Visits:
    """Return the visits of several orbits to the cells of a window, on one core.

    Crossings elsewhere, on the upper edges of the window, or on another sheet are not counted.

    Parameters
    ----------
    section : PoincareSection
        The section.
    window : ((float, float), (float, float))
        Lower left and upper right corner of the window.
    cells : (int, int)
        Number of cells across and up, (m, n).
    starts : array_like, shape (k, d)
        Initial states.
    crossings : int
        Largest number of crossings of each orbit, 1 to 100 000.
    forward : bool
        Follow the orbits forward in time, otherwise backward.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    Visits
        The visits.

    Raises
    ------
    InvalidParameter
        As `section_points`.
    WorkLimit
        As `section_points`, and if a motion ends.
    """
    # NumPy is fast enough: counting takes a hundredth of the time of the orbits.
    low, high = np.array(window)
    counts = np.zeros(cells[0] * cells[1], np.uint32)
    ends, points, drift = list[Array](), 0, dict[str, float]()
    starts = np.asarray(starts, float)
    for first in range(0, len(starts), _TOGETHER):
        some = starts[first : first + _TOGETHER]
        orbits = complete(section_crossings(section, some, crossings, accuracy, not forward, threads=1))
        for states in orbits.states:
            coordinates = section.points_of(states[section.is_on(states)])
            within = coordinates[np.all((coordinates >= low) & (coordinates < high), axis=1)]
            at = ((within - low) * (cells / (high - low))).astype(int)
            np.add.at(counts, at[:, 1] * cells[0] + at[:, 0], 1)
            points += len(within)
            ends.extend(states[-1:])
        drift = _larger(drift, orbits.drift)
    return Visits(
        as_read_only(counts.reshape(cells[::-1])),
        as_read_only(np.array(ends).reshape(-1, starts.shape[1])),
        points,
        drift,
    )


def visits_over(
    family: Callable[[float], PoincareSection],
    values: Sequence[float],
    side: int,
    reach: tuple[float, float],
    rows: int,
    starts: Sequence[Sequence[float]] | Array,
    transient: int,
    crossings: int,
    forward: bool,
    accuracy: Accuracy,
) -> Visits:
    """Return the visits of one orbit at each value of a parameter, in a column of cells for each, on one core.

    Columns of values without a body or without a motion are empty.

    Parameters
    ----------
    family : callable
        Function from the value to the section; where it raises a `ModelError`, the column is empty.
    values : sequence of float, length n
        Values of the parameter.
    side : int
        Index of the coordinate that is counted.
    reach : (float, float)
        Range of this coordinate, without its upper end.
    rows : int
        Number of cells over this range.
    starts : array_like, shape (n, k)
        Point where each orbit starts, NaN for none.
    transient : int
        Number of crossings discarded first.
    crossings : int
        Number of crossings counted.
    forward : bool
        Follow the orbits forward in time, otherwise backward.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    Visits
        The visits.

    Raises
    ------
    WorkLimit
        If an orbit needs too many steps, or a motion ends.
    """
    low, high = reach
    counts = np.zeros((rows, len(values)), np.uint32)
    ends, points, drift = np.full((len(values), len(starts[0])), np.nan), 0, dict[str, float]()
    for j, (value, start) in enumerate(zip(values, starts, strict=True)):
        if not all(map(math.isfinite, start)):
            continue
        try:
            section = family(value)
            state, there = section.states_at(*np.array(start)[:, None])
            if not there[0]:
                continue
            orbits = complete(
                section_crossings(section, state, transient + crossings, accuracy, not forward, threads=1)
            )
        except WorkLimit:
            raise
        except ModelError:
            # A value without a body or without motion leaves its column empty.
            continue
        states = orbits.states[0]
        coordinates = section.points_of(states[section.is_on(states)])
        ends[j] = coordinates[-1] if len(coordinates) else np.nan
        y = coordinates[transient:, side]
        within = y[(y >= low) & (y < high)]
        np.add.at(counts[:, j], ((within - low) * (rows / (high - low))).astype(int), 1)
        points += len(within)
        drift = _larger(drift, orbits.drift)
    return Visits(as_read_only(counts), as_read_only(ends), points, drift)


def _larger(one: Mapping[str, float], other: Mapping[str, float]) -> dict[str, float]:
    """Return the larger drift of each integral."""
    return {name: max(one.get(name, 0.0), other.get(name, 0.0)) for name in {**one, **other}}
