# mypy: allow-untyped-defs
"""Length of a Taylor step, from the last terms of the series; checked where these terms may miss a change ahead.

Not for users.  The last terms of a series bound its error only if the terms after them fall as well.  They need not:
the series of τ⁴⁰ at 0 ends before it begins, tanh(x) rounds to 1 and stays constant whatever x does later, x/√(x²) is 1
up to x = 0.  So a step is compared with the field at its end and at a point inside: p′(s) = f(p(s)) for the polynomial
p of the step.

In a field with functions every step is checked, which takes half as long again.  In a rational field the series of the
state contains all that the field contains, so that it can deceive only where terms vanish by accident, at special
points, or are tiny until a divisor has changed by a large factor.  So the first step is checked, each that is more than
twice as long as the one before, and each in which a divisor changes much.  In the systems of the paper none does.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from functools import cache
from typing import Any

import numpy as np

from hess_mechanics.numerics.expressions import FUNCTIONS
from hess_mechanics.numerics.jit import inner
from hess_mechanics.numerics.recursions import Recursion
from hess_mechanics.numerics.unrolled import compile_source, items

__all__ = ["LONGEST", "is_small", "last_terms", "parts", "step_check", "step_condition", "step_of", "step_size"]

LONGEST = 0.01
"""Longest step in a field with functions, as a fraction of the duration."""
_SMALL = 30.0
"""Inverse of the size below which tolerances are relative."""
_FAINT, _LEAST = 1e-250, float(np.finfo(float).tiny)
"""Size below which coefficients of high order underflow, and the smallest number with all its digits."""
_ONE = int(np.float64(1.0).view(np.int64))
"""Bits of 1.0, which stand for the logarithm 0."""
_DEFECT = 16.0
"""Largest |p′ − f| times the step, relative to (order + 1) times the tolerance; about 1 if the series is right."""
_ROUNDING = 1e-13
"""The same, relative to the size of the terms: the floor of double precision."""
_ROUNDING_ACROSS = 1e-11
"""Likewise for a step across a zero of a divisor, whose series loses digits like 1.3^order."""
_INSIDE = math.sqrt(2.0) - 1.0
"""The inner point, as a fraction of the step."""
_ACROSS = 1.3
"""Length of a step across a zero of a divisor, relative to the distance of the zero."""
_RESOLVED = 0.9
"""Relative change of a divisor within one step up to which the series of the quotient shows what comes."""
_HALVINGS = 64
_NOISE, _NOISE_HALVINGS = 0.1, 6
"""A relative defect below `_NOISE` that does not fall in so many halvings is round-off of the field; one of the series
would fall like h^order.  `System.rounding` measures what it means for the motion."""


@cache
def parts(recursion: Recursion) -> dict[str, Callable[..., Any]]:
    """Return the compiled functions of the source of a recursion."""
    return compile_source(recursion.source, **FUNCTIONS)


@cache
def step_condition(recursion: Recursion) -> Callable[..., Any]:
    """Return the compiled suspects(seen, h, before): True if a step h after the step `before` must be checked."""
    divisors = range(recursion.observables, recursion.outputs)
    # Three orders are enough: if a divisor changes by higher ones alone, the first step has been checked.
    changes = [
        f"((abs(seen[3, {i}]) * h + abs(seen[2, {i}])) * h + abs(seen[1, {i}])) * h > {_RESOLVED!r} * abs(seen[0, {i}])"
        for i in divisors
    ]
    tests = ["True"] if recursion.functions else ["h > 2.0 * before", *changes]
    return compile_source(
        f"""
def suspects(seen, h, before):
    return {" or ".join(tests)}
"""
    )["suspects"]


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
def _rise(seen, i, h):
    """Return Σ_{k≥1} |x_k| h^k, an upper bound on the change of the watched x within a step."""
    total = 0.0
    for k in range(seen.shape[0] - 1, 0, -1):
        total = (total + abs(seen[k, i])) * h
    return total


@inner
def _within(seen, i, h, allowed):
    """Return the step, halved until the watched expression changes by no more than `allowed`."""
    for _ in range(_HALVINGS):
        if not _rise(seen, i, h) > allowed:
            break
        h *= 0.5
    return h


@inner
def _zero_ahead(seen, i, direction):
    """Return the distance of the next zero of a divisor; ∞ if Newton's method finds none."""
    s = 0.0
    for _ in range(5):
        value = 0.0
        slope = 0.0
        for k in range(seen.shape[0] - 1, -1, -1):
            slope = slope * s + value
            value = value * s + seen[k, i]
        if slope == 0.0:
            return math.inf
        s -= value / slope
    return direction * s if direction * s > 0.0 else math.inf


