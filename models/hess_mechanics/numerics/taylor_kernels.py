# mypy: allow-untyped-defs
"""Taylor series of traced fields: steps, dense output, compensated sums.  Not for users.

All kernels are generated from the `Recursion` of a field (see `tracing`): one orbit here, many orbits in
`batch_kernels`, crossings of a surface in `events_kernels`.

The state must be in units in which it is O(1); tolerances are absolute.
"""

from __future__ import annotations

from collections.abc import Callable
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
from numba import float64, int64

from hess_mechanics.numerics.jit import inner, part
from hess_mechanics.numerics.recursions import Recursion
from hess_mechanics.numerics.step_kernels import parts, step_check, step_condition, step_of
from hess_mechanics.numerics.tracing import trace
from hess_mechanics.numerics.unrolled import compile_source, evaluation, items

__all__ = [
    "PATIENCE",
    "STALLED",
    "STEP_LIMIT_REACHED",
    "STOPPED",
    "columns_of",
    "compensated_sum",
    "compile_shared",
    "convolution",
    "convolution_source",
    "expansion",
    "expansion_source",
    "orbit_integrator",
    "workspace",
]

STEP_LIMIT_REACHED = -1
STOPPED = -2
"""The field has no finite rates at this point, or the motion ends there."""
PATIENCE, STALLED = 4096, 1e-10
"""A motion ends if in so many steps its time grows by less than this share: it has reached a pole."""


@cache
def expansion(recursion: Recursion) -> Callable[..., Any]:
    """Return the compiled recursion of one orbit.

    expand(c, left, right, inverses, parameters, seen) computes the Taylor coefficients c[1 … order, variable] from the
    state in c[0].  left, right : copies of the coefficients of the factors of the products, one column per product;
    inverses : 1/(k+1) for k = 0 … order−1.  seen[0 … order−1, i] receives the series that the field returns after its
    rates, then those that are watched.
    """
    convolve = convolution(columns_of(recursion))
    return compile_source(expansion_source(recursion), **parts(recursion), convolve=convolve)["expand"]


def expansion_source(recursion: Recursion) -> str:
    """Return the Python source of `expand`, which calls the functions of `recursion.source` and `convolve`.

    Every coefficient has a name, z0, z1, … at order 0 and y0, y1, … at order k: Numba takes longer for items of tuples.
    """
    pairs, known = recursion.pairs, recursion.stage_starts
    variables, moving = range(recursion.variables), range(recursion.dimension)
    observed = range(recursion.outputs)

    def names(letter: str, end: int, start: int = 0) -> str:
        return "".join(f"{letter}{i}, " for i in range(start, end))

    def all_of(letter: str, count: int) -> str:
        return items(f"{letter}{i}" for i in range(count))

    def keep(order: str, letter: str, since: int, count: int) -> str:
        """Store the factors that became known: `count` series are known now, `since` were known before."""
        return (
            "; ".join(
                f"left[{order}, {j}] = {letter}{a}; right[{order}, {j}] = {letter}{b}"
                for j, (a, b) in enumerate(pairs)
                if since <= max(a, b) < count
            )
            or "pass"
        )

    def first_products(stage: int) -> str:
        return items(
            f"z{a} * z{b}" if j in recursion.read[stage] and max(a, b) < known[stage] else "0.0"
            for j, (a, b) in enumerate(pairs)
        )

    def products(stage: int) -> str:
        """Return the products that a stage reads, without terms that it makes known."""

        def ends(a: int, b: int) -> str:
            return (f" + z{a} * y{b}" if b < known[stage] else "") + (f" + y{a} * z{b}" if a < known[stage] else "")

        return items(f"s{j}{ends(a, b)}" if j in recursion.read[stage] else "0.0" for j, (a, b) in enumerate(pairs))

    def stages(order: str, letter: str, one: str, products: Callable[[int], str]) -> str:
        return "".join(
            f"""
        {names(letter, end, start)}= stage{i}(({all_of(letter, start)}), ({products(i)}), p, {one})
        {keep(order, letter, start, end)}"""
            for i, (start, end) in enumerate(pairwise(known))
        )

    def rates(letter: str, one: str, products: Callable[[int], str]) -> str:
        targets = names("rate", recursion.dimension + len(observed))
        return f"{targets}= rates(({all_of(letter, known[-1])}), ({products(len(recursion.stages))}), p, {one})"

    def seen(order: str) -> str:
        return "; ".join(f"seen[{order}, {i}] = rate{recursion.dimension + i}" for i in observed) or "pass"

    start = all_of("z", recursion.variables)
    return f"""
def expand(c, left, right, inverses, parameters, seen):
    p = ({items(f"parameters[{i}]" for i in range(recursion.parameters))})
    {"; ".join(f"z{i} = c[0, {i}]" for i in variables)}
    {f"{names('z', len(moving), len(variables))}= started(({start}), p)" if recursion.functions else "pass"}
    {f"p = p + constants(({all_of('z', len(moving))}), p)" if recursion.constants else "pass"}
    {keep("0", "z", 0, recursion.dimension)}
    if True:{stages("0", "z", "1.0", first_products) or " pass"}
    {rates("z", "1.0", first_products)}
    {"; ".join(f"c[1, {i}] = rate{i}" for i in variables)}
    {seen("0")}
    {"; ".join(f"y{i} = rate{i}" for i in moving)}
    for k in range(1, inverses.size):
        {keep("k", "y", 0, recursion.dimension)}
        {names("s", columns_of(recursion))}= convolve(left, right, k){stages("k", "y", "0.0", products)}
        {rates("y", "0.0", products)}
        {seen("k")}
        {"; ".join(f"y{i} = rate{i} * inverses[k]" for i in moving)}
        {"; ".join(f"c[k + 1, {i}] = y{i}" for i in variables)}
"""


