"""Many orbits of one system: eight at a time, each with its own steps, on as many threads as wanted.

The recursion of `taylor` with eight orbits in the place of one number, which the processor computes
together.  A lane whose orbit is done takes the next one, so that no lane waits for another.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np

from .jit import inner
from .taylor import STEP_LIMIT_REACHED, Quadratic, compensated
from .unrolled import compiled
from .vector import LANES, load, same, store

__all__ = ["LANES", "ensemble_integrator"]

_ONE = int(np.float64(1.0).view(np.int64))
"""The bits of 1.0, whose logarithm is 0."""
_ZERO = "same(0.0)"
_TINY = 1e-280
"""In the place of the coefficients of a motion at rest."""


def expansion_of_lanes(field: Quadratic) -> Callable[..., Any]:
    """expand(c, scratch, parameters, order, rates, convolve): the Taylor coefficients c[k, series, lane].

    scratch[product or constant, lane]; convolve : see `convolution_of_lanes`.
    """
    m, n, known, count = len(field.pairs), field.dimension, field.known, scratch_rows(field)
    products = ", ".join(f"q{j}" for j in range(m)) + ","

    def constants() -> str:
        first = ", ".join(f"c[0, {i}, lane]" for i in range(n))
        kept = "; ".join(f"scratch[{i}, lane] = y[{i - m}]" for i in range(m, count))
        return f"""
    for lane in range({LANES}):
        y = constants(({first}), p)
        {kept}
    p = p + ({", ".join(f"load(scratch, ({i},))" for i in range(m, count))},)"""

    def stage(i: int) -> str:
        since, now = known[i : i + 2]
        ends = [(j, series, a + b - series) for series in range(since, now)
                for j, (a, b) in enumerate(field.pairs) if series in (a, b)]
        return f"""
        z = stage{i}(y, ({products}), p)
        y = y + z
        {"; ".join(f"store(c, (k, {i}), z[{i - since}])" for i in range(since, now))}
        {"; ".join(f"q{j} += z[{i - since}] * load(c, (0, {other}))" for j, i, other in ends)}"""

    return compiled(f"""
def function(c, scratch, parameters, order, rates, convolve):
    p = ({", ".join(f"parameters[{i}]" for i in range(field.parameters))},)
    {constants() if field.constants else "pass"}
    for k in range(order):
        {"; ".join(f"store(c, (k, {i}), {_ZERO})" for i in range(n, known[-1])) or "pass"}
        convolve(c, scratch, k)
        {"; ".join(f"q{j} = load(scratch, ({j},))" for j in range(m))}
        y = ({", ".join(f"load(c, (k, {i}))" for i in range(n))},){"".join(map(stage, range(len(field.stages))))}
        y = rates(y, ({products}), p)
        s = 1.0 / (k + 1.0)
        {"; ".join(f"store(c, (k + 1, {i}), y[{i}] * s)" for i in range(n))}
