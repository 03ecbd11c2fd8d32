"""A planar picture as data: axes, layers, caption and response to clicks.

`bokeh_figure` draws it; the stage of its scene sends the data of a state.
"""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

from hess_explorer.views import tags
from hess_explorer.views.layers import MESSAGE, POINT, Axes, Columns, Layer, Layers, Range, Sign, Sources, label
from hess_explorer.views.picture import Picture

S = TypeVar("S")
Ticks = Sequence[tuple[float, str]]


@dataclass(frozen=True, kw_only=True)
class Plot(Picture[S]):
    """A square plot, with these fields in addition to those of `Picture`.

    Parameters
    ----------
    axes : tuple of str or callable
        Names of the axes, or a function of the state.
    x, y : (float, float) or callable
        Ranges of the axes, or functions of the state; a function that returns None keeps the current range.
    layers : sequence of Layer
        Layers from the back to the front, below the moving point and the message.
    message : callable, optional
        `message(state)` returns a sentence for the middle of an empty frame; "" for none.
    dot : tuple of str, optional
        The two columns of "orbit" that the moving point follows.
    dots : mapping of str to tuple, optional
        The two columns of "orbit" that further layers follow, by name of the layer.
    point : Layer
        Style of the moving point, and its legend entry.
    ticks : tuple, optional
        Positions and labels on both axes, instead of the default.
    y_ticks : tuple, optional
        Positions and labels on the vertical axis, instead of `ticks`.
    log : str
        Logarithmic axes: "x", "y" or "xy".
    first : Axes, optional
        Axes before the first state, if they depend on the state.
    x_ticks : sequence of float, optional
        Positions of the ticks on the horizontal axis; ignored if `ticks` is given.
    y_tick_count : int, optional
        Desired number of labels on the vertical axis.
    """

    axes: tuple[str, str] | Callable[[S], tuple[str, str]]
    x: Range | Callable[[S], Range | None]
    y: Range | Callable[[S], Range | None]
    layers: Layers[S]
    message: Callable[[S], str] | None = None
    dot: tuple[str, str] | None = None
    dots: Mapping[str, tuple[str, str]] | None = None
    point: Layer[S] = POINT
    ticks: Ticks | None = None
    y_ticks: Ticks | None = None
    log: str = ""
    first: Axes | None = None
    x_ticks: Sequence[float] | None = None
    y_tick_count: int | None = None

    kind: ClassVar[str] = "plot"

    @property
    def all_layers(self) -> Layers[S]:
        """All layers from the back to the front, including labels, the moving point and the message."""
        return (*self.layers, *(label(layer) for layer in self.layers if layer.tag), self.point, MESSAGE)

    @property
    def axis_ticks(self) -> tuple[Sequence[Any] | None, Sequence[Any] | None]:
        """Positions on both axes, with or without labels; None for the default."""
        return self.ticks or self.x_ticks, self.y_ticks or self.ticks

    @property
    def events(self) -> tuple[str, ...]:
        """Mouse events that the browser reports: Bokeh's events, "box" and "hover"."""
        return (
            *(("tap", "doubletap") if self.on_click else ()),
            *(("pan",) if self.on_click and self.on_drag else ()),
            *(("box",) if self.on_box else ()),
            *(("hover",) if self.on_hover else ()),
        )

    @property
    def handle(self) -> Layer[S] | None:
        """The layer whose point a drag moves; None if a drag moves no point."""
        return next((layer for layer in self.layers if layer.name == self.on_drag), None)

    @property
    def followers(self) -> Mapping[str, tuple[str, str]]:
        """The two columns of "orbit" that each moving point follows, by data source."""
        moving = {**({"point": self.dot} if self.dot else {}), **(self.dots or {})}
        return {f"{self.name}-{layer}": columns for layer, columns in moving.items()}

    def describe(self) -> dict[str, Any]:
        """Return the description of the plot, sent to the browser before the first data."""
        # Only pages need Bokeh and Panel, whose import is slow.
        from hess_explorer.views import bokeh_figure

        return {**super().describe(), **bokeh_figure.describe(self)}

    @property
    def tracks(self) -> frozenset[str]:
        """Names of the tracks that the plot requires."""
        drawn = {layer.track for layer in self.layers if layer.track is not None}
        return frozenset(drawn | ({"orbit"} if self.followers else set()))

    @property
    def legend(self) -> tuple[Sign, ...]:
        """Entries that the plot adds to the legend of its scene."""
        return (
            *(sign for layer in self.layers for sign in layer.legend),
            *self.signs,
            *(self.point.legend if self.dot is not None else ()),
        )

    def visible_legend(self, drawn: Mapping[str, Columns]) -> tuple[Sign, ...]:
        """Return the visible legend entries, given the columns of all data sources.

        The legend does not repeat labels inside the picture.
        """
        found = (
            sign
            for layer in self.layers
            for sign in layer.legend
            if not (sign.label == layer.tag and drawn.get(f"{self.name}-{layer.name}-label"))
            and _has(drawn.get(self.source_of(layer), {}), layer, sign)
        )
        return (*found, *self.signs, *(self.point.legend if self.dot is not None and drawn.get("data-orbit") else ()))

    @property
    def first_axes(self) -> Axes:
        """The axes before the first state: `first`, the fixed ranges or placeholders."""
        if self.first is not None:
            return self.first
        x, y = ((1.0, 10.0) if side in self.log else (0.0, 1.0) for side in "xy")
        return Axes(x if callable(self.x) else self.x, y if callable(self.y) else self.y)

    def names(self, state: S) -> tuple[str, str]:
        """Return the names of the axes."""
        return self.axes(state) if callable(self.axes) else self.axes

    def source_of(self, layer: Layer[S]) -> str:
        """Return the name of the source of a layer."""
        return f"data-{layer.track}" if layer.track else f"{self.name}-{layer.name}"

    def ranges(self, state: S, held: Axes | None) -> Axes:
        """Return the axes that fit a state; a range that is not known yet is taken from the current axes `held`."""
        assert held is not None
        x, y = self.x(state) if callable(self.x) else self.x, self.y(state) if callable(self.y) else self.y
        return Axes(x or held.x, y or held.y)

    def data(self, state: S) -> Sources:
        """Return the columns that do not depend on the axes, by data source."""
        return {self.source_of(layer): layer.data(state) for layer in self.layers if layer.data is not None}

    def data_in_axes(self, state: S, axes: Axes | None, drawn: Sources) -> Sources:
        """Return the columns that depend on the axes, labels and message included, by data source."""
        assert axes is not None
        found = {
            self.source_of(layer): layer.data_in_axes(state, axes)
            for layer in self.layers
            if layer.data_in_axes is not None
        }
        sentence = "" if self.message is None else self.message(state)
        sources = [self.source_of(layer) for layer in self.layers]
        columns = [{**drawn.get(source, {}), **found.get(source, {})} for source in sources]
        labels = tags.label_places(self.layers, columns, axes, self.log)
        found.update({f"{self.name}-{name}-label": one for name, one in labels.items()})
        return {**found, **self._words(self.names(state), sentence, axes)}

    def empty_data(self, sentence: str, axes: Axes | None) -> Sources:
        """Return the columns of an empty plot with a sentence as message."""
        assert axes is not None
        empty: Sources = {self.source_of(layer): {} for layer in self.all_layers}
        return {**empty, **self._words((" ", " "), sentence, axes)}

    def _words(self, names: tuple[str, str], sentence: str, axes: Axes) -> Sources:
        """Return the columns of the message and of state-dependent axis names."""
        message: Columns = (
            {}
            if not sentence
            else {
                "x": [_middle(axes.x, "x" in self.log)],
                "y": [_middle(axes.y, "y" in self.log)],
                "text": [textwrap.fill(sentence, 24)],
            }
        )
        renamed = {f"{self.name}-axes": {"text": list(names)}} if callable(self.axes) else {}
        return {**renamed, f"{self.name}-message": message}


def _has(columns: Columns, layer: Layer[Any], sign: Sign) -> bool:
    """Return whether a layer with these columns draws the content of a legend sign."""
    first = columns.get(layer.columns[0], ())
    if not len(first) or sign.least is None:
        return bool(len(first))
    cells = first[0]
    return bool(((cells >= sign.least) & (cells < sign.least + 1.0)).any())


def _middle(axis: Range, log: bool) -> float:
    return math.sqrt(axis[0] * axis[1]) if log else (axis[0] + axis[1]) / 2
