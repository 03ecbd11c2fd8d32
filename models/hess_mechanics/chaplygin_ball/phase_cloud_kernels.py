# mypy: allow-untyped-defs
"""Kernel of `phase_cloud`: the motion of the ball without a field in x = (ω, ξ), y = (ω, η) and γ.

The equations are derived in `phase_cloud`; the quotient is that of `chaplygin_ball.equations`.
"""

from __future__ import annotations

from hess_mechanics.numerics.batch import one_by_one
from hess_mechanics.numerics.jit import inner, kernel
from hess_mechanics.numerics.taylor import Quadratic, orbit_integrator

__all__ = ["QUADRATIC", "integrate"]


@inner
def constants(y, p):
    """What stays the same during a step: 1/J1, 1/J2, 𝒟γ² and 1/d at its start, see `chaplygin_ball`."""
    _, _, g1, g2, g3 = y
    I11, I22, _, _, _, D = p
    added = D * (g1 * g1 + g2 * g2 + g3 * g3)
    inverse1, inverse2 = 1.0 / (I11 + added), 1.0 / (I22 + added)
    return inverse1, inverse2, added, 1.0 / (I11 * inverse1 * g1 * g1 + I22 * inverse2 * g2 * g2 + g3 * g3)


@inner
def velocities(y, q, p):
    """ω1, ω2, d, and f = F/J with F = (−ω2, ω1)."""
    x, across, _, _, _ = y
    I11, I22, _, n1, n2, _, inverse1, inverse2, _, _ = p
    g1g1, g2g2, g3g3 = q[4], q[5], q[6]
    w1 = n2 * x + n1 * across
    w2 = n2 * across - n1 * x
    return w1, w2, I11 * inverse1 * g1g1 + I22 * inverse2 * g2g2 + g3g3, -w2 * inverse1, w1 * inverse2


@inner
def quotient(y, q, p):
    """z from d z = γ1 f1 + γ2 f2."""
    return ((q[7] + q[8] - q[9]) * p[9],)


@inner
def turning(y, q, p):
    """(h, ξ) and (h, η)."""
    f1, f2 = y[8], y[9]
    n1, n2, inverse1, inverse2, added = p[3], p[4], p[6], p[7], p[8]
    h1 = f1 + added * inverse1 * q[10]
    h2 = f2 + added * inverse2 * q[11]
    return n2 * h1 - n1 * h2, n1 * h1 + n2 * h2


@inner
def rates(y, q, p):
    """The equations of the module's docstring."""
    J = p[2]
    g3w2, g3w1, g1w2, g2w1 = q[0], q[1], q[2], q[3]
    return J * q[12], J * q[13], -g3w2, g3w1, g1w2 - g2w1


QUADRATIC = Quadratic(
    "x y g1 g2 g3",
    "g3*w2 g3*w1 g1*w2 g2*w1 g1*g1 g2*g2 g3*g3 g1*f1 g2*f2 d*z g1*z g2*z y*hx y*hy",
    rates,
    parameters=6,
    stages=(("w1 w2 d f1 f2", velocities), ("z", quotient), ("hx hy", turning)),
    constants=("1/J1 1/J2 𝒟γ² 1/d", constants),
)

_ensemble = one_by_one(orbit_integrator(QUADRATIC))


@kernel
def integrate(states, p, times, order, tolerance, max_steps, out):
    """Many motions (x, y, γ), see `ensemble_integrator`; p = (I11, I22, J, I13/J, I23/J, 𝒟)."""
    return _ensemble(states, p, times, order, tolerance, max_steps, out)
