"""Pictures of the explorer and results of the mechanics by HoloViews: to look at, to combine, to restyle."""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Mapping
from typing import Any

import holoviews as hv
import numpy as np
from holoviews import dim

from hess_explorer.export.figure import as_file
from hess_explorer.export.shown import Shown
from hess_explorer.views import theme
from hess_explorer.views.layers import Columns, Layer
from hess_explorer.views.plot import Plot
from hess_mechanics.numerics.labelled import Labels, Result

__all__ = ["draw", "draw_result"]

_SIDE = 420
"""Pixels of a picture in a notebook."""
_MILLIMETRES = 71.0
"""Two pixels of the image for one of the picture."""


def draw(shown: Shown) -> Any:
    """A picture in the page's colours: a plot as an overlay of its layers; spheres, bodies and clouds as an image.

    Raises `InvalidParameter`: an image needs Matplotlib.
    """
    return _plot(shown, shown.picture) if isinstance(shown.picture, Plot) else _painted(shown)


def _plot(shown: Shown, plot: Plot[Any]) -> Any:
    axes = shown.axes
    assert axes is not None
    names = plot.axes if isinstance(plot.axes, tuple) else plot.axes(shown.state)
    x, y = hv.Dimension("x", label=names[0]), hv.Dimension("y", label=names[1])
    drawn = []
    for layer in plot.layers:
        columns = shown.columns.get(plot.source_of(layer), {})
        if len(columns.get(layer.columns[0], ())):
            drawn.append(_GLYPHS[layer.glyph](layer, columns, [x, y]).relabel(_plain(layer.name)))
    said = shown.columns.get(f"{plot.name}-message", {})
    drawn += [hv.Text(*place) for place in zip(*(said.get(name, ()) for name in ("x", "y", "text")), strict=True)]
    looks: dict[str, Any] = {"xlim": axes.x, "ylim": axes.y, "logx": "x" in plot.log, "logy": "y" in plot.log}
    if plot.ticks is not None:
        looks |= {"xticks": list(plot.ticks), "yticks": list(plot.y_ticks or plot.ticks)}
    return _framed(drawn or [hv.Curve([], x, y)], shown.title, **looks)


def _framed(drawn: list[Any], title: str, **looks: Any) -> Any:
    # Layers are painted in their order, whatever their kind.
    return hv.Overlay(drawn).opts(hv.opts.Overlay(
        frame_width=_SIDE, frame_height=_SIDE, title=title, show_legend=False, fontsize={"labels": 13}, **looks))


def _plain(name: str) -> str:
    return name.replace("-", " ")


Glyph = Callable[[Layer[Any], Columns, list[Any]], Any]


def _stroke(style: Mapping[str, Any]) -> dict[str, Any]:
    return {"color": style["color"], "line_width": style.get("line_width", 1.0),
            "line_dash": style.get("line_dash", "solid"), "alpha": style.get("line_alpha", 1.0)}


def _line(layer: Layer[Any], columns: Columns, dims: list[Any]) -> Any:
    x, y = (np.asarray(columns[name]) for name in layer.columns[:2])
    # A path, not a curve: it goes to and fro, and may leave the frame between.
    return hv.Path([np.column_stack([x, y])], dims).opts(**_stroke(layer.style))


def _curves(layer: Layer[Any], columns: Columns, dims: list[Any]) -> Any:
    parts = [np.column_stack(part) for part in zip(columns["xs"], columns["ys"], strict=True)]
    return hv.Path(parts, dims).opts(**_stroke(layer.style))


def _segments(layer: Layer[Any], columns: Columns, dims: list[Any]) -> Any:
    ends = zip(*(columns[name] for name in layer.columns), strict=True)
    return hv.Path([np.array([[x0, y0], [x1, y1]]) for x0, y0, x1, y1 in ends], dims).opts(**_stroke(layer.style))


def _areas(layer: Layer[Any], columns: Columns, dims: list[Any]) -> Any:
    style = layer.style
    parts = [{dims[0].name: xs[0][0], dims[1].name: ys[0][0],
              "holes": [[np.column_stack(hole) for hole in zip(xs[0][1:], ys[0][1:], strict=True)]]}
             for xs, ys in zip(columns["xs"], columns["ys"], strict=True)]
    return hv.Polygons(parts, dims).opts(color=style["fill_color"], line_color=style.get("line_color", theme.INK),
                                         line_alpha=style.get("line_alpha", 1.0))


