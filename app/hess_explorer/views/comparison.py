"""Changes of a picture from one accuracy to a more exact one: moved points, parts of curves, cells."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field

import numpy as np

from hess_explorer.views.layers import Axes
from hess_mechanics.dynamics.sampling import PIXELS
from hess_mechanics.dynamics.shadowing import HALF_A_PIXEL, away_from, errors_in_pixels, torn_away
from hess_mechanics.numerics.results import Array, Mask, frozen

__all__ = ["Cells", "Curves", "Difference", "Frame", "Look", "Marks", "compared"]

_STEP = 2.0
"""Spacing of the compared points of a curve, in pixels."""
_MOST = 4000
"""Largest number of points of a curve in a comparison."""
_TOGETHER = 256
"""Number of points per distance computation: small enough for the processor's cache."""


def _none() -> Array:
    return frozen(np.empty((0, 2)))


@dataclass(frozen=True)
class Frame:
    """The axes of a picture, and their names."""

    axes: Axes
    names: tuple[str, str]

    @property
    def pixels(self) -> tuple[float, float]:
        """Pixels per unit along each axis."""
        (x0, x1), (y0, y1) = self.axes.x, self.axes.y
        return PIXELS / (x1 - x0), PIXELS / (y1 - y0)

    def inside(self, points: Array) -> Mask:
        """Return the mask (n,) of the points (n, 2) inside the frame."""
        (x0, x1), (y0, y1) = self.axes.x, self.axes.y
        return np.asarray((points[:, 0] >= x0) & (points[:, 0] <= x1) & (points[:, 1] >= y0) & (points[:, 1] <= y1))


@dataclass(frozen=True)
class Marks:
    """The points of orbits (n, 2), one after the other.

    periods : periods of the coordinates, ∞ for a coordinate that is not an angle.
    elsewhere : coordinates (n, …, d) of each orbit in the pixels of all pictures that show it, if there are others
    than this one.  crossings : whether the points are crossings of a section.
    """

    frame: Frame
    orbits: tuple[Array, ...]
    periods: tuple[float, float] = (math.inf,) * 2
    elsewhere: tuple[tuple[Array, ...], ...] = ()
    crossings: bool = False


@dataclass(frozen=True)
class Curves:
    """Polylines (n, 2), compared by their distance, independently of the position of their vertices.

    in_pairs : compare curves in order, one by one; else each with the nearest of all others.
    """

    frame: Frame
    curves: tuple[Array, ...]
    in_pairs: bool = False


@dataclass(frozen=True)
class Cells:
    """Values (n, m) of cells that fill the frame, NaN for none; differences above `step` are visible."""

    frame: Frame
    values: Array
    step: float


Look = Marks | Curves | Cells


@dataclass(frozen=True)
class Difference:
    """The differences between two pictures.

    same, changed : points (n, 2) at most and more than half a pixel from the more exact ones.
    added : points of the more exact picture only; cells : (n, m), 1 changed, 0 unchanged, −1 empty in both.
    largest : in pixels or in the unit of the cells; orbits : number of orbits of a section; lost : for each orbit that
    chaos separates, its first crossing, counted from 1, in another place.
    """

    frame: Frame
    same: Array = field(default_factory=_none)
    changed: Array = field(default_factory=_none)
    added: Array = field(default_factory=_none)
    cells: Array | None = None
    largest: float = 0.0
    orbits: int = 0
    lost: tuple[int, ...] = ()

    @property
    def share(self) -> float:
        """The changed share of the non-empty cells or of the points."""
        if self.cells is not None:
            there = self.cells >= 0.0
            return float(np.mean(self.cells[there])) if there.any() else 0.0
        count = len(self.same) + len(self.changed)
        return len(self.changed) / count if count else 0.0


def compared(one: Look, finer: Look) -> Difference:
    """Return the differences between `one` and a more exact picture `finer` of the same kind."""
    if isinstance(one, Marks) and isinstance(finer, Marks):
        return _points(one, finer)
    if isinstance(one, Curves) and isinstance(finer, Curves):
        return _curves(one, finer)
    assert isinstance(one, Cells) and isinstance(finer, Cells)
    return _cells(one, finer)


def _joined(parts: Sequence[Array]) -> Array:
    return np.concatenate([_none(), *parts])


def _sorted(frame: Frame, points: Array, away: Array) -> tuple[Array, Array, float]:
    """Return the unchanged and the changed points in the frame, and the largest finite distance."""
    seen = frame.inside(points)
    points, away = points[seen], away[seen]
    return (
        frozen(points[away <= HALF_A_PIXEL]),
        frozen(points[away > HALF_A_PIXEL]),
        float(away[np.isfinite(away)].max(initial=0.0)),
    )


