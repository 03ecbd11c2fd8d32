"""A largest Lyapunov exponent by finite differences."""

import math

import numpy as np
from scipy.integrate import solve_ivp

from support.andoyer import cross


def finite_exponent(body, state, span):
    """Return the exponent by the variational equations of hh01, integrated with the motion.

    Directions and lengths are in units of the largest velocity ν = √(2 max(a)(T + 2μ|r|)) and of M = I ω.
    """
    a, m = np.array(body.a), body.mu * np.array(body.r)
    kinetic = 0.5 * np.sum(a * np.array(state[:3]) ** 2)
    unit = math.sqrt(2.0 * a.max() * (kinetic + 2.0 * body.strength)) / a.min()
    scale = np.array([unit, unit, unit, 1.0, 1.0, 1.0])
    direction = np.cos(1.0 + np.arange(6) ** 2)
    direction *= scale / np.linalg.norm(direction)

    a1, a2, a3 = body.a
    gravity = m.tolist()

    def turning(momentum):
        return a1 * momentum[0], a2 * momentum[1], a3 * momentum[2]

    def rates(_, z):
        M, gamma, dM, dgamma = z.reshape(4, 3).tolist()
        omega, domega = turning(M), turning(dM)
        return [
            *map(sum, zip(cross(M, omega), cross(gravity, gamma), strict=True)),
            *cross(gamma, omega),
            *map(sum, zip(cross(dM, omega), cross(M, domega), cross(gravity, dgamma), strict=True)),
            *map(sum, zip(cross(dgamma, omega), cross(gamma, domega), strict=True)),
        ]

    run = solve_ivp(rates, (0.0, span), np.concatenate([state, direction]), method="DOP853", rtol=1e-11, atol=1e-12)
    return math.log(np.linalg.norm(run.y[6:, -1] / scale)) / abs(span)
