"""One orbit of a body, sampled for the pictures."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import Any, Protocol

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.part import Host, Part
from hess_explorer.scenes.framework.scene import Motion
from hess_explorer.scenes.framework.work import orbit_status
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import with_margin
from hess_explorer.views.layers import Columns, Range, column, line
from hess_explorer.views.picture import Picture
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_mechanics.dynamics.sampling import sampled_orbit
from hess_mechanics.dynamics.system import Body
from hess_mechanics.numerics import results
from hess_mechanics.numerics.accuracy import Level


class _Host(Host, Protocol):
    @property
    def body(self) -> Body:
        """The equations and their parameters.  Raises `ModelError`."""

    @property
    def start(self) -> tuple[float, ...]:
        """The state at t = 0.  Raises `ModelError`."""

    @property
    def duration(self) -> float:
        """The time span of the orbit."""

    @property
    def weights(self) -> tuple[float, ...]:
        """Pixels of the pictures per unit of each variable."""


@dataclass(frozen=True, eq=False)
class BodyOrbit(Part[_Host]):
    """The orbit of a body from `start`.

    Attributes
    ----------
    accuracy : callable or None
        `accuracy()` returns the level of the orbit; by default the level of the state.
    most : int
        Largest number of samples.
    max_step : float
        Largest step size; 0 for no limit.
    """

    accuracy: Callable[[], Level] | None = None
    most: int = 4000
    max_step: float = 0.0

    @property
    def orbit_task(self) -> Task[results.Orbit]:
        """The task of the sampled orbit."""
        host = self.host
        level = self.work.level if self.accuracy is None else self.accuracy()
        step = self.max_step or None
        return Task(sampled_orbit, host.body, host.start, host.duration, host.weights, level, self.most, step)

    @cached_property
    def path(self) -> results.Orbit:
        """The sampled orbit: `times` (n,) and `states` (n, d)."""
        return self.work.need(self.orbit_task)

    def motion(self) -> Motion:
        """Return the motion of the orbit, for "Speed and accuracy"."""
        host = self.host
        return Motion(host.body.system, host.start, host.body.parameters, host.duration, host.weights)

    @property
    def caption(self) -> Caption:
        """The caption: the time span, and whether the motion ends early."""
        ends = "The motion ends early." if self.path.reason else ""
        return Caption(ends, f"From t = 0 to t = {digits(float(self.path.times[-1]))}.")

    def notes(self) -> Iterator[str]:
        """Yield the reason why the motion ends early, with time and point."""
        if self.has_result("path") and self.path.reason:
            yield self.path.reason

    def status(self) -> Iterator[str]:
        """Yield the size, cost and error of the orbit."""
        if self.has_result("path"):
            yield orbit_status(self.path)[0]

    @property
    def columns(self) -> Columns:
        """The columns of the orbit by name: t and each variable."""
        states = zip(self.host.body.system.variables, self.path.states.T, strict=True)
        return {"t": column(self.path.times), **{name: column(values) for name, values in states}}


def orbit_picture(x: str, y: str, title: str = "The orbit", name: str = "orbit") -> Picture[Any]:
    """Return the picture of the orbit in the plane of two variables; the scene needs `columns` as track "orbit"."""

    def room_for(name: str) -> Callable[[Any], Range]:
        return lambda s: with_margin(s.orbit.columns[name], 0.06, 1e-3)

    return Plot(
        name=name,
        title=title,
        caption=lambda s: s.orbit.caption,
        axes=(x, y),
        x=room_for(x),
        y=room_for(y),
        dot=(x, y),
        layers=(
            line("orbit", track="orbit", columns=(x, y), color=theme.ORBIT, width=2.5, label="orbit", tag="orbit"),
        ),
    )
