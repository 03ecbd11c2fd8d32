"""A Poincaré section whose points are of two kinds, with a curve that divides them and what is impossible."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hess_explorer.protocol.wire import Wire
from hess_explorer.views import theme
from hess_explorer.views.figure import Figure, Range
from hess_mechanics.numerics.results import Array

__all__ = ["LayeredSection"]

_MANY = 50_000
_ACROSS = 384
"""Cells across a window: as many as its picture has pixels, on most screens."""


class LayeredSection(Figure):
    """Grey: impossible.  A click starts an orbit, a box looks closer.

    path : whether the source "data-orbit" is drawn here, the way of the chosen orbit over the plane, columns l, x.
    """

    def __init__(self, wire: Wire, name: str, labels: tuple[str, str], x_range: Range, y_range: Range,
                 path: bool = False) -> None:
        super().__init__(wire, name, labels, x_range, y_range, picks=("tap", "doubletap", "box"))
        self.add_image("basins", (theme.FORBIDDEN + "00", theme.POINT + "90", theme.STABLE + "70"), 0.0, 3.0)
        self.add_image("impossible", (theme.FORBIDDEN + "00", theme.FORBIDDEN), 0.0, 1.0)
        self.add("first", "dots", ("x", "y"), size=5, color=theme.ORBIT)
        self.add("second", "dots", ("x", "y"), size=5, color=theme.UNSTABLE)
        self.add("curve", "line", ("x", "y"), color=theme.STABLE, line_width=2)
        if path:
            self.add("path", "dots", ("l", "x"), source="data-orbit", size=3, color=theme.MAP,
                     alpha=0.4)
        self.add("line", "line", ("x", "y"), color=theme.MUTED, line_dash="dashed", line_width=1.5)
        self.add("own", "dots", ("x", "y"), size=10, color=theme.MAP)
        self.add("chosen", "scatter", ("x", "y"), size=16, fill_alpha=0, line_color=theme.MAP, line_width=3)
        self.add_point_and_message()

    def show(self, first: Array, second: Array, own: Array, whole: bool) -> None:
        """Points (n, 2) of either kind, and of the chosen orbit; of very many, those that can be told apart.

        whole : no more are to come; where there are none, the picture says so.
        """
        nothing = True
        for layer, points in (("first", first), ("second", second), ("own", own)):
            within = points[self._within(points)]
            nothing &= len(within) == 0
            seen = points if len(points) <= _MANY else self._apart(within)
            self.assign(layer, x=seen[:, 0].astype(np.float32), y=seen[:, 1].astype(np.float32))
        self.say("" if not (whole and nothing) else
                 "None of the points lies in this window: choose more crossings, or press Undo")

    def _within(self, points: Array) -> np.ndarray:
        (x0, x1), (y0, y1) = self.x_range, self.y_range
        x, y = points.T
        return (x >= x0) & (x <= x1) & (y >= y0) & (y <= y1)

    def _apart(self, within: Array) -> Array:
        """Of points within the window, one in each of its cells."""
        (x0, x1), (y0, y1) = self.x_range, self.y_range
        cells = np.minimum((within - (x0, y0)) * (_ACROSS / (x1 - x0), _ACROSS / (y1 - y0)), _ACROSS - 1).astype(int)
        one = np.full(_ACROSS * _ACROSS, -1)
        one[cells @ (_ACROSS, 1)] = np.arange(len(within))
        return within[np.sort(one[one >= 0])]

    def show_basins(self, cells: Array, x: Range, y: Range) -> None:
        """Cells (m, n) over the window x × y: 0 or 1, by the attractor; −1 where nothing is known."""
        self.assign("basins", image=[(cells + 1.5).astype(np.float32)], x=[x[0]], y=[y[0]], dw=[x[1] - x[0]],
                    dh=[y[1] - y[0]])

    def show_impossible(self, cells: Array, x: Range, y: Range) -> None:
        """Cells (m, n), 1 where nothing is possible, over the window x × y."""
        self.assign("impossible", image=[cells.astype(np.float32)], x=[x[0]], y=[y[0]], dw=[x[1] - x[0]],
                    dh=[y[1] - y[0]])

    def show_line(self, layer: str, x: Sequence[float] | Array, y: Sequence[float] | Array) -> None:
        """The dividing "curve", or the "line" along which something is looked at."""
        self.assign(layer, x=np.asarray(x, np.float32), y=np.asarray(y, np.float32))

    def choose(self, places: Sequence[tuple[float, float]]) -> None:
        """Rings where the chosen orbits start."""
        self.assign("chosen", x=[x for x, _ in places], y=[y for _, y in places])
