"""Periodic orbits of maps of a line or a plane, by Newton's method, with multipliers, types and errors.

All m points of an orbit of period m are unknowns, x_(i+1) = P(x_i) (multiple shooting), so that errors are not
amplified from one point to the next.  With the Jacobian J of these equations, the error is J⁻¹ times their residual for
a more accurate map.  The multipliers are the eigenvalues of M = DP(x_(m−1)) … DP(x_0).
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from hess_mechanics.errors import InvalidParameter, ModelError, NotConverged
from hess_mechanics.numerics.accuracy import Status
from hess_mechanics.numerics.labelled import Labels, Result, components
from hess_mechanics.numerics.measured import SAFETY
from hess_mechanics.numerics.patience import check_limit
from hess_mechanics.numerics.results import Array, Complex, as_read_only

__all__ = [
    "MAX_PERIOD",
    "Map",
    "PeriodicOrbit",
    "Shot",
    "difference",
    "find_periodic",
    "images_of",
    "kind_of",
    "multipliers_of",
    "shoot",
    "units_of",
]

MAX_PERIOD = 64
_ITERATIONS = 40
_TRIED = 6
"""Largest number of guesses besides the start: those from which the orbit comes back closest."""
_FOLLOWED = 8
"""Number of periods for which an orbit is followed to find where it comes back closest."""
_FAR = 1e6
_ROUNDING = 2.3e-16
_DIFFERENCES = 5e-12
"""Error of the derivatives of sections, which come partly from differences, even if two runs agree."""
_FAMILY = 1e-9
"""Relative singular values of J below this are directions in which periodic orbits form a family."""


class Map(Protocol):
    """A map of a line (d = 1) or plane (d = 2) to itself; it raises a `ModelError` at points without an image."""

    @property
    def turns(self) -> tuple[float, ...]:
        """Period of each coordinate, ∞ if it is not an angle."""

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the coordinates."""

    @property
    def promise(self) -> float:
        """Largest error that a result may have."""

    @property
    def level(self) -> str:
        """Name of the accuracy level."""

    @property
    def is_floor(self) -> bool:
        """True if the map cannot be computed more accurately."""

    def image(self, point: Array) -> Array:
        """Return P(x) at one point or several.

        Parameters
        ----------
        point : ndarray, shape (d,) or (m, d)
            The points.

        Returns
        -------
        ndarray, shape (d,) or (m, d)
            Their images.
        """

    def iterate(self, point: Array, count: int) -> Array:
        """Return the images after several iterations.

        Parameters
        ----------
        point : ndarray, shape (d,) or (m, d)
            The points.
        count : int
            Number of iterations.

        Returns
        -------
        ndarray, shape (d,) or (m, d)
            The images P^count(x).
        """

    def with_derivative(self, point: Array) -> tuple[Array, Array]:
        """Return P(x) and its derivative at one point or several.

        Parameters
        ----------
        point : ndarray, shape (d,) or (m, d)
            The points.

        Returns
        -------
        image : ndarray, shape (d,) or (m, d)
            The images P(x).
        derivative : ndarray, shape (d, d) or (m, d, d)
            The derivatives DP(x).
        """

    def inverse(self) -> Map:
        """Return the inverse map P⁻¹.

        Returns
        -------
        Map
            The inverse.
        """

    def symmetries_of(self, points: Array, near: float) -> Sequence[str]:
        """Return the symmetries of the map that take an orbit to itself.

        Parameters
        ----------
        points : ndarray, shape (m, d)
            Points of the orbit.
        near : float
            Distance within which two points count as equal.

        Returns
        -------
        sequence of str
            Names of the symmetries.
        """

    def tighter(self) -> Map:
        """Return the same map, computed more accurately and with other roundings.

        Returns
        -------
        Map
            The more accurate map.
        """


def units_of(names: Sequence[str]) -> dict[str, str]:
    """Return the units of the coordinates of a section; other coordinates, such as canonical ones, are left out.

    Parameters
    ----------
    names : sequence of str
        Names of the coordinates.

    Returns
    -------
    dict of str to str
        Units by the names of the coordinates: "rad", or "1" for L/G.
    """
    units = {"l": "rad", "L/G": "1", "ψ": "rad", "δ": "rad", "φ": "rad"}
    return {name: units[name] for name in names if name in units}


