"""Recurrent sets of a plane map, and the orbits that arrive there.

Orbits from all over the plane are followed for a long time, on a grid of cells.  Two orbits that visit the same cell
late, or neighbouring cells, approach the same set (Datseris and Wagemakers 2022).  Some orbits of each set are followed
much longer: slow orbits that looked apart have met by then, and the set fills its cells.  An orbit has arrived when
several of its crossings in a row lie in the cells of one set, or beside them.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.dynamics.cells import centres
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array, as_read_only

__all__ = ["CROSSINGS", "LOST", "NOWHERE", "Arrivals", "Orbits", "RecurrentSets", "arrivals", "recurrent_sets"]

CROSSINGS = 240
"""Crossings after which an orbit that has not arrived is lost."""
NOWHERE, LOST = -1, -2
"""Values in place of the number of a set: no motion at the point; no arrival."""
_STARTS = 16
"""Orbits along each side of the plane."""
_CELLS = (512, 256)
"""Cells across and up the plane: two sets closer than two cells count as one."""
_FEWEST, _MOST = 2, 12
"""Smallest number of orbits of a recognised set, and largest number of sets that are followed longer."""
_TRANSIENT, _LONG = 2000, 4000
"""Crossings of an orbit that is followed longer: first those discarded, then those that fill the cells of its set."""
_ROW = 8
"""Crossings in a row after which an orbit has arrived."""
_PIECES = (20, 40, 80, 100)
"""Crossings of each round, after which the orbits that have arrived are left out; their sum is `CROSSINGS`."""


class Orbits(Protocol):
    """The orbits of a section, followed together."""

    @property
    def section(self) -> PoincareSection:
        """The section."""

    def follow(self, starts: Array, crossings: int) -> Sequence[Array]:
        """Return the next crossings of several orbits.

        Parameters
        ----------
        starts : ndarray, shape (k, d)
            Initial states.
        crossings : int
            Number of crossings of each orbit.

        Returns
        -------
        sequence of ndarray, shape (n, d)
            States at the crossings of each orbit; fewer where an orbit stops crossing.
        """


@dataclass(frozen=True)
class RecurrentSets:
    """Sets that orbits approach, numbered from 0 by the size of their largest group of orbits, the largest first.

    Attributes
    ----------
    table : ndarray of int, shape (n, m)
        Number of the set in its cells and in those beside them, with n cells up and m across; `LOST` elsewhere.
    states : tuple of tuple of float
        A state of each set.
    """

    table: NDArray[np.int16]
    states: tuple[tuple[float, ...], ...]

    def subset(self, which: Sequence[bool]) -> RecurrentSets:
        """Return some of the sets, renumbered from 0 in the same order.

        Parameters
        ----------
        which : sequence of bool
            True for each set to return.

        Returns
        -------
        RecurrentSets
            The chosen sets.
        """
        numbers = np.append(np.where(which, np.cumsum(which) - 1, LOST), LOST).astype(np.int16)
        states = tuple(state for state, flag in zip(self.states, which, strict=True) if flag)
        return RecurrentSets(as_read_only(numbers[np.where(self.table < 0, -1, self.table)]), states)

    def of(self, section: PoincareSection, states: Array) -> NDArray[np.int16]:
        """Return the number of the set at each state.

        Parameters
        ----------
        section : PoincareSection
            The section.
        states : ndarray, shape (n, d)
            States of the section.

        Returns
        -------
        ndarray of int, shape (n,)
            Numbers of the sets; `LOST` where there is none.
        """
        return np.asarray(self.table[_cells(section, states)])


@dataclass(frozen=True)
class Arrivals:
    """The sets where the orbits from some points arrive, and the crossings that they need.

    Attributes
    ----------
    number : ndarray of int, shape (n,) or (n, m)
        Number of the set; `LOST` if the orbit does not arrive, `NOWHERE` if no motion crosses the section at the point.
    crossings : ndarray of int
        Index, from 0, of the first crossing in the set, of the same shape; `CROSSINGS` where no set is reached.
    """

    number: NDArray[np.int16]
    crossings: NDArray[np.int16]


def _cells(section: PoincareSection, states: Array) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
    """Return row and column of the cells of states (n, d)."""
    low, high = np.array(section.window).T
    at = np.floor((section.points_of(states) - low) / (high - low) * _CELLS).astype(int)
    column, row = (np.clip(one, 0, count - 1) for one, count in zip(at.T, _CELLS, strict=True))
    return row, column


def _joined(cells: Sequence[tuple[NDArray[np.int64], NDArray[np.int64]]]) -> NDArray[np.int64]:
    """Return a set number for each orbit: orbits belong to the same set if the cells that they visit touch."""
    visited = np.zeros(_CELLS[::-1], bool)
    for one in cells:
        visited[one] = True
    # Imported here because the imports take 0.2 s together, and few states need them.
    from scipy import ndimage
    from scipy.sparse import coo_array
    from scipy.sparse.csgraph import connected_components

    patches, count = ndimage.label(visited, np.ones((3, 3)))
    # Nodes of the graph are orbits and patches of cells; an edge is a visit.
    orbit = np.repeat(np.arange(len(cells)), [len(row) for row, _ in cells])
    patch = np.concatenate([patches[one] for one in cells]) + len(cells) - 1
    nodes = len(cells) + count
    graph = coo_array((np.ones(orbit.size), (orbit, patch)), shape=(nodes, nodes))
    return np.asarray(connected_components(graph, directed=False)[1][: len(cells)], np.int64)


def recurrent_sets(orbits: Orbits) -> RecurrentSets:
    """Return the recurrent sets of a section, at most 12, each approached by at least two orbits.

    The orbits start from the points of a 16 × 16 grid over the section at which motions cross it.

    Parameters
    ----------
    orbits : Orbits
        The orbits of a section with two coordinates.

    Returns
    -------
    RecurrentSets
        The sets; none if no two orbits that keep crossing the section approach the same set.

    Raises
    ------
    WorkLimit
        If an orbit needs too many steps.
    """
    section = orbits.section
    (x0, x1), (y0, y1) = section.window
    x, y = (one.ravel() for one in np.meshgrid(centres(x0, x1, _STARTS), centres(y0, y1, _STARTS)))
    states, there = section.states_at(x, y)
    complete = [orbit for orbit in orbits.follow(states[there], CROSSINGS) if len(orbit) == CROSSINGS]
    table = np.full(_CELLS[::-1], LOST, np.int16)
    if not complete:
        return RecurrentSets(as_read_only(table), ())
    of_each = _joined([_cells(section, orbit[-CROSSINGS // 4 :]) for orbit in complete])
    sizes = np.bincount(of_each)
    largest = [one for one in np.argsort(-sizes, kind="stable")[:_MOST] if sizes[one] >= _FEWEST]
    ends = [complete[int(np.argmax(of_each == one))][-1] for one in largest]
    long = [one[_TRANSIENT:] for one in orbits.follow(np.array(ends), _TRANSIENT + _LONG) if len(one) > _TRANSIENT]
    if not long:
        return RecurrentSets(as_read_only(table), ())
    cells = [_cells(section, one) for one in long]
    # Number the sets in the order of their first orbits, which begins with the largest set.
    _, firsts, numbers = np.unique(_joined(cells), return_index=True, return_inverse=True)
    order = np.argsort(np.argsort(firsts))
    for one, number in zip(cells, order[numbers], strict=True):
        table[one] = number
    from scipy import ndimage

    around = ndimage.maximum_filter(
        table, 3, mode=["wrap" if np.isfinite(turn) else "nearest" for turn in section.turns[::-1]]
    )
    states_on = tuple(tuple(map(float, long[i][-1])) for i in sorted(firsts))
    return RecurrentSets(as_read_only(np.where(table == LOST, around, table)), states_on)


def arrivals(orbits: Orbits, sets: RecurrentSets, x: Array, y: Array) -> Arrivals:
    """Return the recurrent sets that orbits reach within `CROSSINGS` crossings.

    Parameters
    ----------
    orbits : Orbits
        The orbits of the section.
    sets : RecurrentSets
        The recurrent sets.
    x, y : ndarray, shape (n,)
        Coordinates of the points where the orbits start.

    Returns
    -------
    Arrivals
        The arrivals, of shape (n,).

    Raises
    ------
    WorkLimit
        If an orbit needs too many steps.
    """
    states, there = orbits.section.states_at(x, y)
    number = np.where(there, LOST, NOWHERE).astype(np.int16)
    crossings = np.full(number.shape, CROSSINGS, np.int16)
    left = np.flatnonzero(there)
    states, before, done = states[left], np.full((left.size, 0), LOST, np.int16), 0
    for piece in _PIECES if sets.states else ():
        if not left.size:
            break
        check_limit()
        following = orbits.follow(states, piece)
        whole = np.array([len(orbit) == piece for orbit in following])
        left, before = left[whole], before[whole]
        if not left.size:
            break
        together = np.concatenate([orbit for orbit, flag in zip(following, whole, strict=True) if flag])
        seen = np.hstack([before, sets.of(orbits.section, together).reshape(-1, piece)])
        rows = np.lib.stride_tricks.sliding_window_view(seen, _ROW, axis=1)
        arrived = (rows[..., 0] >= 0) & np.all(rows == rows[..., :1], axis=2)
        has, first = arrived.any(axis=1), np.argmax(arrived, axis=1)
        number[left[has]] = seen[has, first[has]]
        crossings[left[has]] = done - before.shape[1] + first[has]
        done += piece
        states = together.reshape(-1, piece, together.shape[1])[~has, -1]
        left, before = left[~has], seen[~has, -_ROW + 1 :]
    return Arrivals(as_read_only(number), as_read_only(crossings))
