"""S8: the possible values of (h, f), and the turning points of n3 (`eq0003`, `Geq3`, `Geq4`).

Units b = 1.  The gyroscopic function is p(n) = 2(h+n)(1−n²) − f².  Motion needs
|f| ≤ f_max(h); on the curve f = ±f_max the torus shrinks to a circle.
`Geq3` is printed with h = (1−3n³)/(2n); correct is h = (1−3n²)/(2n).

The roots of p come from its expansions about its two extrema, p(n_c+s) = p_c ∓ 2D s² − 2s³
with D = √(h²+3): every gap between roots then keeps its relative accuracy, however close
(h, f) is to the curve, to the separatrix (1, 0) or to the bottom (−1, 0).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hess_mechanics.errors import InvalidParameter, OutsideRegion, Separatrix
from hess_mechanics.numerics.jit import inner, kernel
from hess_mechanics.numerics.results import Array, frozen
from hess_mechanics.rigid_body.inertia import require_finite

__all__ = ["SPECIAL_POINTS", "TurningPoints", "curve", "curve_point", "f_max", "turning_points"]

SPECIAL_POINTS: tuple[tuple[float, float], ...] = ((1.0, 0.0), (-1.0, 0.0))
"""`Geq4`: the upper and lower equilibrium (h, f)."""


@inner
def upper_extremum(h):
    """(D, h+n_c, 1−n_c) at the maximum n_c of p, without cancellation for any h ≥ −1."""
    e = h + 1.0
    D = math.sqrt(h * h + 3.0)
    return D, e * (e + D) / (e + 2.0 + D), 2.0 * e / (e + 2.0 + D)


@inner
def largest_f(h):
    """f_max(h) = √(2(h+n_c)(1−n_c²))."""
    _, k, d = upper_extremum(h)
    return math.sqrt(2.0 * k * d * (2.0 - d))


@inner
def roots(h, f):
    """The roots of p(n) = 2(h+n)(1−n²) − f², and what cancels in them, for |f| ≤ f_max(h).

    Returns (n0, n1, n2, g10, g21, g20, w1, v1): n0 ≤ n1 ≤ n2; gaps g_ij = n_i − n_j;
    w1 = h + n1 (half of |w|² at the lower turning point) and v1 = 1 − n1².
    """
    D, k, d = upper_extremum(h)
    fm = math.sqrt(2.0 * k * d * (2.0 - d))
    above = max(0.0, (fm - abs(f)) * (fm + abs(f)))
    # The minimum n_m = (−h−D)/3: p(n_m) = −below, with h+n_m and 1+n_m free of cancellation.
    n_m = (-h - D) / 3.0
    if 2.0 * h + D > 1.0:
        h_plus = (h - 1.0) * (h + 1.0) / (2.0 * h + D)
    else:
        h_plus = (2.0 * h - D) / 3.0
    # D − h, which cancels for large h.
    D_less_h = 3.0 / (D + h) if h > 0.0 else D - h
    one_plus = 2.0 * (1.0 - h) / (3.0 + D_less_h)
    below = max(0.0, f * f - 2.0 * h_plus * one_plus * (1.0 - n_m))
    # p = 0 is u³ − 3u + 2 = q; u = 2 cos α, q = 4 cos²(3α/2), 4 − q = 4 sin²(3α/2).
    alpha = 2.0 / 3.0 * math.atan2(math.sqrt(below), math.sqrt(above))
    delta = 2.0 / 3.0 * math.atan2(math.sqrt(above), math.sqrt(below))
    g = 2.0 * D / math.sqrt(3.0)
    g21 = g * math.sin(delta)
    g10 = g * math.sin(alpha)
    g20 = g * math.sin(math.pi / 3.0 + alpha)
    half = math.sin(0.5 * delta)
    s1 = -D / 3.0 * (2.0 * half * half + math.sqrt(3.0) * math.sin(delta))
    one_minus = d - s1
    n1 = 1.0 - one_minus
    n2 = n1 + g21
    w1 = k + s1
    u1 = 2.0 - one_minus
    if f == 0.0:
        w1 = max(0.0, h - 1.0)
        u1 = max(0.0, 1.0 - h)
        one_minus = min(2.0, 1.0 + h)
        n1 = -min(1.0, h)
    elif min(w1 / k, u1) < 0.1:
        # Near the pole or the rim |w| = 0 what is small of h+n1 and 1+n1 has cancelled.  With v = 1−n1
        # it solves x² ± (1−h)x = f²/2v; Newton on p then.  Never near the curve, a double root of p.
        v = one_minus
        x = f * f / v
        root = math.sqrt((1.0 - h) * (1.0 - h) + 2.0 * x)
        if w1 < u1:
            w1 = x / ((1.0 - h) + root) if h < 1.0 else 0.5 * ((h - 1.0) + root)
            for _ in range(2):
                u = (1.0 - h) + w1
                v = (1.0 + h) - w1
                w1 -= (2.0 * w1 * u * v - f * f) / (2.0 * (u * v + w1 * v - w1 * u))
            u1 = (1.0 - h) + w1
            one_minus = (1.0 + h) - w1
            n1 = w1 - h
        else:
            u1 = x / ((h - 1.0) + root) if h > 1.0 else 0.5 * ((1.0 - h) + root)
            for _ in range(2):
                w = (h - 1.0) + u1
                v = 2.0 - u1
                u1 -= (2.0 * w * u1 * v - f * f) / (2.0 * (u1 * v + w * v - w * u1))
            w1 = (h - 1.0) + u1
            one_minus = 2.0 - u1
            n1 = u1 - 1.0
    v1 = u1 * one_minus
    return n1 - g10, n1, n2, g10, g21, g20, w1, v1


@inner
def period_from_gaps(g10, g20):
    """One period of n3, T = 2√2/√(n2−n0) K(m), by the arithmetic–geometric mean of 1 and √(1−m)."""
    x = 1.0
    y = math.sqrt(g10 / g20)
    for _ in range(60):
        if abs(x - y) <= 1e-16 * x:
            break
        x, y = 0.5 * (x + y), math.sqrt(x * y)
    return 2.0 * math.sqrt(2.0) / math.sqrt(g20) * math.pi / (x + y)


@kernel
def _f_max_and_roots(h, f):
    fm = largest_f(h)
    if not abs(f) <= fm * (1.0 + 1e-15):
        return fm, (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0), 0.0
    found = roots(h, f)
    # The gap n1 − n0 is 0 at the separatrix only, where the period is infinite.
    return fm, found, period_from_gaps(found[3], found[5]) if found[3] > 0.0 else math.inf


@dataclass(frozen=True)
class TurningPoints:
    """Where n3 turns for given (h, f), units b = 1.

    roots : n0 < n1 ≤ n2 of 2(h+n)(1−n²) − f²; the motion has n1 ≤ n3 ≤ n2.
    w_squared : |w|² at n1; sine_squared : 1 − n1²; period : one period of n3;
    f_max : the region's edge at this h.
    """

    h: float
    f: float
    roots: tuple[float, float, float]
    w_squared: float
    sine_squared: float
    period: float
    f_max: float

    @property
    def initial_rho(self) -> float:
        """ρ = |w| at n3 = n1."""
        return math.sqrt(self.w_squared)

    def state_at_lower_turn(self, phi: float) -> Array:
        """The state of `eq01` (b = 1) on the section n3 = n1 with w = ρ(sin φ, cos φ), shape (5,).

        There (n1, n2) is parallel to w, on the side given by the sign of f (f = 0: the limit f → 0+).
        """
        s, c = math.sin(phi), math.cos(phi)
        rho = self.initial_rho
        nu = math.copysign(math.sqrt(self.sine_squared), self.f)
        return np.array([rho * s, rho * c, nu * s, nu * c, self.roots[1]])


def _check_h(h: float) -> None:
    require_finite(h=h)
    if not h > -1.0:
        raise OutsideRegion(f"h = {h:.12g} is at or below the bottom: no motion. Choose h > −1.")
    if h > 1e12:
        raise InvalidParameter(f"h = {h:g} is beyond what double precision can show: choose h ≤ 1e12.")


def f_max(h: float) -> float:
    """The largest |f| at this h (`Geq3`).  Raises `OutsideRegion` for h ≤ −1."""
    _check_h(h)
    return float(largest_f(float(h)))


def turning_points(h: float, f: float) -> TurningPoints:
    """Roots, period and section of the torus (h, f).

    Raises `OutsideRegion` (h ≤ −1, |f| > f_max), `Separatrix` (f = 0, h = 1), `InvalidParameter`.
    """
    _check_h(h)
    require_finite(f=f)
    h, f = float(h), float(f) + 0.0  # f = −0.0 is f = 0
    fm, found, period = _f_max_and_roots(h, f)
    if abs(f) > fm * (1 + 1e-15):
        # The bound is shown a little below, so that what is shown is accepted.
        raise OutsideRegion(
            f"No motion has h = {h:.15g} and f = {f:.15g}: at this h choose |f| ≤ {fm * (1 - 1e-11):.12g}, "
            "or a larger h."
        )
    n0, n1, n2, _, _, _, w1, v1 = found
    if not math.isfinite(period):
        raise Separatrix("h = 1, f = 0 is the separatrix: no return. Move h or f a little.")
    return TurningPoints(h, f, (n0, n1, n2), 2.0 * w1, v1, period, fm)


def curve_point(n: float) -> tuple[float, float]:
    """The point (h, f ≥ 0) of `Geq3` (corrected) at 0 < n3 = n ≤ 1.  Raises `InvalidParameter`."""
    if not 0.0 < n <= 1.0:
        raise InvalidParameter(f"n3 = {n:g} is not on the curve: choose 0 < n3 ≤ 1.")
    return (1.0 - 3.0 * n * n) / (2.0 * n), (1.0 - n * n) / math.sqrt(n)


def curve(h_end: float, points: int = 200) -> Array:
    """The upper branch of `Geq3` from (−1, 0) to h = h_end, shape (points, 2)."""
    _check_h(h_end)
    n_end = 2.0 / (2.0 * h_end + 2.0 * math.sqrt(h_end * h_end + 3.0))
    # Towards (−1, 0) the curve is a parabola on its side: squares of n make the points even.
    n = 1.0 - (1.0 - n_end) * np.linspace(0.0, 1.0, points)
    return frozen(np.column_stack([(1 - 3 * n * n) / (2 * n), (1 - n * n) / np.sqrt(n)]))
