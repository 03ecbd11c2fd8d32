"""Stable and unstable manifolds of saddles of a plane map, with adaptive density, and their intersections.

Let F be the map after the period m of the saddle (after 2m if its multiplier λ is negative) and v its unstable
direction.  The manifold starts as x_0 + σ δ v + σ² q, which F maps by σ → λσ to second order if (λ² − DF) q = ½ D²F(δv,
δv).  With δ so small that the third order is below round-off, the point with parameter τ = k + s, 0 ≤ s < 1, is

    W(τ) = F^k(x_0 + λ^s δ v + λ^2s q),

a smooth curve with W(τ + 1) = F(W(τ)).  A piece is halved if its middle is too far from its chord, or its chord is too
long (Hobson 1993, with the sagitta in place of an angle).  The error of the first piece across the curve shrinks with
each return.  Stable manifolds are the unstable manifolds of P⁻¹.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, replace

import numpy as np

from hess_mechanics.dynamics.periodic import Map, PeriodicOrbit, difference, units_of
from hess_mechanics.errors import InvalidParameter, ModelError, NotConverged
from hess_mechanics.numerics.accuracy import Status
from hess_mechanics.numerics.labelled import Labels, Result, components
from hess_mechanics.numerics.measured import SAFETY
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array, as_read_only

__all__ = ["MAX_RETURNS", "Intersection", "Manifold", "crossings_of", "heights_at", "manifold", "split"]

MAX_RETURNS = 2_000_000
_FIRST = 4
"""Initial number of pieces per return of the curve."""
_CURVED = 1e-3
"""Distance from the saddle at which the curvature is measured; third orders and round-off are a millionth there."""
_SIZES = tuple(0.05 * 0.5**k for k in range(16))
"""Lengths δ of the first piece that are tried, the longest first."""
_STANDS = 1e-3
"""A curve that grows by less than this fraction of the sagitta in a return has come to a point: a periodic one."""
_CHECKED = 6
"""Number of points that a more accurate map recomputes."""
_FEET = 8
"""Largest number of iterations for the foot of a perpendicular."""


@dataclass(frozen=True)
class Manifold(Result):
    """One branch of the stable or unstable manifold of a saddle.

    Attributes
    ----------
    names : tuple of str
        Names of the coordinates.
    turns : tuple of float
        Period of each coordinate, ∞ if it is not an angle.
    stable : bool
        True for the stable manifold.
    side : int
        1 along the eigenvector whose component of largest modulus is positive, −1 against it.
    multiplier : float
        Multiplier on the manifold, > 1, of F: the map (its inverse if `stable`) over one period of the saddle, or over
        two if the multiplier of one is negative.
    points : ndarray, shape (n, 2)
        Polyline along the branch; angles continue without jumps.
    parameters : ndarray, shape (n,)
        Parameter τ of each point, increasing by 1 under F; −∞ at the saddle, which is the first point.
    lengths : ndarray, shape (n,)
        Length along the polyline from the saddle, in units of the coordinates.
    sagitta : float
        Requested bound on the distance between the curve and the polyline, in units of the coordinates.
    error_estimate : float
        Estimated error of the points across the curve, ≥ 0, in units of the coordinates; ∞ if unknown.
    end_reason : str
        Reason why the branch ends.
    level : str
        Name of the accuracy level.
    point_at : callable
        Function from a finite τ to the point (2,), with angles in any turn; it raises the errors of the map.
    """

    names: tuple[str, ...]
    turns: tuple[float, ...]
    stable: bool
    side: int
    multiplier: float
    points: Array
    parameters: Array
    lengths: Array
    sagitta: float
    error_estimate: float
    end_reason: str
    level: str
    point_at: Callable[[float], Array]

    @property
    def length(self) -> float:
        """Length of the branch, in units of the coordinates."""
        return float(self.lengths[-1])

    @property
    def status(self) -> Status:
        """OK if the error of the points is at most the sagitta, otherwise PROMISE_NOT_MET."""
        return Status.OK if self.error_estimate <= self.sagitta else Status.PROMISE_NOT_MET

    def labels(self) -> Labels:
        """Return the points and their parameters τ, labelled with the length along the curve.

        Returns
        -------
        Labels
            The coordinates and τ over the length.
        """
        return Labels(
            {"length": (("length",), self.lengths)},
            {
                **components(self.names, self.points, "length"),
                "τ": (("length",), self.parameters),
            },
            units_of(self.names),
            {
                "manifold": "stable" if self.stable else "unstable",
                "side": self.side,
                "multiplier": self.multiplier,
                "sagitta": self.sagitta,
                "error_estimate": self.error_estimate,
                "status": str(self.status),
                "ended": self.end_reason,
                "level": self.level,
            },
        )


@dataclass(frozen=True)
class _Curve:
    """The curve W: F is `returns` steps of the map; x_0 is `saddle`, δ v `away`, q `bend`, and λ of F `multiplier`."""

    map_: Map
    saddle: Array
    away: Array
    bend: Array
    multiplier: float
    returns: int
    first_error: float = 0.0
    """Error at the end of the first piece."""

    def point_at(self, tau: float) -> Array:
        count = max(0, math.floor(tau))
        return self.map_.iterate(self._point_near_saddle(self.multiplier ** (tau - count)), count * self.returns)

    def _point_near_saddle(self, sigma: float) -> Array:
        return np.asarray(self.saddle + sigma * self.away + sigma * sigma * self.bend)

    def third_order(self) -> float:
        """Return the distance of F(σ = 1/λ) from the point σ = 1 of the first piece: its third order, and round-off."""
        there = self.map_.iterate(self._point_near_saddle(1.0 / self.multiplier), self.returns)
        return float(np.linalg.norm(difference(self.map_.turns, there, self._point_near_saddle(1.0))))


def _begun(map_: Map, orbit: PeriodicOrbit, side: int, index: int) -> _Curve:
    """Return the curve with the longest first piece whose error is well below the promise of the map.

    Raises `InvalidParameter` if the orbit is not a saddle.
    """
    saddle = orbit.points[index % orbit.period]
    M, at = np.eye(2), saddle
    for _ in range(orbit.period):
        at, D = map_.with_derivative(at)
        M = D @ M
    values, vectors = np.linalg.eig(M)
    big = int(np.argmax(np.abs(values)))
    if values.imag.any() or not abs(values[big]) > 1.0 + 1e-6 or abs(values[1 - big]) >= 1.0:
        raise InvalidParameter(
            f"This orbit ({orbit.kind}) has no stable and unstable curves: choose a saddle, with one multiplier inside "
            "and one outside the unit circle."
        )
    value, returns = float(values[big].real), orbit.period
    v = np.asarray(vectors[:, big].real, float)
    v = v * math.copysign(1.0 / math.hypot(*v), v[np.argmax(np.abs(v))])
    if value < 0.0:
        M, value, returns = M @ M, value * value, 2 * returns
    size, error = _CURVED, math.inf
    q: Array = np.zeros(2)
    try:
        both = [difference(map_.turns, map_.iterate(saddle + sign * size * v, returns), saddle) for sign in (1.0, -1.0)]
        q = np.asarray(np.linalg.solve(value * value * np.eye(2) - M, 0.5 * (both[0] + both[1])) / size**2, float)
    except ModelError:
        # Close to the edge of the section the manifold starts as a straight line.
        pass
    curve = _Curve(map_, saddle, side * _SIZES[0] * v, _SIZES[0] ** 2 * q, value, returns)
    third = math.inf
    for size in _SIZES:
        curve = replace(curve, away=side * size * v, bend=size * size * q)
        try:
            # Use the smallest coefficient: closer to the saddle, round-off exceeds the third order.
            third = min(third, curve.third_order() / size**3)
        except ModelError:
            continue
        # The first piece ends at σ = λ.
        error = third * (size * value) ** 3
        if error <= 0.1 * map_.promise:
            break
    return replace(curve, first_error=error if math.isfinite(third) else math.inf)


def manifold(
    map_: Map,
    saddle: PeriodicOrbit,
    length: float,
    *,
    stable: bool = False,
    side: int = 1,
    index: int = 0,
    sagitta: float = 1e-3,
    longest: float = 0.1,
    most: int = 4000,
    returns: int = MAX_RETURNS,
) -> Manifold:
    """Return one branch of the stable or unstable manifold of a saddle, up to a given length.

    Parameters
    ----------
    map_ : ReturnMap or Map
        Return map of a section with two coordinates, or another map of a plane.
    saddle : PeriodicOrbit
        A saddle of this map.
    length : float
        Length along the curve at which the branch ends, positive, in units of the coordinates.
    stable : bool, default False
        Return the stable manifold instead of the unstable one.
    side : {1, -1}, default 1
        Leave the saddle along the eigenvector whose component of largest modulus is positive (1), or against it (−1).
    index : int, default 0
        Index of the point of the saddle from which the branch starts, modulo its period.
    sagitta : float, default 1e-3
        Largest distance between the curve and the returned polyline, positive, in units of the coordinates.
    longest : float, default 0.1
        Longest chord of the polyline, positive, in units of the coordinates.
    most : int, default 4000
        Number of points after which the branch ends.
    returns : int, default 2 000 000
        Number of evaluations of the map after which the branch ends.

    Returns
    -------
    Manifold
        The branch, as a polyline; it may end before `length`, see `Manifold.end_reason`.

    Raises
    ------
    InvalidParameter
        If the orbit is not a saddle, a number is out of range, or the map does not have two coordinates.
    ModelError
        If the map, or its inverse for `stable`, has no image at a point of the saddle.

    Examples
    --------
    >>> from hess_mechanics import HeavyBody, manifold, periodic_orbit, return_map
    >>> P = return_map(HeavyBody.hess((1.0, 1.6, 4.0), 1.0), h=1.5, f=-0.76)
    >>> saddle = periodic_orbit(P, (-2.84, 0.288), 1)
    >>> manifold(P, saddle, 0.5).length >= 0.5
    True
    """
    if not (math.isfinite(length) and length > 0.0 and sagitta > 0.0 and longest > 0.0):
        raise InvalidParameter(
            f"length = {length}, sagitta = {sagitta}, longest = {longest}: choose positive numbers and a finite length."
        )
    if side not in (-1, 1):
        raise InvalidParameter(f"side = {side}: choose 1 (along the eigenvector of the saddle) or −1 (against it).")
    if len(getattr(map_, "turns", ())) != 2:
        raise InvalidParameter("This map does not have two coordinates: give the return map of a section that has two.")
    forwards = map_.inverse() if stable else map_
    curve = _begun(forwards, saddle, side, index)
    points, parameters, ended = _followed(curve, length, sagitta, longest, most, returns)
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    return Manifold(
        map_.names,
        map_.turns,
        stable,
        side,
        curve.multiplier,
        as_read_only(points),
        as_read_only(parameters),
        as_read_only(lengths),
        sagitta,
        _error(curve, points, parameters),
        ended,
        map_.level,
        curve.point_at,
    )


def _followed(
    curve: _Curve, length: float, sagitta: float, longest: float, most: int, returns: int
) -> tuple[Array, Array, str]:
    """Return points and parameters with adaptive density, from the saddle to the length, and why the curve ends."""
    turns = curve.map_.turns
    points, parameters = [curve.saddle.copy(), curve.point_at(0.0)], [-math.inf, 0.0]
    total = float(np.linalg.norm(curve.away))
    # Right ends of the unfinished pieces, with the nearest one last.
    waiting: list[tuple[float, Array]] = []
    ahead, before, spent = 0.0, 0.0, 0
    ended = "At its length."
    while total < length:
        check_limit()
        if spent > returns:
            ended = f"After {returns} returns of the map."
            break
        if len(points) >= most:
            ended = f"After {most} points."
            break
        tau, here = parameters[-1], points[-1]
        try:
            if not waiting:
                if tau >= 1.0 and tau % 1.0 == 0.0:
                    if total - before < _STANDS * sagitta and total > 10.0 * sagitta:
                        where = ", ".join(f"{x:.9g}" for x in here)
                        ended = f"It comes to a point, ({where})."
                        break
                    before = total
                ahead += 1.0 / _FIRST
                waiting.append((ahead, here + difference(turns, curve.point_at(ahead), here)))
            right, there = waiting[-1]
            middle = curve.point_at(0.5 * (tau + right))
            spent += max(1, math.floor(right)) * curve.returns
        except ModelError as error:
            ended = f"At the length {total:.6g}; the map fails beyond it: {error}"
            break
        middle = here + difference(turns, middle, here)
        there = middle + difference(turns, there, middle)
        chord = there - here
        size = float(np.linalg.norm(chord))
        off = float(np.linalg.norm(middle - 0.5 * (here + there)))
        across = abs(_cross(chord, middle - here)) / max(size, 1e-300)
        # A middle point far from the middle of the chord, though on its line, may hide a fold.
        if (across > sagitta or size > longest or off > 0.35 * size) and right - tau > 1e-12 * max(1.0, tau):
            waiting.append((0.5 * (tau + right), middle))
            continue
        # The map is discontinuous here, so the branch ends.  Drop the points within a sagitta of the jump, because the
        # error of the map shifts the jump along the branch.
        if size > longest:
            while len(points) > 2 and float(np.linalg.norm(points[-2] - here)) < sagitta:
                points.pop()
                parameters.pop()
            ended = f"At the length {total:.6g} the map jumps: an orbit touches the plane of the section."
            break
        waiting.pop()
        # Keep the middle point, which is already computed: it reduces the sagitta by a factor of four.
        for parameter, point in ((0.5 * (tau + right), middle), (right, there)):
            total += float(np.linalg.norm(point - points[-1]))
            points.append(point)
            parameters.append(parameter)
            if total >= length:
                break
    return np.array(points), np.array(parameters), ended


def _cross(u: Array, v: Array) -> Array:
    """Return the signed area u₁v₂ − u₂v₁ of vectors (2,) or (2, n)."""
    return np.asarray(u[0] * v[1] - u[1] * v[0])


def _error(curve: _Curve, points: Array, parameters: Array) -> float:
    """Return the largest distance, across the curve, of sampled points from those of a more accurate map."""
    better = replace(curve, map_=curve.map_.tighter())
    off, last = -math.inf, len(points) - 1
    for i in np.unique(np.linspace(1, max(1, last - 1), _CHECKED).astype(int)):
        try:
            there = better.point_at(float(parameters[i]))
        except ModelError:
            continue
        along = points[min(i + 1, last)] - points[max(i - 1, 0)]
        along = along / max(float(np.linalg.norm(along)), 1e-300)
        away = difference(curve.map_.turns, there, points[i])
        off = max(off, abs(float(_cross(away, along))))
    # The error is unknown, hence infinite, if no point could be compared.
    return SAFETY * off + curve.first_error + 4e-16 if off >= 0.0 else math.inf


# ---- intersections ---------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Intersection:
    """Intersection of the manifolds of one or two saddles: a homoclinic or heteroclinic point.

    Attributes
    ----------
    point : ndarray, shape (2,)
        The point.
    parameters : (float, float)
        Parameter τ of the point on each manifold.
    angle : float
        Angle between the manifolds, in radians, 0 to π/2.
    error : float
        Estimated error of the point, ≥ 0, in units of the coordinates.
    is_certain : bool
        True if the manifolds change sides between one chord before and one chord after the crossing, by more than their
        errors; False where they run together.
    """

    point: Array
    parameters: tuple[float, float]
    angle: float
    error: float
    is_certain: bool


def crossings_of(one: Manifold, other: Manifold, most: int = 100) -> list[Intersection]:
    """Return the intersections of two manifolds, in their order along the first one.

    Intersecting segments of the two polylines are the initial guesses for Newton's method on W_1(τ_1) = W_2(τ_2).  The
    saddles themselves are excluded; points closer together than their errors count once.

    Parameters
    ----------
    one, other : Manifold
        The manifolds, of the same map.
    most : int, default 100
        Largest number of points.

    Returns
    -------
    list of Intersection
        The homoclinic or heteroclinic points; empty if the polylines do not intersect.
    """
    crossings: list[Intersection] = []
    for i, j in _meeting(one, other):
        crossing = _refined(one, other, (i, j))
        if crossing is not None and all(
            np.abs(difference(one.turns, crossing.point, known.point)).max() > 1e-9 + crossing.error + known.error
            for known in crossings
        ):
            crossings.append(crossing)
            if len(crossings) == most:
                break
    return crossings


def _meeting(one: Manifold, other: Manifold) -> list[tuple[int, int]]:
    """Return the indices of the pairs of segments that intersect, except the first segments at the saddles."""
    a, b = one.points[1:], other.points[1:]
    pairs = []
    da, db = np.diff(a, axis=0), np.diff(b, axis=0)
    for i in range(len(da)):
        start = difference(one.turns, b[:-1], a[i])
        with np.errstate(divide="ignore", invalid="ignore"):
            s, t = (_cross(start.T, along) / _cross(da[i], db.T) for along in (db.T, da[i]))
        pairs += [(i + 1, int(j) + 1) for j in np.flatnonzero((s >= 0.0) & (s < 1.0) & (t >= 0.0) & (t < 1.0))]
    return pairs


def _refined(one: Manifold, other: Manifold, pair: tuple[int, int]) -> Intersection | None:
    """Return the intersection near a pair of segments, by Newton's method; None if it fails or moves away from them."""
    ends = [np.array(curve.parameters[i : i + 2]) for curve, i in zip((one, other), pair, strict=True)]
    tau: Array = np.array([float(end.mean()) for end in ends])
    h = np.array([1e-4 * float(np.ptp(end)) for end in ends])
    slopes = np.zeros((2, 2))
    step = np.zeros(2)
    try:
        for iteration in range(20):
            check_limit()
            # After two steps the slopes are accurate to a percent, and reusing them saves points.
            for k, (curve, sign) in enumerate(((one, 1.0), (other, -1.0)) if iteration < 2 else ()):
                both = [curve.point_at(tau[k] + side * h[k]) for side in (1.0, -1.0)]
                slopes[:, k] = sign * difference(one.turns, *both) / (2.0 * h[k])
            left = difference(one.turns, one.point_at(tau[0]), other.point_at(tau[1]))
            step = np.asarray(-np.linalg.solve(slopes, left), float)
            room = np.array([float(np.ptp(end)) for end in ends])
            tau = np.asarray(tau + np.clip(step, -room, room), float)
            if np.abs(slopes * step).max() < 1e-13:
                break
        point = one.point_at(tau[0])
        left = difference(one.turns, point, other.point_at(tau[1]))
    except (ModelError, np.linalg.LinAlgError):
        return None
    if any(not end[0] - np.ptp(end) <= value <= end[1] + np.ptp(end) for value, end in zip(tau, ends, strict=True)):
        return None
    u, v = (slopes[:, k] / np.linalg.norm(slopes[:, k]) for k in (0, 1))
    angle = math.atan2(abs(float(_cross(u, v))), abs(float(u @ v)))
    off = (one.error_estimate + other.error_estimate + float(np.abs(left).max())) / max(math.sin(angle), 1e-6)
    return Intersection(
        as_read_only(point),
        (float(tau[0]), float(tau[1])),
        angle,
        off,
        _changes_sides(one, other, tau, float(np.ptp(ends[0])), -slopes[:, 1]),
    )


