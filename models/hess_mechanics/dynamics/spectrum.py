"""Lyapunov exponents of one orbit, from its variational equations (Benettin, Galgani, Giorgilli, Strelcyn 1980).

The largest exponent is the growth rate of a single tangent vector, which starts in a fixed direction that no symmetry
singles out and is renormalised when it is long.  For all exponents a frame of tangent vectors is orthonormalised
whenever its condition requires it, so no distance has to be small and no digits are lost to round-off.  ∫ tr J dt is
computed along with the frame; its mean is the sum of all exponents, whatever the frame.

The first vector of a frame is along the motion.  It is parallel to f(y) and as long, up to a constant factor, so it is
not integrated until the motion becomes slow.
"""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property, partial

import numpy as np

from hess_mechanics.dynamics.birkhoff import ERRORS, STRETCHES, batch_error
from hess_mechanics.dynamics.orbit import MAX_SAMPLES, MAX_STEPS, as_duration, end_of, require_finite_rates
from hess_mechanics.dynamics.system import Body, Problem
from hess_mechanics.dynamics.variation import LONGEST, flow_frame, generic_direction, tangent
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import PLANS, STANDARD, Accuracy, Kind, Level, Status, plan
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array, Cost, as_read_only
from hess_mechanics.parameters import plain

__all__ = ["LIMIT", "Exponent", "Spectrum", "kaplan_yorke", "lyapunov_exponent", "lyapunov_spectrum", "no_chaos"]

_INTERVAL = 2.0
"""Time between samples of a single vector, in units of 1/ν."""
_SETTLES = 3
"""Stretches of time in which the frame settles, before those that are measured."""
_SAMPLES = 16
"""Samples per stretch."""
LIMIT = 1e2
"""Largest condition of the frame; it multiplies the truncation error of a step at most."""
_SLOW = 1e-2
"""Smallest |f| of a moving orbit, in units in which states are O(1): errors of f(y) are divided by it."""
_RESTS, _ESCAPES, _RETURNS = 1e-6, 10.0, 8
"""Largest |f| of a motion that has come to rest, and distance within which it has closed; least growth of the largest
|y|, at least 1, from the first half of the time to the second of a motion that escapes: linear growth doubles it.  Both
in units in which states are O(1).  Crossings of the plane across the motion at its start that are compared with it."""


@dataclass(frozen=True)
class Exponent(Result):
    """Running estimates of the largest Lyapunov exponent; the result of `lyapunov_exponent`.

    Attributes
    ----------
    times : ndarray, shape (n,)
        Times, positive and increasing, also for backward motion.
    rates : ndarray, shape (n,)
        Mean growth rate up to each time, in 1/T; the last one is the estimate.
    spread : float
        Range of the rates over the second half of the time, ≥ 0, in 1/T.
    no_chaos : str, default ""
        Why the motion is not chaotic, whatever the estimate is, see `Megno`; empty if there is no such reason.
    """

    times: Array
    rates: Array
    spread: float
    no_chaos: str = ""

    @property
    def value(self) -> float:
        """The estimate of the exponent, in 1/T."""
        return float(self.rates[-1])

    def labels(self) -> Labels:
        """Return the mean growth rates, labelled with time.

        Returns
        -------
        Labels
            The rates over the times.
        """
        return Labels(
            {"t": (("t",), self.times)},
            {"rate": (("t",), self.rates)},
            {"t": "T", "rate": "1/T"},
            {"exponent": self.value, "spread": self.spread, "no chaos": self.no_chaos},
        )

    @property
    def is_regular(self) -> bool:
        """True if the rate is below 2 ln(n)/t for n samples, as for a regular motion: neighbours part linearly."""
        return self.value < 2.0 * math.log(max(math.e, self.times.size)) / float(self.times[-1])


