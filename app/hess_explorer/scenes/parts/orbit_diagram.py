"""An orbit diagram of a section over one parameter, computed piece by piece."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol, TypeVar

import numpy as np

from hess_explorer.protocol.parameters import Values, places, written
from hess_explorer.scenes.framework.families import Begin, Family
from hess_explorer.scenes.framework.parameters import TURN, specs_of
from hess_explorer.scenes.framework.part import Host, Part, Start
from hess_explorer.scenes.framework.periodic_search import NONE, PERIODS
from hess_explorer.scenes.framework.scene import State
from hess_explorer.scenes.framework.windows import Window, boxed, tidy_window, window_of
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Axes, Layer, Range, curves, dots
from hess_explorer.views.plot import Plot
from hess_explorer.views.section_plane import joined
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.orbit_diagram import Cascade, Diagram, doubling_seen
from hess_mechanics.dynamics.parameter_diagram import diagram, doublings, nearest_place
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.errors import OutsideRegion
from hess_mechanics.numerics.accuracy import Computation
from hess_mechanics.numerics.results import Array

__all__ = ["ANEW", "BOUNDS", "FARTHEST", "FOLLOWED", "WAYS", "OrbitDiagram", "diagram_picture", "edges"]

_RISING, _FALLING, _BACKWARD = "rising", "falling", "backward"
WAYS = {
    "there and back, and backward in time": (_RISING, _FALLING, _BACKWARD),
    "there and back": (_RISING, _FALLING),
    "there, and backward in time": (_RISING, _BACKWARD),
}
FOLLOWED, ANEW = "where it was at the value before", "at the chosen place"
FARTHEST = (-1e3, 1e3)
BOUNDS = ((FARTHEST[0], -TURN), (FARTHEST[1], TURN))
_TOGETHER = 30
"""Values of the parameter computed at once: few enough that points arrive soon."""
_FEW = 30
"""Largest number of values while a slider is held."""
_DOUBLINGS = 4


def edges(one: float, other: float) -> tuple[float, float]:
    """Return the edges of a diagram, left one first; equal edges give a diagram of width 1 within the bounds."""
    first, last = sorted((one, other))
    if first == last:
        first = min(first, FARTHEST[1] - 1.0)
        last = first + 1.0
    return first, last


class _Section(PoincareSection, Protocol):
    def somewhere(self) -> Start | None:
        """Return a state on the section; None if no motion crosses it."""


class _Host(Host, Protocol):
    @property
    def poincare(self) -> _Section:
        """The section in its coordinates.  Raises `ModelError`."""

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
    def chosen(self) -> str: ...

    @property
    def branch(self) -> str: ...


@dataclass(frozen=True, eq=False)
class OrbitDiagram(Part[_Host]):
    """The points to which the orbits of a section settle, over one of its parameters.

    symbols : symbols of all parameters of the section → their names.
    """

    symbols: Mapping[str, str]

    def admitted(self, notes: list[str]) -> Values:
        """Return a valid window within the diagram, a place, and the edges in order."""
        first, last = edges(self.host.first, self.host.last)
        default = next(spec.default for spec in specs_of(type(self.host)) if spec.name == "chosen")
        window = tidy_window(self.host.window)
        (x0, _), (x1, _) = window_of(window, ((first, 0.0), (last, 0.0)))
        return {
            "first": first,
            "last": last,
            "chosen": self.host.chosen or default,
            "window": window if x0 < last and x1 > first else "",
        }

    @property
    def poincare(self) -> PoincareSection:
        """The section in its coordinates.  Raises `ModelError`."""
        return self.host.poincare

    @cached_property
    def place(self) -> tuple[float, float]:
        """The start of the orbit on show: the chosen place, or another one if no motion is possible there.

        Raises `OutsideRegion`.
        """
        (chosen,) = places(self.host.chosen)[-1:]
        if self.host.poincare.states_at(*np.array(chosen)[:, None])[1][0]:
            return chosen
        other = self.host.poincare.somewhere()
        if other is None:
            raise OutsideRegion("No motion of this energy crosses γ₃ = 0: choose a larger h.")
        x, y = self.host.poincare.places_of(np.array([other]))[0]
        return float(x), float(y)

    @property
    def start(self) -> Start:
        """The initial state of the orbit on show."""
        return tuple(map(float, self.host.poincare.states_at(*np.array(self.place)[:, None])[0][0]))

    @property
    def begin(self) -> Begin | None:
        """The start of the branch of a periodic orbit; None if no branch is requested."""
        if self.host.branch == NONE:
            return None
        (low, _), (high, _) = self.frame
        return Begin(
            self.family, self.at, self.place, PERIODS[self.host.branch], (min(low, self.at), max(high, self.at))
        )

    @property
    def seen(self) -> Window:
        """The visible window, for the branch."""
        return self.frame

    @property
    def full(self) -> Window:
        """The whole diagram."""
        low, high = (-math.pi, math.pi) if self.host.shown == "ψ" else (0.0, math.pi)
        return (self.host.first, low), (self.host.last, high)

    @cached_property
    def frame(self) -> Window:
        """The visible window."""
        return window_of(self.host.window, self.full)

    @property
    def name(self) -> str:
        """The name of the parameter of the diagram."""
        return self.symbols[self.host.along]

    @property
    def at(self) -> float:
        """The value of the parameter in this state."""
        return float(getattr(self.host, self.name))

    @property
    def family(self) -> Family:
        """The sections over the parameter; they do not depend on its value in this state."""
        return Family.of(self.host, self.name, self.host.along, tuple(self.symbols.values()))

    @property
    def side(self) -> int:
        """Index of the section's coordinate that the diagram shows."""
        return ("ψ", "δ").index(self.host.shown)

    @cached_property
    def along_values(self) -> Array:
        """The values of the parameter (n,), increasing."""
        share = self.work.plan(Computation.SECTION).share
        steps = min(int(self.host.steps), _FEW) if self.work.dragging else max(2, round(share * self.host.steps))
        return np.linspace(self.frame[0][0], self.frame[1][0], steps)

    @cached_property
    def branches(self) -> dict[str, list[Diagram]]:
        """The known pieces of each way, in order."""
        rising = self._followed(self.along_values, self.place, False)
        found = {_RISING: rising}
        asked = WAYS[self.host.ways]
        if _BACKWARD in asked:
            found[_BACKWARD] = self._followed(self.along_values, self.place, True)
        # The way back starts at the end of the way there.
        if _FALLING in asked and sum(len(one.values) for one in rising) == self.along_values.size:
            found[_FALLING] = self._followed(self.along_values[::-1], _end(rising) or self.place, False)
        elif _FALLING in asked:
            found[_FALLING] = []
        return found

    def _followed(self, values: Array, place: tuple[float, ...], backward: bool) -> list[Diagram]:
        level, followed = self.work.plan(Computation.SECTION).level, self.host.begins == FOLLOWED
        left, shown = (40, 20) if self.work.dragging else (int(self.host.transient), int(self.host.count))
        found: list[Diagram] = []
        for i in range(0, len(values), _TOGETHER):
            one = self.work.soon(
                diagram,
                self.family,
                self.name,
                tuple(values[i : i + _TOGETHER].tolist()),
                _end(found) or place,
                self.place,
                left,
                shown,
                followed,
                backward,
                level,
            )
            if one is None:
                break
            found.append(one)
        return found

    def points(self, way: str) -> Array | None:
        """Return the drawn points (2, n) of a way."""
        parts = [
            np.column_stack([np.full(len(some), value), some[:, self.side]])
            for one in self.branches.get(way, ())
            for value, some in zip(one.values, one.places, strict=True)
            if len(some)
        ]
        return joined(parts).T

    @cached_property
    def cascade(self) -> Cascade | str | None:
        """The period doublings from the first one seen, or why none was located; None if unknown or none is seen."""
        known = self.branches[_RISING]
        missing = sum(len(one.values) for one in known) < self.along_values.size
        if missing or self.work.dragging or self.work.level.name == "draft":
            return None
        seen = doubling_seen(known)
        if seen is None:
            return None
        value, places, end = seen
        return self.work.later(
            doublings, self.family, self.name, value, tuple(map(tuple, places.tolist())), end, _DOUBLINGS
        )

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

    def caption(self) -> Caption:
        """Return the caption: progress, doublings, periods."""
        known = sum(len(one.values) for way in self.branches.values() for one in way)
        asked = self.along_values.size * len(WAYS[self.host.ways])
        if known < asked:
            return Caption(self.work.awaited(), f"{known} of {asked} values are known.")
        if all(one.conservative.all() for one in self.branches[_RISING]):
            return Caption("Volume is preserved: no attractors.", "One orbit for each value.")
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
            return Caption(many, f"The first of period {period} at {self.host.along} = {place}{ratio}.")
        periods = sorted({int(m) for one in self.branches[_RISING] for m in one.periods if m})
        if not periods:
            return Caption("No periodic orbit is seen.")
        return Caption(numbers=f"Periods seen: {', '.join(map(str, periods[:8]))}.")

    def status(self) -> Iterator[str]:
        """Yield the error of the doublings."""
        if self.asked("cascade") and self.flips.size and isinstance(self.cascade, Cascade):
            yield f"doublings to {digits(self.cascade.error_estimate, 1)}"

    def notes(self) -> Iterator[str]:
        """Yield the reason why a doubling could not be located."""
        if self.asked("cascade") and isinstance(self.cascade, str):
            yield f"The doubling that is seen was not located: {self.cascade}"


