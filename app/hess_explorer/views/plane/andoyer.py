"""Andoyer–Deprit variables (l, L/G) of a motion on the Hess manifold, and the curve of the Hess relation."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import ANGLE, ANGLE_TICKS
from hess_explorer.views.layers import Layers, Positions, curves, dots, line, ring
from hess_explorer.views.plot import Plot
from hess_mechanics.numerics.results import Array

S = TypeVar("S")

_X_TICKS = [(-1.0, "−1"), (-0.5, "−½"), (0.0, "0"), (0.5, "½"), (1.0, "1")]


def picture(
    title: str,
    caption: Callable[[S], Caption],
    relation: Callable[[S], Array],
    orbit: Callable[[S], Array],
    color: str = theme.ORBIT,
) -> Plot[S]:
    """Return the plot of the Hess relation and an orbit; a ring marks the start.

    Parameters
    ----------
    title : str
        Heading.
    caption : callable
        `caption(state)` returns the caption.
    relation : callable
        `relation(state)` returns points (l, L/G), (n, 2), of the Hess relation.
    orbit : callable
        `orbit(state)` returns points (l, L/G), (m, 2), of the orbit.
    color : str
        Colour of the orbit.
    """
    return Plot(
        name="andoyer",
        title=title,
        caption=caption,
        axes=("l", "L/G"),
        x=ANGLE,
        y=(-1.0, 1.0),
        ticks=ANGLE_TICKS,
        y_ticks=_X_TICKS,
        dot=("l", "x"),
        layers=(
            curves(
                "hess", lambda s: _parts(relation(s)), color=theme.STABLE, label="Hess manifold, r·M = 0", tag="r·M = 0"
            ),
            curves("orbit", lambda s: _parts(orbit(s)), color=color),
            ring(
                "chosen",
                lambda s: [(float(orbit(s)[0, 0]), float(orbit(s)[0, 1]))],
                size=18,
                label="start",
                tag="start",
            ),
        ),
    )


def middle_layers(
    other_sheets: Callable[[S], Array],
    curve: Callable[[S], tuple[Array, Array]],
    across: Callable[[S], Positions],
) -> Layers[S]:
    """Return the layers between the other orbits of a section and the chosen ones.

    They include all points of the current orbit, from the track "orbit".

    Parameters
    ----------
    other_sheets : callable
        `other_sheets(state)` returns crossings (l, L/G), (n, 2), on another sheet of the section.
    curve : callable
        `curve(state)` returns l and L/G of the Hess relation, each (m,).
    across : callable
        `across(state)` returns the ends of the line of the rotation number that lie in the window; empty for none.
    """
    return (
        dots(
            "elsewhere", lambda s: other_sheets(s).T, color=theme.SHEET, size=12, label="on another sheet (different G)"
        ),
        line("curve", curve, color=theme.STABLE, label="Hess manifold, r·M = 0", tag="r·M = 0"),
        dots("path", track="orbit", columns=("l", "x"), size=3, color=theme.MAP, alpha=0.4),
        line(
            "line",
            lambda s: tuple(zip(*across(s), strict=True)) or None,
            color=theme.MUTED,
            dash="dashed",
            width=1.5,
            label="line of the rotation number",
        ),
    )


def _parts(points: Array) -> list[Array]:
    """Split a curve (l, L/G), (n, 2), where M passes 0 and where l passes ±π; there the parts overlap the edge."""
    l, x = points.T
    s = np.sqrt(np.maximum(0.0, 1.0 - x * x))
    direction = np.column_stack([s * np.sin(l), s * np.cos(l), x])
    round_ = np.sum(direction[1:] * direction[:-1], axis=1) < 0.0
    passes = (np.abs(np.diff(l)) > math.pi) & ~round_
    turn = np.column_stack([2.0 * math.pi * np.sign(np.diff(l)), np.zeros(l.size - 1)])
    cuts = np.flatnonzero(round_ | passes) + 1
    parts = []
    for first, last in zip([0, *cuts], [*cuts, l.size], strict=True):
        pieces = [points[first:last]]
        if first and passes[first - 1]:
            pieces.insert(0, points[first - 1 : first] + turn[first - 1])
        if last < l.size and passes[last - 1]:
            pieces.append(points[last : last + 1] - turn[last - 1])
        parts.append(np.concatenate(pieces))
    return parts
