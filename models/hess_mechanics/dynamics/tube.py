"""Tubes: rigorous (validated) integration, with intervals that are proved to contain the true states of an orbit.

The intervals are computed in Arb's ball arithmetic.  At time t the state lies within |D⁻¹(y − c)| ≤ ρ of a centre c,
where D holds the sizes of the components.  Let p(s) be any polynomials with p(0) = c, here the Taylor series of the
centre; their digits need not be right.  For the true solution y of ẏ = f(y), the distance e = D⁻¹(y − p) obeys

    |e|˙ ≤ μ|e| + Δ,   Δ ≥ |D⁻¹(ṗ − f(p))|,   μ ≥ the largest eigenvalue of the symmetric part of D⁻¹ f′ D,

so |e(s)| ≤ (ρ + Δs) max(1, e^{μs}) as long as this is less than the R for which μ was found, over the box p ± DR.  The
defect ṗ − f(p) is computed in polynomials, to all orders; a division in f becomes a polynomial with a bound on its
error.  f′ comes from dual numbers, μ from Gershgorin's circles where f′ is nearly diagonal.

ρ grows at this rate along a motion even if neighbours do not part.  Other methods rotate boxes along with the motion
(R. Lohner, 1987); here the number of bits is raised until the last state is known to the requested accuracy.

The proof holds for the true solution from exactly these doubles as start and parameters, provided that Arb's operations
are correct.  It says nothing about a body whose parameters are measured.
"""

from __future__ import annotations

import ast
import math
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cache, cached_property
from operator import mul
from typing import Any

import numpy as np

from hess_mechanics.dynamics.orbit import as_times, solve
from hess_mechanics.dynamics.polynomials import Slope, TaylorModel
from hess_mechanics.dynamics.system import Body, Problem, System
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import Accuracy
from hess_mechanics.numerics.arguments import as_integer
from hess_mechanics.numerics.balls import BALL_FUNCTIONS, ArbBall, Enclosure, enclosure, rational, working_precision
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.recursions import Recursion
from hess_mechanics.numerics.results import Array, Orbit, as_read_only

__all__ = [
    "MAX_WORK",
    "WORK_PER_SECOND",
    "ProvedOrbit",
    "Tube",
    "proved_orbit",
    "tube",
]

_FIRST_BITS, _MOST_BITS, _STEP_BITS = 96, 4096, 32
WORK_PER_SECOND = 5e5
"""Work per second: steps times the square of their terms, three times that if a field divides, plus the terms of each
requested time, at all precisions together.  A limit on work, not on seconds, makes the end of a tube reproducible.
Measured: 4.5e5 to 1.4e6 per second on one core."""
MAX_WORK = 4.0 * WORK_PER_SECOND
_TERMS = 0.5 * math.log(2.0)
"""Terms per bit.  Steps are then e⁻² of the radius of convergence, the cheapest choice if the cost is quadratic."""
_PARTS = 2
"""Parts of a step; f′ is bounded on each of them."""
_LONGER = 1.15
"""Largest ratio of a step to the one before: a rejected step costs as much as an accepted one."""
_TRIED = 8
_GUARD_BITS, _LOW_BITS = 32, 64


