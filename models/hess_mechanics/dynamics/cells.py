"""Windows of a plane, and the cells that fill them."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hess_mechanics.numerics.results import Array

__all__ = ["Window", "centres", "evenly", "occupied_cells"]

Window = tuple[tuple[float, float], tuple[float, float]]
"""Two opposite corners, (x0, y0), (x1, y1), the lower left one first."""


def centres(low: float, high: float, count: int) -> Array:
    """Return the centres of `count` equal cells between two ends, (count,)."""
    return low + (np.arange(count) + 0.5) * (high - low) / count


def occupied_cells(points: Array, ranges: Sequence[tuple[float, float]], across: int = 32) -> int:
    """Return the number of across × across equal cells that hold a point: few on a curve, many in a chaotic sea.

    points : coordinates (n, 2); ranges : the range of each coordinate, which the cells fill.
    """
    low, high = np.array(ranges).T
    at = np.clip((points - low) / (high - low) * across, 0, across - 1).astype(int)
    return len(np.unique(at, axis=0))


_PLASTIC = np.array([[0.7548776662466927], [0.5698402909980532]])
"""1/ρ and 1/ρ² of the plastic number, ρ³ = ρ + 1."""


def evenly(count: int, origin: float = 0.0) -> Array:
    """Return the R2 low-discrepancy sequence (2, count) in the unit square (Roberts, 2018).

    Any initial segment of it fills the square evenly.

    Parameters
    ----------
    count : number of points.
    origin : both coordinates of the point before the first.
    """
    return np.asarray((origin + _PLASTIC * np.arange(1, count + 1)) % 1.0)
