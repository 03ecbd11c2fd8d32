"""Poincaré sections: crossings of a plane or another surface by one orbit or many."""

from __future__ import annotations

import math
import time
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, Protocol

import numpy as np

from hess_mechanics.dynamics.orbit import (
    ESCAPED,
    LARGEST,
    as_max_step,
    as_max_steps,
    drift_of,
    end_error,
    end_of,
    require_finite_states,
)
from hess_mechanics.dynamics.system import Body, Problem, System
from hess_mechanics.errors import InvalidParameter, MotionEnds, WorkLimit
from hess_mechanics.numerics.accuracy import Accuracy, Level
from hess_mechanics.numerics.arguments import as_level
from hess_mechanics.numerics.labelled import Labels, Result, components
from hess_mechanics.numerics.measured import measured
from hess_mechanics.numerics.parallel import THREADS, run_in_threads
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array, Cost, SectionCrossings, angle_facts, as_read_only, unit_of

__all__ = [
    "MAX_CROSSINGS",
    "AnglePlane",
    "Plane",
    "SectionPoints",
    "Surface",
    "section",
    "section_points",
]

MAX_CROSSINGS = 100_000
MAX_STEPS = 5_000_000
_ROOM = 1000
"""Crossings for which memory is allocated at first; few orbits have more."""
_PARTS = 8
"""Time intervals into which a section of many orbits is divided."""
_BEFORE = 1e-6
"""Crossings closer than this to the end of a motion, in units of 1/ν, do not count."""
_SHARE = 4
"""Orbits per task of the thread pool."""


@dataclass(frozen=True)
class Plane:
    """The plane normal·y = offset in state space.

    Parameters
    ----------
    normal : tuple of float, shape (d,)
        Normal vector, nonzero; its length does not matter.
    offset : float, default 0.0
        Value of normal·y on the plane, any finite number.
    sense : {1, -1, 0}, default 1
        Crossings that count: from below (1), from above (−1), or both (0).

    Raises
    ------
    InvalidParameter
        If the normal is zero, the normal or the offset is not finite, or `sense` is not 1, −1 or 0.
    """

    normal: tuple[float, ...]
    offset: float = 0.0
    sense: int = 1

    def __post_init__(self) -> None:
        if not (all(map(math.isfinite, self.normal)) and any(self.normal) and math.isfinite(self.offset)):
            raise InvalidParameter(
                "The normal of the plane is 0, or the normal, value or offset is not finite: give a nonzero normal and "
                "finite numbers."
            )
        if self.sense not in (-1, 0, 1):
            raise InvalidParameter(
                f"sense = {self.sense}: choose 1 (crossings from below), −1 (from above) or 0 (both)."
            )

    def gradient(self, state: Array) -> Array:
        """Return the normal.

        Parameters
        ----------
        state : ndarray, shape (d,)
            Any state; the normal does not depend on it.

        Returns
        -------
        ndarray, shape (d,)
            The normal, as given.
        """
        return np.array(self.normal)

    def crossing_kernel(self, system: System, problem: Problem) -> tuple[Callable[..., tuple[int, int]], Array, float]:
        """Return the crossing kernel of a system, and the plane in the scaled units of a problem.

        Parameters
        ----------
        system : System
            The equations of motion.
        problem : Problem
            The initial states and their units.

        Returns
        -------
        cross : callable
            Kernel that finds the crossings.
        normal : ndarray, shape (d,)
            Normal vector of length 1.
        offset : float
            Offset for this normal, in scaled units.

        Raises
        ------
        InvalidParameter
            If the normal does not have d components, or the offset is too large.
        """
        if len(self.normal) != len(system.variables):
            raise InvalidParameter(
                f"The normal has {len(self.normal)} components: give {len(system.variables)} for {system.title}."
            )
        largest = max(map(abs, self.normal))
        normal = np.array(self.normal) / largest * problem.scale
        length = float(np.linalg.norm(normal))
        offset = self.offset / largest / length
        if not math.isfinite(offset):
            raise InvalidParameter("The offset of the plane is too large for its normal: choose a smaller offset.")
        return system.crossing, normal / length, offset


