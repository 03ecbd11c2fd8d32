"""Continuation of a periodic orbit in a parameter, computed in pieces; a click selects an orbit."""

from __future__ import annotations

import math
from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from operator import itemgetter
from typing import TypeVar

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.families import BranchStart
from hess_explorer.scenes.framework.part import HasSection, Part
from hess_explorer.scenes.framework.periodic_search import ClosedOrbit, NotFound, Point
from hess_explorer.scenes.framework.windows import Window
from hess_explorer.views.caption import Caption
from hess_explorer.views.maps.branch import bifurcations
from hess_explorer.views.text import conjugates, digits
from hess_mechanics.dynamics import continuation as mechanics
from hess_mechanics.dynamics.continuation import Bifurcation, branch_from, extension
from hess_mechanics.dynamics.periodic import difference, find_periodic
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.errors import ModelError
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array

_TOGETHER = 60
"""Points of a branch computed at once: few enough to arrive soon."""
_PARTS = 16
"""Largest number of pieces of a branch in each direction."""
_STEP = 0.02
"""Longest step, in units of the coordinates and the range: with a turn of 0.3 rad its chord is off by half a pixel."""
_LEAST_ADVANCE = 1e-4
"""Least advance of a piece, as a share of the range or in a coordinate: shorter pieces show no progress."""
_NEAR = 12.0
"""Largest distance of the mouse from a branch that it selects, in pixels."""
_MOST_LISTED = 8
"""Largest number of bifurcations listed."""


_Nearest = tuple[float, mechanics.Branch, int, float, int]
"""Distance in pixels from a branch, the branch, index of a segment, position on it (0 to 1), index on the orbit."""


H_co = TypeVar("H_co", bound=HasSection, covariant=True)


