"""Orbit diagrams of a section over a parameter, and cascades of period doublings.

An orbit diagram shows where an orbit settles.  A bifurcation diagram in the strict sense also shows unstable orbits:
`continuation.branch_from` computes its branches.  An orbit is followed from value to value, each time from its last
point at the value before, so that it stays with its attractor as long as there is one; the way back may differ.
Alternatively it starts again at the same point.  The map backward in time shows repellers.  Periods in a diagram are
read from the orbit; period doublings are computed: there an orbit found by Newton's method has the multiplier −1.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.dynamics.continuation import Bifurcation, branch_from
from hess_mechanics.dynamics.periodic import MAX_PERIOD, Map, PeriodicOrbit, difference, find_periodic, shoot, units_of
from hess_mechanics.errors import InvalidParameter, ModelError, NotConverged, OutsideRegion, WorkLimit
from hess_mechanics.numerics.labelled import Labels, Result, components
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array, Mask, as_read_only

__all__ = [
    "MAX_VALUES",
    "SAME",
    "Cascade",
    "Diagram",
    "OrbitMap",
    "cascade",
    "diagram_over",
    "first_doubling",
    "period_of",
]

MAX_VALUES, MAX_CROSSINGS = 2000, 20_000
SAME = 1e-4
"""Points closer than this are the same point of a periodic orbit: near a doubling, errors decay slowly."""
_PROMISES = 3.0
"""Another tolerance, in errors of the map; the larger one counts.  Projecting to the integrals moves long orbits."""
_SETTLING = 0.8
"""An orbit is still settling if its distance from closing falls below this fraction from one half to the next."""
_WATCHED = 50
"""Number of crossings after which the end of a transient is tested again."""
_CLOSER, _CLOSE = 1e-3, 0.1
"""A transient ends where an orbit closes this much better than at its start, and to this share of the map's error."""
_AMPLITUDES = 0.4 * 0.4 ** np.arange(6, -1, -1)
"""Distances from a flip at which the orbit of twice the period is searched for, the nearest first."""
_NEAR = 3.0
"""An orbit farther away than this multiple of the distance is a different one."""
_AHEAD = (0.25, 0.05, 0.01)
"""Distances beyond the flip in the parameter, in units of the distance to the next expected flip."""
_GROWTH = 4.669
"""Feigenbaum's δ; it only guides the search."""
_POINTS = 120
_UNSETTLED = 2
"""Largest number of values without a period between an orbit and that of twice the period."""


Whole = NDArray[np.int64]


class OrbitMap(Map, Protocol):
    """A map that can return a whole orbit at once."""

    @property
    def preserves_volume(self) -> bool:
        """True if the map preserves a volume and therefore has no attractors."""

    def orbit(self, point: Array, count: int) -> Array:
        """Return the next points of an orbit.

        Parameters
        ----------
        point : ndarray, shape (d,)
            Point where the orbit starts.
        count : int
            Number of points.

        Returns
        -------
        ndarray, shape (n, d)
            The points, without `point` itself; n < `count` if the motion does not come back.
        """


@dataclass(frozen=True)
class Diagram(Result):
    """An orbit diagram: the points where an orbit settles, over a parameter.

    Attributes
    ----------
    parameter : str
        Name of the parameter.
    names : tuple of str
        Names of the coordinates; empty if there is no map at any value.
    values : ndarray, shape (n,)
        Values of the parameter, in the order in which they were visited.
    points : tuple of ndarray, shape (m, d)
        Points at each value, m = 0 if there is no map or the motion does not return often enough.
    periods : ndarray of int, shape (n,)
        Period at each value; 0 if none is found up to 64 and up to a third of the points.
    ends : ndarray, shape (n, d)
        Last point at each value; NaN if there are no points.
    conservative : ndarray of bool, shape (n,)
        True if the map preserves volume: the points are then a part of a single orbit, which attracts nothing.
    level : str
        Name of the accuracy level; empty if there is no map at any value.
    """

    parameter: str
    names: tuple[str, ...]
    values: Array
    points: tuple[Array, ...]
    periods: Whole
    ends: Array
    conservative: Mask
    level: str

    def labels(self) -> Labels:
        """Return all points, each labelled with its value of the parameter.

        Returns
        -------
        Labels
            The coordinates over the points.
        """
        value = np.repeat(self.values, [len(one) for one in self.points])
        points = np.concatenate([np.empty((0, len(self.names))), *self.points])
        along = ("point",)
        return Labels(
            {self.parameter: (along, value)},
            components(self.names, points, *along),
            units_of(self.names),
            {"level": self.level},
        )


