"""Orbit diagrams: where an orbit of a section settles, over a parameter; hysteresis; cascades of period doublings.

An orbit is followed from value to value, each time from where it was at the one before, so that it stays with its
attractor as long as there is one, and the way back may be another one; or it starts anew at the same place.  The map
backward in time shows repellers.  What a diagram shows is seen; where a period doubles is computed: there an orbit
found by Newton's method has the multiplier −1.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import groupby, pairwise
from operator import itemgetter
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from hess_mechanics.dynamics.continuation import Bifurcation, continued
from hess_mechanics.dynamics.periodic import MAX_PERIOD, Map, PeriodicOrbit, apart, find_periodic, place_units, shoot
from hess_mechanics.dynamics.point_sets import how_far_apart
from hess_mechanics.errors import InvalidParameter, ModelError, NotConverged, OutsideRegion, WorkLimit
from hess_mechanics.numerics.labelled import Labels, Result, components
from hess_mechanics.numerics.patience import go_on
from hess_mechanics.numerics.results import Array, Mask, frozen

__all__ = [
    "COMPARED",
    "MAX_VALUES",
    "Cascade",
    "Diagram",
    "Followed",
    "cascade",
    "diagram_over",
    "doubling_seen",
    "hysteresis",
    "period_of",
]

MAX_VALUES, MAX_CROSSINGS = 2000, 20_000
COMPARED = 16
"""Places of two sets from which on they are told apart."""
_SAME = 1e-4
"""Places closer than this are one of a periodic orbit: near a doubling, small errors die out slowly."""
_PROMISES = 3.0
"""Nor can those be told apart that differ by so many errors of the map: a long orbit is brought back to its integrals
now and then, and moves by some errors then."""
_SETTLING = 0.8
"""An orbit whose distances from closing fall below this share from its first half to its second is on its way."""
_AMPLITUDES = 0.4 * 0.4 ** np.arange(6, -1, -1)
"""How far from a flip the orbit of twice the period is looked for, the nearest first."""
_NEAR = 3.0
"""What is found farther away than so many times that is another orbit."""
_AHEAD = (0.25, 0.05, 0.01)
"""And how far beyond it, in units of the distance to where the next one is expected."""
_GROWTH = 4.669
"""Feigenbaum's δ: it only says where to look."""
_POINTS = 120


Whole = NDArray[np.int64]


class Followed(Map, Protocol):
    """A map whose orbits are followed at once."""

    @property
    def volume_kept(self) -> bool:
        """Whether it keeps a volume, and has no attractors."""

    def orbit(self, place: Array, count: int) -> Array:
        """The next `count` places (n, d), one after the other; fewer where the motion stays away."""


@dataclass(frozen=True)
class Diagram(Result):
    """Where an orbit settles over a parameter.

    values : (n,), in the order in which they were passed; places : n arrays (m, d), empty where the motion does not
    come back; periods : (n,), 0 where none up to 64 is seen; settled : (n,), whether what is seen stays.
    ends : (n, d), the last place at each value, NaN where there is none.
    conservative : (n,), whether volume is kept: what is seen is then one orbit, which nothing attracts.
    """

    parameter: str
    names: tuple[str, ...]
    values: Array
    places: tuple[Array, ...]
    periods: Whole
    settled: Mask
    ends: Array
    conservative: Mask
    level: str

    def labels(self) -> Labels:
        """All places, with the value of the parameter."""
        value = np.repeat(self.values, [len(one) for one in self.places])
        points = np.concatenate([np.empty((0, len(self.names))), *self.places])
        along = ("point",)
        return Labels(
            {self.parameter: (along, value)},
            components(self.names, points, *along),
            place_units(self.names),
            {"level": self.level},
        )


