"""Taylor series of polynomial vector fields: steps, dense output, compensated sums.

A system is described once, by its `series(c, k, p)`: given the normalised Taylor
coefficients c[i, 0..k] of every variable it fills c[i, k+1] (and any auxiliary rows at
order k).  Everything here is generic in it and compiled together with it.

The state is expected in units in which it is O(1), so tolerances are absolute.
"""

from __future__ import annotations

import math

import numpy as np

from .jit import inner

__all__ = ["STEP_LIMIT_REACHED", "cauchy", "horner", "integrator", "step_size"]

STEP_LIMIT_REACHED = -1


@inner
def cauchy(c, i, j, k):
    """Coefficient k of the product of the series in rows i and j: Σ c[i,m] c[j,k−m]."""
    total = 0.0
    for m in range(k + 1):
        total += c[i, m] * c[j, k - m]
    return total


@inner
def step_size(c, dimension, order, tolerance):
    """The step at which the last two terms of every row fall below the tolerance (Jorba and Zou, 2005)."""
    last = 0.0
    previous = 0.0
    for i in range(dimension):
        last = max(last, abs(c[i, order]))
        previous = max(previous, abs(c[i, order - 1]))
    h = math.inf
    if last > 0.0:
        h = (tolerance / last) ** (1.0 / order)
    if previous > 0.0:
        h = min(h, (tolerance / previous) ** (1.0 / (order - 1)))
    return h


@inner
def horner(c, i, order, s):
    """Row i's polynomial at s without its constant term: Σ_{k≥1} c[i,k] s^k."""
    total = 0.0
    for k in range(order, 0, -1):
        total = (total + c[i, k]) * s
    return total


def integrator(series, rows):
    """The compiled solver of ẏ = f(y, p) for one `series` with `rows` rows (variables, then auxiliary).

    integrate(state, p, times, order, tolerance, max_steps, out): from t = 0, writes the state (d,)
    at the given times (n,), monotonic, all ≥ 0 or all ≤ 0, into `out` (n, d).  Returns the number
    of steps, or `STEP_LIMIT_REACHED`.  State and time are summed with compensation, so that
    round-off does not grow with the number of steps.
    """

    @inner
    def integrate(state, p, times, order, tolerance, max_steps, out):
        dimension = state.size
        c = np.zeros((rows, order + 1))
        y = state.copy()
        low = np.zeros(dimension)
        t = 0.0
        t_low = 0.0
        n = times.size
        direction = 1.0 if times[n - 1] >= 0.0 else -1.0
        j = 0
        steps = 0
        while True:
            for i in range(dimension):
                c[i, 0] = y[i]
            for k in range(order):
                series(c, k, p)
            h = step_size(c, dimension, order, tolerance)
            while j < n:
                s = (times[j] - t) - t_low
                if direction * s > h:
                    break
                for i in range(dimension):
                    out[j, i] = y[i] + (low[i] + horner(c, i, order, s))
                j += 1
            if j == n:
                return steps + 1
            if steps >= max_steps or not (h > 0.0):
                return STEP_LIMIT_REACHED
            for i in range(dimension):
                increment = horner(c, i, order, direction * h) + low[i]
                total = y[i] + increment
                low[i] = increment - (total - y[i])
                y[i] = total
            increment = direction * h + t_low
            total = t + increment
            t_low = increment - (total - t)
            t = total
            steps += 1

    return integrate
