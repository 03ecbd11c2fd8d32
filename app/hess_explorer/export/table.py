"""Write the data of a picture as CSV, with one row for each point, or as JSON, by layer."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Iterator, Mapping, Sequence
from itertools import repeat
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hess_explorer.export.picture_data import PictureData
from hess_explorer.views.layers import Columns, Sources
from hess_explorer.views.plot import Plot
from hess_mechanics.numerics.results import turning

__all__ = ["ANGLES", "Block", "angles_of", "as_csv", "as_json", "blocks", "names_of"]

ANGLES = ("phi", "phi_start", "theta", "psi", "delta", "l", "φ", "θ", "θ⁻", "θ⁺", "ψ", "δ", "Θ(φ)")
"""Names of columns and axes that are angles, in radians."""

_FIRST = ("layer", "part", "ring")
_GRID = ("image", "x", "y", "dw", "dh")
_WIDEST = 2.001 * math.pi
Block = Mapping[str, NDArray[Any]]
"""Columns of equal length by name; the first is "layer"."""


def blocks(data: PictureData) -> list[Block]:
    """Return the points of all layers in double precision.

    A block has the column "layer" and coordinates by name.  "part" is the index of a part of a curve or an area, and
    "ring" that of a boundary curve of an area, 0 for the outer one.  A grid has a value at the centre (x, y) of each
    cell.
    """
    return [
        {"layer": np.full(len(next(iter(block.values()))), layer), **block}
        for layer, columns in _layers(data).items()
        for block in _blocks_of(columns)
    ]


def names_of(found: Sequence[Block]) -> list[str]:
    """Return the names of the columns: "layer", then the indices of parts, then coordinates."""
    known = dict.fromkeys(name for block in found for name in block)
    return list(dict.fromkeys(["layer", *(name for name in _FIRST if name in known), *known]))


def as_csv(data: PictureData) -> str:
    """Return the CSV text, with the metadata as # comments; a field is empty if the layer lacks the coordinate."""
    found = blocks(data)
    names = names_of(found)
    out = io.StringIO()
    for key, value in {**data.facts, **_axes(data), **angles_of(data), **_besides(data)}.items():
        out.write(f"# {key}: {json.dumps(value, ensure_ascii=False, allow_nan=False)}\n")
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(names)
    for block in found:
        fields = {name: [_field(value) for value in column.tolist()] for name, column in block.items()}
        writer.writerows(zip(*(fields.get(name, repeat("")) for name in names), strict=False))
    return out.getvalue()


def as_json(data: PictureData) -> str:
    """Return the JSON text: metadata, axes, and the columns of each layer; null stands for a non-finite number."""
    layers = {
        layer: {name: _plain(column) for name, column in columns.items()} for layer, columns in _layers(data).items()
    }
    facts = {**data.facts, **_axes(data), **angles_of(data)}
    return json.dumps({**facts, "layers": layers}, ensure_ascii=False, allow_nan=False) + "\n"


def angles_of(data: PictureData) -> dict[str, dict[str, str]]:
    """Return the fact "angles": whether each column of angles, "layer.name", counts on over full turns."""
    axes = dict(zip("xy", data.picture.names(data.state), strict=True)) if isinstance(data.picture, Plot) else {}
    angles = {*ANGLES, *getattr(type(data.state), "angles", ())}
    found: dict[str, bool] = {}
    for layer, columns in _layers(data).items():
        # A track is a motion, sampled densely: it jumps only where it starts a turn again.
        is_track = f"data-{layer}" in data.columns
        for block in _blocks_of(columns):
            for name, column in block.items():
                known = column[np.isfinite(column)] if axes.get(name, name) in angles else np.empty(0)
                if known.size:
                    key, jumps = f"{layer}.{name}", np.abs(np.diff(known)).max(initial=0.0) > math.pi
                    wide = np.ptp(known) > _WIDEST
                    found[key] = found.get(key, False) or bool(wide or (is_track and not jumps))
    return {"angles": {key: turning(counts) for key, counts in found.items()}} if found else {}


