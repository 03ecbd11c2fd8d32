"""The loxodromic pendulum: its swing, clock and slope."""

from math import copysign, sqrt, tan

import numpy as np
from scipy.special import ellipj

from hess_explorer.scenes import scenes


def swing_at(h, t):
    """α(t) of α̇²/2 − cos α = h, α(0) = 0, in Jacobi's functions."""
    if h == 1.0:
        return 4.0 * np.arctan(np.tanh(0.5 * t))
    if h > 1.0:
        return 2.0 * ellipj(sqrt(0.5 * (h + 1.0)) * t, 2.0 / (h + 1.0))[3]
    k = sqrt(0.5 * (h + 1.0))
    return 2.0 * np.arcsin(k * ellipj(t, k * k)[0])


def closed_form(one, tau):
    """Centre of mass and middle axis in space, along (γ, e, γ × e), at the times τ in units b = 1."""
    a1, a2, a3 = one.body.a
    a = (1 if a1 > a3 else -1) * sqrt((a3 - a2) * (a2 - a1)) / a2
    alpha = swing_at(one.h, tau)
    l = 2.0 * np.arctan(tan(0.5 * one.l) * np.exp(a * alpha))
    centre = np.stack([np.cos(alpha), 0.0 * alpha, -np.sin(alpha)], axis=1)
    return centre, np.stack([np.sin(l) * np.sin(alpha), np.cos(l), np.sin(l) * np.cos(alpha)], axis=1)


LOXODROME = scenes()["loxodrome"]


def slope(values):
    """a, with the sign of I3 − I1."""
    a1, a2, a3 = (1.0 / values[name] for name in ("I1", "I2", "I3"))
    return copysign(sqrt((a3 - a2) * (a2 - a1)) / a2, a1 - a3)
