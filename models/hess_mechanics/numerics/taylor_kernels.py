# mypy: allow-untyped-defs
"""Taylor series of traced fields: steps, dense output, compensated sums.

All kernels are generated from the `Recursion` of a field (see `tracing`): one orbit here, many orbits in
`batch_kernels`, crossings of a surface in `events_kernels`.

The state must be in units in which it is O(1); tolerances are absolute.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from itertools import pairwise
from typing import Any

import numpy as np
from numba import float64, int64

from hess_mechanics.numerics.expressions import FUNCTIONS
from hess_mechanics.numerics.jit import inner, part
from hess_mechanics.numerics.recursions import Recursion
from hess_mechanics.numerics.tracing import trace
from hess_mechanics.numerics.unrolled import compiled, evaluation, items

__all__ = [
    "STEP_LIMIT_REACHED",
    "columns_of",
    "compensated",
    "compile_shared",
    "convolution",
    "convolution_source",
    "expansion",
    "expansion_source",
    "is_small",
    "last_terms",
    "orbit_integrator",
    "parts",
    "step_of",
    "step_size",
    "workspace",
]

STEP_LIMIT_REACHED = -1
_SMALL = 30.0
"""Inverse of the size below which tolerances are relative."""
_FAINT, _LEAST = 1e-250, float(np.finfo(float).tiny)
"""Size below which coefficients of high order underflow, and the smallest number with all its digits."""
"""Logarithm of the ratio of successive terms of e^{λh}, from order 6 to 12, for λh = 6, where order 12 errs by 1 %."""
_ONE = int(np.float64(1.0).view(np.int64))
"""Bits of 1.0, which stand for the logarithm 0."""


@cache
def parts(recursion: Recursion) -> dict[str, Callable[..., Any]]:
    """Return the compiled functions of the source of a recursion."""
    return compiled(recursion.source, **FUNCTIONS)


@cache
def expansion(recursion: Recursion) -> Callable[..., Any]:
    """Return the compiled recursion of one orbit.

    expand(c, left, right, inverses, parameters) computes the Taylor coefficients c[1 … order, variable] from the state
    in c[0].  left, right : copies of the coefficients of the factors of the products, one column per product;
    inverses : 1/(k+1) for k = 0 … order−1.  If the field returns more than its rates, the last argument
    seen[0 … order−1, i] receives these series.
    """
    convolve = convolution(columns_of(recursion))
    return compiled(expansion_source(recursion), **parts(recursion), convolve=convolve)["expand"]


def expansion_source(recursion: Recursion) -> str:
    """Return the Python source of `expand`, which calls the functions of `recursion.source` and `convolve`.

    Every coefficient has a name, z0, z1, … at order 0 and y0, y1, … at order k: Numba takes longer for items of tuples.
    """
    pairs, known = recursion.pairs, recursion.known
    variables, moving = range(recursion.variables), range(recursion.moving)
    observed = range(recursion.observed)

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
        found = names("rate", recursion.moving + recursion.observed)
        return f"{found}= rates(({all_of(letter, known[-1])}), ({products(len(recursion.stages))}), p, {one})"

    def seen(order: str) -> str:
        return "; ".join(f"seen[{order}, {i}] = rate{recursion.moving + i}" for i in observed) or "pass"

    start = all_of("z", recursion.variables)
    return f"""
def expand(c, left, right, inverses, parameters{", seen" if observed else ""}):
    p = ({items(f"parameters[{i}]" for i in range(recursion.parameters))})
    {"; ".join(f"z{i} = c[0, {i}]" for i in variables)}
    {f"{names('z', len(moving), len(variables))}= started(({start}), p)" if recursion.functions else "pass"}
    {f"p = p + constants(({all_of('z', len(moving))}), p)" if recursion.constants else "pass"}
    {keep("0", "z", 0, recursion.moving)}
    if True:{stages("0", "z", "1.0", first_products) or " pass"}
    {rates("z", "1.0", first_products)}
    {"; ".join(f"c[1, {i}] = rate{i}" for i in variables)}
    {seen("0")}
    {"; ".join(f"y{i} = rate{i}" for i in moving)}
    for k in range(1, inverses.size):
        {keep("k", "y", 0, recursion.moving)}
        {names("s", columns_of(recursion))}= convolve(left, right, k){stages("k", "y", "0.0", products)}
        {rates("y", "0.0", products)}
        {seen("k")}
        {"; ".join(f"y{i} = rate{i} * inverses[k]" for i in moving)}
        {"; ".join(f"c[k + 1, {i}] = y{i}" for i in variables)}
