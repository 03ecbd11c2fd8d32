"""Figures for print with Matplotlib: plots, in colours or black on white, and images with their texts."""

from __future__ import annotations

import io
import textwrap
from collections.abc import Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass
from math import degrees
from typing import TYPE_CHECKING, Any

import holoviews as hv
import numpy as np

from hess_explorer.export.formats import WIDTHS, FileRequest
from hess_explorer.export.picture_data import PictureData
from hess_explorer.export.table import as_csv, as_json
from hess_explorer.views import theme
from hess_explorer.views.elements import matplotlib_style, overlay, unchanged
from hess_explorer.views.layers import Layer
from hess_explorer.views.plot import Plot
from hess_explorer.views.space.cloud import CloudPlane
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_DOTS_PER_INCH = 300
_POINTS = 0.6
"""Points per pixel of the page."""
_TITLE, _CAPTION, _LINE, _LETTER = 9.0, 7.5, 11.0, 0.58
"""Sizes of title and caption below an image and height of their lines, in points; width of a letter in its size."""
_OVER = 1e3
"""Drawing order of moving points, above all static layers."""
_STYLE: Mapping[str, Any] = {
    # DejaVu Sans has no 𝒟, so STIXGeneral is the fallback.
    "font.family": ["DejaVu Sans", "STIXGeneral"],
    "font.size": 9.0,
    "axes.linewidth": 0.6,
    "svg.fonttype": "none",
    "pdf.fonttype": 42,
    "svg.hashsalt": "hess-explorer",
    "mathtext.fontset": "dejavusans",
}
_ALIGNED = {"alphabetic": "baseline", "middle": "center"}
"""Vertical alignment in Matplotlib by `textBaseline` of a canvas, where they differ."""


@dataclass(frozen=True)
class PageImage:
    """A picture as the page draws it.

    Attributes
    ----------
    image : bytes
        PNG file without the texts.
    texts : sequence of mappings
        Text, x, y, turn, size, colour, alpha, align and baseline of each text, see `LiftedText` in "types.d.ts".
    edge : float
        Width of the picture in pixels of the page.
    """

    image: bytes
    texts: Sequence[Mapping[str, Any]]
    edge: float


def as_file(data: PictureData, request: FileRequest) -> bytes:
    """Return the data of a picture as a table, or a plot as a figure, in a file.

    Parameters
    ----------
    data : PictureData
        The picture, a plot for a figure.
    request : FileRequest
        "csv" or "json" for a table; "png" (300 dots per inch), "svg" or "pdf" for a figure, in which text stays text.

    Returns
    -------
    bytes
        The contents of the file.

    Raises
    ------
    InvalidParameter
        If the width is not supported, or Matplotlib is not installed.
    """
    if request.kind in ("csv", "json"):
        return (as_csv if request.kind == "csv" else as_json)(data).encode()
    return figure_bytes(as_figure(data, request.width, request.black), data, request.kind)


