"""A plot as HoloViews elements, for notebooks, figures and films, in either backend.

They look as on the page, because a layer names its style by properties of Bokeh glyphs.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import holoviews as hv
import numpy as np

from hess_explorer.views.layers import Axes, Columns, Layer

if TYPE_CHECKING:
    from hess_explorer.views.plot import Plot

Colour = Callable[[str], str]
"""Maps a colour of the light page to the colour to use."""
Style = Mapping[str, Any]
Options = dict[str, Any]

SIDE = 420
"""Size of a picture in a notebook, in pixels."""
_PAPER = 0.6
"""Points per pixel of the page for lines and markers."""
_TYPE = 0.75
"""Points per pixel of the page for the offset of labels."""
_AXES, _LABEL = 45.0, 0.038
"""Points of the width outside the frame; largest font size of a label as a share of the frame, see "tags.py"."""
_DOT = 0.6
"""Scale of dots in figures, smaller than on the page as no pixels need filling."""
_MOST_VECTORS = 5000
"""Larger numbers of markers are rasterized in vector files, which would otherwise open slowly."""
_MARKERS = {"circle": "o", "triangle": "^", "inverted_triangle": "v", "diamond": "D", "square": "s"}
_DASHES: Mapping[str, Any] = {"solid": "-", "dashed": (0, (6, 3)), "dotted": (0, (2, 4)), "dotdash": (0, (2, 4, 6, 4))}


def unchanged(colour: str) -> str:
    """Return the colour unchanged."""
    return colour


def overlay(
    plot: Plot[Any],
    columns: Mapping[str, Columns],
    axes: Axes,
    names: tuple[str, str],
    title: str = "",
    colour: Colour = unchanged,
) -> hv.Overlay:
    """Return a plot as an overlay of HoloViews elements, one per layer with data, with options for all loaded backends.

    Parameters
    ----------
    plot : Plot
        The plot.
    columns : mapping of str to mapping
        Columns by data source; layers without columns are omitted.
    axes : Axes
        Ranges of the axes.
    names : tuple of str
        Names of the axes.
    title : str
        Title above the plot.
    colour : callable
        Maps the colours of the page.
    """
    # Draw the cells below all other layers.
    layers = sorted(plot.all_layers, key=lambda layer: layer.glyph != "image")
    drawn = [
        _element(layer, columns[plot.source_of(layer)], colour)
        for layer in layers
        if len(columns.get(plot.source_of(layer), {}).get(layer.columns[0], ()))
    ]
    found = hv.Overlay(drawn or [hv.Curve([])])
    shared = {**_frame(plot, axes, names), "title": title, "show_legend": False}
    return with_options(
        found,
        {
            "bokeh": {**shared, "frame_width": SIDE, "frame_height": SIDE, "fontsize": {"labels": 13}},
            "matplotlib": {**shared, "show_frame": True, "aspect": "auto", "hooks": [_finish]},
        },
    )


def _frame(plot: Plot[Any], axes: Axes, names: tuple[str, str]) -> Options:
    """Return the options for ranges, names, scales and ticks of the axes."""
    places = zip(("xticks", "yticks"), plot.axis_ticks, strict=True)
    return {
        "xlim": axes.x,
        "ylim": axes.y,
        "xlabel": names[0],
        "ylabel": names[1],
        "logx": "x" in plot.log,
        "logy": "y" in plot.log,
        **{name: [*ticks] for name, ticks in places if ticks is not None},
    }


def matplotlib_style(layer: Layer[Any], colour: Colour) -> Options:
    """Return the style of a layer as Matplotlib options."""
    return _KINDS[layer.glyph].matplotlib(_with_colours(layer.style, colour))


def _with_colours(style: Style, colour: Colour) -> Options:
    """Return the style with mapped colours, except colours that encode numbers."""
    found = {name: colour(value) if name.endswith("color") else value for name, value in style.items()}
    return {**found, "palette": [*map(colour, style["palette"])]} if style.get("kinds") or style.get("fine") else found


def _element(layer: Layer[Any], columns: Columns, colour: Colour) -> hv.Element:
    kind = _KINDS[layer.glyph]
    element = kind.element(layer.name.replace("-", " "), *(columns[name] for name in layer.columns))
    # The range of the colour scale may depend on the state.
    ends = {name: columns[name][0] for name in ("low", "high") if layer.glyph == "image" and name in columns}
    style = _with_colours({**layer.style, **ends}, colour)
    hooks = {} if kind.hook is None else {"hooks": [kind.hook(style)]}
    return with_options(element, {"bokeh": kind.bokeh(style), "matplotlib": {**kind.matplotlib(style), **hooks}})


def with_options(element: Any, options: Mapping[str, Options]) -> Any:
    """Return an element with the options of each loaded backend; options of other backends are ignored."""
    # HoloViews rejects options of a backend that is not loaded.
    for backend in set(options) & set(hv.Store.loaded_backends()):
        element = element.opts(getattr(hv.opts, type(element).__name__)(backend=backend, **options[backend]))
    return element


def _curve(label: str, x: Any, y: Any) -> hv.Element:
    return hv.Curve((np.asarray(x, float), np.asarray(y, float)), label=label)


def _curves(label: str, xs: Sequence[Any], ys: Sequence[Any]) -> hv.Element:
    return hv.Path([np.column_stack(part) for part in zip(xs, ys, strict=True)], label=label)


def _areas(label: str, xs: Sequence[Any], ys: Sequence[Any]) -> hv.Element:
    rings = [[np.column_stack(ring) for ring in zip(x[0], y[0], strict=True)] for x, y in zip(xs, ys, strict=True)]
    return hv.Polygons([{("x", "y"): outer, "holes": [holes]} for outer, *holes in rings], label=label)


def _points(label: str, *columns: Any) -> hv.Element:
    numbers = tuple(np.asarray(one, float) for one in columns)
    return hv.Points(numbers, vdims=["angle"][: len(columns) - 2], label=label)


def _cells(label: str, image: Any, x: Any, y: Any, dw: Any, dh: Any) -> hv.Element:
    return hv.Image(image[0][::-1], bounds=(x[0], y[0], x[0] + dw[0], y[0] + dh[0]), vdims="value", label=label)


def _labels(label: str, x: Any, y: Any, text: Any) -> hv.Element:
    return hv.Labels((np.asarray(x, float), np.asarray(y, float), list(text)), vdims="text", label=label)


def _stroke(style: Style) -> Options:
    return {
        "color": style["line_color"],
        "linewidth": _PAPER * style["line_width"],
        "linestyle": _DASHES[style["line_dash"]],
        "alpha": style["line_alpha"],
    }


def _area(style: Style) -> Options:
    # Without an explicit colour, the colour of HoloViews' cycle would win.
    return {
        "color": None,
        "facecolor": style["fill_color"],
        "edgecolor": style["line_color"] or "none",
        "linewidth": 0.6,
    }


def _rotation(style: Style) -> Options:
    return {**style, "angle": hv.dim("angle") * (180.0 / math.pi)} if "angle" in style else dict(style)


def _marker(style: Style) -> Options:
    filled, edged = style.get("fill_alpha", 1.0), style.get("line_alpha", 1.0)
    return {
        "s": (_PAPER * style["size"]) ** 2,
        "marker": _MARKERS[style.get("marker", "circle")],
        "linewidth": _PAPER * style["line_width"],
        "alpha": max(filled, edged),
        "facecolors": style["fill_color"] if filled else "none",
        "edgecolors": style["line_color"] if edged else "none",
    }


def _small(style: Style) -> Options:
    return {**style, "size": _DOT * style["size"]}


def _dot(style: Style) -> Options:
    return {"s": (_TYPE * _DOT * style["size"]) ** 2, "color": style["color"], "alpha": style["alpha"], "linewidth": 0}


def _scale(style: Style) -> Options:
    return {"cmap": style["palette"], "clim": (style["low"], style["high"]), "clipping_colors": {"NaN": "#00000000"}}


def _interpolation(style: Style) -> Options:
    # Do not interpolate cyclic numbers: −½ and ½ would give 0.
    even = style["smooth"] and not style["cyclic"]
    kept = "antialiased" if style["fine"] else "nearest"
    return {**_scale(style), "interpolation": "bilinear" if even else kept}


def _word(style: Style) -> Options:
    # A plot of HoloViews cannot hold a text without axes values.
    left_out = ("x_offset", "y_offset", "background_fill_color", "background_fill_alpha")
    return {name: value for name, value in style.items() if name not in left_out}


def _letters(style: Style) -> Options:
    upright = {"middle": "center"}.get(style.get("text_baseline", "bottom"), "bottom")
    return {
        "color": style["text_color"],
        "size": "medium",
        "weight": "bold" if style.get("text_font_style") == "bold" else "normal",
        "horizontalalignment": style["text_align"],
        "verticalalignment": upright,
    }


def _finish(plot: Any, element: hv.Overlay) -> None:
    """Make the frame square, draw it above all layers, fit labels to it, and hide those with anchors outside."""
    axis = plot.handles["axis"]
    # HoloViews computes the aspect from the axis values, even if only one axis is logarithmic.
    axis.set_box_aspect(1.0)
    for spine in axis.spines.values():
        spine.set_zorder(len(element))
    largest = _LABEL * (72.0 * plot.handles["fig"].get_figwidth() - _AXES)
    for text in axis.texts:
        if text.get_fontweight() == "bold":
            text.set_fontsize(min(text.get_fontsize(), largest))
        (x0, x1), (y0, y1), (x, y) = axis.get_xlim(), axis.get_ylim(), text.get_position()
        text.set(visible=x0 <= x <= x1 and y0 <= y <= y1, in_layout=False)
        # Matplotlib ships no bold font with 𝒟.
        if "𝒟" in text.get_text():
            text.set_fontweight("normal")


Hook = Callable[[Any, Any], None]


def _pixels(style: Style) -> Hook:
    """Return a hook that rotates markers and rasterizes large numbers of them."""

    def hook(plot: Any, element: hv.Points) -> None:
        from matplotlib.transforms import Affine2D

        artist = plot.handles["artist"]
        artist.set_rasterized(len(element) > _MOST_VECTORS)
        if element.vdims:
            (path,) = artist.get_paths()
            artist.set_paths([path.transformed(Affine2D().rotate(angle)) for angle in element["angle"]])

    return hook


def _shift(style: Style) -> Hook:
    """Return a hook that shifts words away from their anchors, on a paper-coloured background."""

    def hook(plot: Any, element: hv.Labels) -> None:
        from matplotlib.transforms import ScaledTranslation

        x, y = _TYPE * style.get("x_offset", 0.0), -_TYPE * style.get("y_offset", 0.0)
        by = ScaledTranslation(x / 72.0, y / 72.0, plot.handles["fig"].dpi_scale_trans)
        for text in plot.handles["artist"]:
            text.set_transform(text.get_transform() + by)
            if "background_fill_color" in style:
                paper = {"facecolor": style["background_fill_color"], "alpha": style["background_fill_alpha"]}
                text.set_bbox({**paper, "linewidth": 0.0, "pad": 0.5})

    return hook


class _Kind(NamedTuple):
    """Functions from a layer's columns to an element, and from its style to the options of each backend."""

    element: Callable[..., hv.Element]
    bokeh: Callable[[Style], Options]
    matplotlib: Callable[[Style], Options]
    hook: Callable[[Style], Hook] | None = None


_KINDS: Mapping[str, _Kind] = {
    "line": _Kind(_curve, dict, _stroke),
    "multi_line": _Kind(_curves, dict, _stroke),
    "multi_polygons": _Kind(_areas, dict, _area),
    "scatter": _Kind(_points, _rotation, _marker, _pixels),
    "dots": _Kind(_points, _small, _dot, _pixels),
    "image": _Kind(_cells, _scale, _interpolation),
    "text": _Kind(_labels, _word, _letters, _shift),
}
"""Kinds by the glyph of a layer."""
