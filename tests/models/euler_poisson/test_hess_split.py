"""Separatrices of the Hess manifold: unsplit in the Hess case; their splitting against Melnikov's integral."""

from dataclasses import replace
from math import exp, sin, sqrt

import numpy as np
from pytest import approx, mark, raises
from scipy.integrate import solve_ivp

from hess_mechanics import HeavyBody, circle_map
from hess_mechanics.errors import NotConverged, OutsideRegion
from hess_mechanics.euler_poisson.andoyer import AndoyerSection, hess_curve
from hess_mechanics.euler_poisson.hess_isomorphism import Bridge
from hess_mechanics.euler_poisson.hess_split import HessTorus, slope_of, split_at
from hess_mechanics.numerics.accuracy import PRECISE
from support.thorough import sample

TORI = [HessTorus((1.0, 0.625, 0.375), 9.975, 50.0, 5.0), HessTorus((1.0, 1.5, 2.0), -sqrt(0.5), 2.0, 1.0)]


def melnikov(torus, l):
    """d split/dε at ε = 0: ∫ of the perturbation of (r, M) along the unsplit separatrix, with the transverse growth.

    With u = (r, M), |r| = 1, u' = (r, M × A r) u − μ γ2 ε to first order, as dr/dε = (−r3, 0, r1); u of the unstable
    manifold is bounded in the past, that of the stable one in the future.
    """
    body = HeavyBody.hess(torus.moments, torus.strength)
    A, r, mu = np.array(body.a), np.array(body.r), body.mu
    x = float(hess_curve(body, np.array([l]))[0])
    start = np.array(AndoyerSection(body, torus.h, torus.f).state_at(l, x))

    def field(t, y, sense):
        M, g = y[:3] - (y[:3] @ r) * r, y[3:6]
        growth = r @ np.cross(M, A * r)
        return [
            *(sense * (np.cross(M, A * M) + mu * np.cross(r, g))),
            *(sense * np.cross(g, A * M)),
            -sense * growth,
            -mu * g[1] * exp(y[6]),
        ]

    bridge = Bridge.of_heavy(body)
    theta = circle_map(bridge.hess.a, *bridge.in_units_of_b(torus.h, torus.f), "reference")
    end = 25.0 / theta.fixed_points[1].log_multiplier * theta.period / bridge.hess.frequency_unit
    both = [
        solve_ivp(field, (0.0, end), [*start, 0.0, 0.0], "DOP853", rtol=1e-11, atol=1e-13, args=(sense,)).y[7, -1]
        for sense in (1.0, -1.0)
    ]
    G = np.linalg.norm(start[:3])
    return sum(both) / (G * (r[2] - r[0] * sin(l) * x / sqrt(1.0 - x * x)))


@mark.parametrize("torus", sample(TORI, 1))
def test_the_separatrices_part_as_melnikovs_integral_says(torus):
    there = split_at(torus, 0.0, PRECISE)
    assert abs(there.value) <= there.error < 1e-9
    close = [split_at(torus, away, PRECISE) for away in (1e-3, -1e-3, 2e-3, -2e-3)]
    slope, error = slope_of(close)
    exact = melnikov(torus, there.l)
    assert abs(slope - exact) <= error + 1e-8
    assert error < 1e-3 * abs(exact)
    for one in close:
        assert one.value == approx(exact * one.away, rel=2e-2)
        assert abs(one.value) > 1e3 * one.error


def test_where_there_is_nothing_to_split_that_is_said():
    with raises(OutsideRegion, match="no limit cycles"):
        split_at(replace(TORI[1], h=0.2), 0.0, PRECISE)
    with raises(OutsideRegion, match="no motion with these h and f"):
        split_at(replace(TORI[1], h=0.0), 0.0, PRECISE)
    with raises(NotConverged):
        split_at(replace(TORI[1], h=0.8), 0.1, PRECISE)
