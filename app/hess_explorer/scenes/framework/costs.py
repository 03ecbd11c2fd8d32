"""Cost against error of all that another scene computes, and what the next level changes in its pictures."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from hess_explorer.scenes.framework.looking_into import Insight
from hess_explorer.scenes.framework.parameters import specs_of
from hess_explorer.scenes.framework.trial import Refused, Trial, next_level
from hess_explorer.views import theme
from hess_explorer.views.comparison import Difference
from hess_explorer.views.layers import Axes, CellGrid, Layer, Range, Sign, dots, image, line, points, ring, text
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.shadowing import typical
from hess_mechanics.dynamics.trade import LevelCost, enough
from hess_mechanics.numerics.accuracy import DRAFT, LEVELS, Computation
from hess_mechanics.numerics.results import Array

__all__ = ["Costs", "difference_picture", "trade_picture"]

_ERRORS, _MS = (1e-9, 1e3), (1e-2, 1e5)
_NO_AXIS = (-1.0, 1.0)
_TICKS = [1e-8, 1e-6, 1e-4, 1e-2, 1.0, 100.0]
_LINES = (("solid", 1.5), ("dashed", 2.0), ("dotted", 3.0), ("solid", 4.0))
"""Dash and width: the page's legend has no line of dots and dashes."""


class Costs(Insight):
    """What the computations of the other scene cost, how wrong they are, and what of it would be seen."""

    # ---- cost against error -------------------------------------------------------------------------------------

    def _samples(self, kind: Computation) -> tuple[LevelCost, ...] | None:
        found = self.costs.get(kind)
        return None if isinstance(found, Refused) else found

    def cost_of(self, kind: Computation) -> tuple[Array, Array] | None:
        """Errors, as multiples of what can just not be seen, and milliseconds of the levels."""
        samples = self._samples(kind)
        if samples is None:
            return None
        seen = next(trial.seen for trial in self.trials if trial.kind == kind)
        return (np.clip([one.error / seen for one in samples], *_ERRORS),
                np.array([max(one.ms, _MS[0]) for one in samples]))

    def costs_at(self, name: str) -> tuple[Array, Array] | None:
        """The same of one level, for each kind."""
        i, found = [*LEVELS].index(name), [xy for kind in self.costs if (xy := self.cost_of(kind)) is not None]
        return (np.array([x[i] for x, _ in found]), np.array([y[i] for _, y in found])) if found else None

    def enough(self) -> list[tuple[float, float]]:
        """The points beyond which more accuracy changes nothing that is seen."""
        return [(float(xy[0][i]), float(xy[1][i])) for kind, level_name in self._enough.items()
                if (xy := self.cost_of(kind)) is not None for i in ([*LEVELS].index(level_name),)]

    @cached_property
    def _enough(self) -> dict[Computation, str]:
        return {trial.kind: enough(samples, trial.seen) for trial in self.trials
                if (samples := self._samples(trial.kind)) is not None}

    def about_costs(self) -> str:
        """The caption: which level is enough for what, as far as that is measured."""
        if self.dragging:
            return "It is measured when a slider is let go."
        known = [found for found in self.costs.values() if found is not None]
        if len(known) < len(self.costs):
            return f"Measured so far: {len(known)} of {len(self.costs)}."
        said = [f"{kind} cannot be measured: {found.reason}" for kind, found in self.costs.items()
                if isinstance(found, Refused)]
        if self._enough:
            said.insert(0, f"Enough to the eye: {', '.join(f'{kind} {name}' for kind, name in self._enough.items())}.")
        return _capitalized(" ".join(said))

    def cost_rows(self) -> Iterator[str]:
        """Milliseconds and errors of the levels, a line for each kind."""
        for trial in self.trials:
            samples = self._samples(trial.kind)
            if samples is not None:
                times, errors = (", ".join(digits(value, 2) for value in values) for values in (
                    [one.ms for one in samples], [one.error for one in samples]))
                yield f"{trial.kind}: {times} ms; error {errors} {trial.unit}"

    def measured_rows(self) -> Iterator[str]:
        """Of the pictures in sight, what was measured and compared."""
        if "trade" in self.seen:
            yield from self.cost_rows()
        if "difference" in self.seen:
            yield from self.difference_rows()

    # ---- what would change --------------------------------------------------------------------------------------

    @property
    def finer(self) -> str | None:
        """The next more exact level; None for the last one."""
        return next_level(self.chosen)

    @property
    def found_difference(self) -> Difference | None:
        """The `changes`, where they are known."""
        return None if isinstance(self.changes, Refused) else self.changes

    def about_difference(self) -> str:
        """The caption: how much changes, and from which crossing on orbits are others."""
        if self.finer is None:
            return f"Nothing is more exact than {self.chosen}: nothing to compare it with."
        if self.dragging:
            return "It is found when a slider is let go."
        if isinstance(self.changes, Refused):
            return self.changes.reason
        if self.changes is None:
            return f"The scene shows no {self.difference} now." if self.difference_message() else "Not compared yet."
        return _said(self.changes)

    def difference_message(self) -> str:
        """Why there is nothing to see."""
        if self.finer is None:
            return f"{self.chosen} is the last level"
        # Only what a state shows is compared: basins, where they are asked for.
        if not (self.trials and self.compared.shown(self.shown)):
            return f"No {self.difference} in this state"
        return f"The {self.difference} cannot be compared" if isinstance(self.changes, Refused) else ""

    def difference_rows(self) -> Iterator[str]:
        """What was compared, and where chaos takes orbits away."""
        found = self.found_difference
        if found is None:
            return
        small = self.compared.small(self.shown)
        less = [f"{spec.label.lower()} {getattr(small, spec.name):g}" for spec in specs_of(type(small))
                if getattr(small, spec.name) != getattr(self.shown, spec.name)]
        if less:
            yield f"Compared with no more than: {', '.join(less)}"
        if found.lost:
            yield (f"Lost to chaos between {self.chosen} and {self.finer}: {len(found.lost)} of {found.orbits} orbits, "
                   f"from crossing {min(found.lost)} to {max(found.lost)} on, median {typical(found.lost)}")

    def difference_title(self) -> str:
        """Which levels are compared."""
        return f"{self.difference.capitalize()}: {self.chosen}" + (f" and {self.finer}" if self.finer else "")

    def difference_axis(self, side: str) -> Range | None:
        """The axis "x" or "y" of the picture that is compared; as it was while that is being found."""
        if self.difference_message():
            return _NO_AXIS
        if self.found_difference is None:
            return None
        found: Range = getattr(self.found_difference.frame.axes, side)
        return found

    def changed_cells(self) -> CellGrid | None:
        """1 where a cell changes, 0 where it does not, −1 where nothing is."""
        found = self.found_difference
        if found is None or found.cells is None:
            return None
        return CellGrid(found.cells, found.frame.axes.x, found.frame.axes.y)

    def added_by(self, name: str) -> Array | None:
        """Points (2, n) that only this level has."""
        return self.found_difference.added.T if self.found_difference is not None and self.finer == name else None

    def difference_names(self) -> str:
        """What the axes are."""
        return "" if self.found_difference is None else "{} across, {} up".format(*self.found_difference.frame.names)


