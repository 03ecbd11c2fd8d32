"""Labels in a planar picture: a free place beside each curve or point, or inside each region, that carries a tag.

Places are found on a coarse grid of the frame, so they cost little and need no text metrics.  All
lengths are fractions of the frame, from its lower left corner.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hess_explorer.views.layers import Axes, Columns, Layer
from hess_mechanics.numerics.results import Array

__all__ = ["placed"]

_CELLS = 48
"""Cells of the grid along each side."""
_LETTER, _LINE = 0.027, 0.068
"""Width of a letter and height of a line in a small frame (270 pixels)."""
_GAP = 0.012
"""Distance between a label and what it names."""
_SAMPLES = 800
"""Points by which a curve or a cloud of dots covers the grid."""
_ANCHORS = 90
"""Points of a curve that are tried."""
_FULL = 0.22
"""A label would hide too much if what is drawn covers this part of it."""
_PULL = 0.08
"""Weight of the distance from the upper right corner: few labels jump while a slider moves."""
_DOTS = 0.25
"""Weight of a cell with dots: a label may stand in a section where few dots are."""
_CLOSED = 2.0
"""Mark of cells under a label, where no other label goes."""
_AROUND = np.array([(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)]).T
_EDGE = 0.01


def placed(layers: Sequence[Layer[Any]], columns: Sequence[Columns], axes: Axes, log: str) -> Mapping[str, Columns]:
    """Return the columns of the label of each layer with a tag, by the layer's name; empty without a free place.

    columns : those of each layer; log : the logarithmic axes.
    """
    frame = _Frame(axes, log)
    drawn = [
        (layer, given, _curves(layer, given, frame))
        for layer, given in zip(layers, columns, strict=True)
        if _there(layer, given)
    ]
    taken = np.zeros((_CELLS, _CELLS))
    for layer, given, curves in drawn:
        if curves:
            _mark(taken, np.concatenate(curves, axis=1), _DOTS if layer.glyph == "dots" else 1.0)
        for place, word in _words(layer, given, frame):
            taken[_box(place, _half(word))] = 1.0
    found: dict[str, Columns] = {layer.name: {} for layer in layers if layer.tag}
    for layer, given, curves in drawn:
        if not layer.tag:
            continue
        half = _half(layer.tag)
        inside = _inside(layer, given, frame)
        places = _around(curves, half) if inside is None else _middles(inside, half)
        places = places[:, _within(abs(places - 0.5) + half <= 0.5 - _EDGE)]
        if places.size == 0:
            continue
        covered = _mean(taken, places, half)
        best = np.argmin(covered + _PULL * np.hypot(*(1.0 - places)))
        if covered[best] > _FULL:
            continue
        place = places[:, best]
        taken[_box(place, half)] = _CLOSED
        x, y = frame.back(place)
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
        """Return at most `_SAMPLES` of the points (2, n) in the frame, without those that have no logarithm."""
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


def _within(there: NDArray[np.bool_]) -> NDArray[np.bool_]:
    """Return where both rows are true."""
    return np.asarray(there[0] & there[1])


def _curves(layer: Layer[Any], columns: Columns, frame: _Frame) -> list[Array]:
    """Return the points (2, n) that a layer covers, close together on curves; none for regions, cells and words."""
    given = [columns[name] for name in layer.columns]
    if layer.glyph in ("image", "multi_polygons", "text"):
        return []
    if layer.glyph == "multi_line":
        return [_dense(frame.to(x, y), _SAMPLES // len(given[0])) for x, y in zip(*given, strict=True)]
    if layer.glyph == "segment":
        return [_dense(frame.to(ends[::2], ends[1::2]), 100) for ends in zip(*given, strict=True)]
    points = frame.to(*given[:2])
    return [_dense(points, _SAMPLES) if layer.glyph == "line" else points]


def _words(layer: Layer[Any], columns: Columns, frame: _Frame) -> Iterable[tuple[Array, str]]:
    """Return the words of a layer, each with its place (2,)."""
    if layer.glyph != "text":
        return ()
    x, y, words = (columns[name] for name in layer.columns)
    return ((place, word) for place, word in zip(frame.to(x, y).T, words, strict=False) if word)


def _dense(curve: Array, least: int) -> Array:
    """Return points evenly along the index of a curve, at least 50."""
    count = curve.shape[1]
    if count < 2:
        return curve
    at, index = np.linspace(0.0, count - 1.0, max(50, least)), np.arange(count)
    return np.array([np.interp(at, index, side) for side in curve])


def _half(word: str) -> Array:
    """Return half the width and height of a word, (2, 1)."""
    return np.array([[0.5 * _LETTER * len(word)], [0.5 * _LINE]])


def _box(place: Array, half: Array) -> tuple[slice, slice]:
    """Return the cells [row, column] of a box."""
    (x0, x1), (y0, y1) = (
        (max(0, math.floor((at - side) * _CELLS)), max(0, math.ceil((at + side) * _CELLS)))
        for at, side in zip(place, half[:, 0], strict=True)
    )
    return slice(y0, y1), slice(x0, x1)


def _mark(taken: Array, points: Array, how: float = 1.0) -> None:
    """Mark the cells [row, column] of some points."""
    column, row = (points[:, _within((points >= 0.0) & (points < 1.0))] * _CELLS).astype(int)
    taken[row, column] = how


def _mean(cells: Array, places: Array, half: Array) -> Array:
    """Return the mean of the cells in a box about each place (n,)."""
    total = np.zeros((_CELLS + 1, _CELLS + 1))
    cells.cumsum(0).cumsum(1, out=total[1:, 1:])
    ends = np.rint(np.array([places - half, places + half]) * _CELLS).astype(int)
    (x0, y0), (x1, y1) = np.maximum(0, np.minimum(_CELLS, ends))
    area = np.maximum(1, (x1 - x0) * (y1 - y0))
    return np.asarray((total[y1, x1] - total[y0, x1] - total[y1, x0] + total[y0, x0]) / area)


def _around(curves: Sequence[Array], half: Array) -> Array:
    """Return the middles of labels in eight directions from points of some curves (2, n)."""
    points = np.concatenate(curves, axis=1)
    points = points[:, _within((points >= 0.0) & (points <= 1.0))]
    points = points[:, :: points.shape[1] // _ANCHORS + 1]
    return (points[:, :, None] + (_AROUND * (half + _GAP))[:, None]).reshape(2, -1)


def _middles(inside: Array, half: Array) -> Array:
    """Return the cells whose label lies inside a mask [row, column]."""
    row, column = np.nonzero(inside)
    places = (np.array([column, row]) + 0.5) / _CELLS
    return places[:, _mean(inside.astype(float), places, half) > 0.999]


def _inside(layer: Layer[Any], columns: Columns, frame: _Frame) -> Array | None:
    """Return which cells [row, column] a region or the first kind of an image fills; None for other layers."""
    if layer.glyph == "image":
        (cells,), middles = columns["image"], (np.arange(_CELLS) + 0.5) / _CELLS
        x, y = (columns[name][0] for name in ("x", "y"))
        low, high = frame.to([x, x + columns["dw"][0]], [y, y + columns["dh"][0]]).T
        at = [np.floor((middles - low[i]) / (high[i] - low[i]) * cells.shape[1 - i]).astype(int) for i in range(2)]
        there = [(one >= 0) & (one < cells.shape[1 - i]) for i, one in enumerate(at)]
        kinds = cells[np.ix_(*(np.clip(at[i], 0, cells.shape[1 - i] - 1) for i in (1, 0)))]
        least = layer.legend[0].least or 0.0
        return np.asarray((kinds >= least) & (kinds < least + 1.0) & there[1][:, None] & there[0])
    if layer.glyph != "multi_polygons":
        return None
    parts = zip(columns["xs"], columns["ys"], strict=True)
    filled = [
        np.logical_xor.reduce([_even_odd(frame.to(x, y)) for x, y in zip(*rings, strict=True)])
        for rings in ((xs[0], ys[0]) for xs, ys in parts)
    ]
    return np.asarray(np.logical_or.reduce(filled))


def _even_odd(ring: Array) -> Array:
    """Return which cells [row, column] have their middle inside a closed curve (2, n): the crossings left of it."""
    (x0, y0), (x1, y1) = ring, np.concatenate([ring[:, 1:], ring[:, :1]], axis=1)
    heights = (np.arange(_CELLS)[:, None] + 0.5) / _CELLS
    row, edge = np.nonzero((y0 <= heights) != (y1 <= heights))
    x = x0[edge] + (heights[row, 0] - y0[edge]) / (y1[edge] - y0[edge]) * (x1[edge] - x0[edge])
    column = np.clip(np.ceil(x * _CELLS - 0.5), 0, _CELLS).astype(int)
    crossings = np.bincount(row * (_CELLS + 1) + column, minlength=_CELLS * (_CELLS + 1)).reshape(_CELLS, -1)
    return np.asarray(np.cumsum(crossings, axis=1)[:, :-1] % 2 == 1)
