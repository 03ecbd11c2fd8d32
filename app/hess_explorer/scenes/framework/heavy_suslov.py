"""A body of the Suslov problem with gravity, by its parameters, and the room that its motions of one energy take."""

from __future__ import annotations

import math
from functools import cached_property

from hess_explorer.scenes.framework.inertia import CentreOfMass, Tensor
from hess_explorer.views.velocity_plane import nice_above, pixels_per_unit
from hess_mechanics.suslov.equations import SuslovBody

__all__ = ["HeavySuslov"]


class HeavySuslov(CentreOfMass, Tensor):
    """A body and the energy of its motions.

    The scene declares the parameter that stands here without a value: h = E + |b|, the energy above the bottom.
    """

    h: float

    @cached_property
    def body(self) -> SuslovBody:
        """The body.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
        return SuslovBody(self.I11, self.I22, self.I13, self.I23, self.b1, self.b2, self.b3)

    @property
    def E(self) -> float:
        """The energy."""
        return self.h - math.hypot(self.b1, self.b2, self.b3)

    @property
    def half_width(self) -> float:
        """Of the (ω1, ω2)-plane: room for all motions of this energy."""
        return nice_above(1.05 * math.sqrt(2.0 * self.h / min(self.I11, self.I22)))

    @property
    def weights(self) -> tuple[float, ...]:
        """From the variables to the pictures, in pixels for a unit."""
        return pixels_per_unit(self.half_width)