def _points(one: Marks, finer: Marks) -> Difference:
    kept, away, added, lost = [], [], [], []
    for i, (orbit, exact) in enumerate(zip(one.orbits, finer.orbits, strict=True)):
        both = min(len(orbit), len(exact))
        found = (
            errors_in_pixels(orbit, exact, finer.frame.pixels, one.periods)
            if not one.elsewhere
            else np.max([*_distances(one.elsewhere[i], finer.elsewhere[i], both)], axis=0)
        )
        wrong = np.flatnonzero(found > HALF_A_PIXEL)
        if one.crossings and wrong.size and torn_away(found):
            lost.append(int(wrong[0]) + 1)
        kept.append(orbit)
        # Points that the more exact picture lacks count as changed.
        away.append(np.append(found, np.full(len(orbit) - both, math.inf)))
        added.append(exact[both:])
    same, changed, largest = _sorted(finer.frame, _joined(kept), np.concatenate([np.empty(0), *away]))
    more = _joined(added)
    return Difference(
        finer.frame,
        same,
        changed,
        frozen(more[finer.frame.inside(more)]),
        largest=largest,
        orbits=len(one.orbits) if one.crossings else 0,
        lost=tuple(lost),
    )


def _distances(left: Sequence[Array], right: Sequence[Array], both: int) -> Iterator[Array]:
    for one, other in zip(left, right, strict=True):
        away = np.linalg.norm(one[:both] - other[:both], axis=-1)
        yield away.reshape(both, -1).max(axis=1)


def _fine(curve: Array, pixels: Array) -> Array:
    """Return a curve (n, 2) in pixels, resampled at equal steps of arc length."""
    places = curve * pixels
    if len(places) < 2:
        return np.asarray(places)
    way = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(places, axis=0), axis=1))])
    stops = np.linspace(0.0, way[-1], int(min(_MOST, max(2.0, way[-1] / _STEP))))
    return np.column_stack([np.interp(stops, way, each) for each in places.T])


def _from_curves(points: Array, curves: Sequence[Array]) -> Array:
    """Return the distances (m,) of points from the nearest of some polylines."""
    away = np.full(len(points), math.inf)
    for curve in curves:
        if not len(curve):
            continue
        kept = curve[np.unique(np.linspace(0, len(curve) - 1, min(_MOST, len(curve))).astype(int))]
        for i in range(0, len(points), _TOGETHER):
            part = slice(i, i + _TOGETHER)
            away[part] = np.minimum(away[part], away_from(points[part], kept))
    return away


def _one_way(frame: Frame, curves: Sequence[Array], others: Sequence[Array], in_pairs: bool) -> tuple[Array, Array]:
    """Return points along curves within the frame, and their distances in pixels from the other curves."""
    pixels = np.array(frame.pixels)
    points, away = [np.empty((0, 2))], [np.empty(0)]
    scaled = [other * pixels for other in others]
    for i, curve in enumerate(curves):
        fine = _fine(curve, pixels)
        fine = fine[frame.inside(fine / pixels)]
        points.append(fine / pixels)
        away.append(_from_curves(fine, scaled[i : i + 1] if in_pairs else scaled))
    return np.concatenate(points), np.concatenate(away)


def _curves(one: Curves, finer: Curves) -> Difference:
    pairs = one.in_pairs and len(one.curves) == len(finer.curves)
    points, away = _one_way(finer.frame, one.curves, finer.curves, pairs)
    same, changed, largest = _sorted(finer.frame, points, away)
    there, missing = _one_way(finer.frame, finer.curves, one.curves, pairs)
    return Difference(finer.frame, same, changed, frozen(there[missing > HALF_A_PIXEL]), largest=largest)


def _cells(one: Cells, finer: Cells) -> Difference:
    """Compare the cells on the finer of both grids, without interpolation, as the picture shows them."""
    shape = tuple(map(max, one.values.shape, finer.values.shape))
    left, right = (_enlarged(each.values, shape) for each in (one, finer))
    nothing, either = np.isnan(left) & np.isnan(right), np.isnan(left) ^ np.isnan(right)
    away = np.where(nothing | either, 0.0, np.abs(left - right))
    cells = np.where(nothing, -1.0, ((away > finer.step) | either).astype(float))
    return Difference(finer.frame, cells=frozen(cells), largest=float(away.max(initial=0.0)))


def _enlarged(values: Array, shape: Sequence[int]) -> Array:
    rows, columns = (np.arange(fine) * coarse // fine for coarse, fine in zip(values.shape, shape, strict=True))
    return np.asarray(values[np.ix_(rows, columns)])
