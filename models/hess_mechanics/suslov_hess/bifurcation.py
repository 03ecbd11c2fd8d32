"""Bifurcation diagram of the Suslov–Hess case: the region of (h, f) and the turning points of n3 (`Geq3`, `Geq4`).

Units b = 1.  The gyroscopic function is p(n) = 2(h+n)(1−n²) − f².  Motion needs |f| ≤ f_max(h); on the curve
f = ±f_max the torus shrinks to a circle.
The paper prints `Geq3` with h = (1−3n³)/(2n); the correct form is h = (1−3n²)/(2n).
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from hess_mechanics.errors import InvalidParameter, OutsideRegion, Separatrix
from hess_mechanics.numerics.arguments import as_integer, as_number
from hess_mechanics.numerics.results import Array, as_read_only
from hess_mechanics.rigid_body.inertia import require_finite
from hess_mechanics.suslov_hess.bifurcation_kernels import f_max_and_roots, largest_f_into

__all__ = [
    "TurningPoints",
    "curve",
    "curve_point",
    "f_max",
    "f_max_of_energies",
    "h_min",
    "reach",
    "turning_points",
]


@dataclass(frozen=True)
class TurningPoints:
    """Turning points of n3 on the torus (h, f), in units b = 1; the result of `turning_points`.

    Attributes
    ----------
    h : float
        Energy, h > −1.
    f : float
        Area integral, |f| ≤ f_max(h).
    roots : tuple of three floats
        The roots n0 < n1 ≤ n2 of 2(h+n)(1−n²) − f²; the motion has n1 ≤ n3 ≤ n2.
    w_squared : float
        |w|² at n3 = n1, ≥ 0.
    sine_squared : float
        1 − n1², 0 to 1.
    period : float
        Period of n3, positive, in units 1/√b.
    """

    h: float
    f: float
    roots: tuple[float, float, float]
    w_squared: float
    sine_squared: float
    period: float

    @property
    def initial_rho(self) -> float:
        """The value ρ = |w| at n3 = n1."""
        return math.sqrt(self.w_squared)

    @property
    def final_rho(self) -> float:
        """The value ρ = |w| at n3 = n2, where it is largest."""
        return math.sqrt(2.0 * max(0.0, self.h + self.roots[2]))

    def state_at_lower_turn(self, phi: float) -> Array:
        """Return the reduced state at n3 = n1 with w = ρ(sin φ, cos φ).

        Parameters
        ----------
        phi : float
            The angle φ in radians.

        Returns
        -------
        ndarray of float, shape (5,)
            The state (w1, w2, n1, n2, n3) in units b = 1.

        Notes
        -----
        (n1, n2) is parallel to w, with the sign of f; f = 0 is the limit f → 0+.

        Examples
        --------
        >>> from hess_mechanics import turning_points
        >>> turning_points(1.5, 0.6).state_at_lower_turn(0.0).round(4)
        array([ 0.    ,  1.1399,  0.    ,  0.5263, -0.8503])
        """
        s, c = math.sin(phi), math.cos(phi)
        rho = self.initial_rho
        nu = math.copysign(math.sqrt(self.sine_squared), self.f)
        return np.array([rho * s, rho * c, nu * s, nu * c, self.roots[1]])


def _check_h(h: float) -> None:
    require_finite(h=h)
    if not h > -1.0:
        raise OutsideRegion(f"h = {h:.12g} is not above the lowest energy: choose h > −1.")
    if h > 1e12:
        raise InvalidParameter(f"h = {h:g} is beyond what double precision can show: choose h ≤ 1e12.")


def f_max(h: float) -> float:
    """Return the largest |f| of motions with the energy h.

    Parameters
    ----------
    h : float
        The energy, −1 < h ≤ 1e12, in units b = 1.

    Returns
    -------
    float
        The largest |f|, in units b = 1.

    Raises
    ------
    OutsideRegion
        If h ≤ −1.
    InvalidParameter
        If h is not finite or too large.

    References
    ----------
    `Geq3`.

    Examples
    --------
    >>> from hess_mechanics import curve_point, f_max
    >>> round(f_max(1.0), 6)
    1.539601
    >>> h, f = curve_point(0.5)
    >>> abs(f_max(h) - f) < 1e-12
    True
    """
    _check_h(h)
    return float(f_max_of_energies(np.array([h], float))[0])


def f_max_of_energies(h: Array) -> Array:
    """Return `f_max` of each energy.

    Parameters
    ----------
    h : ndarray, shape (n,)
        Energies, −1 ≤ h ≤ 1e12, in units b = 1.

    Returns
    -------
    ndarray, shape (n,)
        Largest |f|, in units b = 1; 0 at h = −1.
    """
    out = np.empty(h.size)
    largest_f_into(h, out)
    return out


def h_min(f: float) -> float:
    """Return the least h of motions with a given f (`Geq3`).

    There |f| = `f_max`, and 1 − n² = |f|√n with n in (0, 1].

    Parameters
    ----------
    f : float
        Area integral, |f| ≤ 1e150, in units b = 1.

    Returns
    -------
    float
        The least energy, in units b = 1.

    Raises
    ------
    InvalidParameter
        If f is not finite, or |f| is so large that n underflows to 0.
    """
    require_finite(f=f)
    low, high = 0.0, 1.0
    # Bisect in r = √n down to round-off, because r⁴ + |f| r − 1 increases with r.
    while low < (root := 0.5 * (low + high)) < high:
        low, high = (root, high) if root**4 + abs(f) * root < 1.0 else (low, root)
    return curve_point(high * high)[0]


def reach(h: float, n3: Array) -> Array:
    """Return the largest |f| of motions with the energy h that reach given n3; the motion with this |f| turns there.

    Parameters
    ----------
    h : float
        Energy, h > −1, in units b = 1.
    n3 : ndarray, shape (n,)
        Heights n3, −1 to 1.

    Returns
    -------
    ndarray, shape (n,)
        Largest |f| = √(2(h + n3)(1 − n3²)), in units b = 1; 0 where h + n3 ≤ 0.
    """
    return np.sqrt(np.maximum(0.0, 2.0 * (h + n3) * (1.0 - n3 * n3)))


def turning_points(h: float, f: float) -> TurningPoints:
    """Return the turning points and the period of n3 on the torus (h, f).

    Parameters
    ----------
    h : float
        The energy, −1 < h ≤ 1e12, in units b = 1.
    f : float
        The area integral, |f| ≤ f_max(h), in units b = 1.

    Returns
    -------
    TurningPoints
        Roots of the gyroscopic function, the period, and |w|² and 1 − n3² at the lower turning point.

    Raises
    ------
    OutsideRegion
        If h ≤ −1 or |f| > f_max(h).
    Separatrix
        If h = 1 and f = 0.
    InvalidParameter
        If h or f is not finite, or h too large.

    References
    ----------
    `Geq3`, `Geq4`.

    Examples
    --------
    >>> from hess_mechanics import turning_points
    >>> [round(float(n3), 9) for n3 in turning_points(1.5, 0.0).roots]  # 2(h + n3)(1 − n3²) = 0
    [-1.5, -1.0, 1.0]
    """
    _check_h(h)
    h, f = float(h), as_number("f", f) + 0.0  # Treat f = −0.0 as 0.
    fm, numbers, period = f_max_and_roots(h, f)
    if abs(f) > fm * (1 + 1e-15):
        # Round down, so that the bound in the message is itself accepted.
        raise OutsideRegion(
            f"No motion has h = {h:.15g} and f = {f:.15g}: at this h choose |f| ≤ {fm * (1 - 1e-11):.12g}, "
            "or a larger h."
        )
    n0, n1, n2, _, _, _, w1, v1 = numbers
    if not math.isfinite(period):
        raise Separatrix("h = 1, f = 0 is the separatrix: no return. Move h or f a little.")
    return TurningPoints(h, f, (n0, n1, n2), 2.0 * w1, v1, period)


def curve_point(n: float) -> tuple[float, float]:
    """Return the point of the bifurcation curve at n3 = n, on the branch f ≥ 0.

    Parameters
    ----------
    n : float
        The constant value of n3, 0 < n ≤ 1.

    Returns
    -------
    h : float
        The energy, in units b = 1.
    f : float
        The area integral, in units b = 1.

    Raises
    ------
    InvalidParameter
        If n is not in (0, 1].

    References
    ----------
    `Geq3`, with the correction h = (1 − 3n²)/(2n).

    Examples
    --------
    >>> from hess_mechanics import curve_point
    >>> h, f = curve_point(0.5)  # (1 − 3/4)/1, (1 − 1/4)/√½
    >>> h, round(f * 2**-0.5, 12)
    (0.25, 0.75)
    """
    if not 0.0 < n <= 1.0:
        raise InvalidParameter(f"n3 = {n:g} is not on the curve: choose 0 < n3 ≤ 1.")
    return (1.0 - 3.0 * n * n) / (2.0 * n), (1.0 - n * n) / math.sqrt(n)


def curve(h_end: float, points: int = 200) -> Array:
    """Return the bifurcation curve from (−1, 0) to h = h_end, on the branch f ≥ 0.

    Parameters
    ----------
    h_end : float
        The last energy, −1 < h_end ≤ 1e12, in units b = 1.
    points : int, optional
        Number of points, both ends included, 1 to 100 000; 1 gives only the point (−1, 0).

    Returns
    -------
    ndarray of float, shape (points, 2)
        The points (h, f), read-only.

    Raises
    ------
    OutsideRegion
        If h_end ≤ −1.
    InvalidParameter
        If h_end is not finite or too large, or `points` is out of range.

    References
    ----------
    `Geq3`.

    Examples
    --------
    >>> from hess_mechanics import curve
    >>> curve(2.0, 3).round(4)
    array([[-1.    ,  0.    ],
           [-0.0886,  0.8092],
           [ 2.    ,  2.0555]])
    """
    _check_h(h_end)
    as_integer("points", points, 1, 100_000)
    n_end = 2.0 / (2.0 * h_end + 2.0 * math.sqrt(h_end * h_end + 3.0))
    n = 1.0 - (1.0 - n_end) * np.linspace(0.0, 1.0, points)
    return as_read_only(np.column_stack([(1 - 3 * n * n) / (2 * n), (1 - n * n) / np.sqrt(n)]))
