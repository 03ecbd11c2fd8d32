"""A Poincaré section: the points of many orbits, those of the chosen one on top."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hess_explorer.protocol.wire import Wire
from hess_explorer.views import theme
from hess_explorer.views.figure import Figure, Range
from hess_mechanics.numerics.results import Array

__all__ = ["SectionPlane"]


class SectionPlane(Figure):
    """Grey: impossible.  Small points: other orbits; large ones: the chosen orbit.  A click starts an orbit there."""

    def __init__(self, wire: Wire, name: str, labels: tuple[str, str], x_range: Range, y_range: Range,
                 picks: Sequence[str] = (), ticks: Sequence[tuple[float, str]] | None = None,
                 y_ticks: Sequence[tuple[float, str]] | None = None) -> None:
        super().__init__(wire, name, labels, x_range, y_range, picks=picks, ticks=ticks, y_ticks=y_ticks)
        self.add("forbidden", "multi_polygons", ("xs", "ys"), moving=False, color=theme.FORBIDDEN, line_alpha=0)
        self.add("others", "dots", ("x", "y"), size=6, color=theme.MUTED)
        self.add("own", "dots", ("x", "y"), size=11, color=theme.ORBIT)
        self.add("chosen", "scatter", ("x", "y"), size=16, fill_alpha=0, line_color=theme.UNSTABLE, line_width=3)
        self.add_point_and_message()

    def show(self, others: Array, own: Array) -> None:
        """Points (n, 2) and (m, 2)."""
        for layer, points in (("others", others), ("own", own)):
            self.assign(layer, x=points[:, 0].astype(np.float32), y=points[:, 1].astype(np.float32))

    def show_forbidden(self, bands: Sequence[Range]) -> None:
        """Bands of the horizontal axis, over the whole height."""
        low, high = self.y_range
        self.assign("forbidden", xs=[[[[a, b, b, a]]] for a, b in bands],
                    ys=[[[[low, low, high, high]]] for _ in bands])

    def choose(self, x: float, y: float) -> None:
        """A ring where the chosen orbit starts."""
        self.assign("chosen", x=[x], y=[y])
