"""Pseudo-arclength continuation of periodic orbits in a parameter, through folds, with detection of bifurcations.

A branch is a curve of z = (x_0, …, x_(m−1), λ) with F = P_λ(x_i) − x_(i+1) = 0.  A step goes along the tangent t, and
Newton's method returns to the curve in the plane across t (Keller 1977).  Between two points of a branch the following
functions may change sign; the zero is then located:

    fold                 t_λ: the branch turns back;
    branch point         det (F_x F_λ; tᵀ): another branch crosses; a pitchfork if it breaks a symmetry;
    flip                 det (M + 1): a multiplier −1, an orbit of twice the period is born;
    Neimark–Sacker       det M − 1 with a pair of complex multipliers: an invariant curve is born.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from hess_mechanics.dynamics.periodic import (
    Map,
    PeriodicOrbit,
    Shot,
    difference,
    kind_of,
    multipliers_of,
    shoot,
    units_of,
)
from hess_mechanics.errors import InvalidParameter, ModelError, NotConverged
from hess_mechanics.numerics.labelled import Labels, Result, components
from hess_mechanics.numerics.measured import SAFETY
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array, Complex, as_read_only

__all__ = ["Bifurcation", "Branch", "MapFamily", "branch_from", "extension"]

_FIRST, _LONGEST, _SHORTEST = 0.01, 0.1, 1e-7
"""First, longest and shortest step along a branch, in units of the coordinates and of the width of the range of λ."""
_TURN = 0.3
"""Largest turn of the tangent in one step, in radians."""
_CONSERVATIVE = 1e-6
"""If |det M − 1| is below this at both ends of a step, the map preserves area, and no curve is born."""

_SINGULAR = (NotConverged, ModelError, np.linalg.LinAlgError)
"""Errors raised where two branches cross."""
_MAPS = 8
"""Number of cached maps of a family: Newton's method returns to some of them."""
_SHARES, _HALVINGS = (0.5, 0.35, 0.65, 0.2, 0.8, 0.05, 0.95), 24
"""Fractions at which a bracket may be divided, tried in this order; and the largest number of divisions."""

MapFamily = Callable[[float], Map]
"""Function from λ to the map; it raises a `ModelError` if there is none."""

_ASIDE = 1e-3
"""Distance from a crossing of branches at which the other branch is tested for symmetries."""


@dataclass(frozen=True)
class Bifurcation:
    """A point of a branch where orbits are born, merge or change their type.

    Attributes
    ----------
    kind : str
        "fold", "flip", "Neimark–Sacker", "pitchfork" or "branch point".
    value : float
        Value of the parameter.
    error : float
        Estimated error of the value, ≥ 0.
    points : ndarray, shape (m, d)
        Points of the orbit.
    multipliers : ndarray of complex, shape (d,)
        Multipliers of the orbit, the largest first.
    index : int
        Index of the point of the branch before the bifurcation.
    """

    kind: str
    value: float
    error: float
    points: Array
    multipliers: Complex
    index: int


@dataclass(frozen=True)
class Branch(Result):
    """A branch of periodic orbits over a parameter.

    Attributes
    ----------
    parameter : str
        Name of the parameter.
    names : tuple of str
        Names of the coordinates.
    values : ndarray, shape (n,)
        Values of the parameter.
    points : ndarray, shape (n, m, d)
        Points of each orbit.
    multipliers : ndarray of complex, shape (n, d)
        Multipliers of each orbit.
    kinds : tuple of str
        Type of each orbit, see `PeriodicOrbit`.
    errors : ndarray, shape (n,)
        Estimated errors of the points, in units of the coordinates.
    bifurcations : tuple of Bifurcation
        Bifurcations, in their order along the branch.
    end_reason : str
        Reason why the branch ends.
    level : str
        Name of the accuracy level.
    times : ndarray, shape (n,), or None
        Time of one period of each orbit, in units T; None if it was not computed.
    heading : (ndarray, float) or None
        Tangent (m d + 1,) at the last point and length of the next step, both in the units of the steps; None if the
        branch has come to an end.
    """

    parameter: str
    names: tuple[str, ...]
    values: Array
    points: Array
    multipliers: Complex
    kinds: tuple[str, ...]
    errors: Array
    bifurcations: tuple[Bifurcation, ...]
    end_reason: str
    level: str
    times: Array | None = None
    heading: tuple[Array, float] | None = None

    @property
    def period(self) -> int:
        """Period of all orbits."""
        return int(self.points.shape[1])

    @property
    def error_estimate(self) -> float:
        """Largest estimated error of a point."""
        return float(self.errors.max())

    def labels(self) -> Labels:
        """Return the first point, multipliers, type, error and time of each orbit, labelled with the parameter.

        Returns
        -------
        Labels
            The arrays over the points of the branch, without the times if these are None.
        """
        along = ("point",)
        parts = {
            f"{part}{i + 1}": (along, getattr(self.multipliers[:, i], part).copy())
            for i in range(self.multipliers.shape[1])
            for part in ("real", "imag")
        }
        return Labels(
            {self.parameter: (along, self.values)},
            {
                **components(self.names, self.points[:, 0], *along),
                **parts,
                **({} if self.times is None else {"time": (along, self.times)}),
                "kind": (along, np.array(self.kinds)),
                "error": (along, self.errors),
            },
            {"time": "T", **units_of(self.names)},
            {
                "period": self.period,
                "level": self.level,
                "error_estimate": self.error_estimate,
                "ended": self.end_reason,
                "bifurcations": "; ".join(
                    f"{one.kind} at {one.value:.12g} ± {one.error:.1g}" for one in self.bifurcations
                ),
            },
        )


