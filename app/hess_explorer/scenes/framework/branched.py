"""A section beside which the branch of its periodic orbit is drawn over a parameter."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator, Mapping
from dataclasses import replace
from functools import cached_property
from typing import Any, ClassVar

import numpy as np

from hess_explorer.protocol.parameters import Number, Values
from hess_explorer.scenes.framework.branch import Begin, Continuation, Family
from hess_explorer.scenes.framework.parameters import Slider, choice, number, specs_of
from hess_explorer.scenes.framework.periodic import PeriodicOrbits
from hess_explorer.scenes.framework.periodic_search import PERIODS
from hess_explorer.scenes.framework.windows import Window
from hess_explorer.views import branch as view
from hess_explorer.views import theme
from hess_explorer.views.layers import Axes, curves, points
from hess_explorer.views.periodic import seen
from hess_explorer.views.picture import Corners
from hess_explorer.views.plot import Plot
from hess_mechanics.dynamics.continuation import Branch
from hess_mechanics.numerics.results import Array

__all__ = ["Branched", "branch_picture", "coordinate_of_branch", "end_of_branch", "parameter_of_branch"]

_AROUND = 0.125
"""Of a slider's range, to each side of the value, where no other range is chosen."""
_ROOM = 0.08
_LEAST = 1e-3
"""Of the section, upwards."""
_FARTHEST = (-1e5, 1e5)


def parameter_of_branch(symbols: tuple[str, ...]) -> Any:
    """Over what the branch is continued; the first one at first."""
    return choice("Branch over", symbols, symbols[0],
                  doc="In “Branch of the periodic orbit”: what changes from left to right. All others are as they "
                      "stand.")


def end_of_branch(word: str) -> Any:
    """One end of the range; the other end."""
    return number(word, 0.0, (-1.0, 6.0), 0.01, bounds=_FARTHEST, label=f"Branch {word}", group="Computation",
                  doc="In “Branch of the periodic orbit”. With both ends alike: about the value that the parameter "
                      "has.")


def coordinate_of_branch(names: tuple[str, str]) -> Any:
    """What of the section is drawn upwards."""
    return choice("Branch upwards", names, names[0],
                  doc="In “Branch of the periodic orbit”: which coordinate of the section.")


