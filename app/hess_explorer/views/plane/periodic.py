"""A periodic orbit in a section: its points by stability, and the manifolds of a saddle."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.layers import Axes, Layers, curves, points
from hess_mechanics.dynamics.manifolds import Intersection, Manifold
from hess_mechanics.dynamics.periodic import PeriodicOrbit
from hess_mechanics.numerics.results import Array

S = TypeVar("S")


def visible_parts(curve: Array, turn: float, axes: Axes) -> list[Array]:
    """Return the parts of a curve (n, 2) within the horizontal axis, including its copies shifted by periods.

    `turn` is the period of the horizontal coordinate, ∞ if it is not an angle.  A part extends one point beyond the
    axis, and the frame clips it.
    """
    low, high = axes.x
    x = curve[:, 0]
    shifts = (
        [0.0]
        if math.isinf(turn)
        else [turn * k for k in range(math.ceil((low - x.max()) / turn), math.floor((high - x.min()) / turn) + 1)]
    )
    parts = []
    for shift in shifts:
        seen = (x + shift >= low) & (x + shift <= high)
        kept = np.flatnonzero(seen | np.append(seen[1:], False) | np.append(False, seen[:-1]))
        runs = np.split(kept, np.flatnonzero(np.diff(kept) > 1) + 1)
        parts += [curve[run] + (shift, 0.0) for run in runs if run.size > 1]
    return parts


def visible_points(points: Array, turn: float, axes: Axes) -> Array:
    """Return the points (n, 2) within the horizontal axis; angles, of period `turn` < ∞, are first shifted to it."""
    low, high = axes.x
    x, y = points.T
    x = x if math.isinf(turn) else low + np.mod(x - low, turn)
    there = (x >= low) & (x <= high)
    return np.column_stack([x[there], y[there]])


def layers(
    orbits: Callable[[S], Sequence[PeriodicOrbit]],
    manifolds: Callable[[S], Sequence[Manifold]],
    homoclinic: Callable[[S], Sequence[Intersection]],
) -> Layers[S]:
    """Return the layers: manifolds of saddles, their intersections, and the points of periodic orbits on top.

    Parameters
    ----------
    orbits : callable
        `orbits(state)` returns the periodic orbits.
    manifolds : callable
        `manifolds(state)` returns the branches of the manifolds; not empty if there are homoclinic points.
    homoclinic : callable
        `homoclinic(state)` returns the intersections of the manifolds.
    """

    def parts(stable: bool) -> Callable[[S, Axes], list[Array]]:
        return lambda s, axes: [
            part
            for one in manifolds(s)
            if one.stable is stable
            for part in visible_parts(one.points, one.turns[0], axes)
        ]

    def crossed(state: S, axes: Axes) -> Array | None:
        found = [one.point for one in homoclinic(state)]
        return visible_points(np.array(found), manifolds(state)[0].turns[0], axes).T if found else None

    return (
        curves(
            "stable-manifold",
            data_in_axes=parts(True),
            color=theme.STABLE,
            width=3.0,
            label="stable manifold",
            tag="stable manifold",
        ),
        curves(
            "unstable-manifold",
            data_in_axes=parts(False),
            color=theme.UNSTABLE,
            width=3.0,
            dash="dashed",
            label="unstable manifold",
            tag="unstable manifold",
        ),
        points(
            "homoclinic", data_in_axes=crossed, size=7, color=theme.LOCKED, edge=theme.INK, label="homoclinic point"
        ),
        *orbit_points(orbits),
    )


def orbit_points(orbits: Callable[[S], Sequence[PeriodicOrbit]]) -> Layers[S]:
    """Return the layers of the points of periodic orbits, styled by stability."""

    def of_sign(sign: str) -> Callable[[S], Array | None]:
        def of(state: S) -> Array | None:
            found = [one.points for one in orbits(state) if sign_of(one.kind) == sign]
            return np.concatenate(found).T if found else None

        return of

    return (
        points(
            "attracts",
            of_sign("attracts"),
            size=12,
            color=theme.STABLE,
            edge=theme.INK,
            edge_width=1.5,
            label="attracting periodic orbit",
            tag="attracts",
        ),
        points(
            "neither",
            of_sign("neither"),
            size=14,
            marker="diamond",
            color=theme.SHEET,
            edge=theme.INK,
            edge_width=1.5,
            label="elliptic or parabolic periodic orbit",
            tag="elliptic",
        ),
        points(
            "repels",
            of_sign("repels"),
            size=12,
            color=theme.UNSTABLE,
            hollow=True,
            edge_width=2.5,
            label="unstable periodic orbit",
            tag="unstable",
        ),
    )


def sign_of(kind: str) -> str:
    """Return "attracts", "neither" or "repels" for a kind of periodic orbit.

    Elliptic and parabolic orbits are "neither", saddles count as "repels".
    """
    if kind in ("stable node", "stable focus"):
        return "attracts"
    return "neither" if kind == "elliptic" or kind.startswith("parabolic") else "repels"
