"""Taylor series of quadratic vector fields: steps, dense output, compensated sums.

Every field of the paper is linear in the variables and in some products of two of them.  It is
described by the names of those products and one function,

    rates(y, q, p) → ẏ,   linear in the variables y and the products q,

from which all kernels are made: one orbit here, many orbits in `ensemble`, crossings of a surface in
`section`.  Being linear, it holds for the Taylor coefficients of every order too, with those of the
products, q_k = Σ_m left_m right_(k−m), and gives (k+1) y_(k+1).

The state is expected in units in which it is O(1), so tolerances are absolute.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from .jit import inner
from .unrolled import compiled, evaluation

__all__ = [
    "STEP_LIMIT_REACHED", "Quadratic", "columns_of", "compensated", "convolution", "expansion", "orbit_integrator",
    "step_of", "step_size", "workspace",
]

STEP_LIMIT_REACHED = -1


@dataclass(frozen=True)
class Quadratic:
    """A quadratic field.

    variables : their names, "w1 w2 …"; products : those that occur, "w1*w1 w1*w2 …";
    rates : the compiled function of the module's docstring; parameters : how many p has.
    """

    variables: str
    products: str
    rates: Callable[..., Any]
    parameters: int

    @property
    def dimension(self) -> int:
        """The number of variables."""
        return len(self.variables.split())

    @property
    def pairs(self) -> list[tuple[int, int]]:
        """The indices of the two variables of each product."""
        names = self.variables.split()
        factors = (product.split("*") for product in self.products.split())
        return [(names.index(left), names.index(right)) for left, right in factors]


def expansion(field: Quadratic) -> Callable[..., Any]:
    """The compiled recursion of one orbit.

    expand(c, left, right, inverses, parameters, rates, convolve): from the state in c[0] the Taylor coefficients
    c[1 … order, variable].  left, right : those of the factors of the products once more, side by side;
    inverses : 1/(k+1) for k = 0 … order−1.
    """
    pairs, n = field.pairs, field.dimension
    variables = range(n)

    def keep(order: str, y: str) -> str:
        return "; ".join(
            f"left[{order}, {j}] = {y}[{a}]; right[{order}, {j}] = {y}[{b}]" for j, (a, b) in enumerate(pairs))

    return compiled(f"""
def function(c, left, right, inverses, parameters, rates, convolve):
    p = ({", ".join(f"parameters[{i}]" for i in range(field.parameters))},)
    y0 = ({", ".join(f"c[0, {i}]" for i in variables)},)
    {keep("0", "y0")}
    y = rates(y0, ({", ".join(f"y0[{a}] * y0[{b}]" for a, b in pairs)},), p)
    {"; ".join(f"c[1, {i}] = y[{i}]" for i in variables)}
    for k in range(1, inverses.size):
        {keep("k", "y")}
        s = convolve(left, right, k)
        q = ({", ".join(f"s[{j}] + y0[{a}] * y[{b}] + y[{a}] * y0[{b}]" for j, (a, b) in enumerate(pairs))},)
        y = rates(y, q, p)
        y = ({", ".join(f"y[{i}] * inverses[k]" for i in variables)},)
        {"; ".join(f"c[k + 1, {i}] = y[{i}]" for i in variables)}
""")


def convolution(field: Quadratic) -> Callable[..., Any]:
    """convolve(left, right, k): Σ_{0<m<k} left[m, j] right[k−m, j] for each product j, as a tuple.

    From the middle outwards: the orders computed last, for which the processor still waits, come last.
    The two ends are left to the caller, who has them in registers.
    """
    columns = range(columns_of(field))
    return compiled(f"""
def function(left, right, k):
    m = k // 2
    if 2 * m == k:
        {"; ".join(f"s{j} = left[m, {j}] * right[m, {j}]" for j in columns)}
    else:
        {" = ".join(f"s{j}" for j in columns)} = 0.0
    {" = ".join(f"t{j}" for j in columns)} = 0.0
    for m in range((k - 1) // 2, 0, -1):
        n = k - m
        {"; ".join(f"s{j} += left[m, {j}] * right[n, {j}]; t{j} += left[n, {j}] * right[m, {j}]" for j in columns)}
    return ({", ".join(f"s{j} + t{j}" for j in columns)},)
""")


def columns_of(field: Quadratic) -> int:
    """The products in whole vectors of four numbers: what is too many stays 0."""
    m = len(field.pairs)
    return m + -m % 4


@inner
def workspace(order, n, columns):
    """c, left, right, inverses for `expansion`, with n variables."""
    rows = order + 1
    inverses = 1.0 / (1.0 + np.arange(order))
    return np.zeros((rows, n + -n % 4)), np.zeros((rows, columns)), np.zeros((rows, columns)), inverses


@inner
def step_size(last, previous, order, tolerance):
    """The step at which the terms of the two highest orders fall below the tolerance (Jorba and Zou, 2005).

    `last`, `previous`: the largest coefficient of order N and N−1.
    """
    return np.exp2(min(math.log2(tolerance / last) / order, math.log2(tolerance / previous) / (order - 1.0)))


@inner
def step_of(c, n, tolerance):
    """`step_size` from the coefficients of one orbit with n variables."""
    order = c.shape[0] - 1
    last = 0.0
    previous = 0.0
    for i in range(n):
        last = max(last, abs(c[order, i]))
        previous = max(previous, abs(c[order - 1, i]))
    return step_size(last, previous, order, tolerance)


@inner
def compensated(total, low, increment):
    """total + low + increment as a sum and what the sum cannot hold."""
    increment += low
    new = total + increment
    return new, increment - (new - total)


def orbit_integrator(field: Quadratic) -> Callable[..., Any]:
    """The compiled solver of ẏ = f(y, p) for one orbit with dense output.

    integrate(state, parameters, times, order, tolerance, max_steps, out): from t = 0, writes the state (d,)
    at the given times (n,), monotonic, all ≥ 0 or all ≤ 0, into `out` (n, d).  Returns the number
    of steps, or `STEP_LIMIT_REACHED`.  State and time are summed with compensation, so that
    round-off does not grow with the number of steps.
    """
    n, columns, rates = field.dimension, columns_of(field), field.rates
    expand, convolve = expansion(field), convolution(field)
    evaluate = evaluation(n)

    @inner
    def integrate(state, parameters, times, order, tolerance, max_steps, out):
        c, left, right, inverses = workspace(order, n, columns)
        y = state.copy()
        low = np.zeros(n)
        increments = np.zeros(n)
        t = 0.0
        t_low = 0.0
        count = times.size
        direction = 1.0 if times[count - 1] >= 0.0 else -1.0
        j = 0
        steps = 0
        while True:
            for i in range(n):
                c[0, i] = y[i]
            expand(c, left, right, inverses, parameters, rates, convolve)
            h = step_of(c, n, tolerance)
            while j < count:
                s = (times[j] - t) - t_low
                if direction * s > h:
                    break
                evaluate(c, s, increments)
                for i in range(n):
                    out[j, i] = y[i] + (low[i] + increments[i])
                j += 1
            if j == count:
                return steps + 1
            if steps >= max_steps or not (h > 0.0):
                return STEP_LIMIT_REACHED
            evaluate(c, direction * h, increments)
            for i in range(n):
                y[i], low[i] = compensated(y[i], low[i], increments[i])
            t, t_low = compensated(t, t_low, direction * h)
            steps += 1

    return integrate
