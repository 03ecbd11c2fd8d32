"""An orbit diagram of a section over one parameter of a state, computed in parts, one after the other."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from hess_explorer.protocol.parameters import Values, written
from hess_explorer.scenes.framework.branch import Family
from hess_explorer.scenes.framework.filled_window import TURN
from hess_explorer.scenes.framework.parameters import choice, number
from hess_explorer.scenes.framework.parameters import places as chosen_places
from hess_explorer.scenes.framework.scene import State
from hess_explorer.scenes.framework.windows import Window, boxed, window_of
from hess_explorer.views import theme
from hess_explorer.views.layers import Axes, Layer, curves, dots
from hess_explorer.views.plot import Plot
from hess_explorer.views.section_plane import joined
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.orbit_diagram import Cascade, Diagram, doubling_seen
from hess_mechanics.dynamics.parameter_diagram import diagram, doublings, nearest_place
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.numerics.accuracy import Computation
from hess_mechanics.numerics.results import Array

__all__ = ["BOUNDS", "OverParameter", "edges", "parameter_of_diagram", "picture"]

_RISING, _FALLING, _BACKWARD = "rising", "falling", "backward"
_WAYS = {"there and back, and backward in time": (_RISING, _FALLING, _BACKWARD),
         "there and back": (_RISING, _FALLING), "there, and backward in time": (_RISING, _BACKWARD)}
_FOLLOWED, _ANEW = "where it was at the value before", "at the chosen place"
_FARTHEST = (-1e3, 1e3)
BOUNDS = ((_FARTHEST[0], -TURN), (_FARTHEST[1], TURN))
_TOGETHER = 30
"""Values of the parameter that are computed at once: few enough for points to arrive soon."""
_FEW = 30
"""Values while a slider is held."""
_DOUBLINGS = 4


def parameter_of_diagram(symbols: tuple[str, ...], default: str) -> Any:
    """Over what the diagram is."""
    return choice("Parameter of the diagram", symbols, default,
                  doc="What changes from left to right. All others are as they stand.")


def edges(one: float, other: float) -> tuple[float, float]:
    """Of a diagram, the left one first; where both are one value, within their bounds a diagram of length 1."""
    first, last = sorted((one, other))
    if first == last:
        first = min(first, _FARTHEST[1] - 1.0)
        last = first + 1.0
    return first, last


@dataclass(frozen=True)
class OverParameter(State):
    """A state with a section, a place on it and an orbit diagram over one of its parameters.

    parameters_of_section : symbols of all on which the section depends → their names.
    """

    parameters_of_section: ClassVar[Mapping[str, str]]

    along: str = parameter_of_diagram(("h",), "h")
    first: float = number("from", -0.15, (-3.0, 6.0), 0.01, bounds=_FARTHEST, label="Diagram from",
                          doc="The value at its left edge.")
    last: float = number("to", 0.3, (-3.0, 6.0), 0.01, bounds=_FARTHEST, label="Diagram to",
                         doc="The value at its right edge.")
    shown: str = choice("Coordinate of the section", ("ψ", "δ"), "ψ", doc="What the diagram shows, upwards.")
    ways: str = choice("Followed", tuple(_WAYS), next(iter(_WAYS)),
                       doc="There: the parameter rises; back: it falls. Backward in time motions come to repellers.")
    begins: str = choice("Each value starts", (_FOLLOWED, _ANEW), _FOLLOWED,
                         doc="Followed, an orbit stays with its attractor, and the way back may be another one.")
    steps: float = number("n", 150.0, (30.0, 300.0), 10.0, bounds=(2.0, 600.0), label="Values of the parameter",
                           doc="At how many even values.", group="Computation")
    transient: float = number("N₀", 300.0, (0.0, 1000.0), 10.0, bounds=(0.0, 5000.0), label="Crossings left out",
                              doc="Until the orbit has settled, at each value.", group="Computation")
    count: float = number("N", 60.0, (10.0, 200.0), 5.0, bounds=(2.0, 500.0), label="Crossings shown",
                          doc="At each value, after those left out.", group="Computation")
    window: str = chosen_places("The window of the diagram", 2, *BOUNDS)

    @property
    @abstractmethod
    def section(self) -> PoincareSection:
        """The section.  Raises `ModelError`."""

    @property
    @abstractmethod
    def place(self) -> tuple[float, float]:
        """Where orbits start.  Raises `ModelError`."""

    @property
    def full(self) -> Window:
        """The whole diagram."""
        low, high = (-math.pi, math.pi) if self.shown == "ψ" else (0.0, math.pi)
        return (self.first, low), (self.last, high)

    @cached_property
    def frame(self) -> Window:
        """What of it is seen."""
        return window_of(self.window, self.full)

    @property
    def name(self) -> str:
        """The parameter of the diagram."""
        return self.parameters_of_section[self.along]

    @property
    def at(self) -> float:
        """Its value in this state."""
        return float(getattr(self, self.name))

    @property
    def family(self) -> Family:
        """The sections over it: what the parameter itself is in this state does not matter."""
        return Family.of(self, self.name, self.along, tuple(self.parameters_of_section.values()))

    @property
    def side(self) -> int:
        """Which coordinate of the section the diagram shows."""
        return ("ψ", "δ").index(self.shown)

    @cached_property
    def along_values(self) -> Array:
        """The values of the parameter, rising (n,)."""
        share = self.plan(Computation.SECTION).share
        steps = min(int(self.steps), _FEW) if self.dragging else max(2, round(share * self.steps))
        return np.linspace(self.frame[0][0], self.frame[1][0], steps)

    @cached_property
    def branches(self) -> dict[str, list[Diagram]]:
        """What is known of each way, in parts, one after the other."""
        rising = self._followed(self.along_values, self.place, False)
        found = {_RISING: rising}
        asked = _WAYS[self.ways]
        if _BACKWARD in asked:
            found[_BACKWARD] = self._followed(self.along_values, self.place, True)
        # The way back begins where the way there ended.
        if _FALLING in asked and sum(len(one.values) for one in rising) == self.along_values.size:
            found[_FALLING] = self._followed(self.along_values[::-1], _end(rising) or self.place, False)
        elif _FALLING in asked:
            found[_FALLING] = []
        return found

    def _followed(self, values: Array, place: tuple[float, ...], backward: bool) -> list[Diagram]:
        left, shown = (40, 20) if self.dragging else (int(self.transient), int(self.count))
        found: list[Diagram] = []
        for i in range(0, len(values), _TOGETHER):
            one = self.work.soon(
                diagram, self.family, self.name, tuple(values[i : i + _TOGETHER].tolist()), _end(found) or place,
                self.place, left, shown, self.begins == _FOLLOWED, backward, self.plan(Computation.SECTION).level)
            if one is None:
                break
            found.append(one)
        return found

    def points(self, way: str) -> Array | None:
        """What is drawn of a way (2, n)."""
        parts = [np.column_stack([np.full(len(some), value), some[:, self.side]])
                 for one in self.branches.get(way, ()) for value, some in zip(one.values, one.places, strict=True)
                 if len(some)]
        return joined(parts).T

    @cached_property
    def cascade(self) -> Cascade | str | None:
        """The doublings, from the first that the way there shows; None while they are sought or none is seen."""
        known = self.branches[_RISING]
        missing = sum(len(one.values) for one in known) < self.along_values.size
        if missing or self.dragging or self.level.name == "draft":
            return None
        seen = doubling_seen(known)
        if seen is None:
            return None
        value, places, end = seen
        return self.work.later(doublings, self.family, self.name, value, tuple(map(tuple, places.tolist())), end,
                               _DOUBLINGS)

    @property
    def flips(self) -> Array:
        """Where periods double (k,)."""
        return self.cascade.values if isinstance(self.cascade, Cascade) else np.empty(0)

    def choose(self, x: float, y: float) -> Values:
        """A click in the diagram: the value of the parameter, and a motion that is there."""
        found = nearest_place([one for way in self.branches.values() for one in way], self.side, x, y)
        if found is None:
            return {self.name: x}
        value, place = found
        return {self.name: value, "chosen": written([place])}

    def _about_diagram(self) -> str:
        known = sum(len(one.values) for way in self.branches.values() for one in way)
        asked = self.along_values.size * len(_WAYS[self.ways])
        if known < asked:
            return f"{known} of {asked} values are known."
        if all(one.conservative.all() for one in self.branches[_RISING]):
            return "Volume is kept: each value shows one orbit, and nothing attracts."
        if isinstance(self.cascade, Cascade) and self.flips.size:
            ratios = self.cascade.ratios
            said = "" if not ratios.size else (
                f"; ratio {digits(ratios[-1], 4)} ± {digits(self.cascade.ratio_errors[-1], 1)}")
            many = f"{self.flips.size} doublings located, the first" if self.flips.size > 1 else "One doubling located,"
            return (f"{many} of period {self.cascade.periods[0]} at {self.along} = "
                    f"{digits(self.flips[0], 6)}{said}.")
        periods = sorted({int(m) for one in self.branches[_RISING] for m in one.periods if m})
        return f"Periods seen: {', '.join(map(str, periods[:8])) or 'none'}."

    def notes(self) -> Iterator[str]:
        """What of the diagram could not be located."""
        if self.known("cascade") is not None and isinstance(self.cascade, str):
            yield f"The doubling that is seen was not located: {self.cascade}"


def _end(parts: list[Diagram]) -> tuple[float, ...] | None:
    """Where the orbit was at the last value at which it came back."""
    ends = [end for one in parts for end in one.ends if np.isfinite(end).all()]
    return tuple(ends[-1].tolist()) if ends else None


def picture(state: type[OverParameter], over: tuple[Layer[Any], ...] = (),
            on_hover: Callable[[Any, float, float], str] | None = None) -> Plot[Any]:
    """The diagram of such states, and what is drawn over it."""
    return Plot(name="diagram", title="Orbit diagram", caption=state._about_diagram, on_hover=on_hover,
         axes=lambda s: (s.along, s.shown), first=Axes((state.first, state.last), (-math.pi, math.pi)),
         x=lambda s: (s.frame[0][0], s.frame[1][0]), y=lambda s: (s.frame[0][1], s.frame[1][1]),
         on_click=state.choose, on_box=lambda s, corners: boxed(corners, BOUNDS),
         layers=(
             curves("flips", within=lambda s, axes: [np.array([[x, axes.y[0]], [x, axes.y[1]]]) for x in s.flips],
                    color=theme.STABLE, width=1.5, dash="dashed", label="the period doubles"),
             dots("backward", lambda s: s.points(_BACKWARD), color=theme.UNSTABLE, size=3,
                  label="backward in time"),
             dots("falling", lambda s: s.points(_FALLING), color=theme.MAP, size=5,
                  label="forward, parameter falling"),
             dots("rising", lambda s: s.points(_RISING), color=theme.ORBIT, size=3,
                  label="forward, parameter rising"),
             curves("here", within=lambda s, axes: [np.array([[s.at, axes.y[0]], [s.at, axes.y[1]]])],
                    color=theme.INK, width=1.5, label="the state on show"), *over))
