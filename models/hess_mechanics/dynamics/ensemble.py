"""Integrate many orbits of one system at given times, on all cores, with error estimates."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from typing import Protocol, TypeVar

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.dynamics.orbit import MAX_STEPS, as_max_step, as_max_steps, as_times, drift_of, end_error
from hess_mechanics.dynamics.system import Body, Problem
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import Accuracy, Level, Status
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.measured import SAFETY, UNSURE, safety_of
from hess_mechanics.numerics.parallel import THREADS, run_in_threads
from hess_mechanics.numerics.results import Array, Cost, Ensemble, as_read_only

__all__ = ["MAX_NUMBERS", "complete", "ensemble", "integrate_many"]

Indices = NDArray[np.int64]

MAX_NUMBERS = 20_000_000
"""Largest number of floats in the result: 160 MB."""

_SHARE = 64
"""Orbits per task: enough to fill the vector lanes, few enough for the threads to finish together."""


def integrate_many(
    kernel: Callable[..., None],
    states: Array,
    parameters: Array,
    times: Array,
    level: Level,
    longest: float,
    max_steps: int,
    threads: int,
) -> tuple[Array, Indices, Array]:
    """Return the states of many orbits at given times, in scaled units.

    An orbit that could not be followed has the negative steps of `taylor_kernels.orbit_integrator`, its last state in
    the row of the next time, and NaN in the rows after it.

    Parameters
    ----------
    kernel : callable
        Kernel of an ensemble, see `System.ensemble`.
    states : ndarray, shape (n, d)
        Initial states.
    parameters : ndarray, shape (q,)
        Parameters of the system.
    times : ndarray, shape (m,)
        Times, monotonic from 0 forward or backward.
    level : Level
        Order and tolerance.
    longest : float
        Longest step.
    max_steps : int
        Largest number of steps of each orbit.
    threads : int
        Number of threads.

    Returns
    -------
    states : ndarray, shape (n, m, d)
        States of the orbits.
    steps : ndarray of int, shape (n,)
        Steps of each orbit; `STEP_LIMIT_REACHED` or `STOPPED` if it could not be followed.
    ends : ndarray, shape (n,)
        Time that each orbit reached.
    """
    count = len(states)
    out, steps, ends = np.full((count, times.size, states.shape[1]), np.nan), np.zeros(count, np.int64), np.zeros(count)

    def part(i: int) -> None:
        own = slice(i * _SHARE, (i + 1) * _SHARE)
        results = out[own], steps[own], ends[own]
        kernel(states[own], parameters, times, level.order, level.tolerance, longest, max_steps, *results)

    run_in_threads(part, -(-count // _SHARE), threads)
    return out, steps, ends


def ensemble(
    body: Body,
    states: Sequence[Sequence[float]] | Array,
    times: Sequence[float] | Array,
    accuracy: Accuracy = "precise",
    threads: int = THREADS,
    max_step: float | None = None,
    max_steps: int = MAX_STEPS,
) -> Ensemble:
    """Return the orbits from several initial states, computed on all cores.

    Errors are measured as in `solve`, orbit by orbit.  Orbits that miss the promise of the level are recomputed with
    smaller tolerances, down to the floor of double precision.  An orbit that cannot be followed to the last time is
    incomplete: its later states are NaN, and `Ensemble.reasons` says why.  The other orbits are not affected.

    Parameters
    ----------
    body : Body
        The body.
    states : array_like, shape (n, d)
        Initial states at time 0.
    times : array_like, shape (m,)
        Times of the result, monotonic from 0 forward or backward.
    accuracy : str or Level, default "precise"
        Accuracy level.
    threads : int, optional
        Number of threads.  By default one per core, at most eight.
    max_step : float, optional
        Longest step, positive, in the unit of time, see `solve`.
    max_steps : int, default 2 000 000
        Largest number of steps of one orbit in one run.

    Returns
    -------
    Ensemble
        States (n, m, d), with a status and an error estimate for each orbit.

    Raises
    ------
    InvalidParameter
        If a number is not finite, the times are not monotonic, there is no initial state, or `max_step` or `max_steps`
        is not positive.
    WorkLimit
        If there are more than 200 000 times, or the result would have more than 20 million numbers.

    Examples
    --------
    >>> from hess_mechanics import ensemble, level, systems
    >>> suslov = systems()["suslov"]
    >>> body, state = suslov.example_motion
    >>> ensemble(body, [state, state], [0.0, 1.0, 2.0], level("precise")).states.shape
    (2, 3, 5)
    """
    level = as_level(accuracy)
    start = time.perf_counter()
    t = as_times(times)
    problem = Problem.of(body, states)
    count, dimension = problem.states.shape
    if count == 0:
        raise InvalidParameter("There are no initial states: give at least one.")
    if count * t.size * dimension > MAX_NUMBERS:
        raise WorkLimit(f"{count} orbits at {t.size} times are too many: choose fewer, for at most 20 million numbers.")
    scaled_times = problem.times(t)

    longest, most_steps = as_max_step(max_step, problem), as_max_steps(max_steps)

    def run(own: Problem, chosen: slice | Indices, at: Level) -> tuple[Array, Indices, Array]:
        system, states, p = own.system, own.states[chosen], own.parameters
        step = system.longest_step(at, scaled_times[-1], longest)
        return integrate_many(system.ensemble, states, p, scaled_times, at, step, most_steps, threads)

    out, steps, reached = run(problem, slice(None), level)
    done = steps >= 0
    problems = problem, problem.perturb().with_rounding(out[done, -1])
    total = int(steps[done].sum())
    errors, scaled_errors = np.full(count, np.inf), np.zeros(count)
    todo = np.flatnonzero(done)
    before, current = out[todo], level
    # Repeat the orbits that still miss the promise, as `measured` does.
    while todo.size:
        tighter = current.tighter()
        finer, more, _ = run(problems[tighter.is_perturbed], todo, tighter)
        total += int(np.maximum(more, 0).sum())
        difference = np.abs(before - finer)
        difference[more < 0] = np.inf
        off = difference.max(axis=(1, 2))
        safety = safety_of(off, scaled_errors[todo])
        scaled_errors[todo] = safety * off + 2e-16
        errors[todo] = safety * (difference * problem.scale).max(axis=(1, 2)) + 2e-16 * max(1.0, problem.nu)
        if not tighter.is_perturbed:
            out[todo] = finer
        if current.is_floor:
            todo = todo[scaled_errors[todo] > UNSURE]
            third, more, _ = run(problems[current.is_perturbed], todo, current.variant())
            total += int(np.maximum(more, 0).sum())
            difference = np.abs(out[todo] - third)
            difference[more < 0] = np.inf
            scaled_errors[todo] = np.maximum(scaled_errors[todo], SAFETY * difference.max(axis=(1, 2)) + 2e-16)
            errors[todo] = np.maximum(errors[todo], SAFETY * (difference * problem.scale).max(axis=(1, 2)))
            break
        missed = scaled_errors[todo] > level.promise
        todo, before, current = todo[missed], finer[missed], tighter

    statuses = [level.status(float(error)) for error in scaled_errors]
    ends, last, reasons = np.full(count, t[-1]), out[:, -1].copy(), [""] * count
    for i in np.flatnonzero(~done):
        row = int(np.count_nonzero(np.abs(scaled_times) <= abs(reached[i])))
        statuses[i], ends[i], last[i] = Status.INCOMPLETE, reached[i] / problem.nu, out[i, row]
        reasons[i] = str(end_error(problem, int(steps[i]), reached[i], last[i], most_steps))
        out[i, row:] = np.nan
    out *= problem.scale
    drift = drift_of(body.system, np.array(states, float, ndmin=2), out, np.asarray(body.parameters, float))
    wall_ms = (time.perf_counter() - start) * 1e3
    return Ensemble(
        body.system.name,
        level.name,
        as_read_only(t),
        as_read_only(out),
        level.status(float(scaled_errors.max())) if done.all() else Status.INCOMPLETE,
        float(errors[done].max(initial=0.0)),
        drift,
        Cost(total, wall_ms),
        body.system.variables,
        as_read_only(errors),
        tuple(statuses),
        as_read_only(ends),
        as_read_only(last * problem.scale),
        tuple(reasons),
        angles=body.system.angles,
    )


class _Several(Protocol):
    @property
    def reasons(self) -> tuple[str, ...]:
        """Reason why each motion is incomplete; empty for one that is complete."""


M = TypeVar("M", bound=_Several)


def complete(motions: M) -> M:
    """Return the given motions if all of them are complete.

    Parameters
    ----------
    motions : M
        Motions with `reasons`, such as an `Ensemble`.

    Returns
    -------
    M
        The same motions.

    Raises
    ------
    WorkLimit
        If a motion is incomplete; the message is the reason of the first such motion.
    """
    reason = next(filter(None, motions.reasons), None)
    if reason is not None:
        raise WorkLimit(reason)
    return motions