"""


@cache
def convolution(columns: int) -> Callable[..., Any]:
    """Return the compiled `convolve` of `convolution_source`."""
    return compiled(convolution_source(columns))["convolve"]


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
def _log2(x):
    """Return log₂ x in units of 2^−52, to within 0.09."""
    return np.float64(x).view(np.int64) - _ONE


@inner
def is_small(size):
    """Return True if errors of a motion or a component of this size count relative to it."""
    return _SMALL * size < 1.0


@inner
def _relative(term, size):
    """Return |coefficient| of high order relative to a size that `is_small`; a component that is 0 has no digits."""
    if size == 0.0 or not is_small(size):
        return term
    # Smaller coefficients than `_LEAST` have lost digits, or underflow to 0.
    return (max(term, _LEAST) if size < _FAINT else term) / (_SMALL * size)


@inner
def step_size(last, previous, order, tolerance):
    """Return the step for which the terms of the two highest orders equal the tolerance (Jorba and Zou, 2005).

    last, previous : largest coefficient of order N and N−1, see `last_terms`.

    The step is right within 3 %: the bits of a double, read as an integer, are 2^52 times its binary logarithm to
    within 0.09.  Taking the N-th root divides them by N.  A library's logarithm would take a tenth of a step.
    """
    sum_of_both = last + previous
    if sum_of_both == 0.0:
        return math.inf
    if not sum_of_both < math.inf:
        return 0.0
    exponent = min(_log2(tolerance / last) / order, _log2(tolerance / previous) / (order - 1.0))
    return 0.97 * np.int64(int(exponent) + _ONE).view(np.float64)


@inner
def last_terms(c, n):
    """Return the largest coefficients of the two highest orders, for one orbit with n variables.

    They are relative to the size of their component, or to the speed of the motion if it is smaller, where this
    `is_small`.  A component that leaves an invariant plane, or a motion that leaves an equilibrium, keeps its relative
    digits in doubles and grows later; an absolute tolerance would ignore it.  Beside an equilibrium all coefficients
    are proportional to the speed.
    """
    order = c.shape[0] - 1
    last = 0.0
    previous = 0.0
    speed = 0.0
    for i in range(n):
        speed = max(speed, abs(c[1, i]))
    for i in range(n):
        size = min(max(abs(c[0, i]), abs(c[1, i])), speed)
        last = max(last, _relative(abs(c[order, i]), size))
        previous = max(previous, _relative(abs(c[order - 1, i]), size))
    return last, previous


@inner
def step_of(c, n, tolerance):
    """Return `step_size` for the coefficients of one orbit with n variables."""
    last, previous = last_terms(c, n)
    return step_size(last, previous, c.shape[0] - 1, tolerance)


@inner
def compensated(total, low, increment):
    """Return total + low + increment as a rounded sum and its round-off."""
    increment += low
    new = total + increment
    return new, increment - (new - total)


def orbit_integrator(recursion: Recursion) -> Callable[..., Any]:
    """Return the compiled solver of ẏ = f(y, p) for one orbit with dense output.

    integrate(state, parameters, times, order, tolerance, max_steps, out): from t = 0, writes the state (d,)
    at the given times (n,), monotonic, all ≥ 0 or all ≤ 0, into `out` (n, d).  Returns the number
    of steps, or `STEP_LIMIT_REACHED`.  State and time are summed with compensation, so that
    round-off does not grow with the number of steps.
    """
    n, columns = recursion.variables, columns_of(recursion)
    expand, evaluate = expansion(recursion), evaluation(n)

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
            expand(c, left, right, inverses, parameters)
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


def compile_shared() -> None:
    """Compile the functions that kernels of orbits share, before a new system needs them."""
    vector: Any = float64[::1]
    table: Any = float64[:, ::1]
    smallest: Any = orbit_integrator(trace(lambda y, p: (y[0],), 1, 0))
    smallest.compile((vector, vector, vector, int64, float64, int64, table))
    for columns in (12, 16, 20, 24):
        convolve: Any = convolution(columns)
        convolve.compile((table, table, int64))
