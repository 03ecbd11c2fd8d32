# mypy: allow-untyped-defs
"""Kernel of `andoyer`: crossings of the surface g = π/2, G²γ3 − f M3 = 0 with (γ, v) > 0."""

from __future__ import annotations

from hess_mechanics.euler_poisson.equations import SYSTEM
from hess_mechanics.numerics.events_kernels import Surface, crossing_finder
from hess_mechanics.numerics.jit import kernel, part

__all__ = ["cross"]


@part
def _along(c, normal, e, scratch):
    """The Taylor coefficients of G²γ3 − f M3; normal[0] = f."""
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
    """g = π/2 and not −π/2."""
    return y[3] * y[1] - y[4] * y[0] > 0.0


_cross = crossing_finder(SYSTEM.recursion, Surface(_along, _height, _on_this_side, curved=True))


@kernel
def cross(y, p, normal, offset, sense, end, order, tolerance, max_steps, times, states):
    """Crossings of g = π/2 by one orbit of `hh01`, see `crossing_finder`; normal = (f,)."""
    return _cross(y, p, normal, offset, sense, end, order, tolerance, max_steps, times, states)
