"""Collect the results of a sweep in memory or in a resumable Zarr store, and return them as an xarray Dataset.

The chunks of the store are the boxes of the sweep.  For each box the values are written first and the status last, each
file under a temporary name until it is complete.  A box with a status is therefore finished, whenever the run ended.  A
box that cannot be read, or that lacks a value, is computed again.
"""

from __future__ import annotations

import json
import math
import shutil
from collections.abc import Callable, Mapping
from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from hess_explorer.sweep.dataset import described
from hess_explorer.sweep.errors import OtherSweep, StoreError
from hess_explorer.sweep.grid import MAX_NUMBERS, Box, SweepGrid
from hess_explorer.sweep.quantities import QUANTITIES
from hess_explorer.sweep.quantity import Outcome, Quantity
from hess_explorer.sweep.work import ChunkResult, version
from hess_mechanics.errors import MissingLibrary

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["Memory", "Storage", "Store", "opened", "read", "require_libraries"]

_PROGRAM = "hess-explorer sweep"


def require_libraries() -> None:
    """Raise `MissingLibrary` unless xarray and Zarr are installed."""
    if any(find_spec(name) is None for name in ("xarray", "zarr")):
        raise MissingLibrary("Sweeps need xarray and Zarr: pip install 'hess-explorer[sweep]'.")


class Storage(Protocol):
    """Storage of finished boxes."""

    def write(self, box: Box, done: ChunkResult) -> None:
        """Save a box.  Raises `StoreError`."""

    def dataset(self) -> xr.Dataset:
        """Return the results; unfinished cells have the status 0."""

    @property
    def resume_hint(self) -> str:
        """A sentence on where the results are and how to resume."""


def _slices(box: Box) -> tuple[slice, ...]:
    return tuple(slice(low, high) for low, high in box)


def _names(what: Quantity) -> tuple[str, ...]:
    """Return the names of the arrays in the order of writing, with the status last."""
    return what.variable, *(("error",) if what.error else ()), "status"


def _write(arrays: Mapping[str, Any], box: Box, done: ChunkResult) -> None:
    for array, part in zip(arrays.values(), (done.values, *done.errors, done.status), strict=True):
        array[_slices(box)] = part


def _empty(what: Quantity, grid: SweepGrid, level: str, filled: Callable[[tuple[int, ...], Any], Any]) -> xr.Dataset:
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
        program=_PROGRAM,
        version=version(),
        level=level,
        parameters=json.dumps(dict(grid.fixed), ensure_ascii=False, sort_keys=True),
    )


class Memory:
    """Finished boxes in memory."""

    resume_hint = ""

    def __init__(self, what: Quantity, grid: SweepGrid, level: str) -> None:
        self._dataset = _empty(what, grid, level, np.full)
        self._arrays = {name: self._dataset[name].values for name in _names(what)}

    def write(self, box: Box, done: ChunkResult) -> None:
        """Save a box."""
        _write(self._arrays, box, done)

    def dataset(self) -> xr.Dataset:
        """Return the results."""
        return self._dataset


