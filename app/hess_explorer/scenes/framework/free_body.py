"""The body of the free Suslov problem with I11 set by k, for the scenes of one orbit and of the scattering."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import replace

from hess_explorer.scenes.framework.sliders import Slider
from hess_explorer.views.text import digits
from hess_mechanics import parameters
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.suslov.additional_integral import I11_at
from hess_mechanics.suslov.equations import SuslovBody

I22 = replace(parameters.I22, default=1.0, softbounds=(0.2, 3.0))
I13 = replace(
    parameters.I13,
    default=0.0,
    softbounds=(-1.0, 1.0),
    doc="Product of inertia; with I₂₃ it sets the line of equilibria I₁₃ω₁ + I₂₃ω₂ = 0.",
)
I23 = replace(
    parameters.I23, default=0.5, softbounds=(-1.0, 1.0), doc="Product of inertia; I₁₃ and I₂₃ must not both be 0."
)


def free_body(k: float, I22: float, I13: float, I23: float) -> SuslovBody:
    """Return the body with I11 = I22 + k|k| (I13² + I23²)/I22, with error messages that name the controls.

    Raises `InvalidParameter` if I13 = I23 = 0, or I11 is not positive.
    """
    if I13 == I23 == 0.0:
        raise InvalidParameter(
            "I₁₃ = I₂₃ = 0: without a field ω does not change, and there is no ξ. Choose at least one of them nonzero."
        )
    I11 = I11_at(k, I22, I13, I23)
    if I11 <= 0.0:
        raise InvalidParameter(
            f"k = {digits(k)} would make I₁₁ = {digits(I11)}; a moment of inertia is positive. Choose a larger k."
        )
    return SuslovBody(I11, I22, I13, I23)


def limits_of_k(I22: float, I13: float, I23: float) -> Mapping[str, Slider]:
    """Return the range of the slider of k: from −2, or a larger round value at which I11 > 0, to 7."""
    J = math.hypot(I13, I23)
    # The slider ends at −2, so −3 is low enough; −I₂₂/J may overflow.
    lowest = max(-3.0, -I22 / J) if J > 0.0 else -3.0
    return {"k": (max(-2.0, math.ceil(lowest * 19.0) / 20.0), 7.0, 0.05)}


def derived_quantities(k: float, body: SuslovBody) -> Iterator[str]:
    """Yield I11 and k|k|, which is called k² and negative for k < 0."""
    yield f"I₁₁ = {digits(body.I11)}"
    yield f"k² = {digits(k * abs(k))}"
