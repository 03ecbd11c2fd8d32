"""Planar pictures: axes and background by HoloViews, what changes as Bokeh glyphs whose data are assigned.

A picture is built once in a process, empty; the browser gets it as JSON and fills it with what goes by the wire.
"""

from __future__ import annotations

import math
import textwrap
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import holoviews as hv
import numpy as np
from bokeh import palettes
from bokeh.embed import json_item
from bokeh.models import ColumnDataSource
from bokeh.plotting import figure

from hess_explorer.protocol.wire import Wire
from hess_explorer.views import theme

__all__ = ["Figure", "columns_of"]

hv.extension("bokeh", logo=False)
_renderer = hv.renderer("bokeh")
_renderer.webgl = False  # costs several times the canvas at these sizes

_LETTERS = 26
"""As many stand side by side under the smallest picture; beside it there is room for any number."""

_POSITIONS = {
    "quad": ("left", "right", "top", "bottom"),
    "multi_line": ("xs", "ys"), "multi_polygons": ("xs", "ys"), "text": ("x", "y", "text"),
    "image": ("image", "x", "y", "dw", "dh"), "segment": ("x0", "y0", "x1", "y1"),
}
"""Those of a glyph's properties that are columns; (x, y) for all others."""

_ON_CANVAS = ("image", "dots")
"""Glyphs that are none of Bokeh's: cells and dots by the thousand, which the page draws itself."""

Range = tuple[float, float]


@dataclass(frozen=True)
class _Layer:
    source: str
    glyph: str
    columns: tuple[str, ...]
    level: str
    style: Mapping[str, Any]


