"""A section with one orbit among others; of the others a few crossings come first."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.indicator import Indicated
from hess_explorer.scenes.framework.trial import Trial, section_error
from hess_explorer.scenes.framework.windows import Window
from hess_explorer.scenes.framework.work import drift_status, kept_status
from hess_explorer.views.comparison import Frame, Marks
from hess_explorer.views.layers import Axes
from hess_explorer.views.section_plane import joined
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.dynamics.section import SectionPoints
from hess_mechanics.dynamics.shadowing import right_crossings, typical
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.accuracy import Computation, Level, Plan
from hess_mechanics.numerics.results import Array

__all__ = ["SECTION", "Crossings"]

_FEW = 30
"""Crossings of each orbit, while a slider is dragged and until all are known."""
_ON = 1e-9
"""A start that is so close to the section, beside its size, is on it."""


@dataclass(frozen=True)
class _Crossed:
    """Crossings of the orbit on show and of the others; None where they are left out, for that reason."""

    own: SectionPoints | None
    others: SectionPoints | None
    reason: str


class Crossings(Indicated):
    """A section with the orbit on show, and others; of the others a few crossings come first.

    The scene declares the parameters that stand here without a value.
    """

    most: ClassVar[int] = 6000
    periods: ClassVar[tuple[float, float]] = (math.inf, math.inf)

    count: float

    @abstractmethod
    def crossing(self, crossings: int, level: Level) -> tuple[Task, Task]:
        """What finds so many crossings of the orbit on show, and of the others."""

    @property
    @abstractmethod
    def section_axes(self) -> Axes:
        """The axes of the picture of the section."""

    @property
    def frame(self) -> Window:
        """All of the picture."""
        (x0, x1), (y0, y1) = self.section_axes.x, self.section_axes.y
        return (x0, y0), (x1, y1)

    def first_shown(self, crossings: int) -> int:
        """Which crossing of an orbit is the first one that is drawn, where the longest orbit has so many."""
        return 0

    @property
    def pixels(self) -> tuple[float, ...]:
        """Pixels of the picture for a unit of each coordinate."""
        return tuple(PIXELS / (high - low) for low, high in (self.section_axes.x, self.section_axes.y))

    @property
    def wanted(self) -> int:
        """How many crossings of each orbit."""
        return self.plan(Computation.SECTION).part(self.count, _FEW)

    @cached_property
    def _crossed(self) -> _Crossed:
        few, whole = (self.crossing(count, self.plan(Computation.SECTION).level) for count in (
            min(self.wanted, _FEW), self.wanted))
        mine = few[0] if self.dragging else whole[0]
        try:
            own: SectionPoints = self.work.get(mine.function, *mine.arguments)
            return _Crossed(own, self.work.sooner(whole[1], few[1]), "")
        except WorkLimit as error:
            return _Crossed(None, None, f"The section is left out: {error}")

    @property
    def reason(self) -> str:
        """Why the section is left out; empty where it is not."""
        return self._crossed.reason

    @cached_property
    def own(self) -> Array | None:
        """Places (n, 2) of the orbit on show; None where the section is left out."""
        return self._places(self._crossed.own) if self.closed is None else self.closed.orbit.places

    def points(self) -> Array | None:
        """The same where it is no periodic one, which has signs of its own."""
        return self.own if self.closed is None else None

    @cached_property
    def aim(self) -> tuple[float, ...] | None:
        """Where the chosen orbit starts, or else first crosses the section."""
        given, points = np.array([self.given]), self._crossed.own
        place = self.section.places_of(given)
        states, there = self.section.states_at(*place.T)
        if not (there[0] and np.abs(states - given).max() < _ON * max(1.0, float(np.abs(given).max()))):
            if points is None or not len(points.states[0]):
                return None
            place = self.section.places_of(points.states[0])
        return tuple(map(float, place[0]))

    @cached_property
    def others(self) -> Array | None:
        """Places (n, 2) of the others; None where the section is left out."""
        return self._places(self._crossed.others)

    def _places(self, points: SectionPoints | None) -> Array | None:
        if points is None:
            return None
        first = self.first_shown(max(map(len, points.states), default=0))
        return joined(self.section.places_of(states[first:]) for states in points.states)

    def orbits_at(self, plan: Plan) -> list[Array]:
        """All orbits of the section (n, 2), that on show first, computed here and now."""
        tasks = self.crossing(plan.part(self.count, _FEW), plan.level)
        return [self.section.places_of(states) for task in tasks for states in task.now().states]

    @cached_property
    def kept(self) -> tuple[int, int | None] | None:
        """Up to which crossing the orbit on show is right to half a pixel, and the median of the others.

        From a second run, with a hundredth of the tolerance; None until it is known, and while a slider is held.
        """
        crossed = self._crossed
        if self.dragging or self.closed is not None or crossed.own is None or crossed.others is None:
            return None
        tight: list[Any] = [self.work.later(task.function, *task.arguments) for task in self.crossing(
            self.wanted, self.plan(Computation.SECTION).level.tightened())]
        if None in tight or self.work.todo:
            # Of the others a few crossings are shown so far.
            return None
        at = self.section.places_of
        own, others = (
            right_crossings([*map(at, coarse.states)], [*map(at, fine.states)], self.pixels, self.periods)
            for coarse, fine in zip((crossed.own, crossed.others), tight, strict=True))
        return own[0], typical(others)

    def status(self) -> Iterator[str]:
        """Size, cost and drift of the section, the orbit on show."""
        found: _Crossed | None = self.known("_crossed")
        if found and found.own and found.others and self.own is not None and self.others is not None:
            steps = found.own.cost.steps + found.others.cost.steps
            yield f"section {len(self.own) + len(self.others)} points, {steps} Taylor steps"
            yield from drift_status((found.own.drift, found.others.drift))
            yield from kept_status(self.kept, self.wanted)
        yield from super().status()
        yield from self._orbit_status()

    def notes(self) -> Iterator[str]:
        """A section that is left out."""
        if self.known("_crossed") and self.reason:
            yield self.reason
        yield from super().notes()


_MOST_COMPARED = 400.0
"""Crossings of each orbit for which levels are compared."""


def _small(s: Crossings) -> Crossings:
    state: Any = s  # a dataclass only where the scene declares its parameters
    less: Crossings = replace(state, count=min(s.count, _MOST_COMPARED))
    return less


SECTION: Trial[Any] = Trial(
    Computation.SECTION, ("section",), lambda s, plan: s.orbits_at(plan),
    lambda s, orbits, truth: section_error(orbits, truth, s.pixels, s.periods),
    lambda s, orbits: Marks(Frame(s.section_axes, s.names), tuple(orbits), s.periods, crossings=True),
    small=_small)
