"""The Zarr group of a sweep, on a disk or in memory, which xarray writes region by region.

Its chunks are the pieces of the sweep, each a file that is whole or not there.  The status of a piece is written after
its values, so a piece with a status is finished, whenever the run ended.  A piece that cannot be read is computed again.
"""

from __future__ import annotations

import json
import math
import shutil
import uuid
import warnings
from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from importlib.util import find_spec
from itertools import islice
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hess_explorer.compute.cells import Outcome
from hess_explorer.sweep.errors import OtherSweep, StoreError
from hess_explorer.sweep.piece import PieceResult
from hess_explorer.sweep.plan import MAX_CELLS, Plan, Region, version
from hess_mechanics.errors import InvalidParameter, MissingLibrary

if TYPE_CHECKING:
    import xarray as xr
    from zarr.storage import MemoryStore

__all__ = ["Store", "opened", "path_of", "read", "require_libraries"]

_PROGRAM = "hess-explorer sweep"
_MOST_FAILURES = 1000
_DAMAGED = (OSError, ValueError, RuntimeError, KeyError)
"""Errors of the decoder for an incomplete file."""


def require_libraries() -> None:
    """Raise `MissingLibrary` unless xarray, Zarr and Dask are installed."""
    if any(find_spec(name) is None for name in ("xarray", "zarr", "distributed")):
        raise MissingLibrary("Sweeps need xarray, Zarr and Dask: pip install 'hess-explorer[sweep]'.")


class Store:
    """The results of a sweep.

    Attributes
    ----------
    place : its folder, or a store of Zarr in memory.
    piece : shape of a piece.
    """

    def __init__(self, place: Path | MemoryStore, plan: Plan) -> None:
        """Open the store."""
        self.place, self._plan = place, plan
        self.piece: tuple[int, ...] = _open(place).status.encoding["chunks"]

    @classmethod
    def create(cls, path: Path | None, plan: Plan, piece: tuple[int, ...]) -> Store:
        """Create an empty store with pieces of this shape, or open the same one if another process was faster.

        Raises `OtherSweep`, `StoreError`.
        """
        if path is None:
            from zarr.storage import MemoryStore

            memory = MemoryStore()
            _fill(memory, plan, piece)
            return cls(memory, plan)
        begun = path.with_name(f"{path.name}.begun-{uuid.uuid4().hex}")
        try:
            _fill(begun, plan, piece)
            # Renaming makes the creation atomic; it fails if another process has filled the folder.
            begun.rename(path)
        except OSError as error:
            shutil.rmtree(begun, ignore_errors=True)
            if (other := opened(path, plan)) is not None:
                return other
            raise StoreError(f"{str(path)!r} cannot be written ({error.strerror}); choose another folder.") from error
        return cls(path, plan)

    @property
    def resume_hint(self) -> str:
        """A sentence on where the results are and how to resume."""
        if not isinstance(self.place, Path):
            return ""
        return f"Finished cells are saved in {str(self.place)!r}: run the same sweep again to continue."

    def missing(self) -> list[Region]:
        """Return the pieces that are not finished."""
        stored = _open(self.place)
        return [region for region in self._plan.regions(self.piece) if not self._has(stored.isel(region))]

    def _has(self, part: xr.Dataset) -> bool:
        """Return True if a piece is readable, each cell has a status, and each cell with a value some finite number."""
        try:
            status = part.status.values
            if not status.all():
                return False
            part.load()
        except _DAMAGED:
            return False
        finite = np.any([np.isfinite(part[name].values) for name in self._plan.variables], axis=0)
        return bool((finite | (status >= Outcome.OUTSIDE_REGION)).all())

    def write(self, region: Region, done: PieceResult) -> None:
        """Save a piece, with the status last.  Raises `StoreError`."""
        import xarray as xr
        import zarr

        parts = {name: (tuple(region), values) for name, values in done.arrays.items()}
        status = {"status": parts.pop("status")}
        try:
            if done.failures:
                facts = zarr.open_group(self.place, mode="r+", use_consolidated=True).attrs
                both = {**_failures(facts), **done.failures}
                facts["failures"] = json.dumps(dict(islice(both.items(), _MOST_FAILURES)), ensure_ascii=False)
            for variables in (parts, status):
                xr.Dataset(variables).to_zarr(self.place, region=region, consolidated=False)
        except (OSError, ValueError) as error:
            raise StoreError(f"{str(self.place)!r} cannot be written ({error}).  {self.resume_hint}") from error

    def dataset(self) -> xr.Dataset:
        """Return the results; unfinished cells have the status 0."""
        return _loaded(self.place)


def _failures(facts: Mapping[str, Any]) -> dict[str, str]:
    return dict(json.loads(facts.get("failures", "{}")))


def _fill(place: Path | MemoryStore, plan: Plan, piece: tuple[int, ...]) -> None:
    """Write the attributes of a store, its axes, and its arrays without any chunk."""
    from zarr.codecs import Crc32cCodec, ZstdCodec

    cells = _empty(plan, piece)
    # Checksums reveal incomplete files.  The doubles look random, so compression would cost more than it saves.
    packed: dict[Any, Any] = {name: {"compressors": (Crc32cCodec(),)} for name in cells.data_vars}
    packed["status"] = {"compressors": (ZstdCodec(level=1, checksum=True),), "fill_value": 0}
    with warnings.catch_warnings():
        # Without consolidated metadata `xr.open_zarr` warns; with them Zarr says that its specification lacks them.
        warnings.filterwarnings("ignore", "Consolidated metadata is currently not part")
        cells.to_zarr(place, compute=False, zarr_format=3, consolidated=True, encoding=packed)