def _markers(layer: Layer[Any], columns: Columns, dims: list[Any]) -> Any:
    style = layer.style
    x, y = (np.asarray(columns[name], float) for name in layer.columns[:2])
    face = style.get("fill_color", style.get("color", theme.INK))
    look = {"color": face, "size": style["size"], "marker": style.get("marker", "circle"),
            "line_color": style.get("line_color", face), "line_width": style.get("line_width", 1.0),
            "fill_alpha": style.get("fill_alpha", 1.0), "line_alpha": style.get("line_alpha", 1.0),
            "alpha": style.get("alpha", 1.0)}
    if look["alpha"] == 1.0:
        del look["alpha"]
    if "angle" not in layer.columns:
        return hv.Points((x, y), dims).opts(**look)
    return hv.Points((x, y, np.asarray(columns["angle"], float)), dims, "angle").opts(
        **look, angle=dim("angle") * (180.0 / math.pi))


def _dots(layer: Layer[Any], columns: Columns, dims: list[Any]) -> Any:
    style = layer.style
    x, y = (np.asarray(columns[name], float) for name in layer.columns[:2])
    return hv.Points((x, y), dims).opts(color=style["color"], size=0.6 * style["size"], alpha=style["alpha"])


def _cells(layer: Layer[Any], columns: Columns, dims: list[Any]) -> Any:
    style = layer.style
    images = [hv.Image(cells[::-1], bounds=(x, y, x + width, y + height), kdims=dims, vdims="value")
              for cells, x, y, width, height in zip(*(columns[name] for name in layer.columns), strict=True)]
    return hv.Overlay(images).opts(hv.opts.Image(
        cmap=list(style["palette"]), clim=(style["low"], style["high"]), clipping_colors={"NaN": "#00000000"}))


def _texts(layer: Layer[Any], columns: Columns, dims: list[Any]) -> Any:
    style = layer.style
    x, y, text = (columns[name] for name in layer.columns)
    return hv.Labels((np.asarray(x, float), np.asarray(y, float), list(text)), dims, "text").opts(
        text_color=style["text_color"], text_align=style["text_align"], text_font_size="11px",
        text_baseline=style.get("text_baseline", "bottom"))


_GLYPHS: Mapping[str, Glyph] = {
    "line": _line, "multi_line": _curves, "multi_polygons": _areas, "scatter": _markers, "dots": _dots,
    "image": _cells, "segment": _segments, "text": _texts}


def _painted(shown: Shown) -> Any:
    """What is solid or seen from somewhere, as the figure for paper has it, in pixels."""
    # Matplotlib is an extra: `as_file` says so where it is missing.
    file = as_file(shown, "png", _MILLIMETRES)
    from matplotlib.image import imread

    pixels = imread(io.BytesIO(file))
    return hv.RGB(pixels, bounds=(-1.0, -1.0, 1.0, 1.0)).opts(hv.opts.RGB(
        frame_width=_SIDE, frame_height=_SIDE, title=shown.title, xaxis=None, yaxis=None))


def draw_result(result: Result) -> Any:
    """A result of the mechanics, a panel for each variable: over its coordinate, or a map over two of them.

    What has no coordinate are points of a plane, whose first two variables are the axes.
    """
    known = result.labels()
    axes = [dims[0] for name, (dims, _) in known.coords.items() if dims == (name,)]
    if not axes:
        (x, (_, across)), (y, (_, up)), *_ = known.variables.items()
        return hv.Points((across, up), [_axis(known, x), _axis(known, y)]).opts(
            hv.opts.Points(size=1.5, frame_width=_SIDE, frame_height=_SIDE, title=type(result).__name__))
    panels = [_panel(known, name, axes) for name, (dims, values) in known.variables.items()
              if dims[-1] in axes and values.dtype.kind == "f"]
    return hv.Layout(panels).cols(2) if len(panels) > 1 else panels[0]


def _axis(known: Labels, name: str) -> Any:
    return hv.Dimension(name, unit=known.units.get(name) or None)


def _panel(known: Labels, name: str, axes: list[str]) -> Any:
    """One variable over its last dimension; over its last two where both have coordinates."""
    dims, values = known.variables[name]
    x = known.coords[dims[-1]][1]
    if len(dims) > 1 and dims[-2] in axes:
        return hv.Image((x, known.coords[dims[-2]][1], values), [_axis(known, dims[-1]), _axis(known, dims[-2])],
                        _axis(known, name)).opts(hv.opts.Image(colorbar=True, title=name, frame_width=_SIDE // 2))
    curves = [np.column_stack([x, one]) for one in values.reshape(-1, x.size)]
    return hv.Path(curves, [_axis(known, dims[-1]), _axis(known, name)]).opts(
        hv.opts.Path(frame_width=_SIDE, frame_height=_SIDE // 3, color=theme.ORBIT))
