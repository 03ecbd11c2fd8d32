"""A plot as a Bokeh figure: axes by HoloViews, lines and markers as Bokeh's glyphs with empty sources.

It is built once in a process; the browser gets it as JSON and fills it with what goes by the wire.  Cells and dots by
the thousand are none of Bokeh's glyphs: the page draws them itself.  HoloViews makes the axes alone: it takes four
times as long to make the glyphs, too, and has as many glyphs again for selections that are never made.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import holoviews as hv
import numpy as np
from bokeh import __version__
from bokeh.core.serialization import Serializer
from bokeh.document import Document
from bokeh.models import ColumnDataSource, ContinuousTicker, NoOverlap, glyphs
from bokeh.models.glyph import Glyph
from bokeh.plotting import figure

from hess_explorer.views import elements, theme
from hess_explorer.views.layers import MESSAGE, POINT, Layer

if TYPE_CHECKING:
    from hess_explorer.views.plot import Plot

__all__ = ["build", "describe"]

_renderer = hv.renderer("bokeh")
_renderer.webgl = False  # costs several times the canvas at these sizes

_LETTERS = 26
"""As many stand side by side under the smallest picture; beside it there is room for any number."""

_GLYPHS: Mapping[str, tuple[type[Glyph], tuple[str, ...]]] = {
    "line": (glyphs.Line, ("x", "y")),
    "scatter": (glyphs.Scatter, ("x", "y")),
    "multi_line": (glyphs.MultiLine, ("xs", "ys")),
    "multi_polygons": (glyphs.MultiPolygons, ("xs", "ys")),
    "segment": (glyphs.Segment, ("x0", "y0", "x1", "y1")),
    "text": (glyphs.Text, ("x", "y", "text")),
    "quad": (glyphs.Quad, ("left", "right", "top", "bottom")),
}
"""Those that Bokeh draws, and which of their properties are columns, by the glyph of a layer."""
_BOX: Layer[Any] = Layer(
    "box",
    "quad",
    ("left", "right", "top", "bottom"),
    {"fill_alpha": 0.1, "fill_color": theme.UNSTABLE, "line_color": theme.UNSTABLE},
)
"""The box that the mouse draws."""


def build(plot: Plot[Any]) -> figure:
    """Return the plot as a Bokeh model, with empty sources."""
    axes, names = plot.first_axes, plot.axes if isinstance(plot.axes, tuple) else (" ", " ")
    # Plain arrays: any other form of data makes HoloViews import pandas (0.25 s).
    point = {"x": np.array([axes.x[0]]), "y": np.array([axes.y[0]])}
    background = hv.Curve(point, "x", "y", datatype=["dictionary"]).opts(
        hv.opts.Curve(
            **elements.frame(plot, axes, names),
            backend="bokeh",
            toolbar=None,
            default_tools=[],
            responsive=True,
            title="",
            fontsize={"labels": theme.FONT_SIZE, "ticks": "12px"},
        )
    )
    root: figure = _renderer.get_plot(background).state
    # The page shines through, whatever its theme.  An invisible background that is painted all the same makes Bokeh
    # begin a new path for the outline; without one it strokes the ticks of the last painting once more.
    root.update(
        name=plot.name,
        min_border=4,
        sizing_mode="stretch_both",
        aspect_ratio=None,
        background_fill_color="#00000000",
        background_fill_alpha=1,
        border_fill_alpha=0,
    )
    for axis in root.axis:
        axis.major_label_policy = NoOverlap(min_distance=4)
    if plot.y_tick_count is not None:
        ticker = root.yaxis[0].ticker
        assert isinstance(ticker, ContinuousTicker)
        ticker.desired_num_ticks = plot.y_tick_count
    sources: dict[str, ColumnDataSource] = {}
    for layer in (*plot.layers, POINT, MESSAGE, *([_BOX] if plot.on_box is not None else [])):
        if layer.glyph in _GLYPHS:
            name, (glyph, positions) = plot.source_of(layer), _GLYPHS[layer.glyph]
            source = sources.setdefault(name, ColumnDataSource(name=name))
            for column in layer.columns:
                source.data.setdefault(column, [])
            look = {**dict(zip(positions, layer.columns, strict=False)), **layer.style}
            root.add_glyph(source, glyph(**look), level="overlay" if layer.moving else "glyph")
    return root


def _item(root: figure) -> dict[str, Any]:
    """What `bokeh.embed.json_item` says of a figure, but for the definitions of all models of Panel that it adds: the
    page has them already (150 kB), and to write them takes longer than all the rest."""
    # The serializer knows what it has met by its place in memory: that lives on.
    serializer, empty = Serializer(deferred=False), Document()
    config = serializer.encode(empty.config)
    document = {"version": __version__, "title": "", "config": config, "roots": serializer.encode([root])}
    return {"doc": document, "root_id": root.id, "target_id": None, "version": __version__}


def describe(plot: Plot[Any]) -> dict[str, Any]:
    """What the browser needs to know of a plot, see "plot.js"."""
    return {
        "item": _item(build(plot)),
        "renamed": not isinstance(plot.axes, tuple),
        "picks": list(plot.events),
        "letters": [
            None if plot.ticks is not None or side in plot.log else letters
            for side, letters in (("x", _LETTERS), ("y", 1000))
        ],
        "cells": [{"source": plot.source_of(layer), **layer.style} for layer in plot.layers if layer.glyph == "image"],
        "dots": [
            {"source": plot.source_of(layer), "x": layer.columns[0], "y": layer.columns[1], **layer.style}
            for layer in plot.layers
            if layer.glyph == "dots"
        ],
    }
