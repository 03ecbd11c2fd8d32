"""θ⁺ over the square of all (φ, θ⁻), and curves θ⁺(φ)."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TypeVar

import numpy as np
from bokeh.palettes import Cividis256

from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import ANGLE, ANGLE_TICKS
from hess_explorer.views.layers import CellGrid, Layers, Range, Sign, curves, image, line, ring, target
from hess_explorer.views.plane.velocity_plane import round_up
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_mechanics.numerics.results import Array

S = TypeVar("S")

POLAR: Range = (0.0, math.pi)
POLAR_TICKS = ((0.0, "0"), (math.pi / 4, "π/4"), (math.pi / 2, "π/2"), (3 * math.pi / 4, "3π/4"), (math.pi, "π"))


def square_plot(
    caption: Callable[[S], Caption], theta_plus: Callable[[S], Array], here: Callable[[S], tuple[float, float]]
) -> Plot[S]:
    """Return the plot of θ⁺ over (φ, θ⁻); a click or drag sets both parameters.

    Parameters
    ----------
    caption : callable
        `caption(state)` returns the caption.
    theta_plus : callable
        `theta_plus(state)` returns θ⁺ (m, n) in radians, rows of equal θ⁻ from 0 to π and columns from φ = −π to π.
    here : callable
        `here(state)` returns the current φ and θ⁻.
    """
    return Plot(
        name="map",
        title="θ⁺ over (φ, θ⁻)",
        caption=caption,
        axes=("φ", "θ⁻"),
        x=ANGLE,
        y=POLAR,
        ticks=ANGLE_TICKS,
        y_ticks=POLAR_TICKS,
        on_click=lambda s, x, y: {"phi": x, "theta": y},
        on_drag="here",
        layers=(
            image(
                "theta",
                lambda s: CellGrid(theta_plus(s), ANGLE, POLAR),
                palette=theme.NUMBER_MAP,
                low=0.0,
                high=math.pi,
                smooth=True,
                legend=(Sign("θ⁺ from 0 to π", "box rho", f"background: {theme.gradient(Cividis256)}"),),
            ),
            line("line", lambda s: (ANGLE, (here(s)[1],) * 2), color="white", dash="dashed"),
            *target("here", lambda s: [here(s)], size=19.0),
        ),
    )


def phase_plot(
    caption: Callable[[S], Caption], layers: Layers[S], message: Callable[[S], str] | None = None
) -> Plot[S]:
    """Return the plot of curves θ⁺(φ); a click or drag sets the phase."""
    return Plot(
        name="curve",
        title="θ⁺ against the phase φ",
        caption=caption,
        axes=("φ", "θ⁺"),
        x=ANGLE,
        y=POLAR,
        ticks=ANGLE_TICKS,
        y_ticks=POLAR_TICKS,
        message=message,
        on_click=lambda s, x, y: {"phi": x},
        on_drag="chosen",
        layers=layers,
    )


def range_text(theta_plus: Array) -> str:
    """Return the range of a curve θ⁺(φ), (n,), in words; a range below 1e-4 counts as constant."""
    low, high = float(np.min(theta_plus)), float(np.max(theta_plus))
    return f"θ⁺ = {digits(low)} for every φ" if high - low < 1e-4 else f"θ⁺ from {digits(low)} to {digits(high)}"


def order_plot(
    ends: Callable[[S], Range],
    orders: Callable[[S], Array],
    here: Callable[[S], tuple[float, float]],
    closed: Callable[[S], float],
) -> Plot[S]:
    """Return the plot of cos χ over k; a click or drag sets k.

    Parameters
    ----------
    ends : callable
        `ends(state)` returns the range of k.
    orders : callable
        `orders(state)` returns rows (k, cos χ) of the closed form, (n, 2).
    here : callable
        `here(state)` returns k of the body and the computed cos χ.
    closed : callable
        `closed(state)` returns cos χ of the closed form for the body.
    """

    def about(state: S) -> Caption:
        computed, exact = here(state)[1], closed(state)
        return Caption(
            numbers=f"cos χ = {digits(computed)}; the closed form differs by {digits(abs(computed - exact), 2)}."
        )

    return Plot(
        name="chi",
        title="cos χ against k",
        caption=about,
        axes=("k", "cos χ"),
        button="Show cos χ against k",
        x=ends,
        y=lambda s: cosine_axis(orders(s)[:, 1].max(initial=here(s)[1])),
        on_click=lambda s, x, y: {"k": x},
        on_drag="chosen",
        layers=(
            curves(
                "closed", lambda s: [orders(s)], color=theme.MAP, dash="dashed", label="closed form", tag="closed form"
            ),
            ring("chosen", lambda s: [here(s)], size=18.0),
        ),
    )


def cosine_axis(largest: float) -> Range:
    """Return an axis from just below −1 to above the largest cosine."""
    reach = round_up(max(1e-3, 1.0 + float(largest)))
    return -1.0 - 0.05 * reach, -1.0 + 1.05 * reach
