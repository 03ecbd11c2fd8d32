"""A plot as a Bokeh figure: axes and background by HoloViews, layers as Bokeh's glyphs with empty sources.

It is built once in a process; the browser gets it as JSON and fills it with what goes by the wire.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any

import holoviews as hv
import numpy as np
from bokeh.models import ColumnDataSource, CustomJS, CustomJSTickFormatter, LinearColorMapper
from bokeh.plotting import figure

from hess_explorer.assets import STATIC
from hess_explorer.views import theme
from hess_explorer.views.plot import MESSAGE, POINT, Plot

__all__ = ["build"]

hv.extension("bokeh", logo=False)
_renderer = hv.renderer("bokeh")
_renderer.webgl = False  # costs several times the canvas at these sizes

_PICK = """
    const detail = { pick: [name, cb_obj.x, cb_obj.y], drag: cb_obj.event_name === "pan" }
    document.dispatchEvent(new CustomEvent("hess:pick", { detail }))
"""

_HOVER = """
    document.dispatchEvent(new CustomEvent("hess:hover", { detail: [name, cb_obj.x, cb_obj.y] }))
"""

_BOX = """
    const here = [cb_obj.x, cb_obj.y]
    if (cb_obj.event_name === "panstart") source.tags = here
    const [x, y] = source.tags
    const ended = cb_obj.event_name === "panend"
    source.data = ended ? { left: [], right: [], top: [], bottom: [] }
      : { left: [x], right: [here[0]], top: [y], bottom: [here[1]] }
    if (!ended) return
    const detail = { pick: [name, x, y, ...here], drag: true }
    document.dispatchEvent(new CustomEvent("hess:pick", { detail }))
"""

_TICKS = (STATIC / "ticks.js").read_text(encoding="utf-8")
_LETTERS = 26
"""As many stand side by side under the smallest picture; beside it there is room for any number."""

_POSITIONS = {
    "quad": ("left", "right", "top", "bottom"),
    "multi_line": ("xs", "ys"), "multi_polygons": ("xs", "ys"), "text": ("x", "y", "text"),
    "image": ("image", "x", "y", "dw", "dh"), "segment": ("x0", "y0", "x1", "y1"),
}
"""Those of a glyph's properties that are columns; (x, y) for all others."""


def build(plot: Plot[Any], sources: dict[str, ColumnDataSource]) -> figure:
    """The picture as a Bokeh model; `sources`: by name, those of the scene, to which its own are added, empty."""
    (x, y), labels = (plot.first_axes.x, plot.first_axes.y), plot.axes
    # Plain arrays: any other form of data makes HoloViews import pandas (0.25 s).
    point = {"x": np.array([x[0]]), "y": np.array([y[0]])}
    background = hv.Curve(point, "x", "y", datatype=["dictionary"])
    drawn = _renderer.get_plot(background.opts(
        xlabel=labels[0], ylabel=labels[1], xlim=x, ylim=y, toolbar=None, default_tools=[],
        logx="x" in plot.log, logy="y" in plot.log,
        responsive=True, min_height=200, min_width=200, title="",
        fontsize={"labels": theme.FONT_SIZE, "ticks": "12px"},
        **({} if plot.ticks is None else {"xticks": list(plot.ticks), "yticks": list(plot.y_ticks or plot.ticks)}),
    ))
    root: figure = drawn.state
    # The page shines through, whatever its theme.
    root.update(name=plot.name, min_border=4, sizing_mode="stretch_width", aspect_ratio=1,
                background_fill_alpha=0, border_fill_alpha=0)
    for axis, side, letters in ((root.xaxis, "x", _LETTERS), (root.yaxis, "y", 1000)):
        if plot.ticks is None and side not in plot.log:
            axis.formatter = CustomJSTickFormatter(args={"letters": letters}, code=_TICKS)
    if plot.x_ticks is not None:
        root.xaxis.ticker = list(plot.x_ticks)
    if plot.y_tick_count is not None:
        root.yaxis.ticker.desired_num_ticks = plot.y_tick_count
    for layer in (*plot.layers, POINT, MESSAGE):
        source = _source(sources, plot.source_of(layer), layer.columns)
        positions = dict(zip(_POSITIONS.get(layer.glyph, ("x", "y")), layer.columns, strict=False))
        style = dict(layer.style)
        if layer.glyph == "image":
            style = {"color_mapper": LinearColorMapper(**style)}
        level = "image" if layer.glyph == "image" else "overlay" if layer.moving else "glyph"
        getattr(root, layer.glyph)(source=source, level=level, **positions, **style)
    for event in plot.events:
        if event == "box":
            source = ColumnDataSource({column: [] for column in _POSITIONS["quad"]})
            root.quad(source=source, level="overlay", fill_alpha=0.1, color=theme.UNSTABLE)
            for stage in ("panstart", "pan", "panend"):
                root.js_on_event(stage, CustomJS(args={"name": plot.name, "source": source}, code=_BOX))
        elif event == "hover":
            root.js_on_event("mousemove", CustomJS(args={"name": plot.name}, code=_HOVER))
        else:
            root.js_on_event(event, CustomJS(args={"name": plot.name}, code=_PICK))
    return root


def _source(sources: dict[str, ColumnDataSource], name: str, columns: Sequence[str]) -> ColumnDataSource:
    """The source of that name, which several plots may draw, with these columns at least."""
    source = sources.setdefault(name, ColumnDataSource(name=name))
    for column in columns:
        source.data.setdefault(column, [])
    return source
