"""Closed forms of the Suslov–Hess case with proved bounds: the period of n3 and the trace on the edge of the region.

Ball arithmetic is that of Arb.  Numbers are exact, see `balls.exact`; the precision doubles until the enclosure has
the requested number of digits.
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
    """Return an enclosure of the period of n3 on the torus (h, f): T = √2 π/AGM(√(n2 − n0), √(n1 − n0)).

    Parameters
    ----------
    h : str, float or Fraction
        The energy, in units b = 1, taken as exact.
    f : str, float or Fraction
        The area integral, in units b = 1, taken as exact.
    digits : int, optional
        Number of significant decimal digits.

    Returns
    -------
    Enclosure
        The period in units b = 1.

    Raises
    ------
    MissingLibrary
        If python-flint is not installed.
    InvalidParameter
        If a number cannot be taken as exact, or (h, f) lies on the edge, where n3 is constant.
    OutsideRegion
        If no motion has this h and f.
    Separatrix
        If h = 1 and f = 0.
    WorkLimit
        If the enclosure needs more precision than allowed.

    Notes
    -----
    n0 < n1 < n2 are the roots of 2(h + n)(1 − n²) − f², isolated as balls.
    """
    energy, area = exact("h", h), exact("f", f)
    check_possible(Fraction(0), energy, area)
    if on_edge(energy, area):
        raise InvalidParameter(
            f"h = {energy}, f = {area} lies on the edge of the region, where n3 is constant and has no period. "
            "Choose a smaller |f|, or a larger h."
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
    """Return an enclosure of the limit of t at the point n3 = n of the bifurcation curve.

    Parameters
    ----------
    a : str, float or Fraction
        The coupling, |a| ≤ 1000, taken as exact.
    n : str, float or Fraction
        The constant value of n3, 0 < n ≤ 1, taken as exact.
    digits : int, optional
        Number of significant decimal digits.

    Returns
    -------
    Enclosure
        2 cos(π√(n²(1+a²)−a²)/√(1+3n²)), with cosh if the radicand is negative.

    Raises
    ------
    MissingLibrary
        If python-flint is not installed.
    InvalidParameter
        If a or n is out of range, or cannot be taken as exact.
    WorkLimit
        If the enclosure needs more precision than allowed.

    Notes
    -----
    On the curve itself there is no torus, see `edge`.
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
