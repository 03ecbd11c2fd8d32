"""Numbers as people read them."""

from __future__ import annotations

import math

__all__ = ["number"]


def number(value: float, digits: int = 4) -> str:
    """Up to `digits` significant digits, with a true minus sign; ∞ where it is beyond double range."""
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    return f"{value:.{digits}g}".replace("-", "−").replace("e+", "e")
