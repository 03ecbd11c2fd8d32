"""A picture as a figure for paper, by Matplotlib: the layers and axes of the page, in its colours or black on white."""

from __future__ import annotations

import io
import math
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from hess_explorer.export.shown import Shown
from hess_explorer.export.spheres import draw_sphere
from hess_explorer.views import theme
from hess_explorer.views.layers import Columns, Layer
from hess_explorer.views.plot import Plot
from hess_explorer.views.poisson_sphere import Sphere
from hess_mechanics.errors import InvalidParameter

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Frame
    from matplotlib.figure import Figure

__all__ = ["FORMATS", "as_file", "draw"]

FORMATS = ("png", "svg", "pdf")
_WIDTHS = (20.0, 400.0)
_DOTS_PER_INCH = 300
_MOST_VECTORS = 5000
"""More dots than these are pixels in a vector file, which would else take a viewer seconds."""
_POINTS = 72.0 / 96.0
"""Of type, for a pixel of the page."""
_MARKERS = {"circle": "o", "triangle": "^", "diamond": "D"}
_DASHES: Mapping[str, Any] = {
    "solid": "-", "dashed": (0, (6, 3)), "dotted": (0, (2, 4)), "dotdash": (0, (2, 4, 6, 4))}
_STYLE: Mapping[str, Any] = {
    "font.size": 9.0, "axes.linewidth": 0.6, "svg.fonttype": "none", "pdf.fonttype": 42,
    "svg.hashsalt": "hess-explorer", "mathtext.fontset": "dejavusans"}


def as_file(shown: Shown, kind: str, width: float = 85.0, black: bool = False) -> bytes:
    """A square figure of so many millimetres as PNG (300 dots an inch), SVG or PDF; fonts stay text.

    black : black on white, lines told apart by their dashes, instead of the colours of the page.

    Raises
    ------
    InvalidParameter : no such format or width, or Matplotlib is not installed.
    """
    if kind not in FORMATS:
        raise InvalidParameter(f"{kind!r} is no format of a figure: choose one of {', '.join(FORMATS)}.")
    if not _WIDTHS[0] <= width <= _WIDTHS[1]:
        raise InvalidParameter(f"A figure is {_WIDTHS[0]:g} to {_WIDTHS[1]:g} mm wide, not {width:g}.")
    try:
        import matplotlib as mpl
    except ImportError as error:
        raise InvalidParameter(
            "Figures need Matplotlib: pip install 'hess-explorer[export]'. CSV and JSON need nothing.") from error
    facts = shown.facts
    said = f"{facts['program']}, ?{facts['link']}"
    metadata: dict[str, Any] = {
        "png": {"Title": shown.title, "Description": said, "Comment": shown.caption, "Software": facts["program"]},
        "svg": {"Title": shown.title, "Description": f"{shown.caption} {said}", "Date": None},
        "pdf": {"Title": shown.title, "Subject": said, "Keywords": shown.caption, "CreationDate": None},
    }[kind]
    with mpl.rc_context(dict(_STYLE)):
        figure = draw(shown, width, black)
        out = io.BytesIO()
        figure.savefig(out, format=kind, dpi=_DOTS_PER_INCH, metadata=metadata)
    return out.getvalue()