@dataclass(frozen=True)
class _Point:
    """A point z of the branch, with the map and Newton's equations there."""

    z: Array
    shot: Shot
    by_parameter: Array
    iterations: int

    @cached_property
    def bordered(self) -> Array:
        """The matrix (F_x F_λ), shape (m d, m d + 1)."""
        return np.hstack([self.shot.jacobian, self.by_parameter[:, None]])

    def tangent(self, like: Array) -> Array:
        """Return the unit tangent (m d + 1,) of the branch, oriented like `like`."""
        t = np.linalg.svd(self.bordered)[2][-1]
        return np.asarray(t if t @ like >= 0.0 else -t)


@dataclass(frozen=True)
class _Track:
    """The constants of a branch; z holds the points (m, d) divided by √m, and λ divided by the width of its range.

    map_at : the family of maps, with a cache of the last ones.
    """

    map_at: MapFamily
    parameter: str
    names: tuple[str, ...]
    level: str
    ends: tuple[float, float]
    shape: tuple[int, ...]

    @property
    def width(self) -> float:
        return abs(self.ends[1] - self.ends[0])

    @property
    def root(self) -> float:
        """Scale √m of the points."""
        return math.sqrt(self.shape[0])

    def split(self, z: Array) -> tuple[Array, float]:
        return z[:-1].reshape(self.shape) * self.root, float(z[-1] * self.width)

    def joined(self, points: Array, value: float) -> Array:
        return np.append(points.ravel() / self.root, value / self.width)

    def point(self, z: Array, iterations: int = 0, better: bool = False) -> _Point:
        """Return F and its derivatives at z.  Raises the errors of the family and of its maps."""
        points, value = self.split(z)
        map_ = self.map_at(value).tighter() if better else self.map_at(value)
        shot = shoot(map_, points)
        # Only Newton's steps and the tangent use this derivative; its error does not move the orbit.
        h = 1e-5 * self.width
        sides = [self.map_at(value + sign * h).image(points) for sign in (1.0, -1.0)]
        by_value = difference(map_.turns, *sides) / (2.0 * h)
        # The equations are divided by √m, like the points.
        return _Point(z, shot, by_value.ravel() * self.width / self.root, iterations)

    def _step(self, point: _Point, across: Array, left: float) -> Array:
        matrix = np.vstack([point.bordered, across])
        return np.linalg.solve(matrix, -np.append(point.shot.residuals.ravel() / self.root, left))

    def corrected(self, guess: Array, across: Array) -> _Point:
        """Return the point of the branch in the plane through `guess` across a direction.  Raises `NotConverged`."""
        z, before = guess, math.inf
        for iteration in range(1, 13):
            check_limit()
            try:
                point = self.point(z, iteration)
                step = self._step(point, across, float(across @ (z - guess)))
            except (ModelError, np.linalg.LinAlgError) as error:
                raise NotConverged(str(error)) from error
            length = float(np.abs(step).max())
            promise = self.map_at(self.split(z)[1]).promise
            if length <= 1e-14 or (length <= promise and length > 0.25 * before):
                return point
            if length > 4.0 * before and length > promise:
                break
            z, before = z + step, length
        raise NotConverged("Newton's method does not converge to a point of the branch.")

    def beside(self, guess: Array, across: Array, t: Array) -> tuple[_Point, Array]:
        """Return the `corrected` point and its tangent, which must be close to t.  Raises `NotConverged`."""
        point = self.corrected(guess, across)
        tangent = point.tangent(t)
        if math.acos(min(1.0, float(tangent @ t))) > _TURN:
            raise NotConverged("The branch turns too sharply.")
        return point, tangent

    def error(self, point: _Point, across: Array) -> float:
        """Return the error of the points and of the scaled λ, by a more accurate map."""
        better = self.point(point.z, better=True)
        return SAFETY * self.root * float(np.abs(self._step(better, across, 0.0)).max()) + 1e-15


