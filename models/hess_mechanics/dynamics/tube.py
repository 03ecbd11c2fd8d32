"""An orbit's tube: intervals that contain the true states of one motion of any traced system, by balls of Arb.

A step from the ball Y at time t: if the field is bounded by |f_i| ≤ F_i on the complex boxes |y_i − Y_i| ≤ R_i, all
solutions from Y are analytic for |s − t| < r = min R_i/F_i and stay in these boxes; by Cauchy the terms of their Taylor
series from the N-th on are at most R_i τ^N/(1 − τ) together, τ = |s − t|/r.  The terms before are found by the
recursion of the traced field (`numerics.tracing`), in balls.

Balls grow along the motion by at most a factor in unit time, even where the motion itself does not spread.  Other
methods turn their boxes along (R. Lohner, 1987); here numbers have as many digits as that growth takes away: the bits
are raised until the last state is known as exactly as was asked for.

What is proved: the true solution, from exactly these doubles as start and parameters, lies in the intervals, if Arb's
operations enclose.  Nothing is proved of a body whose numbers are measured.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from fractions import Fraction
from functools import cache
from operator import mul
from typing import Any

import numpy as np

from hess_mechanics.dynamics.orbit import checked_times
from hess_mechanics.dynamics.system import Problem, System
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.balls import Ball, Enclosure, enclosure, rational, working
from hess_mechanics.numerics.results import Array, Orbit
from hess_mechanics.numerics.tracing import Recursion

__all__ = ["MOST_WORK", "Tube", "proved_error", "right_until", "tube"]

_FIRST_BITS, _MOST_BITS, _STEP_BITS = 96, 4096, 64
MOST_WORK = 1e7
"""Steps times the square of their terms, at one precision: some 20 s."""
_TAU = 0.125
_BOXES = (0.03125, 0.0625, 0.125, 0.25, 0.5, 1.0)
"""Half sides R of boxes that are tried, in units in which the state is O(1)."""
_WIDER, _TRIED = 1.3, 4
"""Then sides of that many times what the field needs there, so often."""


@dataclass(frozen=True)
class Tube:
    """What contains the motion at some times.

    times : (n,), all that were asked for, or as many as were reached; states : for each time an interval of each
    component; width : the largest of them, relative to the size that the component may have; complete : whether all
    times were reached; steps, bits, seconds : what it took.
    """

    system: str
    times: Array
    states: tuple[tuple[Enclosure, ...], ...]
    width: float
    complete: bool
    steps: int
    bits: int
    seconds: float
    variables: tuple[str, ...] = ()


def tube(system: System, state: Sequence[float], parameters: Sequence[float], times: Sequence[float] | Array,
         digits: int = 18, most_work: float = MOST_WORK) -> Tube:
    """Enclose the motion from `state` at time 0, to so many digits at all times; these doubles are taken as exact.

    Where that needs more than `most_work` the tube is shorter.  Raises `MissingLibrary`, `InvalidParameter`,
    `WorkLimit` (too many times).

    >>> from hess_mechanics import systems, tube
    >>> found = tube(systems()["hess"], (0.3, 0.9, 0.6, 0.0, 0.8), (0.75, 1.0), [1.0])
    >>> found.complete, found.width < 1e-18
    (True, True)
    """
    if not 1 <= digits <= 100:
        raise InvalidParameter(f"{digits} digits: choose 1 to 100.")
    begun = time.perf_counter()
    asked = checked_times(times)
    problem = Problem.of(system, [state], parameters)
    bits = _FIRST_BITS
    while True:
        with working(bits):
            walk = _Walk(system, [float(x) for x in state], [float(x) for x in parameters], problem.scale, bits)
            found, width = walk.through(asked, 10.0 ** (-digits), most_work)
        lost = walk.lost
        if len(found) == asked.size or walk.spent or bits >= _MOST_BITS:
            return Tube(system.name, asked[: len(found)], tuple(found), width, len(found) == asked.size, walk.steps,
                        bits, time.perf_counter() - begun, system.variables)
        # As many as the whole way will take at this rate, and some to spare.
        share = max(abs(walk.t) / Fraction(abs(float(asked[-1]))), Fraction(1, 64))
        needed = 3.33 * digits + 1.1 * float(lost / float(share)) + 32
        bits = min(_MOST_BITS, max(bits + _STEP_BITS, math.ceil(needed / _STEP_BITS) * _STEP_BITS))


@cache
def _functions(recursion: Recursion) -> dict[str, Callable[..., Any]]:
    """The functions of the recursion's source, not compiled: for any numbers."""
    namespace: dict[str, Any] = {}
    exec(recursion.source, namespace)
    return namespace


