"""An orbit diagram with the branch of a periodic orbit over it, continued through folds, in parts."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import CACHE
from hess_explorer.protocol.parameters import Values, written
from hess_explorer.scenes.framework.over_parameter import OverParameter
from hess_explorer.scenes.framework.parameters import choice
from hess_explorer.scenes.framework.periodic_search import NONE, PERIODS, Closed, Missed, Place, sought
from hess_explorer.views.branch import bifurcations
from hess_explorer.views.text import conjugates, digits, power
from hess_mechanics.dynamics.continuation import Bifurcation, Branch, continued, gone_on
from hess_mechanics.dynamics.periodic import Map, apart, find_periodic
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.accuracy import PRECISE
from hess_mechanics.numerics.patience import go_on
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov.parameter_diagram import moved
from hess_mechanics.suslov.section import SuslovSection

__all__ = ["Continued"]

_TOGETHER = 60
"""Places on a branch that are computed at once: few enough for them to arrive soon."""
_PARTS = 16
"""Of a branch in each direction, at most."""
_STEP = 0.02
"""Of the width of the range, at most: lines between points are then half a pixel off, as directions differ by 0.3."""
_NEAR = 12.0
"""Pixels from a branch within which the mouse means it."""
_SAID = 8
"""Bifurcations that are listed."""


@dataclass(frozen=True)
class _Begin:
    """Where a branch begins: the section, whatever the parameter is in it, its value, the place, the period, and the
    ends of the range."""

    section: SuslovSection
    name: str
    value: float
    place: Place
    period: int | None
    ends: tuple[float, float]

    def map_at(self, value: float) -> ReturnMap:
        """The return map at a value of the parameter."""
        return ReturnMap(moved(self.section, self.name, value), PRECISE)

    def orbit(self) -> Closed | Missed:
        """Where it begins."""
        found: Closed | Missed = CACHE.get(sought, self.map_at(self.value), self.place, self.period, False)[0]
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
class Continued(OverParameter):
    """An orbit diagram, and over it the branch of the periodic orbit that is found from the chosen place."""

    branch: str = choice("Branch of a periodic orbit", (NONE, *PERIODS), NONE, group="State",
                         doc="Over the diagram: the periodic orbit that Newton's method finds from the chosen place, "
                             "continued in the parameter, through folds. A click on it shows that orbit.")

    @cached_property
    def _begin(self) -> _Begin | None:
        """Where the branch begins, if one is asked for."""
        if self.branch == NONE:
            return None
        (low, _), (high, _) = self.frame
        return _Begin(moved(self.section, self.name, self.first), self.name, self.at, self.place, PERIODS[self.branch],
                      (min(low, self.at), max(high, self.at)))

    @cached_property
    def _closed(self) -> Closed | Missed | None:
        """The orbit from which it is continued; None while that is not known."""
        begin = self._begin
        if begin is None:
            return None
        search = (begin.map_at(begin.value), begin.place, begin.period, False)
        return self.work.known(sought, *search) if self.dragging else self.work.later(sought, *search)

    @property
    def closed(self) -> Closed | None:
        """The same where there is one."""
        return self._closed if isinstance(self._closed, Closed) else None

    @cached_property
    def _continued(self) -> tuple[list[Branch], list[str], bool]:
        """What is known of the branch, why parts of it could not be computed, and whether that is all."""
        found: list[Branch] = []
        failed: list[str] = []
        whole = True
        if self.closed is None or self._begin is None:
            return found, failed, False
        for upwards in (True, False):
            if self._begin.value == self._begin.ends[upwards]:
                continue
            for k in range(_PARTS):
                asked = (self._begin, upwards, k)
                one = self.work.known(_part, *asked) if self.dragging else self.work.later(_part, *asked)
                if one is None or isinstance(one, Missed):
                    failed += [] if one is None else [one.reason]
                    whole = whole and one is not None
                    break
                found.append(one)
                if one.heading is None:
                    break
        return found, failed, whole

    @property
    def continued(self) -> list[Branch]:
        """What is known of the branch."""
        return self._continued[0]

    @property
    def turn(self) -> float:
        """Of the coordinate that the diagram shows."""
        return self.section.turns[self.side]

    # ---- what the mouse does ------------------------------------------------------------------------------------

    def _nearest(self, x: float, y: float) -> _Nearest | None:
        (x0, y0), (x1, y1) = self.frame
        scale = PIXELS / (x1 - x0), PIXELS / (y1 - y0)
        best: _Nearest | None = None
        for branch in self.continued:
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

    def choose(self, x: float, y: float) -> Values:
        """A click: on the branch, the parameter and the orbit that is there; elsewhere, what is seen there."""
        near = self._nearest(x, y)
        if near is None or self._begin is None:
            return super().choose(x, y)
        a, b = near.branch.places[near.i : near.i + 2]
        between = np.roll(a + near.share * apart(self.section.turns, b, a), -near.j, axis=0)
        value = near.value
        try:
            place = find_periodic(self._begin.map_at(value), between, near.branch.period).places[0]
        except ModelError:
            go_on()
            value, place = float(near.branch.values[near.i]), a[near.j]
        psi = math.remainder(float(place[0]), 2.0 * math.pi)
        return {self.name: value, "chosen": written([(psi, float(place[1]))])}

    def about(self, x: float, y: float) -> str:
        """The bifurcation, or the orbit of the branch, under the mouse."""
        (x0, y0), (x1, y1) = self.frame
        for one in bifurcations(self.continued):
            up = apart((self.turn,), one.places[:, self.side, None], np.array([y]))
            if math.hypot((one.value - x) * PIXELS / (x1 - x0), float(np.abs(up).min()) * PIXELS / (y1 - y0)) <= _NEAR:
                return self._named(one)
        near = self._nearest(x, y)
        if near is None:
            return ""
        i = near.i + round(near.share)
        multipliers = ", ".join(conjugates(complex(one)) for one in near.branch.multipliers[i])
        return (f"{self.along} = {digits(float(near.branch.values[i]), 6)}: period {near.branch.period}, "
                f"{near.branch.kinds[i]}, μ = {multipliers}")

    # ---- words --------------------------------------------------------------------------------------------------

    def _named(self, one: Bifurcation) -> str:
        return f"{one.kind} of period {len(one.places)} at {self.along} = {digits(one.value, 8)} ± {power(one.error)}"

    def _about_diagram(self) -> str:
        if self._begin is None:
            return super()._about_diagram()
        if self._closed is None:
            return self.awaited("A periodic orbit is")
        if self.closed is None:
            return "No periodic orbit is found from here: no branch."
        found, _, whole = self._continued
        orbit = self.closed.orbit
        known = bifurcations(found)
        some = f"{len(known)} bifurcation{'s' * (len(known) != 1)}" if known else "no bifurcation"
        return f"Period {orbit.period}, {orbit.kind} here; its branch has {some}{'' if whole else ' so far'}."

    def derived(self) -> Iterator[str]:
        """The bifurcations of the branch."""
        for one in bifurcations(self.continued)[:_SAID]:
            yield self._named(one)
        more = len(bifurcations(self.continued)) - _SAID
        if more > 0:
            yield f"and {more} more bifurcations of the branch"

    def status(self) -> Iterator[str]:
        """How exact the branch is."""
        found = self.continued
        if found:
            yield (f"branch {sum(len(one.values) for one in found)} points, places to "
                   f"{power(max(one.error_estimate for one in found))}")

    def notes(self) -> Iterator[str]:
        """Why there is no branch, or why it ends within the range."""
        yield from super().notes()
        if self._begin is None or self._closed is None:
            return
        if isinstance(self._closed, Missed):
            yield self._closed.reason
        found, failed, whole = self._continued
        yield from failed
        if whole and not failed and sum(one.heading is None for one in found) < 2 - (self.at in self._begin.ends):
            yield "The branch goes on: no more of it is computed."
        ended = [one.ended for one in found if one.heading is None and "the end of the range" not in one.ended]
        yield from (f"The branch ends. {why}" for why in ended)


def _symmetries(map_: Map, places: Array) -> tuple[str, ...]:
    assert isinstance(map_, ReturnMap)
    return tuple(map_.symmetries_of(places))


def _part(begin: _Begin, upwards: bool, k: int) -> Branch | Missed:
    """The part of this number of the branch, from its beginning towards larger values of the parameter, or smaller."""
    found = begin.orbit()
    if isinstance(found, Missed):
        return found
    end, edge = begin.ends[upwards], begin.ends[not upwards]
    points = max(6, _TOGETHER // found.orbit.period)
    try:
        if k == 0:
            return continued(begin.map_at, found.orbit, begin.name, begin.value, end, points, _symmetries, edge, _STEP)
        before, _ = CACHE.get(_part, begin, upwards, k - 1)
        return gone_on(begin.map_at, before, end, edge, points, _symmetries, _STEP)
    except ModelError as error:
        go_on()
        return Missed(str(error))
