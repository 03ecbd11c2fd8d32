"""Plots as figures: the layers and axes of the page, and what moves in them."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from hess_explorer.export.moment import density_at, state_at
from hess_explorer.export.sheet import Colour
from hess_explorer.export.shown import Shown
from hess_explorer.views import theme
from hess_explorer.views.cloud import CloudPlane
from hess_explorer.views.layers import POINT, Columns, Layer
from hess_explorer.views.plot import Plot

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Frame

__all__ = ["densities", "draw_moving", "draw_still"]

_MOST_VECTORS = 5000
"""More dots than these are pixels in a vector file, which would else take a viewer seconds."""
_OVER = 3.0
"""The order of what moves: over all that is still."""
_POINTS = 72.0 / 96.0
"""Of type, for a pixel of the page."""
_MARKERS = {"circle": "o", "triangle": "^", "diamond": "D"}
_DASHES: Mapping[str, Any] = {
    "solid": "-", "dashed": (0, (6, 3)), "dotted": (0, (2, 4)), "dotdash": (0, (2, 4, 6, 4))}


def draw_still(frame: Frame, shown: Shown, colour: Colour) -> None:
    """Axes, layers and the message in the middle."""
    plot, axes = shown.picture, shown.axes
    assert isinstance(plot, Plot)
    assert axes is not None
    frame.set(xlim=axes.x, ylim=axes.y, box_aspect=1.0)
    if "x" in plot.log:
        frame.set_xscale("log")
    if "y" in plot.log:
        frame.set_yscale("log")
    names = plot.axes if isinstance(plot.axes, tuple) else plot.axes(shown.state)
    frame.set_xlabel(names[0])
    frame.set_ylabel(names[1])
    if plot.ticks is not None:
        frame.set_xticks([at for at, _ in plot.ticks], [label for _, label in plot.ticks])
        upright = plot.y_ticks or plot.ticks
        frame.set_yticks([at for at, _ in upright], [label for _, label in upright])
    if plot.x_ticks is not None:
        frame.set_xticks(list(plot.x_ticks))
    for order, layer in enumerate(plot.layers):
        columns = shown.columns.get(plot.source_of(layer), {})
        if len(columns.get(layer.columns[0], ())):
            _GLYPHS[layer.glyph](frame, layer, columns, colour, 1.0 + 0.01 * order)
    message = shown.columns.get(f"{plot.name}-message", {})
    for text in message.get("text", ()):
        frame.text(0.5, 0.5, text, transform=frame.transAxes, ha="center", va="center", color=colour(theme.MUTED))


def densities(shown: Shown) -> list[tuple[CloudPlane[Any], Layer[Any]]]:
    """The layers that show the density of a cloud at the moving time, and whose."""
    plot = shown.picture
    layers = {plot.source_of(layer): layer for layer in plot.layers} if isinstance(plot, Plot) else {}
    return [(view, layers[view.density]) for view in shown.scene.views
            if isinstance(view, CloudPlane) and view.density in layers and view.name in plot.needs]


def draw_moving(frame: Frame, shown: Shown, colour: Colour, t: float, point: bool) -> None:
    """The density of a cloud at a time; point : the points that follow the orbit too."""
    plot = shown.picture
    assert isinstance(plot, Plot)
    for view, layer in densities(shown):
        x, y = density_at(shown.columns.get(view.name, {}), t)
        _markers(frame, layer, {"x": x, "y": y}, colour, _OVER)
    layers = {plot.source_of(layer): layer for layer in (*plot.layers, POINT)}
    state = state_at(shown.columns.get("data-orbit", {}), shown.scene.angles, t) if point else {}
    if state:
        for source, (across, up) in plot.followers.items():
            layer = layers[source]
            there = dict(zip(layer.columns, ([state[across]], [state[up]]), strict=True))
            _markers(frame, layer, there, colour, _OVER)


def _line(frame: Frame, layer: Layer[Any], columns: Columns, colour: Colour, order: float) -> None:
    x, y = (columns[name] for name in layer.columns[:2])
    frame.plot(x, y, zorder=order, **_stroke(layer, colour))


def _curves(frame: Frame, layer: Layer[Any], columns: Columns, colour: Colour, order: float) -> None:
    for x, y in zip(columns["xs"], columns["ys"], strict=True):
        frame.plot(x, y, zorder=order, **_stroke(layer, colour))


def _stroke(layer: Layer[Any], colour: Colour) -> dict[str, Any]:
    style = layer.style
    return {"color": colour(style["color"]), "linewidth": 0.8 * _POINTS * style.get("line_width", 1.0),
            "linestyle": _DASHES[style.get("line_dash", "solid")], "alpha": style.get("line_alpha", 1.0)}


def _segments(frame: Frame, layer: Layer[Any], columns: Columns, colour: Colour, order: float) -> None:
    for x0, y0, x1, y1 in zip(*(columns[name] for name in layer.columns), strict=True):
        frame.plot((x0, x1), (y0, y1), zorder=order, **_stroke(layer, colour))


def _areas(frame: Frame, layer: Layer[Any], columns: Columns, colour: Colour, order: float) -> None:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    style = layer.style
    edge = colour(style["line_color"]) if style.get("line_alpha", 1) else "none"
    for xs, ys in zip(columns["xs"], columns["ys"], strict=True):
        path = Path.make_compound_path(
            *(Path(np.column_stack([x, y]), closed=False) for x, y in zip(xs[0], ys[0], strict=True)))
        frame.add_patch(PathPatch(path, facecolor=colour(style["fill_color"]), edgecolor=edge, linewidth=0.6,
                                  zorder=order))


def _markers(frame: Frame, layer: Layer[Any], columns: Columns, colour: Colour, order: float) -> None:
    from matplotlib.markers import MarkerStyle
    from matplotlib.transforms import Affine2D

    style = layer.style
    x, y = (np.asarray(columns[name]) for name in layer.columns[:2])
    face = colour(style.get("fill_color", style.get("color", theme.INK)))
    edge = "none" if style.get("line_alpha") == 0 else colour(style.get("line_color", face))
    look = {"s": (_POINTS * 0.8 * style["size"]) ** 2, "linewidths": 0.8 * _POINTS * style.get("line_width", 1.0),
            "facecolors": "none" if style.get("fill_alpha") == 0 else face, "edgecolors": edge,
            "alpha": style.get("alpha", 1.0), "zorder": order, "rasterized": x.size > _MOST_VECTORS}
    marker = _MARKERS[style.get("marker", "circle")]
    if "angle" not in layer.columns:
        frame.scatter(x, y, marker=marker, **look)
        return
    for at, turned, angle in zip(x, y, columns["angle"], strict=True):
        frame.scatter([at], [turned], marker=MarkerStyle(marker, transform=Affine2D().rotate(angle)), **look)


def _dots(frame: Frame, layer: Layer[Any], columns: Columns, colour: Colour, order: float) -> None:
    style = layer.style
    x, y = (np.asarray(columns[name]) for name in layer.columns[:2])
    frame.scatter(x, y, s=(_POINTS * 0.6 * style["size"]) ** 2, color=colour(style["color"]), alpha=style["alpha"],
                  linewidths=0, zorder=order, rasterized=x.size > _MOST_VECTORS)


def _cells(frame: Frame, layer: Layer[Any], columns: Columns, colour: Colour, order: float) -> None:
    from matplotlib.colors import ListedColormap

    style = layer.style
    scale = ListedColormap([colour(one) for one in style["palette"]] if style["kinds"] else style["palette"])
    for cells, x, y, width, height in zip(*(columns[name] for name in layer.columns), strict=True):
        # Numbers that go round are not to be mixed: −½ and ½ would give 0.
        even = style["smooth"] and not style["cyclic"]
        frame.imshow(np.ma.masked_invalid(cells), extent=(x, x + width, y, y + height), origin="lower", cmap=scale,
                     vmin=style["low"], vmax=style["high"], interpolation="bilinear" if even else "nearest",
                     aspect="auto", zorder=0.5)
    frame.set(xlim=frame.get_xlim(), ylim=frame.get_ylim())


def _texts(frame: Frame, layer: Layer[Any], columns: Columns, colour: Colour, order: float) -> None:
    style = layer.style
    for x, y, text in zip(*(columns[name] for name in layer.columns), strict=True):
        offset = (_POINTS * style.get("x_offset", 0.0), -_POINTS * style.get("y_offset", 0.0))
        frame.annotate(text, (x, y), offset, textcoords="offset points", color=colour(style["text_color"]),
                       ha=style["text_align"], va="center" if style.get("text_baseline") == "middle" else "bottom",
                       zorder=order, annotation_clip=math.isfinite(x))


_GLYPHS: Mapping[str, Callable[[Any, Layer[Any], Columns, Colour, float], None]] = {
    "line": _line, "multi_line": _curves, "multi_polygons": _areas, "scatter": _markers, "dots": _dots,
    "image": _cells, "segment": _segments, "text": _texts}
