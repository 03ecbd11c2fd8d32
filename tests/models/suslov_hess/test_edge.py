"""The edge of the possible (h, f): no torus, but a circle of states with two equilibria, or one periodic orbit."""

from fractions import Fraction
from itertools import product

import mpmath
import pytest

from hess_mechanics import prove, systems
from support.thorough import sample

# n3 and its root: where both are rational, so are h and f.
PLACES = [(Fraction(1, 4), Fraction(1, 2)), (Fraction(1, 9), Fraction(1, 3)), (Fraction(16, 25), Fraction(4, 5))]


def number(x):
    return mpmath.mpf(Fraction(x).numerator) / Fraction(x).denominator


@pytest.mark.parametrize(
    ("a", "sign", "where"), sample(product(["0.5", "-0.5", "1.5", "-3", "0.1", "0"], [1, -1], PLACES), 5)
)
@mpmath.workdps(40)
def test_what_is_proved_of_the_circle_is_what_the_field_does(a, sign, where):
    """At the equilibria the field vanishes, and next to them it points to the one and away from the other."""
    n, root = where
    found = prove(a, (1 - 3 * n * n) / (2 * n), sign * (1 - n * n) / root)
    assert found.n == n
    h, f = number(found.h), number(found.f)
    square = 2 * (h + number(n))

    def speed(phi):
        """φ' by the field of the reduced equations: (n1, n2) is parallel to w, and w·(n1, n2) = f."""
        w = mpmath.sqrt(square) * mpmath.sin(phi), mpmath.sqrt(square) * mpmath.cos(phi)
        y = [*w, *(f / square * x for x in w), number(n)]
        rates = systems()["hess"].field(y, (mpmath.mpf(a), 1))
        turn = (w[1] * rates[0] - w[0] * rates[1]) / square
        # Along the circle w and (n1, n2) turn together.
        assert max(abs(r - turn * x) for r, x in zip(rates, (y[1], -y[0], y[3], -y[2], 0), strict=True)) < 1e-35
        return turn

    grid = [speed(2 * mpmath.pi * k / 100) for k in range(100)]
    if found.statement == "periodic orbit":
        assert found.fixed_points == found.rates == ()
        assert min(grid) > 0 or max(grid) < 0
        # The period is the integral of 1/|φ'|: of a periodic function, so sums of values converge fast.
        known = mpmath.quad(lambda phi: 1 / abs(speed(phi)), mpmath.linspace(0, 2 * mpmath.pi, 9))
        assert abs(number(found.period.low) - known) < mpmath.mpf(10) ** -25
        assert found.period.width < found.period.high / 10**29
        return
    assert found.statement == "two equilibria"
    assert found.period is None
    assert sum(x * y <= 0 for x, y in zip(grid, grid[1:] + grid[:1], strict=True)) == 2
    for angle, rate, attracts in zip(found.fixed_points, found.rates, (True, False), strict=True):
        assert angle.width < Fraction(1, 10**29)
        phi = number(angle.low)
        assert abs(speed(phi)) < mpmath.mpf(10) ** -28
        slope = mpmath.diff(speed, phi)
        assert (slope < 0) == attracts
        assert abs(slope - number(rate.low)) < 1e-12
