"""A picture as a figure for paper, by Matplotlib: the layers and axes of the page, in its colours or black on white."""

from __future__ import annotations

import io
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

from hess_explorer.export import clouds, plots, spheres
from hess_explorer.export.formats import WIDTHS, holding
from hess_explorer.export.shown import Shown
from hess_explorer.export.solid import EVEN, ODD
from hess_explorer.views import theme
from hess_explorer.views.cloud import CloudPlane
from hess_explorer.views.elements import Colour, as_it_is
from hess_explorer.views.plot import Plot
from hess_mechanics.errors import InvalidParameter

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Frame
    from matplotlib.figure import Figure

__all__ = ["STYLE", "as_file", "draw", "draw_moving", "draw_still", "in_black", "saved"]

_DOTS_PER_INCH = 300
STYLE: Mapping[str, Any] = {
    # The one without 𝒟 falls back on the other.
    "font.family": ["DejaVu Sans", "STIXGeneral"],
    "font.size": 9.0,
    "axes.linewidth": 0.6,
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
    "svg.hashsalt": "hess-explorer",
    "mathtext.fontset": "dejavusans",
}


def as_file(shown: Shown, kind: str, width: float = 85.0, black: bool = False) -> bytes:
    """A square figure of so many millimetres as PNG (300 dots an inch), SVG or PDF; fonts stay text.

    black : black on white, lines told apart by their dashes, instead of the colours of the page.

    Raises
    ------
    InvalidParameter : no such format or width, or Matplotlib is not installed.
    """
    if kind not in holding("figure"):
        raise InvalidParameter(f"{kind!r} is no format of a figure: choose one of {', '.join(holding('figure'))}.")
    if not WIDTHS.low <= width <= WIDTHS.high:
        raise InvalidParameter(f"A figure is {WIDTHS} mm wide, not {width:g}.")
    try:
        import matplotlib as mpl
    except ImportError as error:
        raise InvalidParameter(
            "Figures need Matplotlib: pip install 'hess-explorer[export]'. CSV and JSON need nothing."
        ) from error
    with mpl.rc_context(dict(STYLE)):
        return saved(draw(shown, width, black), shown, kind)


def saved(figure: Figure, shown: Shown, kind: str) -> bytes:
    """The file of a figure, which says where it comes from."""
    program, said = shown.facts["program"], shown.said
    metadata: dict[str, Any] = {
        "png": {"Title": shown.title, "Description": said, "Comment": shown.caption, "Software": program},
        "svg": {"Title": shown.title, "Description": f"{shown.caption} {said}", "Date": None},
        "pdf": {"Title": shown.title, "Subject": said, "Keywords": shown.caption, "CreationDate": None},
    }[kind]
    out = io.BytesIO()
    figure.savefig(out, format=kind, dpi=_DOTS_PER_INCH, metadata=metadata)
    return out.getvalue()


def draw(shown: Shown, width: float = 85.0, black: bool = False) -> Figure:
    """The figure itself, of so many millimetres, at the time and the turn of the link."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width / 25.4, width / 25.4), layout="constrained")
    frame = figure.add_subplot()
    colour = in_black if black else as_it_is
    draw_still(frame, shown, colour)
    draw_moving(frame, shown, colour, shown.client["t"], point=False)
    return figure


def draw_still(frame: Frame, shown: Shown, colour: Colour) -> None:
    """What no motion changes, and lies beneath what moves."""
    if isinstance(shown.picture, Plot):
        plots.draw_still(frame, shown, colour)
    elif isinstance(shown.picture, CloudPlane):
        clouds.draw_still(frame, shown, colour)
    else:
        spheres.draw_still(frame, shown, colour)


def draw_moving(frame: Frame, shown: Shown, colour: Colour, t: float, point: bool) -> None:
    """What moves, at a time: bodies and clouds; point : the moving points of the orbit too."""
    if isinstance(shown.picture, Plot):
        plots.draw_moving(frame, shown, colour, t, point)
    elif isinstance(shown.picture, CloudPlane):
        clouds.draw_moving(frame, shown, colour, t)
    else:
        spheres.draw_moving(frame, shown, colour, t, point)


def in_black(colour: str) -> str:
    """Areas keep their lightness, everything else is black."""
    return (
        colour
        if colour in (theme.PAPER, "white")
        else {theme.FORBIDDEN: "#E4E4E4", theme.LOCKED: "#BDBDBD", EVEN: "#D6D6D6", ODD: "#B2B2B2"}.get(
            colour, "#000000"
        )
    )
