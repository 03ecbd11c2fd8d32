"""Planar pictures: axes and background by HoloViews, what changes as Bokeh glyphs whose data are assigned."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from typing import Any

import holoviews as hv
import numpy as np
from bokeh.models import ColumnDataSource, CustomJS
from bokeh.plotting import figure

from app import theme
from app.wire import Wire

__all__ = ["Figure", "columns_of", "curve"]

hv.extension("bokeh", logo=False)
_renderer = hv.renderer("bokeh")
_renderer.webgl = False  # costs several times the canvas at these sizes

_PICK = """
    const detail = { pick: [name, cb_obj.x, cb_obj.y], drag: cb_obj.event_name === "pan" }
    document.dispatchEvent(new CustomEvent("hess:pick", { detail }))
"""


def curve(x: Sequence[float], y: Sequence[float], names: tuple[str, str]) -> hv.Curve:
    """A HoloViews curve on plain arrays (any other form of data makes HoloViews import pandas: 0.25 s)."""
    return hv.Curve(dict(zip(names, map(np.asarray, (x, y)), strict=True)), *names, datatype=["dictionary"])


class Figure:
    """A square picture.

    Every layer has a source of its own, named "<picture>-<layer>".  Layers are drawn in the order
    in which they are added; those that change with every state lie on a canvas of their own
    (`moving`), so that a new state does not paint axes and background again.

    Parameters
    ----------
    name : identifier, also of the picture's root model.
    background : the HoloViews element that is drawn once, under everything.
    labels, x_range, y_range : the axes, which stay until `set_ranges`.
    picks : Bokeh events ("tap", "pan") that choose a point; the browser sends it with the state.
    ticks : positions and labels on both axes, where the usual ones would not do.
    log : the axes that are logarithmic, "x", "y" or "xy".
    """

    def __init__(self, name: str, background: hv.Element, labels: tuple[str, str],
                 x_range: tuple[float, float], y_range: tuple[float, float], picks: Sequence[str] = (),
                 ticks: Sequence[tuple[float, str]] | None = None, log: str = "") -> None:
        self.name = name
        self._log = log
        self.wire: Wire | None = None
        self._sentence = ""
        plot = _renderer.get_plot(background.opts(
            xlabel=labels[0], ylabel=labels[1], xlim=x_range, ylim=y_range, toolbar=None, default_tools=[],
            logx="x" in log, logy="y" in log,
            responsive=True, min_height=200, min_width=200, title="",
            fontsize={"labels": theme.FONT_SIZE, "ticks": "12px"},
            **({} if ticks is None else {"xticks": list(ticks), "yticks": list(ticks)}),
        ))
        self.root: figure = plot.state
        self.root.update(name=name, min_border=4, sizing_mode="stretch_width", aspect_ratio=1)
        self.sources: dict[str, ColumnDataSource] = {}
        for event in picks:
            self.root.js_on_event(event, CustomJS(args={"name": name}, code=_PICK))

    def add(self, layer: str, glyph: str, columns: Sequence[str], moving: bool = True, **style: Any) -> None:
        """A layer of Bokeh glyphs ("line", "multi_line", "multi_polygons", "scatter", "text"), empty at first.

        `columns` are those of its positions; further columns may be assigned with them.
        """
        source = ColumnDataSource({column: [] for column in columns}, name=f"{self.name}-{layer}")
        names = ("xs", "ys") if glyph.startswith("multi") else ("x", "y")
        positions = dict(zip(names, columns, strict=False))
        level = "overlay" if moving else "glyph"
        getattr(self.root, glyph)(source=source, level=level, **positions, **style)
        self.sources[layer] = source

    def add_point_and_message(self) -> None:
        """The last layers of every picture: the moving point, and a sentence where there is nothing to see."""
        self.add("point", "scatter", ("x", "y"), color=theme.POINT, line_color="black", line_width=1.5, size=13)
        self.add("message", "text", ("x", "y", "text"), text_color=theme.MUTED, text_font_style="bold",
                 text_font_size="15px", text_align="center", text_baseline="middle")

    def assign(self, layer: str, **columns: Any) -> None:
        """New data for one layer: at once before the page exists, afterwards by the wire."""
        source = self.sources[layer]
        if self.wire is None:
            source.data = columns
        else:
            self.wire.put(source.name, columns)

    def clear(self, *layers: str) -> None:
        """No data for these layers: nothing stale stays beside new parameters."""
        for layer in layers:
            self.assign(layer, **{column: [] for column in self.sources[layer].data})

    def say(self, sentence: str) -> None:
        """A sentence in the middle of the picture; empty for none."""
        x, y = self.root.x_range, self.root.y_range
        if sentence != self._sentence:
            self._sentence = sentence
            self.clear("message")
            if sentence:
                self.assign("message", x=[_middle(x, "x" in self._log)], y=[_middle(y, "y" in self._log)],
                            text=[sentence])

    def set_ranges(self, x: tuple[float, float], y: tuple[float, float]) -> None:
        """Other axes; assigning the same ones does nothing."""
        for axis, (start, end) in ((self.root.x_range, x), (self.root.y_range, y)):
            if (axis.start, axis.end) != (start, end):
                axis.update(start=start, end=end)


def _middle(axis: Any, log: bool) -> float:
    return math.sqrt(axis.start * axis.end) if log else (axis.start + axis.end) / 2


def columns_of(array: np.ndarray, names: Sequence[str]) -> Mapping[str, np.ndarray]:
    """Columns of a 2-D array under these names, in the single precision that a screen needs."""
    return {name: np.ascontiguousarray(array[:, i], dtype=np.float32) for i, name in enumerate(names)}
