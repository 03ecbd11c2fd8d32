"""Pack the data of a state for the browser: all arrays in one message.

Bokeh would send each array of a source as a separate message, about fifty per state.  Here the arrays become one block
of bytes and a small tree with their positions.  In the browser "base/unpack.js" restores the columns of the sources.
All data of the pictures are sent this way.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

__all__ = ["Wire"]


class Wire:
    """Collects the changes of columns, axes, texts and controls, and packs them."""

    def __init__(self) -> None:
        self._pending: dict[str, Mapping[str, Any]] = {}
        self._texts: dict[str, str] = {}
        self._captions: dict[str, dict[str, str]] = {}
        self._ranges: dict[str, list[float]] = {}
        self._controls: dict[str, list[float] | str] = {}

    def put(self, source: str, columns: Mapping[str, Any]) -> None:
        """Set the columns of a source; a later call before `pack` replaces them."""
        self._pending[source] = columns

    def put_ranges(self, plot: str, x: tuple[float, float], y: tuple[float, float]) -> None:
        """Set the axis ranges of a plot."""
        self._ranges[plot] = [*x, *y]

    def set_text(self, key: str, text: str) -> None:
        """Set the text of a key, which the browser shows in the element of that key."""
        self._texts[key] = text

    def caption(self, picture: str, caption: dict[str, str]) -> None:
        """Set the caption of a picture: a dict of the fields of `Caption`."""
        self._captions[picture] = caption

    def show_number(self, name: str, value: float, limits: Sequence[float], idle: bool = False) -> None:
        """Set the value of a number's control and the (low, high, step) of its slider; `idle` disables it."""
        self._controls[name] = [value, *limits, *([True] if idle else [])]

    def show_choice(self, name: str, option: str) -> None:
        """Set the selected option of a menu."""
        self._controls[name] = option

    def pack(self) -> tuple[dict[str, Any], bytes]:
        """Return the tree and the block of all collected changes, and clear them.

        The tree has the keys "sources", "ranges", "texts", "captions" and "controls".  It represents an array by
        {"at": first, "n": length}, counted in single-precision numbers, and its "shape" unless that is (n,).  An array
        of 16-bit integers is stored with two integers per number; "shorts" is its length.  Lists and plain values are
        copied.
        """
        blocks: list[np.ndarray] = []
        position = 0

        def place(item: Any) -> Any:
            nonlocal position
            if isinstance(item, np.ndarray) and item.dtype == np.int16:
                pairs = np.resize(item.astype("<i2"), (item.size + 1) // 2 * 2).view("<f4")
                return {**place(pairs), "shorts": item.size}
            if isinstance(item, np.ndarray):
                block = np.ascontiguousarray(item, dtype="<f4")
                blocks.append(block)
                position += block.size
                shape = {} if block.ndim == 1 else {"shape": list(block.shape)}
                return {"at": position - block.size, "n": block.size, **shape}
            return [place(part) for part in item] if isinstance(item, list) else item

        sources = {
            source: {name: place(column) for name, column in columns.items()}
            for source, columns in self._pending.items()
        }
        tree = {
            "sources": sources,
            "ranges": self._ranges,
            "texts": self._texts,
            "captions": self._captions,
            "controls": self._controls,
        }
        self._pending, self._ranges, self._texts, self._captions, self._controls = {}, {}, {}, {}, {}
        return tree, b"".join(block.tobytes() for block in blocks)
