"""The rotation number over two parameters: colours, lock zones, what is impossible, the line through a torus."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hess_explorer.protocol.wire import Wire
from hess_explorer.views import theme
from hess_explorer.views.figure import Figure, Range
from hess_mechanics.numerics.results import Array

__all__ = ["RotationPlane"]


class RotationPlane(Figure):
    """A click chooses a torus, a box looks closer."""

    def __init__(self, wire: Wire, name: str, labels: tuple[str, str], x_range: Range, y_range: Range) -> None:
        super().__init__(wire, name, labels, x_range, y_range, picks=("tap", "doubletap", "box"))
        self.add_image("rho", theme.NUMBER_MAP, -0.5, 0.5)
        self.add_image("zones", (theme.FORBIDDEN + "00", theme.FORBIDDEN, theme.LOCKED), 0.0, 3.0)
        self.add("boundary", "multi_line", ("xs", "ys"), moving=False, color="black", line_width=2)
        self.add("across", "multi_line", ("xs", "ys"), color=theme.MUTED, line_dash="dashed", line_width=2)
        self.add("here", "scatter", ("x", "y"), size=21, fill_alpha=0, line_color="white", line_width=6)
        self.add("here-too", "scatter", ("x", "y"), size=21, fill_alpha=0, line_color="black", line_width=2.5)
        self.add("names", "text", ("x", "y", "text"), text_color=theme.MUTED, text_font_size=theme.FONT_SIZE,
                 text_align="right", x_offset=-6, y_offset=-4)
        self.add_point_and_message()

    def show(self, rho: Array, possible: Array, locked: Array, x: Range, y: Range) -> None:
        """At the centres of cells (m, n) that fill the window."""
        place = {"x": [x[0]], "y": [y[0]], "dw": [x[1] - x[0]], "dh": [y[1] - y[0]]}
        self.assign("rho", image=[rho.astype(np.float32)], **place)
        zones = np.where(possible, np.where(locked, 2.5, 0.5), 1.5)
        self.assign("zones", image=[zones.astype(np.float32)], **place)

    def show_lines(self, boundary: Sequence[Array], across: Sequence[Array]) -> None:
        """Curves (n, 2) where |t| = 2, and the line through the torus on show."""
        for layer, curves in (("boundary", boundary), ("across", across)):
            self.assign(layer, xs=[curve[:, 0].astype(np.float32) for curve in curves],
                        ys=[curve[:, 1].astype(np.float32) for curve in curves])

    def show_here(self, places: Sequence[tuple[float, float]], names: str) -> None:
        """The torus on show, if it is in sight; what the axes are, where that is not always the same."""
        for layer in ("here", "here-too"):
            self.assign(layer, x=[x for x, _ in places], y=[y for _, y in places])
        self.assign("names", x=[self.x_range[1]], y=[self.y_range[0]], text=[names])
