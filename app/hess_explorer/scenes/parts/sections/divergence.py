"""The Lyapunov exponent of the orbit and the mean divergence along it, in one picture."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.parts.orbits.exponent import OrbitExponent, exponent_picture
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import settled_range, thin, time_graph
from hess_explorer.views.layers import Axes, Range, levels
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits, with_error
from hess_mechanics.dynamics.basins import MeanDivergence, mean_divergence
from hess_mechanics.numerics.accuracy import Kind
from hess_mechanics.numerics.results import Array


@dataclass(frozen=True, eq=False)
class Divergence(OrbitExponent):
    """The exponent and the mean divergence along an orbit of the Suslov problem; shown when both are known."""

    @cached_property
    def divergence(self) -> MeanDivergence | None:
        """The mean divergence over time; None until known, during a drag, and for a periodic orbit."""
        if self.must_wait:
            return None
        duration = self.work.plan(Kind.EXPONENT).share * self.host.long
        return self.work.need(Task(mean_divergence, self.host.body, self.host.start, duration), preview=None)

    @property
    def curves(self) -> tuple[tuple[Array, Array], ...]:
        """Times and values, each (n,), of the exponent and of the mean divergence; empty until both are known."""
        if self.growth is not None:
            return tuple((np.array([0.0, self.host.long]), np.full(2, rate)) for rate in self.growth)
        found, course = self.result, self.divergence
        return () if found is None or course is None else ((found.times, found.rates), (course.times, course.mean))

    def rate(self, i: int) -> tuple[Array, Array] | None:
        """Return the curve of the exponent (0) or of the mean divergence (1); None until both are known."""
        return thin(*self.curves[i]) if self.curves else None

    @property
    def axis(self) -> Range | None:
        """The vertical range of the picture; None until both are known."""
        return settled_range([y for _, y in self.curves]) if self.curves else None

    @property
    def caption(self) -> Caption:
        """The caption of the picture."""
        if self.growth is not None:
            across, divergence = map(digits, self.growth)
            return Caption(
                "Exponent from the multipliers of the periodic orbit.",
                f"ln|μ₁|/T = {across}, div = ln|μ₁μ₂|/T = {divergence}.",
            )
        found, course = self.result, self.divergence
        if found is None or course is None:
            return Caption(self.work.pending_caption())
        return Caption(
            numbers=f"λ = {with_error(found.value, found.spread)}, "
            f"div = {digits(float(course.mean[-1]), 3)} after t = {digits(float(course.times[-1]))}."
        )


def divergence_picture() -> Plot[Any]:
    """Return the picture of both rates over time."""
    return replace(
        exponent_picture(),
        title="Lyapunov exponent and divergence",
        first=Axes((0.0, 1000.0), (-0.2, 0.2)),
        layers=(
            levels("levels", lambda s: [0.0] if s.exponent.curves else []),
            time_graph(
                "divergence",
                lambda s: s.exponent.rate(1),
                color=theme.MAP,
                dash="dashed",
                label="mean divergence",
                tag="divergence",
            ),
            time_graph("lambda", lambda s: s.exponent.rate(0), color=theme.ORBIT, label="exponent λ", tag="λ"),
        ),
    )
