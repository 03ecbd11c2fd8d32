"""Closed forms of the Suslov–Hess case with proved bounds, by balls of Arb: the period of n3, the trace on the edge.

Numbers are exact, see `balls.exact`; the precision doubles until the enclosure has as many digits as are asked for.
"""

from __future__ import annotations

from fractions import Fraction
from itertools import pairwise
from typing import Any

from hess_mechanics.errors import InvalidParameter
from hess_mechanics.numerics.balls import ArbBall, Enclosure, ExactNumber, exact, rational, to_digits
from hess_mechanics.suslov_hess.proof import check_possible, on_edge

__all__ = ["proved_torus_period", "proved_trace_on_curve"]


def proved_torus_period(h: ExactNumber, f: ExactNumber, digits: int = 30) -> Enclosure:
    """The period of n3 on the torus (h, f), units b = 1: T = √2 π/AGM(√(n2 − n0), √(n1 − n0)).

    n0 < n1 < n2 are the roots of 2(h + n)(1 − n²) − f², isolated as balls.
    Raises `MissingLibrary`, `InvalidParameter` (also on the edge, where n3 is constant), `OutsideRegion`,
    `Separatrix`, `WorkLimit`.
    """
    energy, area = exact("h", h), exact("f", f)
    check_possible(Fraction(0), energy, area)
    if on_edge(energy, area):
        raise InvalidParameter(
            f"h = {energy}, f = {area} lies on the edge of the possible (h, f), where n3 is "
            "constant and has no period. Choose a smaller |f|, or a larger h."
        )

    def compute(library: Any) -> ArbBall:
        arb = library.arb
        cubic = library.fmpq_poly(
            [rational(c) for c in (2 * energy - area * area, Fraction(2), -2 * energy, Fraction(-2))]
        )
        roots = sorted((root.real for root, _ in cubic.numer().complex_roots()), key=lambda root: float(root.mid()))
        if len(roots) < 3 or any(not low < high for low, high in pairwise(roots)):
            return arb("nan")
        n0, n1, n2 = roots
        return arb(2).sqrt() * arb.pi() / (n2 - n0).sqrt().agm((n1 - n0).sqrt())

    return to_digits(digits, compute)


def proved_trace_on_curve(a: ExactNumber, n: ExactNumber, digits: int = 30) -> Enclosure:
    """The limit of t at the point n3 = n of the bifurcation curve: 2 cos(π√(n²(1+a²)−a²)/√(1+3n²)).

    It is cosh where the radicand is negative.  On the curve itself there is no torus, see `edge`.
    Raises `MissingLibrary`, `InvalidParameter`, `WorkLimit`.
    """
    ratio, height = exact("a", a), exact("n", n)
    if not 0 < height <= 1:
        raise InvalidParameter(f"n3 = {float(height):g} is not on the curve: choose 0 < n3 ≤ 1.")
    if abs(ratio) > 1000:
        raise InvalidParameter(f"a = {float(ratio):g}: choose |a| ≤ 1000.")
    radicand = height**2 * (1 + ratio**2) - ratio**2

    def compute(library: Any) -> ArbBall:
        arb = library.arb
        angle = arb.pi() * (arb(rational(abs(radicand))) / rational(1 + 3 * height**2)).sqrt()
        return 2 * (angle.cos() if radicand >= 0 else angle.cosh())

    return to_digits(digits, compute)
