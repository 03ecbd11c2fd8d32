"""The Euler–Poisson equations against integrals and motions known in closed form."""

from math import sqrt

import numpy as np
from pytest import approx, mark, param

from hess_mechanics import solve
from hess_mechanics.errors import ModelError, NotPositiveDefinite
from hess_mechanics.euler_poisson.equations import HeavyBody
from support.andoyer import GESS1, RIS, rates
from support.refusals import refused


def test_the_body_of_the_loxodromic_figures_is_the_hess_case():
    # H = ½(M1² + ⅔M2² + ½M3²) + γ1/√3 + γ3/√6; the caption prints ⅔M3² once for ⅔M2².
    assert RIS.a == approx((1.0, 2.0 / 3.0, 0.5))
    assert [RIS.mu * r for r in RIS.r] == approx([-1.0 / sqrt(3.0), 0.0, -1.0 / sqrt(6.0)])
    assert RIS.is_hess
    assert RIS.hess_a == approx(sqrt(1.0 / 18.0) / (2.0 / 3.0))


@mark.parametrize("moments", [(1.0, 1.5, 2.0), (3.0, 2.0, 1.5)])
def test_the_relation_is_invariant_in_the_hess_case_and_in_no_other(moments):
    """d/dt (r1 M1 + r3 M3) = 0 wherever r1 M1 + r3 M3 = 0; with either sign of r3, as gess-*1 says."""
    random = np.random.default_rng(3)
    body = HeavyBody.hess(moments, 1.7)
    for turned, invariant in ((0.0, True), (0.01, False), (-0.2, False)):
        other = HeavyBody.hess(moments, 1.7, turned)
        assert other.is_hess is invariant
        M, gamma = random.normal(size=(2, 20, 3))
        M -= np.outer(M @ other.r, other.r)
        slopes = [abs(rates(other, state)[:3] @ other.r) for state in np.hstack([M, gamma])]
        assert max(slopes) < 1e-14 if invariant else max(slopes) > 1e-3
    r1, _, r3 = body.r
    assert HeavyBody(body.a, (r1, 0.0, -r3), 1.7).is_hess
    assert not HeavyBody(body.a, (r1, 1e-3, r3), 1.7).is_hess


# ---- Motions and integrals known in closed form ------------------------------------------------------------------


def kovalevskaya(y):
    """a3 = 2a1 = 2a2, r = (1, 0, 0): |(M1 + iM2)²/2 + μ(γ1 + iγ2)/a1|²."""
    return np.abs(0.5 * (y[0] + 1j * y[1]) ** 2 + 0.8 * (y[3] + 1j * y[4])) ** 2


def goryachev_chaplygin(y):
    """a3 = 4a1 = 4a2, r = (1, 0, 0): M3(M1² + M2²) + (μ/a1) M1γ3, for f = 0 only."""
    return y[2] * (y[0] ** 2 + y[1] ** 2) + 0.8 * y[0] * y[5]


@mark.parametrize(
    ("body", "integral"),
    [
        param(HeavyBody((1.0, 1.0, 2.0), (1.0, 0.0, 0.0), 0.8), kovalevskaya, id="Kovalevskaya"),
        param(HeavyBody((1.0, 1.0, 4.0), (1.0, 0.0, 0.0), 0.8), goryachev_chaplygin, id="Goryachev–Chaplygin, f = 0"),
    ],
)
def test_the_integrable_tops_keep_their_integrals(body, integral):
    random = np.random.default_rng(8)
    for f in (0.0, -0.7):
        gamma, M = random.normal(size=(2, 3))
        gamma /= np.linalg.norm(gamma)
        M -= (M @ gamma - f) * gamma
        states = solve(body, [*M, *gamma], np.linspace(0.0, 30.0, 100), "reference").states
        kept = f == 0.0 or integral is not goryachev_chaplygin
        change = np.ptp(integral(states.T))
        assert change < 1e-11 if kept else change > 1e-2


# ---- Refusals ---------------------------------------------------------------------------------------------------


test_what_is_no_body_is_refused_in_a_sentence = refused(
    (lambda: HeavyBody((0.0, 1.0, 2.0), (1.0, 0.0, 0.0), 1.0), "a1 = 0.*choose a1 > 0", NotPositiveDefinite),
    (lambda: HeavyBody((1.0, 1e-25, 2.0), (1.0, 0.0, 0.0), 1.0), "choose ratios of at most"),
    (lambda: HeavyBody.hess((1.0, 2.0, 1.5), 1.0), "I2 = 2 must lie between I1 = 1 and I3 = 1.5"),
    (lambda: solve(GESS1, [1e200, 0.0, 0.0, 0.0, 0.0, 1.0], [1.0], "draft"), "less extreme", ModelError),
)