@dataclass(frozen=True)
class AnglePlane:
    """The planes on which an angle equals a value up to full turns, for stroboscopic sections.

    Parameters
    ----------
    index : int
        Index of the angle among the variables.
    value : float, default 0.0
        The value, any finite number, in radians.
    sense : {1, -1, 0}, default 1
        Crossings that count: with increasing angle (1), with decreasing angle (−1), or both (0).

    Raises
    ------
    InvalidParameter
        If the value is not finite, or `sense` is not 1, −1 or 0.

    Examples
    --------
    >>> import math
    >>> from hess_mechanics import System, section
    >>> from hess_mechanics.dynamics.plane_section import AnglePlane
    >>> turning = System("turning", lambda y, p: (1,), "phase")
    >>> result = section(turning.at(), (0.0,), AnglePlane(0, math.pi), 20.0, "precise")
    >>> [round(t / math.pi, 9) for t in result.times]
    [1.0, 3.0, 5.0]
    """

    index: int
    value: float = 0.0
    sense: int = 1

    def __post_init__(self) -> None:
        # A plane has the same checks of value and sense.
        Plane((1.0,), self.value, self.sense)

    def gradient(self, state: Array) -> Array:
        """Return the gradient of the angle.

        Parameters
        ----------
        state : ndarray, shape (d,)
            Any state.

        Returns
        -------
        ndarray, shape (d,)
            1 for the angle, 0 for the other variables.
        """
        return np.array(np.arange(len(state)) == self.index, float)

    def crossing_kernel(self, system: System, problem: Problem) -> tuple[Callable[..., tuple[int, int]], Array, float]:
        """Return the crossing kernel of a system, and the constants of the planes.

        Parameters
        ----------
        system : System
            The equations of motion.
        problem : Problem
            The initial states and their units.

        Returns
        -------
        cross : callable
            Kernel that finds the crossings.
        constants : ndarray, shape (3,)
            Index of the angle, its scale, and the value in radians.
        offset : float
            0.

        Raises
        ------
        InvalidParameter
            If the system has no variable with this index.
        """
        if self.index not in range(len(system.variables)):
            raise InvalidParameter(
                f"{system.title} has no variable {self.index}: choose 0 to {len(system.variables) - 1}."
            )
        return system.angle_crossing, np.array([self.index, problem.scale[self.index], self.value]), 0.0


class Surface(Protocol):
    """A surface in state space, on which a function of the state has a given value."""

    def gradient(self, state: Array) -> Array:
        """Return the gradient of the function that is constant on the surface.

        Parameters
        ----------
        state : ndarray, shape (d,)
            State on the surface.

        Returns
        -------
        ndarray, shape (d,)
            The gradient.
        """

    @property
    def sense(self) -> int:
        """Crossings that count: those with an increasing function (1), a decreasing one (−1), or both (0)."""

    def crossing_kernel(self, system: System, problem: Problem) -> tuple[Callable[..., tuple[int, int]], Array, float]:
        """Return the crossing kernel of a system, and the surface in the scaled units of a problem.

        Parameters
        ----------
        system : System
            The equations of motion.
        problem : Problem
            The initial states and their units.

        Returns
        -------
        kernel : callable
            Kernel that finds the crossings.
        constants : ndarray
            Constants of the surface, such as a normal, in scaled units.
        offset : float
            Value of the function on the surface, in scaled units.

        Raises
        ------
        InvalidParameter
            If the surface does not fit the system.
        """


