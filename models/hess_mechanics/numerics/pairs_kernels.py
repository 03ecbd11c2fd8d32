# mypy: allow-untyped-defs
"""Double-double arithmetic, with 31 digits: a number is the sum of two doubles, stored as the complex high + i low.

Not for users.  |low| is at most half a unit in the last place of high.  The arithmetic is that of Dekker (1971) and
Knuth (The Art of Computer Programming 2, 4.2.2).

exp, sin and cos are series after a reduction of the argument.  The inverse functions are a Newton step from the double,
which squares its relative error of 1e-16.
"""

from __future__ import annotations

import math

from hess_mechanics.numerics.jit import without_fma

__all__ = ["DOUBLE_DOUBLE_FUNCTIONS", "add", "divide", "multiply", "subtract"]

_SPLITTER = 134217729.0
"""2^27 + 1: splits a double into two halves, whose products are exact."""
_LN2 = complex(0.6931471805599453, 2.3190468138462996e-17)
_HALF_PI = complex(1.5707963267948966, 6.123233995736766e-17)
_HALF_PI_LOW = complex(-1.4973849048591833e-33, 0.0)
"""The third double of π/2: the quarter turns of a large angle are subtracted to 31 digits."""
_ONE, _TWO = complex(1.0, 0.0), complex(2.0, 0.0)
_HALVINGS, _EXP_TERMS, _SIN_TERMS = 6, 12, 15


@without_fma
def add(a, b):
    """Return a + b, to 31 digits of the larger operand."""
    total = a.real + b.real
    part_of_b = total - a.real
    low = (a.real - (total - part_of_b)) + (b.real - part_of_b)
    low += a.imag + b.imag
    high = total + low
    return complex(high, low - (high - total))


@without_fma
def subtract(a, b):
    """Return a − b."""
    return add(a, -b)


@without_fma
def multiply(a, b):
    """Return a · b."""
    product = a.real * b.real
    scaled = _SPLITTER * a.real
    a_high = scaled - (scaled - a.real)
    a_low = a.real - a_high
    scaled = _SPLITTER * b.real
    b_high = scaled - (scaled - b.real)
    b_low = b.real - b_high
    low = ((a_high * b_high - product) + a_high * b_low + a_low * b_high) + a_low * b_low
    low += a.real * b.imag + a.imag * b.real
    high = product + low
    return complex(high, low - (high - product))


@without_fma
def divide(a, b):
    """Return a/b, by long division."""
    first = complex(a.real / b.real, 0.0)
    left = subtract(a, multiply(first, b))
    second = complex(left.real / b.real, 0.0)
    left = subtract(left, multiply(second, b))
    return add(add(first, second), complex(left.real / b.real, 0.0))


@without_fma
def sqrt(a):
    """Return √a."""
    if not a.real > 0.0:
        return complex(math.sqrt(a.real), 0.0)
    first = complex(math.sqrt(a.real), 0.0)
    return add(first, divide(subtract(a, multiply(first, first)), multiply(_TWO, first)))


@without_fma
def exp(a):
    """Return e^a: with r = (a − k ln 2)/2⁶ from the series of e^r − 1, doubled six times."""
    k = math.floor(a.real / _LN2.real + 0.5)
    if not abs(k) < 1020.0:
        return complex(math.exp(a.real), 0.0)
    r = subtract(a, multiply(complex(k, 0.0), _LN2)) * 0.5**_HALVINGS
    total = complex(0.0, 0.0)
    for n in range(_EXP_TERMS, 0, -1):
        total = divide(multiply(r, add(_ONE, total)), complex(float(n), 0.0))
    for _ in range(_HALVINGS):
        total = add(multiply(total, total), total * 2.0)
    return add(_ONE, total) * 2.0**k


@without_fma
def log(a):
    """Return ln a."""
    first = complex(math.log(a.real), 0.0)
    if not math.isfinite(first.real):
        return first
    return add(first, subtract(multiply(a, exp(-first)), _ONE))


@without_fma
def _sine_cosine(a):
    """Return sin a and cos a, by series on |r| ≤ π/4."""
    k = math.floor(a.real / _HALF_PI.real + 0.5)
    turns = complex(k, 0.0)
    r = subtract(subtract(a, multiply(turns, _HALF_PI)), multiply(turns, _HALF_PI_LOW))
    square = multiply(r, r)
    s, c = complex(0.0, 0.0), complex(0.0, 0.0)
    for n in range(_SIN_TERMS, 0, -1):
        s = divide(multiply(square, subtract(_ONE, s)), complex(2.0 * n * (2.0 * n + 1.0), 0.0))
        c = divide(multiply(square, subtract(_ONE, c)), complex(2.0 * n * (2.0 * n - 1.0), 0.0))
    s, c = multiply(r, subtract(_ONE, s)), subtract(_ONE, c)
    quarter = int(k) % 4
    if quarter == 1:
        return c, -s
    if quarter == 2:
        return -s, -c
    if quarter == 3:
        return -c, s
    return s, c


@without_fma
def sin(a):
    """Return sin a."""
    return _sine_cosine(a)[0]


@without_fma
def cos(a):
    """Return cos a."""
    return _sine_cosine(a)[1]


@without_fma
def tan(a):
    """Return tan a."""
    s, c = _sine_cosine(a)
    return divide(s, c)


@without_fma
def sinh(a):
    """Return sinh a, to 31 digits of cosh a."""
    e = exp(a)
    return subtract(e, divide(_ONE, e)) * 0.5


@without_fma
def cosh(a):
    """Return cosh a."""
    e = exp(a)
    return add(e, divide(_ONE, e)) * 0.5


@without_fma
def tanh(a):
    """Return tanh a = 1 − 2/(e^{2a} + 1)."""
    return subtract(_ONE, divide(_TWO, add(exp(a * 2.0), _ONE)))


@without_fma
def atan2(y, x):
    """Return the angle of (x, y) as a double, and the remaining angle after a rotation back by this double."""
    first = complex(math.atan2(y.real, x.real), 0.0)
    s, c = _sine_cosine(first)
    along, across = add(multiply(x, c), multiply(y, s)), subtract(multiply(y, c), multiply(x, s))
    return add(first, divide(across, along)) if along.real > 0.0 else first


@without_fma
def atan(a):
    """Return arctan a."""
    return atan2(a, _ONE)


@without_fma
def asin(a):
    """Return arcsin a."""
    return atan2(a, sqrt(multiply(subtract(_ONE, a), add(_ONE, a))))


@without_fma
def acos(a):
    """Return arccos a."""
    return atan2(sqrt(multiply(subtract(_ONE, a), add(_ONE, a))), a)


@without_fma
def power(a, exponent):
    """Return a to the power of an exponent."""
    return exp(multiply(exponent, log(a)))


DOUBLE_DOUBLE_FUNCTIONS = {
    "acos": acos,
    "asin": asin,
    "atan": atan,
    "atan2": atan2,
    "cos": cos,
    "cosh": cosh,
    "exp": exp,
    "log": log,
    "pow": power,
    "sin": sin,
    "sinh": sinh,
    "sqrt": sqrt,
    "tan": tan,
    "tanh": tanh,
}
"""The functions by the names that they have in the source of a recursion."""
