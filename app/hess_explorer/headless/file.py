"""Write a picture in any file format: tables and plots without a browser, everything else with the page."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from hess_explorer.export.figure import as_figure, as_file, figure_bytes, image_figure
from hess_explorer.export.formats import FORMATS, FileRequest
from hess_explorer.export.picture_data import PictureData
from hess_explorer.headless.drawing import page_image, png_of
from hess_explorer.headless.film import as_film
from hess_explorer.views.plot import Plot

if TYPE_CHECKING:
    from matplotlib.figure import Figure


def content(
    data: PictureData, request: FileRequest, report: Callable[[int, int], None] = lambda done, of: None
) -> bytes:
    """Return the contents of a file with a picture or its data.

    Parameters
    ----------
    data : PictureData
        The picture.
    request : FileRequest
        The format and its settings.
    report : callable
        Progress callback of `as_film`; not used for other files.

    Returns
    -------
    bytes
        The contents.

    Raises
    ------
    InvalidParameter
        If a setting is not supported, or a library is not installed.
    BrowserError
        If a browser is needed, and there is none or it cannot draw the picture.
    """
    kind, width, black = request.kind, request.width, request.black
    if FORMATS[kind].content == "film":
        return as_film(data, request, report)
    if FORMATS[kind].content == "data" or isinstance(data.picture, Plot):
        return as_file(data, request)
    return png_of(data, width, black) if kind == "png" else figure_bytes(figure(data, width, black), data, kind)


def figure(data: PictureData, width: float = 85.0, black: bool = False) -> Figure:
    """Return a picture as a figure of Matplotlib; parameters as in `as_figure`, errors as in `content`."""
    if isinstance(data.picture, Plot):
        return as_figure(data, width, black)
    return image_figure(data, page_image(data, width, black), width)
