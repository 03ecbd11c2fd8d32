"""The data of a picture as CSV, one row for each number that is drawn, or as JSON, layer by layer."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from hess_explorer.export.shown import Shown
from hess_explorer.views.layers import Columns
from hess_explorer.views.plot import Plot

__all__ = ["as_csv", "as_json", "rows"]

_FIRST = ("layer", "part", "ring")
Row = dict[str, Any]


def rows(shown: Shown) -> list[Row]:
    """One row for each point of each layer, in double precision: "layer", and its coordinates by name.

    Curves of several parts, and areas, number them in "part", and the curves that bound an area in "ring", 0 the outer
    one; a grid has the value at the centre (x, y) of each cell.
    """
    return [row for layer, columns in _layers(shown).items() for row in _rows_of(layer, columns)]


def as_csv(shown: Shown) -> str:
    """A table with the facts as # comments above it; a field is empty where a layer has no such coordinate."""
    table = rows(shown)
    names = list(dict.fromkeys([name for name in _FIRST if any(name in row for row in table)]
                               + [name for row in table for name in row]))
    out = io.StringIO()
    for key, value in {**shown.facts, **_axes(shown), **_besides(shown)}.items():
        out.write(f"# {key}: {json.dumps(value, ensure_ascii=False, allow_nan=False)}\n")
    writer = csv.DictWriter(out, names or ["layer"], restval="", lineterminator="\n")
    writer.writeheader()
    writer.writerows({key: _field(value) for key, value in row.items()} for row in table)
    return out.getvalue()


def as_json(shown: Shown) -> str:
    """The facts, the axes, and the columns of each layer by name; null stands for what is no number."""
    layers = {layer: {name: _plain(column) for name, column in columns.items()}
              for layer, columns in _layers(shown).items()}
    return json.dumps({**shown.facts, **_axes(shown), "layers": layers}, ensure_ascii=False, allow_nan=False) + "\n"


def _layers(shown: Shown) -> dict[str, Columns]:
    """The columns by layer: "plot-layer" → "layer", a track of the scene by its name; clouds at the link's time."""
    found: dict[str, Columns] = {}
    own = f"{shown.picture.name}-"
    for source, columns in sorted(shown.columns.items()):
        layer = source.removeprefix(own).removeprefix("data-")
        if "frames0" in columns:
            found |= {f"{layer}-{name}": cloud for name, cloud in _clouds(columns, shown.client["t"]).items()}
        # Only of a plot are lists columns: elsewhere they are vectors, names and the like.
        is_short = _is_list if isinstance(shown.picture, Plot) and source.startswith(own) else _never
        found[layer] = {name: np.array(column) if is_short(column) else column for name, column in columns.items()
                        if name not in _FRAMES or "frames0" not in columns}
    return found


_FRAMES = ("frames0", "frames1", "signs0", "times")


def _is_list(column: Any) -> bool:
    return isinstance(column, list) and all(isinstance(one, (int, float, str)) for one in column)


def _never(column: Any) -> bool:
    return False


def _clouds(columns: Columns, time: float) -> dict[str, Columns]:
    """The points at the frame next to a time: u along the line of equilibria, ln|s|, the sign of s, γ; or ω and γ."""
    frame = int(np.argmin(np.abs(columns["times"] - time)))
    at = float(columns["times"][frame])

    def there(name: str, names: tuple[str, ...]) -> Columns:
        block = columns[name].reshape(len(columns["times"]), len(names), -1)[frame]
        return {"t": np.full(block.shape[1], at), **dict(zip(names, block, strict=True))}

    gamma = ("g1", "g2", "g3")
    found: dict[str, Columns] = {"cloud": {**there("frames0", ("u", "log_s", *gamma)), "sign": columns["signs0"]}}
    if "frames1" in columns:
        found["beside"] = there("frames1", ("omega1", "omega2", *gamma))
    return found


def _axes(shown: Shown) -> dict[str, Any]:
    if shown.axes is None or not isinstance(shown.picture, Plot):
        return {}
    names = shown.picture.axes if isinstance(shown.picture.axes, tuple) else shown.picture.axes(shown.state)
    return {"axes": {"x": [names[0], *map(float, shown.axes.x)], "y": [names[1], *map(float, shown.axes.y)]}}


def _rows_of(layer: str, columns: Columns) -> Iterator[Row]:
    if "image" in columns:
        yield from _cells(layer, columns)
    elif "xs" in columns:
        for part, (xs, ys) in enumerate(zip(columns["xs"], columns["ys"], strict=True)):
            # An area is a list of parts, each of an outer curve and holes.
            rings = [(None, xs, ys)] if isinstance(xs, np.ndarray) else [
                (ring, x, y) for ring, (x, y) in enumerate(zip(xs[0], ys[0], strict=True))]
            for ring, x, y in rings:
                number = {} if ring is None else {"ring": ring}
                yield from ({"layer": layer, "part": part, **number, "x": a, "y": b} for a, b in zip(x, y, strict=True))
    else:
        for names in _together(columns):
            for numbers in zip(*(columns[name] for name in names), strict=True):
                yield {"layer": layer, **dict(zip(names, numbers, strict=True))}


def _cells(layer: str, columns: Columns) -> Iterator[Row]:
    for cells, x, y, width, height in zip(*(columns[name] for name in ("image", "x", "y", "dw", "dh")), strict=True):
        m, n = cells.shape
        for i, row in enumerate(cells):
            for j, value in enumerate(row):
                yield {"layer": layer, "x": x + (j + 0.5) * width / n, "y": y + (i + 0.5) * height / m, "value": value}


def _together(columns: Columns) -> list[list[str]]:
    """The names of columns of one length each."""
    lengths: dict[int, list[str]] = {}
    for name, column in columns.items():
        if _is_column(column):
            lengths.setdefault(len(column), []).append(name)
    return [names for length, names in lengths.items() if length]


def _is_column(column: Any) -> bool:
    return isinstance(column, np.ndarray) and column.ndim == 1


def _besides(shown: Shown) -> dict[str, Any]:
    """What of the columns is no table: circles, marks, axes of a body."""
    return {f"{layer}.{name}": _plain(column) for layer, columns in _layers(shown).items()
            for name, column in columns.items()
            if name not in ("xs", "ys", "image", "x", "y", "dw", "dh") and not _is_column(column)}


def _field(value: Any) -> str:
    if isinstance(value, (str, int, np.integer)):
        return str(value)
    return repr(float(value)) if math.isfinite(value) else ""


def _plain(value: Any) -> Any:
    if isinstance(value, np.ndarray):
        return _plain(value.tolist())
    if isinstance(value, Mapping):
        return {name: _plain(part) for name, part in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(part) for part in value]
    if isinstance(value, (np.floating, float)):
        return float(value) if math.isfinite(value) else None
    return value
