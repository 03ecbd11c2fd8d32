"""The Suslov problem with e on a principal axis, I13 = I23 = 0, in conformally Hamiltonian form (`Biz135`, `Biz133`).

The field is γ3 P ∇E with a Poisson structure P: Hamiltonian in the time τ, dτ = γ3 dt.  It
keeps the standard measure (its divergence is 0), in τ the measure γ3 dω dγ.  The case b3 = 0 is `kharlamova`, the
case b1 = b2 = 0 is `quartic`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

__all__ = ["divergence", "energy_gradient", "poisson_matrix"]


def poisson_matrix(y: Sequence[Any], p: Sequence[Any]) -> tuple[tuple[Any, ...], ...]:
    """{x_i, x_j} (`Biz133`) of x = (ω1, ω2, γ1, γ2, γ3); singular on the equator γ3 = 0, of rank 4 elsewhere."""
    _, _, g1, g2, g3 = y
    I11, I22 = p[0], p[1]
    one = (0, 0, 0, -1 / I11, g2 / (I11 * g3))
    two = (0, 0, 1 / I22, 0, -g1 / (I22 * g3))
    return one, two, (0, -two[2], 0, 0, 0), (-one[3], 0, 0, 0, 0), (-one[4], -two[4], 0, 0, 0)


def energy_gradient(y: Sequence[Any], p: Sequence[Any]) -> tuple[Any, ...]:
    """∇E, E the energy (`Biz11`)."""
    return (p[0] * y[0], p[1] * y[1], p[4], p[5], p[6])


def divergence(y: Sequence[Any], p: Sequence[Any]) -> Any:
    """Σ ∂ẏ_i/∂y_i of the general field (`Biz131`): 0 everywhere only for I13 = I23 = 0."""
    I11, I22, I13, I23 = p[:4]
    return I23 * y[0] / I22 - I13 * y[1] / I11
