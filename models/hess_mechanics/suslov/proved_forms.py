"""Closed forms of the Suslov problem with proved bounds: cos χ of free motion, and periods.

Ball arithmetic is that of Arb.  Numbers are exact, see `balls.exact`; the precision doubles until the enclosure has
the requested number of digits.
"""

from __future__ import annotations

from fractions import Fraction
from typing import Any

from hess_mechanics.errors import InvalidParameter, NotPositiveDefinite
from hess_mechanics.numerics.balls import ArbBall, Enclosure, ExactNumber, exact, rational, to_digits

__all__ = ["proved_cos_chi", "proved_period", "proved_radial_period"]


def _positive(**moments: Fraction) -> None:
    for name, value in moments.items():
        if value <= 0:
            raise NotPositiveDefinite(f"{name} = {float(value):g}: choose {name} > 0.")


def proved_cos_chi(
    I11: ExactNumber, I22: ExactNumber, I13: ExactNumber, I23: ExactNumber, digits: int = 30
) -> Enclosure:
    """Return an enclosure of cos χ of the free problem, for any inertia tensor, see `scattering`.

    Parameters
    ----------
    I11 : str, float or Fraction
        Moment of inertia, I11 > 0, taken as exact.
    I22 : str, float or Fraction
        Moment of inertia, I22 > 0, taken as exact.
    I13 : str, float or Fraction
        Product of inertia, taken as exact.
    I23 : str, float or Fraction
        Product of inertia, taken as exact.
    digits : int, optional
        Number of significant decimal digits.

    Returns
    -------
    Enclosure
        The value 2|A|² − 1.

    Raises
    ------
    MissingLibrary
        If python-flint is not installed.
    InvalidParameter
        If I13 = I23 = 0, or a number cannot be taken as exact.
    NotPositiveDefinite
        If I11 ≤ 0 or I22 ≤ 0.
    WorkLimit
        If the enclosure needs more precision than allowed.

    Notes
    -----
    |A|² = (Re C/cosh(πK/2))² + (Im C/sinh(πK/2))², C = cos(π/2 √(κ² − (K + ic)²)).
    """
    one, two, q, r = exact("I11", I11), exact("I22", I22), exact("I13", I13), exact("I23", I23)
    _positive(I11=one, I22=two)
    J2 = q * q + r * r
    if J2 == 0:
        raise InvalidParameter(
            "I13 = I23 = 0: ω is constant and there is no scattering. Choose I13 or I23 other than 0."
        )
    w = (two * q * q + one * r * r) / J2

    def compute(library: Any) -> ArbBall:
        arb, acb = library.arb, library.acb
        J = arb(rational(J2)).sqrt()
        K, kappa = rational(one * two / w) / J, arb(rational(one * two)).sqrt() / J
        c = kappa * rational(q * r * (two - one) / (J2 * w))
        C = (acb(kappa * kappa) - acb(K, c) ** 2).sqrt()
        C = (C * arb.pi() / 2).cos()
        half = K * arb.pi() / 2
        return 2 * ((C.real / half.cosh()) ** 2 + (C.imag / half.sinh()) ** 2) - 1

    return to_digits(digits, compute)


def proved_period(
    I11: ExactNumber,
    I22: ExactNumber,
    b1: ExactNumber,
    b2: ExactNumber,
    omega: tuple[ExactNumber, ExactNumber],
    gamma: tuple[ExactNumber, ExactNumber],
    digits: int = 30,
) -> Enclosure:
    """Return an enclosure of the period T of an orbit of Kharlamova's case, b3 = 0, that starts off the equator.

    Parameters
    ----------
    I11 : str, float or Fraction
        Moment of inertia, I11 > 0, taken as exact.
    I22 : str, float or Fraction
        Moment of inertia, I22 > 0, taken as exact.
    b1 : str, float or Fraction
        First component of **b**, taken as exact.
    b2 : str, float or Fraction
        Second component of **b**, taken as exact.
    omega : tuple of two numbers
        Angular velocity (ω1, ω2), taken as exact.
    gamma : tuple of two numbers
        Components (γ1, γ2) of the unit vector γ, taken as exact, γ1² + γ2² < 1.
    digits : int, optional
        Number of significant decimal digits.

    Returns
    -------
    Enclosure
        The period.

    Raises
    ------
    MissingLibrary
        If python-flint is not installed.
    InvalidParameter
        If γ1² + γ2² ≥ 1, the body is at rest, or a number cannot be taken as exact.
    NotPositiveDefinite
        If I11 ≤ 0 or I22 ≤ 0.
    WorkLimit
        If the enclosure needs more precision than allowed.

    Notes
    -----
    T = 2πs/AGM(√((A − C + √(R₊R₋))/2), (R₊R₋)^¼), see `kharlamova`.  An asymptotic orbit has no period.
    """
    one, two = exact("I11", I11), exact("I22", I22)
    _positive(I11=one, I22=two)
    u = [exact(f"γ{i}", x) for i, x in enumerate(gamma, 1)]
    v = [-exact("ω2", omega[1]), exact("ω1", omega[0])]
    a = [-exact("b1", b1) / two, -exact("b2", b2) / one]
    if u[0] ** 2 + u[1] ** 2 >= 1:
        raise InvalidParameter("γ1² + γ2² ≥ 1: choose a state off the equator, with γ1² + γ2² < 1.")
    if v == [0, 0] == a:
        raise InvalidParameter("With ω = 0 and no field the body is at rest: choose ω or b other than 0.")
    P = [1 - _dot(u, u), -2 * _dot(u, v), -_dot(v, v) - _dot(u, a), -_dot(v, a), -_dot(a, a) / 4]

    def compute(library: Any) -> ArbBall:
        arb = library.arb
        quartic = library.fmpq_poly([rational(c) for c in P])
        roots = [root.real for root, _ in quartic.numer().complex_roots() if root.imag.contains(0)]
        low = max((x for x in roots if x < 0), key=lambda x: x.mid())
        high = min((x for x in roots if x > 0), key=lambda x: x.mid())
        s = (high - low) / 2
        # In x, τ = m + sx, P = (1 − x²)(A + Bx + Cx²).
        p = library.arb_poly([rational(c) for c in P])(library.arb_poly([(high + low) / 2, s])).coeffs()
        p += [arb(0)] * (5 - len(p))
        A, B, C = p[0], p[1], -p[4]
        product = ((A + C) ** 2 - B * B).sqrt()
        return 2 * arb.pi() * s / ((A - C + product) / 2).sqrt().agm(product.sqrt())

    return to_digits(digits, compute)