def _end(parts: list[Diagram]) -> tuple[float, ...] | None:
    """Return the last known place of the orbit; None if it never returned to the section."""
    ends = [end for one in parts for end in one.ends if np.isfinite(end).all()]
    return tuple(ends[-1].tolist()) if ends else None


S = TypeVar("S", bound=State)


def diagram_picture(
    of: Callable[[S], OrbitDiagram],
    first: Range,
    caption: Callable[[S], Caption],
    on_click: Callable[[S, float, float], Values],
    on_hover: Callable[[S, float, float], str],
    over: tuple[Layer[S], ...] = (),
) -> Plot[S]:
    """Return the picture of the diagram.

    first : its horizontal range before the first state; over : layers on top.
    """

    def upright(values: Callable[[S], Sequence[float]]) -> Callable[[S, Axes], list[Array]]:
        return lambda s, axes: [np.array([[x, axes.y[0]], [x, axes.y[1]]]) for x in values(s)]

    return Plot(
        name="diagram",
        title="Orbit diagram",
        caption=caption,
        on_hover=on_hover,
        on_click=on_click,
        axes=lambda s: (of(s).host.along, of(s).host.shown),
        first=Axes(first, (-math.pi, math.pi)),
        x=lambda s: (of(s).frame[0][0], of(s).frame[1][0]),
        y=lambda s: (of(s).frame[0][1], of(s).frame[1][1]),
        on_box=lambda s, corners: boxed(corners, BOUNDS),
        layers=(
            curves(
                "flips",
                within=upright(lambda s: of(s).flips.tolist()),
                color=theme.STABLE,
                width=1.5,
                dash="dashed",
                label="the period doubles",
            ),
            dots("backward", lambda s: of(s).points(_BACKWARD), color=theme.UNSTABLE, size=3, label="backward in time"),
            dots(
                "falling", lambda s: of(s).points(_FALLING), color=theme.MAP, size=5, label="forward, parameter falling"
            ),
            dots(
                "rising", lambda s: of(s).points(_RISING), color=theme.ORBIT, size=3, label="forward, parameter rising"
            ),
            curves(
                "here",
                within=upright(lambda s: [of(s).at]),
                color=theme.INK,
                width=1.5,
                label="state on show",
                tag="state on show",
            ),
            *over,
        ),
    )
