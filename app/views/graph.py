"""Graphs of functions on linear axes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from app import theme
from app.views.chart import Series
from app.views.figure import Figure, Range
from app.wire import Wire
from models.results import Array

__all__ = ["Graph"]


class Graph(Figure):
    """Some series in one frame; a click chooses a place on the horizontal axis.

    Every series may have several branches, so that curves with jumps (angles) are not joined across them.
    """

    def __init__(self, wire: Wire, name: str, labels: tuple[str, str], x_range: Range, y_range: Range,
                 series: Sequence[Series], picks: Sequence[str] = (),
                 ticks: Sequence[tuple[float, str]] | None = None,
                 y_ticks: Sequence[tuple[float, str]] | None = None) -> None:
        super().__init__(wire, name, labels, x_range, y_range, picks=picks, ticks=ticks, y_ticks=y_ticks)
        self.add("levels", "segment", ("x0", "y0", "x1", "y1"), color=theme.MUTED, line_dash="dotted", line_width=1.5)
        for one in series:
            self.add(one.name, "multi_line", ("xs", "ys"), color=one.color, line_dash=one.dash, line_width=2)
        self.add("chosen", "scatter", ("x", "y"), size=18, fill_alpha=0, line_color=theme.UNSTABLE, line_width=3)
        self.add_point_and_message()

    def show(self, name: str, x: Array, y: Array, jump: float | None = None) -> None:
        """One series; steps of more than `jump` in x or y are not joined."""
        x, y = np.asarray(x, float), np.asarray(y, float)
        cuts = [] if jump is None else np.flatnonzero((np.abs(np.diff(x)) > jump) | (np.abs(np.diff(y)) > jump)) + 1
        self.assign(name, xs=[part.astype(np.float32) for part in np.split(x, cuts)],
                    ys=[part.astype(np.float32) for part in np.split(y, cuts)])

    def show_levels(self, heights: Sequence[float]) -> None:
        """Dotted lines across the frame at these heights."""
        low, high = self.x_range
        reach = high - low
        self.assign("levels", x0=[low - reach] * len(heights), y0=list(heights), x1=[high + reach] * len(heights),
                    y1=list(heights))

    def choose(self, x: float, y: float) -> None:
        """A ring round one point."""
        self.assign("chosen", x=[x], y=[y])
