# mypy: allow-untyped-defs
"""Crossings of a surface by an orbit: roots of the Taylor polynomial of each step, each found exactly once.

Not for users.  During a step the height e(s) over a plane is a polynomial.  Let |e″| ≤ D on a piece of width w.  The
piece lies within D w²/8 of its chord, and its slope within D w/2 of the slope of the chord.  A piece that starts and
ends on the same side, farther from the plane than D w²/8, has no root.  A piece that changes sides more steeply than
D w/2 has exactly one.  Any other piece is bisected.  The side of the plane is carried from step to step, so that a
crossing between two steps is found exactly once.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from hess_mechanics.numerics.jit import inner, part
from hess_mechanics.numerics.recursions import Recursion
from hess_mechanics.numerics.step_kernels import step_check, step_condition, step_of
from hess_mechanics.numerics.taylor_kernels import (
    PATIENCE,
    STALLED,
    STEP_LIMIT_REACHED,
    STOPPED,
    columns_of,
    compensated_sum,
    expansion,
    workspace,
)
from hess_mechanics.numerics.unrolled import compile_source, evaluation

__all__ = ["ANGLE", "SurfaceKernels", "crossing_finder", "plane"]

_DEPTH = 45
"""Number of bisections after which a piece is a point in double precision."""


@inner
def _value_and_slope(e, s):
    """Return e(s) and e′(s) of the polynomial with coefficients e[0 …]."""
    value = 0.0
    slope = 0.0
    for k in range(e.size - 1, -1, -1):
        slope = slope * s + value
        value = value * s + e[k]
    return value, slope


@inner
def _largest_bend(e, h):
    """Return the upper bound D = Σ k(k−1)|e_k| h^(k−2) on |e″| over [0, h]."""
    even = 0.0
    odd = 0.0
    # Keep the square finite, so that 0 · square = 0.
    square = min(h * h, 1e300)
    last = e.size - 1
    if last % 2 == 0:
        even = last * (last - 1.0) * abs(e[last])
        last -= 1
    for k in range(last, 1, -2):
        odd = odd * square + k * (k - 1.0) * abs(e[k])
        even = even * square + (k - 1.0) * (k - 2.0) * abs(e[k - 1])
    return even + odd * h


@inner
def _root_between(e, low, high, s, below, bend):
    """Return the only root of e in [low, high], by Newton's method from s, safeguarded by bisection.

    below : True if e is negative at `low`.
    """
    first, end = low, high
    width = high - low
    for _ in range(100):
        value, slope = _value_and_slope(e, s)
        if (value < 0.0) == below:
            low = s
        else:
            high = s
        step = -value / slope if slope != 0.0 else width
        # The next Newton step would be about D step²/(2 |e′|).
        if bend * step * step <= 1e-16 * abs(slope) * width:
            return min(max(s + step, first), end)
        s = s + step if low < s + step < high else 0.5 * (low + high)
        if high - low <= 1e-16 * end:
            return s
    return s


@inner
def roots_on_step(e, h, below, end, below_at_end, sense, roots, pieces):
    """Write the roots of e on [0, h], in increasing order, to `roots` and return their number.

    sense : 1 for roots where e increases, −1 where it decreases, 0 for both.
    below, below_at_end : True if the orbit is below the plane at the two ends; end : e(h).
    pieces : scratch (`_DEPTH` + 2, 2) for the right ends of the remaining pieces, and e there.
    """
    whole = _largest_bend(e, h)
    if below == below_at_end and min(abs(e[0]), abs(end)) > 0.125 * whole * h * h:
        return 0
    # With coefficients beyond double range no piece could be decided, and all 2^_DEPTH pieces would be visited.
    if not whole * h * h < np.inf:
        return 0
    # A smaller |e| may be round-off: the orbit counts as still on its previous side.
    noise = 0.0
    for k in range(e.size - 1, -1, -1):
        noise = noise * h + abs(e[k])
    noise *= 4e-16
    number = 0
    left = 0.0
    at_left = e[0]
    waiting = 1
    pieces[0, 0] = h
    pieces[0, 1] = end
    while waiting > 0:
        right, at_right = pieces[waiting - 1]
        if waiting == 1:
            below_right = below_at_end
        else:
            below_right = at_right < 0.0 if abs(at_right) > noise else below
        width = right - left
        rise = at_right - at_left
        # Use the bound on [0, right] only, so that curvature near the end does not force bisections at the start.
        bend = whole if right == h else _largest_bend(e, right)
        same_side = below == below_right
        if same_side:
            clear = min(abs(at_left), abs(at_right)) > 0.125 * bend * width * width
        else:
            clear = abs(rise) > 0.5 * bend * width * width
        if clear or 0.125 * bend * width * width <= noise or waiting > _DEPTH:
            if not same_side and (sense == 0 or (sense > 0) == below):
                guess = left - at_left * width / rise if rise != 0.0 else left
                roots[number] = _root_between(e, left, right, guess, below, bend)
                number += 1
            left, at_left, below = right, at_right, below_right
            waiting -= 1
        else:
            middle = left + 0.5 * width
            pieces[waiting, 0] = middle
            pieces[waiting, 1] = _value_and_slope(e, middle)[0]
            waiting += 1
    return number


@part
def _as_it_is(e, h):
    return h


@dataclass(frozen=True)
class SurfaceKernels:
    """A surface e(y) = offset, given by compiled functions with a vector `normal` of constants.

    along(c, normal, e, scratch) : writes the Taylor coefficients of e, from those of the state c[k, variable], to
        e (n,); scratch is (n,).
    height(y, normal) : returns e(y).
    is_crossing(y, normal) : returns True if a crossing at y counts.
    is_nonlinear : True if e is nonlinear, so that its truncated series is less accurate than those of the state.
    step_limit(e, h) : returns a step of at most h on which the height is its series, without a jump.
    """

    along: Callable[..., Any]
    height: Callable[..., Any]
    is_crossing: Callable[..., Any]
    is_nonlinear: bool
    step_limit: Callable[..., Any] = _as_it_is


def plane(n: int) -> SurfaceKernels:
    """Return the kernels of a plane in a space of n variables; normal (n,) is its normal vector."""

    def height(row: str) -> str:
        return " + ".join(f"{row}{i}] * normal[{i}]" for i in range(n))

    return SurfaceKernels(
        **compile_source(f"""
