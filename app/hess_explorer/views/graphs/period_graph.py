"""The period of an orbit over its initial direction."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.layers import Axes, Layers, Range, curves, ring
from hess_explorer.views.plane.velocity_plane import round_up
from hess_mechanics.numerics.results import Array

S = TypeVar("S")


def has_periods(periods: Array) -> bool:
    """Return whether any period T is finite, given rows (α, T), (n, 2)."""
    return bool(np.isfinite(periods[:, 1]).any())


def period_axis(periods: Array, here: float = 0.0) -> Range:
    """Return an axis from 0 that contains most finite periods, and the current period `here` if it is finite.

    (0, 20) if no period in the rows (α, T), (n, 2), is finite.
    """
    finite = periods[np.isfinite(periods[:, 1]), 1]
    if not finite.size:
        return 0.0, 20.0
    return 0.0, round_up(max(1.5 * float(np.median(finite)), 1.1 * here if math.isfinite(here) else 0.0))


def layers(periods: Callable[[S], Array], here: Callable[[S], tuple[float, float] | None]) -> Layers[S]:
    """Return the layers: the graph of T over α, and a ring at the current orbit; empty if no period is finite.

    Parameters
    ----------
    periods : callable
        `periods(state)` returns rows (α, T), (n, 2).
    here : callable
        `here(state)` returns α and T of the current orbit, or None.  The ring of a T beyond the axis is at its end.
    """

    def curve(state: S, axes: Axes) -> list[Array]:
        found = periods(state)
        return [np.minimum(found, (np.inf, 4.0 * axes.y[1]))] if has_periods(found) else []

    def chosen(state: S, axes: Axes) -> list[tuple[float, float]]:
        point = here(state) if has_periods(periods(state)) else None
        return [] if point is None else [(point[0], min(point[1], axes.y[1]))]

    return curves("T", data_in_axes=curve, color=theme.ORBIT), ring("chosen", data_in_axes=chosen, size=18)
