"""The Chaplygin ball with Suslov's constraint in a field, and the energy of its motions."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

from hess_explorer.scenes.framework.ball import Ball
from hess_explorer.scenes.framework.inertia import CentreOfMass, Tensor
from hess_explorer.scenes.framework.parameters import like, number
from hess_mechanics.chaplygin_ball.equations import BallBody

__all__ = ["PARAMETERS", "HeavyBall"]

PARAMETERS = {"h": "h", "I₁₁": "I11", "I₂₂": "I22", "I₁₃": "I13", "I₂₃": "I23", "𝒟": "D", "b₁": "b1", "b₂": "b2",
              "b₃": "b3"}
"""Of its section: symbols → names."""


@dataclass(frozen=True)
class HeavyBall(CentreOfMass, Ball):
    """A body with a ball rolling inside, in a field, and the energy of its motions."""

    I11: float = like(Tensor, "I11", 1.0, bounds=(1e-2, 1e2))
    I22: float = like(Tensor, "I22", 3.0, bounds=(1e-2, 1e2))
    I13: float = like(Tensor, "I13", 0.0, softbounds=(-1.0, 1.0), bounds=(-20.0, 20.0),
                      doc="Product of inertia; with I₁₃ = I₂₃ = 0 the flow keeps volume.")
    I23: float = like(Tensor, "I23", 0.0, softbounds=(-1.0, 1.0), bounds=(-20.0, 20.0))
    D: float = like(Ball, "D", 5.0, softbounds=(0.0, 10.0), bounds=(0.0, 1e2),
                    doc="𝒟 = (R/Rₛ)² Iₛ of the ball that rolls inside.")
    b1: float = like(CentreOfMass, "b1", 0.5, softbounds=(-1.0, 1.0), bounds=(-1e2, 1e2),
                     doc="b = −mg r, r the centre of mass.")
    b2: float = like(CentreOfMass, "b2", 0.0, softbounds=(-1.0, 1.0), bounds=(-1e2, 1e2), doc="b = −mg r.")
    b3: float = like(CentreOfMass, "b3", 0.8, softbounds=(-1.0, 1.0), bounds=(-1e2, 1e2),
                     doc="b = −mg r; with I₁₃ = I₂₃ = 0 and b₃ = 0 every orbit closes.")
    h: float = number("h", 2.0, (0.05, 5.0), 0.01, bounds=(1e-3, 1e3), label="Energy above the plane's lowest",
                      doc="E = h − √(b₁²+b₂²): every h > 0 has motions through γ₃ = 0.")

    @cached_property
    def body(self) -> BallBody:
        """The ball.  Raises `InvalidParameter`, `NotPositiveDefinite`."""
        return BallBody(self.I11, self.I22, self.I13, self.I23, self.D, self.b1, self.b2, self.b3)

    @property
    def E(self) -> float:
        """The energy."""
        return self.h - math.hypot(self.b1, self.b2)
