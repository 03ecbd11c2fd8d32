"""Draw a picture for print with Matplotlib: the layers and axes of the page, in its colours or black on white."""

from __future__ import annotations

import io
from collections.abc import Mapping
from contextlib import AbstractContextManager
from typing import TYPE_CHECKING, Any

from hess_explorer.export import clouds, plots, spheres, torus
from hess_explorer.export.formats import WIDTHS, holding
from hess_explorer.export.picture_data import PictureData
from hess_explorer.export.solid import EVEN, ODD
from hess_explorer.views import theme
from hess_explorer.views.cloud import CloudPlane
from hess_explorer.views.elements import Colour, as_it_is
from hess_explorer.views.plot import Plot
from hess_explorer.views.torus_in_space import TorusInSpace
from hess_mechanics.errors import InvalidParameter

if TYPE_CHECKING:
    from matplotlib.axes import Axes as Frame
    from matplotlib.figure import Figure

__all__ = ["STYLE", "as_figure", "as_file", "draw", "draw_moving", "draw_still", "in_black", "saved"]

_DOTS_PER_INCH = 300
STYLE: Mapping[str, Any] = {
    # DejaVu Sans has no 𝒟, so STIXGeneral is the fallback.
    "font.family": ["DejaVu Sans", "STIXGeneral"],
    "font.size": 9.0,
    "axes.linewidth": 0.6,
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
    "svg.hashsalt": "hess-explorer",
    "mathtext.fontset": "dejavusans",
}


def as_file(data: PictureData, kind: str, width: float = 85.0, black: bool = False) -> bytes:
    """Return a square figure as a file, in which text stays text.

    Parameters
    ----------
    data : PictureData
        The picture and its data.
    kind : str
        "png" (300 dots per inch), "svg" or "pdf".
    width : float
        Width in millimetres.
    black : bool
        True for black on white, with lines distinguished by dashes, instead of the colours of the page.

    Returns
    -------
    bytes
        The contents of the file.

    Raises
    ------
    InvalidParameter
        If the format or width is not supported, or Matplotlib is not installed.
    """
    if kind not in holding("figure"):
        raise InvalidParameter(f"{kind!r} is not a figure format: choose one of {', '.join(holding('figure'))}.")
    with _style():
        return saved(as_figure(data, width, black), data, kind)


def as_figure(data: PictureData, width: float = 85.0, black: bool = False) -> Figure:
    """Return a square figure of Matplotlib, to be changed or saved.

    Parameters
    ----------
    data, width, black
        As in `as_file`.

    Returns
    -------
    matplotlib.figure.Figure
        The figure, with one Axes.

    Raises
    ------
    InvalidParameter
        If the width is not supported, or Matplotlib is not installed.
    """
    WIDTHS.require("A figure", width, "mm wide")
    with _style():
        return draw(data, width, black)


def _style() -> AbstractContextManager[None]:
    """Return a context with the fonts of figures.  Raises `InvalidParameter` without Matplotlib."""
    try:
        import matplotlib as mpl
    except ImportError as error:
        raise InvalidParameter(
            "Figures need Matplotlib: pip install 'hess-explorer[export]'. CSV and JSON work without it."
        ) from error
    return mpl.rc_context(dict(STYLE))


def saved(figure: Figure, data: PictureData, kind: str) -> bytes:
    """Return a figure as a file whose metadata contain link, parameters and version."""
    program, text = data.facts["program"], data.metadata_text
    metadata: dict[str, Any] = {
        "png": {"Title": data.title, "Description": text, "Comment": data.caption, "Software": program},
        "svg": {"Title": data.title, "Description": f"{data.caption} {text}", "Date": None},
        "pdf": {"Title": data.title, "Subject": text, "Keywords": data.caption, "CreationDate": None},
    }[kind]
    out = io.BytesIO()
    figure.savefig(out, format=kind, dpi=_DOTS_PER_INCH, metadata=metadata)
    return out.getvalue()


def draw(data: PictureData, width: float = 85.0, black: bool = False) -> Figure:
    """Return the figure, `width` millimetres wide, at the time and view of the link."""
    from matplotlib.figure import Figure

    figure = Figure(figsize=(width / 25.4, width / 25.4), layout="constrained")
    frame = figure.add_subplot()
    colour = in_black if black else as_it_is
    draw_still(frame, data, colour)
    draw_moving(frame, data, colour, data.client["t"], point=False)
    return figure


def draw_still(frame: Frame, data: PictureData, colour: Colour) -> None:
    """Draw the static parts, beneath the moving ones."""
    if isinstance(data.picture, Plot):
        plots.draw_still(frame, data, colour)
    elif isinstance(data.picture, CloudPlane):
        clouds.draw_still(frame, data, colour)
    elif isinstance(data.picture, TorusInSpace):
        torus.draw_still(frame, data, colour)
    else:
        spheres.draw_still(frame, data, colour)


def draw_moving(frame: Frame, data: PictureData, colour: Colour, t: float, point: bool) -> None:
    """Draw bodies and clouds at time t; point : True to include the moving points of the orbit."""
    if isinstance(data.picture, Plot):
        plots.draw_moving(frame, data, colour, t, point)
    elif isinstance(data.picture, CloudPlane):
        clouds.draw_moving(frame, data, colour, t)
    elif isinstance(data.picture, TorusInSpace):
        torus.draw_moving(frame, data, colour, t, point)
    else:
        spheres.draw_moving(frame, data, colour, t, point)


def in_black(colour: str) -> str:
    """Return the colour in black on white: areas keep their lightness, everything else is black."""
    return (
        colour
        if colour in (theme.PAPER, "white")
        else {theme.FORBIDDEN: "#E4E4E4", theme.LOCKED: "#BDBDBD", EVEN: "#D6D6D6", ODD: "#B2B2B2"}.get(
            colour, "#000000"
        )
    )
