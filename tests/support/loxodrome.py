"""The loxodromic pendulum: its swing, clock and slope."""

from math import sqrt

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


LOXODROME, HESS = scenes()["loxodrome"], scenes()["suslov-hess"]
