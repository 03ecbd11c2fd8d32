# mypy: allow-untyped-defs
"""Crossings of a plane by one orbit: the roots of each step's own polynomial, none lost, none doubled.

On a step the height e(s) over the plane is a polynomial, |e″| ≤ D up to the end of a piece.  A piece of width w
lies within D w²/8 of its chord, and its slope within D w/2 of the chord's.  So a piece that ends on the
side where it began, farther away than that, holds no root; one that changes sides more steeply than that
holds exactly one; any other is halved.  The side of the plane is carried from step to step, so that a
crossing where two steps meet is seen exactly once.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import numpy as np

from hess_mechanics.numerics.jit import inner, part
from hess_mechanics.numerics.taylor_kernels import (
    STEP_LIMIT_REACHED,
    columns_of,
    compensated,
    expansion,
    step_of,
    workspace,
)
from hess_mechanics.numerics.tracing import Recursion
from hess_mechanics.numerics.unrolled import evaluation

__all__ = ["PLANE", "SurfaceKernels", "crossing_finder"]

_DEPTH = 45
"""Halvings after which a piece is a point, for double precision."""


@inner
def value_and_slope(e, s):
    """e(s) and e′(s) of the polynomial with coefficients e[0 …]."""
    value = 0.0
    slope = 0.0
    for k in range(e.size - 1, -1, -1):
        slope = slope * s + value
        value = value * s + e[k]
    return value, slope


@inner
def largest_bend(e, h):
    """D: a bound of |e″| on [0, h], Σ k(k−1)|e_k| h^(k−2)."""
    even = 0.0
    odd = 0.0
    last = e.size - 1
    for k in range(last - last % 2, 1, -2):
        even = even * h * h + k * (k - 1.0) * abs(e[k])
        if k < last:
            odd = odd * h * h + k * (k + 1.0) * abs(e[k + 1])
    return even + odd * h


@inner
def root_between(e, low, high, s, below, bend):
    """The one root of e in [low, high], from s on: Newton's method, kept inside by bisection.

    below : whether e is negative at `low`.
    """
    first, end = low, high
    width = high - low
    for _ in range(100):
        value, slope = value_and_slope(e, s)
        if (value < 0.0) == below:
            low = s
        else:
            high = s
        step = -value / slope if slope != 0.0 else width
        # What Newton's next step would still find is about D step²/(2 |e′|).
        if bend * step * step <= 1e-16 * abs(slope) * width:
            return min(max(s + step, first), end)
        s = s + step if low < s + step < high else 0.5 * (low + high)
        if high - low <= 1e-16 * end:
            return s
    return s


@inner
def roots_on_step(e, h, below, end, below_at_end, roots, pieces):
    """The roots of e on [0, h] from left to right into `roots`; how many.

    below, below_at_end : whether the orbit is below the plane at the two ends; end : e(h).
    pieces : scratch (`_DEPTH` + 2, 2), the right ends of the pieces not yet looked at, and e there.
    """
    bend = largest_bend(e, h)
    if below == below_at_end and min(abs(e[0]), abs(end)) > 0.125 * bend * h * h:
        return 0
    # Coefficients beyond double range: no piece would ever be clear, and there are 2^_DEPTH.
    if not bend * h * h < np.inf:
        return 0
    # What is lower than this may be round-off: it is on the side on which the orbit was.
    noise = 0.0
    for k in range(e.size - 1, -1, -1):
        noise = noise * h + abs(e[k])
    noise *= 4e-16
    found = 0
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
        # Its bound on [0, right] alone: where e is flat at first, what bends it at the end must not halve that away.
        bend = largest_bend(e, right)
        same_side = below == below_right
        if same_side:
            clear = min(abs(at_left), abs(at_right)) > 0.125 * bend * width * width
        else:
            clear = abs(rise) > 0.5 * bend * width * width
        if clear or 0.125 * bend * width * width <= noise or waiting > _DEPTH:
            if not same_side:
                guess = left - at_left * width / rise if rise != 0.0 else left
                roots[found] = root_between(e, left, right, guess, below, bend)
                found += 1
            left, at_left, below = right, at_right, below_right
            waiting -= 1
        else:
            middle = left + 0.5 * width
            pieces[waiting, 0] = middle
            pieces[waiting, 1] = value_and_slope(e, middle)[0]
            waiting += 1
    return found


@dataclass(frozen=True)
class SurfaceKernels:
    """A surface e(y) = offset, by compiled functions with a vector `normal` of constants.

    along(c, normal, e, scratch) : the Taylor coefficients of e from those of the state, c[k, variable], into e (n,);
        scratch is (n,).
    height(y, normal) : e(y).
    counted(y, normal) : whether a crossing at y counts.
    curved : whether e is more than linear, so that its series ends later than those of the state.
    """

    along: Callable[..., Any]
    height: Callable[..., Any]
    counted: Callable[..., Any]
    curved: bool


@part
def _along_plane(c, normal, e, scratch):
    for k in range(e.size):
        height = 0.0
        for i in range(normal.size):
            height += c[k, i] * normal[i]
        e[k] = height


@part
def _height_over_plane(y, normal):
    height = 0.0
    for i in range(normal.size):
        height += y[i] * normal[i]
    return height


@part
def _always(y, normal):
    return True


PLANE = SurfaceKernels(_along_plane, _height_over_plane, _always, curved=False)


def crossing_finder(recursion: Recursion, surface: SurfaceKernels = PLANE) -> Callable[..., Any]:
    """The compiled search for the crossings of a plane, or of another surface, by one orbit.

    cross(state, parameters, normal, offset, sense, end, order, tolerance, max_steps, times, states): the
    crossings of normal·y = offset after t = 0 and up to t = `end` (of either sign) into `times` (n,) and
    `states` (n, d), until those are full; sense 1: from below, −1: from above (as time grows), 0: both.
    An orbit that starts on the plane has not crossed it there.
    Returns (crossings, steps); crossings is `STEP_LIMIT_REACHED` when that is so.
    """
    n, columns = recursion.variables, columns_of(recursion)
    expand, evaluate = expansion(recursion), evaluation(n)
    along, height, counted, curved = surface.along, surface.height, surface.counted, surface.curved

    @part
    def cross(state, parameters, normal, offset, sense, end, order, tolerance, max_steps, times, states):
        c, left, right, inverses = workspace(order, n, columns)
        e = np.zeros(order + 1)
        scratch = np.zeros(order + 1)
        found = np.zeros(n)
        roots = np.zeros(order + 1)
        pieces = np.zeros((_DEPTH + 2, 2))
        y = state.copy()
        low = np.zeros(n)
        increments = np.zeros(n)
        t = 0.0
        t_low = 0.0
        direction = 1.0 if end >= 0.0 else -1.0
        below = False
        crossings = 0
        steps = 0
        while True:
            for i in range(n):
                c[0, i] = y[i]
            expand(c, left, right, inverses, parameters)
            along(c, normal, e, scratch)
            e[0] -= offset
            if direction < 0.0:
                for k in range(1, order + 1, 2):
                    e[k] = -e[k]
            if steps == 0:
                # Round-off must not make a crossing of a start that was meant to be on the plane.
                on_plane = abs(e[0]) <= 1e-14 * (1.0 + abs(offset))
                below = e[0] < 0.0
                if on_plane:
                    if end == 0.0:
                        return 0, 1
                    for k in range(1, order + 1):
                        if abs(e[k]) > 1e-14:
                            below = e[k] < 0.0
                            break
            h = step_of(c, n, tolerance)
            remaining = direction * ((end - t) - t_low)
            last = h >= remaining
            h = min(h, remaining)
            steps += 1
            if steps > max_steps or not (h > 0.0 or last):
                return STEP_LIMIT_REACHED, steps
            evaluate(c, direction * h, increments)
            for i in range(n):
                y[i], low[i] = compensated(y[i], low[i], increments[i])
            at_end = height(y, normal) - offset
            below_at_end = at_end < 0.0
            for root in range(roots_on_step(e, h, below, at_end, below_at_end, roots, pieces)):
                if sense == 0 or (sense * direction > 0.0) == below:
                    s = direction * roots[root]
                    evaluate(c, s, increments)
                    if curved:
                        # What the cut series of e leaves, one step of Newton's method takes away.
                        for i in range(n):
                            found[i] = c[0, i] + increments[i]
                        slope = value_and_slope(e, roots[root])[1]
                        if slope != 0.0:
                            s -= direction * (height(found, normal) - offset) / slope
                            evaluate(c, s, increments)
                    for i in range(n):
                        found[i] = c[0, i] + increments[i]
                    if counted(found, normal):
                        times[crossings] = t + (t_low + s)
                        states[crossings] = found
                        crossings += 1
                        if crossings == times.size:
                            return crossings, steps
                below = not below
            below = below_at_end
            if last:
                return crossings, steps
            t, t_low = compensated(t, t_low, direction * h)

    return cross
