"""Basins on a section of the Suslov problem: the motions that the orbits from its cells tend to."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Protocol, TypeVar

import numpy as np

from hess_explorer.scenes.framework.cells import CELLS, COARSE, Arguments, changed, found_by_rows, look
from hess_explorer.scenes.framework.part import Host, Part
from hess_explorer.scenes.framework.scene import State
from hess_explorer.scenes.framework.trial import Trial
from hess_explorer.scenes.framework.windows import Window
from hess_explorer.views.caption import Caption
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.basin_boundary import unsure
from hess_mechanics.numerics.accuracy import Computation, Plan
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov.basins import Contraction, contraction_at, groups_of_cells, middle_cells
from hess_mechanics.suslov.section import SuslovSection

__all__ = ["Basins", "basins_trial"]

_CROSSINGS = 240
_MOST_STEPS = 100_000
_NUMBERS = {2: "Two", 3: "Three", 4: "Four"}


class _Window(Protocol):
    @property
    def frame(self) -> Window:
        """The visible window."""

    @property
    def batches(self) -> object:
        """The orbits of the section, computed before the finer cells."""


class _Host(Host, Protocol):
    @property
    def poincare(self) -> SuslovSection:
        """The section in its coordinates.  Raises `ModelError`."""

    @property
    def long(self) -> float:
        """The averaging time of the divergence."""


@dataclass(frozen=True, eq=False)
class Basins(Part[_Host]):
    """The cells of a section of the Suslov problem, grouped by the motions that their orbits tend to.

    wanted : show them.
    """

    section: _Window
    wanted: bool

    @cached_property
    def _found(self) -> tuple[Array, int] | None:
        """`SuslovSection.ends` of all cells (n, m), ∞ without motion, and the number of rows that are still coarse.

        None until all coarse cells are known; each is the middle one of `COARSE`² cells.
        """
        if not self.wanted or self.work.dragging:
            return None
        plan = self.work.plan(Computation.BASINS)
        return found_by_rows(
            self.work, SuslovSection.ends, self.rows(plan, COARSE), self.rows(plan), lambda: self.section.batches
        )

    @property
    def ends(self) -> Array | None:
        """`SuslovSection.ends` of all cells (n, m), ∞ without motion; None until all are known."""
        return None if self._found is None or self._found[1] else self._found[0]

    @cached_property
    def basin(self) -> Array | None:
        """The group 0, 1, … of each cell (n, m), −1 without motion; coarse until the finer cells are known."""
        return None if self._found is None else groups_of_cells(self._found[0])

    @cached_property
    def contractions(self) -> list[Contraction] | None:
        """The contraction of one motion of each group; None until all are known."""
        ends = self.ends
        if self.basin is None or ends is None:
            return None
        grid = self.work.plan(Computation.BASINS).grid(CELLS)
        long = self.work.plan(Computation.EXPONENT).share * self.host.long
        found = [
            self.work.later(contraction_at, self.host.poincare, self.section.frame, grid, row, column, long)
            for row, column in middle_cells(ends, self.basin)
        ]
        known = [one for one in found if one is not None]
        return known if len(known) == len(found) else None

    def about(self, cells: Array) -> Caption:
        """Return the caption of the basins."""
        found = self.contractions
        if found is None:
            return Caption(
                self.work.awaited(), "Basins: first coarse cells." if self.ends is None else "Basins: all cells."
            )
        if not found:
            return Caption("Nothing moves in this window.")
        largest = max(found, key=lambda one: one.mean)
        div = f"mean div = {digits(largest.mean, 2)} ± {digits(largest.error, 1)}"
        shares = [100.0 * float(np.mean(cells[cells >= 0] == group)) for group in range(len(found))]
        drawn = [share for share, one in zip(shares, found, strict=True) if one.attracts]
        if not drawn:
            return Caption("No attractor is seen.", f"{div}.")
        if len(drawn) < len(found):
            return Caption(
                "Attractors and motion without one.",
                f"Basins: {digits(sum(drawn), 2)} % of the cells; elsewhere {div}.",
            )
        if len(drawn) == 1:
            return Caption("One attractor for all orbits.", f"{div}.")
        *parts, last = (f"{digits(share, 2)} %" for share in reversed(drawn))
        return Caption(
            f"{_NUMBERS.get(len(drawn), len(drawn))} attractors.",
            f"Basins: {', '.join(parts)} and {last} of the cells.",
        )

    def status(self) -> Iterator[str]:
        """Yield how much the basins depend on the size of the cells, once all are known."""
        if self.asked("basin") and self.basin is not None and self.ends is not None:
            n, m = self.basin.shape
            yield f"basins {m} × {n}, twice as many cells would change {digits(100.0 * unsure(self.basin), 2)} % of it"

    def rows(self, plan: Plan, coarse: int = 1) -> list[Arguments]:
        """Return the arguments of `SuslovSection.ends` for each row of cells as wide as `coarse` of the finest."""
        m, n = plan.grid(CELLS)
        cells = m // coarse, n // coarse
        return [
            (self.host.poincare, self.section.frame, cells, row, _CROSSINGS, _MOST_STEPS, plan.level)
            for row in range(cells[1])
        ]


S = TypeVar("S", bound=State)


def basins_trial(of: Callable[[S], Basins]) -> Trial[S]:
    """Return the trial of the basins, computed at each level."""
    return Trial[Basins](
        Computation.BASINS,
        ("section",),
        lambda s, plan: groups_of_cells(np.stack([SuslovSection.ends(*row) for row in s.rows(plan)])),
        lambda s, cells, truth: changed(cells, truth),
        lambda s, cells: look(s.section.frame, s.host.poincare.names, cells),
        unit="% of the cells that change",
        seen=3.0,
        shown=lambda s: s.wanted,
    ).of_part(of)
