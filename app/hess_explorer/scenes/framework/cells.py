"""Cells of a picture, computed row by row: coarse cells everywhere first, then finer ones."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.work import Work
from hess_mechanics.numerics.results import Array

CELLS = (36, 24)
"""Cells across and up a section at the level `standard`."""
COARSE = 3
"""Fine cells along each side of a coarse one: odd, so that the middle of the coarse cell is that of a fine one."""

DENSITY = "density"
"""Choice that shows the density of crossings under the points of a section."""

Arguments = tuple[Any, ...]


def cells_by_rows(
    work: Work,
    row_of: Callable[..., Array],
    stages: Sequence[Sequence[Arguments]],
    sooner: Callable[[], object] = lambda: None,
) -> tuple[Array, int] | None:
    """Return the cells (n, …, m) in the resolution of the last stage, and the number of rows that are still coarse.

    Rows that are not yet known repeat the cells of the stage before.  None until all rows of the first stage are known.

    Parameters
    ----------
    work : Work
        Computation of the state.
    row_of : callable
        Computes a row of cells (…, m) from its arguments.
    stages : sequence of sequences
        Arguments of the rows of each stage, the coarsest first.  Each stage has `COARSE` times as many rows
        and columns as the one before.
    sooner : callable, optional
        Requests results that are computed right after the first stage; by default none.

    Returns
    -------
    (array (n, …, m), int) or None
        The cells, and the number of rows of the last stage that are still unknown.
    """
    cells: Array | None = None
    left = 0
    for stage, rows in enumerate(stages):
        # Compute every third row first, so that the whole window becomes finer evenly.
        order = [i for begun in range(COARSE) for i in range(begun, len(rows), COARSE)]
        found = {i: row for i in order if (row := work.need(Task(row_of, *rows[i]), preview=None)) is not None}
        left = len(rows) - len(found)
        if stage == 0:
            sooner()
            cells = None if left else np.stack([found[i] for i in range(len(rows))])
        elif cells is not None:
            cells = np.repeat(np.repeat(cells, COARSE, axis=0), COARSE, axis=-1)
            for i, row in found.items():
                cells[i] = row
    return None if cells is None else (cells, left)


def change_percentage(cells: Array, truth: Array) -> float:
    """Return the percentage of the cells of `truth` in which `cells`, a grid that is no finer, has another value.

    Parameters
    ----------
    cells : array (n, m)
        Categories of the cells.
    truth : array (k, l)
        Categories on the same window, with k ≥ n and l ≥ m.
    """
    rows, columns = (np.arange(fine) * coarse // fine for coarse, fine in zip(cells.shape, truth.shape, strict=True))
    return 100.0 * float(np.mean(cells[np.ix_(rows, columns)] != truth))
