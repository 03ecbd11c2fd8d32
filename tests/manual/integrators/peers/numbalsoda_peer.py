"""numbalsoda: LSODA and DOP853 in C and Fortran, called from Numba code."""

from functools import cache

import numba
import numpy as np
from numbalsoda import dop853, lsoda, lsoda_sig

from ..method import Method, half_decades, version
from ..moebius import half_period, theta_after
from .compiled import initial_state, rates

_SOLVERS = {"lsoda": lsoda, "dop853": dop853}
_MAX_STEPS = 10_000_000


def _ladders(work):
    return [tuple((name, tolerance) for tolerance in half_decades(3, 14)) for name in _SOLVERS]


@cache
def _right_hand_side(work):
    """The C function, kept: its address is good as long as it lives."""
    field = rates(work)

    @numba.cfunc(lsoda_sig)
    def right_hand_side(t, y, dy, data):
        field(y, dy)

    return right_hand_side


@cache
def _all_orbits(solver):
    @numba.njit
    def all_orbits(address, initial, times, tolerance, out):
        for i in range(len(initial)):
            states, success = solver(address, initial[i], times, rtol=tolerance, atol=tolerance, mxstep=_MAX_STEPS)
            if success:
                out[i] = states[1]
            else:
                out[i] = np.nan

    return all_orbits


def _one(work, times, setting):
    """States (n, d) at the times, which start with 0."""
    name, tolerance = setting
    solver, address, state = _SOLVERS[str(name)], _right_hand_side(work).address, initial_state(work)

    def run():
        states, success = solver(address, state, times, rtol=tolerance, atol=tolerance, mxstep=_MAX_STEPS)
        return states if success else np.full_like(states, np.nan)

    return run


def _dense(work, setting):
    return _one(work, work.times, setting)


def _end(work, setting):
    states = _one(work, np.array([0.0, work.times[0]]), setting)
    return lambda: states()[1:]


def _ensemble(work, setting):
    name, tolerance = setting
    all_orbits, address = _all_orbits(_SOLVERS[str(name)]), _right_hand_side(work).address
    times, out = np.array([0.0, work.times[0]]), np.empty_like(work.initial)

    def run():
        all_orbits(address, work.initial, times, tolerance, out)
        return out

    return run


def _circle_map(work, setting):
    states, theta = _one(work, np.array([0.0, half_period(work)]), setting), theta_after(work.phi)
    return lambda: theta(states()[1])


_WAYS = {"A": _dense, "A2": _end, "B": _ensemble, "B2": _ensemble, "C": _circle_map}


def _prepare(work, setting, threads=1):
    run = _WAYS[work.name](work, setting)
    run()
    return run


METHOD = Method(
    "numbalsoda", version("numbalsoda"), _ladders, _prepare, without={"D": "these two solvers have no events"}
)
