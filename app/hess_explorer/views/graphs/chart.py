"""Curves of logarithms or on logarithmic axes; values below the axis are drawn at its edge."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.layers import Layer, Range, line
from hess_mechanics.numerics.results import Array

S = TypeVar("S")

POWERS = [1e-16, 1e-12, 1e-8, 1e-4, 1.0]
"""Ticks of errors on a horizontal axis: fewer than Bokeh's, as labels with powers of ten are wide."""

LG_OF_0 = -17.5
"""Height at which lg 0 is drawn."""


def lg(distance: Array) -> Array:
    """Return the decimal logarithm of non-negative distances, at least `LG_OF_0`."""
    return np.asarray(np.log10(np.maximum(distance, 10.0**LG_OF_0)), float)


def lg_axis(largest: float) -> Range:
    """Return an axis from `LG_OF_0` to the decimal logarithm of `largest`, rounded up to a multiple of ½."""
    return LG_OF_0, math.ceil(2.0 * math.log10(largest)) / 2.0


def clip(values: Array, floor: float) -> Array:
    """Return values (n,), clipped from below at the floor of the axis."""
    return np.asarray(np.maximum(values, floor), float)


def limit(height: Callable[[S], float]) -> Layer[S]:
    """Return the layer of a dotted horizontal line across the picture, at `height(state)`."""
    return line("limit", lambda s: ((-1e30, 1e30), (height(s),) * 2), color=theme.MUTED, dash="dotted")
