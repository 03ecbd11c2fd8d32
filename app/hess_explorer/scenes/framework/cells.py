"""Cells of a section, computed row by row: first coarse cells all over it, then finer ones."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from hess_explorer.scenes.framework.windows import Window, frame_of
from hess_explorer.scenes.framework.work import Work
from hess_explorer.views.comparison import Cells
from hess_mechanics.numerics.results import Array

__all__ = ["CELLS", "COARSE", "DENSITY", "Arguments", "changed", "found_by_rows", "look"]

CELLS = (36, 24)
"""Cells across and up a section at the level `standard`."""
COARSE = 3
"""Fine cells along each side of a coarse one: odd, so that the middle of the coarse cell is that of a fine one."""

DENSITY = "density"
"""The choice of what lies under the points of a section that counts crossings."""

Arguments = tuple[Any, ...]


def found_by_rows(
    work: Work,
    row_of: Callable[..., Array],
    coarse: Sequence[Arguments],
    fine: Sequence[Arguments],
    sooner: Callable[[], object],
) -> tuple[Array, int] | None:
    """Return the cells (n, …, m), and the number of rows that are still coarse; None until all coarse ones are known.

    row_of : computes a coarse or fine row of cells (…, m) from its arguments; sooner : requests results that are
    computed between the coarse and the fine cells.  Each coarse cell is the middle one of `COARSE`² fine cells.
    """
    first = [work.later(row_of, *row) for row in coarse]
    sooner()
    # Every third row first, so that the whole window becomes finer.
    found = {i: work.later(row_of, *fine[i]) for begun in range(COARSE) for i in range(begun, len(fine), COARSE)}
    known = [row for row in first if row is not None]
    if len(known) < len(first):
        return None
    cells = np.repeat(np.repeat(np.stack(known), COARSE, axis=0), COARSE, axis=-1)
    for i, row in found.items():
        if row is not None:
            cells[i] = row
    return cells, sum(row is None for row in found.values())


def changed(cells: Array, truth: Array) -> float:
    """Return the percentage of cells (n, m) that differ at the points of the truth, in as many cells or finer ones."""
    rows, columns = (np.arange(fine) * coarse // fine for coarse, fine in zip(cells.shape, truth.shape, strict=True))
    return 100.0 * float(np.mean(cells[np.ix_(rows, columns)] != truth))


def look(frame: Window, names: Sequence[str], cells: Array) -> Cells:
    """Return cells of categories, −1 for none, for a comparison in which any change counts."""
    return Cells(frame_of(frame, names), np.where(cells < 0.0, np.nan, cells), step=0.5)
