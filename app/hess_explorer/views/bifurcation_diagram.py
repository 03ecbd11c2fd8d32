"""The bifurcation diagram in (h, f): region, curve, points, rotation number, lock zone."""

from __future__ import annotations

import numpy as np

from hess_explorer.protocol.wire import Wire
from hess_explorer.views import theme
from hess_explorer.views.figure import Figure
from hess_mechanics.numerics.results import Array


def window(h: float) -> tuple[tuple[float, float], tuple[float, float]]:
    """The part of the plane shown for this h: the same for all h of the slider, larger ones in steps."""
    end = 4.0
    while h > end:
        end *= 2.5
    top = 1.08 * _largest_f(end)
    return (-1.0 - 0.08 * (end + 1.0), end), (-top, top)


def _largest_f(h: float) -> float:
    n = 1.0 / (h + np.sqrt(h * h + 3.0))
    return float((1.0 - n * n) / np.sqrt(n))


class BifurcationDiagram(Figure):
    """Colours: rotation number ρ.  One tone where it is locked.  Grey: no motion.  A click picks (h, f)."""

    def __init__(self, wire: Wire) -> None:
        super().__init__(wire, "bifurcation", ("h", "f"), *window(0.0), picks=("tap", "doubletap", "pan", "hover"))
        self.add_image("rotation", theme.NUMBER_MAP, -0.5, 0.5)
        areas = {"moving": False, "line_alpha": 0}
        self.add("locked", "multi_polygons", ("xs", "ys"), color=theme.LOCKED, **areas)
        self.add("boundary", "multi_line", ("xs", "ys"), moving=False, color="black", line_width=2)
        self.add("forbidden", "multi_polygons", ("xs", "ys"), color=theme.FORBIDDEN, **areas)
        self.add("curve", "multi_line", ("xs", "ys"), moving=False, color="black", line_width=2)
        self.add("special", "scatter", ("h", "f"), moving=False, marker="diamond", color="white",
                 line_color="black", size=11)
        # A ring that is seen on any colour: white, and black on it.
        self.add("here", "scatter", ("h", "f"), size=21, fill_alpha=0, line_color="white", line_width=6)
        self.add("here-too", "scatter", ("h", "f"), size=21, fill_alpha=0, line_color="black", line_width=2.5)
        self.add_point_and_message()

    def show_region(self, curve: Array, x: tuple[float, float], y: tuple[float, float]) -> None:
        """Everything outside `Geq3` grey, and the curve itself.  `curve` is its upper branch."""
        h, f = curve[:, 0], curve[:, 1]
        xs = np.concatenate([[x[0]], h, [x[1], x[0]]])
        ys = np.concatenate([[0.0], f, [y[1], y[1]]])
        self.assign("forbidden", xs=[[[xs]], [[xs]]], ys=[[[ys]], [[-ys]]])
        self.assign("curve", xs=[h, h], ys=[f, -f])
        self.assign("special", h=[1.0, -1.0], f=[0.0, 0.0])

    def show_rotation(self, grid: Array, x: tuple[float, float], y: tuple[float, float]) -> None:
        """The rotation number at the centres of a grid of cells that fills the window."""
        self.assign("rotation", image=[grid], x=[x[0]], y=[y[0]], dw=[x[1] - x[0]], dh=[y[1] - y[0]])

    def show_lock(self, boundary: Array, x: tuple[float, float], y: tuple[float, float]) -> None:
        """The zone right of |t| = 2 (between it and the curve) and its boundary; `boundary` has f ≥ 0."""
        if len(boundary) == 0:
            self.clear("locked", "boundary")
            return
        h, f = boundary[:, 0], boundary[:, 1]
        # Where the boundary ends on the curve, the zone goes on along it: the grey region covers the rest.
        far = max(x[1], float(h[0])) + 1.0
        xs = np.concatenate([h, [far, far, h[0]]])
        ys = np.concatenate([f, [0.0, 2 * max(y[1], float(f[0])), 2 * max(y[1], float(f[0]))]])
        self.assign("locked", xs=[[[xs]], [[xs]]], ys=[[[ys]], [[-ys]]])
        self.assign("boundary", xs=[h, h], ys=[f, -f])

    def show_here(self, h: float, f: float) -> None:
        """The torus on show."""
        for label in ("here", "here-too"):
            self.assign(label, h=[h], f=[f])
