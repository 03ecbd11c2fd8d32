"""The sliders of the principal moments of a heavy body near the Hess case."""

from __future__ import annotations

from collections.abc import Mapping

from hess_explorer.scenes.framework.parameters import Slider
from hess_mechanics.parameters import I1

__all__ = ["limits_of_moments"]


def limits_of_moments(first: float, second: float, third: float) -> Mapping[str, Slider]:
    """Return sliders that keep I₂ between I₁ and I₃; a typed value may change their order."""
    low, high = sorted((first, third))
    if not (low <= second <= high and high - low > 2.0 * I1.step):
        return {}
    (least, most), step = I1.softbounds, I1.step
    smallest, largest = ("I1", "I3") if first < third else ("I3", "I1")
    return {smallest: (min(least, low), second, step), "I2": (low, high, step),
            largest: (second, max(most, high), step)}
