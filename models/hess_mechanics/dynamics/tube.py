"""An orbit's tube: intervals that contain the true states of one motion of any traced system, by balls of Arb.

At time t the state lies within |D⁻¹(y − c)| ≤ ρ of a centre c, D the sizes that components may have.  Let p(s) be any
polynomials with p(0) = c, here of the centre's Taylor series; none of their digits has to be right.  For the true
solution y of ẏ = f(y) from there e = D⁻¹(y − p) obeys

    |e|˙ ≤ μ|e| + Δ,   Δ ≥ |D⁻¹(ṗ − f(p))|,   μ ≥ the largest eigenvalue of the symmetric part of D⁻¹ f′ D,

so |e(s)| ≤ (ρ + Δs) max(1, e^{μs}) as long as that is less than the R for which μ was found, over the box p ± DR.  The
defect ṗ − f(p) is computed in polynomials, to all orders; where f divides, by a polynomial and a bound of what that is
off.  f′ comes from dual numbers, μ from Gershgorin's circles where f′ is nearly diagonal.

Along a motion ρ grows at that rate even where neighbours do not part.  Other methods turn boxes along (R. Lohner,
1987); here numbers have as many digits as the growth takes away: the bits are raised until the last state is known as
exactly as was asked for.

What is proved: the true solution, from exactly these doubles as start and parameters, lies in the intervals, if Arb's
operations enclose.  Nothing is proved of a body whose numbers are measured.
"""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache
from operator import mul
from typing import Any

import numpy as np

from hess_mechanics.dynamics.orbit import checked_times
from hess_mechanics.dynamics.polynomials import Along, Slope
from hess_mechanics.dynamics.system import Body, Problem, System
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.balls import ArbBall, Enclosure, enclosure, rational, working
from hess_mechanics.numerics.patience import go_on
from hess_mechanics.numerics.results import Array, Orbit, frozen
from hess_mechanics.numerics.tracing import Recursion

__all__ = ["MOST_WORK", "WORK_PER_SECOND", "Tube", "error_bounds", "proved_error", "right_until", "tube"]

_FIRST_BITS, _MOST_BITS, _STEP_BITS = 96, 4096, 32
WORK_PER_SECOND = 5e5
"""Work is steps times the square of their terms, three times that where a field divides, and the terms of each time
asked for, at all precisions together.  It is counted, so that the same tube always ends at the same time; measured:
4.5e5 to 1.4e6 per second of one core."""
MOST_WORK = 4.0 * WORK_PER_SECOND
_TERMS = 0.5 * math.log(2.0)
"""Of a bit: then steps are e⁻² of the radius of convergence, which is cheapest where the cost is that square."""
_PARTS = 2
"""Of a step, for each of which f′ is bounded."""
_LONGER = 1.15
"""How much longer than the last step the next one may be: a refused step costs as much as one that is made."""
_TRIED = 8
_GUARD_BITS, _LOW_BITS = 32, 64


