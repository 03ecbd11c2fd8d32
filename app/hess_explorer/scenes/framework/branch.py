"""The branch of a periodic orbit over a parameter of a scene: computed in parts, what the mouse means on it, words."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from hess_explorer.compute.cache import CACHE
from hess_explorer.protocol.parameters import Value
from hess_explorer.scenes.framework.periodic_search import Closed, Missed, Place, sought
from hess_explorer.scenes.framework.scene import State
from hess_explorer.scenes.framework.windows import Window
from hess_explorer.scenes.framework.work import Work
from hess_explorer.views.branch import bifurcations
from hess_explorer.views.text import conjugates, digits, power
from hess_mechanics.dynamics.continuation import Bifurcation, Branch, continued, gone_on
from hess_mechanics.dynamics.periodic import Map, apart, find_periodic
from hess_mechanics.dynamics.return_map import PoincareSection, ReturnMap
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.accuracy import PRECISE
from hess_mechanics.numerics.patience import go_on
from hess_mechanics.numerics.results import Array

__all__ = ["Begin", "Continuation", "Family"]

_TOGETHER = 60
"""Places on a branch that are computed at once: few enough for them to arrive soon."""
_PARTS = 16
"""Of a branch in each direction, at most."""
_STEP = 0.02
"""Of the width of the range, at most: lines between points are then half a pixel off, as directions differ by 0.3."""
_CREEPING = 1e-4
"""Of the width of the range, and of the coordinates: with parts that are shorter nobody sees a branch go on."""
_NEAR = 12.0
"""Pixels from a branch within which the mouse means it."""
_SAID = 8
"""Bifurcations that are listed."""


@dataclass(frozen=True)
class Family:
    """A scene's section, and its return map, over one of its parameters.

    state : of the scene; name, symbol : of the parameter; others : what else the section depends on, by name.
    """

    state: type[State]
    name: str
    symbol: str
    others: tuple[tuple[str, Value], ...]

    @classmethod
    def of(cls, state: State, name: str, symbol: str, names: tuple[str, ...]) -> Family:
        """About a state; names : of all that the section depends on."""
        return cls(type(state), name, symbol, tuple((one, getattr(state, one)) for one in names if one != name))

    def __call__(self, value: float) -> PoincareSection:
        """The section at a value of the parameter.  Raises `ModelError`."""
        state: Any = self.state  # its fields are known only where the scene declares its parameters
        found: PoincareSection = state(**dict(self.others), **{self.name: value}).section
        return found

    def map_at(self, value: float) -> ReturnMap:
        """The return map there.  Raises `ModelError`."""
        return ReturnMap(self(value), PRECISE)


@dataclass(frozen=True)
class Begin:
    """Where a branch begins: the value of the parameter, the place and the period, and the ends of the range."""

    family: Family
    value: float
    place: Place
    period: int | None
    ends: tuple[float, float]

    def orbit(self) -> Closed | Missed:
        """The orbit there."""
        found: Closed | Missed = CACHE.get(sought, self.family.map_at(self.value), self.place, self.period, False)[0]
        return found


@dataclass(frozen=True)
class _Nearest:
    """The place of a branch that is nearest to the mouse: how far, in pixels, between which points of it, and where."""

    away: float
    branch: Branch
    i: int
    share: float
    j: int

    @property
    def value(self) -> float:
        """Of the parameter."""
        a, b = self.branch.values[self.i : self.i + 2]
        return float(a + self.share * (b - a))


@dataclass(frozen=True)
class Continuation:
    """What is known of a branch; while a slider is held, nothing more is asked for.

    side : which coordinate of the section is drawn, upwards.
    """

    work: Work
    begin: Begin
    side: int

    @property
    def symbol(self) -> str:
        """Of the parameter."""
        return self.begin.family.symbol

    @cached_property
    def turns(self) -> tuple[float, ...]:
        """The period of each coordinate, ∞ where it is no angle.  Raises `ModelError`."""
        return self.begin.family.map_at(self.begin.value).turns

    @property
    def turn(self) -> float:
        """Of the coordinate that is drawn."""
        return self.turns[self.side]

    @cached_property
    def _found(self) -> Closed | Missed | None:
        """The orbit from which it is continued; None while that is not known."""
        search = (self.begin.family.map_at(self.begin.value), self.begin.place, self.begin.period, False)
        found: Closed | Missed | None = self._ask(sought, *search)
        return found

    @property
    def closed(self) -> Closed | None:
        """The same where there is one."""
        return self._found if isinstance(self._found, Closed) else None

    def _ask(self, function: Any, *arguments: Any) -> Any:
        return (self.work.known if self.work.dragging else self.work.later)(function, *arguments)

    @cached_property
    def _known(self) -> tuple[list[Branch], list[str], bool]:
        """What is known of the branch, why parts of it could not be computed, and whether that is all."""
        found: list[Branch] = []
        failed: list[str] = []
        whole = True
        if self.closed is None:
            return found, failed, False
        for upwards in (True, False):
            if self.begin.value == self.begin.ends[upwards]:
                continue
            for k in range(_PARTS):
                one: Branch | Missed | None = self._ask(_part, self.begin, upwards, k)
                if one is None or isinstance(one, Missed):
                    failed += [] if one is None else [one.reason]
                    whole = whole and one is not None
                    break
                found.append(one)
                if one.heading is None or self._creeps(one):
                    break
        return found, failed, whole

    def _creeps(self, part: Branch) -> bool:
        """Whether it hardly gets on, as where orbits begin to touch the section and the map has no derivative."""
        low, high = self.begin.ends
        return max(float(np.ptp(part.values)) / (high - low), float(np.ptp(part.places, axis=0).max())) < _CREEPING

    @property
    def branches(self) -> list[Branch]:
        """What is known of the branch."""
        return self._known[0]

    # ---- what the mouse does ------------------------------------------------------------------------------------

    def _nearest(self, x: float, y: float, frame: Window) -> _Nearest | None:
        (x0, y0), (x1, y1) = frame
        scale = PIXELS / (x1 - x0), PIXELS / (y1 - y0)
        best: _Nearest | None = None
        for branch in self.branches:
            if len(branch.values) < 2:
                continue
            for j in range(branch.period):
                across = apart((self.turn,), branch.places[:, j, self.side, None], np.array([y]))[:, 0]
                at = np.column_stack([(branch.values - x) * scale[0], across * scale[1]])
                along = np.diff(at, axis=0)
                length2 = np.maximum(np.sum(along**2, axis=1), 1e-300)
                share = np.clip(-np.sum(at[:-1] * along, axis=1) / length2, 0.0, 1.0)
                away = np.hypot(*(at[:-1] + share[:, None] * along).T)
                i = int(np.argmin(away))
                if best is None or away[i] < best.away:
                    best = _Nearest(float(away[i]), branch, i, float(share[i]), j)
        return best if best is not None and best.away <= _NEAR else None

    def chosen(self, x: float, y: float, frame: Window) -> tuple[float, Place, int] | None:
        """Of the orbit of the branch at (x, y): the parameter, a place and the period; None away from the branch."""
        near = self._nearest(x, y, frame)
        if near is None:
            return None
        a, b = near.branch.places[near.i : near.i + 2]
        between = np.roll(a + near.share * apart(self.turns, b, a), -near.j, axis=0)
        value, m = near.value, near.branch.period
        try:
            place = find_periodic(self.begin.family.map_at(value), between, m).places[0]
        except ModelError:
            go_on()
            value, place = float(near.branch.values[near.i]), a[near.j]
        # Angles as the section has them.
        return value, tuple(float(one) if math.isinf(turn) else math.remainder(float(one), turn)
                            for one, turn in zip(place, self.turns, strict=True)), m

    def about(self, x: float, y: float, frame: Window) -> str:
        """The bifurcation, or the orbit of the branch, under the mouse."""
        (x0, y0), (x1, y1) = frame
        for one in bifurcations(self.branches):
            up = apart((self.turn,), one.places[:, self.side, None], np.array([y]))
            if math.hypot((one.value - x) * PIXELS / (x1 - x0), float(np.abs(up).min()) * PIXELS / (y1 - y0)) <= _NEAR:
                return self._named(one)
        near = self._nearest(x, y, frame)
        if near is None:
            return ""
        i = near.i + round(near.share)
        multipliers = ", ".join(conjugates(complex(one)) for one in near.branch.multipliers[i])
        return (f"{self.symbol} = {digits(float(near.branch.values[i]), 6)}: period {near.branch.period}, "
                f"{near.branch.kinds[i]}, μ = {multipliers}")

    # ---- words --------------------------------------------------------------------------------------------------

    def _named(self, one: Bifurcation) -> str:
        return f"{one.kind} of period {len(one.places)} at {self.symbol} = {digits(one.value, 8)} ± {power(one.error)}"

    @property
    def caption(self) -> str:
        """Of the picture; empty while the orbit itself is not known."""
        if self._found is None:
            return ""
        if self.closed is None:
            return "No periodic orbit is found from here: no branch."
        found, _, whole = self._known
        orbit = self.closed.orbit
        known = bifurcations(found)
        some = f"{len(known)} bifurcation{'s' * (len(known) != 1)}" if known else "no bifurcation"
        return f"Period {orbit.period}, {orbit.kind} here; its branch has {some}{'' if whole else ' so far'}."

    def derived(self) -> Iterator[str]:
        """The bifurcations of the branch."""
        found = bifurcations(self.branches)
        yield from map(self._named, found[:_SAID])
        if len(found) > _SAID:
            yield f"and {len(found) - _SAID} more bifurcations of the branch"

    def status(self) -> Iterator[str]:
        """How exact the branch is."""
        if self.branches:
            yield (f"branch {sum(len(one.values) for one in self.branches)} points, places to "
                   f"{power(max(one.error_estimate for one in self.branches))}")

    def notes(self) -> Iterator[str]:
        """Why there is no branch, or why it ends within the range."""
        if isinstance(self._found, Missed):
            yield self._found.reason
        if self.closed is None:
            return
        found, failed, whole = self._known
        yield from failed
        if whole and not failed and sum(one.heading is None for one in found) < 2 - (
                self.begin.value in self.begin.ends):
            yield "The branch goes on: no more of it is computed."
        ended = [one.ended for one in found if one.heading is None and "the end of the range" not in one.ended]
        yield from (f"The branch ends. {why}" for why in ended)


def _symmetries(map_: Map, places: Array) -> tuple[str, ...]:
    assert isinstance(map_, ReturnMap)
    return tuple(map_.symmetries_of(places))


def _part(begin: Begin, upwards: bool, k: int) -> Branch | Missed:
    """The part of this number of the branch, from its beginning towards larger values of the parameter, or smaller."""
    found = begin.orbit()
    if isinstance(found, Missed):
        return found
    family, end, edge = begin.family, begin.ends[upwards], begin.ends[not upwards]
    points = max(6, _TOGETHER // found.orbit.period)
    try:
        if k == 0:
            return continued(family.map_at, found.orbit, family.symbol, begin.value, end, points, _symmetries, edge,
                             _STEP)
        before, _ = CACHE.get(_part, begin, upwards, k - 1)
        return gone_on(family.map_at, before, end, edge, points, _symmetries, _STEP)
    except ModelError as error:
        go_on()
        return Missed(str(error))
