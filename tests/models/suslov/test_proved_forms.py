"""Closed forms with proved bounds: against formulas and integrals of mpmath with 40 digits."""

from fractions import Fraction

import mpmath
from pytest import approx, mark, raises

from hess_mechanics import SuslovBody, scattering, systems
from hess_mechanics.errors import InvalidParameter, NotPositiveDefinite
from hess_mechanics.suslov.proved_forms import proved_cos_chi, proved_period, proved_radial_period
from hess_mechanics.suslov.scattering import cos_chi
from support.refusals import refused
from support.thorough import sample

# (I11, I22, I13, I23), cos χ: held values, from 40-digit Taylor series of the motion.
HELD = [
    (("1", "1.5", "0.7", "1.2"), "-0.47889450360074"),
    (("2", "1", "0.3", "0.5"), "-0.95659283876095"),
    (("3", "2", "-0.4", "0.9"), "-0.98973299253727"),
]


def rational(number):
    mantissa, exponent = number.man_exp
    return (-1 if number < 0 else 1) * Fraction(mantissa) * Fraction(2) ** exponent


@mark.parametrize(("tensor", "held"), HELD)
def test_cos_chi_of_any_tensor_is_that_of_the_motion(tensor, held):
    found = proved_cos_chi(*tensor)
    assert found.width < Fraction(1, 10**30)
    # The first held value is off by 1.2e-14, in its last digit: the motion itself, integrated, decides.
    assert abs(found.low - Fraction(held)) < Fraction(2, 10**14)
    body = SuslovBody(*map(float, tensor))
    moved = scattering(body, "reference")
    assert float(found.low) == approx(moved.cos_chi, abs=min(1e-14, moved.error_estimate))
    assert float(found.low) == approx(cos_chi(body), abs=2e-15)


@mark.parametrize(
    ("I11", "I22", "I23"),
    [("3.56", "1", "0.8"), ("2.44", "1", "0.5"), ("1.64", "1", "0.8"), ("0.5", "2", "0.3"), ("1", "1", "0.01")],
)
def test_cos_chi_encloses_forty_digits_of_the_formula_for_I13_zero(I11, I22, I23):
    """2cos²(πk/2)/cosh²(πI22/(2I23)) − 1, k² = I22(I11 − I22)/I23²."""
    with mpmath.workdps(60):
        one, two, r = map(mpmath.mpf, (I11, I22, I23))
        k = mpmath.sqrt(mpmath.mpc(two * (one - two) / r**2))
        across = mpmath.cosh(mpmath.pi * two / (2 * r))
        known = rational(2 * mpmath.re(mpmath.cos(mpmath.pi * k / 2) ** 2) / across**2 - 1)
    found = proved_cos_chi(I11, I22, "0", I23)
    # 60 digits of mpmath.
    slack = Fraction(1, 10**55)
    assert found.low - slack <= known <= found.high + slack
    assert found.width < Fraction(1, 10**30)


@mark.parametrize(
    ("body", "omega", "gamma"),
    [
        (("1.3", "0.8", "0.5", "-0.2"), ("1", "-0.5"), ("0", "0.6")),
        (("2", "1", "0", "0"), ("0.7", "0.4"), ("0.3", "-0.2")),
        (("1", "1.5", "-1", "2"), ("0", "0"), ("0.1", "0.5")),
    ],
)
def test_the_period_encloses_forty_digits_of_the_integral(body, omega, gamma):
    """2 ∫ dτ/√P between the zeros of P = 1 − |u + vτ + aτ²/2|² on both sides of the start."""
    with mpmath.workdps(50):
        I11, I22, b1, b2 = map(mpmath.mpf, body)
        (w1, w2), (g1, g2) = (map(mpmath.mpf, pair) for pair in (omega, gamma))

        def P(tau):
            return 1 - (g1 - w2 * tau - b1 / I22 * tau**2 / 2) ** 2 - (g2 + w1 * tau - b2 / I11 * tau**2 / 2) ** 2

        ends = []
        for sign in (-1, 1):
            step = mpmath.mpf(sign) / 64
            far = next(k for k in range(1, 10_000) if P(k * step) < 0)
            ends.append(mpmath.findroot(P, ((far - 1) * step, far * step), solver="anderson", tol=1e-90))
        low, high = ends
        # τ = m + s sin x takes the roots out of the ends.
        m, s = (low + high) / 2, (high - low) / 2
        known = rational(
            2
            * mpmath.re(
                mpmath.quad(
                    lambda x: s * mpmath.cos(x) / mpmath.sqrt(P(m + s * mpmath.sin(x))),
                    [-mpmath.pi / 2, 0, mpmath.pi / 2],
                )
            )
        )
    found = proved_period(*body, omega, gamma)
    assert found.width < Fraction(1, 10**29)
    # The quadrature divides 0 by 0 at its ends, which leaves it some 25 digits.
    assert abs(known - found.low) < Fraction(1, 10**22)


test_what_has_no_closed_form_is_refused = refused(
    (lambda: proved_cos_chi("1", "2", "0", "0"), "I13 = I23 = 0"),
    (lambda: proved_cos_chi("1", "-2", "0.1", "0"), "choose I22 > 0", NotPositiveDefinite),
    (lambda: proved_period("1", "2", "0.1", "0", ("1", "1"), ("1", "0")), "off the equator"),
    (lambda: proved_period("1", "2", "0", "0", ("0", "0"), ("0.5", "0")), "at rest"),
)


@mark.parametrize(
    ("inertia", "b3", "omega", "gamma"),
    sample(
        [
            ("0.7", "2", ("1.5", "1"), ("0", "0.5")),
            ("1", "1", ("0.4", "-0.3"), ("0.6", "0.1")),
            ("1.5", "-0.8", ("0.9", "0.5"), ("-0.2", "0.3")),
        ],
        1,
    ),
)
def test_after_the_radial_period_the_motion_is_as_high_and_as_fast(inertia, b3, omega, gamma):
    """By Taylor series of mpmath of the general system: |ω|, γ3 and its rate, and not after half of it."""
    found = proved_radial_period(inertia, b3, omega, gamma)
    assert found.width < Fraction(1, 10**29)
    with mpmath.workdps(30):
        one, b = mpmath.mpf(inertia), mpmath.mpf(b3)
        w, u = ([mpmath.mpf(x) for x in some] for some in (omega, gamma))
        start = [*w, *u, mpmath.sqrt(1 - u[0] ** 2 - u[1] ** 2)]
        solution = mpmath.odefun(lambda _, y: systems()["suslov"].field(y, [one, one, 0, 0, 0, 0, b]), 0, start)
        period = mpmath.mpf(found.low.numerator) / found.low.denominator

        def seen(y):
            return [y[0] ** 2 + y[1] ** 2, y[4], y[2] * y[1] - y[3] * y[0]]

        then, half = seen(solution(period)), seen(solution(period / 2))
        assert max(abs(x - y) for x, y in zip(then, seen(start), strict=True)) < mpmath.mpf(10) ** -25
        assert max(abs(x - y) for x, y in zip(half, seen(start), strict=True)) > 1e-3


def test_what_has_no_radial_period_is_refused():
    for words, error in (
        (("1", "0", ("1", "0"), ("0", "0")), InvalidParameter),
        (("-1", "1", ("1", "0"), ("0", "0")), NotPositiveDefinite),
        (("1", "1", ("1", "0"), ("1", "0")), InvalidParameter),
    ):
        with raises(error):
            proved_radial_period(*words)