class Branched(PeriodicOrbits):
    """A section with a periodic orbit, and its branch over a parameter, with bifurcations.

    The scene declares the parameters that stand here without a value.
    along : symbols of the parameters of the section → their names; besides : choices on which it depends, too.
    """

    over: str
    low: float
    high: float
    upwards: str

    along: ClassVar[Mapping[str, str]]
    besides: ClassVar[tuple[str, ...]] = ()

    @abstractmethod
    def start_at(self, x: float, y: float) -> Values:
        """The values with which the chosen orbit starts at a place of the section."""

    @property
    def _name(self) -> str:
        return self.along[self.over]

    @property
    def _at(self) -> float:
        return float(getattr(self, self._name))

    @property
    def _side(self) -> int:
        return self.names.index(self.upwards)

    @cached_property
    def branch_ends(self) -> tuple[float, float]:
        """From where to where the parameter goes, within its bounds."""
        spec = next(one for one in specs_of(type(self)) if one.name == self._name)
        assert isinstance(spec, Number)
        least, most = spec.bounds
        limits: Mapping[str, Slider] = self.limits()
        first, last, _ = limits.get(self._name, (*spec.softbounds, spec.step))
        low, high = (min(max(one, least), most) for one in sorted((self.low, self.high)))
        if low == high:
            away, at = _AROUND * (last - first), self._at
            # Beyond the ends of the slider there may be no motion at all.
            low, high = (max(at - away, first) if at > first else at - away), at + away
            low, high = max(low, least), min(high, most)
        return low, high

    @cached_property
    def continuation(self) -> Continuation | None:
        """The branch of the periodic orbit, where there is one."""
        if self.aim is None or self.closed is None:
            return None
        low, high = self.branch_ends
        begin = Begin(Family.of(self, self._name, self.over, (*self.along.values(), *self.besides)), self._at, self.aim,
                      PERIODS[self.periodic], (min(low, self._at), max(high, self._at)))
        return Continuation(self.work, begin, self._side)

    @property
    def continued(self) -> list[Branch]:
        """What is known of it."""
        return [] if self.continuation is None else self.continuation.branches

    @property
    def turn(self) -> float:
        """Of the coordinate that is drawn."""
        return self.section.turns[self._side]

    @property
    def here(self) -> Array | None:
        """The orbit on show in the picture (2, m)."""
        return None if self.closed is None else np.array(
            [(self._at, place[self._side]) for place in self.closed.orbit.places]).T

    @cached_property
    def upwards_range(self) -> tuple[float, float] | None:
        """Room for what is known of the branch; None before anything is."""
        if not self.continued:
            return None
        found = np.concatenate([one.places[:, :, self._side].ravel() for one in self.continued])
        low, high = self.section.window[self._side]
        if found.max() - found.min() >= self.turn:
            return low, high
        middle = 0.5 * float(found.min() + found.max())
        half = (0.5 + _ROOM) * max(float(found.max() - found.min()), _LEAST * (high - low))
        return middle - half, middle + half

    # ---- what the mouse does ------------------------------------------------------------------------------------

    @property
    def _seen(self) -> Window | None:
        if self.upwards_range is None:
            return None
        return (self.branch_ends[0], self.upwards_range[0]), (self.branch_ends[1], self.upwards_range[1])

    def on_branch(self, x: float, y: float) -> Values:
        """A click on the branch: the parameter and the orbit that is there, in the range that is seen."""
        found = None if self.continuation is None or self._seen is None else self.continuation.chosen(x, y, self._seen)
        if found is None:
            return {}
        value, place, period = found
        state: Any = self  # a dataclass only where the scene declares its parameters
        there: Branched = replace(state, **{self._name: value})
        low, high = self.branch_ends
        return {self._name: value, **there.start_at(place[0], place[1]), "periodic": f"period {period}", "low": low,
                "high": high}

    def about_branch(self, x: float, y: float) -> str:
        """The bifurcation, or the orbit, under the mouse."""
        return "" if self.continuation is None or self._seen is None else self.continuation.about(x, y, self._seen)

    # ---- words --------------------------------------------------------------------------------------------------

    def _caption(self) -> str:
        if not self.closing:
            return "No periodic orbit is chosen: choose one, and a click on its branch shows that orbit."
        if self.looking or (self.continuation is not None and not self.continuation.caption):
            return self.awaited("A periodic orbit is")
        if self.continuation is None:
            return "No periodic orbit is found from here: no branch."
        return self.continuation.caption

    def _nothing(self) -> str:
        if not self.closing:
            return "Choose a Periodic orbit, and its branch is continued here"
        return "" if self.looking or self.closed is not None else "No periodic orbit is found from here"

    def means(self) -> Mapping[str, str]:
        """Over what, and from where to where: in each scene its own."""
        own = type(self).__name__
        return {**super().means(), **{name: f"{name} of the branch of {own} over {self.over}"
                                      for name in ("over", "low", "high", "upwards")}}

    def idle(self) -> Mapping[str, float]:
        """The ends of a range that nobody asks for."""
        return {**super().idle(), **({} if self.closing else {"low": self.low, "high": self.high})}

    def carried(self, before: Any) -> Mapping[str, float]:
        """Over another parameter the range is another one."""
        return {**super().carried(before), **({} if self.over == before.over else {"low": 0.0, "high": 0.0})}

    def derived(self) -> Iterator[str]:
        """The bifurcations of the branch."""
        yield from super().derived()
        if self.known("continuation") and self.continuation is not None:
            yield from self.continuation.derived()

    def status(self) -> Iterator[str]:
        """How exact the branch is."""
        yield from super().status()
        if self.known("continuation") and self.continuation is not None:
            yield from self.continuation.status()

    def notes(self) -> Iterator[str]:
        """Why the branch ends within the range."""
        yield from super().notes()
        if self.known("continuation") and self.continuation is not None:
            yield from self.continuation.notes()


def branch_picture(scene: type[Branched]) -> Plot[Any]:
    """The branch over its parameter."""

    def at_the_value(s: Any, axes: Axes) -> list[Array]:
        return [np.array([[s._at, axes.y[0]], [s._at, axes.y[1]]])]

    def shown(s: Any, axes: Axes) -> Array | None:
        return None if s.here is None else seen(s.here[::-1].T, s.turn, Axes(axes.y, axes.x))[:, ::-1].T

    def boxed(s: Any, corners: Corners) -> Values:
        x0, _, x1, _ = corners
        return {} if x0 == x1 or not s.continued else {"low": min(x0, x1), "high": max(x0, x1)}

    return Plot(
        name="branch", title="Branch of the periodic orbit", caption=scene._caption,
        folded="Show the branch of the periodic orbit", axes=lambda s: (s.over, s.upwards),
        message=lambda s: s._nothing(), on_click=lambda s, x, y: s.on_branch(x, y), on_box=boxed,
        on_hover=lambda s, x, y: s.about_branch(x, y),
        x=lambda s: s.branch_ends, y=lambda s: s.upwards_range,
        layers=(curves("value", within=at_the_value, color=theme.INK, width=1.5, label="the state on show"),
                *view.layers(lambda s: s.continued, lambda s: s._side, lambda s: s.turn),
                points("shown", within=shown, size=15, color=theme.INK, hollow=True, edge_width=2.0,
                       label="the periodic orbit on show")))
