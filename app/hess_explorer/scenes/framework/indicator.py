"""A section whose cells are coloured by MEGNO: regular, chaotic, and where volume about the motion shrinks."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator
from functools import cached_property
from typing import Any

import numpy as np

from hess_explorer.scenes.framework.cells import CELLS, COARSE, Arguments, changed, found_by_rows, look
from hess_explorer.scenes.framework.parameters import choice
from hess_explorer.scenes.framework.periodic import PeriodicOrbits
from hess_explorer.scenes.framework.trial import Trial
from hess_explorer.scenes.framework.windows import Window
from hess_explorer.views import layered_section
from hess_explorer.views.layers import Layer
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.megno import CHAOTIC, REGULAR
from hess_mechanics.dynamics.megno_map import row_of_cells, time_of
from hess_mechanics.numerics.accuracy import Computation, Plan
from hess_mechanics.numerics.results import Array

__all__ = ["INDICATOR", "Indicated", "colouring", "indicator_layer"]

NOTHING, MEGNO = "nothing", "MEGNO"
_TURNS = 300.0
"""Time of the indicator in 1/ν: some fifty returns."""


def colouring() -> Any:
    """What lies under the points of a section."""
    return choice("Under the points", (NOTHING, MEGNO), NOTHING,
                  doc="MEGNO tells after a short time whether the motion from each cell is regular or chaotic, and "
                      "whether volume about it shrinks.")


class Indicated(PeriodicOrbits):
    """A section whose cells may be coloured by MEGNO.

    The scene declares the parameter that stands here without a value.
    """

    indicator: str

    @property
    @abstractmethod
    def frame(self) -> Window:
        """What of the section is seen."""

    @property
    def indicated(self) -> bool:
        """Whether MEGNO is to be shown."""
        return self.indicator == MEGNO

    def sooner(self) -> object:
        """What comes before the finer cells: the points of the section."""
        return None

    @cached_property
    def indicator_time(self) -> float:
        """How long the motion from each cell is followed."""
        return self.work.get(time_of, self.section, _TURNS)

    def indicator_rows(self, plan: Plan, coarse: int = 1) -> list[Arguments]:
        """What `row_of_cells` is asked for, for each row of cells, of which one is as wide as `coarse` of them."""
        m, n = plan.grid(CELLS)
        cells = m // coarse, n // coarse
        return [(self.section, self.frame, cells, row, self.indicator_time, plan.level) for row in range(cells[1])]

    @cached_property
    def _cells(self) -> tuple[Array, int] | None:
        """Ȳ and kind of the cells, (n, 2, m), and how many of their rows are still coarse; None before any is known."""
        if not self.indicated or self.dragging:
            return None
        plan = self.plan(Computation.INDICATOR)
        return found_by_rows(self.work, row_of_cells, self.indicator_rows(plan, COARSE), self.indicator_rows(plan),
                             self.sooner)

    @property
    def kinds(self) -> Array | None:
        """Cells (n, m): 0 regular, 1 chaotic, 2 more where volume shrinks, −1 where nothing moves."""
        return None if self._cells is None else self._cells[0][:, 1]

    @property
    def about_indicator(self) -> str:
        """The caption of a section with MEGNO; else empty."""
        if not self.indicated or self.dragging:
            return ""
        said = f"MEGNO after t = {digits(self.indicator_time)}"
        if self._cells is None or self._cells[1]:
            return f"{said}, coarse as yet."
        kinds = self._cells[0][:, 1]
        there = kinds[kinds >= 0.0]
        if not there.size:
            return "Nothing moves in this window."
        chaotic, shrinks = (100.0 * float(np.mean(one)) for one in (there % 2.0 == 1.0, there >= 2.0))
        return (f"{said}: {100.0 - chaotic:.0f} % of the cells regular, {chaotic:.0f} % chaotic; volume shrinks about "
                f"{shrinks:.0f} %.")

    def status(self) -> Iterator[str]:
        """How many cells lie between what is regular and what is chaotic, when all are known."""
        if self.known("_cells") is not None and self._cells is not None and not self._cells[1]:
            values = self._cells[0][:, 0]
            n, m = values.shape
            between = float(np.mean((values > REGULAR) & (values <= CHAOTIC)))
            yield f"MEGNO {m} × {n} cells, {digits(100.0 * between, 2)} % between {REGULAR:g} and {CHAOTIC:g}"
        yield from super().status()


def indicator_layer() -> Layer[Any]:
    """The cells, under all points."""
    return layered_section.indicator(lambda s: s.kinds, lambda s: s.frame)


def _all(s: Indicated, plan: Plan) -> Array:
    return np.stack([row_of_cells(*row)[1] for row in s.indicator_rows(plan)])


INDICATOR: Trial[Any] = Trial(
    Computation.INDICATOR, ("section",), _all, lambda s, cells, truth: changed(cells, truth),
    lambda s, cells: look(s.frame, s.names, cells), unit="% of the cells that change", seen=3.0,
    shown=lambda s: s.indicated)
