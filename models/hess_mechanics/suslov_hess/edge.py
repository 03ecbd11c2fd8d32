"""The edge of the possible (h, f): a circle of states instead of a torus, and a theorem about the motion on it.

Units b = 1.  On the edge the two larger roots of 2(h + n)(1 − n²) − f² are one, n, and n3 = n all the time (`Geq3`):
h = (1 − 3n²)/(2n), |f| = (1 − n²)/√n.  Then |w|² = (1 − n²)/n, (n1, n2) = w f/|w|², and with w = |w|(sin φ, cos φ)
the equation of φ (`eq0003`) has constant coefficients:

    φ' = −a|w| cos φ − f/|w|²,   (f/|w|²)² = n,   (a|w|)² = a²(1 − n²)/n.

With the radicand R = n²(1 + a²) − a² the difference of these two squares is R/n, and its sign decides.

R > 0 : φ' has one sign.  The circle is one periodic orbit with the period 2π√(n/R).
R < 0 : φ' vanishes where cos φ = −f/(a|w|³), at two places ±φ*.  These are equilibria of the reduced equations, with
    the rates dφ'/dφ = a|w| sin φ = ±√(−R/n): one attracts all other motions of the circle, the other repels them.
    There γ stays in the body, so γ × ω = 0: the body turns steadily about the vertical.

R = 0 does not happen for rational a, h, f: see `hess_mechanics/proofs.md`.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from hess_mechanics.numerics.balls import ArbBall, Enclosure, rational, to_digits

__all__ = ["PERIODIC_ORBIT", "TWO_EQUILIBRIA", "EdgeProof", "prove_edge"]

TWO_EQUILIBRIA, PERIODIC_ORBIT = "two equilibria", "periodic orbit"
_DIGITS = 30


@dataclass(frozen=True)
class EdgeProof:
    """What is proved of the circle of states (h, f) on the edge, for exactly these rationals, if Arb's balls are right.

    Parameters
    ----------
    a, h, f : the rationals, in units b = 1.
    n : the constant value of n3.
    statement : `TWO_EQUILIBRIA` or `PERIODIC_ORBIT`.
    fixed_points : the angles φ of the attracting and the repelling equilibrium, in radians; empty without equilibria.
    rates : dφ'/dφ at these two, negative and positive, in units of √b; empty without equilibria.
    period : of the periodic orbit, in units of 1/√b; None where there are equilibria.
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
    """Prove what the motion on the edge is, for h > −1 and f ≠ 0 with a double root.  Source: `Geq3`, `eq0003`.

    Parameters
    ----------
    a, h, f : exact rationals in units b = 1; (h, f) must lie on the edge.

    Raises
    ------
    MissingLibrary
        Without python-flint.
    WorkLimit
        If the enclosures need more precision than allowed.
    """
    n = _double_root(h, f)
    radicand = n * n * (1 + a * a) - a * a

    def rate(library: Any) -> ArbBall:
        return library.arb(rational(abs(radicand) / n)).sqrt()

    if radicand > 0:
        period = to_digits(_DIGITS, lambda library: 2 * library.arb.pi() / rate(library))
        return EdgeProof(a, h, f, n, PERIODIC_ORBIT, (), (), period)
    # 1/√n = |f|/(1 − n²), so cos²φ = n²/(a²(1 − n²)); the sign is that of −af.
    cosine = n * n / (a * a * (1 - n * n))
    sign = -1 if a * f > 0 else 1
    angle = to_digits(_DIGITS, lambda library: (sign * library.arb(rational(cosine)).sqrt()).acos())
    away = to_digits(_DIGITS, rate)
    phi, growth = (angle, _opposite(angle)), (_opposite(away), away)
    return EdgeProof(a, h, f, n, TWO_EQUILIBRIA, phi if a < 0 else phi[::-1], growth, None)


def _double_root(h: Fraction, f: Fraction) -> Fraction:
    """The double root of p = −2n³ − 2hn² + 2n + 2h − f²: the root of p modulo p', which is linear."""
    # p' = −6n² − 4hn + 2; p − p'(n/3 + h/9) = (4/3 + 4h²/9) n + (2h − f²) − 2h/9.
    return -(2 * h - f * f - 2 * h / 9) / (Fraction(4, 3) + 4 * h * h / 9)


def _opposite(found: Enclosure) -> Enclosure:
    return Enclosure(-found.high, -found.low)
