"""Integrate one orbit at given times, with a measured error."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from hess_mechanics.dynamics.system import Body, Problem, System
from hess_mechanics.errors import InvalidParameter, MotionEnds, WorkLimit
from hess_mechanics.numerics.accuracy import PRECISE, Accuracy, Level
from hess_mechanics.numerics.arguments import as_integer, as_level
from hess_mechanics.numerics.field_values import Undefined
from hess_mechanics.numerics.measured import measured
from hess_mechanics.numerics.results import Array, Orbit, as_read_only
from hess_mechanics.numerics.taylor_kernels import STEP_LIMIT_REACHED, STOPPED
from hess_mechanics.parameters import plain

__all__ = [
    "ESCAPED",
    "LARGEST",
    "MAX_SAMPLES",
    "MAX_STEPS",
    "as_duration",
    "as_max_step",
    "as_max_steps",
    "as_times",
    "drift_of",
    "drifts_along",
    "end_error",
    "end_of",
    "precise_run",
    "require_finite_neighbours",
    "require_finite_rates",
    "require_finite_states",
    "require_steps",
    "solve",
]

MAX_STEPS = 2_000_000
"""Largest number of steps, unless another limit is given."""
MAX_SAMPLES = 200_000
_MOST_STEPS = 2**62
ESCAPED, _SHOWN = 1e9, 6
"""Size from which a variable escapes, in units in which the start is O(1); number of variables in a message."""
LARGEST = 10.0
"""Largest size of a variable, in the same units, in the states that are kept of a motion that ends early."""
_AHEAD = 1e-9
"""Time after the end of a motion, in scaled units, at which the field is evaluated to find the reason."""
_SHORTEST = 1e-290
"""Shortest time span for rates: divided by a shorter one, the round-off of a zero overflows."""


def as_times(times: float | Sequence[float] | Array) -> Array:
    """Return a validated copy of times.

    Parameters
    ----------
    times : float or array_like, shape (n,)
        Times, monotonic from 0 forward or backward; equal times are allowed.

    Returns
    -------
    ndarray, shape (n,)
        The times; n = 1 for a single number.

    Raises
    ------
    InvalidParameter
        If there is no time, a time is not finite, or the times are not one-dimensional or not monotonic from 0.
    WorkLimit
        If there are more than 200 000 times.
    """
    t = np.array(times, dtype=float, ndmin=1)
    if t.ndim != 1 or t.size == 0 or not np.all(np.isfinite(t)):
        raise InvalidParameter("The times are empty, not finite or not a list: give one or more finite numbers.")
    if t.size > MAX_SAMPLES:
        raise WorkLimit(f"{t.size} times are too many: choose at most {MAX_SAMPLES}.")
    before = np.concatenate(([0.0], t[:-1]))
    if np.any(t < before) and np.any(t > before):
        raise InvalidParameter("The times are not monotonic: give increasing times from 0 on, or decreasing ones.")
    return t


def as_duration(duration: float, what: str) -> float:
    """Return a validated duration.

    Parameters
    ----------
    duration : float
        Duration, nonzero; negative for backward in time.
    what : str
        Name of the quantity that needs it, for the message.

    Returns
    -------
    float
        The duration.

    Raises
    ------
    InvalidParameter
        If the duration is 0, shorter than 1e-290 or not finite.
    """
    if not _SHORTEST <= abs(duration) < math.inf:
        raise InvalidParameter(
            f"The time span of {what} is {duration:g}, and must be finite and at least {_SHORTEST:g}: choose one such "
            "as 100, or -100 for backward motion."
        )
    return float(duration)


def require_steps(steps: int, too_long: str, where: Callable[[], WorkLimit | None] = lambda: None) -> None:
    """Raise an error if a kernel did not reach its last time.

    Parameters
    ----------
    steps : int
        Steps of the kernel, or one of its negative codes.
    too_long : str
        Message for a kernel that ran out of steps.
    where : callable, optional
        Function that returns the error of a motion that stopped, or None if only a neighbour stopped.  By default the
        error is a `MotionEnds` that gives no state.

    Raises
    ------
    WorkLimit
        If the kernel ran out of steps.
    MotionEnds
        If the motion or a neighbour stopped; the error of `where` may also be a plain `WorkLimit`.
    """
    if steps == STEP_LIMIT_REACHED:
        raise WorkLimit(too_long)
    if steps == STOPPED:
        raise where() or MotionEnds(
            "The motion or a neighbour exceeds the range of double precision, escapes to infinity or reaches a state "
            "without finite rates: choose a shorter time span or less extreme parameters."
        )


def end_of(problem: Problem, state: Array, end: float) -> WorkLimit | None:
    """Return the error of a motion that stops before a given time.

    Parameters
    ----------
    problem : Problem
        The equations of motion and their units.
    state : ndarray, shape (d,)
        State at time 0, in scaled units.
    end : float
        Time, in scaled units.

    Returns
    -------
    WorkLimit or None
        The error; None if the motion reaches that time.
    """
    steps, reached, out = precise_run(problem, state, np.array([end]))
    return end_error(problem, steps, reached, out[0], MAX_STEPS) if steps < 0 else None


def precise_run(problem: Problem, state: Array, times: Array) -> tuple[int, float, Array]:
    """Return one run of a motion at the level `precise`, in scaled units.

    Parameters
    ----------
    problem : Problem
        The equations of motion and their units.
    state : ndarray, shape (d,)
        State at time 0.
    times : ndarray, shape (n,)
        Times, monotonic from 0.

    Returns
    -------
    steps : int
        Number of steps, or a negative code if the motion stopped.
    end : float
        Time reached.
    states : ndarray, shape (n, d)
        The states.  If the motion stopped, the row of the next time holds its last state, and later rows are 0.
    """
    system, out = problem.system, np.zeros((times.size, state.size))
    longest = system.longest_step(PRECISE, float(times[-1]))
    p, order, tolerance = problem.parameters, PRECISE.order, PRECISE.tolerance
    return *system.orbit(state, p, times, order, tolerance, longest, MAX_STEPS, out), out


def end_error(problem: Problem, code: int, t: float, state: Array, max_steps: int) -> WorkLimit:
    """Return the error of a motion that could not be followed to its end.

    Parameters
    ----------
    problem : Problem
        The equations of motion and their units.
    code : int
        `STEP_LIMIT_REACHED` or `STOPPED`.
    t : float
        Time reached, in scaled units.
    state : ndarray, shape (d,)
        State at that time, in scaled units.
    max_steps : int
        Limit of the number of steps.

    Returns
    -------
    WorkLimit
        The error: a plain `WorkLimit` if the steps were used up, otherwise a `MotionEnds`, whose message gives the time
        reached and the variable or operation that ended the motion.
    """
    system, time = problem.system, t / problem.nu
    at = f"t = {time:.6g}"
    physical = state * problem.scale
    shown = ", ".join(f"{name} = {x:.6g}" for name, x in list(zip(system.variables, physical, strict=True))[:_SHOWN])
    largest = int(np.argmax(np.abs(state)))
    if abs(state[largest]) >= ESCAPED:
        return MotionEnds(
            f"{system.variables[largest]} reached {plain(physical[largest], 3)} at {at}: the motion escapes to "
            "infinity in finite time. Choose a shorter time span.",
            time,
        )
    if code == STEP_LIMIT_REACHED:
        return WorkLimit(
            f"This motion needs more than {max_steps} steps, which reach {at}: choose a shorter time span, longer "
            "steps or a cheaper accuracy."
        )
    rates = np.zeros(state.size)
    try:
        for ahead in (0.0, _AHEAD):
            rates = system.rates_with_rounding(state + ahead * rates, problem.parameters)[0]
    except Undefined as error:
        return MotionEnds(
            f"At {at} the field {error}, where {shown}: choose a shorter time span, another start or less extreme "
            "parameters.",
            time,
        )
    fastest = int(np.argmax(np.abs(rates)))
    return MotionEnds(
        f"At {at} no step is short enough: the rate of {system.variables[fastest]} reached {plain(rates[fastest], 3)} "
        f"or jumps, where {shown}. End the motion before, or find the event with `section` and go on from it with a "
        "system for the next case.",
        time,
    )


def as_max_steps(max_steps: int) -> int:
    """Return a validated limit on the number of steps.

    Parameters
    ----------
    max_steps : int
        The limit, at least 1.

    Returns
    -------
    int
        The limit.

    Raises
    ------
    InvalidParameter
        If the limit is not a positive integer.
    """
    return as_integer("max_steps", max_steps, 1, _MOST_STEPS)


def as_max_step(max_step: float | None, problem: Problem) -> float:
    """Return the longest step in scaled time.

    Parameters
    ----------
    max_step : float or None
        Longest step in the user's unit of time, positive; None for no limit.
    problem : Problem
        The equations of motion and their units.

    Returns
    -------
    float
        The longest step; ∞ if there is no limit.

    Raises
    ------
    InvalidParameter
        If the step is not positive.
    """
    if max_step is None:
        return math.inf
    if not max_step > 0.0:
        raise InvalidParameter(f"max_step = {max_step:g} is not positive: choose a time such as 0.01.")
    return max_step * problem.nu


def require_finite_states(states: Array) -> None:
    """Raise an error if a state is not finite.

    Parameters
    ----------
    states : ndarray
        The states.

    Raises
    ------
    InvalidParameter
        If a number is not finite.
    """
    if not np.all(np.isfinite(states)):
        raise InvalidParameter("The motion exceeded the range of double precision: choose less extreme parameters.")


def require_finite_neighbours(*results: Array) -> None:
    """Raise an error if the variational equations have overflowed.

    Parameters
    ----------
    *results : ndarray
        Results of the variational equations.

    Raises
    ------
    WorkLimit
        If a number is not finite.
    """
    if not all(np.all(np.isfinite(one)) for one in results):
        raise WorkLimit(
            "Nearby orbits separate beyond the range of double precision: choose a shorter time span, or less "
            "extreme parameters."
        )


def require_finite_rates(*rates: Array | float) -> None:
    """Raise an error if a rate has overflowed.

    Parameters
    ----------
    *rates : ndarray or float
        The rates.

    Raises
    ------
    InvalidParameter
        If a rate is not finite.
    """
    if not all(np.all(np.isfinite(one)) for one in rates):
        raise InvalidParameter(
            "Rates over this time span exceed the range of double precision: choose a longer one, or "
            "less extreme parameters."
        )


def drift_of(system: System, start: Array, states: Array, parameters: Array) -> dict[str, float]:
    """Return the largest drift of each integral along an orbit, see `drifts_along`.

    Parameters
    ----------
    system : System
        The equations of motion.
    start : ndarray, shape (d,) or (n, d)
        Initial state of one orbit or of many.
    states : ndarray, shape (m, d) or (n, m, d)
        States along the orbits.
    parameters : ndarray, shape (q,)
        Parameters of the system.

    Returns
    -------
    dict of str to float
        Largest drift of each integral over all states, by name; 0 without states, NaN if a state is NaN.
    """
    drifts = drifts_along(system, start, states, parameters)
    return {name: float(np.max(drift, initial=0.0)) for name, drift in drifts.items()}


def drifts_along(system: System, start: Array, states: Array, parameters: Array) -> dict[str, Array]:
    """Return the drift |F(y) − F(start)| of each integral F along orbits, relative to |F(start)| if that exceeds 1.

    Parameters
    ----------
    system : System
        The equations of motion.
    start : ndarray, shape (d,) or (n, d)
        Initial state of one orbit or of many.
    states : ndarray, shape (m, d) or (n, m, d)
        States along the orbits.
    parameters : ndarray, shape (q,)
        Parameters of the system.

    Returns
    -------
    dict of str to ndarray, shape (m,) or (n, m)
        Drift of each integral, by name.
    """
    p = list(parameters)
    initial = system.integrals(list(np.moveaxis(start, -1, 0)), p)
    along = system.integrals(list(np.moveaxis(states, -1, 0)), p)
    drift = {}
    for name, value in initial.items():
        origin = np.asarray(value)[..., None]
        drift[name] = np.abs(along[name] - origin) / np.maximum(1.0, np.abs(origin))
    return drift


def solve(
    body: Body,
    start: Sequence[float] | Array,
    times: float | Sequence[float] | Array,
    accuracy: Accuracy = "precise",
    samples: int = 500,
    max_step: float | None = None,
    max_steps: int = MAX_STEPS,
) -> Orbit:
    """Return the orbit of a body from an initial state, with a measured error.

    Parameters
    ----------
    body : Body
        A body of this package, or a system with values of its parameters, `System.at`.
    start : array_like, shape (d,)
        Initial state at time 0: the variables of the body's system, in their order.
    times : float or array_like, shape (n,)
        Times of the result, in units T, monotonic from 0 forward or backward; or a single number, the last time.
    accuracy : str or Level, default "precise"
        Accuracy level: "draft", "standard", "precise", "reference", or a level of your own.
    samples : int, default 500
        Number of evenly spaced times from 0 to the last time, both included, if `times` is a single number; 2 to
        200 000.
    max_step : float, optional
        Longest step, positive, in units T.  By default there is no limit, except that in a field with functions a step
        is never longer than a hundredth of the time span.  Choose `max_step` shorter than the shortest pulse of the
        field: see Notes.
    max_steps : int, default 2 000 000
        Largest number of steps of all runs together.

    Returns
    -------
    Orbit
        The states at these times, with status, error estimate, drift of the integrals and cost.

    Raises
    ------
    InvalidParameter
        If a number is not finite or out of range, the times are not monotonic, or the motion exceeds the range of
        double precision.
    WorkLimit
        If the orbit needs more than `max_steps` steps, or there are more than 200 000 times.
    MotionEnds
        If the motion escapes to infinity, or reaches a state without finite rates.

    Notes
    -----
    Taylor series of high order with adaptive steps.  The orbit is computed twice, the second time with a hundredth of
    the tolerance, other steps, and a start that is moved by a few units in the last place; the difference gives the
    error estimate.  If it exceeds the promise of the level, more exact runs follow, down to the floor of double
    precision: see `numerics.measured`.  If rates are differences of much larger numbers, the second run has rates that
    are wrong by their round-off.

    In a field with functions the series of each step is compared with the field at the end of the step and at one
    point inside, and is shortened until they agree: see `numerics.step_kernels`.  A pulse that is narrower than a step
    and falls between these points is missed, by both runs.  To be sure, choose `max_step` below the width of the
    pulse, and compare with a run of half that step.

    Examples
    --------
    >>> from hess_mechanics import SuslovBody, solve, systems
    >>> result = solve(SuslovBody(2.0, 1.0, 0.3, 0.5, 0.3, -0.5, 1.0), (0.8, -0.4, 0.6, 0.0, 0.8), 10.0)
    >>> result.states.shape, str(result.status), result.variables
    ((500, 5), 'ok', ('ω1', 'ω2', 'γ1', 'γ2', 'γ3'))
    >>> solve(*systems()["suslov"].example_motion, [0.0, 1.0, 2.0], "draft").states.shape
    (3, 5)
    """
    level = as_level(accuracy)
    times = as_times(
        times if np.ndim(times) else np.linspace(0.0, times, as_integer("samples", samples, 2, MAX_SAMPLES))
    )
    problem = Problem.of(body, [start])
    scaled_times = problem.times(times)
    longest = as_max_step(max_step, problem)
    most_steps = as_max_steps(max_steps)
    nearby = problem.perturb()
    problems = [problem, nearby]

    def run(at: Level, spent: int) -> tuple[Array, int]:
        own = problems[at.is_perturbed]
        out = np.empty((times.size, problem.scale.size))
        steps, end = own.system.orbit(
            own.states[0],
            own.parameters,
            scaled_times,
            at.order,
            at.tolerance,
            own.system.longest_step(at, scaled_times[-1], longest),
            most_steps - spent,
            out,
        )
        if steps < 0:
            reached = np.count_nonzero(np.abs(scaled_times) <= abs(end))
            raise end_error(problem, steps, end, out[reached], most_steps)
        require_finite_states(out)
        if not at.is_perturbed:
            problems[1] = nearby.with_rounding(out)
        return out, steps

    result = measured(level, run, lambda one, other: float(np.abs(one - other).max()))
    states = result.result * problem.scale
    drift = drift_of(body.system, np.asarray(start, float), states, np.asarray(body.parameters, float))
    absolute = result.safety * float((np.abs(result.result - result.other) * problem.scale).max()) + 2e-16 * max(
        1.0, problem.nu
    )
    return Orbit(
        body.system.name,
        level.name,
        as_read_only(times),
        as_read_only(states),
        result.status,
        absolute,
        drift,
        result.cost,
        variables=body.system.variables,
        angles=body.system.angles,
    )
