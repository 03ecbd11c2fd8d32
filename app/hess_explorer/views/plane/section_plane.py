"""A Poincaré section: points of many orbits, with the chosen orbit on top."""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.layers import (
    Axes,
    Layer,
    Layers,
    Positions,
    Regions,
    compose,
    dots,
    points,
    rectangle,
    region,
    ring,
)
from hess_mechanics.numerics.results import Array

S = TypeVar("S")
Points = Callable[[S], Array | None]
_CLOSES = 12
"""An orbit with at most this many distinct crossings looks closed."""


def layers(
    own: Points[S],
    others: Points[S] | None = None,
    forbidden: Callable[[S, Axes], Regions] | None = None,
    start: Callable[[S], Positions] | None = None,
    ended: Points[S] | None = None,
) -> Layers[S]:
    """Return the layers of a section: the chosen orbit, other orbits, a ring at the start, the forbidden region.

    Parameters
    ----------
    own : callable
        `own(state)` returns the points (n, 2) of the chosen orbit, or None.
    others : callable, optional
        `others(state)` returns the points (n, 2) of other orbits, drawn small, or None.
    forbidden : callable, optional
        `forbidden(state, axes)` returns the forbidden region, as for `region`.
    start : callable, optional
        `start(state)` returns the start of the chosen orbit as a list; empty for none.
    ended : callable, optional
        `ended(state)` returns the points (n, 2) of other orbits that end early, or None.
    """
    found: list[Layer[S]] = []
    if forbidden is not None:
        found.append(region("forbidden", data_in_axes=forbidden, label="impossible", tag="impossible"))
    if others is not None:
        found.append(_points("others", others, theme.MUTED, 6, "other orbits"))
    if ended is not None:
        found.append(_points("ended", ended, theme.CHANGED, 6, "orbits that end early"))
    found.append(_points("own", own, theme.ORBIT, 14, ""))
    found.append(points("own-few", lambda s: _few(own(s)), color=theme.ORBIT, size=9))
    if start is not None:
        found.append(ring("chosen", start, label="start", tag="start"))
    return tuple(found)


def _points(name: str, of: Points[S], color: str, size: float, label: str) -> Layer[S]:
    return dots(name, compose(of, np.transpose), color=color, size=size, label=label)


def _few(crossings: Array | None) -> Array | None:
    """Return the distinct crossings (2, n) of a closed orbit, which need large marks; None for other orbits."""
    if crossings is None or not len(crossings):
        return None
    points = np.unique(np.round(crossings, 3), axis=0)
    return points.T if len(points) <= _CLOSES else None


def concatenate(parts: Iterable[Array]) -> Array:
    """Return the points (n, 2) of all given orbits as one array; n = 0 without orbits."""
    return np.concatenate([np.empty((0, 2)), *parts])


def band(middle: float, half: float, period: float, axes: Axes) -> list[list[Array]]:
    """Return the vertical band middle ± half of the horizontal angle with its periodic copies, as a region."""
    part = rectangle((-half, half), axes.y)
    return [[part + np.array([middle + turn, 0.0])] for turn in (-period, 0.0, period)]


def exterior(curves: Sequence[Array], x: float, y: float) -> list[list[Array]]:
    """Return the rectangle ±x, ±y without the interior of closed curves (n, 2), as a region."""
    return [[rectangle((-x, x), (-y, y)), *curves]]
