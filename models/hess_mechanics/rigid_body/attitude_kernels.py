# mypy: allow-untyped-defs
"""Kernels of `attitude`: directions fixed in space, carried along orbits.  Not for users."""

from __future__ import annotations

import math

from hess_mechanics.numerics.jit import kernel, part

__all__ = ["carry", "rotate"]


@part
def _cross(a, b):
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@part
def _dot(a, b):
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@part
def _unit(a):
    length = math.sqrt(_dot(a, a))
    return a[0] / length, a[1] / length, a[2] / length


@part
def _across(a, g):
    """Return the unit vector along the part of a that is orthogonal to the unit vector g."""
    along = _dot(a, g)
    return _unit((a[0] - along * g[0], a[1] - along * g[1], a[2] - along * g[2]))


@part
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


@part
def _row(a, k):
    return a[k, 0], a[k, 1], a[k, 2]


@part
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


@part
def _turn(step, w0, w1, s0, s1):
    """Return the rotation vector of a step from ω and ω̇ at its ends, of fourth order."""
    c = _cross(w0, w1)
    h, q = 0.5 * step, step * step / 12.0
    return (
        h * (w0[0] + w1[0]) + q * (s0[0] - s1[0] + c[0]),
        h * (w0[1] + w1[1]) + q * (s0[1] - s1[1] + c[1]),
        h * (w0[2] + w1[2]) + q * (s0[2] - s1[2] + c[2]),
    )


@kernel
def carry(times, omega, gamma, e, v, moved):
    """Carry a direction along n orbits with m samples: ė = e × ω, orthogonal to γ.

    Store the directions in e (n, m, 3), the rotation vectors of the steps in v (n, m − 1, 3), and the sample of γ
    before each step, rotated by it, in `moved` (n, m − 1, 3).
    """
    n, m, _ = gamma.shape
    for i in range(n):
        w0 = s0 = g = (0.0, 0.0, 0.0)
        # Start from the axis of the smallest component of γ, which is farthest from γ.
        x, y, z = abs(gamma[i, 0, 0]), abs(gamma[i, 0, 1]), abs(gamma[i, 0, 2])
        there = (
            1.0 if x <= y and x <= z else 0.0,
            1.0 if y < x and y <= z else 0.0,
            1.0 if z < x and z < y else 0.0,
        )
        for k in range(m):
            w1, s1 = _row(omega[i], k), _slope(times, omega[i], k)
            if k > 0:
                turn = _turn(times[k] - times[k - 1], w0, w1, s0, s1)
                v[i, k - 1, 0], v[i, k - 1, 1], v[i, k - 1, 2] = turn
                moved[i, k - 1, 0], moved[i, k - 1, 1], moved[i, k - 1, 2] = _rotated(g, turn)
                there = _rotated(there, turn)
            w0, s0, g = w1, s1, _unit(_row(gamma[i], k))
            there = _across(there, g)
            e[i, k, 0], e[i, k, 1], e[i, k, 2] = there


@kernel
def rotate(u, v, out):
    """Store exp(−v×) u for rows of u and v (n, 3) in out (n, 3)."""
    for i in range(len(u)):
        out[i, 0], out[i, 1], out[i, 2] = _rotated(_row(u, i), _row(v, i))
