"""A section with cells coloured by MEGNO: regular, chaotic, and shrinking phase-space volume."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.cells import CELLS, COARSE, DENSITY, Arguments, cells_by_rows, change_percentage
from hess_explorer.scenes.framework.part import Part
from hess_explorer.scenes.framework.sliders import choice
from hess_explorer.scenes.framework.trial import Trial
from hess_explorer.scenes.framework.windows import Window
from hess_explorer.scenes.parts.sections.section import Section
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Layer
from hess_explorer.views.plane import layered_section
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.megno import CHAOTIC, REGULAR
from hess_mechanics.dynamics.megno_map import ENDED, row_of_cells, time_of
from hess_mechanics.numerics.accuracy import Kind, Plan
from hess_mechanics.numerics.results import Array

MEGNO = "MEGNO"
_TURNS = 300.0
"""Time of the indicator, in units of 1/ν: some fifty returns."""


def colouring(has_density: bool = True) -> Any:
    """Declare the choice of colours under the points of a section; only with `has_density` it offers the density."""
    dense = "Density: a million crossings instead of the points. " if has_density else ""
    return choice(
        "Under the points",
        (DENSITY, MEGNO, "nothing") if has_density else ("nothing", MEGNO),
        DENSITY if has_density else "nothing",
        doc=f"{dense}MEGNO shows after a short time whether the motion from each cell is regular or "
        "chaotic, and whether volume around it shrinks.",
    )


_WAYS = ((1.0, 1.0), (-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0))


@dataclass(frozen=True, eq=False)
class Indicator(Part[Section]):
    """The cells of a section coloured by MEGNO.

    Attributes
    ----------
    is_on : bool
        True to show the cells.
    """

    is_on: bool

    @cached_property
    def time(self) -> float:
        """The time for which the motion from each cell is followed."""
        return self.work.need(Task(time_of, self.host.poincare, _TURNS))

    def rows(self, plan: Plan, coarse: int = 1) -> list[Arguments]:
        """Return the arguments of `row_of_cells` for each row; cells are as wide as `coarse` cells of the plan."""
        m, n = plan.grid(CELLS)
        cells = m // coarse, n // coarse
        frame = self.host.frame
        windows = (_aside(frame, cells, row) if plan.level.is_perturbed else frame for row in range(cells[1]))
        return [(self.host.poincare, one, cells, row, self.time, plan.level) for row, one in enumerate(windows)]

    @cached_property
    def _cells(self) -> tuple[Array, int] | None:
        """The rows (3, m) of `row_of_cells`, and the number of coarse rows; None until all coarse rows are known."""
        if not self.is_on or self.work.is_preview:
            return None
        plan = self.work.plan(Kind.INDICATOR)
        return cells_by_rows(
            self.work, row_of_cells, (self.rows(plan, COARSE), self.rows(plan)), lambda: self.host.known_orbits
        )

    @property
    def kinds(self) -> Array | None:
        """Kinds of the cells (n, m), as in `megno_map`; None until all coarse cells are known, and if not shown."""
        return None if self._cells is None else self._cells[0][:, 1]

    @property
    def caption(self) -> Caption | None:
        """The caption of a section with MEGNO; None without it, and during a drag."""
        if not self.is_on or self.work.is_preview:
            return None
        if self._cells is None or self._cells[1]:
            return Caption(
                self.work.pending_caption(),
                f"MEGNO after t = {digits(self.time)}."
                + ("" if self._cells is None else " Some cells are still coarse."),
            )
        kinds = self._cells[0][:, 1]
        there = kinds[kinds >= 0.0]
        if not there.size:
            return Caption("No motion is possible in this window.")
        ended = there == ENDED
        chaotic, shrinks, ends = (
            100.0 * float(np.mean(one)) for one in (there % 2.0 == 1.0, (there >= 2.0) & ~ended, ended)
        )
        return Caption(
            f"{100.0 - chaotic - ends:.0f} % of the cells regular, {chaotic:.0f} % chaotic.",
            f"MEGNO after t = {digits(self.time)}; volume shrinks in about {shrinks:.0f} %."
            + (f" In {ends:.0f} % the motion ends early." if ended.any() else ""),
        )

    def status(self) -> Iterator[str]:
        """Yield the share of cells between regular and chaotic, once all are known."""
        if self.has_result("_cells") and self._cells is not None and not self._cells[1]:
            values = self._cells[0][:, 0]
            n, m = values.shape
            between = float(np.mean((values > REGULAR) & (values <= CHAOTIC)))
            yield f"MEGNO {m} × {n} cells, {digits(100.0 * between, 2)} % between {REGULAR:g} and {CHAOTIC:g}"


def _aside(frame: Window, cells: tuple[int, int], row: int) -> Window:
    """Return the window in which the centres of a row of cells (m, n) are shifted by a quarter of a cell.

    A reference at the centres themselves would not depend on the size of the cells.  The shifted centres belong to a
    grid twice as fine; the direction of the shift changes from row to row.
    """
    (x0, y0), (x1, y1) = frame
    right, up = (
        0.25 * way * (high - low) / count for way, low, high, count in zip(_WAYS[row % 4], *frame, cells, strict=True)
    )
    return (x0 + right, y0 + up), (x1 + right, y1 + up)


def indicator_layer() -> Layer[Any]:
    """Return the layer of cells, drawn under all points."""
    return layered_section.indicator(lambda s: s.megno.kinds, lambda s: s.section.frame)


def indicator_trial() -> Trial[Any]:
    """Return the trial of the cells, computed at each level."""
    return Trial(
        Kind.INDICATOR,
        ("section",),
        lambda s, plan: np.stack([row_of_cells(*row)[1] for row in s.megno.rows(plan)]),
        lambda s, cells, truth: change_percentage(cells, truth),
        unit="% of the cells that change",
        tolerance=3.0,
        condition=lambda s: s.megno.is_on,
    )
