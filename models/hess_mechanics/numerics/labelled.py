"""Results that know the names, units and coordinates of their numbers: for pandas, xarray, a plot and a notebook."""

from __future__ import annotations

import importlib
from abc import ABC, abstractmethod
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field
from html import escape
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.errors import InvalidParameter

__all__ = ["Labels", "Result", "components"]

Named = Mapping[str, tuple[tuple[str, ...], NDArray[Any]]]
"""Arrays by name, each with the names of its dimensions."""


def components(names: Iterable[str], values: NDArray[Any], *dims: str) -> Named:
    """Return the components along the last axis of an array by their names, for `Labels`."""
    return {name: (dims, values[..., i]) for i, name in enumerate(names)}


@dataclass(frozen=True)
class Labels:
    """What the numbers of a result are.

    coords, variables : arrays by name, with the names of their dimensions; a coordinate of the name of a dimension
        belongs to that dimension.
    units : by name, "T" standing for the unit of time; facts : numbers and words of the whole result.
    """

    coords: Named
    variables: Named
    units: Mapping[str, str] = field(default_factory=dict)
    facts: Mapping[str, Any] = field(default_factory=dict)


class Result(ABC):
    """A result that can be handed on and drawn; the libraries for that are imported only then."""

    @abstractmethod
    def labels(self) -> Labels:
        """The names, units and coordinates of its numbers."""

    def to_xarray(self) -> Any:
        """An `xarray.Dataset`, units in the `attrs` of its arrays.  Raises `InvalidParameter` without xarray."""
        known = self.labels()

        def arrays(named: Named) -> dict[str, Any]:
            return {
                name: (dims, values, {"units": known.units[name]} if name in known.units else {})
                for name, (dims, values) in named.items()
            }

        return _needed("xarray").Dataset(arrays(known.variables), arrays(known.coords), dict(known.facts))

    def to_pandas(self) -> Any:
        """A `pandas.DataFrame`, one row for each number of a kind, whose `attrs` are the facts.

        Raises `InvalidParameter` without pandas.
        """
        known = self.labels()
        both = {**known.coords, **known.variables}
        # Rows run as the numbers of the variables do.
        dims = tuple(
            dict.fromkeys(name for names, _ in [*known.variables.values(), *known.coords.values()] for name in names)
        )
        sides = {name: size for names, values in both.values() for name, size in zip(names, values.shape, strict=True)}
        grid = dict(zip(dims, np.indices([sides[name] for name in dims]), strict=True))
        columns = {name: values[tuple(grid[one].ravel() for one in names)] for name, (names, values) in both.items()}
        # A dimension without a coordinate of its own is counted, where there are several.
        counted = {name: index.ravel() for name, index in grid.items() if name not in both and len(dims) > 1}
        frame = _needed("pandas").DataFrame({**counted, **columns})
        frame.attrs.update(known.facts)
        return frame

    def plot(self) -> Any:
        """Return a HoloViews object: variables over a coordinate, over two, or points of a plane.

        Needs the package `hess_explorer` beside this one.  Raises `InvalidParameter` where there is nothing to draw.
        """
        # By name, as pandas finds what plots: the mechanics know no user interface.
        return importlib.import_module("hess_explorer.library.drawing").draw_result(self)

    def _repr_html_(self) -> str:
        """A table of the facts, and of the arrays with their units, for notebooks."""
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
