"""Draw plots with Matplotlib: their HoloViews elements, and the moving points above them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

import holoviews as hv

from hess_explorer.export.moment import density_at, state_at
from hess_explorer.export.picture_data import PictureData
from hess_explorer.views.cloud import CloudPlane
from hess_explorer.views.elements import Colour, on_paper, overlay
from hess_explorer.views.layers import Columns, Layer
from hess_explorer.views.plot import Plot

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Frame

__all__ = ["densities", "draw_moving", "draw_still"]

_OVER = 1e3
"""Drawing order of moving points, above all static layers."""


def draw_still(frame: Frame, data: PictureData, colour: Colour) -> None:
    """Draw axes, layers and the message in the middle."""
    plot, axes = data.picture, data.axes
    assert isinstance(plot, Plot)
    assert axes is not None
    renderer = hv.renderer("matplotlib")
    elements = overlay(plot, data.columns, axes, plot.names(data.state), colour=colour)
    renderer.get_plot(elements, fig=frame.figure, axis=frame)


def densities(data: PictureData) -> list[tuple[CloudPlane[Any], Layer[Any]]]:
    """Return the layers that show the density of a cloud at the moving time, each with its cloud."""
    plot = data.picture
    layers = {plot.source_of(layer): layer for layer in plot.layers} if isinstance(plot, Plot) else {}
    return [
        (view, layers[view.density])
        for view in data.scene.views
        if isinstance(view, CloudPlane) and view.density in layers and view.name in plot.needs
    ]


def draw_moving(frame: Frame, data: PictureData, colour: Colour, t: float, point: bool) -> None:
    """Draw the density of a cloud at time t; point : True to include the points that follow the orbit."""
    for layer, columns in (*_clouds(data, t), *(_points(data, t) if point else ())):
        frame.scatter(*(columns[name] for name in layer.columns[:2]), zorder=_OVER, **on_paper(layer, colour))


def _clouds(data: PictureData, t: float) -> Iterator[tuple[Layer[Any], Columns]]:
    for view, layer in densities(data):
        yield layer, dict(zip(layer.columns, density_at(data.columns.get(view.name, {}), t), strict=True))


def _points(data: PictureData, t: float) -> Iterator[tuple[Layer[Any], Columns]]:
    plot, state = data.picture, state_at(data.columns.get("data-orbit", {}), data.scene.angles, t)
    assert isinstance(plot, Plot)
    layers = {plot.source_of(layer): layer for layer in (*plot.layers, plot.point)}
    for source, columns in plot.followers.items() if state else ():
        layer = layers[source]
        yield layer, dict(zip(layer.columns, ([state[name]] for name in columns), strict=True))
