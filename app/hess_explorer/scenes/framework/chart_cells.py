"""Cells of a chart: a number of the catalogue at values of two parameters of a scene."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.compute.cells import evaluate, failure
from hess_explorer.protocol.specs import points_of, points_text
from hess_explorer.scenes.framework.charted import ChartSource
from hess_explorer.scenes.framework.windows import Window
from hess_explorer.views.layers import Range
from hess_mechanics.dynamics.cells import centres
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.results import Array, as_read_only


@dataclass(frozen=True)
class Side:
    """A side of a chart: a parameter of the scene, or a coordinate of its last point.

    Attributes
    ----------
    symbol : str
        Symbol on the axis.
    name : str
        Name of the parameter.
    ends : (float, float)
        Default range.
    axis : int or None
        Index of the coordinate, if the parameter is a list of points; None if it is a number.
    """

    symbol: str
    name: str
    ends: Range
    axis: int | None = None

    def of(self, state: Any) -> float:
        """Return the value in a state."""
        value = getattr(state, self.name)
        return float(value) if self.axis is None else points_of(value)[-1][self.axis]

    def put(self, state: Any, value: float) -> Any:
        """Return the state with another value; only the last of several points is kept."""
        if self.axis is None:
            return state.with_values({self.name: value})
        point = [*points_of(getattr(state, self.name))[-1]]
        point[self.axis] = value
        return state.with_values({self.name: points_text([tuple(point)])})


@dataclass(frozen=True)
class Cells:
    """Cache key of the cells of a chart: a number over two parameters, with all others from a state.

    Attributes
    ----------
    source : ChartSource
        The computation.
    number : str
        Name of the number.
    x, y : Side
        The horizontal and the vertical side.
    state : State
        A state from `bare_state`, with both sides at their lower ends.
    level : Level
        Level of accuracy.
    """

    source: ChartSource
    number: str
    x: Side
    y: Side
    state: Any
    level: Level

    def arguments(self, x: float, y: float) -> Mapping[str, Any]:
        """Return the arguments of the computation at a point.  Raises `ModelError`."""
        return self.source.values(self.y.put(self.x.put(self.state, x), y))


def _evaluate_cells(source: ChartSource, number: str, chosen: Level, cells: tuple[Any, ...]) -> Array:
    names = [one.name for one in source.computation.parameters]
    columns = dict(zip(names, np.array(cells, float).T, strict=True))
    found = evaluate(source.computation, (number,), columns, chosen)
    errors = found.errors.get(number, np.full(len(cells), np.nan))
    return as_read_only(np.stack([found.values[number], errors, found.status]))


def chart_row(cells: Cells, window: Window, count: int, row: int) -> Array:
    """Return the values, estimated errors and status (3, count) of one row of `count` × `count` cells.

    Parameters
    ----------
    cells : Cells
        The chart.
    window : Window
        Lower left and upper right corner.
    count : int
        Number of cells along a side.
    row : int
        Index of the row, 0 for the lowest.

    Returns
    -------
    array (3, count)
        Values, NaN where there is none; estimated errors, NaN without an estimate; status as `Outcome`.
    """
    (x0, y0), (x1, y1) = window
    y = float(centres(y0, y1, count)[row])
    found, known = np.full((3, count), np.nan), dict[int, tuple[float, ...]]()
    for i, x in enumerate(centres(x0, x1, count).tolist()):
        try:
            known[i] = tuple(cells.arguments(x, y).values())
        # An error in one cell must not stop the others.
        except Exception as error:
            found[2, i], _ = failure(error, {cells.x.name: x, cells.y.name: y})
    if known:
        # Compare arguments instead of states, because the cells do not depend on the other parameters of the scene.
        found[:, [*known]] = Task(_evaluate_cells, cells.source, cells.number, cells.level, tuple(known.values())).get()
    return as_read_only(found)


STORED: dict[Cells, tuple[Array, Window]] = {}
"""Values, errors and status (n, 3, m) of displayed stored sweeps, and their windows, by the key of the cells."""
