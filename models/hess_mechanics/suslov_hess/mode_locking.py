"""Mode locking of the circle map: the rotation number over (h, f), and the boundary |t| = 2 of the Arnold tongue.

The Arnold tongue is that of the rotation number 0.  A Möbius map locks at integers only, and here at 0 only
(section 2 of proofs.md).  The tongue ends on the bifurcation curve (`Geq3`) at h* = (1−2a²)/(2a√(1+a²)) and at the
point (1, 0).
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from hess_mechanics.dynamics.cells import centres
from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.accuracy import Accuracy, Level
from hess_mechanics.numerics.arguments import as_integer, as_level
from hess_mechanics.numerics.parallel import run_in_threads
from hess_mechanics.numerics.results import Array, as_read_only
from hess_mechanics.suslov_hess.bifurcation import f_max_of_energies, turning_points
from hess_mechanics.suslov_hess.circle_map import check_a, matrices, rotation_numbers_of

__all__ = [
    "CELLS",
    "affordable_cells",
    "critical_a",
    "critical_a_of_tori",
    "rotation_number_window",
    "tongue_boundary",
]

_MAX_A_OF_BOUNDARY = 1e5


def _lock_function(a: Array | float, h: Array, f: Array, level: Level) -> Array:
    """Return (Im β² − Im α²)/(Im β² + Im α²): positive where the map is locked, 0 where |t| = 2, bounded and smooth."""
    _, im, im_beta, *_ = matrices(a, h, f, level).T
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


def tongue_boundary(a: float, accuracy: Accuracy, points: int = 48) -> Array:
    """Return the boundary |t| = 2 of the Arnold tongue of ρ = 0, for f ≥ 0; t is the trace of the circle map.

    Parameters
    ----------
    a : float
        Inertia parameter a = I23/I22, |a| ≤ 1e5.
    accuracy : str or Level
        Accuracy level or its name, see `level`.
    points : int, optional
        Number of points, 3 to 100 000.

    Returns
    -------
    ndarray of float, shape (points, 2)
        Points (h, f) from the bifurcation curve to (1, 0), in units b = 1, read-only.  The map locks at larger h.
        Shape (0, 2) if a = 0, where no map locks, or |a| < 5e-7, where the boundary extends beyond h = 1e6.

    Raises
    ------
    InvalidParameter
        If a is not finite, |a| > 1e5, or `points` is out of range.
    WorkLimit
        If a torus needs too many steps.

    Examples
    --------
    >>> from hess_mechanics import circle_map, level, tongue_boundary
    >>> h, f = tongue_boundary(0.5, level("precise"))[20]
    >>> abs(circle_map(0.5, h, f, level("precise")).trace - 2.0) < 1e-6
    True
    """
    level = as_level(accuracy)
    check_a(a)
    as_integer("points", points, 3, 100_000)
    if abs(a) > _MAX_A_OF_BOUNDARY:
        raise InvalidParameter(f"a = {a:g} is too large for the Arnold tongue: choose |a| ≤ {_MAX_A_OF_BOUNDARY:g}.")
    # h* is the energy at the end of the boundary on the bifurcation curve.
    end = (1 - 2 * a * a) / (2 * abs(a) * math.hypot(1.0, a)) if a else math.inf
    if end > 1e6:
        return as_read_only(np.empty((0, 2)))
    s = np.cos(np.linspace(0.0, 0.5 * math.pi, points))[1:-1]

    def locked(e: Array) -> Array:
        return _lock_function(abs(float(a)), e - 1.0, s * f_max_of_energies(e - 1.0), level)

    # In e = h + 1 the boundary lies between half the smaller and twice the larger of its end values.
    ends = (end + 1.0, 2.0)
    e = _rising_roots(locked, np.full(s.size, 0.5 * min(ends)), np.full(s.size, 2.0 * max(ends)))
    inside = np.column_stack([e - 1.0, s * f_max_of_energies(e - 1.0)])
    return as_read_only(np.vstack([[end, f_max_of_energies(np.array([end]))[0]], inside, [1.0, 0.0]]))


def critical_a_of_tori(h: Array, f: Array, accuracy: Accuracy, high: float) -> Array:
    """Return the a at which the limit cycles of each torus appear, as `critical_a`.

    Parameters
    ----------
    h : ndarray, shape (n,)
        Energies, in units b = 1.
    f : ndarray, shape (n,)
        Area integrals, |f| ≤ f_max(h), in units b = 1.
    accuracy : str or Level
        Accuracy level.
    high : float
        Upper end of the search interval, positive; its lower end is 1e-9.

    Returns
    -------
    ndarray, shape (n,)
        Values of a > 0; NaN unless the map is elliptic at a = 1e-9 and locks at a = `high`.

    Raises
    ------
    WorkLimit
        If a torus needs too many steps.
    """
    level, result = as_level(accuracy), np.full(h.size, np.nan)

    def locked(a: Array) -> Array:
        return _lock_function(a, h[own], f[own], level)

    low, top = np.full(h.size, 1e-9), np.full(h.size, high)
    own = np.arange(h.size)
    own = np.flatnonzero((locked(low) < 0.0) & (locked(top) > 0.0))
    result[own] = _rising_roots(locked, low[own], top[own])
    return result


def critical_a(h: float, f: float, accuracy: Accuracy, high: float = 10.0) -> float:
    """Return the a at which the limit cycles of the torus (h, f) appear, where the trace of the circle map is ±2.

    Parameters
    ----------
    h : float
        Energy, −1 < h ≤ 1e12, in units b = 1.
    f : float
        Area integral, |f| ≤ f_max(h), in units b = 1.
    accuracy : str or Level
        Accuracy level or its name, see `level`.
    high : float, optional
        Upper end of the search interval, positive, at most 1e6; its lower end is 1e-9.

    Returns
    -------
    float
        The critical inertia parameter a, 1e-9 < a < high.

    Raises
    ------
    OutsideRegion
        If no motion has this h and f.
    Separatrix
        If h = 1 and f = 0.
    InvalidParameter
        If the map does not lock at a = high or already locks at a = 1e-9, or an argument is not finite or too large.
    WorkLimit
        If the torus needs too many steps.

    Examples
    --------
    >>> from hess_mechanics import circle_map, critical_a, level
    >>> a = critical_a(0.5, 0.6, level("precise"))
    >>> [circle_map(factor * a, 0.5, 0.6, level("precise")).kind for factor in (0.99, 1.01)]
    ['elliptic', 'hyperbolic']
    """
    check_a(high)
    turning_points(h, f)
    a = float(critical_a_of_tori(np.array([h], float), np.array([f], float), accuracy, high)[0])
    if math.isnan(a):
        raise InvalidParameter(
            f"At this h and f no limit cycles appear between a = 1e-9 and a = {high:g}: choose another torus or a "
            "larger `high`."
        )
    return a


CELLS = (100, 75)
"""Largest number of cells of a window, horizontally and vertically."""


def affordable_cells(a: float, cells: tuple[int, int]) -> tuple[int, int]:
    """Return the number of cells, reduced for |a| > 10, where each cell is expensive, but at least 8 × 8.

    Parameters
    ----------
    a : float
        Inertia parameter a.
    cells : (int, int)
        Number of cells across and up, (m, n).

    Returns
    -------
    (int, int)
        The reduced numbers.
    """
    share_ = min(1.0, math.sqrt(10.0 / max(abs(a), 1e-9)))
    m, n = (max(8, round(size * share_)) for size in cells)
    return m, n


def rotation_number_window(
    a: float, h: tuple[float, float], f: tuple[float, float], accuracy: Accuracy, cells: tuple[int, int] = CELLS
) -> Array:
    """Return the rotation numbers at the centres of the cells of a window of (h, f).

    Cells outside the region have the value at its edge (same h), so that a plot can be clipped along the bifurcation
    curve; the separatrix (1, 0), which has no return, has the limit f → 0 at h = 1.  ρ is odd in f, so only |f| is
    computed, by two threads.

    Parameters
    ----------
    a : float
        Inertia parameter a, |a| ≤ 1e6.
    h : (float, float)
        Range of h, in units b = 1; cells with h ≤ −1 have the value at h = −1 + 1e-6.
    f : (float, float)
        Range of f, in units b = 1.
    accuracy : str or Level
        Accuracy level.
    cells : (int, int), default CELLS
        Number of cells across and up, (m, n).

    Returns
    -------
    ndarray, shape (n, m)
        Rotation numbers, in turns per return.

    Raises
    ------
    InvalidParameter
        If a is not finite or too large.
    WorkLimit
        If a torus needs too many steps.
    """
    level = as_level(accuracy)
    check_a(a)
    hs, fs = np.maximum(centres(*h, cells[0]), -1.0 + 1e-6), centres(*f, cells[1])
    # Compute each |f| once: the values of f and −f may differ in the last digits.
    mantissas, exponents = np.frexp(np.abs(fs))
    magnitudes, back = np.unique(np.ldexp(np.round(mantissas, 13), exponents), return_inverse=True)
    H, F = (x.ravel() for x in np.meshgrid(hs, magnitudes))
    F = np.minimum(F, f_max_of_energies(H))
    F[(F == 0.0) & (H == 1.0)] = 1e-12
    out = np.empty(H.size)

    # Near the separatrix the motion is slow and the saddle magnifies errors.
    near = np.abs(H - 1.0) + F < 1e-3
    exact = level.tighter().tighter()

    def part(i: int) -> None:
        # Give each thread every second point, so that both get equally many slow points.
        own = np.arange(H.size) % 2 == i
        for points, chosen in ((own & ~near, level), (own & near, exact)):
            if points.any():
                out[points] = rotation_numbers_of(matrices(a, H[points], F[points], chosen))

    run_in_threads(part, 2)
    return as_read_only(np.where(fs < 0.0, -1.0, 1.0)[:, None] * out.reshape(magnitudes.size, hs.size)[back])
