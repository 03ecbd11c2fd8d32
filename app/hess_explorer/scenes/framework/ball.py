"""The Chaplygin ball."""

from __future__ import annotations

from dataclasses import dataclass

from hess_explorer.scenes.framework.inertia import Tensor
from hess_explorer.scenes.framework.parameters import number

__all__ = ["Ball"]


@dataclass(frozen=True)
class Ball(Tensor):
    """A body with a ball rolling inside."""

    D: float = number("𝒟", 10.0, (0.0, 20.0), 0.05, bounds=(0.0, 300.0), group="Body", label="Ball inside, 𝒟",
                      doc="𝒟 = (R/Rₛ)² Iₛ of the ball that rolls inside; 0 is the free Suslov problem.")
