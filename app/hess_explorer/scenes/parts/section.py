"""A Poincaré section with the orbit on show and other orbits; a few crossings of the others are computed first."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol, TypeVar

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.parameters import Values, places, written
from hess_explorer.scenes.framework.parameters import number
from hess_explorer.scenes.framework.part import Part, Sectioned, Start
from hess_explorer.scenes.framework.periodic_search import Closed, none_closed
from hess_explorer.scenes.framework.scene import State
from hess_explorer.scenes.framework.trial import Trial, section_error
from hess_explorer.scenes.framework.windows import Window, boxed, tidy_window, window_of
from hess_explorer.scenes.framework.work import drift_status, kept_status
from hess_explorer.views import section_plane
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Axes, Range
from hess_explorer.views.picture import Picture
from hess_explorer.views.plot import Plot
from hess_explorer.views.section_plane import joined
from hess_mechanics.dynamics.cells import evenly
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.dynamics.section import SectionPoints, section_points
from hess_mechanics.dynamics.shadowing import right_crossings, typical
from hess_mechanics.errors import OutsideRegion, WorkLimit
from hess_mechanics.numerics.accuracy import STANDARD, Kind, Level, Plan
from hess_mechanics.numerics.results import Array

__all__ = ["Section", "crossings_of_each", "first_place", "section_picture", "section_trial", "start_on"]

_FEW = 30
"""Crossings of each orbit while a slider is dragged, and until all are known."""
_ON = 1e-9
"""Largest relative distance of a start that counts as on the section."""
_ORBITS, _MOST_STEPS = 20, 100_000
"""Default section: number of other orbits, and largest number of Taylor steps of each."""
_TURNS = 60.0
"""Time limit per crossing, in units of 1/ν times the slowness of the section."""
_MOST_COMPARED = 400.0
"""Largest number of crossings of each orbit for which levels are compared."""


def crossings_of_each() -> Any:
    """Declare the number of crossings of each orbit."""
    return number(
        "n",
        200.0,
        (50.0, 600.0),
        10.0,
        bounds=(1.0, 1e3),
        label="Crossings of each orbit",
        doc="Points for each orbit.",
        group="Computation",
    )


def start_on(section: PoincareSection, text: str) -> Start:
    """Return the state at the last place of a link's text.  Raises `OutsideRegion`, also if there is no place."""
    states, there = section.states_at(*np.array(places(text)[-1:]).reshape(-1, 2).T)
    if not there.any():
        names = " and ".join(section.names)
        raise OutsideRegion(f"No motion crosses the section at this {names}: choose another place, or a larger energy.")
    return tuple(map(float, states[0]))


class _Host(Sectioned, Protocol):
    @property
    def count(self) -> float:
        """The number of crossings of each orbit."""


@dataclass(frozen=True)
class _Crossed:
    """Crossings of the orbit on show and of the others; None if they are left out for that reason."""

    own: SectionPoints | None
    others: SectionPoints | None
    reason: str


