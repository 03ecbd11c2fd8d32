"""Build the xarray Dataset of a sweep or a chart, with names, units and coordinates."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from hess_explorer.sweep.quantity import Outcome, Quantity
from hess_mechanics.numerics.results import Array

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["PART", "described"]

PART = "number"
"""Name of the dimension of quantities with several numbers per cell."""


def described(
    what: Quantity,
    axes: Mapping[str, tuple[Array, Mapping[str, str]]],
    values: Any,
    status: Any,
    errors: Any = None,
    *,
    parts: Sequence[str] = (),
    **facts: Any,
) -> xr.Dataset:
    """Return a Dataset of arrays over the axes, given by their coordinates and attributes.

    parts : names of the numbers at a cell, none for a scalar; facts : attributes of the Dataset.
    """
    import xarray as xr

    dimensions = tuple(axes)
    coordinates: dict[str, Any] = {name: (name, places, attrs) for name, (places, attrs) in axes.items()}
    together = bool(parts) and not what.separate
    if together:
        coordinates[PART] = (PART, np.array(parts, object), {"long_name": what.doc})
    variables: dict[str, Any] = {
        name: (
            (*dimensions, PART) if together else dimensions,
            own,
            {
                "long_name": what.title if name == what.variable else name,
                "symbol": what.symbol if name == what.variable else name,
                "units": what.units,
                "description": what.doc,
            },
        )
        for name, own in zip(what.variables, what.columns(values), strict=True)
    }
    variables["status"] = (
        dimensions,
        status,
        {
            "long_name": "how each cell ended",
            "units": "1",
            "flag_values": [int(one) for one in Outcome],
            "flag_meanings": " ".join(one.words.replace(" ", "_") for one in Outcome),
        },
    )
    if errors is not None:
        variables["error"] = (dimensions, errors, {"long_name": f"estimated error: {what.error}", "units": what.units})
    return xr.Dataset(variables, coordinates, {"title": what.title, "quantity": what.name, **facts})
