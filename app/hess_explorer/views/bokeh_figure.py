"""A plot as a Bokeh figure: axes, lines and markers, with empty sources.

The browser receives it as JSON and fills its sources with data.  Cells, large numbers of dots and moving points are not
Bokeh glyphs; the page draws them itself.
"""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from bokeh import __version__
from bokeh.core.serialization import Serializer
from bokeh.document import Document
from bokeh.models import ColumnDataSource, ContinuousTicker, FixedTicker, NoOverlap, Range1d, glyphs
from bokeh.models.glyph import Glyph
from bokeh.plotting import figure

from hess_explorer.views import theme
from hess_explorer.views.layers import Layer

if TYPE_CHECKING:
    from hess_explorer.views.plot import Plot

_LETTERS = 26
"""Number of letters that fit side by side under the smallest picture; beside it any number fits."""

_GLYPHS: Mapping[str, tuple[type[Glyph], tuple[str, ...]]] = {
    "line": (glyphs.Line, ("x", "y")),
    "scatter": (glyphs.Scatter, ("x", "y")),
    "multi_line": (glyphs.MultiLine, ("xs", "ys")),
    "multi_polygons": (glyphs.MultiPolygons, ("xs", "ys")),
    "text": (glyphs.Text, ("x", "y", "text")),
    "quad": (glyphs.Quad, ("left", "right", "top", "bottom")),
}
"""Bokeh glyphs by name, with those properties that are columns."""
_BOX: Layer[Any] = Layer(
    "box",
    "quad",
    ("left", "right", "top", "bottom"),
    {"fill_alpha": 0.1, "fill_color": theme.UNSTABLE, "line_color": theme.UNSTABLE},
)
"""The selection box of the mouse."""


def build(plot: Plot[Any]) -> figure:
    """Return the plot as a Bokeh model, with empty sources."""
    axes, names = plot.first_axes, plot.axes if isinstance(plot.axes, tuple) else (" ", " ")
    # A transparent background shows the theme of the page.  It must still be painted: otherwise Bokeh begins no new
    # path for the outline, and strokes the ticks of the previous painting again.
    root = figure(
        name=plot.name,
        x_range=Range1d(start=axes.x[0], end=axes.x[1]),
        y_range=Range1d(start=axes.y[0], end=axes.y[1]),
        x_axis_type="log" if "x" in plot.log else "linear",
        y_axis_type="log" if "y" in plot.log else "linear",
        x_axis_label=names[0],
        y_axis_label=names[1],
        tools="",
        toolbar_location=None,
        min_border=10,
        sizing_mode="stretch_both",
        background_fill_color="#00000000",
        background_fill_alpha=1,
        border_fill_alpha=0,
    )
    root.grid.grid_line_color = None
    for axis, ticks in zip(root.axis, plot.axis_ticks, strict=True):
        axis.update(
            axis_label_text_font_size=theme.FONT_SIZE,
            major_label_text_font_size="12px",
            major_label_policy=NoOverlap(min_distance=4),
        )
        if ticks is not None:
            labels: dict[float, str] = dict(one for one in ticks if isinstance(one, tuple))
            axis.update(ticker=FixedTicker(ticks=[*labels] or [*ticks]), major_label_overrides=labels)
    if plot.y_tick_count is not None:
        ticker = root.yaxis[0].ticker
        assert isinstance(ticker, ContinuousTicker)
        ticker.desired_num_ticks = plot.y_tick_count
    sources: dict[str, ColumnDataSource] = {}
    for layer in (*plot.all_layers, *([_BOX] if plot.on_box is not None else [])):
        name = plot.source_of(layer)
        if layer.glyph in _GLYPHS and name not in plot.followers:
            glyph, positions = _GLYPHS[layer.glyph]
            source = sources.setdefault(name, ColumnDataSource(name=name))
            for column in layer.columns:
                source.data.setdefault(column, [])
            look = {**dict(zip(positions, layer.columns, strict=False)), **layer.style}
            root.add_glyph(source, glyph(**look), name=layer.name, level="overlay" if layer.is_overlay else "glyph")
    return root


def _item(root: figure) -> dict[str, Any]:
    """Return `bokeh.embed.json_item` of a figure without the definitions of Panel's models.

    The page already has these 150 kB, and writing them is slow.
    """
    # Keep a reference to this document, because the serializer identifies objects by their address.
    serializer, empty = Serializer(deferred=False), Document()
    config = serializer.encode(empty.config)
    document = {"version": __version__, "title": "", "config": config, "roots": serializer.encode([root])}
    return {"doc": document, "root_id": root.id, "target_id": None, "version": __version__}


def describe(plot: Plot[Any]) -> dict[str, Any]:
    """Return the description of a plot for the browser, see "plot.js"."""
    return {
        "item": _item(build(plot)),
        "renamed": not isinstance(plot.axes, tuple),
        "picks": list(plot.events),
        "handle": None if plot.handle is None else [plot.source_of(plot.handle), *plot.handle.columns],
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
        "points": [
            {"source": source, "columns": list(plot.followers[source]), **layer.style}
            for layer in plot.all_layers
            if (source := plot.source_of(layer)) in plot.followers
        ],
    }
