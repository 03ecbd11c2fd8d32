"""The leak off the Hess manifold and the bridge, by the reduced equations written out."""

from functools import cache
from math import copysign, cos, sin, sqrt

import numpy as np
from scipy.special import ellipk

from hess_explorer.scenes import scenes
from support.mechanics import followed

HELD = "At most # up to t = # if r·M = 0 is imposed; # if not."
LEAK, BRIDGE = scenes()["hess-leak"], scenes()["bridge"]


def torus(values):
    """a, h, f in units b = 1 and the unit of frequency √b, by hand from the moments."""
    a1, a2, a3 = (1.0 / values[name] for name in ("I1", "I2", "I3"))
    # Here r1, r3 > 0: b' has the sign of a1 − a3.
    a = copysign(sqrt((a3 - a2) * (a2 - a1)), a1 - a3) / a2
    b = a2 * values["m"]
    return a, a2 * values["h"] / b, -a2 * values["f"] / sqrt(b), sqrt(b)


def period_of(h, f):
    """One period of n3 in units b = 1, from the roots of 2(h+n)(1−n²) − f²."""
    n0, n1, n2 = np.sort(np.roots([-2.0, -2.0 * h, 2.0, 2.0 * h - f * f]).real)
    return 2.0 * sqrt(2.0 / (n2 - n0)) * ellipk((n2 - n1) / (n2 - n0)), n1


def reduced(a):
    """`eq01` with b = 1, and the exponent of r·M."""

    def field(t, y):
        w1, w2, n1, n2, n3, _ = y
        return [
            -a * w2 * w2 - n2,
            a * w1 * w2 + n1,
            -(a * n2 + n3) * w2,
            a * w2 * n1 + w1 * n3,
            n1 * w2 - n2 * w1,
            -a * w1,
        ]

    return field


def motion_of_torus(a, h, f, phi, times):
    """States (n, 6) of the reduced motion and its exponent, from the lower turn at the phase φ."""
    _, lowest = period_of(h, f)
    rho = sqrt(2.0 * (h + lowest))
    w = rho * np.array([sin(phi), cos(phi)])
    return followed(reduced(a), [*w, *(f / rho**2 * w), lowest, 0.0], times)


@cache
def exact_growth(name):
    """Return the exponent that an example gains on its stable cycle from the 15th to the 16th period."""
    a, h, f, _ = torus(values_of(LEAK, name))
    period, _ = period_of(h, f)
    before, after = motion_of_torus(a, h, f, 0.5, [15.0 * period, 16.0 * period])[:, 5]
    return float(after - before)


def values_of(scene, name):
    preset = next(one for one in scene.presets if one.name == name)
    return {**scene.defaults(), **preset.values}


UNSTABLE = [preset.name for preset in LEAK.presets if preset.values.get("h", 50.0) not in (5.0, 0.3)]
STABLE = [preset.name for preset in LEAK.presets if preset.name not in UNSTABLE]
