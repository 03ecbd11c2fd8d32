"""The largest Lyapunov exponent of the orbit."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.part import Host, Part, Start
from hess_explorer.scenes.framework.periodic_search import NotFound, Periodic
from hess_explorer.scenes.framework.trial import Trial
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import thin, time_graph, with_margin
from hess_explorer.views.layers import Axes, Range
from hess_explorer.views.plane.velocity_plane import round_up
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits, with_error
from hess_mechanics.dynamics import spectrum
from hess_mechanics.dynamics.system import Body
from hess_mechanics.errors import MotionEnds
from hess_mechanics.numerics.accuracy import Kind, Level, Plan
from hess_mechanics.numerics.results import Array

_LONG = 2000.0
"""The longest time for which levels are compared."""


class _Host(Host, Protocol):
    @property
    def body(self) -> Body:
        """The equations and their parameters.  Raises `ModelError`."""

    @property
    def start(self) -> Start:
        """The state at t = 0.  Raises `ModelError`."""

    @property
    def long(self) -> float:
        """The averaging time."""

    @property
    def periodic_orbit(self) -> Periodic:
        """The current periodic orbit, if any."""


@dataclass(frozen=True, eq=False)
class OrbitExponent(Part[_Host]):
    """The largest Lyapunov exponent; for a periodic orbit it follows from the multipliers."""

    @property
    def growth(self) -> tuple[float, float] | None:
        """Growth rate ln|μ₁|/T and mean divergence ln|μ₁μ₂|/T of the periodic orbit; None without a periodic orbit."""
        return self.host.periodic_orbit.growth

    @property
    def must_wait(self) -> bool:
        """True if the exponent has to wait: during a drag, or if a periodic orbit is shown or searched for."""
        return self.work.is_preview or self.host.periodic_orbit.is_searching or self.growth is not None

    @cached_property
    def _answer(self) -> spectrum.Exponent | NotFound | None:
        if self.must_wait:
            return None
        plan = self.work.plan(Kind.EXPONENT)
        return self.work.need(
            Task(_exponent, self.host.body, self.host.start, plan.share * self.host.long, plan.level), preview=None
        )

    @property
    def result(self) -> spectrum.Exponent | None:
        """The exponent of a non-periodic orbit; None until known, while `must_wait`, and if the motion ends early."""
        return None if isinstance(self._answer, NotFound) else self._answer

    def compute(self, plan: Plan) -> spectrum.Exponent:
        """Return the exponent for a plan, computed at once.  Raises `ModelError`."""
        return spectrum.lyapunov_exponent(self.host.body, self.host.start, plan.share * self.host.long, plan.level)

    @property
    def rates(self) -> tuple[Array, Array] | None:
        """Times and mean growth rates, each (n,); None until known, and if the motion ends early."""
        if self.growth is not None:
            return np.array([0.0, self.host.long]), np.full(2, self.growth[0])
        return None if self.result is None else thin(self.result.times, self.result.rates)

    @property
    def axis(self) -> Range | None:
        """The vertical range of the picture; None if there are no `rates`."""
        if self.growth is not None:
            return with_margin(np.array([0.0, self.growth[0]]), 0.1, 1e-6)
        if self.result is None:
            return None
        later = self.result.rates[len(self.result.rates) // 10 :]
        return min(0.0, 1.05 * float(later.min())), round_up(1.05 * max(1e-6, float(later.max())))

    @property
    def caption(self) -> Caption:
        """The caption of the picture."""
        if self.growth is not None:
            return Caption(
                "Exponent from the multipliers of the periodic orbit.", f"ln|μ₁|/T = {digits(self.growth[0])}."
            )
        found = self._answer
        if found is None:
            return Caption(self.work.pending_caption())
        if isinstance(found, NotFound):
            return Caption("No exponent: the motion ends early.")
        end = float(found.times[-1])
        grows = f"Not chaotic: {found.no_chaos}." if found.no_chaos else "Looks chaotic."
        kind = "Looks regular." if found.is_regular else grows
        return Caption(kind, f"λ = {with_error(found.value, found.spread)} after t = {digits(end)}.")

    @property
    def separation(self) -> tuple[float, str] | None:
        """The asymptotic rate at which neighbours of the orbit separate, and its name; None if unknown or regular."""
        if self.growth is not None:
            return self.growth[0], f"Near the periodic orbit: ln|μ₁|/T = {digits(self.growth[0])}"
        found = self.result
        if found is None or found.is_regular:
            return None
        return found.value, f"λ = {with_error(found.value, found.spread)} along the chosen orbit"

    def notes(self) -> Iterator[str]:
        """Yield the reason why the motion ends early, with time and point."""
        if self.has_result("_answer") and isinstance(self._answer, NotFound):
            yield self._answer.reason


def _exponent(body: Body, start: Start, duration: float, level: Level) -> spectrum.Exponent | NotFound:
    """Return the exponent, or the reason why the motion ends early, so that other tasks continue."""
    try:
        return spectrum.lyapunov_exponent(body, start, duration, level)
    except MotionEnds as error:
        return NotFound(str(error))


def exponent_picture(button: str = "") -> Plot[Any]:
    """Return the picture of the mean growth rate over time, with a `button` that shows it, if any."""
    return Plot(
        name="exponent",
        title="Largest Lyapunov exponent",
        caption=lambda s: s.exponent.caption,
        axes=("t", "λ"),
        button=button,
        first=Axes((0.0, 200.0), (0.0, 1.0)),
        x=lambda s: (0.0, s.exponent.host.long),
        y=lambda s: s.exponent.axis,
        layers=(time_graph("lambda", lambda s: s.exponent.rates, color=theme.ORBIT),),
    )


def exponent_trial() -> Trial[Any]:
    """Return the trial of the exponent, computed at each level."""
    return Trial(
        Kind.EXPONENT,
        ("exponent",),
        lambda s, plan: s.exponent.compute(plan),
        lambda s, found, truth: abs(found.value - truth.value) / max(truth.spread, 1e-12),
        unit="of its change in the second half of the time",
        tolerance=10.0,
        most=(("long", _LONG),),
    )