@dataclass(frozen=True)
class Spectrum(Result):
    """All Lyapunov exponents of one orbit; the result of `lyapunov_spectrum`.

    Attributes
    ----------
    system : str
        Name of the system.
    level : str
        Name of the accuracy level.
    times : ndarray, shape (n,)
        Times, positive and increasing, also for backward motion.
    rates : ndarray, shape (n, d)
        Mean growth rates up to each time, in 1/T, in the order of `values`; they show the convergence.
    values : ndarray, shape (d,)
        The exponents, in 1/T, the largest first: means over the last four fifths of the time.
    errors : ndarray, shape (d,)
        Their errors, in 1/T: the standard error from 12 stretches of time, combined with the part of the growth that is
        a power of t and therefore no exponent, plus the error of the integration.
    divergence, divergence_error : float
        Mean of tr J over the same time, and its error ≥ 0, both in 1/T.
    integrals : int
        Number of first integrals of the system.
    status : Status
        `OK` if the largest error is within the promise of the level, else `PROMISE_NOT_MET`.
    cost : Cost
        Steps and time.
    """

    system: str
    level: str
    times: Array
    rates: Array
    values: Array
    errors: Array
    divergence: float
    divergence_error: float
    integrals: int
    status: Status
    cost: Cost

    @property
    def error_estimate(self) -> float:
        """Largest error of an exponent, in 1/T."""
        return float(self.errors.max())

    @property
    def signs(self) -> tuple[str, ...]:
        """Sign of each exponent: "+", "0" or "-", where "0" means within three errors of 0."""
        return tuple(
            "0" if abs(value) <= ERRORS * error else "+" if value > 0.0 else "-"
            for value, error in zip(self.values.tolist(), self.errors.tolist(), strict=True)
        )

    @property
    def zeros(self) -> int:
        """Number of exponents within three errors of 0; each integral gives one, and so does a motion not at rest."""
        return self.signs.count("0")

    @cached_property
    def dimension(self) -> tuple[float, float]:
        """Kaplan–Yorke dimension of the set that the motion fills, on its level of the integrals, and its error.

        One zero exponent per integral is left out, and exponents within their error of 0 count as 0.  The sum of all
        exponents is the mean divergence, which is known more exactly.
        """
        zero = [sign == "0" for sign in self.signs]
        values, errors = np.where(zero, 0.0, self.values), np.where(zero, 0.0, self.errors)
        order = np.argsort(-values, kind="stable")
        rest = np.delete(order, np.flatnonzero(np.array(zero)[order])[: self.integrals])
        return kaplan_yorke(values[rest], errors[rest], self.divergence, self.divergence_error)

    def labels(self) -> Labels:
        """Return the running means over time, and the exponents with their errors.

        Returns
        -------
        Labels
            Rates, exponents and errors.
        """
        number = np.arange(1, self.values.size + 1)
        dimension, error = self.dimension
        return Labels(
            {"t": (("t",), self.times), "number": (("number",), number)},
            {
                "rate": (("t", "number"), self.rates),
                "exponent": (("number",), self.values),
                "error": (("number",), self.errors),
            },
            {"t": "T", "rate": "1/T", "exponent": "1/T", "error": "1/T"},
            {
                "system": self.system,
                "level": self.level,
                "status": str(self.status),
                "signs": " ".join(self.signs),
                "divergence": self.divergence,
                "divergence error": self.divergence_error,
                "dimension": dimension,
                "dimension error": error,
                "steps": self.cost.steps,
            },
        )


def kaplan_yorke(values: Array, errors: Array, total: float, total_error: float = 0.0) -> tuple[float, float]:
    """Return the Kaplan–Yorke dimension k + Σ_(i≤k) λ_i/|λ_(k+1)| of exponents and its error.

    Here k is the largest number such that the sum of the first k exponents is ≥ 0.  If that is true of all m exponents,
    to three errors of their sum, the dimension is m, and its error is how far below m it may be.  If the sum is
    negative but the last exponent is 0, the dimension is undefined, and both results are m.

    Parameters
    ----------
    values, errors : ndarray, shape (m,)
        The exponents, the largest first, and their errors.
    total : float
        Their sum, the mean divergence, which is known more exactly than they are.
    total_error : float, default 0.0
        Error of the sum, ≥ 0.

    Returns
    -------
    dimension : float
        The dimension, 0 to m.
    error : float
        Its error, ≥ 0.

    Examples
    --------
    >>> import numpy as np
    >>> from hess_mechanics.dynamics.spectrum import kaplan_yorke
    >>> round(kaplan_yorke(np.array([0.9056, 0.0, -14.572]), np.zeros(3), -13.6667)[0], 3)  # Lorenz
    2.062
    """
    if not values.size:
        return 0.0, 0.0
    sums = np.cumsum(values)
    last = abs(float(values[-1]))
    if total >= -ERRORS * total_error:
        return float(values.size), (abs(total) + total_error) / last if last > 0.0 else 0.0
    if last == 0.0:
        # Volume shrinks although no exponent is negative, so the dimension is undefined.
        return float(values.size), float(values.size)
    k = int(np.argmax(sums < 0.0)) if np.any(sums < 0.0) else values.size - 1
    if k == values.size - 1:
        # The sum of the first m − 1 is the total less the last one.
        return values.size + total / last, math.hypot(total_error, total / last * float(errors[-1])) / last
    before, next_one = float(sums[k - 1]) if k else 0.0, abs(float(values[k]))
    error = math.hypot(float(np.hypot.reduce(errors[:k])) if k else 0.0, before / next_one * float(errors[k]))
    return k + before / next_one, error / next_one


