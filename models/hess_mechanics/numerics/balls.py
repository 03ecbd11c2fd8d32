"""Ball arithmetic by Arb (python-flint): numbers with midpoint and radius, whose operations enclose the exact result.

Input numbers are exact rationals, and so are the ends of the resulting intervals.  A result is proved to lie between
them, provided that Arb's operations are correct.
"""

from __future__ import annotations

import importlib
import importlib.util
import math
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from decimal import ROUND_CEILING, ROUND_FLOOR, Decimal, InvalidOperation, localcontext
from fractions import Fraction
from typing import Any

from hess_mechanics.errors import InvalidParameter, MissingLibrary, WorkLimit
from hess_mechanics.numerics.expressions import FUNCTIONS

__all__ = [
    "BALL_FUNCTIONS",
    "ArbBall",
    "Enclosure",
    "ExactNumber",
    "enclosure",
    "exact",
    "flint",
    "has_flint",
    "rational",
    "series_coefficients",
    "to_digits",
    "working_precision",
]

ArbBall = Any
"""An `arb` of python-flint, an optional dependency that is imported on demand."""

ExactNumber = str | float | Fraction
"""A number that proofs take as exact, see `exact`."""

_MOST_DIGITS, _MOST_EXPONENT = 100, 400
_MOST_BITS = 1 << 14
_LOCK = threading.RLock()


def flint() -> Any:
    """Return the library python-flint.

    Returns
    -------
    module
        The library.

    Raises
    ------
    MissingLibrary
        If it is not installed; the message says what to install.
    """
    try:
        return importlib.import_module("flint")
    except ImportError as error:
        raise MissingLibrary("Proofs need python-flint: pip install 'hess-explorer[prove]'.") from error


def has_flint() -> bool:
    """Return True if python-flint is installed.

    Returns
    -------
    bool
        True if it can be imported.
    """
    return importlib.util.find_spec("flint") is not None


def _of_balls(name: str) -> Callable[..., ArbBall]:
    def call(*arguments: Any) -> ArbBall:
        arb = flint().arb
        return getattr(arb, name)(*map(arb, arguments))

    return call


BALL_FUNCTIONS = {name: _of_balls("__pow__" if name == "pow" else name) for name in FUNCTIONS}
"""Functions of balls, by the names in the source of a recursion."""


@contextmanager
def working_precision(bits: int) -> Iterator[Any]:
    """Set the precision of ball arithmetic for the body of a `with` statement.

    The precision is global, so other threads wait at this statement.  The cap on the terms of power series is restored
    at the end.

    Parameters
    ----------
    bits : int
        Precision, in bits.

    Yields
    ------
    module
        The library python-flint.

    Raises
    ------
    MissingLibrary
        If it is not installed.
    """
    library = flint()
    with _LOCK, library.ctx.workprec(bits):
        before = library.ctx.cap
        try:
            yield library
        finally:
            library.ctx.cap = before


def exact(name: str, value: ExactNumber | Decimal) -> Fraction:
    """Return a number, or a text such as 1.5, -2e-3 or 3/4, as a rational; a double is read as its shortest decimal.

    Parameters
    ----------
    name : str
        Name of the number, for the message.
    value : str, float, Fraction or Decimal
        The number; numerator and denominator have at most 100 digits and exponents within ±400.

    Returns
    -------
    Fraction
        The rational.

    Raises
    ------
    InvalidParameter
        If it is not such a number.

    Examples
    --------
    >>> from hess_mechanics.numerics.balls import exact
    >>> exact("a", "0.1"), exact("a", 0.1), exact("a", "1/3")
    (Fraction(1, 10), Fraction(1, 10), Fraction(1, 3))
    """
    text = str(value).strip()
    try:
        parts = [_decimal(part) for part in text.split("/")]
        if len(parts) > 2 or (len(parts) == 2 and parts[1] == 0):
            raise ValueError
    except (ValueError, InvalidOperation):
        shown = text if len(text) <= 60 else text[:60] + "…"
        raise InvalidParameter(
            f"{name} = {shown!r} is not an exact number; write it like 1.5, -2e-3 "
            f"or 3/4, with at most {_MOST_DIGITS} digits and exponents within ±{_MOST_EXPONENT}."
        ) from None
    return parts[0] / parts[1] if len(parts) == 2 else parts[0]


def _decimal(text: str) -> Fraction:
    """Return a decimal text as a rational.  Raises `ValueError`, `InvalidOperation`.

    The bounds are checked first: the rational 1e999999999 would fill the memory.
    """
    if len(text) > 3 * _MOST_DIGITS or not text.isascii() or "_" in text:
        raise ValueError
    number = Decimal(text)
    if (
        not number.is_finite()
        or len(number.as_tuple().digits) > _MOST_DIGITS
        or (number and abs(number.adjusted()) > _MOST_EXPONENT)
    ):
        raise ValueError
    return Fraction(number)


def rational(value: Fraction | int) -> Any:
    """Return a rational as python-flint's `fmpq`.

    Parameters
    ----------
    value : Fraction or int
        The rational.

    Returns
    -------
    fmpq
        The same number.
    """
    return flint().fmpq(value.numerator, value.denominator)


