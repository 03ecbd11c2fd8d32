"""The circle map Θ(φ) on the square (−π, π]², its fixed points and a cobweb."""

from __future__ import annotations

import math

import numpy as np

from hess_explorer.protocol.wire import Wire
from hess_explorer.views import theme
from hess_explorer.views.figure import Figure
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.circle_map import CircleMap

_TICKS = [(-math.pi, "−π"), (-math.pi / 2, "−π/2"), (0.0, "0"), (math.pi / 2, "π/2"), (math.pi, "π")]
_GRID = np.linspace(-math.pi, math.pi, 193)


def graph(circle_map: CircleMap) -> tuple[Array, Array]:
    """φ and Θ, continued without jumps, at points close together on the curve also where it is steep.

    The reversor gives the inverse, Θ⁻¹(ψ) = −Θ(−ψ): values at even φ and at even Θ are joined.
    """
    phi = np.unique(np.concatenate([_GRID, -circle_map.theta(-_GRID)]))
    theta = np.unwrap(circle_map.theta(phi))
    return phi, theta


def cobweb(iterates: Array) -> tuple[Array, Array]:
    """The staircase (φ0, φ0) → (φ0, φ1) → (φ1, φ1) → …"""
    return np.repeat(iterates, 2)[:-1], np.repeat(iterates, 2)[1:]


class CircleMapView(Figure):
    """Θ, the diagonal, stable (filled) and unstable (hollow) fixed points, the cobweb.  A click picks φ0."""

    def __init__(self, wire: Wire) -> None:
        side = (-math.pi, math.pi)
        super().__init__(wire, "circle", ("φ", "Θ(φ)"), side, side, picks=("tap", "doubletap"), ticks=_TICKS)
        here = ("phi", "theta")
        self.add("diagonal", "line", here, moving=False, color=theme.MUTED, line_dash="dotted", line_width=1.5)
        self.add("cobweb", "line", here, color=theme.ORBIT, line_width=1)
        self.add("map", "multi_line", ("xs", "ys"), color=theme.MAP, line_width=2.5)
        self.add("stable", "scatter", here, size=12, line_width=3, color=theme.STABLE)
        self.add("unstable", "scatter", here, size=12, line_width=3, fill_alpha=0, line_color=theme.UNSTABLE)
        self.add_point_and_message()

    def show(self, circle_map: CircleMap, iterates: Array) -> None:
        """One map, with the cobweb through its iterates."""
        self.say("")
        self.assign("diagonal", phi=[-math.pi, math.pi], theta=[-math.pi, math.pi])
        phi, theta = graph(circle_map)
        phi32, theta32 = phi.astype(np.float32), theta.astype(np.float32)
        turn = np.float32(2 * math.pi)
        # The graph and its copies one turn up and down: the frame cuts out the square.
        self.assign("map", xs=[phi32] * 3, ys=[theta32, theta32 - turn, theta32 + turn])
        xs, ys = cobweb(iterates)
        self.assign("cobweb", phi=xs.astype(np.float32), theta=ys.astype(np.float32))
        self.clear("stable", "unstable")
        for point in circle_map.fixed_points:
            self.assign("stable" if point.log_multiplier <= 0 else "unstable", phi=[point.phi], theta=[point.phi])
