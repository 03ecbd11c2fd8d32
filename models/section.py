"""Poincaré sections: the crossings of a plane by one orbit or many, with their errors."""

from __future__ import annotations

import math
import time
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from .accuracy import Level
from .errors import InvalidParameter, WorkLimit
from .orbit import drift_of, require_finite_states, status_of
from .results import Array, Cost, Section, frozen
from .system import Problem, System
from .taylor import STEP_LIMIT_REACHED
from .threads import THREADS, share

__all__ = ["MAX_CROSSINGS", "Plane", "section", "sections"]

MAX_CROSSINGS = 100_000
MAX_STEPS = 10_000_000


@dataclass(frozen=True)
class Plane:
    """normal·y = offset in the space of the states; sense 1: crossed from below, −1: from above, 0: both."""

    normal: tuple[float, ...]
    offset: float = 0.0
    sense: int = 1

    def __post_init__(self) -> None:
        if not (all(map(math.isfinite, self.normal)) and any(self.normal) and math.isfinite(self.offset)):
            raise InvalidParameter("A plane needs a finite normal other than 0 and a finite offset.")
        if self.sense not in (-1, 0, 1):
            raise InvalidParameter("The sense of a crossing is 1 (from below), −1 (from above) or 0 (both).")


def section(system: System, state: Sequence[float] | Array, parameters: Sequence[float], plane: Plane,
            end: float, level: Level, crossings: int = MAX_CROSSINGS) -> Section:
    """The first `crossings` crossings of the plane after t = 0 and up to t = `end` (which may be negative).

    They are roots of the Taylor polynomials of the orbit itself.  The error is measured as in `solve`,
    crossing by crossing; a run that finds other crossings than the more exact one is replaced by it.
    Raises `InvalidParameter`, `WorkLimit`.
    """
    start = time.perf_counter()
    if len(plane.normal) != len(system.variables):
        raise InvalidParameter(f"The normal of the plane has {len(system.variables)} components here.")
    if not math.isfinite(end):
        raise InvalidParameter("The end of the time span must be finite.")
    if not 1 <= crossings <= MAX_CROSSINGS:
        raise WorkLimit(f"The number of crossings lies between 1 and {MAX_CROSSINGS}.")
    problem = Problem.of(system, [state], parameters)
    # In the scaled variables, and with a normal of length 1.
    largest = max(map(abs, plane.normal))
    normal = np.array(plane.normal) / largest * problem.scale
    length = float(np.linalg.norm(normal))
    offset = plane.offset / largest / length
    if not math.isfinite(offset):
        raise InvalidParameter("The offset of the plane is too large beside its normal: choose a smaller one.")
    total = 0

    def run(rung: Level) -> tuple[Array, Array]:
        nonlocal total
        times = np.empty(crossings)
        states = np.empty((crossings, problem.scale.size))
        found, steps = system.cross(
            problem.states[0], problem.parameters, normal / length, offset, plane.sense,
            end * problem.nu, rung.order, rung.tolerance, MAX_STEPS - total, times, states)
        if found == STEP_LIMIT_REACHED:
            raise WorkLimit(f"This section needs more than {MAX_STEPS} steps: choose a shorter time span.")
        total += steps
        require_finite_states(states[:found])
        return times[:found].copy(), states[:found].copy()

    current = level
    coarse_times, coarse = run(current)
    while True:
        tighter = current.tightened()
        fine_times, fine = run(tighter)
        both = min(len(coarse), len(fine))
        safety = 4.0 if current.is_floor else 1.25
        difference = np.abs(coarse[:both] - fine[:both])
        error = safety * float(difference.max(initial=0.0)) + 2e-16
        # One crossing more or less only at the very end of the span.
        extra = np.concatenate((coarse_times[both:], fine_times[both:]))
        same = len(extra) == 0 or (len(extra) == 1 and abs(extra[0] - end * problem.nu) <= 10 * level.promise)
        if (same and error <= level.promise) or current.is_floor:
            break
        current, coarse, coarse_times = tighter, fine, fine_times

    states = coarse * problem.scale
    absolute = safety * float((difference * problem.scale).max(initial=0.0)) + 2e-16 * max(1.0, problem.nu)
    drift = drift_of(system, np.asarray(state, float), states, np.asarray(parameters, float))
    wall_ms = (time.perf_counter() - start) * 1e3
    return Section(system.name, level.name, frozen(coarse_times / problem.nu), frozen(states),
                   status_of(error if same else math.inf, level), absolute, drift, Cost(total, wall_ms))


def sections(system: System, states: Sequence[Sequence[float]] | Array, parameters: Sequence[float], plane: Plane,
             end: float, level: Level, crossings: int = MAX_CROSSINGS, threads: int = THREADS) -> list[Section]:
    """`section` for each row of `states` (n, d), on all cores."""
    starts = np.array(states, float, ndmin=2)
    found: list[Section | None] = [None] * len(starts)

    def part(i: int) -> None:
        found[i] = section(system, starts[i], parameters, plane, end, level, crossings)

    share(part, len(starts), threads)
    return [one for one in found if one is not None]