def _capitalized(sentence: str) -> str:
    return sentence[:1].upper() + sentence[1:]


def _pixels(count: float) -> str:
    return f"{count:.0f}" if count >= 10.0 else digits(count, 2)


def _said(found: Difference) -> str:
    """Two short lines."""
    share = digits(100.0 * found.share, 2)
    if found.cells is not None:
        return f"{share} % of the cells change." if found.share else "No cell changes."
    if not len(found.changed):
        return f"Nothing moves by more than {_pixels(found.largest)} pixels."
    if found.lost:
        return (f"{share} % move over ½ pixel; chaos takes {len(found.lost)} of {found.orbits} orbits, from crossing "
                f"{min(found.lost)}.")
    return f"{share} % of the points move over ½ pixel, by at most {_pixels(found.largest)}."


C = TypeVar("C", bound=Costs)


def trade_picture(trials: Sequence[Trial[Any]], folded: bool = True) -> Plot[C]:
    """All that is computed, measured when it is asked for."""
    def kind(trial: Trial[Any], dash: str, width: float) -> Layer[C]:
        return line(str(trial.kind).replace(" ", "-"), lambda s: s.cost_of(trial.kind), color=theme.MUTED, dash=dash,
                    width=width, label=str(trial.kind))

    def at(name: str) -> Layer[C]:
        return points(f"at-{name}", lambda s: s.costs_at(name), color=theme.LEVELS[name], size=10, label=name)

    return Plot(
        name="trade", title="Cost of all that is computed", caption=Costs.about_costs, log="xy",
        axes=("error / what is not seen", "milliseconds"), x=_ERRORS, y=_MS, x_ticks=_TICKS,
        y_tick_count=5, folded="Measure all that is computed" if folded else "",
        layers=(line("visible", lambda s: ((1.0, 1.0), _MS), color=theme.MUTED, dash="dotted", width=1.0),
                *(kind(trial, *look) for trial, look in zip(trials, _LINES, strict=False)), *map(at, LEVELS),
                ring("enough", Costs.enough, size=20, label="more accuracy is not seen")))


def difference_picture(folded: bool = True) -> Plot[C]:
    """What the next more exact level changes in the picture of one kind of computation."""
    clear = theme.MUTED + "00"

    def of(part: Callable[[Difference], Array]) -> Callable[[C], Array | None]:
        return lambda s: None if (found := s.found_difference) is None else part(found).T

    def added(name: str) -> Layer[C]:
        return dots(f"added-{name}", lambda s: s.added_by(name), color=theme.LEVELS[name], size=4)

    return Plot(
        name="difference", title=Costs.difference_title, caption=Costs.about_difference, axes=(" ", " "),
        first=Axes(_NO_AXIS, _NO_AXIS), message=Costs.difference_message,
        x=lambda s: s.difference_axis("x"), y=lambda s: s.difference_axis("y"),
        folded="Show what more accuracy changes" if folded else "",
        layers=(
            image("cells", Costs.changed_cells, palette=(theme.FORBIDDEN, clear, theme.CHANGED), low=-1.5, high=1.5,
                  legend=(Sign("changes, point or cell", "box", f"background: {theme.CHANGED}"),)),
            dots("same", of(lambda found: found.same), color=theme.MUTED, size=4, label="stays to ½ pixel"),
            *(added(name) for name in LEVELS if name != DRAFT.name),
            dots("changed", of(lambda found: found.changed), color=theme.CHANGED, size=7),
            text("names", Costs.difference_names)))