@dataclass(frozen=True)
class Tube(Result):
    """Intervals that contain the true states of an orbit; the result of `tube`.

    Attributes
    ----------
    system : str
        Name of the system.
    times : ndarray, shape (n,)
        The requested times that were reached.
    states : tuple of tuple of Enclosure, shape (n, d)
        For each time, an interval for each component.
    width : float
        Largest width of an interval, ≥ 0, relative to the scale of the component; 0 without any time.
    complete : bool
        True if all requested times were reached.
    steps : int
        Number of steps at this precision.
    bits : int
        Working precision, in bits, of the run that reached the most times.
    seconds : float
        Elapsed wall time, in seconds.
    variables : tuple of str, default ()
        Names of the variables.
    reached_work_limit : bool, default False
        True if more work might have reached more times.
    digits : int, default 18
        Requested number of digits; `labels` writes the intervals with three more.
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
    reached_work_limit: bool = False
    digits: int = 18

    def labels(self) -> Labels:
        """Return the ends of the intervals, rounded to floats, and decimals that enclose them, labelled with time.

        Returns
        -------
        Labels
            The lower and the upper end of each variable over the times, and both as text.
        """
        ends = {
            f"{name} {end}": (("t",), np.array([float(getattr(one[i], end)) for one in self.states]))
            for i, name in enumerate(self.variables)
            for end in ("low", "high")
        }
        digits = {
            f"{name} digits": (("t",), np.array([" to ".join(one[i].decimals(self.digits + 3)) for one in self.states]))
            for i, name in enumerate(self.variables)
        }
        facts = ("system", "complete", "width", "bits", "steps")
        return Labels(
            {"t": (("t",), self.times)}, ends | digits, {"t": "T"}, {name: getattr(self, name) for name in facts}
        )


@dataclass(frozen=True)
class ProvedOrbit(Result):
    """An orbit with proved bounds on its true error.

    Parameters
    ----------
    orbit : Orbit
        The orbit.
    tube : Tube
        The intervals that contain the true states of the same motion, at the first of these times or at all.
    right_to : float, default 1e-6
        Largest error of a component of a state that counts as right, positive.

    Raises
    ------
    InvalidParameter
        If the orbit and the tube differ in their system or times.
    """

    orbit: Orbit
    tube: Tube
    right_to: float = 1e-6

    def __post_init__(self) -> None:
        """Check that the orbit and the tube have the same system and times."""
        times = self.tube.times
        if self.orbit.system != self.tube.system or not np.array_equal(self.orbit.times[: times.size], times):
            raise InvalidParameter(
                "The orbit and the tube differ in their system or times: compute both for the same ones."
            )

    @cached_property
    def _errors(self) -> list[list[tuple[Fraction, Fraction]]]:
        """Lower and upper bounds on the error of each component at each time of the tube."""

        def error(value: float, one: Enclosure) -> tuple[Fraction, Fraction]:
            above, below = one.high - Fraction(value), Fraction(value) - one.low
            return max(Fraction(0), -above, -below), max(above, below)

        both = zip(self.orbit.states.tolist(), self.tube.states, strict=False)
        return [list(map(error, state, intervals)) for state, intervals in both]

    @cached_property
    def bounds(self) -> Array:
        """Upper bounds on the error of each component at the m times of the tube, shape (m, d)."""
        rows = [[math.nextafter(float(most), math.inf) for _, most in sample] for sample in self._errors]
        return as_read_only(np.array(rows, float).reshape(len(rows), self.orbit.states.shape[1]))

    @property
    def least(self) -> float:
        """Lower bound on the largest error of any component at the times of the tube; NaN if there is no time."""
        bound = max((least for sample in self._errors for least, _ in sample), default=math.nan)
        return math.nextafter(float(bound), 0.0)

    @property
    def largest(self) -> float:
        """Upper bound on the largest error of any component at the times of the tube; NaN if there is no time."""
        return float(self.bounds.max()) if self.bounds.size else math.nan

    @property
    def valid_until(self) -> float:
        """Last time of the tube up to which all its states are correct to `right_to`; 0 if the first one is not."""
        last = 0.0
        for t, sample in zip(self.tube.times.tolist(), self._errors, strict=True):
            if max(most for _, most in sample) > Fraction(self.right_to):
                break
            last = t
        return last

    def labels(self) -> Labels:
        """Return the orbit, with its proved error among the facts.

        Returns
        -------
        Labels
            The variables over the times.
        """
        known = self.orbit.labels()
        proved = {
            "proved least": self.least,
            "proved largest": self.largest,
            "proved right_to": self.right_to,
            "proved right_until": self.valid_until,
        }
        return replace(known, facts={**known.facts, **proved})


def tube(
    body: Body, start: Sequence[float], times: Sequence[float] | Array, digits: int = 18, most_work: float = MAX_WORK
) -> Tube:
    """Return intervals that are proved to contain the orbit from a state.

    This is rigorous (validated) integration.

    Parameters
    ----------
    body : Body
        The body; its parameters are taken as exact.
    start : sequence of float, shape (d,)
        Initial state at time 0, taken as exact.
    times : array_like, shape (n,)
        Times, monotonic from 0 forward or backward, in units T.
    digits : int, default 18
        Accuracy of the intervals, in decimal digits, 1 to 100.
    most_work : float, optional
        Limit on the work, positive, in units of 1/`WORK_PER_SECOND` s; by default about 4 s.  If it does not suffice,
        the tube ends earlier.

    Returns
    -------
    Tube
        The intervals at the times that were reached, perhaps none.

    Raises
    ------
    MissingLibrary
        If python-flint is not installed.
    InvalidParameter
        If a number is not finite or out of range, or the times are not monotonic from 0.
    WorkLimit
        If there are more than 200 000 times.

    Examples
    --------
    >>> from hess_mechanics import systems, tube
    >>> result = tube(systems()["hess"].at((0.75, 1.0)), (0.3, 0.9, 0.6, 0.0, 0.8), [1.0])
    >>> result.complete, result.width < 1e-18
    (True, True)
    """
    as_integer("digits", digits, 1, 100)
    begun = time.perf_counter()
    targets = as_times(times)
    problem, system = Problem.of(body, [start]), body.system
    length = abs(float(targets[-1]))
    best: Tube | None = None
    bits, left = max(_FIRST_BITS, _whole(3.33 * digits + _GUARD_BITS)), most_work
    while True:
        with working_precision(bits):
            walk = _Walk(system, [float(x) for x in start], [float(x) for x in body.parameters], problem.scale, bits)
            states, width = walk.through(targets, 10.0 ** (-digits), left)
        left -= walk.work
        if best is None or len(states) > len(best.states):
            best = Tube(
                system.name,
                targets[: len(states)],
                tuple(states),
                width,
                len(states) == targets.size,
                walk.steps,
                bits,
                0.0,
                system.variables,
            )
        following = 0 if best.complete else _more_bits(walk, digits, length, left)
        if following <= bits:
            spent = not best.complete and (walk.reached_work_limit or (bool(walk.t) and bits < _MOST_BITS))
            return replace(best, seconds=time.perf_counter() - begun, reached_work_limit=spent, digits=digits)
        bits = following


def _more_bits(walk: _Walk, digits: int, length: float, left: float) -> int:
    """Return the bits that the whole time needs at a walk's rate of loss, or as many as the work left allows.

    At most those of the walk, or 0, if another run cannot reach more.
    """
    gone = float(abs(walk.t))
    if walk.reached_work_limit or gone == 0.0 or walk.bits >= _MOST_BITS:
        return 0
    base, rate, pace = 3.33 * digits + _GUARD_BITS, 1.1 * walk.lost / gone, walk.steps / gone
    bits = _whole(min(_MOST_BITS, base + rate * length))
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


class _Exact(ast.NodeTransformer):
    """Replace numbers by balls, so that a quotient of numbers is enclosed; leave indices unchanged."""

    def visit_Subscript(self, node: ast.Subscript) -> ast.AST:
        return node

    def visit_Constant(self, node: ast.Constant) -> ast.AST:
        return ast.Call(ast.Name("arb", ast.Load()), [node], [])


@cache
def _functions(recursion: Recursion) -> dict[str, Callable[..., Any]]:
    """Return the functions of the recursion's source, not compiled, for any kind of numbers."""
    from flint import arb

    namespace: dict[str, Any] = {**BALL_FUNCTIONS, "arb": arb}
    tree = ast.fix_missing_locations(_Exact().visit(ast.parse(recursion.source)))
    exec(compile(tree, "<balls>", "exec"), namespace)
    return namespace