def difference(turns: Sequence[float], a: Array, b: Array) -> Array:
    """Return the difference a − b, with differences of angles reduced to at most half a turn either way.

    Parameters
    ----------
    turns : sequence of float
        Period of each coordinate, ∞ if it is not an angle.
    a, b : ndarray, shape (..., d)
        Points; their shapes are broadcast.

    Returns
    -------
    ndarray, shape (..., d)
        The differences.
    """
    result: Array = np.asarray(a, float) - np.asarray(b, float)
    for i, turn in enumerate(turns):
        if math.isfinite(turn):
            result[..., i] -= turn * np.round(result[..., i] / turn)
    return result


@dataclass(frozen=True)
class Shot:
    """Equations of multiple shooting for a periodic orbit.

    Attributes
    ----------
    points : ndarray, shape (m, d)
        Points x_i.
    residuals : ndarray, shape (m, d)
        Residuals P(x_i) − x_(i+1).
    derivatives : ndarray, shape (m, d, d)
        Derivatives DP(x_i).
    """

    points: Array
    residuals: Array
    derivatives: Array

    @property
    def jacobian(self) -> Array:
        """Jacobian J of the residuals, shape (m d, m d)."""
        m, d = self.points.shape
        J = np.zeros((m, d, m, d))
        for i in range(m):
            J[i, :, i, :] += self.derivatives[i]
            J[i, :, (i + 1) % m, :] -= np.eye(d)
        return np.asarray(J.reshape(m * d, m * d))

    def step(self, family: float = _FAMILY) -> Array:
        """Return Newton's step; if the Jacobian is singular, the shortest least-squares step.

        Parameters
        ----------
        family : float, default 1e-9
            Singular values count as 0 up to this fraction of the largest one, or of 1 if that is larger.

        Returns
        -------
        ndarray, shape (m, d)
            The step −J⁻¹ times the residuals, with the pseudoinverse if J is singular.
        """
        u, values, v = np.linalg.svd(self.jacobian)
        nonzero = values > family * max(1.0, float(values[0]))
        solution = -(v[nonzero].T / values[nonzero]) @ (u.T[nonzero] @ self.residuals.ravel())
        return np.asarray(solution.reshape(self.points.shape))

    @property
    def size(self) -> float:
        """Largest absolute value of a residual."""
        return float(np.abs(self.residuals).max())


def shoot(map_: Map, points: Array) -> Shot:
    """Return the equations of multiple shooting at given points.

    Parameters
    ----------
    map_ : Map
        The map.
    points : ndarray, shape (m, d)
        The points.

    Returns
    -------
    Shot
        Residuals and derivatives.

    Raises
    ------
    ModelError
        If the map has no image at a point.
    """
    images, derivatives = map_.with_derivative(points)
    return Shot(points, difference(map_.turns, images, np.roll(points, -1, axis=0)), derivatives)


def multipliers_of(derivatives: Array) -> tuple[Complex, float, float]:
    """Return the multipliers of a periodic orbit, and the trace and determinant of its matrix M.

    M is the product of the derivatives.  Its smaller eigenvalue is computed from the product of their determinants,
    because M itself loses its digits if the other one is large.

    Parameters
    ----------
    derivatives : ndarray, shape (m, d, d)
        Derivatives along the orbit, d = 1 or 2.

    Returns
    -------
    multipliers : ndarray of complex, shape (d,)
        Eigenvalues of M, the largest first.
    trace : float
        Trace of M.
    determinant : float
        Determinant of M.
    """
    M = np.eye(derivatives.shape[1])
    for one in derivatives:
        M = one @ M
    trace, determinant = float(np.trace(M)), float(np.prod(np.linalg.det(derivatives)))
    return _eigenvalues(M.shape[0], trace, determinant), trace, determinant


def _eigenvalues(d: int, trace: float, determinant: float) -> Complex:
    if d == 1:
        return np.array([trace], complex)
    half = 0.5 * trace
    discriminant = half * half - determinant
    if discriminant < 0.0:
        root = math.sqrt(-discriminant)
        return np.array([complex(half, root), complex(half, -root)])
    large = half + math.copysign(math.sqrt(discriminant), half)
    return np.array([large, determinant / large if large else 0.0], complex)