class _Walk:
    """The steps of one tube at one precision."""

    def __init__(self, system: System, state: list[float], parameters: list[float], scale: Array, bits: int) -> None:
        from flint import arb

        self.system, self.bits = system, bits
        self.y = [arb(x) for x in state]
        self.p = [arb(x) for x in parameters]
        self.scale = [float(x) for x in scale]
        self.t = Fraction(0)
        self.steps, self.work, self.spent = 0, 0.0, False

    @property
    def lost(self) -> float:
        """Bits that the widest ball has lost."""
        return max(0.0, self.bits + math.log2(max(self._width(self.y), 2.0 ** -min(self.bits, 1000))))

    def _width(self, y: Sequence[Ball]) -> float:
        if not all(x.is_finite() for x in y):
            return 1.0
        return max(2.0 * float(x.rad()) / scale for x, scale in zip(y, self.scale, strict=True))

    def through(self, times: Array, tolerance: float, most_work: float) -> tuple[list[tuple[Enclosure, ...]], float]:
        """The states at these times while they are as narrow as that, and the largest width."""
        from flint import arb

        found: list[tuple[Enclosure, ...]] = []
        widest = 0.0
        wanted = [Fraction(float(t)) for t in times]
        sign = -1 if wanted[-1] < 0 else 1
        terms = math.ceil(self.bits / -math.log2(_TAU)) + 2
        while len(found) < len(wanted):
            radius, room = self._disc()
            if radius == 0.0:
                break
            series = _series(self.system.recursion, self.y, self.p, terms)
            end = self.t + sign * Fraction(radius * _TAU)

            def at(when: Fraction, series: list[list[Ball]] = series, radius: float = radius,
                   room: list[Ball] = room) -> list[Ball]:
                step = arb(rational(when - self.t))
                tau = abs(step) / arb(radius)
                tail = tau**terms / (1 - tau)
                return [_value(one, step) + arb(0, (tail * R).abs_upper()) for one, R in zip(series, room, strict=True)]

            while len(found) < len(wanted) and sign * (wanted[len(found)] - end) <= 0:
                y = at(wanted[len(found)])
                if self._width(y) > tolerance:
                    return found, widest
                widest = max(widest, self._width(y))
                found.append(tuple(enclosure(x) for x in y))
            self.y, self.t = at(end), end
            self.steps += 1
            self.work += terms**2
            if self._width(self.y) > tolerance:
                break
            if self.work > most_work:
                self.spent = True
                break
        return found, widest

    def _disc(self) -> tuple[float, list[Ball]]:
        """r and R for a step from here; r = 0 where there is none."""
        best, R, most = 0.0, [], []
        for box in _BOXES:
            sides = [box * scale for scale in self.scale]
            r, rates = self._radius(sides)
            if r > best:
                best, R, most = r, sides, rates
        # Where the field is small in a direction a shorter side will do, and then it is smaller in the others.
        for _ in range(_TRIED if best else 0):
            sides = [_WIDER * best * rate for rate in most]
            r, rates = self._radius(sides)
            if r <= best:
                break
            best, R, most = r, sides, rates
        from flint import arb

        return best, [arb(side) for side in R]

    def _radius(self, sides: list[float]) -> tuple[float, list[float]]:
        """For half sides R of boxes: r, rounded down, and the bounds of the field; 0 where it has none."""
        from flint import acb, arb

        around = [acb(y + arb(0, side), arb(0, side)) for y, side in zip(self.y, sides, strict=True)]
        try:
            rates = [acb(rate).abs_upper() for rate in self.system.field(around, self.p)]
        except ZeroDivisionError:
            return 0.0, []
        if not all(rate.is_finite() for rate in rates):
            return 0.0, []
        most = [math.nextafter(float(rate), math.inf) for rate in rates]
        r = min((side / rate for side, rate in zip(sides, most, strict=True) if rate > 1e-200), default=1.0)
        r = math.ldexp(math.floor(math.ldexp(min(r, 1e6) * (1.0 - 1e-6), 20)), -20)
        certain = all(rate * arb(r) < arb(side) for side, rate in zip(sides, rates, strict=True))
        return (r, most) if certain else (0.0, [])


