"""The number of points of a picture shaded by density."""

from __future__ import annotations

import math
import os

_MOST = float(os.environ.get("HESS_EXPLORER_POINTS", "1e7"))
"""Largest number of points of a picture, smaller on a server with many visitors."""


def stages_of(first: int, stages: int, growth: int = 2) -> tuple[int, int]:
    """Return the points of the first stage and the number of stages, limited to the points that a picture may have.

    All stages together have at most that many points; there is at least one stage.

    Parameters
    ----------
    first, stages : int
        Points of the first stage and number of stages without the limit.
    growth : int
        Factor from the points of a stage to those of the next one, at least 2.
    """
    first = min(first, int(_MOST))
    return first, max(1, min(stages, int(math.log(_MOST / first * (growth - 1) + 1.0, growth) + 1e-9)))
