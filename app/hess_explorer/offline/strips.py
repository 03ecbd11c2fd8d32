"""Strips: the arrays of consecutive states, quantised, coded by differences, and compressed.

An array is quantised to whole numbers q = 1 + round(x/step) − low, and 0 for NaN.  They are coded by differences modulo
2³²: from the same array of the previous state if both have the same length, and along the array.  These differences are
small, because neighbouring states and neighbouring points of a curve differ little.  They are stored byte by byte, the
lowest bytes of all arrays first, and compressed; without this order the files are 1.6 times as large.
"offline/strip.js" reverses this.
"""

from __future__ import annotations

import json
import struct
import zlib
from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

from hess_explorer.views.layers import Axes
from hess_explorer.views.plot import Plot
from hess_mechanics.numerics.results import Array

PIXELS = 16_000
"""Steps across a plot: an eighth of a pixel of a picture that is 2000 pixels wide."""
EXACT = 0.0
"""Step of an array that is stored bit by bit in single precision."""

_SPAN = 2**17
"""Steps across the extent of an array that is not a coordinate of a plot, such as a direction on a sphere."""
_SHADES = 2**11
"""Steps across the extent of an image, which has 256 colours."""
_SMALL = 8
"""Arrays with at most this many numbers are stored to 2⁻²² of their largest magnitude."""
_LARGEST = 2.0**31


def steps_of_plots(plots: Sequence[tuple[Plot[Any], Axes]]) -> dict[str, dict[str, float]]:
    """Return the quantisation step of each column that is a coordinate of a plot, by source and column.

    Parameters
    ----------
    plots : sequence of (Plot, Axes)
        The plots and their axes.  A column of several plots has the smallest of their steps.

    Returns
    -------
    dict
        Steps in the units of the column, by source and column; `EXACT` for a logarithmic axis.
    """
    found: dict[str, dict[str, float]] = {}
    for plot, axes in plots:
        for layer in plot.all_layers:
            steps = found.setdefault(plot.source_of(layer), {})
            for place, column in enumerate(layer.columns[:2]):
                side, (low, high) = ("x", axes.x) if place == 0 else ("y", axes.y)
                step = EXACT if side in plot.log else (high - low) / PIXELS
                steps[column] = min(step, steps.get(column, step))
    return found


def _step(values: Array, column: str, step: float | None) -> float:
    """Return the quantisation step of an array in single precision; `step` is the step of its plot, if any."""
    if step == EXACT:
        return EXACT
    finite = values[np.isfinite(values)]
    if len(finite) == 0:
        return 1.0
    low, high = float(finite.min()), float(finite.max())
    extent = high - low
    if np.isinf(values).any():
        return EXACT
    if extent < _SPAN and np.array_equal(finite, np.rint(finite)):
        return 1.0
    if values.size <= _SMALL:
        return max(abs(low), abs(high)) / 2**22
    step = step or extent / (_SHADES if column == "image" else _SPAN)
    # Store values exactly if they are all equal, or if multiples of the step would overflow far beyond the plot.
    return step if extent < _LARGEST * step else EXACT


def _quantise(values: Array, step: float) -> tuple[int, np.ndarray]:
    """Quantise an array: return the least multiple of the step, and the whole numbers (n,).

    For the step `EXACT`, return 0 and the bits of the single-precision numbers.
    """
    if step == EXACT:
        return 0, values.view(np.uint32)
    finite = np.isfinite(values)
    multiples = np.rint(values[finite].astype(np.float64) / step).astype(np.int64)
    low = int(multiples.min()) if len(multiples) else 0
    whole = np.zeros(len(values), dtype=np.uint32)
    whole[finite] = 1 + multiples - low
    return low, whole


class OfflineStrip:
    """A sequence of states under construction: trees of pictures, texts and controls with their arrays.

    Attributes
    ----------
    trees : list of dict
        The tree of each state, see `Wire.pack`; arrays are replaced by their positions in the strip.
    size : int
        Number of stored numbers.
    """

    def __init__(self) -> None:
        self.trees: list[Any] = []
        self._arrays: list[list[float]] = []
        self._starts: list[int] = []
        self._wholes: list[np.ndarray] = []
        self._residuals: list[np.ndarray] = []
        # Maps a position in the tree to the number of its array in the last state.
        self._last: dict[str, int] = {}
        self.size = 0

    def add(self, tree: Mapping[str, Any], block: bytes, steps: Mapping[str, Mapping[str, float]]) -> None:
        """Append a state.

        Parameters
        ----------
        tree, block : mapping and bytes
            The result of `Wire.pack`, of one complete state.
        steps : mapping
            Quantisation steps by source and column, see `steps_of_plots`.
        """
        numbers = np.frombuffer(block, dtype="<f4")
        places: dict[str, int] = {}

        def stored(item: Any, path: str, source: str, column: str) -> Any:
            if isinstance(item, list):
                return [stored(part, f"{path}/{i}", source, column) for i, part in enumerate(item)]
            if not (isinstance(item, dict) and "at" in item):
                return item
            values = numbers[item["at"] : item["at"] + item["n"]]
            known = EXACT if "shorts" in item else steps.get(source, {}).get(column)
            number = places[path] = self._array(values, column, known, self._last.get(path))
            return {**item, "at": self._starts[number]}

        sources = {
            source: {name: stored(item, f"{source}/{name}", source, name) for name, item in columns.items()}
            for source, columns in tree["sources"].items()
        }
        self.trees.append({**tree, "sources": sources})
        self._last = places

    def _array(self, values: Array, column: str, step: float | None, before: int | None) -> int:
        """Store an array unless it equals its predecessor; return its number."""
        step = _step(values, column, step)
        if before is not None and len(self._wholes[before]) != len(values):
            before = None
        if before is not None:
            _, step_before, low_before, _ = self._arrays[before]
            # Keep the previous step if it is fine enough, because differences of equal steps compress better.
            if EXACT not in (step, step_before) and 1.0 <= step / step_before <= 2.0:
                step = step_before
        low, whole = _quantise(values, step)
        away = whole
        if before is not None:
            if (step, low) == (step_before, low_before) and np.array_equal(whole, self._wholes[before]):
                return before
            away = whole - self._wholes[before]
        self._starts.append(self.size)
        self._arrays.append([len(values), step, low, -1 if before is None else before])
        self._wholes.append(whole)
        self._residuals.append(np.diff(away, prepend=np.uint32(0)).view(np.int32))
        self.size += len(values)
        return len(self._wholes) - 1

    def pack(self) -> bytes:
        """Return the compressed strip: the length of its head, the head as JSON, the bytes of the differences."""
        signed = np.concatenate([np.empty(0, np.int32), *self._residuals])
        zigzag = ((signed << 1) ^ (signed >> 31)).astype("<u4")
        planes = zigzag.view(np.uint8).reshape(-1, 4).T
        kept = max((i + 1 for i in range(4) if planes[i].any()), default=0)
        head = json.dumps(
            {"trees": self.trees, "arrays": self._arrays, "planes": kept}, ensure_ascii=False, allow_nan=False
        ).encode()
        return zlib.compress(struct.pack("<I", len(head)) + head + planes[:kept].tobytes(), 9)
