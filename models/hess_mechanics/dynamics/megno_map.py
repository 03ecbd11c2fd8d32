"""MEGNO over the cells of a section: where motions are regular, where chaotic, and where volume about them shrinks."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hess_mechanics.dynamics.cells import Window, centres
from hess_mechanics.dynamics.megno import megno
from hess_mechanics.dynamics.periodic import place_units
from hess_mechanics.dynamics.return_map import PoincareSection, ReturnMap
from hess_mechanics.errors import InvalidParameter, OutsideRegion
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.arguments import as_cells, as_number, as_place
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.parallel import share
from hess_mechanics.numerics.results import Array, frozen

__all__ = ["NOWHERE", "MegnoMap", "megno_map", "require_plane", "row_of_cells", "time_of"]

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
        return Labels(
            {up: ((up,), self.y), across: ((across,), self.x)},
            {"MEGNO": ((up, across), self.values), "kind": ((up, across), self.kind)},
            {**place_units(self.names), "MEGNO": "1"},
            {"t": self.t, "level": self.level},
        )


def row_of_cells(
    section: PoincareSection, window: Window, cells: tuple[int, int], row: int, t: float, level: Accuracy
) -> Array:
    """Ȳ and kind, (2, m), of the motions from the middles of the cells of a row.

    cells : (m, n) across and up the window; the row is counted from below.  Raises `InvalidParameter`, `WorkLimit`.
    """
    (x0, y0), (x1, y1) = window
    m, n = cells
    states, there = section.states_at(centres(x0, x1, m), np.full(m, centres(y0, y1, n)[row]))
    out = np.stack([np.full(m, np.nan), np.full(m, float(NOWHERE))])
    if there.any():
        found = megno(section, states[there], t, level, threads=1)
        out[:, there] = found.values, found.chaotic + 2.0 * found.attracted
    return frozen(out)


def megno_map(
    map_: ReturnMap, cells: tuple[int, int] = (16, 12), window: Window | None = None, t: float = 200.0
) -> MegnoMap:
    """Return MEGNO of the motions from the cells of a section after the time t, computed on all cores.

    Parameters
    ----------
    map_ : a `return_map` of a section with two coordinates.
    cells : how many across and up.
    window : its corners (x0, y0) and (x1, y1); by default all of the section.
    t : the time of the indicator; negative for backward in time.

    Raises
    ------
    `InvalidParameter`, `WorkLimit`.

    >>> from hess_mechanics import QuarticBody, megno_map, return_map
    >>> found = megno_map(return_map(QuarticBody(2.0, 1.0, 1.0, 0.8), accuracy="standard"), cells=(6, 4), t=50.0)
    >>> found.values.shape, found.names
    ((4, 6), ('q', 'p'))
    """
    section, level = map_.section, map_.accuracy
    corners = (x0, y0), (x1, y1) = _corners(section, window)
    m, n = shape = as_cells(cells)
    span = as_number("t", t)
    rows = np.empty((n, 2, m))

    def row(i: int) -> None:
        rows[i] = row_of_cells(section, corners, shape, i, span, level)

    share(row, n)
    across, up = section.names
    return MegnoMap(
        (across, up),
        frozen(centres(x0, x1, m)),
        frozen(centres(y0, y1, n)),
        frozen(rows[:, 0].copy()),
        frozen(rows[:, 1].astype(int)),
        abs(span),
        level.name,
    )


def require_plane(section: PoincareSection) -> None:
    """Raise `InvalidParameter` where a section has only one coordinate."""
    if len(section.names) != 2:
        raise InvalidParameter(
            f"The section of this body has the coordinate {section.names[0]} alone: there is no "
            "plane to fill with cells."
        )


def _corners(section: PoincareSection, window: Window | None) -> Window:
    """Return the corners of a window within a section, or of the section itself.  Raises `InvalidParameter`."""
    require_plane(section)
    names, sides = section.names, section.window
    given = tuple(zip(*sides, strict=True)) if window is None else window
    (x0, y0), (x1, y1) = (as_place(names, corner) for corner in given)
    # An angle may begin where it likes.
    inside = all(
        math.isfinite(turn) or (low <= a and b <= high)
        for turn, (low, high), a, b in zip(section.turns, sides, (x0, y0), (x1, y1), strict=True)
    )
    if not (x0 < x1 and y0 < y1 and inside):
        across, up = (f"{low:.6g} to {high:.6g}" for low, high in sides)
        raise InvalidParameter(
            "A window is (x0, y0), (x1, y1) with x0 < x1, y0 < y1: here "
            f"{names[0]} goes from {across}, {names[1]} from {up}."
        )
    return (x0, y0), (x1, y1)


def time_of(section: PoincareSection, turns: float) -> float:
    """So many times 1/ν times the slowness of the section, the median ν of places all over it.

    Raises `OutsideRegion` where none of them is possible.
    """
    (x0, x1), (y0, y1) = section.window
    x, y = np.meshgrid(centres(x0, x1, _TRIED), centres(y0, y1, _TRIED))
    states, there = section.states_at(x.ravel(), y.ravel())
    if not there.any():
        raise OutsideRegion("No motion of this energy crosses the section: choose a larger one.")
    nu = section.system.frequency(states[there].T, np.array(section.parameters))
    return float(turns * section.slowness / np.median(nu))
