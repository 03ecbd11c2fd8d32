"""The data of a picture as columns by name, the same as in its CSV file."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hess_explorer.export.picture_data import PictureData
from hess_explorer.export.table import ANGLES, Block, angles_of, blocks, names_of
from hess_explorer.views.plot import Plot
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.labelled import Labels, Result
from hess_mechanics.numerics.results import frozen

__all__ = ["Table", "columns_of"]


@dataclass(frozen=True, eq=False)
class Table(Result):
    """Data of a picture: columns of equal length, with one row for each point.

    The column "layer" names the layer of a row.  A coordinate that the layer does not have is NaN.

    Attributes
    ----------
    columns : mapping of str to ndarray
        The columns by the names of the CSV file, read-only.
    facts : mapping of str
        Link, parameters, accuracy, errors and version, the same as in exported files; "angles" says of each column of
        angles whether it counts on over full turns.
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

    def __contains__(self, name: object) -> bool:
        return name in self.columns

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
            The layers by name.  A map has the coordinates y and x.  Other layers have points along a dimension, with
            the first column as coordinate.

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
        """Return the columns as variables over the rows, for `to_pandas`.

        Returns
        -------
        Labels
            The variables by name.
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
        # Columns x and y are what the axes of the plot say.
        symbols = {name: axes.get(name, name) for name, column in columns.items() if column.dtype.kind == "f"}
        units = {name: _UNITS.get(symbol, "1") for name, symbol in symbols.items()}
        facts = {**self.table.facts, **{f"{name}_axis": symbol for name, symbol in axes.items()}}
        if "value" in columns:
            y, x = np.unique(columns["y"]), np.unique(columns["x"])
            if (y.size, x.size) != (1, 1) and y.size * x.size == columns["value"].size:
                order = np.lexsort((columns["x"], columns["y"]))
                cells = columns["value"][order].reshape(y.size, x.size)
                return Labels({"y": (("y",), y), "x": (("x",), x)}, {"value": (("y", "x"), cells)}, units, facts)
        numbers = [name for name in columns if name not in ("part", "ring")]
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
    """Return the data of a picture in double precision."""
    found = blocks(data)
    axes = data.picture.names(data.state) if isinstance(data.picture, Plot) else ()
    facts = {**data.facts, **angles_of(data)}
    return Table({name: frozen(_column(name, found)) for name in names_of(found)}, facts, axes)


def _column(name: str, found: Sequence[Block]) -> NDArray[Any]:
    parts = [block.get(name) for block in found]
    nothing = "" if any(part is not None and part.dtype.kind == "U" for part in parts) else np.nan
    sizes = (len(block["layer"]) for block in found)
    filled = [np.full(size, nothing) if part is None else part for size, part in zip(sizes, parts, strict=True)]
    return np.concatenate(filled) if filled else np.array([], str)


def _has_any(column: NDArray[Any]) -> bool:
    return bool((column != "").any() if column.dtype.kind == "U" else not np.isnan(column).all())
