"""The Lyapunov exponent of the orbit on show and the mean divergence along it, in one picture."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.part import Host, Part, Start
from hess_explorer.scenes.parts.orbits.exponent import Exponent
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import over_time, settled_range, thinned
from hess_explorer.views.layers import Axes, levels
from hess_explorer.views.picture import Picture
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits, with_error
from hess_mechanics.dynamics.basins import MeanDivergence, mean_divergence
from hess_mechanics.numerics.accuracy import Kind
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov.equations import SuslovBody

__all__ = ["Divergence", "divergence_picture"]


class _Host(Host, Protocol):
    @property
    def body(self) -> SuslovBody:
        """The body.  Raises `ModelError`."""

    @property
    def start(self) -> Start:
        """The state at t = 0.  Raises `ModelError`."""

    @property
    def long(self) -> float:
        """The averaging time."""


@dataclass(frozen=True, eq=False)
class Divergence(Part[_Host]):
    """The mean divergence along the orbit on show, beside its exponent."""

    exponent: Exponent

    @cached_property
    def course(self) -> MeanDivergence | None:
        """The mean divergence over time; None until known, while a slider is held, and for a periodic orbit."""
        if self.exponent.later:
            return None
        duration = self.work.plan(Kind.EXPONENT).share * self.host.long
        return self.work.need(Task(mean_divergence, self.host.body, self.host.start, duration), preview=None)

    @property
    def rates(self) -> tuple[tuple[Array, Array], ...]:
        """Times and values of the exponent and of the mean divergence, once both are known.

        For a periodic orbit they come from its multipliers.
        """
        exponent, course = self.exponent.found, self.course
        if self.exponent.growth is not None:
            return tuple((np.array([0.0, self.host.long]), np.full(2, rate)) for rate in self.exponent.growth)
        return (
            ()
            if exponent is None or course is None
            else ((exponent.times, exponent.rates), (course.times, course.mean))
        )

    def rate(self, i: int) -> tuple[Array, Array] | None:
        """Return the curve of the exponent (0), or of the mean divergence (1)."""
        return thinned(*self.rates[i]) if self.rates else None

    @property
    def caption(self) -> Caption:
        """The caption of the picture."""
        exponent, course = self.exponent.found, self.course
        if self.exponent.growth is not None:
            across, divergence = map(digits, self.exponent.growth)
            return Caption(
                "From the multipliers of the periodic orbit.", f"ln|μ₁|/T = {across}, div = ln|μ₁μ₂|/T = {divergence}."
            )
        if exponent is None or course is None:
            return Caption(self.work.awaited())
        return Caption(
            numbers=f"λ = {with_error(exponent.value, exponent.spread)}, "
            f"div = {digits(float(course.mean[-1]), 3)} after t = {digits(float(course.times[-1]))}."
        )


def divergence_picture() -> Picture[Any]:
    """Return the picture of both rates over time, of a state with a part `divergence`."""
    return Plot(
        name="exponent",
        title="Lyapunov exponent and divergence",
        caption=lambda s: s.divergence.caption,
        axes=("t", "λ"),
        first=Axes((0.0, 1000.0), (-0.2, 0.2)),
        x=lambda s: (0.0, s.long),
        y=lambda s: settled_range([y for _, y in s.divergence.rates]) if s.divergence.rates else None,
        layers=(
            levels("levels", lambda s: [0.0] if s.divergence.rates else []),
            over_time(
                "divergence",
                lambda s: s.divergence.rate(1),
                color=theme.MAP,
                dash="dashed",
                label="mean divergence",
                tag="divergence",
            ),
            over_time("lambda", lambda s: s.divergence.rate(0), color=theme.ORBIT, label="exponent λ", tag="λ"),
        ),
    )
