"""The (ω1, ω2)-plane of a motion without a field: the line of equilibria, the level of the energy, arcs with arrows."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from hess_explorer.protocol.wire import Wire
from hess_explorer.views import theme
from hess_explorer.views.figure import Figure, columns_of
from hess_mechanics.numerics.results import Array

__all__ = ["COLUMNS", "VelocityPlane", "sphere_columns"]

COLUMNS = ("omega1", "omega2", "g1", "g2", "g3")


def sphere_columns(omega: Array, gamma: Array) -> dict[str, Array]:
    """The columns of a motion, ω (m, 2) and γ (m, 3), for this plane and the sphere."""
    return dict(columns_of(np.hstack([omega, gamma]), COLUMNS))


def nice_above(value: float) -> float:
    """The next of 1, 1.5, 2, 3, 4, 5, 6, 8 times a power of ten."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(power * next(step for step in (1, 1.5, 2, 3, 4, 5, 6, 8, 10) if step * power >= value * (1 - 1e-12)))


class VelocityPlane(Figure):
    """Grey: ω that the energy forbids.  The sources `data-orbit` and `data-second` feed the sphere too."""

    def __init__(self, wire: Wire, picks: Sequence[str] = ("tap", "doubletap")) -> None:
        super().__init__(wire, "omega", ("ω₁", "ω₂"), (-4.0, 4.0), (-4.0, 4.0), picks=picks)
        self.add("forbidden", "multi_polygons", ("xs", "ys"), color=theme.FORBIDDEN, line_color=theme.MUTED)
        self.add("levels", "multi_line", ("xs", "ys"), color=theme.MUTED, line_width=1)
        self.add("arcs", "multi_line", ("xs", "ys"), color=theme.ORBIT, line_width=1, line_alpha=0.5)
        self.add("level-arrows", "scatter", ("x", "y", "angle"), marker="triangle", angle="angle", size=8,
                 color=theme.MUTED, line_alpha=0)
        self.add("stable", "line", ("x", "y"), color=theme.STABLE, line_width=3)
        self.add("unstable", "line", ("x", "y"), color=theme.UNSTABLE, line_width=3, line_dash="dashed")
        self.add("second", "line", COLUMNS, source="data-second", color=theme.MAP, line_width=2, line_dash="dotdash")
        self.add("orbit", "line", COLUMNS, source="data-orbit", color=theme.ORBIT, line_width=2.5)
        self.add("arrows", "scatter", ("x", "y", "angle"), marker="triangle", angle="angle", size=10, color=theme.ORBIT,
                 line_alpha=0, fill_alpha=0.8)
        self.add("stable-point", "scatter", ("x", "y"), size=11, line_width=3, color=theme.STABLE)
        self.add("unstable-point", "scatter", ("x", "y"), size=11, line_width=3, fill_alpha=0,
                 line_color=theme.UNSTABLE)
        self.add_point_and_message()

    def show_line(self, stable: Array, unstable: Array, half_width: float) -> None:
        """The line of equilibria to the edge: its stable and unstable half, and those two of its points (2,)."""
        # Axes that are held may be the larger ones.
        far = max(half_width, self.x_range[1]) / max(float(np.max(np.abs(stable))), 1e-300)
        for name, point in (("stable", stable), ("unstable", unstable)):
            self.assign(name, x=[0.0, far * float(point[0])], y=[0.0, far * float(point[1])])
            self.assign(f"{name}-point", x=[float(point[0])], y=[float(point[1])])

    def show_arcs(self, arcs: Sequence[Array], half_width: float) -> None:
        """Curves (m, 2) passed from their first to their last point, an arrow in the middle of each."""
        arcs = [arc for arc in arcs if len(arc) > 1]
        self.assign("arcs", xs=[arc[:, 0].astype(np.float32) for arc in arcs],
                    ys=[arc[:, 1].astype(np.float32) for arc in arcs])
        self.assign("arrows", **_arrows(arcs, half_width))

    def show_levels(self, levels: Sequence[Array], half_width: float) -> None:
        """Curves (m, 2) of other energies, passed from their first to their last point, with arrows."""
        self.assign("levels", xs=[level[:, 0].astype(np.float32) for level in levels],
                    ys=[level[:, 1].astype(np.float32) for level in levels])
        self.assign("level-arrows", **_arrows(levels, half_width))

    def show_strip(self, inner: Array, outer: Array, half_width: float) -> None:
        """All but the ring between two closed curves (m, 2) is grey."""
        r = 4.0 * half_width
        frame = np.array([[-r, -r], [r, -r], [r, r], [-r, r]])
        self.assign("forbidden", xs=[[[frame[:, 0], outer[:, 0]]], [[inner[:, 0]]]],
                    ys=[[[frame[:, 1], outer[:, 1]]], [[inner[:, 1]]]])

    def fit(self, half_width: float) -> None:
        """Axes ± half_width."""
        self.set_ranges((-half_width, half_width), (-half_width, half_width))


def _arrows(curves: Sequence[Array], half_width: float) -> dict[str, list[float]]:
    """An arrow in the middle of each curve (m, 2) that is long enough for one."""
    x, y, angle = [], [], []
    for curve in curves:
        length = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(curve, axis=0), axis=1))])
        if length[-1] < 0.02 * half_width:
            continue
        i = min(int(np.searchsorted(length, 0.5 * length[-1])), len(curve) - 1)
        step = curve[i] - curve[i - 1]
        x.append(float(curve[i, 0]))
        y.append(float(curve[i, 1]))
        # A triangle points upwards at angle 0.
        angle.append(float(np.arctan2(step[1], step[0]) - np.pi / 2))
    return {"x": x, "y": y, "angle": angle}