def period_of(
    turns: Sequence[float], points: Array, promise: float = 0.0, most: int = MAX_PERIOD, same: float = SAME
) -> tuple[int, bool]:
    """Return the least period that the points of an orbit show, and whether the orbit has settled.

    A period counts if the orbit shows it at least three times.  An orbit that closes better in its second half is still
    settling.  Only Newton's method tells whether the orbit is periodic.

    Parameters
    ----------
    turns : sequence of float
        Period of each coordinate, ∞ if it is not an angle.
    points : ndarray, shape (n, d)
        Points of the orbit.
    promise : float, default 0.0
        Error of the points, ≥ 0.
    most : int, default 64
        Largest period tried.
    same : float, default 1e-4
        Distance within which two points count as equal, but at least three times `promise`.

    Returns
    -------
    period : int
        The period; 0 if the orbit shows none, or seems to double its period only because it is still settling.
    settled : bool
        True if the orbit has settled; False for fewer than three points.
    """
    most = min(most, len(points) // 3)
    if most < 1:
        return 0, False
    ways = np.empty((most, 2))
    for m in range(1, most + 1):
        halves = points[: len(points) // 2 + m // 2], points[len(points) // 2 - m // 2 :]
        ways[m - 1] = [np.abs(difference(turns, one[m:], one[:-m])).max() for one in halves]
        if ways[m - 1].max() <= max(same, _PROMISES * promise):
            # While an orbit with a multiplier near −1 settles, its period seems doubled.
            shorter = [k - 1 for k in range(1, m) if m % k == 0]
            is_settled = bool(np.all(ways[shorter, 1] >= _SETTLING * ways[shorter, 0]))
            return (m, True) if is_settled else (0, False)
    first, second = ways.T
    # The orbit settles if the distance to its own shift decreases, in the median over all periods and for the best one.
    ratios = second / first
    return 0, min(float(np.median(ratios)), float(ratios[second.argmin()])) >= _SETTLING


def diagram_over(
    family: Callable[[float], OrbitMap],
    parameter: str,
    values: Sequence[float] | Array,
    start: Sequence[float] | Array,
    transient: int = 200,
    crossings: int = 64,
    follow: bool = True,
    again: Sequence[float] | Array | None = None,
) -> Diagram:
    """Return the orbit diagram of a family of maps.

    Parameters
    ----------
    family : callable
        Function from the value of the parameter to the map.
    parameter : str
        Name of the parameter.
    values : array_like, shape (n,)
        Values of the parameter, in the order in which they are visited; there and back they show hysteresis.
    start : array_like, shape (d,)
        Point where the orbit starts at the first value.
    transient : int, default 200
        Largest number of crossings discarded at each value, ≥ 0.  The transient ends as soon as the orbit has come a
        thousand times closer to a periodic one than it was, and to a tenth of the error of the map.
    crossings : int, default 64
        Number of crossings shown at each value, at least 1; `transient` + `crossings` is at most 20 000.
    follow : bool, default True
        Start each value from the last point of the one before, or from `again` if that fails.  If False, start every
        value from `again`.
    again : array_like, shape (d,), optional
        Point where the orbit starts again.  By default `start`.

    Returns
    -------
    Diagram
        The points and the period at each value, with a gap at values without a map or without returns.

    Raises
    ------
    InvalidParameter
        If there are no values or more than 2000, or one is not finite.
    WorkLimit
        If `transient` or `crossings` is out of range, or the map needs too many steps.
    """
    along = np.array(values, float, ndmin=1)
    if not (along.ndim == 1 and np.all(np.isfinite(along)) and 1 <= along.size <= MAX_VALUES):
        raise InvalidParameter(
            f"The values of the parameter ({along.size}) are too few, too many, not finite or not one-dimensional: "
            f"give 1 to {MAX_VALUES} finite ones."
        )
    if not (crossings >= 1 and transient >= 0 and transient + crossings <= MAX_CROSSINGS):
        raise WorkLimit(
            f"transient = {transient} and crossings = {crossings} are out of range: choose a transient of at least 0 "
            f"and at least 1 crossing, together at most {MAX_CROSSINGS}."
        )
    first = np.array(start, float)
    restart = first if again is None else np.array(again, float)
    point = first
    shown: list[Array] = []
    periods, conservative = np.zeros(along.size, np.int64), np.zeros(along.size, bool)
    ends = np.full((along.size, first.size), np.nan)
    names: tuple[str, ...] = ()
    level = ""
    for i, value in enumerate(along.tolist()):
        check_limit()
        points = np.empty((0, first.size))
        try:
            map_ = family(value)
            names, level = map_.names, map_.level
            conservative[i] = map_.preserves_volume
            for origin in (point, restart) if follow else (restart,):
                try:
                    orbit = _after_transient(map_, origin, transient, crossings)
                except OutsideRegion:
                    continue
                if len(orbit) == crossings:
                    points = orbit
                    break
        except WorkLimit:
            raise
        except ModelError:
            # The diagram has a gap at a value without a body or without motion.
            pass
        shown.append(as_read_only(points.copy()))
        if len(points):
            periods[i], _ = period_of(map_.turns, points, map_.promise)
            ends[i] = point = points[-1]
        else:
            point = restart
    return Diagram(
        parameter,
        names,
        as_read_only(along),
        tuple(shown),
        as_read_only(periods),
        as_read_only(ends),
        as_read_only(conservative),
        level,
    )


def _after_transient(map_: OrbitMap, origin: Array, transient: int, crossings: int) -> Array:
    """Return `crossings` points of an orbit after its transient; fewer if the motion stops returning."""
    orbit = np.asarray(origin, float)[None]
    while len(orbit) <= transient and not _has_approached(map_, orbit):
        piece = map_.orbit(orbit[-1], min(_WATCHED, transient + 1 - len(orbit)))
        if not len(piece):
            return piece
        orbit = np.concatenate([orbit, piece])
    return map_.orbit(orbit[-1], crossings)


def _has_approached(map_: OrbitMap, orbit: Array) -> bool:
    """Return True if an orbit (n, d) has come close to a periodic one.

    For some m its last m-step distances are at most 1e-3 of the first ones, and at most 0.1 of the map's promise.
    """
    for m in range(1, min(_WATCHED, len(orbit) - 1) // 3 + 1):
        steps = np.abs(difference(map_.turns, orbit[m:], orbit[:-m])).max(axis=1)
        first, last = float(steps[:m].max()), float(steps[-m:].max())
        if last <= min(_CLOSE * map_.promise, _CLOSER * first):
            return True
    return False


def first_doubling(parts: Sequence[Diagram]) -> tuple[float, Array, float] | None:
    """Return the first doubling of the smallest period that doubles in a diagram.

    Next to a doubling orbits settle slowly, so that up to two values in between may have no period.

    Parameters
    ----------
    parts : sequence of Diagram
        Parts of the diagram, in order.  They are searched forward, and backward if nothing is found.

    Returns
    -------
    (float, ndarray, float), or None
        Value before the doubling, the points (m, d) of the orbit there, and the last value in the direction of the
        search; None if no period doubles.
    """
    known = [
        one for part in parts for one in zip(part.values.tolist(), part.periods.tolist(), part.points, strict=True)
    ]
    for way in (known, known[::-1]):
        periods = [m for _, m, _ in way]
        steps = [
            (m, k)
            for k, m in enumerate(periods)
            if m and next(filter(None, periods[k + 1 : k + 2 + _UNSETTLED]), 0) == 2 * m
        ]
        if steps:
            m, k = min(steps)
            return way[k][0], way[k][2][-m:], way[-1][0]
    return None


@dataclass(frozen=True)
class Cascade(Result):
    """A cascade of period doublings.

    Attributes
    ----------
    parameter : str
        Name of the parameter.
    names : tuple of str
        Names of the coordinates.
    values : ndarray, shape (k,)
        Values of the parameter at the doublings.
    errors : ndarray, shape (k,)
        Estimated errors of the values, ≥ 0.
    periods : ndarray of int, shape (k,)
        Period before each doubling.
    points : tuple of ndarray, shape (m, d)
        Points of the orbit at each doubling.
    end_reason : str
        Reason why there are no more doublings.
    level : str
        Name of the accuracy level.
    """

    parameter: str
    names: tuple[str, ...]
    values: Array
    errors: Array
    periods: Whole
    points: tuple[Array, ...]
    end_reason: str
    level: str

    @property
    def error_estimate(self) -> float:
        """Largest estimated error of a value; 0 without doublings."""
        return float(self.errors.max(initial=0.0))

    @property
    def ratios(self) -> Array:
        """Ratios (λ_k − λ_(k−1))/(λ_(k+1) − λ_k), shape (k − 2,); near 4.6692 for maps close to a map of a line."""
        steps = np.diff(self.values)
        return np.asarray(steps[:-1] / steps[1:])

    @property
    def ratio_errors(self) -> Array:
        """Errors of the ratios, shape (k − 2,), propagated from the errors of the values."""
        steps, off = np.abs(np.diff(self.values)), self.errors[1:] + self.errors[:-1]
        return np.asarray(np.abs(self.ratios) * (off[:-1] / steps[:-1] + off[1:] / steps[1:]))

    @property
    def limit(self) -> float:
        """Accumulation point if all further ratios equal the last ratio; NaN for fewer than three doublings."""
        if len(self.values) < 3:
            return math.nan
        return float(self.values[-1] + (self.values[-1] - self.values[-2]) / (self.ratios[-1] - 1.0))

    def labels(self) -> Labels:
        """Return the values and ratios with their errors, labelled with the period before each doubling.

        Returns
        -------
        Labels
            The arrays over the doublings; the ratios are NaN at the first and the last one.
        """
        along = ("doubling",)
        ratio, off = np.full((2, len(self.values)), np.nan)
        if len(self.values) > 2:
            ratio[1:-1], off[1:-1] = self.ratios, self.ratio_errors
        return Labels(
            {"period": (along, self.periods)},
            {
                self.parameter: (along, self.values),
                "error": (along, self.errors),
                "ratio": (along, ratio),
                "ratio error": (along, off),
            },
            {},
            {"ended": self.end_reason, "limit": self.limit, "level": self.level},
        )


def cascade(
    family: Callable[[float], Map], parameter: str, orbit: PeriodicOrbit, start: float, end: float, doublings: int = 6
) -> Cascade:
    """Return the period doublings of a periodic orbit over a parameter λ.

    The orbit is continued up to its flip; beyond it, Newton's method finds the orbit of twice the period in the
    direction in which it is born; and so on.

    Parameters
    ----------
    family : callable
        Function from λ to the map.
    parameter : str
        Name of λ.
    orbit : PeriodicOrbit
        A periodic orbit at λ = `start`.
    start, end : float
        Values of λ between which doublings are searched for.
    doublings : int, default 6
        Largest number of doublings.

    Returns
    -------
    Cascade
        The doublings with their errors; possibly none, see `Cascade.end_reason`.

    Raises
    ------
    InvalidParameter
        If the range is empty or not finite.
    NotConverged
        If the first branch cannot be started.
    WorkLimit
        If a map needs too many steps.
    """
    flips: list[Bifurcation] = []
    direction = math.copysign(1.0, end - start)
    at, far = start, end
    ended = f"After {doublings} doublings."
    while len(flips) < doublings:
        check_limit()
        try:
            branch = branch_from(family, orbit, parameter, at, far, _POINTS, until="flip")
        except NotConverged as error:
            if not flips:
                raise
            ended = str(error)
            break
        flip = next((one for one in branch.bifurcations if one.kind == "flip"), None)
        if flip is None:
            ended = f"The orbit of period {orbit.period} keeps its period: {branch.end_reason}"
            break
        flips.append(flip)
        if len(flips) == doublings:
            break
        if 2 * orbit.period > MAX_PERIOD:
            ended = f"Orbits are looked for up to period {MAX_PERIOD}."
            break
        step = abs(flip.value - (flips[-2].value if len(flips) > 1 else start)) / _GROWTH
        born = _doubled(family, flip, direction * step)
        if born is None:
            ended = f"Beyond {parameter} = {flip.value:.9g} no orbit of period {2 * orbit.period} is found."
            break
        at, orbit = born
        # The first step is no estimate of the distance to the next doubling.
        far = end if len(flips) == 1 else flip.value + direction * 4.0 * step
    return Cascade(
        parameter,
        orbit.names,
        as_read_only(np.array([one.value for one in flips])),
        as_read_only(np.array([one.error for one in flips])),
        as_read_only(np.array([len(one.points) for one in flips], np.int64)),
        tuple(one.points for one in flips),
        ended,
        orbit.level,
    )


def _doubled(family: Callable[[float], Map], flip: Bifurcation, step: float) -> tuple[float, PeriodicOrbit] | None:
    """Return the orbit of twice the period beyond a flip, if possible a stable orbit, and the parameter."""
    twice = np.concatenate([flip.points, flip.points])
    away = np.linalg.svd(shoot(family(flip.value), twice).jacobian)[2][-1].reshape(twice.shape)
    away /= np.abs(away).max()
    other: tuple[float, PeriodicOrbit] | None = None
    for share in _AHEAD:
        value = flip.value + share * step
        map_ = family(value)
        for amplitude in _AMPLITUDES:
            check_limit()
            try:
                orbit = find_periodic(map_, twice + amplitude * away)
            except ModelError:
                continue
            if (
                orbit.period == len(twice)
                and np.abs(difference(map_.turns, orbit.points, twice)).max() < _NEAR * amplitude
            ):
                if orbit.kind.startswith("stable"):
                    return value, orbit
                other = other or (value, orbit)
                break
    return other
