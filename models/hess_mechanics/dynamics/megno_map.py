"""MEGNO over the cells of a section: regular and chaotic regions, and regions where phase volume shrinks."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from hess_mechanics.dynamics.cells import Window, centres
from hess_mechanics.dynamics.megno import megno
from hess_mechanics.dynamics.periodic import units_of
from hess_mechanics.dynamics.return_map import PoincareSection, ReturnMap
from hess_mechanics.errors import InvalidParameter, OutsideRegion
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.arguments import as_cells, as_number, as_point
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.parallel import run_in_threads
from hess_mechanics.numerics.results import Array, as_read_only

__all__ = ["ENDED", "NOWHERE", "MegnoMap", "corners", "megno_map", "require_plane", "row_of_cells", "time_of"]

NOWHERE, ENDED = -1, 4
"""Kinds of a cell whose centre no motion crosses, and of one whose motion cannot be followed over the time span."""
_TRIED = 16
"""Points along each side of a section at which the frequency is evaluated."""


@dataclass(frozen=True)
class MegnoMap(Result):
    """MEGNO over the cells of a section.

    Attributes
    ----------
    names : tuple of str
        Names of the two coordinates.
    x, y : ndarray, shape (m,) and (n,)
        Centres of the cells.
    values : ndarray, shape (n, m)
        Ȳ after the time `duration`; NaN where no motion crosses the section, or the motion ends before.
    kind : ndarray of int, shape (n, m)
        0 not chaotic, 1 chaotic, plus 2 where phase volume shrinks by more than three standard errors; 4 where the
        motion or a neighbour ends earlier; −1 where no motion crosses the section.
    ends : ndarray, shape (n, m)
        Time up to which each motion was followed, positive, in units T; NaN where that is not known.
    duration : float
        Time of each motion, positive, in units T.
    level : str
        Name of the accuracy level.
    """

    names: tuple[str, str]
    x: Array
    y: Array
    values: Array
    kind: Array
    ends: Array
    duration: float
    level: str

    def labels(self) -> Labels:
        """Return MEGNO, kind and end of each cell, labelled with both coordinates.

        Returns
        -------
        Labels
            The three arrays over the cells.
        """
        arrays = {"MEGNO": self.values, "kind": self.kind, "end": self.ends}
        facts = {"t": self.duration, "level": self.level}
        return labels_of_cells(self.names, self.x, self.y, arrays, facts, MEGNO="1", end="T")


def labels_of_cells(
    names: tuple[str, str],
    x: Array,
    y: Array,
    arrays: Mapping[str, Array],
    facts: Mapping[str, Any],
    **units: str,
) -> Labels:
    """Return arrays over the cells of a window, labelled with both coordinates.

    Parameters
    ----------
    names : (str, str)
        Names of the coordinates, across and up.
    x : ndarray, shape (m,)
        Centres of the cells across.
    y : ndarray, shape (n,)
        Centres of the cells up.
    arrays : mapping of str to ndarray, shape (n, m)
        The arrays, by name.
    facts : mapping of str to object
        Facts about the computation, by name.
    **units : str
        Units of the arrays, by name.

    Returns
    -------
    Labels
        The labelled arrays.
    """
    across, up = names
    return Labels(
        {up: ((up,), y), across: ((across,), x)},
        {name: ((up, across), of) for name, of in arrays.items()},
        {**units_of(names), **units},
        facts,
    )


def row_of_cells(
    section: PoincareSection, window: Window, cells: tuple[int, int], row: int, duration: float, accuracy: Accuracy
) -> Array:
    """Return MEGNO of the motions from the centres of one row of cells.

    Parameters
    ----------
    section : PoincareSection
        The section.
    window : ((float, float), (float, float))
        Corners of the window, see `Window`.
    cells : (int, int)
        Numbers (m, n) of cells across and up.
    row : int
        Index of the row, from 0 for the lowest.
    duration : float
        Time span, nonzero, in units T; negative for backward in time.
    accuracy : str or Level
        Accuracy level.

    Returns
    -------
    ndarray, shape (3, m)
        Ȳ, kind and end of each motion, see `MegnoMap`.

    Raises
    ------
    InvalidParameter
        If a number is not finite, or the time span is 0.
    WorkLimit
        If the time span is too long.
    """
    (x0, y0), (x1, y1) = window
    m, n = cells
    states, there = section.states_at(centres(x0, x1, m), np.full(m, centres(y0, y1, n)[row]))
    out = np.full((3, m), np.nan)
    out[1] = NOWHERE
    if there.any():
        row_values = megno(section, states[there], duration, accuracy, threads=1)
        kinds = np.where(np.array(row_values.reasons, bool), ENDED, row_values.chaotic + 2 * row_values.dissipative)
        out[:, there] = row_values.values, kinds, row_values.ends
    return as_read_only(out)


def megno_map(
    map_: ReturnMap, cells: tuple[int, int] = (16, 12), window: Window | None = None, duration: float = 200.0
) -> MegnoMap:
    """Return MEGNO over the cells of a section, computed on all cores.

    Parameters
    ----------
    map_ : ReturnMap
        Return map of a section with two coordinates.
    cells : (int, int), default (16, 12)
        Number of cells across and up.
    window : ((float, float), (float, float)), optional
        Corners (x0, y0) and (x1, y1) of the window.  By default the whole section.
    duration : float, default 200
        Time span, nonzero, in units T; negative for backward in time.

    Returns
    -------
    MegnoMap
        Ȳ, kind and end of each cell.

    Raises
    ------
    InvalidParameter
        If the section has only one coordinate, or a number is out of range.
    WorkLimit
        If the time span is too long.

    Examples
    --------
    >>> from hess_mechanics import QuarticBody, megno_map, return_map
    >>> chart = megno_map(return_map(QuarticBody(2.0, 1.0, 1.0, 0.8), accuracy="standard"), cells=(6, 4), duration=50.0)
    >>> chart.values.shape, chart.names
    ((4, 6), ('q', 'p'))
    """
    section, level = map_.section, map_.accuracy
    window = (x0, y0), (x1, y1) = corners(section, window)
    m, n = shape = as_cells(cells)
    span = as_number("duration", duration)
    rows = np.empty((n, 3, m))

    def row(i: int) -> None:
        rows[i] = row_of_cells(section, window, shape, i, span, level)

    run_in_threads(row, n)
    across, up = section.names
    return MegnoMap(
        (across, up),
        as_read_only(centres(x0, x1, m)),
        as_read_only(centres(y0, y1, n)),
        as_read_only(rows[:, 0].copy()),
        as_read_only(rows[:, 1].astype(int)),
        as_read_only(rows[:, 2].copy()),
        abs(span),
        level.name,
    )


def require_plane(section: PoincareSection) -> None:
    """Raise an error if a section has only one coordinate.

    Parameters
    ----------
    section : PoincareSection
        The section.

    Raises
    ------
    InvalidParameter
        If it has only one coordinate.
    """
    if len(section.names) != 2:
        raise InvalidParameter(
            f"This section has only the coordinate {section.names[0]}: choose a body whose section has two."
        )


def corners(section: PoincareSection, window: Window | None) -> Window:
    """Return the corners of a window of a section.

    Parameters
    ----------
    section : PoincareSection
        The section.
    window : ((float, float), (float, float)) or None
        The corners; None for the whole section.

    Returns
    -------
    Window
        The corners, the lower left one first.

    Raises
    ------
    InvalidParameter
        If the corners are not finite, out of order or outside of the section, or it has only one coordinate.
    """
    require_plane(section)
    names, sides = section.names, section.window
    given = tuple(zip(*sides, strict=True)) if window is None else window
    (x0, y0), (x1, y1) = (as_point(names, corner) for corner in given)
    # A window may start at any angle.
    inside = all(
        math.isfinite(turn) or (low <= a and b <= high)
        for turn, (low, high), a, b in zip(section.turns, sides, (x0, y0), (x1, y1), strict=True)
    )
    if not (x0 < x1 and y0 < y1 and inside):
        across, up = (f"{low:.6g} to {high:.6g}" for low, high in sides)
        raise InvalidParameter(
            f"({x0:.6g}, {y0:.6g}), ({x1:.6g}, {y1:.6g}) is not a window: give (x0, y0), (x1, y1) with x0 < x1 and y0 "
            f"< y1. On this section {names[0]} runs from {across}, {names[1]} from {up}."
        )
    return (x0, y0), (x1, y1)


def time_of(section: PoincareSection, turns: float) -> float:
    """Return the time that typical motions through a section take for a number of turns: `turns` × slowness/ν.

    ν is the median of the frequency of the system over the points of a 16 × 16 grid at which motions cross the section.

    Parameters
    ----------
    section : PoincareSection
        A section with two coordinates.
    turns : float
        Number of turns.

    Returns
    -------
    float
        The time, in units T.

    Raises
    ------
    OutsideRegion
        If no motion crosses the section at these points.
    """
    (x0, x1), (y0, y1) = section.window
    x, y = np.meshgrid(centres(x0, x1, _TRIED), centres(y0, y1, _TRIED))
    states, there = section.states_at(x.ravel(), y.ravel())
    if not there.any():
        raise OutsideRegion("No motion crosses this section: choose a larger energy, or other parameters.")
    nu = section.system.frequency(states[there].T, np.array(section.parameters))
    return float(turns * section.slowness / np.median(nu))
