# mypy: allow-untyped-defs
"""Kernel of `free`: the rotation of γ along one passage, as a matrix of SU(2).  Not for users."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hess_mechanics.numerics.jit import kernel
from hess_mechanics.numerics.taylor_kernels import orbit_integrator
from hess_mechanics.numerics.tracing import trace

__all__ = ["field", "integrate"]


def field(y: Sequence[Any], p: Sequence[Any]) -> tuple[Any, ...]:
    """Return the right-hand side of the equations of `free` in u: V = v1 + i v2, A = a1 + i a2, B = b1 + i b2.

    Parameters
    ----------
    y : sequence, shape (8,)
        T = tanh u, S = sech u, v1, v2, a1, a2, b1, b2.
    p : sequence, shape (2,)
        K and σc.

    Returns
    -------
    tuple of length 8
        Derivatives with respect to u.
    """
    T, S, v1, v2, a1, a2, b1, b2 = y
    K, c = p
    return (
        S**2,
        -S * T,
        K * T * v2 - c * S * v2 - T * v1,
        c * S * v1 - K * T * v1 - T * v2,
        (v1 * b2 + v2 * b1) / 2,
        (v2 * b2 - v1 * b1) / 2,
        (v1 * a2 - v2 * a1) / 2,
        -(v1 * a1 + v2 * a2) / 2,
    )


_orbit = orbit_integrator(trace(field, variables=8, parameters=2))


@kernel
def integrate(y, p, u, order, tolerance, longest, max_steps, out):
    """Integrate from u = 0 to the given u; the arguments are those of `orbit_integrator`."""
    return _orbit(y, p, u, order, tolerance, longest, max_steps, out)
