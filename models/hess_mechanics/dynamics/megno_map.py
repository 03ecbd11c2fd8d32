"""MEGNO over the cells of a section: where motions are regular, where chaotic, and where volume about them shrinks."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.cells import Window, centres
from hess_mechanics.dynamics.megno import megno
from hess_mechanics.dynamics.periodic import place_units
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.errors import OutsideRegion
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.parallel import share
from hess_mechanics.numerics.results import Array, frozen

__all__ = ["NOWHERE", "MegnoMap", "over_section", "row_of_cells", "time_of"]

NOWHERE = -1
"""The kind of a cell from whose middle no motion starts."""
_TRIED = 16
"""Places along each side of a section at which its frequency is looked at."""


@dataclass(frozen=True)
class MegnoMap(Result):
    """Regular, chaotic, attracted: MEGNO over the cells of a section.

    x (m,), y (n,) : the middles of the cells; values (n, m) : Ȳ after the time t, NaN where no motion is;
    kind (n, m) : 0 regular, 1 chaotic, and 2 more where volume shrinks beyond its error; −1 where no motion is.
    """

    names: tuple[str, str]
    x: Array
    y: Array
    values: Array
    kind: Array
    t: float
    level: str

    def labels(self) -> Labels:
        """MEGNO and kind over both coordinates."""
        across, up = self.names
        return Labels({up: ((up,), self.y), across: ((across,), self.x)},
                      {"MEGNO": ((up, across), self.values), "kind": ((up, across), self.kind)},
                      {**place_units(self.names), "MEGNO": "1"}, {"t": self.t, "level": self.level})


def row_of_cells(sheet: PoincareSection, window: Window, cells: tuple[int, int], row: int, t: float,
                 level: Accuracy) -> Array:
    """Ȳ and kind, (2, m), of the motions from the middles of the cells of a row.

    cells : (m, n) across and up the window; the row is counted from below.  Raises `InvalidParameter`, `WorkLimit`.
    """
    (x0, y0), (x1, y1) = window
    m, n = cells
    states, there = sheet.states_at(centres(x0, x1, m), np.full(m, centres(y0, y1, n)[row]))
    out = np.stack([np.full(m, np.nan), np.full(m, float(NOWHERE))])
    if there.any():
        found = megno(sheet, states[there], t, level, threads=1)
        out[:, there] = found.values, found.chaotic + 2.0 * found.attracted
    return frozen(out)


def over_section(sheet: PoincareSection, window: Window, cells: tuple[int, int], t: float, level: Accuracy) -> MegnoMap:
    """Of all cells, on all cores.  Raises as `row_of_cells`."""
    level = as_level(level)
    (x0, y0), (x1, y1) = window
    m, n = cells
    rows = np.empty((n, 2, m))

    def row(i: int) -> None:
        rows[i] = row_of_cells(sheet, window, cells, i, t, level)

    share(row, n)
    across, up = sheet.names
    return MegnoMap((across, up), frozen(centres(x0, x1, m)), frozen(centres(y0, y1, n)), frozen(rows[:, 0].copy()),
                    frozen(rows[:, 1].astype(int)), abs(t), level.name)


def time_of(sheet: PoincareSection, turns: float) -> float:
    """So many times 1/ν times the slowness of the section, the median ν of places all over it.

    Raises `OutsideRegion` where none of them is possible.
    """
    (x0, x1), (y0, y1) = sheet.window
    x, y = np.meshgrid(centres(x0, x1, _TRIED), centres(y0, y1, _TRIED))
    states, there = sheet.states_at(x.ravel(), y.ravel())
    if not there.any():
        raise OutsideRegion("No motion of this energy crosses the section: choose a larger one.")
    nu = sheet.system.frequency(states[there].T, np.array(sheet.parameters))
    return float(turns * sheet.slowness / np.median(nu))
