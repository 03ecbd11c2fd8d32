"""Numbers and formulas as people read them."""

from __future__ import annotations

import math
import re

from latex2mathml.converter import convert

__all__ = ["number", "with_formulas"]


def number(value: float, digits: int = 4) -> str:
    """Up to `digits` significant digits, with a true minus sign; ∞ where it is beyond double range."""
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    return f"{value:.{digits}g}".replace("-", "−").replace("e+", "e")


def with_formulas(text: str) -> str:
    """Markdown whose $…$ and $$…$$ have become MathML, which browsers set without a script."""
    text = re.sub(r"\$\$(.+?)\$\$", lambda match: convert(match[1], display="block"), text, flags=re.DOTALL)
    return re.sub(r"\$(.+?)\$", lambda match: convert(match[1]), text)