@dataclass(frozen=True, eq=False)
class Section(Part[_Host]):
    """A section with the orbit on show and other orbits; a few crossings of the others are computed first.

    start() : the initial state of the chosen orbit, raises `ModelError`.
    crossing(crossings, level) : the computations of so many crossings of the orbit on show, and of the others; by
        default the others are spread over the visible window.
    axes() : the axes of the picture, if it shows more than that window; closed() : the periodic orbit shown in place
        of the chosen one, if any; later : draw only the later half of the crossings.
    zoom : the visible window, as in a link; empty for the whole picture.
    """

    start: Callable[[], Start]
    crossing: Callable[[int, Level], tuple[Task[SectionPoints], Task[SectionPoints]]] | None = None
    axes: Callable[[], Axes] | None = None
    closed: Callable[[], Closed | None] = none_closed
    later: bool = False
    zoom: str = ""

    @property
    def poincare(self) -> PoincareSection:
        """The section in its coordinates.  Raises `ModelError`."""
        return self.host.poincare

    @property
    def given(self) -> Start:
        """The initial state of the chosen orbit.  Raises `ModelError`."""
        return self.start()

    @property
    def whole(self) -> Window:
        """The window of the whole picture."""
        (x0, x1), (y0, y1) = self.poincare.window if self.axes is None else (self.axes().x, self.axes().y)
        return (x0, y0), (x1, y1)

    @property
    def frame(self) -> Window:
        """The visible window."""
        return window_of(self.zoom, self.whole)

    def look_closer(self, corners: tuple[float, float, float, float]) -> Values:
        """Return the window that a box selects."""
        return boxed(corners, self.whole)

    def admitted(self, notes: list[str]) -> Values:
        """Return a valid window."""
        return {"window": tidy_window(self.zoom)} if self.zoom else {}

    @property
    def pixels(self) -> tuple[float, ...]:
        """Pixels per unit of each coordinate."""
        return tuple(PIXELS / (high - low) for low, high in zip(*self.frame, strict=True))

    @property
    def wanted(self) -> int:
        """The number of crossings of each orbit."""
        return self.work.plan(Kind.SECTION).part(self.host.count, _FEW)

    def _tasks(self, crossings: int, level: Level) -> tuple[Task[SectionPoints], Task[SectionPoints]]:
        if self.crossing is not None:
            return self.crossing(crossings, level)
        return (
            Task(_crossings, self.poincare, (self.given,), crossings, level),
            Task(_spread, self.poincare, self.frame, crossings, level),
        )

    @cached_property
    def crossed(self) -> _Crossed:
        """The known crossings."""
        level = self.work.plan(Kind.SECTION).level
        few, whole = (self._tasks(count, level) for count in (min(self.wanted, _FEW), self.wanted))
        mine = few[0] if self.work.dragging else whole[0]
        try:
            own: SectionPoints = self.work.need(mine)
            return _Crossed(own, self.work.need(whole[1], preview=few[1]), "")
        except WorkLimit as error:
            return _Crossed(None, None, f"The section is left out: {error}")

    @property
    def reason(self) -> str:
        """The reason why the section is left out; an empty string if it is not."""
        return self.crossed.reason

    @cached_property
    def own(self) -> Array | None:
        """Places (n, 2) of the orbit on show; None if the section is left out."""
        closed = self.closed()
        return self._places(self.crossed.own) if closed is None else closed.orbit.places

    @property
    def points(self) -> Array | None:
        """Places (n, 2) of the orbit on show; None for a periodic orbit, which has its own marks."""
        return self.own if self.closed() is None else None

    @cached_property
    def aim(self) -> tuple[float, ...] | None:
        """The place where the chosen orbit starts, or else first crosses the section."""
        return _first_place(self.poincare, self.given, lambda: self.crossed.own)

    @cached_property
    def others(self) -> Array | None:
        """Places (n, 2) of the other orbits; None if the section is left out."""
        return self._places(self.crossed.others, False)

    @cached_property
    def ended(self) -> Array | None:
        """Places (n, 2) of the other orbits that end early; None if the section is left out."""
        return self._places(self.crossed.others, True)

    def _places(self, points: SectionPoints | None, ended: bool | None = None) -> Array | None:
        """Return the places of all orbits, or of those that end early or not."""
        if points is None:
            return None
        first = max(map(len, points.states), default=0) // 2 if self.later else 0
        return joined(
            self.poincare.places_of(states[first:])
            for states, reason in zip(points.states, points.reasons, strict=True)
            if ended in (None, reason != "")
        )

    def orbits_at(self, plan: Plan) -> list[Array]:
        """Return all orbits of the section (n, 2), the one on show first; computed at once."""
        tasks = self._tasks(plan.part(self.host.count, _FEW), plan.level)
        return [self.poincare.places_of(states) for task in tasks for states in task.now().states]

    @cached_property
    def kept(self) -> tuple[int, int | None] | None:
        """The last crossing right to half a pixel: of the orbit on show, and the median of the others.

        Compares with a second run at a hundredth of the tolerance; None until it is known, and while a slider is held.
        """
        crossed = self.crossed
        if self.work.dragging or self.closed() is not None or crossed.own is None or crossed.others is None:
            return None
        tight: list[SectionPoints | None] = [
            self.work.need(task, preview=None)
            for task in self._tasks(self.wanted, self.work.plan(Kind.SECTION).level.tightened())
        ]
        if self.work.todo:
            # So far only a few crossings of the others are known.
            return None
        at = self.poincare.places_of
        own, others = (
            right_crossings([*map(at, coarse.states)], [*map(at, fine.states)], self.pixels, self.poincare.turns)
            for coarse, fine in zip((crossed.own, crossed.others), tight, strict=True)
            if fine is not None
        )
        return own[0], typical(others)

    @property
    def caption(self) -> Caption:
        """The caption: the number of crossings, or the reason why the section is left out."""
        if self.own is None or self.others is None:
            return Caption(numbers=self.reason)
        others = self.crossed.others
        count = sum(map(bool, others.reasons)) if others else 0
        ends = f" {count} of {len(others.states)} others end early." if others and count else ""
        return Caption(
            "The chosen orbit ends early." if self.crossed.own and any(self.crossed.own.reasons) else "",
            f"{len(self.own)} crossings of the chosen orbit, {len(self.others)} of others.{ends}",
        )

    def status(self) -> Iterator[str]:
        """Yield the size, cost, drift and accuracy."""
        if self.asked("crossed") and self.crossed.own and self.crossed.others:
            own, others = self.crossed.own, self.crossed.others
            points = sum(len(one) for one in (self.own, self.others) if one is not None)
            yield f"section {points} points, {own.cost.steps + others.cost.steps} Taylor steps"
            yield from drift_status((own.drift, others.drift))
            yield from kept_status(self.kept, self.wanted)

    def notes(self) -> Iterator[str]:
        """Yield the reason why the section is left out."""
        if self.asked("crossed"):
            yield from filter(None, (self.reason, *(self.crossed.own.reasons if self.crossed.own else ())))