def no_chaos(problem: Problem, start: Array, states: Array, duration: float, level: Level, grows: bool) -> str:
    """Return the reason why a motion is not chaotic, however its neighbours part.

    A return of the motion to its start is looked for only if `grows` is True.

    Parameters
    ----------
    problem : Problem
        The equations of motion and their units.
    start : ndarray, shape (d,)
        State at time 0, in scaled units.
    states : ndarray, shape (n, d)
        States at evenly spaced times, in scaled units.
    duration : float
        Time of the last state, in scaled units.
    level : Level
        Accuracy level.
    grows : bool
        True if neighbours part.

    Returns
    -------
    str
        The reason in words: two dimensions, at rest, escaping, or periodic; empty if there is none.
    """
    system, p = problem.system, problem.parameters
    if start.size - len(system.integrals(start.tolist(), p.tolist())) <= 2:
        return "flows of two dimensions have no chaos"
    with np.errstate(all="ignore"):
        rates = system.rates(states[-(len(states) // 4) - 1 :], p)
    if float(np.abs(rates).max()) < _RESTS:
        return "it rests"
    half = len(states) // 2
    if float(np.abs(states[half:]).max()) > _ESCAPES * float(np.abs(states[:half]).max(initial=1.0)):
        return "it escapes"
    if grows:
        ahead = np.array(system.field(start.tolist(), p.tolist()), float)
        across = ahead / max(float(np.linalg.norm(ahead)), 1e-300)
        times, returns = np.empty(_RETURNS), np.empty((_RETURNS, start.size))
        longest = system.longest_step(level, duration)
        plane = across, float(across @ start), 0, duration
        number, _ = system.crossing(start, p, *plane, level.order, level.tolerance, longest, MAX_STEPS, times, returns)
        # The first crossing may be the start itself.
        away = np.abs(returns[: max(number, 0)] - start).max(axis=1)
        if np.any(away[np.abs(times[: max(number, 0)]) > _RESTS] < _RESTS):
            return "it is periodic"
    return ""


def lyapunov_exponent(body: Body, start: Sequence[float], duration: float, accuracy: Accuracy = STANDARD) -> Exponent:
    """Return the largest Lyapunov exponent of an orbit.

    Parameters
    ----------
    body : Body
        The body.
    start : array_like, shape (d,)
        Initial state.
    duration : float
        Time, nonzero, in units of the problem; negative: backward.
    accuracy : str or Level, default "standard"
        Accuracy level.  A named level means its `Plan` for exponents.

    Returns
    -------
    Exponent
        The running estimates, in 1/T.

    Raises
    ------
    InvalidParameter
        If a number is not finite, or the duration is 0.
    WorkLimit
        If the time span is too long, or the orbit needs too many steps.
    MotionEnds
        If the motion ends before.

    References
    ----------
    G. Benettin, L. Galgani, J.-M. Strelcyn, Kolmogorov entropy and numerical experiments, Phys. Rev. A 14
    (1976).

    Examples
    --------
    >>> from hess_mechanics import lyapunov_exponent, systems
    >>> suslov = systems()["suslov"]
    >>> float(lyapunov_exponent(*suslov.example_motion, 50.0).times[-1])
    50.0
    """
    level = plan(Kind.EXPONENT, accuracy).level
    span = as_duration(duration, "a Lyapunov exponent")
    problem = Problem.of(body, [start])
    samples = abs(span) / _INTERVAL * problem.nu
    if not samples <= MAX_SAMPLES:
        raise WorkLimit(
            f"This takes {plain(samples, 3)} samples of the growth, but at most {MAX_SAMPLES} are allowed: choose a "
            "shorter time span."
        )
    count = max(1, math.ceil(samples))
    times = span * np.arange(1, count + 1) / count
    state = problem.states[0]
    motion = tangent(problem, state, generic_direction(state.size), problem.times(times), level, LONGEST)
    rates = motion.lengths[:, 0] / np.abs(times)
    require_finite_rates(rates)
    later = rates[count // 2 :]
    reason = no_chaos(problem, state, motion.states, span * problem.nu, level, True)
    return Exponent(as_read_only(np.abs(times)), as_read_only(rates), float(later.max() - later.min()), reason)


def lyapunov_spectrum(
    body: Body, start: Sequence[float] | Array, duration: float, accuracy: Accuracy = STANDARD
) -> Spectrum:
    """Return all Lyapunov exponents of an orbit, one for each of the d variables.

    Parameters
    ----------
    body : Body
        The body.
    start : array_like, shape (d,)
        Initial state.
    duration : float
        Time, nonzero, in units of the problem; negative: backward.
    accuracy : str or Level, default "standard"
        Accuracy level.

    Returns
    -------
    Spectrum
        The exponents with their errors.

    Raises
    ------
    InvalidParameter
        If a number is not finite, or the duration is 0.
    WorkLimit
        If the orbit needs too many steps.
    MotionEnds
        If the motion ends before.

    References
    ----------
    G. Benettin, L. Galgani, A. Giorgilli, J.-M. Strelcyn, Lyapunov characteristic exponents for smooth dynamical
    systems, Meccanica 15 (1980).

    Examples
    --------
    >>> from hess_mechanics import lyapunov_spectrum, systems
    >>> suslov = systems()["suslov"]
    >>> lyapunov_spectrum(*suslov.example_motion, 200.0).values.shape
    (5,)
    """
    level = as_level(accuracy)
    as_duration(duration, "Lyapunov exponents")
    begun = time.perf_counter()
    problem, system = Problem.of(body, [start]), body.system
    y, d, end = problem.states[0], len(system.variables), duration * problem.nu
    # Take other columns in general position.
    frame, speed = flow_frame(problem, np.cos(1.0 + np.arange(d * d).reshape(d, d) ** 2), _SLOW)
    ahead = speed > _SLOW
    stretches = _SETTLES + STRETCHES
    part = end / stretches * np.arange(1, _SAMPLES + 1) / _SAMPLES
    count = stretches * _SAMPLES
    growth, volume = np.zeros((count + 1, d)), np.zeros(count + 1)
    steps, i = 0, 0
    where = partial(end_of, problem, y, end)
    while i < count:
        check_limit()
        motion = tangent(problem, y, frame, part, level, LIMIT, ahead, steps, where)
        steps += motion.steps
        if ahead:
            speeds = speed * np.linalg.norm(motion.vectors[:, :, 0], axis=1)
            speed = float(speeds[-1])
            if not speeds.min() > _SLOW:
                # From now on integrate the vector f like all others.
                ahead = False
                continue
        columns, lengths = np.linalg.qr(motion.vectors)
        diagonal = np.abs(np.diagonal(lengths, axis1=1, axis2=2))
        now = slice(i + 1, i + _SAMPLES + 1)
        growth[now] = growth[i] + motion.log_growth + np.log(np.maximum(diagonal, 1e-300))
        volume[now] = volume[i] + motion.volume
        y, frame = motion.states[-1].copy(), columns[-1]
        i += _SAMPLES
    times = abs(duration) * np.arange(count + 1) / count
    first = _SETTLES * _SAMPLES
    together = np.column_stack([growth, volume])
    mean, error = batch_error(together[first:], times[first:])
    # The error of the integration is about one tolerance per step.
    floor = (level.tolerance + 1e-15) * steps / abs(duration)
    order = np.argsort(-mean[:-1], kind="stable")
    rates = growth[1:, order] / times[1:, None]
    require_finite_rates(mean, error, rates)
    worst = float(error.max()) + floor
    plans = PLANS[Kind.EXPONENT]
    promise = plans[level.name].promise * problem.nu if level.name in plans else worst
    number = len(system.integrals(list(start), list(body.parameters)))
    return Spectrum(
        system.name,
        level.name,
        as_read_only(times[1:]),
        as_read_only(rates),
        as_read_only(mean[order]),
        as_read_only(error[order] + floor),
        float(mean[-1]),
        float(error[-1]) + floor,
        number,
        Status.OK if worst <= promise else Status.PROMISE_NOT_MET,
        Cost(steps, (time.perf_counter() - begun) * 1e3),
    )
