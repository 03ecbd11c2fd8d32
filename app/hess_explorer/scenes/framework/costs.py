"""Cost against error of all that another scene computes, kind by kind and level by level, measured when asked for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Any, TypeVar

import numpy as np

from hess_explorer.scenes.framework.looking_into import Insight
from hess_explorer.scenes.framework.trial import Trial
from hess_explorer.views import theme
from hess_explorer.views.layers import Layer, line, points, ring
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.trade import enough
from hess_mechanics.numerics.accuracy import LEVELS, Kind
from hess_mechanics.numerics.results import Array

__all__ = ["Costs", "trade_picture"]

_ERRORS, _MS = (1e-9, 1e3), (1e-2, 1e5)
_TICKS = [1e-8, 1e-6, 1e-4, 1e-2, 1.0, 100.0]
_LOOKS = ((theme.ORBIT, "solid"), (theme.STABLE, "dashed"), (theme.UNSTABLE, "dotdash"), (theme.MAP, "dotted"))


class Costs(Insight):
    """What the computations of the other scene cost, and how wrong they are."""

    def cost_of(self, kind: Kind) -> tuple[Array, Array] | None:
        """Errors, as multiples of what can just not be seen, and milliseconds of the levels."""
        samples = self.costs.get(kind)
        if samples is None:
            return None
        seen = next(trial.seen for trial in self.trials if trial.kind == kind)
        return (np.clip([one.error / seen for one in samples], *_ERRORS),
                np.array([max(one.ms, _MS[0]) for one in samples]))

    def enough(self) -> list[tuple[float, float]]:
        """The points beyond which more accuracy changes nothing that is seen."""
        return [(float(xy[0][i]), float(xy[1][i])) for kind, level_name in self._enough.items()
                if (xy := self.cost_of(kind)) is not None for i in ([*LEVELS].index(level_name),)]

    @cached_property
    def _enough(self) -> dict[Kind, str]:
        return {trial.kind: enough(samples, trial.seen) for trial in self.trials
                if (samples := self.costs.get(trial.kind)) is not None}

    def about_costs(self) -> str:
        """The caption: which level is enough for what, as far as that is measured."""
        if self.dragging:
            return "It is measured when a slider is let go."
        if len(self._enough) < len(self.costs):
            return f"Being measured: {len(self._enough)} of {len(self.costs)}."
        return f"Enough to the eye: {', '.join(f'{kind} {name}' for kind, name in self._enough.items())}."

    def cost_rows(self) -> Iterator[str]:
        """Milliseconds and errors of the levels, a line for each kind."""
        for trial in self.trials:
            samples = self.costs.get(trial.kind)
            if samples is not None:
                times, errors = (", ".join(digits(value, 2) for value in values) for values in (
                    [one.ms for one in samples], [one.error for one in samples]))
                yield f"{trial.kind}: {times} ms; error {errors} {trial.unit}"


C = TypeVar("C", bound=Costs)


def trade_picture(trials: Sequence[Trial[Any]]) -> Plot[C]:
    """All that is computed, measured when it is asked for."""
    def layers(kind: Kind, color: str, dash: str) -> tuple[Layer[C], ...]:
        name = str(kind).replace(" ", "-")
        return (line(name, lambda s: s.cost_of(kind), color=color, dash=dash, label=str(kind)),
                points(f"{name}-marks", lambda s: s.cost_of(kind), color=color, size=8))

    return Plot(
        name="trade", title="Cost of all that is computed", caption=Costs.about_costs, log="xy",
        axes=("error / what is not seen", "milliseconds"), x=_ERRORS, y=_MS, x_ticks=_TICKS,
        y_tick_count=5, folded="Measure all that is computed",
        layers=(line("visible", lambda s: ((1.0, 1.0), _MS), color=theme.MUTED, dash="dotted"),
                *(layer for trial, look in zip(trials, _LOOKS, strict=False) for layer in layers(trial.kind, *look)),
                ring("enough", Costs.enough, size=20, label="more accuracy is not seen")))