def _multiplier_error(derivatives: Array, better: Array) -> float:
    """Return the error of the multipliers, from trace and determinant of a better run and from round-off."""
    values, trace, determinant = multipliers_of(derivatives)
    _, other_trace, other_determinant = multipliers_of(better)
    product = float(np.prod(np.linalg.norm(derivatives, axis=(1, 2))))
    rounding = _DIFFERENCES * len(derivatives)
    off_trace = SAFETY * abs(trace - other_trace) + rounding * max(1.0, product)
    off_determinant = SAFETY * abs(determinant - other_determinant) + rounding * abs(determinant)
    worst = 0.0
    for a in (-off_trace, off_trace):
        for b in (-off_determinant, off_determinant):
            worst = max(worst, float(np.abs(_eigenvalues(values.size, trace + a, determinant + b) - values).max()))
    return worst


def kind_of(multipliers: Complex, error: float) -> str:
    """Return the type of an orbit from its multipliers.

    Parameters
    ----------
    multipliers : ndarray of complex, shape (d,)
        The multipliers, the largest first.
    error : float
        Their error, ≥ 0; a multiplier this close to the border between two types counts as on it.

    Returns
    -------
    str
        The type, see `PeriodicOrbit`.
    """
    sizes = np.abs(multipliers)
    if np.any(np.abs(multipliers - 1.0) <= error):
        return "parabolic"
    if np.any(np.abs(multipliers + 1.0) <= error):
        return "parabolic with reflection"
    if multipliers[0].imag:
        if abs(sizes[0] - 1.0) <= error:
            return "elliptic"
        return "stable focus" if sizes[0] < 1.0 else "unstable focus"
    if np.all(sizes < 1.0):
        return "stable node"
    if np.all(sizes > 1.0):
        return "unstable node"
    return "saddle" if multipliers[0].real > 0.0 else "saddle with reflection"


@dataclass(frozen=True)
class PeriodicOrbit(Result):
    """A periodic orbit of a map.

    Attributes
    ----------
    names : tuple of str
        Names of the coordinates.
    points : ndarray, shape (m, d)
        Points of the orbit in order, where m is the least period.
    multipliers : ndarray of complex, shape (d,)
        Multipliers, the one of largest modulus first.
    kind : str
        "saddle", "saddle with reflection" (negative unstable multiplier), "stable node", "unstable node", "stable
        focus", "unstable focus", "elliptic", "parabolic" (multiplier 1: a fold or a family) or "parabolic with
        reflection" (−1).
    error_estimate : float
        Estimated error of the points, ≥ 0, in units of the coordinates.
    multiplier_error : float
        Estimated error of the multipliers, ≥ 0.
    condition : float
        Condition number of the Jacobian of Newton's equations, without its zero singular values.
    iterations : int
        Iterations of Newton's method.
    level : str
        Name of the accuracy level.
    status : Status
        How the computation ended.
    symmetric : tuple of str
        Names of the symmetries of the map that take the orbit to itself; empty also where they were not computed, as by
        `find_periodic`.
    time : float
        Time of one period, positive, in units T; NaN if the map does not know it.
    time_error : float
        Estimated error of this time, ≥ 0, in units T; NaN if the time is.
    """

    names: tuple[str, ...]
    points: Array
    multipliers: Complex
    kind: str
    error_estimate: float
    multiplier_error: float
    condition: float
    iterations: int
    level: str
    status: Status
    symmetric: tuple[str, ...] = ()
    time: float = math.nan
    time_error: float = math.nan

    @property
    def period(self) -> int:
        """Number of returns after which the orbit closes."""
        return len(self.points)

    def labels(self) -> Labels:
        """Return the points of the orbit, labelled with the number of the return, and its properties.

        Returns
        -------
        Labels
            The coordinates over the returns, with type, multipliers, time and errors.
        """
        multipliers = {f"multiplier {i + 1}": _shown(complex(one)) for i, one in enumerate(self.multipliers)}
        return Labels(
            {"return": (("return",), np.arange(self.period))},
            components(self.names, self.points, "return"),
            units_of(self.names),
            {
                "period": self.period,
                "time": self.time,
                "time_error": self.time_error,
                "kind": self.kind,
                **multipliers,
                "multiplier_error": self.multiplier_error,
                "error_estimate": self.error_estimate,
                "condition": self.condition,
                "iterations": self.iterations,
                "symmetric": ", ".join(self.symmetric),
                "level": self.level,
                "status": str(self.status),
            },
        )


