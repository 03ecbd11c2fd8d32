"""The Hess manifold r·M = 0 as a theorem: it is invariant, and the separatrices of a torus with two cycles coincide.

With r = (s, 0, t), a1 = a2 ∓ s², a3 = a2 ± t², which are all bodies with the Hess condition (`gess-*1`), for every μ,

    (r·M)˙ = ±s t M2 (r·M):

an identity of polynomials in s, t, a2, μ, M, γ, which `cofactor` derives from the field that the program integrates, in
rationals.  So r·M = 0 is invariant.  In the section it is one closed curve for each torus (h, f), on which the return
map is Θ, that of `eq0003`.  If Θ is proved to have exactly two fixed points, one attracting and one repelling, every
other orbit of the curve goes from the one to the other: each arc between them is a branch of the unstable manifold of
the one and of the stable manifold of the other.  As the section map conserves an area, both are saddles with the
multipliers of Θ, μ and 1/μ.
"""

from __future__ import annotations

from dataclasses import dataclass
from fractions import Fraction
from typing import Any

from hess_mechanics.errors import InvalidParameter, WorkLimit
from hess_mechanics.euler_poisson.equations import SYSTEM
from hess_mechanics.numerics.balls import Enclosure, ExactNumber, flint
from hess_mechanics.suslov_hess.edge import EdgeProof
from hess_mechanics.suslov_hess.proof import TWO_CYCLES, Proof, prove

__all__ = ["Unsplit", "cofactor", "unsplit_separatrices"]


def cofactor(sign: int) -> tuple[Any, Any]:
    """Return (r·M)˙ for every body with the Hess condition, and ±s t M2 (r·M), as rational polynomials.

    sign : the sign of a3 − a2.  Raises `MissingLibrary`.
    """
    library = flint()
    ring = library.fmpq_mpoly_ctx.get(("s", "t", "a2", "mu", "M1", "M2", "M3", "g1", "g2", "g3"), library.Ordering.lex)
    s, t, a2, mu, M1, M2, M3, *gamma = ring.gens()
    rates = SYSTEM.field([M1, M2, M3, *gamma], [a2 - sign * s**2, a2, a2 + sign * t**2, s, 0 * s, t, mu])
    return s * rates[0] + t * rates[2], sign * s * t * M2 * (s * M1 + t * M3)


@dataclass(frozen=True)
class Unsplit:
    """The two saddles of a torus on the Hess manifold, whose separatrices coincide.

    proof : Θ has exactly two cycles; multipliers : of either saddle, the smaller one first.
    """

    proof: Proof
    multipliers: tuple[Enclosure, Enclosure]


def unsplit_separatrices(a: ExactNumber, h: ExactNumber, f: ExactNumber, digits: int = 30) -> Unsplit | None:
    """Prove that the separatrices of two saddles coincide on the torus (h, f), for all bodies with a = s t/a2.

    Parameters
    ----------
    a : str, float or Fraction
        The parameter a, taken as exact.
    h : str, float or Fraction
        The energy, in units b = 1, taken as exact.
    f : str, float or Fraction
        The area integral, in units b = 1, taken as exact.
    digits : int, optional
        Number of significant decimal digits of the multipliers.

    Returns
    -------
    Unsplit or None
        The proof; None if two limit cycles are not proved.

    Raises
    ------
    InvalidParameter
        If (h, f) lies on the edge of the region, where there is no torus, or a number cannot be taken as exact.
    MissingLibrary
        If python-flint is not installed.
    OutsideRegion
        If no motion has this h and f.
    Separatrix
        If h = 1 and f = 0.
    WorkLimit
        If the digits need more precision than a proof may use.
    """
    if not all(found == claimed for found, claimed in map(cofactor, (1, -1))):
        return None
    proof = prove(a, h, f, digits=digits + 4)
    if isinstance(proof, EdgeProof):
        raise InvalidParameter(
            f"h = {proof.h}, f = {proof.f} lies on the edge of the region: there is no torus, and no separatrix on it. "
            "Choose a smaller |f|, or a larger h."
        )
    if proof.statement != TWO_CYCLES:
        return None
    less, more = sorted(proof.multipliers, key=lambda one: one.low)
    if max(one.width / one.high for one in (less, more)) > Fraction(1, 10**digits):
        raise WorkLimit("These multipliers need more precision than a proof may use: choose fewer digits.")
    return Unsplit(proof, (less, more))
