"""Cost of all computations of a state: time and error at every level of accuracy."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.scene import State
from hess_explorer.scenes.framework.trial import Refusal, Trial, level_costs
from hess_explorer.scenes.framework.work import Work
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Layer, line, points, ring
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.trade import LevelCost, first_sufficient
from hess_mechanics.numerics.accuracy import LEVELS
from hess_mechanics.numerics.results import Array

_ERRORS, _MS = (1e-9, 1e3), (1e-2, 1e5)
_TICKS = [1e-8, 1e-6, 1e-4, 1e-2, 1.0, 100.0]
_LINES = (("solid", 1.5), ("dashed", 2.0), ("dotted", 3.0), ("solid", 4.0))
"""Dash and width of each line: the page's legend cannot show dash-dotted lines."""


@dataclass(frozen=True)
class Costs:
    """Time and error of every level for each kind of computation, measured in the background.

    Attributes
    ----------
    work : Work
        Computation of the state.
    base : State
        The state to measure, from `bare_state`.
    trials : tuple of Trial
        Its computations.
    """

    work: Work
    base: State
    trials: tuple[Trial[Any], ...]

    @cached_property
    def results(self) -> dict[Trial[Any], tuple[LevelCost, ...] | Refusal | None]:
        """The measurements of each trial, one per level, or the reason why there are none; None until known."""
        return {trial: self.work.need(Task(level_costs, trial, self.base), preview=None) for trial in self.trials}

    @cached_property
    def samples(self) -> dict[Trial[Any], tuple[LevelCost, ...]]:
        """The measurements so far, of the trials and levels with an error."""
        return {
            trial: samples
            for trial, found in self.results.items()
            if isinstance(found, tuple) and (samples := tuple(one for one in found if one.is_measured))
        }

    @cached_property
    def sufficient_levels(self) -> dict[Trial[Any], str]:
        """The cheapest level with full resolution and an invisible error, of the trials that have one."""
        return {
            trial: first_sufficient(samples, trial.tolerance)
            for trial, samples in self.samples.items()
            if any(one.suffices(trial.tolerance) for one in samples)
        }

    @cached_property
    def curves(self) -> dict[Trial[Any], tuple[Array, Array]]:
        """Errors (n,), in units of the largest invisible error, and times (n,) in milliseconds of the levels, by trial.

        Both are clipped to the axes: errors on both sides, times from below.
        """
        return {
            trial: (
                np.clip([one.error / trial.tolerance for one in samples], *_ERRORS),
                np.array([max(one.ms, _MS[0]) for one in samples]),
            )
            for trial, samples in self.samples.items()
        }

    def _at(self, levels: dict[Trial[Any], str]) -> list[tuple[float, float]]:
        """Return the point of each trial's curve at its level."""
        return [
            (float(x), float(y))
            for trial, samples in self.samples.items()
            for one, x, y in zip(samples, *self.curves[trial], strict=True)
            if one.level == levels.get(trial)
        ]

    def level(self, name: str) -> Sequence[Sequence[float]] | None:
        """Return the errors and times of one level for the measured trials; None without any.

        The errors are in units of the largest invisible error, the times in milliseconds.
        """
        return [*zip(*self._at(dict.fromkeys(self.trials, name)), strict=True)] or None

    def rings(self) -> list[tuple[float, float]]:
        """Return the point of each curve at its sufficient level."""
        return self._at(self.sufficient_levels)

    def caption(self) -> Caption:
        """Return the caption: the progress; then the sufficient level of each trial, or why it has none."""
        if self.work.is_preview:
            return Caption("Measured when the slider is released.")
        known = [found for found in self.results.values() if found is not None]
        if len(known) < len(self.results):
            return Caption("The costs are being measured.", f"{len(known)} of {len(self.results)} so far.")
        sentences = []
        for trial, found in self.results.items():
            if isinstance(found, Refusal):
                sentences.append(f"{trial.kind} cannot be measured: {found.reason}")
            elif trial not in self.samples:
                sentences.append(f"{trial.kind} has no error to measure: everything is chaotic, or nothing is drawn.")
            elif trial not in self.sufficient_levels:
                sentences.append(f"{trial.kind} has a visible error at every level.")
        if self.sufficient_levels:
            least = ", ".join(f"{trial.kind} {name}" for trial, name in self.sufficient_levels.items())
            sentences.insert(0, f"Cheapest levels without a visible error: {least}.")
        sentence = " ".join(sentences)
        return Caption(numbers=sentence[:1].upper() + sentence[1:])

    def rows(self) -> Iterator[str]:
        """Yield the times in milliseconds and the errors of the levels, one line per kind."""
        for trial, samples in self.samples.items():
            times, errors = (
                ", ".join(digits(value, 2) for value in values)
                for values in ([one.ms for one in samples], [one.error for one in samples])
            )
            yield f"{trial.kind}: {times} ms; error {errors} {trial.unit}"


def costs_picture(trials: Sequence[Trial[Any]], folded: bool) -> Plot[Costs]:
    """Return the picture of cost and error of all computations.

    Parameters
    ----------
    trials : sequence of Trial
        The computations; at most four have a curve.
    folded : bool
        True to show the picture only after a click on a button.
    """

    def kind(trial: Trial[Any], dash: str, width: float) -> Layer[Costs]:
        name = str(trial.kind)
        return line(
            name.replace(" ", "-"), lambda s: s.curves.get(trial), color=theme.MUTED, dash=dash, width=width, label=name
        )

    def at(name: str) -> Layer[Costs]:
        return points(f"at-{name}", lambda s: s.level(name), color=theme.LEVELS[name], size=10, label=name)

    return Plot(
        name="trade",
        title="Cost of all computations",
        caption=Costs.caption,
        log="xy",
        axes=("error / largest invisible error", "milliseconds"),
        x=_ERRORS,
        y=_MS,
        x_ticks=_TICKS,
        y_tick_count=5,
        button="Measure all computations" if folded else "",
        layers=(
            line("visible", lambda s: ((1.0, 1.0), _MS), color=theme.MUTED, dash="dotted", width=1.0),
            *(kind(trial, *look) for trial, look in zip(trials, _LINES, strict=False)),
            *map(at, LEVELS),
            ring("enough", Costs.rings, size=20, label="cheapest level without visible error"),
        ),
    )
