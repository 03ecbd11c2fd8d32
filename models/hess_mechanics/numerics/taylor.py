"""Taylor series of quadratic vector fields: steps, dense output, compensated sums.

Every field of the paper is linear in the variables and in some products of two of them.  It is
described by the names of those products and one function,

    rates(y, q, p) → ẏ,   linear in the variables y and the products q,

from which all kernels are made: one orbit here, many orbits in `ensemble`, crossings of a surface in
`section`.  Being linear, it holds for the Taylor coefficients of every order too, with those of the
products, q_k = Σ_m left_m right_(k−m), and gives (k+1) y_(k+1).

A field with a denominator has auxiliary series too, found at every order in stages: each is linear in the
variables, in what earlier stages found, and in products of all these.  A product holds the terms of
coefficients that are known by then.  So a quotient z = r/d is a stage as well: with d·z among the products,
d_0 z_k = r_k − (d z)_k, in which the term d_0 z_k is still missing.

The state is expected in units in which it is O(1), so tolerances are absolute.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cache
from itertools import accumulate
from typing import Any

import numpy as np

from hess_mechanics.numerics.jit import inner, part
from hess_mechanics.numerics.unrolled import compiled, evaluation

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
    stages : the auxiliary series, the names of each stage and its compiled function (y, q, p) → their values;
        `rates` and later stages find them at the end of y.  No auxiliary series is squared.
    constants : the names of what stays the same during a step and its compiled function (y, p) → their values;
        all other functions find them at the end of p.
    """

    variables: str
    products: str
    rates: Callable[..., Any]
    parameters: int
    stages: tuple[tuple[str, Callable[..., Any]], ...] = ()
    constants: tuple[str, Callable[..., Any]] | None = None

    @property
    def dimension(self) -> int:
        """The number of variables."""
        return len(self.variables.split())

    @property
    def known(self) -> list[int]:
        """How many series, variables first, are known before the first stage and after each."""
        return list(accumulate((len(names.split()) for names, _ in self.stages), initial=self.dimension))

    @property
    def pairs(self) -> list[tuple[int, int]]:
        """The indices of the two series of each product."""
        names = " ".join([self.variables, *(names for names, _ in self.stages)]).split()
        factors = (product.split("*") for product in self.products.split())
        return [(names.index(left), names.index(right)) for left, right in factors]

    @property
    def helpers(self) -> dict[str, Callable[..., Any]]:
        """The functions besides `rates`, by the names they have in generated source."""
        named = {f"stage{i}": rule for i, (_, rule) in enumerate(self.stages)}
        return {**named, "constants": self.constants[1]} if self.constants else named


@cache
def expansion(field: Quadratic) -> Callable[..., Any]:
    """The compiled recursion of one orbit.

    expand(c, left, right, inverses, parameters, rates, convolve): from the state in c[0] the Taylor coefficients
    c[1 … order, variable].  left, right : those of the factors of the products once more, side by side;
    inverses : 1/(k+1) for k = 0 … order−1.
    """
    pairs, n, known = field.pairs, field.dimension, field.known
    variables = range(n)

    def keep(order: str, y: str, since: int, count: int) -> str:
        """Of the `count` series known now, `since` of them before."""
        return "; ".join(
            f"left[{order}, {j}] = {y}[{a}]; right[{order}, {j}] = {y}[{b}]"
            for j, (a, b) in enumerate(pairs) if since <= max(a, b) < count) or "pass"

    def first_products(count: int) -> str:
        return ", ".join(f"y0[{a}] * y0[{b}]" if max(a, b) < count else "0.0" for a, b in pairs) + ","

    def products(count: int) -> str:
        def ends(a: int, b: int) -> str:
            return (f" + y0[{a}] * y[{b}]" if b < count else "") + (f" + y[{a}] * y0[{b}]" if a < count else "")

        return ", ".join(f"s[{j}]{ends(a, b)}" for j, (a, b) in enumerate(pairs)) + ","

    def stages(order: str, y: str, products: Callable[[int], str]) -> str:
        return "".join(f"""
        q = ({products(known[i])})
        {y} = {y} + stage{i}({y}, q, p)
        {keep(order, y, known[i], known[i + 1])}""" for i in range(len(field.stages)))

    return compiled(f"""
def function(c, left, right, inverses, parameters, rates, convolve):
    p = ({", ".join(f"parameters[{i}]" for i in range(field.parameters))},)
    y0 = ({", ".join(f"c[0, {i}]" for i in variables)},)
    {"p = p + constants(y0, p)" if field.constants else "pass"}
    {keep("0", "y0", 0, n)}
    if True:{stages("0", "y0", first_products) or " pass"}
    y = rates(y0, ({first_products(known[-1])}), p)
    {"; ".join(f"c[1, {i}] = y[{i}]" for i in variables)}
    for k in range(1, inverses.size):
        {keep("k", "y", 0, n)}
        s = convolve(left, right, k){stages("k", "y", products)}
        q = ({products(known[-1])})
        y = rates(y, q, p)
        y = ({", ".join(f"y[{i}] * inverses[k]" for i in variables)},)
        {"; ".join(f"c[k + 1, {i}] = y[{i}]" for i in variables)}
""", **field.helpers)


@cache
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


@part
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

    @part
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