_ALLOWED = {
    # e^x is 0 below −745, so x may vary freely there.
    "exp": "max(8.0, -745.0 - seen[0, {i}])",
    # tanh x rounds to ±1 beyond 19.
    "tanh": "max(4.0, abs(seen[0, {i}]) - 20.0)",
    "sinh": "8.0",
    "cosh": "8.0",
    "/": f"{_RESOLVED!r} * abs(seen[0, {{i}}])",
}
"""Change of a watched expression within one step that its series, or its rounding, surely describes."""


@cache
def step_check(recursion: Recursion) -> Callable[..., Any]:
    """Return the compiled check of steps.

    check(c, seen, h, most, direction, parameters, tolerance) returns a step up to h at whose end and inner point the
    series c[k, variable] agrees with the field.  It is longer than h, but not longer than `most`, if it leads across a
    regular zero of a divisor.  0 if there is no such step.
    seen : the series that are observed and watched, see `taylor_kernels.expansion`.
    """
    each = range(recursion.variables)
    watched = [(recursion.observables + j, kind) for j, kind in enumerate(recursion.monitors)]
    extended = "y + started(y, p)" if recursion.functions else "y"
    # For a polynomial field p′ − f(p) is s^order times a polynomial, so the end of the step is the best test point.
    points = 2 if recursion.functions or recursion.monitors else 1
    compare = compile_source(
        f"""
def compare(c, h, parameters):
    p = ({items(f"parameters[{i}]" for i in range(recursion.parameters))})
    off = change = size = 0.0
    s = h
    for _ in range({points}):
        {"; ".join(f"a{i} = b{i} = 0.0" for i in each)}
        for k in range(c.shape[0] - 1, -1, -1):
            {"; ".join(f"b{i} = b{i} * s + a{i}; a{i} = a{i} * s + c[k, {i}]" for i in each)}
        y = ({items(f"a{i}" for i in each)})
        rates = extended({extended}, p)
        off += abs(s) * ({" + ".join(f"abs(b{i} - rates[{i}])" for i in each)})
        change += abs(s) * ({" + ".join(f"abs(rates[{i}])" for i in each)})
        size += {" + ".join(f"abs(a{i})" for i in each)}
        s = {_INSIDE!r} * h
    return off, change, size + change
""",
        **parts(recursion),
    )["compare"]
    limited = watched if not recursion.functions else [one for one in watched if one[1] != "/"]
    limits = [f"h = within(seen, {i}, h, {_ALLOWED[kind].format(i=i)})" for i, kind in limited]
    zeros = [f"zero = min(zero, zero_ahead(seen, {i}, direction))" for i, kind in watched if kind == "/"]
    newline = "\n    "
    across = f"""
    zero = most
    {newline.join(zeros)}
    across = {_ACROSS!r} * zero
    if h < across and across <= min(most, 16.0 * h):
        off, _, size = compare(c, direction * across, parameters)
        if off <= bound + {_ROUNDING_ACROSS!r} * size:
            return across
"""
    return compile_source(
        f"""
def check(c, seen, h, most, direction, parameters, tolerance):
    bound = {_DEFECT!r} * c.shape[0] * tolerance
    {newline.join(limits) or "pass"}
    {across if zeros else "pass"}
    first = h
    first_off = 0.0
    for halvings in range({_HALVINGS}):
        off, change, size = compare(c, direction * h, parameters)
        if off <= bound + {_ROUNDING!r} * size:
            return h
        off /= change
        if halvings == 0:
            first_off = off
        elif halvings == {_NOISE_HALVINGS} and first_off < {_NOISE!r} and off > 0.25 * first_off:
            return first
        h *= 0.5
    return 0.0
""",
        compare=compare,
        within=_within,
        zero_ahead=_zero_ahead,
    )["check"]
