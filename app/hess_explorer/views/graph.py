"""Graphs of functions on linear axes."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hess_explorer.protocol.wire import Wire
from hess_explorer.views import theme
from hess_explorer.views.chart import Series
from hess_explorer.views.figure import Figure, Range
from hess_mechanics.numerics.results import Array

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
        self.add("across", "text", ("x", "y", "text"), text_color=theme.MUTED, text_font_size=theme.FONT_SIZE,
                 text_align="right", x_offset=-6, y_offset=-4)
        self.add("chosen", "scatter", ("x", "y"), size=18, fill_alpha=0, line_color=theme.UNSTABLE, line_width=3)
        self.add_point_and_message()

    def show(self, name: str, x: Array, y: Array, period: float | None = None) -> None:
        """One series; `period`: x is an angle, and a curve that leaves at one edge goes on at the other."""
        x, y = np.asarray(x, float), np.asarray(y, float)
        parts = [(x, y)] if period is None else _branches(x, y, period)
        self.assign(name, xs=[part.astype(np.float32) for part, _ in parts],
                    ys=[part.astype(np.float32) for _, part in parts])

    def name_across(self, text: str) -> None:
        """What the horizontal axis is, in the corner of the frame, where it is not always the same."""
        self.assign("across", x=[self.x_range[1]], y=[self.y_range[0]], text=[text])

    def show_levels(self, heights: Sequence[float]) -> None:
        """Dotted lines across the frame at these heights."""
        low, high = self.x_range
        reach = high - low
        self.assign("levels", x0=[low - reach] * len(heights), y0=list(heights), x1=[high + reach] * len(heights),
                    y1=list(heights))

    def choose(self, x: float, y: float) -> None:
        """A ring round one point."""
        self.assign("chosen", x=[x], y=[y])


def _branches(x: Array, y: Array, period: float) -> list[tuple[Array, Array]]:
    """A curve over an angle in ±period/2, cut where the angle passes ±period/2; every part reaches to the edge."""
    cuts = np.flatnonzero(np.abs(np.diff(x)) > period / 2)
    edges = np.copysign(period / 2, x[cuts])
    before, after = np.abs(edges - x[cuts]), np.abs(edges + x[cuts + 1])
    share = np.divide(before, before + after, out=np.zeros(cuts.size), where=before + after > 0.0)
    heights = y[cuts] + share * (y[cuts + 1] - y[cuts])
    at = np.repeat(cuts + 1, 2)
    x, y = np.insert(x, at, np.column_stack([edges, -edges]).ravel()), np.insert(y, at, np.repeat(heights, 2))
    ends = cuts + 2 + 2 * np.arange(cuts.size)
    return list(zip(np.split(x, ends), np.split(y, ends), strict=True))
