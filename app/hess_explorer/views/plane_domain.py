"""The (q1, q2)-plane of a point under a potential: where it may be, equipotentials, its orbit."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hess_explorer.protocol.wire import Wire
from hess_explorer.views import theme
from hess_explorer.views.figure import Figure, columns_of
from hess_mechanics.numerics.results import Array

__all__ = ["PlaneDomain", "plane_columns"]

COLUMNS = ("q1", "q2", "g1", "g2", "g3")


def plane_columns(q: Array, gamma: Array) -> dict[str, Array]:
    """The columns of a motion, q (m, 2) and γ (m, 3), for this plane and the sphere."""
    return dict(columns_of(np.hstack([q, gamma]), COLUMNS))


class PlaneDomain(Figure):
    """Grey: impossible.  The source `data-orbit` feeds the sphere too.  A click starts an orbit there."""

    def __init__(self, wire: Wire) -> None:
        super().__init__(wire, "domain", ("q₁", "q₂"), (-1.5, 1.5), (-1.5, 1.5), picks=("tap", "doubletap"))
        self.add("forbidden", "multi_polygons", ("xs", "ys"), moving=False, color=theme.FORBIDDEN, line_alpha=0)
        self.add("levels", "multi_line", ("xs", "ys"), color=theme.MUTED, line_width=1)
        self.add("path", "multi_line", ("xs", "ys"), color=theme.ORBIT, line_alpha=0.7, line_width=1.5,
                 line_dash="dotted")
        self.add("stable", "multi_line", ("xs", "ys"), color=theme.STABLE, line_width=3)
        self.add("unstable", "multi_line", ("xs", "ys"), color=theme.UNSTABLE, line_width=3, line_dash="dashed")
        self.add("orbit", "line", COLUMNS, source="data-orbit", color=theme.ORBIT, line_width=2)
        self.add("start", "scatter", ("x", "y"), size=16, fill_alpha=0, line_color=theme.UNSTABLE, line_width=3)
        self.add("mirror", "scatter", ("x", "y"), color=theme.MAP, line_color="black", line_width=1.5, size=11)
        self.add_point_and_message()

    def show_forbidden(self, parts: Sequence[Sequence[Array]]) -> None:
        """Grey parts, each an outer closed curve (m, 2) and those of its holes."""
        self.assign("forbidden", xs=[[[curve[:, 0] for curve in one]] for one in parts],
                    ys=[[[curve[:, 1] for curve in one]] for one in parts])

    def frame(self, half_width: float) -> Array:
        """A square (4, 2) around all that is to be seen, for `show_forbidden`."""
        # Axes that are held may be the larger ones.
        r = 2.0 * max(half_width, self.x_range[1])
        return np.array([[-r, -r], [r, -r], [r, r], [-r, r]])

    def show_curves(self, layer: str, curves: Sequence[Array]) -> None:
        """Curves (m, 2) of the layer "levels", "path", "stable" or "unstable"."""
        self.assign(layer, xs=[curve[:, 0].astype(np.float32) for curve in curves],
                    ys=[curve[:, 1].astype(np.float32) for curve in curves])

    def show_start(self, q: Sequence[float]) -> None:
        """A ring where the orbit starts."""
        self.assign("start", x=[float(q[0])], y=[float(q[1])])

    def fit(self, half_width: float) -> None:
        """Axes ± half_width."""
        self.set_ranges((-half_width, half_width), (-half_width, half_width))
