"""SciPy: solve_ivp with a right-hand side compiled by Numba; an ensemble is one large system."""

from functools import cache

import numba
import numpy as np
from scipy.integrate import solve_ivp

from hess_mechanics import systems

from .method import Method, version


def _ladders(work):
    # solve_ivp takes no relative tolerance below 2.2e-14.
    return [tuple((name, float(f"1e-{k}")) for k in range(3, 14)) for name in ("DOP853", "LSODA")]


@cache
def _right_hand_side(work):
    """Return f(t, y) for one state, or for many in a row."""
    rates, p = numba.njit(error_model="numpy", fastmath={"contract"})(systems()["suslov"].field), work.parameters

    @numba.njit
    def right_hand_side(t, y):
        dy = np.empty_like(y)
        for i in range(0, y.size, 5):
            found = rates((y[i], y[i + 1], y[i + 2], y[i + 3], y[i + 4]), p)
            for j in range(5):
                dy[i + j] = found[j]
        return dy

    return right_hand_side


def _solver(work, setting, **options):
    (name, tolerance), function, state = setting, _right_hand_side(work), work.initial.ravel()
    function(0.0, state)
    return lambda: solve_ivp(
        function, (0.0, work.times[-1]), state, name, work.times, rtol=tolerance, atol=tolerance, **options
    )


def _motion(work, setting):
    solve = _solver(work, setting)
    # One state at many times, or many states at one time.
    return lambda: solve().y.T.reshape(-1, 5)


def _crossings(work, setting):
    def height(t, y):
        return float(y[4])

    # solve_ivp's option for upward crossings only.
    height.direction = 1.0
    solve = _solver(work, setting, events=height)
    return lambda: solve().y_events[0]


def _prepare(work, setting):
    return (_crossings if work.name == "D" else _motion)(work, setting)


METHOD = Method("SciPy", version("scipy"), _ladders, _prepare)
