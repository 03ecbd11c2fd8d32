"""A section filled with orbits, computed in batches, in addition to the orbits started by clicks."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol, TypeVar

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.parameters import Values, places, written
from hess_explorer.scenes.framework.orbit_batches import OrbitBatch, in_batches
from hess_explorer.scenes.framework.parameters import number, specs_of
from hess_explorer.scenes.framework.part import Host, Part, Start
from hess_explorer.scenes.framework.periodic_search import Closed
from hess_explorer.scenes.framework.scene import State
from hess_explorer.scenes.framework.trial import Trial, section_error
from hess_explorer.scenes.framework.windows import Window, boxed, inside, tidy_window, window_of
from hess_explorer.scenes.framework.work import drift_status, kept_status
from hess_explorer.views import density, layered_section, theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Axes, Layer
from hess_explorer.views.plot import Plot
from hess_explorer.views.section_plane import joined
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.dynamics.shadowing import right_crossings, typical
from hess_mechanics.errors import InvalidParameter, OutsideRegion
from hess_mechanics.numerics.accuracy import Kind, Level, Plan
from hess_mechanics.numerics.results import Array

__all__ = ["FilledSection", "filled_picture", "filled_trial", "orbits_spread", "points_of_each"]

_FEWEST = 20
"""Least number of crossings of each orbit, at any level."""
_COMPARED = 3
"""Batches that are computed twice for an error estimate, in addition to the orbit on show."""
_PERIODS = (2.0 * math.pi, math.inf)
"""Periods of the coordinates: the first is an angle."""
_LARGE = (("orbits", 40.0), ("count", 400.0))
"""Limits of the section for which levels are compared."""

Place = tuple[float, float]


def orbits_spread(default: float, longest: float, most: float) -> Any:
    """Declare the number of orbits that fill a window."""
    return number(
        "n",
        default,
        (0.0, longest),
        1.0,
        bounds=(0.0, most),
        label="Orbits",
        group="Computation",
        doc="Number of orbits spread over the window.",
    )


def points_of_each(default: float) -> Any:
    """Declare the number of crossings of each orbit of a filled section."""
    return number(
        "N",
        default,
        (20.0, 1000.0),
        10.0,
        bounds=(2.0, 4000.0),
        label="Crossings",
        group="Computation",
        doc="Number of points of each orbit.",
    )


class _Filled(PoincareSection, Protocol):
    def spread(self, window: Window, count: int) -> tuple[Start, ...]:
        """Return at most `count` states, spread over the possible part of the window."""

    def impossible(self, window: Window) -> Array:
        """Return cells (m, n) over the window: 1 if no motion is possible."""


class _Periodic(Protocol):
    @property
    def closed(self) -> Closed | None:
        """The periodic orbit shown in place of the last chosen one; None if none is requested or known."""

    @property
    def looking(self) -> bool:
        """True while a requested periodic orbit is not known yet."""


class _Density(Protocol):
    @property
    def tones(self) -> Sequence[Array]:
        """The tone (n, m) of each pixel for each kind of orbits; empty if the density is not shown."""


class _Host(Host, Protocol):
    @property
    def poincare(self) -> _Filled:
        """The section in its coordinates.  Raises `ModelError`."""

    @property
    def orbits(self) -> float:
        """The number of orbits that fill the window."""

    @property
    def count(self) -> float:
        """The number of crossings of each orbit."""

    @property
    def starts(self) -> str:
        """The places of the chosen orbits."""

    @property
    def window(self) -> str:
        """The visible window, as in a link; empty for the whole section."""

    @property
    def impossible_here(self) -> str:
        """The message if no motion is possible in the window."""

    @property
    def periodic_orbit(self) -> _Periodic:
        """The periodic orbit shown in place of the last chosen one."""

    @property
    def density(self) -> _Density:
        """The density shown in place of the points of the orbits that fill the window."""

    def batch(self, starts: tuple[Start, ...], crossings: int, forward: bool, level: Level) -> Task[OrbitBatch]:
        """Return the computation of an `OrbitBatch`: so many crossings of the orbits from these states."""


@dataclass(frozen=True)
class _Chosen:
    """The starts of the orbits chosen by clicks; the last orbit is on show.

    refused : the place chosen for the orbit on show, if no motion is possible there.
    """

    places: Sequence[Place]
    states: Sequence[Start]
    refused: Place | None = None


@dataclass(frozen=True, eq=False)
class FilledSection(Part[_Host]):
    """A section filled with orbits, in addition to those started by clicks; all are computed in batches.

    excuse : the reason why some places have no orbit.
    bounds : the whole section, as places in a link are written; held : the largest numbers of orbits and of crossings
    while a slider is held.
    ways : directions of time, True is forward; later : draw only the later half of the crossings.
    alone : whether a window without points is empty: nothing else is drawn there.
    """

    excuse: str
    bounds: Window
    held: tuple[int, int]
    ways: tuple[bool, ...] = (True,)
    later: bool = False
    alone: bool = True

    @property
    def poincare(self) -> PoincareSection:
        """The section in its coordinates.  Raises `ModelError`."""
        return self.host.poincare

    def shown(self, orbit: Array) -> Array:
        """Return the drawn points (m, 2) of an orbit."""
        return orbit[len(orbit) // 2 :] if self.later else orbit

    def admitted(self, notes: list[str]) -> Values:
        """Return a valid window, and at least one start."""
        default = next(spec.default for spec in specs_of(type(self.host)) if spec.name == "starts")
        return {"window": tidy_window(self.host.window), "starts": self.host.starts or default}

    # ---- what is computed ---------------------------------------------------------------------------------------

    @cached_property
    def frame(self) -> Window:
        """The visible window."""
        (x0, x1), (y0, y1) = self.host.poincare.window
        return window_of(self.host.window, ((x0, y0), (x1, y1)))

    @property
    def wanted(self) -> tuple[int, int]:
        """The number of orbits, and of crossings of each."""
        orbits, crossings = int(self.host.orbits), int(self.host.count)
        if self.work.dragging:
            return min(orbits, self.held[0]), min(crossings, self.held[1])
        return orbits, self.work.plan(Kind.SECTION).part(crossings, _FEWEST)

    def _follow(self, starts: tuple[Start, ...], forward: bool) -> OrbitBatch | None:
        task = self.host.batch(starts, self.wanted[1], forward, self.work.plan(Kind.SECTION).level)
        return self.work.need(task, preview=task if self.work.dragging else None)

    @cached_property
    def picked(self) -> _Chosen:
        """The chosen starts with a motion; if the last one has none, a single other start replaces them all.

        Raises `InvalidParameter` if no motion is possible in the window.
        """
        wanted = places(self.host.starts)
        states, possible = self.host.poincare.states_at(*np.array(wanted).T)
        if possible[-1]:
            kept = np.flatnonzero(possible).tolist()
            return _Chosen([wanted[i] for i in kept], [tuple(map(float, states[i])) for i in kept])
        others = self._spread(max(1, self.wanted[0]))
        if not others:
            raise InvalidParameter(self.host.impossible_here)
        return _Chosen([_place(self.host.poincare.places_of(np.array(others))[0])], [others[0]], wanted[-1])

    @property
    def given(self) -> Start:
        """The initial state of the last chosen orbit."""
        return self.picked.states[-1]

    @property
    def asked_start(self) -> Start:
        """The state at the last chosen place.  Raises `OutsideRegion` if no motion is possible there."""
        place = places(self.host.starts)[-1]
        states, possible = self.host.poincare.states_at(*np.array([place]).T)
        if not possible[0]:
            raise OutsideRegion(f"At {self.at(place)} {self.excuse}: choose another point.")
        return tuple(map(float, states[0]))

    @property
    def aim(self) -> Place:
        """The place of the last chosen orbit."""
        return self.picked.places[-1]

    @property
    def first_chosen(self) -> Place:
        """The place of the first chosen orbit."""
        return self.picked.places[0]

    @property
    def chosen(self) -> Place:
        """The place where the orbit on show starts."""
        closed = self.host.periodic_orbit.closed
        return self.aim if closed is None else _place(closed.orbit.places[0])

    def _spread(self, count: int) -> tuple[Start, ...]:
        return self.work.need(Task(_seeds, self.host.poincare, self.frame, count))

    @cached_property
    def impossible(self) -> Array:
        """Cells (m, n) over the window: 1 if no motion is possible."""
        return self.work.need(Task(_impossible, self.host.poincare, self.frame))

    @cached_property
    def _followed(self) -> tuple[list[OrbitBatch | None], list[OrbitBatch | None]]:
        """Batches of the chosen orbits, computed first, and of those that fill the window; None if not known yet."""
        seeds = self._spread(self.wanted[0])
        own = self.picked.states if self.host.periodic_orbit.closed is None else self.picked.states[:-1]
        return (
            [self._follow((state,), True) for state in own],
            [self._follow(starts, forward) for starts in in_batches(seeds) for forward in self.ways],
        )

    @cached_property
    def _known(self) -> tuple[list[OrbitBatch], list[OrbitBatch]]:
        """The known batches of the chosen orbits, and of those that fill the window."""
        own, others = ([batch for batch in some if batch is not None] for some in self._followed)
        return own, others

    @property
    def batches(self) -> list[OrbitBatch]:
        """The known batches of the orbits that fill the window."""
        return self._known[1]

    def kind(self, first: bool) -> list[Array]:
        """Return the orbits of one kind, with all their points."""
        return [
            orbit
            for batch in self.batches
            for orbit, is_first in zip(batch.orbits, batch.firsts, strict=True)
            if is_first is first
        ]

    @cached_property
    def first(self) -> Array:
        """Points (n, 2) of the orbits of the first kind."""
        return joined(map(self.shown, self.kind(True)))

    @cached_property
    def second(self) -> Array:
        """Points (n, 2) of the orbits of the second kind."""
        return joined(map(self.shown, self.kind(False)))

    def points(self, first: bool) -> Array:
        """Return the points (n, 2) drawn of one kind of orbits: none where their density is shown."""
        found = self.first if first else self.second
        return found[:0] if self.host.density.tones else found

    @cached_property
    def elsewhere(self) -> Array:
        """Points (n, 2) of all orbits, chosen ones too, that are drawn separately."""
        own, others = self._known
        return joined(batch.elsewhere for batch in (*own, *others) if batch.elsewhere is not None)

    @cached_property
    def own(self) -> Array:
        """Points (n, 2) of the chosen orbits."""
        return joined(self.shown(orbit) for batch in self._known[0] for orbit in batch.orbits)

    # ---- accuracy -----------------------------------------------------------------------------------------------

    @property
    def pixels(self) -> tuple[float, ...]:
        """Pixels per unit of each coordinate."""
        return tuple(PIXELS / (high - low) for low, high in zip(*self.frame, strict=True))

    def orbits_at(self, plan: Plan) -> list[Array]:
        """Return all orbits of the section (n, 2), the chosen ones first; computed at once."""
        crossings = plan.part(self.host.count, _FEWEST)
        seeds = self._spread(int(self.host.orbits))
        tasks = [self.host.batch((start,), crossings, True, plan.level) for start in self.picked.states]
        tasks += [
            self.host.batch(some, crossings, forward, plan.level) for some in in_batches(seeds) for forward in self.ways
        ]
        return [orbit for task in tasks for orbit in task.now().orbits]

    @cached_property
    def kept(self) -> tuple[int, int | None] | None:
        """The last crossing right to half a pixel: of the orbit on show, and the median of some others, if any.

        Compares with a second run at a hundredth of the tolerance; None until it is known, and while a slider is held.
        """
        if self.work.dragging or self.host.periodic_orbit.looking or self.host.periodic_orbit.closed is not None:
            return None
        own, around = self._followed
        level = self.work.plan(Kind.SECTION).level.tightened()
        some = [*in_batches(self._spread(self.wanted[0]))][:_COMPARED]
        tasks = [self.host.batch(starts, self.wanted[1], True, level) for starts in ((self.picked.states[-1],), *some)]
        fine: list[OrbitBatch | None] = [self.work.need(task, preview=None) for task in tasks]
        coarse = [own[-1], *around[:: len(self.ways)]]
        counts = [
            right_crossings(one.orbits, other.orbits, self.pixels, _PERIODS)
            for one, other in zip(coarse, fine, strict=False)
            if one is not None and other is not None
        ]
        if len(counts) < len(fine):
            return None
        others = [count for each in counts[1:] for count in each]
        return counts[0][0], typical(others)

    # ---- what is shown ------------------------------------------------------------------------------------------

    def rings(self) -> list[Place]:
        """Return the starts of the chosen orbits within the visible window."""
        return inside([*self.picked.places[:-1], self.chosen], self.frame)

    def nothing_seen(self) -> str:
        """Return the message for a window without points, once all are computed; else an empty string."""
        (x0, y0), (x1, y1) = self.frame
        if (
            self.work.dragging
            or self.work.todo
            or not self.alone
            or self.host.density.tones
            or any(
                np.any((x >= x0) & (x <= x1) & (y >= y0) & (y <= y1))
                for x, y in (points.T for points in (self.first, self.second, self.own))
            )
        ):
            return ""
        return "None of the points lies in this window: choose more crossings, or press Undo"

    def start_here(self, x: float, y: float) -> Values:
        """Return the starts with another orbit added at (x, y)."""
        return {"starts": written([*self.picked.places, self._inside(x, y)])}

    def start_at(self, x: float, y: float) -> Values:
        """Return the starts with the orbit on show moved to (x, y)."""
        return {"starts": written([*places(self.host.starts)[:-1], self._inside(x, y)])}

    def _inside(self, x: float, y: float) -> Place:
        (x0, y0), (x1, y1) = self.bounds
        return min(max(x, x0), x1), min(max(y, y0), y1)

    def look_closer(self, corners: tuple[float, float, float, float]) -> Values:
        """Return the window that a box selects."""
        return boxed(corners, self.bounds)

    def at(self, place: Place) -> str:
        """Return a place in words."""
        names = self.host.poincare.names
        return ", ".join(f"{name} = {digits(value)}" for name, value in zip(names, place, strict=True))

    def notes(self) -> Iterator[str]:
        """Yield a note if no motion is possible at the chosen start."""
        if self.picked.refused is not None:
            yield (
                f"At {self.at(self.picked.refused)} {self.excuse}: the chosen orbit starts at "
                f"{self.at(self.picked.places[0])}."
            )

    def status(self) -> Iterator[str]:
        """Yield the size and drift of the section, and the accuracy of the orbit on show."""
        if self.asked("_known"):
            yield f"section {len(self.first) + len(self.second) + len(self.own)} points"
            yield from drift_status(batch.drift for batch in self.batches)
            yield from kept_status(self.kept, self.wanted[1])


S = TypeVar("S", bound=State)


def _place(found: Array) -> Place:
    return float(found[0]), float(found[1])


def filled_trial(of: Callable[[S], FilledSection]) -> Trial[S]:
    """Return the trial of the section, computed at each level."""

    return Trial(
        Kind.SECTION,
        ("section",),
        lambda s, plan: of(s).orbits_at(plan),
        lambda s, orbits, truth: section_error(orbits, truth, of(s).pixels, _PERIODS),
        most=_LARGE,
    )


def filled_picture(
    of: Callable[[S], FilledSection],
    full: Window,
    title: str | Callable[[S], str],
    caption: Callable[[S], Caption],
    axes: tuple[str, str],
    labels: tuple[str, str],
    dot: tuple[str, str] | None = None,
    under: tuple[Layer[S], ...] = (),
    between: tuple[Layer[S], ...] = (),
    over: tuple[Layer[S], ...] = (),
) -> Plot[S]:
    """Return the picture of a filled section.

    full : the whole section; labels : labels of the two kinds of orbits; under, over : layers below and above all
    points; between : as in `layered_section.layers`.
    """
    (x0, y0), (x1, y1) = full
    return Plot(
        name="section",
        title=title,
        caption=caption,
        axes=axes,
        dot=dot,
        message=lambda s: of(s).nothing_seen(),
        x=lambda s: (of(s).frame[0][0], of(s).frame[1][0]),
        y=lambda s: (of(s).frame[0][1], of(s).frame[1][1]),
        first=Axes((x0, x1), (y0, y1)),
        on_click=lambda s, x, y: of(s).start_here(x, y),
        starts=True,
        on_box=lambda s, corners: of(s).look_closer(corners),
        layers=(
            *under,
            *density.layers(
                lambda s: of(s).host.density.tones, lambda s: of(s).frame, labels, (theme.ORBIT, theme.UNSTABLE)
            ),
            *layered_section.layers(
                lambda s: of(s).points(True),
                lambda s: of(s).points(False),
                lambda s: of(s).own,
                chosen=lambda s: of(s).rings(),
                impossible=lambda s: of(s).impossible,
                window=lambda s: of(s).frame,
                labels=labels,
                between=between,
            ),
            *over,
        ),
    )


def _seeds(section: _Filled, window: Window, count: int) -> tuple[Start, ...]:
    return section.spread(window, count)


def _impossible(section: _Filled, window: Window) -> Array:
    return section.impossible(window)
