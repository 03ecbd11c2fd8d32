"""S8, S15: where the circle map locks: rotation number over (h, f), and the boundary |t| = 2.

A Möbius map locks at integers only; in this family only the plateau ρ = 0 was seen.  The zone ends
on the curve `Geq3` at h* = (1−2a²)/(2a√(1+a²)) and at the point (1, 0).
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor

import numpy as np

from .accuracy import Level
from .bifurcation import f_max, largest_f, turning_points
from .circle_map import check_a, matrix_of, monodromy, rotation_number
from .errors import InvalidParameter, WorkLimit
from .jit import inner, kernel
from .results import Array, frozen
from .rigid_body import require_finite

__all__ = [
    "critical_a", "lock_boundary", "lock_boundary_end", "lock_boundary_f", "lock_boundary_h", "rotation_number_grid",
    "trace_on_curve",
]


@kernel
def _rotation_numbers(h, f, a, order, tolerance, out):
    """ρ at each (h[i], f[i]); f is drawn inside the region first."""
    for i in range(h.size):
        fm = largest_f(h[i])
        fi = min(max(f[i], -fm), fm)
        if fi == 0.0 and h[i] == 1.0:
            fi = 1e-12
        m = monodromy(h[i], fi, a, order, tolerance, 10_000)
        out[i] = rotation_number(m[0], m[1], m[2], m[3], m[4]) if m[5] >= 0 else math.nan


@inner
def _lock_function(h, s, a, order, tolerance):
    """Positive where the map is locked, at f = s f_max(h): (Im β² − Im α²)/|β|², bounded and smooth."""
    m = monodromy(h, s * largest_f(h), a, order, tolerance, 10_000)
    return (m[2] - m[1]) * (m[2] + m[1]) / (m[2] * m[2] + m[1] * m[1])


@kernel
def _lock_boundary(s, start, a, order, tolerance, out):
    """h where |t| = 2 along f = s[i] f_max(h), followed from s ≈ 1 where it is h = start."""
    e = start + 1.0
    for i in range(s.size):
        lo = e
        hi = e
        value = _lock_function(e - 1.0, s[i], a, order, tolerance)
        factor = 1.02
        for _ in range(60):
            if value > 0.0:
                lo = lo / factor
                if _lock_function(lo - 1.0, s[i], a, order, tolerance) <= 0.0:
                    break
                hi = lo
            else:
                hi = hi * factor
                if _lock_function(hi - 1.0, s[i], a, order, tolerance) > 0.0:
                    break
                lo = hi
            factor *= 1.3
        f_lo = _lock_function(lo - 1.0, s[i], a, order, tolerance)
        f_hi = _lock_function(hi - 1.0, s[i], a, order, tolerance)
        # The Illinois variant of regula falsi: the bracket always holds the boundary.
        side = 0
        for _ in range(60):
            e = hi - f_hi * (hi - lo) / (f_hi - f_lo) if f_hi != f_lo else 0.5 * (lo + hi)
            if hi - lo <= 1e-12 * hi:
                break
            value = _lock_function(e - 1.0, s[i], a, order, tolerance)
            if abs(value) < 1e-13:
                break
            if value > 0.0:
                hi, f_hi = e, value
                if side == 1:
                    f_lo *= 0.5
                side = 1
            else:
                lo, f_lo = e, value
                if side == -1:
                    f_hi *= 0.5
                side = -1
        out[i] = e - 1.0


_POOL = ThreadPoolExecutor(max_workers=2, thread_name_prefix="grid")


def rotation_number_grid(a: float, h: Sequence[float] | Array, f: Sequence[float] | Array, level: Level) -> Array:
    """ρ on the grid h × f, shape (f.size, h.size), read-only.

    Points outside the region take the value at its edge (the same h), so that a picture can be
    cut exactly along `Geq3`.  ρ is odd in f, and only |f| is computed.  Two threads share the rows.
    Raises `InvalidParameter`, `WorkLimit`.
    """
    check_a(a)
    hs, fs = np.asarray(h, float), np.asarray(f, float)
    if hs.ndim != 1 or fs.ndim != 1 or hs.size * fs.size > 1_000_000:
        raise WorkLimit("A grid has at most a million points on two axes: choose fewer.")
    if not (np.all(np.isfinite(hs)) and np.all(np.isfinite(fs)) and np.all(hs > -1.0) and np.all(hs <= 1e12)):
        raise InvalidParameter("The grid needs finite values, and −1 < h ≤ 1e12.")
    magnitudes, back = np.unique(np.round(np.abs(fs), 13), return_inverse=True)
    H, F = (x.ravel() for x in np.meshgrid(hs, magnitudes))
    out = np.empty(H.size)

    def part(i: int) -> None:
        # Every second point: both threads get the same share of slow ones.
        values = np.empty(H[i::2].size)
        _rotation_numbers(H[i::2].copy(), F[i::2].copy(), float(a), level.order, level.tolerance, values)
        out[i::2] = values

    list(_POOL.map(part, (0, 1)))
    if np.any(np.isnan(out)):
        raise WorkLimit("This grid needs too many steps: choose smaller a, or smaller h.")
    return frozen(np.where(fs < 0, -1.0, 1.0)[:, None] * out.reshape(magnitudes.size, hs.size)[back])


def trace_on_curve(a: float, n: float) -> float:
    """t on the bifurcation curve at n3 = n: 2cos(π√(n²(1+a²)−a²)/√(1+3n²)), cosh if the root is imaginary.

    ∞ beyond double range.  Raises `InvalidParameter` (a or n not finite, |a| too large).
    """
    check_a(a)
    require_finite(n=n)
    radicand = n * n * (1 + a * a) - a * a
    argument = math.pi * math.sqrt(abs(radicand)) / math.sqrt(1 + 3 * n * n)
    if radicand >= 0:
        return 2.0 * math.cos(argument)
    return 2.0 * math.cosh(argument) if argument < 709.0 else math.inf


def lock_boundary_end(a: float) -> float:
    """h* = (1−2a²)/(2|a|√(1+a²)), where the lock boundary meets the curve.  a = 0: ∞, nothing locks."""
    a = abs(a)
    return math.inf if a == 0 else (1 - 2 * a * a) / (2 * a * math.hypot(1.0, a))


def lock_boundary(a: float, level: Level, points: int = 48) -> Array:
    """The curve |t| = 2 with f ≥ 0, from the bifurcation curve down to (1, 0); shape (n, 2), read-only.

    The map is locked to the right of it.  Empty for a = 0 (no map locks).  Raises `InvalidParameter`.
    """
    check_a(a)
    end = lock_boundary_end(a)
    if end > 1e6:
        return frozen(np.empty((0, 2)))
    s = np.cos(np.linspace(0.0, 0.5 * math.pi, points))[1:-1]
    found = np.empty(s.size)
    # The end on the curve has a closed form; s = 1 itself would ask for a torus that is a circle.
    _lock_boundary(s, end, abs(float(a)), level.order, level.tolerance, found)
    inside = np.column_stack([found, s * np.array([largest_f(h) for h in found])])
    return frozen(np.vstack([[end, largest_f(end)], inside, [1.0, 0.0]]))


def _locked(a: float, h: float, f: float, level: Level) -> float:
    m, _ = matrix_of(h, f, a, level)
    return (m[2] - m[1]) * (m[2] + m[1]) / (m[2] ** 2 + m[1] ** 2)


def _root(function: Callable[[float], float], low: float, high: float, what: str) -> float:
    from scipy.optimize import brentq  # 0.3 s of import that no page needs

    if function(low) * function(high) > 0:
        raise InvalidParameter(f"The lock boundary has no {what} between {low:g} and {high:g} here.")
    return float(brentq(function, low, high, xtol=1e-15, rtol=1e-14))


def lock_boundary_f(a: float, h: float, level: Level) -> float:
    """The f > 0 with |t| = 2 at given a and h.  Raises `InvalidParameter` where there is none."""
    check_a(a)
    top = turning_points(h, 0.0 if h != 1.0 else 0.5).f_max
    return _root(lambda f: _locked(a, h, f, level), 1e-9 * top, top * (1 - 1e-9), "f")


def lock_boundary_h(a: float, f: float, level: Level, low: float, high: float) -> float:
    """The h between low and high with |t| = 2 at given a and f.  Raises `InvalidParameter`, `OutsideRegion`."""
    check_a(a)
    require_finite(f=f)
    for h in (low, high):
        f_max(h)
    return _root(lambda h: _locked(a, h, f, level), low, high, "h")


def critical_a(h: float, f: float, level: Level, high: float = 10.0) -> float:
    """The a in (0, high) at which the limit cycles of the torus (h, f) appear, |t| = 2.

    Raises `OutsideRegion`, `Separatrix`, `InvalidParameter` where there is none.
    """
    check_a(high)
    turning_points(h, f)
    return _root(lambda a: _locked(a, h, f, level), 1e-9, high, "a")
