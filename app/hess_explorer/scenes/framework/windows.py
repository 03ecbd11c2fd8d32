"""Windows of a picture: what of its plane is seen, as a text in the link."""

from __future__ import annotations

from collections.abc import Sequence

from hess_explorer.protocol.parameters import Value, Values, places, written
from hess_explorer.views.comparison import Frame
from hess_explorer.views.layers import Axes
from hess_mechanics.dynamics.cells import Window

__all__ = ["Window", "boxed", "frame_of", "inside", "tidy_window", "window_of"]


def tidy_window(text: Value) -> str:
    """The text of a window with its corners in order; empty where it is none."""
    corners = places(text)
    if len(corners) != 2 or corners[0][0] == corners[1][0] or corners[0][1] == corners[1][1]:
        return ""
    (x0, y0), (x1, y1) = corners
    return written([(min(x0, x1), min(y0, y1)), (max(x0, x1), max(y0, y1))])


def window_of(text: Value, full: Window) -> Window:
    """The window that an admitted text means; `full` where it is empty."""
    corners = places(text)
    return (corners[0], corners[1]) if len(corners) == 2 else full


def frame_of(window: Window, names: Sequence[str]) -> Frame:
    """Return the axes of a picture of a window."""
    (x0, y0), (x1, y1) = window
    return Frame(Axes((x0, x1), (y0, y1)), (names[0], names[1]))


def inside(points: Sequence[tuple[float, float]], window: Window) -> list[tuple[float, float]]:
    """Those of the points that lie in the window."""
    (x0, y0), (x1, y1) = window
    return [(x, y) for x, y in points if x0 <= x <= x1 and y0 <= y <= y1]


def boxed(corners: tuple[float, float, float, float], bounds: Window, name: str = "window") -> Values:
    """The window, of that name, of a box, as far as it lies within the bounds; nothing where it has no size."""
    (x0, y0), (x1, y1) = bounds
    left, right = max(x0, min(corners[0], corners[2])), min(x1, max(corners[0], corners[2]))
    low, high = max(y0, min(corners[1], corners[3])), min(y1, max(corners[1], corners[3]))
    return {name: written([(left, low), (right, high)])} if low < high and left < right else {}
