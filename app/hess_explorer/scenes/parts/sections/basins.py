"""Basins in a section of the Suslov problem: attractor and arrival time of each pixel, and the basin boundaries."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.part import Host, Part
from hess_explorer.scenes.framework.periodic_search import ClosedOrbit, Search, branch_of, find_orbit
from hess_explorer.scenes.framework.trial import Trial
from hess_explorer.scenes.framework.windows import Window, pixels_in
from hess_explorer.scenes.parts.sections.section import Section
from hess_explorer.views.caption import Caption
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.attraction import CROSSINGS, LOST, NOWHERE, Arrivals, arrivals
from hess_mechanics.dynamics.basin_boundary import ambiguity, arrivals_of_cells, cells_to_compute, coarsest_cells, merge
from hess_mechanics.dynamics.basins import Attractors, SectionOrbits, attractors
from hess_mechanics.dynamics.cells import centres, even_points
from hess_mechanics.dynamics.edge import saddle_between
from hess_mechanics.dynamics.manifolds import Manifold
from hess_mechanics.dynamics.periodic import PeriodicOrbit
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.errors import NotConverged
from hess_mechanics.numerics.accuracy import PRECISE, Accuracy, Kind, Plan
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array, Mask
from hess_mechanics.suslov.suslov_section import SuslovSection

_PIXELS = (512, 512)
_STAGES = 6
"""Each stage has twice as many cells across and up as the one before; those of the last are the pixels."""
_EVERYWHERE = 4
"""In stages with fewer cells, all are divided, for the times of arrival; later only those on a boundary."""
_PARTS = 2
"""Tasks of each stage, for two cores."""
_MOST = 20_000
"""Largest number of orbits of a later stage: a boundary in more cells is not a curve, and they stay undivided."""
_SPREAD = even_points(20_000).T
"""Points of the unit square at which cells are measured."""
_SEARCHES = 8
"""Number of boundary points at which the search for saddles starts."""
_NUMBERS = {2: "Two", 3: "Three", 4: "Four", 5: "Five"}


class _Host(Host, Protocol):
    @property
    def poincare(self) -> SuslovSection:
        """The section in its coordinates.  Raises `ModelError`."""

    @property
    def long(self) -> float:
        """The averaging time of the divergence."""

    @property
    def reach(self) -> float:
        """The length of each branch of a manifold."""


@dataclass(frozen=True)
class _BasinGrid:
    """Basins in a window of (m, n) pixels of a section; the divergence is averaged over the time `long`."""

    section: SuslovSection
    window: Window
    pixels: tuple[int, int]
    long: float
    level: Accuracy

    @property
    def orbits(self) -> SectionOrbits:
        """The orbits from the cells."""
        return SectionOrbits(self.section, self.level)

    def new_cells(self, stage: int, before: Arrivals | None) -> Mask:
        """Return the mask (n, m) of the cells to compute in a stage."""
        m, n = (side >> (_STAGES - 1 - stage) for side in self.pixels)
        return cells_to_compute(before, (m, n), stage < _EVERYWHERE, _MOST)

    def arrivals(self, there: Attractors, mask: Mask, i: int) -> Arrivals:
        """Return the arrivals of one part of the cells in a mask (n, m)."""
        return arrivals_of_cells(self.orbits, there.sets, self.window, mask, slice(i, None, _PARTS))

    def attractors(self) -> Attractors:
        """Return the attractors of the whole section."""
        return Task(attractors, self.section, self.long, self.level).get()


@dataclass(frozen=True)
class _Piece:
    """A part of the new cells of a stage."""

    stage: int
    arrivals: Arrivals


@dataclass(frozen=True, eq=False)
class SectionBasins(Part[_Host]):
    """The basins in a section of the Suslov problem, refined to the pixel, and the saddles on their boundaries.

    Attributes
    ----------
    section : Section
        The section, with its visible window.
    """

    section: Section

    @property
    def is_on(self) -> bool:
        """True if basins are shown, in addition to the orbits of the section."""
        return not self.section.is_exclusive

    def target(self, plan: Plan) -> _BasinGrid:
        """Return the basins to compute at a level."""
        long = self.work.plan(Kind.EXPONENT).share * self.host.long
        return _BasinGrid(self.host.poincare, self.section.frame, plan.grid(_PIXELS), long, plan.level)

    @cached_property
    def _what(self) -> _BasinGrid | None:
        """The basins to compute; None if none are shown, and during a drag."""
        return self.target(self.work.plan(Kind.BASINS)) if self.is_on and not self.work.is_preview else None

    @cached_property
    def stage(self) -> int:
        """The newest known stage; −1 before the first stage."""
        if self._what is None:
            return -1
        chains = [[Task(_piece, self._what, stage, i) for stage in range(_STAGES)] for i in range(_PARTS)]
        pieces: list[_Piece | None] = self.work.newest_results(chains)
        return min(-1 if one is None else one.stage for one in pieces)

    @property
    def is_complete(self) -> bool:
        """True if all stages are known."""
        return self.stage == _STAGES - 1

    @cached_property
    def arrivals(self) -> Arrivals | None:
        """Attractor and arrival time of each cell (n, m); coarse until all stages are known.

        None until the first stage is known, and without attractors.
        """
        if self._what is None or self.stage < 0 or not self._what.attractors().count:
            return None
        return self.work.need(Task(_cells, self._what, self.stage))

    @cached_property
    def attractors(self) -> Attractors | None:
        """The attractors of the section; None until the first stage is known."""
        return None if self._what is None or self.stage < 0 else self._what.attractors()

    # ---- boundaries ---------------------------------------------------------------------------------------------

    @cached_property
    def _searches(self) -> tuple[Search, ...]:
        """The searches for saddles on the boundaries; empty until these are known."""
        if self._what is None or not self.is_complete:
            return ()
        return self.work.need(Task(_saddles, self._what), preview=None) or ()

    @cached_property
    def saddles(self) -> list[PeriodicOrbit]:
        """The known saddles on the boundaries."""
        found = [self.work.need(Task(find_orbit, *search), preview=None) for search in self._searches]
        return [one.orbit for one in found if isinstance(one, ClosedOrbit)]

    @cached_property
    def manifolds(self) -> list[Manifold]:
        """The known branches of the stable manifolds of the saddles."""
        if not self.host.reach:
            return []
        pixel = 1.0 / max(pixels_in(self.section.frame))
        found = [
            self.work.need(Task(branch_of, search, (index, True, side), self.host.reach, pixel), preview=None)
            for search in self._searches
            for index in range(search[2] or 1)
            for side in (1, -1)
        ]
        return [one for one in found if isinstance(one, Manifold)]

    # ---- texts --------------------------------------------------------------------------------------------------

    @property
    def caption(self) -> Caption | None:
        """The caption of a section with basins; None without them, and during a drag."""
        if self._what is None:
            return None
        if self.attractors is None:
            return Caption(self.work.pending_caption(), "Searching for attractors with 256 orbits.")
        largest, count = self.attractors.largest, self.attractors.count
        if largest is None:
            return Caption("No recurrent motion found.")
        div = f"mean div = {digits(largest.mean, 2)} ± {digits(largest.error, 1)}"
        if not count or self.arrivals is None:
            return Caption("No attractor is visible.", f"{div}.")
        numbers = self.arrivals.number
        there = numbers[numbers != NOWHERE]
        if not there.size:
            return Caption("No motion is possible in this window.")
        m, n = numbers.shape[::-1]
        said = "" if self.is_complete else f" So far {m} × {n} cells."
        lost = 100.0 * float(np.mean(there == LOST))
        late = f" {digits(lost, 2)} % reach no attractor in {CROSSINGS} crossings." if lost else ""
        if count == 1:
            words = "One attractor for all cells." if not lost else "One attractor."
            return Caption(words, f"{div}.{late}{said}" if self.attractors.all_attract else f"{late}{said}".strip())
        *parts, last = (f"{digits(100.0 * float(np.mean(there == one)), 2)} %" for one in range(count))
        return Caption(
            f"{_NUMBERS.get(count, count)} attractors.",
            f"Basins: {', '.join(parts)} and {last} of the cells.{late}{said}",
        )

    def status(self) -> Iterator[str]:
        """Yield the effect of the cell size on the basins, once all cells are known, and the error of the manifolds."""
        if self.has_result("arrivals") and self.arrivals is not None and self.is_complete:
            cells = coarsest_cells(self.arrivals.number)
            n, m = cells.shape
            change = digits(100.0 * ambiguity(cells), 2)
            yield f"basins {m} × {n} cells, a finer grid would change {change} % of the area"
        if self.has_result("manifolds") and self.manifolds:
            yield (
                f"stable manifolds {sum(len(one.points) for one in self.manifolds)} points, error across ≤ "
                f"{max(one.error_estimate for one in self.manifolds):.1e}"
            )


def _piece(what: _BasinGrid, stage: int, i: int) -> _Piece:
    """Return the arrivals of one part of the new cells of a stage."""
    mask = what.new_cells(stage, _before(what, stage))
    return _Piece(stage, what.arrivals(what.attractors(), mask, i))


def _before(what: _BasinGrid, stage: int) -> Arrivals | None:
    found: Arrivals | None = None if stage == 0 else Task(_cells, what, stage - 1).get()
    return found


def _cells(what: _BasinGrid, stage: int) -> Arrivals:
    """Return the arrivals of all cells (n, m) of a stage."""
    before = _before(what, stage)
    pieces = [(slice(i, None, _PARTS), Task(_piece, what, stage, i).get().arrivals) for i in range(_PARTS)]
    return merge(before, what.new_cells(stage, before), pieces)


def _at_once(what: _BasinGrid) -> Arrivals:
    """Compute the arrivals of all pixels (n, m) at once."""
    there, cells = attractors(what.section, what.long, what.level), None
    for stage in range(_STAGES):
        mask = what.new_cells(stage, cells)
        cells = merge(cells, mask, [(slice(i, None, _PARTS), what.arrivals(there, mask, i)) for i in range(_PARTS)])
    assert cells is not None
    return cells


def _sample(what: _BasinGrid) -> Arrivals:
    """Compute the arrivals of points spread over the window, as a reference for cells of any size."""
    low, high = np.array(what.window)
    there = attractors(what.section, what.long, what.level)
    return arrivals(what.orbits, there.sets, *(low + _SPREAD * (high - low)).T)


def _error(cells: Array, truth: Array) -> float:
    """Return the percentage of reference points that lie in a cell (n, m) of another colour."""
    columns, rows = (_SPREAD * cells.shape[::-1]).astype(int).T
    return 100.0 * float(np.mean(cells[rows, columns] != truth))


def _saddles(what: _BasinGrid) -> tuple[Search, ...]:
    """Return searches that find distinct saddles on the boundaries."""
    number = Task(_cells, what, _STAGES - 1).get().number
    left, right = number[:, :-1], number[:, 1:]
    pairs = np.argwhere((left != right) & (left >= 0) & (right >= 0))
    (x0, y0), (x1, y1) = what.window
    m, n = what.pixels
    x, y = centres(x0, x1, m), centres(y0, y1, n)
    map_, sets = ReturnMap(what.section, PRECISE), what.attractors().sets

    def arrives(point: Array) -> int:
        return int(arrivals(what.orbits, sets, point[:1], point[1:]).number[0])

    found: dict[tuple[float, ...], Search] = {}
    for row, column in pairs[np.linspace(0, len(pairs) - 1, min(_SEARCHES, len(pairs))).astype(int)].tolist():
        check_limit()
        try:
            left_end, right_end = (np.array([x[i], y[row]]) for i in (column, column + 1))
            orbit = saddle_between(map_, left_end, right_end, arrives)
        except NotConverged:
            continue
        points = [tuple(map(float, point)) for point in orbit.points]
        first = min(points)
        found.setdefault(tuple(np.round(first, 6).tolist()), (map_, first, orbit.period, True))
    return tuple(found.values())


def basins_trial() -> Trial[Any]:
    """Return the trial of the basins, computed at each level."""
    return Trial(
        Kind.BASINS,
        ("section",),
        lambda s, plan: (_sample if plan.level.is_perturbed else _at_once)(s.basins.target(plan)).number.astype(float),
        lambda s, cells, truth: _error(cells, truth),
        unit="% of the cells that change",
        tolerance=3.0,
        condition=lambda s: s.basins.is_on,
    )
