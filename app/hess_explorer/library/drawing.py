"""Pictures of the explorer and results of the mechanics by HoloViews: to look at, to combine, to restyle."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from typing import Any

import holoviews as hv
import numpy as np
from holoviews import dim

from hess_explorer.export.shown import Shown
from hess_explorer.export.spheres import draw_sphere
from hess_explorer.views import theme
from hess_explorer.views.layers import Columns, Layer
from hess_explorer.views.plot import Plot
from hess_explorer.views.poisson_sphere import Sphere
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.labelled import Labelled, Labels

__all__ = ["draw", "draw_result"]

_SIDE = 420
"""Pixels of a picture in a notebook."""
_UP = math.pi / 2.0


def draw(shown: Shown) -> Any:
    """A picture as an overlay of its layers, in the page's colours, on the page's axes.

    Raises `InvalidParameter` for pictures that are neither plots nor Poisson spheres.
    """
    if isinstance(shown.picture, Plot):
        return _plot(shown, shown.picture)
    if isinstance(shown.picture, Sphere):
        return _sphere(shown)
    raise InvalidParameter(f"{shown.title} moves, and is drawn on the page only: take its data.")


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


class _Sheet:
    """What `draw_sphere` asks of a frame of Matplotlib, as layers of HoloViews."""

    def __init__(self) -> None:
        self.drawn: list[tuple[float, Any]] = []

    def set(self, **_: Any) -> None:
        """The axes are those of the overlay."""

    def set_axis_off(self) -> None:
        """They are bare."""

    def plot(self, x: Any, y: Any, *, color: str, linestyle: Any = "-", linewidth: float = 1.0, alpha: float = 1.0,
             zorder: float = 2.0) -> None:
        """A line; dashes as Matplotlib writes them."""
        dash = "solid" if linestyle == "-" else " ".join(f"{3 * length}" for length in linestyle[1])
        path = hv.Path([np.column_stack([x, y])], ["x", "y"])
        self.drawn.append((zorder, path.opts(color=color, line_dash=dash, line_width=1.4 * linewidth, alpha=alpha)))

    def text(self, x: float, y: float, said: str, *, color: str, alpha: float = 1.0, **_: Any) -> None:
        """A word about a place."""
        self.drawn.append((3.0, hv.Labels([(x, y, said)], ["x", "y"], "text").opts(
            text_color=color, text_alpha=alpha, text_font_size="12px")))

    def scatter(self, x: Any, y: Any, *, facecolors: str, edgecolors: str, alpha: float, zorder: float,
                **_: Any) -> None:
        """A mark."""
        hollow = facecolors == "none"
        self.drawn.append((zorder, hv.Points((x, y), ["x", "y"]).opts(
            size=8, color=edgecolors, fill_alpha=0.0 if hollow else alpha, line_alpha=alpha)))


def _sphere(shown: Shown) -> Any:
    sheet = _Sheet()
    draw_sphere(sheet, shown, lambda colour: colour)  # type: ignore[arg-type]
    layers = [layer for _, layer in sorted(sheet.drawn, key=lambda one: one[0])]
    return _framed(layers, shown.title, xlim=(-1.25, 1.25), ylim=(-1.25, 1.25), xaxis=None, yaxis=None)


def draw_result(result: Labelled) -> Any:
    """A result of the mechanics: each of its variables over the first dimension, or points of the plane.

    Raises `InvalidParameter` where it has neither.
    """
    known = result.labels()
    return _over_time(known, type(result).__name__)


def _over_time(known: Labels, title: str) -> Any:
    raise NotImplementedError
