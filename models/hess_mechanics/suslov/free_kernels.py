# mypy: allow-untyped-defs
"""Kernel of `free`: the rotation of γ along one passage, as a matrix of SU(2)."""

from __future__ import annotations

from hess_mechanics.numerics.jit import inner, kernel
from hess_mechanics.numerics.taylor import Quadratic, orbit_integrator

__all__ = ["QUADRATIC", "integrate"]


@inner
def rates(y, q, p):
    """The equations of the module's docstring: T = tanh u, S = sech u, V = v1 + i v2, A = a1 + i a2, B = b1 + i b2."""
    K, c = p
    SS, ST, Tv1, Tv2, Sv1, Sv2, v1b1, v2b2, v1b2, v2b1, v1a1, v2a2, v1a2, v2a1 = q
    return (
        SS,
        -ST,
        K * Tv2 - c * Sv2 - Tv1,
        c * Sv1 - K * Tv1 - Tv2,
        0.5 * (v1b2 + v2b1),
        0.5 * (v2b2 - v1b1),
        0.5 * (v1a2 - v2a1),
        -0.5 * (v1a1 + v2a2),
    )


QUADRATIC = Quadratic(
    "T S v1 v2 a1 a2 b1 b2", "S*S S*T T*v1 T*v2 S*v1 S*v2 v1*b1 v2*b2 v1*b2 v2*b1 v1*a1 v2*a2 v1*a2 v2*a1",
    rates, parameters=2,
)

_orbit = orbit_integrator(QUADRATIC)


@kernel
def integrate(y, p, u, order, tolerance, max_steps, out):
    """From u = 0 to the given u, see `orbit_integrator`."""
    return _orbit(y, p, u, order, tolerance, max_steps, out)
