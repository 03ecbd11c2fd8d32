"""Bifurcation diagram in (h, f): region, curve, points, rotation number, Arnold tongue."""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import (
    TURNS,
    Axes,
    CellGrid,
    Layer,
    Layers,
    Positions,
    Regions,
    curves,
    image,
    points,
    region,
    target,
)
from hess_explorer.views.text import digits
from hess_mechanics.numerics.accuracy import DRAFT
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.bifurcation import f_max
from hess_mechanics.suslov_hess.circle_map import CircleMap, circle_map

S = TypeVar("S")


def window(h: float) -> Axes:
    """Return the axes (h, f) for this h: constant up to h = 4, the end of the slider, larger in steps beyond."""
    end = 4.0
    while h > end:
        end *= 2.5
    top = 1.08 * f_max(end)
    return Axes((-1.0 - 0.08 * (end + 1.0), end), (-top, top))


def _with_mirror_image(half: Array) -> list[Array]:
    """Return a curve (n, 2) with f ≥ 0 and its mirror image."""
    return [half, half * (1.0, -1.0)]


def impossible(curve: Array, axes: Axes) -> Regions:
    """Return the forbidden region within the axes, given the upper branch (n, 2), f ≥ 0, of the bifurcation curve."""
    top = axes.y[1]
    edge = [[axes.x[0], 0.0], *curve, [axes.x[1], top], [axes.x[0], top]]
    return [[one] for one in _with_mirror_image(np.array(edge))]


def _tongue(boundary: Array, axes: Axes) -> Regions:
    """Return the Arnold tongue to the right of |t| = 2; empty without a boundary.

    The forbidden region covers the excess.
    """
    if len(boundary) == 0:
        return []
    h, f = boundary[0]
    far, top = max(axes.x[1], h) + 1.0, 2.0 * max(axes.y[1], f)
    # Use one part, because two parts that meet at f = 0 would show a seam.
    mirrored = boundary[::-1] * (1.0, -1.0)
    return [[np.array([*boundary, *mirrored, [h, -top], [far, -top], [far, top], [h, top]])]]


def layers(
    rotation: Callable[[S], CellGrid],
    boundary: Callable[[S], Array],
    curve: Callable[[S], Array],
    here: Callable[[S], Positions],
    axes: Callable[[S], Axes],
) -> Layers[S]:
    """Return the layers: ρ, Arnold tongue, forbidden region in grey, their borders, and a ring at the current torus.

    Diamonds mark the separatrix (1, 0) and the lowest equilibrium (−1, 0).

    Parameters
    ----------
    rotation : callable
        `rotation(state)` returns ρ over the window.
    boundary : callable
        `boundary(state)` returns the curve |t| = 2 with f ≥ 0, (n, 2); n = 0 without an Arnold tongue.
    curve : callable
        `curve(state)` returns the upper branch of the bifurcation curve, (n, 2).
    here : callable
        `here(state)` returns the point of the current torus, as a list.
    axes : callable
        `axes(state)` returns the axes.
    """
    corners = ("h", "f")

    def lock(state: S) -> list[Array]:
        found = boundary(state)
        return _with_mirror_image(found) if len(found) else []

    return (
        image("rotation", rotation, palette=theme.TURN_MAP, low=-0.5, high=0.5, cyclic=True, legend=(TURNS,)),
        region("locked", lambda s: _tongue(boundary(s), axes(s)), color=theme.LOCKED, label="locked", tag="locked"),
        curves("boundary", lock, is_overlay=False, color=theme.INK),
        region("forbidden", lambda s: impossible(curve(s), axes(s)), label="impossible", tag="impossible"),
        curves("curve", lambda s: _with_mirror_image(curve(s)), is_overlay=False, color=theme.INK),
        points(
            "special",
            lambda s: ((1.0, -1.0), (0.0, 0.0)),
            columns=corners,
            marker="diamond",
            color=theme.PAPER,
            edge=theme.INK,
            size=11,
        ),
        *target("here", here, columns=corners),
    )


REACH: Layer[Any] = points(
    "point",
    marker="inverted_triangle",
    color=theme.MUTED,
    edge=theme.PAPER,
    edge_width=1.5,
    size=14.0,
    label="largest |f| at the current n₃",
)
"""The moving point of the diagram; (h, f) is the ring, which does not move in time."""


def caption(h: float, f: float, theta: CircleMap | None) -> Caption:
    """Return the caption of the diagram: the current torus is in the Arnold tongue, on its boundary or outside.

    `theta` is the circle map of the torus; None on the separatrix.
    """
    if theta is None:
        zone = "On the separatrix."
    elif theta.kind == "hyperbolic":
        zone = "Locked: two limit cycles."
    elif theta.fixed_points:
        zone = "On the boundary of the Arnold tongue."
    else:
        zone = "Not locked: no limit cycle."
    rho = f", ρ = {digits(theta.rotation_number)}" if theta is not None and theta.kind == "elliptic" else ""
    return Caption(zone, f"h = {digits(h)}, f = {digits(f)}{rho}.")


def torus_tooltip(a: float, h: float, f: float) -> str:
    """Return the tooltip on (a, h, f): values of the torus, or that it is impossible.

    Raises `Separatrix` and `WorkLimit`.
    """
    if h <= -1.0 or abs(f) > f_max(h):
        return f"h = {digits(h)}, f = {digits(f)}: impossible"
    theta = circle_map(a, h, f, DRAFT)
    values = f"h = {digits(h)}, f = {digits(f)}: ρ = {digits(theta.rotation_number)}, |trace| = {digits(theta.trace)}"
    multipliers = ", ".join(digits(point.multiplier) for point in theta.fixed_points)
    return f"{values}, multipliers {multipliers}" if multipliers else f"{values}, no cycle"
