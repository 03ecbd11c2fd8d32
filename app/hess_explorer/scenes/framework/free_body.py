"""The body of the free Suslov problem, whose I11 is chosen by k: for the motion of one orbit and for the scattering."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property

from hess_explorer.scenes.framework.inertia import Tensor
from hess_explorer.scenes.framework.parameters import like, number
from hess_explorer.scenes.framework.scene import Motion, State
from hess_explorer.views.text import digits
from hess_explorer.views.velocity_plane import pixels_per_unit
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.suslov.additional_integral import I11_at
from hess_mechanics.suslov.equations import SYSTEM, SuslovBody

__all__ = ["FreeBody"]


@dataclass(frozen=True)
class FreeBody(State):
    """A body without a field, I13 and I23 not both 0."""

    I22: float = like(Tensor, "I22", 1.0, softbounds=(0.2, 3.0))
    I13: float = like(Tensor, "I13", 0.0, softbounds=(-1.0, 1.0),
                      doc="Product of inertia; with I₂₃ it sets the line of equilibria I₁₃ω₁ + I₂₃ω₂ = 0.")
    I23: float = like(Tensor, "I23", 0.5, softbounds=(-1.0, 1.0),
                      doc="Product of inertia; not 0 together with I₁₃.")
    k: float = number("k", 2.4, (-2.0, 7.0), 0.05, bounds=(-50.0, 50.0), group="Body", label="k, drives I₁₁",
                      doc="I₁₁ = I₂₂ + k|k| (I₁₃² + I₂₃²)/I₂₂. With I₁₃ = 0 and k odd there is an additional integral "
                          "F₂.")

    def limits(self) -> Mapping[str, tuple[float, float, float]]:
        """The slider of k begins where I11 is still positive."""
        J = math.hypot(self.I13, self.I23)
        # Below −2.2 it makes no difference; −I₂₂/J may be beyond double range.
        lowest = max(-3.0, -self.I22 / J) if J > 0.0 else -3.0
        return {"k": (max(-2.0, math.ceil(lowest * 19.0) / 20.0), 7.0, 0.05)}

    @cached_property
    def body(self) -> SuslovBody:
        """Raises `NotPositiveDefinite`, `InvalidParameter`, in the words of the controls."""
        if self.I13 == self.I23 == 0.0:
            raise InvalidParameter(
                "I₁₃ = I₂₃ = 0: without a field ω does not change, and there is no ξ. Choose one of them other than 0.")
        I11 = I11_at(self.k, self.I22, self.I13, self.I23)
        if I11 <= 0.0:
            raise InvalidParameter(f"k = {digits(self.k)} would make I₁₁ = {digits(I11)}; a moment of inertia is "
                                   "positive. Choose a larger k.")
        return SuslovBody(I11, self.I22, self.I13, self.I23)

    def general_motion(self, omega: Sequence[float], gamma: Sequence[float], span: float, half_width: float) -> Motion:
        """A motion as one of the general system."""
        return Motion(SYSTEM, (*omega, *gamma), self.body.parameters, span, pixels_per_unit(half_width))

    def derived(self) -> Iterator[str]:
        """I11 and k²."""
        yield f"I₁₁ = {digits(self.body.I11, 6)}"
        yield f"k² = {digits(self.k * abs(self.k), 6)}"
