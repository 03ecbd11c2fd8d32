"""A sweep as a chart of the page, in the scene whose states its cells are."""

from __future__ import annotations

import json
import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from hess_explorer.protocol.parameters import Number, encode
from hess_explorer.scenes import scenes
from hess_explorer.scenes.framework.charted import Charted
from hess_explorer.scenes.framework.scene import Scene
from hess_explorer.sweep.chart import MOST_SIDE, Chart, Side, swept
from hess_explorer.sweep.chart_file import PROGRAM, chart_of
from hess_explorer.sweep.quantities import QUANTITIES
from hess_mechanics.errors import InvalidParameter, ModelError

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["chart_file"]


def chart_file(found: xr.Dataset, at: Mapping[str, float] | None = None) -> dict[str, Any]:
    """Return the contents of the file in which the page would save this sweep, or has saved this chart.

    at : values of the other parameters of a sweep over more than two.
    A side with more cells than the page shows has every second or every third cell, and so on.  Raises
    `InvalidParameter` if the sweep is none over two evenly spaced parameters of a scene.
    """
    found = _slice(found, at or {})
    names = tuple(map(str, found.status.dims))
    if len(names) != 2:
        advice = "choose a value of each further one with --slice NAME=NUMBER, or " if len(names) > 2 else ""
        raise InvalidParameter(
            f"A chart has two sides, but this sweep is over {', '.join(names)}: {advice}open it in Python."
        )
    steps = {name: math.ceil((found.sizes[name] - 1) / (MOST_SIDE - 1)) for name in names}
    if min(steps.values()) < 1:
        raise InvalidParameter("A side of a chart needs two values or more: open the sweep in Python.")
    found = found.isel(
        {name: slice(0, (found.sizes[name] - 1) // step * step + 1, step) for name, step in steps.items()}
    )
    ends = {name: (float(found[name][0]), float(found[name][-1])) for name in names}
    sides = [Side(name, *ends[name], found.sizes[name]) for name in names]
    if not all(
        np.allclose(found[side.name], side.places, rtol=0.0, atol=1e-9 * abs(side.high - side.low)) for side in sides
    ):
        raise InvalidParameter(
            "The sides of a chart are evenly spaced: sweep over ranges LO:HI:N, or open the sweep in Python."
        )
    if "state" in found.attrs:
        return _written(chart_of(found), found)
    fixed = json.loads(found.attrs["parameters"])
    for scene in scenes().values():
        for charted in scene.charts:
            if charted.quantity == found.attrs["quantity"] and {*names} <= {*swept(scene.name, charted.quantity)}:
                chart = _in_scene(scene, charted, sides, fixed, found.attrs["level"])
                if chart is not None:
                    return _written(chart, found)
    raise InvalidParameter(
        f"No scene shows {found.attrs['quantity']} over {' and '.join(names)} with these parameters: open the sweep in "
        "Python with hess_explorer.sweep.read, which also reads functions of your own."
    )


def _slice(found: xr.Dataset, at: Mapping[str, float]) -> xr.Dataset:
    """Return a sweep at values of some of its parameters, which become fixed ones.  Raises `InvalidParameter`."""
    fixed = json.loads(found.attrs["parameters"])
    for name, value in at.items():
        if name not in found.status.dims:
            raise InvalidParameter(
                f"The sweep has no side {name!r} to choose a value of: choose among "
                f"{', '.join(map(str, found.status.dims))}."
            )
        places = found[name].values
        i = int(np.argmin(np.abs(places - value)))
        if not math.isclose(places[i], value, rel_tol=1e-9, abs_tol=1e-12):
            raise InvalidParameter(f"The sweep has no cells at {name} = {value:g}: the nearest are at {places[i]!s}.")
        fixed[name] = float(places[i])
        found = found.isel({name: i})
    return found.assign_attrs(parameters=json.dumps(fixed))


def _in_scene(
    scene: Scene[Any], charted: Charted[Any], sides: list[Side], fixed: dict[str, float], level: str
) -> Chart | None:
    """Return the chart if two opposite cells have the parameters of the sweep, otherwise None."""
    known = {spec.name for spec in scene.specs if isinstance(spec, Number)}
    given = {name: value for name, value in fixed.items() if name in known}
    try:
        values, _ = scene.admit({**scene.defaults(), **given, "accuracy": level})
        chart = Chart(scene, values, charted, 0, *sides)
        for end in (0, -1):
            cell = {side.name: float(side.places[end]) for side in sides}
            wanted, own = {**fixed, **cell}, chart.arguments(cell)
            if any(not math.isclose(own[name], value, rel_tol=1e-12, abs_tol=1e-12) for name, value in wanted.items()):
                return None
    except ModelError:
        return None
    return chart


def _written(chart: Chart, found: xr.Dataset) -> dict[str, Any]:
    what = QUANTITIES[found.attrs["quantity"]]
    part = what.parts[chart.part] if what.parts else ""
    values = found[what.variable].values
    values = (values[..., 0] if what.parts else values).T.ravel()
    errors = found.error.values if "error" in found else np.array([])
    known = errors[np.isfinite(errors)]
    symbols = {name: str(found[name].attrs.get("symbol", name)) for name in (chart.x.name, chart.y.name)}
    state = encode(chart.scene.name, chart.values)
    return {
        "program": PROGRAM,
        "title": what.title,
        "link": f"?{state}",
        "scene": chart.scene.name,
        "state": state,
        "quantity": what.name,
        "part": chart.part,
        "symbol": f"{what.symbol} {part}".strip(),
        "units": what.units,
        "turn": what.turn,
        "level": found.attrs["level"],
        "error": float(known.max()) if known.size else found.attrs.get("largest_error"),
        "version": found.attrs["version"],
        "names": [list(one) for one in what.named.get(part, {}).items()],
        **{
            axis: {
                "name": side.name,
                "symbol": symbols[side.name],
                "low": side.low,
                "high": side.high,
                "count": side.count,
            }
            for axis, side in (("x", chart.x), ("y", chart.y))
        },
        "values": [value if math.isfinite(value) else None for value in values.tolist()],
        "status": found.status.values.T.ravel().tolist(),
    }