def _value(series: list[Ball], step: Ball) -> Ball:
    """By Horner's rule."""
    found = series[-1]
    for c in reversed(series[:-1]):
        found = found * step + c
    return found


def _series(recursion: Recursion, y: Sequence[Ball], parameters: Sequence[Ball], terms: int) -> list[list[Ball]]:
    """The first Taylor coefficients of each variable, by the recursion in balls."""
    from flint import arb

    functions, zero = _functions(recursion), arb(0)
    stages = [functions[f"stage{i}"] for i in range(len(recursion.stages))]
    p = tuple(parameters)
    if recursion.constants:
        p += tuple(functions["constants"](tuple(y), p))
    series: list[list[Ball]] = [[] for _ in range(recursion.known[-1])]
    now = list(y)
    for k in range(terms):
        one = arb(1 if k == 0 else 0)
        middle = [sum(map(mul, series[a][1:k], series[b][k - 1 : 0 : -1]), zero) for a, b in recursion.pairs]

        def products(now: list[Ball], k: int = k, middle: list[Ball] = middle) -> tuple[Ball, ...]:
            """Of order k, without the terms of order k that are not known yet."""
            if k == 0:
                return tuple(now[a] * now[b] if max(a, b) < len(now) else zero for a, b in recursion.pairs)
            return tuple(inner + (series[a][0] * now[b] if b < len(now) else zero)
                         + (now[a] * series[b][0] if a < len(now) else zero)
                         for (a, b), inner in zip(recursion.pairs, middle, strict=True))

        for stage in stages:
            now = [*now, *stage(tuple(now), products(now), p, one)]
        for own, value in zip(series, now, strict=True):
            own.append(value)
        rates = functions["rates"](tuple(now), products(now), p, one)
        now = [rate / (k + 1) for rate in rates]
    return series[: recursion.variables]


# ---- an orbit judged by its tube ------------------------------------------------------------------------------------


def _errors(orbit: Orbit, found: Tube) -> list[tuple[Fraction, Fraction]]:
    """Of each sample, between which bounds its largest error lies."""
    if orbit.system != found.system or not np.array_equal(orbit.times[: found.times.size], found.times):
        raise InvalidParameter("A tube judges the orbit of the same system at the same times.")
    bounds = []
    for state, intervals in zip(orbit.states, found.states, strict=False):
        least = most = Fraction(0)
        for x, one in zip(state, intervals, strict=True):
            value = Fraction(float(x))
            least = max(least, one.low - value, value - one.high)
            most = max(most, one.high - value, value - one.low)
        bounds.append((least, most))
    return bounds


def proved_error(orbit: Orbit, found: Tube) -> tuple[float, float]:
    """Two bounds of the largest true error of an orbit at the times of its tube.  Raises `InvalidParameter`.

    >>> from hess_mechanics import level, proved_error, solve, systems, tube
    >>> hess, motion = systems()["hess"], ((0.3, 0.9, 0.6, 0.0, 0.8), (0.75, 1.0), [0.5])
    >>> low, high = proved_error(solve(hess, *motion, level("draft")), tube(hess, *motion))
    >>> 0.0 <= low <= high < 1e-3
    True
    """
    bounds = _errors(orbit, found)
    return (math.nextafter(float(max(least for least, _ in bounds)), 0.0),
            math.nextafter(float(max(most for _, most in bounds)), math.inf))


def right_until(orbit: Orbit, found: Tube, error: float) -> float:
    """The last of the times up to which every sample is certainly right to that error; 0 where the first is not.

    Raises `InvalidParameter`.

    >>> from hess_mechanics import level, right_until, solve, systems, tube
    >>> hess, motion = systems()["hess"], ((0.3, 0.9, 0.6, 0.0, 0.8), (0.75, 1.0), [0.25, 0.5])
    >>> right_until(solve(hess, *motion, level("reference")), tube(hess, *motion), 1e-12)
    0.5
    """
    last = 0.0
    for t, (_, most) in zip(found.times, _errors(orbit, found), strict=True):
        if most > Fraction(error):
            break
        last = float(t)
    return last