def _shown(value: complex) -> float | str:
    return value.real if value.imag == 0.0 else f"{value.real:.17g}{value.imag:+.17g}i"


def _converged(map_: Map, points: Array) -> tuple[Shot, int]:
    """Return the solution of Newton's method with damped steps from points (m, d).  Raises `NotConverged`."""
    try:
        shot = shoot(map_, points)
    except ModelError as error:
        raise NotConverged(f"Newton's method cannot start here: {error}") from error
    before = math.inf
    # If every point is periodic, J contains only the errors of the map.
    family = max(_FAMILY, map_.promise)
    for iteration in range(1, _ITERATIONS + 1):
        check_limit()
        step = shot.step(family)
        length = float(np.abs(step).max())
        # Close to the solution, steps shrink quadratically until the map's own round-off dominates.
        if length <= 1e-15 or (length <= map_.promise and length > 0.25 * before):
            return shot, iteration
        before = length
        share = min(1.0, 0.5 / length)
        while True:
            try:
                tried = shoot(map_, shot.points + share * step)
                if tried.size < shot.size or length <= map_.promise:
                    break
            except ModelError:
                pass
            share *= 0.5
            if share < 1e-4:
                raise _not_converged(len(points))
        shot = tried
        before = length if share == 1.0 else math.inf
    raise _not_converged(len(points))


def _not_converged(m: int) -> NotConverged:
    return NotConverged(
        f"Newton's method finds no orbit of period {m} from here: start closer to one, where an orbit "
        "comes back close to itself, or choose another period."
    )


def find_periodic(
    map_: Map, start: Sequence[float] | Array, period: int | None = None, most: int = 12, near: bool = False
) -> PeriodicOrbit:
    """Return the periodic orbit that Newton's method finds from a point (d,), or from all points (m, d) of an orbit.

    Parameters
    ----------
    map_ : Map
        The map.
    start : array_like, shape (d,) or (m, d)
        Initial guess.
    period : int, optional
        Least period, at least 1.  By default the periods up to `most` at which the orbit comes back closest are tried.
        Several points determine the period themselves: m or one of its divisors.
    most : int, default 12
        Largest period tried if `period` is not given.
    near : bool, default False
        Search only from the start itself, not from later points of its orbit that come back closer.  Without `period`,
        only the period at which the orbit comes back closest is tried.

    Returns
    -------
    PeriodicOrbit
        The orbit, with its least period and without its symmetries.

    Raises
    ------
    InvalidParameter
        If the start does not have finite coordinates of the right number.
    NotConverged
        If no orbit is found.
    ModelError
        If the more accurate map that measures the error has no image at a point of the orbit.
    """
    points = np.array(start, float, ndmin=2)
    if points.ndim != 2 or points.shape[1] != len(map_.turns) or not np.all(np.isfinite(points)):
        raise InvalidParameter(
            f"{start!s:.80} is not a point of the map: give {len(map_.turns)} finite numbers, {', '.join(map_.names)}."
        )
    if len(points) > 1:
        return _measured(map_, *_converged(map_, points))
    others: set[int] = set()
    for guess in _guesses(map_, points[0], period, most, near):
        try:
            orbit = _measured(map_, *_converged(map_, guess))
        except NotConverged:
            continue
        if period in (None, orbit.period):
            return orbit
        others.add(orbit.period)
    if period is None:
        raise NotConverged(
            f"Newton's method finds no periodic orbit up to period {most} from here: start closer to one, "
            "or give its period."
        )
    if others:
        raise NotConverged(
            f"From here Newton's method finds orbits of period {', '.join(map(str, sorted(others)))} "
            f"but none of period {period}: start closer to one, or choose another period."
        )
    raise _not_converged(period)


def _guesses(map_: Map, point: Array, period: int | None, most: int, near: bool) -> Iterator[Array]:
    """Yield the points (m, d) from which Newton's method starts, the best first, see `find_periodic`."""
    if period is None:
        orbit = images_of(map_, point, most)
        for back in np.argsort(_closeness(map_, orbit[1:], orbit[0]), kind="stable")[: 1 if near else _TRIED]:
            yield orbit[: back + 1]
        return
    orbit = images_of(map_, point, period - 1 if near else (_FOLLOWED + 1) * period)
    if len(orbit) < period:
        raise NotConverged(
            f"The number of returns from here is {len(orbit) - 1}, too few for an orbit of period {period}: start "
            "elsewhere, or choose a smaller period."
        )
    # Start from the point itself, and from the points whose images come back closest.
    later = np.argsort(_closeness(map_, orbit[period:], orbit[:-period]), kind="stable")
    for first in (0, *later[:_TRIED]):
        yield orbit[first : first + period]


