# mypy: allow-untyped-defs
"""Kernel of `kharlamova`: the zeros of the quartic P(τ) next to τ = 0, and the period between them."""

from __future__ import annotations

import math

import numpy as np

from hess_mechanics.numerics.jit import kernel, part

__all__ = ["arcs"]

_REACH = 10.0
"""The τ by which every arc has left the disk, in units of 1/ν, in which |v0| ≤ 1, |a| ≤ 1 and one of them is 1."""

_LEAST = 1e-50
"""Smallest |a| in those units; below it the parabola is a straight line to double precision."""

_TOUCH = 1e-14
"""Largest γ3² of a minimum that counts as a double zero: its sign is round-off."""


@part
def _value(c, x):
    return c[0] + x * (c[1] + x * (c[2] + x * (c[3] + x * c[4])))


@part
def _slope(c, x):
    return c[1] + x * (2.0 * c[2] + x * (3.0 * c[3] + x * 4.0 * c[4]))


@part
def _zero(c, a, b):
    """Return the zero between a and b, where the values differ in sign, by Newton's method safeguarded by bisection."""
    rising = _value(c, b) > 0.0
    x = 0.5 * (a + b)
    for _ in range(200):
        f = _value(c, x)
        if f == 0.0:
            break
        if (f > 0.0) == rising:
            b = x
        else:
            a = x
        slope = _slope(c, x)
        y = x - f / slope if slope != 0.0 else a
        if not a < y < b:
            y = 0.5 * (a + b)
        done = abs(y - x) <= 1e-16 * abs(y)
        x = y
        if done:
            break
    return x


@part
def _zeros(c, knots, count, touching, found):
    """Return the number of zeros between the knots, which include all extrema; found[i] = (zero, 1 if double).

    touching : largest |minimum| that counts as one double zero.
    """
    n = 0
    before = _value(c, knots[0])
    for i in range(1, count):
        x = knots[i]
        f = _value(c, x)
        bend = c[2] + x * (3.0 * c[3] + x * 6.0 * c[4])
        if i < count - 1 and abs(f) <= touching and bend > 0.0:
            found[n, 0], found[n, 1] = x, 1.0
            n += 1
            f = 1e-300
        elif (f > 0.0) != (before > 0.0):
            found[n, 0], found[n, 1] = _zero(c, knots[i - 1], x), 0.0
            n += 1
        before = f
    return n


@part
def _zeros_beyond(c, reach, knots, found):
    """Return the number of zeros in (0, reach) of a quartic with c[0] ≠ 0; `found` lists them as in `_zeros`."""
    c1 = (c[1], 2.0 * c[2], 3.0 * c[3], 4.0 * c[4], 0.0)
    A, B, C = 3.0 * c1[3], 2.0 * c1[2], c1[1]
    knots[0] = 0.0
    count = 1
    discriminant = B * B - 4.0 * A * C
    if discriminant > 0.0:
        half = -0.5 * (B + math.copysign(math.sqrt(discriminant), B))
        x = C / half if half != 0.0 else 0.0
        y = half / A if A != 0.0 else 0.0
        for z in (min(x, y), max(x, y)):
            if 0.0 < z < reach:
                knots[count] = z
                count += 1
    knots[count] = reach
    n = _zeros(c1, knots, count + 1, -1.0, found)
    for i in range(n):
        knots[i + 1] = found[i, 0]
    knots[n + 1] = reach
    return _zeros(c, knots, n + 2, _TOUCH, found)


@part
def _mean(x, y):
    """Return the arithmetic–geometric mean."""
    for _ in range(64):
        if abs(x - y) <= 1e-15 * x:
            break
        x, y = 0.5 * (x + y), math.sqrt(x * y)
    return 0.5 * (x + y)


@part
def _period(c, low, high):
    s, m = 0.5 * (high - low), 0.5 * (high + low)
    product = -_slope(c, high) * _slope(c, low)
    if not product > 0.0:
        return math.inf
    root = 0.5 * s * math.sqrt(product)
    C = -c[4] * s * s * s * s
    first = 0.5 * (_value(c, m) - C + root)
    if not first > 0.0:
        return math.inf
    return 2.0 * math.pi * s / _mean(math.sqrt(first), math.sqrt(root))


@kernel
def arcs(coefficients, out):
    """Compute for each P, coefficients (n, 5) with P(0) ≥ 0, the zeros next to τ = 0 and the period between them.

    out : (n, 6), τ₋, τ₊, T, side of a double zero (−1, 1; 0: none), and the zeros of another orbit (0, 0: none).
    """
    knots = np.empty(8)
    left, right = np.empty((5, 2)), np.empty((5, 2))
    for k in range(len(coefficients)):
        c0, c1, c2, c3, c4 = coefficients[k]
        low, high, touch, other_low, other_high = 0.0, 0.0, 0.0, 0.0, 0.0
        bent = 2.0 * math.sqrt(-c4)
        # |u| ≥ |a|τ²/2 − τ − 1.
        reach = max(_REACH, 1.01 * (1.0 + math.sqrt(1.0 + 4.0 * bent)) / bent) if bent > _LEAST else _REACH
        if c0 > 0.0:
            n = _zeros_beyond((c0, -c1, c2, -c3, c4), reach, knots, left)
            m = _zeros_beyond((c0, c1, c2, c3, c4), reach, knots, right)
        else:
            n = _zeros_beyond((-c1, c2, -c3, c4, 0.0), reach, knots, left) if c1 != 0.0 else 0
            m = _zeros_beyond((c1, c2, c3, c4, 0.0), reach, knots, right) if c1 != 0.0 else 0
        i, j = 0, 0
        if c0 > 0.0 or c1 < 0.0:
            low, i = -left[0, 0], 1
            touch = -left[0, 1]
        if c0 > 0.0 or c1 > 0.0:
            high, j = right[0, 0], 1
            touch = right[0, 1] if right[0, 1] > 0.0 else touch
        # If the arc only touches the equator, the next arc starts there.
        if touch < 0.0 and n > 1:
            other_low, other_high = -left[1, 0], low
        elif touch > 0.0 and m > 1:
            other_low, other_high = high, right[1, 0]
        elif n - i > 1:
            other_low, other_high = -left[i + 1, 0], -left[i, 0]
        elif m - j > 1:
            other_low, other_high = right[j, 0], right[j + 1, 0]
        if c0 == 0.0 and c1 == 0.0:
            period = 2.0 * math.pi / math.sqrt(-c2) if c2 < 0.0 else math.inf
        else:
            period = math.inf if touch != 0.0 else _period((c0, c1, c2, c3, c4), low, high)
        out[k, 0], out[k, 1], out[k, 2], out[k, 3] = low, high, period, touch
        out[k, 4], out[k, 5] = other_low, other_high
