"""Numbers and formulas for display."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable

from latex2mathml.converter import convert

from hess_mechanics.numerics.results import Array
from hess_mechanics.parameters import plain


def digits(value: float, count: int = 4) -> str:
    """Return a number with up to `count` significant digits and a true minus sign; infinities as ∞ and −∞."""
    if math.isinf(value):
        return "∞" if value > 0 else "−∞"
    return plain(value, count).replace("-", "−")


def with_error(value: float, error: float) -> str:
    """Return "value ± error": an error in [1e-8, 1) with two significant digits, and the value with as many decimals.

    For any other error the value has up to three significant digits and the error up to two.
    """
    places = 1 - math.floor(math.log10(error)) if 0.0 < error < 1.0 else 0
    if not 0 < places <= 9:
        return f"{digits(value, 3)} ± {digits(error, 2)}"
    # Adding 0 turns −0 into 0.
    return f"{round(value, places) + 0.0:.{places}f} ± {error:.{places}f}".replace("-", "−")


def range_text(low: float, high: float, count: int = 4) -> str:
    """Return "from … to …", or "= …" if both numbers agree to `count` significant digits."""
    first, last = digits(low, count), digits(high, count)
    return f"= {first}" if first == last else f"from {first} to {last}"


def variation_text(values: Array) -> str:
    """Return "between … and …" for values (n,), or "constant at …" if they agree to four significant digits."""
    low, high = digits(float(values.min())), digits(float(values.max()))
    return f"constant at {low}" if low == high else f"between {low} and {high}"


def conjugates(value: complex) -> str:
    """Return a real number as text, or the pair of a complex number and its conjugate as "a ± bi"."""
    return digits(value.real) if not value.imag else f"{digits(value.real)} ± {digits(abs(value.imag))}i"


def vector(components: Iterable[float]) -> str:
    """Return the components in parentheses."""
    return f"({', '.join(map(digits, components))})"


def superscript(number: int) -> str:
    """Return a natural number as an exponent: 12 becomes "¹²"."""
    return str(number).translate(str.maketrans("0123456789", "⁰¹²³⁴⁵⁶⁷⁸⁹"))


def with_formulas(text: str) -> str:
    """Return Markdown with $…$ and $$…$$ converted to MathML, which browsers render without a script."""
    text = re.sub(r"\$\$(.+?)\$\$", lambda match: convert(match[1], display="block"), text, flags=re.DOTALL)
    return re.sub(r"\$(.+?)\$", lambda match: convert(match[1]), text)
