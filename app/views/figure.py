"""Planar pictures: declared once with HoloViews, drawn by Bokeh, afterwards only their data change."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import holoviews as hv
import numpy as np
from bokeh.models import ColumnDataSource, CustomJS
from bokeh.plotting import figure

from app import theme
from app.wire import Wire

__all__ = ["Figure", "moving_point"]

hv.extension("bokeh", logo=False)
renderer = hv.renderer("bokeh")
renderer.webgl = False  # costs several times the canvas at these sizes


_PICK = """
    const detail = [name, cb_obj.x, cb_obj.y]
    document.dispatchEvent(new CustomEvent("hess:pick", { detail }))
"""


def moving_point(name: str) -> hv.Points:
    """An empty one-point element; the player moves it."""
    return hv.Points([], ["x", "y"], label=name).opts(
        color=theme.POINT, line_color="black", line_width=1.5, size=13
    )


class Figure:
    """A square picture made of one HoloViews overlay, whose sources are then assigned to.

    Parameters
    ----------
    name : identifier, also of the picture's root model.
    overlay : labelled elements; their labels name the sources.
    x_range, y_range : the axes, which stay until `set_ranges`.
    picks : Bokeh events ("tap", "pan") that choose a point; the browser sends it with the state.
    ticks : positions and labels on both axes, where the usual ones would not do.
    still : elements that seldom change.  All others are painted on a canvas of their own, so that a
        new state does not paint axes and background again.
    """

    def __init__(self, name: str, overlay: hv.Overlay, labels: tuple[str, str],
                 x_range: tuple[float, float], y_range: tuple[float, float], picks: Sequence[str] = (),
                 still: Sequence[str] = (), ticks: Sequence[tuple[float, str]] | None = None) -> None:
        self.name = name
        self.wire: Wire | None = None
        self._sentence = ""
        overlay = overlay * hv.Labels([], ["x", "y"], "text", label="message").opts(
            text_color=theme.MUTED, text_font_style="bold", text_font_size="15px")
        plot = renderer.get_plot(overlay.opts(
            xlabel=labels[0], ylabel=labels[1], xlim=x_range, ylim=y_range, toolbar=None, default_tools=[],
            show_legend=False, responsive=True, min_height=200, min_width=200,
            fontsize={"labels": theme.FONT_SIZE, "ticks": "12px"}, title="",
            **({} if ticks is None else {"xticks": list(ticks), "yticks": list(ticks)}),
        ))
        self.root: figure = plot.state
        self.root.name = name
        self.root.update(min_border=4, sizing_mode="stretch_width", aspect_ratio=1)
        self.sources: dict[str, ColumnDataSource] = {}
        for element, drawn in zip(overlay, plot.subplots.values(), strict=True):
            source = drawn.handles["source"]
            source.name = f"{name}-{element.label}"
            self.sources[element.label] = source
            if element.label not in still:
                drawn.handles["glyph_renderer"].level = "overlay"
        for event in picks:
            self.root.js_on_event(event, CustomJS(args={"name": name}, code=_PICK))

    def assign(self, label: str, **columns: Any) -> None:
        """New data for one element: at once before the page exists, afterwards by the wire."""
        source = self.sources[label]
        if self.wire is None:
            source.data = columns
        else:
            self.wire.put(source.name, columns)

    def clear(self, *labels: str) -> None:
        """No data for these elements: nothing stale stays beside new parameters."""
        for label in labels:
            self.assign(label, **{column: [] for column in self.sources[label].data})

    def say(self, sentence: str) -> None:
        """A sentence in the middle of the picture; empty for none."""
        x, y = self.root.x_range, self.root.y_range
        middle = {"x": [(x.start + x.end) / 2], "y": [(y.start + y.end) / 2], "text": [sentence]}
        if sentence != self._sentence:
            self._sentence = sentence
            self.assign("message", **(middle if sentence else {"x": [], "y": [], "text": []}))

    def set_ranges(self, x: tuple[float, float], y: tuple[float, float]) -> None:
        """Other axes; assigning the same ones does nothing."""
        for axis, (start, end) in ((self.root.x_range, x), (self.root.y_range, y)):
            if (axis.start, axis.end) != (start, end):
                axis.update(start=start, end=end)


def columns_of(array: np.ndarray, names: Sequence[str]) -> Mapping[str, np.ndarray]:
    """Columns of a 2-D array under these names, in the single precision that a screen needs."""
    return {name: np.ascontiguousarray(array[:, i], dtype=np.float32) for i, name in enumerate(names)}