def as_figure(data: PictureData, width: float = 85.0, black: bool = False) -> Figure:
    """Return a plot as a square figure of Matplotlib, at the time of the link, to be changed or saved.

    Parameters
    ----------
    data : PictureData
        The plot and its data.
    width : float
        Width in millimetres, within `WIDTHS`.
    black : bool
        True for black on white, with lines distinguished by dashes, instead of the colours of the page.

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
    plot, colour = data.picture, _in_black if black else unchanged
    assert isinstance(plot, Plot)
    assert data.axes is not None
    with _style():
        from matplotlib.figure import Figure

        figure = Figure(figsize=(width / 25.4, width / 25.4), layout="constrained")
        frame = figure.add_subplot()
        renderer = hv.renderer("matplotlib")
        elements = overlay(plot, data.columns, data.axes, plot.names(data.state), colour=colour)
        renderer.get_plot(elements, fig=figure, axis=frame)
        for view, layer in densities(data):
            x, y = _density(data.columns.get(view.name, {}), data.client["t"])
            frame.scatter(x, y, zorder=_OVER, **matplotlib_style(layer, colour))
    return figure


def image_figure(data: PictureData, drawing: PageImage, width: float = 85.0) -> Figure:
    """Return the image of a picture as a figure of Matplotlib, with title and caption below.

    Parameters
    ----------
    data : PictureData
        The picture and its data.
    drawing : PageImage
        The image and the texts in it.
    width : float
        Width in millimetres.

    Returns
    -------
    matplotlib.figure.Figure
        The figure, with one Axes in the pixels of the page.

    Raises
    ------
    InvalidParameter
        If Matplotlib is not installed.
    """
    with _style():
        from matplotlib.figure import Figure
        from matplotlib.image import imread

        side = width / 25.4
        lines = _wrap(data.title, side, _TITLE), _wrap(data.caption, side, _CAPTION)
        below = _LINE * (sum(map(len, lines)) + 0.5) / 72.0
        figure = Figure(figsize=(side, side + below))
        frame = figure.add_axes((0.0, below / (side + below), 1.0, side / (side + below)))
        frame.axis("off")
        extent = (0.0, drawing.edge, drawing.edge, 0.0)
        frame.imshow(imread(io.BytesIO(drawing.image)), extent=extent, aspect="auto", interpolation="none")
        for one in drawing.texts:
            frame.text(
                one["x"],
                one["y"],
                one["text"],
                fontsize=_POINTS * one["size"],
                color=one["colour"],
                alpha=one["alpha"],
                rotation=degrees(one["turn"]),
                rotation_mode="anchor",
                horizontalalignment=one["align"],
                verticalalignment=_ALIGNED.get(one["baseline"], one["baseline"]),
                parse_math=False,
            )
        place = below
        for size, text in zip((_TITLE, _CAPTION), lines, strict=True):
            for line in text:
                place -= _LINE / 72.0
                figure.text(0.02, place / (side + below), line, fontsize=size, parse_math=False)
    return figure


def _wrap(text: str, side: float, size: float) -> list[str]:
    """Wrap a text below an image of a width of `side` inches, at a font size of `size` points."""
    return textwrap.wrap(text, max(10, int(72.0 * side / (_LETTER * size))))


def _style() -> AbstractContextManager[None]:
    """Return a context with the style of figures.  Raises `InvalidParameter` without Matplotlib."""
    try:
        import matplotlib as mpl
    except ImportError as error:
        raise InvalidParameter(
            "Figures need Matplotlib: pip install 'hess-explorer[export]'. CSV and JSON work without it."
        ) from error
    return mpl.rc_context(dict(_STYLE))


def figure_bytes(figure: Figure, data: PictureData, kind: str) -> bytes:
    """Return a figure as a PNG, SVG or PDF file, with link, parameters and version in the metadata."""
    text = data.metadata_text
    metadata: dict[str, dict[str, Any]] = {
        "png": {**data.texts},
        "svg": {"Title": data.title, "Description": f"{data.caption} {text}", "Date": None},
        "pdf": {"Title": data.title, "Subject": text, "Keywords": data.caption, "CreationDate": None},
    }
    out = io.BytesIO()
    with _style():
        figure.savefig(out, format=kind, dpi=_DOTS_PER_INCH, metadata=metadata[kind])
    return out.getvalue()


def densities(data: PictureData) -> list[tuple[CloudPlane[Any], Layer[Any]]]:
    """Return each cloud whose density the plot shows, with the layer that shows it; empty for other pictures."""
    plot = data.picture
    layers = {plot.source_of(layer): layer for layer in plot.layers} if isinstance(plot, Plot) else {}
    return [
        (view, layers[view.density])
        for view in data.scene.views
        if isinstance(view, CloudPlane) and view.density in layers and view.name in plot.dependencies
    ]


def _density(columns: Mapping[str, Any], t: float) -> tuple[Array, Array]:
    """Return |s| and the density per unit of |s| of the first cloud at time t, in its nonempty bins of ln|s|."""
    if "signs0" not in columns:
        return np.empty(0), np.empty(0)
    times, (first, wide, count) = columns["times"], columns["bins"]
    frames = np.asarray(columns["frames0"], float).reshape(len(times), 5, -1)
    place = np.interp(t, times, np.arange(len(times)))
    i = min(int(place), len(times) - 2)
    log_s = frames[i, 1] + (place - i) * (frames[i + 1, 1] - frames[i, 1])
    counts = np.histogram(log_s, first + wide * np.arange(count + 1))[0]
    s = np.exp(first + (np.arange(count) + 0.5) * wide)
    full = counts > 0
    return s[full], counts[full] / (log_s.size * wide * s[full])


def _in_black(colour: str) -> str:
    """Return the substitute of a colour in black on white: grey for areas, black for everything else."""
    if colour in (theme.PAPER, "white"):
        return colour
    return {theme.FORBIDDEN: "#E4E4E4", theme.LOCKED: "#BDBDBD"}.get(colour, "#000000")
