"""Grids of cells for pictures of basins, refined along the boundaries, and the change that a finer grid would make."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.dynamics.attraction import Arrivals, Orbits, RecurrentSets, arrivals
from hess_mechanics.dynamics.cells import Window, centres
from hess_mechanics.numerics.results import Mask, as_read_only

__all__ = ["ambiguity", "arrivals_of_cells", "cells_to_compute", "coarsest_cells", "merge"]


def _on_boundary(cells: NDArray[Any]) -> Mask:
    """Return the mask (n, m) of the cells whose number differs from that of one of their eight neighbours."""
    from scipy import ndimage

    return np.asarray(ndimage.maximum_filter(cells, 3) != ndimage.minimum_filter(cells, 3))


def _halved(cells: NDArray[Any]) -> NDArray[Any]:
    """Return the cells (n, m) divided into cells (2n, 2m) of half the size."""
    return cells.repeat(2, axis=0).repeat(2, axis=1)


def cells_to_compute(before: Arrivals | None, cells: tuple[int, int], everywhere: bool, most: int) -> Mask:
    """Return the mask of the cells to compute: those along the boundaries, half as large as before.

    Parameters
    ----------
    before : Arrivals or None
        Arrivals from cells of twice the size; None for the first cells, which are all computed.
    cells : (int, int)
        Numbers (m, n) of the new cells across and up.
    everywhere : bool
        Compute all cells, not only those along the boundaries.
    most : int
        Largest number of new cells along the boundaries.  If there are more, the boundaries are not curves, and no
        cell is computed.

    Returns
    -------
    ndarray of bool, shape (n, m)
        True for the cells to compute.
    """
    if before is None or everywhere:
        return np.ones(cells[::-1], bool)
    mask = _halved(_on_boundary(before.number))
    return mask if mask.sum() <= most else np.zeros_like(mask)


def arrivals_of_cells(orbits: Orbits, sets: RecurrentSets, window: Window, mask: Mask, part: slice) -> Arrivals:
    """Return the arrivals of the orbits from the centres of some cells.

    Parameters
    ----------
    orbits : Orbits
        The orbits of the section.
    sets : RecurrentSets
        The recurrent sets.
    window : ((float, float), (float, float))
        Corners of the window that the cells fill, see `Window`.
    mask : ndarray of bool, shape (n, m)
        True for the cells to compute.
    part : slice
        Part of these cells, row after row.

    Returns
    -------
    Arrivals
        The arrivals from the cells of this part, in their order.

    Raises
    ------
    WorkLimit
        If an orbit needs too many steps.
    """
    (x0, y0), (x1, y1) = window
    rows, columns = (one[part] for one in np.nonzero(mask))
    n, m = mask.shape
    return arrivals(orbits, sets, centres(x0, x1, m)[columns], centres(y0, y1, n)[rows])


def merge(before: Arrivals | None, mask: Mask, parts: Sequence[tuple[slice, Arrivals]]) -> Arrivals:
    """Return the arrivals from all cells: new ones where a mask is True, elsewhere those from before.

    Parameters
    ----------
    before : Arrivals or None
        Arrivals from cells of twice the size; None for the first cells, whose mask must be True everywhere.
    mask : ndarray of bool, shape (n, m)
        True for the cells that were computed.
    parts : sequence of (slice, Arrivals)
        Parts of these cells, as for `arrivals_of_cells`, with their arrivals.

    Returns
    -------
    Arrivals
        Arrivals of shape (n, m).
    """
    first = np.empty(mask.shape, np.int16)
    number, crossings = (first, first.copy()) if before is None else (_halved(before.number), _halved(before.crossings))
    rows, columns = np.nonzero(mask)
    for part, one in parts:
        at = rows[part], columns[part]
        number[at], crossings[at] = one.number, one.crossings
    return Arrivals(as_read_only(number), as_read_only(crossings))


def coarsest_cells(cells: NDArray[Any]) -> NDArray[Any]:
    """Return the coarsest grid that shows the same boundaries.

    A grid whose cells were not divided, see `cells_to_compute`, consists of blocks of 2 × 2 equal cells.

    Parameters
    ----------
    cells : ndarray, shape (n, m)
        Number of the basin of each cell.

    Returns
    -------
    ndarray, shape (n/2ᵏ, m/2ᵏ)
        The cells, after k ≥ 0 halvings of the grid; k = 0 if all numbers are equal.
    """
    while np.ptp(cells) and not any(side % 2 for side in cells.shape):
        coarse = cells[::2, ::2]
        if not np.array_equal(_halved(coarse), cells):
            break
        cells = coarse
    return cells


def ambiguity(cells: NDArray[Any]) -> float:
    """Estimate the fraction of the area that a grid twice as fine would assign to another basin.

    A straight boundary passes through about one cell for each pair of neighbours that differ; about a quarter of that
    cell lies in another basin than its centre.

    Parameters
    ----------
    cells : ndarray, shape (n, m)
        Number of the basin at the centre of each cell.

    Returns
    -------
    float
        The fraction, 0 to ½.
    """
    across, up = np.abs(np.diff(cells, axis=1)) > 0, np.abs(np.diff(cells, axis=0)) > 0
    return 0.25 * float(across.sum() + up.sum()) / cells.size
