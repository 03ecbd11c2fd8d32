"""A largest Lyapunov exponent by finite differences."""

import math

import numpy as np

from support.mechanics import scipy_states

_STEP = 1e-7


def finite_exponent(body, state, span):
    """Return the exponent from central differences of motions of hh01 by SciPy.

    Directions and lengths are in units of the largest velocity ν = √(2 max(a)(T + 2μ|r|)) and of M = I ω.
    """
    a = np.array(body.a)
    kinetic = 0.5 * np.sum(a * np.array(state[:3]) ** 2)
    unit = math.sqrt(2.0 * a.max() * (kinetic + 2.0 * body.strength)) / a.min()
    scale = np.array([unit, unit, unit, 1.0, 1.0, 1.0])
    direction = np.cos(1.0 + np.arange(6) ** 2)
    direction *= scale / np.linalg.norm(direction)
    ahead, behind = (
        scipy_states(body.system, state + step * direction, body.parameters, [span])[0] for step in (_STEP, -_STEP)
    )
    return math.log(np.linalg.norm((ahead - behind) / scale) / (2.0 * _STEP)) / abs(span)