@cache
def convolution(columns: int) -> Callable[..., Any]:
    """Return the compiled `convolve` of `convolution_source`."""
    return compile_source(convolution_source(columns))["convolve"]


def convolution_source(columns: int) -> str:
    """Return the source of convolve(left, right, k): Σ_{0<m<k} left[m, j] right[k−m, j] for each column j, as a tuple.

    The sum runs from the middle outwards, because the processor still waits for the orders computed last.
    The caller adds the two ends, which it has in registers.
    """
    each = range(columns)
    return f"""
def convolve(left, right, k):
    m = k // 2
    if 2 * m == k:
        {"; ".join(f"s{j} = left[m, {j}] * right[m, {j}]" for j in each)}
    else:
        {" = ".join(f"s{j}" for j in each)} = 0.0
    {" = ".join(f"t{j}" for j in each)} = 0.0
    for m in range((k - 1) // 2, 0, -1):
        n = k - m
        {"; ".join(f"s{j} += left[m, {j}] * right[n, {j}]; t{j} += left[n, {j}] * right[m, {j}]" for j in each)}
    return ({items(f"s{j} + t{j}" for j in each)})
"""


def columns_of(recursion: Recursion) -> int:
    """Return the number of products, padded to a multiple of four (at least four); the padding stays 0."""
    m = len(recursion.pairs)
    return max(4, m + -m % 4)


@part
def workspace(order, n, columns):
    """Return the arrays c, left, right, inverses for `expansion` with n variables."""
    rows = order + 1
    inverses = 1.0 / (1.0 + np.arange(order))
    return np.zeros((rows, n + -n % 4)), np.zeros((rows, columns)), np.zeros((rows, columns)), inverses


@inner
def compensated_sum(total, low, increment):
    """Return total + low + increment as a rounded sum and its round-off."""
    increment += low
    new = total + increment
    return new, increment - (new - total)


def orbit_integrator(recursion: Recursion) -> Callable[..., Any]:
    """Return the compiled solver of ẏ = f(y, p) for one orbit with dense output.

    integrate(state, parameters, times, order, tolerance, longest, max_steps, out): from t = 0, writes the state (d,)
    at the given times (n,), monotonic, all ≥ 0 or all ≤ 0, into `out` (n, d), by steps of at most `longest`.  Returns
    the number of steps and the time reached.  If this is not the last one, the number is `STEP_LIMIT_REACHED` or
    `STOPPED`, and the row of the next time holds the last state.  State and time are summed with compensation, so that
    round-off does not grow with the number of steps.
    """
    n, columns = recursion.variables, columns_of(recursion)
    expand, evaluate, check = expansion(recursion), evaluation(n), step_check(recursion)
    suspects, watched = step_condition(recursion), recursion.outputs

    @part
    def integrate(state, parameters, times, order, tolerance, longest, max_steps, out):
        c, left, right, inverses = workspace(order, n, columns)
        seen = np.zeros((order, watched))
        y = state.copy()
        low = np.zeros(n)
        increments = np.zeros(n)
        t = 0.0
        t_low = 0.0
        before = 0.0
        mark = 0.0
        count = times.size
        direction = 1.0 if times[count - 1] >= 0.0 else -1.0
        j = 0
        steps = 0
        while True:
            for i in range(n):
                c[0, i] = y[i]
            expand(c, left, right, inverses, parameters, seen)
            most = min(longest, direction * ((times[count - 1] - t) - t_low))
            h = min(step_of(c, n, tolerance), most)
            if suspects(seen, h, before):
                h = check(c, seen, h, most, direction, parameters, tolerance)
            while j < count:
                s = (times[j] - t) - t_low
                if direction * s > h:
                    break
                evaluate(c, s, increments)
                for i in range(n):
                    out[j, i] = y[i] + (low[i] + increments[i])
                j += 1
            if j == count:
                return steps + 1, times[count - 1]
            if steps % PATIENCE == 0:
                mark = t
            ends = not (h > 0.0) or (steps % PATIENCE == PATIENCE - 1 and abs(t - mark) <= STALLED * abs(t))
            if steps >= max_steps or ends:
                for i in range(n):
                    out[j, i] = y[i]
                return STOPPED if ends else STEP_LIMIT_REACHED, t
            evaluate(c, direction * h, increments)
            for i in range(n):
                y[i], low[i] = compensated_sum(y[i], low[i], increments[i])
            t, t_low = compensated_sum(t, t_low, direction * h)
            before = h
            steps += 1

    return integrate


def compile_shared() -> None:
    """Compile the functions that kernels of orbits share, before a new system needs them."""
    vector: Any = float64[::1]
    table: Any = float64[:, ::1]
    smallest: Any = orbit_integrator(trace(lambda y, p: (y[0],), 1, 0))
    smallest.compile((vector, vector, vector, int64, float64, float64, int64, table))
    for columns in (12, 16, 20, 24):
        convolve: Any = convolution(columns)
        convolve.compile((table, table, int64))
