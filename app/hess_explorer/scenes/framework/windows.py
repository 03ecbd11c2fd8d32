"""Windows: the visible part of a picture's plane, as text in a link."""

from __future__ import annotations

from hess_explorer.protocol.specs import Value, Values, points_of, points_text
from hess_mechanics.dynamics.cells import Window
from hess_mechanics.dynamics.sampling import PIXELS

__all__ = ["Window", "box_window", "normalized_window", "pixels_in", "window_of"]


def normalized_window(text: Value) -> str:
    """Return the text of a window with sorted corners; empty unless the text has two corners with an area between."""
    corners = points_of(text)
    if len(corners) != 2 or corners[0][0] == corners[1][0] or corners[0][1] == corners[1][1]:
        return ""
    (x0, y0), (x1, y1) = corners
    return points_text([(min(x0, x1), min(y0, y1)), (max(x0, x1), max(y0, y1))])


def window_of(text: Value, full: Window) -> Window:
    """Return the window of a valid text; `full` if the text is empty."""
    corners = points_of(text)
    return (corners[0], corners[1]) if len(corners) == 2 else full


def pixels_in(window: Window) -> tuple[float, ...]:
    """Return the pixels per unit of each coordinate of a window that fills a picture."""
    return tuple(PIXELS / (high - low) for low, high in zip(*window, strict=True))


def box_window(corners: tuple[float, float, float, float], bounds: Window, name: str = "window") -> Values:
    """Return the value of the window parameter `name` for a box.

    Parameters
    ----------
    corners : (float, float, float, float)
        Two opposite corners of the box: x0, y0, x1, y1.
    bounds : Window
        Largest window, to which the box is clipped.
    name : str
        Name of the parameter.

    Returns
    -------
    mapping of str to str
        The window as a text, which is empty if the box contains the bounds; an empty mapping if nothing is left of the
        box.
    """
    (x0, y0), (x1, y1) = bounds
    left, right = max(x0, min(corners[0], corners[2])), min(x1, max(corners[0], corners[2]))
    low, high = max(y0, min(corners[1], corners[3])), min(y1, max(corners[1], corners[3]))
    if not (low < high and left < right):
        return {}
    return {name: "" if ((left, low), (right, high)) == bounds else points_text([(left, low), (right, high)])}
