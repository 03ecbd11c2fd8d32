"""Labels in a planar picture: find a free place beside each curve or point with a tag, or inside each region.

The search on a coarse grid of the frame is cheap and needs no text metrics.  All lengths are fractions of the frame,
from its lower left corner.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np

from hess_explorer.views.layers import Axes, Columns, Layer
from hess_explorer.views.tag_kernels import best_label, fill, mark, sample_curve
from hess_mechanics.numerics.results import Array

_CELLS = 48
"""Cells of the grid along each side."""
_LETTER, _LINE = 0.027, 0.068
"""Width of a letter and height of a line in a small frame (270 pixels)."""
_PIXEL = 1.0 / 180.0
"""A pixel of a marker in the smallest frame with labels."""
_GAP = 0.012
"""Distance between a label and its curve or point."""
_SAMPLES = 800
"""Number of points by which a curve or a cloud of dots covers the grid."""
_ANCHORS = 90
"""Largest number of points of a curve next to which a label is tried."""
_FULL = 0.22
"""Largest covered share of a label: beyond it the label would hide too much."""
_PULL = 0.08
"""Weight of the distance from the upper right corner: few labels jump while a slider moves."""
_DOTS = 0.25
"""Weight of a cell with dots: a label may stand in a section where few dots are."""
_CLOSED = 2.0
"""Mark of cells under a label, where no other label goes."""
_EDGE = 0.01
_FRAME = np.ones((_CELLS, _CELLS))
_DIRECTIONS = np.array([(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)], float).T


def label_places(
    layers: Sequence[Layer[Any]], columns: Sequence[Columns], axes: Axes, log: str
) -> Mapping[str, Columns]:
    """Return the columns of the label of each layer with a tag, by the layer's name.

    The columns are empty for a layer without data, and if there is no free place.

    Parameters
    ----------
    layers : sequence of Layer
        The layers of a plot.
    columns : sequence of mappings
        Columns of each layer.
    axes : Axes
        The axes.
    log : str
        Logarithmic axes: "x", "y" or "xy".
    """
    frame = _Frame(axes, log)
    drawn = [
        (layer, given, _points(layer, given, frame))
        for layer, given in zip(layers, columns, strict=True)
        if _there(layer, given)
    ]
    taken = np.zeros((_CELLS, _CELLS))
    for layer, given, points in drawn:
        mark(taken, points, _DOTS if layer.glyph == "dots" else 1.0)
        for place, word in _words(layer, given, frame):
            taken[_box(place, *_half(word))] = 1.0
    found: dict[str, Columns] = {layer.name: {} for layer in layers if layer.tag}
    for layer, given, points in drawn:
        if not layer.tag:
            continue
        half = _half(layer.tag)
        inside = _inside(layer, given, frame)
        cost, covered, *place = (
            best_label(taken, _FRAME, _around(points, half), *half, _EDGE, _PULL)
            if inside is None
            else best_label(taken, inside, _middles(inside), *half, _EDGE, _PULL)
        )
        if cost == math.inf or covered > _FULL:
            continue
        taken[_box(place, *half)] = _CLOSED
        x, y = frame.back(np.array(place))
        found[layer.name] = {"x": [x], "y": [y], "text": [layer.tag]}
    return found


class _Frame:
    """Maps coordinates to fractions of the frame, and back."""

    def __init__(self, axes: Axes, log: str) -> None:
        self._log = [side in log for side in "xy"]
        ends = (np.log10(pair) if log else pair for pair, log in zip((axes.x, axes.y), self._log, strict=True))
        self._low, high = np.array([*ends], float).T
        self._extent = high - self._low

    def to(self, x: Any, y: Any) -> Array:
        """Convert points to fractions (2, n) of the frame: at most `_SAMPLES` of them, all finite."""
        found = np.array([np.asarray(side)[:: len(side) // _SAMPLES + 1] for side in (x, y)], float)
        for i in np.flatnonzero(self._log):
            with np.errstate(divide="ignore", invalid="ignore"):
                found[i] = np.log10(found[i])
        finite = np.isfinite(found[0] + found[1])
        if not finite.all():
            found = found[:, finite]
        return np.asarray((found - self._low[:, None]) / self._extent[:, None])

    def back(self, place: Array) -> list[float]:
        """Return the coordinates of a place (2,)."""
        found = self._low + place * self._extent
        return [float(10.0**one if log else one) for one, log in zip(found, self._log, strict=True)]


def _there(layer: Layer[Any], columns: Columns) -> bool:
    return len(columns.get(layer.columns[0], ())) > 0


def _points(layer: Layer[Any], columns: Columns, frame: _Frame) -> Array:
    """Return the points (2, n) that a layer covers, dense on curves, with the edges of markers.

    It is empty for regions, cells and words.
    """
    given = [columns[name] for name in layer.columns]
    if layer.glyph in ("image", "multi_polygons", "text"):
        return np.empty((2, 0))
    if layer.glyph == "multi_line":
        lines = [_dense(frame.to(x, y), _SAMPLES // len(given[0])) for x, y in zip(*given, strict=True)]
        return np.concatenate(lines, axis=1)
    points = frame.to(*given[:2])
    if layer.glyph == "scatter":
        reach = 0.5 * _PIXEL * layer.style["size"]
        return np.concatenate([points, *(points + reach * side[:, None] for side in _DIRECTIONS.T)], axis=1)
    return _dense(points, _SAMPLES) if layer.glyph == "line" else points


def _words(layer: Layer[Any], columns: Columns, frame: _Frame) -> Iterable[tuple[Array, str]]:
    """Return the words of a layer, each with its place (2,)."""
    if layer.glyph != "text":
        return ()
    x, y, words = (columns[name] for name in layer.columns)
    return ((place, word) for place, word in zip(frame.to(x, y).T, words, strict=False) if word)


def _dense(curve: Array, least: int) -> Array:
    """Interpolate a curve to at least 50 points, evenly along its index."""
    points: Array = curve if curve.shape[1] < 2 else sample_curve(*curve, max(50, least))
    return points


def _half(word: str) -> tuple[float, float]:
    """Return half the width and height of a word."""
    return 0.5 * _LETTER * len(word), 0.5 * _LINE


def _around(points: Array, half: tuple[float, float]) -> Array:
    """Return the places (2, n) of a label in eight directions from at most `_ANCHORS` of the points in the frame."""
    (x, y), (width, height) = points, half
    seen = np.flatnonzero((x >= 0.0) & (x <= 1.0) & (y >= 0.0) & (y <= 1.0))
    anchors = points[:, seen[:: seen.size // _ANCHORS + 1]]
    apart = _DIRECTIONS * [[width + _GAP], [height + _GAP]]
    return np.asarray((anchors[:, :, None] + apart[:, None]).reshape(2, -1))


def _middles(region: Array) -> Array:
    """Return the middles (2, n) of the cells of a region."""
    return np.asarray((np.argwhere(region).T[::-1] + 0.5) / _CELLS)


def _box(place: Sequence[float] | Array, *half: float) -> tuple[slice, slice]:
    """Return the cells [row, column] of a box."""
    (x0, x1), (y0, y1) = (
        (max(0, math.floor((at - side) * _CELLS)), max(0, math.ceil((at + side) * _CELLS)))
        for at, side in zip(place, half, strict=True)
    )
    return slice(y0, y1), slice(x0, x1)


def _inside(layer: Layer[Any], columns: Columns, frame: _Frame) -> Array | None:
    """Return 1 in the cells [row, column] of a region or of the first kind of an image; None for other layers."""
    if layer.glyph == "image":
        (cells,), middles = columns["image"], (np.arange(_CELLS) + 0.5) / _CELLS
        x, y = (columns[name][0] for name in ("x", "y"))
        low, high = frame.to([x, x + columns["dw"][0]], [y, y + columns["dh"][0]]).T
        at = [np.floor((middles - low[i]) / (high[i] - low[i]) * cells.shape[1 - i]).astype(int) for i in range(2)]
        there = [(one >= 0) & (one < cells.shape[1 - i]) for i, one in enumerate(at)]
        kinds = cells[np.ix_(*(np.clip(at[i], 0, cells.shape[1 - i] - 1) for i in (1, 0)))]
        least = layer.legend[0].least or 0.0
        return np.asarray((kinds >= least) & (kinds < least + 1.0) & there[1][:, None] & there[0], float)
    if layer.glyph != "multi_polygons":
        return None
    found = np.zeros((_CELLS, _CELLS))
    for x, y in zip(columns["xs"], columns["ys"], strict=True):
        part = np.zeros((_CELLS, _CELLS))
        for ring in zip(x[0], y[0], strict=True):
            fill(part, frame.to(*ring))
        found = np.maximum(found, part)
    return found
