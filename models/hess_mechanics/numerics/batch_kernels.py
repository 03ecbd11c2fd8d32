# mypy: allow-untyped-defs
"""Ensembles of orbits of one system: several orbits at a time with their own step sizes, on any number of threads.

Not for users.  The recursion is that of `taylor_kernels`, with lanes in place of each number, which become vector
instructions.  A lane takes the next orbit as soon as its orbit is complete, so that no lane waits for another.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any

import numpy as np
from llvmlite.binding import get_host_cpu_features

from hess_mechanics.numerics.jit import part
from hess_mechanics.numerics.recursions import Recursion
from hess_mechanics.numerics.step_kernels import is_small, last_terms, parts, step_check, step_size
from hess_mechanics.numerics.taylor_kernels import STEP_LIMIT_REACHED, STOPPED, compensated_sum
from hess_mechanics.numerics.unrolled import compile_source, items

__all__ = ["LANES", "ensemble_integrator", "sequential_integrator"]

LANES = 8 if get_host_cpu_features().get("avx512f") else 4
"""Orbits at a time: the sums of eight need the 32 vector registers of AVX-512."""


def _expansion_of_lanes(recursion: Recursion) -> Callable[..., Any]:
    """Return expand(c, q, parameters, order), which computes the Taylor coefficients c[k, variable, lane].

    q[product, lane] is scratch space.  Only for recursions without auxiliary series, constants and functions.
    """
    m, n = len(recursion.pairs), recursion.variables
    states = [items(f"c[k, {i}, {lane}]" for i in range(n)) for lane in range(LANES)]
    products = [items(f"q[{j}, {lane}]" for j in range(m)) for lane in range(LANES)]
    results = [f"c[k + 1, {i}, {lane}] = y{lane}[{i}] * s" for i in range(n) for lane in range(LANES)]
    # Read all lanes before writing any, so that the compiler can vectorise the loop.
    return compile_source(
        f"""
def expand(c, q, parameters, order):
    p = ({items(f"parameters[{i}]" for i in range(recursion.parameters))})
    for k in range(order):
        convolve(c, q, k)
        s = 1.0 / (k + 1.0)
        one = 1.0 if k == 0 else 0.0
        {_for_lanes(lambda lane: f"y{lane} = rates(({states[lane]}), ({products[lane]}), p, one)")}
        {"; ".join(results)}
""",
        **parts(recursion),
        convolve=_convolution_of_lanes(recursion),
    )["expand"]


def _for_lanes(statement: Callable[[int], str]) -> str:
    return "; ".join(map(statement, range(LANES)))


def _convolution_of_lanes(recursion: Recursion) -> Callable[..., Any]:
    """Return a function (c, q, k) that sets q[j, lane] = Σ_m c[m, left, lane] c[k−m, right, lane] for each product j.

    Every coefficient is read once for all products; a square needs only half of the sum.
    """
    rows = sorted({row for pair in recursion.pairs for row in pair})
    lanes = range(LANES)
    squares = [(j, a, b) for j, (a, b) in enumerate(recursion.pairs) if a == b]
    others = [(j, a, b) for j, (a, b) in enumerate(recursion.pairs) if a != b]

    def lines(template: str, products: list[tuple[int, int, int]]) -> str:
        return (
            "\n        ".join(template.format(j=j, a=a, b=b, lane=lane) for j, a, b in products for lane in lanes)
            or "pass"
        )

    def read(name: str, order: str) -> str:
        return "\n        ".join(f"{name}{row}_{lane} = c[{order}, {row}, {lane}]" for row in rows for lane in lanes)

    return compile_source(f"""
