"""The Hess manifold is invariant, and its separatrices coincide: an identity, and proofs with thirty digits."""

from fractions import Fraction

import mpmath
import pytest

import oracle
from hess_mechanics.errors import InvalidParameter, Separatrix
from hess_mechanics.euler_poisson import proved_manifold
from hess_mechanics.euler_poisson.equations import SYSTEM
from hess_mechanics.euler_poisson.proved_manifold import cofactor, unsplit_separatrices


@pytest.mark.parametrize("sign", [1, -1])
def test_the_rate_of_r_M_has_the_cofactor_on_every_hess_body(sign):
    found, claimed = cofactor(sign)
    assert found == claimed
    assert found != 0
    # The polynomials are those of a body: by numbers, off the manifold too.
    s, t, a2, mu, *state = (0.7, 0.4, 1.3, 0.9, 0.2, -0.6, 1.1, 0.5, -0.3, 0.8)
    values = [Fraction(x) for x in (s, t, a2, mu, *state)]
    rates = SYSTEM.field(state, [a2 - sign * s * s, a2, a2 + sign * t * t, s, 0.0, t, mu])
    known = s * rates[0] + t * rates[2]
    assert float(evaluated(found, values)) == pytest.approx(known, rel=1e-12)


def evaluated(polynomial, values):
    """Term by term, in rationals."""
    total = Fraction(0)
    for exponents, coefficient in polynomial.to_dict().items():
        term = Fraction(int(coefficient.p), int(coefficient.q))
        for value, power in zip(values, exponents, strict=True):
            term *= value ** int(power)
        total += term
    return total


@pytest.mark.parametrize("torus", [("0.5", "5.01253", "2.0025"), ("-0.7", "1.5", "0.6")])
def test_multipliers_of_the_saddles_to_thirty_digits(torus):
    """By the map through three orbits with 45 decimals."""
    found = unsplit_separatrices(*torus)
    held = oracle.circle_maps.map_by_three_orbits(*torus, 45)
    with mpmath.workdps(60):
        half = abs(mpmath.re(held.A))
        root = half + mpmath.sqrt(half * half - 1)
        for one, known in zip(found.multipliers, (root**-2, root**2), strict=True):
            value = Fraction(mpmath.nstr(known, 50))
            assert abs(value - one.low) < value * Fraction(1, 10**25)
            assert one.width < one.high * Fraction(1, 10**29)
    less, more = found.multipliers
    assert less.low * more.low <= 1 <= less.high * more.high


def test_nothing_is_claimed_where_there_are_no_cycles_or_no_invariant_manifold(monkeypatch):
    assert unsplit_separatrices("0.5", "0.2", "0.5") is None
    with pytest.raises(Separatrix):
        unsplit_separatrices("0.5", "1", "0")
    with pytest.raises(InvalidParameter, match="no torus"):
        unsplit_separatrices("3", "13/8", "15/8")
    found, claimed = cofactor(1)
    monkeypatch.setattr(proved_manifold, "cofactor", lambda sign: (found, claimed + (sign < 0)))
    assert unsplit_separatrices("0.5", "1.5", "0.6") is None
