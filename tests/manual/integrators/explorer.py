"""The method of this project: Taylor series of chosen order and tolerance, one run of each kernel."""

import math

import numpy as np

from hess_mechanics import systems

from .method import OURS, Method, half_decades, version

_ORDERS = (8, 10, 12, 14, 16, 18, 20, 22, 24)
_MAX_STEPS = 1_000_000
_MAX_CROSSINGS = 1000
_LONGEST = math.inf
"""The field of the works is a polynomial, whose steps need no limit."""


def _ladders(work):
    return [tuple((order, tolerance) for tolerance in half_decades(2, 17)) for order in _ORDERS]


def _orbit(work, order, tolerance):
    """A, A2."""
    integrate = systems()["suslov"].orbit
    start, p, out = work.initial[0], np.array(work.parameters), np.empty((work.times.size, 5))

    def run():
        if integrate(start, p, work.times, order, tolerance, _LONGEST, _MAX_STEPS, out)[0] < 0:
            out.fill(np.nan)
        return out

    return run


def _ensemble(work, order, tolerance):
    """B2."""
    integrate = systems()["suslov"].ensemble
    p, out = np.array(work.parameters), np.empty((len(work.initial), 1, 5))
    steps, ends = np.empty(len(out), np.int64), np.empty(len(out))

    def run():
        integrate(work.initial, p, work.times, order, tolerance, _LONGEST, _MAX_STEPS, out, steps, ends)
        out[steps < 0] = np.nan
        return out[:, 0]

    return run


def _crossings(work, order, tolerance):
    """D."""
    cross = systems()["suslov"].cross
    p, normal, end = np.array(work.parameters), np.array([0.0, 0.0, 0.0, 0.0, 1.0]), float(work.times[0])
    times, states = np.empty(_MAX_CROSSINGS), np.empty((_MAX_CROSSINGS, 5))

    def run():
        found, _ = cross(work.initial[0], p, normal, 0.0, 1, end, order, tolerance, _LONGEST, _MAX_STEPS, times, states)
        return states[: max(found, 0)]

    return run


_WAYS = {
    "A": _orbit,
    "A2": _orbit,
    "B2": _ensemble,
    "D": _crossings,
}


def _prepare(work, setting):
    order, tolerance = setting
    run = _WAYS[work.name](work, order, tolerance)
    run()
    return run


METHOD = Method(OURS, version("hess-explorer"), _ladders, _prepare)
