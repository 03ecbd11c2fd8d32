"""The Suslov problem with gravity, written out."""

from math import atan2, cos, pi, sin, sqrt

import numpy as np
from scipy.optimize import brentq

from hess_mechanics import SuslovBody

HESS_BODY = SuslovBody(0.96 + 0.28**2 / 0.96, 0.96, 0.0, 0.28, 0.0, 0.28 / 0.96, -1.0)
"""A body in the Hess case: I11 I22 = I22² + I23², b2 = I23/I22."""


def field(body, y):
    """`Biz131`, with gravity."""
    w1, w2, g1, g2, g3 = y
    s = body.I13 * w1 + body.I23 * w2
    return np.array(
        [
            (-w2 * s + body.b3 * g2 - body.b2 * g3) / body.I11,
            (w1 * s + body.b1 * g3 - body.b3 * g1) / body.I22,
            -g3 * w2,
            g3 * w1,
            g1 * w2 - g2 * w1,
        ]
    )


def divergence(body, y):
    """Return the divergence of that field at states (5,) or (5, n): central differences of quadratics are exact."""
    y = np.asarray(y)
    steps = np.eye(5).reshape(5, 5, *(1 for _ in y.shape[1:]))
    return sum(field(body, y + e)[i] - field(body, y - e)[i] for i, e in enumerate(steps)) / 2.0


def energy(body, y):
    """`Biz11`."""
    w1, w2, *gamma = y
    return 0.5 * (body.I11 * w1**2 + body.I22 * w2**2) + np.dot((body.b1, body.b2, body.b3), gamma)


def permanent_rotations(body, E):
    """States γ3 = 0, ω = wγ with w²(I13γ1 + I23γ2) = b3 and energy E: the body turns for ever about the vertical."""

    def excess(psi):
        g1, g2 = cos(psi), sin(psi)
        squared = body.b3 / (body.I13 * g1 + body.I23 * g2)
        return energy(body, (sqrt(squared) * g1, sqrt(squared) * g2, g1, g2, 0.0)) - E

    # I13γ1 + I23γ2 has the sign of b3 within 90° of its maximum.
    middle = atan2(body.I23, body.I13) + (0.0 if body.b3 > 0.0 else pi)
    psi = np.linspace(middle - 1.56, middle + 1.56, 2001)
    values = np.array([excess(x) for x in psi])
    roots = [brentq(excess, *psi[i : i + 2], xtol=1e-14) for i in np.flatnonzero(values[1:] * values[:-1] < 0.0)]
    for x in roots:
        g = np.array([cos(x), sin(x), 0.0])
        for w in (1.0, -1.0):
            yield np.array([*(w * sqrt(body.b3 / (body.I13 * g[0] + body.I23 * g[1])) * g[:2]), *g])
