"""Discretisation error of a picture of basins: a finer grid changes the cells along the boundary."""

from __future__ import annotations

import numpy as np

from hess_mechanics.numerics.results import Array

__all__ = ["unsure"]


def unsure(cells: Array) -> float:
    """Estimate the fraction of the area of the cells (m, n) that a grid twice as fine would assign to another basin.

    cells : number of the basin at the centre of each cell.  A straight boundary passes through about one cell for each
    pair of neighbours that differ; about a quarter of that cell lies in another basin than its centre.
    """
    across, up = np.abs(np.diff(cells, axis=1)) > 0, np.abs(np.diff(cells, axis=0)) > 0
    return 0.25 * float(across.sum() + up.sum()) / cells.size
