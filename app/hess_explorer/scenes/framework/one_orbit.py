"""A state with one orbit of a body on show."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator
from functools import cached_property
from typing import ClassVar

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.proved_orbit import ProvedOrbit
from hess_explorer.scenes.framework.scene import Motion
from hess_explorer.scenes.framework.work import orbit_status
from hess_mechanics.dynamics.sampling import sampled_orbit
from hess_mechanics.dynamics.system import Body
from hess_mechanics.numerics.accuracy import Level
from hess_mechanics.numerics.results import Orbit

__all__ = ["OneOrbit", "Start"]

Start = tuple[float, ...]


class OneOrbit(ProvedOrbit):
    """A state with one orbit on show, of a body, from `start`; `most`: as many samples."""

    most: ClassVar[int] = 4000

    span: float

    @property
    @abstractmethod
    def body(self) -> Body:
        """The body.  Raises `ModelError`."""

    @property
    @abstractmethod
    def start(self) -> Start:
        """Where the orbit starts.  Raises `ModelError`."""

    @property
    def start_asked_for(self) -> Start:
        """Where it was asked to start.  Raises `OutsideRegion` where no motion does and another place was taken."""
        return self.start

    @property
    @abstractmethod
    def weights(self) -> tuple[float, ...]:
        """From the variables to the scene's pictures, in pixels for a unit."""

    @property
    def lasts(self) -> float:
        """How long the orbit is followed."""
        return self.span

    @cached_property
    def orbit(self) -> Orbit:
        """The orbit on show."""
        found: Orbit = self.work.get(self.finding.function, *self.finding.arguments)
        return found

    @property
    def finding(self) -> Task:
        """What finds it."""
        return Task(sampled_orbit, (self.body, self.start, self.lasts, self.weights, self.orbit_level, self.most))

    @property
    def orbit_level(self) -> Level:
        """The accuracy of the orbit on show."""
        return self.level

    def motion(self) -> Motion:
        """The orbit on show."""
        return Motion(self.body.system, self.start, self.body.parameters, self.lasts, self.weights)

    def _orbit_status(self) -> Iterator[str]:
        if self.known("orbit"):
            yield orbit_status(self.orbit)[0]
            yield from self.certainty()