def _first_place(
    poincare: PoincareSection, state: Start, crossed: Callable[[], SectionPoints | None]
) -> tuple[float, ...] | None:
    """Return the place of a state on the section, or else of the first crossing; None without one."""
    given = np.array([state])
    place = poincare.places_of(given)
    states, there = poincare.states_at(*place.T)
    if not (there[0] and np.abs(states - given).max() < _ON * max(1.0, float(np.abs(given).max()))):
        points = crossed()
        if points is None or not len(points.states[0]):
            return None
        place = poincare.places_of(points.states[0])
    return tuple(map(float, place[0]))


def first_place(poincare: PoincareSection, state: Start) -> tuple[float, ...] | None:
    """Return the place where the motion of a state starts, or else first crosses the section; None if it does not."""
    return _first_place(poincare, state, lambda: _crossings(poincare, (state,), 1, STANDARD))


def _crossings(
    poincare: PoincareSection, starts: tuple[tuple[float, ...], ...], crossings: int, level: Level
) -> SectionPoints:
    fastest = float(np.max(poincare.system.frequency(np.array(starts).T, np.array(poincare.parameters)), initial=0.0))
    end = _TURNS * crossings * poincare.slowness / (fastest or 1.0)
    return section_points(poincare, starts, poincare.surface, end, level, crossings, most_steps=_MOST_STEPS)


def _spread(poincare: PoincareSection, window: Window, crossings: int, level: Level) -> SectionPoints:
    """Return the crossings of orbits spread over a window of the section, where motions cross it."""
    ways = evenly(8 * _ORBITS - 1).T
    low, high = np.array(window)
    states, there = poincare.states_at(*(low + ways * (high - low)).T)
    return _crossings(poincare, tuple(map(tuple, states[there][:_ORBITS].tolist())), crossings, level)


S = TypeVar("S", bound=State)


def section_picture(of: Callable[[S], Section], start: str) -> Picture[S]:
    """Return the picture of a section, in which a click sets the start of the orbit.

    start : the name of the parameter that holds its place, see `places`.
    """

    def range_of(axis: int) -> Callable[[S], Range]:
        return lambda s: (of(s).frame[0][axis], of(s).frame[1][axis])

    def names(s: S) -> tuple[str, str]:
        first, second = of(s).poincare.names
        return first, second

    return Plot(
        name="section",
        title="Poincaré section",
        caption=lambda s: of(s).caption,
        axes=names,
        x=range_of(0),
        y=range_of(1),
        message=lambda s: of(s).reason,
        on_click=lambda s, x, y: {start: written([(x, y)])},
        starts=True,
        layers=section_plane.layers(lambda s: of(s).points, others=lambda s: of(s).others, ended=lambda s: of(s).ended),
    )


def section_trial(of: Callable[[S], Section]) -> Trial[S]:
    """Return the trial of the section, computed at each level."""
    return Trial(
        Kind.SECTION,
        ("section",),
        lambda s, plan: of(s).orbits_at(plan),
        lambda s, orbits, truth: section_error(orbits, truth, of(s).pixels, of(s).poincare.turns),
        most=(("count", _MOST_COMPARED),),
    )