@dataclass(frozen=True)
class Enclosure:
    """An interval with rational ends in which a real number lies.

    Parameters
    ----------
    low : Fraction
        Lower end.
    high : Fraction
        Upper end, ≥ low.
    """

    low: Fraction
    high: Fraction

    @property
    def width(self) -> Fraction:
        """Length of the interval."""
        return self.high - self.low

    @property
    def precision(self) -> float:
        """Width of the interval, divided by the largest magnitude of its ends if that exceeds 1."""
        return float(self.width / max(Fraction(1), abs(self.low), abs(self.high)))

    def __repr__(self) -> str:
        # Python refuses to print integers of thousands of digits, which fractions near 0 have.
        return "Enclosure({}, {})".format(*self.decimals())

    def __contains__(self, number: Fraction) -> bool:
        return self.low <= number <= self.high

    def decimals(self, digits: int | None = None) -> tuple[str, str]:
        """Return two decimals that enclose the interval.

        Parameters
        ----------
        digits : int, optional
            Number of significant digits.  By default enough for decimals that are hardly wider than the interval.

        Returns
        -------
        (str, str)
            The lower and the upper decimal.

        Examples
        --------
        >>> from fractions import Fraction
        >>> from hess_mechanics.numerics.balls import Enclosure
        >>> Enclosure(Fraction(1, 3), Fraction(1, 3)).decimals(4)
        ('0.3333', '0.3334')
        """
        if digits is None:
            size = max(abs(self.low), abs(self.high))
            share = self.width / size if size else Fraction(0)
            # Print one digit beyond the first digit in which the ends differ.
            digits = len(str(int(1 / share))) + 1 if share else max(30, len(str(self.low.denominator)) + 1)
        return _rounded(self.low, digits, ROUND_FLOOR), _rounded(self.high, digits, ROUND_CEILING)

    def double_decimals(self) -> tuple[str, str]:
        """Return two decimals that enclose the interval, also after conversion to doubles.

        Returns
        -------
        (str, str)
            The lower and the upper decimal, with at most 16 significant digits.  Beyond the range of doubles they
            enclose the interval only as decimals.
        """
        low, high = self.decimals(16)
        if not math.isfinite(float(low)) or not math.isfinite(float(high)):
            return low, high
        for _ in range(2):
            if Fraction(float(low)) <= self.low and self.high <= Fraction(float(high)):
                break
            unit = max(abs(self.low), abs(self.high), Fraction(1, 10**300)) / 10**15
            low, high = Enclosure(self.low - unit, self.high + unit).decimals(16)
        return low, high


def _rounded(number: Fraction, digits: int, rounding: str) -> str:
    with localcontext(prec=digits, rounding=rounding, Emax=10**9, Emin=-(10**9)):
        decimal = (Decimal(number.numerator) / Decimal(number.denominator)).normalize()
    return f"{decimal:f}" if -6 < decimal.adjusted() < digits + 6 else str(decimal)


def enclosure(ball: ArbBall) -> Enclosure:
    """Return the exact interval of a ball.

    Parameters
    ----------
    ball : arb
        The ball.

    Returns
    -------
    Enclosure
        The interval.

    Raises
    ------
    ArithmeticError
        If the ball is not finite.
    """
    if not ball.is_finite():
        raise ArithmeticError("an unbounded ball")
    low, high = (end.man_exp() for end in (ball.lower(), ball.upper()))
    return Enclosure(_dyadic(*low), _dyadic(*high))


def _dyadic(mantissa: Any, exponent: Any) -> Fraction:
    m, e = int(mantissa), int(exponent)
    return Fraction(m << e) if e >= 0 else Fraction(m, 1 << -e)


def to_digits(digits: int, compute: Callable[[Any], ArbBall]) -> Enclosure:
    """Return the enclosure of a number, with the working precision raised until the interval is narrow enough.

    Parameters
    ----------
    digits : int
        Number of digits: `Enclosure.precision` becomes less than 10^−digits.
    compute : callable
        Function compute(library) that returns the ball at the current precision of the library python-flint.

    Returns
    -------
    Enclosure
        The interval.

    Raises
    ------
    WorkLimit
        If the number needs more than 16 384 bits.
    MissingLibrary
        If python-flint is not installed.
    """
    bits = 128
    while bits <= _MOST_BITS:
        with working_precision(bits) as library:
            ball = compute(library)
            if ball.is_finite() and enclosure(ball).precision < 10.0 ** (-digits):
                return enclosure(ball)
        bits *= 2
    raise WorkLimit("These numbers need more precision than a closed form may take: choose less extreme ones.")


def series_coefficients(series: Any, terms: int) -> list[ArbBall]:
    """Return the coefficients of a power series, with the zeros at its end that python-flint leaves out.

    Parameters
    ----------
    series : arb_series
        The series.
    terms : int
        Number of coefficients, not less than the length of the series.

    Returns
    -------
    list of arb
        The coefficients, from order 0 on.
    """
    coefficients = series.coeffs()
    return [*coefficients, *([0 * series[0]] * (terms - len(coefficients)))]
