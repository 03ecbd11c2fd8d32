"""The layers of a plot: glyphs with a style, a legend entry and a source of data.

A layer is immutable: `data(state)` returns its columns for a state, and nothing here keeps state.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field, replace
from typing import Any, Generic, TypeVar

import numpy as np
from bokeh import palettes

from hess_explorer.views import theme
from hess_mechanics.numerics.results import Array

S = TypeVar("S")
T = TypeVar("T")
U = TypeVar("U")
Range = tuple[float, float]
Columns = Mapping[str, Any]
"""Columns of a source by name: arrays, or lists of arrays and plain values."""
Sources = dict[str, Columns]
"""The columns of sources by name."""
Positions = Sequence[tuple[float, float]]
"""Points (x, y)."""
Regions = Sequence[Sequence[Array]]
"""Filled parts: for each the outer closed curve (n, 2), then the curves of its holes."""


def rectangle(x: Range, y: Range) -> Array:
    """Return the corners (4, 2) of a rectangle."""
    return np.array([[x[0], y[0]], [x[1], y[0]], [x[1], y[1]], [x[0], y[1]]])


@dataclass(frozen=True)
class Axes:
    """The current axes of a plot; while a slider is held they may belong to an earlier state.

    Attributes
    ----------
    x, y : (float, float)
        Ranges of the horizontal and the vertical axis.
    """

    x: Range
    y: Range


@dataclass(frozen=True)
class CellGrid:
    """Numbers at the centres of cells that fill a rectangle.

    Attributes
    ----------
    cells : array (m, n)
        The numbers; each row has one y, the lowest first.  NaN is transparent.
    x, y : (float, float)
        Sides of the rectangle.
    ends : (float, float) or None
        Numbers of the first and the last colour, if they depend on the state; None for those of the layer.
    """

    cells: Array
    x: Range
    y: Range
    ends: Range | None = None


def in_window(
    cells: Callable[[S], Array | None], window: Callable[[S], Sequence[tuple[float, float]]]
) -> Callable[[S], CellGrid | None]:
    """Return a function of the state that returns the grid of cells over a window, or None without cells.

    Parameters
    ----------
    cells : callable
        `cells(state)` returns the numbers (m, n), the lowest row first, or None.
    window : callable
        `window(state)` returns the lower left and the upper right corner of the window.
    """

    def grid(state: S) -> CellGrid | None:
        found = cells(state)
        (x0, y0), (x1, y1) = window(state)
        return None if found is None else CellGrid(found, (x0, x1), (y0, y1))

    return grid


@dataclass(frozen=True)
class Sign:
    """One legend entry.

    Attributes
    ----------
    label : str
        Text of the entry.
    kind : str
        CSS classes of the sign: "line", "dot" or "box", and optionally "small", "diamond", "inverted_triangle" or
        "rho".
    style : str
        CSS style of the sign.
    least : float or None
        For layers of cells: the sign stands for numbers in [least, least + 1); None for all numbers.
    """

    label: str
    kind: str
    style: str
    least: float | None = None


TURNS = Sign("ρ from −½ to ½ (cyclic)", "box rho", f"background: {theme.gradient(theme.TURN_MAP)}")
"""Legend entry of the scale of rotation numbers."""
MOVING_POINT = Sign("moving point", "dot", f"background: {theme.POINT}; border: 1.5px solid")
_QUARTERS = f"{theme.INK} 25%, {theme.PAPER} 0 50%, {theme.INK} 0 75%, {theme.PAPER} 0"
CENTRE_OF_MASS = Sign("centre of mass", "dot", f"background: conic-gradient({_QUARTERS}); border: 1.5px solid")
"""Legend entry of the centre of mass, in the quarters of engineering drawings."""


@dataclass(frozen=True)
class Layer(Generic[S]):
    """One layer of glyphs.

    Attributes
    ----------
    name : str
        Name within the plot; the data source is "<plot>-<name>", or "data-<track>" for a track of the scene.
    glyph : str
        Name of the glyph in Bokeh.
    columns : tuple of str
        Names of the columns with positions.
    style : mapping of str
        Properties of the glyph.
    data : callable or None
        `data(state)` returns the columns; empty for no data.
    data_in_axes : callable or None
        `data_in_axes(state, axes)` returns the columns if they depend on the axes.
    track : str or None
        Name of the track of the scene that the layer draws; None for data of its own.
    is_overlay : bool
        True if the layer changes with every state; it then lies above axes and background, which are not repainted.
    legend : tuple of Sign
        Entries in the legend of the scene.
    tag : str
        Label in the picture, see "tags.py"; empty for none.
    """

    name: str
    glyph: str
    columns: tuple[str, ...]
    style: Mapping[str, Any] = field(default_factory=dict)
    data: Callable[[S], Columns] | None = None
    data_in_axes: Callable[[S, Axes], Columns] | None = None
    track: str | None = None
    is_overlay: bool = True
    legend: tuple[Sign, ...] = ()
    tag: str = ""


Layers = tuple[Layer[S], ...]
Data = Callable[[S], Any] | None
"""The data of a layer as a function of the state."""
AxesData = Callable[[S, Axes], Any] | None
"""The data of a layer as a function of the state and the axes."""


def _words(name: str, size: int, **style: Any) -> Layer[Any]:
    """Return a layer of words, by default centred at their points."""
    look = {"text_color": theme.INK, "text_font_size": f"{size}px", "text_align": "center", "text_baseline": "middle"}
    return Layer(name, "text", ("x", "y", "text"), {**look, **style})


MESSAGE = _words("message", 15)
"""The sentence shown instead of an empty plot."""


def compose(get: Callable[[S], T | None], make: Callable[[T], U]) -> Callable[[S], U | None]:
    """Compose `make` with `get`; None passes through."""

    def of(state: S) -> U | None:
        found = get(state)
        return None if found is None else make(found)

    return of


def crop(points: Positions, window: Positions) -> list[tuple[float, float]]:
    """Return the points within a window, edges included; the window is its lower left and its upper right corner."""
    (x0, y0), (x1, y1) = window
    return [(x, y) for x, y in points if x0 <= x <= x1 and y0 <= y <= y1]


def column(values: Any) -> Array:
    """Return numbers as a contiguous array in double precision; the browser receives single precision."""
    return np.ascontiguousarray(values, dtype=np.float64)


def _positions(columns: Sequence[str], value: Any) -> Columns:
    """Return arrays by column; empty for None."""
    return {} if value is None else {name: column(one) for name, one in zip(columns, value, strict=True)}


def _parts(value: Sequence[Array] | None) -> Columns:
    turned = [column(np.asarray(curve).T) for curve in value or ()]
    return {"xs": [x for x, _ in turned], "ys": [y for _, y in turned]} if turned else {}


def _regions(value: Regions | None) -> Columns:
    found = [_parts(rings) for rings in value or ()]
    return {name: [[part[name]] for part in found] for name in ("xs", "ys")} if found else {}


def _cells(value: CellGrid | None) -> Columns:
    if value is None:
        return {}
    (x0, x1), (y0, y1) = value.x, value.y
    ends = {} if value.ends is None else {"low": [value.ends[0]], "high": [value.ends[1]]}
    return {"image": [column(value.cells)], "x": [x0], "y": [y0], "dw": [x1 - x0], "dh": [y1 - y0], **ends}


def _layer(
    layer: Layer[S],
    convert: Callable[[Any], Columns],
    data: Data[S],
    data_in_axes: AxesData[S] = None,
) -> Layer[S]:
    """Return the layer with its data converted to columns."""
    return replace(
        layer,
        data=None if data is None else lambda state: convert(data(state)),
        data_in_axes=None if data_in_axes is None else lambda state, axes: convert(data_in_axes(state, axes)),
    )


def _signed(label: str, kind: str, style: str) -> tuple[Sign, ...]:
    return (Sign(label, kind, style),) if label else ()


def _stroked(layer: Layer[S], color: str, width: float, dash: str, alpha: float, label: str) -> Layer[S]:
    # CSS has no dash-dot lines.
    sign = f"border-top: {max(2.0, width):g}px {'dashed' if dash == 'dotdash' else dash} {color}"
    return replace(
        layer,
        legend=_signed(label, "line", sign),
        style={"line_color": color, "line_width": width, "line_dash": dash, "line_alpha": alpha},
    )


def line(
    name: str,
    data: Data[S] = None,
    *,
    color: str,
    width: float = 2.0,
    dash: str = "solid",
    label: str = "",
    tag: str = "",
    columns: tuple[str, str] = ("x", "y"),
    track: str | None = None,
    data_in_axes: AxesData[S] = None,
) -> Layer[S]:
    """Return a layer with one curve: `data(state)` returns (x, y) or None; or it draws columns of a track."""
    layer: Layer[S] = Layer(name, "line", columns, track=track, tag=tag)
    return _layer(
        _stroked(layer, color, width, dash, 1.0, label), lambda value: _positions(columns, value), data, data_in_axes
    )


def curves(
    name: str,
    data: Callable[[S], Sequence[Array] | None] | None = None,
    *,
    color: str,
    width: float = 2.0,
    dash: str = "solid",
    alpha: float = 1.0,
    label: str = "",
    tag: str = "",
    is_overlay: bool = True,
    data_in_axes: AxesData[S] = None,
) -> Layer[S]:
    """Return a layer of curves; `data(state)` returns arrays (n, 2), or None."""
    layer: Layer[S] = Layer(name, "multi_line", ("xs", "ys"), is_overlay=is_overlay, tag=tag)
    return _layer(_stroked(layer, color, width, dash, alpha, label), _parts, data, data_in_axes)


def region(
    name: str,
    data: Callable[[S], Regions] | None = None,
    *,
    color: str = theme.FORBIDDEN,
    edge: str | None = None,
    label: str = "",
    tag: str = "",
    is_overlay: bool = False,
    data_in_axes: AxesData[S] = None,
) -> Layer[S]:
    """Return a layer of filled regions; `data(state)` returns `Regions`, empty for none."""
    layer: Layer[S] = Layer(
        name,
        "multi_polygons",
        ("xs", "ys"),
        {"fill_color": color, "line_color": edge},
        is_overlay=is_overlay,
        legend=_signed(label, "box", f"background: {color}"),
        tag=tag,
    )
    return _layer(layer, _regions, data, data_in_axes)


def points(
    name: str,
    data: Data[S] = None,
    *,
    color: str,
    size: float,
    marker: str = "circle",
    hollow: bool = False,
    edge: str | None = None,
    edge_width: float = 1.0,
    alpha: float = 1.0,
    label: str = "",
    tag: str = "",
    columns: tuple[str, ...] = ("x", "y"),
    data_in_axes: AxesData[S] = None,
) -> Layer[S]:
    """Return a layer of markers; `data(state)` returns one array for each of `columns`, or None.

    A third column "angle" rotates the markers, in radians.
    """
    small = size < 10 and not hollow
    shape = [marker] if marker in ("diamond", "inverted_triangle") else []
    look = (
        f"background: none; border: {min(3.0, max(2.0, edge_width)):g}px solid {color}"
        if hollow
        else (f"background: {color}" + (f"; border: 1.5px solid {edge}" if edge else ""))
    )
    layer: Layer[S] = Layer(
        name,
        "scatter",
        columns,
        {
            "marker": marker,
            "size": size,
            "line_width": edge_width,
            "fill_color": color,
            "line_color": edge or color,
            "fill_alpha": 0.0 if hollow else alpha,
            "line_alpha": alpha,
            **({"angle": "angle"} if "angle" in columns else {}),
        },
        legend=_signed(label, " ".join(["dot", *(["small"] if small else []), *shape]), look),
        tag=tag,
    )
    return _layer(layer, lambda value: _positions(columns, value), data, data_in_axes)


def dots(
    name: str,
    data: Data[S] = None,
    *,
    color: str,
    size: float,
    alpha: float = 1.0,
    label: str = "",
    columns: tuple[str, str] = ("x", "y"),
    track: str | None = None,
) -> Layer[S]:
    """Return a layer of thousands of points, drawn by the page itself.

    `data(state)` returns (x, y) or None; without it the layer draws columns of a track.
    """
    layer: Layer[S] = Layer(
        name,
        "dots",
        columns,
        {"size": size, "color": color, "alpha": alpha},
        track=track,
        legend=_signed(label, "dot small", f"background: {color}"),
    )
    return _layer(layer, lambda value: _positions(columns, value), data)


def arrows(
    name: str,
    data: Data[S] = None,
    *,
    color: str,
    size: float = 10.0,
    alpha: float = 1.0,
) -> Layer[S]:
    """Return a layer of triangles along a motion; `data(state)` returns (x, y, angle) or None.

    The angle is in radians, counterclockwise; a triangle with angle 0 points up.
    """
    layer: Layer[S] = points(
        name, data, color=color, size=size, marker="triangle", alpha=alpha, columns=("x", "y", "angle")
    )
    return replace(layer, style={**layer.style, "line_alpha": 0.0})


def ring(
    name: str,
    data: Callable[[S], Positions] | None = None,
    *,
    color: str = theme.UNSTABLE,
    size: float = 16.0,
    width: float = 3.0,
    label: str = "",
    tag: str = "",
    columns: tuple[str, str] = ("x", "y"),
    data_in_axes: AxesData[S] = None,
) -> Layer[S]:
    """Return a layer of rings at points; `data(state)` returns [(x, y), …], empty for none."""
    layer: Layer[S] = points(
        name, color=color, size=size, hollow=True, edge_width=width, label=label, tag=tag, columns=columns
    )
    return _layer(layer, lambda value: _rows(columns, value), data, data_in_axes)


def _rows(columns: Sequence[str], value: Sequence[Sequence[Any]]) -> Columns:
    """Return rows as lists by column; empty without rows."""
    return dict(zip(columns, map(list, zip(*value, strict=True)), strict=False))


def target(
    name: str,
    data: Callable[[S], Positions],
    size: float = 21.0,
    columns: tuple[str, str] = ("x", "y"),
) -> Layers[S]:
    """Return the layers of rings that are visible on any colour, black on white; `data(state)` as for `ring`."""
    return (
        ring(name, data, color="white", size=size, width=6.0, columns=columns),
        ring(f"{name}-too", data, color="black", size=size, width=2.5, columns=columns),
    )


def image(
    name: str,
    data: Callable[[S], CellGrid | None],
    *,
    palette: str | tuple[str, ...],
    low: float,
    high: float,
    smooth: bool = False,
    cyclic: bool = False,
    kinds: bool = False,
    fine: bool = False,
    legend: tuple[Sign, ...] = (),
    tag: str = "",
) -> Layer[S]:
    """Return a layer of coloured cells, below all other layers.

    Parameters
    ----------
    name : str
        Name within the plot.
    data : callable
        `data(state)` returns the cells, or None.
    palette : str or tuple of str
        Name of a palette, or its colours.
    low, high : float
        Numbers of the first and the last colour, unless the cells have `ends`.
    smooth : bool
        True to interpolate between the centres of cells, for continuous functions.
    cyclic : bool
        True to interpolate as for `smooth`, with `low` and `high` identified.
    kinds : bool
        True if numbers are labels, with smooth borders between them.
    fine : bool
        True if cells are about as large as pixels.
    legend : tuple of Sign
        Legend entries.
    tag : str
        Label in the picture.
    """
    colors = getattr(palettes, palette) if isinstance(palette, str) else palette
    layer: Layer[S] = Layer(
        name,
        "image",
        ("image", "x", "y", "dw", "dh"),
        {
            "palette": list(colors),
            "low": low,
            "high": high,
            "smooth": smooth or cyclic,
            "cyclic": cyclic,
            "kinds": kinds,
            "fine": fine,
        },
        is_overlay=False,
        legend=legend,
        tag=tag,
    )
    return _layer(layer, _cells, data)


_PAPER = {"background_fill_color": theme.PAPER, "background_fill_alpha": 0.75}


def levels(name: str, data: Callable[[S], Sequence[float]]) -> Layer[S]:
    """Return a layer of dotted horizontal lines across the frame; `data(state)` returns their heights."""

    def across(state: S, axes: Axes) -> list[Array]:
        low, high = axes.x
        reach = high - low
        return [np.array([[low - reach, y], [high + reach, y]]) for y in data(state)]

    return curves(name, data_in_axes=across, color=theme.MUTED, dash="dotted", width=1.5)


def names(
    name: str,
    data: Callable[[S], Sequence[tuple[float, float, str]]] | None = None,
    *,
    size: int = 16,
    above: int = 0,
    on_paper: bool = False,
    data_in_axes: AxesData[S] = None,
) -> Layer[S]:
    """Return a layer of words; `data(state)` returns [(x, y, word), …].

    A word is centred at its point, or stands `above` pixels above it.
    """
    paper = _PAPER if on_paper else {}
    layer: Layer[S] = _words(name, size, text_baseline="bottom" if above else "middle", y_offset=-above, **paper)
    return _layer(layer, lambda value: _rows(layer.columns, value), data, data_in_axes)


def label(layer: Layer[S]) -> Layer[S]:
    """Return the layer of the label of another layer, in its colour."""
    own = {"line": "line_color", "multi_line": "line_color", "scatter": "fill_color", "dots": "color"}.get(layer.glyph)
    colour = {"text_color": layer.style[own], **_PAPER} if own else {}
    return _words(f"{layer.name}-label", 13, text_font_style="bold", **colour)


def text(name: str, data: Callable[[S], str]) -> Layer[S]:
    """Return a layer with a text in the lower right corner of the frame; `data(state)` returns it, "" for none."""

    def there(state: S, axes: Axes) -> Columns:
        said = data(state)
        return {"x": [axes.x[1]], "y": [axes.y[0]], "text": [said]} if said else {}

    style = {
        "text_color": theme.INK,
        "text_font_size": theme.FONT_SIZE,
        "text_align": "right",
        "x_offset": -6,
        "y_offset": -4,
    }
    return Layer(name, "text", ("x", "y", "text"), style, data_in_axes=there)


POINT: Layer[Any] = replace(
    points("point", color=theme.POINT, edge=theme.INK, edge_width=1.5, size=13.0), legend=(MOVING_POINT,)
)
"""The moving point of a plot."""