def draw(shown: Shown, width: float = 85.0, black: bool = False) -> Figure:
    """The figure itself, of so many millimetres."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width / 25.4, width / 25.4), layout="constrained")
    frame = figure.add_subplot()
    colour = _black if black else _as_it_is
    if isinstance(shown.picture, Plot):
        _draw_plot(frame, shown, colour)
    elif isinstance(shown.picture, Sphere):
        draw_sphere(frame, shown, colour)
    else:
        raise InvalidParameter(f"{shown.title} cannot be drawn as a figure yet: take its data as CSV or JSON, or the "
                               "page as PNG (hess-explorer shot).")
    return figure


def _as_it_is(colour: str) -> str:
    return colour


def _black(colour: str) -> str:
    """Areas keep their lightness, everything else is black."""
    return colour if colour in (theme.PAPER, "white") else {
        theme.FORBIDDEN: "#E4E4E4", theme.LOCKED: "#BDBDBD"}.get(colour, "#000000")


def _draw_plot(frame: Frame, shown: Shown, colour: Callable[[str], str]) -> None:
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


def _line(frame: Frame, layer: Layer[Any], columns: Columns, colour: Callable[[str], str], order: float) -> None:
    x, y = (columns[name] for name in layer.columns[:2])
    frame.plot(x, y, zorder=order, **_stroke(layer, colour))


def _curves(frame: Frame, layer: Layer[Any], columns: Columns, colour: Callable[[str], str], order: float) -> None:
    for x, y in zip(columns["xs"], columns["ys"], strict=True):
        frame.plot(x, y, zorder=order, **_stroke(layer, colour))


def _stroke(layer: Layer[Any], colour: Callable[[str], str]) -> dict[str, Any]:
    style = layer.style
    return {"color": colour(style["color"]), "linewidth": 0.8 * _POINTS * style.get("line_width", 1.0),
            "linestyle": _DASHES[style.get("line_dash", "solid")], "alpha": style.get("line_alpha", 1.0)}


def _segments(frame: Frame, layer: Layer[Any], columns: Columns, colour: Callable[[str], str], order: float) -> None:
    for x0, y0, x1, y1 in zip(*(columns[name] for name in layer.columns), strict=True):
        frame.plot((x0, x1), (y0, y1), zorder=order, **_stroke(layer, colour))


def _areas(frame: Frame, layer: Layer[Any], columns: Columns, colour: Callable[[str], str], order: float) -> None:
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    style = layer.style
    edge = colour(style["line_color"]) if style.get("line_alpha", 1) else "none"
    for xs, ys in zip(columns["xs"], columns["ys"], strict=True):
        path = Path.make_compound_path(
            *(Path(np.column_stack([x, y]), closed=False) for x, y in zip(xs[0], ys[0], strict=True)))
        frame.add_patch(PathPatch(path, facecolor=colour(style["fill_color"]), edgecolor=edge, linewidth=0.6,
                                  zorder=order))


def _markers(frame: Frame, layer: Layer[Any], columns: Columns, colour: Callable[[str], str], order: float) -> None:
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


def _dots(frame: Frame, layer: Layer[Any], columns: Columns, colour: Callable[[str], str], order: float) -> None:
    style = layer.style
    x, y = (np.asarray(columns[name]) for name in layer.columns[:2])
    frame.scatter(x, y, s=(_POINTS * 0.6 * style["size"]) ** 2, color=colour(style["color"]), alpha=style["alpha"],
                  linewidths=0, zorder=order, rasterized=x.size > _MOST_VECTORS)


def _cells(frame: Frame, layer: Layer[Any], columns: Columns, colour: Callable[[str], str], order: float) -> None:
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


def _texts(frame: Frame, layer: Layer[Any], columns: Columns, colour: Callable[[str], str], order: float) -> None:
    style = layer.style
    for x, y, text in zip(*(columns[name] for name in layer.columns), strict=True):
        offset = (_POINTS * style.get("x_offset", 0.0), -_POINTS * style.get("y_offset", 0.0))
        frame.annotate(text, (x, y), offset, textcoords="offset points", color=colour(style["text_color"]),
                       ha=style["text_align"], va="center" if style.get("text_baseline") == "middle" else "bottom",
                       zorder=order, annotation_clip=math.isfinite(x))


_GLYPHS: Mapping[str, Callable[[Any, Layer[Any], Columns, Callable[[str], str], float], None]] = {
    "line": _line, "multi_line": _curves, "multi_polygons": _areas, "scatter": _markers, "dots": _dots,
    "image": _cells, "segment": _segments, "text": _texts}