@dataclass(frozen=True)
class _Search:
    """Search for crossings by the orbits from `starts` (n, d), in the user's units; `end` and `max_step` are scaled."""

    body: Body
    plane: Surface
    starts: Array
    problem: Problem
    end: float
    level: Level
    crossings: int
    max_step: float
    max_steps: int

    @classmethod
    def of(
        cls,
        body: Body,
        states: Sequence[Sequence[float]] | Array,
        plane: Surface,
        duration: float,
        level: Level,
        crossings: int,
        max_step: float | None,
        max_steps: int,
    ) -> _Search:
        """Return the search with validated arguments and scaled times.  Raises `InvalidParameter`, `WorkLimit`."""
        if not math.isfinite(duration):
            raise InvalidParameter(f"The end of the time span is {duration}: choose a finite number.")
        if not 1 <= crossings <= MAX_CROSSINGS:
            raise WorkLimit(f"crossings = {crossings}: choose a number between 1 and {MAX_CROSSINGS}.")
        problem = Problem.of(body, states)
        if not hasattr(plane, "crossing_kernel"):
            raise InvalidParameter(f"{type(plane).__name__} is not a surface: give one such as Plane(normal, offset).")
        plane.crossing_kernel(body.system, problem)
        starts = np.array(states, float, ndmin=2)
        longest = as_max_step(max_step, problem)
        most = as_max_steps(max_steps)
        return cls(body, plane, starts, problem, duration * problem.nu, level, crossings, longest, most)

    def run(
        self, problem: Problem, start: Array, duration: float, level: Level, spent: int = 0
    ) -> tuple[tuple[Array, Array], int, WorkLimit | None]:
        """Return times and states of the crossings of one orbit, its steps, and the error that ends it or None."""
        cross, normal, offset = self.plane.crossing_kernel(problem.system, problem)
        longest = problem.system.longest_step(level, duration, self.max_step)
        room, total = min(self.crossings, _ROOM), 0
        while True:
            times, states = np.full(room, np.nan), np.zeros((room, self.problem.scale.size))
            number, steps = cross(
                start,
                problem.parameters,
                normal,
                offset,
                self.plane.sense,
                duration,
                level.order,
                level.tolerance,
                longest,
                self.max_steps - spent - total,
                times,
                states,
            )
            ended: WorkLimit | None = None
            if number < 0:
                ended = end_error(self.problem, number, times[-1], states[-1], self.max_steps)
                number = room - 1
            elif np.abs(states[:number]).max(initial=0.0) >= ESCAPED:
                # Round-off has taken the motion past a pole.
                ended = end_of(problem, start, duration)
            if ended is not None:
                if not isinstance(ended, MotionEnds):
                    raise ended
                number = int(np.count_nonzero(np.abs(times[:number]) < abs(ended.time) * self.problem.nu - _BEFORE))
            total += steps
            if ended or number < room or room == self.crossings:
                break
            room = min(self.crossings, 10 * room)
        require_finite_states(states[:number])
        return (times[:number].copy(), states[:number].copy()), total, ended

    def measured(self) -> SectionCrossings:
        """Return the crossings of the first orbit, with an error from a more accurate run with a nearby start."""
        nearby = self.problem.perturb()
        problems = [self.problem, nearby]

        def run(level: Level, spent: int) -> tuple[tuple[Array, Array], int]:
            own = problems[level.is_perturbed]
            crossings, steps, ended = self.run(own, own.states[0], self.end, level, spent)
            if ended is not None:
                raise ended
            if not level.is_perturbed:
                problems[1] = nearby.with_rounding(np.vstack((self.problem.states, crossings[1])))
            return crossings, steps

        result = measured(self.level, run, self._apart)
        (times, scaled), (other_times, others) = result.result, result.other
        both = min(len(scaled), len(others))
        nu, scale = self.problem.nu, self.problem.scale
        states = scaled * scale
        difference = result.safety * np.abs(scaled[:both] - others[:both])
        system, p = self.body.system, np.asarray(self.body.parameters, float)
        return SectionCrossings(
            system.name,
            self.level.name,
            as_read_only(times / nu),
            as_read_only(states),
            result.status,
            float((difference * scale).max(initial=0.0)) + 2e-16 * max(1.0, nu),
            drift_of(system, self.starts[0], states, p),
            result.cost,
            system.variables,
            time_error(result.safety, times, other_times) / nu,
            angles=system.angles,
        )

    def _apart(self, one: tuple[Array, Array], other: tuple[Array, Array]) -> float:
        """Return the difference of the states at the crossings of two runs, ∞ if the crossings do not correspond."""
        (times, states), (other_times, others) = one, other
        both = min(len(states), len(others))
        off = float(np.abs(times[:both] - other_times[:both]).max(initial=0.0))
        # At the very end of the time span, one of the runs may have one more crossing.
        extra = np.concatenate((times[both:], other_times[both:]))
        near = 10.0 * max(self.level.promise, off)
        same = len(extra) == 0 or (len(extra) == 1 and abs(extra[0] - self.end) <= near)
        return float(np.abs(states[:both] - others[:both]).max(initial=0.0)) if same else math.inf


def time_error(safety: float, times: Array, others: Array) -> float:
    """Return the error of the times of crossings, from the times of another run and from their own rounding.

    Parameters
    ----------
    safety : float
        Factor from the difference of two runs to the error.
    times : ndarray, shape (n,)
        Times of one run.
    others : ndarray, shape (m,)
        Times of the other run.

    Returns
    -------
    float
        The error, ≥ 0, in the unit of the times.
    """
    both = min(times.size, others.size)
    off = float(np.abs(times[:both] - others[:both]).max(initial=0.0))
    return safety * off + 4e-16 * float(np.abs(times).max(initial=0.0))


