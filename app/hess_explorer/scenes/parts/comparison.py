"""Comparison of two levels of accuracy: the changes that the next more accurate level makes in a picture."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from hess_explorer.scenes.framework.parameters import specs_of
from hess_explorer.scenes.framework.scene import State
from hess_explorer.scenes.framework.trial import Refused, Trial, differing, next_level
from hess_explorer.scenes.framework.work import Work
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.comparison import Difference
from hess_explorer.views.layers import Axes, CellGrid, Layer, Range, Sign, dots, image, text
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.shadowing import typical
from hess_mechanics.numerics.accuracy import DRAFT, LEVELS
from hess_mechanics.numerics.results import Array

__all__ = ["Comparison"]

_NO_AXIS = (-1.0, 1.0)


@dataclass(frozen=True)
class Comparison:
    """The picture of one trial at the chosen level and the next more accurate one, compared in the background.

    shown : the `bare` state.
    """

    work: Work
    shown: State
    trial: Trial[Any]

    @property
    def finer(self) -> str | None:
        """The next more accurate level; None for the last one."""
        return next_level(self.work.chosen)

    @cached_property
    def found(self) -> Difference | Refused | None:
        """The difference, or the reason why there is none; None until known, and if there is nothing to compare."""
        if self.work.dragging or self.finer is None or not self.trial.shown(self.shown):
            return None
        return self.work.later(differing, self.trial, self.shown, self.work.chosen, self.finer)

    @property
    def difference(self) -> Difference | None:
        """The difference; None if unknown."""
        return self.found if isinstance(self.found, Difference) else None

    # ---- words --------------------------------------------------------------------------------------------------

    def title(self) -> str:
        """Return the title: the kind of computation and the two levels."""
        return f"{self.trial.kind.capitalize()}: {self.work.chosen}" + (f" and {self.finer}" if self.finer else "")

    def about(self) -> Caption:
        """Return the caption: the size of the change, and the first crossing after which orbits differ."""
        if self.finer is None:
            return Caption("Nothing to compare with.", f"No level is more accurate than {self.work.chosen}.")
        if self.work.dragging:
            return Caption("Compared when a slider is released.")
        if isinstance(self.found, Refused):
            return Caption(numbers=self.found.reason)
        if self.found is None:
            return Caption(f"The scene shows no {self.trial.kind} now." if self.message() else "Not compared yet.")
        return _said(self.found)

    def message(self) -> str:
        """Return the reason why the picture is empty; an empty string if it is not."""
        if self.finer is None:
            return f"{self.work.chosen} is the last level"
        # Basins, for example, are compared only if the state shows them.
        if not self.trial.shown(self.shown):
            return f"No {self.trial.kind} in this state"
        return f"The {self.trial.kind} cannot be compared" if isinstance(self.found, Refused) else ""

    def rows(self) -> Iterator[str]:
        """Yield the limits of the comparison, and the orbits lost to chaos."""
        found = self.difference
        if found is None:
            return
        small = self.trial.small(self.shown)
        less = [
            f"{spec.label.lower()} {getattr(small, spec.name):g}"
            for spec in specs_of(type(small))
            if getattr(small, spec.name) != getattr(self.shown, spec.name)
        ]
        if less:
            yield f"Compared with no more than: {', '.join(less)}"
        if found.lost:
            yield (
                f"Lost to chaos between {self.work.chosen} and {self.finer}: {len(found.lost)} of {found.orbits} "
                f"orbits, from crossing {min(found.lost)} to {max(found.lost)} on, median {typical(found.lost)}"
            )

    # ---- the picture --------------------------------------------------------------------------------------------

    def axes(self) -> tuple[Range, Range] | tuple[None, None]:
        """Return the axes of the compared picture; (None, None) keeps the axes until the difference is known."""
        if self.message():
            return _NO_AXIS, _NO_AXIS
        return (None, None) if self.difference is None else (self.difference.frame.axes.x, self.difference.frame.axes.y)

    def axis_names(self) -> str:
        """Return the names of the axes as one text; empty without a difference."""
        return "" if self.difference is None else "{} across, {} up".format(*self.difference.frame.names)

    def cells(self) -> CellGrid | None:
        """Return a grid of cells: 1 changed, 0 unchanged, −1 empty; None if the picture has no cells."""
        found = self.difference
        if found is None or found.cells is None:
            return None
        return CellGrid(found.cells, found.frame.axes.x, found.frame.axes.y)

    @staticmethod
    def picture(folded: bool) -> Plot[Comparison]:
        """Return the picture of the changes that the next more accurate level makes."""
        clear = theme.MUTED + "00"

        def of(part: Callable[[Difference], Array]) -> Callable[[Comparison], Array | None]:
            return lambda s: None if s.difference is None else part(s.difference).T

        def added(name: str) -> Layer[Comparison]:
            points = of(lambda found: found.added)
            return dots(
                f"added-{name}", lambda s: points(s) if s.finer == name else None, color=theme.LEVELS[name], size=4
            )

        return Plot(
            name="difference",
            title=Comparison.title,
            caption=Comparison.about,
            axes=(" ", " "),
            first=Axes(_NO_AXIS, _NO_AXIS),
            message=Comparison.message,
            x=lambda s: s.axes()[0],
            y=lambda s: s.axes()[1],
            folded="Show what more accuracy changes" if folded else "",
            layers=(
                image(
                    "cells",
                    Comparison.cells,
                    palette=(theme.FORBIDDEN, clear, theme.CHANGED),
                    low=-1.5,
                    high=1.5,
                    legend=(Sign("changes, point or cell", "box", f"background: {theme.CHANGED}"),),
                ),
                dots("same", of(lambda found: found.same), color=theme.MUTED, size=4, label="moves less than ½ pixel"),
                *(added(name) for name in LEVELS if name != DRAFT.name),
                dots("changed", of(lambda found: found.changed), color=theme.CHANGED, size=7),
                text("names", Comparison.axis_names),
            ),
        )


def _said(found: Difference) -> Caption:
    """Return the caption of a difference."""
    share = digits(100.0 * found.share, 2)
    if found.cells is not None:
        return Caption(f"{share} % of the cells change." if found.share else "No cell changes.")
    largest = f"{found.largest:.0f}" if found.largest >= 10.0 else digits(found.largest, 2)
    if not len(found.changed):
        return Caption(f"Nothing moves by more than {largest} pixels.")
    if found.lost:
        return Caption(
            f"Chaos changes {len(found.lost)} of {found.orbits} orbits.",
            f"From crossing {min(found.lost)} on; {share} % of the points move over ½ pixel.",
        )
    return Caption(f"No point moves over {largest} pixels.", f"{share} % of the points move over ½ pixel.")
