# mypy: allow-untyped-defs
"""Kernel of `reversal`: crossings of the surface (ω, γ) = 0 by a motion of the Suslov problem with gravity."""

from __future__ import annotations

from hess_mechanics.numerics.events_kernels import Surface, crossing_finder
from hess_mechanics.numerics.jit import kernel, part
from hess_mechanics.suslov.equations import SYSTEM

__all__ = ["cross"]


@part
def _along(c, normal, e, scratch):
    """The Taylor coefficients of ω1γ1 + ω2γ2."""
    for k in range(e.size):
        total = 0.0
        for m in range(k + 1):
            total += c[m, 0] * c[k - m, 2] + c[m, 1] * c[k - m, 3]
        e[k] = total


@part
def _height(y, normal):
    return y[0] * y[2] + y[1] * y[3]


@part
def _any_side(y, normal):
    return True


_cross = crossing_finder(SYSTEM.recursion, Surface(_along, _height, _any_side, curved=True))


@kernel
def cross(y, p, normal, offset, sense, end, order, tolerance, max_steps, times, states):
    """Crossings of (ω, γ) = 0 by one orbit of `Biz131`, see `crossing_finder`."""
    return _cross(y, p, normal, offset, sense, end, order, tolerance, max_steps, times, states)
