# mypy: allow-untyped-defs
"""Kernel of `phase_cloud`: the motion of the ball without a field in x = (ω, ξ), y = (ω, η) and γ.  Not for users.

`phase_cloud` derives the equations; Î is inverted as in `chaplygin_ball.equations`.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

from hess_mechanics.chaplygin_ball.equations import inverse_times
from hess_mechanics.numerics.batch_kernels import sequential_integrator
from hess_mechanics.numerics.jit import kernel
from hess_mechanics.numerics.taylor_kernels import orbit_integrator
from hess_mechanics.numerics.tracing import trace

__all__ = ["field", "integrate"]


def field(y: Sequence[Any], p: Sequence[Any]) -> tuple[Any, ...]:
    """Return the right-hand side of `phase_cloud`; y = (x, y, γ), p = (I11, I22, J, I13/J, I23/J, 𝒟)."""
    x, across, g1, g2, g3 = y
    I11, I22, J, n1, n2, D = p
    w1, w2 = n2 * x + n1 * across, n2 * across - n1 * x
    h1, h2 = inverse_times((-w2, w1), (g1, g2, g3), I11, I22, D)
    return (
        J * across * (n2 * h1 - n1 * h2),
        J * across * (n1 * h1 + n2 * h2),
        -g3 * w2,
        g3 * w1,
        g1 * w2 - g2 * w1,
    )


_ensemble = sequential_integrator(orbit_integrator(trace(field, variables=5, parameters=6)))


@kernel
def integrate(states, p, times, order, tolerance, longest, max_steps, out, steps, ends):
    """Integrate many motions (x, y, γ), see `ensemble_integrator`; p = (I11, I22, J, I13/J, I23/J, 𝒟)."""
    _ensemble(states, p, times, order, tolerance, longest, max_steps, out, steps, ends)
