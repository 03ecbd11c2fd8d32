"""Mode locking of the circle map: the rotation number over (h, f), and the boundary |t| = 2 of the lock zone.

A Möbius map locks at integers only, and here at 0 only (section 2 of proofs.md).  The lock zone ends on the
bifurcation curve (`Geq3`) at h* = (1−2a²)/(2a√(1+a²)) and at the point (1, 0).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence

import numpy as np

from hess_mechanics.dynamics.cells import centres
from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.numerics.accuracy import Accuracy, Level
from hess_mechanics.numerics.arguments import as_level, as_whole
from hess_mechanics.numerics.parallel import share
from hess_mechanics.numerics.results import Array, frozen
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov_hess.bifurcation import f_max_each, turning_points
from hess_mechanics.suslov_hess.circle_map import check_a, matrices, rotation_numbers_of

__all__ = [
    "CELLS",
    "affordable_cells",
    "critical_a",
    "lock_boundary",
    "lock_boundary_end",
    "lock_boundary_f",
    "rotation_number_grid",
    "rotation_number_window",
    "trace_on_curve",
]


_MAX_A_OF_BOUNDARY = 1e5


def _locked(h: Array, f: Array, a: float, level: Level) -> Array:
    """Return (Im β² − Im α²)/(Im β² + Im α²): positive where the map is locked, 0 where |t| = 2, bounded and smooth."""
    _, im, im_beta, *_ = matrices(h, f, a, level).T
    locked: Array = (im_beta - im) * (im_beta + im) / (im_beta**2 + im**2)
    return locked


def _rising_roots(function: Callable[[Array], Array], low: Array, high: Array) -> Array:
    """Return the roots at which the components of `function` increase, by the Illinois variant of regula falsi."""
    f_low, f_high = function(low), function(high)
    side = np.zeros(low.size)
    x = low
    for _ in range(80):
        x = high - f_high * (high - low) / (f_high - f_low)
        f_x = function(x)
        if np.all(np.abs(f_x) < 1e-13):
            break
        up = f_x > 0.0
        f_low = np.where(up & (side > 0), 0.5 * f_low, f_low)
        f_high = np.where(~up & (side < 0), 0.5 * f_high, f_high)
        high, f_high = np.where(up, x, high), np.where(up, f_x, f_high)
        low, f_low = np.where(up, low, x), np.where(up, f_low, f_x)
        side = np.where(up, 1.0, -1.0)
    return x


def rotation_number_grid(a: float, h: Sequence[float] | Array, f: Sequence[float] | Array, accuracy: Accuracy) -> Array:
    """Return the rotation number ρ on a grid of (h, f).

    Parameters
    ----------
    a : float
        The coupling a = I23/I22.
    h : array_like of float, shape (m,)
        Energies, −1 < h ≤ 1e12, in units b = 1.
    f : array_like of float, shape (n,)
        Values of the area integral, in units b = 1.
    accuracy : Level or str
        Accuracy level or its name, see `accuracy`.

    Returns
    -------
    ndarray of float, shape (n, m)
        Values ρ in turns per return, read-only; NaN where there is no torus, |f| > f_max(h).

    Raises
    ------
    InvalidParameter
        If a value is not finite, or a or h out of range.
    WorkLimit
        If the grid has more than a million points, or a torus needs too many steps.

    Notes
    -----
    `np.isfinite` of the result is the mask of the region.  The separatrix (1, 0) has no return: its value is the limit
    f → 0 at h = 1.  ρ is odd in f, so only |f| is computed.  Two threads share the points.

    References
    ----------
    `eq0003`.

    Examples
    --------
    >>> from hess_mechanics import rotation_number_grid
    >>> rotation_number_grid(0.5, [0.0, 1.5], [0.2, 0.6], "standard").round(4)
    array([[-0.4427,  0.    ],
           [-0.3426,  0.    ]])
    """
    level = as_level(accuracy)
    hs, fs = np.asarray(h, float), np.asarray(f, float)
    filled = _filled_grid(a, hs, fs, level)
    return frozen(np.where(np.abs(fs)[:, None] <= f_max_each(hs), filled, np.nan))


def _filled_grid(a: float, hs: Array, fs: Array, level: Level) -> Array:
    """Return `rotation_number_grid`, with the value at the edge of the region (same h) outside it."""
    check_a(a)
    if hs.ndim != 1 or fs.ndim != 1 or hs.size * fs.size > 1_000_000:
        raise WorkLimit("A grid has at most a million points on two axes: choose fewer.")
    if not (np.all(np.isfinite(hs)) and np.all(np.isfinite(fs)) and np.all(hs > -1.0) and np.all(hs <= 1e12)):
        raise InvalidParameter("The grid needs finite values, and −1 < h ≤ 1e12.")
    # f and −f may differ in the last digits of an axis built by repeated addition.
    mantissas, exponents = np.frexp(np.abs(fs))
    magnitudes, back = np.unique(np.ldexp(np.round(mantissas, 13), exponents), return_inverse=True)
    H, F = (x.ravel() for x in np.meshgrid(hs, magnitudes))
    F = np.minimum(F, f_max_each(H))
    F[(F == 0.0) & (H == 1.0)] = 1e-12
    out = np.empty(H.size)

    # Near the separatrix the motion is slow and the saddle magnifies errors.
    near = np.abs(H - 1.0) + F < 1e-3
    exact = level.tightened().tightened()

    def part(i: int) -> None:
        # Every second point, so that both threads get equally many slow points.
        own = np.arange(H.size) % 2 == i
        for points, chosen in ((own & ~near, level), (own & near, exact)):
            if points.any():
                out[points] = rotation_numbers_of(matrices(H[points], F[points], a, chosen))

    share(part, 2)
    signed: Array = np.where(fs < 0, -1.0, 1.0)[:, None] * out.reshape(magnitudes.size, hs.size)[back]
    return signed


def trace_on_curve(a: float, n: float) -> float:
    """Return the trace |t| on the bifurcation curve at n3 = n.

    Parameters
    ----------
    a : float
        The coupling a = I23/I22, |a| ≤ 1e6.
    n : float
        The constant value of n3 on the curve.

    Returns
    -------
    float
        2 cos(π√(n²(1+a²)−a²)/√(1+3n²)), with cosh for an imaginary root; ∞ beyond the range of doubles.

    Raises
    ------
    InvalidParameter
        If a or n is not finite, or |a| is too large.

    References
    ----------
    `Geq3`.  The limit of the trace is not in the paper, see models/README.md.

    Examples
    --------
    >>> from hess_mechanics import trace_on_curve
    >>> round(trace_on_curve(0.5, 0.5), 6)
    1.657747
    """
    check_a(a)
    require_finite(n=n)
    radicand = n * n * (1 + a * a) - a * a
    argument = math.pi * math.sqrt(abs(radicand)) / math.sqrt(1 + 3 * n * n)
    if radicand >= 0:
        return 2.0 * math.cos(argument)
    return 2.0 * math.cosh(argument) if argument < 709.0 else math.inf


def lock_boundary_end(a: float) -> float:
    """Return h* = (1−2a²)/(2|a|√(1+a²)), the end of the lock boundary on the bifurcation curve; ∞ for a = 0."""
    a = abs(a)
    return math.inf if a == 0 else (1 - 2 * a * a) / (2 * a * math.hypot(1.0, a))


def lock_boundary(a: float, accuracy: Accuracy, points: int = 48) -> Array:
    """Return the boundary |t| = 2 of the lock zone, for f ≥ 0.

    Parameters
    ----------
    a : float
        The coupling a = I23/I22, |a| ≤ 1e5.
    accuracy : Level or str
        Accuracy level or its name, see `accuracy`.
    points : int, optional
        Number of points.

    Returns
    -------
    ndarray of float, shape (points, 2)
        Points (h, f) from the bifurcation curve to (1, 0), in units b = 1, read-only.  The map locks at larger h.
        Shape (0, 2) if a = 0, where no map locks.

    Raises
    ------
    InvalidParameter
        If a is not finite or |a| > 1e5.

    Examples
    --------
    >>> from hess_mechanics import circle_map, level, lock_boundary
    >>> h, f = lock_boundary(0.5, level("precise"))[20]
    >>> abs(circle_map(0.5, h, f, level("precise")).trace - 2.0) < 1e-6
    True
    """
    level = as_level(accuracy)
    check_a(a)
    as_whole("points", points, 3, 100_000)
    if abs(a) > _MAX_A_OF_BOUNDARY:
        raise InvalidParameter(f"a = {a:g} is too large for the lock boundary: choose |a| ≤ {_MAX_A_OF_BOUNDARY:g}.")
    end = lock_boundary_end(a)
    if end > 1e6:
        return frozen(np.empty((0, 2)))
    s = np.cos(np.linspace(0.0, 0.5 * math.pi, points))[1:-1]

    def locked(e: Array) -> Array:
        return _locked(e - 1.0, s * f_max_each(e - 1.0), abs(float(a)), level)

    # In e = h + 1 the boundary lies between half the smaller and twice the larger of its end values.
    ends = (end + 1.0, 2.0)
    e = _rising_roots(locked, np.full(s.size, 0.5 * min(ends)), np.full(s.size, 2.0 * max(ends)))
    inside = np.column_stack([e - 1.0, s * f_max_each(e - 1.0)])
    return frozen(np.vstack([[end, f_max_each(np.array([end]))[0]], inside, [1.0, 0.0]]))


def _locked_at(h: float, f: float, a: float, level: Level) -> float:
    return float(_locked(np.array([h]), np.array([f]), float(a), level)[0])


def _root(function: Callable[[float], float], low: float, high: float, what: str) -> float:
    from scipy.optimize import brentq  # imported here because it takes 0.3 s

    if function(low) * function(high) > 0:
        raise InvalidParameter(f"The lock boundary has no {what} between {low:g} and {high:g} here.")
    return float(brentq(function, low, high, xtol=1e-15, rtol=1e-14))


def lock_boundary_f(a: float, h: float, accuracy: Accuracy) -> float:
    """Return the f > 0 with |t| = 2 at given a and h.

    Parameters
    ----------
    a : float
        The coupling a = I23/I22.
    h : float
        The energy, in units b = 1.
    accuracy : Level or str
        Accuracy level or its name, see `accuracy`.

    Returns
    -------
    float
        The area integral f on the lock boundary, in units b = 1.

    Raises
    ------
    OutsideRegion
        If h ≤ −1.
    InvalidParameter
        If no such f exists, or a or h is out of range.

    Examples
    --------
    >>> from hess_mechanics import circle_map, level, lock_boundary_f
    >>> f = lock_boundary_f(0.5, 0.5, level("precise"))
    >>> abs(circle_map(0.5, 0.5, f, level("precise")).trace - 2.0) < 1e-6
    True
    """
    level = as_level(accuracy)
    check_a(a)
    top = turning_points(h, 0.0 if h != 1.0 else 0.5).f_max
    return _root(lambda f: _locked_at(h, f, a, level), 1e-9 * top, top * (1 - 1e-9), "f")


def critical_a(h: float, f: float, accuracy: Accuracy, high: float = 10.0) -> float:
    """Return the a at which the limit cycles of the torus (h, f) appear, |t| = 2.

    Parameters
    ----------
    h : float
        The energy, in units b = 1.
    f : float
        The area integral, in units b = 1.
    accuracy : Level or str
        Accuracy level or its name, see `accuracy`.
    high : float, optional
        Upper end of the search interval (0, high).

    Returns
    -------
    float
        The critical coupling a.

    Raises
    ------
    OutsideRegion
        If no motion has this h and f.
    Separatrix
        If h = 1 and f = 0.
    InvalidParameter
        If there is no such a in (0, high).

    Examples
    --------
    >>> from hess_mechanics import circle_map, critical_a, level
    >>> a = critical_a(0.5, 0.6, level("precise"))
    >>> [circle_map(factor * a, 0.5, 0.6, level("precise")).kind for factor in (0.99, 1.01)]
    ['elliptic', 'hyperbolic']
    """
    level = as_level(accuracy)
    check_a(high)
    turning_points(h, f)
    return _root(lambda a: _locked_at(h, f, a, level), 1e-9, high, "a")


CELLS = (100, 75)
"""Largest number of cells of a window, horizontally and vertically."""


def affordable_cells(a: float, cells: tuple[int, int]) -> tuple[int, int]:
    """Return fewer cells (m, n) if a large |a| makes each one expensive, but at least 8 × 8."""
    share_ = min(1.0, math.sqrt(10.0 / max(abs(a), 1e-9)))
    m, n = (max(8, round(size * share_)) for size in cells)
    return m, n


def rotation_number_window(
    a: float, h: tuple[float, float], f: tuple[float, float], accuracy: Accuracy, cells: tuple[int, int] = CELLS
) -> Array:
    """Return ρ at the centres of the cells (m, n) of a window, shape (n, m).

    Cells outside the region have the value at its edge (same h), so that a plot can be clipped along the bifurcation
    curve.  Raises as `rotation_number_grid`.
    """
    level = as_level(accuracy)
    m, n = cells
    return frozen(_filled_grid(a, np.maximum(centres(*h, m), -1.0 + 1e-6), centres(*f, n), level))
