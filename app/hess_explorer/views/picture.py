"""Base class of all pictures of a scene, independent of how the browser draws them."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import Any, ClassVar, Generic, TypeVar

from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Axes, Columns, Layer, Sign, Sources

__all__ = ["Corners", "Picture", "Values"]

S = TypeVar("S")
T = TypeVar("T")
Values = Mapping[str, float | str]
Corners = tuple[float, float, float, float]
"""Two opposite corners: x0, y0, x1, y1."""


@dataclass(frozen=True, kw_only=True)
class Picture(ABC, Generic[S]):
    """One picture on the page, as data: its content for a state of the scene, and its response to the mouse.

    Parameters
    ----------
    name : identifier; title : heading, or a function of the state.
    caption(state) : verdict and numbers; `full_caption` adds the title.
    on_click(state, x, y) : parameter values set by a click; on_drag : name of the layer whose point a drag moves.
    starts : whether a click chooses where the motion starts.
    on_box(state, corners) : parameter values set by a box selection.
    on_hover(state, x, y) : tooltip for the place under the mouse.  Raises `ModelError`.
    signs : legend entries in addition to those of its layers.
    drawn_from : names of other pictures whose sources it draws.
    button : label of the button that shows the picture, if it is hidden at first.
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
    drawn_from: tuple[str, ...] = ()
    button: str = ""

    kind: ClassVar[str]
    """Renderer in the browser: "plot" is Bokeh, the others draw on their own canvases."""

    def of(self, part: Callable[[T], S], **changes: Any) -> Picture[T]:
        """Return the same picture for states with `part`: its functions apply to that.

        Parameters
        ----------
        changes
            Other fields.
        """

        def through(value: Any) -> Any:
            if isinstance(value, Layer):
                return replace(value, data=through(value.data), within=through(value.within))
            if type(value) is tuple:
                return tuple(map(through, value))
            return (lambda state, *more: value(part(state), *more)) if callable(value) else value

        typed: Any = self
        found: Picture[T] = replace(typed, **{name: through(value) for name, value in vars(self).items()} | changes)
        return found

    @property
    def needs(self) -> frozenset[str]:
        """Names of the pictures whose data it requires."""
        return frozenset(self.drawn_from)

    @property
    def tracks(self) -> frozenset[str]:
        """The tracks of the scene that it requires: "orbit" sets the time of the player."""
        return frozenset({"orbit"})

    @property
    def followers(self) -> Mapping[str, tuple[str, str]]:
        """Columns of the track "orbit" followed by each moving point, by source."""
        return {}

    @property
    def legend(self) -> tuple[Sign, ...]:
        """Entries that the picture adds to the legend of its scene."""
        return self.signs

    def there(self, drawn: Mapping[str, Columns]) -> tuple[Sign, ...]:
        """Return the legend entries that are visible, given the columns of all sources."""
        return self.legend

    @property
    def first_axes(self) -> Axes | None:
        """The axes before the first state."""
        return None

    @property
    def hands(self) -> str:
        """The mouse gestures that set values: "drag", "box", "drag box", "click" or none."""
        if self.on_click is None:
            return ""
        return " ".join(["drag"] * bool(self.on_drag) + ["box"] * (self.on_box is not None)) or "click"

    def describe(self) -> dict[str, Any]:
        """Return the description of the picture, sent to the browser before the first data."""
        return {"name": self.name, "kind": self.kind, "hands": self.hands, "starts": self.starts}

    def ranges(self, state: S, held: Axes | None) -> Axes | None:
        """Return the axes that fit a state; those `held` where it has none."""
        return held

    @abstractmethod
    def data(self, state: S) -> Sources:
        """Return the columns that are independent of the axes, by source."""

    def framed(self, state: S, axes: Axes | None, drawn: Sources) -> Sources:
        """Return the columns that depend on the axes, by source; they are merged with those `drawn` without axes."""
        return {}

    def nothing(self, sentence: str, axes: Axes | None) -> Sources:
        """Return the columns of an empty picture; only a plot shows the reason."""
        return {self.name: {}}

    def full_caption(self, state: S) -> Caption:
        """Return the caption with its title."""
        title = self.title if isinstance(self.title, str) else self.title(state)
        return replace(self.caption(state), title=title)
