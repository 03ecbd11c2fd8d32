"""The Chaplygin ball, and the one without a field at an energy, for orbits across its strip and clouds on it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from hess_explorer.scenes.framework.inertia import Tensor
from hess_explorer.scenes.framework.parameters import like, number
from hess_mechanics.chaplygin_ball.energy_surface import Strip, line_of_rest
from hess_mechanics.chaplygin_ball.equations import BallBody
from hess_mechanics.numerics.results import Array

__all__ = ["Ball", "FreeBall"]


@dataclass(frozen=True)
class Ball(Tensor):
    """A body with a ball rolling inside."""

    D: float = number("𝒟", 10.0, (0.0, 20.0), 0.05, bounds=(0.0, 300.0), group="Body", label="Ball inside, 𝒟",
                      doc="𝒟 = (R/Rₛ)² Iₛ of the ball that rolls inside; 0 is the free Suslov problem.")


@dataclass(frozen=True)
class FreeBall(Ball):
    """A ball without a field, I13 and I23 not both 0, at the energy h."""

    I11: float = like(Tensor, "I11", 1.0)
    I13: float = like(Tensor, "I13", 0.7, doc="Product of inertia; with I₂₃ it sets the line I₁₃ω₁ + I₂₃ω₂ = 0.")
    I23: float = like(Tensor, "I23", 1.2, doc="Product of inertia; not 0 together with I₁₃.")
    h: float = number("h", 10.0, (0.1, 20.0), 0.1, bounds=(1e-6, 1e6), label="Energy h",
                      doc="E = h > 0: every such energy is possible. It sets the size of the strip and the unit of "
                          "time.")

    @cached_property
    def body(self) -> BallBody:
        """Raises `InvalidParameter`, `NotPositiveDefinite`."""
        return BallBody(self.I11, self.I22, self.I13, self.I23, self.D)

    @cached_property
    def strip(self) -> Strip:
        """Where ω may be."""
        return Strip(self.body, self.h)

    @cached_property
    def xi(self) -> Array:
        """ξ (3,).  Raises `InvalidParameter`."""
        return np.append(line_of_rest(self.body)[0], 0.0)
