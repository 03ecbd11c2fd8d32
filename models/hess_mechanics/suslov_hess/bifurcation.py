"""The bifurcation diagram of the Suslov–Hess case: possible (h, f), and the turning points of n3 (`Geq3`, `Geq4`).

Units b = 1.  The gyroscopic function is p(n) = 2(h+n)(1−n²) − f².  Motion needs |f| ≤ f_max(h); on the curve
f = ±f_max the torus shrinks to a circle.
`Geq3` is printed with h = (1−3n³)/(2n); correct is h = (1−3n²)/(2n).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hess_mechanics.errors import InvalidParameter, OutsideRegion, Separatrix
from hess_mechanics.numerics.results import Array, frozen
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov_hess.bifurcation_kernels import f_max_and_roots, largest_f, largest_f_into

__all__ = [
    "SPECIAL_POINTS",
    "TurningPoints",
    "curve",
    "curve_point",
    "f_max",
    "f_max_each",
    "h_min",
    "reach",
    "turning_points",
]

SPECIAL_POINTS: tuple[tuple[float, float], ...] = ((1.0, 0.0), (-1.0, 0.0))
"""(h, f) of the upper and the lower equilibrium (`Geq4`)."""


@dataclass(frozen=True)
class TurningPoints:
    """The turning points of n3 for given (h, f), units b = 1.

    roots : n0 < n1 ≤ n2 of 2(h+n)(1−n²) − f²; the motion has n1 ≤ n3 ≤ n2.
    w_squared : |w|² at n1; sine_squared : 1 − n1²; period : of n3; f_max : the largest |f| at this h.
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

    @property
    def final_rho(self) -> float:
        """ρ at n3 = n2, where it is largest."""
        return math.sqrt(2.0 * max(0.0, self.h + self.roots[2]))

    def state_at_lower_turn(self, phi: float) -> Array:
        """The reduced state (w1, w2, n1, n2, n3) on the section n3 = n1 with w = ρ(sin φ, cos φ), shape (5,).

        There (n1, n2) is parallel to w, with the sign of f (f = 0: the limit f → 0+).
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
    """The largest |f| of motions with this h (`Geq3`).  Raises `OutsideRegion` for h ≤ −1.

    >>> from hess_mechanics import curve_point, f_max
    >>> h, f = curve_point(0.5)
    >>> abs(f_max(h) - f) < 1e-12
    True
    """
    _check_h(h)
    return float(largest_f(float(h)))


def f_max_each(h: Array) -> Array:
    """`f_max` of each h (n,) from −1 to 1e12, where it is 0 at the bottom."""
    out = np.empty(h.size)
    largest_f_into(h, out)
    return out


def h_min(f: float) -> float:
    """The least h of motions with this f, where |f| = `f_max` (`Geq3`): 1 − n² = |f|√n there, of √n the root in (0, 1].

    Raises `InvalidParameter` for f that is not finite.
    """
    require_finite(f=f)
    low, high = 0.0, 1.0
    # Bisection to round-off: n⁴ + |f|n − 1 grows.
    while low < (root := 0.5 * (low + high)) < high:
        low, high = (root, high) if root**4 + abs(f) * root < 1.0 else (low, root)
    return curve_point(high * high)[0]


def reach(h: float, n3: Array) -> Array:
    """The largest |f| of motions with this h that come to the heights n3 (n,); at a turning point it is |f|."""
    return np.sqrt(np.maximum(0.0, 2.0 * (h + n3) * (1.0 - n3 * n3)))


def turning_points(h: float, f: float) -> TurningPoints:
    """Roots, period and section of the torus (h, f).

    Raises `OutsideRegion` (h ≤ −1, |f| > f_max), `Separatrix` (f = 0, h = 1), `InvalidParameter`.

    >>> from hess_mechanics import turning_points
    >>> [round(float(n3), 9) for n3 in turning_points(1.5, 0.0).roots]  # 2(h + n3)(1 − n3²) = 0
    [-1.5, -1.0, 1.0]
    """
    _check_h(h)
    require_finite(f=f)
    h, f = float(h), float(f) + 0.0  # f = −0.0 is f = 0
    fm, found, period = f_max_and_roots(h, f)
    if abs(f) > fm * (1 + 1e-15):
        # Rounded down, so that the bound in the message is itself accepted.
        raise OutsideRegion(
            f"No motion has h = {h:.15g} and f = {f:.15g}: at this h choose |f| ≤ {fm * (1 - 1e-11):.12g}, "
            "or a larger h."
        )
    n0, n1, n2, _, _, _, w1, v1 = found
    if not math.isfinite(period):
        raise Separatrix("h = 1, f = 0 is the separatrix: no return. Move h or f a little.")
    return TurningPoints(h, f, (n0, n1, n2), 2.0 * w1, v1, period, fm)


def curve_point(n: float) -> tuple[float, float]:
    """The point (h, f ≥ 0) of the bifurcation curve (`Geq3`, corrected) at n3 = n.

    Raises `InvalidParameter` unless 0 < n ≤ 1.

    >>> from hess_mechanics import curve_point
    >>> h, f = curve_point(0.5)  # (1 − 3/4)/1, (1 − 1/4)/√½
    >>> h, round(f * 2**-0.5, 12)
    (0.25, 0.75)
    """
    if not 0.0 < n <= 1.0:
        raise InvalidParameter(f"n3 = {n:g} is not on the curve: choose 0 < n3 ≤ 1.")
    return (1.0 - 3.0 * n * n) / (2.0 * n), (1.0 - n * n) / math.sqrt(n)


def curve(h_end: float, points: int = 200) -> Array:
    """The branch f ≥ 0 of the bifurcation curve (`Geq3`) from (−1, 0) to h = h_end, shape (points, 2).

    >>> from hess_mechanics import curve
    >>> curve(2.0, 100).shape[1]
    2
    """
    _check_h(h_end)
    n_end = 2.0 / (2.0 * h_end + 2.0 * math.sqrt(h_end * h_end + 3.0))
    n = 1.0 - (1.0 - n_end) * np.linspace(0.0, 1.0, points)
    return frozen(np.column_stack([(1 - 3 * n * n) / (2 * n), (1 - n * n) / np.sqrt(n)]))