def _dot(x: list[Fraction], y: list[Fraction]) -> Fraction:
    return x[0] * y[0] + x[1] * y[1]


def proved_radial_period(
    inertia: ExactNumber,
    b3: ExactNumber,
    omega: tuple[ExactNumber, ExactNumber],
    gamma: tuple[ExactNumber, ExactNumber],
    digits: int = 30,
) -> Enclosure:
    """Return an enclosure of the time T after which |ω| and γ3 recur, for b1 = b2 = 0 and I11 = I22 = I.

    Parameters
    ----------
    inertia : str, float or Fraction
        Moment of inertia I > 0, taken as exact.
    b3 : str, float or Fraction
        Third component of **b**, not 0, taken as exact.
    omega : tuple of two numbers
        Angular velocity (ω1, ω2), taken as exact.
    gamma : tuple of two numbers
        Components (γ1, γ2) of the unit vector γ with γ3 > 0, taken as exact.
    digits : int, optional
        Number of significant decimal digits.

    Returns
    -------
    Enclosure
        The time T.

    Raises
    ------
    MissingLibrary
        If python-flint is not installed.
    InvalidParameter
        If b3 = 0, γ1² + γ2² ≥ 1, or a number cannot be taken as exact.
    NotPositiveDefinite
        If I ≤ 0.
    WorkLimit
        If the enclosure needs more precision than allowed, as for a circular orbit.

    Notes
    -----
    With h = E and ρ = |q|², q as in `quartic`, γ3 = e − kρ, e = h/b3, k = b3/(2I), and M = (ω1γ1 + ω2γ2) I/b3,

        ρ̇² = 4(ρ − ρ(e − kρ)² − M²) = −4k²(ρ − ρ0)(ρ − ρ1)(ρ − ρ2),   T = π/(|k| AGM(√(ρ2 − ρ0), √(ρ1 − ρ0))).
    """
    own, field = exact("I", inertia), exact("b3", b3)
    _positive(I=own)
    if field == 0:
        raise InvalidParameter("b3 = 0: without a field |ω| is constant. Choose b3 other than 0.")
    u, w = [exact(f"γ{i}", x) for i, x in enumerate(gamma, 1)], [exact(f"ω{i}", x) for i, x in enumerate(omega, 1)]
    if _dot(u, u) >= 1:
        raise InvalidParameter("γ1² + γ2² ≥ 1: choose a state off the equator, with γ1² + γ2² < 1.")
    k, M2 = field / (2 * own), (_dot(u, w) * own / field) ** 2
    # e = γ3 + kρ, and γ3 is a root.
    rise, square = k * _dot(w, w) * (own / field) ** 2, 1 - _dot(u, u)

    def compute(library: Any) -> ArbBall:
        arb = library.arb
        e = arb(rational(square)).sqrt() + rational(rise)
        slope = arb(rational(k))
        # Roots of ρ³ + aρ² + bρ + c by the trigonometric formula: irrational coefficients prevent exact isolation.
        a, b, c = -2 * e / slope, (e * e - 1) / (slope * slope), rational(M2) / (slope * slope)
        p, q = b - a * a / 3, 2 * a * a * a / 27 - a * b / 3 + c
        size = (-p / 3).sqrt()
        angle = (-q / (2 * size * size * size)).acos() / 3
        high, low, middle = (2 * size * (angle - 2 * arb.pi() * i / 3).cos() - a / 3 for i in (0, 2, 1))
        low, middle = (low, middle) if low < middle else (middle, low)
        if not low < middle or not middle < high:
            return arb("nan")
        return arb.pi() / (abs(slope) * (high - low).sqrt().agm((middle - low).sqrt()))

    return to_digits(digits, compute)
