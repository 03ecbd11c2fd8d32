"""What every picture of a scene is, whoever draws it in the browser."""

from __future__ import annotations

from abc import ABC, abstractmethod
from collections.abc import Callable, Mapping
from dataclasses import dataclass, fields, is_dataclass, replace
from typing import Any, ClassVar, Generic, TypeVar, cast

from hess_explorer.views.caption import Caption
from hess_explorer.views.layers import Axes, Columns, Sign, Sources

__all__ = ["Corners", "Picture", "Values", "adapted"]

S = TypeVar("S")
H = TypeVar("H")
Values = Mapping[str, float | str]
Corners = tuple[float, float, float, float]
"""x0, y0, x1, y1 of two opposite corners."""


@dataclass(frozen=True, kw_only=True)
class Picture(ABC, Generic[S]):
    """One picture on the page, as data: what it shows of a state of its scene, and what the mouse means in it.

    Parameters
    ----------
    name, title : identifier; what stands over it, of a state where it depends on that.
    caption(state) : verdict and numbers; `said` adds the title.
    on_click(state, x, y) : the values that a click chooses; on_drag : whether a drag does the same.
    on_box(state, corners) : the values that a box chooses.
    on_hover(state, x, y) : a line about the place under the mouse.  Raises `ModelError`.
    signs : entries of the legend besides those of its layers.
    drawn_from : names of the pictures whose sources it draws from besides its own.
    folded : what the button says that shows the picture, if it is not seen at first.
    """

    name: str
    title: str | Callable[[S], str]
    caption: Callable[[S], Caption]
    on_click: Callable[[S, float, float], Values] | None = None
    on_drag: bool = False
    on_box: Callable[[S, Corners], Values] | None = None
    on_hover: Callable[[S, float, float], str] | None = None
    signs: tuple[Sign, ...] = ()
    drawn_from: tuple[str, ...] = ()
    folded: str = ""

    kind: ClassVar[str]
    """Who draws it in the browser: "plot" is Bokeh, the others draw on canvases of their own."""

    def of_part(self, part: Callable[[H], S]) -> Picture[H]:
        """Return the same picture of a state that holds what is shown as a part of it."""
        return cast("Picture[H]", adapted(self, part))

    @property
    def needs(self) -> frozenset[str]:
        """The pictures whose data must be there for it."""
        return frozenset(self.drawn_from)

    @property
    def tracks(self) -> frozenset[str]:
        """The tracks of the scene that it needs."""
        return frozenset()

    @property
    def followers(self) -> Mapping[str, tuple[str, str]]:
        """Sources of moving points → the columns of the track "orbit" that they follow."""
        return {}

    @property
    def legend(self) -> tuple[Sign, ...]:
        """What it adds to the legend of its scene."""
        return self.signs

    def there(self, drawn: Mapping[str, Columns]) -> tuple[Sign, ...]:
        """Those of its legend that are drawn, where these are the columns of all sources."""
        return self.legend

    @property
    def first_axes(self) -> Axes | None:
        """Its axes before the first state."""
        return None

    @property
    def hands(self) -> str:
        """What the mouse chooses in it: "drag", "box", "click", or nothing."""
        if self.on_click is None:
            return ""
        return "drag" if self.on_drag else "box" if self.on_box is not None else "click"

    def describe(self) -> dict[str, Any]:
        """What the browser needs to know before the first data."""
        return {"name": self.name, "kind": self.kind, "hands": self.hands}

    def ranges(self, state: S) -> Axes | None:
        """Return the axes that fit a state."""
        return None

    @abstractmethod
    def data(self, state: S) -> Sources:
        """Return the columns of its sources, by the name of the source, but those that depend on the axes."""

    def framed(self, state: S, axes: Axes | None) -> Sources:
        """Return the columns that do, which join those of the same source."""
        return {}

    def nothing(self, sentence: str, axes: Axes | None) -> Sources:
        """Return the columns of its sources where there is nothing to see; only a plot has room for the reason."""
        return {self.name: {}}

    def said(self, state: S) -> Caption:
        """Return the caption with its title."""
        title = self.title if isinstance(self.title, str) else self.title(state)
        return replace(self.caption(state), title=title)


def adapted(shown: Any, part: Callable[[Any], Any]) -> Any:
    """Turn functions of a part into functions of the state that holds it: in a picture, a layer, one field."""
    if is_dataclass(shown) and not isinstance(shown, type):
        return replace(shown, **{one.name: adapted(getattr(shown, one.name), part) for one in fields(shown)})
    if isinstance(shown, tuple):
        return tuple(adapted(one, part) for one in shown)
    return (lambda state, *mouse: shown(part(state), *mouse)) if callable(shown) else shown