class Figure:
    """A square picture.

    Every layer has a source of its own, named "<picture>-<layer>".  Layers are drawn in the order
    in which they are added; those that change with every state lie on a canvas of their own
    (`moving`), so that a new state does not paint axes and background again.

    Parameters
    ----------
    wire : what new data and axes go by.
    name : identifier.
    labels, x_range, y_range : the axes, which stay until `set_ranges`.
    picks : Bokeh events ("tap", "pan") that choose a point; the browser sends it with the state.  "box": a drag
        draws a box, whose corners it sends.  "hover": it sends where the mouse is.
    ticks : positions and labels on both axes, where the usual ones would not do; y_ticks : others on the vertical one.
    log : the axes that are logarithmic, "x", "y" or "xy".
    x_ticks : positions on the horizontal axis; y_tick_count : how many labels the vertical one wants.
    """

    kind = "plot"

    def __init__(self, wire: Wire, name: str, labels: tuple[str, str], x_range: Range, y_range: Range,
                 picks: Sequence[str] = (), ticks: Sequence[tuple[float, str]] | None = None, log: str = "",
                 y_ticks: Sequence[tuple[float, str]] | None = None,
                 x_ticks: Sequence[float] | None = None, y_tick_count: int | None = None) -> None:
        self.wire = wire
        self.name = name
        self.x_range, self.y_range = x_range, y_range
        self._labels, self._picks, self._log = labels, picks, log
        self._ticks, self._y_ticks = ticks, y_ticks or ticks
        self._x_ticks, self._y_tick_count = x_ticks, y_tick_count
        self._first_ranges = (x_range, y_range)
        self._layers: dict[str, _Layer] = {}
        self._columns: dict[str, tuple[str, ...]] = {}
        self._sentence = ""

    def add(self, layer: str, glyph: str, columns: Sequence[str], moving: bool = True, source: str | None = None,
            **style: Any) -> None:
        """A layer of Bokeh glyphs ("line", "multi_line", "multi_polygons", "scatter", "text"), empty at first.

        `columns` are those of its positions; further columns may be assigned with them.  `source`: another name
        for its data than "<picture>-<layer>".
        """
        self._layers[layer] = _Layer(source or f"{self.name}-{layer}", glyph, tuple(columns),
                                     "overlay" if moving else "glyph", style)
        self._columns[layer] = tuple(columns)

    def add_image(self, layer: str, palette: str | tuple[str, ...], low: float, high: float) -> None:
        """A layer of numbers on a grid, under all others (not HoloViews', which would import pandas)."""
        columns = _POSITIONS["image"]
        colors = getattr(palettes, palette) if isinstance(palette, str) else palette
        style = {"palette": list(colors), "low": low, "high": high}
        self._layers[layer] = _Layer(f"{self.name}-{layer}", "image", columns, "image", style)
        self._columns[layer] = columns

    def add_point_and_message(self) -> None:
        """The last layers of every picture: the moving point, and a sentence where there is nothing to see."""
        self.add("point", "scatter", ("x", "y"), color=theme.POINT, line_color="black", line_width=1.5, size=13)
        self.add("message", "text", ("x", "y", "text"), text_color=theme.MUTED, text_font_style="bold",
                 text_font_size="15px", text_align="center", text_baseline="middle")

    def build(self) -> figure:
        """The picture as a Bokeh model, with empty sources."""
        (x, y), labels = self._first_ranges, self._labels
        # Plain arrays: any other form of data makes HoloViews import pandas (0.25 s).
        point = {"x": np.array([x[0]]), "y": np.array([y[0]])}
        background = hv.Curve(point, "x", "y", datatype=["dictionary"])
        plot = _renderer.get_plot(background.opts(
            xlabel=labels[0], ylabel=labels[1], xlim=x, ylim=y, toolbar=None, default_tools=[],
            logx="x" in self._log, logy="y" in self._log,
            responsive=True, min_height=200, min_width=200, title="",
            fontsize={"labels": theme.FONT_SIZE, "ticks": "12px"},
            **({} if self._ticks is None else {"xticks": list(self._ticks), "yticks": list(self._y_ticks or ())}),
        ))
        root: figure = plot.state
        # The page shines through, whatever its theme.  An invisible background that is painted all the same makes Bokeh
        # begin a new path for the outline; without one it strokes the ticks of the last painting once more.
        root.update(name=self.name, min_border=4, sizing_mode="stretch_width", aspect_ratio=1,
                    background_fill_color="#00000000", background_fill_alpha=1, border_fill_alpha=0)
        if self._x_ticks is not None:
            root.xaxis.ticker = list(self._x_ticks)
        if self._y_tick_count is not None:
            root.yaxis.ticker.desired_num_ticks = self._y_tick_count
        for layer in self._layers.values():
            if layer.glyph not in _ON_CANVAS:
                source = ColumnDataSource({column: [] for column in layer.columns}, name=layer.source)
                positions = dict(zip(_POSITIONS.get(layer.glyph, ("x", "y")), layer.columns, strict=False))
                getattr(root, layer.glyph)(source=source, level=layer.level, **positions, **layer.style)
        if "box" in self._picks:
            source = ColumnDataSource({column: [] for column in _POSITIONS["quad"]}, name=f"{self.name}-box")
            root.quad(source=source, level="overlay", fill_alpha=0.1, color=theme.UNSTABLE)
        return root

    def describe(self) -> dict[str, Any]:
        """What the browser needs to know: see "plot.js"."""
        drawn = self._layers.values()
        return {
            "name": self.name, "kind": self.kind, "item": json_item(self.build()), "picks": list(self._picks),
            "letters": [None if self._ticks is not None or side in self._log else letters
                        for side, letters in (("x", _LETTERS), ("y", 1000))],
            "cells": [{"source": layer.source, **layer.style} for layer in drawn if layer.glyph == "image"],
            "dots": [{"source": layer.source, "x": layer.columns[0], "y": layer.columns[1], "alpha": 1.0, **layer.style}
                     for layer in drawn if layer.glyph == "dots"],
        }

    def assign(self, layer: str, **columns: Any) -> None:
        """New data for one layer."""
        self._columns[layer] = tuple(columns)
        self.wire.put(self._layers[layer].source, columns)

    def clear(self, *layers: str) -> None:
        """No data for these layers: nothing stale stays beside new parameters."""
        for layer in layers:
            self.assign(layer, **{column: [] for column in self._columns[layer]})

    def clear_all(self) -> None:
        """No data at all."""
        self._sentence = ""
        self.clear(*self._layers)

    def say(self, sentence: str) -> None:
        """A sentence in the middle of the picture; empty for none."""
        if sentence != self._sentence:
            self._sentence = sentence
            self.clear("message")
            if sentence:
                self.assign("message", x=[_middle(self.x_range, "x" in self._log)],
                            y=[_middle(self.y_range, "y" in self._log)], text=[textwrap.fill(sentence, 24)])

    def show_nothing(self, sentence: str) -> None:
        """Nothing but the reason."""
        self.clear_all()
        self.say(sentence)

    def set_ranges(self, x: Range, y: Range) -> None:
        """Other axes; the same ones do nothing."""
        if (x, y) != (self.x_range, self.y_range):
            self.x_range, self.y_range = x, y
            self.wire.put_ranges(self.name, x, y)


def _middle(axis: Range, log: bool) -> float:
    return math.sqrt(axis[0] * axis[1]) if log else (axis[0] + axis[1]) / 2


def columns_of(array: np.ndarray, names: Sequence[str]) -> Mapping[str, np.ndarray]:
    """Columns of a 2-D array under these names, in the single precision that a screen needs."""
    return {name: np.ascontiguousarray(array[:, i], dtype=np.float32) for i, name in enumerate(names)}
