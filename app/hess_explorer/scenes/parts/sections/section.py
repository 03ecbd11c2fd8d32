"""A Poincaré section with chosen orbits among others."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import Values, points_of
from hess_explorer.scenes.framework.orbit_batches import OrbitBatch, batch_of
from hess_explorer.scenes.framework.part import HasSection, Part, Start
from hess_explorer.scenes.framework.periodic_search import Periodic, Point
from hess_explorer.scenes.framework.sliders import number
from hess_explorer.scenes.framework.windows import Window, normalized_window, pixels_in, window_of
from hess_explorer.scenes.framework.work import accuracy_status, drift_status
from hess_explorer.views.caption import Caption
from hess_explorer.views.plane.section_plane import concatenate
from hess_mechanics.dynamics.return_map import PoincareSection, section_crossings
from hess_mechanics.dynamics.shadowing import count_correct_crossings, lower_median
from hess_mechanics.errors import OutsideRegion, WorkLimit
from hess_mechanics.numerics.accuracy import STANDARD, Kind, Level, Plan
from hess_mechanics.numerics.results import Array

_FEW, _LEAST = 30, 20
"""Largest number of crossings of each orbit during a drag, and until all are known; least number at any level."""
_ON = 1e-9
"""Largest relative distance of a start that counts as on the section."""
_ORBITS, _MOST_STEPS = 20, 100_000
"""Defaults: number of other orbits, and largest number of Taylor steps of each."""
_TRIALS = 3
"""Batches that are computed twice for an error estimate, in addition to the current orbit."""


def crossings_of_each() -> Any:
    """Declare the number of crossings of each orbit."""
    return number(
        "n",
        200.0,
        (50.0, 600.0),
        10.0,
        bounds=(1.0, 1e3),
        label="Crossings of each orbit",
        doc="Number of crossings to compute for each orbit.",
        group="Computation",
    )


def start_on(section: PoincareSection, text: str) -> Start:
    """Return the state (d,) at the last point in a text.

    Raises `OutsideRegion` if no motion crosses the section there, or the text is empty.
    """
    states, there = section.states_at(*np.array(points_of(text)[-1:]).reshape(-1, 2).T)
    if not there.any():
        names = " and ".join(section.names)
        raise OutsideRegion(f"No motion crosses the section at these {names}: choose another point or a larger energy.")
    return tuple(map(float, states[0]))


def crossings_from(
    section: PoincareSection,
    starts: tuple[Start, ...],
    crossings: int,
    forward: bool,
    level: Level,
    max_steps: int = _MOST_STEPS,
) -> OrbitBatch:
    """Return a batch with `crossings` crossings of each orbit from some states; forward orbits are of the first kind.

    Raises `WorkLimit` if an orbit needs more than `max_steps` steps.
    """
    found = section_crossings(section, starts, crossings, level, not forward, max_steps=max_steps)
    return batch_of(section, found, forward)


def _all_over(section: Section) -> list[tuple[Start, ...]]:
    """Return one batch of starts spread over the part of the visible window that motions cross, or none."""
    starts = section.poincare.spread(_ORBITS, section.frame)
    return [starts] if starts else []


Seeds = Callable[["Section"], list[tuple[Start, ...]]]
"""The starts of the other orbits of a section, those of a batch together."""


class _Host(HasSection, Protocol):
    @property
    def count(self) -> float:
        """The number of crossings of each orbit."""

    @property
    def window(self) -> str:
        """The visible window, as in a link; empty for the whole."""

    @property
    def chosen_start(self) -> Start:
        """The chosen initial state.  Raises `ModelError`."""

    @property
    def periodic_orbit(self) -> Periodic:
        """The periodic orbit in place of the chosen orbit."""


@dataclass(frozen=True)
class KnownOrbits:
    """The known orbits of a section.

    Attributes
    ----------
    own_batches : list of OrbitBatch
        Batches of the chosen orbits, one for each; None in place of an unknown batch.
    others : list of OrbitBatch
        Batches of the other orbits; None in place of an unknown batch.
    preview_batches : list of OrbitBatch or None
        Batches with fewer crossings of the other orbits, until all batches are known; otherwise None.
    reason : str
        Reason why the section is omitted; otherwise an empty string.
    """

    own_batches: list[OrbitBatch | None]
    others: list[OrbitBatch | None]
    preview_batches: list[OrbitBatch] | None = None
    reason: str = ""

    @property
    def chosen_batches(self) -> list[OrbitBatch]:
        """The known batches of the chosen orbits."""
        return [batch for batch in self.own_batches if batch is not None]

    @property
    def batches(self) -> list[OrbitBatch]:
        """The known batches of the other orbits, or those with fewer crossings until all are known."""
        return self.preview_batches or [batch for batch in self.others if batch is not None]


@dataclass(frozen=True, eq=False)
class Section(Part[_Host]):
    """A section with chosen orbits among others, computed in batches.

    Attributes
    ----------
    chosen : callable or None
        `chosen()` returns the initial states (d,) of the chosen orbits, by default the given one; the last one is the
        current orbit.
    compute : callable
        `compute(section, starts, crossings, forward, level, max_steps)` returns the `OrbitBatch` of these starts.
    seeds : callable
        `seeds(section)` returns the starts of the other orbits, in batches.
    max_steps : int
        Largest number of Taylor steps of each orbit.
    directions : tuple of bool
        Directions of time of the other orbits; True is forward.
    second_half_only : bool
        True to draw only the second half of the crossings.
    default_window : callable or None
        `default_window()` returns the window of the whole picture; by default that of the section.
    is_immediate : bool
        True to compute the chosen orbits, and a few crossings of the others, before anything is drawn.
    is_exclusive : bool
        True if the window shows nothing else, such as basins.
    """

    chosen: Callable[[], Sequence[Start]] | None = None
    compute: Callable[..., OrbitBatch] = crossings_from
    seeds: Seeds = _all_over
    max_steps: int = _MOST_STEPS
    directions: tuple[bool, ...] = (True,)
    second_half_only: bool = False
    default_window: Callable[[], Window] | None = None
    is_immediate: bool = True
    is_exclusive: bool = True

    @property
    def poincare(self) -> PoincareSection:
        """The section in its coordinates.  Raises `ModelError`."""
        return self.host.poincare

    @property
    def frame(self) -> Window:
        """The visible window."""
        (x0, x1), (y0, y1) = self.poincare.window
        return window_of(
            self.host.window, ((x0, y0), (x1, y1)) if self.default_window is None else self.default_window()
        )

    def corrections(self, notes: list[str]) -> Values:
        """Return the window with sorted corners, the whole for an invalid one."""
        return {"window": normalized_window(self.host.window)} if self.host.window else {}

    @property
    def starts(self) -> Sequence[Start]:
        """The initial states of the chosen orbits; the last one is the current orbit.  Raises `ModelError`."""
        return (self.host.chosen_start,) if self.chosen is None else self.chosen()

    @cached_property
    def start_point(self) -> Point | None:
        """The point where the current orbit starts in the section or first crosses it.

        None without a crossing, or if too many steps are needed.
        """
        start = self.starts[-1]
        try:
            return _first_point(self.poincare, start, lambda: self.work.need(self.batch((start,))))
        except WorkLimit:
            return None

    # ---- the orbits ---------------------------------------------------------------------------------------------

    def batch(
        self, starts: tuple[Start, ...], forward: bool = True, crossings: int = 0, level: Level | None = None
    ) -> Task[OrbitBatch]:
        """Return the task of the orbits from some states; crossings and level are by default those of the picture."""
        plan = self.work.plan(Kind.SECTION)
        how = crossings or self._count, forward, level or plan.level, self.max_steps
        return Task(self.compute, self.poincare, starts, *how)

    def _other_tasks(self, crossings: int = 0, level: Level | None = None) -> list[Task[OrbitBatch]]:
        return [self.batch(starts, way, crossings, level) for starts in self.seeds(self) for way in self.directions]

    @property
    def _count(self) -> int:
        """The number of crossings of each orbit."""
        crossings = self.host.count
        return (
            int(min(crossings, _FEW)) if self.work.is_preview else self.work.plan(Kind.SECTION).part(crossings, _LEAST)
        )

    @cached_property
    def known_orbits(self) -> KnownOrbits:
        """The known orbits; without orbits, but with a reason, if an orbit needs too many steps."""
        states = self.starts if self.host.periodic_orbit.closed_orbit is None else self.starts[:-1]
        held = self.work.is_preview
        try:
            own = [self.batch((state,)) for state in states]
            others = self._other_tasks()
            known = KnownOrbits(
                [self.work.need(task, preview=task if held or self.is_immediate else None) for task in own],
                [self.work.need(task, preview=task if held else None) for task in others],
            )
            if self.is_immediate and None in known.others:
                few = [self.work.need(task) for task in self._other_tasks(min(self._count, _FEW))]
                known = replace(known, preview_batches=few)
        except WorkLimit:
            much = f"{self._count} crossings take an orbit more than {self.max_steps} steps here"
            return KnownOrbits([], [], reason=f"The section is omitted, because {much}: choose fewer crossings.")
        return known

    @cached_property
    def chosen_points(self) -> Array:
        """The drawn points (n, 2) of all chosen orbits that are known."""
        return concatenate(
            self._visible_part(orbit) for batch in self.known_orbits.chosen_batches for orbit in batch.orbits
        )

    @property
    def points_of_each_chosen(self) -> list[Array]:
        """The drawn points (n, 2) of each chosen orbit; no points for an orbit that is not known yet."""
        return [
            concatenate(map(self._visible_part, () if batch is None else batch.orbits))
            for batch in self.known_orbits.own_batches
        ]

    def _visible_part(self, orbit: Array, second_half_only: bool = False) -> Array:
        return orbit[len(orbit) // 2 :] if self.second_half_only or second_half_only else orbit

    def points(self, first: bool = True, ends: bool = False, second_half_only: bool = False) -> Array:
        """Return the drawn points (n, 2) of the other orbits of one kind.

        Parameters
        ----------
        first : bool
            True for the first of two kinds.
        ends : bool
            True for orbits that end early, False for all others.
        second_half_only : bool
            True for only the second half of the crossings, even if all are drawn.
        """
        if (first, ends, second_half_only) not in self._points:
            self._points[first, ends, second_half_only] = concatenate(
                self._visible_part(orbit, second_half_only)
                for batch in self.known_orbits.batches
                for orbit, is_first, reason in zip(batch.orbits, batch.first_kind, batch.reasons, strict=True)
                if (is_first, reason != "") == (first, ends)
            )
        return self._points[first, ends, second_half_only]

    @cached_property
    def _points(self) -> dict[tuple[bool, bool, bool], Array]:
        return {}

    def orbits_at(self, plan: Plan) -> list[Array]:
        """Compute all orbits (n, 2) of the section at once; the chosen ones come first."""
        how = plan.part(self.host.count, _LEAST), plan.level
        tasks = [*(self.batch((state,), True, *how) for state in self.starts), *self._other_tasks(*how)]
        return [orbit for task in tasks for orbit in task.compute().orbits]

    @cached_property
    def _right(self) -> tuple[int, int | None] | None:
        """The number of crossings accurate to half a pixel, of the current orbit and in the median of some others.

        This compares with a second run at a hundredth of the tolerance; None until known, and during a drag.
        """
        periodic, own = self.host.periodic_orbit, self.known_orbits.own_batches
        if self.work.is_preview or periodic.is_searching or periodic.closed_orbit is not None or not own:
            return None
        level, step = self.work.plan(Kind.SECTION).level.tighter(), len(self.directions)
        tasks = [self.batch((self.starts[-1],), level=level), *self._other_tasks(level=level)[::step][:_TRIALS]]
        fine: list[OrbitBatch | None] = [self.work.need(task, preview=None) for task in tasks]
        counts = [
            count_correct_crossings(one.orbits, other.orbits, pixels_in(self.frame), self.poincare.turns)
            for one, other in zip([own[-1], *self.known_orbits.others[::step]], fine, strict=False)
            if one is not None and other is not None
        ]
        if len(counts) < len(fine):
            return None
        return counts[0][0], lower_median([count for each in counts[1:] for count in each])

    # ---- texts --------------------------------------------------------------------------------------------------

    def status(self) -> Iterator[str]:
        """Yield the size, cost and drift of the section, and the accuracy of the current orbit."""
        if self.has_result("known_orbits") and not self.known_orbits.reason:
            known = [*self.known_orbits.chosen_batches, *self.known_orbits.batches]
            points = len(self.chosen_points) + len(self.points()) + len(self.points(False))
            yield f"section {points} points, {sum(batch.steps for batch in known)} Taylor steps"
            yield from drift_status(batch.drift for batch in known)
            yield from accuracy_status(self._right, self._count)

    def notes(self) -> Iterator[str]:
        """Yield the reason why the section is omitted, or why a chosen orbit ends early."""
        if self.has_result("known_orbits"):
            reasons = (reason for batch in self.known_orbits.chosen_batches for reason in batch.reasons)
            yield from filter(None, (self.known_orbits.reason, *reasons))


def section_caption(section: Section) -> Caption:
    """Return the caption of a section: numbers of crossings and of orbits that end early, or why it is omitted."""
    if section.known_orbits.reason:
        return Caption(numbers=section.known_orbits.reason)
    reasons = [reason for batch in section.known_orbits.batches for reason in batch.reasons]
    count = sum(map(bool, reasons))
    ends = f" {count} of {len(reasons)} others end early." if count else ""
    return Caption(
        "The chosen orbit ends early."
        if any(reason for one in section.known_orbits.chosen_batches for reason in one.reasons)
        else "",
        f"{len(section.chosen_points)} crossings of the chosen orbit, {len(section.points())} of others.{ends}",
    )


def _first_point(section: PoincareSection, state: Start, crossed: Callable[[], OrbitBatch]) -> Point | None:
    """Return the point of a state in the section, or of its first crossing; None without a crossing."""
    start = np.array([state])
    point = section.points_of(start)
    states, there = section.states_at(*point.T)
    if not (there[0] and np.abs(states - start).max() < _ON * max(1.0, float(np.abs(start).max()))):
        (point,) = crossed().orbits
    return tuple(map(float, point[0])) if len(point) else None


def first_point(section: PoincareSection, state: Start) -> Point | None:
    """Return the point where a motion starts in the section or first crosses it; None if it never does."""
    return _first_point(section, state, lambda: crossings_from(section, (state,), 1, True, STANDARD))
