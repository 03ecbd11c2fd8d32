"""Draw plots with Matplotlib: their HoloViews elements, and the moving points above them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import holoviews as hv

from hess_explorer.export.moment import density_at, state_at
from hess_explorer.export.shown import Shown
from hess_explorer.views.cloud import CloudPlane
from hess_explorer.views.elements import Colour, on_paper, overlay
from hess_explorer.views.layers import Columns, Layer
from hess_explorer.views.plot import Plot

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Frame

__all__ = ["densities", "draw_moving", "draw_still"]

_OVER = 1e3
"""Drawing order of moving points, above all static layers."""


def draw_still(frame: Frame, shown: Shown, colour: Colour) -> None:
    """Draw axes, layers and the message in the middle."""
    plot, axes = shown.picture, shown.axes
    assert isinstance(plot, Plot)
    assert axes is not None
    renderer = hv.renderer("matplotlib")
    elements = overlay(plot, shown.columns, axes, plot.names(shown.state), colour=colour)
    renderer.get_plot(elements, fig=frame.figure, axis=frame)


def densities(shown: Shown) -> list[tuple[CloudPlane[Any], Layer[Any]]]:
    """Return the layers that show the density of a cloud at the moving time, each with its cloud."""
    plot = shown.picture
    layers = {plot.source_of(layer): layer for layer in plot.layers} if isinstance(plot, Plot) else {}
    return [
        (view, layers[view.density])
        for view in shown.scene.views
        if isinstance(view, CloudPlane) and view.density in layers and view.name in plot.needs
    ]


def draw_moving(frame: Frame, shown: Shown, colour: Colour, t: float, point: bool) -> None:
    """Draw the density of a cloud at time t; point : True to include the points that follow the orbit."""
    for layer, columns in (*_clouds(shown, t), *(_points(shown, t) if point else ())):
        frame.scatter(*(columns[name] for name in layer.columns[:2]), zorder=_OVER, **on_paper(layer, colour))


def _clouds(shown: Shown, t: float) -> Iterator[tuple[Layer[Any], Columns]]:
    for view, layer in densities(shown):
        yield layer, dict(zip(layer.columns, density_at(shown.columns.get(view.name, {}), t), strict=True))


def _points(shown: Shown, t: float) -> Iterator[tuple[Layer[Any], Columns]]:
    plot, state = shown.picture, state_at(shown.columns.get("data-orbit", {}), shown.scene.angles, t)
    assert isinstance(plot, Plot)
    layers = {plot.source_of(layer): layer for layer in (*plot.layers, plot.point)}
    for source, columns in plot.followers.items() if state else ():
        layer = layers[source]
        yield layer, dict(zip(layer.columns, ([state[name]] for name in columns), strict=True))