def _layers(data: PictureData) -> Sources:
    """Return the columns by layer ("plot-layer" → "layer") or by track; clouds are at the time of the link."""
    found: Sources = {}
    own = f"{data.picture.name}-"
    for source, columns in sorted(data.columns.items()):
        layer = source.removeprefix(own).removeprefix("data-")
        # Labels belong to the look of a picture, not to its numbers.
        if layer.endswith("-label"):
            continue
        if "frames0" in columns:
            found |= {f"{layer}-{name}": cloud for name, cloud in _clouds(columns, data.client["t"]).items()}
        # Lists are columns only in plots; elsewhere they are vectors or names.
        is_short = _is_list if isinstance(data.picture, Plot) and source.startswith(own) else _never
        found[layer] = {
            name: np.array(column) if is_short(column) else column
            for name, column in columns.items()
            if name not in _FRAMES or "frames0" not in columns
        }
    return found


_FRAMES = ("frames0", "frames1", "signs0", "times")


def _is_list(column: Any) -> bool:
    return isinstance(column, list) and all(isinstance(one, (int, float, str)) for one in column)


def _never(column: Any) -> bool:
    return False


def _clouds(columns: Columns, time: float) -> Sources:
    """Return the points of the frame nearest to a time: u along the equilibria, ln|s|, sign of s, γ; or ω, γ."""
    frame = int(np.argmin(np.abs(columns["times"] - time)))
    at = float(columns["times"][frame])

    def there(name: str, names: tuple[str, ...]) -> Columns:
        block = columns[name].reshape(len(columns["times"]), len(names), -1)[frame]
        return {"t": np.full(block.shape[1], at), **dict(zip(names, block, strict=True))}

    gamma = ("g1", "g2", "g3")
    found: Sources = {"cloud": {**there("frames0", ("u", "log_s", *gamma)), "sign": columns["signs0"]}}
    if "frames1" in columns:
        found["beside"] = there("frames1", ("omega1", "omega2", *gamma))
    return found


def _axes(data: PictureData) -> dict[str, Any]:
    if data.axes is None or not isinstance(data.picture, Plot):
        return {}
    names = data.picture.names(data.state)
    return {"axes": {"x": [names[0], *map(float, data.axes.x)], "y": [names[1], *map(float, data.axes.y)]}}


def _blocks_of(columns: Columns) -> Iterator[dict[str, NDArray[Any]]]:
    if "image" in columns:
        for cells, x, y, width, height in zip(*(columns[name] for name in _GRID), strict=True):
            m, n = cells.shape
            across, up = x + (np.arange(n) + 0.5) * width / n, y + (np.arange(m) + 0.5) * height / m
            yield {"x": np.tile(across, m), "y": np.repeat(up, n), "value": cells.ravel()}
    elif "xs" in columns:
        for part, (xs, ys) in enumerate(zip(columns["xs"], columns["ys"], strict=True)):
            # An area is a list of parts, each with an outer curve and holes.
            rings = (
                [(None, xs, ys)]
                if isinstance(xs, np.ndarray)
                else [(ring, x, y) for ring, (x, y) in enumerate(zip(xs[0], ys[0], strict=True))]
            )
            for ring, x, y in rings:
                number = {} if ring is None else {"ring": np.full(len(x), ring)}
                yield {"part": np.full(len(x), part), **number, "x": np.asarray(x), "y": np.asarray(y)}
    else:
        for names in _together(columns):
            yield {name: columns[name] for name in names}


def _together(columns: Columns) -> list[list[str]]:
    """Return the names of the columns, grouped by length."""
    lengths: dict[int, list[str]] = {}
    for name, column in columns.items():
        if _is_column(column):
            lengths.setdefault(len(column), []).append(name)
    return [names for length, names in lengths.items() if length]


def _is_column(column: Any) -> bool:
    return isinstance(column, np.ndarray) and column.ndim == 1


def _besides(data: PictureData) -> dict[str, Any]:
    """Return the data that are not tabular: circles, marks, axes of a body."""
    return {
        f"{layer}.{name}": _plain(column)
        for layer, columns in _layers(data).items()
        for name, column in columns.items()
        if name not in ("xs", "ys", *_GRID) and not _is_column(column)
    }


def _field(value: Any) -> str:
    if isinstance(value, (str, int)):
        return str(value)
    return repr(value) if math.isfinite(value) else ""


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
