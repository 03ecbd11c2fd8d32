"""Cells of a picture of basins, divided along the boundaries, and how much a finer grid would change."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.dynamics.attraction import Arrivals, Orbits, RecurrentSets, arrivals
from hess_mechanics.dynamics.cells import Window, centres
from hess_mechanics.numerics.results import Mask, frozen

__all__ = ["arrivals_of_cells", "divided", "joined", "resolved", "unsure"]


def _on_boundary(cells: NDArray[Any]) -> Mask:
    """Return a mask (n, m) of the cells with another number than one of their eight neighbours."""
    from scipy import ndimage

    return np.asarray(ndimage.maximum_filter(cells, 3) != ndimage.minimum_filter(cells, 3))


def _halved(cells: NDArray[Any]) -> NDArray[Any]:
    """Return cells (2n, 2m) of half the size."""
    return cells.repeat(2, axis=0).repeat(2, axis=1)


def divided(before: Arrivals | None, cells: tuple[int, int], everywhere: bool, most: int) -> Mask:
    """Return the mask (n, m) of the cells (m, n) to compute: half as large as before, along the boundaries.

    before : None for the first cells, which are all computed.  everywhere : divide all cells.  most : a boundary in
    more cells is no curve, and they are left as they are.
    """
    if before is None or everywhere:
        return np.ones(cells[::-1], bool)
    mask = _halved(_on_boundary(before.number))
    return mask if mask.sum() <= most else np.zeros_like(mask)


def arrivals_of_cells(orbits: Orbits, sets: RecurrentSets, window: Window, mask: Mask, part: slice) -> Arrivals:
    """Return the arrivals from the centres of a part of the cells of a mask (n, m).  Raises as `arrivals`."""
    (x0, y0), (x1, y1) = window
    rows, columns = (one[part] for one in np.nonzero(mask))
    n, m = mask.shape
    return arrivals(orbits, sets, centres(x0, x1, m)[columns], centres(y0, y1, n)[rows])


def joined(before: Arrivals | None, mask: Mask, found: Sequence[tuple[slice, Arrivals]]) -> Arrivals:
    """Return the arrivals from all cells (n, m): those of a mask, found in parts, and the others as before."""
    first = np.empty(mask.shape, np.int16)
    number, crossings = (first, first.copy()) if before is None else (_halved(before.number), _halved(before.crossings))
    rows, columns = np.nonzero(mask)
    for part, one in found:
        at = rows[part], columns[part]
        number[at], crossings[at] = one.number, one.crossings
    return Arrivals(frozen(number), frozen(crossings))


def resolved(cells: NDArray[Any]) -> NDArray[Any]:
    """Return the coarsest cells (n, m) that show the same boundaries: some are left undivided, see `divided`."""
    while np.ptp(cells) and not any(side % 2 for side in cells.shape):
        coarse = cells[::2, ::2]
        if not np.array_equal(_halved(coarse), cells):
            break
        cells = coarse
    return cells


def unsure(cells: NDArray[Any]) -> float:
    """Estimate the fraction of the area of the cells (m, n) that a grid twice as fine would assign to another basin.

    cells : number of the basin at the centre of each cell.  A straight boundary passes through about one cell for each
    pair of neighbours that differ; about a quarter of that cell lies in another basin than its centre.
    """
    across, up = np.abs(np.diff(cells, axis=1)) > 0, np.abs(np.diff(cells, axis=0)) > 0
    return 0.25 * float(across.sum() + up.sum()) / cells.size
