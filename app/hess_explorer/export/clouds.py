"""Draw clouds of phase points with Matplotlib, on the plane (ω1, ω2) and on the sphere, rasterized in vector files."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from hess_explorer.export.moment import CloudFrame, clouds_at
from hess_explorer.export.picture_data import PictureData
from hess_explorer.export.sphere_canvas import LOOKS, SphereCanvas, seen
from hess_explorer.views import theme
from hess_explorer.views.cloud import CloudPlane
from hess_explorer.views.elements import Colour
from hess_mechanics.numerics.results import Array

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Frame

__all__ = ["draw_moving", "draw_still", "on_sphere"]

_COLOURS = (theme.ORBIT, theme.MAP)
_SIDE = 0.9
"""Size of a point, in typographic points."""


def draw_still(frame: Frame, data: PictureData, colour: Colour) -> None:
    """Draw the axes, the lines σ1 and σ2, the line of equilibria and the ends of its halves."""
    picture, axes = data.picture, data.axes
    assert isinstance(picture, CloudPlane)
    assert axes is not None
    frame.set(xlim=axes.x, ylim=axes.y, box_aspect=1.0, xlabel="ω₁", ylabel="ω₂")
    own = data.columns.get(picture.name, {})
    for look, x, y in own.get("curves", ()):
        ink, dash, weight = LOOKS[look]
        frame.plot(x, y, color=colour(ink), linestyle=dash, linewidth=weight)
    for look, a, b in own.get("points", ()):
        ink = colour(LOOKS[look][0])
        frame.plot(
            [a],
            [b],
            marker="o",
            markersize=5.0,
            markeredgecolor=ink,
            markeredgewidth=1.5,
            markerfacecolor="none" if look == "unstable" else ink,
            linestyle="none",
        )


def draw_moving(frame: Frame, data: PictureData, colour: Colour, t: float) -> None:
    """Draw the clouds at time t above the equilibria, where a whole cloud may end."""
    for cloud, ink in zip(clouds_at(data.columns.get(data.picture.name, {}), t), _COLOURS, strict=False):
        _dots(frame, cloud.omega, colour(ink), 3.0)


def on_sphere(canvas: SphereCanvas, clouds: Sequence[CloudFrame], near: bool) -> None:
    """Draw the points of the near or far half."""
    for cloud, ink in zip(clouds, _COLOURS, strict=False):
        x, y, depth = seen(cloud.gamma, *canvas.view).T
        there = (depth >= 0.0) == near
        _dots(canvas.frame, np.column_stack([x, y])[there], canvas.colour(ink), canvas.above(), 1.0 if near else 0.3)


def _dots(frame: Frame, places: Array, colour: str, order: float, faint: float = 1.0) -> None:
    # Fewer points are more opaque.
    alpha = faint * float(np.clip(4300.0 / max(1, len(places)), 0.43, 0.9))
    frame.plot(
        *places.T,
        linestyle="none",
        marker="s",
        markersize=_SIDE,
        markeredgewidth=0,
        color=colour,
        alpha=alpha,
        zorder=order,
        rasterized=True,
    )