""", load=load, store=store, same=same, **field.helpers)


def scratch_rows(field: Quadratic) -> int:
    """Rows of the q of `expansion_of_lanes`."""
    return len(field.pairs) + (len(field.constants[0].split()) if field.constants else 0)


def _for_lanes(statement: Callable[[int], str]) -> str:
    return "; ".join(map(statement, range(LANES)))


def convolution_of_lanes(field: Quadratic) -> Callable[..., Any]:
    """The function of (c, q, k) that sets q[j, lane] = Σ_m c[m, left, lane] c[k−m, right, lane] for each product j.

    Every coefficient is read once for eight products, as many sums as the processor has room for; of a square half
    the sum is enough.
    """
    products = [(j, a, b) for j, (a, b) in enumerate(field.pairs)]
    return compiled("\n".join(["def function(c, q, k):", *(
        _sums(products[i : i + LANES]) for i in range(0, len(products), LANES))]), load=load, store=store, same=same)


def _sums(products: list[tuple[int, int, int]]) -> str:
    rows = sorted({row for _, a, b in products for row in (a, b)})
    squares = [(j, a, b) for j, a, b in products if a == b]
    others = [(j, a, b) for j, a, b in products if a != b]

    def lines(template: str, products: list[tuple[int, int, int]]) -> str:
        return "; ".join(template.format(j=j, a=a, b=b) for j, a, b in products) or "pass"

    def read(name: str, order: str) -> str:
        return "; ".join(f"{name}{row} = load(c, ({order}, {row}))" for row in rows)

    return f"""
    m = k // 2
    if 2 * m == k:
        {read("x", "m")}
        {lines("s{j} = 0.5 * x{a} * x{b}", squares)}
        {lines("s{j} = x{a} * x{b}", others)}
    else:
        {lines(f"s{{j}} = {_ZERO}", products)}
    for m in range((k - 1) // 2, -1, -1):
        n = k - m
        {read("x", "m")}
        {read("y", "n")}
        {lines("s{j} += x{a} * y{b}", products)}
        {lines("s{j} += y{a} * x{b}", others)}
    if True:
        {lines("store(q, ({j},), 2.0 * s{j})", squares)}
        {lines("store(q, ({j},), s{j})", others)}
"""


@inner
def steps_of_lanes(last, previous, order, tolerance, ratios, bits, h, h_bits):
    """`step_size` of every lane into h, to 3 %, by arithmetic that the processor can do for all lanes at once.

    The bits of a double, read as a whole number, are its binary logarithm to 0.09, times 2^52; the N-th root
    divides that by N.  bits, h_bits : ratios (2, lanes) and h (lanes,) seen as whole numbers.
    """
    for lane in range(LANES):
        ratios[0, lane] = tolerance / max(last[lane], _TINY)
        ratios[1, lane] = tolerance / max(previous[lane], _TINY)
    for lane in range(LANES):
        logarithm = min((bits[0, lane] - _ONE) / order, (bits[1, lane] - _ONE) / (order - 1.0))
        h_bits[lane] = int(logarithm) + _ONE
    for lane in range(LANES):
        h[lane] = math.inf if last[lane] + previous[lane] == 0.0 else 0.97 * h[lane]


def ensemble_integrator(field: Quadratic) -> Callable[..., Any]:
    """The compiled solver of many orbits.

    integrate(states, parameters, times, order, tolerance, max_steps, out): the orbits that start at the rows of
    `states` (orbits, d), at the given times (n,), monotonic, all ≥ 0 or all ≤ 0, into `out` (orbits, n, d).
    Returns the number of steps of all orbits, or `STEP_LIMIT_REACHED` when one took more than `max_steps`.
    """
    n, series, rows = field.dimension, field.known[-1], scratch_rows(field)
    rates, expand, convolve = field.rates, expansion_of_lanes(field), convolution_of_lanes(field)
    largest = compiled(f"""
def function(c, k, out):
    {_for_lanes(lambda lane: f"a{lane} = 0.0")}
    for i in range({n}):
        {_for_lanes(lambda lane: f"a{lane} = max(a{lane}, abs(c[k, i, {lane}]))")}
    {_for_lanes(lambda lane: f"out[{lane}] = a{lane}")}
""")
    @inner
    def advance(c, low, s):
        for i in range(n):
            total = same(0.0)
            for k in range(c.shape[0] - 1, 0, -1):
                total = (total + load(c, (k, i))) * s
            y, rest = compensated(load(c, (0, i)), load(low, (i,)), total)
            store(c, (0, i), y)
            store(low, (i,), rest)

    @inner
    def value(c, i, lane, s):
        total = 0.0
        for k in range(c.shape[0] - 1, 0, -1):
            total = (total + c[k, i, lane]) * s
        return total

    @inner
    def integrate(states, parameters, times, order, tolerance, max_steps, out):
        c = np.zeros((order + 1, series, LANES))
        q = np.zeros((rows, LANES))
        low = np.zeros((n, LANES))
        last = np.zeros(LANES)
        previous = np.zeros(LANES)
        ratios = np.zeros((2, LANES))
        bits = ratios.view(np.int64)
        h = np.zeros(LANES)
        h_bits = h.view(np.int64)
        step = np.zeros((1, LANES))
        t = np.zeros(LANES)
        t_low = np.zeros(LANES)
        orbit = np.full(LANES, -1)
        sample = np.zeros(LANES, np.int64)
        steps = np.zeros(LANES, np.int64)
        count = times.size
        direction = 1.0 if times[count - 1] >= 0.0 else -1.0
        following = 0
        running = 0
        total = 0
        while True:
            for lane in range(LANES):
                if orbit[lane] < 0 and following < states.shape[0]:
                    orbit[lane] = following
                    for i in range(n):
                        c[0, i, lane] = states[following, i]
                        low[i, lane] = 0.0
                    t[lane] = 0.0
                    t_low[lane] = 0.0
                    sample[lane] = 0
                    steps[lane] = 0
                    following += 1
                    running += 1
            if running == 0:
                return total
            expand(c, q, parameters, order, rates, convolve)
            largest(c, order, last)
            largest(c, order - 1, previous)
            steps_of_lanes(last, previous, order, tolerance, ratios, bits, h, h_bits)
            for lane in range(LANES):
                step[0, lane] = 0.0
                if orbit[lane] < 0:
                    continue
                while sample[lane] < count:
                    s = (times[sample[lane]] - t[lane]) - t_low[lane]
                    if direction * s > h[lane]:
                        break
                    for i in range(n):
                        increment = low[i, lane] + value(c, i, lane, s)
                        out[orbit[lane], sample[lane], i] = c[0, i, lane] + increment
                    sample[lane] += 1
                steps[lane] += 1
                if sample[lane] == count:
                    total += steps[lane]
                    orbit[lane] = -1
                    running -= 1
                    continue
                if steps[lane] > max_steps or not (h[lane] > 0.0):
                    return STEP_LIMIT_REACHED
                step[0, lane] = direction * h[lane]
                t[lane], t_low[lane] = compensated(t[lane], t_low[lane], step[0, lane])
            advance(c, low, load(step, (0,)))

    return integrate
