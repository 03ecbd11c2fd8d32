"""The loxodromic pendulum: its swing, clock and slope."""

from __future__ import annotations

import math

import numpy as np
from scipy.special import ellipj

from hess_explorer.scenes import scenes


def swing_at(h, t):
    """α(t) of α̇²/2 − cos α = h, α(0) = 0, in Jacobi's functions."""
    if h == 1.0:
        return 4.0 * np.arctan(np.tanh(0.5 * t))
    if h > 1.0:
        return 2.0 * ellipj(math.sqrt(0.5 * (h + 1.0)) * t, 2.0 / (h + 1.0))[3]
    k = math.sqrt(0.5 * (h + 1.0))
    return 2.0 * np.arcsin(k * ellipj(t, k * k)[0])


LOXODROME, HESS = scenes()["loxodrome"], scenes()["suslov-hess"]


def slope(values):
    """a, with the sign of I3 − I1."""
    a1, a2, a3 = (1.0 / values[name] for name in ("I1", "I2", "I3"))
    return math.copysign(math.sqrt((a3 - a2) * (a2 - a1)) / a2, a1 - a3)


def clock(values):
    """The unit of time, 1/√(μ/I2)."""
    return math.sqrt(values["I2"] / values["m"])
