"""Curves on logarithmic scales: what is too small for the axis is drawn on its edge."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.layers import Layer, line
from hess_mechanics.numerics.results import Array

__all__ = ["POWERS", "clipped", "limit"]

S = TypeVar("S")

POWERS = [1e-16, 1e-12, 1e-8, 1e-4, 1.0]
"""Ticks of errors on a horizontal axis: fewer than Bokeh would set, as powers of ten are wide."""


def clipped(values: Array, floor: float) -> Array:
    """Values (n,), none below the floor of the axis."""
    return np.maximum(np.asarray(values, float), floor)


def limit(height: Callable[[S], float]) -> Layer[S]:
    """A dotted line across the picture."""
    return line("limit", lambda s: ((-1e30, 1e30), (height(s),) * 2), color=theme.MUTED, dash="dotted")
