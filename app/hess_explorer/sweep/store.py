"""A resumable Zarr store of a sweep.

The chunks of the store are the boxes of the sweep; a file, a shard of Zarr, has several of them.  For each box the
values are written first and the status last, each file under a temporary name until it is complete.  A box with a
status is therefore finished, whenever the run ended.  A box that cannot be read, or that lacks a value, is computed
again.
"""

from __future__ import annotations

import json
import math
import shutil
import uuid
from collections import Counter
from collections.abc import Iterator, Sequence
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from hess_explorer.sweep.errors import OtherSweep, StoreError
from hess_explorer.sweep.grid import MAX_NUMBERS, Box, Part, SweepGrid, boxes, size
from hess_explorer.sweep.quantity import Outcome, Quantity
from hess_explorer.sweep.result import PROGRAM, empty, names, parts, require_libraries, slices, with_failures
from hess_explorer.sweep.work import ChunkResult, version
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array

if TYPE_CHECKING:
    import xarray as xr

__all__ = ["FILES", "Store", "StoreStatus", "opened", "path_of", "read", "store_status"]

_FAILURES = "failures.jsonl"
"""File of a store: a line [cell, text] for each exception, see `named`."""
_PARTS = "parts"
"""Attribute of a store: the number of parts of the job array that began it."""
_MOST_NUMBERS = 500_000
"""Maximum number of values of a file with several boxes, 4 MB, which are written again with each of them."""
_MOST_BOXES = 64
"""Maximum number of boxes of a file."""
FILES = 4
"""Minimum number of files per part, if there are enough boxes: parts take about equally long."""


