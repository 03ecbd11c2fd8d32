"""Sliders of the principal moments of a heavy body in or near the Hess case."""

from __future__ import annotations

from collections.abc import Mapping

from hess_explorer.scenes.framework.sliders import Slider
from hess_mechanics.parameters import I1 as FIRST

_ENDS, _STEP = FIRST.softbounds, FIRST.step


def limits_of_moments(I1: float, I2: float, I3: float) -> Mapping[str, Slider]:
    """Return slider ranges that keep I₂ between the other moments; typed values may lie outside.

    Empty if I₂ is not between them, or they differ by at most two steps: the sliders then have their usual ranges.
    """
    low, high = sorted((I1, I3))
    if not (low <= I2 <= high and high - low > 2.0 * _STEP):
        return {}
    smallest, largest = ("I1", "I3") if I1 < I3 else ("I3", "I1")
    return {
        smallest: (min(_ENDS[0], low), I2, _STEP),
        "I2": (low, high, _STEP),
        largest: (I2, max(_ENDS[1], high), _STEP),
    }