class Store:
    """Finished boxes in a Zarr store."""

    def __init__(self, path: Path, what: Quantity) -> None:
        """Open the store.  Raises `StoreError`."""
        import zarr

        self.path, self._what = path, what
        group = _group(path, "r+")
        found = {name: group.get(name) for name in _names(what)}
        if not all(isinstance(array, zarr.Array) for array in found.values()):
            raise StoreError(f"{str(path)!r} is a damaged or incomplete store: choose another folder.")
        self._arrays: dict[str, Any] = found
        self.shape: tuple[int, ...] = found["status"].chunks

    @classmethod
    def create(cls, path: Path, what: Quantity, grid: SweepGrid, level: str, shape: tuple[int, ...]) -> Store:
        """Create an empty store with boxes of this shape.  Raises `StoreError`."""
        from zarr.codecs import Crc32cCodec, ZstdCodec

        empty = _empty(what, grid, level, lambda of, value: np.broadcast_to(value, of))
        # Checksums reveal incomplete files.  The doubles of a quantity look random, so compression would cost more
        # than it saves; the status is mostly one number.
        packed = {"status": ZstdCodec(level=1, checksum=True)}
        begun = path.with_name(f"{path.name}.begun")
        try:
            shutil.rmtree(begun, ignore_errors=True)
            empty.drop_vars(list(empty.data_vars)).to_zarr(begun, zarr_format=3, consolidated=False)
            group = _group(begun, "r+")
            for name, one in empty.data_vars.items():
                group.create_array(
                    name,
                    shape=one.shape,
                    dtype=one.dtype,
                    chunks=(*shape, *one.shape[len(shape) :]),
                    compressors=(packed.get(str(name), Crc32cCodec()),),
                    fill_value=one.values.flat[0],
                    dimension_names=one.dims,
                    attributes=one.attrs,
                )
            # Renaming makes the creation atomic.
            begun.rename(path)
        except OSError as error:
            raise StoreError(f"{str(path)!r} cannot be written ({error.strerror}); choose another folder.") from error
        return cls(path, what)

    @property
    def resume_hint(self) -> str:
        """A sentence on where the results are and how to resume."""
        return f"Finished cells are saved in {str(self.path)!r}: run the same sweep again to continue."

    def require(self, grid: SweepGrid, level: str) -> None:
        """Raise `OtherSweep` if the store was created for a different sweep."""
        held = _group(self.path, "r").attrs
        wanted = {"quantity": self._what.name, "level": level, "version": version()}
        for name, value in wanted.items():
            if held.get(name) != value:
                self._refuse(f"has {name} {held.get(name)!r}, not {value!r}")
        axes = tuple(self._arrays["status"].metadata.dimension_names or ())
        if axes != tuple(grid.axes):
            self._refuse(f"is over {', '.join(axes)}, not {', '.join(grid.axes)}")
        for name, places in grid.axes.items():
            if not np.array_equal(np.asarray(_group(self.path, "r")[name]), places):
                self._refuse(f"has other values of {name}")
        fixed = json.loads(str(held["parameters"]))
        for name, one in grid.fixed.items():
            if fixed.get(name) != one:
                self._refuse(f"has {name} = {fixed.get(name)}, not {one}")

    def _refuse(self, why: str) -> None:
        raise OtherSweep(
            f"{str(self.path)!r} contains another sweep: it {why}.  Choose another folder, or repeat that sweep."
        )

    def has(self, box: Box) -> bool:
        """Return True if this box is finished and readable."""
        own = _slices(box)
        try:
            values, *_, status = (array[own] for array in self._arrays.values())
        # The decoder raises many types of errors for an incomplete file.
        except (OSError, ValueError, RuntimeError):
            return False
        known = (status >= Outcome.OK) & (status < Outcome.OUTSIDE_REGION)
        return bool(status.all() and np.isfinite(values[known]).all())

    def write(self, box: Box, done: ChunkResult) -> None:
        """Save a box, with the status last."""
        try:
            _write(self._arrays, box, done)
        except OSError as error:
            raise StoreError(f"{str(self.path)!r} cannot be written ({error.strerror}).  {self.resume_hint}") from error

    def dataset(self) -> xr.Dataset:
        """Return the results, loaded up to `MAX_NUMBERS` values and lazily above that."""
        return read(self.path)


def _group(path: Path, mode: Any) -> Any:
    import zarr

    try:
        return zarr.open_group(path, mode=mode, zarr_format=3)
    except (OSError, ValueError) as error:
        raise StoreError(f"{str(path)!r} does not contain a sweep: choose another folder.") from error


def read(path: str | Path) -> xr.Dataset:
    """Return the Dataset of a saved sweep, finished or not, or of a chart that the page has saved.

    Parameters
    ----------
    path : str or Path
        Folder of the store, or file of the chart.

    Returns
    -------
    xarray.Dataset
        The results, loaded into memory up to `MAX_NUMBERS` values and lazily above that.

    Raises
    ------
    StoreError
        If there is no store or chart, or a part of it cannot be read.
    """
    require_libraries()
    import xarray as xr

    path = Path(path)
    if path.is_file():
        # Imported here, because only charts depend on scenes.
        from hess_explorer.sweep.chart_file import read_chart

        return read_chart(path)
    if _group(path, "r").attrs.get("program") != _PROGRAM:
        raise StoreError(f"{str(path)!r} does not contain a sweep: choose another folder.")
    found: xr.Dataset = xr.open_zarr(path, consolidated=False, zarr_format=3, chunks=None)
    try:
        return found.load() if math.prod(found.sizes.values()) <= MAX_NUMBERS else found
    except (OSError, ValueError, RuntimeError) as error:
        raise StoreError(
            f"A part of {str(path)!r} cannot be read: run the same sweep again to recompute it."
        ) from error


def opened(path: Path, what: Quantity, grid: SweepGrid, level: str) -> Store | None:
    """Return the store of this sweep, or None if the path does not exist.  Raises `OtherSweep`, `StoreError`."""
    if not path.exists() or (path.is_dir() and not any(path.iterdir())):
        return None
    held = _group(path, "r").attrs.get("quantity")
    if held != what.name and held in QUANTITIES:
        raise OtherSweep(
            f"{str(path)!r} contains another sweep: it has quantity {held!r}, not {what.name!r}.  "
            "Choose another folder, or repeat that sweep."
        )
    found = Store(path, what)
    found.require(grid, level)
    return found
