"""A periodic orbit in a section: its places, by what they are, and the manifolds of a saddle."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.layers import Axes, Layer, curves, points
from hess_mechanics.dynamics.manifolds import Manifold
from hess_mechanics.dynamics.periodic import PeriodicOrbit
from hess_mechanics.numerics.results import Array

__all__ = ["layers", "within"]

S = TypeVar("S")


def within(curve: Array, turn: float, axes: Axes) -> list[Array]:
    """The parts of a curve (n, 2) that are seen between the ends of the horizontal axis, an angle with this turn, or ∞.

    A part goes one point beyond the end: what is outside of the frame is not painted.
    """
    low, high = axes.x
    x = curve[:, 0]
    shifts = [0.0] if math.isinf(turn) else [
        turn * k for k in range(math.ceil((low - x.max()) / turn), math.floor((high - x.min()) / turn) + 1)]
    parts = []
    for shift in shifts:
        seen = (x + shift >= low) & (x + shift <= high)
        kept = np.flatnonzero(seen | np.append(seen[1:], False) | np.append(False, seen[:-1]))
        runs = np.split(kept, np.flatnonzero(np.diff(kept) > 1) + 1)
        parts += [curve[run] + (shift, 0.0) for run in runs if run.size > 1]
    return parts


def layers(orbit: Callable[[S], PeriodicOrbit | None], manifolds: Callable[[S], Sequence[Manifold]]
           ) -> tuple[Layer[S], ...]:
    """The places of an orbit, over the manifolds of a saddle."""

    def parts(stable: bool) -> Callable[[S, Axes], list[Array]]:
        return lambda s, axes: [part for one in manifolds(s) if one.stable is stable
                                for part in within(one.points, one.turns[0], axes)]

    def places(sign: str) -> Callable[[S], Array | None]:
        def of(state: S) -> Array | None:
            found = orbit(state)
            return None if found is None or _sign(found.kind) != sign else found.places.T

        return of

    return (
        curves("stable-manifold", within=parts(True), color=theme.STABLE, width=3.0, label="stable manifold"),
        curves("unstable-manifold", within=parts(False), color=theme.UNSTABLE, width=3.0,
               dash="dashed", label="unstable manifold"),
        points("attracts", places("attracts"), size=12, color=theme.STABLE, edge=theme.INK, edge_width=1.5,
               label="periodic orbit that attracts"),
        points("neither", places("neither"), size=14, marker="diamond", color=theme.SHEET, edge=theme.INK,
               edge_width=1.5, label="elliptic or parabolic periodic orbit"),
        points("repels", places("repels"), size=12, color=theme.UNSTABLE, hollow=True, edge_width=2.5,
               label="unstable periodic orbit"),
    )


def _sign(kind: str) -> str:
    if kind in ("stable node", "stable focus"):
        return "attracts"
    return "neither" if kind == "elliptic" or kind.startswith("parabolic") else "repels"
