"""The chart of a scene: a number of the catalogue over two of the scene's parameters, as one of its pictures.

A scene declares the computations and their arguments (`Charts`).  The choices of the chart, which are parameters of the
state, and the picture follow from them.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, make_dataclass
from functools import cached_property
from typing import Any, Self

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.compute.cells import Outcome
from hess_explorer.protocol.specs import ChoiceSpec, NumberSpec, Points, Spec, Values
from hess_explorer.scenes.framework.cells import COARSE, cells_by_rows
from hess_explorer.scenes.framework.chart_cells import STORED, Cells, Side, chart_row
from hess_explorer.scenes.framework.charted import Charts, Numbers
from hess_explorer.scenes.framework.part import Part, part
from hess_explorer.scenes.framework.sliders import declare, specs_of
from hess_explorer.scenes.framework.trial import bare_state
from hess_explorer.scenes.framework.windows import Window, box_window, normalized_window, window_of
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import CellGrid, Positions, crop
from hess_explorer.views.picture import Corners
from hess_explorer.views.text import digits, range_text, with_error
from hess_mechanics import catalogue
from hess_mechanics.numerics.accuracy import level
from hess_mechanics.numerics.results import Array

_FIRST, _STAGES = 8, 3
"""Cells along a side of the first stage, and the number of stages; one more where many cells are computed at once."""
_BEYOND = 0.01
"""Share of the numbers beyond each end of the colours: without it one outlier would take all colours."""
_FAR, _LARGEST = 1e6, 1e38
"""Bound on the coordinates of a window; bound on the drawn numbers, within the range of single precision."""


@dataclass(frozen=True, eq=False)
class _Chart(Part[Any]):
    """The chart of a state, from the numbers by option and the sides by symbol."""

    numbers: Numbers
    sides: Mapping[str, Side]

    @property
    def axes(self) -> tuple[Side, Side]:
        """The horizontal and the vertical side."""
        return self.sides[self.host.chart_x], self.sides[self.host.chart_y]

    @property
    def point(self) -> tuple[float, float]:
        """The point of this state in the chart."""
        return self.axes[0].of(self.host), self.axes[1].of(self.host)

    def adjustments(self, before: Self) -> Values:
        """Return an empty window, which shows the whole chart, if an axis has changed; otherwise nothing."""
        return {} if self.axes == before.axes else {"chart_window": ""}

    @property
    def number(self) -> catalogue.Number:
        """The number that the chart shows."""
        source, number = self.numbers[self.host.chart]
        return source.computation.number(number)

    @cached_property
    def key(self) -> Cells:
        """Cache key of the cells.  They do not depend on the values that the parameters of both sides have here."""
        x, y = self.axes
        state = y.put(x.put(bare_state(self.host), x.ends[0]), y.ends[0])
        return Cells(*self.numbers[self.host.chart], x, y, state, level(self.work.level_name))

    @cached_property
    def window(self) -> Window:
        """The visible window: the chosen one, or else that of a displayed stored sweep, or else the whole chart."""
        x, y = self.axes
        whole = (x.ends[0], y.ends[0]), (x.ends[1], y.ends[1])
        return window_of(normalized_window(self.host.chart_window), STORED.get(self.key, ((), whole))[1])

    @cached_property
    def _rows(self) -> tuple[Array, int, Window] | None:
        """Rows (n, 3, m) of cells, the number of rows still coarse, and the window of the cells; None until known."""
        if self.key in STORED:
            cells, window = STORED[self.key]
            return cells, 0, window
        # Request the number of this state before the numbers of the cells.
        _ = self.own
        more = self.key.source.computation.vectorized is not None
        counts = [_FIRST * COARSE**stage for stage in range(_STAGES + more)]
        rows = [[(self.key, self.window, count, row) for row in range(count)] for count in counts]
        found = cells_by_rows(self.work, chart_row, rows)
        return None if found is None else (*found, self.window)

    @cached_property
    def own(self) -> Array | None:
        """Value, error and status (3, 1) of this state; None until known."""
        return self.work.need(Task(chart_row, self.key, (self.point, self.point), 1, 0), preview=None)

    @cached_property
    def cells(self) -> CellGrid | None:
        """The cells; None until known.

        The ends of their colours are one turn, or the range without outliers; None for categories, and without numbers.
        """
        if self._rows is None:
            return None
        values, _, ((x0, y0), (x1, y1)) = self._rows
        number, values = self.number, np.where(np.abs(values[:, 0]) < _LARGEST, values[:, 0], np.nan)
        known, ends = values[np.isfinite(values)], None
        if number.turn:
            values, ends = values - number.turn * np.round(values / number.turn), (-number.turn / 2, number.turn / 2)
        elif not number.categories and known.size:
            low, high = np.quantile(known, (_BEYOND, 1.0 - _BEYOND)).tolist()
            room = max(1e-6 * abs(low), 1e-9) if low == high else 0.0
            ends = low - room, high + room
        return CellGrid(values, (x0, x1), (y0, y1), ends)

    def here(self) -> Positions:
        """Return the point of the state, or an empty list if the window does not contain it."""
        return crop([self.point], self.window)

    def choose(self, x: float, y: float) -> Values:
        """Return the values that a click at a point sets.  Raises `ModelError` if no number can be computed there."""
        across, up = self.axes
        state = up.put(across.put(self.host, x), y)
        self.key.source.values(state)
        return {one.name: getattr(state, one.name) for one in (across, up)}

    def box_window(self, corners: Corners) -> Values:
        """Return the window of a box, clipped to the ranges of the sides; nothing for a box without area."""
        (x0, x1), (y0, y1) = (one.ends for one in self.axes)
        return box_window(corners, ((x0, y0), (x1, y1)), "chart_window")

    def _says(self, value: float, error: float, status: float) -> str:
        outcome, number = Outcome(int(status)), self.number
        if not math.isfinite(value):
            return f"No number: {(outcome if outcome >= Outcome.OUTSIDE_REGION else Outcome.NO_VALUE).words}."
        said = number.categories.get(round(value)) or (with_error(value, error) if error > 0.0 else digits(value))
        unit = "" if number.unit == "1" else f" {number.unit}"
        return f"{number.symbol} = {said}{unit}{'' if outcome is Outcome.OK else f' ({outcome.words})'}."

    def about(self, x: float, y: float) -> str:
        """Return the tooltip of the cell at a point; empty until the cells are known."""
        if self._rows is None:
            return ""
        cells, _, window = self._rows
        at = zip((x, y), *window, (cells.shape[2], cells.shape[0]), strict=True)
        column, row = (min(max(int((one - low) / (high - low) * n), 0), n - 1) for one, low, high, n in at)
        across, up = self.axes
        return f"{across.symbol} = {digits(x)}, {up.symbol} = {digits(y)}: {self._says(*cells[row, :, column])}"

    @property
    def caption(self) -> Caption:
        """The caption: the number in this state, and the progress of the cells."""
        verdict = "" if self.own is None else self._says(*self.own[:, 0])
        if self._rows is None or self.cells is None:
            return Caption(verdict, self.work.pending_caption("The chart is"))
        cells, coarse, _ = self._rows
        rows, _, columns = cells.shape
        said = [f"{columns} × {rows} cells" + f", {rows - coarse} rows known" * (coarse > 0)]
        if self.cells.ends is not None:
            said.append(f"colours {range_text(*self.cells.ends, 3)}")
        return Caption(verdict, f"{'; '.join(said)}.")


def _sides(charts: Charts, state: type[Any]) -> Mapping[str, Side]:
    found = []
    for spec in specs_of(state):
        if isinstance(spec, NumberSpec):
            found.append(Side(spec.symbol, spec.name, spec.softbounds))
        elif isinstance(spec, Points) and spec.name == charts.point[0]:
            ends = zip(spec.low, spec.high, strict=True)
            found += [Side(charts.point[1][i], spec.name, both, i) for i, both in enumerate(ends)]
    return {one.symbol: one for one in found}


def with_chart(state: type[Any], charts: Charts) -> type[Any]:
    """Return a class of states with the additional choices of a chart, which do not change other results.

    Parameters
    ----------
    state : type
        Class of the states without the chart.
    charts : Charts
        The numbers and the initial sides.
    """
    numbers, sides = charts.numbers, _sides(charts, state)
    x, y = (next(symbol for symbol, side in sides.items() if one in (symbol, side.name)) for one in charts.over)
    along = "Parameter along this axis."
    specs: tuple[Spec, ...] = (
        ChoiceSpec(
            "chart", "Number", (*numbers,), next(iter(numbers)), "Displayed number, named as in commands.", "Chart"
        ),
        ChoiceSpec("chart_x", "Across", (*sides,), x, along, "Chart"),
        ChoiceSpec("chart_y", "Up", (*sides,), y, along, "Chart"),
        Points("chart_window", "The window of the chart", 2, (-_FAR, -_FAR), (_FAR, _FAR)),
    )

    return make_dataclass(
        state.__name__,
        [(spec.name, str, declare(spec, compare=False)) for spec in specs],
        bases=(state,),
        frozen=True,
        namespace={"__module__": state.__module__, "chart_part": part(lambda s: _Chart(s, numbers, sides))},
    )
