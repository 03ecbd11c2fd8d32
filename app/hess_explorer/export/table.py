"""Format the data of a picture as CSV, with one row for each point, or as JSON, by layer."""

from __future__ import annotations

import csv
import io
import json
import math
from collections.abc import Mapping
from typing import Any

import numpy as np

from hess_explorer.export.columns import GRID, INDICES, angle_facts, columns_of, is_column, layers_of
from hess_explorer.export.picture_data import PictureData


def as_csv(data: PictureData) -> str:
    """Return the data as CSV, with the metadata as # comments; missing and non-finite numbers are empty."""
    table = columns_of(data)
    out = io.StringIO()
    for key, value in {**_facts(data), **_besides(data)}.items():
        out.write(f"# {key}: {json.dumps(value, ensure_ascii=False, allow_nan=False)}\n")
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(table)
    fields = ([_field(name, value) for value in column.tolist()] for name, column in table.columns.items())
    writer.writerows(zip(*fields, strict=True))
    return out.getvalue()


def as_json(data: PictureData) -> str:
    """Return the data as JSON: metadata, axes, and the columns of each layer, with null for a non-finite number."""
    return json.dumps({**_facts(data), "layers": _plain(layers_of(data))}, ensure_ascii=False, allow_nan=False) + "\n"


def _facts(data: PictureData) -> dict[str, Any]:
    """Return the metadata, the axes as [name, low, high], and the conventions of angles."""
    ends = () if data.axes is None else (data.axes.x, data.axes.y)
    axes = {side: [name, *map(float, range_)] for side, name, range_ in zip("xy", data.names, ends, strict=False)}
    return {**data.facts, **({"axes": axes} if axes else {}), **angle_facts(data)}


def _besides(data: PictureData) -> dict[str, Any]:
    """Return the data that are not tabular: circles, marks, axes of a body."""
    return {
        f"{layer}.{name}": _plain(column)
        for layer, columns in layers_of(data).items()
        for name, column in columns.items()
        if name not in ("xs", "ys", *GRID) and not is_column(column)
    }


def _field(name: str, value: Any) -> str:
    if isinstance(value, (str, int)):
        return str(value)
    if not math.isfinite(value):
        return ""
    return f"{value:.0f}" if name in INDICES else repr(value)


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
