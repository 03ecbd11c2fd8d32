"""How much of a picture of basins hangs on its cells: those that a finer grid would change lie along the boundary."""

from __future__ import annotations

import numpy as np

from hess_mechanics.numerics.results import Array

__all__ = ["unsure"]


def unsure(cells: Array) -> float:
    """About which share of the cells (m, n) twice as many along each side would change, from the cells themselves.

    cells : a number for each basin.  A straight boundary passes through a cell for each pair of neighbours that differ,
    more or less, and takes a quarter of the area of such a cell from the basin of its centre.
    """
    across, up = np.abs(np.diff(cells, axis=1)) > 0, np.abs(np.diff(cells, axis=0)) > 0
    return 0.25 * float(across.sum() + up.sum()) / cells.size
