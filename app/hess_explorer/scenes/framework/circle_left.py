"""The start of an orbit next to the unstable half of the line of rest: where on which circle γ is, how far ω is off."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TypeVar

from hess_explorer.scenes.framework.parameters import number
from hess_explorer.scenes.framework.scene import State
from hess_explorer.views import theme
from hess_explorer.views.layers import Sign
from hess_explorer.views.poisson_sphere import Circle, Direction, Sphere, ends
from hess_mechanics.numerics.results import Array

__all__ = ["CIRCLES", "CircleLeft", "sphere"]

CIRCLES = (Sign("circle joined", "line", f"border-top: 3px solid {theme.STABLE}"),
           Sign("circle left", "line", f"border-top: 3px dashed {theme.UNSTABLE}"),
           Sign("fixed points Γ = ±1", "dot", f"background: {theme.MUTED}"))
"""Of the legend."""


@dataclass(frozen=True)
class CircleLeft(State):
    """The circle θ⁻ about ξ, the phase φ on it, and the distance δ."""

    theta: float = number("θ⁻", 1.2, (0.0, 3.14), 0.01, bounds=(0.0, math.pi), label="Angle θ⁻ of the circle left",
                          doc="The angle between ξ and γ at the start of the chosen orbit.")
    phi: float = number("φ", 0.5, (-3.14, 3.14), 0.01, bounds=(-math.pi, math.pi), label="Phase φ of the chosen orbit",
                        doc="Where on that circle γ starts, in radians.")
    digits: float = number("−lg δ", 4.0, (2.0, 8.0), 0.05, bounds=(2.0, 10.0), label="Distance δ of the start, digits",
                           doc="The chosen orbit starts δ = 10^−digits of |ω| away from Nᵘ.")

    @property
    def distance(self) -> float:
        """δ."""
        return float(10.0**-self.digits)

    @property
    def levels(self) -> Sequence[float]:
        """θ⁻, and θ⁺ of a complete reversal."""
        return self.theta, math.pi - self.theta

    def circles(self, xi: Array, Gamma: float) -> list[Circle]:
        """The circle that is left, and the one (ξ, γ) = Γ that is joined."""
        return [Circle(xi, math.cos(self.theta), "unstable"), Circle(xi, Gamma, "stable")]


C = TypeVar("C", bound=CircleLeft)


def sphere(caption: Callable[[C], str], xi: Callable[[C], Array], Gamma: Callable[[C], float],
           signs: tuple[Sign, ...] = ()) -> Sphere[C]:
    """The sphere with the orbit on show, the circle that it leaves and the one that it joins, and the axis ξ."""
    return Sphere(caption=caption, looks={"orbit": "orbit"}, axis=lambda s: Direction(xi(s), "ξ"), signs=signs,
                  circles=lambda s: s.circles(xi(s), Gamma(s)), marks=lambda s: ends(xi(s)))
