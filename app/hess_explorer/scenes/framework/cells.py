"""Cells of a section, computed row by row: coarse ones all over it first, then finer ones."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import Any

import numpy as np

from hess_explorer.scenes.framework.windows import Window, frame_of
from hess_explorer.scenes.framework.work import Work
from hess_explorer.views.comparison import Cells
from hess_mechanics.numerics.results import Array

__all__ = ["CELLS", "COARSE", "Arguments", "changed", "found_by_rows", "look"]

CELLS = (36, 24)
"""Across and up a section at `standard`."""
COARSE = 3
"""Cells along each side of one of those that are seen first: odd, so that its middle is that of one of them."""

Arguments = tuple[Any, ...]


def found_by_rows(
    work: Work,
    row_of: Callable[..., Array],
    coarse: Sequence[Arguments],
    fine: Sequence[Arguments],
    sooner: Callable[[], object],
) -> tuple[Array, int] | None:
    """The cells (n, …, m), and how many of their rows are still coarse.

    row_of : a row of cells (…, m) from its arguments, of a coarse or of a fine one; sooner : asks for what is to come
    between the coarse and the fine ones.  None before all coarse ones are known, of which each is the middle one of
    `COARSE`² cells.
    """
    first = [work.later(row_of, *row) for row in coarse]
    sooner()
    # Every third one first: all over the window it becomes finer.
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
    """How many of 100 cells (n, m) are others among finer ones, which are these or divide them."""
    rows, columns = (np.arange(fine) * coarse // fine for coarse, fine in zip(cells.shape, truth.shape, strict=True))
    return 100.0 * float(np.mean(cells[np.ix_(rows, columns)] != truth))


def look(frame: Window, names: Sequence[str], cells: Array) -> Cells:
    """How cells whose numbers are names, −1 where there is nothing, are compared: any other one is another colour."""
    return Cells(frame_of(frame, names), np.where(cells < 0.0, np.nan, cells), step=0.5)