def along(c, normal, e, scratch):
    for k in range(e.size):
        e[k] = {height("c[k, ")}

def height(y, normal):
    return {height("y[")}

def is_crossing(y, normal):
    return True
"""),
        is_nonlinear=False,
    )


@inner
def _within_half_a_turn(angle):
    return angle - 2.0 * math.pi * np.round(angle / (2.0 * math.pi))


@part
def _along_angle(c, normal, e, scratch):
    i = int(normal[0])
    for k in range(e.size):
        e[k] = normal[1] * c[k, i]
    e[0] = _within_half_a_turn(e[0] - normal[2])


@part
def _height_of_angle(y, normal):
    return _within_half_a_turn(normal[1] * y[int(normal[0])] - normal[2])


@part
def _at_the_value(y, normal):
    """Return False opposite the value, where the height jumps from π to −π."""
    return abs(_within_half_a_turn(normal[1] * y[int(normal[0])] - normal[2])) < 0.5 * math.pi


@part
def _less_than_a_quarter_turn(e, h):
    while True:
        moved = 0.0
        for k in range(e.size - 1, 0, -1):
            moved = (moved + abs(e[k])) * h
        if not moved >= 0.5 * math.pi:
            return h
        h *= 0.5


ANGLE = SurfaceKernels(_along_angle, _height_of_angle, _at_the_value, False, _less_than_a_quarter_turn)
"""A variable equals a value up to full turns; normal is the index of the variable, its scale and the value."""


def crossing_finder(recursion: Recursion, surface: SurfaceKernels | None = None) -> Callable[..., Any]:
    """Return the compiled search for crossings of a plane, or of another surface, by an orbit.

    cross(state, parameters, normal, offset, sense, end, order, tolerance, longest, max_steps, times, states) writes the
    crossings of normal·y = offset between t = 0 and t = `end` (of either sign) to `times` (n,) and `states` (n, d),
    until these are full, by steps of at most `longest`.  sense : 1 for crossings from below, −1 from above (as time
    increases), 0 for both.  The start does not count, even if it lies on the plane.
    It returns (crossings, steps).  If the motion cannot be followed, crossings is `STEP_LIMIT_REACHED` or `STOPPED`,
    and the last rows of `times` and `states` hold the time and the state reached.
    """
    n, columns = recursion.variables, columns_of(recursion)
    expand, evaluate, check = expansion(recursion), evaluation(n), step_check(recursion)
    suspects, watched = step_condition(recursion), recursion.outputs
    surface = surface or plane(n)
    along, height, is_crossing, curved = surface.along, surface.height, surface.is_crossing, surface.is_nonlinear
    step_limit = surface.step_limit

    @part
    def cross(state, parameters, normal, offset, sense, end, order, tolerance, longest, max_steps, times, states):
        c, left, right, inverses = workspace(order, n, columns)
        seen = np.zeros((order, watched))
        e = np.zeros(order + 1)
        scratch = np.zeros(order + 1)
        point = np.zeros(n)
        roots = np.zeros(order + 1)
        pieces = np.zeros((_DEPTH + 2, 2))
        y = state.copy()
        low = np.zeros(n)
        increments = np.zeros(n)
        t = 0.0
        t_low = 0.0
        direction = 1.0 if end >= 0.0 else -1.0
        sense_of_steps = sense if end >= 0.0 else -sense
        before = 0.0
        mark = 0.0
        below = False
        crossings = 0
        steps = 0
        while True:
            for i in range(n):
                c[0, i] = y[i]
            expand(c, left, right, inverses, parameters, seen)
            along(c, normal, e, scratch)
            e[0] -= offset
            if direction < 0.0:
                for k in range(1, order + 1, 2):
                    e[k] = -e[k]
            if steps == 0:
                # Round-off must not turn a start on the plane into a crossing.
                on_plane = abs(e[0]) <= 1e-14 * (1.0 + abs(offset))
                below = e[0] < 0.0
                if on_plane:
                    if end == 0.0:
                        return 0, 1
                    for k in range(1, order + 1):
                        if abs(e[k]) > 1e-14:
                            below = e[k] < 0.0
                            break
            remaining = direction * ((end - t) - t_low)
            most = min(longest, remaining)
            h = min(step_of(c, n, tolerance), most)
            if suspects(seen, h, before):
                h = check(c, seen, h, most, direction, parameters, tolerance)
            h = before = step_limit(e, h)
            last = h >= remaining
            steps += 1
            if steps % PATIENCE == 1:
                mark = t
            ends = not (h > 0.0 or last) or (steps % PATIENCE == 0 and abs(t - mark) <= STALLED * abs(t))
            if steps > max_steps or ends:
                times[times.size - 1] = t
                states[times.size - 1] = y
                return STOPPED if ends else STEP_LIMIT_REACHED, steps
            evaluate(c, direction * h, increments)
            for i in range(n):
                y[i], low[i] = compensated_sum(y[i], low[i], increments[i])
            at_end = height(y, normal) - offset
            below_at_end = at_end < 0.0
            for root in range(roots_on_step(e, h, below, at_end, below_at_end, sense_of_steps, roots, pieces)):
                s = direction * roots[root]
                evaluate(c, s, increments)
                if curved:
                    # One Newton step removes the truncation error of the series of e.
                    for i in range(n):
                        point[i] = c[0, i] + increments[i]
                    slope = _value_and_slope(e, roots[root])[1]
                    if slope != 0.0:
                        s -= direction * (height(point, normal) - offset) / slope
                        evaluate(c, s, increments)
                for i in range(n):
                    point[i] = c[0, i] + increments[i]
                if is_crossing(point, normal):
                    times[crossings] = t + (t_low + s)
                    states[crossings] = point
                    crossings += 1
                    if crossings == times.size:
                        return crossings, steps
            below = below_at_end
            if last:
                return crossings, steps
            t, t_low = compensated_sum(t, t_low, direction * h)

    return cross