def _empty(plan: Plan, piece: tuple[int, ...]) -> xr.Dataset:
    """Return a Dataset without finished cells, with names, units and coordinates.  Raises `InvalidParameter`."""
    import dask.array
    import xarray as xr

    what = plan.computation

    def full(value: float | np.uint8, name: str, symbol: str = "", units: str = "1", **about: Any) -> Any:
        cells = dask.array.full(plan.shape, value, chunks=piece, dtype=np.asarray(value).dtype)
        return tuple(plan.axes), cells, {"long_name": name, "symbol": symbol or name, "units": units, **about}

    variables = {}
    for own, name in plan.variables.items():
        one = what.number(name)
        variables[own] = full(math.nan, one.title, one.symbol, one.unit)
        if one.error is not None:
            variables[f"{own}_error"] = full(math.nan, f"estimated error: {one.title}", f"δ{one.symbol}", one.unit)
    words = " ".join(one.words.replace(" ", "_") for one in Outcome)
    variables["status"] = full(
        np.uint8(0), "how each cell ended", flag_values=[int(one) for one in Outcome], flag_meanings=words
    )
    if taken := set(variables) & {one.name for one in what.parameters}:
        raise InvalidParameter(f"{what.key} has a number and a parameter {min(taken)!r}: choose another name for one.")
    axes = {}
    for name, values in plan.axes.items():
        of = what.parameter(name)
        about = {"long_name": of.label, "description": of.doc, "symbol": of.symbol, "units": of.unit}
        axes[name] = (name, values, about)
    return xr.Dataset(variables, axes, _facts(plan))


def _facts(plan: Plan) -> dict[str, str]:
    return {
        "program": _PROGRAM,
        "computation": plan.computation.key,
        "title": plan.computation.title,
        "numbers": ", ".join(plan.numbers),
        "level": plan.level,
        "version": version(),
        "parameters": json.dumps(dict(plan.fixed), ensure_ascii=False, sort_keys=True),
        "source": plan.source,
    }


@contextmanager
def _reading(place: Path | MemoryStore, message: str) -> Iterator[None]:
    try:
        yield
    except _DAMAGED as error:
        raise StoreError(f"{str(place)!r} {message}") from error


def _open(place: Path | MemoryStore) -> xr.Dataset:
    """Return the Dataset of a store, not loaded.  Raises `StoreError`."""
    import xarray as xr

    with _reading(place, "does not contain a sweep: choose another folder."):
        found = xr.open_zarr(place, zarr_format=3, consolidated=True, chunks=None)
        if found.attrs["program"] != _PROGRAM:
            raise ValueError
        # Zarr sorts the names.
        own = [f"{name.replace('-', '_')}{end}" for name in found.numbers.split(", ") for end in ("", "_error")]
        return found[[*(name for name in own if name in found), "status"]]


def _loaded(place: Path | MemoryStore) -> xr.Dataset:
    found = _open(place)
    with _reading(place, "has a part that cannot be read: run the same sweep again to recompute it."):
        return found.load().drop_encoding() if found.status.size <= MAX_CELLS else found


def opened(path: Path, plan: Plan) -> Store | None:
    """Return the store of this sweep, or None if the path does not exist.  Raises `OtherSweep`, `StoreError`."""
    try:
        if not path.exists() or (path.is_dir() and not any(path.iterdir())):
            return None
    except OSError as error:
        raise StoreError(f"{str(path)!r} cannot be read ({error.strerror}); choose another folder.") from error
    if why := _difference(_open(path), plan):
        raise OtherSweep(
            f"{str(path)!r} contains another sweep: it {why}.  Choose another folder, or repeat that sweep."
        )
    return Store(path, plan)


def _difference(stored: xr.Dataset, plan: Plan) -> str:
    """Return what distinguishes the sweep of a store, as the end of a sentence; empty for the same sweep."""
    if stored.attrs["computation"] == plan.computation.key and stored.attrs["source"] != plan.source:
        return f"has another text of the function {plan.computation.key}"
    for name, values in plan.axes.items():
        if name not in stored.dims or not np.array_equal(stored[name], values):
            return f"is not over the same values of {name}"
    held, own = ({**facts, **json.loads(facts["parameters"])} for facts in (stored.attrs, _facts(plan)))
    for name in own.keys() - {"parameters"}:
        if held.get(name) != own[name]:
            return f"has {name} = {held.get(name)}, not {own[name]}"
    return ""


def path_of(place: str | Path) -> Path:
    """Return the path of a store.  Raises `InvalidParameter`."""
    if not isinstance(place, str | Path):
        raise InvalidParameter(f"{place!r} is not the name of a folder: write it like 'rho.zarr'.")
    return Path(place)


def read(path: str | Path) -> xr.Dataset:
    """Return the Dataset of a saved sweep, finished or not, also while it is computed.

    Parameters
    ----------
    path : str or Path
        Folder of the store.

    Returns
    -------
    xarray.Dataset
        The results, loaded into memory up to ten million cells and lazily above that.

    Raises
    ------
    StoreError
        If there is no store, or a part of it cannot be read.
    """
    require_libraries()
    return _loaded(path_of(path))