def _changes_sides(one: Manifold, other: Manifold, tau: Array, chord: float, along: Array) -> bool:
    """Return True if the first curve crosses the second: one chord before and after, it lies on opposite sides.

    Both distances must exceed the errors of the curves; False if one of them cannot be computed.
    """
    speed = float(np.linalg.norm(along))
    u = along / speed
    gaps = []
    for side in (-1.0, 1.0):
        try:
            point, t = one.point_at(tau[0] + side * chord), float(tau[1])
            for _ in range(_FEET):
                away = difference(one.turns, point, other.point_at(t))
                # An error along the curve changes the distance across it only in second order.
                if abs(float(away @ u)) <= 1e-3 * float(np.linalg.norm(away)):
                    break
                t += float(away @ u) / speed
            else:
                return False
        except ModelError:
            return False
        gaps.append(float(_cross(u, away)))
    return gaps[0] * gaps[1] < 0.0 and min(map(abs, gaps)) > one.error_estimate + other.error_estimate


def heights_at(curve: Manifold, axis: int, value: float) -> Array:
    """Return the other coordinate at all points of a manifold where one coordinate has a given value.

    Parameters
    ----------
    curve : Manifold
        The manifold.
    axis : int
        Index of the coordinate that has the value, 0 or 1.
    value : float
        The value; angles are unwrapped, as in `Manifold.points`.

    Returns
    -------
    ndarray, shape (n,)
        Values of the other coordinate, in the order of the manifold.

    Raises
    ------
    NotConverged
        If the manifold does not reach the value.
    """
    along = curve.points[:, axis] - value
    change = np.flatnonzero((along[1:-1] <= 0.0) != (along[2:] <= 0.0)) + 1
    if not change.size:
        raise NotConverged(
            f"This manifold does not reach {curve.names[axis]} = {value:g}: choose a greater length, or another value."
        )
    return np.array([_height_on(curve, axis, value, int(i)) for i in change])


