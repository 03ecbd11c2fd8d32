# mypy: allow-untyped-defs
"""Kernel of `reversal`: the surface (ω, γ) = 0 of systems with the variables (ω1, ω2, γ1, γ2, γ3).  Not for users."""

from __future__ import annotations

from hess_mechanics.numerics.events_kernels import SurfaceKernels
from hess_mechanics.numerics.jit import part

__all__ = ["NO_TURN"]


@part
def _along(c, normal, e, scratch):
    """Store the Taylor coefficients of ω1γ1 + ω2γ2 in e."""
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


NO_TURN = SurfaceKernels(_along, _height, _any_side, is_nonlinear=True)
"""The surface (ω, γ) = 0."""