@dataclass(frozen=True)
class _Step:
    """Polynomials along a step of the given length, and an upper bound on |e| over the whole step."""

    series: list[ArbBall]
    length: float
    radius: ArbBall


class _Walk:
    """The steps of one tube at one working precision."""

    def __init__(self, system: System, state: list[float], parameters: list[float], scale: Array, bits: int) -> None:
        from flint import arb

        self.system, self.bits, self.terms, self.cost = system, bits, _terms(bits), _cost(system, bits)
        self.p = [arb(x) for x in parameters]
        self.scale = [float(x) for x in scale]
        self.field, self.variables = system.field, len(state)
        start = [arb(x) for x in state]
        if system.recursion.functions:
            # Functions of the state become variables of an arithmetic field; enclose their initial values in balls.
            self.field = _functions(system.recursion)["extended"]
            start += _functions(system.recursion)["started"](tuple(start), tuple(self.p))
            self.scale += [max(1.0, abs(float(x))) for x in start[self.variables :]]
        self.centre = [x.mid() for x in start]
        self.radius = _norm([x.rad() / size for x, size in zip(start, self.scale, strict=True)])
        self.t = Fraction(0)
        self.steps, self.work, self.reached_work_limit = 0, 0.0, False
        self.last = math.inf

    @property
    def lost(self) -> float:
        """Bits lost to the growth of the radius."""
        return max(0.0, self.bits + math.log2(max(2.0 * float(self.radius), 2.0 ** -min(self.bits, 1000))))

    def through(self, times: Array, tolerance: float, most_work: float) -> tuple[list[tuple[Enclosure, ...]], float]:
        """Return the states at the times as long as they are narrower than `tolerance`, and the largest width."""
        from flint import arb

        states: list[tuple[Enclosure, ...]] = []
        widest = 0.0
        targets = [Fraction(float(t)) for t in times]
        sign = -1 if targets[-1] < 0 else 1
        while len(states) < len(targets):
            check_limit()
            left = math.nextafter(float(abs(targets[-1] - self.t)), math.inf)
            step = self._step(sign, left, most_work)
            if step is None:
                break
            end = self.t + sign * Fraction(step.length)
            while len(states) < len(targets) and sign * (targets[len(states)] - end) <= 0:
                gone = abs(targets[len(states)] - self.t)
                radius = step.radius if gone else self.radius
                y = [
                    one(arb(rational(gone))) + arb(0, (radius * size).abs_upper())
                    for one, size in zip(step.series[: self.variables], self.scale, strict=False)
                ]
                width = max(2.0 * float(x.rad()) / size for x, size in zip(y, self.scale, strict=False))
                if width > tolerance:
                    return states, widest
                widest = max(widest, width)
                states.append(tuple(enclosure(x) for x in y))
                self.work += self.terms
                if self.work > most_work and len(states) < len(targets):
                    self.reached_work_limit = True
                    return states, widest
            self._go_to(step, end)
            if 2.0 * float(self.radius) > tolerance:
                break
            if self.work > most_work:
                self.reached_work_limit = True
                break
        return states, widest

    def _go_to(self, step: _Step, end: Fraction) -> None:
        from flint import arb

        there = [one(arb(step.length)) for one in step.series]
        self.centre = [x.mid() for x in there]
        self.radius = (step.radius + _norm([x.rad() / size for x, size in zip(there, self.scale, strict=True)])).upper()
        self.t = end
        self.steps += 1

    def _step(self, sign: int, left: float, most_work: float) -> _Step | None:
        """Return the next step, at most over the remaining time; None if it fails or exceeds the remaining work."""
        from flint import arb_poly

        series = [
            [c.mid() * (sign if k % 2 else 1) for k, c in enumerate(one)]
            for one in _series(self.system.recursion, self.centre, self.p, self.terms)
        ]
        length = min(left, self._length(series), _LONGER * self.last)
        along = [arb_poly(one) for one in series]
        for _ in range(_TRIED):
            # A rejected step costs as much as an accepted one.
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
                self.reached_work_limit = True
                return None
            length *= 0.5
        return None

    def _length(self, series: list[list[ArbBall]]) -> float:
        """Return the step size at which the last terms are as small as a rounding; the proof does not depend on it."""
        # Use logarithms, because the terms of a distant pulse may underflow.
        shortest = math.log(1e6)
        for k in (self.terms - 1, self.terms - 2):
            for one, size in zip(series, self.scale, strict=True):
                if one[k] != 0:
                    last = float(abs(one[k]).log())
                    shortest = min(shortest, (-self.bits * math.log(2.0) - last + math.log(size)) / k)
        return math.exp(shortest)

    def _radius(self, along: list[ArbBall], length: float, sign: int) -> ArbBall | None:
        """Return an upper bound on |e| over a step; None if the step is too long."""
        from flint import arb, ctx

        delta = arb(length)
        rates = self.field([TaylorModel(one, delta, self.terms) for one in along], self.p)
        defects = []
        for one, rate, size in zip(along, rates, self.scale, strict=True):
            known = rate if isinstance(rate, TaylorModel) else TaylorModel.number(rate, delta, self.terms)
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
        """Return an upper bound on the eigenvalues of the symmetric part of ±D⁻¹ f′ D over a box.

        None if f′ is not finite there.  Raises `ZeroDivisionError` if a divisor may vanish.
        """
        from flint import arb, arb_mat

        n, scale = len(box), [arb(size) for size in self.scale]
        rates = self.field([Slope.of(x, i, n) for i, x in enumerate(box)], self.p)
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
        bound = most[0].upper()
        for one in most[1:]:
            bound = bound.max(one.upper())
        return bound


