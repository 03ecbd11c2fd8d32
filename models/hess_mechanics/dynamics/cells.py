"""Windows of a plane, and the cells that fill them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hess_mechanics.numerics.results import Array

__all__ = ["Window", "centres", "even_points", "occupied_cells"]

Window = tuple[tuple[float, float], tuple[float, float]]
"""Two opposite corners, (x0, y0), (x1, y1), the lower left one first."""


def centres(low: float, high: float, count: int) -> Array:
    """Return the centres of equal cells that fill an interval.

    Parameters
    ----------
    low, high : float
        Ends of the interval.
    count : int
        Number of cells.

    Returns
    -------
    ndarray, shape (count,)
        The centres, from `low` to `high`.
    """
    return low + (np.arange(count) + 0.5) * (high - low) / count


def occupied_cells(points: Array, ranges: Sequence[tuple[float, float]], across: int = 32) -> int:
    """Return the number of equal cells that hold a point: few on a curve, many in a chaotic sea.

    Parameters
    ----------
    points : ndarray, shape (n, 2)
        Coordinates of the points; a point outside the ranges counts in the nearest cell.
    ranges : sequence of (float, float)
        Range of each coordinate, which the cells fill.
    across : int, default 32
        Number of cells along each range.

    Returns
    -------
    int
        The number of cells, at most across².
    """
    low, high = np.array(ranges).T
    at = np.clip((points - low) / (high - low) * across, 0, across - 1).astype(int)
    return len(np.unique(at, axis=0))


_PLASTIC = np.array([[0.7548776662466927], [0.5698402909980532]])
"""1/ρ and 1/ρ² of the plastic number, ρ³ = ρ + 1."""


def even_points(count: int, origin: float = 0.0) -> Array:
    """Return points of the R2 low-discrepancy sequence in the unit square (Roberts, 2018).

    Any initial segment of the sequence fills the square evenly.

    Parameters
    ----------
    count : int
        Number of points.
    origin : float, default 0.0
        Both coordinates of the point before the first.

    Returns
    -------
    ndarray, shape (2, count)
        Coordinates of the points, 0 ≤ x, y < 1.
    """
    return np.asarray((origin + _PLASTIC * np.arange(1, count + 1)) % 1.0)