def period_of(turns: Sequence[float], places: Array, promise: float = 0.0, most: int = MAX_PERIOD) -> tuple[int, bool]:
    """The least period with which the places (n, d) of an orbit repeat, 0 where none is seen, and whether it stays so.

    Seen is a period of which the orbit shows at least three; it is on its way to one where its halves say so.
    promise : the error of the map that the places have; most : the longest period that is looked for.
    """
    most = min(most, len(places) // 3)
    ways = np.array(
        [
            [
                np.abs(apart(turns, one[m:], one[:-m])).max()
                for one in (places[: len(places) // 2 + m // 2], places[len(places) // 2 - m // 2 :])
            ]
            for m in range(1, most + 1)
        ]
    )
    if not len(ways):
        return 0, False
    first, second = ways.T
    closed = np.flatnonzero(np.maximum(first, second) <= max(_SAME, _PROMISES * promise))
    if closed.size:
        m = int(closed[0]) + 1
        # A multiplier near −1 makes an orbit look twice as long while it is still coming.
        return (
            (m, True)
            if all(second[k - 1] >= _SETTLING * first[k - 1] for k in range(1, m) if m % k == 0)
            else (0, False)
        )
    # All of them close better and better, or the one that closes best does: then the orbit comes to a periodic one.
    ratios = second / first
    return 0, min(float(np.median(ratios)), float(ratios[second.argmin()])) >= _SETTLING


def diagram_over(
    family: Callable[[float], Followed],
    parameter: str,
    values: Sequence[float] | Array,
    start: Sequence[float] | Array,
    transient: int = 200,
    kept: int = 64,
    follow: bool = True,
    again: Sequence[float] | Array | None = None,
) -> Diagram:
    """Where the orbit from a place `start` (d,) settles at each of the values (n,), in their order.

    family : value → map.  transient, kept : crossings that are left out, and shown.
    follow : from where it was at the value before; it starts anew, from `again` or `start`, where that is impossible
    or it did not come back there.  Raises `WorkLimit`, `InvalidParameter`.
    """
    along = np.array(values, float, ndmin=1)
    if not (along.ndim == 1 and np.all(np.isfinite(along)) and 1 <= along.size <= MAX_VALUES):
        raise InvalidParameter(f"An orbit diagram has from 1 to {MAX_VALUES} finite values of its parameter.")
    if not (kept >= 1 and transient >= 0 and transient + kept <= MAX_CROSSINGS):
        raise WorkLimit(f"At each value at most {MAX_CROSSINGS} crossings are followed: choose fewer.")
    first = np.array(start, float)
    anew = first if again is None else np.array(again, float)
    place = first
    places: list[Array] = []
    periods, settled = np.zeros(along.size, np.int64), np.zeros(along.size, bool)
    conservative = np.zeros(along.size, bool)
    ends = np.full((along.size, first.size), np.nan)
    names: tuple[str, ...] = ()
    turns: tuple[float, ...] = ()
    level = ""
    for i, value in enumerate(along.tolist()):
        go_on()
        found = np.empty((0, first.size))
        try:
            map_ = family(value)
            names, turns, level = map_.names, map_.turns, map_.level
            conservative[i] = map_.volume_kept
            for origin in (place, anew) if follow else (anew,):
                try:
                    orbit = map_.orbit(origin, transient + kept)
                except OutsideRegion:
                    continue
                if len(orbit) == transient + kept:
                    found = orbit[transient:]
                    break
        except WorkLimit:
            raise
        except ModelError:
            # At this value there is no such body, or no motion: the diagram has a gap.
            pass
        places.append(frozen(found.copy()))
        if len(found):
            periods[i], settled[i] = period_of(turns, found, map_.promise)
            ends[i] = place = found[-1]
        else:
            place = anew
    return Diagram(
        parameter,
        names,
        frozen(along),
        tuple(places),
        frozen(periods),
        frozen(settled),
        frozen(ends),
        frozen(conservative),
        level,
    )


def doubling_seen(parts: Sequence[Diagram]) -> tuple[float, Array, float] | None:
    """After which value of a diagram periods first double, the least first, going over it or, if there is none, back.

    parts : of the diagram, in their order.  The value, the places (m, d) there, and the value at the end of that way;
    None where no period doubles between neighbours.
    """
    known = [
        one for part in parts for one in zip(part.values.tolist(), part.periods.tolist(), part.places, strict=True)
    ]
    for way in (known, known[::-1]):
        steps = [(m, k) for k, ((_, m, _), (_, following, _)) in enumerate(pairwise(way)) if m and following == 2 * m]
        if steps:
            m, k = min(steps)
            return way[k][0], way[k][2][-m:], way[-1][0]
    return None


def hysteresis(turns: Sequence[float], there: Diagram, back: Diagram) -> tuple[tuple[float, float], ...]:
    """The intervals of values (low, high) over which a diagram and the one of the same values backwards differ.

    They differ where the two sets of places are farther apart than their halves are from each other, by three times
    the error; an interval ends at the outermost values where they do.  Of fewer than 16 places nothing is said.
    """
    differ: list[tuple[float, bool]] = []
    for value, one, other in zip(there.values, there.places, reversed(back.places), strict=True):
        if min(len(one), len(other)) < COMPARED:
            continue
        found = how_far_apart(turns, one, other)
        differ.append((float(value), found.distance > 3.0 * (found.grain + found.error) + 1e-3))
    runs = [(is_other, [value for value, _ in run]) for is_other, run in groupby(sorted(differ), itemgetter(1))]
    return tuple((run[0], run[-1]) for is_other, run in runs if is_other)


@dataclass(frozen=True)
class Cascade(Result):
    """Period doublings, one after the other: where an orbit of each period has the multiplier −1.

    values, errors : (k,), of the parameter; periods : (k,), before the doubling; places : of the orbits there.
    ratios, ratio_errors : (k − 2,), of the distances between neighbouring doublings, which tend to Feigenbaum's δ =
    4.6692 where a map is like one of a line; ended : why there are no more.
    """

    parameter: str
    names: tuple[str, ...]
    values: Array
    errors: Array
    periods: Whole
    places: tuple[Array, ...]
    ended: str
    level: str

    @property
    def error_estimate(self) -> float:
        """The largest error of a value."""
        return float(self.errors.max(initial=0.0))

    @property
    def ratios(self) -> Array:
        """(λ_k − λ_(k−1))/(λ_(k+1) − λ_k)."""
        steps = np.diff(self.values)
        return np.asarray(steps[:-1] / steps[1:])

    @property
    def ratio_errors(self) -> Array:
        """From the errors of the values."""
        steps, off = np.abs(np.diff(self.values)), self.errors[1:] + self.errors[:-1]
        return np.asarray(np.abs(self.ratios) * (off[:-1] / steps[:-1] + off[1:] / steps[1:]))

    @property
    def limit(self) -> float:
        """Where it would come to an end if all further ratios were the last one; NaN before there is one."""
        if len(self.values) < 3:
            return math.nan
        return float(self.values[-1] + (self.values[-1] - self.values[-2]) / (self.ratios[-1] - 1.0))

    def labels(self) -> Labels:
        """Periods, values and errors, with the ratio that belongs to each but the first and the last."""
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
            {"ended": self.ended, "limit": self.limit, "level": self.level},
        )


def cascade(
    family: Callable[[float], Map], parameter: str, orbit: PeriodicOrbit, start: float, end: float, doublings: int = 6
) -> Cascade:
    """The doublings of the period of an orbit of the map at λ = `start`, towards λ = `end`.

    The orbit is continued up to its flip; just beyond, Newton's method finds the one of twice the period, from the
    direction in which it is born, and so on.  Raises as `continued` for the first one.
    """
    found: list[Bifurcation] = []
    direction = math.copysign(1.0, end - start)
    at, far = start, end
    ended = f"After {doublings} doublings."
    while len(found) < doublings:
        go_on()
        try:
            branch = continued(family, orbit, parameter, at, far, _POINTS)
        except NotConverged as error:
            if not found:
                raise
            ended = str(error)
            break
        flip = next((one for one in branch.bifurcations if one.kind == "flip"), None)
        if flip is None:
            ended = f"The orbit of period {orbit.period} keeps its period: {branch.ended}"
            break
        found.append(flip)
        if len(found) == doublings:
            break
        if 2 * orbit.period > MAX_PERIOD:
            ended = f"Orbits are looked for up to period {MAX_PERIOD}."
            break
        step = abs(flip.value - (found[-2].value if len(found) > 1 else start)) / _GROWTH
        born = _doubled(family, flip, direction * step)
        if born is None:
            ended = f"Beyond {parameter} = {flip.value:.9g} no orbit of period {2 * orbit.period} is found."
            break
        at, orbit = born
        # Room for a first step that is no guide yet.
        far = end if len(found) == 1 else flip.value + direction * 4.0 * step
    return Cascade(
        parameter,
        orbit.names,
        frozen(np.array([one.value for one in found])),
        frozen(np.array([one.error for one in found])),
        frozen(np.array([len(one.places) for one in found], np.int64)),
        tuple(one.places for one in found),
        ended,
        orbit.level,
    )


def _doubled(family: Callable[[float], Map], flip: Bifurcation, step: float) -> tuple[float, PeriodicOrbit] | None:
    """The orbit of twice the period beyond a flip, and the parameter: a stable one if there is."""
    twice = np.concatenate([flip.places, flip.places])
    away = np.linalg.svd(shoot(family(flip.value), twice).jacobian)[2][-1].reshape(twice.shape)
    away /= np.abs(away).max()
    other: tuple[float, PeriodicOrbit] | None = None
    for share in _AHEAD:
        value = flip.value + share * step
        map_ = family(value)
        for amplitude in _AMPLITUDES:
            go_on()
            try:
                orbit = find_periodic(map_, twice + amplitude * away)
            except ModelError:
                continue
            if orbit.period == len(twice) and np.abs(apart(map_.turns, orbit.places, twice)).max() < _NEAR * amplitude:
                if orbit.kind.startswith("stable"):
                    return value, orbit
                other = other or (value, orbit)
                break
    return other
