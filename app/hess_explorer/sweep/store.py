"""The Zarr group of a sweep, on disk or in memory, which xarray writes region by region.

The chunks are the pieces of the sweep; each is a complete file or missing.  The status of a piece is written after its
values, so a piece with a status is finished, even if the run was killed.  Unreadable pieces are computed again.
"""

from __future__ import annotations

import json
import shutil
import uuid
from collections.abc import Iterator
from contextlib import contextmanager
from importlib.util import find_spec
from itertools import islice
from pathlib import Path
from textwrap import shorten
from typing import TYPE_CHECKING, Any

import numpy as np

from hess_explorer.compute.cells import Outcome
from hess_explorer.sweep.errors import OtherSweep, StoreError
from hess_explorer.sweep.piece import PieceResult
from hess_explorer.sweep.plan import Region, SweepPlan, version
from hess_mechanics.errors import MissingLibrary

if TYPE_CHECKING:
    import xarray as xr
    from zarr.storage import MemoryStore

_MOST_FAILURES = 1000
_DECODING_ERRORS = (OSError, ValueError, RuntimeError, KeyError)
"""Errors that reading an incomplete or foreign file raises."""


def require_libraries() -> None:
    """Raise `MissingLibrary` unless xarray, Zarr and Dask are installed."""
    if any(find_spec(name) is None for name in ("xarray", "zarr", "distributed")):
        raise MissingLibrary("Sweeps need xarray, Zarr and Dask: pip install 'hess-explorer[sweep]'.")


def create(path: Path | None, plan: SweepPlan, cells: float) -> Path | MemoryStore:
    """Create a store with pieces of at most `cells` cells; without a path it is in memory.

    Raises `StoreError` if the folder cannot be written, `OtherSweep` if another process has filled it.
    """
    if path is None:
        from zarr.storage import MemoryStore

        memory = MemoryStore()
        _fill(memory, plan, cells)
        return memory
    begun = path.with_name(f"{path.name}.begun-{uuid.uuid4().hex}")
    try:
        _fill(begun, plan, cells)
        # Renaming makes the creation atomic; it fails if another process has filled the folder.
        begun.rename(path)
    except OSError as error:
        shutil.rmtree(begun, ignore_errors=True)
        if not exists(path, plan):
            raise StoreError(f"{str(path)!r} cannot be written ({error.strerror}); choose another folder.") from error
    return path


def _fill(place: Path | MemoryStore, plan: SweepPlan, cells: float) -> None:
    """Write the attributes, the axes and the empty arrays of a store."""
    import dask.array
    import xarray as xr
    from zarr.codecs import ZstdCodec

    chunks = dask.array.core.normalize_chunks("auto", plan.shape, limit=cells, dtype=np.uint8)
    dimensions, nothing = tuple(plan.axes), dask.array.full(plan.shape, np.nan, chunks=chunks)
    variables: dict[str, Any] = {}
    for own, name in plan.variables.items():
        one = plan.computation.number(name)
        about = {"long_name": one.title, "symbol": one.symbol, "units": one.unit}
        variables[own] = dimensions, nothing, about
        if one.error_reader is not None:
            variables[f"{own}_error"] = dimensions, nothing, {**about, "long_name": f"estimated error: {one.title}"}
    flags = {"flag_values": [*map(int, Outcome)], "flag_meanings": " ".join(o.words.replace(" ", "_") for o in Outcome)}
    status = dask.array.zeros(plan.shape, dtype=np.uint8, chunks=chunks)
    variables["status"] = dimensions, status, {"long_name": "how each cell ended", "units": "1", **flags}
    axes = {}
    for name, values in plan.axes.items():
        of = plan.computation.parameter(name)
        axes[name] = name, values, {"long_name": of.label, "symbol": of.symbol, "units": of.unit}
    facts = {**_facts(plan), "variables": ", ".join(variables), "failures": "{}"}
    # Checksums reveal incomplete files.
    packed = {name: {"compressors": (ZstdCodec(level=1, checksum=True),)} for name in variables}
    # The specification of Zarr 3 has no consolidated metadata.
    whole = xr.Dataset(variables, axes, facts)
    whole.to_zarr(place, compute=False, zarr_format=3, consolidated=False, encoding=packed)


def _facts(plan: SweepPlan) -> dict[str, str]:
    return {
        "computation": plan.computation.key,
        "title": plan.computation.title,
        "numbers": ", ".join(plan.numbers),
        "accuracy": plan.accuracy,
        "version": version(),
        "parameters": json.dumps(plan.fixed, sort_keys=True),
        "source": plan.source,
    }


