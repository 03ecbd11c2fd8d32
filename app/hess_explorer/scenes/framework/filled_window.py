"""A section whose window is filled with orbits, piece by piece, besides those that clicks start."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, ClassVar, Protocol, Self, TypeVar

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.parameters import Values, places, written
from hess_explorer.scenes.framework import periodic
from hess_explorer.scenes.framework.indicator import Indicated, indicator_layer
from hess_explorer.scenes.framework.one_orbit import Start
from hess_explorer.scenes.framework.trial import Trial, section_error
from hess_explorer.scenes.framework.windows import Window, boxed, inside, tidy_window, window_of
from hess_explorer.scenes.framework.work import drift_status, kept_status
from hess_explorer.views import layered_section
from hess_explorer.views.comparison import Curves, Frame, Marks
from hess_explorer.views.graph import settled_range, thinned
from hess_explorer.views.layers import Axes, Layer
from hess_explorer.views.plot import Plot
from hess_explorer.views.section_plane import joined
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.lyapunov import Exponent, lyapunov_exponent
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.dynamics.shadowing import right_crossings, typical
from hess_mechanics.errors import InvalidParameter, OutsideRegion
from hess_mechanics.numerics.accuracy import Computation, Level, Plan
from hess_mechanics.numerics.results import Array

__all__ = ["EXPONENT", "SECTION", "TURN", "FilledWindow", "OrbitBatch", "filled_window", "in_pieces"]

TURN = 3.14159
"""Half a turn, as a place in a link is written."""

_FEWEST = 20
"""Crossings of each orbit, whatever the level."""
_COMPARED = 3
"""Pieces besides the orbit on show that are computed twice."""
_TOGETHER = 4
"""Orbits that are computed together: few enough for points to arrive soon."""

T = TypeVar("T")
Place = tuple[float, float]


class _Section(PoincareSection, Protocol):
    def spread(self, window: Window, count: int) -> tuple[Start, ...]:
        """At most `count` states, spread over what is possible of the window."""

    def impossible(self, window: Window) -> Array:
        """Cells (m, n) over the window: 1 where no motion is possible."""


@dataclass(frozen=True)
class OrbitBatch:
    """Some orbits: points (n, 2) of each, as they are passed, and of which of two kinds it is; the largest drifts.

    kept : whether all its points lie on its side of the curve that divides the kinds, where there is one;
    elsewhere : those of the points (m, 2) that are drawn apart from the others.
    """

    orbits: tuple[Array, ...]
    firsts: tuple[bool, ...]
    drift: Mapping[str, float]
    kept: tuple[bool, ...] = ()
    elsewhere: Array | None = None


@dataclass(frozen=True)
class _Chosen:
    """Where the orbits of clicks start, the last of which is the one on show.

    refused : the chosen place of that one, where no motion is possible there.
    """

    places: Sequence[Place]
    states: Sequence[Start]
    refused: Place | None = None


class FilledWindow(Indicated):
    """A section whose window is filled with orbits, besides those started by clicks; all come piece by piece.

    The scene declares the parameters that stand here without a value.
    excuse : why at some places no orbit starts.
    full : the whole section; bounds : the same, as places in a link are written; held : how many orbits and crossings
    there are at most while a slider is held.
    """

    orbits: float
    count: float
    long: float
    starts: str
    window: str

    excuse: ClassVar[str]
    full: ClassVar[Window]
    bounds: ClassVar[Window]
    held: ClassVar[tuple[int, int]]

    @property
    @abstractmethod
    def section(self) -> _Section:
        """The section.  Raises `ModelError`."""

    @abstractmethod
    def piece(self, starts: tuple[Start, ...], crossings: int, forward: bool, level: Level) -> Task:
        """What follows these orbits to so many crossings, as a `OrbitBatch`."""

    @property
    @abstractmethod
    def impossible_here(self) -> str:
        """What is said where nothing is possible in the window."""

    @property
    def ways(self) -> tuple[bool, ...]:
        """Whether orbits are followed forward in time, or both forward and backward."""
        return (True,)

    def shown(self, orbit: Array) -> Array:
        """Those points (m, 2) of an orbit that are drawn."""
        return orbit

    def admitted(self, notes: list[str]) -> Self:
        """A window that is one, and at least one start."""
        default: str = type(self).starts
        state: Any = self  # a dataclass only where the scene declares its parameters
        starts = self.starts if places(self.starts) else default
        admitted: Self = replace(state, window=tidy_window(self.window), starts=starts)
        return admitted

    # ---- what is computed ---------------------------------------------------------------------------------------

    @cached_property
    def frame(self) -> Window:
        """What of the section is seen."""
        return window_of(self.window, self.full)

    @property
    def wanted(self) -> tuple[int, int]:
        """How many orbits, and crossings of each."""
        orbits, crossings = int(self.orbits), int(self.count)
        if self.dragging:
            return min(orbits, self.held[0]), min(crossings, self.held[1])
        return orbits, self.plan(Computation.SECTION).part(crossings, _FEWEST)

    def follow(self, starts: tuple[Start, ...], forward: bool) -> OrbitBatch | None:
        """What is known of these orbits."""
        task = self.piece(starts, self.wanted[1], forward, self.plan(Computation.SECTION).level)
        found: OrbitBatch | None = self.work.soon(task.function, *task.arguments)
        return found

    @cached_property
    def picked(self) -> _Chosen:
        """The chosen starts where motions are possible; where the last one is not, another one instead of all.

        Raises `InvalidParameter` where nothing is possible in the window.
        """
        wanted = places(self.starts)
        states, possible = self.section.states_at(*np.array(wanted).T)
        if possible[-1]:
            kept = np.flatnonzero(possible).tolist()
            return _Chosen([wanted[i] for i in kept], [tuple(map(float, states[i])) for i in kept])
        others = self._spread(max(1, self.wanted[0]))
        if not others:
            raise InvalidParameter(self.impossible_here)
        x, y = self.section.places_of(np.array(others))[0]
        return _Chosen([(float(x), float(y))], [others[0]], wanted[-1])

    @property
    def given(self) -> Start:
        """The last of them."""
        return self.picked.states[-1]

    @property
    def start_asked_for(self) -> Start:
        """The last chosen place.  Raises `OutsideRegion` where no motion is possible there."""
        place = places(self.starts)[-1]
        states, possible = self.section.states_at(*np.array([place]).T)
        if not possible[0]:
            raise OutsideRegion(f"At {self.at(place)} {self.excuse}: choose another point.")
        return tuple(map(float, states[0]))

    @property
    def aim(self) -> Place:
        """Its place."""
        return self.picked.places[-1]

    @property
    def chosen(self) -> Place:
        """The place where the orbit on show starts."""
        return self.aim if self.places is None else self.places[0]

    def _spread(self, count: int) -> tuple[Start, ...]:
        return self.work.get(_seeds, self.section, self.frame, count)

    @cached_property
    def impossible(self) -> Array:
        """Cells (m, n) over the window: 1 where no motion is possible."""
        return self.work.get(_impossible, self.section, self.frame)

    @cached_property
    def _followed(self) -> tuple[list[OrbitBatch | None], list[OrbitBatch | None]]:
        """Pieces of the chosen orbits, which come first, and of those all over the window; None where not known yet."""
        seeds = self._spread(self.wanted[0])
        own = self.picked.states if self.closed is None else self.picked.states[:-1]
        return ([self.follow((state,), True) for state in own],
                [self.follow(starts, forward) for starts in in_pieces(seeds) for forward in self.ways])

    @cached_property
    def _known(self) -> tuple[list[OrbitBatch], list[OrbitBatch]]:
        """Those that are known."""
        own, others = ([piece for piece in some if piece is not None] for some in self._followed)
        return own, others

    def sooner(self) -> object:
        """The orbits come before cells are finer."""
        return self.pieces

    @property
    def pieces(self) -> list[OrbitBatch]:
        """What is known of the orbits all over the window."""
        return self._known[1]

    def kind(self, first: bool) -> list[Array]:
        """The orbits of one kind, all their points."""
        return [orbit for piece in self.pieces for orbit, is_first in zip(piece.orbits, piece.firsts, strict=True)
                if is_first is first]

    @cached_property
    def first(self) -> Array:
        """Marks (n, 2) of orbits of the first kind."""
        return joined(map(self.shown, self.kind(True)))

    @cached_property
    def second(self) -> Array:
        """Marks (n, 2) of orbits of the second kind."""
        return joined(map(self.shown, self.kind(False)))

    @cached_property
    def elsewhere(self) -> Array:
        """Marks (n, 2) of all these orbits and of the chosen ones that are drawn apart from the others."""
        own, others = self._known
        return joined(piece.elsewhere for piece in (*own, *others) if piece.elsewhere is not None)

    @cached_property
    def own(self) -> Array:
        """Marks (n, 2) of the chosen orbits."""
        return joined(self.shown(orbit) for piece in self._known[0] for orbit in piece.orbits)

    @cached_property
    def exponent(self) -> Exponent | None:
        """The largest Lyapunov exponent of the orbit on show, when it is known; not while a slider is held.

        That of a periodic orbit is known from its multipliers, see `growth`.
        """
        if self.dragging or self.looking or self.closed is not None:
            return None
        plan = self.plan(Computation.EXPONENT)
        return self.work.later(lyapunov_exponent, self.body, self.start, plan.share * self.long, plan.level)

    # ---- how exact it is ----------------------------------------------------------------------------------------

    @property
    def pixels(self) -> tuple[float, ...]:
        """Pixels of the picture for a unit of each coordinate."""
        return tuple(PIXELS / (high - low) for low, high in zip(*self.frame, strict=True))

    def orbits_at(self, plan: Plan) -> list[Array]:
        """All orbits of the section (n, 2), the chosen ones first, computed here and now."""
        crossings = plan.part(self.count, _FEWEST)
        seeds = self._spread(int(self.orbits))
        tasks = [self.piece((start,), crossings, True, plan.level) for start in self.picked.states]
        tasks += [self.piece(some, crossings, forward, plan.level)
                  for some in in_pieces(seeds) for forward in self.ways]
        return [orbit for task in tasks for orbit in task.now().orbits]

    @cached_property
    def kept(self) -> tuple[int, int | None] | None:
        """Up to which crossing the orbit on show is right to half a pixel, and the median of some others, if any.

        From a second run, with a hundredth of the tolerance; None until it is known, and while a slider is held.
        """
        if self.dragging or self.looking or self.closed is not None:
            return None
        own, around = self._followed
        level = self.plan(Computation.SECTION).level.tightened()
        some = [*in_pieces(self._spread(self.wanted[0]))][:_COMPARED]
        tasks = [self.piece(starts, self.wanted[1], True, level) for starts in ((self.picked.states[-1],), *some)]
        fine: list[OrbitBatch | None] = [self.work.later(task.function, *task.arguments) for task in tasks]
        coarse = [own[-1], *around[:: len(self.ways)]]
        counts = [right_crossings(one.orbits, other.orbits, self.pixels, PERIODS)
                  for one, other in zip(coarse, fine, strict=False) if one is not None and other is not None]
        if len(counts) < len(fine):
            return None
        others = [count for each in counts[1:] for count in each]
        return counts[0][0], typical(others) if others else None

    # ---- what is shown ------------------------------------------------------------------------------------------

    def rings(self) -> list[Place]:
        """Where the chosen orbits start, as far as that is seen."""
        return inside([*self.picked.places[:-1], self.chosen], self.frame)

    def nothing_seen(self) -> str:
        """What is said in the frame where no point lies in it and no more are to come."""
        (x0, y0), (x1, y1) = self.frame
        if self.dragging or self.work.todo or any(
                np.any((x >= x0) & (x <= x1) & (y >= y0) & (y <= y1))
                for x, y in (points.T for points in (self.first, self.second, self.own))):
            return ""
        return "None of the points lies in this window: choose more crossings, or press Undo"

    def start_here(self, x: float, y: float) -> Values:
        """A click: an orbit at (x, y), besides those that there are."""
        return {"starts": written([*self.picked.places, self._inside(x, y)])}

    def start_at(self, x: float, y: float) -> Values:
        """The orbit on show at (x, y), in place of the one there was."""
        return {"starts": written([*places(self.starts)[:-1], self._inside(x, y)])}

    def _inside(self, x: float, y: float) -> Place:
        (x0, y0), (x1, y1) = self.bounds
        return min(max(x, x0), x1), min(max(y, y0), y1)

    def look_closer(self, corners: tuple[float, float, float, float]) -> Values:
        """A box: the new window."""
        return boxed(corners, self.bounds)

    def at(self, place: Place) -> str:
        """A place in words."""
        return ", ".join(f"{name} = {digits(value)}" for name, value in zip(self.names, place, strict=True))

    def notes(self) -> Iterator[str]:
        """A start that is not possible."""
        if self.picked.refused is not None:
            yield (f"At {self.at(self.picked.refused)} {self.excuse}: the chosen orbit starts at "
                   f"{self.at(self.picked.places[0])}.")
        yield from super().notes()

    def status(self) -> Iterator[str]:
        """Size and drift of the section, the orbit on show."""
        if self.known("_known"):
            yield f"section {len(self.first) + len(self.second) + len(self.own)} points"
            yield from drift_status(piece.drift for piece in self.pieces)
            yield from kept_status(self.kept, self.wanted[1])
        yield from super().status()
        yield from self._orbit_status()


W = TypeVar("W", bound=FilledWindow)

PERIODS = (2.0 * math.pi, math.inf)
"""The first coordinate of these sections is an angle."""

_LARGE = {"orbits": 40.0, "count": 400.0}
"""The largest section for which levels are compared."""
_LONG = {"long": 2000.0}
"""The same for exponents."""


def _at_most(s: FilledWindow, most: Mapping[str, float]) -> FilledWindow:
    state: Any = s  # a dataclass only where the scene declares its parameters
    less: FilledWindow = replace(state, **{name: min(getattr(s, name), value) for name, value in most.items()})
    return less


def _frame(s: FilledWindow) -> Frame:
    (x0, y0), (x1, y1) = s.frame
    return Frame(Axes((x0, x1), (y0, y1)), s.names)


SECTION: Trial[Any] = Trial(
    Computation.SECTION, ("section",), lambda s, plan: s.orbits_at(plan),
    lambda s, orbits, truth: section_error(orbits, truth, s.pixels, PERIODS),
    lambda s, orbits: Marks(_frame(s), tuple(orbits), PERIODS, crossings=True),
    small=lambda s: _at_most(s, _LARGE))


def _exponent(s: FilledWindow, plan: Plan) -> Exponent:
    return lyapunov_exponent(s.body, s.start, plan.share * s.long, plan.level)


def _over_time(s: FilledWindow, found: Exponent) -> Curves:
    """With room for all but the first tenth of the time."""
    axes = Axes((0.0, s.long), settled_range([found.rates]))
    return Curves(Frame(axes, ("t", "λ")), (np.column_stack(thinned(found.times, found.rates)),))


EXPONENT: Trial[Any] = Trial(
    Computation.EXPONENT, ("exponent",), _exponent,
    lambda s, found, truth: abs(found.value - truth.value) / max(truth.spread, 1e-12), _over_time,
    unit="of what it changes by in the second half of its time", seen=10.0,
    small=lambda s: _at_most(s, _LONG))


def filled_window(title: str | Callable[[W], str], caption: Callable[[W], str], scene: type[W],
                  labels: tuple[str, str], dot: tuple[str, str] | None = None,
                  under: tuple[Layer[W], ...] = (), between: tuple[Layer[W], ...] = ()) -> Plot[W]:
    """The picture of such a section; labels : of the two kinds of orbits; between : as of `layered_section.layers`."""
    (x0, y0), (x1, y1) = scene.full
    return Plot(
        name="section", title=title, caption=caption, axes=scene.names, dot=dot, message=lambda s: s.nothing_seen(),
        x=lambda s: (s.frame[0][0], s.frame[1][0]), y=lambda s: (s.frame[0][1], s.frame[1][1]),
        first=Axes((x0, x1), (y0, y1)),
        on_click=lambda s, x, y: s.start_here(x, y), on_box=lambda s, corners: s.look_closer(corners),
        layers=(*under, indicator_layer(), *layered_section.layers(
            lambda s: s.first, lambda s: s.second, lambda s: s.own, chosen=lambda s: s.rings(),
            impossible=lambda s: s.impossible, window=lambda s: s.frame, labels=labels, between=between),
            *periodic.layers()))


def _seeds(section: _Section, window: Window, count: int) -> tuple[Start, ...]:
    return section.spread(window, count)


def _impossible(section: _Section, window: Window) -> Array:
    return section.impossible(window)


def in_pieces(items: Sequence[T]) -> Iterator[tuple[T, ...]]:
    """As many at a time as are computed together."""
    return (tuple(items[i : i + _TOGETHER]) for i in range(0, len(items), _TOGETHER))
