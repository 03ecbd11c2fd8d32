"""Start of an orbit near the unstable half of the line of equilibria: phase of γ on a circle, distance of ω."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Any, TypeVar

from hess_explorer.scenes.framework.sliders import ONE_TURN
from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import time_graph
from hess_explorer.views.layers import Layer, Sign, levels
from hess_explorer.views.plot import Plot
from hess_explorer.views.space.poisson_sphere import Circle, Direction, Sphere, ends
from hess_mechanics.numerics.results import Array
from hess_mechanics.parameters import CIRCLE_PHASE, Parameter

CIRCLES = (
    Sign("limit circle for t → ∞", "line", f"border-top: 3px solid {theme.STABLE}"),
    Sign("limit circle for t → −∞", "line", f"border-top: 3px dashed {theme.UNSTABLE}"),
    Sign("fixed points Γ = ±1", "dot", f"background: {theme.MUTED}"),
)
"""Legend entries of the sphere."""

PHI = replace(CIRCLE_PHASE, label="Phase φ of the chosen orbit", bounds=ONE_TURN)
DIGITS = Parameter(
    "digits",
    "−lg δ",
    "Distance δ of the start, digits",
    4.0,
    (2.0, 8.0),
    0.05,
    (2.0, 10.0),
    "Distance of the start of the chosen orbit from Nᵘ, in units of |ω|: δ = 10^−digits.",
)

S = TypeVar("S")


def sphere(
    caption: Callable[[S], Caption],
    xi: Callable[[S], Array],
    left: Callable[[S], float],
    joined: Callable[[S], float],
    signs: tuple[Sign, ...] = (),
) -> Sphere[S]:
    """Return the sphere with the orbit, the axis ξ and the limit circles of γ about it.

    Parameters
    ----------
    caption : callable
        `caption(state)` returns the caption.
    xi : callable
        `xi(state)` returns the unit vector ξ, (3,).
    left : callable
        `left(state)` returns the angle θ⁻ between γ and ξ for t → −∞, in radians.
    joined : callable
        `joined(state)` returns Γ = (ξ, γ) for t → ∞.
    signs : tuple of Sign
        Additional legend entries.
    """
    return Sphere(
        caption=caption,
        looks={"orbit": "orbit"},
        axis=lambda s: Direction(xi(s), "ξ"),
        signs=signs,
        circles=lambda s: [Circle(xi(s), math.cos(left(s)), "unstable"), Circle(xi(s), joined(s), "stable")],
        marks=lambda s: ends(xi(s)),
    )


def Gamma_picture(
    caption: Callable[[Any], Caption],
    limits: Callable[[Any], Sequence[float]],
    orbit: Callable[[Any], tuple[Array, Array]],
    *others: Layer[Any],
) -> Plot[Any]:
    """Return the graph of Γ = (ξ, γ) over the time span of the state, with levels.

    Parameters
    ----------
    caption : callable
        `caption(state)` returns the caption.
    limits : callable
        `limits(state)` returns the levels of Γ.
    orbit : callable
        `orbit(state)` returns the times (n,) and Γ (n,) of the chosen orbit.
    *others : Layer
        Further layers, under that of the chosen orbit.
    """
    return Plot(
        name="Gamma",
        title="Γ = (ξ, γ) against time",
        caption=caption,
        axes=("t", "Γ"),
        button="Show Γ against time",
        x=lambda s: (0.0, s.span),
        y=(-1.05, 1.05),
        dot=("t", "Gamma"),
        layers=(levels("levels", limits), *others, time_graph("first", orbit, color=theme.ORBIT, tag="orbit")),
    )