def _norm(sizes: Sequence[ArbBall]) -> ArbBall:
    return sum(map(mul, sizes, sizes), 0 * sizes[0]).sqrt().upper()


def _series(
    recursion: Recursion, y: Sequence[ArbBall], parameters: Sequence[ArbBall], terms: int
) -> list[list[ArbBall]]:
    """Return the first Taylor coefficients of variables and functions y, by the recursion in ball arithmetic."""
    from flint import arb

    functions, zero = _functions(recursion), arb(0)
    stages = [functions[f"stage{i}"] for i in range(len(recursion.stages))]
    p = tuple(parameters)
    if recursion.constants:
        p += tuple(functions["constants"](tuple(y), p))
    series: list[list[ArbBall]] = [[] for _ in range(recursion.stage_starts[-1])]
    now = list(y)
    for k in range(terms):
        one = arb(1 if k == 0 else 0)
        middle = [sum(map(mul, series[a][1:k], series[b][k - 1 : 0 : -1]), zero) for a, b in recursion.pairs]

        def products(now: list[ArbBall], k: int = k, middle: list[ArbBall] = middle) -> tuple[ArbBall, ...]:
            """Return the products of order k, without the terms of order k that are not known yet."""
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
        now = [rate / (k + 1) for rate in rates[: recursion.dimension]]
    return series[: recursion.dimension]