def _closeness(map_: Map, a: Array, b: Array) -> Array:
    return np.asarray(np.abs(difference(map_.turns, a, b)).max(axis=1))


def images_of(map_: Map, point: Array, count: int) -> Array:
    """Return a point and its images, up to the first one that does not exist or has a coordinate beyond 1e6.

    Parameters
    ----------
    map_ : Map
        The map.
    point : ndarray, shape (d,)
        The point.
    count : int
        Largest number of images.

    Returns
    -------
    ndarray, shape (n, d)
        The point and its images, 1 ≤ n ≤ count + 1.

    Raises
    ------
    NotConverged
        If the map raises an error at the point itself.
    """
    orbit = [point]
    try:
        for _ in range(count):
            check_limit()
            orbit.append(map_.image(orbit[-1]))
            if not np.all(np.isfinite(orbit[-1])) or np.abs(orbit[-1]).max() > _FAR:
                return np.array(orbit[:-1])
    except ModelError as error:
        if len(orbit) == 1:
            raise NotConverged(f"No orbit can be started here: {error}") from error
    return np.array(orbit)


def _least_period(map_: Map, points: Array, error: float) -> int:
    """Return the least divisor of m after which the points (m, d) repeat."""
    m = len(points)
    near = max(1e3 * error, 1e-7)
    return next(
        k
        for k in range(1, m + 1)
        if m % k == 0 and np.abs(difference(map_.turns, points, np.roll(points, -k, axis=0))).max() <= near
    )


def _measured(map_: Map, shot: Shot, iterations: int) -> PeriodicOrbit:
    """Return the orbit with its error, measured with a more accurate map.

    If the error exceeds the promise, the more accurate map takes over.
    """
    current = map_
    shot = shoot(current, shot.points[: _least_period(current, shot.points, map_.promise)])
    while True:
        better = current.tighter()
        # The residuals of Newton's equations for the more accurate map estimate the error of the present map.
        there = shoot(better, shot.points)
        family = max(_FAMILY, current.promise)
        step = there.step(family)
        values = np.linalg.svd(there.jacobian, compute_uv=False)
        nonzero = values[values > family * max(1.0, float(values[0]))]
        condition = float(nonzero[0] / nonzero[-1]) if nonzero.size else 1.0
        size = max(1.0, float(np.abs(shot.points).max()))
        # Divide by the smallest singular value σ, not by the condition number: a unit residual moves the orbit by 1/σ.
        least = float(nonzero[-1]) if nonzero.size else 1.0
        error = SAFETY * float(np.abs(step).max()) + 4.0 * _ROUNDING * size / least
        if nonzero.size < values.size:
            # Within a family of periodic orbits no point is distinguished, so only the residual is known.
            error = max(error, SAFETY * there.size)
        if error <= map_.promise or current.is_floor:
            break
        current, shot = better, shoot(better, shot.points + step)
    moved = shoot(better, shot.points + step)
    off = _multiplier_error(shot.derivatives, moved.derivatives)
    multipliers = multipliers_of(shot.derivatives)[0]
    points = shot.points.copy()
    for i, turn in enumerate(map_.turns):
        if math.isfinite(turn):
            points[:, i] -= turn * np.ceil(points[:, i] / turn - 0.5)
    # Compare the period with that of the orbit of the more accurate map.
    time, other = (
        abs(one.time_of(at)) if hasattr(one, "time_of") else math.nan
        for one, at in ((current, shot.points), (better, moved.points))
    )
    status = Status.OK if error <= map_.promise else Status.FLOOR if map_.is_floor else Status.PROMISE_NOT_MET
    return PeriodicOrbit(
        map_.names,
        as_read_only(points),
        as_read_only(multipliers),
        kind_of(multipliers, off),
        error,
        off,
        condition,
        iterations,
        map_.level,
        status,
        time=time,
        time_error=SAFETY * abs(time - other) + 4.0 * _ROUNDING * time,
    )
