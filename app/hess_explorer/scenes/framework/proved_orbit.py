"""What is proved of the orbit on show: how far it can be from the true one, at the moments of its samples."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Iterator
from functools import cached_property

import numpy as np

from hess_explorer.compute.cache import Task
from hess_explorer.scenes.framework.scene import Motion, State
from hess_explorer.scenes.parts.proof import SHOWN, ProvedError, judged, proved_error_shown
from hess_explorer.views.poisson_sphere import Circle
from hess_mechanics.numerics.balls import has_flint
from hess_mechanics.numerics.results import Array

__all__ = ["ProvedOrbit", "proved_error_shown"]


class ProvedOrbit(State, ABC):
    """A state with one orbit of a traced system on show, the error of which may be proved.

    The scene declares the parameter that stands here without a value.
    """

    certain: str

    @property
    def units(self) -> tuple[float, float]:
        """Of ω1 and ω2 in the computation, in those of the picture."""
        return 1.0, 1.0

    @property
    @abstractmethod
    def finding(self) -> Task:
        """What finds the orbit on show, an `Orbit` or a `Track`.  Raises `ModelError`."""

    @abstractmethod
    def motion(self) -> Motion:
        """The motion that it follows.  Raises `ModelError`."""

    @cached_property
    def proved_error(self) -> ProvedError | None:
        """What is proved of it, as soon as it is known; not while a slider is dragged, nor unless it is asked for."""
        if self.dragging or self.certain != SHOWN:
            return None
        if not has_flint():
            return ProvedError("proofs need python-flint: pip install 'hess-explorer[prove]'")
        return self.work.later(judged, self.finding, self.motion(), self.units)

    @property
    def proved_band(self) -> list[list[Array]]:
        """For a `region`: where the true orbit is, if that is wider than a pixel."""
        return [] if self.proved_error is None else [[one] for one in self.proved_error.band]

    @property
    def proved_around(self) -> list[Circle]:
        """The same on the sphere, at some moments."""
        found = () if self.proved_error is None else self.proved_error.around
        return [Circle(gamma, float(np.cos(radius)), "muted") for gamma, radius in found]

    def certainty(self) -> Iterator[str]:
        """For the status line."""
        if self.proved_error is not None:
            yield self.proved_error.said
