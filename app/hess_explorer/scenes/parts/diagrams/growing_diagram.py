"""An orbit diagram of a section over one parameter, computed piece by piece."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product
from typing import Protocol

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.protocol.specs import Values, written
from hess_explorer.protocol.specs import places as points_of
from hess_explorer.scenes.framework.families import Begin, Family
from hess_explorer.scenes.framework.part import Part, Sectioned, Start
from hess_explorer.scenes.framework.periodic_search import NONE, PERIODS
from hess_explorer.scenes.framework.sliders import TURN, choice, specs_of
from hess_explorer.scenes.framework.windows import Window, tidy_window, window_of
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Range
from hess_explorer.views.plane.section_plane import joined
from hess_explorer.views.text import digits
from hess_mechanics.chaplygin_ball.ball_section import BallSection
from hess_mechanics.dynamics.orbit_diagram import Cascade, Diagram, doubling_seen
from hess_mechanics.dynamics.parameter_diagram import diagram, doublings, nearest_place
from hess_mechanics.errors import OutsideRegion
from hess_mechanics.numerics.accuracy import Accuracy, Kind, plan
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov.suslov_section import SuslovSection

__all__ = [
    "ANEW",
    "BACKWARD",
    "BOUNDS",
    "COORDINATES",
    "FALLING",
    "FARTHEST",
    "FOLLOWED",
    "RISING",
    "WAYS",
    "OrbitDiagram",
    "parameter_of_diagram",
]

COORDINATES = ("ψ", "δ")
RISING, FALLING, BACKWARD = "rising", "falling", "backward"
WAYS = {
    "there and back, and backward in time": (RISING, FALLING, BACKWARD),
    "there and back": (RISING, FALLING),
    "there, and backward in time": (RISING, BACKWARD),
}
FOLLOWED, ANEW = "where it was at the value before", "at the chosen place"
FARTHEST = (-1e3, 1e3)
BOUNDS = ((FARTHEST[0], -TURN), (FARTHEST[1], TURN))
_TOGETHER = 30
"""Values of the parameter computed at once: few enough that points arrive soon."""
_FEW = 30
"""Largest number of values while a slider is held."""
_DOUBLINGS = 4
_GLANCES = 12
"""Values of the parameter from which the vertical range is taken."""
_BOTH = 2.5
"""Largest height of attractor and repeller together, in heights of the attractor, at which both are in sight."""
_FEW_FAR = 0.05
"""Share of these values that do not count."""
_ROOM, _LEAST = 0.1, 0.01
"""Room above and below, in heights of what is there, and at least in those of the section."""


def parameter_of_diagram(symbols: tuple[str, ...], default: str) -> str:
    """Declare the control that selects the parameter of the diagram."""
    declared: str = choice(
        "Parameter of the diagram",
        symbols,
        default,
        doc="Parameter on the horizontal axis; all others keep their values.",
    )
    return declared


class _Host(Sectioned, Protocol):
    @property
    def poincare(self) -> SuslovSection | BallSection:
        """The section γ3 = 0.  Raises `ModelError`."""

    @property
    def symbols(self) -> Mapping[str, str]:
        """The symbol of each parameter of the section → its name."""

    @property
    def along(self) -> str: ...

    @property
    def first(self) -> float: ...

    @property
    def last(self) -> float: ...

    @property
    def shown(self) -> str: ...

    @property
    def ways(self) -> str: ...

    @property
    def begins(self) -> str: ...

    @property
    def steps(self) -> float: ...

    @property
    def transient(self) -> float: ...

    @property
    def count(self) -> float: ...

    @property
    def window(self) -> str: ...

    @property
    def branch(self) -> str: ...

    @property
    def chosen(self) -> str: ...


@dataclass(frozen=True, eq=False)
class OrbitDiagram(Part[_Host]):
    """The points to which the orbits of a section settle, over one of its parameters."""

    def admitted(self, notes: list[str]) -> Values:
        """Return a valid window within the diagram, a place, and the edges in order."""
        first, last = sorted((self.host.first, self.host.last))
        if first == last:
            first = min(first, FARTHEST[1] - 1.0)
            last = first + 1.0
        default = next(one.default for one in specs_of(type(self.host)) if one.name == "chosen")
        window = tidy_window(self.host.window)
        (x0, _), (x1, _) = window_of(window, ((first, 0.0), (last, 0.0)))
        return {
            "first": first,
            "last": last,
            "chosen": self.host.chosen or default,
            "window": window if x0 < last and x1 > first else "",
        }

    @property
    def poincare(self) -> SuslovSection | BallSection:
        """The section in its coordinates.  Raises `ModelError`."""
        return self.host.poincare

    @cached_property
    def place(self) -> tuple[float, float]:
        """The start of the orbit on show: the chosen place, or another one if no motion is possible there.

        Raises `OutsideRegion`.
        """
        (chosen,) = points_of(self.host.chosen)[-1:]
        if self.host.poincare.states_at(*np.array(chosen)[:, None])[1][0]:
            return chosen
        others = self.host.poincare.spread(1)
        if not others:
            raise OutsideRegion("No motion of this energy crosses γ₃ = 0: choose a larger h.")
        x, y = self.host.poincare.places_of(np.array(others))[0]
        return float(x), float(y)

    @property
    def start(self) -> Start:
        """The initial state of the orbit on show."""
        return tuple(map(float, self.host.poincare.states_at(*np.array(self.place)[:, None])[0][0]))

    @property
    def begin(self) -> Begin | None:
        """The start of the branch of a periodic orbit: the requested one, or the one that doubles first, if any."""
        at, place, period = self.at, self.place, PERIODS.get(self.host.branch)
        if self.host.branch == NONE:
            if self._doubling is None:
                return None
            at, places, _ = self._doubling
            place, period = tuple(places[0].tolist()), len(places)
        (low, _), (high, _) = self.frame
        return Begin(self.family, at, place, period, (min(low, at), max(high, at)))

    @property
    def seen(self) -> Window | None:
        """The visible window, for the branch; None while it is unknown."""
        return self.frame if self.height else None

    @cached_property
    def _window(self) -> Window:
        """The chosen window, or the whole diagram."""
        low, high = self.host.poincare.window[self.side]
        return window_of(self.host.window, ((self.host.first, low), (self.host.last, high)))

    @cached_property
    def height(self) -> Range | None:
        """The visible range of the coordinate: that of the attractor, unless a window is chosen; None while unknown."""
        (left, low), (right, high) = self._window
        if self.host.window:
            return low, high
        cropped = Task(_cropped, self.family, (left, right), self.place, self.side, (low, high))
        return self.work.need(cropped, preview=None)

    @cached_property
    def frame(self) -> Window:
        """The visible window; as high as the whole diagram while its height is unknown."""
        (left, low), (right, high) = self._window
        low, high = self.height or (low, high)
        return (left, low), (right, high)

    @property
    def name(self) -> str:
        """The name of the parameter of the diagram."""
        return self.host.symbols[self.host.along]

    @property
    def at(self) -> float:
        """The value of the parameter in this state."""
        return float(getattr(self.host, self.name))

    @property
    def family(self) -> Family:
        """The sections over the parameter; they do not depend on its value in this state."""
        return Family.of(self.host, self.name, self.host.along, tuple(self.host.symbols.values()))

    @property
    def side(self) -> int:
        """Index of the section's coordinate that the diagram shows."""
        return COORDINATES.index(self.host.shown)

    @cached_property
    def along_values(self) -> Array:
        """The values of the parameter (n,), increasing."""
        share = self.work.plan(Kind.SECTION).share
        steps = min(int(self.host.steps), _FEW) if self.work.dragging else max(2, round(share * self.host.steps))
        return np.linspace(self.frame[0][0], self.frame[1][0], steps)

    @cached_property
    def _courses(self) -> dict[str, _Course]:
        """The course of each requested way."""
        level = self.work.plan(Kind.SECTION).level
        left, shown = (40, 20) if self.work.dragging else (int(self.host.transient), int(self.host.count))
        values, follow = tuple(self.along_values.tolist()), self.host.begins == FOLLOWED
        rising = _Course(self.family, values, self.place, left, shown, follow, False, level)
        courses = {
            RISING: rising,
            FALLING: replace(rising, values=values[::-1], before=rising),
            BACKWARD: replace(rising, backward=True),
        }
        return {way: courses[way] for way in WAYS[self.host.ways]}

    @cached_property
    def branches(self) -> dict[str, list[Diagram]]:
        """The known pieces of each way, in order."""
        found: dict[str, list[Diagram | None]] = {way: [] for way in self._courses}
        pieces = product(self._courses, range(self._courses[RISING].pieces))
        # The way back comes last, because it starts where the way there ends.
        for way, i in sorted(pieces, key=lambda one: (one[0] == FALLING, one[1])):
            task = Task(_piece, self._courses[way], i)
            found[way].append(self.work.need(task, preview=task if self.work.dragging else None))
        return {way: [one for one in parts if one is not None] for way, parts in found.items()}

    def points(self, way: str) -> Array | None:
        """Return the drawn points (2, n) of a way."""
        parts = [
            np.column_stack([np.full(len(some), value), some[:, self.side]])
            for one in self.branches.get(way, ())
            for value, some in zip(one.values, one.places, strict=True)
            if len(some)
        ]
        return joined(parts).T

    @property
    def _locates(self) -> bool:
        """True if doublings are located: not while a slider is held, and not at `draft`."""
        return not self.work.dragging and self.work.level.name != "draft"

    @cached_property
    def _doubling(self) -> tuple[float, Array, float] | None:
        """The first doubling seen, see `doubling_seen`; None if unknown or none is seen."""
        known = self.branches[RISING]
        missing = sum(len(one.values) for one in known) < self.along_values.size
        return doubling_seen(known) if self._locates and not missing else None

    @cached_property
    def cascade(self) -> Cascade | str | None:
        """The period doublings from the first one seen, or why none was located; None if unknown or none is seen."""
        return (self.work.need(Task(_cascade, self._courses[RISING]), preview=None) or None) if self._locates else None

    @property
    def flips(self) -> Array:
        """The parameter values (k,) of the period doublings."""
        return self.cascade.values if isinstance(self.cascade, Cascade) else np.empty(0)

    def choose(self, x: float, y: float) -> Values:
        """Return the parameter value and the place that a click at (x, y) selects."""
        found = nearest_place([one for way in self.branches.values() for one in way], self.side, x, y)
        if found is None:
            return {self.name: x}
        value, place = found
        return {self.name: value, "chosen": written([place])}

    def caption(self, points: str = "") -> Caption:
        """Return the caption: progress, doublings, periods; points : their number in words."""
        known = sum(len(one.values) for way in self.branches.values() for one in way)
        asked = self.along_values.size * len(WAYS[self.host.ways])
        if known < asked:
            return Caption(self.work.awaited(), f"{known} of {asked} values are known.")
        if all(one.conservative.all() for one in self.branches[RISING]):
            return Caption("Volume is preserved: no attractors.", f"{points}One orbit for each value.")
        if isinstance(self.cascade, Cascade) and self.flips.size:
            ratios = self.cascade.ratios
            ratio = (
                f"; ratio {digits(ratios[-1], 4)} ± {digits(self.cascade.ratio_errors[-1], 1)}" if ratios.size else ""
            )
            many = (
                f"{self.flips.size} period doublings located."
                if self.flips.size > 1
                else "One period doubling located."
            )
            period, place = self.cascade.periods[0], digits(self.flips[0])
            return Caption(many, f"{points}The first of period {period} at {self.host.along} = {place}{ratio}.")
        periods = sorted({int(m) for one in self.branches[RISING] for m in one.periods if m})
        if not periods:
            return Caption("No periodic orbit is seen.", points.rstrip())
        return Caption(numbers=f"{points}Periods seen: {', '.join(map(str, periods[:8]))}.")

    def status(self) -> Iterator[str]:
        """Yield the error of the doublings."""
        if self.asked("cascade") and self.flips.size and isinstance(self.cascade, Cascade):
            yield f"doublings to {digits(self.cascade.error_estimate, 1)}"

    def notes(self) -> Iterator[str]:
        """Yield the reason why a doubling could not be located."""
        if self.asked("cascade") and isinstance(self.cascade, str):
            yield f"The doubling that is seen was not located: {self.cascade}"


