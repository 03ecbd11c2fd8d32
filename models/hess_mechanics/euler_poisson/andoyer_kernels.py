# mypy: allow-untyped-defs
"""Kernels of `andoyer`: crossings of the surface g = π/2, G²γ3 − f M3 = 0 with (γ, v) > 0, and its roots G.

Not for users.
"""

from __future__ import annotations

import math

import numpy as np

from hess_mechanics.euler_poisson.equations import SYSTEM
from hess_mechanics.numerics.events_kernels import SurfaceKernels, crossing_finder
from hess_mechanics.numerics.jit import inner, kernel, part

__all__ = ["cross", "least_excess", "roots_into"]


@part
def _along(c, normal, e, scratch):
    """Store the Taylor coefficients of G²γ3 − f M3 in e; normal[0] = f."""
    for k in range(e.size):
        total = 0.0
        for m in range(k + 1):
            n = k - m
            total += c[m, 0] * c[n, 0] + c[m, 1] * c[n, 1] + c[m, 2] * c[n, 2]
        scratch[k] = total
    for k in range(e.size):
        total = -normal[0] * c[k, 2]
        for m in range(k + 1):
            total += scratch[m] * c[k - m, 5]
        e[k] = total


@part
def _height(y, normal):
    return (y[0] * y[0] + y[1] * y[1] + y[2] * y[2]) * y[5] - normal[0] * y[2]


@part
def _on_this_side(y, normal):
    """Return True at g = π/2, False at g = −π/2."""
    return y[3] * y[1] - y[4] * y[0] > 0.0


_cross = crossing_finder(SYSTEM.recursion, SurfaceKernels(_along, _height, _on_this_side, is_nonlinear=True))


@kernel
def cross(y, p, normal, offset, sense, end, order, tolerance, longest, max_steps, times, states):
    """Find the crossings of g = π/2 by one orbit of `hh01`, see `crossing_finder`; normal = (f,)."""
    return _cross(y, p, normal, offset, sense, end, order, tolerance, longest, max_steps, times, states)


@inner
def _energy(G, f, K, P, Q):
    """Return h at G on the plane g = π/2."""
    cos = f / G if f != 0.0 else 0.0
    return 0.5 * K * G * G - cos * P - math.sqrt(max(0.0, 1.0 - cos * cos)) * Q


@inner
def _largest(h, f, strength, K):
    """Return the G ≥ |f| above which the energy exceeds h, as the potential is at least −`strength`."""
    return max(abs(f), math.sqrt(max(0.0, 2.0 * (h + strength) / K)))


@inner
def _falling(top, f, share):
    """Return a value of G between `top` (share 0) and |f| (share 1), with increasing steps."""
    return max(abs(f), top + (abs(f) - top) * share * share)


@kernel
def least_excess(h, f, strength, K, P, Q, count, out):
    """Store in out the minimum of the energy on the plane minus h, over `count` values of G from the largest to |f|."""
    for i in range(K.size):
        top = _largest(h, f, strength, K[i])
        least = math.inf
        for k in range(count):
            G = _falling(top, f, k / (count - 1))
            least = min(least, _energy(G, f, K[i], P[i], Q[i]) - h)
        out[i] = least


@kernel
def roots_into(h, f, strength, K, P, Q, count, out):
    """Fill each row of out with the solutions G ≥ |f| > 0 of energy h, in decreasing order, as far as they fit.

    They are found by bisection between `count` values of G and half as many of α = arccos |f|/G.
    """
    G = np.empty(count + count // 2)
    for i in range(K.size):
        top = _largest(h, f, strength, K[i])
        for k in range(count):
            G[k] = _falling(top, f, k / (count - 1))
        # Add equal steps of α: those of G are too long near |f|, where the energy varies as the root of G − |f|.
        steepest = math.acos(min(1.0, abs(f) / top))
        for k in range(count // 2):
            cos = math.cos(steepest * (1.0 - k / (count // 2 - 1)))
            G[count + k] = min(top, max(abs(f), abs(f) / cos)) if cos > 0.0 else top
        G.sort()
        number = 0
        # If round-off produces too many roots, those of the smallest G are dropped.
        above = _energy(top, f, K[i], P[i], Q[i]) - h >= -1e-12 * (abs(h) + strength)
        for k in range(G.size - 2, -1, -1):
            before = above
            above = _energy(G[k], f, K[i], P[i], Q[i]) > h
            if above == before or number == out.shape[1]:
                continue
            low, high = G[k], G[k + 1]
            for _ in range(60):
                middle = 0.5 * (high + low)
                if (_energy(middle, f, K[i], P[i], Q[i]) > h) == before:
                    high = middle
                else:
                    low = middle
            out[i, number] = 0.5 * (high + low)
            number += 1