def convolve(c, q, k):
    m = k // 2
    if 2 * m == k:
        {read("x", "m")}
        {lines("s{j}_{lane} = 0.5 * x{a}_{lane} * x{b}_{lane}", squares)}
        {lines("s{j}_{lane} = x{a}_{lane} * x{b}_{lane}", others)}
    else:
        {lines("s{j}_{lane} = 0.0", squares + others)}
    for m in range((k - 1) // 2, -1, -1):
        n = k - m
        {read("x", "m")}
        {read("y", "n")}
        {lines("s{j}_{lane} += x{a}_{lane} * y{b}_{lane}", squares + others)}
        {lines("s{j}_{lane} += y{a}_{lane} * x{b}_{lane}", others)}
    if True:
        {lines("q[{j}, {lane}] = 2.0 * s{j}_{lane}", squares)}
        {lines("q[{j}, {lane}] = s{j}_{lane}", others)}
""")["convolve"]


def ensemble_integrator(recursion: Recursion) -> Callable[..., Any]:
    """Return the compiled solver of many orbits.

    integrate(states, parameters, times, order, tolerance, longest, max_steps, out, steps, ends) writes the orbits that
    start at the rows of `states` (orbits, d), at the times (n,), monotonic and all ≥ 0 or all ≤ 0, into `out`
    (orbits, n, d).  `steps` and `ends` (orbits,) receive what `taylor_kernels.orbit_integrator` returns for each orbit.
    Only for recursions without auxiliary series, constants and functions.
    """
    n, m = recursion.variables, len(recursion.pairs)
    expand, check = _expansion_of_lanes(recursion), step_check(recursion)
    largest, smallest, values, add = compile_source(f"""
def largest(c, k, out):
    {_for_lanes(lambda lane: f"a{lane} = 0.0")}
    for i in range({n}):
        {_for_lanes(lambda lane: f"a{lane} = max(a{lane}, abs(c[k, i, {lane}]))")}
    {_for_lanes(lambda lane: f"out[{lane}] = a{lane}")}

def smallest(c, out):
    {_for_lanes(lambda lane: f"a{lane} = 1.0; v{lane} = 0.0")}
    for i in range({n}):
        {_for_lanes(lambda lane: f"v{lane} = max(v{lane}, abs(c[1, i, {lane}]))")}
        {_for_lanes(lambda lane: f"s{lane} = max(abs(c[0, i, {lane}]), abs(c[1, i, {lane}]))")}
        {_for_lanes(lambda lane: f"a{lane} = min(a{lane}, s{lane})")}
    {_for_lanes(lambda lane: f"out[{lane}] = min(a{lane}, v{lane})")}

def values(c, i, s):
    {_for_lanes(lambda lane: f"a{lane} = 0.0")}
    for k in range(c.shape[0] - 1, 0, -1):
        {_for_lanes(lambda lane: f"a{lane} = a{lane} * s[{lane}] + c[k, i, {lane}]")}
    return ({", ".join(f"a{lane} * s[{lane}]" for lane in range(LANES))},)

def add(y, low, s, compensated):
    {_for_lanes(lambda lane: f"a{lane}, b{lane} = compensated(y[{lane}], low[{lane}], s[{lane}])")}
    {_for_lanes(lambda lane: f"y[{lane}] = a{lane}")}
    {_for_lanes(lambda lane: f"low[{lane}] = b{lane}")}
""").values()

    @part
    def value(c, i, lane, s):
        total = 0.0
        for k in range(c.shape[0] - 1, 0, -1):
            total = total * s + c[k, i, lane]
        return total * s

    @part
    def integrate(states, parameters, times, order, tolerance, longest, max_steps, out, steps, ends):
        c = np.zeros((order + 1, n, LANES))
        one = np.zeros((order + 1, n))
        seen = np.zeros((order, 0))
        q = np.zeros((m, LANES))
        low = np.zeros((n, LANES))
        last = np.zeros(LANES)
        previous = np.zeros(LANES)
        size = np.zeros(LANES)
        h = np.zeros(LANES)
        step = np.zeros(LANES)
        t = np.zeros(LANES)
        t_low = np.zeros(LANES)
        before = np.zeros(LANES)
        orbit = np.full(LANES, -1)
        sample = np.zeros(LANES, np.int64)
        count = times.size
        direction = 1.0 if times[count - 1] >= 0.0 else -1.0
        following = 0
        running = 0
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
                    before[lane] = 0.0
                    steps[following] = 0
                    following += 1
                    running += 1
            if running == 0:
                return
            expand(c, q, parameters, order)
            largest(c, order, last)
            largest(c, order - 1, previous)
            smallest(c, size)
            for lane in range(LANES):
                if is_small(size[lane]):
                    last[lane], previous[lane] = last_terms(c[:, :, lane], n)
            for lane in range(LANES):
                h[lane] = step_size(last[lane], previous[lane], order, tolerance)
            for lane in range(LANES):
                step[lane] = 0.0
                own = orbit[lane]
                if own < 0:
                    continue
                most = min(longest, direction * ((times[count - 1] - t[lane]) - t_low[lane]))
                h[lane] = min(h[lane], most)
                if h[lane] > 2.0 * before[lane]:
                    for k in range(order + 1):
                        for i in range(n):
                            one[k, i] = c[k, i, lane]
                    h[lane] = check(one, seen, h[lane], most, direction, parameters, tolerance)
                while sample[lane] < count:
                    s = (times[sample[lane]] - t[lane]) - t_low[lane]
                    if direction * s > h[lane]:
                        break
                    for i in range(n):
                        increment = low[i, lane] + value(c, i, lane, s)
                        out[own, sample[lane], i] = c[0, i, lane] + increment
                    sample[lane] += 1
                steps[own] += 1
                ends[own] = times[count - 1]
                if sample[lane] < count:
                    if steps[own] <= max_steps and h[lane] > 0.0:
                        before[lane] = h[lane]
                        step[lane] = direction * h[lane]
                        t[lane], t_low[lane] = compensated_sum(t[lane], t_low[lane], step[lane])
                        continue
                    steps[own] = STEP_LIMIT_REACHED if h[lane] > 0.0 else STOPPED
                    ends[own] = t[lane]
                    for i in range(n):
                        out[own, sample[lane], i] = c[0, i, lane]
                orbit[lane] = -1
                running -= 1
            for i in range(n):
                add(c[0, i], low[i], values(c, i, step), compensated_sum)

    return integrate


def sequential_integrator(orbit: Callable[..., Any]) -> Callable[..., Any]:
    """Return the solver of `ensemble_integrator`, made from the solver of one orbit (`orbit_integrator`).

    It serves fields with functions, whose steps are checked, and fields with stages, for which lanes would be a third
    faster but take three times as long to compile.
    """

    @part
    def integrate(states, parameters, times, order, tolerance, longest, max_steps, out, steps, ends):
        for i in range(len(states)):
            steps[i], ends[i] = orbit(states[i], parameters, times, order, tolerance, longest, max_steps, out[i])

    return integrate