@dataclass(frozen=True)
class _Course:
    """An orbit followed through the values of the parameter, in pieces.

    before : the course at whose end this one starts; without it, it starts at `place`.
    """

    family: Family
    values: tuple[float, ...]
    place: tuple[float, ...]
    transient: int
    kept: int
    follow: bool
    backward: bool
    level: Accuracy
    before: _Course | None = None

    @property
    def pieces(self) -> int:
        """The number of pieces."""
        return -(-len(self.values) // _TOGETHER)


def _piece(course: _Course, number: int) -> Diagram:
    """Return a piece of a course, which needs the pieces before it."""
    return diagram(
        course.family,
        course.family.name,
        course.values[number * _TOGETHER : (number + 1) * _TOGETHER],
        _reached(course, number),
        course.place,
        course.transient,
        course.kept,
        course.follow,
        course.backward,
        course.level,
    )


def _reached(course: _Course, number: int) -> tuple[float, ...]:
    """Return the last place of the orbit on the section before a piece."""
    if number == 0:
        return course.place if course.before is None else _reached(course.before, course.before.pieces)
    before: Diagram = Task(_piece, course, number - 1).get()
    ends = before.ends[np.isfinite(before.ends).all(axis=1)]
    return tuple(ends[-1].tolist()) if len(ends) else _reached(course, number - 1)


def _cascade(course: _Course) -> Cascade | str:
    """Return the doublings from the first one seen on a course, or why none was located; "" if none is seen."""
    seen = doubling_seen([Task(_piece, course, number).get() for number in range(course.pieces)])
    if seen is None:
        return ""
    value, places, end = seen
    return doublings(course.family, course.family.name, value, tuple(map(tuple, places.tolist())), end, _DOUBLINGS)


def _cropped(family: Family, ends: Range, place: tuple[float, float], side: int, whole: Range) -> tuple[float, float]:
    """Return the range of a coordinate with the attractor over the parameter, and the repeller if it is near."""
    values, level = tuple(np.linspace(*ends, _GLANCES).tolist()), plan(Kind.SECTION, "draft").level
    attractor, repeller = (
        [
            one[:, side]
            for one in diagram(family, family.name, values, place, place, 200, 30, True, backward, level).places
        ]
        for backward in (False, True)
    )
    if not any(map(len, attractor)):
        return whole
    alone, both = _range(attractor), _range(attractor + repeller)
    low, high = both if both[1] - both[0] < _BOTH * (alone[1] - alone[0]) else alone
    room = max(_ROOM * (high - low), _LEAST * (whole[1] - whole[0]))
    return max(whole[0], low - room), min(whole[1], high + room)


def _range(parts: Sequence[Array]) -> tuple[float, float]:
    """Return the range of the points at most values: at a few of them a motion may go far away for a moment."""
    lows, highs = zip(*((one.min(), one.max()) for one in parts if len(one)), strict=True)
    return float(np.quantile(lows, _FEW_FAR)), float(np.quantile(highs, 1.0 - _FEW_FAR))