@dataclass(frozen=True, eq=False)
class Continuation(Part[H_co]):
    """The known pieces of a branch; no more are computed while a slider is held."""

    @property
    @abstractmethod
    def branch_start(self) -> BranchStart | None:
        """The start of the branch; None if no branch is requested."""

    @property
    @abstractmethod
    def side(self) -> int:
        """Index of the coordinate on the vertical axis."""

    @property
    @abstractmethod
    def frame(self) -> Window:
        """The visible window."""

    @property
    def turn(self) -> float:
        """The period of the coordinate on the vertical axis; ∞ if it is not an angle.  Raises `ModelError`."""
        return self.host.poincare.turns[self.side]

    @cached_property
    def _target(self) -> ClosedOrbit | NotFound | None:
        """The orbit to continue, or the reason why there is none; None until known, and if no branch is requested."""
        return None if self.branch_start is None else self.work.need(self.branch_start.search, preview=None)

    @property
    def closed_orbit(self) -> ClosedOrbit | None:
        """The orbit to continue; None until known, and if there is none."""
        return self._target if isinstance(self._target, ClosedOrbit) else None

    @cached_property
    def _pieces(self) -> tuple[list[mechanics.Branch], list[str], bool]:
        """The known pieces of the branch, the reasons for missing pieces, and whether all pieces are known."""
        found: list[mechanics.Branch] = []
        failed: list[str] = []
        whole = True
        begin = self.branch_start
        if begin is None or self.closed_orbit is None:
            return found, failed, False
        low, high = begin.ends
        for upwards in (True, False):
            if begin.value == begin.ends[upwards]:
                continue
            for k in range(_PARTS):
                one: mechanics.Branch | NotFound | None = self.work.need(Task(_part, begin, upwards, k), preview=None)
                if one is None or isinstance(one, NotFound):
                    failed += [] if one is None else [one.reason]
                    whole = whole and one is not None
                    break
                found.append(one)
                advance = max(float(np.ptp(one.values)) / (high - low), float(np.ptp(one.points, axis=0).max()))
                # Stop near a tangency with the section, where further pieces would hardly advance.
                if one.heading is None or advance < _LEAST_ADVANCE:
                    break
        return found, failed, whole

    @property
    def branches(self) -> list[mechanics.Branch]:
        """The known pieces of the branch; empty until the first is known."""
        return self._pieces[0]

    # ---- mouse events -------------------------------------------------------------------------------------------

    def _pixels(self, values: Array, points: Array, x: float, y: float) -> Array:
        """Return the pixels (n, 2) from (x, y) to points (n, d) at values (n,) of the parameter."""
        (x0, y0), (x1, y1) = self.frame
        up = difference((self.turn,), points[:, self.side, None], np.array([y]))[:, 0]
        return np.column_stack([values - x, up]) * (PIXELS / (x1 - x0), PIXELS / (y1 - y0))

    def _nearest(self, x: float, y: float) -> _Nearest | None:
        found: list[_Nearest] = []
        for branch in self.branches:
            if len(branch.values) < 2:
                continue
            for j in range(branch.period):
                at = self._pixels(branch.values, branch.points[:, j], x, y)
                along = np.diff(at, axis=0)
                length2 = np.maximum(np.sum(along**2, axis=1), 1e-300)
                share = np.clip(-np.sum(at[:-1] * along, axis=1) / length2, 0.0, 1.0)
                away = np.hypot(*(at[:-1] + share[:, None] * along).T)
                i = int(np.argmin(away))
                found.append((float(away[i]), branch, i, float(share[i]), j))
        near = min(found, key=itemgetter(0), default=None)
        return near if near is not None and near[0] <= _NEAR else None

    def orbit_at(self, x: float, y: float) -> tuple[float, Point, int] | None:
        """Return the parameter, the point nearest to (x, y) and the period of the branch's orbit there.

        None if the branch is more than 12 pixels away.
        """
        near = self._nearest(x, y)
        if near is None or self.branch_start is None:
            return None
        _, branch, i, share, j = near
        turns = self.host.poincare.turns
        (a, b), (first, second), m = branch.points[i : i + 2], branch.values[i : i + 2], branch.period
        between = np.roll(a + share * difference(turns, b, a), -j, axis=0)
        value = float(first + share * (second - first))
        try:
            point = find_periodic(self.branch_start.family.map_at(value), between, m).points[0]
        except ModelError:
            check_limit()
            value, point = float(first), a[j]
        # The section has angles between −turn/2 and turn/2.
        return (
            value,
            tuple(
                float(one) if math.isinf(turn) else math.remainder(float(one), turn)
                for one, turn in zip(point, turns, strict=True)
            ),
            m,
        )

    def tooltip(self, x: float, y: float) -> str:
        """Return a tooltip on the bifurcation or the orbit of the branch at (x, y); empty away from the branch."""
        for one in bifurcations(self.branches):
            if np.hypot(*self._pixels(np.full(len(one.points), one.value), one.points, x, y).T).min() <= _NEAR:
                return self._bifurcation_text(one)
        near = self._nearest(x, y)
        if near is None:
            return ""
        _, branch, before, share, _ = near
        i = before + round(share)
        multipliers = ", ".join(conjugates(complex(one)) for one in branch.multipliers[i])
        return (
            f"{branch.parameter} = {digits(float(branch.values[i]))}: period {branch.period}, "
            f"{branch.kinds[i]}, μ = {multipliers}"
        )

    # ---- texts --------------------------------------------------------------------------------------------------

    def _bifurcation_text(self, one: Bifurcation) -> str:
        value = f"{digits(one.value, 8)} ± {digits(one.error, 1)}"
        return f"{one.kind} of period {len(one.points)} at {self.branches[0].parameter} = {value}"

    @property
    def caption(self) -> Caption:
        """The caption of the branch."""
        if self.branch_start is None or isinstance(self._target, NotFound):
            return Caption("No periodic orbit found near this point.")
        if self.closed_orbit is None:
            return Caption(self.work.pending_caption("A periodic orbit is"))
        found, _, whole = self._pieces
        orbit = self.closed_orbit.orbit
        known = bifurcations(found)
        some = f"{len(known)} bifurcation{'s' * (len(known) != 1)}" if known else "No bifurcation"
        return Caption(
            f"Period {orbit.period}, {orbit.kind} here.", f"{some} on its branch{'' if whole else ' so far'}."
        )

    def quantities(self) -> Iterator[str]:
        """Yield the first eight bifurcations, and the number of the others."""
        found = bifurcations(self.branches) if self.has_result("_pieces") else []
        yield from map(self._bifurcation_text, found[:_MOST_LISTED])
        if len(found) > _MOST_LISTED:
            yield f"and {len(found) - _MOST_LISTED} more bifurcations of the branch"

    def status(self) -> Iterator[str]:
        """Yield the number of points of the branch and its largest error."""
        if self.has_result("_pieces") and self.branches:
            yield (
                f"branch {sum(len(one.values) for one in self.branches)} points, error "
                f"{digits(max(one.error_estimate for one in self.branches), 1)}"
            )

    def notes(self) -> Iterator[str]:
        """Yield the reasons why there is no branch, or why it ends or is not computed further inside the range."""
        if not self.has_result("_pieces"):
            return
        if isinstance(self._target, NotFound):
            yield self._target.reason
        if self.branch_start is None or self.closed_orbit is None:
            return
        found, failed, whole = self._pieces
        yield from failed
        open_ends = 2 - (self.branch_start.value in self.branch_start.ends)
        if whole and not failed and sum(one.heading is None for one in found) < open_ends:
            yield "The branch continues, but is not computed further."
        ended = [
            one.end_reason for one in found if one.heading is None and "the end of the range" not in one.end_reason
        ]
        yield from (f"The branch ends. {why}" for why in ended)


def _part(begin: BranchStart, upwards: bool, k: int) -> mechanics.Branch | NotFound:
    """Return piece k of the branch that starts towards larger (`upwards`) or smaller values, or why it is missing."""
    found = begin.search.get()
    if isinstance(found, NotFound):
        return found
    family, end, edge = begin.family, begin.ends[upwards], begin.ends[not upwards]
    points = max(6, _TOGETHER // found.orbit.period)
    try:
        if k == 0:
            return branch_from(family.map_at, found.orbit, family.symbol, begin.value, end, points, edge, _STEP)
        before = Task(_part, begin, upwards, k - 1).get()
        assert not isinstance(before, NotFound), "pieces are continued one after the other"
        return extension(family.map_at, before, end, edge, points, _STEP)
    except ModelError as error:
        check_limit()
        return NotFound(str(error))
