"""Edge of the region of (h, f): a circle of states instead of a torus, and a theorem about the motion on it.

Units b = 1.  On the edge the two larger roots of 2(h + n)(1 − n²) − f² coincide at n, and n3 = n at all times (`Geq3`):
h = (1 − 3n²)/(2n), |f| = (1 − n²)/√n.  Then |w|² = (1 − n²)/n, (n1, n2) = w f/|w|², and with w = |w|(sin φ, cos φ)
the equation of φ (`eq0003`) has constant coefficients:

    φ' = −a|w| cos φ − f/|w|²,   (f/|w|²)² = n,   (a|w|)² = a²(1 − n²)/n.

Let R = n²(1 + a²) − a².  The difference of these two squares is R/n, so the sign of R decides.

R > 0 : φ' has one sign.  The circle is one periodic orbit with the period 2π√(n/R).
R < 0 : φ' vanishes at two angles ±φ* with cos φ = −f/(a|w|³).  They are equilibria of the reduced equations with
    the rates dφ'/dφ = a|w| sin φ = ±√(−R/n): one attracts all other motions of the circle, the other repels them.
    At an equilibrium γ is fixed in the body and γ × ω = 0: the body rotates uniformly about the vertical.

R = 0 is impossible for rational a, h, f: see `hess_mechanics/proofs.md`.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from hess_mechanics.numerics.balls import ArbBall, Enclosure, rational, to_digits
from hess_mechanics.numerics.labelled import ShortRepr

__all__ = ["PERIODIC_ORBIT", "TWO_EQUILIBRIA", "EdgeProof", "prove_edge"]

TWO_EQUILIBRIA, PERIODIC_ORBIT = "two equilibria", "periodic orbit"
_DIGITS = 30


@dataclass(frozen=True)
class EdgeProof(ShortRepr):
    """Proved statement about the circle of states (h, f) on the edge of the region, in units b = 1.

    Attributes
    ----------
    a : Fraction
        Inertia parameter.
    h : Fraction
        Energy, h > −1.
    f : Fraction
        Area integral, nonzero.
    n : Fraction
        The constant value of n3, 0 < n < 1.
    statement : str
        `TWO_EQUILIBRIA` or `PERIODIC_ORBIT`.
    fixed_points : tuple of Enclosure
        Angles φ of the attracting and of the repelling equilibrium, in radians; empty without equilibria.
    rates : tuple of Enclosure
        Rates dφ'/dφ at these two, negative and positive, in units of √b; empty without equilibria.
    period : Enclosure or None
        Period of the periodic orbit, in units of 1/√b; None if there are equilibria.

    Notes
    -----
    The statement holds for exactly these rationals if the ball arithmetic of Arb is correct.
    """

    a: Fraction
    h: Fraction
    f: Fraction
    n: Fraction
    statement: str
    fixed_points: tuple[Enclosure, ...]
    rates: tuple[Enclosure, ...]
    period: Enclosure | None


def prove_edge(a: Fraction, h: Fraction, f: Fraction) -> EdgeProof:
    """Prove whether the circle of states on the edge has equilibria or is a periodic orbit.

    Parameters
    ----------
    a : Fraction
        Inertia parameter.
    h : Fraction
        Energy h > −1, in units b = 1; (h, f) must lie on the edge, which is not checked.
    f : Fraction
        Area integral, nonzero, in units b = 1.

    Returns
    -------
    EdgeProof
        The statement and its numbers.

    Raises
    ------
    MissingLibrary
        If python-flint is not installed.
    WorkLimit
        If the enclosures need more precision than allowed.

    References
    ----------
    `Geq3`, `eq0003`.
    """
    n = _double_root(h, f)
    radicand = n * n * (1 + a * a) - a * a

    def rate(library: Any) -> ArbBall:
        return library.arb(rational(abs(radicand) / n)).sqrt()

    if radicand > 0:
        period = to_digits(_DIGITS, lambda library: 2 * library.arb.pi() / rate(library))
        return EdgeProof(a, h, f, n, PERIODIC_ORBIT, (), (), period)
    # 1/√n = |f|/(1 − n²), so cos²φ = n²/(a²(1 − n²)); cos φ has the sign of −af.
    cosine = n * n / (a * a * (1 - n * n))
    sign = -1 if a * f > 0 else 1
    angle = to_digits(_DIGITS, lambda library: (sign * library.arb(rational(cosine)).sqrt()).acos())
    away = to_digits(_DIGITS, rate)
    phi, growth = (angle, _opposite(angle)), (_opposite(away), away)
    return EdgeProof(a, h, f, n, TWO_EQUILIBRIA, phi if a < 0 else phi[::-1], growth, None)


def _double_root(h: Fraction, f: Fraction) -> Fraction:
    """Return the double root of p = −2n³ − 2hn² + 2n + 2h − f²: the root of p modulo p', which is linear."""
    # p' = −6n² − 4hn + 2; p − p'(n/3 + h/9) = (4/3 + 4h²/9) n + (2h − f²) − 2h/9.
    return -(2 * h - f * f - 2 * h / 9) / (Fraction(4, 3) + 4 * h * h / 9)


def _opposite(interval: Enclosure) -> Enclosure:
    return Enclosure(-interval.high, -interval.low)
