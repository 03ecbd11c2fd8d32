"""Classify a motion on a section, and the dynamics around it: conservative, dissipative or mixed.

A motion is periodic if its crossings repeat, Newton's method finds a periodic orbit there, and the crossings lie on it
to within the error, or tend to it.  It is chaotic if two independent indicators agree and still agree when the time is
doubled: MEGNO, which follows neighbours by the variational equations, exceeds 3 and keeps growing, and the largest K of
the 0–1 test of every crossing, every second, every fourth and so on is close to 1.  It is quasi-periodic if neighbours
do not part and averages along it converge as on a smooth curve, also without their periodic part; an attractor needs an
exponent that is 0 too.  If none of this is clear, the motion is followed four times as long, up to three times; after
that it is undecided.

Dynamics are classified by the sets to which orbits tend forward and backward in time, and by the mean divergence on the
first one (Gonchenko, Gonchenko, Kazakov 2020).  Both come from an ensemble of orbits.  `dissipative` and `mixed` need a
mean divergence that is negative by more than three errors, at least six settled orbits of eight, and agreement of these
about the sets; `conservative` needs a fact: a field that preserves a volume, a smooth invariant measure, or a reversor
that takes the motion to itself.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from enum import IntEnum

import numpy as np

from hess_mechanics.dynamics.birkhoff import bounded_series, ensemble_mean, irregularity, volume_sign
from hess_mechanics.dynamics.ensemble import complete
from hess_mechanics.dynamics.megno import CHAOTIC, REGULAR, Megno, longest_duration, megno
from hess_mechanics.dynamics.orbit_diagram import SAME, period_of
from hess_mechanics.dynamics.periodic import difference, find_periodic, units_of
from hess_mechanics.dynamics.plane_section import section
from hess_mechanics.dynamics.point_sets import SetDistance, nearest, set_distance
from hess_mechanics.dynamics.return_map import ReturnMap
from hess_mechanics.dynamics.spectrum import lyapunov_spectrum
from hess_mechanics.dynamics.symmetry import sign_symmetries
from hess_mechanics.dynamics.system import Problem
from hess_mechanics.dynamics.zero_one import LEAST, zero_one_of_bands
from hess_mechanics.errors import ModelError, NoReturn, OutsideRegion, WorkLimit
from hess_mechanics.numerics.accuracy import Status
from hess_mechanics.numerics.arguments import as_integer, as_point
from hess_mechanics.numerics.labelled import Labels, Result, components
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array, as_read_only

__all__ = ["Dynamics", "MotionKind", "Regime", "comparison", "dynamics_of", "regime"]

_MEMBERS = 8
"""Number of orbits of an ensemble; the probability that all agree by chance is 1/2⁸."""
_ENOUGH = 6
"""Least number of orbits of an ensemble whose sets must have settled; transient orbits carry no information."""
_SHIFT = 1e-8
"""Initial distance between the orbits of an ensemble: invisible, but large enough for chaotic orbits to separate."""
_ROUNDS = 4
_LONGER = 4
"""Factor by which the next round follows an undecided motion longer."""
_RETURNS = 30
"""The indicator takes at least this many returns, so that it sees more than one passage of a slow motion."""
_GROWS = 1.25
"""Least ratio of MEGNO to MEGNO at half the time of a chaotic motion: 2 in the limit, at most 1 for regular ones."""
_CHAOTIC_SERIES = 0.8
"""K of the 0–1 test above which crossings are chaotic.  Below it nothing follows, and alone it proves nothing: K of
slowly modulated quasi-periodic motions stays close to 1 for long."""
_SMOOTH = 3e-3
"""Largest `irregularity` of a quasi-periodic motion; at least 0.01 in narrow bands of chaos."""
_PRECISION = 1e3
"""Differences of averages that do not count as irregularity, in errors of the map: an orbit drifts by some of them."""
_LINEAR = 0.1
"""Largest distance of MEGNO from 2 of motions whose neighbours part linearly, as those of tori do."""
_FEWEST, _MANY = 800, 6000
"""Crossings that a motion without a period needs to count as quasi-periodic.  An attractor needs more: beyond a cascade
of doublings it consists of bands, which only that many crossings show to be no curve."""
_LONGEST_PERIOD = 256
"""Longest period that is tried; it has to repeat three times."""
_CLOSED = 100.0
"""Largest distance, in errors of the map, between points a period apart: orbits of many returns repeat to about ten.
Also the largest |f| of a motion at rest, in the same unit."""
_INDEPENDENT = 400
"""Crossings after which orbits of an ensemble are taken for independent."""
_MOST_CROSSINGS = 20_000
_MIRRORED, _GRAINS = 16, 3.0
"""Points of a motion whose mirror images are compared with it, and their largest distance from it, in units of the
distance between its halves."""
_TOUCHING = 0.005
"""Fraction of common points from which two sets count as touching.  It was 0.015 to 0.2 in samples of 1500 points of
sets that touch, and 0 for sets that do not."""


class MotionKind(IntEnum):
    """Kinds of motions on a section, numbered as in charts."""

    NO_RETURN = 0
    FIXED_POINT = 1
    PERIODIC = 2
    QUASI_PERIODIC = 3
    CHAOTIC = 4
    UNDECIDED = 5
    NO_PERIOD = 6
    SETTLING = 7

    @property
    def words(self) -> str:
        """The name of the kind in a sentence."""
        return _WORDS[self]


_WORDS = (
    "not seen to return to the section",
    "fixed point",
    "periodic",
    "quasi-periodic",
    "chaotic",
    "undecided so far",
    f"regular, no period up to {_LONGEST_PERIOD}",
    "still settling",
)
"""Names of the kinds, in their order."""

_ON_ONE_SET = MotionKind.FIXED_POINT, MotionKind.PERIODIC, MotionKind.QUASI_PERIODIC
"""Kinds of motions whose averages are the same forward and backward in time."""


@dataclass(frozen=True)
class Regime(Result):
    """The kind of one motion after its transient.

    Attributes
    ----------
    map_ : ReturnMap
        Return map of the section.
    kind : MotionKind
        Kind of the motion.
    points : ndarray, shape (n, d)
        Its crossings after the transient; for a motion that did not return, the crossings of the last search.
    duration : float
        Time of MEGNO, positive, in units T; for a motion that did not return, the time limit.
    period : int
        Number of returns after which the motion repeats; 0 if no period was found.
    megno : float
        Ȳ after that time: of the motion if it is periodic, otherwise the median over the ensemble.  Near 2 for regular
        motions, > 3 for chaotic ones; 0 for a motion that did not return.
    k : float
        Largest K of the 0–1 test of every crossing, every second, every fourth and so on; NaN for fewer than 100
        crossings.
    divergence, divergence_error : float
        Mean of div ẏ and its error, in 1/T, along the motion if it is periodic, otherwise over an ensemble of orbits;
        three errors are a 99.7 % interval.  Both are 0 if `measure` is not empty or the motion did not return.
    measure : str
        Reason why the mean divergence is exactly 0 although the divergence is not; empty if none is known.
    """

    map_: ReturnMap
    kind: MotionKind
    points: Array
    duration: float
    period: int = 0
    megno: float = 0.0
    k: float = math.nan
    divergence: float = 0.0
    divergence_error: float = 0.0
    measure: str = ""

    @property
    def volume(self) -> int:
        """−1 if phase volume around the motion shrinks by more than three errors, 1 if it grows by so much, else 0."""
        return 0 if self.measure else int(volume_sign(self.divergence, self.divergence_error))

    @property
    def bound(self) -> float:
        """Upper bound on |mean divergence|: its value plus three errors."""
        return abs(self.divergence) + 3.0 * self.divergence_error

    def labels(self) -> Labels:
        """Return the crossings, with the kind and the numbers that decided it.

        Returns
        -------
        Labels
            The coordinates over the crossings.
        """
        return Labels(
            {},
            components(self.map_.names, self.points, "crossing"),
            units_of(self.map_.names),
            {
                "kind": self.kind.words,
                "period": self.period,
                "MEGNO": self.megno,
                "K": self.k,
                "t": self.duration,
                "divergence": self.divergence,
                "divergence error": self.divergence_error,
                "measure": self.measure,
                "integrable": self.map_.section.integrable,
                "level": self.map_.level,
            },
        )


@dataclass(frozen=True)
class _Evidence:
    """The findings of one round; early and late are Ȳ at half the time and at all of it.

    regular : a theorem excludes chaos; winds : by a theorem, a motion without a period is quasi-periodic.
    """

    crossings: int
    period: int
    has_settled: bool
    early: float
    late: float
    k: float
    irregular: float
    divergence: float
    divergence_error: float
    regular: bool
    winds: bool

    @property
    def dissipative(self) -> bool:
        """True if phase volume changes, so that the motion lies on an attractor or repeller."""
        return not self.winds and volume_sign(self.divergence, self.divergence_error) != 0

    @property
    def smooth(self) -> bool:
        """True if the motion lies on a smooth curve, by its averages or, for many crossings, by its neighbours."""
        if self.winds or self.irregular < _SMOOTH:
            return True
        linear = max(abs(self.early - 2.0), abs(self.late - 2.0)) < _LINEAR
        return linear and not self.dissipative and self.crossings >= _MANY

    @property
    def kind(self) -> MotionKind:
        """The kind of the motion that this evidence shows."""
        if self.period:
            return MotionKind.FIXED_POINT if self.period == 1 else MotionKind.PERIODIC
        # Neighbours separate exponentially, and continue to when the time is doubled.
        grows = min(self.early, self.late) > CHAOTIC and self.late > _GROWS * self.early
        if grows and self.k > _CHAOTIC_SERIES and not self.regular:
            return MotionKind.CHAOTIC
        if not (self.late < max(REGULAR, self.early) or self.regular):
            return MotionKind.UNDECIDED
        if not self.has_settled:
            return MotionKind.SETTLING
        if self.crossings >= (_MANY if self.dissipative else _FEWEST) and self.smooth:
            return MotionKind.QUASI_PERIODIC
        return MotionKind.UNDECIDED


def regime(
    map_: ReturnMap, start: Sequence[float] | Array, transient: int = 300, crossings: int = 200, duration: float = 200.0
) -> Regime:
    """Classify the motion from a point of a section.

    Parameters
    ----------
    map_ : ReturnMap
        Return map of the section.
    start : array_like, shape (d,)
        Point where the motion starts.
    transient : int, default 300
        Crossings discarded, 0 to 20 000.
    crossings : int, default 200
        Crossings used, 1 to 20 000.  Up to 64 times as many are used if they do not decide, at most 20 000.
    duration : float, default 200
        Time of MEGNO, positive, in units T; longer if 30 returns need more.  Up to 64 times as long if it does not
        decide.

    Returns
    -------
    Regime
        The kind of the motion, with the numbers that decided it.  It may be UNDECIDED, SETTLING
        (regular, but the transient is longer) or NO_RETURN.

    Raises
    ------
    InvalidParameter
        If a number is out of range.
    NoReturn
        If the last crossing is not followed by another one on the same sheet.
    OutsideRegion
        If no motion crosses the section at the point.
    WorkLimit
        If the orbit needs too many steps, or the motion ends.

    Examples
    --------
    >>> from hess_mechanics import HessBody, regime, return_map
    >>> P = return_map(HessBody(I22=2.0, I23=1.0, b3=-1.0), h=1.5, f=0.6)
    >>> regime(P, (0.3,), duration=100.0).kind.words  # it tends to the stable limit cycle
    'fixed point'
    """
    transient, crossings = (
        as_integer("transient", transient, 0, _MOST_CROSSINGS),
        as_integer("crossings", crossings, 1, _MOST_CROSSINGS),
    )
    start = as_point(map_.names, start)
    points = map_.orbit(np.array(start), transient + crossings)
    if len(points) < transient + crossings:
        return _not_seen(map_, points, start)
    points = points[transient:]
    # Pass a time that is not positive to MEGNO unchanged, which raises the error for it.
    span = max(duration, _RETURNS * map_.time_of(points[-1])) if duration > 0.0 else duration
    evidence = _evidence(map_, points, span)
    for _ in range(_ROUNDS - 1):
        if evidence.kind not in (MotionKind.UNDECIDED, MotionKind.SETTLING):
            break
        count = min(_LONGER * len(points), _MOST_CROSSINGS)
        longest = longest_duration(map_.section, map_.state_at(points[-1]))
        longer = max(span, min(_LONGER * span, longest))
        if (count, longer) == (len(points), span):
            break
        check_limit()
        following = map_.orbit(points[-1], count)
        if len(following) < count:
            return _not_seen(map_, following, points[-1])
        points, span = following, longer
        evidence = _evidence(map_, points, span)
    kind, measure = evidence.kind, map_.section.measure
    if kind in _ON_ONE_SET and not (measure or evidence.dissipative or map_.preserves_volume):
        measure = _reversor(map_, points)
    if kind is MotionKind.QUASI_PERIODIC and evidence.dissipative and not _has_a_curve(map_, points[-1], span):
        kind = MotionKind.NO_PERIOD
    divergence = (0.0, 0.0) if measure else (evidence.divergence, evidence.divergence_error)
    return Regime(
        map_, kind, as_read_only(points.copy()), span, evidence.period, evidence.late, evidence.k, *divergence, measure
    )


def _not_seen(map_: ReturnMap, points: Array, start: Sequence[float] | Array) -> Regime:
    last = points[-1] if len(points) else np.array(start, float)
    measure = map_.section.measure
    return Regime(map_, MotionKind.NO_RETURN, as_read_only(points.copy()), map_.wait(last), measure=measure)


def _evidence(map_: ReturnMap, points: Array, duration: float) -> _Evidence:
    period, settled = _period(map_, points)
    # A periodic orbit needs no ensemble; the kind of any other motion follows from its neighbours as well.
    starts = points[-1:] if period else _ensemble(map_, points)
    early, late = (_indicated(map_, starts, time) for time in (duration / 2.0, duration))
    windows = late.windows
    mean, error = (windows[0, 0], np.ptp(windows)) if len(windows) == 1 else ensemble_mean(windows)
    plane, enough = map_.section, len(points) >= LEAST
    winds = bool(plane.integrable or plane.measure)
    return _Evidence(
        len(points),
        period,
        settled,
        float(np.median(early.values)),
        float(np.median(late.values)),
        zero_one_of_bands(bounded_series(map_.turns, points).sum(axis=1)) if enough else math.nan,
        irregularity(map_.turns, points, _PRECISION * map_.promise) if enough else math.inf,
        float(mean),
        0.0 if map_.preserves_volume else float(error) + map_.promise,
        winds or all(late.no_chaos),
        winds,
    )


def _period(map_: ReturnMap, points: Array) -> tuple[int, bool]:
    """Return the period of an orbit, 0 if Newton's method confirms none, and True if the orbit has settled."""
    most = min(_LONGEST_PERIOD, len(points) // 3)
    period, settled = period_of(map_.turns, points, map_.promise, most)
    # Next to a doubling, an orbit of twice the period looks like one of the period that doubled.
    for m in (period, 2 * period) if period else ():
        if m <= most and _closes(map_, points, m):
            return m, True
    return 0, period_of(map_.turns, points, 0.0, most, 0.0)[1] if period else settled


def _closes(map_: ReturnMap, points: Array, m: int) -> bool:
    """Return True if the points lie on, or tend to, an orbit of least period m that Newton's method finds."""
    last, precision = points[-m:], min(SAME, _CLOSED * map_.promise)
    if m == 1 and _at_rest(map_, last[0], precision):
        # The motion does not return, but its kind is known: f(y) = 0.
        return True
    try:
        orbit = find_periodic(map_, last if m > 1 else last[0], m, near=True)
    except WorkLimit:
        raise
    except ModelError:
        return False
    if orbit.period != m or orbit.status is Status.PROMISE_NOT_MET:
        return False
    periods = len(points) // m
    away = np.abs(difference(map_.turns, points[-periods * m :].reshape(periods, m, -1), orbit.points)).max(axis=(1, 2))
    gap = float(np.abs(difference(map_.turns, points[m:], points[:-m])).max())
    if away[-1] <= precision or (gap <= precision and away[-1] <= SAME):
        return True
    # An attracting orbit is the limit if the distance decreases at the rate of its multiplier.
    rate = float(np.abs(orbit.multipliers).max()) + orbit.multiplier_error
    return rate < 1.0 and float(away[-1]) < 0.5 * (1.0 + rate ** (periods - 1)) * float(away[0])


def _at_rest(map_: ReturnMap, point: Array, precision: float) -> bool:
    problem = Problem.of(map_.section, map_.state_at(point)[None])
    return float(np.abs(problem.system.rates(problem.states, problem.parameters)).max()) <= precision


def _ensemble(map_: ReturnMap, points: Array) -> Array:
    """Return the end points (m, d) of orbits that started next to different points (n, d) of an orbit."""
    ends, count = [], min(len(points), _INDEPENDENT)
    for i in range(_MEMBERS):
        start = points[i * len(points) // _MEMBERS]
        try:
            following = map_.orbit(start + _SHIFT * (i + 1), count)
        except OutsideRegion:
            following = map_.orbit(start, count)
        if len(following):
            ends.append(following[-1])
    return np.array(ends)


def _indicated(map_: ReturnMap, points: Array, duration: float) -> Megno:
    states = map_.state_at(points)
    return complete(megno(map_.section, states, -duration if map_.backward else duration, map_.accuracy, threads=1))


def _reversor(map_: ReturnMap, points: Array) -> str:
    """Return the reversor that takes a motion to itself, in words; an empty string if there is none.

    A reversor changes the sign of the divergence and of time, so the mean divergence of such a motion is 0.
    """
    plane = map_.section
    halves = np.array_split(points, 2)
    precision = _GRAINS * float(np.quantile(nearest(map_.turns, *halves), 0.95)) + _CLOSED * map_.promise
    states = map_.state_at(points[:: -(-len(points) // _MIRRORED)])
    for mirror in sign_symmetries(plane.system, plane.parameters):
        if not mirror.reverses:
            continue
        try:
            images = np.array(
                [
                    section(plane, one, plane.surface, map_.wait(points[-1]), map_.accuracy, 1).states[0]
                    for one in map(mirror.image, states)
                ]
            )
            there = plane.points_of(images)
            # The image must have the same values of the integrals.
            same = float(np.abs(map_.state_at(there) - images).max()) <= SAME * max(1.0, float(np.abs(images).max()))
        except (ModelError, IndexError):
            continue
        if same and float(nearest(map_.turns, there, points).max()) <= precision:
            return f"the reversor {mirror.name} takes the motion to itself"
    return ""


def _has_a_curve(map_: ReturnMap, point: Array, duration: float) -> bool:
    """Return True if at least one more exponent vanishes than the integrals and the direction of motion require.

    An attracting invariant curve has such an exponent; an attracting periodic orbit, however long, does not.
    """
    spectrum = lyapunov_spectrum(
        map_.section, map_.state_at(point), -duration if map_.backward else duration, map_.accuracy
    )
    return spectrum.zeros >= spectrum.integrals + 2


@dataclass(frozen=True)
class Dynamics(Result):
    """Attractor and repeller of the orbits from a point, their distance, and the change of volume.

    Attributes
    ----------
    motion : Regime
        Kind of the motion forward in time, with the mean divergence.
    attractor, repeller : ndarray, shape (n, d) and (m, d)
        Crossings of the first orbit after the transient, followed forward and backward in time, in coordinates of the
        section.
    comparisons : tuple of SetDistance
        Distance between the two sets, for each orbit of the ensemble.
    """

    motion: Regime
    attractor: Array
    repeller: Array
    comparisons: tuple[SetDistance, ...]

    @property
    def settled_comparisons(self) -> tuple[SetDistance, ...]:
        """Comparisons of the orbits that have settled; all comparisons if there is no such orbit."""
        return tuple(one for one in self.comparisons if one.has_settled) or self.comparisons

    @property
    def distance(self) -> float:
        """Mean distance between attractor and repeller over the settled orbits, in units of the coordinates."""
        return float(np.mean([one.distance for one in self.settled_comparisons]))

    @property
    def distance_error(self) -> float:
        """Largest error, grain or difference from the mean distance among the settled orbits."""
        return max(max(one.error, one.grain, abs(one.distance - self.distance)) for one in self.settled_comparisons)

    @property
    def overlap(self) -> float:
        """Mean fraction of the points of one set that are close to the other set, over the settled orbits."""
        return float(np.mean([one.overlap for one in self.settled_comparisons]))

    @property
    def verdict(self) -> str:
        """One of "conservative", "dissipative", "mixed" and "not told apart", see the module."""
        if self.motion.map_.preserves_volume or self.motion.measure:
            return "conservative"
        if sum(one.has_settled for one in self.comparisons) >= _ENOUGH and self.motion.volume < 0:
            if all(one.is_separated for one in self.settled_comparisons):
                return "dissipative"
            if all(one.overlap >= _TOUCHING for one in self.settled_comparisons):
                return "mixed"
        return "not told apart"

    def labels(self) -> Labels:
        """Return the points of both sets, with the verdict.

        Returns
        -------
        Labels
            The coordinates over the points.
        """
        which = np.repeat(["attractor", "repeller"], [len(self.attractor), len(self.repeller)])
        points = np.concatenate([self.attractor, self.repeller])
        along, names = ("crossing",), self.motion.map_.names
        return Labels(
            {"set": (along, which)},
            components(names, points, *along),
            units_of(names),
            {
                "verdict": self.verdict,
                "distance": self.distance,
                "distance error": self.distance_error,
                "shared": self.overlap,
                "divergence": self.motion.divergence,
                "divergence error": self.motion.divergence_error,
                "level": self.motion.map_.level,
            },
        )


def dynamics_of(
    map_: ReturnMap,
    start: Sequence[float] | Array,
    transient: int = 500,
    crossings: int = 2000,
    duration: float = 1000.0,
) -> Dynamics:
    """Classify the dynamics around the orbits from a point: conservative, dissipative or mixed.

    Parameters
    ----------
    map_ : ReturnMap
        Return map of the section.
    start : array_like, shape (d,)
        Point where the orbits start, 1e-8 from each other.
    transient : int, default 500
        Crossings discarded of each orbit, 0 to 20 000.
    crossings : int, default 2000
        Crossings used of each orbit, 8 to 20 000.
    duration : float, default 1000
        Time of MEGNO and of the mean divergence, positive, in units T, see `regime`.

    Returns
    -------
    Dynamics
        The verdict, with the two sets and their distance.

    Raises
    ------
    InvalidParameter
        If a number is out of range.
    NoReturn
        If the motion does not return often enough.
    OutsideRegion
        If no motion crosses the section at the point.
    WorkLimit
        If an orbit needs too many steps, or a motion ends.

    Examples
    --------
    >>> from hess_mechanics import QuarticBody, dynamics_of, return_map
    >>> P = return_map(QuarticBody(2.0, 1.0, 1.0, 0.8), accuracy="standard")
    >>> dynamics_of(P, (0.3, 0.2), transient=60, crossings=64, duration=100.0).verdict  # I₁₃ = I₂₃ = 0 preserves volume
    'conservative'
    """
    crossings = as_integer("crossings", crossings, 8, _MOST_CROSSINGS)
    return comparison(map_, regime(map_, start, transient, min(crossings, 400), duration), start, transient, crossings)


def comparison(
    map_: ReturnMap, motion: Regime, start: Sequence[float] | Array, transient: int, crossings: int
) -> Dynamics:
    """Classify the dynamics around orbits whose kind of motion is already known.

    Parameters
    ----------
    map_ : ReturnMap
        Return map of the section.
    motion : Regime
        Kind of the motion forward in time.
    start : array_like, shape (d,)
        Point where the orbits start, 1e-8 from each other.
    transient : int
        Crossings discarded of each orbit.
    crossings : int
        Crossings used of each orbit, at least 8.

    Returns
    -------
    Dynamics
        The verdict, with the two sets and their distance.

    Raises
    ------
    InvalidParameter
        If the point does not have d numbers, or `transient` and `crossings` are out of range.
    NoReturn
        If the motion does not return often enough.
    OutsideRegion
        If no motion crosses the section at the point.
    WorkLimit
        If an orbit needs too many steps, or a motion ends.
    """
    origin = np.array(start, float)
    pairs: list[tuple[Array, Array]] = []
    for i in range(_MEMBERS):
        check_limit()
        pair: list[Array] = []
        for one in (map_, map_.inverse()):
            orbit = one.orbit(origin + _SHIFT * i, transient + crossings)
            if len(orbit) < transient + crossings:
                way = "backward" if one.backward else "forward"
                raise NoReturn(
                    f"Followed {way} in time, the motion returned only {len(orbit)} times: choose another point."
                )
            pair.append(as_read_only(orbit[transient:].copy()))
        pairs.append((pair[0], pair[1]))
    return Dynamics(motion, *pairs[0], tuple(set_distance(map_.turns, a, b) for a, b in pairs))
