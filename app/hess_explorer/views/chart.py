"""Curves and marks over time or cost, on logarithmic scales."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from hess_explorer.protocol.wire import Wire
from hess_explorer.views import theme
from hess_explorer.views.figure import Figure
from hess_mechanics.numerics.results import Array

__all__ = ["Chart", "Series"]


@dataclass(frozen=True)
class Series:
    """One curve: its name, colour, dashes (Bokeh's), and marker, if its points are marked."""

    name: str
    color: str
    dash: str = "solid"
    marker: str | None = None


class Chart(Figure):
    """Some series in one frame, the vertical axis logarithmic; `log_x`: the horizontal one too."""

    def __init__(self, wire: Wire, name: str, labels: tuple[str, str], x_range: tuple[float, float],
                 y_range: tuple[float, float], series: Sequence[Series], log_x: bool = False,
                 picks: Sequence[str] = ()) -> None:
        self._floor = y_range[0]
        # Fewer labels than Bokeh would set: powers of ten are wide.
        super().__init__(wire, name, labels, x_range, y_range, picks=picks, log="xy" if log_x else "y",
                         x_ticks=[1e-16, 1e-12, 1e-8, 1e-4, 1.0] if log_x else None, y_tick_count=5)
        self.add("limit", "line", ("x", "y"), color=theme.MUTED, line_dash="dotted", line_width=2)
        for one in series:
            self.add(one.name, "line", ("x", "y"), color=one.color, line_dash=one.dash, line_width=2)
            if one.marker is not None:
                self.add(f"{one.name}-marks", "scatter", ("x", "y"), marker=one.marker, color=one.color, size=10)
        self.add("chosen", "scatter", ("x", "y"), size=20, fill_alpha=0, line_color=theme.UNSTABLE, line_width=3)
        self.add_point_and_message()
        self._marked = {one.name for one in series if one.marker is not None}

    def clipped(self, values: Array) -> Array:
        """What is too small for the axis is drawn on its edge; in the screen's precision."""
        return np.maximum(np.asarray(values, float), self._floor).astype(np.float32)

    def show(self, name: str, x: Array, y: Array) -> None:
        """The points of one series."""
        data = {"x": np.asarray(x, np.float32), "y": self.clipped(y)}
        self.assign(name, **data)
        if name in self._marked:
            self.assign(f"{name}-marks", **data)

    def show_limit(self, y: float) -> None:
        """A dotted line across the picture at this height."""
        self.assign("limit", x=[-1e30, 1e30], y=[y, y])

    def choose(self, x: float, y: float) -> None:
        """A ring round one point."""
        self.assign("chosen", x=[x], y=[max(y, self._floor)])