def _signs(point: _Point, t: Array) -> dict[str, float]:
    """Return the functions that change sign at a bifurcation, by the kind of the bifurcation."""
    values, trace, determinant = multipliers_of(point.shot.derivatives)
    signs = {"fold": float(t[-1]), "branch point": float(np.linalg.det(np.vstack([point.bordered, t])))}
    if values.size == 1:
        return {**signs, "flip": 1.0 + trace}
    return {**signs, "flip": 1.0 + trace + determinant, "Neimark–Sacker": determinant - 1.0}


def _happens(kind: str, before: _Point, after: _Point, values: tuple[float, float]) -> bool:
    if not values[0] * values[1] < 0.0:
        return False
    if kind == "Neimark–Sacker":
        return max(map(abs, values)) > _CONSERVATIVE and all(
            bool(multipliers_of(one.shot.derivatives)[0][0].imag) for one in (before, after)
        )
    return True


def branch_from(
    family: MapFamily,
    orbit: PeriodicOrbit,
    parameter: str,
    start: float,
    end: float,
    points: int = 200,
    edge: float | None = None,
    longest: float = _LONGEST,
    until: str = "",
) -> Branch:
    """Return the branch of an orbit of the map at λ = `start`, towards λ = `end`.

    It ends at either end of the range, after `points` points, where Newton's method fails, or at the first point beyond
    a bifurcation of kind `until`.

    Parameters
    ----------
    family : MapFamily
        Function from λ to the map.
    orbit : PeriodicOrbit
        A periodic orbit at λ = `start`.
    parameter : str
        Name of λ.
    start, end : float
        Values of λ at which the branch starts, and towards which it starts; `end` is one end of the range.
    points : int, default 200
        Largest number of points.
    edge : float, optional
        Other end of the range: `start`, or a value on the side of `start` that is away from `end`.  By default `start`.
    longest : float, default 0.1
        Longest step along the branch, in units of the coordinates and of the width of the range.
    until : str, default ""
        Kind of bifurcation beyond which the branch is not needed, such as "flip"; empty for none.

    Returns
    -------
    Branch
        The branch.

    Raises
    ------
    InvalidParameter
        If the range is empty or not finite, or `start` is not in it.
    WorkLimit
        If the map needs too many steps.
    NotConverged
        If the branch cannot be started: the orbit is none of this map, is at a bifurcation or belongs to a family.
    """
    edge = start if edge is None else edge
    if not (all(map(math.isfinite, (start, end, edge))) and min(edge, end) <= start <= max(edge, end) and start != end):
        raise InvalidParameter(
            f"{parameter} cannot go from {start:g} to {end:g}: give two different finite numbers, and as `edge`, "
            "if any, a finite one that is not on the side of the second."
        )
    track = _Track(lru_cache(_MAPS)(family), parameter, orbit.names, orbit.level, (edge, end), orbit.points.shape)
    along = np.zeros(orbit.points.size + 1)
    along[-1] = math.copysign(1.0, end - start)
    z = track.joined(orbit.points, start)
    try:
        point = track.corrected(z, along)
    except NotConverged as error:
        raise NotConverged(
            f"The branch cannot start at {parameter} = {start:g}: the orbit is not one of this map, is at a "
            "bifurcation, or belongs to a family of periodic orbits. Start at a slightly different value, with an "
            "orbit of the map there."
        ) from error
    return _followed(track, point, point.tangent(along), points, min(_FIRST, longest), longest, until)