def proved_orbit(
    body: Body,
    start: Sequence[float],
    times: Sequence[float] | Array,
    accuracy: Accuracy = "standard",
    right_to: float = 1e-6,
    digits: int = 18,
    most_work: float = MAX_WORK,
) -> ProvedOrbit:
    """Return an orbit with proved bounds on its true error.

    Parameters
    ----------
    body : Body
        The body; its parameters are taken as exact.
    start : sequence of float, shape (d,)
        Initial state at time 0, taken as exact.
    times : array_like, shape (n,)
        Times, monotonic from 0 forward or backward, in units T.
    accuracy : str or Level, default "standard"
        Accuracy level of the orbit.
    right_to : float, default 1e-6
        Largest error of a component that counts as right, positive.
    digits : int, default 18
        Number of digits of the intervals, 1 to 100, see `tube`.
    most_work : float, optional
        Limit on the work, positive, see `tube`.

    Returns
    -------
    ProvedOrbit
        The orbit with its proved error, up to the last time that the tube reaches.

    Raises
    ------
    MissingLibrary
        If python-flint is not installed.
    InvalidParameter
        If a number is not finite or out of range, or the times are not monotonic from 0.
    WorkLimit
        If the tube ends before its first time, there are more than 200 000 times, or the orbit needs too many steps.

    Examples
    --------
    >>> from hess_mechanics import proved_orbit, systems
    >>> proved_orbit(*systems()["hess"].example_motion, [0.5]).largest < 1e-6
    True
    """
    intervals = tube(body, start, times, digits, most_work)
    if not intervals.times.size:
        raise WorkLimit(
            "The motion is enclosed at none of the times: choose fewer digits, earlier times, more work or less "
            "extreme parameters."
        )
    return ProvedOrbit(solve(body, start, intervals.times, accuracy), intervals, right_to)
