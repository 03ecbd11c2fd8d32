"""SciPy: solve_ivp with a right-hand side compiled by Numba; an ensemble is one large system."""

from functools import cache

import numba
import numpy as np
from scipy.integrate import solve_ivp

from ..method import Method, version
from ..moebius import half_period, theta_after
from .compiled import dimension, initial_state, rates


def _ladders(work):
    # solve_ivp takes no relative tolerance below 2.2e-14.
    return [tuple((name, float(f"1e-{k}")) for k in range(3, 14)) for name in ("DOP853", "LSODA")]


@cache
def _right_hand_side(work):
    """f(t, y) for one state, or for many in a row."""
    field, n = rates(work), dimension(work)

    @numba.njit
    def right_hand_side(t, y):
        dy = np.empty_like(y)
        for i in range(0, y.size, n):
            field(y[i : i + n], dy[i : i + n])
        return dy

    return right_hand_side


def _solve(work, state, times, setting, **options):
    """The solution up to the last of the times, with its values at them as `y`, (d, n)."""
    name, tolerance = setting
    function = _right_hand_side(work)
    function(0.0, state)

    def run():
        return solve_ivp(function, (0.0, times[-1]), state, name, times, rtol=tolerance, atol=tolerance, **options)

    return run


def _motion(work, setting):
    solve = _solve(work, work.initial.ravel(), work.times, setting)
    # One state at many times, or many states at one time.
    return lambda: solve().y.T.reshape(-1, 5)


def _circle_map(work, setting):
    solve, theta = _solve(work, initial_state(work), np.array([half_period(work)]), setting), theta_after(work.phi)
    return lambda: theta(solve().y[:, -1])


def _crossings(work, setting):
    def height(t, y):
        return float(y[4])

    # solve_ivp's option for upward crossings only.
    setattr(height, "direction", 1.0)  # noqa: B010
    solve = _solve(work, work.initial[0], work.times, setting, events=height)
    return lambda: solve().y_events[0]


_WAYS = {
    "A": _motion,
    "A2": _motion,
    "B": _motion,
    "B2": _motion,
    "C": _circle_map,
    "D": _crossings,
}


def _prepare(work, setting, threads=1):
    return _WAYS[work.name](work, setting)


METHOD = Method("SciPy", version("scipy"), _ladders, _prepare)
