"""Additional integral F2 of the free Suslov problem, for every odd k (`eq834`; table in models/README.md).

If I13 = 0 and I11 I22 = I22² + k² I23², k odd, F2 = (γ, V(ω)) is an integral of `biz132` with γ̇ = γ × ω, provided that
V̇ = V × ω.  With n = (k+1)/2 and

    V1 = Σ a_j ω1^(k−2j) ω2^(2j),  V2 = Σ b_j ω1^(k−1−2j) ω2^(2j+1),  V3 = Σ c_j ω1^(k−1−2j) ω2^(2j+1),  0 ≤ j < n,

this is an upward recursion in j, rational in I22 and I23:

    c_j       = I23 ((2j+1) b_j/I22 − (k+1−2j) b_(j−1)/I11)
    a_j − b_j = I23 ((2j+1) c_j/I22 − (k+1−2j) c_(j−1)/I11)
    a_(j+1)   = I22/(2j+2) ((k−2j) a_j/I11 − c_j/I23),

which starts from b_0 = I22^n I11^(k−1), the scale of the paper; a_n = 0 is the condition `eq834`.  Case 2, I23 = 0,
follows from the permutation 1 ↔ 2, with γ3 → −γ3, I13 → −I23 and I23 → −I13.  Its condition is
I11 I22 = I11² + k² I13² (the paper prints I22² there).
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

import numpy as np

from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.results import Array
from hess_mechanics.rigid_body.inertia import require_finite, require_positive_definite
from hess_mechanics.suslov.equations import SuslovBody

__all__ = [
    "MAX_K",
    "AdditionalIntegral",
    "Coefficients",
    "I11_at",
    "I11_of",
    "additional_integral",
    "coefficients",
    "formula",
    "integral_of",
    "order",
]

MAX_K = 15


def _check_order(k: int) -> None:
    if not (isinstance(k, int) and k % 2 == 1 and 1 <= k <= MAX_K):
        raise InvalidParameter(f"k = {k} has no integral here: choose an odd k from 1 to {MAX_K}.")


def I11_of(k: int, I22: float, I23: float) -> float:
    """Return I11 = I22 + k² I23²/I22, for which F2 of degree k exists (`eq834`).

    Parameters
    ----------
    k : int
        Degree in ω, odd, 1 to 15.
    I22 : float
        Moment of inertia about the second axis, I22 > 0.
    I23 : float
        Product of inertia, any finite number, in the unit of I22.

    Returns
    -------
    float
        Moment of inertia about the first axis, in the unit of I22.

    Raises
    ------
    InvalidParameter
        If k is even or out of range, or a value is not finite.
    NotPositiveDefinite
        If I22 ≤ 0.
    """
    _check_order(k)
    require_finite(I22=I22, I23=I23)
    require_positive_definite(1.0, I22)
    return I22 + k * k * (I23 / I22) * I23


def I11_at(k: float, I22: float, I13: float, I23: float) -> float:
    """Return I11 = I22 + k|k| (I13² + I23²)/I22, which for I13 = 0 extends `I11_of` to any real k.

    Parameters
    ----------
    k : float
        Any real number; I11 < I22 for k < 0.  With I13 ≠ 0 an odd k does not mean that F2 exists.
    I22 : float
        Moment of inertia about the second axis, I22 > 0.
    I13, I23 : float
        Products of inertia, in the unit of I22.

    Returns
    -------
    float
        Moment of inertia about the first axis; not positive if k is too small.
    """
    return I22 + k * abs(k) * (I13 * I13 + I23 * I23) / I22


@dataclass(frozen=True)
class Coefficients:
    """Exact coefficients of the additional integral F2 of degree k.

    Attributes
    ----------
    k : int
        Degree in ω, odd, 1 to 15.
    a, b, c : tuple of Fraction, length (k + 1)/2
        Coefficients of V1, V2 and V3, see the module.
    remainder : Fraction
        The coefficient a_n, n = (k + 1)/2; it is 0 if F2 is conserved.
    """

    k: int
    a: tuple[Fraction, ...]
    b: tuple[Fraction, ...]
    c: tuple[Fraction, ...]
    remainder: Fraction


@lru_cache(maxsize=64)
def coefficients(k: int, I22: Fraction | float, I23: Fraction | float) -> Coefficients:
    """Return the exact coefficients of case 1 of `eq834` for these I22 and I23, with I11 from k.

    Parameters
    ----------
    k : int
        Degree in ω, odd, 1 to 15.
    I22 : Fraction or float
        Moment of inertia about the second axis, I22 > 0.
    I23 : Fraction or float
        Product of inertia, nonzero.

    Returns
    -------
    Coefficients
        The coefficients, as fractions.

    Raises
    ------
    InvalidParameter
        If k is even or out of range, I22 ≤ 0 or I23 = 0.
    """
    _check_order(k)
    if not (I22 > 0 and I23 != 0):
        raise InvalidParameter(
            f"I22 = {float(I22):g}, I23 = {float(I23):g}: choose I22 > 0, and a nonzero I23 (otherwise ω is constant)."
        )
    I22, I23 = Fraction(I22), Fraction(I23)
    I11 = I22 + k * k * I23**2 / I22
    n, x = (k + 1) // 2, I23 / I22
    a, b, c = [Fraction(0)], [I22**n * I11 ** (k - 1)], [Fraction(0)]
    for j in range(n):
        odd, back = 2 * j + 1, (k + 1 - 2 * j) * I23 / I11
        below_b, below_c = (b[j - 1], c[j - 1]) if j else (Fraction(0), Fraction(0))
        # a_j = b_j + odd x c_j − back c_(j−1) and c_j = odd x b_j − back b_(j−1).
        if j:
            b.append((a[j] + odd * x * back * below_b + back * below_c) / (1 + (odd * x) ** 2))
            c.append(Fraction(0))
        c[j] = odd * x * b[j] - back * below_b
        a[j] = b[j] + odd * x * c[j] - back * below_c
        a.append(I22 / (2 * j + 2) * ((k - 2 * j) * a[j] / I11 - c[j] / I23))
    return Coefficients(k, tuple(a[:n]), tuple(b), tuple(c), a[n])


@dataclass(frozen=True)
class AdditionalIntegral:
    """Additional integral F2 = (γ, V(ω)) of one body; the result of `additional_integral`.

    Attributes
    ----------
    k : int
        Degree in ω.
    swaps_axes : bool
        True for case 2 of `eq834` (I23 = 0).
    a : ndarray of float, shape ((k + 1)/2,)
        Coefficients of V1, see the module; in case 2 those of the permuted body.
    b : ndarray of float, shape ((k + 1)/2,)
        Coefficients of V2, likewise.
    c : ndarray of float, shape ((k + 1)/2,)
        Coefficients of V3, likewise.
    inertia : float
        Moment of inertia about ξ: I11, in case 2 I22; positive, in units I.
    """

    k: int
    swaps_axes: bool
    a: Array
    b: Array
    c: Array
    inertia: float

    def vector(self, omega: Array) -> Array:
        """Return the vector V(ω) of F2 = (γ, V(ω)).

        Parameters
        ----------
        omega : array_like of float, shape (..., 2)
            Angular velocities (ω1, ω2).

        Returns
        -------
        ndarray of float, shape (..., 3)
            The vectors V.
        """
        omega = np.asarray(omega, float)
        w1, w2 = (omega[..., 1], omega[..., 0]) if self.swaps_axes else (omega[..., 0], omega[..., 1])
        j = np.arange(self.a.size)
        odd = w1[..., None] ** (self.k - 2 * j) * w2[..., None] ** (2 * j)
        even = w1[..., None] ** (self.k - 1 - 2 * j) * w2[..., None] ** (2 * j + 1)
        v1, v2, v3 = odd @ self.a, even @ self.b, even @ self.c
        return np.stack([v2, v1, -v3] if self.swaps_axes else [v1, v2, v3], axis=-1)

    def circle(self, omega: Array, level: float) -> tuple[Array, float]:
        """Return the circle of all γ with F2 = level at one ω.

        Parameters
        ----------
        omega : array_like of float, shape (2,)
            Angular velocity (ω1, ω2), not 0.
        level : float
            Value of F2, any finite number.

        Returns
        -------
        n : ndarray of float, shape (3,)
            Unit vector along the axis of the circle.
        d : float
            Signed distance of its plane from the origin: (n, γ) = d.  There is no such γ if |d| > 1.
        """
        V = self.vector(omega)
        length = float(np.linalg.norm(V))
        return V / length, level / length

    def __call__(self, omega: Array, gamma: Array) -> Array:
        """Return F2 = (γ, V(ω)).

        Parameters
        ----------
        omega : array_like, shape (..., 2)
            Angular velocities (ω1, ω2), in rad/T.
        gamma : array_like, shape (..., 3)
            Verticals γ.

        Returns
        -------
        ndarray, shape (...,)
            Values of F2.
        """
        value: Array = np.sum(self.vector(omega) * np.asarray(gamma, float), axis=-1)
        return value

    def at_fixed_points(self, h: float) -> float:
        """Return the value of F2 at ω^(±) with γ^(±) = ±ξ; γ = ∓ξ has the opposite value.

        Parameters
        ----------
        h : float
            The energy h > 0.

        Returns
        -------
        float
            The value f^+ = f^−.

        Raises
        ------
        InvalidParameter
            If h is not a finite positive number.

        References
        ----------
        `biz138`.

        Examples
        --------
        >>> from hess_mechanics import SuslovBody, additional_integral
        >>> F2 = additional_integral(1, SuslovBody(2.0, 1.0, 0.0, 0.5))
        >>> round(F2.at_fixed_points(0.5), 6)
        -1.118034
        """
        require_finite(h=h)
        if not h > 0.0:
            raise InvalidParameter(f"E = h = {h:g}, but without a field the energy is positive: choose h > 0.")
        # At ω^(±) V = ∓a_0 |ω|^k ξ for all signs of I13 and I23, as k is odd.
        return -float(self.a[0]) * math.sqrt(2.0 * h / self.inertia) ** self.k


def order(body: SuslovBody) -> int | None:
    """Return the odd k ≤ 15 for which the body satisfies `eq834` to round-off.

    Parameters
    ----------
    body : SuslovBody
        The body.

    Returns
    -------
    int or None
        The degree of F2; None if the body has a field, no such k exists, or round-off leaves k open.
    """
    I11, I22, I13, I23, *b = body.parameters
    if any(b) or (I13 == 0.0) == (I23 == 0.0):
        return None
    if I23 == 0.0:
        I11, I22, I23 = I22, I11, I13
    squared = (I22 / I23) * ((I11 - I22) / I23)
    if not 0.5 < squared < (MAX_K + 1) ** 2:
        return None
    k = 2 * int(math.sqrt(squared) // 2) + 1
    # I11 is known to a few units in the last place; return None if k is ambiguous.
    blur = 2e-15 * (I11 / abs(I23)) * (I22 / abs(I23)) + 4e-15 * squared
    return k if k <= MAX_K and abs(squared - k * k) <= blur < 1e-3 else None


def additional_integral(k: int, body: SuslovBody) -> AdditionalIntegral:
    """Return the additional integral F2 of degree k of a body with I13 = 0 or I23 = 0.

    Parameters
    ----------
    k : int
        Degree in ω, odd, from 1 to 15.
    body : SuslovBody
        Body of which I22 and I23 are used (in case 2 I11 and I13); the other moment follows from k.

    Returns
    -------
    AdditionalIntegral
        The integral with its coefficients.

    Raises
    ------
    InvalidParameter
        If k is not odd from 1 to 15, I13 and I23 are both 0 or both nonzero, or a coefficient overflows.

    References
    ----------
    `eq834`.

    Examples
    --------
    >>> from hess_mechanics import SuslovBody, additional_integral
    >>> F2 = additional_integral(3, SuslovBody(3.25, 1.0, 0.0, 0.5))
    >>> F2.k, F2.inertia
    (3, 3.25)
    >>> round(float(F2([0.3, 0.2], [0.6, 0.0, 0.8])), 6)
    0.296591
    """
    permuted = body.I23 == 0.0
    if permuted == (body.I13 == 0.0):
        raise InvalidParameter(
            "F2 is known only if exactly one of I13, I23 is 0: choose one of them 0 and the other nonzero."
        )
    I22, I23 = (body.I11, -body.I13) if permuted else (body.I22, body.I23)
    exact = coefficients(k, I22, I23)
    try:
        a, b, c = (np.array([float(x) for x in row]) for row in (exact.a, exact.b, exact.c))
    except OverflowError:
        raise InvalidParameter(
            "The coefficients of F2 exceed the range of doubles: measure the moments of inertia in other units."
        ) from None
    return AdditionalIntegral(k, permuted, a, b, c, I11_of(k, I22, I23))


def integral_of(body: SuslovBody) -> AdditionalIntegral | None:
    """Return the additional integral F2 of a body.

    Parameters
    ----------
    body : SuslovBody
        The body.

    Returns
    -------
    AdditionalIntegral or None
        F2; None if the body has a field or `eq834` does not hold.
    """
    k = order(body)
    return None if k is None else additional_integral(k, body)


_FORMULAS = {
    1: r"F_2 = I_{11}\gamma_1\omega_1 + (I_{22}\gamma_2 + I_{23}\gamma_3)\omega_2",
    3: r"F_2 = I_{11}^2\omega_1^2\big((I_{22}^2 + I_{23}^2)\gamma_1\omega_1 + I_{22}(I_{22}\gamma_2 + I_{23}\gamma_3)"
    r"\omega_2\big) + I_{22}\omega_2^2\big(I_{22}(I_{22}^2 + 5I_{23}^2)\gamma_2\omega_2 + (I_{22}^2 - 3I_{23}^2)"
    r"(I_{11}\gamma_1\omega_1 + I_{23}\gamma_3\omega_2)\big)",
}


def formula(k: int) -> str:
    """Return F2 in LaTeX, case 1 of `eq834`: expanded for k = 1 and 3, otherwise as a sum.

    Parameters
    ----------
    k : int
        Degree in ω, odd, 1 to 15.

    Returns
    -------
    str
        The formula, without delimiters.

    Raises
    ------
    InvalidParameter
        If k is even or out of range.
    """
    _check_order(k)
    return _FORMULAS.get(
        k,
        (
            rf"F_2 = \sum_{{j=0}}^{{{(k - 1) // 2}}} \omega_1^{{{k - 1}-2j}}\omega_2^{{2j}}"
            r"\big(a_j\gamma_1\omega_1 + (b_j\gamma_2 + c_j\gamma_3)\omega_2\big)"
        ),
    )