@dataclass(frozen=True)
class Tube:
    """What contains the motion at some times.

    times : (n,), all that were asked for, or as many as were reached; states : for each time an interval of each
    component; width : the largest of them, relative to the size that the component may have; complete : whether all
    times were reached; spent : whether they would have been with more work; steps, bits, seconds : what it took.
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
    spent: bool = False


def tube(
    body: Body, state: Sequence[float], times: Sequence[float] | Array, digits: int = 18, most_work: float = MOST_WORK
) -> Tube:
    """Enclose the motion from `state` at time 0, to so many digits at all times; these doubles are taken as exact.

    Where that needs more than `most_work` (some 4 s) the tube is shorter.  Raises `MissingLibrary`, `InvalidParameter`,
    `WorkLimit` (too many times).

    >>> from hess_mechanics import systems, tube
    >>> found = tube(systems()["hess"].at((0.75, 1.0)), (0.3, 0.9, 0.6, 0.0, 0.8), [1.0])
    >>> found.complete, found.width < 1e-18
    (True, True)
    """
    if not 1 <= digits <= 100:
        raise InvalidParameter(f"{digits} digits: choose 1 to 100.")
    begun = time.perf_counter()
    asked = checked_times(times)
    problem, system = Problem.of(body, [state]), body.system
    length = abs(float(asked[-1]))
    best: Tube | None = None
    bits, left = max(_FIRST_BITS, _whole(3.33 * digits + _GUARD_BITS)), most_work
    while True:
        with working(bits):
            walk = _Walk(system, [float(x) for x in state], [float(x) for x in body.parameters], problem.scale, bits)
            found, width = walk.through(asked, 10.0 ** (-digits), left)
        left -= walk.work
        if best is None or len(found) > len(best.states):
            best = Tube(
                system.name,
                asked[: len(found)],
                tuple(found),
                width,
                len(found) == asked.size,
                walk.steps,
                bits,
                0.0,
                system.variables,
            )
        following = _more_bits(walk, digits, length, left)
        if best.complete or following <= bits:
            spent = not best.complete and (walk.spent or (bool(walk.t) and bits < _MOST_BITS))
            return replace(best, seconds=time.perf_counter() - begun, spent=spent)
        bits = following


def _more_bits(walk: _Walk, digits: int, length: float, left: float) -> int:
    """As many as the whole way will take at the rate of a walk, or as much of it as can be paid for."""
    gone = float(abs(walk.t))
    if walk.spent or gone == 0.0 or walk.bits >= _MOST_BITS:
        return 0
    base, rate, pace = 3.33 * digits + _GUARD_BITS, 1.1 * walk.lost / gone, walk.steps / gone
    bits = min(_MOST_BITS, _whole(base + rate * length))
    bits = max(bits, walk.bits + _STEP_BITS)
    while bits > walk.bits:
        way = min(length, max(gone, (bits - base) / max(rate, 1e-9)))
        if pace * way * _cost(walk.system, bits) <= left:
            break
        bits -= _STEP_BITS
    return bits


def _whole(bits: float) -> int:
    return math.ceil(bits / _STEP_BITS) * _STEP_BITS


def _terms(bits: int) -> int:
    return math.ceil(_TERMS * bits) + 4


def _cost(system: System, bits: int) -> float:
    return _terms(bits) ** 2 * (1.0 if system.recursion.is_quadratic else 3.0)


@cache
def _functions(recursion: Recursion) -> dict[str, Callable[..., Any]]:
    """The functions of the recursion's source, not compiled: for any numbers."""
    namespace: dict[str, Any] = {}
    exec(recursion.source, namespace)
    return namespace


@dataclass(frozen=True)
class _Step:
    """Polynomials along a step of that length, and a bound of |e| over all of it."""

    series: list[ArbBall]
    length: float
    radius: ArbBall