def section(
    body: Body,
    start: Sequence[float] | Array,
    plane: Surface,
    duration: float,
    accuracy: Accuracy,
    crossings: int = MAX_CROSSINGS,
    max_step: float | None = None,
    max_steps: int = MAX_STEPS,
) -> SectionCrossings:
    """Return the crossings of a surface by one orbit.

    Parameters
    ----------
    body : Body
        The body.
    start : array_like, shape (d,)
        Initial state at time 0.
    plane : Plane or Surface
        The surface.
    duration : float
        Time up to which crossings are found, in units of the problem; negative: backward.
    accuracy : str or Level
        Accuracy level.
    crossings : int, default 100 000
        Largest number of crossings, 1 to 100 000; the search ends with the last one.
    max_step : float, optional
        Longest step, positive, in units of the problem, see `solve`.
    max_steps : int, default 5 000 000
        Largest number of steps of all runs together.

    Returns
    -------
    SectionCrossings
        Times and states of the crossings, with status, error estimates and drift of the integrals.

    Raises
    ------
    InvalidParameter
        If a number is not finite, a limit on the steps is not positive, or the surface does not fit the system.
    WorkLimit
        If `crossings` is out of range, or the orbit needs too many steps.
    MotionEnds
        If the motion escapes to infinity, or reaches a state without finite rates.

    Notes
    -----
    The start does not count as a crossing, even if it lies on the surface.

    Crossings are roots of the orbit's own Taylor polynomials.  Errors of states and times are measured as in `solve`,
    crossing by crossing.  The promise and the status of a level are those of the states.  The times have an error of
    their own, which is the larger one along a conservative motion, where it grows with the time: choose a more exact
    level if it is too large.  If two runs find different crossings, the more accurate one is used.

    Examples
    --------
    >>> from hess_mechanics import Plane, level, section, systems
    >>> suslov = systems()["suslov"]
    >>> result = section(*suslov.example_motion, Plane((0.0, 0.0, 0.0, 0.0, 1.0)), 50.0, level("precise"), 5)
    >>> bool(abs(result.states[:, 4]).max() < 1e-9)
    True
    """
    start = np.array(start, float)[None]
    return _Search.of(body, start, plane, duration, as_level(accuracy), crossings, max_step, max_steps).measured()


@dataclass(frozen=True)
class SectionPoints(Result):
    """Crossings of several orbits, each computed once; the result of `section_points`.

    The points lie on the surface and on the levels of the integrals.  There is no error estimate along the orbits,
    which would soon be meaningless for chaotic motions; `section` has one.

    Attributes
    ----------
    states : list of ndarray, shape (n, d)
        States at the crossings of each orbit.
    drift : dict of str to float
        Largest drift of each integral, see `drifts_along`; empty without any crossing.
    cost : Cost
        Steps and time.
    variables : tuple of str, default ()
        Names of the variables.
    reasons : tuple of str, default ()
        Why each motion ends before the time span does, with time and place; empty for the others.
    angles : tuple of str, default ()
        Names of the variables that are angles; they are unwrapped, not reduced to one turn.
    """

    states: list[Array]
    drift: Mapping[str, float]
    cost: Cost
    variables: tuple[str, ...] = ()
    reasons: tuple[str, ...] = ()
    angles: tuple[str, ...] = ()

    def labels(self) -> Labels:
        """Return the variables at all crossings, labelled with the number of the orbit.

        Returns
        -------
        Labels
            The variables over the crossings.
        """
        units = {name: "rad" if name in self.angles else unit_of(name) for name in self.variables}
        return labels_of_orbits(self.variables, self.states, "crossing", units, self.facts | angle_facts(self.angles))

    @property
    def facts(self) -> dict[str, float | str]:
        """The drift of each integral, and the number of steps."""
        return {**{f"drift of {name}": value for name, value in self.drift.items()}, "steps": self.cost.steps}


