"""Windows of a plane, and the cells that fill them."""

from __future__ import annotations

import numpy as np

from hess_mechanics.numerics.results import Array

__all__ = ["Window", "centres"]

Window = tuple[tuple[float, float], tuple[float, float]]
"""Two opposite corners, (x0, y0), (x1, y1), the lower left one first."""


def centres(low: float, high: float, count: int) -> Array:
    """Of `count` equal cells between two ends, (count,)."""
    return low + (np.arange(count) + 0.5) * (high - low) / count
