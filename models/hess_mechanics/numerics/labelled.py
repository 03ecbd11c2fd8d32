"""Results with the names, units and coordinates of their numbers, for pandas, xarray, plots and notebooks."""

from __future__ import annotations

import importlib
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field, fields
from html import escape
from textwrap import wrap
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.errors import InvalidParameter

__all__ = ["Labels", "Result", "ShortRepr", "components"]

_LINES = 10
"""Most lines of a printed result."""

Named = Mapping[str, tuple[tuple[str, ...], NDArray[Any]]]
"""Arrays by name, each with the names of its dimensions."""


def components(names: Iterable[str], values: NDArray[Any], *dims: str) -> Named:
    """Return the components along the last axis of an array, by name, for `Labels`.

    Parameters
    ----------
    names : iterable of str
        Names of the components.
    values : ndarray, shape (..., d)
        The array.
    *dims : str
        Names of the other dimensions.

    Returns
    -------
    mapping of str to (tuple of str, ndarray)
        Each component with the names of its dimensions.
    """
    return {name: (dims, values[..., i]) for i, name in enumerate(names)}


@dataclass(frozen=True)
class Labels:
    """Names, units and coordinates of the numbers of a result.

    Attributes
    ----------
    coords : dict
        Coordinates by name, each with the names of its dimensions.  A coordinate named like a dimension belongs to it.
    variables : dict
        Arrays by name, each with the names of its dimensions.
    units : dict of str to str
        Units by name; "T" stands for the unit of time.
    facts : dict
        Numbers and words about the whole result.
    """

    coords: Named
    variables: Named
    units: Mapping[str, str] = field(default_factory=dict)
    facts: Mapping[str, Any] = field(default_factory=dict)


class ShortRepr:
    """Base class of data classes that print in at most ten lines, with the size of arrays instead of their numbers."""

    def __str__(self) -> str:
        """Return type, fields and the sizes of arrays."""
        known = {one.name: getattr(self, one.name) for one in fields(self)}  # type: ignore[arg-type]
        arrays = {name: value for name, value in known.items() if isinstance(value, np.ndarray)}
        facts = {name: value for name, value in known.items() if name not in arrays}
        return _printed(self, facts, [f"{name} {value.shape} {_range(value)}" for name, value in arrays.items()])


def _printed(result: Any, facts: Mapping[str, Any], arrays: Sequence[str]) -> str:
    """Return the type of a result with its facts, and a line for each array, up to the maximum number of lines."""
    words = ", ".join(f"{name} {_short(value)}" for name, value in facts.items() if str(value))
    lines = wrap(f"{type(result).__name__}: {words}", 100, max_lines=4, placeholder=" …")
    room = _LINES - len(lines)
    more = [f"and {len(arrays) - room + 1} more"] if len(arrays) > room else []
    return "\n  ".join([*lines, *arrays[: room - len(more)], *more])


class Result(ABC):
    """Base class of results that can be converted and drawn; the libraries for this are imported only when needed."""

    @abstractmethod
    def labels(self) -> Labels:
        """Return the names, units and coordinates of the numbers.

        Returns
        -------
        Labels
            The labels.
        """

    def to_xarray(self) -> Any:
        """Return the result as an `xarray.Dataset`, with units in the `attrs` of its arrays.

        Returns
        -------
        xarray.Dataset
            The arrays with their coordinates.

        Raises
        ------
        InvalidParameter
            If xarray is not installed.
        """
        known = self.labels()

        def arrays(named: Named) -> dict[str, Any]:
            return {
                name: (dims, values, {"units": known.units[name]} if name in known.units else {})
                for name, (dims, values) in named.items()
            }

        return _needed("xarray").Dataset(arrays(known.variables), arrays(known.coords), dict(known.facts))

    def to_pandas(self) -> Any:
        """Return the result as a `pandas.DataFrame`, with the facts in its `attrs`.

        Returns
        -------
        pandas.DataFrame
            One row per point, with the coordinates and the variables as columns.

        Raises
        ------
        InvalidParameter
            If pandas is not installed.
        """
        known = self.labels()
        both = {**known.coords, **known.variables}
        # Rows are in the order of the variables' own dimensions.
        dims = tuple(
            dict.fromkeys(name for names, _ in [*known.variables.values(), *known.coords.values()] for name in names)
        )
        sides = {name: size for names, values in both.values() for name, size in zip(names, values.shape, strict=True)}
        grid = dict(zip(dims, np.indices([sides[name] for name in dims]), strict=True))
        columns = {name: values[tuple(grid[one].ravel() for one in names)] for name, (names, values) in both.items()}
        # With several dimensions, a dimension without a coordinate gets an index.
        counted = {name: index.ravel() for name, index in grid.items() if name not in both and len(dims) > 1}
        frame = _needed("pandas").DataFrame({**counted, **columns})
        frame.attrs.update(known.facts)
        return frame

    def plot(self) -> Any:
        """Return the result as a HoloViews object: variables over one coordinate or two, or points of a plane.

        Needs the package `hess_explorer` in addition to this one.

        Returns
        -------
        holoviews.core.Dimensioned
            The picture.

        Raises
        ------
        InvalidParameter
            If there is nothing to draw.
        ImportError
            If `hess_explorer` is not installed.
        """
        # Import the backend by name, as pandas does, so that this package does not depend on a user interface.
        return importlib.import_module("hess_explorer.library.drawing").draw_result(self)

    def __str__(self) -> str:
        """Return type, facts and arrays in at most ten lines."""
        known = self.labels()
        return _printed(
            self,
            known.facts,
            [
                f"{name} ({', '.join(dims)}) {_range(values)} {known.units.get(name, '')}".rstrip()
                for name, (dims, values) in {**known.coords, **known.variables}.items()
            ],
        )

    def _repr_html_(self) -> str:
        """Return a table of the facts, and of the arrays with their units, for notebooks."""
        known = self.labels()
        facts = "".join(
            f"<tr><th>{escape(str(name))}</th><td>{escape(_short(value))}</td></tr>"
            for name, value in known.facts.items()
        )
        arrays = "".join(
            f"<tr><th>{escape(name)}</th><td>({', '.join(dims)}) {escape(_range(values))} "
            f"{escape(known.units.get(name, ''))}</td></tr>"
            for name, (dims, values) in {**known.coords, **known.variables}.items()
        )
        return f"<table><caption>{escape(type(self).__name__)}</caption>{facts}{arrays}</table>"


def _short(value: Any) -> str:
    text = f"{value:.6g}" if isinstance(value, float) else str(value)
    return text if len(text) <= 200 else text[:200] + "…"


def _range(values: NDArray[Any]) -> str:
    if not values.size or not np.issubdtype(values.dtype, np.floating):
        return f"{values.size}"
    known = values[np.isfinite(values)]
    return f"{values.size}, from {known.min():.4g} to {known.max():.4g}" if known.size else f"{values.size}"


def _needed(name: str) -> Any:
    try:
        return importlib.import_module(name)
    except ImportError as error:
        raise InvalidParameter(f"This needs {name}: pip install 'hess-explorer[data]'.") from error