class Store:
    """Finished boxes in a Zarr store.

    Attributes
    ----------
    path : its folder.
    shape : shape of a box.
    shards : shape of the cells in a file.
    parts : number of parts of a job array.
    """

    def __init__(self, path: Path, what: Quantity, grid: SweepGrid) -> None:
        """Open the store.  Raises `StoreError`."""
        import zarr

        self.path, self._what, self._grid = path, what, grid
        group = _group(path, "r+")
        found = {name: group.get(name) for name in names(what)}
        if not all(isinstance(array, zarr.Array) and array.shards for array in found.values()):
            raise StoreError(f"{str(path)!r} is a damaged or incomplete store: choose another folder.")
        self._arrays: dict[str, Any] = found
        self.shape: tuple[int, ...] = found["status"].chunks
        self.shards: tuple[int, ...] = found["status"].shards
        self.parts = int(group.attrs.get(_PARTS, 1))

    @classmethod
    def create(
        cls, path: Path, what: Quantity, grid: SweepGrid, level: str, shape: tuple[int, ...], parts: int = 1
    ) -> Store:
        """Create an empty store with boxes of this shape, or open the same one if another process was faster.

        Raises `OtherSweep`, `StoreError`.
        """
        begun = path.with_name(f"{path.name}.begun-{uuid.uuid4().hex}")
        try:
            _fill(begun, what, grid, level, shape, parts)
            # Renaming makes the creation atomic; it fails if another process has filled the folder.
            begun.rename(path)
        except OSError as error:
            shutil.rmtree(begun, ignore_errors=True)
            if (other := opened(path, what, grid, level, parts)) is not None:
                return other
            raise StoreError(f"{str(path)!r} cannot be written ({error.strerror}); choose another folder.") from error
        return cls(path, what, grid)

    @property
    def resume_hint(self) -> str:
        """A sentence on where the results are and how to resume."""
        return f"Finished cells are saved in {str(self.path)!r}: run the same sweep again to continue."

    def require(self, level: str) -> None:
        """Raise `OtherSweep` if the store was created for a different sweep."""
        grid = self._grid
        held = _group(self.path, "r").attrs
        wanted = {"quantity": self._what.name, "level": level, "version": version()}
        for name, value in wanted.items():
            if held.get(name) != value:
                self._refuse(f"has {name} {held.get(name)!r}, not {value!r}")
        if held.get("source") != self._what.source:
            self._refuse(f"has another text of the function {self._what.name}")
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
        own = slices(box)
        *arrays, status = self._arrays.values()
        try:
            ended = status[own]
            if not ended.all():
                return False
            values = [array[own] for array in arrays]
        # The decoder raises many types of errors for an incomplete file.
        except (OSError, ValueError, RuntimeError):
            return False
        known = (ended >= Outcome.OK) & (ended < Outcome.OUTSIDE_REGION)
        return all(np.isfinite(one[known]).all() for one in values[: len(self._what.variables)])

    def cells(self, part: Part | None) -> int:
        """Return the number of cells of a part."""
        return sum(map(size, self._files(part)))

    def missing(self, part: Part | None) -> list[Box]:
        """Return the boxes of a part that are not finished, file by file."""
        found: list[Box] = []
        for file in self._files(part):
            if not self.has(file):
                inside = boxes(file, self.shape)
                found += inside if self._is_empty(file) else (box for box in inside if not self.has(box))
        return found

    def _files(self, part: Part | None) -> Iterator[Box]:
        """Yield the cells of each file of a part."""
        for number, file in enumerate(self._grid.boxes(self.shards)):
            if part is None or _part_of(number, part[1]) == part[0]:
                yield file

    def _is_empty(self, file: Box) -> bool:
        try:
            return not self._arrays["status"][slices(file)].any()
        except (OSError, ValueError, RuntimeError):
            return False

    def write(self, box: Box, done: ChunkResult) -> None:
        """Save a box, with the status last."""
        try:
            # A file is read and written again with the box; simultaneous runs take turns.
            with _alone(self.path):
                if done.failures:
                    with (self.path / _FAILURES).open("a", encoding="utf-8") as file:
                        file.writelines(f"{json.dumps(one)}\n" for one in done.failures.items())
                for array, part in zip(self._arrays.values(), parts(self._what, done), strict=True):
                    self._put(array, box, part)
        except OSError as error:
            raise StoreError(f"{str(self.path)!r} cannot be written ({error.strerror}).  {self.resume_hint}") from error

    def _put(self, array: Any, box: Box, part: Array) -> None:
        """Write a box of an array, after removing its file if that is damaged: `has` is False for all boxes in it."""
        try:
            array[slices(box)] = part
        except (ValueError, RuntimeError):
            file = [low // side for (low, _), side in zip(box, self.shards, strict=True)]
            key = array.metadata.encode_chunk_key((*file, *[0] * (array.ndim - len(file))))
            (self.path / array.basename / key).unlink()
            array[slices(box)] = part

    def dataset(self) -> xr.Dataset:
        """Return the results, loaded up to `MAX_NUMBERS` values and lazily above that."""
        return read(self.path)


def _part_of(file: int, parts: int) -> int:
    """Return the part to which a file belongs; neighbouring files, which cost the same, belong to different parts."""
    return file % parts + 1


@dataclass(frozen=True)
class StoreStatus:
    """What a store contains and what is missing.

    Attributes
    ----------
    cells : int
        Number of cells.
    missing : int
        Number of cells that are not computed, or that cannot be read.
    parts : int
        Number of parts of the job array that began the store; 1 for a single run.
    missing_parts : tuple of int
        The parts that are not finished, counted from 1.
    """

    cells: int
    missing: int
    parts: int
    missing_parts: tuple[int, ...]


def store_status(path: str | Path) -> StoreStatus:
    """Return what is missing in a store, also while a sweep writes to it.

    Parameters
    ----------
    path : str or Path
        Folder of the store.

    Returns
    -------
    StoreStatus
        Numbers of cells, and the parts of a job array that have to run again.

    Raises
    ------
    StoreError
        If there is no store.

    Examples
    --------
    >>> import tempfile
    >>> from hess_explorer.sweep import store_status, sweep
    >>> with tempfile.TemporaryDirectory() as folder:
    ...     chart = sweep("cos-chi", over={"I11": (1.0, 3.0, 5)}, store=f"{folder}/chi.zarr")
    ...     store_status(f"{folder}/chi.zarr").missing
    0
    """
    require_libraries()
    group = _sweep_group(path_of(path))
    status, parts = group["status"], int(group.attrs.get(_PARTS, 1))
    missing: Counter[int] = Counter()
    for number, file in enumerate(boxes(tuple((0, whole) for whole in status.shape), status.shards)):
        try:
            left = int(np.count_nonzero(status[slices(file)] == Outcome.NOT_COMPUTED))
        except (OSError, ValueError, RuntimeError):
            left = size(file)
        missing += Counter({_part_of(number, parts): left})
    return StoreStatus(math.prod(status.shape), missing.total(), parts, tuple(sorted(missing)))


def _fill(folder: Path, what: Quantity, grid: SweepGrid, level: str, shape: tuple[int, ...], parts: int) -> None:
    """Write the metadata of a store, its axes and its empty arrays."""
    from zarr.codecs import Crc32cCodec, ZstdCodec

    cells = empty(what, grid, level, lambda of, value: np.broadcast_to(value, of))
    shards = _shards(grid, shape, what.numbers, parts)
    # Checksums reveal incomplete files.  The doubles of a quantity look random, so compression would cost more than it
    # saves; the status is mostly one number.
    packed = {"status": ZstdCodec(level=1, checksum=True)}
    cells.drop_vars(list(cells.data_vars)).to_zarr(folder, zarr_format=3, consolidated=False)
    group = _group(folder, "r+")
    if parts > 1:
        group.attrs[_PARTS] = parts
    for name, one in cells.data_vars.items():
        group.create_array(
            name,
            shape=one.shape,
            dtype=one.dtype,
            chunks=(*shape, *one.shape[len(shape) :]),
            shards=(*shards, *one.shape[len(shape) :]),
            compressors=(packed.get(str(name), Crc32cCodec()),),
            fill_value=one.values.flat[0],
            dimension_names=one.dims,
            attributes=one.attrs,
        )
    _consolidate(folder, [*map(str, (*cells.coords, *cells.data_vars))])


def _consolidate(folder: Path, names: Sequence[str]) -> None:
    """Copy the metadata of all arrays into that of the group, without which `xr.open_zarr` warns.

    xarray keeps the order of these names; `zarr.consolidate_metadata` would sort them, and warn that this part of the
    format is not in its specification.
    """
    root = folder / "zarr.json"
    said = json.loads(root.read_text(encoding="utf-8"))
    said["consolidated_metadata"] = {
        "kind": "inline",
        "must_understand": False,
        "metadata": {name: json.loads((folder / name / "zarr.json").read_text(encoding="utf-8")) for name in names},
    }
    root.write_text(json.dumps(said, indent=2), encoding="utf-8")


def _shards(grid: SweepGrid, shape: tuple[int, ...], numbers: int, parts: int) -> tuple[int, ...]:
    """Return the shape of the cells in a file, a multiple of that of a box: few files, each quickly written again."""
    shards = larger = shape
    while (
        math.prod(larger) <= min(_MOST_NUMBERS // numbers, _MOST_BOXES * math.prod(shape))
        and (parts == 1 or len(list(grid.boxes(larger))) >= FILES * parts)
    ) or larger == shape:
        shards = larger
        # The side along which most files lie grows.
        files = [whole / side for whole, side in zip(grid.shape, shards, strict=True)]
        if max(files) <= 1.0:
            break
        larger = tuple(side * (1 + (i == files.index(max(files)))) for i, side in enumerate(shards))
    return shards


@contextmanager
def _alone(path: Path) -> Iterator[None]:
    """Wait until no other process writes to the store, where the system has such locks."""
    try:
        import fcntl
    except ImportError:
        yield
        return
    # A file that never changes, opened for writing, which network file systems ask for.
    with (path / "zarr.json").open("r+b") as lock:
        # Without locks only parts of a job array can run simultaneously, since they write to different files.
        with suppress(OSError):
            fcntl.flock(lock, fcntl.LOCK_EX)
        yield


def _group(path: Path, mode: Any) -> Any:
    import zarr

    try:
        return zarr.open_group(path, mode=mode, zarr_format=3, use_consolidated=False)
    except (OSError, ValueError) as error:
        raise StoreError(f"{str(path)!r} does not contain a sweep: choose another folder.") from error


def _sweep_group(path: Path) -> Any:
    found = _group(path, "r")
    if found.attrs.get("program") != PROGRAM:
        raise StoreError(f"{str(path)!r} does not contain a sweep: choose another folder.")
    return found


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

    path = path_of(path)
    if _exists(path) and path.is_file():
        # Imported here, because only charts depend on scenes.
        from hess_explorer.sweep.chart_file import read_chart

        return read_chart(path)
    _sweep_group(path)
    found: xr.Dataset = xr.open_zarr(path, zarr_format=3, chunks=None)
    try:
        found = found.load() if math.prod(found.sizes.values()) <= MAX_NUMBERS else found
        return with_failures(found, _failures(path / _FAILURES))
    except (OSError, ValueError, RuntimeError) as error:
        raise StoreError(
            f"A part of {str(path)!r} cannot be read: run the same sweep again to recompute it."
        ) from error


def _failures(file: Path) -> dict[str, str]:
    """Return the texts of the exceptions by cell; a run that was killed may have left half a line."""
    found: dict[str, str] = {}
    if file.exists():
        for line in file.read_text(encoding="utf-8").splitlines():
            with suppress(ValueError):
                found |= [json.loads(line)]
    return found


def path_of(place: str | Path) -> Path:
    """Return the path of a store or chart.  Raises `InvalidParameter`."""
    if not isinstance(place, str | Path):
        raise InvalidParameter(f"{place!r} is not the name of a folder or file: write it like 'rho.zarr'.")
    return Path(place)


def _exists(path: Path) -> bool:
    try:
        return path.exists()
    except OSError as error:
        raise StoreError(f"{str(path)!r} cannot be read ({error.strerror}); choose another folder.") from error


def opened(path: Path, what: Quantity, grid: SweepGrid, level: str, parts: int = 1) -> Store | None:
    """Return the store of this sweep, or None if the path does not exist.  Raises `OtherSweep`, `StoreError`."""
    if not _exists(path) or (path.is_dir() and not any(path.iterdir())):
        return None
    held = _group(path, "r").attrs
    if held.get("program") == PROGRAM and held.get("quantity") != what.name:
        raise OtherSweep(
            f"{str(path)!r} contains another sweep: it has quantity {held['quantity']!r}, not {what.name!r}.  "
            "Choose another folder, or repeat that sweep."
        )
    found = Store(path, what, grid)
    found.require(level)
    if parts not in (1, found.parts):
        raise OtherSweep(
            f"{str(path)!r} was begun in {found.parts} parts, not {parts}: use the same number, or no part to compute "
            "all that is missing."
        )
    return found
