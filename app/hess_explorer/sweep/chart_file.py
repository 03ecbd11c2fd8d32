"""Read a chart that the page has saved, as a Dataset like those of sweeps."""

from __future__ import annotations

import json
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hess_explorer.protocol.parameters import Link
from hess_explorer.sweep.chart import MOST_SIDE, Chart
from hess_explorer.sweep.dataset import described
from hess_explorer.sweep.errors import StoreError
from hess_explorer.sweep.quantities import QUANTITIES
from hess_explorer.sweep.quantity import Outcome
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import level as level_named
from hess_mechanics.numerics.results import Array

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["PROGRAM", "chart_of", "read_chart"]

PROGRAM = "hess-explorer chart"
_MOST_BYTES = 10_000_000
"""Maximum size of a file in bytes; 65 536 cells take two million."""


def read_chart(path: Path) -> xr.Dataset:
    """Return the chart in a file, with its sides as coordinates, x first.  Raises `StoreError`."""
    try:
        if path.stat().st_size > _MOST_BYTES:
            raise ValueError
        found: Any = json.loads(path.read_text(encoding="utf-8"))
        if found["program"] != PROGRAM or not isinstance(found["state"], str):
            raise ValueError
        what = QUANTITIES[found["quantity"]]
        part, sides = int(found["part"]), (found["x"], found["y"])
        places = {str(side["name"]): _places(side) for side in sides}
        columns, rows = (axis.size for axis in places.values())
        values = np.array(found["values"], float).reshape(rows, columns).T
        status = np.array(found["status"], np.uint8).reshape(rows, columns).T
        state, level, link = found["state"], level_named(found["level"]).name, str(found["link"])
        error, version = found.get("error"), str(found.get("version") or "unknown")
        own = [what.parts[part]] if what.parts else []
        has_number = (status >= Outcome.OK) & (status < Outcome.OUTSIDE_REGION)
        if not (np.isin(status, list(Outcome)).all() and np.array_equal(np.isfinite(values), has_number)):
            raise ValueError
    except OSError as failure:
        raise StoreError(f"{str(path)!r} cannot be read ({failure.strerror}): choose another file.") from failure
    except (ValueError, TypeError, KeyError, IndexError, AttributeError, OverflowError, InvalidParameter) as failure:
        raise StoreError(
            f"{str(path)!r} does not contain a complete chart: choose a file written by Save on the page, or the "
            "folder of a sweep."
        ) from failure
    given = {name: value for name, value in Link(state).given.items() if name not in places}
    axes = {
        name: (axis, {"symbol": str(side.get("symbol", name))})
        for (name, axis), side in zip(places.items(), sides, strict=True)
    }
    return described(
        what,
        axes,
        values[..., None] if own else values,
        status,
        parts=own,
        program=PROGRAM,
        version=version,
        level=level,
        parameters=json.dumps(given, ensure_ascii=False, sort_keys=True),
        link=link,
        state=state,
        part=part,
        **({} if error is None else {"largest_error": float(error)}),
    )


def _places(side: Any) -> Array:
    low, high, count = float(side["low"]), float(side["high"]), side["count"]
    if not (isinstance(count, int) and 2 <= count <= MOST_SIDE and low < high and np.isfinite([low, high]).all()):
        raise ValueError
    return np.linspace(low, high, count)


def chart_of(found: xr.Dataset) -> Chart:
    """Return the chart of a Dataset, to compute more cells.

    Raises `InvalidParameter` if it belongs to another version of the scene.
    """
    x, y = (
        [name, float(found[name].min()), float(found[name].max()), found.sizes[name]]
        for name in map(str, found.status.dims)
    )
    return Chart.read(
        {
            "state": found.attrs["state"],
            "quantity": found.attrs["quantity"],
            "part": int(found.attrs["part"]),
            "x": x,
            "y": y,
        }
    )