def extension(
    family: MapFamily,
    branch: Branch,
    end: float,
    edge: float,
    points: int = 200,
    longest: float = _LONGEST,
) -> Branch:
    """Return the continuation of a branch between the same ends of its range.

    Parameters
    ----------
    family : MapFamily
        Function from λ to the map.
    branch : Branch
        Branch that has a `heading`.
    end : float
        Value of λ at one end of the range, as for `branch`.
    edge : float
        Value of λ at the other end, as for `branch`.
    points : int, default 200
        Largest number of points, with the first one.
    longest : float, default 0.1
        Longest step along the branch, in units of the coordinates and of the width of the range.

    Returns
    -------
    Branch
        The continuation; its first point is the last one of `branch`.

    Raises
    ------
    InvalidParameter
        If the branch cannot be continued.
    NotConverged
        If Newton's method does not converge to a point of the branch.
    WorkLimit
        If a map needs too many steps.
    """
    if branch.heading is None:
        raise InvalidParameter(f"This branch cannot be continued: {branch.end_reason}")
    shape, maps = branch.points.shape[1:], lru_cache(_MAPS)(family)
    track = _Track(maps, branch.parameter, branch.names, branch.level, (edge, end), shape)
    along, step = branch.heading
    point = track.corrected(track.joined(branch.points[-1], float(branch.values[-1])), along)
    return _followed(track, point, point.tangent(along), points, step, longest)


def _followed(
    track: _Track, point: _Point, t: Array, points: int, step: float, longest: float, until: str = ""
) -> Branch:
    """Return the branch from a point along t, with a first and a longest step; it ends after a bifurcation `until`."""
    line = [point]
    errors = [track.error(point, t)]
    bifurcations: list[Bifurcation] = []
    low, high = sorted(one / track.width for one in track.ends)
    along = np.zeros(t.size)
    along[-1] = 1.0
    ended = ""
    while not ended and len(line) < points:
        last = line[-1]
        room = _to_edge(last.z[-1], t[-1], low, high)
        ahead = min(step, room)
        try:
            # Place the last point exactly at the end of the range.
            following, tangent = track.beside(last.z + ahead * t, along if room <= step else t, t)
        except NotConverged as error:
            step = 0.5 * min(step, ahead)
            if step < _SHORTEST:
                at = track.split(last.z)[1]
                ended = f"At {track.parameter} = {at:.9g} it cannot be followed further: {error}"
            continue
        before, after = _signs(last, t), _signs(following, tangent)
        for kind in before:
            if _happens(kind, last, following, (before[kind], after[kind])):
                bifurcations.append(_located(track, kind, last, t, ahead, len(line) - 1))
        line.append(following)
        errors.append(track.error(following, tangent))
        t = tangent
        step = min(longest, step * (1.6 if following.iterations <= 4 else 1.0 if following.iterations <= 6 else 0.6))
        if _to_edge(following.z[-1], t[-1], low, high) <= 1e-12:
            ended = f"At {track.parameter} = {track.split(following.z)[1]:.9g}, the end of the range."
        if any(one.kind == until for one in bifurcations):
            ended = f"Beyond the {until}."
    orbits, values = zip(*(track.split(one.z) for one in line), strict=True)
    multipliers = np.array([multipliers_of(one.shot.derivatives)[0] for one in line])
    kinds = tuple(kind_of(one, max(1e-9, 10.0 * error)) for one, error in zip(multipliers, errors, strict=True))
    return Branch(
        track.parameter,
        track.names,
        as_read_only(np.array(values)),
        as_read_only(np.array(orbits)),
        as_read_only(multipliers),
        kinds,
        as_read_only(np.array(errors)),
        tuple(_told_apart(bifurcations)),
        ended or f"After {points} points.",
        track.level,
        heading=None if ended else (as_read_only(t.copy()), step),
    )


def _to_edge(z: float, rate: float, low: float, high: float) -> float:
    """Return the distance along the tangent to the end of the range: 0 beyond it, ∞ if the parameter is constant."""
    if abs(rate) < 1e-12:
        return math.inf
    return max(0.0, (high - z) / rate if rate > 0.0 else (low - z) / rate)


def _told_apart(bifurcations: Sequence[Bifurcation]) -> list[Bifurcation]:
    """Return the bifurcations without the spurious fold at a pitchfork, where the newborn branch turns."""
    crossings = [one for one in bifurcations if one.kind in ("branch point", "pitchfork")]
    return [
        one
        for one in bifurcations
        if one.kind != "fold" or not any(abs(one.value - other.value) <= one.error + other.error for other in crossings)
    ]