class _Walk:
    """The steps of one tube at one precision."""

    def __init__(self, system: System, state: list[float], parameters: list[float], scale: Array, bits: int) -> None:
        from flint import arb

        self.system, self.bits, self.terms, self.cost = system, bits, _terms(bits), _cost(system, bits)
        self.centre = [arb(x) for x in state]
        self.radius = arb(0)
        self.p = [arb(x) for x in parameters]
        self.scale = [float(x) for x in scale]
        self.t = Fraction(0)
        self.steps, self.work, self.spent = 0, 0.0, False
        self.last = math.inf

    @property
    def lost(self) -> float:
        """Bits that the radius has lost."""
        return max(0.0, self.bits + math.log2(max(2.0 * float(self.radius), 2.0 ** -min(self.bits, 1000))))

    def through(self, times: Array, tolerance: float, most_work: float) -> tuple[list[tuple[Enclosure, ...]], float]:
        """The states at these times while they are as narrow as that, and the largest width."""
        from flint import arb

        found: list[tuple[Enclosure, ...]] = []
        widest = 0.0
        wanted = [Fraction(float(t)) for t in times]
        sign = -1 if wanted[-1] < 0 else 1
        while len(found) < len(wanted):
            go_on()
            left = math.nextafter(float(abs(wanted[-1] - self.t)), math.inf)
            step = self._step(sign, left, most_work)
            if step is None:
                break
            end = self.t + sign * Fraction(step.length)
            while len(found) < len(wanted) and sign * (wanted[len(found)] - end) <= 0:
                gone = abs(wanted[len(found)] - self.t)
                radius = step.radius if gone else self.radius
                y = [
                    one(arb(rational(gone))) + arb(0, (radius * size).abs_upper())
                    for one, size in zip(step.series, self.scale, strict=True)
                ]
                width = max(2.0 * float(x.rad()) / size for x, size in zip(y, self.scale, strict=True))
                if width > tolerance:
                    return found, widest
                widest = max(widest, width)
                found.append(tuple(enclosure(x) for x in y))
                self.work += self.terms
                if self.work > most_work and len(found) < len(wanted):
                    self.spent = True
                    return found, widest
            self._go_to(step, end)
            if 2.0 * float(self.radius) > tolerance:
                break
            if self.work > most_work:
                self.spent = True
                break
        return found, widest

    def _go_to(self, step: _Step, end: Fraction) -> None:
        from flint import arb

        there = [one(arb(step.length)) for one in step.series]
        self.centre = [x.mid() for x in there]
        self.radius = (step.radius + _norm([x.rad() / size for x, size in zip(there, self.scale, strict=True)])).upper()
        self.t = end
        self.steps += 1

    def _step(self, sign: int, left: float, most_work: float) -> _Step | None:
        """Return the next step, of the time that is left at most; None where there is none, or no work for it."""
        from flint import arb_poly

        series = [
            [c.mid() * (sign if k % 2 else 1) for k, c in enumerate(one)]
            for one in _series(self.system.recursion, self.centre, self.p, self.terms)
        ]
        length = min(left, self._length(series), _LONGER * self.last)
        along = [arb_poly(one) for one in series]
        for _ in range(_TRIED):
            # A step that is refused has cost as much as one that is made.
            self.work += self.cost
            try:
                radius = self._radius(along, length, sign)
            except ZeroDivisionError:
                # A divisor of the field may vanish on this step; a shorter one can avoid that.
                radius = None
            if radius is not None:
                self.last = length
                return _Step(along, length, radius)
            if self.work > most_work:
                self.spent = True
                return None
            length *= 0.5
        return None

    def _length(self, series: list[list[ArbBall]]) -> float:
        """At which the last terms are as small as a rounding; this proves nothing, and need not."""
        shortest = 1e6
        for k in (self.terms - 1, self.terms - 2):
            for one, size in zip(series, self.scale, strict=True):
                last = float(abs(one[k]).log()) if one[k] != 0 else -math.inf
                if last > -math.inf:
                    shortest = min(shortest, math.exp((-self.bits * math.log(2.0) - last + math.log(size)) / k))
        return shortest

    def _radius(self, along: list[ArbBall], length: float, sign: int) -> ArbBall | None:
        """A bound of |e| over a step; None for one that is too long."""
        from flint import arb, ctx

        delta = arb(length)
        rates = self.system.field([Along(one, delta, self.terms) for one in along], self.p)
        defects = []
        for one, rate, size in zip(along, rates, self.scale, strict=True):
            known = rate if isinstance(rate, Along) else Along.number(rate, delta, self.terms)
            defects.append(((known * sign).distance(one.derivative()) / size).abs_upper())
        start = self.radius + _norm(defects) * delta
        if not start.is_finite():
            return None
        R = 2 * start + arb(2.0 ** (-self.bits))
        growth = arb(0)
        with ctx.workprec(_LOW_BITS):
            for j in range(_PARTS):
                part = (delta * j / _PARTS).union(delta * (j + 1) / _PARTS)
                box = [one(part) + arb(0, (R * size).abs_upper()) for one, size in zip(along, self.scale, strict=True)]
                rate = self._rate(box, sign)
                if rate is None:
                    return None
                growth += (rate * delta / _PARTS).max(arb(0))
            most = (start * growth.exp()).upper()
        return most if most < R else None

    def _rate(self, box: list[ArbBall], sign: int) -> ArbBall | None:
        """Return a bound of the eigenvalues of the symmetric part of ±D⁻¹ f′ D over a box; None without one.

        Raises `ZeroDivisionError` where a divisor may vanish.
        """
        from flint import arb, arb_mat

        n, scale = len(box), [arb(size) for size in self.scale]
        rates = self.system.field([Slope.of(x, i, n) for i, x in enumerate(box)], self.p)
        J = [
            [rate.slopes[j] * sign * scale[j] / scale[i] if isinstance(rate, Slope) else 0 * box[0] for j in range(n)]
            for i, rate in enumerate(rates)
        ]
        if not all(x.is_finite() for row in J for x in row):
            return None
        S = arb_mat([[(J[i][j] + J[j][i]) / 2 for j in range(n)] for i in range(n)])
        _, Q = np.linalg.eigh([[float(S[i, j].mid()) for j in range(n)] for i in range(n)])
        turn = arb_mat(Q.tolist())
        near = turn.inv() * S * turn
        most = [near[i, i] + sum((abs(near[i, j]) for j in range(n) if j != i), 0 * box[0]) for i in range(n)]
        found = most[0].upper()
        for one in most[1:]:
            found = found.max(one.upper())
        return found


def _norm(sizes: Sequence[ArbBall]) -> ArbBall:
    return sum(map(mul, sizes, sizes), 0 * sizes[0]).sqrt().upper()