def exists(path: Path, plan: SweepPlan) -> bool:
    """Return True if the path contains a store of this sweep, False if it is free.

    Raises `OtherSweep` if it contains another sweep, `StoreError` if it contains anything else.
    """
    if not path.exists() or (path.is_dir() and not any(path.iterdir())):
        return False
    stored = _open(path)
    other = [
        f"{name} = {shorten(str(stored.attrs.get(name)), 80)}, not {shorten(value, 80)}"
        for name, value in _facts(plan).items()
        if stored.attrs.get(name) != value
    ]
    axes = plan.axes.items()
    other += [f"other values of {name}" for name, values in axes if not np.array_equal(stored.get(name, ()), values)]
    if other:
        raise OtherSweep(f"{str(path)!r} contains another sweep: it has {other[0]}.  Choose another folder.")
    return True


def missing(place: Path | MemoryStore, plan: SweepPlan) -> list[Region]:
    """Return the regions of the unfinished pieces."""
    from dask.array.core import normalize_chunks, slices_from_chunks

    stored = _open(place)
    chunks = normalize_chunks(stored.status.encoding["chunks"], plan.shape)
    regions = (dict(zip(plan.axes, one, strict=True)) for one in slices_from_chunks(chunks))
    return [region for region in regions if not _is_finished(stored.isel(region), plan)]


def _is_finished(part: xr.Dataset, plan: SweepPlan) -> bool:
    """Return True if a piece is readable, each cell has a status, and each cell with a value has a finite number."""
    try:
        status = part.status.values
        if not status.all():
            return False
        part.load()
    except _DECODING_ERRORS:
        return False
    finite = np.any([np.isfinite(part[name]) for name in plan.variables], axis=0)
    return bool((finite | (status >= Outcome.OUTSIDE_REGION)).all())


def write(place: Path | MemoryStore, region: Region, done: PieceResult) -> None:
    """Save a piece, its status last.  Raises `StoreError` if the store cannot be written."""
    import xarray as xr
    import zarr

    arrays, failures = done
    parts = {name: (tuple(region), values) for name, values in arrays.items()}
    status = {"status": parts.pop("status")}
    try:
        if failures:
            facts = zarr.open_group(place, mode="r+", use_consolidated=False).attrs
            both = json.loads(str(facts["failures"])) | failures
            # Sort the failures, so that their order does not depend on the workers.
            facts["failures"] = json.dumps(dict(islice(sorted(both.items()), _MOST_FAILURES)))
        for variables in (parts, status):
            xr.Dataset(variables).to_zarr(place, region=region, consolidated=False)
    except (OSError, ValueError) as error:
        raise StoreError(
            f"{str(place)!r} cannot be written ({error}): check the free space and the permissions."
        ) from error


@contextmanager
def _reading(place: Any, message: str) -> Iterator[None]:
    try:
        yield
    except _DECODING_ERRORS as error:
        raise StoreError(f"{str(place)!r} {message}") from error


def _open(place: Path | MemoryStore) -> xr.Dataset:
    """Open the Dataset of a store without loading it.  Raises `StoreError`."""
    import xarray as xr

    with _reading(place, "does not contain a sweep: choose another folder."):
        found = xr.open_zarr(place, zarr_format=3, consolidated=False, chunks=None)
        # Restore the order of the variables, which Zarr does not keep.
        ordered: xr.Dataset = found[found.attrs["variables"].split(", ")]
        return ordered


def load(place: Path | MemoryStore) -> xr.Dataset:
    """Load the results of a store; unfinished cells have the status 0.  Raises `StoreError`."""
    found = _open(place)
    with _reading(place, "has a part that cannot be read: run the same sweep again to recompute it."):
        return found.load().drop_encoding()


def read(path: str | Path) -> xr.Dataset:
    """Read the results of a stored sweep, which may be unfinished or still running.

    Parameters
    ----------
    path : str or Path
        Folder of the store.

    Returns
    -------
    xarray.Dataset
        The results, as `sweep` returns them; unfinished cells have the status 0.

    Raises
    ------
    StoreError
        If there is no store, or a part of it cannot be read.

    Examples
    --------
    >>> import tempfile
    >>> from hess_explorer.sweep import read, sweep
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     result = sweep("circle-map", over={"h": [1.2, 1.5]}, store=f"{folder}/map.zarr")
    ...     read(f"{folder}/map.zarr").identical(result)
    True
    """
    require_libraries()
    return load(Path(path))
