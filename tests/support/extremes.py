"""Errors at extreme parameters, and the bounds that the levels promise."""

import numpy as np

import oracle
from hess_mechanics import HeavyBody
from hess_mechanics.euler_poisson.andoyer import hess_curve
from support.andoyer import GESS1
from support.mechanics import PROMISE

UPRIGHT = HeavyBody((1.0, 1.6, 2.1), (0.0, 0.0, 1.0), 0.7)
BARRIER = float(hess_curve(GESS1, np.array([0.7]))[0])


def assert_promised(error, floor=0.0, admitted=lambda name: False):
    """Assert that error(level), the distance from an independent result, is within the promise of each level.

    floor : replaces a smaller promise where the last place of a double matters that much; say why beside it.
    admitted : admitted(level) tells whether the result itself reports the error.
    """
    errors = {name: error(name) for name in PROMISE}
    assert not {name: e for name, e in errors.items() if not (e <= max(PROMISE[name], floor) or admitted(name))}


def off(found, exact, unit=None):
    """Return the largest distance of states (n, d); velocities in a unit, by default the fastest of the motion."""
    apart = oracle.distances(found, exact)
    unit = unit or np.max(np.abs(exact[:, :-3].astype(float)), initial=1e-300)
    return float(max(np.max(apart[:, :-3]) / unit, np.max(apart[:, -3:])))
