# mypy: allow-untyped-defs
"""Kernels of `bifurcation`: the largest f, the roots of the gyroscopic function, and the period of n3, units b = 1.

Not for users.  The roots of p(n) = 2(h+n)(1−n²) − f² come from its expansions about its two extrema,
p(n_c+s) = p_c ∓ 2D s² − 2s³ with D = √(h²+3).  The gaps between the roots then keep their relative accuracy, however
close (h, f) is to the bifurcation curve, to the separatrix (1, 0) or to the bottom (−1, 0).
"""

from __future__ import annotations

import math

from hess_mechanics.numerics.jit import inner, kernel

__all__ = ["f_max_and_roots", "largest_f", "largest_f_into", "period_from_gaps", "roots"]


@inner
def _upper_extremum(h):
    """Return (D, h+n_c, 1−n_c) at the maximum n_c of p, without cancellation for any h ≥ −1."""
    e = h + 1.0
    D = math.sqrt(h * h + 3.0)
    return D, e * (e + D) / (e + 2.0 + D), 2.0 * e / (e + 2.0 + D)


@inner
def largest_f(h):
    """Return f_max(h) = √(2(h+n_c)(1−n_c²))."""
    _, k, d = _upper_extremum(h)
    return math.sqrt(2.0 * k * d * (2.0 - d))


@kernel
def largest_f_into(h, out):
    """Store f_max of each h[i] ≥ −1 in out[i]."""
    for i in range(h.size):
        out[i] = largest_f(h[i])


@inner
def roots(h, f):
    """Return the roots of p(n) = 2(h+n)(1−n²) − f² and their differences, without cancellation, for |f| ≤ f_max(h).

    The result is (n0, n1, n2, g10, g21, g20, w1, v1): roots n0 ≤ n1 ≤ n2; gaps g_ij = n_i − n_j;
    w1 = h + n1 (half of |w|² at the lower turning point) and v1 = 1 − n1².
    """
    D, k, d = _upper_extremum(h)
    fm = math.sqrt(2.0 * k * d * (2.0 - d))
    above = max(0.0, (fm - abs(f)) * (fm + abs(f)))
    # The minimum n_m = (−h−D)/3: p(n_m) = −below, with h+n_m and 1+n_m computed without cancellation.
    n_m = (-h - D) / 3.0
    if 2.0 * h + D > 1.0:
        h_plus = (h - 1.0) * (h + 1.0) / (2.0 * h + D)
    else:
        h_plus = (2.0 * h - D) / 3.0
    # D − h would cancel for large h.
    D_less_h = 3.0 / (D + h) if h > 0.0 else D - h
    one_plus = 2.0 * (1.0 - h) / (3.0 + D_less_h)
    below = max(0.0, f * f - 2.0 * h_plus * one_plus * (1.0 - n_m))
    # p = 0 is u³ − 3u + 2 = q; u = 2 cos α, q = 4 cos²(3α/2), 4 − q = 4 sin²(3α/2).
    alpha = 2.0 / 3.0 * math.atan2(math.sqrt(below), math.sqrt(above))
    delta = 2.0 / 3.0 * math.atan2(math.sqrt(above), math.sqrt(below))
    g = 2.0 * D / math.sqrt(3.0)
    g21 = g * math.sin(delta)
    g10 = g * math.sin(alpha)
    g20 = g * math.sin(math.pi / 3.0 + alpha)
    half = math.sin(0.5 * delta)
    s1 = -D / 3.0 * (2.0 * half * half + math.sqrt(3.0) * math.sin(delta))
    one_minus = d - s1
    n1 = 1.0 - one_minus
    n2 = n1 + g21
    w1 = k + s1
    u1 = 2.0 - one_minus
    if f == 0.0:
        w1 = max(0.0, h - 1.0)
        u1 = max(0.0, 1.0 - h)
        one_minus = min(2.0, 1.0 + h)
        n1 = -min(1.0, h)
    elif min(w1 / k, u1) < 0.1:
        # Near the pole or the circle |w| = 0 the smaller of h+n1 and 1+n1, x, has lost digits.  With v = 1−n1 and
        # the larger one, y = d+x, it solves x² + dx = f²/2v; Newton's method on p = 2xyv − f² refines it.  The
        # bifurcation curve, where p has a double root, is far away.
        lower = w1 < u1
        d, e = (1.0 - h, 1.0 + h) if lower else (h - 1.0, 2.0)
        x = f * f / one_minus
        root = math.sqrt(d * d + 2.0 * x)
        x = x / (d + root) if d > 0.0 else 0.5 * (root - d)
        for _ in range(2):
            y = d + x
            v = e - x
            x -= (2.0 * x * y * v - f * f) / (2.0 * (y * v + x * v - x * y))
        w1, u1 = (x, d + x) if lower else (d + x, x)
        one_minus = e - x
        n1 = x - h if lower else x - 1.0
    v1 = u1 * one_minus
    return n1 - g10, n1, n2, g10, g21, g20, w1, v1


@inner
def period_from_gaps(g10, g20):
    """Return the period of n3, T = 2√2/√(n2−n0) K(m), by the arithmetic–geometric mean of 1 and √(1−m)."""
    x = 1.0
    y = math.sqrt(g10 / g20)
    for _ in range(60):
        if abs(x - y) <= 1e-16 * x:
            break
        x, y = 0.5 * (x + y), math.sqrt(x * y)
    return 2.0 * math.sqrt(2.0) / math.sqrt(g20) * math.pi / (x + y)


@kernel
def f_max_and_roots(h, f):
    """Return f_max(h), `roots(h, f)` and the period of n3, ∞ on the separatrix; the last two are 0 if |f| > f_max."""
    fm = largest_f(h)
    if not abs(f) <= fm * (1.0 + 1e-15):
        return fm, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), 0.0
    numbers = roots(h, f)
    # The gap n1 − n0 is 0 only on the separatrix, where the period is infinite.
    return fm, numbers, period_from_gaps(numbers[3], numbers[5]) if numbers[3] > 0.0 else math.inf
