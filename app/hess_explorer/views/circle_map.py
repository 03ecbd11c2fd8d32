"""The circle map Θ(φ) on the square (−π, π]², its fixed points and a cobweb."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.layers import Layer, curves, line, points
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.circle_map import CircleMap

__all__ = ["SIDE", "TICKS", "cobweb", "graph", "layers"]

S = TypeVar("S")

SIDE = (-math.pi, math.pi)
TICKS = [(-math.pi, "−π"), (-math.pi / 2, "−π/2"), (0.0, "0"), (math.pi / 2, "π/2"), (math.pi, "π")]
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


def _copies(circle_map: CircleMap | None) -> list[Array]:
    """The graph and its copies one turn up and down: the frame cuts out the square."""
    if circle_map is None:
        return []
    phi, theta = graph(circle_map)
    return [np.column_stack([phi, theta + turn]) for turn in (0.0, -2 * math.pi, 2 * math.pi)]


def _fixed(circle_map: CircleMap | None, stable: bool) -> tuple[list[float], list[float]]:
    found = [point.phi for point in (circle_map.fixed_points if circle_map else ())
             if (point.log_multiplier <= 0) == stable]
    return found, found


def layers(map: Callable[[S], CircleMap | None], iterates: Callable[[S], Array | None]) -> tuple[Layer[S], ...]:
    """Θ, the diagonal, stable (filled) and unstable (hollow) fixed points, the cobweb of some iterates."""
    here = ("phi", "theta")

    def staircase(state: S) -> tuple[Array, Array] | None:
        found = iterates(state)
        return None if found is None else cobweb(found)

    return (
        line("diagonal", lambda s: None if map(s) is None else (SIDE, SIDE), columns=here, moving=False,
             color=theme.MUTED, dash="dotted", width=1.5),
        line("cobweb", staircase, columns=here, color=theme.ORBIT, width=1),
        curves("map", lambda s: _copies(map(s)), color=theme.MAP, width=2.5, label="circle map Θ"),
        points("stable", lambda s: _fixed(map(s), True), columns=here, size=12, edge_width=3, color=theme.STABLE),
        points("unstable", lambda s: _fixed(map(s), False), columns=here, size=12, edge_width=3, hollow=True,
               color=theme.UNSTABLE),
    )
