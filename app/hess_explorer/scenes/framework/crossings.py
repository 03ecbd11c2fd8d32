"""A section with one orbit among others; of the others a few crossings come first."""

from __future__ import annotations

from abc import abstractmethod
from collections.abc import Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import ClassVar

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.one_orbit import OneOrbit
from hess_explorer.scenes.framework.work import drift_status
from hess_mechanics.dynamics.section import Points
from hess_mechanics.errors import WorkLimit
from hess_mechanics.numerics.results import Array

__all__ = ["Crossings"]

_FEW = 30
"""Crossings of each orbit, while a slider is dragged and until all are known."""


@dataclass(frozen=True)
class _Crossed:
    """Crossings of the orbit on show and of the others; None where they are left out, for that reason."""

    own: Points | None
    others: Points | None
    reason: str


class Crossings(OneOrbit):
    """A section with the orbit on show, and others; of the others a few crossings come first.

    The scene declares the parameters that stand here without a value.
    """

    most: ClassVar[int] = 6000

    count: float

    @abstractmethod
    def crossing(self, crossings: int) -> tuple[Task, Task]:
        """What finds so many crossings of the orbit on show, and of the others."""

    @abstractmethod
    def places_of(self, points: Points) -> Array:
        """The places (n, 2) on the section of all these points."""

    @cached_property
    def _crossed(self) -> _Crossed:
        count = int(self.count)
        few, whole = self.crossing(min(count, _FEW)), self.crossing(count)
        mine = few[0] if self.dragging else whole[0]
        try:
            own: Points = self.work.get(mine.function, *mine.arguments)
            return _Crossed(own, self.work.sooner(whole[1], few[1]), "")
        except WorkLimit as error:
            return _Crossed(None, None, f"The section is left out: {error}")

    @property
    def reason(self) -> str:
        """Why the section is left out; empty where it is not."""
        return self._crossed.reason

    @cached_property
    def own(self) -> Array | None:
        """Places (n, 2) of the orbit on show; None where the section is left out."""
        return None if self._crossed.own is None else self.places_of(self._crossed.own)

    @cached_property
    def others(self) -> Array | None:
        """Places (n, 2) of the others; None where the section is left out."""
        return None if self._crossed.others is None else self.places_of(self._crossed.others)

    def status(self) -> Iterator[str]:
        """Size, cost and drift of the section, the orbit on show."""
        found: _Crossed | None = self.known("_crossed")
        if found and found.own and found.others and self.own is not None and self.others is not None:
            steps = found.own.cost.steps + found.others.cost.steps
            yield f"section {len(self.own) + len(self.others)} points, {steps} Taylor steps"
            yield from drift_status((found.own.drift, found.others.drift))
        yield from self._orbit_status()

    def notes(self) -> Iterator[str]:
        """A section that is left out."""
        if self.known("_crossed") and self.reason:
            yield self.reason
