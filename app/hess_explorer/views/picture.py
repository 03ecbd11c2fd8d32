"""Base class of all pictures of a scene, independent of how the browser draws them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Generic, TypeVar

from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Axes, Columns, Layer, Sign, Sources

S = TypeVar("S")
T = TypeVar("T")
Values = Mapping[str, float | str]
Corners = tuple[float, float, float, float]
"""Two opposite corners: x0, y0, x1, y1."""
_EVERYTHING = (-1e300, -1e300, 1e300, 1e300)
"""A box around any picture, as the page sends it to show the whole."""


@dataclass(frozen=True, kw_only=True)
class Picture(ABC, Generic[S]):
    """A picture as data: its content for a state of the scene, and its response to the mouse.

    Parameters
    ----------
    name : str
        Identifier.
    title : str or callable
        Heading, or `title(state)`.
    caption : callable
        `caption(state)` returns verdict and numbers; `full_caption` adds the title.
    on_click : callable, optional
        `on_click(state, x, y)` returns the parameter values that a click sets.
    on_drag : str
        Name of the layer whose point a drag moves.
    starts : bool
        True if a click chooses the start of the motion.
    on_box : callable, optional
        `on_box(state, corners)` returns the parameter values that a box selection sets.
    on_hover : callable, optional
        `on_hover(state, x, y)` returns the tooltip at a point, empty for none; it may raise `ModelError`.
    signs : tuple of Sign
        Legend entries in addition to those of the layers.
    source_pictures : tuple of str
        Names of other pictures whose data sources it draws.
    button : str
        Label of the button that shows the picture; empty for a picture that is visible at first.
    """

    name: str
    title: str | Callable[[S], str]
    caption: Callable[[S], Caption]
    on_click: Callable[[S, float, float], Values] | None = None
    on_drag: str = ""
    starts: bool = False
    on_box: Callable[[S, Corners], Values] | None = None
    on_hover: Callable[[S, float, float], str] | None = None
    signs: tuple[Sign, ...] = ()
    source_pictures: tuple[str, ...] = ()
    button: str = ""

    kind: ClassVar[str]
    """Renderer in the browser: "plot" is Bokeh, the others draw on their own canvases."""

    def of(self, part: Callable[[T], S], **changes: Any) -> Picture[T]:
        """Return the same picture for other states; its functions apply to `part(state)`.

        Parameters
        ----------
        part : callable
            `part(state)` returns the state of this picture.
        **changes
            Changed fields.
        """

        def through(value: Any) -> Any:
            if isinstance(value, Layer):
                return replace(value, data=through(value.data), data_in_axes=through(value.data_in_axes))
            if type(value) is tuple:
                return tuple(map(through, value))
            return (lambda state, *more: value(part(state), *more)) if callable(value) else value

        typed: Any = self
        found: Picture[T] = replace(typed, **{name: through(value) for name, value in vars(self).items()} | changes)
        return found

    @property
    def dependencies(self) -> frozenset[str]:
        """Names of the pictures whose data the picture requires."""
        return frozenset(self.source_pictures)

    @property
    def tracks(self) -> frozenset[str]:
        """Names of the tracks that the picture requires; "orbit" sets the time of the player."""
        return frozenset({"orbit"})

    @property
    def followers(self) -> Mapping[str, tuple[str, str]]:
        """The two columns of "orbit" that each moving point follows, by data source."""
        return {}

    @property
    def legend(self) -> tuple[Sign, ...]:
        """Entries that the picture adds to the legend of its scene."""
        return self.signs

    def visible_legend(self, drawn: Mapping[str, Columns]) -> tuple[Sign, ...]:
        """Return the legend entries that are visible, given the columns of all sources."""
        return self.legend

    @property
    def first_axes(self) -> Axes | None:
        """The axes before the first state; None for a picture without axes."""
        return None

    @property
    def gestures(self) -> str:
        """The mouse gestures that set values: "drag", "box", "drag box" or "click"; empty without `on_click`."""
        if self.on_click is None:
            return ""
        return " ".join(["drag"] * bool(self.on_drag) + ["box"] * (self.on_box is not None)) or "click"

    def is_windowed(self, state: S) -> bool:
        """Return whether the state shows only the part of the picture that a box has selected."""
        whole = {} if self.on_box is None else self.on_box(state, _EVERYTHING)
        return any(getattr(state, name) != value for name, value in whole.items())

    def describe(self) -> dict[str, Any]:
        """Return the description of the picture, sent to the browser before the first data."""
        return {"name": self.name, "kind": self.kind, "hands": self.gestures, "starts": self.starts}

    def ranges(self, state: S, held: Axes | None) -> Axes | None:
        """Return the axes that fit a state; by default the current axes `held`."""
        return held

    @abstractmethod
    def data(self, state: S) -> Sources:
        """Return the columns that do not depend on the axes, by data source."""

    def data_in_axes(self, state: S, axes: Axes | None, drawn: Sources) -> Sources:
        """Return the columns that depend on the axes, by data source, given the columns `drawn` without axes."""
        return {}

    def empty_data(self, sentence: str, axes: Axes | None) -> Sources:
        """Return the columns of an empty picture; only a plot shows the sentence."""
        return {self.name: {}}

    def full_caption(self, state: S) -> Caption:
        """Return the caption with its title."""
        title = self.title if isinstance(self.title, str) else self.title(state)
        return replace(self.caption(state), title=title)
