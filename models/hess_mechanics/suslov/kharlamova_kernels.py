# mypy: allow-untyped-defs
"""Kernel of `kharlamova`: the zeros of the quartic P(τ) next to τ = 0.  Not for users."""

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

_CLOSE = 1e-12
"""Last step of Newton's method, which squares the error, as a share of the zero."""


@part
def _value(c, x):
    value = 0.0
    for k in range(4, -1, -1):
        value = value * x + c[k]
    return value


@part
def _zero(c, derivative, a, b):
    """Return the zero between a and b, where the values differ in sign, by Newton's method safeguarded by bisection."""
    rising = _value(c, b) > 0.0
    x = 0.5 * (a + b)
    for _ in range(200):
        f, slope = _value(c, x), _value(derivative, x)
        if (f > 0.0) == rising:
            b = x
        else:
            a = x
        if abs(f) <= _CLOSE * abs(slope * x):
            return x - f / slope if slope != 0.0 else x
        y = x - f / slope
        x = y if a < y < b else 0.5 * (a + b)
    return x


@part
def _zeros(c, reach, derivatives, zeros):
    """Return the number of zeros of P in (−reach, reach); zeros[i] = (τ, 1 if P only touches 0 from above).

    If P(0) = 0, the zeros are those of P/τ.
    """
    first = 0 if c[0] > 0.0 else 1
    derivatives[:] = 0.0
    derivatives[0, : 5 - first] = c[first:]
    for d in range(1, 6):
        for k in range(4):
            derivatives[d, k] = (k + 1.0) * derivatives[d - 1, k + 1]
    count = 0
    knots = np.empty(6)
    # Between the zeros of its derivative a polynomial is monotone.
    for d in range(3, -1, -1):
        knots[0], knots[count + 1] = -reach, reach
        knots[1 : count + 1] = zeros[:count, 0]
        n, before = 0, _value(derivatives[d], -reach)
        for i in range(1, count + 2):
            x = knots[i]
            f = _value(derivatives[d], x)
            bend = _value(derivatives[2], x) * (x if first else 1.0)
            if d == 0 and i <= count and abs(f) <= _TOUCH and bend > 0.0:
                zeros[n, 0], zeros[n, 1] = x, 1.0
                n += 1
                continue
            if (f > 0.0) != (before > 0.0):
                zeros[n, 0], zeros[n, 1] = _zero(derivatives[d], derivatives[d + 1], knots[i - 1], x), 0.0
                n += 1
            before = f
        count = n
    return count


@kernel
def arcs(coefficients, out):
    """Compute the zeros next to τ = 0 of polynomials P of degree 4 with P(0) ≥ 0.

    coefficients : (n, 5), those of each P, the constant first.
    out : (n, 5), the zeros τ₋ and τ₊, the side of a double zero (−1 or 1; 0: none), and the zeros of another orbit on
    the same parabola (0, 0: none).
    """
    derivatives, zeros = np.empty((6, 5)), np.empty((6, 2))
    out[:] = 0.0
    for k in range(len(coefficients)):
        c = coefficients[k]
        if c[0] == 0.0 and c[1] == 0.0:
            continue
        bent = 2.0 * math.sqrt(-c[4])
        # Beyond this reach |u| ≥ |a|τ²/2 − τ − 1 exceeds 1.
        reach = max(_REACH, 1.01 * (1.0 + math.sqrt(1.0 + 4.0 * bent)) / bent) if bent > _LEAST else _REACH
        n = _zeros(c, reach, derivatives, zeros)
        # The start τ = 0 lies between the zeros i − 1 and i, where P > 0.
        i = 0
        while i < n and zeros[i, 0] < 0.0:
            i += 1
        if c[0] == 0.0:
            zeros[i + 1 : n + 1] = zeros[i:n].copy()
            zeros[i] = 0.0
            n += 1
            i += 1 if c[1] > 0.0 else 0
        out[k, 0], out[k, 1] = zeros[i - 1, 0], zeros[i, 0]
        out[k, 2] = 1.0 if zeros[i, 1] > 0.0 else -zeros[i - 1, 1]
        # If the arc only touches the equator, the next arc starts there.
        j = i - 1 if out[k, 2] < 0.0 else (i + 1 if out[k, 2] > 0.0 else (i - 2 if i > 2 else i + 2))
        if 0 < j < n:
            out[k, 3], out[k, 4] = zeros[j - 1, 0], zeros[j, 0]
