"""Collect the results of a sweep, in memory or in a store, as an xarray Dataset."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from importlib.util import find_spec
from itertools import islice
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from hess_explorer.sweep.dataset import described
from hess_explorer.sweep.grid import Box, Part, SweepGrid
from hess_explorer.sweep.quantity import Outcome, Quantity
from hess_explorer.sweep.work import ChunkResult, version
from hess_mechanics.errors import MissingLibrary

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["PROGRAM", "Memory", "Storage", "empty", "names", "parts", "require_libraries", "slices", "with_failures"]

_MOST_FAILURES = 1000
PROGRAM = "hess-explorer sweep"


def require_libraries() -> None:
    """Raise `MissingLibrary` unless xarray and Zarr are installed."""
    if any(find_spec(name) is None for name in ("xarray", "zarr")):
        raise MissingLibrary("Sweeps need xarray and Zarr: pip install 'hess-explorer[sweep]'.")


class Storage(Protocol):
    """Storage of finished boxes."""

    def cells(self, part: Part | None) -> int:
        """Return the number of cells of a part."""

    def missing(self, part: Part | None) -> list[Box]:
        """Return the boxes of a part that are not finished."""

    def write(self, box: Box, done: ChunkResult) -> None:
        """Save a box.  Raises `StoreError`."""

    def dataset(self) -> xr.Dataset:
        """Return the results; unfinished cells have the status 0."""

    @property
    def resume_hint(self) -> str:
        """A sentence on where the results are and how to resume."""


def slices(box: Box) -> tuple[slice, ...]:
    """Return a box as an index of an array."""
    return tuple(slice(low, high) for low, high in box)


def names(what: Quantity) -> tuple[str, ...]:
    """Return the names of the arrays in the order of writing, with the status last."""
    return *what.variables, *(("error",) if what.error else ()), "status"


def parts(what: Quantity, done: ChunkResult) -> tuple[Any, ...]:
    """Return a box of each array, in the order of `names`."""
    return *what.columns(done.values), *done.errors, done.status


def empty(what: Quantity, grid: SweepGrid, level: str, filled: Callable[[tuple[int, ...], Any], Any]) -> xr.Dataset:
    """Return a Dataset without finished cells; filled(shape, value) : creates an array."""
    known = {one.name: one for one in what.parameters}
    axes = {
        name: (
            places,
            {
                "long_name": known[name].label,
                "description": known[name].doc,
                "symbol": known[name].symbol,
                "units": known[name].unit,
            },
        )
        for name, places in grid.axes.items()
    }
    return described(
        what,
        axes,
        filled((*grid.shape, *((len(what.parts),) if what.parts else ())), np.nan),
        filled(grid.shape, np.uint8(Outcome.NOT_COMPUTED)),
        filled(grid.shape, np.nan) if what.error else None,
        parts=what.parts,
        program=PROGRAM,
        version=version(),
        level=level,
        parameters=json.dumps(dict(grid.fixed), ensure_ascii=False, sort_keys=True),
        **({} if what.source is None else {"source": what.source}),
    )


def with_failures(found: xr.Dataset, failures: Mapping[str, str]) -> xr.Dataset:
    """Return a Dataset whose attribute "failures" has the texts of exceptions, as JSON, if there are any."""
    if not failures:
        return found
    return found.assign_attrs(failures=json.dumps(dict(islice(failures.items(), _MOST_FAILURES)), ensure_ascii=False))


class Memory:
    """Finished boxes in memory."""

    resume_hint = ""

    def __init__(self, what: Quantity, grid: SweepGrid, level: str, shape: tuple[int, ...]) -> None:
        self._grid, self._shape = grid, shape
        self._what, self._dataset = what, empty(what, grid, level, np.full)
        self._arrays = [self._dataset[name].values for name in names(what)]
        self._failures: dict[str, str] = {}

    def cells(self, part: Part | None) -> int:
        """Return the number of cells; there are no parts."""
        return self._grid.cells

    def missing(self, part: Part | None) -> list[Box]:
        """Return all boxes."""
        return list(self._grid.boxes(self._shape))

    def write(self, box: Box, done: ChunkResult) -> None:
        """Save a box."""
        for array, part in zip(self._arrays, parts(self._what, done), strict=True):
            array[slices(box)] = part
        self._failures |= done.failures

    def dataset(self) -> xr.Dataset:
        """Return the results."""
        return with_failures(self._dataset, self._failures)
