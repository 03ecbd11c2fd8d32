"""The Euler–Poisson equations against integrals and motions known in closed form."""

from math import nan, sqrt

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


@mark.parametrize("moments", [(1.0, 0.625, 0.375), (1.0, 1.5, 2.0), (3.0, 2.0, 1.5)])
def test_the_relation_is_invariant_in_the_hess_case_and_in_no_other(moments):
    """d/dt (r1 M1 + r3 M3) = 0 wherever r1 M1 + r3 M3 = 0; with either sign of r3, as gess-*1 says."""
    random = np.random.default_rng(3)
    body = HeavyBody.hess(moments, 1.7)
    for turned, invariant in ((0.0, True), (0.01, False), (-0.2, False)):
        other = HeavyBody.hess(moments, 1.7, turned)
        assert other.is_hess is invariant
        slopes = []
        for _ in range(20):
            M, gamma = random.normal(size=3), random.normal(size=3)
            M -= (M @ other.r) * np.array(other.r)
            rate = rates(other, [*M, *gamma])
            slopes.append(abs(rate[0] * other.r[0] + rate[2] * other.r[2]))
        assert max(slopes) < 1e-14 if invariant else max(slopes) > 1e-3
    a1, a2, a3 = body.a
    r1, _, r3 = body.r
    assert r1 * sqrt(abs(a3 - a2)) == approx(r3 * sqrt(abs(a2 - a1)), rel=1e-14)
    mirrored = HeavyBody(body.a, (r1, 0.0, -r3), 1.7)
    assert mirrored.is_hess
    assert not HeavyBody(body.a, (r1, 1e-3, r3), 1.7).is_hess


# ---- Motions and integrals known in closed form ------------------------------------------------------------------


def orbits(body, count=4, span=30.0):
    random = np.random.default_rng(8)
    for _ in range(count):
        gamma = random.normal(size=3)
        state = [*random.normal(size=3), *gamma / np.linalg.norm(gamma)]
        yield solve(body, state, np.linspace(0.0, span, 100), "reference").states


def kovalevskaya(y):
    """a3 = 2a1 = 2a2, r = (1, 0, 0): |(M1 + iM2)²/2 + μ(γ1 + iγ2)/a1|²."""
    return np.abs(0.5 * (y[0] + 1j * y[1]) ** 2 + 0.8 * (y[3] + 1j * y[4])) ** 2


@mark.parametrize(
    ("body", "integral"),
    [
        param(HeavyBody((1.0, 1.6, 2.3), (0.0, 0.0, 0.0), 1.0), lambda y: np.sum(y[:3] ** 2, 0), id="Euler"),
        param(HeavyBody((1.5, 1.5, 0.9), (0.0, 0.0, 0.7), 2.0), lambda y: 10.0 * y[2], id="Lagrange"),
        param(HeavyBody((1.0, 1.0, 2.0), (1.0, 0.0, 0.0), 0.8), kovalevskaya, id="Kovalevskaya"),
    ],
)
def test_the_integrable_tops_keep_their_integrals(body, integral):
    for states in orbits(body):
        assert np.ptp(integral(states.T)) < 1e-11


def test_goryachev_and_chaplygin_keep_theirs_at_f_0():
    """a3 = 4a1 = 4a2, r = (1, 0, 0), (M, γ) = 0: M3(M1² + M2²) + (μ/a1) M1γ3 — and for another f it is lost."""
    body = HeavyBody((1.0, 1.0, 4.0), (1.0, 0.0, 0.0), 0.8)
    for states in orbits(body):
        for shift, kept in ((0.0, True), (0.7, False)):
            gamma = states[0, 3:]
            M = states[0, :3] - (states[0, :3] @ gamma - shift) * gamma
            run = solve(body, [*M, *gamma], np.linspace(0.0, 20.0, 100), "reference").states
            integral = run[:, 2] * (run[:, 0] ** 2 + run[:, 1] ** 2) + 0.8 * run[:, 0] * run[:, 5]
            assert np.ptp(integral) < 1e-11 if kept else np.ptp(integral) > 1e-2


# ---- Refusals ---------------------------------------------------------------------------------------------------


test_what_is_no_body_is_refused_in_a_sentence = refused(
    (lambda: HeavyBody((0.0, 1.0, 2.0), (1.0, 0.0, 0.0), 1.0), "a1 = 0.*choose a1 > 0", NotPositiveDefinite),
    (lambda: HeavyBody((1.0, 1e-25, 2.0), (1.0, 0.0, 0.0), 1.0), "choose ratios below"),
    (lambda: HeavyBody((1.0, 1.0, 2.0), (nan, 0.0, 0.0), 1.0), "r1 is not a finite number"),
    (lambda: HeavyBody.hess((1.0, 2.0, 1.5), 1.0), "I2 = 2 must lie between I1 = 1 and I3 = 1.5"),
    (lambda: HeavyBody.hess((1.0, 1.0, 1.0), 1.0), "which differ"),
    (lambda: solve(GESS1, [1e200, 0.0, 0.0, 0.0, 0.0, 1.0], [1.0], "draft"), "less extreme", ModelError),
)
