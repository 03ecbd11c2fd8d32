"""The parameters of a ball in a field, for its sections."""

from __future__ import annotations

from dataclasses import replace

from hess_mechanics import parameters

# Narrower bounds than elsewhere: beyond them a section takes too many Taylor steps.
_MOMENT, _PRODUCT, _FIELD = (1e-2, 1e2), (-20.0, 20.0), (-1e2, 1e2)
_NEAR_0 = (-1.0, 1.0)

I11 = replace(parameters.I11, default=1.0, bounds=_MOMENT)
I22 = replace(parameters.I22, default=3.0, bounds=_MOMENT)
I13 = replace(
    parameters.I13,
    default=0.0,
    softbounds=_NEAR_0,
    bounds=_PRODUCT,
    doc="Product of inertia; with I₁₃ = I₂₃ = 0 the flow preserves volume.",
)
I23 = replace(parameters.I23, default=0.0, softbounds=_NEAR_0, bounds=_PRODUCT)
D = replace(
    parameters.D,
    default=5.0,
    softbounds=(0.0, 10.0),
    bounds=(0.0, 1e2),
    doc="𝒟 = (R/Rₛ)² Iₛ of the ball that rolls inside.",
)
B1 = replace(
    parameters.B1, default=0.5, softbounds=_NEAR_0, bounds=_FIELD, doc="b = −mg r, where r is the centre of mass."
)
B2 = replace(parameters.B2, default=0.0, softbounds=_NEAR_0, bounds=_FIELD, doc="Component of b = −mg r.")
B3 = replace(
    parameters.B3,
    default=0.8,
    softbounds=_NEAR_0,
    bounds=_FIELD,
    doc="b = −mg r; with I₁₃ = I₂₃ = 0 and b₃ = 0 every orbit that returns closes.",
)

PARAMETERS = {
    "h": "h",
    "I₁₁": "I11",
    "I₂₂": "I22",
    "I₁₃": "I13",
    "I₂₃": "I23",
    "𝒟": "D",
    "b₁": "b1",
    "b₂": "b2",
    "b₃": "b3",
}
"""Names of the parameters of a ball's section, by symbol."""
