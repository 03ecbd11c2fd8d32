"""Integrate many orbits of one system at given times, on all cores, with error estimates."""

from __future__ import annotations

import time
from collections.abc import Callable, Sequence
from functools import partial

import numpy as np

from hess_mechanics.dynamics.orbit import MAX_STEPS, checked_times, drift_of, require_finite_states, require_steps
from hess_mechanics.dynamics.system import Body, Problem
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import Accuracy, Level
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.measured import safety_of
from hess_mechanics.numerics.parallel import THREADS, share
from hess_mechanics.numerics.results import Array, Cost, Ensemble, frozen

__all__ = ["MAX_NUMBERS", "ensemble"]

MAX_NUMBERS = 20_000_000
"""Largest number of floats in the result: 160 MB."""

_SHARE = 64
"""Orbits per task: enough to fill the vector lanes, few enough for the threads to finish together."""


def integrated(
    kernel: Callable[..., int],
    states: Array,
    parameters: Array,
    times: Array,
    level: Level,
    most_steps: int,
    threads: int,
    too_long: str,
) -> tuple[Array, int]:
    """Return the states (n, m, d) of many orbits at the times (m,), and the number of steps.

    Raises `WorkLimit` with the message `too_long`, and `InvalidParameter`.
    """
    out = np.empty((len(states), times.size, states.shape[1]))
    parts = -(-len(states) // _SHARE)
    steps = np.zeros(parts, int)

    def part(i: int) -> None:
        own = slice(i * _SHARE, (i + 1) * _SHARE)
        steps[i] = kernel(states[own], parameters, times, level.order, level.tolerance, most_steps, out[own])

    share(part, parts, threads)
    require_steps(steps.min(initial=0), too_long)
    require_finite_states(out)
    return out, int(steps.sum())


def ensemble(
    body: Body,
    states: Sequence[Sequence[float]] | Array,
    times: Sequence[float] | Array,
    level: Accuracy = "precise",
    threads: int = THREADS,
) -> Ensemble:
    """Return the orbits from several initial states, computed on all cores.

    Errors are measured as in `solve`, orbit by orbit.  Orbits that miss the promise of the level are recomputed with
    smaller tolerances, down to the floor of double precision.

    Parameters
    ----------
    body : Body
        The body.
    states : array_like, shape (n, d)
        Initial states at time 0.
    times : array_like, shape (m,)
        Times of the result, monotonic from 0 forward or backward.
    level : str or Level, default "precise"
        Accuracy level.
    threads : int, optional
        Number of threads.  By default one per core, at most eight.

    Returns
    -------
    Ensemble
        States (n, m, d), with an error estimate for each orbit.

    Raises
    ------
    InvalidParameter
        If a number is not finite, or the times are not monotonic.
    WorkLimit
        If an orbit needs too many steps, or the result would be too large.

    Examples
    --------
    >>> from hess_mechanics import ensemble, level, systems
    >>> suslov = systems()["suslov"]
    >>> body, state = suslov.example_motion
    >>> ensemble(body, [state, state], [0.0, 1.0, 2.0], level("precise")).states.shape
    (2, 3, 5)
    """
    level = as_level(level)
    start = time.perf_counter()
    t = checked_times(times)
    problem = Problem.of(body, states)
    count, dimension = problem.states.shape
    if count == 0:
        raise InvalidParameter("An ensemble needs at least one initial state.")
    if count * t.size * dimension > MAX_NUMBERS:
        raise WorkLimit(f"{count} orbits at {t.size} times are too many: choose fewer of one or the other.")
    scaled_times = problem.times(t)

    starts = (problem.states, problem.nearby().states)
    run = partial(
        integrated,
        body.system.ensemble,
        parameters=problem.parameters,
        times=scaled_times,
        most_steps=MAX_STEPS,
        threads=threads,
        too_long=f"One of these orbits needs more than {MAX_STEPS} steps: choose a shorter time span.",
    )
    out, total = run(states=starts[level.aside], level=level)
    errors, scaled_errors = np.zeros(count), np.zeros(count)
    todo, before = np.arange(count), out
    current = level
    # As in `measured`, for the orbits that still miss the promise.
    while todo.size:
        tighter = current.tightened()
        found, steps = run(states=starts[tighter.aside][todo], level=tighter)
        total += steps
        difference = np.abs(before - found)
        off = difference.max(axis=(1, 2))
        safety = safety_of(off, scaled_errors[todo])
        scaled_errors[todo] = safety * off + 2e-16
        errors[todo] = safety * (difference * problem.scale).max(axis=(1, 2)) + 2e-16 * max(1.0, problem.nu)
        if not tighter.aside:
            out[todo] = found
        if current.is_floor:
            break
        missed = scaled_errors[todo] > level.promise
        todo, before, current = todo[missed], found[missed], tighter

    out *= problem.scale
    drift = drift_of(body.system, np.array(states, float, ndmin=2), out, np.asarray(body.parameters, float))
    wall_ms = (time.perf_counter() - start) * 1e3
    return Ensemble(
        body.system.name,
        level.name,
        frozen(t),
        frozen(out),
        level.status(float(scaled_errors.max())),
        float(errors.max()),
        drift,
        Cost(total, wall_ms),
        body.system.variables,
        frozen(errors),
    )
