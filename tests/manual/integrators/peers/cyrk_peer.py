"""CyRK: its C++ Runge–Kutta methods, called from Numba code."""

from functools import cache

import numba
import numpy as np
from CyRK import cyjit, nbsolve2_ivp

from ..method import Method, half_decades, version
from .compiled import rates
from .states import preparing


def _ladders(work):
    return [tuple((name, tolerance) for tolerance in half_decades(3, 14)) for name in ("DOP853", "Vern8")]


@cache
def _right_hand_side(work):
    """The C function, kept: its address is good as long as it lives."""
    field = rates(work)

    @cyjit
    def right_hand_side(dy, t, y, args):
        field(y, dy)

    return right_hand_side


@numba.njit
def _solve(address, method, initial, times, tolerance, out):
    """States at the times, the first of which is 0: out[i] (n, d) for each initial[i] (d,)."""
    span = (0.0, times[-1])
    for i in range(len(initial)):
        solution = nbsolve2_ivp(address, span, initial[i], method=method, t_eval=times, rtol=tolerance, atol=tolerance)
        if solution.success:
            out[i] = solution.y.T
        else:
            out[i] = np.nan
        solution.free()


def _run(work, initial, times, setting, finish):
    method, tolerance = setting
    address, out = _right_hand_side(work).address, np.empty((len(initial), len(times), initial.shape[1]))

    def run():
        _solve(address, method, initial, times, tolerance, out)
        return finish(out)

    run()
    return run


METHOD = Method(
    "CyRK", version("CyRK"), _ladders, preparing(_run), without={"D": "its functions for Numba have no events"}
)
