"""Some orbits of a section, computed together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

from hess_mechanics.numerics.results import Array

__all__ = ["OrbitBatch", "in_batches"]

_TOGETHER = 4
"""Orbits that are computed together: few enough for points to arrive soon."""

T = TypeVar("T")


@dataclass(frozen=True)
class OrbitBatch:
    """Some orbits: points (n, 2) of each, as they are passed, and of which of two kinds it is; the largest drifts.

    kept : whether all its points lie on its side of the curve that divides the kinds, where there is one;
    elsewhere : those of the points (m, 2) that are drawn apart from the others.
    """

    orbits: tuple[Array, ...]
    firsts: tuple[bool, ...]
    drift: Mapping[str, float]
    kept: tuple[bool, ...] = ()
    elsewhere: Array | None = None


def in_batches(items: Sequence[T]) -> Iterator[tuple[T, ...]]:
    """Return the items, as many at a time as are computed together."""
    return (tuple(items[i : i + _TOGETHER]) for i in range(0, len(items), _TOGETHER))
