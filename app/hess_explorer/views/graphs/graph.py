"""Graphs of functions over time and over an angle, and ranges that fit them."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TypeVar

import numpy as np

from hess_explorer.views.layers import Layer, Range, compose, curves
from hess_explorer.views.plane.velocity_plane import round_up, symmetric_range
from hess_mechanics.numerics.results import Array, Mask

S = TypeVar("S")

ANGLE: Range = (-math.pi, math.pi)
"""The axis of an angle."""
ANGLE_TICKS = ((-math.pi, "−π"), (-math.pi / 2, "−π/2"), (0.0, "0"), (math.pi / 2, "π/2"), (math.pi, "π"))
_POINTS = 600
"""Number of points of a curve over a long time that a picture resolves."""


def time_graph(
    name: str,
    data: Callable[[S], tuple[Array, Array] | None],
    *,
    color: str,
    dash: str = "solid",
    label: str = "",
    tag: str = "",
) -> Layer[S]:
    """Return the layer of a graph over time; `data(state)` returns times and values (n,), or None if unknown."""
    return curves(
        name, compose(data, lambda found: [np.column_stack(found)]), color=color, dash=dash, label=label, tag=tag
    )


def settled_range(curves: Sequence[Array]) -> Range:
    """Return an axis that contains, with a margin, 0 and the last nine tenths of each curve (n,) over a long time."""
    settled = np.concatenate([y[len(y) // 10 :] for y in curves])
    low, high = float(settled.min()), float(settled.max())
    room = 0.08 * max(1e-6, high - low)
    return min(0.0, low) - room, max(0.0, high) + room


def axis_about_0(values: Array, least: float) -> Range:
    """Return an axis about 0 with a round limit that contains the values and ±`least`."""
    return symmetric_range(round_up(1.2 * max(float(np.abs(values).max()), least)))


def with_margin(values: Array, share: float, least: float = 0.0) -> Range:
    """Return an axis for values with a margin on both sides: a share of their range, at least `least`."""
    low, high = float(values.min()), float(values.max())
    room = max(least, share * (high - low))
    return low - room, high + room


def thin(x: Array, y: Array) -> tuple[Array, Array]:
    """Return x and y of a curve (n,), reduced to the 600 points that a picture resolves."""
    kept = np.unique(np.linspace(0, len(x) - 1, _POINTS).astype(int))
    return x[kept], y[kept]


def branches(x: Array, y: Array, period: float) -> list[Array]:
    """Return the parts (n, 2) of a curve over an angle x in [−period/2, period/2], cut where x jumps across ±period/2.

    The parts are extended to these edges.
    """
    x, y = np.asarray(x, float), np.asarray(y, float)
    cuts = np.flatnonzero(np.abs(np.diff(x)) > period / 2)
    edges = np.copysign(period / 2, x[cuts])
    before, after = np.abs(edges - x[cuts]), np.abs(edges + x[cuts + 1])
    share = np.divide(before, before + after, out=np.zeros(cuts.size), where=before + after > 0.0)
    heights = y[cuts] + share * (y[cuts + 1] - y[cuts])
    at = np.repeat(cuts + 1, 2)
    x, y = np.insert(x, at, np.column_stack([edges, -edges]).ravel()), np.insert(y, at, np.repeat(heights, 2))
    return np.split(np.column_stack([x, y]), cuts + 2 + 2 * np.arange(cuts.size))


def pieces(curve: Array, mask: Mask, jump: float = math.inf) -> list[Array]:
    """Return the parts (k, 2) of a curve (n, 2) where `mask` (n,) is true, also cut where the height jumps.

    A jump is a change by more than `jump` from one point to the next.  Parts of a single point are omitted.
    """
    cuts = np.flatnonzero((mask[1:] != mask[:-1]) | (np.abs(np.diff(curve[:, 1])) > jump)) + 1
    return [
        part
        for part, whole in zip(np.split(curve, cuts), np.split(mask, cuts), strict=True)
        if whole[0] and len(part) > 1
    ]