def _series(
    recursion: Recursion, y: Sequence[ArbBall], parameters: Sequence[ArbBall], terms: int
) -> list[list[ArbBall]]:
    """The first Taylor coefficients of each variable, by the recursion in balls."""
    from flint import arb

    functions, zero = _functions(recursion), arb(0)
    stages = [functions[f"stage{i}"] for i in range(len(recursion.stages))]
    p = tuple(parameters)
    if recursion.constants:
        p += tuple(functions["constants"](tuple(y), p))
    series: list[list[ArbBall]] = [[] for _ in range(recursion.known[-1])]
    now = list(y)
    for k in range(terms):
        one = arb(1 if k == 0 else 0)
        middle = [sum(map(mul, series[a][1:k], series[b][k - 1 : 0 : -1]), zero) for a, b in recursion.pairs]

        def products(now: list[ArbBall], k: int = k, middle: list[ArbBall] = middle) -> tuple[ArbBall, ...]:
            """Of order k, without the terms of order k that are not known yet."""
            if k == 0:
                return tuple(now[a] * now[b] if max(a, b) < len(now) else zero for a, b in recursion.pairs)
            return tuple(
                inner
                + (series[a][0] * now[b] if b < len(now) else zero)
                + (now[a] * series[b][0] if a < len(now) else zero)
                for (a, b), inner in zip(recursion.pairs, middle, strict=True)
            )

        for stage in stages:
            now = [*now, *stage(tuple(now), products(now), p, one)]
        for own, value in zip(series, now, strict=True):
            own.append(value)
        rates = functions["rates"](tuple(now), products(now), p, one)
        now = [rate / (k + 1) for rate in rates]
    return series[: recursion.variables]


# ---- an orbit judged by its tube ------------------------------------------------------------------------------------


def _errors(orbit: Orbit, found: Tube) -> list[list[tuple[Fraction, Fraction]]]:
    """Return the bounds between which the error of each component of each sample lies."""
    if orbit.system != found.system or not np.array_equal(orbit.times[: found.times.size], found.times):
        raise InvalidParameter("A tube judges the orbit of the same system at the same times.")

    def error(value: Fraction, one: Enclosure) -> tuple[Fraction, Fraction]:
        above, below = one.high - value, value - one.low
        return max(Fraction(0), -above, -below), max(above, below)

    return [
        [error(Fraction(x), one) for x, one in zip(state, intervals, strict=True)]
        for state, intervals in zip(orbit.states.tolist(), found.states, strict=False)
    ]


def error_bounds(orbit: Orbit, found: Tube) -> Array:
    """Bounds (m, d) of the true error of each component at the times of the tube.  Raises `InvalidParameter`."""
    bounds = [[math.nextafter(float(most), math.inf) for _, most in sample] for sample in _errors(orbit, found)]
    return frozen(np.array(bounds, float).reshape(len(bounds), orbit.states.shape[1]))


def proved_error(orbit: Orbit, found: Tube) -> tuple[float, float]:
    """Two bounds of the largest true error of an orbit at the times of its tube.

    Raises `InvalidParameter`, also where the tube ends before the first of them.

    >>> from hess_mechanics import level, proved_error, solve, systems, tube
    >>> motion = systems()["hess"].at((0.75, 1.0)), (0.3, 0.9, 0.6, 0.0, 0.8), [0.5]
    >>> low, high = proved_error(solve(*motion, level("draft")), tube(*motion))
    >>> 0.0 <= low <= high < 1e-3
    True
    """
    bounds = [one for sample in _errors(orbit, found) for one in sample]
    if not bounds:
        raise InvalidParameter("The tube ends before the first of its times: allow more work, or begin earlier.")
    return (
        math.nextafter(float(max(least for least, _ in bounds)), 0.0),
        math.nextafter(float(max(most for _, most in bounds)), math.inf),
    )


def right_until(orbit: Orbit, found: Tube, error: float) -> float:
    """The last of the times up to which every sample is certainly right to that error; 0 where the first is not.

    Raises `InvalidParameter`.

    >>> from hess_mechanics import level, right_until, solve, systems, tube
    >>> motion = systems()["hess"].at((0.75, 1.0)), (0.3, 0.9, 0.6, 0.0, 0.8), [0.25, 0.5]
    >>> right_until(solve(*motion, level("reference")), tube(*motion), 1e-12)
    0.5
    """
    last = 0.0
    for t, sample in zip(found.times, _errors(orbit, found), strict=True):
        if max(most for _, most in sample) > Fraction(error):
            break
        last = float(t)
    return last