def _height_on(curve: Manifold, axis: int, value: float, i: int) -> float:
    """Return the other coordinate where the segment i of a manifold has the value."""
    from scipy.optimize import brentq  # Imported here because the import takes 0.3 s.

    reference = curve.points[i]

    def away(tau: float) -> Array:
        return difference(curve.turns, curve.point_at(tau), reference)

    tau = brentq(lambda tau: reference[axis] + away(tau)[axis] - value, *curve.parameters[i : i + 2], xtol=1e-14)
    return float((reference + away(tau))[1 - axis])


def split(unstable: Manifold, stable: Manifold, axis: int, value: float) -> tuple[float, float]:
    """Return the signed distance between two manifolds where one coordinate has a given value.

    If they have this value at several points, the two closest points are compared.

    Parameters
    ----------
    unstable, stable : Manifold
        The manifolds, of the same map.
    axis : int
        Index of the coordinate that has the value, 0 or 1.
    value : float
        The value.

    Returns
    -------
    distance : float
        Other coordinate of the unstable manifold minus that of the stable one; full turns of an angle are not removed.
    error : float
        Its estimated error, ≥ 0: the sum of the errors of both manifolds across their curves.

    Raises
    ------
    NotConverged
        If one of the manifolds does not reach the value.
    """
    gaps = heights_at(unstable, axis, value)[:, None] - heights_at(stable, axis, value)
    closest = gaps.ravel()[int(np.argmin(np.abs(gaps)))]
    return float(closest), unstable.error_estimate + stable.error_estimate
