# mypy: allow-untyped-defs
"""Kernels of `attitude`: directions fixed in space, carried along orbits.  Not for users."""

from __future__ import annotations

import math

import numpy as np

from hess_mechanics.numerics.jit import inner, kernel

__all__ = ["carry", "rotate"]


@inner
def _cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@inner
def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@inner
def _unit(a):
    length = math.sqrt(_dot(a, a))
    return a[0] / length, a[1] / length, a[2] / length


@inner
def _across(a, g):
    """Return the unit vector along the part of a that is orthogonal to the unit vector g."""
    along = _dot(a, g)
    return _unit((a[0] - along * g[0], a[1] - along * g[1], a[2] - along * g[2]))


@inner
def _rotated(u, v):
    """Return exp(−v×) u."""
    angle = math.sqrt(_dot(v, v))
    sine = math.sin(angle) / angle if angle > 0.0 else 1.0
    half = math.sin(0.5 * angle) / (0.5 * angle) if angle > 0.0 else 1.0
    first = _cross(u, v)
    second = _cross(first, v)
    cosine = 0.5 * half * half
    return (
        u[0] + sine * first[0] + cosine * second[0],
        u[1] + sine * first[1] + cosine * second[1],
        u[2] + sine * first[2] + cosine * second[2],
    )


@inner
def _slope(times, w, k):
    """Return ẇ at sample k, from the parabola through three samples, or at the ends from the chord."""
    left, right = max(k - 1, 0), min(k + 1, times.size - 1)
    a, b = times[k] - times[left], times[right] - times[k]
    if a == 0.0:
        before, after = 0.0, 1.0 / b
    elif b == 0.0:
        before, after = 1.0 / a, 0.0
    else:
        before, after = b / (a * (a + b)), a / (b * (a + b))
    return (
        before * (w[k, 0] - w[left, 0]) + after * (w[right, 0] - w[k, 0]),
        before * (w[k, 1] - w[left, 1]) + after * (w[right, 1] - w[k, 1]),
        before * (w[k, 2] - w[left, 2]) + after * (w[right, 2] - w[k, 2]),
    )


@inner
def _turn(times, w, k):
    """Return the rotation vector of the step after sample k, of fourth order."""
    step = times[k + 1] - times[k]
    s, t = _slope(times, w, k), _slope(times, w, k + 1)
    c = _cross(w[k], w[k + 1])
    h, q = 0.5 * step, step * step / 12.0
    return (
        h * (w[k, 0] + w[k + 1, 0]) + q * (s[0] - t[0] + c[0]),
        h * (w[k, 1] + w[k + 1, 1]) + q * (s[1] - t[1] + c[1]),
        h * (w[k, 2] + w[k + 1, 2]) + q * (s[2] - t[2] + c[2]),
    )


@kernel
def carry(times, omega, gamma, e, v, moved):
    """Carry a direction along n orbits with m samples: ė = e × ω, orthogonal to γ.

    Store the directions in e (n, m, 3), the rotation vectors of the steps in v (n, m − 1, 3), and the sample of γ
    before each step, rotated by it, in `moved` (n, m − 1, 3).
    """
    n, m, _ = gamma.shape
    for i in range(n):
        g = _unit(gamma[i, 0])
        smallest = np.zeros(3)
        smallest[np.argmin(np.abs(gamma[i, 0]))] = 1.0
        there = _across(smallest, g)
        for k in range(m):
            if k > 0:
                turn = _turn(times, omega[i], k - 1)
                v[i, k - 1, 0], v[i, k - 1, 1], v[i, k - 1, 2] = turn
                rotated = _rotated(g, turn)
                moved[i, k - 1, 0], moved[i, k - 1, 1], moved[i, k - 1, 2] = rotated
                g = _unit(gamma[i, k])
                there = _across(_rotated(there, turn), g)
            e[i, k, 0], e[i, k, 1], e[i, k, 2] = there


@kernel
def rotate(u, v, out):
    """Store exp(−v×) u for rows of u and v (n, 3) in out (n, 3)."""
    for i in range(len(u)):
        out[i, 0], out[i, 1], out[i, 2] = _rotated(u[i], v[i])
