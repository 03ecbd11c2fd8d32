"""A planar picture as data: axes, layers, caption, and what a click means.

How it is drawn is for `bokeh_figure` to know; what is told of a state, for the stage of its scene.
"""

from __future__ import annotations

import math
import textwrap
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from typing import Any, ClassVar, TypeVar

from hess_explorer.views import bokeh_figure
from hess_explorer.views.layers import MOVING_POINT, POINT, Axes, Columns, Layer, Layers, Range, Sign, Sources
from hess_explorer.views.picture import Picture

__all__ = ["Plot"]

S = TypeVar("S")
Ticks = Sequence[tuple[float, str]]


@dataclass(frozen=True, kw_only=True)
class Plot(Picture[S]):
    """A square picture.

    Parameters
    ----------
    axes : the names of the axes; x, y : their ranges; each of a state where it depends on that.  Both ranges stay as
        they are where one is None.
    layers : what is drawn, from the back to the front.  The moving point and a message come on top.
    message(state) : a sentence in the middle of the frame where there is nothing to see; empty for none.
    dot : columns of the track "orbit" that the moving point follows; dots : further layers that follow it.
    ticks : positions and labels on both axes, where the usual ones would not do; y_ticks : others on the vertical one.
    log : the axes that are logarithmic, "x", "y" or "xy".
    first : the axes before the first state, where those depend on it.
    x_ticks : positions on the horizontal axis; y_tick_count : how many labels the vertical one wants.
    """

    axes: tuple[str, str] | Callable[[S], tuple[str, str]]
    x: Range | Callable[[S], Range | None]
    y: Range | Callable[[S], Range | None]
    layers: Layers[S]
    message: Callable[[S], str] | None = None
    dot: tuple[str, str] | None = None
    dots: Mapping[str, tuple[str, str]] | None = None
    ticks: Ticks | None = None
    y_ticks: Ticks | None = None
    log: str = ""
    first: Axes | None = None
    x_ticks: Sequence[float] | None = None
    y_tick_count: int | None = None

    kind: ClassVar[str] = "plot"

    @property
    def events(self) -> tuple[str, ...]:
        """What the browser tells of the mouse: Bokeh's events, "box" and "hover"."""
        return (
            *(("tap", "doubletap") if self.on_click else ()),
            *(("pan",) if self.on_click and self.on_drag else ()),
            *(("box",) if self.on_box else ()),
            *(("hover",) if self.on_hover else ()),
        )

    @property
    def followers(self) -> Mapping[str, tuple[str, str]]:
        """Sources of moving points → the columns of the track "orbit" that they follow."""
        moving = {**({"point": self.dot} if self.dot else {}), **(self.dots or {})}
        return {f"{self.name}-{layer}": columns for layer, columns in moving.items()}

    def describe(self) -> dict[str, Any]:
        """What the browser needs to know before the first data."""
        return {**super().describe(), **bokeh_figure.describe(self)}

    @property
    def tracks(self) -> frozenset[str]:
        """The tracks of the scene that it needs."""
        drawn = {layer.track for layer in self.layers if layer.track is not None}
        return frozenset(drawn | ({"orbit"} if self.followers else set()))

    @property
    def legend(self) -> tuple[Sign, ...]:
        """What it adds to the legend of its scene."""
        return (
            *(sign for layer in self.layers for sign in layer.legend),
            *self.signs,
            *((MOVING_POINT,) if self.dot is not None else ()),
        )

    def there(self, drawn: Mapping[str, Columns]) -> tuple[Sign, ...]:
        """Those of its legend that are drawn, where these are the columns of all sources."""
        found = (
            sign
            for layer in self.layers
            for sign in layer.legend
            if _has(drawn.get(self.source_of(layer), {}), layer, sign)
        )
        return (*found, *self.signs, *((MOVING_POINT,) if self.dot is not None and drawn.get("data-orbit") else ()))

    @property
    def first_axes(self) -> Axes:
        """The axes before the first state: any that are possible, where they depend on it and none are given."""
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

    def ranges(self, state: S) -> Axes | None:
        """Return the axes that fit a state."""
        x, y = self.x(state) if callable(self.x) else self.x, self.y(state) if callable(self.y) else self.y
        return None if x is None or y is None else Axes(x, y)

    def data(self, state: S) -> Sources:
        """Return the columns of its own sources, but those that depend on the axes."""
        return {self.source_of(layer): layer.data(state) for layer in self.layers if layer.data is not None}

    def framed(self, state: S, axes: Axes | None) -> Sources:
        """Return the columns of those that do."""
        assert axes is not None
        found = {self.source_of(layer): layer.within(state, axes) for layer in self.layers if layer.within is not None}
        sentence = "" if self.message is None else self.message(state)
        return {**found, **self._words(self.names(state), sentence, axes)}

    def nothing(self, sentence: str, axes: Axes | None) -> Sources:
        """Return the columns of all its sources where there is nothing to see but the reason."""
        assert axes is not None
        empty: Sources = {self.source_of(layer): {} for layer in (*self.layers, POINT)}
        return {**empty, **self._words((" ", " "), sentence, axes)}

    def _words(self, names: tuple[str, str], sentence: str, axes: Axes) -> Sources:
        """Return the columns of the names of its axes, where those depend on the state, and of the message."""
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
    """Whether a layer with these columns draws what a sign of it means."""
    first = columns.get(layer.columns[0], ())
    if not len(first) or sign.least is None:
        return bool(len(first))
    cells = first[0]
    return bool(((cells >= sign.least) & (cells < sign.least + 1.0)).any())


def _middle(axis: Range, log: bool) -> float:
    return math.sqrt(axis[0] * axis[1]) if log else (axis[0] + axis[1]) / 2
