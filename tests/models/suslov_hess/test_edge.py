"""The edge of the possible (h, f): no torus, but a circle of states with two equilibria, or one periodic orbit."""

from fractions import Fraction
from itertools import product

import mpmath
import pytest

from hess_mechanics import prove, systems
from support.thorough import sample

# n3 and its root: where both are rational, so are h and f.
PLACES = [(Fraction(1, 4), Fraction(1, 2)), (Fraction(1, 9), Fraction(1, 3)), (Fraction(16, 25), Fraction(4, 5))]


def place(n, root):
    return (1 - 3 * n * n) / (2 * n), (1 - n * n) / root


def number(x):
    return mpmath.mpf(Fraction(x).numerator) / Fraction(x).denominator


def state_at(h, f, n, phi):
    """(w, n) on the circle: (n1, n2) is parallel to w, and w·(n1, n2) = f."""
    rho = mpmath.sqrt(2 * (number(h) + number(n)))
    w = [rho * mpmath.sin(phi), rho * mpmath.cos(phi)]
    return [*w, *(number(f) / rho**2 * x for x in w), number(n)]


def integrals(y):
    return systems()["hess"].integrals(y, (0, 1))


@pytest.mark.parametrize(
    ("a", "sign", "where"), sample(product(["0.5", "-0.5", "1.5", "-3", "0.1", "0"], [1, -1], PLACES), 5)
)
def test_what_is_proved_of_the_circle_is_what_the_field_does(a, sign, where):
    """At the equilibria the field vanishes, and next to them it points to the one and away from the other."""
    n, root = where
    h, f = place(n, root)
    found = prove(a, h, sign * f)
    assert found.n == n
    field = systems()["hess"].field
    with mpmath.workdps(40):
        p = mpmath.mpf(a), 1

    def speed(phi):
        """φ' by the field of the reduced equations, and how far that leads off the circle."""
        y = state_at(h, found.f, n, phi)
        rates = field(y, p)
        turn = (y[1] * rates[0] - y[0] * rates[1]) / (y[0] ** 2 + y[1] ** 2)
        # Along the circle w and (n1, n2) turn together.
        off = max(abs(rate - turn * x) for rate, x in zip(rates, (y[1], -y[0], y[3], -y[2], 0), strict=True))
        return turn, off

    with mpmath.workdps(40):
        for phi in (mpmath.mpf(0), mpmath.mpf(1), mpmath.mpf(-2)):
            y = integrals(state_at(h, found.f, n, phi))
            assert max(abs(y["E"] - number(h)), abs(y["F1"] - 1), abs(y["F2"] - number(found.f))) < 1e-35
            assert speed(phi)[1] < 1e-35
        grid = [speed(2 * mpmath.pi * k / 100)[0] for k in range(100)]
        if found.statement == "periodic orbit":
            assert found.fixed_points == found.rates == ()
            assert min(grid) > 0 or max(grid) < 0
            # The period is the integral of 1/|φ'|: of a periodic function, so sums of values converge fast.
            known = mpmath.quad(lambda phi: 1 / abs(speed(phi)[0]), mpmath.linspace(0, 2 * mpmath.pi, 9))
            assert abs(number(found.period.low) - known) < mpmath.mpf(10) ** -25
            assert found.period.width < found.period.high / 10**29
            return
        assert found.statement == "two equilibria"
        assert found.period is None
        assert sum(x * y <= 0 for x, y in zip(grid, grid[1:] + grid[:1], strict=True)) == 2
        for angle, rate, attracts in zip(found.fixed_points, found.rates, (True, False), strict=True):
            assert angle.width < Fraction(1, 10**29)
            phi = number(angle.low)
            assert abs(speed(phi)[0]) < mpmath.mpf(10) ** -28
            slope = mpmath.diff(lambda x: speed(x)[0], phi)
            assert (slope < 0) == attracts
            assert abs(slope - number(rate.low)) < 1e-12