def labels_of_orbits(
    names: Sequence[str], orbits: Sequence[Array], dim: str, units: Mapping[str, str], facts: Mapping[str, Any]
) -> Labels:
    """Return the points of some orbits, labelled with the number of the orbit.

    Parameters
    ----------
    names : sequence of str
        Names of the k coordinates.
    orbits : sequence of ndarray, shape (n, k)
        Points of each orbit.
    dim : str
        Name of the dimension of the points.
    units : mapping of str to str
        Units of the coordinates, by name.
    facts : mapping of str to object
        Facts about the computation, by name.

    Returns
    -------
    Labels
        The labelled coordinates over all points.
    """
    number = np.repeat(np.arange(len(orbits)), [len(one) for one in orbits])
    points = np.concatenate([np.empty((0, len(names))), *orbits])
    return Labels({"orbit": ((dim,), number)}, components(names, points, dim), units, facts)


def section_points(
    body: Body,
    states: Sequence[Sequence[float]] | Array,
    plane: Surface,
    duration: float,
    accuracy: Accuracy,
    crossings: int,
    threads: int = THREADS,
    max_steps: int = MAX_STEPS,
) -> SectionPoints:
    """Return the crossings of a surface by several orbits, each computed once, for pictures.

    The time span is divided into up to eight parts.  An orbit with less than its share of the crossings in one part
    ends there.  A motion that ends keeps its crossings until its variables are too large for a picture.

    Parameters
    ----------
    body : Body
        The body.
    states : array_like, shape (n, d)
        Initial states at time 0.
    plane : Plane or Surface
        The surface.
    duration : float
        Time up to which crossings are found, in units of the problem; negative: backward.
    accuracy : str or Level
        Accuracy level.
    crossings : int
        Largest number of crossings per orbit, 1 to 100 000.
    threads : int, optional
        Number of threads.  By default one per core, at most eight.
    max_steps : int, default 5 000 000
        Largest number of steps per orbit.

    Returns
    -------
    SectionPoints
        States at the crossings of each orbit.

    Raises
    ------
    InvalidParameter
        If a number is not finite, `max_steps` is not positive, or the surface does not fit the system.
    WorkLimit
        If `crossings` is out of range, or an orbit needs too many steps.

    Examples
    --------
    >>> from hess_mechanics import Plane, level, section_points, systems
    >>> suslov = systems()["suslov"]
    >>> body, state = suslov.example_motion
    >>> plane = Plane((0.0, 0.0, 0.0, 0.0, 1.0))
    >>> section_points(body, [state], plane, 100.0, level("standard"), 5).states[0].shape
    (5, 5)
    """
    level = as_level(accuracy)
    begun = time.perf_counter()
    search = _Search.of(body, states, plane, duration, level, crossings, None, max_steps)
    count = len(search.starts)
    parts = max(1, min(_PARTS, crossings // 10))
    one_part = replace(search, crossings=-(-crossings // parts))
    problem = search.problem.perturb() if level.is_perturbed else search.problem
    results: dict[int, tuple[Array, int]] = {}
    reasons = [""] * count

    def follow(orbit: int) -> tuple[Array, int]:
        pieces: list[Array] = []
        start, steps = problem.states[orbit], 0
        for _ in range(parts):
            check_limit()
            (_, points), taken, ended = one_part.run(problem, start, search.end / parts, level, steps)
            pieces.append(points)
            steps += taken
            if ended is not None:
                reasons[orbit] = str(end_of(search.problem, search.problem.states[orbit], search.end) or ended)
                break
            if len(points) < one_part.crossings:
                break
            start = points[-1]
        points = np.concatenate(pieces)[:crossings]
        if reasons[orbit]:
            points = points[np.logical_and.accumulate(np.abs(points).max(axis=1, initial=0.0) <= LARGEST)]
        return points * search.problem.scale, steps

    refused: list[WorkLimit] = []

    def one(orbit: int) -> None:
        # A single orbit beyond the limit stops the whole section.
        if not refused:
            try:
                results[orbit] = follow(orbit)
            except WorkLimit as error:
                refused.append(error)

    run_in_threads(one, count, threads, _SHARE)
    if refused:
        raise refused[0]
    p = np.asarray(body.parameters, float)
    drifts = [drift_of(body.system, search.starts[i], results[i][0], p) for i in range(count) if len(results[i][0])]
    drift = {name: max(one[name] for one in drifts) for name in (drifts[0] if drifts else ())}
    wall_ms = (time.perf_counter() - begun) * 1e3
    return SectionPoints(
        [as_read_only(results[i][0]) for i in range(count)],
        drift,
        Cost(sum(steps for _, steps in results.values()), wall_ms),
        body.system.variables,
        tuple(reasons),
        body.system.angles,
    )
