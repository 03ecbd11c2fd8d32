"""The unrolled torus of the Hess case: invariant density and the current orbit."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeVar

import numpy as np

from hess_explorer.views import theme
from hess_explorer.views.caption import Caption
from hess_explorer.views.graphs.graph import ANGLE, ANGLE_TICKS
from hess_explorer.views.layers import CellGrid, Layers, Sign, dots, image
from hess_explorer.views.maps.circle_map import cycles
from hess_explorer.views.plot import Plot
from hess_explorer.views.text import digits
from hess_mechanics.numerics.results import Array
from hess_mechanics.suslov_hess.bifurcation import TurningPoints
from hess_mechanics.suslov_hess.circle_map import CircleMap
from hess_mechanics.suslov_hess.torus import Track

S = TypeVar("S")

_SHADES = tuple(f"{theme.STABLE}{round(220 * i / 255):02x}" for i in range(256))


def phases(track: Track, theta: CircleMap | None) -> Array:
    """Return σ (n,) in [−π, π) along an orbit, where σ grows by 2π per return; 0 if `theta` is None (separatrix)."""
    if theta is None:
        return np.zeros(track.orbit.times.size)
    turns = track.orbit.times / theta.period
    return np.asarray(2.0 * np.pi * (turns - np.floor(turns + 0.5)))


def reason_for_no_density(theta: CircleMap | None, turning_points: TurningPoints | None) -> str:
    """Return the reason for a missing density; empty if it can be drawn.  The arguments are None on the separatrix."""
    if theta is None or turning_points is None:
        return "On the separatrix no motion returns."
    if turning_points.roots[2] - turning_points.roots[1] < 1e-6:
        return "On the bifurcation curve the torus is a circle."
    if theta.kind == "hyperbolic":
        return "|trace| > 2: all motions but one tend to the stable limit cycle."
    if theta.kind == "parabolic":
        return f"|trace| = 2: {cycles(theta)}."
    return "At f = 0 the angle φ jumps where w = 0: choose another f." if theta.f == 0.0 else ""


def caption(density: Array) -> Caption:
    """Return the caption of a density (n, m) relative to the uniform density."""
    low, high = digits(float(density.min()), 3), digits(float(density.max()), 3)
    if low == high:
        return Caption("The flow preserves the uniform density.", "Uniform to three digits.")
    return Caption("The flow preserves this density.", f"{low} to {high} times the uniform density; greener is denser.")


def picture(density: Callable[[S], tuple[Array | None, str]]) -> Plot[S]:
    """Return the plot of the invariant density and of the orbit over (σ, φ).

    Parameters
    ----------
    density : callable
        `density(state)` returns the density (n, m) relative to the uniform one, or None, and the reason for None.
    """

    def state_caption(state: S) -> Caption:
        found, reason = density(state)
        return Caption("No density is drawn.", reason) if found is None else caption(found)

    def shares(state: S) -> CellGrid | None:
        found, _ = density(state)
        return None if found is None else CellGrid(found / found.max(), ANGLE, ANGLE)

    layers: Layers[S] = (
        image(
            "density",
            shares,
            palette=_SHADES,
            low=0.0,
            high=1.0,
            legend=(Sign("density on the torus", "box", f"background: {theme.STABLE}"),),
        ),
        dots("path", track="orbit", columns=("sigma", "phi"), color=theme.ORBIT, size=8),
    )
    return Plot(
        name="torus",
        title="Density on the torus",
        caption=state_caption,
        axes=("σ", "φ"),
        x=ANGLE,
        y=ANGLE,
        ticks=ANGLE_TICKS,
        dot=("sigma", "phi"),
        button="Show the density on the torus",
        layers=layers,
    )
