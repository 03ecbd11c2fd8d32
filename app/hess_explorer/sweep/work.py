"""A unit of work of a sweep, its result, and the measured cost of a cell."""

from __future__ import annotations

import pickle
import time
from collections.abc import Mapping
from dataclasses import dataclass, field
from functools import cache, lru_cache
from importlib import metadata

import numpy as np

from hess_explorer.sweep.errors import WorkersLost
from hess_explorer.sweep.grid import SweepGrid, expanded
from hess_explorer.sweep.quantities import quantity
from hess_explorer.sweep.quantity import Outcome, Outcomes, Quantity, evaluate
from hess_mechanics.numerics.accuracy import Level, level
from hess_mechanics.numerics.results import Array

__all__ = ["Chunk", "ChunkResult", "compute", "cost_of_a_cell", "named", "version"]

_MOST_FAILURES = 100
"""Largest number of texts of exceptions of a box."""


@cache
def version() -> str:
    """Return the version of this package; results of different versions are not mixed."""
    try:
        return metadata.version("hess-explorer")
    except metadata.PackageNotFoundError:
        return "not installed"


@dataclass(frozen=True)
class Chunk:
    """A box of cells to compute: its parts of the axes, and all other inputs; a few kilobytes.

    quantity : its name; that of a function itself, or pickled for another process.
    """

    quantity: str | bytes | Quantity
    level: str
    version: str
    axes: Mapping[str, Array]
    fixed: Mapping[str, float]


@dataclass(frozen=True)
class ChunkResult:
    """The results of a box in its shape; values have one more axis for several numbers per cell.

    errors : one array, empty without an error estimate; failures : the text of the exception by cell, see `named`.
    """

    values: Array
    errors: tuple[Array, ...]
    status: Outcomes
    failures: Mapping[str, str] = field(default_factory=dict)


def named(cell: Mapping[str, float]) -> str:
    """Return the coordinates of a cell in words, with all digits."""
    return ", ".join(f"{name} = {float(value)!r}" for name, value in cell.items())


def compute(piece: Chunk) -> ChunkResult:
    """Compute a box.  Raises `WorkersLost` if this process has another version than the caller."""
    if piece.version != version():
        raise WorkersLost(
            f"A worker has version {version()} of hess-explorer, but the sweep needs {piece.version}: "
            "install the same version on all workers."
        )
    match piece.quantity:
        case str():
            what = quantity(piece.quantity)
        case bytes():
            what = _unpickled(piece.quantity)
        case _:
            what = piece.quantity
    found = evaluate(what, expanded(piece.axes, piece.fixed), level(piece.level))
    shape = tuple(part.size for part in piece.axes.values())
    failed = np.argwhere(found.status.reshape(shape) == Outcome.FAILED)[:_MOST_FAILURES]
    return ChunkResult(
        found.values.reshape(*shape, *found.values.shape[1:]),
        (found.errors.reshape(shape),) if what.error else (),
        found.status.reshape(shape),
        {
            named({name: part[i] for (name, part), i in zip(piece.axes.items(), cell, strict=True)}): found.why[
                int(np.ravel_multi_index(tuple(cell), shape))
            ]
            for cell in failed
        },
    )


@lru_cache(maxsize=1)
def _unpickled(content: bytes) -> Quantity:
    """Return the same object for all pieces, so that a function keeps what it has compiled."""
    found: Quantity = pickle.loads(content)
    return found


_LONG_ENOUGH = 0.05
"""Minimum duration in seconds of a trial that measures the cost of a cell."""
_PART = 128
"""A trial computes at most this fraction (1/128) of all cells."""
_PLACES = 4


def cost_of_a_cell(what: Quantity, grid: SweepGrid, accuracy: Level) -> float:
    """Return the cost of a cell in seconds, from trials at random cells of growing size; ∞ for few cells.

    The first cell is not counted, because it compiles or loads kernels.
    """
    if grid.cells <= _PART // 4:
        return float("inf")
    random = np.random.default_rng(0)
    _trial(what, grid, accuracy, 1, random)
    count = 1
    while True:
        cells, seconds = _trial(what, grid, accuracy, count, random)
        if seconds >= _LONG_ENOUGH or 2 * count * _PART > grid.cells:
            return seconds / cells
        count *= 2


def _trial(
    what: Quantity, grid: SweepGrid, accuracy: Level, count: int, random: np.random.Generator
) -> tuple[int, float]:
    """Return the number of cells and the seconds of a trial on some boxes."""
    places = min(_PLACES, count)
    shape = grid.box_of(count / places)
    cells, begun = 0, time.perf_counter()
    for _ in range(places):
        corner = [int(random.integers(whole - side + 1)) for whole, side in zip(grid.shape, shape, strict=True)]
        box = tuple((low, low + side) for low, side in zip(corner, shape, strict=True))
        cells += evaluate(what, expanded(grid.pieces(box), grid.fixed), accuracy).status.size
    return cells, time.perf_counter() - begun
