"""Some orbits of a section, computed together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

from hess_mechanics.numerics.results import Array

__all__ = ["OrbitBatch", "in_batches"]

_TOGETHER = 4
"""Orbits computed together: few enough that points arrive soon."""

T = TypeVar("T")


@dataclass(frozen=True)
class OrbitBatch:
    """Some orbits of a section.

    orbits : points (n, 2) of each orbit, in order of time; firsts : True for orbits of the first of two kinds.
    drift : the largest drift of each integral.
    kept : True if all points of an orbit lie on its side of the curve that divides the kinds, if there is one.
    elsewhere : points (m, 2) that are drawn separately.
    """

    orbits: tuple[Array, ...]
    firsts: tuple[bool, ...]
    drift: Mapping[str, float]
    kept: tuple[bool, ...] = ()
    elsewhere: Array | None = None


def in_batches(items: Sequence[T]) -> Iterator[tuple[T, ...]]:
    """Return the items in batches of the size computed together."""
    return (tuple(items[i : i + _TOGETHER]) for i in range(0, len(items), _TOGETHER))
