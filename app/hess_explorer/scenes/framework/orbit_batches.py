"""Some orbits of a section, computed together."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import TypeVar

from hess_mechanics.dynamics.plane_section import SectionPoints
from hess_mechanics.dynamics.return_map import PoincareSection
from hess_mechanics.numerics.results import Array, as_read_only

_TOGETHER = 4
"""Orbits computed together: few enough that points arrive soon."""

T = TypeVar("T")


@dataclass(frozen=True)
class OrbitBatch:
    """Some orbits of a section.

    Attributes
    ----------
    orbits : tuple of array (n, 2)
        Points of each orbit, in order of time; empty for an orbit without a crossing.
    first_kind : tuple of bool
        True for orbits of the first of two kinds.
    drift : mapping of str to float
        Largest drift of each integral, relative to its initial value if that exceeds 1; empty without any crossing.
    steps : int
        Total number of Taylor steps.
    reasons : tuple of str
        Reason why each orbit ends early; empty for a complete orbit.
    same_side : tuple of bool
        For each orbit, True if all its points lie on one side of the curve that separates both kinds; by default
        empty.
    other_sheets : array (m, 2) or None
        Points on other sheets of the section, which are drawn separately; None if there is one sheet.
    """

    orbits: tuple[Array, ...]
    first_kind: tuple[bool, ...]
    drift: Mapping[str, float]
    steps: int
    reasons: tuple[str, ...]
    same_side: tuple[bool, ...] = ()
    other_sheets: Array | None = None


def batch_of(section: PoincareSection, points: SectionPoints, first: bool = True) -> OrbitBatch:
    """Return crossings of a section, in its coordinates, as a batch of one kind.

    Parameters
    ----------
    section : PoincareSection
        The section.
    points : SectionPoints
        Crossings of its orbits, as states.
    first : bool
        True if the orbits are of the first kind.
    """
    orbits = tuple(as_read_only(section.points_of(states)) for states in points.states)
    return OrbitBatch(orbits, (first,) * len(orbits), points.drift, points.cost.steps, points.reasons)


def batches(items: Sequence[T]) -> Iterator[tuple[T, ...]]:
    """Yield the items, in order, in batches of at most four that are computed together."""
    return (tuple(items[i : i + _TOGETHER]) for i in range(0, len(items), _TOGETHER))