def _located(track: _Track, kind: str, last: _Point, t: Array, ahead: float, after: int) -> Bifurcation:
    """Return the bifurcation at a change of sign: regula falsi (Illinois) in the distance along the tangent."""

    known = {0.0: last.z}

    def at(s: float) -> tuple[_Point, float]:
        near, *other = sorted(known, key=lambda one: abs(one - s))[:2]
        # Newton's method starts on the chord through the two nearest known points.
        along = (known[other[0]] - known[near]) / (other[0] - near) if other else t
        # A point with a different tangent belongs to a branch that crosses here.
        point, tangent = track.beside(known[near] + (s - near) * along, t, t)
        known[s] = point.z
        return point, _signs(point, tangent)[kind]

    low, high = 0.0, ahead
    point, f_low = last, _signs(last, t)[kind]
    values = [float(last.z[-1]), float(last.z[-1] + ahead * t[-1])]
    f = f_high = -f_low
    side = 0
    try:
        point, f_high = at(high)
        if f_low * f_high > 0.0:
            # The last point of a branch was corrected in a different plane.
            high *= 1.5
            point, f_high = at(high)
        for _ in range(60):
            s = high - f_high * (high - low) / (f_high - f_low)
            point, f = at(s)
            values.append(float(point.z[-1]))
            if f == 0.0 or high - low <= 1e-12 * ahead or abs(values[-1] - values[-2]) <= 1e-13:
                break
            if (f > 0.0) == (f_high > 0.0):
                high, f_high = s, f
                f_low, side = (0.5 * f_low if side > 0 else f_low), 1
            else:
                low, f_low = s, f
                f_high, side = (0.5 * f_high if side < 0 else f_high), -1
        # Error of the located point: the test function of a more accurate map differs there by Δf, so its zero is
        # shifted along the branch by Δf divided by the slope of f.
        across = point.tangent(t)
        better = track.point(point.z + track._step(track.point(point.z, better=True), t, 0.0), better=True)
        along = abs((_signs(better, better.tangent(t))[kind] - f) * (high - low) / (f_high - f_low))
        moved = abs(better.z[-1] - point.z[-1]) + along * abs(across[-1]) + 0.5 * along * along
        off = 1.25 * float(moved) + abs(values[-1] - values[-2])
    except _SINGULAR:
        # At a crossing of branches the equations are singular; the zero is bracketed by regular points.
        off, point = _closed_in(track, at, (low, high), point, t)
    points, value = track.split(point.z)
    if kind == "branch point" and _breaks_a_symmetry(track.map_at(value), points, point):
        kind = "pitchfork"
    return Bifurcation(
        kind,
        value,
        off * track.width + 4e-16 * max(1.0, abs(value)),
        as_read_only(points.copy()),
        as_read_only(multipliers_of(point.shot.derivatives)[0]),
        after,
    )


def _closed_in(
    track: _Track, at: Callable[[float], tuple[_Point, float]], bracket: tuple[float, float], point: _Point, t: Array
) -> tuple[float, _Point]:
    """Return the error of the scaled λ at a zero next to which the equations are singular, and the point there.

    The bracket is narrowed; within it λ changes no faster than at its ends, and the secant gives the zero.  `at`
    returns the point and the function at a distance along t; `point` is the present estimate.
    """
    low, high = bracket
    rate = 1.0
    with suppress(*_SINGULAR):
        (before, f_before), (after, f_after) = at(low), at(high)
        for _ in range(_HALVINGS):
            middle = _first_of(at, [low + share * (high - low) for share in _SHARES])
            if middle is None:
                break
            s, between, f = middle
            if (f > 0.0) == (f_after > 0.0):
                high, after, f_after = s, between, f
            else:
                low, before, f_before = s, between, f
        if f_before * f_after < 0.0:
            point = track.point(before.z + (after.z - before.z) * f_before / (f_before - f_after))
            rate = 1.25 * max(abs(float(one.tangent(t)[-1])) for one in (before, after))
    # Of the error of the map itself only the promised bound is known.
    return rate * (high - low) + track.map_at(track.split(point.z)[1]).promise, point


def _first_of(
    at: Callable[[float], tuple[_Point, float]], distances: Sequence[float]
) -> tuple[float, _Point, float] | None:
    """Return the first of some distances at which the equations are regular, with the point and the function there."""
    for s in distances:
        with suppress(*_SINGULAR):
            return s, *at(s)
    return None


def _breaks_a_symmetry(map_: Map, points: Array, point: _Point) -> bool:
    """Return True if the orbit has a symmetry that the orbits of the other branch lack."""
    own = set(map_.symmetries_of(points, 1e-7))
    if not own:
        return False
    away = np.linalg.svd(point.shot.jacobian)[2][-1].reshape(points.shape)
    # A symmetry that shifts the phase is exact only to second order: it returns to the section along the motion.
    aside = map_.symmetries_of(points + _ASIDE * away / np.abs(away).max(), 0.1 * _ASIDE)
    return bool(own - set(aside))
