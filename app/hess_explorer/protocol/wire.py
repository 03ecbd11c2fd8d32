"""How new data reach the pictures: all columns of one state in one message.

Bokeh sends every array of a source as a message of its own, some fifty per state.  Here the
arrays become one block of bytes, and their places in it a small tree of numbers, which the
browser turns back into the sources' columns ("unpack.js").  A picture is filled in no other way.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np

__all__ = ["Wire"]


class Wire:
    """Collects the columns, axes, texts and control values that change, and packs them."""

    def __init__(self) -> None:
        self._pending: dict[str, Mapping[str, Any]] = {}
        self._texts: dict[str, str] = {}
        self._ranges: dict[str, list[float]] = {}
        self._controls: dict[str, list[float] | str] = {}

    def put(self, source: str, columns: Mapping[str, Any]) -> None:
        """New columns for the source of that name; the last ones put before `pack` count."""
        self._pending[source] = columns

    def put_ranges(self, plot: str, x: tuple[float, float], y: tuple[float, float]) -> None:
        """New axes for the plot of that name."""
        self._ranges[plot] = [*x, *y]

    def say(self, key: str, text: str) -> None:
        """A new text for the component `Text` of that key."""
        self._texts[key] = text

    def show_number(self, name: str, value: float, limits: Sequence[float], idle: bool = False) -> None:
        """What the control of a number shows: its value, (low, high, step) of its slider, whether it is disabled."""
        self._controls[name] = [value, *limits, *([True] if idle else [])]

    def show_choice(self, name: str, option: str) -> None:
        """What a menu shows."""
        self._controls[name] = option

    def pack(self) -> tuple[dict[str, Any], bytes]:
        """The tree {"sources": …, "ranges": …, "texts": …, "controls": …} and the
        block of all that was put, and forget it.

        In the tree an array is {"at": first, "n": length}, counted in single-precision numbers,
        with its shape if that is not (n,); lists and short plain values stand as they are.
        """
        blocks: list[np.ndarray] = []
        position = 0

        def place(item: Any) -> Any:
            nonlocal position
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
        tree = {"sources": sources, "ranges": self._ranges, "texts": self._texts, "controls": self._controls}
        self._pending, self._ranges, self._texts, self._controls = {}, {}, {}, {}
        return tree, b"".join(block.tobytes() for block in blocks)
