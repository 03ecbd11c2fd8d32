"""The data of a picture as columns by name, the same as in its CSV file."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hess_explorer.export.picture_data import PictureData
from hess_explorer.scenes.framework.swarm import SWARM
from hess_explorer.views.layers import Columns, Sources
from hess_explorer.views.plot import Plot
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.results import angle_convention, as_read_only

__all__ = ["Table", "columns_of"]

ANGLES = ("phi", "phi_start", "theta", "psi", "delta", "l", "φ", "θ", "θ⁻", "θ⁺", "ψ", "δ", "Θ(φ)")
"""Names of columns and axes that are angles, in radians."""
INDICES = ("part", "ring", "body")
"""Index columns: part of a curve or an area and its boundary curve (0 is the outer one), from 0; body, from 1."""
GRID = ("image", "x", "y", "dw", "dh")
"""Columns of images: cells, lower left corner, width and height of each image."""

_FRAMES = ("frames0", "frames1", "signs0", "times")
_WIDEST = 2.001 * math.pi
Block = dict[str, NDArray[Any]]
"""Columns of equal length by name."""


@dataclass(frozen=True, eq=False)
class Table(Result):
    """Data of a picture: columns of equal length, with one row for each point.

    The column "layer" names the layer of a row.  A coordinate that the layer does not have is NaN.

    Attributes
    ----------
    columns : mapping of str to ndarray
        The columns by the names of the CSV file, read-only.
    facts : mapping of str
        Link, parameters, accuracy, errors and version, as in exported files; "angles" tells for each column of angles
        (in radians) whether it is continuous over full turns.
    axes : tuple of str
        Names of the axes of a plot, empty for other pictures.

    Examples
    --------
    >>> import hess_explorer as hess
    >>> data = hess.state("suslov-hess", accuracy="draft").data("circle")
    >>> data.layers
    ('cobweb', 'diagonal', 'map', 'stable', 'unstable', 'orbit')
    >>> data.layer("stable").keys()
    ('layer', 'phi', 'theta')
    """

    columns: Mapping[str, NDArray[Any]]
    facts: Mapping[str, Any]
    axes: tuple[str, ...] = ()

    def __getitem__(self, name: str) -> NDArray[Any]:
        if name not in self.columns:
            raise InvalidParameter(f"There is no column {name!r}: choose one of {', '.join(self.columns)}.")
        return self.columns[name]

    def __iter__(self) -> Iterator[str]:
        return iter(self.columns)

    def __len__(self) -> int:
        """Return the number of rows."""
        return len(self.columns["layer"])

    def keys(self) -> tuple[str, ...]:
        """Return the names of the columns."""
        return tuple(self.columns)

    @property
    def layers(self) -> tuple[str, ...]:
        """The names of the layers that have rows."""
        return tuple(dict.fromkeys(self.columns["layer"].tolist()))

    def layer(self, name: str) -> Table:
        """Return the rows of one layer, with only the columns that it has.

        Parameters
        ----------
        name : str
            Name of the layer, one of `layers`.

        Returns
        -------
        Table
            The rows of the layer.

        Raises
        ------
        InvalidParameter
            If there is no such layer.
        """
        if name not in self.layers:
            raise InvalidParameter(f"There is no layer {name!r}: choose one of {', '.join(self.layers)}.")
        there = self.columns["layer"] == name
        return Table(
            {key: part for key, column in self.columns.items() if _has_any(part := column[there])},
            self.facts,
            self.axes,
        )

    def to_xarray(self) -> dict[str, Any]:
        """Return an `xarray.Dataset` for each layer, with coordinates and units.

        Returns
        -------
        dict of str to xarray.Dataset
            The layers by name.  A map has the dimensions y and x.  Other layers have the dimension "point"; their
            coordinates are the index columns and, if there are several other columns, the first of these.

        Raises
        ------
        InvalidParameter
            If xarray is not installed.

        Examples
        --------
        >>> import hess_explorer as hess
        >>> layers = hess.state("suslov-hess", accuracy="draft").data("circle").to_xarray()
        >>> list(layers["stable"].coords), layers["stable"].theta.attrs["units"]
        (['phi'], 'rad')
        """
        return {name: _Layer(self.layer(name)).to_xarray() for name in self.layers}

    def labels(self) -> Labels:
        """Return the columns as variables over the dimension "row", for `to_pandas`.

        Returns
        -------
        Labels
            The variables by name, without coordinates and units.
        """
        return Labels({}, {name: (("row",), column) for name, column in self.columns.items()}, {}, self.facts)

    def __repr__(self) -> str:
        return f"<{len(self)} rows of {self.facts['title']!r}: {', '.join(self.columns)}>"


@dataclass(frozen=True, eq=False)
class _Layer(Result):
    """One layer of a table, as points or as a map."""

    table: Table

    def labels(self) -> Labels:
        columns = {name: column for name, column in self.table.columns.items() if name != "layer"}
        axes = dict(zip("xy", self.table.axes, strict=False))
        # A plot calls its columns x and y; the labels name the quantities on its axes.
        symbols = {name: axes.get(name, name) for name, column in columns.items() if column.dtype.kind == "f"}
        units = {name: _UNITS.get(symbol, "1") for name, symbol in symbols.items()}
        facts = {**self.table.facts, **{f"{name}_axis": symbol for name, symbol in axes.items()}}
        if "value" in columns:
            y, x = np.unique(columns["y"]), np.unique(columns["x"])
            if (y.size, x.size) != (1, 1) and y.size * x.size == columns["value"].size:
                order = np.lexsort((columns["x"], columns["y"]))
                cells = columns["value"][order].reshape(y.size, x.size)
                return Labels({"y": (("y",), y), "x": (("x",), x)}, {"value": (("y", "x"), cells)}, units, facts)
        numbers = [name for name in columns if name not in INDICES]
        coords = [name for name in columns if name not in numbers] + (numbers[:1] if len(numbers) > 1 else [])
        points = {name: (("point",), column) for name, column in columns.items()}
        return Labels(
            {name: one for name, one in points.items() if name in coords},
            {name: one for name, one in points.items() if name not in coords},
            units,
            facts,
        )


_UNITS = {**dict.fromkeys(("t", "time", "tau", "τ"), "T"), **dict.fromkeys(ANGLES, "rad")}
"""Units of columns and axes; all others are numbers in the units of the problem."""


def columns_of(data: PictureData) -> Table:
    """Return the data of all layers as a table; a grid has one row for the centre (x, y) of each cell."""
    blocks = [
        {"layer": np.full(len(next(iter(block.values()))), layer), **block}
        for layer, columns in layers_of(data).items()
        for block in _blocks(columns)
    ]
    known = dict.fromkeys(name for block in blocks for name in block)
    names = dict.fromkeys(["layer", *(name for name in INDICES if name in known), *known])
    return Table(
        {name: as_read_only(_column(name, blocks)) for name in names}, {**data.facts, **angle_facts(data)}, data.names
    )


def angle_facts(data: PictureData) -> dict[str, dict[str, str]]:
    """Return the fact "angles" of a table: the convention of each column of angles, by "layer.name".

    The dict is empty if there is no such column.
    """
    axes = dict(zip("xy", data.names, strict=False))
    angles = {*ANGLES, *getattr(type(data.state), "angles", ())}
    found: dict[str, bool] = {}
    for layer, columns in layers_of(data).items():
        # Tracks are sampled densely, so their angles jump only by full turns.
        is_track = f"data-{layer}" in data.columns
        for block in _blocks(columns):
            for name, column in block.items():
                known = column[np.isfinite(column)] if axes.get(name, name) in angles else np.empty(0)
                if known.size:
                    key, jumps = f"{layer}.{name}", np.abs(np.diff(known)).max(initial=0.0) > math.pi
                    wide = np.ptp(known) > _WIDEST
                    found[key] = found.get(key, False) or bool(wide or (is_track and not jumps))
    return {"angles": {key: angle_convention(counts) for key, counts in found.items()}} if found else {}


def layers_of(data: PictureData) -> Sources:
    """Return the columns by layer ("plot-layer" → "layer") or by track, without labels.

    Clouds and swarms are those of the sample nearest to the time of the link.
    """
    found: Sources = {}
    own = f"{data.picture.name}-"
    for source, columns in sorted(data.columns.items()):
        layer = source.removeprefix(own).removeprefix("data-")
        # A label belongs to the appearance of a picture, not to its numbers.
        if layer.endswith("-label"):
            continue
        if layer == SWARM:
            found[layer] = _swarm(columns, data.client["t"]) if columns else {}
            continue
        if "frames0" in columns:
            found |= {f"{layer}-{name}": cloud for name, cloud in _clouds(columns, data.client["t"]).items()}
        left_out = _FRAMES if "frames0" in columns else ()
        # Lists are columns only in plots; elsewhere they are vectors or names.
        is_layer = isinstance(data.picture, Plot) and source.startswith(own)
        found[layer] = {
            name: np.array(column) if is_layer and _is_list(column) else column
            for name, column in columns.items()
            if name not in left_out
        }
    return found


def _is_list(column: Any) -> bool:
    return isinstance(column, list) and all(isinstance(one, (int, float, str)) for one in column)


def _swarm(columns: Columns, time: float) -> Columns:
    """Return the columns of the known motions of a swarm at the sample nearest to a time, see "swarm.js"."""
    count, names = columns["count"], columns["names"]
    values = columns["values"].reshape(len(names), -1, count)
    sample = min(round(time / columns["spacing"]), values.shape[1] - 1)
    known = np.flatnonzero(columns["until"] >= sample)
    scaled = (
        low + step * (one[sample, known] + 32767.0)
        for low, step, one in zip(columns["low"], columns["step"], values, strict=True)
    )
    return {
        "body": known + 1.0,
        "t": np.full(known.size, sample * columns["spacing"]),
        **dict(zip(names, scaled, strict=True)),
    }


def _clouds(columns: Columns, time: float) -> Sources:
    """Return the points of the clouds in the frame nearest to a time.

    "cloud" has u, ln|s|, γ and the sign of s; "beside", if there is a second cloud, has ω and γ.
    """
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


def _blocks(columns: Columns) -> Iterator[Block]:
    if "image" in columns:
        for cells, x, y, width, height in zip(*(columns[name] for name in GRID), strict=True):
            m, n = cells.shape
            across, up = x + (np.arange(n) + 0.5) * width / n, y + (np.arange(m) + 0.5) * height / m
            yield {"x": np.tile(across, m), "y": np.repeat(up, n), "value": cells.ravel()}
    elif "xs" in columns:
        for part, (xs, ys) in enumerate(zip(columns["xs"], columns["ys"], strict=True)):
            # An area is a list of one part, which has an outer curve and holes.
            is_curve = isinstance(xs, np.ndarray)
            for ring, (x, y) in enumerate(zip(*(([xs], [ys]) if is_curve else (xs[0], ys[0])), strict=True)):
                indices = (part,) if is_curve else (part, ring)
                numbers = {name: np.full(len(x), i) for name, i in zip(INDICES, indices, strict=False)}
                yield {**numbers, "x": np.asarray(x), "y": np.asarray(y)}
    else:
        by_length: dict[int, Block] = {}
        for name, column in columns.items():
            if is_column(column) and column.size:
                by_length.setdefault(column.size, {})[name] = column
        yield from by_length.values()


def is_column(column: Any) -> bool:
    """Return whether the data contain one number or word for each point."""
    return isinstance(column, np.ndarray) and column.ndim == 1


def _column(name: str, blocks: list[Block]) -> NDArray[Any]:
    known = [block[name] for block in blocks if name in block]
    nothing = "" if any(part.dtype.kind == "U" for part in known) else np.nan
    filled = [block.get(name, np.full(len(block["layer"]), nothing)) for block in blocks]
    return np.concatenate(filled) if filled else np.array([], str)


def _has_any(column: NDArray[Any]) -> bool:
    return bool((column != "").any() if column.dtype.kind == "U" else not np.isnan(column).all())
