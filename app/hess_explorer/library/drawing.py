"""Draw pictures of the explorer and results of `hess_mechanics` with HoloViews."""

from __future__ import annotations

import io
from functools import cache
from importlib.util import find_spec
from typing import Any

import holoviews as hv
import numpy as np

from hess_explorer.export.picture_data import PictureData
from hess_explorer.headless.drawing import png_of
from hess_explorer.views import theme
from hess_explorer.views.elements import SIDE, overlay, with_options
from hess_explorer.views.plot import Plot
from hess_mechanics.errors import InvalidParameter, MissingLibrary
from hess_mechanics.numerics.labelled import Labels, Result

_MILLIMETRES = 71.0
"""Width of the image, which gives it two pixels per pixel of the figure."""


@cache
def _show_in_notebooks() -> None:
    """Enable the display of HoloViews elements in notebooks, unless the user has chosen a backend."""
    # HoloViews keeps options only for loaded backends.
    hv.renderer("bokeh")
    if hv.Store.current_backend == "bokeh":
        hv.extension("bokeh", logo=False)


def draw(data: PictureData) -> Any:
    """Return a picture in the colours of the page.

    Parameters
    ----------
    data : PictureData
        The picture and its data.

    Returns
    -------
    holoviews.Overlay or holoviews.RGB
        The layers of a plot; an image of spheres, bodies, tori and clouds.

    Raises
    ------
    MissingLibrary
        If the image needs Matplotlib and it is not installed.
    BrowserError
        If the image needs a browser and there is none.
    """
    _show_in_notebooks()
    plot = data.picture
    if not isinstance(plot, Plot):
        return _image(data)
    assert data.axes is not None
    if find_spec("matplotlib"):
        # Load the options of the Matplotlib backend without selecting it.
        hv.renderer("matplotlib")
    return overlay(plot, data.columns, data.axes, plot.names(data.state), data.title)


def _image(data: PictureData) -> Any:
    """Return a picture as an image, drawn by the page."""
    try:
        from matplotlib.image import imread
    except ImportError as error:
        raise MissingLibrary("Images need Matplotlib: pip install 'hess-explorer[export]'.") from error

    pixels = imread(io.BytesIO(png_of(data, _MILLIMETRES)))
    shared = {"title": data.title, "xaxis": None, "yaxis": None}
    return with_options(
        hv.RGB(pixels, bounds=(-1.0, -1.0, 1.0, 1.0)),
        {"bokeh": {**shared, "frame_width": SIDE, "frame_height": SIDE}, "matplotlib": shared},
    )


def draw_result(result: Result) -> Any:
    """Return a plot of a result, with a panel for each real variable over a coordinate.

    Parameters
    ----------
    result : Result
        A result of `hess_mechanics`.

    Returns
    -------
    holoviews.Path, holoviews.Image, holoviews.Points or holoviews.Layout
        Curves over the last dimension, or a map over two dimensions if both have coordinates.  A result without
        coordinates is drawn as points, with its first two variables as axes.

    Raises
    ------
    InvalidParameter
        If the result contains nothing to draw.
    """
    _show_in_notebooks()
    known = result.labels()
    axes = [dims[0] for name, (dims, _) in known.coords.items() if dims == (name,)]
    points = [(name, values) for name, (dims, values) in known.variables.items() if len(dims) == 1]
    if not axes and len(points) > 1:
        (x, across), (y, up), *_ = points
        title = {"title": type(result).__name__}
        return with_options(
            hv.Points((across, up), [_axis(known, x), _axis(known, y)]),
            {
                "bokeh": {**title, "size": 1.5, "frame_width": SIDE, "frame_height": SIDE},
                "matplotlib": {**title, "s": 1.5, "aspect": "auto"},
            },
        )
    panels = [
        _panel(known, name, axes)
        for name, (dims, values) in known.variables.items()
        if len(dims) in (1, 2) and dims[-1] in axes and values.dtype.kind == "f"
    ]
    if not panels:
        raise InvalidParameter(f"A {type(result).__name__} has nothing to draw: use `to_xarray()` for its numbers.")
    return hv.Layout(panels).cols(2) if len(panels) > 1 else panels[0]


def _axis(labels: Labels, name: str) -> Any:
    return hv.Dimension(name, unit=labels.units.get(name) or None)


def _panel(labels: Labels, name: str, axes: list[str]) -> Any:
    """Return a variable over its last dimension, or over its last two if both have coordinates."""
    dims, values = labels.variables[name]
    x = labels.coords[dims[-1]][1]
    if len(dims) > 1 and dims[-2] in axes:
        shared = {"colorbar": True, "title": name}
        return with_options(
            hv.Image(
                (x, labels.coords[dims[-2]][1], values),
                [_axis(labels, dims[-1]), _axis(labels, dims[-2])],
                _axis(labels, name),
            ),
            {"bokeh": {**shared, "frame_width": SIDE // 2}, "matplotlib": {**shared, "aspect": "auto"}},
        )
    curves = [np.column_stack([x, one]) for one in values.reshape(-1, x.size)]
    colour = {"color": theme.ORBIT}
    return with_options(
        hv.Path(curves, [_axis(labels, dims[-1]), _axis(labels, name)]),
        {
            "bokeh": {**colour, "frame_width": SIDE, "frame_height": SIDE // 3},
            "matplotlib": {**colour, "aspect": 3.0},
        },
    )
